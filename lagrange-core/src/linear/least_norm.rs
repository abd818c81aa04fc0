//! Forces that are not determined: of all that have the same effect, those of least norm.
//!
//! Where rows depend on one another, C λ = Q leaves λ open. Any λ with that effect, projected onto the space that the rows of C span,
//! is the one of least norm. With an orthogonal basis b of that space
//!
//! ```text
//! λ₀ = Σ b (b·λ)/(b·b)        P = 1 − Σ b bᵀ/(b·b)        λᵢ is determined where Pᵢᵢ = 0
//! ```
//!
//! The basis is orthogonalized twice (Gram–Schmidt). Normal equations would square the condition: links that are nearly in line would seem
//! to leave their forces open.
//! Reference: Golub & Van Loan 2013, Matrix Computations, sections 5.2.9 and 5.6.

use super::lu::{Lu, dot, negligible};
use crate::arithmetic::Scalar;
use nalgebra::DVector;

/// Forces that have no effect, as the row-major projector P onto them: λ is as good as λ + P y.
#[derive(Clone, Debug, Default)]
pub(crate) struct Freedom<T> {
    size: usize,
    projector: Vec<T>,
    /// The same before forces were chosen; nothing if none has been.
    whole: Vec<T>,
}

/// A force that can be changed by no more than this share of a change is determined.
const DETERMINED: f64 = 1e-9;

impl<T: Scalar> Freedom<T> {
    /// Row `i` of P.
    pub(crate) fn row(&self, i: usize) -> &[T] {
        &self.projector[i * self.size..(i + 1) * self.size]
    }

    /// The same as if none had been chosen.
    pub(crate) fn whole_row(&self, i: usize) -> &[T] {
        match self.whole.is_empty() {
            true => self.row(i),
            false => &self.whole[i * self.size..(i + 1) * self.size],
        }
    }

    /// What of a linear function of the forces, (index, factor), is not determined: P a.
    pub(crate) fn part(&self, terms: &[(usize, T)]) -> DVector<T> {
        DVector::from_fn(self.size, |j, _| {
            let terms = terms.iter();
            terms.fold(T::zero(), |sum, &(i, a)| sum + a * self.row(i)[j])
        })
    }

    /// Chooses force `i`, unless it is determined: what can be chosen otherwise is what leaves it as it is. How the others follow from it, by least norm,
    /// per force.
    pub(crate) fn choose(&mut self, i: usize) -> Option<Vec<T>> {
        if self.is_determined(i) {
            return None;
        }
        if self.whole.is_empty() {
            self.whole.clone_from(&self.projector);
        }
        let square = self.row(i)[i];
        let along: Vec<T> = self.row(i).iter().map(|&x| x / square).collect();
        for (row, &part) in self.projector.chunks_exact_mut(self.size).zip(&along) {
            for (x, &y) in row.iter_mut().zip(&along) {
                *x -= part * y * square;
            }
        }
        Some(along)
    }

    /// Whether force `i` is determined.
    pub(crate) fn is_determined(&self, i: usize) -> bool {
        self.row(i)[i].value() <= DETERMINED
    }

    /// How many forces can be chosen: the trace of P.
    pub(crate) fn dimension(&self) -> usize {
        let trace: f64 = (0..self.size).map(|i| self.row(i)[i].value()).sum();
        trace.round() as usize
    }
}

/// How many columns are independent.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Rank {
    /// As many as there seem to be.
    Numerical,
    /// This number, as whoever solved for the forces knows: more seem to be where constraints that depend on one another hold to a tolerance
    /// only, and fewer where next to nothing is left of a row beside others, as in a dead centre.
    Known(usize),
}

/// Replaces `forces` by those of least norm with the same effect, and says how else they could be. `columns` is C by
/// columns: the generalized force of each unit force, `coordinates` elements each.
pub(crate) fn least_norm<T: Scalar>(
    columns: &[T],
    coordinates: usize,
    rank: Rank,
    forces: &mut [T],
) -> Freedom<T> {
    let (n, m) = (coordinates, forces.len());
    let element = |i: usize, j: usize| columns[j * n + i];
    // Square with zeros, so that the same factorization serves; columns scaled to 1. Rows keep their sizes: of one that says nothing here,
    // as those of an attitude at rest where its scalar part is 1, rounding is left, and must not stand for one that does.
    let wide = n.max(m);
    let scales: Vec<T> = (0..m)
        .map(|j| {
            let largest = (0..n)
                .map(|i| element(i, j).value().abs())
                .fold(0.0, f64::max);
            T::from_f64(if largest > 0.0 { 1.0 / largest } else { 0.0 })
        })
        .collect();
    let limits = match rank {
        Rank::Numerical => (negligible::<T>(), wide),
        Rank::Known(rank) => (0.0, rank),
    };
    let mut lu = Lu::default();
    lu.factor_to(limits, wide, |i, row| {
        if i < n {
            let scaled = scales
                .iter()
                .enumerate()
                .map(|(j, &scale)| scale * element(i, j));
            row.iter_mut()
                .zip(scaled)
                .for_each(|(x, scaled)| *x = scaled);
        }
    });
    // Each row of the basis with its square.
    let mut basis: Vec<(Vec<T>, T)> = Vec::with_capacity(n);
    for i in lu.independent_rows() {
        let mut row: Vec<T> = (0..m).map(|j| element(i, j)).collect();
        for (other, square) in basis.iter().chain(&basis) {
            let part = dot(other, &row) / *square;
            row.iter_mut().zip(other).for_each(|(x, &y)| *x -= part * y);
        }
        let square = dot(&row, &row);
        basis.push((row, square));
    }
    let parts: Vec<T> = basis
        .iter()
        .map(|(row, square)| dot(row, forces) / *square)
        .collect();
    let mut freedom = Freedom {
        size: m,
        projector: vec![T::zero(); m * m],
        whole: Vec::new(),
    };
    for (i, force) in forces.iter_mut().enumerate() {
        freedom.projector[i * m + i] = T::one();
        *force = T::zero();
        for ((row, square), &part) in basis.iter().zip(&parts) {
            *force += part * row[i];
            let share = row[i] / *square;
            let others = freedom.projector[i * m..].iter_mut().zip(row);
            others.for_each(|(x, &y)| *x -= share * y);
        }
    }
    freedom
}

