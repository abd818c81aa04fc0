//! Forces that are not determined: of all that have the same effect, those of least norm.
//!
//! Where rows depend on one another, C λ = Q leaves λ open. With B an independent subset of the rows of C that spans them all,
//!
//! ```text
//! λ = Bᵀ (B Bᵀ)⁻¹ Q_B        λᵢ is determined where (Bᵀ (B Bᵀ)⁻¹ B)ᵢᵢ = 1, that is Pᵢᵢ = 0
//! ```
//!
//! Reference: Golub & Van Loan 2013, Matrix Computations, section 5.6.

use super::direct::dot;
use super::lu::Lu;
use crate::arithmetic::Scalar;

/// Forces that have no effect, as the row-major projector P = 1 − Bᵀ (B Bᵀ)⁻¹ B onto them: λ is as good as λ + P y.
#[derive(Clone, Debug, Default)]
pub(crate) struct Freedom {
    size: usize,
    projector: Vec<f64>,
}

/// A force that can be changed by no more than this share of a change is determined.
const DETERMINED: f64 = 1e-9;

impl Freedom {
    /// Row `i` of P.
    pub(crate) fn row(&self, i: usize) -> &[f64] {
        &self.projector[i * self.size..(i + 1) * self.size]
    }

    /// Whether force `i` is determined.
    pub(crate) fn is_determined(&self, i: usize) -> bool {
        self.row(i)[i] <= DETERMINED
    }

    /// How many forces can be chosen: the trace of P.
    pub(crate) fn dimension(&self) -> usize {
        let trace: f64 = (0..self.size).map(|i| self.row(i)[i]).sum();
        trace.round() as usize
    }
}

/// Replaces `forces` by those of least norm with the same effect, and says how else they could be. `columns` is C by
/// columns: the generalized force of each unit force, `coordinates` elements each.
pub(crate) fn least_norm<T: Scalar>(
    columns: &[T],
    coordinates: usize,
    forces: &mut [T],
) -> Freedom {
    let (n, m) = (coordinates, forces.len());
    let element = |i: usize, j: usize| columns[j * n + i];
    // Square with zeros, so that the same factorization serves; rows scaled to 1.
    let wide = n.max(m);
    let scales: Vec<T> = (0..n)
        .map(|i| {
            let largest = (0..m)
                .map(|j| element(i, j).value().abs())
                .fold(0.0, f64::max);
            T::from_f64(if largest > 0.0 { 1.0 / largest } else { 0.0 })
        })
        .collect();
    let mut lu = Lu::default();
    let padded = (0..wide * wide).map(|at| match (at / wide, at % wide) {
        (i, j) if i < n && j < m => scales[i] * element(i, j),
        _ => T::zero(),
    });
    lu.factor(wide, padded);
    let basis: Vec<usize> = lu.independent_rows().collect();
    let rank = basis.len();
    // By columns.
    let mut b = Vec::with_capacity(rank * m);
    for j in 0..m {
        b.extend(basis.iter().map(|&i| scales[i] * element(i, j)));
    }
    let mut gram = vec![T::zero(); rank * rank];
    let mut effect = vec![T::zero(); rank];
    for (column, &force) in b.chunks_exact(rank.max(1)).zip(&*forces) {
        for (i, &x) in column.iter().enumerate().filter(|(_, x)| !x.is_zero()) {
            effect[i] += x * force;
            for (sum, &y) in gram[i * rank..].iter_mut().zip(column) {
                *sum += x * y;
            }
        }
    }
    lu.factor(rank, gram.into_iter());
    lu.solve(&mut effect);
    let mut freedom = Freedom {
        size: m,
        projector: vec![0.0; m * m],
    };
    let mut solved = vec![T::zero(); rank];
    for (j, force) in forces.iter_mut().enumerate() {
        let column = &b[j * rank..(j + 1) * rank];
        *force = dot(column, &effect);
        solved.copy_from_slice(column);
        lu.solve(&mut solved);
        for i in 0..m {
            let share = dot(&b[i * rank..(i + 1) * rank], &solved).value();
            freedom.projector[i * m + j] = if i == j { 1.0 - share } else { -share };
        }
    }
    freedom
}

#[cfg(test)]
mod tests {
    use super::least_norm;

    #[test]
    fn equal_rods_share_and_another_keeps_its_force() {
        // Forces 0 and 1 along x, force 2 along y and force 3 none.
        let columns = [1.0, 0.0, 2.0, 0.0, 0.0, 3.0, 0.0, 0.0];
        let mut forces = [5.0, 0.0, 7.0, 1.0];
        let freedom = least_norm(&columns, 2, &mut forces);
        // Least norm of λ₀ + 2 λ₁ = 5.
        for (found, expected) in forces.into_iter().zip([1.0_f64, 2.0, 7.0, 0.0]) {
            assert!((found - expected).abs() < 1e-14, "{forces:?}");
        }
        let determined: Vec<bool> = (0..4).map(|i| freedom.is_determined(i)).collect();
        assert_eq!(determined, [false, false, true, false]);
        // What changes nothing: 2 λ₀ − λ₁, and λ₃.
        for (found, expected) in freedom.row(0).iter().zip([0.8, -0.4, 0.0, 0.0]) {
            assert!((found - expected).abs() < 1e-14);
        }
    }
}
