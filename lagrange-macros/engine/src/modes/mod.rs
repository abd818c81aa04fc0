//! System → the modes that it can be in: which contacts are closed, and how each friction acts.
//!
//! Within one mode the equations of motion are smooth: a fixed set of rows acts, and some of these rows pin coordinates.

mod list;
mod name;
mod pins;
#[cfg(test)]
mod tests;

use crate::model::{Normal, System};

pub use list::{Modes, all, structures};
pub use name::clauses;
pub use pins::{Pin, pinned, pins};

/// Which contacts are closed, and how each friction acts. Lengths are those of the system's lists.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Mode {
    /// Whether each contact is closed.
    pub contacts: Vec<bool>,
    /// How each friction acts.
    pub frictions: Vec<FrictionState>,
    /// Per constraint: the sign of its multiplier λ, on which the normal force |λ| of a slipping friction depends.
    pub normal_signs: Vec<Sign>,
    /// The constraint that a scene leaves out.
    pub left_out: Option<usize>,
}

/// How a friction acts.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum FrictionState {
    /// Its contact is open, or it is left out: no force.
    Inactive,
    /// Slip is zero; the force is whatever keeps it so.
    Stick,
    /// The force is μk N against the slip.
    Slip(Direction),
}

/// Direction of a slip; the friction force points the other way.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Direction {
    /// One component, of this sign.
    Fixed(Sign),
    /// Two components: the direction of the slip velocity itself, which turns.
    AlongSlip,
    /// Two components: the slip is zero and begins along a given direction.
    Incipient,
}

/// A sign that a mode may fix.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Sign {
    /// +1
    Positive,
    /// −1
    Negative,
    /// The mode has both: its equations take the sign as an argument.
    Undecided,
}

impl FrictionState {
    /// One component slips along its positive direction.
    pub const FORWARD: Self = Self::Slip(Direction::Fixed(Sign::Positive));
    /// One component slips against its positive direction.
    pub const BACKWARD: Self = Self::Slip(Direction::Fixed(Sign::Negative));

    /// Whether it slips.
    pub fn slips(self) -> bool {
        matches!(self, Self::Slip(_))
    }

    /// Whether a slip of one component is positive, where the mode fixes it.
    pub fn is_forward(self) -> Option<bool> {
        match self {
            Self::FORWARD => Some(true),
            Self::BACKWARD => Some(false),
            _ => None,
        }
    }
}

impl Mode {
    /// No contact closed, and no friction acts.
    pub fn open(system: &System) -> Mode {
        Mode {
            contacts: vec![false; system.contacts.len()],
            frictions: vec![FrictionState::Inactive; system.frictions.len()],
            normal_signs: vec![Sign::Undecided; system.constraints.len()],
            left_out: None,
        }
    }

    /// Rows that hold as equations a v̇ + γ = 0, ascending: constraints, closed contacts, components that stick.
    pub fn acting_rows(&self, system: &System) -> Vec<usize> {
        self.rows(system, |state| state == FrictionState::Stick)
    }

    /// Rows with a force, ascending: those that act, and components that slip.
    pub fn loaded_rows(&self, system: &System) -> Vec<usize> {
        self.rows(system, |state| state != FrictionState::Inactive)
    }

    fn rows(&self, system: &System, counts: impl Fn(FrictionState) -> bool) -> Vec<usize> {
        let holds = |&i: &usize| {
            let contact = system.constraints[i].while_contact;
            contact.is_none_or(|contact| self.contacts[contact]) && self.left_out != Some(i)
        };
        let closed = (0..self.contacts.len()).filter(|&i| self.contacts[i]);
        let frictions = (0..self.frictions.len()).filter(|&f| counts(self.frictions[f]));
        let constraints = (0..system.constraints.len()).filter(holds);
        constraints
            .chain(closed.map(|i| system.contact_row(i)))
            .chain(frictions.flat_map(|f| system.slip_rows(f)))
            .collect()
    }

    /// This mode without a constraint that acts in it; none where a friction has its normal force from this constraint.
    fn without(&self, system: &System, constraint: usize) -> Option<Mode> {
        let mut frictions = system.frictions.iter().zip(&self.frictions);
        let carries = frictions.any(|(friction, &state)| {
            let mut pressing = system.pressing(friction.normal);
            pressing.any(|i| i == constraint) && state != FrictionState::Inactive
        });
        let acts = self.acting_rows(system).contains(&constraint);
        (acts && !carries).then(|| Mode {
            left_out: Some(constraint),
            ..self.clone()
        })
    }

    /// This mode with each sign of the multipliers from which slipping frictions have their normal force.
    pub fn with_normal_signs(&self, system: &System) -> Vec<Mode> {
        let mut modes = vec![self.clone()];
        for (friction, state) in system.frictions.iter().zip(&self.frictions) {
            if let (Normal::Constraint(i), FrictionState::Slip(_)) = (friction.normal, state)
                && modes[0].normal_signs[i] == Sign::Undecided
            {
                let signed = |mode: Mode| {
                    [Sign::Positive, Sign::Negative].map(|sign| {
                        let mut mode = mode.clone();
                        mode.normal_signs[i] = sign;
                        mode
                    })
                };
                modes = modes.into_iter().flat_map(signed).collect();
            }
        }
        modes
    }
}
