//! Rows that depend on parameters only leave the system when the mode is set.
//!
//! A row a v̇ = 0 with constant a (a pinned coordinate, rolling on a constant radius, sticking) says once and for all how
//! some accelerations follow from the others. With all such rows A v̇ = 0 and the constant columns C of their multipliers,
//!
//! ```text
//! v̇ = Z u̇        A Z = 0        Wᵀ C = 0        Wᵀ M Z u̇ = Wᵀ f + …        λ = Gᵀ (M Z u̇ − f − …)
//! ```
//!
//! u̇ are the accelerations of the coordinates that are left, Gᵀ C = 1. Without sliding friction C = Aᵀ and W = Z.
//! Reference: null-space (coordinate partitioning) method, Wehage & Haug 1982, J. Mech. Design 104.

use super::lu::negligible;
use crate::arithmetic::Scalar;

/// A pivot below this share of the largest element is not chosen.
const MUCH_SMALLER: f64 = 1e-3;

/// A sparse matrix by rows.
#[derive(Clone, Debug, Default)]
pub(crate) struct Sparse<T> {
    ends: Vec<usize>,
    items: Vec<(usize, T)>,
}

impl<T: Scalar> Sparse<T> {
    fn clear(&mut self) {
        self.ends.clear();
        self.items.clear();
    }

    fn push(&mut self, column: usize, value: T) {
        if !value.is_zero() {
            self.items.push((column, value));
        }
    }

    fn end_row(&mut self) {
        self.ends.push(self.items.len());
    }

    /// All elements, row by row.
    pub(crate) fn values(&self) -> impl Iterator<Item = T> + '_ {
        self.items.iter().map(|&(_, value)| value)
    }

    /// Whether it has its elements where another has them.
    fn is_like(&self, other: &Self) -> bool {
        let mut items = self.items.iter().zip(&other.items);
        self.ends == other.ends && items.all(|(x, y)| x.0 == y.0)
    }

    /// The elements of a row: (column, value).
    #[inline]
    pub(crate) fn row(&self, index: usize) -> &[(usize, T)] {
        let start = if index == 0 { 0 } else { self.ends[index - 1] };
        &self.items[start..self.ends[index]]
    }
}

/// Reduced row echelon form of a constant matrix, and the combinations of its rows that lead there.
#[derive(Clone, Debug, Default)]
struct Echelon<T> {
    width: usize,
    height: usize,
    /// [R | B⁻¹] with R = B⁻¹ A, by rows.
    rows: Vec<T>,
    /// Pivot column of each row; none for a row that depends on those above.
    pivots: Vec<Option<usize>>,
}

impl<T: Scalar> Echelon<T> {
    /// Reduces a row-major matrix with `height` rows of `width`; earlier rows take precedence over later ones. Pivots are the largest elements, or
    /// those of the columns `like` where these are not much smaller.
    fn set(&mut self, matrix: &[T], height: usize, width: usize, like: &[Option<usize>]) {
        let total = width + height;
        (self.width, self.height) = (width, height);
        self.rows.clear();
        self.rows.resize(height * total, T::zero());
        self.pivots.clear();
        for i in 0..height {
            let given = &matrix[i * width..(i + 1) * width];
            let (_, size) = largest(given);
            self.rows[i * total..i * total + width].copy_from_slice(given);
            self.rows[i * total + width + i] = T::one();
            for above in 0..i {
                if let Some(pivot) = self.pivots[above] {
                    self.subtract(i, above, pivot);
                }
            }
            let row = &self.rows[i * total..i * total + width];
            let (pivot, left) = largest(row);
            // Not "<=": a NaN is no pivot either.
            if !(left > negligible::<T>() * size) {
                self.pivots.push(None);
                continue;
            }
            let like = like.get(i).copied().flatten();
            let like = like.filter(|&j| row[j].value().abs() >= MUCH_SMALLER * left);
            let pivot = like.unwrap_or(pivot);
            self.pivots.push(Some(pivot));
            let inverse = T::one() / self.rows[i * total + pivot];
            self.rows[i * total..(i + 1) * total]
                .iter_mut()
                .for_each(|x| *x *= inverse);
            self.rows[i * total + pivot] = T::one();
            for above in 0..i {
                if self.pivots[above].is_some() {
                    self.subtract(above, i, pivot);
                }
            }
        }
    }

    /// Subtracts the multiple of row `by` that takes the element of row `from` at `pivot` away.
    fn subtract(&mut self, from: usize, by: usize, pivot: usize) {
        let total = self.width + self.height;
        let factor = self.rows[from * total + pivot];
        if factor.is_zero() {
            return;
        }
        for j in 0..total {
            let x = self.rows[by * total + j];
            self.rows[from * total + j] -= factor * x;
        }
        self.rows[from * total + pivot] = T::zero();
    }

