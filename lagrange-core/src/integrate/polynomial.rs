//! Positions and velocities over one step, as polynomials in s = (t − t₀)/h.

use super::at_places::{AtPlaces, ORDERS, derivative_at, horner_at};
use crate::arithmetic::products::Row;
use crate::arithmetic::quad::{Quad, values};
use crate::arithmetic::{Pack, Scalar};
use crate::declaration::AtState;

/// The solution over one step: q(t₀ + h s) = Σₖ qₖ sᵏ, the same for v; coefficients carry hᵏ.
#[derive(Clone, Debug, PartialEq)]
pub struct StepPolynomial<T> {
    /// Start of the step.
    pub t: T,
    /// Length of the step.
    pub h: T,
    /// Degree of every polynomial.
    pub degree: usize,
    /// Coefficients of the positions, one row of `degree + 1` per coordinate, ascending powers.
    pub q: Vec<T>,
    /// Coefficients of the velocities, likewise.
    pub v: Vec<T>,
}

impl<T: Scalar> StepPolynomial<T> {
    /// Room for `coordinates` coordinates at `degree`, all zero.
    pub fn new(coordinates: usize, degree: usize) -> Self {
        let zeros = vec![T::zero(); coordinates * (degree + 1)];
        Self {
            t: T::zero(),
            h: T::zero(),
            degree,
            q: zeros.clone(),
            v: zeros,
        }
    }

    /// Changes the degree, coefficients become zero. Does not allocate if the new degree is not above any before.
    pub fn set_degree(&mut self, degree: usize) {
        if degree == self.degree {
            return;
        }
        let size = self.coordinates() * (degree + 1);
        self.degree = degree;
        for row in [&mut self.q, &mut self.v] {
            row.clear();
            row.resize(size, T::zero());
        }
    }

    /// Raises the degree to at least this; the polynomials stay what they are.
    pub(crate) fn raise(&mut self, degree: usize) {
        if degree <= self.degree {
            return;
        }
        let (coordinates, before, width) = (self.coordinates(), self.degree + 1, degree + 1);
        for rows in [&mut self.q, &mut self.v] {
            rows.resize(coordinates * width, T::zero());
            for i in (0..coordinates).rev() {
                rows.copy_within(i * before..(i + 1) * before, i * width);
                rows[i * width + before..(i + 1) * width].fill(T::zero());
            }
        }
        self.degree = degree;
    }

    /// Leaves this first part of the step.
    pub(crate) fn shorten(&mut self, part: f64) {
        self.h *= T::from_f64(part);
        for rows in [&mut self.q, &mut self.v] {
            for row in rows.chunks_exact_mut(self.degree + 1) {
                let mut power = 1.0;
                for c in row {
                    *c *= T::from_f64(power);
                    power *= part;
                }
            }
        }
    }

    /// Number of coordinates.
    pub fn coordinates(&self) -> usize {
        self.q.len() / (self.degree + 1)
    }

    /// Time at `s`.
    pub fn time(&self, s: T) -> T {
        self.t + self.h * s
    }

    /// How far positions are from zero on the step, at most.
    pub fn extent(&self) -> f64 {
        let rows = self.q.chunks_exact(self.degree + 1);
        let sizes = rows.map(|row| row.iter().map(|c| c.value().abs()).sum());
        sizes.fold(0.0, f64::max)
    }

    /// Coefficients of the position of coordinate `i`.
    pub(crate) fn position_row(&self, i: usize) -> &[T] {
        &self.q[i * (self.degree + 1)..][..self.degree + 1]
    }

    /// Coefficients of the velocity of coordinate `i`.
    pub fn velocity_row(&self, i: usize) -> &[T] {
        &self.v[i * (self.degree + 1)..][..self.degree + 1]
    }

    /// Coefficients of the position and velocity of coordinate `i`, to write.
    pub fn rows_mut(&mut self, i: usize) -> (&mut [T], &mut [T]) {
        let width = self.degree + 1;
        (
            &mut self.q[i * width..][..width],
            &mut self.v[i * width..][..width],
        )
    }

    /// Position of coordinate `i` at `s`.
    pub fn position(&self, i: usize, s: T) -> T {
        horner(self.position_row(i), s)
    }

    /// Velocity of coordinate `i` at `s`.
    pub fn velocity(&self, i: usize, s: T) -> T {
        horner(self.velocity_row(i), s)
    }

    /// Acceleration of coordinate `i` at `s`: the derivative of the velocity's polynomial by time.
    pub fn acceleration(&self, i: usize, s: T) -> T {
        derivative(self.velocity_row(i), s) / self.h
    }

    /// Evaluates values where the step begins.
    pub(crate) fn at_start(&self, values: &mut AtState) {
        for i in 0..self.coordinates() {
            let velocity = self.velocity_row(i);
            values.q[i] = self.position_row(i)[0].value();
            values.v[i] = velocity[0].value();
            values.acceleration[i] = (velocity[1] / self.h).value();
        }
        values.evaluate(self.t.value());
    }

    /// Evaluates values, and their rates, at several places.
    pub(crate) fn at_places(&self, places: AtPlaces, values: &mut AtState<AtPlaces>) {
        for i in 0..self.coordinates() {
            values.q[i] = horner_at(self.position_row(i), places);
            values.v[i] = horner_at(self.velocity_row(i), places);
        }
        if values.evaluator.needs_accelerations() {
            for i in 0..self.coordinates() {
                let slope = derivative_at(self.velocity_row(i), places);
                values.acceleration[i] = Pack(slope.0.map(|slope| slope / self.h.value()));
            }
        }
        let times = places.0.map(|s| self.time(T::from_f64(s)).value());
        values.evaluate(Pack(times));
    }

