//! Polynomials of degree two in time, c₀ + c₁τ + c₂τ², as numbers: a motion q + vτ + ½aτ² goes through an expression, and
//! with it its rate.

use core::ops::{Add, Mul};

/// c₀, c₁, c₂.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Series(pub [f64; 3]);

impl Series {
    /// Does not move.
    pub const fn constant(c: f64) -> Self {
        Self([c, 0.0, 0.0])
    }

    /// d/dτ; the coefficient that the rate would need and is not known is 0.
    pub fn derivative(self) -> Self {
        let [_, x, y] = self.0;
        Self([x, 2.0 * y, 0.0])
    }

    /// f(self), and f'(self), from the derivatives f, f', f'', f''' at c₀.
    pub fn of(self, [f, f1, f2, f3]: [f64; 4]) -> (Self, Self) {
        let [_, x, y] = self.0;
        let square = 0.5 * x * x;
        // 0·∞ where a power has come down to a number.
        let times = |a: f64, b: f64| if b == 0.0 { 0.0 } else { a * b };
        let value = [f, times(f1, x), times(f1, y) + times(f2, square)];
        let slope = [f1, times(f2, x), times(f2, y) + times(f3, square)];
        (Self(value), Self(slope))
    }

    /// The angle of (x, y) = (`x`, `self`), and its derivatives by `self` and by `x`.
    pub fn atan2(self, x: Self) -> (Self, [Self; 2]) {
        let y = self;
        let square = x * x + y * y;
        let [s, ..] = square.0;
        let (inverse, _) = square.of([1.0 / s, -1.0 / (s * s), 2.0 / (s * s * s), 0.0]);
        let (along, across) = (x * inverse, y * inverse * Self::constant(-1.0));
        let [rate, slope, _] = (along * y.derivative() + across * x.derivative()).0;
        let angle = f64::atan2(y.0[0], x.0[0]);
        (Self([angle, rate, 0.5 * slope]), [along, across])
    }
}

impl Add for Series {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let ([a, b, c], [x, y, z]) = (self.0, other.0);
        Self([a + x, b + y, c + z])
    }
}

impl Mul for Series {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let ([a, b, c], [x, y, z]) = (self.0, other.0);
        Self([a * x, a * y + b * x, a * z + b * y + c * x])
    }
}

/// Function `number` of the format and its first three derivatives at x.
pub(super) fn function(number: u32, x: f64) -> [f64; 4] {
    match number {
        0 => {
            let (s, c) = x.sin_cos();
            [s, c, -s, -c]
        }
        1 => {
            let (s, c) = x.sin_cos();
            [c, -s, -c, s]
        }
        2 => {
            let t = x.tan();
            let u = 1.0 + t * t;
            [t, u, 2.0 * t * u, 2.0 * u * (1.0 + 3.0 * t * t)]
        }
        3 | 4 => {
            let w = 1.0 / (1.0 - x * x).sqrt();
            let cube = w * w * w;
            let third = cube + 3.0 * x * x * cube * w * w;
            match number {
                3 => [x.asin(), w, x * cube, third],
                _ => [x.acos(), -w, -x * cube, -third],
            }
        }
        5 => {
            let u = 1.0 / (1.0 + x * x);
            let third = (6.0 * x * x - 2.0) * u * u * u;
            [x.atan(), u, -2.0 * x * u * u, third]
        }
        6 => [x.sinh(), x.cosh(), x.sinh(), x.cosh()],
        7 => [x.cosh(), x.sinh(), x.cosh(), x.sinh()],
        8 => {
            let t = x.tanh();
            let u = 1.0 - t * t;
            [t, u, -2.0 * t * u, u * (6.0 * t * t - 2.0)]
        }
        9 => [x.exp(); 4],
        10 => [x.ln(), 1.0 / x, -1.0 / (x * x), 2.0 / (x * x * x)],
        _ => [f64::NAN; 4],
    }
}

/// xᵖ and its first three derivatives.
pub(super) fn power(x: f64, p: f64) -> [f64; 4] {
    let raised = |p: f64| {
        if p == p.trunc() && p.abs() < 1e9 {
            x.powi(p as i32)
        } else {
            x.powf(p)
        }
    };
    let mut factor = 1.0;
    core::array::from_fn(|k| {
        let k = k as f64;
        if k > 0.0 {
            factor *= p - k + 1.0;
        }
        // The fourth derivative of a cube is 0, also at 0.
        if factor == 0.0 {
            0.0
        } else {
            factor * raised(p - k)
        }
    })
}
