//! A dense system that may have dependent rows, solved once: equilibrated, complete pivoting.

use super::lu::Lu;
use crate::arithmetic::Scalar;

/// Solves `matrix` x = `b` in place (`matrix` is row-major, `size` × `size`). Where rows depend on each other the
/// superfluous unknowns are 0. False if the system contradicts itself.
pub(crate) fn solve_consistent<T: Scalar>(matrix: &mut [T], b: &mut [T], size: usize) -> bool {
    // Rows and columns to about 1.
    let mut column_scale = vec![1.0; size];
    for i in 0..size {
        let row = &mut matrix[i * size..(i + 1) * size];
        let largest = row.iter().map(|x| x.value().abs()).fold(0.0, f64::max);
        if largest > 0.0 {
            let scale = T::from_f64(1.0 / largest);
            row.iter_mut().for_each(|x| *x *= scale);
            b[i] *= scale;
        }
    }
    for (j, scale) in column_scale.iter_mut().enumerate() {
        let largest = (0..size)
            .map(|i| matrix[i * size + j].value().abs())
            .fold(0.0, f64::max);
        if largest > 0.0 {
            *scale = 1.0 / largest;
            (0..size).for_each(|i| matrix[i * size + j] *= T::from_f64(*scale));
        }
    }
    let size_of_b = b.iter().map(|x| x.value().abs()).fold(0.0, f64::max);
    let mut lu = Lu::default();
    lu.factor(size, matrix.iter().copied());
    let left_out = lu.solve_part(b);
    for (x, scale) in b.iter_mut().zip(column_scale) {
        *x *= T::from_f64(scale);
    }
    left_out <= 1e-9 * size_of_b && b.iter().all(|x| x.value().is_finite())
}

/// A dense system that may have dependent rows, solved for several right-hand sides.
pub(crate) struct SeveralSides {
    row_scale: Vec<f64>,
    column_scale: Vec<f64>,
    lu: Lu<f64>,
}

impl SeveralSides {
    /// Factors a row-major matrix.
    pub(crate) fn new(mut matrix: Vec<f64>, size: usize) -> Self {
        let inverse = |largest: f64| if largest > 0.0 { 1.0 / largest } else { 1.0 };
        let mut row_scale = vec![1.0; size];
        let mut column_scale = vec![1.0; size];
        for (row, scale) in matrix.chunks_exact_mut(size.max(1)).zip(&mut row_scale) {
            *scale = inverse(row.iter().fold(0.0, |m: f64, x| m.max(x.abs())));
            row.iter_mut().for_each(|x| *x *= *scale);
        }
        for (j, scale) in column_scale.iter_mut().enumerate() {
            let column = (0..size).map(|i| matrix[i * size + j].abs());
            *scale = inverse(column.fold(0.0, f64::max));
            (0..size).for_each(|i| matrix[i * size + j] *= *scale);
        }
        let mut lu = Lu::default();
        lu.factor(size, matrix.into_iter());
        Self {
            row_scale,
            column_scale,
            lu,
        }
    }

    /// x for a right-hand side; superfluous unknowns are 0. Nothing if the system contradicts itself.
    pub(crate) fn solve(&mut self, mut b: Vec<f64>) -> Option<Vec<f64>> {
        let scale = |x: &mut [f64], by: &[f64]| x.iter_mut().zip(by).for_each(|(x, s)| *x *= s);
        scale(&mut b, &self.row_scale);
        let size_of_b = b.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        let left_out = self.lu.solve_part(&mut b);
        scale(&mut b, &self.column_scale);
        (left_out <= 1e-9 * size_of_b && b.iter().all(|x| x.is_finite())).then_some(b)
    }
}

#[cfg(test)]
mod tests {
    use super::solve_consistent;

    #[test]
    fn a_repeated_row_leaves_its_unknown_at_zero() {
        // x + y = 3 twice, x − y = 1.
        let mut matrix = [1.0, 1.0, 0.0, 1.0, 1.0, 0.0, 1.0, -1.0, 0.0];
        let mut right = [3.0, 3.0, 1.0];
        assert!(solve_consistent(&mut matrix, &mut right, 3));
        assert!((right[0] - 2.0_f64).abs() < 1e-15 && (right[1] - 1.0_f64).abs() < 1e-15);
        assert_eq!(right[2], 0.0);
    }

    #[test]
    fn a_contradiction_is_refused() {
        let mut matrix = [1.0, 1.0, 1.0, 1.0];
        assert!(!solve_consistent(&mut matrix, &mut [1.0, 2.0], 2));
    }
}
