//! What is kept whole in equations that would outgrow all bounds multiplied out.
//!
//! The axes of the bodies of an arm in space are each made of those of the body before it. Multiplied out, they have terms for
//! all products of all angles; as numbers of their own they take a few operations each, and so do their derivatives.

use crate::model::{Normal, Restitution, System, Worked};
use crate::symbolic::{ExprId, MOST_OPERANDS};

/// Energies of fewer terms are multiplied out in any case.
const FEW_TERMS: f64 = 1000.0;

/// And so are slips of fewer terms than these. A row has the rates of all its factors as well.
const FEW_TERMS_OF_A_SLIP: f64 = 300.0;

/// Equations that take more operands to derive have fewer operations if what is shared in them is kept whole.
const MULTIPLIED_OUT: usize = 250_000;

/// How many operands may be spent on equations that are multiplied out.
pub(super) fn operands_multiplied_out(system: &System) -> usize {
    let slips = system.frictions.iter().flat_map(|friction| &friction.slip);
    let slips: Vec<ExprId> = slips.map(|&(slip, _)| slip).collect();
    let many = system.pool.terms_multiplied_out(&slips) > FEW_TERMS_OF_A_SLIP;
    match many || energies_may_outgrow(system) {
        true => MULTIPLIED_OUT,
        false => MOST_OPERANDS,
    }
}

/// Whether multiplying out may give too much of energies or dissipations: they have many terms then.
pub(super) fn energies_may_outgrow(system: &System) -> bool {
    let energies = system.kinetic.iter().chain(&system.potential);
    let energies = energies.map(|term| term.energy);
    let functions = energies.chain(system.dissipations.iter().map(|d| d.rayleigh));
    let functions: Vec<ExprId> = functions.collect();
    system.pool.terms_multiplied_out(&functions) > FEW_TERMS
}

/// Keeps whole what stands more than once in the expressions of a system.
pub(super) fn keep_shared(system: &mut System) {
    let mut places = places(system);
    let expressions: Vec<ExprId> = places.iter().map(|place| **place).collect();
    drop(places);
    let kept = system.pool.keep_shared(&expressions);
    places = self::places(system);
    for (place, kept) in places.into_iter().zip(kept) {
        *place = kept;
    }
}

/// All expressions that equations are derived from.
pub(super) fn places(system: &mut System) -> Vec<&mut ExprId> {
    let mut places = Vec::new();
    let energies = system.kinetic.iter_mut().chain(&mut system.potential);
    places.extend(energies.map(|term| &mut term.energy));
    places.extend(system.constraints.iter_mut().map(|c| &mut c.residual));
    for contact in &mut system.contacts {
        let (Restitution::Newton(e) | Restitution::Poisson(e)) = &mut contact.restitution;
        places.extend([&mut contact.gap, e]);
        places.extend(contact.normal_factor.as_mut());
        places.extend(contact.region.as_mut());
    }
    for friction in &mut system.frictions {
        places.extend(friction.slip.iter_mut().map(|(slip, _)| slip));
        if let Normal::Given(force) = &mut friction.normal {
            places.push(force);
        }
        places.push(&mut friction.static_coefficient);
        places.push(&mut friction.kinetic_coefficient);
    }
    for force in &mut system.forces {
        places.push(&mut force.value);
        places.extend(force.generalized.iter_mut().map(|(_, e)| e));
        for (component, worked) in &mut force.components {
            places.push(component);
            if let Worked::Point(e) | Worked::Speed(e) = worked {
                places.push(e);
            }
        }
    }
    places.extend(system.dissipations.iter_mut().map(|d| &mut d.rayleigh));
    places.extend(system.branches.iter_mut().map(|b| &mut b.guard));
    places.extend(system.observes.iter_mut().map(|o| &mut o.value));
    let watches = system.stops.iter_mut().chain(&mut system.marks);
    places.extend(watches.flat_map(|watch| &mut watch.terms));
    places
}
