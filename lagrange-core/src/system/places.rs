//! Where the numbers of the equations are found, and which needs they belong to.
//!
//! Every number is an *output* of a program or a parameter-only *constant*; a [`ValueRef`] says which.

use super::Description;
use crate::program::ValueRef;

/// One scalar equation aᵢ v̇ + γᵢ = 0 with multiplier λᵢ.
#[derive(Debug)]
pub struct Row {
    /// aᵢ: (coordinate, where), structural zeros left out. Need [`RowNeeds::jacobian`].
    pub jacobian: &'static [(usize, ValueRef)],
    /// γᵢ. Need [`RowNeeds::bias`].
    pub bias: ValueRef,
    /// g(q,t), for rows of position level (constraints, contacts). Need [`RowNeeds::position`].
    pub position: Option<ValueRef>,
    /// aᵢ v + bᵢ: the rate of g, or the velocity-level residual, or the slip. Need [`RowNeeds::velocity`].
    pub velocity: ValueRef,
    /// Whether bᵢ is not zero: what it holds moves by itself, so that its force does work.
    pub rheonomic: bool,
    /// What to hold to have each of these.
    pub needs: RowNeeds,
}

impl Row {
    /// Whether its Jacobian depends on parameters only.
    pub(crate) fn is_constant(&self) -> bool {
        !self.jacobian.iter().any(|(_, place)| place.varies())
    }
}

/// Needs of a row.
#[derive(Clone, Copy, Debug)]
pub struct RowNeeds {
    /// For the Jacobian (and the couplings of this row).
    pub jacobian: usize,
    /// For the acceleration bias γ.
    pub bias: usize,
    /// For the position residual or gap.
    pub position: usize,
    /// For the velocity residual or slip.
    pub velocity: usize,
}

/// A force proportional to a multiplier.
#[derive(Clone, Copy, Debug)]
pub struct Coupling {
    /// Coordinate that it acts on.
    pub coordinate: usize,
    /// Row whose multiplier scales it.
    pub row: usize,
    /// The factor.
    pub factor: ValueRef,
    /// Need of the force item that it belongs to.
    pub need: usize,
}

/// Law of impact.
#[derive(Clone, Copy, Debug)]
pub enum Restitution {
    /// v⁺ = −e v⁻.
    Newton(ValueRef),
    /// Impulse of restitution = e · impulse of compression.
    Poisson(ValueRef),
}

impl Restitution {
    /// Where e is found.
    pub(crate) fn place(self) -> ValueRef {
        let (Restitution::Newton(place) | Restitution::Poisson(place)) = self;
        place
    }
}

/// Source of a friction's normal force.
#[derive(Clone, Copy, Debug)]
pub enum Normal {
    /// λ · factor of this contact.
    Contact(usize),
    /// |λ| of this constraint.
    Constraint(usize),
    /// √Σλ² of the constraints of this [resultant](super::Description::resultants).
    Resultant(usize),
    /// An expression (`normal = …`; 1 for `limit = …`, whose limits are the coefficients).
    Given(ValueRef),
}

impl Normal {
    /// The constraints of a description whose forces press.
    pub(crate) fn constraints(self, d: &Description) -> impl Iterator<Item = usize> {
        let (one, together): (_, &[usize]) = match self {
            Normal::Constraint(i) => (Some(i), &[]),
            Normal::Resultant(i) => (None, d.resultants[i]),
            Normal::Contact(_) | Normal::Given(_) => (None, &[]),
        };
        one.into_iter().chain(together.iter().copied())
    }

    /// The rows of a description whose forces press.
    pub(crate) fn rows(self, d: &Description) -> impl Iterator<Item = usize> {
        let contact = match self {
            Normal::Contact(c) => Some(d.contacts[c].row),
            _ => None,
        };
        let constraints = self.constraints(d).map(|i| d.constraints[i].row);
        contact.into_iter().chain(constraints)
    }

    /// Whether it is the force of this contact.
    pub(crate) fn is_of(self, contact: usize) -> bool {
        matches!(self, Normal::Contact(c) if c == contact)
    }

    /// The contact that must be closed for it to press, if there is one: of constraints that hold while a contact is closed, that contact.
    pub(crate) fn contact(self, d: &Description) -> Option<usize> {
        match self {
            Normal::Contact(contact) => Some(contact),
            normal => (normal.constraints(d).next()).and_then(|i| d.constraints[i].while_contact),
        }
    }

    /// Whether something presses, given which contacts are closed.
    pub(crate) fn presses(self, d: &Description, closed: impl FnOnce(usize) -> bool) -> bool {
        self.contact(d).is_none_or(closed)
    }
}

/// A piecewise branch.
#[derive(Debug)]
pub struct Branch {
    /// `then` while ≥ 0. Motion if [`Self::after_solve`] is false, else report.
    pub guard: ValueRef,
    /// Need of the guard.
    pub need: usize,
    /// Whether the guard uses accelerations or forces, so only outputs of the report can use the branch.
    pub after_solve: bool,
    /// Needs of which any one makes the branch matter.
    pub users: &'static [usize],
    /// What holds on the `then` side, in the words of the user: `x >= 0`.
    pub then: &'static str,
    /// What holds on the other side, `x < 0`.
    pub otherwise: &'static str,
}

/// Energies; all in the report tape.
///
/// What a scene can leave out stands under its own need ([`Effect::need`](super::Effect::need)), here as in the motion tape, so that
/// these add up what acts: hold the needs of the active effects beside [`Energy::need`].
#[derive(Debug)]
pub struct Energy {
    /// T as declared.
    pub kinetic: ValueRef,
    /// V as declared.
    pub potential: ValueRef,
    /// v·∂L/∂v − L.
    pub jacobi: ValueRef,
    /// −∂L/∂t: the rate of the Jacobi integral that explicit time causes.
    pub time_power: ValueRef,
    /// Need of the unnamed energies' part of all of them.
    pub need: usize,
}

/// Generalized momenta; needs as for [`Energy`].
#[derive(Debug)]
pub struct Momenta {
    /// ∂L/∂v, one per coordinate. Report.
    pub places: &'static [ValueRef],
    /// Need of the unnamed energies' part of all of them.
    pub need: usize,
}

/// A condition on the mode.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Condition {
    /// This contact is closed.
    Closed(usize),
    /// This contact is open.
    Open(usize),
    /// This friction sticks.
    Sticks(usize),
    /// This friction slips.
    Slips(usize),
}
