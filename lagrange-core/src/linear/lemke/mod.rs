//! Linear complementarity: w = M z + q, w ≥ 0, z ≥ 0, wᵀ z = 0, by Lemke's method.
//!
//! With an artificial unknown z₀, w = M z + 1 z₀ + q is feasible at once; complementary pivots then drive z₀ out. Ties are
//! broken lexicographically (q perturbed by ε, ε², …), so that no basis comes back. For copositive plus M (positive
//! semidefinite, or contacts with friction in the form of Stewart & Trinkle) an end on a ray says that no solution exists.
//!
//! References: Lemke 1965, Management Science 11, 681; Cottle, Pang & Stone 1992, The Linear Complementarity Problem,
//! sections 4.4 and 4.9. The dictionary holds the nonbasic columns only: O(n²) a pivot.

#[cfg(test)]
mod tests;

use super::lu::inverse_root;

/// After equilibration smaller elements are rounding and no pivots.
const NEGLIGIBLE: f64 = 1e-11;

/// Ratios closer than this are equal, and the perturbation decides.
const TIE: f64 = 1e-12;

/// How a search has ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Outcome {
    /// [`Lemke::z`] solves the problem.
    Solved,
    /// No pivot is left: for copositive plus matrices there is no solution.
    Ray,
    /// Too many pivots.
    Limit,
}

/// An unknown of the dictionary.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Unknown {
    W(usize),
    Z(usize),
    Artificial,
}

impl Unknown {
    /// The one that is zero where this one is not.
    fn complement(self) -> Self {
        match self {
            Unknown::W(i) => Unknown::Z(i),
            Unknown::Z(i) => Unknown::W(i),
            Unknown::Artificial => Unknown::Artificial,
        }
    }
}

/// The dictionary basic = constant + coefficients · nonbasic; the memory is reused.
#[derive(Clone, Debug, Default)]
pub(crate) struct Lemke {
    size: usize,
    /// Row-major, `size` × (`size` + 1).
    coefficients: Vec<f64>,
    constants: Vec<f64>,
    basic: Vec<Unknown>,
    nonbasic: Vec<Unknown>,
    row_scale: Vec<f64>,
    column_scale: Vec<f64>,
    z: Vec<f64>,
    pivot_row: Vec<f64>,
    tied: Vec<usize>,
}

impl Lemke {
    /// Solves for the row-major `matrix` (size × size) and `q`.
    pub(crate) fn solve(&mut self, matrix: &[f64], q: &[f64]) -> Outcome {
        self.begin(matrix, q);
        let outcome = self.search();
        self.z.clear();
        self.z.resize(self.size, 0.0);
        if outcome == Outcome::Solved {
            let largest = q
                .iter()
                .zip(&self.row_scale)
                .fold(0.0_f64, |m, (q, r)| m.max((q * r).abs()));
            for (unknown, &x) in self.basic.iter().zip(&self.constants) {
                if let Unknown::Z(i) = *unknown {
                    self.z[i] = x.max(0.0) * self.column_scale[i] * largest;
                }
            }
        }
        outcome
    }

    /// The solution found last.
    pub(crate) fn z(&self) -> &[f64] {
        &self.z
    }

    /// Whether w rather than z vanishes in pair `i` of the solution found last; tells where both are zero.
    pub(crate) fn is_active(&self, i: usize) -> bool {
        self.basic.contains(&Unknown::Z(i))
    }

    /// Takes a problem, rows and columns scaled to about 1: that only stretches w and z.
    fn begin(&mut self, matrix: &[f64], q: &[f64]) {
        let n = q.len();
        self.size = n;
        self.row_scale.clear();
        self.row_scale.resize(n, 1.0);
        self.column_scale.clear();
        self.column_scale.resize(n, 1.0);
        for _ in 0..3 {
            for i in 0..n {
                let row = (0..n).map(|j| (matrix[i * n + j] * self.column_scale[j]).abs());
                let largest = row.fold(0.0, f64::max) * self.row_scale[i];
                self.row_scale[i] *= inverse_root(largest);
            }
            for j in 0..n {
                let column = (0..n).map(|i| (matrix[i * n + j] * self.row_scale[i]).abs());
                let largest = column.fold(0.0, f64::max) * self.column_scale[j];
                self.column_scale[j] *= inverse_root(largest);
            }
        }
        self.constants.clear();
        let scaled = q.iter().zip(&self.row_scale).map(|(q, r)| q * r);
        self.constants.extend(scaled);
        let largest = self.constants.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        if largest > 0.0 {
            self.constants.iter_mut().for_each(|x| *x /= largest);
        }
        self.coefficients.clear();
        for i in 0..n {
            let row = &matrix[i * n..(i + 1) * n];
            let scaled = row.iter().zip(&self.column_scale);
            let r = self.row_scale[i];
            self.coefficients.extend(scaled.map(|(m, c)| r * m * c));
            self.coefficients.push(1.0);
        }
        self.basic.clear();
        self.basic.extend((0..n).map(Unknown::W));
        self.nonbasic.clear();
        self.nonbasic.extend((0..n).map(Unknown::Z));
        self.nonbasic.push(Unknown::Artificial);
    }

