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

use super::convolution::{
    convolution, convolution_ends_last, convolution_square, weighted, weighted_pair,
};
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

/// Runs a tape on Taylor coefficients; made by [`Coefficients::jet`].
#[derive(Debug)]
pub struct Jet<'a, T> {
    table: &'a mut [T],
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
    /// Appends coefficient `k` of slots whose first begins at `base` in `table`.
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

    /// The first operation of this run that has no Taylor series here. Its coefficients are zeros, not NaN.
    #[inline(always)]
    pub fn singular(&self) -> Option<Singular> {
        self.singular
    }

    #[inline(always)]
    fn to(&self, to: usize) -> usize {
        self.base + to * self.stride
    }

    #[inline(always)]
    fn at(&self, x: Slot) -> T {
        self.table[x.0 + self.k]
    }

    /// Coefficient k of a slot.
    #[inline(always)]
    pub(crate) fn latest(&self, x: Slot) -> T {
        self.at(x)
    }

    /// Sets coefficient k of slot `to`.
    #[inline(always)]
    pub(crate) fn append(&mut self, to: usize, value: T) -> Slot {
        self.put(to, value)
    }

    #[inline(always)]
    fn put(&mut self, to: usize, value: T) -> Slot {
        let offset = self.to(to);
        self.table[offset + self.k] = value;
        Slot(offset)
    }

    /// Coefficients `from..until` of the series at `offset`.
    #[inline(always)]
    fn part(&self, offset: usize, from: usize, until: usize) -> &[T] {
        &self.table[offset + from..offset + until]
    }

    /// Σ_{j=1..k} j xⱼ yₖ₋ⱼ
    #[inline(always)]
    fn derivative_product(&self, x: usize, y: usize) -> T {
        let k = self.k;
        weighted(
            &self.weights[1..=k],
            self.part(x, 1, k + 1),
            self.part(y, 0, k),
        )
    }

    /// Σ_{j=1..k−1} j zⱼ yₖ₋ⱼ
    #[inline(always)]
    fn derivative_tail(&self, z: usize, y: usize) -> T {
        let k = self.k;
        weighted(&self.weights[1..k], self.part(z, 1, k), self.part(y, 1, k))
    }

    #[inline(always)]
    fn order(&self) -> T {
        self.weights[self.k]
    }

    #[cold]
    #[inline(never)]
    fn fail(&mut self, operation: Operation, to: usize) -> T {
        let slot = self.to(to) / self.stride;
        self.singular.get_or_insert(Singular { operation, slot });
        T::zero()
    }

    /// The coefficient, or zero and a flag where there is no series.
    #[inline(always)]
    fn unless(
        &mut self,
        bad: bool,
        operation: Operation,
        to: usize,
        f: impl FnOnce(&Self) -> T,
    ) -> T {
        if bad {
            self.fail(operation, to)
        } else {
            f(self)
        }
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
        let value = if self.k == 0 { c } else { T::zero() };
        self.put(to, value)
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
        let n = self.k + 1;
        let z = convolution_ends_last(self.part(x.0, 0, n), self.part(y.0, 0, n));
        self.put(to, z)
    }

    fn square(&mut self, to: usize, x: Slot) -> Slot {
        let z = convolution_square(self.part(x.0, 0, self.k + 1));
        self.put(to, z)
    }

    fn div(&mut self, to: usize, x: Slot, y: Slot) -> Slot {
        let (k, z) = (self.k, self.to(to));
        let y0 = self.table[y.0];
        let value = self.unless(y0.value() == 0.0, Operation::Division, to, |a| {
            (a.at(x) - convolution(a.part(y.0, 1, k + 1), a.part(z, 0, k))) / y0
        });
        self.put(to, value)
    }

    fn ratio(&mut self, to: usize, c: T, x: Slot) -> Slot {
        let (k, z) = (self.k, self.to(to));
        let x0 = self.table[x.0];
        let value = self.unless(x0.value() == 0.0, Operation::Division, to, |a| {
            if k == 0 {
                c / x0
            } else {
                -convolution(a.part(x.0, 1, k + 1), a.part(z, 0, k)) / x0
            }
        });
        self.put(to, value)
    }

    fn sqrt(&mut self, to: usize, x: Slot) -> Slot {
        let (k, z) = (self.k, self.to(to));
        let x0 = self.table[x.0];
        let value = self.unless(!positive(x0), Operation::SquareRoot, to, |a| {
            if k == 0 {
                x0.sqrt()
            } else {
                let z0 = a.table[z];
                (a.at(x) - convolution_square(a.part(z, 1, k))) / (z0 + z0)
            }
        });
        self.put(to, value)
    }

    fn powf(&mut self, to: usize, x: Slot, c: f64) -> Slot {
        let (k, z) = (self.k, self.to(to));
        let x0 = self.table[x.0];
        // x z′ = c z x′
        let value = self.unless(!positive(x0), Operation::Power, to, |a| {
            if k == 0 {
                x0.powf(c)
            } else {
                (T::from_f64(c) * a.derivative_product(x.0, z) - a.derivative_tail(z, x.0))
                    / (a.order() * x0)
            }
        });
        self.put(to, value)
    }

    fn exp(&mut self, to: usize, x: Slot) -> Slot {
        let z = self.to(to);
        let value = if self.k == 0 {
            self.at(x).exp()
        } else {
            self.derivative_product(x.0, z) / self.order()
        };
        self.put(to, value)
    }

    fn ln(&mut self, to: usize, x: Slot) -> Slot {
        let (k, z) = (self.k, self.to(to));
        let x0 = self.table[x.0];
        // x z′ = x′
        let value = self.unless(!positive(x0), Operation::Logarithm, to, |a| {
            if k == 0 {
                x0.ln()
            } else {
                (a.at(x) - a.derivative_tail(z, x.0) / a.order()) / x0
            }
        });
        self.put(to, value)
    }

    fn sin_cos(&mut self, to: usize, x: Slot) -> (Slot, Slot) {
        let (k, s, c) = (self.k, self.to(to), self.to(to + 1));
        let (sin, cos) = if k == 0 {
            self.at(x).sin_cos()
        } else {
            let (weights, x) = (&self.weights[1..=k], self.part(x.0, 1, k + 1));
            let (sin, cos) = weighted_pair(weights, x, self.part(c, 0, k), self.part(s, 0, k));
            (sin / self.order(), -cos / self.order())
        };
        (self.put(to, sin), self.put(to + 1, cos))
    }

    fn sinh_cosh(&mut self, to: usize, x: Slot) -> (Slot, Slot) {
        let (k, s, c) = (self.k, self.to(to), self.to(to + 1));
        let (sinh, cosh) = if k == 0 {
            self.at(x).sinh_cosh()
        } else {
            let (weights, x) = (&self.weights[1..=k], self.part(x.0, 1, k + 1));
            let (sinh, cosh) = weighted_pair(weights, x, self.part(c, 0, k), self.part(s, 0, k));
            (sinh / self.order(), cosh / self.order())
        };
        (self.put(to, sinh), self.put(to + 1, cosh))
    }

    fn tan(&mut self, to: usize, x: Slot) -> Slot {
        let (z, u) = (self.to(to), self.to(to + 1));
        // z′ = u x′, u = 1 + z²
        let value = if self.k == 0 {
            self.at(x).tan()
        } else {
            self.derivative_product(x.0, u) / self.order()
        };
        let slot = self.put(to, value);
        let square = convolution_square(self.part(z, 0, self.k + 1));
        self.put(
            to + 1,
            if self.k == 0 {
                T::one() + square
            } else {
                square
            },
        );
        slot
    }

    fn tanh(&mut self, to: usize, x: Slot) -> Slot {
        let (z, u) = (self.to(to), self.to(to + 1));
        // z′ = u x′, u = 1 − z²
        let value = if self.k == 0 {
            self.at(x).tanh()
        } else {
            self.derivative_product(x.0, u) / self.order()
        };
        let slot = self.put(to, value);
        let square = convolution_square(self.part(z, 0, self.k + 1));
        self.put(
            to + 1,
            if self.k == 0 {
                T::one() - square
            } else {
                -square
            },
        );
        slot
    }

    fn asin(&mut self, to: usize, x: Slot) -> Slot {
        self.inverse_sine(to, x, T::asin, T::one())
    }

    fn acos(&mut self, to: usize, x: Slot) -> Slot {
        self.inverse_sine(to, x, T::acos, -T::one())
    }

    fn atan(&mut self, to: usize, x: Slot) -> Slot {
        let (k, z, u) = (self.k, self.to(to), self.to(to + 1));
        // u z′ = x′, u = 1 + x²
        let square = convolution_square(self.part(x.0, 0, k + 1));
        self.put(to + 1, if k == 0 { T::one() + square } else { square });
        let value = if k == 0 {
            self.at(x).atan()
        } else {
            (self.at(x) - self.derivative_tail(z, u) / self.order()) / self.table[u]
        };
        self.put(to, value)
    }

    fn atan2(&mut self, to: usize, y: Slot, x: Slot) -> Slot {
        let (k, z, u) = (self.k, self.to(to), self.to(to + 1));
        // u z′ = x y′ − y x′, u = x² + y²
        let square = convolution_square(self.part(x.0, 0, k + 1))
            + convolution_square(self.part(y.0, 0, k + 1));
        self.put(to + 1, square);
        let u0 = self.table[u];
        let value = self.unless(!positive(u0), Operation::Angle, to, |a| {
            if k == 0 {
                a.at(y).atan2(a.at(x))
            } else {
                let turn = a.derivative_product(y.0, x.0) - a.derivative_product(x.0, y.0);
                (turn - a.derivative_tail(z, u)) / (a.order() * u0)
            }
        });
        self.put(to, value)
    }
}

impl<T: Scalar> Jet<'_, T> {
    /// asin (sign +) or acos (sign −): u z′ = ±x′, u = √(1 − x²).
    fn inverse_sine(&mut self, to: usize, x: Slot, start: fn(T) -> T, sign: T) -> Slot {
        let (k, z, u) = (self.k, self.to(to), self.to(to + 1));
        let x0 = self.table[x.0];
        if !positive(T::one() - x0 * x0) {
            let zero = self.fail(Operation::InverseSine, to);
            self.put(to + 1, zero);
            return self.put(to, zero);
        }
        if k == 0 {
            self.put(to + 1, ((T::one() - x0) * (T::one() + x0)).sqrt());
            return self.put(to, start(x0));
        }
        let u0 = self.table[u];
        let square =
            convolution_square(self.part(x.0, 0, k + 1)) + convolution_square(self.part(u, 1, k));
        self.put(to + 1, -square / (u0 + u0));
        let value = (sign * self.at(x) - self.derivative_tail(z, u) / self.order()) / u0;
        self.put(to, value)
    }
}
