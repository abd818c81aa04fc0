//! A dense system that may have dependent rows, solved once: Gauss with complete pivoting.

use crate::arithmetic::Scalar;

/// Pivots below this share of the largest are rounding.
const SINGULAR: f64 = 1e-12;

/// Solves `matrix` x = `right` in place (`matrix` is row-major, `size` × `size`). Where rows depend on each other the
/// superfluous unknowns are 0. False if the system contradicts itself.
pub(crate) fn solve_consistent<T: Scalar>(matrix: &mut [T], right: &mut [T], size: usize) -> bool {
    let mut columns: Vec<usize> = (0..size).collect();
    let mut first = 0.0;
    let mut rank = size;
    let scale = right.iter().fold(0.0_f64, |m, x| m.max(x.value().abs()));
    for k in 0..size {
        let mut best = (0.0, k, k);
        for i in k..size {
            for j in k..size {
                let x = matrix[i * size + j].value().abs();
                if x > best.0 {
                    best = (x, i, j);
                }
            }
        }
        let (pivot, row, column) = best;
        if k == 0 {
            first = pivot;
        }
        if pivot <= SINGULAR * first {
            rank = k;
            break;
        }
        for j in 0..size {
            matrix.swap(k * size + j, row * size + j);
        }
        right.swap(k, row);
        for i in 0..size {
            matrix.swap(i * size + k, i * size + column);
        }
        columns.swap(k, column);
        for i in k + 1..size {
            let factor = matrix[i * size + k] / matrix[k * size + k];
            for j in k..size {
                let x = matrix[k * size + j];
                matrix[i * size + j] -= factor * x;
            }
            let x = right[k];
            right[i] -= factor * x;
        }
    }
    if right[rank..].iter().any(|x| x.value().abs() > 1e-9 * scale) {
        return false;
    }
    let mut solution = vec![T::default(); size];
    for k in (0..rank).rev() {
        let sum = (k + 1..rank).fold(right[k], |sum, j| sum - matrix[k * size + j] * solution[columns[j]]);
        solution[columns[k]] = sum / matrix[k * size + k];
    }
    right.copy_from_slice(&solution);
    true
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
