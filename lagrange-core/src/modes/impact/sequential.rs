//! Impacts one after the other: in order of declaration, again and again, until no contact approaches; or those of groups of contacts that do nothing to
//! one another.
//!
//! A ball that two others squeeze with e < 1 is hit infinitely often, by speeds that shrink geometrically: what remains
//! is followed until it is below rounding, its limit. Where it does not shrink there is no end, and that is an error.

use super::collision::Collision;
use super::law::Law;
use super::pattern::{ROUNDING, TERMS};
use crate::arithmetic::{Scalar, rounding};

/// More impacts than this at one instant have no end.
pub(super) const MOST_IMPACTS: usize = 200_000;

/// Why impacts in turn could not be solved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Stuck {
    /// The impact of this touch has no solution.
    Unsolved(usize),
    /// After [`MOST_IMPACTS`] this touch still approaches.
    Endless(usize),
}

/// Impacts in turn; the memory is reused.
#[derive(Clone, Debug, Default)]
pub(super) struct Turns<T> {
    pub impulses: Vec<T>,
    pub rates: Vec<T>,
    /// Below which a rate is rounding.
    pub noise: Vec<f64>,
    pub undetermined: bool,
    pub lowered: bool,
    pub ambiguous: bool,
    /// What other impulses satisfy the law as well, of those of one group, less those taken. They are not known where impacts have followed each other.
    pub others: Vec<Vec<T>>,
    /// Number of impacts.
    pub count: usize,
    /// Largest rate so far.
    spans: Vec<f64>,
    /// Per row: the group that it belongs to.
    groups: Vec<usize>,
}

impl<T: Scalar> Turns<T> {
    /// Solves `c` by single impacts.
    pub fn solve(&mut self, c: &Collision<T>, law: &mut Law<T>) -> Result<(), Stuck> {
        self.begin(c, law);
        self.spans.clear();
        self.spans.resize(c.size, 0.0);
        let mut at_rest = 0;
        for k in (0..c.touches.len()).cycle() {
            self.measure(c);
            let row = c.touches[k].row;
            if self.rates[row].value() >= -self.noise[row] {
                at_rest += 1;
                if at_rest == c.touches.len() {
                    break;
                }
                continue;
            }
            at_rest = 0;
            if self.count == MOST_IMPACTS {
                return Err(Stuck::Endless(k));
            }
            law.phase.within[k] = true;
            let solved = law.solve(c, &self.rates);
            law.phase.within[k] = false;
            if !solved {
                return Err(Stuck::Unsolved(k));
            }
            self.count += 1;
            self.add(law);
        }
        self.settle(c, law);
        if self.count > 1 {
            self.others.clear();
        }
        Ok(())
    }

    /// Solves `c` by one impact of all contacts together, or one for each group of contacts that do nothing to one another: what one of them lets go of a
    /// restitution is no matter of another.
    pub fn solve_groups(&mut self, c: &Collision<T>, law: &mut Law<T>) -> Result<(), Stuck> {
        self.begin(c, law);
        c.groups(&mut self.groups);
        self.noise.clear();
        self.noise.resize(c.size, 0.0);
        for k in 0..c.touches.len() {
            let group = self.groups[c.touches[k].row];
            let mut earlier = c.touches[..k].iter();
            if earlier.any(|touch| self.groups[touch.row] == group) {
                continue;
            }
            for (within, touch) in law.phase.within.iter_mut().zip(&c.touches) {
                *within = self.groups[touch.row] == group;
            }
            let apart = self.groups.iter().map(|other| *other != group);
            law.phase.apart.clear();
            law.phase.apart.extend(apart);
            if !law.solve(c, &self.rates) {
                return Err(Stuck::Unsolved(c.fastest(&law.phase.within).unwrap_or(k)));
            }
            self.count += 1;
            self.add(law);
            for (noise, of_group) in self.noise.iter_mut().zip(&law.noise) {
                *noise = noise.max(*of_group);
            }
        }
        Ok(())
    }

    fn begin(&mut self, c: &Collision<T>, law: &mut Law<T>) {
        self.rates.clone_from(&c.rates);
        self.impulses.clear();
        self.impulses.resize(c.size, T::zero());
        (self.undetermined, self.lowered, self.ambiguous, self.count) = (false, false, false, 0);
        law.phase.within.clear();
        law.phase.within.resize(c.touches.len(), false);
        law.phase.apart.clear();
        self.others.clear();
    }

    /// Adds an impact.
    fn add(&mut self, law: &Law<T>) {
        self.undetermined |= law.undetermined;
        self.lowered |= law.lowered;
        self.ambiguous |= law.ambiguous;
        self.rates.copy_from_slice(&law.after);
        for other in &law.search.others {
            let pairs = other.impulses.iter().zip(&law.impulses);
            self.others
                .push(pairs.map(|(other, taken)| *other - *taken).collect());
        }
        for (sum, &impulse) in self.impulses.iter_mut().zip(&law.impulses) {
            *sum += impulse;
        }
    }

    /// What impacts that go on without end have left of an approach, below what counts as one, is taken by a last one of all that stay
    /// together, without restitution: the bodies move on as one, to rounding.
    fn settle(&mut self, c: &Collision<T>, law: &mut Law<T>) {
        if self.count <= c.touches.len() {
            return;
        }
        // What is left at one contact is handed on to its neighbours.
        let noise = c
            .touches
            .iter()
            .map(|touch| self.noise[touch.row] / c.strength(touch.row));
        let noise = noise.filter(|noise| noise.is_finite()).fold(0.0, f64::max);
        for (within, touch) in law.phase.within.iter_mut().zip(&c.touches) {
            let own = self.noise[touch.row].max(noise * c.strength(touch.row));
            *within = self.rates[touch.row].value().abs() <= own;
        }
        if law.solve_share(c, &self.rates, 0.0) {
            self.add(law);
        }
    }

    fn measure(&mut self, c: &Collision<T>) {
        self.noise.clear();
        for ((span, rate), terms) in self.spans.iter_mut().zip(&self.rates).zip(&c.terms) {
            *span = span.max(rate.value().abs());
            self.noise
                .push(rounding::<T>(ROUNDING) * *span + rounding::<T>(TERMS) * terms);
        }
        // What an impulse does in other rows is known to rounding of what it does in its own.
        let effort = c.effort(&self.impulses);
        for (i, noise) in self.noise.iter_mut().enumerate() {
            *noise += rounding::<T>(TERMS) * c.strength(i) * effort;
        }
    }
}
