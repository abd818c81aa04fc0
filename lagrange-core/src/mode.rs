//! The mode of a system: which contacts are closed, how each friction acts, on which side each branch is.
//!
//! Within one mode the equations of motion are smooth; the guards say where it ends.

use crate::handle::{ContactId, FrictionId, named};
use crate::system::{Condition, Description};
use core::fmt;

/// How a friction acts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FrictionMode {
    /// Its contact is open (or it is left out): no force.
    Inactive,
    /// Slip is zero; the force is whatever keeps it so.
    Stick,
    /// The force is μk N against the slip.
    Slip(Sliding),
}

impl FrictionMode {
    /// Whether the slip is zero.
    pub(crate) fn rests(&self) -> bool {
        matches!(
            self,
            Self::Stick
                | Self::Slip(Sliding {
                    direction: Direction::Incipient(_),
                    ..
                })
        )
    }
}

/// State of a sliding friction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sliding {
    /// Direction of the slip.
    pub direction: Direction,
    /// Sign (+1 or −1) of the multiplier that presses, for friction on a constraint (N = |λ|); +1 on a contact.
    pub normal_sign: f64,
}

/// Direction of a slip; the friction force points the other way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Direction {
    /// This unit vector: (±1, 0) for one component.
    Fixed([f64; 2]),
    /// The direction of the slip velocity itself, which turns (two components, slip not zero).
    AlongSlip,
    /// The slip is zero and begins along this unit vector, from which it turns (two components).
    Incipient([f64; 2]),
}

impl Direction {
    /// That of a slip under way with these components.
    pub(crate) fn of_slip(mut components: impl Iterator<Item = f64>) -> Self {
        match (components.next(), components.next()) {
            (Some(rate), None) => Self::Fixed([rate.signum(), 0.0]),
            _ => Self::AlongSlip,
        }
    }
}

impl Sliding {
    /// Slip with two components along itself, on a contact.
    pub fn along_slip() -> Self {
        Self {
            direction: Direction::AlongSlip,
            normal_sign: 1.0,
        }
    }

    /// Slip with one component, of this sign, on a contact.
    pub fn sign(sign: f64) -> Self {
        Self {
            direction: Direction::Fixed([sign, 0.0]),
            normal_sign: 1.0,
        }
    }
}

/// The mode of a system. Lengths are those of the description's lists.
#[derive(Debug)]
pub struct Mode {
    /// Which contacts are closed.
    pub contacts: Vec<bool>,
    /// How each friction acts.
    pub frictions: Vec<FrictionMode>,
    /// Bit `i`: branch `i` is on its `then` side.
    pub branches: Vec<u64>,
}

impl PartialEq for Mode {
    // A few elements are compared sooner than a call of `memcmp` is made.
    fn eq(&self, other: &Self) -> bool {
        self.contacts.iter().eq(&other.contacts)
            && self.branches.iter().eq(&other.branches)
            && self.frictions == other.frictions
    }
}

impl Clone for Mode {
    fn clone(&self) -> Self {
        Self {
            contacts: self.contacts.clone(),
            frictions: self.frictions.clone(),
            branches: self.branches.clone(),
        }
    }

    // A run changes its mode without allocating.
    fn clone_from(&mut self, source: &Self) {
        self.contacts.clone_from(&source.contacts);
        self.frictions.clone_from(&source.frictions);
        self.branches.clone_from(&source.branches);
    }
}

impl Mode {
    /// All contacts open, no friction acting, all branches on their other side.
    pub fn open(description: &Description) -> Self {
        Self {
            contacts: vec![false; description.contacts.len()],
            frictions: vec![FrictionMode::Inactive; description.frictions.len()],
            branches: vec![0; description.branches.len().div_ceil(64)],
        }
    }

    /// Back to [`Self::open`].
    pub(crate) fn clear(&mut self) {
        self.contacts.fill(false);
        self.frictions.fill(FrictionMode::Inactive);
        self.branches.fill(0);
    }

    /// Whether a contact is closed.
    #[track_caller]
    pub fn closed(&self, contact: ContactId) -> bool {
        *named(&self.contacts, contact.0, "contact")
    }

    /// Whether a friction sticks.
    #[track_caller]
    pub fn sticks(&self, friction: FrictionId) -> bool {
        *named(&self.frictions, friction.0, "friction") == FrictionMode::Stick
    }

    /// Opens all contacts, and ends all frictions; whether any contact was closed.
    pub(crate) fn release_contacts(&mut self) -> bool {
        let closed = self.contacts.contains(&true);
        self.contacts.fill(false);
        self.frictions.fill(FrictionMode::Inactive);
        closed
    }

    /// Whether a friction slips.
    #[track_caller]
    pub fn slips(&self, friction: FrictionId) -> bool {
        matches!(
            named(&self.frictions, friction.0, "friction"),
            FrictionMode::Slip(_)
        )
    }

    /// Whether branch `index` is on its `then` side.
    pub fn branch(&self, index: usize) -> bool {
        self.branches[index / 64] >> (index % 64) & 1 == 1
    }

    /// Puts branch `index` on its `then` side, or on the other.
    pub fn set_branch(&mut self, index: usize, then: bool) {
        let bit = 1 << (index % 64);
        if then {
            self.branches[index / 64] |= bit;
        } else {
            self.branches[index / 64] &= !bit;
        }
    }

    /// Whether the conditions of a stop or a mark hold in this mode.
    pub(crate) fn satisfies(&self, conditions: &[Condition]) -> bool {
        conditions.iter().all(|condition| match *condition {
            Condition::Closed(c) => self.contacts[c],
            Condition::Open(c) => !self.contacts[c],
            Condition::Sticks(f) => self.frictions[f] == FrictionMode::Stick,
            Condition::Slips(f) => matches!(self.frictions[f], FrictionMode::Slip(_)),
        })
    }

