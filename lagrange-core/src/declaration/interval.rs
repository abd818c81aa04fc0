//! Intervals: what an expression can be while its variables stay within theirs (Moore 1966, Interval Analysis).
//!
//! Ends are rounded to the nearest number, not outwards: what is concluded from them is held against a tolerance.

use super::real::Real;
use core::f64::consts::{FRAC_PI_2, PI, TAU};
use core::ops::{Add, Mul};

/// Everything between `low` and `high`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Interval {
    /// The smallest number of it.
    pub low: f64,
    /// The largest number of it.
    pub high: f64,
}

impl Interval {
    /// Everything between two numbers; where one of them is not a number, anything.
    pub fn new(low: f64, high: f64) -> Self {
        if low.is_nan() || high.is_nan() {
            return Self::ANYTHING;
        }
        Self { low, high }
    }

    /// What is in both; `self` where rounding leaves nothing.
    #[must_use]
    pub fn within(self, other: Self) -> Self {
        let (low, high) = (self.low.max(other.low), self.high.min(other.high));
        if low <= high {
            Self { low, high }
        } else {
            self
        }
    }

    /// The smaller of two.
    #[must_use]
    pub fn min(self, other: Self) -> Self {
        Self::new(self.low.min(other.low), self.high.min(other.high))
    }

    /// The larger of two.
    #[must_use]
    pub fn max(self, other: Self) -> Self {
        Self::new(self.low.max(other.low), self.high.max(other.high))
    }

    /// Both, and what lies between them.
    #[must_use]
    pub fn hull(self, other: Self) -> Self {
        Self::new(self.low.min(other.low), self.high.max(other.high))
    }

    /// Whether it is 0 and nothing else.
    fn is_zero(self) -> bool {
        self.low == 0.0 && self.high == 0.0
    }

    /// Whether x is in it.
    pub fn contains(self, x: f64) -> bool {
        self.low <= x && x <= self.high
    }

    /// What a function that does not fall makes of it.
    fn rising(self, f: impl Fn(f64) -> f64) -> Self {
        Self::new(f(self.low), f(self.high))
    }

    /// What a function makes of it that falls below 0 and rises above, and is the same on both sides.
    fn even(self, f: impl Fn(f64) -> f64) -> Self {
        let (a, b) = (f(self.low), f(self.high));
        let least = if self.contains(0.0) { f(0.0) } else { a.min(b) };
        Self::new(least, a.max(b))
    }

    /// Whether `at + kτ` is in it for some whole k.
    fn passes(self, at: f64) -> bool {
        ((self.low - at) / TAU).ceil() <= ((self.high - at) / TAU).floor()
    }

    fn cos(self) -> Self {
        let (a, b) = (self.low.cos(), self.high.cos());
        let low = if self.passes(PI) { -1.0 } else { a.min(b) };
        let high = if self.passes(0.0) { 1.0 } else { a.max(b) };
        Self::new(low, high)
    }
}

impl Add for Interval {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self::new(self.low + other.low, self.high + other.high)
    }
}

impl Mul for Interval {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        if self.is_zero() || other.is_zero() {
            return Self::default();
        }
        let (a, b) = (self.low * other.low, self.low * other.high);
        let (c, d) = (self.high * other.low, self.high * other.high);
        if (a + b + c + d).is_nan() {
            return Self::ANYTHING;
        }
        Self {
            low: a.min(b).min(c.min(d)),
            high: a.max(b).max(c.max(d)),
        }
    }
}

impl Real for Interval {
    const ANYTHING: Self = Self {
        low: f64::NEG_INFINITY,
        high: f64::INFINITY,
    };

    fn number(x: f64) -> Self {
        Self::new(x, x)
    }

    fn choose(self, first: [Self; 3], second: [Self; 3]) -> [Self; 3] {
        match self {
            _ if self.low >= 0.0 => first,
            _ if self.high < 0.0 => second,
            // What is chosen in between jumps, or its rate does.
            _ => {
                let value = first[0].hull(second[0]);
                [value, Self::ANYTHING, Self::ANYTHING]
            }
        }
    }

    fn times_change(self, change: Self) -> Self {
        self * change
    }

    fn raised(self, p: f64) -> Self {
        let power = |x: f64| x.raised(p);
        match p {
            0.0 => Self::number(1.0),
            _ if p < 0.0 && self.contains(0.0) => match p % 2.0 {
                // 1/x² is at least what it is farthest from 0.
                0.0 => Self::new(power(self.low).min(power(self.high)), f64::INFINITY),
                _ => Self::ANYTHING,
            },
            _ if p < 0.0 => {
                let (a, b) = (power(self.low), power(self.high));
                Self::new(a.min(b), a.max(b))
            }
            _ if p % 2.0 == 0.0 => self.even(power),
            _ if p % 1.0 == 0.0 => self.rising(power),
            // A root of what rounding has made negative.
            _ => Self::new(power(self.low.max(0.0)), power(self.high)),
        }
    }

    fn atan2(self, x: Self) -> Self {
        let y = self;
        if x.low <= 0.0 && y.contains(0.0) {
            return Self::new(-PI, PI);
        }
        let corners = [
            (y.low, x.low),
            (y.low, x.high),
            (y.high, x.low),
            (y.high, x.high),
        ];
        let corners = corners.map(|(y, x)| Self::number(f64::atan2(y, x)));
        corners[1..]
            .iter()
            .fold(corners[0], |all, one| all.hull(*one))
    }

    fn sin_cos(self) -> (Self, Self) {
        ((self + Self::number(-FRAC_PI_2)).cos(), self.cos())
    }

    fn tan(self) -> Self {
        let poles = |x: f64| ((x - FRAC_PI_2) / PI).floor();
        if poles(self.low) == poles(self.high) {
            self.rising(f64::tan)
        } else {
            Self::ANYTHING
        }
    }

    fn asin(self) -> Self {
        self.rising(f64::asin)
    }

    fn acos(self) -> Self {
        Self::new(self.high.acos(), self.low.acos())
    }

    fn atan(self) -> Self {
        self.rising(f64::atan)
    }

    fn sinh(self) -> Self {
        self.rising(f64::sinh)
    }

    fn cosh(self) -> Self {
        self.even(f64::cosh)
    }

    fn tanh(self) -> Self {
        self.rising(f64::tanh)
    }

    fn exp(self) -> Self {
        self.rising(f64::exp)
    }

    fn ln(self) -> Self {
        self.rising(f64::ln)
    }
}
