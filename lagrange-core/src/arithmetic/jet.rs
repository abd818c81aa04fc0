//! The jet reading: nodes are slots of a table of Taylor coefficients.
//!
//! A tape is run for k = 0, 1, …; in run k every operation appends coefficient k of the slot that it writes,
//! from coefficients 0…k of its operands and 0…k−1 of itself. With x(τ) = Σ xⱼ τʲ,
//!
//! ```text
//! z = x y     zₖ = Σ_{j=0..k} xⱼ yₖ₋ⱼ
//! z = x / y   zₖ = (xₖ − Σ_{j=1..k} yⱼ zₖ₋ⱼ) / y₀
//! z = eˣ      k zₖ = Σ_{j=1..k} j xⱼ zₖ₋ⱼ           (z′ = x′ z, and so for every function with such an equation)
//! ```
//!
//! References: Jorba & Zou 2005, A software package for the numerical integration of ODEs by means of high-order
//! Taylor methods, section 2; Griewank & Walther 2008, Evaluating Derivatives, chapter 13.

use super::coefficients::{inner_square, product, square, tail_product, weighted_product};
use super::{Arithmetic, Scalar, Slot};

/// An operation whose Taylor series can fail to exist.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Operation {
    /// x / y at y = 0.
    Division,
    /// √x at x ≤ 0.
    SquareRoot,
    /// xᶜ at x ≤ 0.
    Power,
    /// ln x at x ≤ 0.
    Logarithm,
    /// asin or acos at |x| ≥ 1.
    InverseSine,
    /// Angle of the point (0, 0).
    Angle,
}

/// Where a tape met a point without Taylor series.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Singular {
    /// What it tried to expand.
    pub operation: Operation,
    /// The slot that it would have written, counted from the start of the table.
    pub slot: usize,
}

/// Runs a tape on Taylor coefficients; made by [`super::Coefficients::jet`].
#[derive(Debug)]
pub struct Jet<'a, T> {
    table: &'a mut [T],
    /// 0, 1, 2, … as scalars.
    weights: &'a [T],
    stride: usize,
    k: usize,
    base: usize,
    singular: Option<Singular>,
}

/// Whether x > 0; a NaN is not.
#[inline(always)]
fn positive<T: Scalar>(x: T) -> bool {
    x.value() > 0.0
}

impl<'a, T: Scalar> Jet<'a, T> {
    /// Appends coefficient `k` of slots from the one at `base` on.
    #[inline(always)]
    pub(super) fn new(
        table: &'a mut [T],
        weights: &'a [T],
        stride: usize,
        k: usize,
        base: usize,
    ) -> Self {
        Self {
            table,
            weights,
            stride,
            k,
            base,
            singular: None,
        }
    }

    /// The order k of the coefficients that this run appends.
    #[inline(always)]
    pub(super) fn coefficient(&self) -> usize {
        self.k
    }

    /// The first operation of this run that has no Taylor series here. Its coefficients are zeros, not NaN.
    #[inline(always)]
    pub fn singular(&self) -> Option<Singular> {
        self.singular
    }

    #[inline(always)]
    fn to(&self, to: usize) -> Slot {
        Slot(self.base + to * self.stride)
    }

    /// Coefficient k of a slot.
    #[inline(always)]
    pub(super) fn at(&self, x: Slot) -> T {
        self.table[x.0 + self.k]
    }

    /// Coefficient 0 of a slot.
    #[inline(always)]
    pub(super) fn start(&self, x: Slot) -> T {
        self.table[x.0]
    }

    /// Sets coefficient k of slot `to`.
    #[inline(always)]
    pub(super) fn put(&mut self, to: usize, value: T) -> Slot {
        let slot = self.to(to);
        self.table[slot.0 + self.k] = value;
        slot
    }

    /// Coefficient k of a constant.
    #[inline(always)]
    fn only_first(&self, c: T) -> T {
        if self.k == 0 { c } else { T::zero() }
    }

    /// The coefficient of z with z′ = x′ y: (1/k) Σ_{j=1..k} j xⱼ yₖ₋ⱼ.
    #[inline(always)]
    fn integral(&self, x: Slot, y: Slot) -> T {
        let k = self.k;
        weighted_product(self.table, self.weights, x, y, k, k) / self.weights[k]
    }

