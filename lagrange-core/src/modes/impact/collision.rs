//! An impact in the space of its rows: what an impulse in one row does to the rates of all.
//!
//! ```text
//! rates⁺ = rates⁻ + G Λ,   G = A M⁻¹ Aᵀ        (Delassus' matrix)
//! ```
//!
//! Bilateral rows whose impulse nothing depends on are taken into M⁻¹ beforehand: M may be singular as long as they make the
//! whole regular. Rows come in this order: constraints that carry friction, `while` rows, contacts, slip components.

use super::bearing::Bearing;
use crate::arithmetic::Scalar;
use crate::modes::disjoint;
use core::ops::Range;

/// A contact whose gap vanishes.
#[derive(Clone, Copy, Debug)]
pub(super) struct ContactRow<T> {
    /// Index into the description.
    pub contact: usize,
    /// Its row here.
    pub row: usize,
    /// e.
    pub restitution: T,
    /// Whether e multiplies the impulse of compression (Poisson) instead of the speed (Newton).
    pub poisson: bool,
}

/// What presses the surfaces of a friction together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum NormalSource {
    /// A contact, by its place among the touches.
    ContactRow(usize),
    /// A constraint, by its row here; of several that press together the first, to which the others are [turned](super::bearing).
    ConstraintRow(usize),
}

/// A friction that an impact can act on.
#[derive(Clone, Copy, Debug)]
pub(super) struct FrictionRow<T> {
    /// Index into the description.
    pub friction: usize,
    /// First of its rows here.
    pub row: usize,
    /// 1 or 2.
    pub components: usize,
    /// Where N comes from.
    pub bearer: NormalSource,
    /// The place among the touches of the contact with which the constraint holds that N comes from.
    pub while_touch: Option<usize>,
    /// N over the impulse of the bearer.
    pub factor: T,
    /// μs.
    pub stick: T,
    /// μk.
    pub slide: T,
}

impl<T: Scalar> FrictionRow<T> {
    /// Its rows, one per slip component.
    pub fn rows(&self) -> Range<usize> {
        self.row..self.row + self.components
    }

    /// Whether it has an impulse where it is pressed.
    pub fn is_rough(&self) -> bool {
        !(self.stick.is_zero() && self.slide.is_zero())
    }
}

/// The data of an impact.
#[derive(Clone, Debug, Default)]
pub(super) struct Collision<T> {
    /// Number of rows.
    pub size: usize,
    /// G, row-major.
    pub response: Vec<T>,
    /// Rates before.
    pub rates: Vec<T>,
    /// Per row: size of the terms that its rate cancels from.
    pub terms: Vec<f64>,
    /// Largest rate of rows that are at rest, over their strength: what errors of the run have left of it.
    pub drift: f64,
    /// The first so many rows are constraints that always act.
    pub links: usize,
    /// `while` rows with the place of their contact among the touches.
    pub conditional: Vec<(usize, usize)>,
    /// Contacts whose gap vanishes, in order of declaration.
    pub touches: Vec<ContactRow<T>>,
    /// Frictions on them and on constraints.
    pub rubs: Vec<FrictionRow<T>>,
    /// Constraints that press frictions together.
    pub bearings: Vec<Bearing>,
}

impl<T: Scalar> Collision<T> {
    /// √Gᵢᵢ
    pub fn strength(&self, i: usize) -> f64 {
        self.g(i, i).value().max(0.0).sqrt()
    }

    /// Σ √Gⱼⱼ |Λⱼ|: beside it rounding of what an impulse does in other rows is small.
    pub fn effort(&self, impulses: &[T]) -> f64 {
        let impulses = impulses.iter().enumerate();
        impulses
            .map(|(j, x)| self.strength(j) * x.value().abs())
            .sum()
    }

    /// Gᵢⱼ
    pub fn g(&self, i: usize, j: usize) -> T {
        self.response[i * self.size + j]
    }

    /// Per row, the first row of its group: rows that impulses tie together, at once or through others, and what presses them.
    pub fn groups(&self, out: &mut Vec<usize>) {
        disjoint::separate(out, self.size);
        for i in 0..self.size {
            (0..i)
                .filter(|&j| !self.g(i, j).is_zero())
                .for_each(|j| disjoint::join(out, i, j));
        }
        for &(row, touch) in &self.conditional {
            disjoint::join(out, row, self.touches[touch].row);
        }
        for rub in &self.rubs {
            rub.rows()
                .for_each(|row| disjoint::join(out, row, self.bearing_row(rub)));
        }
        for bearing in &self.bearings {
            let rows = bearing.rows().iter();
            rows.for_each(|&row| disjoint::join(out, row, bearing.first()));
        }
        for i in 0..self.size {
            out[i] = disjoint::first(out, i);
        }
    }

    /// Of the touches `within` the one that approaches fastest, if one does, beside what an impulse does to it.
    pub fn fastest(&self, within: &[bool]) -> Option<usize> {
        let rate = |k: usize| self.rates[self.touches[k].row].value();
        let speed = |k: usize| rate(k) / self.strength(self.touches[k].row);
        let approaching = (0..self.touches.len()).filter(|&k| within[k] && rate(k) < 0.0);
        approaching.min_by(|&i, &k| speed(i).total_cmp(&speed(k)))
    }

    /// Row of the bearer of a friction.
    pub fn bearing_row(&self, rub: &FrictionRow<T>) -> usize {
        match rub.bearer {
            NormalSource::ContactRow(k) => self.touches[k].row,
            NormalSource::ConstraintRow(row) => row,
        }
    }
}
