//! Explicit Runge–Kutta pairs as data.
//!
//! ```text
//! yᵢ = y₀ + h Σⱼ aᵢⱼ kⱼ,   kᵢ = f(t₀ + cᵢ h, yᵢ),   y₁ = y₀ + h Σᵢ bᵢ kᵢ
//! ```
//!
//! Dense output is y(t₀ + s h) = y₀ + Σₘ Bₘ C(D,m) sᵐ (1 − s)^(D−m) with Bₘ = h Σᵢ wₘᵢ kᵢ. The literature prints the weights
//! bᵢ(s) by powers of s; those coefficients reach 10⁴ and cancel, which costs four digits. In the Bernstein basis they
//! are of order 1, and power coefficients come from differences of neighbouring Bₘ, which lose nothing.

use super::control::Control;

/// Non-zero weights of stages: (stage, weight).
pub(super) type Weights = &'static [(usize, f64)];

/// A Runge–Kutta pair with dense output.
#[derive(Debug)]
pub(super) struct Tableau {
    /// Order of y₁, for tests and reports.
    pub order: usize,
    /// cᵢ of every stage: those of the step, then the one at (t₁, y₁), then those of the dense output.
    pub nodes: &'static [f64],
    /// aᵢⱼ; row 0 is empty and the row of the stage at (t₁, y₁) is b.
    pub stages: &'static [Weights],
    /// The stage at (t₁, y₁), first stage of the next step.
    pub end: usize,
    /// Error estimates, ẽ = h Σ eᵢ kᵢ.
    pub estimate: Estimate,
    /// Weights wₘᵢ of B₁ … B_{D−1} (B₀ = 0, B_D = y₁ − y₀).
    pub dense: &'static [Weights],
    /// Step control as the authors of the pair recommend it.
    pub control: Control,
}

/// How the error of a step is estimated.
#[derive(Debug)]
pub(super) enum Estimate {
    /// Difference to an embedded method.
    Embedded(Weights),
    /// Differences to methods of order 5 and 3: e₅²/√(e₅² + 0.01 e₃²) (Hairer, Nørsett & Wanner 1993, section II.10).
    Combined {
        /// e₅
        fifth: Weights,
        /// e₃
        third: Weights,
    },
    /// The step is not judged.
    None,
}

impl Estimate {
    /// Whether an estimate reads this stage.
    pub fn reads(&self, stage: usize) -> bool {
        let uses = |weights: Weights| weights.iter().any(|&(i, _)| i == stage);
        match *self {
            Self::Embedded(weights) => uses(weights),
            Self::Combined { fifth, third } => uses(fifth) || uses(third),
            Self::None => false,
        }
    }
}