    /// Σ_{j=1..k−1} j zⱼ yₖ₋ⱼ / k: what the coefficient of z with y z′ = … takes from earlier coefficients of z.
    #[inline(always)]
    fn earlier(&self, z: Slot, y: Slot) -> T {
        let k = self.k;
        weighted_product(self.table, self.weights, z, y, k, k - 1) / self.weights[k]
    }

    #[cold]
    #[inline(never)]
    fn fail(&mut self, operation: Operation, to: usize) -> T {
        let slot = self.base / self.stride + to;
        self.singular.get_or_insert(Singular { operation, slot });
        T::zero()
    }

    /// Writes the coefficient, or zero and a flag where there is no series.
    #[inline(always)]
    fn put_unless(
        &mut self,
        bad: bool,
        operation: Operation,
        to: usize,
        coefficient: impl FnOnce(&Self, Slot) -> T,
    ) -> Slot {
        let value = if bad {
            self.fail(operation, to)
        } else {
            coefficient(self, self.to(to))
        };
        self.put(to, value)
    }

    /// x / y for a y that does not depend on time.
    #[inline(always)]
    pub(super) fn div_constant(&mut self, to: usize, x: Slot, y: Slot) -> Slot {
        let y0 = self.start(y);
        self.put_unless(y0.value() == 0.0, Operation::Division, to, |a, _| {
            a.at(x) / y0
        })
    }

    /// asin (sign +) or acos (sign −): u z′ = ±x′, u = √(1 − x²).
    fn inverse_sine(&mut self, to: usize, x: Slot, first: fn(T) -> T, sign: T) -> Slot {
        let (k, u) = (self.k, self.to(to + 1));
        let x0 = self.start(x);
        let cosine = (T::one() - x0) * (T::one() + x0);
        let bad = !positive(cosine);
        self.put_unless(bad, Operation::InverseSine, to + 1, |a, u| {
            if k == 0 {
                return cosine.sqrt();
            }
            let u0 = a.start(u);
            -(square(a.table, x, k) + inner_square(a.table, u, k)) / (u0 + u0)
        });
        self.put_unless(bad, Operation::InverseSine, to, |a, z| {
            if k == 0 {
                first(x0)
            } else {
                (sign * a.at(x) - a.earlier(z, u)) / a.start(u)
            }
        })
    }
}

