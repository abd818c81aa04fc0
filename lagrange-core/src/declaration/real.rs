//! What a declaration can be evaluated with: a number, several side by side, or an interval of numbers.

use crate::arithmetic::Pack;
use core::ops::{Add, Mul};

/// A number, several numbers side by side, or everything between two numbers.
pub trait Real: Copy + Default + Add<Output = Self> + Mul<Output = Self> {
    /// Nothing is known of it.
    const ANYTHING: Self;

    /// This number.
    fn number(x: f64) -> Self;

    /// The numbers of `first` where it is ≥ 0, and those of `second` elsewhere: values with their coefficients in time.
    fn choose(self, first: [Self; 3], second: [Self; 3]) -> [Self; 3];

    /// What a change makes as a factor: 0 where nothing changes, also of what is infinite.
    fn times_change(self, change: Self) -> Self;

    /// xᵖ
    fn raised(self, p: f64) -> Self;

    /// xᵖ, xᵖ⁻¹, xᵖ⁻² and xᵖ⁻³; 0 for those beyond x⁰, which no derivative of a whole power has.
    fn powers(self, p: f64) -> [Self; 4] {
        each_power(self, p)
    }

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

/// [`Real::powers`], each by itself.
fn each_power<N: Real>(x: N, p: f64) -> [N; 4] {
    [0.0, 1.0, 2.0, 3.0].map(|k| match p == p.trunc() && (0.0..k).contains(&p) {
        true => N::default(),
        false => x.raised(p - k),
    })
}

impl Real for f64 {
    const ANYTHING: Self = f64::NAN;

    fn number(x: f64) -> Self {
        x
    }

    fn choose(self, first: [Self; 3], second: [Self; 3]) -> [Self; 3] {
        if self >= 0.0 { first } else { second }
    }

    fn times_change(self, change: Self) -> Self {
        if change == 0.0 { change } else { self * change }
    }

    fn raised(self, p: f64) -> Self {
        match p {
            0.0 => 1.0,
            1.0 => self,
            2.0 => self * self,
            _ if p == p.trunc() && p.abs() < 1e9 => self.powi(p as i32),
            _ => self.powf(p),
        }
    }

    fn powers(self, p: f64) -> [Self; 4] {
        // One of them makes the others where none that is finite needs more than the range of numbers on the way.
        let in_range = (1e-60..1e60).contains(&self) && p.abs() < 4.0;
        if p == p.trunc() || !in_range {
            return each_power(self, p);
        }
        let (power, inverse) = (self.powf(p), self.recip());
        let (once, twice) = (power * inverse, inverse * inverse);
        [power, once, power * twice, once * twice]
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

impl<const L: usize> Default for Pack<f64, L> {
    fn default() -> Self {
        Self([0.0; L])
    }
}

/// Functions of each number by itself.
macro_rules! of_each {
    ($($function:ident)*) => {$(
        fn $function(self) -> Self {
            Self(self.0.map(<f64 as Real>::$function))
        }
    )*};
}

impl<const L: usize> Real for Pack<f64, L> {
    const ANYTHING: Self = Self([f64::NAN; L]);

    fn number(x: f64) -> Self {
        Self([x; L])
    }

    fn choose(self, first: [Self; 3], second: [Self; 3]) -> [Self; 3] {
        let mut chosen = first;
        for (lane, guard) in self.0.into_iter().enumerate() {
            let of = |x: [Self; 3]| x.map(|c| c.0[lane]);
            let one = guard.choose(of(first), of(second));
            for (to, c) in chosen.iter_mut().zip(one) {
                to.0[lane] = c;
            }
        }
        chosen
    }

    fn times_change(self, change: Self) -> Self {
        let mut product = self;
        for (x, change) in product.0.iter_mut().zip(change.0) {
            *x = x.times_change(change);
        }
        product
    }

    fn raised(self, p: f64) -> Self {
        match p {
            0.0 => Self::number(1.0),
            1.0 => self,
            2.0 => self * self,
            _ => Self(self.0.map(|x| x.raised(p))),
        }
    }

    fn powers(self, p: f64) -> [Self; 4] {
        if p == p.trunc() {
            return each_power(self, p);
        }
        let powers = self.0.map(|x| x.powers(p));
        core::array::from_fn(|k| Self(powers.map(|powers| powers[k])))
    }

    fn atan2(self, x: Self) -> Self {
        let mut angle = self;
        for (angle, x) in angle.0.iter_mut().zip(x.0) {
            *angle = angle.atan2(x);
        }
        angle
    }

    fn sin_cos(self) -> (Self, Self) {
        let pairs = self.0.map(f64::sin_cos);
        (Self(pairs.map(|(s, _)| s)), Self(pairs.map(|(_, c)| c)))
    }

    of_each! { tan asin acos atan sinh cosh tanh exp ln }
}
