//! A state of a mode with everything derived, by the handles of items.

use crate::dynamics::Dynamics;
use crate::effects::Item;
use crate::handle::{ContactId, CoordinateId, FrictionId, ObserveId};
use crate::system::{Normal, Place};
use crate::trajectory::Instant;

/// A state of a mode with everything derived.
#[derive(Clone, Debug)]
pub struct Moment {
    /// All numbers by index.
    pub now: Instant<f64>,
    constraints: Vec<usize>,
    contacts: Vec<usize>,
    frictions: Vec<usize>,
    /// Place of each friction's first slip in [`Instant::slips`].
    slips: Vec<usize>,
    margins: Vec<f64>,
}

impl Moment {
    pub(super) fn new(dynamics: &Dynamics<f64>, now: Instant<f64>) -> Moment {
        let d = dynamics.description();
        let mut slips = Vec::new();
        let mut place = 0;
        for friction in d.frictions {
            slips.push(place);
            place += friction.components;
        }
        Moment {
            now,
            constraints: d.constraints.iter().map(|c| c.row).collect(),
            contacts: d.contacts.iter().map(|c| c.row).collect(),
            frictions: d.frictions.iter().map(|f| f.row).collect(),
            slips,
            margins: (0..d.frictions.len())
                .map(|f| margin(dynamics, f))
                .collect(),
        }
    }

    /// Position.
    pub fn q(&self, coordinate: CoordinateId) -> f64 {
        self.now.q[coordinate.0]
    }

    /// Velocity.
    pub fn v(&self, coordinate: CoordinateId) -> f64 {
        self.now.v[coordinate.0]
    }

    /// Acceleration.
    pub fn a(&self, coordinate: CoordinateId) -> f64 {
        self.now.acceleration[coordinate.0]
    }

    /// Force of a contact, constraint, friction (first component) or applied force; 0 for other items.
    pub fn force(&self, item: impl Into<Item>) -> f64 {
        match item.into() {
            Item::Constraint(i) => self.now.forces[self.constraints[i]],
            Item::Contact(i) => self.now.forces[self.contacts[i]],
            Item::Friction(i) => self.now.forces[self.frictions[i]],
            Item::Force(i) => self.now.loads[i],
            _ => 0.0,
        }
    }

    /// The guard of an open contact.
    pub fn gap(&self, contact: ContactId) -> f64 {
        self.now.gaps[contact.0]
    }

    /// The guard of a slipping friction (first component).
    pub fn slip(&self, friction: FrictionId) -> f64 {
        self.now.slips[self.slips[friction.0]]
    }

    /// The guard of a sticking friction: μs N − |F|.
    pub fn margin(&self, friction: FrictionId) -> f64 {
        self.margins[friction.0]
    }

    /// A declared output.
    pub fn observe(&self, output: ObserveId) -> f64 {
        self.now.observes[output.0]
    }

    /// T + V as declared.
    pub fn energy(&self) -> f64 {
        self.now.kinetic + self.now.potential
    }
}

/// μs N − |F|
fn margin(dynamics: &Dynamics<f64>, f: usize) -> f64 {
    let d = dynamics.description();
    let friction = &d.frictions[f];
    let normal = match friction.normal {
        Normal::Contact(c) => {
            let factor = d.contacts[c].normal_factor;
            let factor = factor.map_or(1.0, |place: Place| dynamics.motion(place));
            factor * dynamics.force(d.contacts[c].row)
        }
        Normal::Constraint(c) => dynamics.force(d.constraints[c].row).abs(),
        Normal::Given(place) => dynamics.motion(place),
    };
    let rows = friction.row..friction.row + friction.components;
    let square: f64 = rows.map(|row| dynamics.force(row).powi(2)).sum();
    dynamics.motion(friction.static_coefficient) * normal - square.sqrt()
}
