//! What can be seen to be singular before any number is known.

use super::euler_lagrange::Inertia;
use super::{OutputId, Structure};
use crate::diagnostics::{Code, Diagnostics};
use crate::model::System;
use std::collections::BTreeSet;

/// Whether the system can be solved as far as its structure tells; reports what cannot.
///
/// * A coordinate whose row of M vanishes has no inertia. A constraint that contains it may still determine it:
///   the constrained system can be regular where M alone is not.
/// * Impacts need M free of velocities.
/// * Exact numbers that overflowed make every form unreliable.
pub(super) fn check(
    system: &System,
    inertias: &[Inertia],
    structure: &Structure<OutputId>,
    sink: &mut Diagnostics,
) -> bool {
    let before = sink.count();
    let inert: BTreeSet<usize> = structure
        .mass
        .iter()
        .flat_map(|&(i, j, _)| [i, j])
        .collect();
    let tied: BTreeSet<usize> = system
        .constraints
        .iter()
        .zip(&structure.rows)
        .filter(|(constraint, _)| constraint.while_contact.is_none())
        .flat_map(|(_, row)| row.jacobian.iter().map(|&(i, _)| i))
        .collect();
    for (i, coordinate) in system.coordinates.iter().enumerate() {
        if !inert.contains(&i) && !tied.contains(&i) {
            sink.report(
                Code::NoInertia,
                coordinate.name.span,
                &[&coordinate.name.text],
            );
        }
    }
    if !system.contacts.is_empty() {
        quadratic(system, inertias, sink);
    }
    if system.pool.overflowed() {
        sink.report(Code::Overflow, system.name.span(), &[]);
    }
    sink.count() == before
}

/// Reports the velocities that the mass matrix contains.
fn quadratic(system: &System, inertias: &[Inertia], sink: &mut Diagnostics) {
    let what = if system.from_lagrangian {
        "Lagrangian"
    } else {
        "kinetic energy"
    };
    let Some(term) = system.kinetic.first() else {
        return;
    };
    let pool = &system.pool;
    let entries = inertias
        .iter()
        .filter(|inertia| !inertia.quadratic)
        .flat_map(|inertia| inertia.mass.values());
    let symbols: BTreeSet<_> = entries.flat_map(|&entry| pool.symbols(entry)).collect();
    for coordinate in system
        .coordinates
        .iter()
        .filter(|c| symbols.contains(&c.velocity))
    {
        let rate = format!("der({})", coordinate.name.text);
        sink.report(Code::NotQuadratic, term.name.span, &[&what, &rate]);
    }
}
