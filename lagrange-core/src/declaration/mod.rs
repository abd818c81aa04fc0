//! What was declared, as data: the quantities as they were written, with `der` as an operation. Nothing is derived in it.
//!
//! [`Evaluator`] gives their values, rates and gradients; certificates check a finished run with it.
//!
//! # Format
//! An operation is three little-endian words of four bytes, (operation | guard·256, x, y). Every operation defines the next
//! value, and operands are values before it.

mod at_state;
mod draw;
mod evaluate;
mod interval;
mod operations;
mod real;
mod series;
#[cfg(test)]
mod tests;

pub(crate) use at_state::AtState;
pub use draw::{Draw, Form, Turn};
pub use evaluate::{Evaluator, Gradient, Inputs, Seed, Sum};
pub use interval::Interval;
pub(crate) use operations::Operations;
pub use real::Real;
pub use series::Series;

/// The declared quantities. Numbers are those of values; lists are in the order of the description's.
#[derive(Clone, Copy, Debug)]
pub struct Declaration {
    /// The operations.
    pub words: &'static [u8],
    /// Exact numbers.
    pub numbers: &'static [f64],
    /// Kinetic energies; of a `lagrangian` the whole of it.
    pub kinetic: &'static [usize],
    /// Potential energies.
    pub potential: &'static [usize],
    /// Left − right of constraints.
    pub constraints: &'static [usize],
    /// Contacts.
    pub contacts: &'static [Contact],
    /// Frictions.
    pub frictions: &'static [Friction],
    /// Applied forces.
    pub forces: &'static [Force],
    /// Rayleigh's functions.
    pub dissipations: &'static [usize],
    /// Terms of stops; `None` where they need more than values (generalized momenta, the energy of a Lagrangian).
    pub stops: &'static [Option<&'static [usize]>],
    /// Terms of marks.
    pub marks: &'static [Option<&'static [usize]>],
    /// What a picture shows, from the back to the front.
    pub draws: &'static [Draw],
}

/// A contact.
#[derive(Clone, Copy, Debug)]
pub struct Contact {
    /// Its gap.
    pub gap: usize,
    /// |∂gap/∂p| where `at p` is declared.
    pub normal_factor: Option<usize>,
    /// e
    pub restitution: usize,
    /// ≥ 0 where it exists.
    pub region: Option<usize>,
}

/// A friction.
#[derive(Clone, Copy, Debug)]
pub struct Friction {
    /// Slip components.
    pub slip: &'static [usize],
    /// The normal force, where it is given.
    pub normal: Option<usize>,
    /// μs
    pub static_coefficient: usize,
    /// μk
    pub kinetic_coefficient: usize,
}

/// An applied force.
#[derive(Clone, Copy, Debug)]
pub struct Force {
    /// What is reported.
    pub value: usize,
    /// Each component and what it does work on.
    pub components: &'static [(usize, Worked)],
}

/// What a component of a force does work on.
#[derive(Clone, Copy, Debug)]
pub enum Worked {
    /// This coordinate.
    Coordinate(usize),
    /// A component of a point, by its value: Q = f ∂p/∂q.
    Point(usize),
    /// A velocity, by its value: Q = f ∂s/∂v.
    Speed(usize),
}

impl Declaration {
    /// The declaration of a struct whose attribute has mistakes: nothing is declared.
    pub const NONE: Self = Self {
        words: &[],
        numbers: &[],
        kinetic: &[],
        potential: &[],
        constraints: &[],
        contacts: &[],
        frictions: &[],
        forces: &[],
        dissipations: &[],
        stops: &[],
        marks: &[],
        draws: &[],
    };

    /// How many values the operations define.
    fn len(&self) -> usize {
        self.words.len() / BYTES
    }
}

/// Length of an operation, bytes.
const BYTES: usize = 12;

/// Number of each operation; those of the macro are the same.
mod op {
    pub const NUMBER: u32 = 0;
    pub const PARAMETER: u32 = 1;
    pub const TIME: u32 = 2;
    pub const POSITION: u32 = 3;
    pub const FORCE: u32 = 4;
    pub const LOAD: u32 = 5;
    pub const ADD: u32 = 6;
    pub const MULTIPLY: u32 = 7;
    pub const POWER: u32 = 8;
    pub const DERIVATIVE: u32 = 9;
    pub const SELECT: u32 = 10;
    pub const ATAN2: u32 = 11;
    pub const FUNCTIONS: u32 = 12;
}
