//! What a declaration can be evaluated with: a number, or an interval of numbers.

use core::ops::{Add, Mul};

/// A number, or everything between two numbers.
pub trait Real: Copy + Default + Add<Output = Self> + Mul<Output = Self> {
    /// Nothing is known of it.
    const ANYTHING: Self;

    /// This number.
    fn number(x: f64) -> Self;

    /// Whether it is ≥ 0; `None` where a part of it is.
    fn is_positive(self) -> Option<bool>;

    /// Whether it is 0 and nothing else.
    fn is_zero(self) -> bool;

    /// Both, and what lies between them.
    fn hull(self, other: Self) -> Self;

    /// xᵖ
    fn raised(self, p: f64) -> Self;

    /// The angle of (x, `self`).
    fn atan2(self, x: Self) -> Self;

    /// Sine and cosine.
    fn sin_cos(self) -> (Self, Self);

    /// Tangent.
    fn tan(self) -> Self;

    /// Inverse sine.
    fn asin(self) -> Self;

    /// Inverse cosine.
    fn acos(self) -> Self;

    /// Inverse tangent.
    fn atan(self) -> Self;

    /// Hyperbolic sine.
    fn sinh(self) -> Self;

    /// Hyperbolic cosine.
    fn cosh(self) -> Self;

    /// Hyperbolic tangent.
    fn tanh(self) -> Self;

    /// eˣ
    fn exp(self) -> Self;

    /// Natural logarithm.
    fn ln(self) -> Self;
}

impl Real for f64 {
    const ANYTHING: Self = f64::NAN;

    fn number(x: f64) -> Self {
        x
    }

    fn is_positive(self) -> Option<bool> {
        Some(self >= 0.0)
    }

    fn is_zero(self) -> bool {
        self == 0.0
    }

    fn hull(self, _: Self) -> Self {
        self
    }

    fn raised(self, p: f64) -> Self {
        if p == p.trunc() && p.abs() < 1e9 {
            self.powi(p as i32)
        } else {
            self.powf(p)
        }
    }

    fn atan2(self, x: Self) -> Self {
        f64::atan2(self, x)
    }

    fn sin_cos(self) -> (Self, Self) {
        f64::sin_cos(self)
    }

    fn tan(self) -> Self {
        f64::tan(self)
    }

    fn asin(self) -> Self {
        f64::asin(self)
    }

    fn acos(self) -> Self {
        f64::acos(self)
    }

    fn atan(self) -> Self {
        f64::atan(self)
    }

    fn sinh(self) -> Self {
        f64::sinh(self)
    }

    fn cosh(self) -> Self {
        f64::cosh(self)
    }

    fn tanh(self) -> Self {
        f64::tanh(self)
    }

    fn exp(self) -> Self {
        f64::exp(self)
    }

    fn ln(self) -> Self {
        f64::ln(self)
    }
}
