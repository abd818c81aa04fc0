//! Small systems, some of whose equations may say nothing.

use crate::arithmetic::Scalar;

/// Solves a small system in place, by Gauss elimination with row exchanges. False if it is singular.
pub(crate) fn solve_small<T: Scalar>(matrix: &mut [T], right: &mut [T]) -> bool {
    let n = right.len();
    for step in 0..n {
        let size = |i: &usize| matrix[i * n + step].value().abs();
        let Some(best) = (step..n).max_by(|a, b| size(a).total_cmp(&size(b))) else {
            return false;
        };
        for j in 0..n {
            matrix.swap(step * n + j, best * n + j);
        }
        right.swap(step, best);
        let pivot = matrix[step * n + step];
        for i in (0..n).filter(|i| *i != step) {
            let factor = matrix[i * n + step] / pivot;
            for j in step..n {
                let x = matrix[step * n + j];
                matrix[i * n + j] -= factor * x;
            }
            let x = right[step];
            right[i] -= factor * x;
        }
    }
    for (i, x) in right.iter_mut().enumerate() {
        *x /= matrix[i * n + i];
    }
    right.iter().all(|x| x.value().is_finite())
}

/// Combinations of the rows of a square matrix that vanish; the memory is reused.
#[derive(Clone, Debug, Default)]
pub(crate) struct VanishingCombinations<T> {
    left: Vec<T>,
    weights: Vec<T>,
    /// Indices of rows that the others replace.
    open: Vec<usize>,
}

impl<T: Scalar> VanishingCombinations<T> {
    /// Finds those of the rows of `matrix`, which have these sizes: what is left of one that says nothing is no more than `nothing`, relative.
    pub(crate) fn find(&mut self, matrix: &[T], sizes: &[f64], nothing: f64) {
        let n = sizes.len();
        let Self {
            left,
            weights,
            open,
        } = self;
        left.clear();
        left.extend_from_slice(matrix);
        weights.clear();
        weights.resize(n * n, T::zero());
        for i in 0..n {
            weights[i * n + i] = T::one();
        }
        open.clear();
        open.extend(0..n);
        while let Some((place, column, largest)) = largest(left, open, sizes)
            && largest > nothing
        {
            let pivot = open.swap_remove(place);
            for &i in &*open {
                let factor = left[i * n + column] / left[pivot * n + column];
                for j in 0..n {
                    let (x, weight) = (left[pivot * n + j], weights[pivot * n + j]);
                    left[i * n + j] -= factor * x;
                    weights[i * n + j] -= factor * weight;
                }
                left[i * n + column] = T::zero();
            }
        }
    }

    /// Whether the rows are independent.
    pub(crate) fn is_empty(&self) -> bool {
        self.open.is_empty()
    }

    /// The weights of the rows in each, and the index of one that the others replace.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (usize, &[T])> {
        let n = self.weights.len().isqrt();
        let open = self.open.iter();
        open.map(move |&row| (row, &self.weights[row * n..(row + 1) * n]))
    }
}

/// The largest element of the rows `open` relative to their sizes: the place of its row in the list, its column, and how large it is.
fn largest<T: Scalar>(matrix: &[T], open: &[usize], sizes: &[f64]) -> Option<(usize, usize, f64)> {
    let n = sizes.len();
    let elements = open.iter().enumerate().flat_map(|(place, &i)| {
        let size =
            move |j: usize| matrix[i * n + j].value().abs() / sizes[i].max(f64::MIN_POSITIVE);
        (0..n).map(move |j| (place, j, size(j)))
    });
    elements.max_by(|x, y| x.2.total_cmp(&y.2))
}