#[cfg(test)]
mod tests {
    use super::{Rank, least_norm};

    #[test]
    fn equal_rods_share_and_another_keeps_its_force() {
        // Forces 0 and 1 along x, force 2 along y and force 3 none.
        let columns = [1.0, 0.0, 2.0, 0.0, 0.0, 3.0, 0.0, 0.0];
        let mut forces = [5.0, 0.0, 7.0, 1.0];
        let freedom = least_norm(&columns, 2, Rank::Numerical, &mut forces);
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

    #[test]
    fn a_force_that_is_chosen_leaves_others_to_be_chosen() {
        // Three rods share 6 along x; the first one is to carry nothing.
        let mut forces = [6.0, 0.0, 0.0];
        let mut freedom = least_norm(&[1.0, 1.0, 1.0], 1, Rank::Numerical, &mut forces);
        let along = freedom.choose(0).unwrap();
        for (found, expected) in along.into_iter().zip([1.0_f64, -0.5, -0.5]) {
            assert!((found - expected).abs() < 1e-14);
        }
        assert!(freedom.is_determined(0) && !freedom.is_determined(1));
        assert_eq!(freedom.dimension(), 1);
        freedom.choose(1).unwrap();
        assert!(freedom.choose(2).is_none());
    }

    #[test]
    fn what_rounding_leaves_of_a_row_does_not_stand_for_another() {
        // Two rods and a screw along x; along y rounding is all that there is of them.
        let columns = [1.0, 1e-17, 1.0, -3e-17, 2.0, 2e-17];
        let mut forces = [6.0_f64, 0.0, 0.0];
        let freedom = least_norm(&columns, 2, Rank::Known(1), &mut forces);
        assert_eq!(freedom.dimension(), 2);
        for (found, expected) in forces.into_iter().zip([1.0, 1.0, 2.0]) {
            assert!((found - expected).abs() < 1e-15, "{forces:?}");
        }
    }

    #[test]
    fn a_row_of_which_next_to_nothing_is_left_determines_forces_where_it_is_known_to() {
        // Two slotted links in their dead centres, and a brake on each: along the crank 1e-14 of the links acts.
        let columns = [
            1e-14, 1.0, 0.0, 3e-14, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0,
        ];
        let mut forces = [2.0_f64, 1.0, 0.0, 0.0];
        let seen = least_norm(&columns, 3, Rank::Numerical, &mut forces.clone());
        assert_eq!(seen.dimension(), 2);
        let freedom = least_norm(&columns, 3, Rank::Known(3), &mut forces);
        assert_eq!(freedom.dimension(), 1);
        // The same push along the crank.
        assert!(
            (forces[0] + 3.0 * forces[1] - 5.0).abs() < 1e-14,
            "{forces:?}"
        );
    }

    #[test]
    fn forces_of_links_nearly_in_line_are_determined() {
        // A pin and two that share a load pull at a flat joint: across it by 1e-5 of their size.
        let flat = 1e-5_f64;
        let columns = [-0.4, 1.0, 0.0, flat, flat, 0.7, 0.0, 0.0, 1.0];
        let pull = [3.0_f64, 2.0, 5.0];
        let mut forces = pull;
        let freedom = least_norm(&columns, 3, Rank::Numerical, &mut forces);
        assert_eq!(freedom.dimension(), 0);
        assert!((0..3).all(|i| freedom.row(i).iter().all(|x| x.abs() < 1e-14)));
        let off = forces.iter().zip(pull).map(|(x, y)| (x - y).abs());
        assert!(off.fold(0.0, f64::max) < 1e-14, "{forces:?}");
        // The same with a third of the load on each of three.
        let columns: [f64; 15] =
            core::array::from_fn(|i| columns[if i < 9 { i } else { i % 3 + 6 }]);
        let mut forces = [3.0_f64, 2.0, 5.0, 4.0, 0.0];
        let freedom = least_norm(&columns, 3, Rank::Numerical, &mut forces);
        assert_eq!(freedom.dimension(), 2);
        assert!(freedom.is_determined(0) && freedom.is_determined(1) && !freedom.is_determined(2));
        let off = forces.iter().zip([3.0, 2.0, 3.0, 3.0, 3.0]);
        let off = off.map(|(x, y)| (x - y).abs());
        assert!(off.fold(0.0, f64::max) < 1e-14, "{forces:?}");
    }
}