    fn search(&mut self) -> Outcome {
        let n = self.size;
        // The most negative constant; of equal ones the last, whose perturbation is smallest.
        let mut worst: Option<usize> = None;
        for (i, &x) in self.constants.iter().enumerate() {
            if x < 0.0 && worst.is_none_or(|w| x <= self.constants[w]) {
                worst = Some(i);
            }
        }
        let Some(mut row) = worst else {
            return Outcome::Solved;
        };
        let mut column = n;
        for _ in 0..50 + 20 * n {
            let left = self.basic[row];
            self.pivot(row, column);
            if left == Unknown::Artificial {
                return Outcome::Solved;
            }
            let entering = left.complement();
            match self.nonbasic.iter().position(|&x| x == entering) {
                Some(at) => column = at,
                None => return Outcome::Limit,
            }
            match self.blocking(column) {
                Some(at) => row = at,
                None => return Outcome::Ray,
            }
        }
        Outcome::Limit
    }

    /// The basic unknown that reaches zero first when the nonbasic unknown `column` grows.
    fn blocking(&mut self, column: usize) -> Option<usize> {
        let width = self.size + 1;
        let ratio = |i: usize| {
            let slope = self.coefficients[i * width + column];
            (slope < -NEGLIGIBLE).then(|| self.constants[i].max(0.0) / -slope)
        };
        let least = (0..self.size).filter_map(ratio).reduce(f64::min)?;
        let near = least + TIE * (1.0 + least);
        let mut tied = core::mem::take(&mut self.tied);
        tied.clear();
        tied.extend((0..self.size).filter(|&i| ratio(i).is_some_and(|r| r <= near)));
        let artificial = tied
            .iter()
            .copied()
            .find(|&i| self.basic[i] == Unknown::Artificial);
        let blocking = artificial.or_else(|| {
            // One column of the perturbation after the other.
            for k in 0..self.size {
                if tied.len() <= 1 {
                    break;
                }
                let share =
                    |i: &usize| self.perturbation(*i, k) / -self.coefficients[*i * width + column];
                let least = tied.iter().map(share).reduce(f64::min)?;
                tied.retain(|i| share(i) <= least + TIE * (1.0 + least.abs()));
            }
            tied.first().copied()
        });
        self.tied = tied;
        blocking
    }

    /// How basic unknown `row` depends on q[k].
    fn perturbation(&self, row: usize, k: usize) -> f64 {
        let w = Unknown::W(k);
        match self.nonbasic.iter().position(|&x| x == w) {
            Some(column) => -self.coefficients[row * (self.size + 1) + column],
            None => f64::from(u8::from(self.basic[row] == w)),
        }
    }

    /// Exchanges basic unknown `row` and nonbasic unknown `column`.
    fn pivot(&mut self, row: usize, column: usize) {
        let width = self.size + 1;
        let inverse = 1.0 / self.coefficients[row * width + column];
        self.pivot_row.clear();
        let old = &self.coefficients[row * width..(row + 1) * width];
        self.pivot_row.extend(old.iter().map(|x| -x * inverse));
        self.pivot_row[column] = inverse;
        let constant = -self.constants[row] * inverse;
        for (i, other) in self.coefficients.chunks_exact_mut(width).enumerate() {
            let factor = other[column];
            if i == row || factor == 0.0 {
                continue;
            }
            other[column] = 0.0;
            for (x, p) in other.iter_mut().zip(&self.pivot_row) {
                *x += factor * p;
            }
            self.constants[i] += factor * constant;
        }
        self.coefficients[row * width..(row + 1) * width].copy_from_slice(&self.pivot_row);
        self.constants[row] = constant;
        core::mem::swap(&mut self.basic[row], &mut self.nonbasic[column]);
    }
}
