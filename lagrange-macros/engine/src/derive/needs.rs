//! System → need allocation: one bit for every part of the equations that a scene or a mode can do without.
//!
//! Need 0 is always held: energies without a name belong to it. Every named energy, force and dissipation has a
//! need, so that a scene may leave it out; every row has four, so that a mode pays for what it uses: an open
//! contact for its gap, a closed one for Jacobian and bias, a sliding friction for Jacobian and slip but no bias.
//! The components of one friction act together and share their needs.

use super::NeedId;
use crate::model::{ItemName, System};

/// Needs of everything in a system, in order of declaration.
pub(super) struct Needs {
    /// What each need asks for.
    pub labels: Vec<String>,
    /// Per kinetic term.
    pub kinetic: Vec<NeedId>,
    /// Per potential term.
    pub potential: Vec<NeedId>,
    /// Per force: contribution to f; report.
    pub forces: Vec<[NeedId; 2]>,
    /// Per dissipation: contribution to f; report.
    pub dissipations: Vec<[NeedId; 2]>,
    /// Per row: Jacobian, bias, position, velocity.
    pub rows: Vec<[NeedId; 4]>,
    /// Per contact.
    pub restitution: Vec<NeedId>,
    /// Per friction: coefficients and given normal force.
    pub coefficients: Vec<NeedId>,
    /// Per branch: its guard.
    pub branches: Vec<NeedId>,
    /// Energies.
    pub energy: NeedId,
    /// Momenta.
    pub momenta: NeedId,
    /// Per observe.
    pub observes: Vec<NeedId>,
    /// Per stop.
    pub stops: Vec<NeedId>,
    /// Per mark.
    pub marks: Vec<NeedId>,
}

/// Need 0.
pub(super) const ALWAYS: NeedId = NeedId(0);

/// Numbers the needs of a system.
pub(super) fn allocate(system: &System) -> Needs {
    let mut labels = vec!["always".to_owned()];
    let mut new = |label: String| {
        labels.push(label);
        NeedId(labels.len() - 1)
    };
    let kinetic = system.kinetic.iter();
    let kinetic = kinetic
        .map(|k| effect("kinetic", &k.name, &mut new))
        .collect();
    let potential = system.potential.iter();
    let potential = potential
        .map(|v| effect("potential", &v.name, &mut new))
        .collect();
    let mut load = |name: &ItemName| {
        [
            new(format!("force of {}", name.text)),
            new(format!("value and power of {}", name.text)),
        ]
    };
    let forces = system.forces.iter().map(|f| load(&f.name)).collect();
    let dissipations = system.dissipations.iter().map(|d| load(&d.name)).collect();

    let rows = rows(system, &mut new);
    let mut named = |what: &str, name: &ItemName| new(format!("{what} {}", name.text));
    let contacts = system.contacts.iter();
    let restitution = contacts.map(|c| named("restitution of", &c.name)).collect();
    let frictions = system.frictions.iter();
    let coefficients = frictions
        .map(|f| named("coefficients of", &f.name))
        .collect();
    let branches = (0..system.branches.len())
        .map(|i| new(format!("branch {i}")))
        .collect();
    let energy = new("energy".to_owned());
    let momenta = new("momenta".to_owned());
    let mut named = |what: &str, name: &ItemName| new(format!("{what} {}", name.text));
    let observes = system.observes.iter();
    let observes = observes.map(|o| named("observe", &o.name)).collect();
    let stops = system.stops.iter();
    let stops = stops.map(|s| named("stop", &s.name)).collect();
    let marks = system.marks.iter();
    let marks = marks.map(|m| named("mark", &m.name)).collect();
    Needs {
        labels,
        kinetic,
        potential,
        forces,
        dissipations,
        rows,
        restitution,
        coefficients,
        branches,
        energy,
        momenta,
        observes,
        stops,
        marks,
    }
}

/// Energies that the user did not name cannot be left out.
fn effect(kind: &str, name: &ItemName, new: &mut impl FnMut(String) -> NeedId) -> NeedId {
    match name.ident {
        Some(_) => new(format!("{kind} {}", name.text)),
        None => ALWAYS,
    }
}

/// Jacobian, bias, position and velocity of each row.
fn rows(system: &System, new: &mut impl FnMut(String) -> NeedId) -> Vec<[NeedId; 4]> {
    let mut rows = Vec::new();
    for constraint in &system.constraints {
        rows.push(row(&constraint.name, "residual", "rate", new));
    }
    for contact in &system.contacts {
        rows.push(row(&contact.name, "gap", "rate", new));
    }
    for friction in &system.frictions {
        let [jacobian, bias, slip] = ["jacobian", "bias", "slip"]
            .map(|part| new(format!("{part} of {}", friction.name.text)));
        // A slip is a velocity: it has no position level, and no need for one.
        rows.extend(friction.slip.iter().map(|_| [jacobian, bias, slip, slip]));
    }
    rows
}

fn row(
    name: &ItemName,
    position: &str,
    velocity: &str,
    new: &mut impl FnMut(String) -> NeedId,
) -> [NeedId; 4] {
    ["jacobian", "bias", position, velocity].map(|part| new(format!("{part} of {}", name.text)))
}