    /// Whether the same equations hold in both: they are one but for the directions in which slips begin.
    pub(crate) fn has_equations_of(&self, other: &Self) -> bool {
        let same = |(x, y): (&FrictionMode, &FrictionMode)| match (x, y) {
            (FrictionMode::Slip(x), FrictionMode::Slip(y)) => {
                let begin = |s: &Sliding| matches!(s.direction, Direction::Incipient(_));
                (x.direction == y.direction || begin(x) && begin(y))
                    && x.normal_sign == y.normal_sign
            }
            _ => x == y,
        };
        // As for equality.
        self.contacts.iter().eq(&other.contacts)
            && self.branches.iter().eq(&other.branches)
            && self.frictions.len() == other.frictions.len()
            && self.frictions.iter().zip(&other.frictions).all(same)
    }

    /// Lets go of what sticks; whether anything did.
    pub(crate) fn release_sticking(&mut self) -> bool {
        let sticking = self.frictions.iter_mut();
        let sticking = sticking.filter(|friction| **friction == FrictionMode::Stick);
        sticking
            .map(|friction| *friction = FrictionMode::Inactive)
            .count()
            > 0
    }

    /// Whether a friction slips.
    pub(crate) fn has_slips(&self) -> bool {
        let mut frictions = self.frictions.iter();
        frictions.any(|friction| matches!(friction, FrictionMode::Slip(_)))
    }

    /// Whether a slip of two components begins in it.
    pub(crate) fn has_incipient_slip(&self) -> bool {
        self.incipient().next().is_some()
    }

    /// Whether a slip of two components goes along itself in it, or begins to.
    pub(crate) fn has_turning_slip(&self) -> bool {
        let mut frictions = self.frictions.iter();
        frictions.any(|friction| {
            matches!(
                friction,
                FrictionMode::Slip(Sliding {
                    direction: Direction::AlongSlip | Direction::Incipient(_),
                    ..
                })
            )
        })
    }

    /// The mode in which the motion goes on once the slips that begin in this one have begun.
    #[must_use]
    pub fn under_way(&self) -> Self {
        let mut mode = self.clone();
        for f in 0..mode.frictions.len() {
            if matches!(mode.frictions[f], FrictionMode::Slip(s) if matches!(s.direction, Direction::Incipient(_)))
            {
                mode.turn(f, Direction::AlongSlip);
            }
        }
        mode
    }

    /// The frictions whose slip of two components begins, with its direction.
    pub(crate) fn incipient(&self) -> impl Iterator<Item = (usize, [f64; 2])> + '_ {
        let frictions = self.frictions.iter().enumerate();
        frictions.filter_map(|(f, state)| match state {
            FrictionMode::Slip(Sliding {
                direction: Direction::Incipient(along),
                ..
            }) => Some((f, *along)),
            _ => None,
        })
    }

    /// The frictions whose slip has two components and is under way.
    pub(crate) fn in_space(&self) -> impl Iterator<Item = (usize, Sliding)> + '_ {
        let frictions = self.frictions.iter().enumerate();
        frictions.filter_map(|(f, state)| match state {
            FrictionMode::Slip(sliding) if sliding.direction == Direction::AlongSlip => {
                Some((f, *sliding))
            }
            _ => None,
        })
    }

    /// Gives friction `f`, which slips, another direction.
    pub(crate) fn turn(&mut self, f: usize, to: Direction) {
        if let FrictionMode::Slip(sliding) = &mut self.frictions[f] {
            sliding.direction = to;
        }
    }

    /// What holds on the side of each branch that the motion depends on, `x >= 0`, not outputs, stops and marks alone.
    pub fn sides<'a>(
        &'a self,
        description: &'a Description,
    ) -> impl Iterator<Item = &'static str> + 'a {
        let branches = 0..description.branches.len();
        let moving = branches.filter(|&index| description.branch_moves(index));
        moving.map(|index| self.side(description, index))
    }

    /// What holds on the side of branch `index`, `x >= 0`.
    pub(crate) fn side(&self, description: &Description, index: usize) -> &'static str {
        let branch = &description.branches[index];
        match self.branch(index) {
            true => branch.then,
            false => branch.otherwise,
        }
    }

    /// The mode in words: `rim closed, grip sticks`.
    pub fn display<'a>(&'a self, description: &'a Description) -> impl fmt::Display + 'a {
        Named {
            mode: self,
            description,
        }
    }
}

struct Named<'a> {
    mode: &'a Mode,
    description: &'a Description,
}

impl fmt::Display for Named<'_> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let mut separator = "";
        for (contact, closed) in self.description.contacts.iter().zip(&self.mode.contacts) {
            write!(
                f,
                "{separator}{} {}",
                contact.name,
                if *closed { "closed" } else { "open" }
            )?;
            separator = ", ";
        }
        for (friction, state) in self.description.frictions.iter().zip(&self.mode.frictions) {
            let verb = match state {
                FrictionMode::Inactive => continue,
                FrictionMode::Stick => "sticks",
                FrictionMode::Slip(sliding) => match sliding.direction {
                    Direction::Fixed([s, 0.0]) if s > 0.0 => "slips forward",
                    Direction::Fixed([s, 0.0]) if s < 0.0 => "slips backward",
                    _ => "slips",
                },
            };
            write!(f, "{separator}{} {verb}", friction.name)?;
            separator = ", ";
        }
        for side in self.mode.sides(self.description) {
            write!(f, "{separator}{side}")?;
            separator = ", ";
        }
        if separator.is_empty() {
            write!(f, "smooth")
        } else {
            Ok(())
        }
    }
}
