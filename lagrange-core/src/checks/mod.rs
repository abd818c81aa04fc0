//! Formulas derived by hand, held against the derived equations: at build time by `check(…)` in the declaration, in a test
//! by [`Checks`] and [`assert_matches!`](crate::assert_matches).
//!
//! At build time both sides are compared exactly, at random points of two finite fields that lie on the constraints of each
//! mode, with forces and accelerations solved from the derived equations there: an error passes with a probability below
//! 2⁻¹²⁰. What cannot be decided so (values of `asin`, `ln` and the like that depend on each other, `abs` of what may have
//! either sign, constraints that cannot be solved for any symbol) is tried at 64 random states instead: a difference is an
//! error, none is reported as tested, not as proven. Fields are taken to be positive, so what is under a root must have one.
//!
//! ```
//! # use lagrange_core::prelude::*;
//! use lagrange_core::{assert_matches, checks::Checks};
//!
//! #[derive(Lagrangian, Clone)]
//! #[lagrange(
//!     coordinates(r, theta),
//!     define(x = r * sin(theta), y = r * cos(theta)),
//!     kinetic   = mass/2 * (der(x)^2 + der(y)^2),
//!     potential = mass * gravity * y,
//!     contact(shell: r >= radius),
//! )]
//! struct Shell { mass: f64, gravity: f64, radius: f64 }
//!
//! let scene = Shell { mass: 1.0, gravity: 9.81, radius: 2.0 };
//! let checks = Checks::new(&scene).closed(Shell::SHELL).vary_parameters(0.5);
//! assert_matches!(checks, |s, now| now.force(Shell::SHELL) =>
//!     s.mass * (s.gravity * now.q(Shell::THETA).cos() - s.radius * now.v(Shell::THETA).powi(2)));
//! ```

mod compare;
pub(crate) mod state;
#[cfg(test)]
mod tests;

pub use compare::{Comparison, Worst};
pub use state::Checks;

/// A `check(…)` of a declaration, and how far it is known to hold; what is known to be false does not compile.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Verdict {
    /// Name, or empty.
    pub name: &'static str,
    /// What is claimed and when, as written.
    pub claim: &'static str,
    /// How far that is known.
    pub outcome: Outcome,
}

/// How far a check is known to hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Outcome {
    /// It is an identity in every mode that it speaks of (but for a probability below 2⁻¹²⁰).
    Proven {
        /// Number of modes.
        modes: usize,
    },
    /// It could not be decided, and no difference was found at this many random states.
    Tested {
        /// Number of states.
        states: usize,
        /// Why it could not be decided.
        because: &'static str,
    },
}

/// Compares what is derived with a formula at the random states and times of [`Checks`], and panics with the worst state if they
/// differ: `assert_matches!(checks, |scene, now| derived => by_hand)`.
#[macro_export]
macro_rules! assert_matches {
    ($checks:expr, |$scene:pat_param, $now:pat_param| $derived:expr => $by_hand:expr $(,)?) => {
        match $checks.compare(|$scene, $now| ($derived, $by_hand)) {
            Ok(comparison) => assert!(
                comparison.holds(),
                "`{}` is not `{}`: {comparison}",
                stringify!($derived),
                stringify!($by_hand),
            ),
            Err(error) => panic!("{error}"),
        }
    };
}
