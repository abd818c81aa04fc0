//! Families of systems whose numbers and starts are random: what fuzzing runs, and the tests of random systems.

#![allow(
    missing_docs,
    reason = "fields are explained by the declarations that use them"
)]

pub mod contacts;
pub mod linkages;
pub mod moving;
pub mod space;
pub mod supports;

use crate::Random;
use core::fmt::Debug;
use lagrange_core::prelude::*;

/// A system with numbers and a start to draw.
pub trait Family: Derived<Scalar = f64> + Debug {
    /// Its name.
    const NAME: &'static str;

    /// Numbers, and a state from which a run may begin; what violates a constraint is to be projected.
    fn draw(random: &mut Random) -> (Self, State<f64>);
}

/// Masses, kg.
fn masses<const N: usize>(random: &mut Random) -> [f64; N] {
    core::array::from_fn(|_| random.between(0.2, 2.0))
}

/// Numbers up to `size` of either sign.
fn signed(random: &mut Random, count: usize, size: f64) -> Vec<f64> {
    (0..count).map(|_| random.between(-size, size)).collect()
}

/// 0 once in three times, else up to `most`.
fn perhaps(random: &mut Random, most: f64) -> f64 {
    random.between(-0.5 * most, most).max(0.0)
}
