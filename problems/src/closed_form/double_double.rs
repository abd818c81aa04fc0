//! Numbers of about 32 digits as unevaluated sums of two doubles (Dekker 1971; Hida, Li & Bailey 2001).

use core::f64::consts::PI;
use core::ops::{Add, Div, Mul, Sub};

/// `high + low`, with `low` at most half a unit in the last place of `high`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct DoubleDouble {
    high: f64,
    low: f64,
}

impl DoubleDouble {
    /// 2π.
    pub(super) const TURN: Self = Self {
        high: 2.0 * PI,
        low: 2.449_293_598_294_706_4e-16,
    };

    /// The nearest double.
    pub(super) fn value(self) -> f64 {
        self.high
    }

    /// The root; 0 for what is not positive.
    pub(super) fn sqrt(self) -> Self {
        if self.high <= 0.0 {
            return 0.0.into();
        }
        // One step of Newton's method doubles the digits of the root in double precision.
        let root = Self::from(self.high.sqrt());
        (root + self / root) * 0.5.into()
    }

    /// What is left of it, at most half a `period` in size, after whole periods are taken away.
    pub(super) fn reduced(self, period: Self) -> Self {
        let count = (self.high / period.high).round();
        self - period * count.into()
    }
}

impl From<f64> for DoubleDouble {
    fn from(high: f64) -> Self {
        Self { high, low: 0.0 }
    }
}

/// a + b and what rounding took from it, for |a| ≥ |b|.
fn ordered_sum(a: f64, b: f64) -> DoubleDouble {
    let high = a + b;
    DoubleDouble {
        high,
        low: b - (high - a),
    }
}

/// a + b and what rounding took from it.
fn sum(a: f64, b: f64) -> DoubleDouble {
    let high = a + b;
    let of_b = high - a;
    DoubleDouble {
        high,
        low: (a - (high - of_b)) + (b - of_b),
    }
}

impl Add for DoubleDouble {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let (high, low) = (sum(self.high, other.high), sum(self.low, other.low));
        let first = ordered_sum(high.high, high.low + low.high);
        ordered_sum(first.high, first.low + low.low)
    }
}

impl Sub for DoubleDouble {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + Self {
            high: -other.high,
            low: -other.low,
        }
    }
}

impl Mul for DoubleDouble {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let high = self.high * other.high;
        let low = self.high.mul_add(other.high, -high);
        ordered_sum(high, low + (self.high * other.low + self.low * other.high))
    }
}

impl Div for DoubleDouble {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        let first = self.high / other.high;
        let rest = self - other * first.into();
        let second = rest.high / other.high;
        let last = (rest - other * second.into()).high / other.high;
        ordered_sum(first, second) + last.into()
    }
}

#[cfg(test)]
mod tests {
    use super::DoubleDouble;

    fn close(a: DoubleDouble, b: DoubleDouble) {
        let error = (a - b).value();
        assert!(
            error.abs() < 1e-30 * b.value().abs().max(1.0),
            "{a:?} is not {b:?}: {error:e}"
        );
    }

    #[test]
    fn thirds_roots_and_turns_have_30_digits() {
        let of = DoubleDouble::from;
        close(of(1.0) / of(3.0) * of(3.0), of(1.0));
        close(of(2.0).sqrt() * of(2.0).sqrt(), of(2.0));
        close(of(1.0) + of(1e-20) - of(1.0), of(1e-20));
        // 1000 · 2π − 6283 from 40 digits of π.
        let rest = of(0.185_307_179_586_476_9) + of(2.528_676_655_900_576e-17);
        let rest = rest - of(0.0);
        let turns = DoubleDouble::TURN * of(1000.0) - of(6283.0);
        assert!((turns - rest).value().abs() < 1e-16, "{turns:?}");
        let angle = DoubleDouble::TURN * of(100.0) + of(1e-20);
        close(angle.reduced(DoubleDouble::TURN), of(1e-20));
    }
}