impl<T: Scalar> Arithmetic for Jet<'_, T> {
    type Scalar = T;
    type Node = Slot;

    #[inline(always)]
    fn origin(&mut self, base: usize) {
        self.base = base * self.stride;
    }

    #[inline]
    fn constant(&mut self, to: usize, c: T) -> Slot {
        self.put(to, self.only_first(c))
    }

    #[inline]
    fn add(&mut self, to: usize, x: Slot, y: Slot) -> Slot {
        self.put(to, self.at(x) + self.at(y))
    }

    #[inline]
    fn sub(&mut self, to: usize, x: Slot, y: Slot) -> Slot {
        self.put(to, self.at(x) - self.at(y))
    }

    #[inline]
    fn neg(&mut self, to: usize, x: Slot) -> Slot {
        self.put(to, -self.at(x))
    }

    #[inline]
    fn offset(&mut self, to: usize, c: T, x: Slot) -> Slot {
        let x = self.at(x);
        self.put(to, if self.k == 0 { c + x } else { x })
    }

    #[inline]
    fn scale(&mut self, to: usize, c: T, x: Slot) -> Slot {
        self.put(to, c * self.at(x))
    }

    fn mul(&mut self, to: usize, x: Slot, y: Slot) -> Slot {
        self.put(to, product(self.table, x, y, self.k))
    }

    fn square(&mut self, to: usize, x: Slot) -> Slot {
        self.put(to, square(self.table, x, self.k))
    }

    fn div(&mut self, to: usize, x: Slot, y: Slot) -> Slot {
        let y0 = self.start(y);
        self.put_unless(y0.value() == 0.0, Operation::Division, to, |a, z| {
            (a.at(x) - tail_product(a.table, y, z, a.k)) / y0
        })
    }

    fn ratio(&mut self, to: usize, c: T, x: Slot) -> Slot {
        let x0 = self.start(x);
        self.put_unless(x0.value() == 0.0, Operation::Division, to, |a, z| {
            (a.only_first(c) - tail_product(a.table, x, z, a.k)) / x0
        })
    }

    fn sqrt(&mut self, to: usize, x: Slot) -> Slot {
        let x0 = self.start(x);
        self.put_unless(!positive(x0), Operation::SquareRoot, to, |a, z| {
            if a.k == 0 {
                return x0.sqrt();
            }
            let z0 = a.start(z);
            (a.at(x) - inner_square(a.table, z, a.k)) / (z0 + z0)
        })
    }

    fn powf(&mut self, to: usize, x: Slot, c: f64) -> Slot {
        let x0 = self.start(x);
        // x z′ = c z x′
        self.put_unless(!positive(x0), Operation::Power, to, |a, z| {
            if a.k == 0 {
                return x0.powf(c);
            }
            (T::from_f64(c) * a.integral(x, z) - a.earlier(z, x)) / x0
        })
    }

    fn exp(&mut self, to: usize, x: Slot) -> Slot {
        let value = if self.k == 0 {
            self.at(x).exp()
        } else {
            self.integral(x, self.to(to))
        };
        self.put(to, value)
    }

    fn ln(&mut self, to: usize, x: Slot) -> Slot {
        let x0 = self.start(x);
        // x z′ = x′
        self.put_unless(!positive(x0), Operation::Logarithm, to, |a, z| {
            if a.k == 0 {
                x0.ln()
            } else {
                (a.at(x) - a.earlier(z, x)) / x0
            }
        })
    }

    fn sin_cos(&mut self, to: usize, x: Slot) -> (Slot, Slot) {
        let (s, c) = (self.to(to), self.to(to + 1));
        let (sin, cos) = if self.k == 0 {
            self.at(x).sin_cos()
        } else {
            (self.integral(x, c), -self.integral(x, s))
        };
        (self.put(to, sin), self.put(to + 1, cos))
    }

    fn sinh_cosh(&mut self, to: usize, x: Slot) -> (Slot, Slot) {
        let (s, c) = (self.to(to), self.to(to + 1));
        let (sinh, cosh) = if self.k == 0 {
            self.at(x).sinh_cosh()
        } else {
            (self.integral(x, c), self.integral(x, s))
        };
        (self.put(to, sinh), self.put(to + 1, cosh))
    }

    fn tan(&mut self, to: usize, x: Slot) -> Slot {
        // z′ = u x′, u = 1 + z²
        let value = if self.k == 0 {
            self.at(x).tan()
        } else {
            self.integral(x, self.to(to + 1))
        };
        let z = self.put(to, value);
        self.put(
            to + 1,
            self.only_first(T::one()) + square(self.table, z, self.k),
        );
        z
    }

    fn tanh(&mut self, to: usize, x: Slot) -> Slot {
        // z′ = u x′, u = 1 − z²
        let value = if self.k == 0 {
            self.at(x).tanh()
        } else {
            self.integral(x, self.to(to + 1))
        };
        let z = self.put(to, value);
        self.put(
            to + 1,
            self.only_first(T::one()) - square(self.table, z, self.k),
        );
        z
    }

    fn asin(&mut self, to: usize, x: Slot) -> Slot {
        self.inverse_sine(to, x, T::asin, T::one())
    }

    fn acos(&mut self, to: usize, x: Slot) -> Slot {
        self.inverse_sine(to, x, T::acos, -T::one())
    }

    fn atan(&mut self, to: usize, x: Slot) -> Slot {
        // u z′ = x′, u = 1 + x²
        let u = self.put(
            to + 1,
            self.only_first(T::one()) + square(self.table, x, self.k),
        );
        let value = if self.k == 0 {
            self.at(x).atan()
        } else {
            (self.at(x) - self.earlier(self.to(to), u)) / self.start(u)
        };
        self.put(to, value)
    }

    fn atan2(&mut self, to: usize, y: Slot, x: Slot) -> Slot {
        // u z′ = x y′ − y x′, u = x² + y²
        let u = self.put(
            to + 1,
            square(self.table, x, self.k) + square(self.table, y, self.k),
        );
        let u0 = self.start(u);
        self.put_unless(!positive(u0), Operation::Angle, to, |a, z| {
            if a.k == 0 {
                return a.at(y).atan2(a.at(x));
            }
            (a.integral(y, x) - a.integral(x, y) - a.earlier(z, u)) / u0
        })
    }
}
