//! How contacts that slide share an impulse of which the law leaves open where it acts: a box that lands on its four feet.
//!
//! As equal springs below a rigid body do, whose impulses are in proportion to what its motion presses them together, Λ = A w: then nᵀΛ = 0
//! for every n with nᵀA = 0. Such an equation stands in the place of one that says nothing new.

use super::{Pattern, Slide};
use crate::arithmetic::Scalar;
use crate::modes::impact::collision::{Collision, NormalSource};

/// nᵀΛ = 0.
#[derive(Clone, Debug)]
pub(in crate::modes::impact) struct Share<T> {
    /// The equation that it replaces, by its place among the unknowns.
    at: usize,
    /// n, of the first unknowns.
    weights: Vec<T>,
}

impl<T: Scalar> Share<T> {
    /// Writes the row of the matrix, of so many elements.
    pub(in crate::modes::impact) fn write(&self, count: usize, matrix: &mut Vec<T>) {
        let rest = core::iter::repeat_n(T::zero(), count - self.weights.len());
        matrix.extend(self.weights.iter().copied().chain(rest));
    }

    /// nᵀΛ
    pub(super) fn sum(&self, unknowns: &[usize], impulses: &[T]) -> T {
        let terms = self.weights.iter().zip(unknowns);
        terms.fold(T::zero(), |sum, (&weight, &row)| {
            sum + weight * impulses[row]
        })
    }
}

impl<T: Scalar> Pattern<T> {
    /// Finds them where something slides on contacts whose rows depend on one another; the unknowns listed until now are impulses of
    /// constraints and contacts.
    pub(super) fn find_shares(&mut self, c: &Collision<T>) {
        self.shares.clear();
        let mut sliding = c
            .rubs
            .iter()
            .zip(&self.slides)
            .filter(|(_, slide)| matches!(slide, Slide::Along(_) | Slide::Turning(_)));
        let on_contact = sliding
            .any(|(rub, _)| matches!(rub.bearer, NormalSource::ContactRow(k) if self.pressed[k]));
        let count = self.unknowns.len();
        if !on_contact || count < 2 {
            return;
        }
        let mut matrix = core::mem::take(&mut self.matrix);
        matrix.clear();
        for &i in &self.unknowns {
            matrix.extend(self.unknowns.iter().map(|&j| c.g(i, j)));
        }
        self.dependence.factor(&mut matrix, count);
        self.matrix = matrix;
        if !self.dependence.is_deficient() {
            return;
        }
        let shares = &mut self.shares;
        self.dependence.combine(|i, k, factor| {
            if shares.last().is_none_or(|share: &Share<T>| share.at != i) {
                let mut weights = vec![T::zero(); count];
                weights[i] = T::one();
                shares.push(Share { at: i, weights });
            }
            if let Some(share) = shares.last_mut() {
                share.weights[k] = -factor;
            }
        });
        self.undetermined |= !self.shares.is_empty();
    }

    /// What stands in the place of the equation of an unknown.
    pub(in crate::modes::impact) fn share_at(&self, at: usize) -> Option<&Share<T>> {
        self.shares.iter().find(|share| share.at == at)
    }
}