    fn pivot_row(&self, column: usize) -> Option<usize> {
        self.pivots.iter().position(|&pivot| pivot == Some(column))
    }

    /// Element of R.
    fn reduced(&self, row: usize, column: usize) -> T {
        self.rows[row * (self.width + self.height) + column]
    }

    /// Element of B⁻¹.
    fn inverse(&self, row: usize, column: usize) -> T {
        self.rows[row * (self.width + self.height) + self.width + column]
    }
}

/// Where a row is largest, and how large.
fn largest<T: Scalar>(row: &[T]) -> (usize, f64) {
    let sizes = row.iter().map(|x| x.value().abs()).enumerate();
    sizes.fold(
        (0, 0.0),
        |best, (j, size)| if size > best.1 { (j, size) } else { best },
    )
}

/// How accelerations and equations are combined once constant rows are eliminated.
#[derive(Clone, Debug, Default)]
pub(crate) struct Elimination<T> {
    accelerations: Echelon<T>,
    forces: Echelon<T>,
    /// Coordinates whose accelerations are left.
    pub free: Vec<usize>,
    /// Coordinates whose equations are left.
    equations: Vec<usize>,
    /// Z by coordinates: v̇ⱼ = Σ value · u̇[column].
    pub right: Sparse<T>,
    /// Wᵀ and Gᵀ by coordinates: equation j goes into equation `column` with factor `value`; columns from
    /// `free.len() + extra` on are the forces of the eliminated rows.
    pub left: Sparse<T>,
    /// Whether W = Z.
    pub symmetric: bool,
}

impl<T: Scalar> Elimination<T> {
    /// Whether it eliminates what another does.
    pub(crate) fn is_like(&self, other: &Self) -> bool {
        self.free == other.free
            && self.symmetric == other.symmetric
            && self.right.is_like(&other.right)
    }

    /// v̇ⱼ from a solution.
    #[inline]
    pub(crate) fn acceleration(&self, j: usize, solution: &[T]) -> T {
        match *self.right.row(j) {
            [(column, factor)] => factor * solution[column],
            ref row => row.iter().fold(T::zero(), |sum, &(column, factor)| {
                sum + factor * solution[column]
            }),
        }
    }

    /// Which of the constant rows in `a` (row-major, `n` wide) depend on earlier ones.
    pub(crate) fn dependent(&mut self, a: &[T], n: usize, dependent: &mut Vec<bool>) {
        self.accelerations.set(a, a.len() / n.max(1), n, &[]);
        dependent.clear();
        dependent.extend(self.accelerations.pivots.iter().map(Option::is_none));
    }

    /// Eliminates the independent constant rows `a` with the columns `c` of their forces (both row-major, `n` wide, one row
    /// a force). `extra` equations stay beside those of motion. False if the columns depend on each other: then nothing
    /// can be eliminated this way.
    pub(crate) fn set(
        &mut self,
        a: &[T],
        c: &[T],
        n: usize,
        symmetric: bool,
        extra: usize,
    ) -> bool {
        let height = a.len() / n.max(1);
        self.symmetric = symmetric;
        self.accelerations.set(a, height, n, &[]);
        // A friction carries the force of its own normal equation into others, where that force may be nothing beside their own loads.
        self.forces.set(c, height, n, &self.accelerations.pivots);
        if self.forces.pivots.iter().any(Option::is_none) {
            return false;
        }
        let Self {
            accelerations,
            forces,
            free,
            equations,
            right,
            left,
            ..
        } = self;
        free.clear();
        free.extend((0..n).filter(|&j| accelerations.pivot_row(j).is_none()));
        equations.clear();
        equations.extend((0..n).filter(|&j| forces.pivot_row(j).is_none()));
        right.clear();
        for j in 0..n {
            match accelerations.pivot_row(j) {
                None => right.push(free.iter().filter(|&&f| f < j).count(), T::one()),
                Some(row) => {
                    for (index, &f) in free.iter().enumerate() {
                        right.push(index, -accelerations.reduced(row, f));
                    }
                }
            }
            right.end_row();
        }
        let size = free.len() + extra;
        left.clear();
        for j in 0..n {
            match forces.pivot_row(j) {
                None => left.push(equations.iter().filter(|&&f| f < j).count(), T::one()),
                Some(row) => {
                    for (index, &f) in equations.iter().enumerate() {
                        left.push(index, -forces.reduced(row, f));
                    }
                    for force in 0..height {
                        left.push(size + force, forces.inverse(row, force));
                    }
                }
            }
            left.end_row();
        }
        true
    }
}
