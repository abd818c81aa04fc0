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

mod assembly;
mod bounded;
mod conic;
mod consistent;
mod direct;
pub(crate) mod direction;
mod eliminate;
mod least_norm;
mod lemke;
mod lu;
mod pattern;
mod program;
mod sliding;
mod small;
mod solver;
#[cfg(test)]
mod tests;

pub(crate) use assembly::{acting, acts};
pub(crate) use bounded::{ForceBounds, Linear};
pub(crate) use conic::{Cone, ConicPoint};
pub(crate) use consistent::Equilibrated;
pub(crate) use least_norm::{Freedom, Rank, least_norm};
pub(crate) use lemke::{Lemke, Outcome as LemkeOutcome};
pub(crate) use lu::dot;
pub(crate) use pattern::KktPattern;
pub(crate) use small::{VanishingCombinations, solve_small};
pub(crate) use solver::{Inertia, Shares, SolveError, Solver, UnitQuaternion};
