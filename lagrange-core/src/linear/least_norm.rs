//! Forces that are not determined: of all that have the same effect, those of least norm.
//!
//! Where rows depend on one another, C λ = Q leaves λ open. With B an independent subset of the rows of C that spans them all,
//!
//! ```text
//! λ = Bᵀ (B Bᵀ)⁻¹ Q_B        λᵢ is determined where (Bᵀ (B Bᵀ)⁻¹ B)ᵢᵢ = 1
//! ```
//!
//! Reference: Golub & Van Loan 2013, Matrix Computations, section 5.6.

use super::lu::Lu;
use crate::arithmetic::Scalar;

/// A diagonal element of the projector this close to 1 is 1.
const DETERMINED: f64 = 1e-9;

/// Replaces `forces` by those of least norm with the same effect, and says which were determined all along. `columns` is C by
/// columns: the generalized force of each unit force, `coordinates` elements each.
pub(crate) fn least_norm<T: Scalar>(
    columns: &[T],
    coordinates: usize,
    forces: &mut [T],
) -> Vec<bool> {
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
    let b = |i: usize, j: usize| scales[basis[i]] * element(basis[i], j);
    let dot = |f: &dyn Fn(usize) -> T| (0..m).fold(T::zero(), |sum, j| sum + f(j));
    let gram = (0..rank * rank).map(|at| dot(&|j| b(at / rank, j) * b(at % rank, j)));
    lu.factor(rank, gram.collect::<Vec<_>>().into_iter());
    let mut effect: Vec<T> = (0..rank).map(|i| dot(&|j| b(i, j) * forces[j])).collect();
    lu.solve(&mut effect);
    let mut determined = Vec::with_capacity(m);
    for (j, force) in forces.iter_mut().enumerate() {
        *force = (0..rank).fold(T::zero(), |sum, i| sum + b(i, j) * effect[i]);
        let mut column: Vec<T> = (0..rank).map(|i| b(i, j)).collect();
        lu.solve(&mut column);
        let share = (0..rank).fold(T::zero(), |sum, i| sum + b(i, j) * column[i]);
        determined.push((share.value() - 1.0).abs() <= DETERMINED);
    }
    determined
}

#[cfg(test)]
mod tests {
    use super::least_norm;

    #[test]
    fn equal_rods_share_and_another_keeps_its_force() {
        // Forces 0 and 1 along x, force 2 along y and force 3 none.
        let columns = [1.0, 0.0, 2.0, 0.0, 0.0, 3.0, 0.0, 0.0];
        let mut forces = [5.0, 0.0, 7.0, 1.0];
        let determined = least_norm(&columns, 2, &mut forces);
        // Least norm of λ₀ + 2 λ₁ = 5.
        for (found, expected) in forces.into_iter().zip([1.0_f64, 2.0, 7.0, 0.0]) {
            assert!((found - expected).abs() < 1e-14, "{forces:?}");
        }
        assert_eq!(determined, [false, false, true, false]);
    }
}
