//! Frictions that several constraints press together: N = √ΣΛ², the impulse of a bearing.
//!
//! The rows of the constraints are turned so that the first one has the direction u of the impulse, and the others none: N is then |Λ| of one row.

use crate::arithmetic::Scalar;
use crate::linear::direction::{Vector, length};

/// Rows that press together, two or three.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Bearing {
    rows: [usize; 3],
    count: usize,
}

/// Orthonormal axes, as many as there are rows; the first is u.
pub(super) type Axes<T> = [Vector<T>; 3];

impl Bearing {
    /// Of these rows, if all are there.
    pub fn of(rows: &mut dyn Iterator<Item = Option<usize>>) -> Option<Self> {
        let mut bearing = Self {
            rows: [0; 3],
            count: 0,
        };
        for row in rows {
            *bearing.rows.get_mut(bearing.count)? = row?;
            bearing.count += 1;
        }
        (bearing.count > 0).then_some(bearing)
    }

    /// The row that takes the direction of the impulse.
    pub fn first(&self) -> usize {
        self.rows[0]
    }

    pub fn rows(&self) -> &[usize] {
        &self.rows[..self.count]
    }

    /// Turns numbers of rows, `stride` apart, to the axes or `back` from them.
    pub fn turn<T: Scalar>(&self, axes: &Axes<T>, numbers: &mut [T], stride: usize, back: bool) {
        let held = self.rows.map(|row| numbers[row * stride]);
        for (i, &row) in self.rows().iter().enumerate() {
            let mut sum = T::zero();
            for (j, &x) in held[..self.count].iter().enumerate() {
                sum += if back { axes[j][i] } else { axes[i][j] } * x;
            }
            numbers[row * stride] = sum;
        }
    }

    /// The impulse in the rows.
    pub fn impulse<T: Scalar>(&self, impulses: &[T]) -> Vector<T> {
        let mut impulse = [T::zero(); 3];
        for (x, &row) in impulse.iter_mut().zip(self.rows()) {
            *x = impulses[row];
        }
        impulse
    }

    /// Axes whose first is along `u`, which is no longer than it has elements.
    pub fn axes<T: Scalar>(&self, u: Vector<T>) -> Axes<T> {
        let mut axes = [u, [T::zero(); 3], [T::zero(); 3]];
        if self.count == 2 {
            axes[1] = [-u[1], u[0], T::zero()];
            return axes;
        }
        // The unit vector most across of u, made orthogonal; then the product of both.
        let least = (0..3).min_by(|&i, &j| {
            let size = |k: usize| u[k].value().abs();
            size(i).total_cmp(&size(j))
        });
        let least = least.unwrap_or(0);
        let mut across = u.map(|x| -u[least] * x);
        across[least] += T::one();
        let length = length(across);
        axes[1] = across.map(|x| x / length);
        let [a, b] = [axes[0], axes[1]];
        axes[2] = [(1, 2), (2, 0), (0, 1)].map(|(i, j)| a[i] * b[j] - a[j] * b[i]);
        axes
    }
}