    /// Positions and velocities of all coordinates at `s`.
    pub fn state_into(&self, s: T, q: &mut [T], v: &mut [T]) {
        let width = self.degree + 1;
        if s.is_one() {
            for (rows, out) in [(&self.q, q), (&self.v, v)] {
                for (x, row) in out.iter_mut().zip(rows.chunks_exact(width)) {
                    *x = sum(row);
                }
            }
            return;
        }
        for (q, row) in q.iter_mut().zip(self.q.chunks_exact(width)) {
            *q = horner(row, s);
        }
        for (v, row) in v.iter_mut().zip(self.v.chunks_exact(width)) {
            *v = horner(row, s);
        }
    }

    /// Changes coefficients by rounding errors, so that the state at s = 1 becomes (`q`, `v`) where rounding allows.
    /// What [`Self::state_into`] then gives at s = 1 is the step's result.
    pub(crate) fn close_onto(&mut self, q: &[T], v: &[T]) {
        let width = self.degree + 1;
        for (rows, end) in [(&mut self.q, q), (&mut self.v, v)] {
            for (row, &end) in rows.chunks_exact_mut(width).zip(end) {
                row[1] += end - sum(row);
            }
        }
    }
}

/// Σ cₖ, the first two last; the others in four chains, so that no addition waits for the one before.
#[inline]
pub(crate) fn sum<T: Scalar>(c: &[T]) -> T {
    let [c0, c1, rest @ ..] = c else {
        return c.iter().fold(T::zero(), |sum, &c| sum + c);
    };
    let (fours, end) = rest.as_chunks::<4>();
    let mut sums = [T::zero(); 4];
    for four in fours.iter().rev() {
        sums = core::array::from_fn(|i| sums[i] + four[i]);
    }
    let sums = (sums[0] + sums[2]) + (sums[1] + sums[3]);
    let rest = match *end {
        [] => sums,
        [a] => sums + a,
        [a, b] => sums + (b + a),
        [a, b, c, ..] => sums + (c + b + a),
    };
    rest + *c1 + *c0
}

/// Coefficients onto a step, cₖ pₖ for as many as `out` has; returns their sum, in which the first four are added last, and, if asked
/// for, Σ k cₖ pₖ.
#[inline(always)]
pub(crate) fn onto_step<T: Scalar, Q: Quad, const SLOPE: bool>(
    quad: Q,
    out: &mut [T],
    c: &Row<T>,
    powers: &Row<f64>,
) -> (T, f64) {
    let (fours, end) = out.as_chunks_mut::<4>();
    let (mut sums, mut slopes) = (quad.splat(T::zero()), quad.splat(0.0));
    let mut higher = sums;
    let terms = fours.iter_mut().zip(c.as_chunks().0);
    let factors = powers.as_chunks().0.iter().zip(ORDERS.as_chunks().0);
    for ((out, &c), (&powers, &orders)) in terms.zip(factors).rev() {
        let x = quad.product(quad.four(c), quad.four(of_type(powers)));
        *out = quad.numbers(x);
        if SLOPE {
            let x = quad.four(values(*out));
            slopes = quad.sum(slopes, quad.product(quad.four(orders), x));
        }
        (higher, sums) = (sums, quad.sum(sums, x));
    }
    let (mut sum, mut slope) = (quad.total(higher), quad.total(slopes));
    let mut k = 4 * fours.len() + end.len();
    for out in end.iter_mut().rev() {
        k -= 1;
        *out = c[k] * T::from_f64(powers[k]);
        sum += *out;
        if SLOPE {
            slope += ORDERS[k] * out.value();
        }
    }
    if let Some(&[x0, x1, x2, x3]) = fours.first() {
        sum = sum + (x2 + x3) + x1 + x0;
    }
    (sum, slope)
}

/// Numbers of another type.
#[inline(always)]
fn of_type<T: Scalar>([a, b, c, d]: [f64; 4]) -> [T; 4] {
    [
        T::from_f64(a),
        T::from_f64(b),
        T::from_f64(c),
        T::from_f64(d),
    ]
}

/// Writes 1, h, h², …, at least to the order `degree`. A power beyond all numbers would make a coefficient that is zero no number: it is the
/// largest of them.
#[inline(always)]
pub(crate) fn powers_of<Q: Quad>(quad: Q, h: f64, degree: usize, powers: &mut Row<f64>) {
    let square = h * h;
    let mut four = quad.lesser(
        quad.four([1.0, h, square, square * h]),
        quad.splat(f64::MAX),
    );
    let factor = quad.splat((square * square).min(f64::MAX));
    for next in powers.as_chunks_mut().0.iter_mut().take(degree / 4 + 1) {
        *next = quad.numbers(four);
        four = quad.lesser(quad.product(four, factor), quad.splat(f64::MAX));
    }
}

/// Σ cₖ sᵏ; the small terms are added first, so that at s = 1 the sum is accurate to rounding for series that decay.
pub(crate) fn horner<T: Scalar>(c: &[T], s: T) -> T {
    c.iter().rev().fold(T::zero(), |sum, &c| sum * s + c)
}

/// Σ cₖ sᵏ; at s = 1 as [`sum`].
pub(crate) fn value(c: &[f64], s: f64) -> f64 {
    if s == 1.0 { sum(c) } else { horner(c, s) }
}

/// Σ k cₖ sᵏ⁻¹.
pub(crate) fn derivative<T: Scalar>(c: &[T], s: T) -> T {
    let terms = c.iter().enumerate().skip(1).rev();
    terms.fold(T::zero(), |sum, (k, &c)| {
        sum * s + T::from_f64(k as f64) * c
    })
}
