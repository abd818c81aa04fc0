//! Guards as polynomials over a step, and the instants at which they vanish.
//!
//! A stepper gives every armed guard as a polynomial in s ∈ [0, 1], t = t₀ + h s, with coefficients already
//! multiplied by hᵏ. Most keep their sign: [`keeps_its_sign`] knows it from a bound. [`roots`] isolates all zeros in (0, 1],
//! [`find_root`] the first that matters.
//!
//! What is not decided here: a guard that *starts* at zero or below it. A root at s = 0 belongs to the step
//! before, so the caller [`deflate`]s guards known to be zero there, and treats one that starts negative as an event at s = 0.

mod bernstein;
mod bracket;
mod isolate;
mod refine;
mod root_filter;
#[cfg(test)]
mod tests;

pub use bernstein::MAX_DEGREE;
pub use bracket::{bracket, zero_between};
pub use isolate::{clearance, deflate, dip, find_root, find_root_until, roots, turns};
pub use root_filter::keeps_its_sign;

/// Which way a guard passes zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// From negative (before) towards positive.
    Rising,
    /// From positive (before) towards negative.
    Falling,
}

/// A zero of a polynomial over a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Root {
    /// Where, in (0, 1].
    pub s: f64,
    /// Sign change; for a grazing root the side from which zero is approached.
    pub direction: Direction,
    /// Zero is touched without a change of sign, as far as rounding can tell.
    pub grazing: bool,
    /// Width of the interval around `s` in which rounding lets the zero be.
    pub width: f64,
}

/// The zeros of one polynomial in ascending order, stored in place.
#[derive(Clone, Debug)]
pub struct RootList {
    items: [Root; MAX_DEGREE + 1],
    len: usize,
}

impl RootList {
    /// No roots.
    pub const fn new() -> Self {
        const NONE: Root = Root {
            s: 0.0,
            direction: Direction::Falling,
            grazing: false,
            width: 0.0,
        };
        Self {
            items: [NONE; MAX_DEGREE + 1],
            len: 0,
        }
    }

    /// Forgets all roots.
    pub fn clear(&mut self) {
        self.len = 0;
    }

    /// A polynomial of degree d has at most d roots and one more that rounding sees at s = 1.
    fn push(&mut self, root: Root) {
        self.items[self.len] = root;
        self.len += 1;
    }
}

impl Default for RootList {
    fn default() -> Self {
        Self::new()
    }
}

impl core::ops::Deref for RootList {
    type Target = [Root];

    fn deref(&self) -> &[Root] {
        &self.items[..self.len]
    }
}
