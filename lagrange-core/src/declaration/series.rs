//! Polynomials of degree two in time, c₀ + c₁τ + c₂τ², as numbers or intervals: a motion q + vτ + ½aτ² goes through an expression, and
//! with it its rate.

use super::real::Real;
use core::ops::{Add, Mul};

/// c₀, c₁, c₂.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Series<N = f64>(pub [N; 3]);

impl<N: Real> Series<N> {
    /// Does not move.
    #[inline]
    pub fn constant(c: N) -> Self {
        Self([c, N::default(), N::default()])
    }

    /// d/dτ; the coefficient that the rate would need and is not known is 0.
    #[inline]
    pub fn derivative(self) -> Self {
        let [_, x, y] = self.0;
        Self([x, y + y, N::default()])
    }

    /// f(self), and f'(self), from the derivatives f, f', f'', f''' at c₀.
    #[inline]
    pub fn of(self, [f, f1, f2, f3]: [N; 4]) -> (Self, Self) {
        let [_, x, y] = self.0;
        let square = N::number(0.5) * x * x;
        // A power that has come down to a number has infinite derivatives, and no changes.
        let times = N::times_change;
        let value = [f, times(f1, x), times(f1, y) + times(f2, square)];
        let slope = [f1, times(f2, x), times(f2, y) + times(f3, square)];
        (Self(value), Self(slope))
    }

    /// The angle of (x, y) = (`x`, `self`), and its derivatives by `self` and by `x`.
    pub fn atan2(self, x: Self) -> (Self, [Self; 2]) {
        let y = self;
        let square = x * x + y * y;
        let (inverse, _) = square.of(power(square.0[0], -1.0));
        let minus = Self::constant(N::number(-1.0));
        let (along, across) = (x * inverse, y * inverse * minus);
        let [rate, slope, _] = (along * y.derivative() + across * x.derivative()).0;
        let angle = y.0[0].atan2(x.0[0]);
        let half = N::number(0.5) * slope;
        (Self([angle, rate, half]), [along, across])
    }
}

impl<N: Real> Add for Series<N> {
    type Output = Self;

    #[inline]
    fn add(self, other: Self) -> Self {
        let ([a, b, c], [x, y, z]) = (self.0, other.0);
        Self([a + x, b + y, c + z])
    }
}

impl<N: Real> Mul for Series<N> {
    type Output = Self;

    #[inline]
    fn mul(self, other: Self) -> Self {
        let ([a, b, c], [x, y, z]) = (self.0, other.0);
        Self([a * x, a * y + b * x, a * z + b * y + c * x])
    }
}

/// Numbers of functions.
pub(super) const TAN: u32 = 2;
pub(super) const ASIN: u32 = 3;
pub(super) const ACOS: u32 = 4;
pub(super) const ATAN: u32 = 5;
pub(super) const SINH: u32 = 6;
pub(super) const COSH: u32 = 7;
pub(super) const TANH: u32 = 8;
pub(super) const EXP: u32 = 9;
pub(super) const LN: u32 = 10;

/// Function `number` of the format and its first three derivatives at x.
pub(super) fn function<N: Real>(number: u32, x: N) -> [N; 4] {
    let n = N::number;
    let minus = |x: N| n(-1.0) * x;
    let square = |x: N| x.raised(2.0);
    match number {
        0 => {
            let (s, c) = x.sin_cos();
            [s, c, minus(s), minus(c)]
        }
        1 => {
            let (s, c) = x.sin_cos();
            [c, minus(s), minus(c), s]
        }
        TAN => {
            let t = x.tan();
            let u = n(1.0) + square(t);
            let third = n(2.0) * u * (n(1.0) + n(3.0) * square(t));
            [t, u, n(2.0) * t * u, third]
        }
        ASIN | ACOS => {
            let w = (n(1.0) + minus(square(x))).raised(-0.5);
            let cube = w.raised(3.0);
            let third = cube + n(3.0) * square(x) * w.raised(5.0);
            match number {
                ASIN => [x.asin(), w, x * cube, third],
                _ => [x.acos(), minus(w), minus(x * cube), minus(third)],
            }
        }
        5 => {
            let u = (n(1.0) + square(x)).raised(-1.0);
            let third = (n(6.0) * square(x) + n(-2.0)) * u.raised(3.0);
            [x.atan(), u, n(-2.0) * x * square(u), third]
        }
        SINH => [x.sinh(), x.cosh(), x.sinh(), x.cosh()],
        COSH => [x.cosh(), x.sinh(), x.cosh(), x.sinh()],
        TANH => {
            let t = x.tanh();
            let u = n(1.0) + minus(square(t));
            let third = u * (n(6.0) * square(t) + n(-2.0));
            [t, u, n(-2.0) * t * u, third]
        }
        EXP => [x.exp(); 4],
        LN => {
            let third = n(2.0) * x.raised(-3.0);
            [x.ln(), x.raised(-1.0), minus(x.raised(-2.0)), third]
        }
        _ => [N::ANYTHING; 4],
    }
}

/// xᵖ and its first three derivatives.
pub(super) fn power<N: Real>(x: N, p: f64) -> [N; 4] {
    let (powers, mut factor) = (x.powers(p), 1.0);
    core::array::from_fn(|k| {
        if k > 0 {
            factor *= p - k as f64 + 1.0;
        }
        // The fourth derivative of a cube is 0, also at 0.
        if factor == 0.0 {
            N::default()
        } else {
            N::number(factor) * powers[k]
        }
    })
}
