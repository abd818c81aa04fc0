//! A dense system that may have dependent rows: equilibrated, complete pivoting, solved for any number of right-hand sides.

use super::lu::Lu;
use crate::arithmetic::Scalar;

/// What contradictory equations leave over is more than this share of the right-hand side.
const CONTRADICTION: f64 = 1e-9;

/// Factors of a square matrix with rows and columns scaled to about 1; the memory is reused.
#[derive(Clone, Debug, Default)]
pub(crate) struct Equilibrated<T> {
    lu: Lu<T>,
    size: usize,
    row_scale: Vec<f64>,
    column_scale: Vec<f64>,
}

impl<T: Scalar> Equilibrated<T> {
    /// Factors the row-major `matrix` (`size` × `size`), which is scaled in place.
    pub(crate) fn factor(&mut self, matrix: &mut [T], size: usize) {
        let inverse = |largest: f64| if largest > 0.0 { 1.0 / largest } else { 1.0 };
        self.size = size;
        self.row_scale.clear();
        self.column_scale.clear();
        for row in matrix.chunks_exact_mut(size.max(1)) {
            let scale = inverse(row.iter().map(|x| x.value().abs()).fold(0.0, f64::max));
            row.iter_mut().for_each(|x| *x *= T::from_f64(scale));
            self.row_scale.push(scale);
        }
        for j in 0..size {
            let column = (0..size).map(|i| matrix[i * size + j].value().abs());
            let scale = inverse(column.fold(0.0, f64::max));
            (0..size).for_each(|i| matrix[i * size + j] *= T::from_f64(scale));
            self.column_scale.push(scale);
        }
        self.lu.factor(size, |i, row| {
            row.copy_from_slice(&matrix[i * size..][..size])
        });
    }

    /// How many rows are independent.
    pub(crate) fn rank(&self) -> usize {
        self.lu.rank()
    }

    /// Whether rows depend on each other.
    pub(crate) fn is_deficient(&self) -> bool {
        self.rank() < self.size
    }

    /// Gives each row that depends on others as a combination of those: the row, one of these, and its factor.
    pub(crate) fn combine(&self, mut put: impl FnMut(usize, usize, T)) {
        let scale = &self.row_scale;
        self.lu
            .combine(|i, k, factor| put(i, k, factor * T::from_f64(scale[k] / scale[i])));
    }

    /// Replaces b by x. Where rows depend on each other the superfluous unknowns are 0. False if the system contradicts
    /// itself, or x is not finite.
    pub(crate) fn solve(&mut self, b: &mut [T]) -> bool {
        let mut largest = 0.0;
        for (b, scale) in b.iter_mut().zip(&self.row_scale) {
            *b *= T::from_f64(*scale);
            largest = f64::max(largest, b.value().abs());
        }
        let left_out = self.lu.solve_part(b);
        for (x, scale) in b.iter_mut().zip(&self.column_scale) {
            *x *= T::from_f64(*scale);
        }
        left_out <= CONTRADICTION * largest && b.iter().all(|x| x.value().is_finite())
    }
}

#[cfg(test)]
mod tests {
    use super::Equilibrated;

    #[test]
    fn a_repeated_row_leaves_its_unknown_at_zero() {
        // x + y = 3 twice, x − y = 1.
        let mut matrix = [1.0, 1.0, 0.0, 1.0, 1.0, 0.0, 1.0, -1.0, 0.0];
        let mut right = [3.0, 3.0, 1.0];
        let mut factors = Equilibrated::default();
        factors.factor(&mut matrix, 3);
        assert!(factors.is_deficient() && factors.solve(&mut right));
        assert!((right[0] - 2.0_f64).abs() < 1e-15 && (right[1] - 1.0_f64).abs() < 1e-15);
        assert_eq!(right[2], 0.0);
    }

    #[test]
    fn a_contradiction_is_refused() {
        let mut factors = Equilibrated::default();
        factors.factor(&mut [1.0, 1.0, 1.0, 1.0], 2);
        assert!(!factors.solve(&mut [1.0, 2.0]));
    }
}
