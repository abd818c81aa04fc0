//! Straight-line programs as data, run by one interpreter.
//!
//! The derive writes what a system is made of, masses, forces, rows, outputs, as [`Encoded`] programs: its constants, what comes before
//! the solution for the accelerations, and what comes after. For a mode they are loaded: blocks that nobody asks for are skipped, branches
//! are decided, and what is left is a list of instructions on registers. It runs for values over any [`Scalar`](crate::arithmetic::Scalar),
//! dual numbers included, and for Taylor coefficients.

mod builder;
mod encoded;
mod evaluate;
mod instruction;
mod roots;
mod selection;
mod series;
#[cfg(test)]
mod tests;

pub(crate) use builder::{Builder, Numbers};
pub use encoded::Encoded;
pub(crate) use instruction::{Op, Program, Register, room};
pub(crate) use selection::Needs;
pub use selection::{Selection, ValueRef};
pub(crate) use series::Series;
pub use series::{MAX_ORDER, Operation};
