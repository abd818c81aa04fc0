//! Derivatives of the shares of forces that bounds decide, by the theorem on implicit functions.
//!
//! With R the rows of the bounds, relative, and u the length of the basis, the shares are u² P Rᵀ z of the multipliers z, where
//!
//! ```text
//! s = R (λ₀ + u² P Rᵀ z) + c ∈ K        z ∈ K        s ∘ z = 0
//! ```
//!
//! The last equation is that of a bound that is met and of one that is not, and of the border of a cone and of its tip. Its Jacobian is one
//! of doubles, so that each of Newton's steps from the solution gives the derivatives of one more order. More bounds than there is freedom may be
//! met: that leaves their multipliers open, and the shares are the same for all. References: Alizadeh & Goldfarb 2003, Mathematical Programming 95, 3,
//! sections 4 and 5; Fiacco 1983, Introduction to Sensitivity and Stability Analysis in Nonlinear Programming, section 3.2.

use super::super::conic::{ConicPoint, ConicProgram, product};
use super::super::consistent::Equilibrated;
use super::ForceBounds;
use crate::arithmetic::{Scalar, derivatives};
use nalgebra::{DMatrix, DVector};

/// Newton steps beyond the order of the derivatives: the programme ends where sᵀ z is rounding, and knows the directions of forces on the border of a
/// cone to its root only.
const MORE_STEPS: usize = 2;

impl<T: Scalar> ForceBounds<T> {
    /// The derivatives of the shares that solve `program`, beside their values.
    pub(super) fn slopes(&self, program: &ConicProgram, point: &ConicPoint) -> DVector<T> {
        let (count, forces) = (self.values.len(), self.basis.nrows());
        let mut changes = DMatrix::from_element(forces, count, T::zero());
        let mut values = DVector::from_element(count, T::zero());
        for (cone, &size) in self.cones.iter().zip(&self.sizes) {
            for row in cone.rows() {
                let (change, value) = &self.exact[row];
                let size = T::from_f64(size);
                changes.set_column(row, &change.map(|x| x / size));
                values[row] = derivatives(*value / size) + T::from_f64(program.b[row]);
            }
        }
        let square = T::from_f64(self.unit * self.unit);
        let responses = changes.tr_mul(&changes) * square;
        let mut z = point.z.map(T::from_f64);
        let mut factors = Equilibrated::default();
        for _ in 0..MORE_STEPS + T::DERIVATIVES {
            let s = &values + &responses * &z;
            factors.factor(&mut jacobian(program, &s, &z), count);
            let mut missed = product(&program.cones, &s, &z);
            factors.solve(missed.as_mut_slice());
            z -= missed;
        }
        (changes * z * square).map(derivatives)
    }
}

/// How s ∘ z changes with z, row by row, but for derivatives.
fn jacobian<T: Scalar>(program: &ConicProgram, s: &DVector<T>, z: &DVector<T>) -> Vec<T> {
    let (s, z) = (s.map(T::value), z.map(T::value));
    let responses = &program.a * program.a.transpose();
    let unit = DMatrix::<f64>::identity(z.len(), z.len());
    let columns = responses.column_iter().zip(unit.column_iter());
    let columns = columns.map(|(response, unit)| {
        product(&program.cones, &response.into_owned(), &z)
            + product(&program.cones, &s, &unit.into_owned())
    });
    let jacobian = DMatrix::from_columns(&columns.collect::<Vec<_>>());
    // A transposed matrix has its rows one after another.
    let rows = jacobian.transpose();
    rows.iter().map(|&x| T::from_f64(x)).collect()
}

#[cfg(test)]
mod tests {
    use super::super::ForceBounds;
    use crate::arithmetic::{Dual, Scalar};
    use crate::linear::{Rank, least_norm};

    /// Numbers with their second derivatives.
    type Number = Dual<Dual<f64, 3>, 3>;

    fn seeded(p: [f64; 3]) -> [Number; 3] {
        core::array::from_fn(|i| Number::variable(Dual::variable(p[i], i), i))
    }

    #[track_caller]
    fn same(a: Number, b: Number) {
        let numbers = |x: Number| {
            let seconds = x.derivative.into_iter().flat_map(|x| x.derivative);
            let firsts = x.value.derivative.into_iter();
            firsts.chain(seconds).collect::<Vec<_>>()
        };
        for (a, b) in numbers(a).into_iter().zip(numbers(b)) {
            assert!((a - b).abs() <= 1e-11 * (1.0 + b.abs()), "{a} for {b}");
        }
    }

    #[test]
    fn a_friction_at_its_limit_turns_with_the_pull() {
        // Two frictions f + g hold the pull (x, y), and |f| ≤ r: f = r (x, y)/|(x, y)|, also where half the pull is far beyond r.
        for p in [[3.0, 2.0, 1.5], [30.0, -20.0, 0.5]] {
            let [x, y, r] = seeded(p);
            let [zero, half, one] = [0.0, 0.5, 1.0].map(Number::from_f64);
            let columns = [one, zero, zero, one, one, zero, zero, one];
            let mut forces = [x, y, x, y].map(|pull| pull * half);
            let freedom = least_norm(&columns, 2, Rank::Known(2), &mut forces);
            let mut bounds = ForceBounds::default();
            let cone = [
                (&[][..], r),
                (&[(0, one)][..], zero),
                (&[(1, one)][..], zero),
            ];
            assert!(bounds.add(cone, &forces, &freedom, || 0.0));
            bounds.complete();
            let shares = bounds.shares(0.0).expect("half the pull is too much");
            let length = (x * x + y * y).sqrt();
            let expected = [x, y].map(|pull| pull * r / length);
            for (k, expected) in expected.into_iter().enumerate() {
                same(forces[k] + shares[k], expected);
                same(forces[k + 2] + shares[k + 2], [x, y][k] - expected);
            }
        }
    }

    #[test]
    fn more_bounds_than_there_is_freedom_leave_no_share_open() {
        // Three feet at 0, 1 and 2 under a load at 2, which is all on the last: the other two are at their bounds, and one force is free.
        let [load, ..] = seeded([3.0, 0.0, 0.0]);
        let (zero, one) = (Number::from_f64(0.0), Number::from_f64(1.0));
        let columns = [one, zero, one, one, one, one + one];
        let mut forces = [zero, zero, load];
        let freedom = least_norm(&columns, 2, Rank::Known(2), &mut forces);
        let mut bounds = ForceBounds::default();
        for k in 0..3 {
            let pushes = [(&[(k, one)][..], zero)];
            assert!(bounds.add(pushes, &forces, &freedom, || 0.0));
        }
        bounds.complete();
        let shares = bounds.shares(0.0).expect("one pulls");
        for (k, expected) in [zero, zero, load].into_iter().enumerate() {
            same(forces[k] + shares[k], expected);
        }
    }
}
