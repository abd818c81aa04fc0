//! The constrained system of one mode and its solution.
//!
//! With the rows that act, ordered 0…m−1, the unknowns are x = (v̇, −λ) and
//!
//! ```text
//! ⎡ M  C ⎤ ⎡  v̇ ⎤   ⎡  f ⎤
//! ⎣ A  0 ⎦ ⎣ −λ ⎦ = ⎣ −γ ⎦
//! ```
//!
//! where column i of C is the generalized force of λᵢ: aᵢᵀ, what couplings add, and sliding friction −μk ν Σ d aₜᵀ.
//! C = Aᵀ where nothing slides.

use crate::arithmetic::Scalar;

mod collect;
mod consistent;
mod direct;
mod eliminate;
mod least_norm;
mod lemke;
mod lu;
mod plan;
mod program;
mod solver;
#[cfg(test)]
mod tests;

/// The distance from 1 to the next number of a type.
#[inline(always)]
pub(crate) fn epsilon<T: Scalar>() -> f64 {
    let double = T::from_f64(1.0 + f64::EPSILON).value() > 1.0;
    if double {
        f64::EPSILON
    } else {
        f64::from(f32::EPSILON)
    }
}

pub(crate) use collect::acts;
pub(crate) use consistent::{Equilibrated, SeveralSides};
pub(crate) use direct::positive_definite;
pub(crate) use least_norm::{Freedom, least_norm};
pub(crate) use lemke::{Lemke, Outcome as LemkeOutcome};
pub(crate) use plan::Plan;
pub(crate) use solver::{Inertia, SolveError, Solver};
