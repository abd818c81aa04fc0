//! Which combination holds: all of them in order where they are few, else Lemke's method.
//!
//! Few: contacts pressed before free, frictions sticking before sliding; of several solutions the one with the least jump of the
//! velocities is taken. Many: the linear complementarity problem of Stewart & Trinkle (1996), with a cone of eight
//! sides where a slip has two components, says which combination it is; that one is then solved as equations. Several
//! frictions with two components: relaxation says which it is and where the slips are to be looked for.

mod directions;
mod enumeration;
mod guesses;
mod turned;

use super::collision::Collision;
use super::complement::Linear;
use super::pattern::{Pattern, Phase};
use super::relaxation::Relaxation;
use crate::arithmetic::Scalar;
use crate::linear::{Equilibrated, Lemke};
use turned::Turned;

/// So many combinations are tried one after the other before Lemke's method is asked.
const FEW: usize = 100;

/// So many are tried if that has failed.
const MOST: usize = 20_000;

/// So many of several frictions with two components: the directions of slips take a hundredth of a second to find.
const MOST_IN_SPACE: usize = 5_000;

/// Frictions with two components obey their law to what rounding leaves; if no combination does so, to so many times that: at the edge of a cone
/// sticking and sliding differ by no more than errors of the state, and what slides hardly has a direction.
const LEEWAY: f64 = 1e4;

/// A search for the combination that holds; the memory is reused.
#[derive(Clone, Debug, Default)]
pub(super) struct Search<T> {
    pub pattern: Pattern<T>,
    /// Other solutions.
    pub others: Vec<Pattern<T>>,
    /// Combinations solved so far.
    pub tried: usize,
    lemke: Lemke,
    problem: Linear,
    relaxation: Relaxation,
    factors: Equilibrated<f64>,
    turned: Turned<T>,
    /// Touches that take part, and frictions that can act.
    taking: Vec<usize>,
    acting: Vec<usize>,
    choice: Vec<usize>,
}

impl<T: Scalar> Search<T> {
    /// Finds a combination that holds and leaves it in `pattern`; false if there is none.
    pub fn find(&mut self, c: &Collision<T>, phase: &Phase<T>) -> bool {
        match c.bearings.is_empty() {
            true => self.find_straight(c, phase),
            false => self.find_turned(c, phase),
        }
    }

    /// The same for frictions that single rows press.
    fn find_straight(&mut self, c: &Collision<T>, phase: &Phase<T>) -> bool {
        self.others.clear();
        self.taking.clear();
        self.taking
            .extend((0..c.touches.len()).filter(|k| phase.within[*k]));
        self.pattern.leeway = 1.0;
        if self.find_within(c, phase) {
            return true;
        }
        self.pattern.leeway = LEEWAY;
        c.rubs.iter().any(|rub| rub.components > 1) && self.find_within(c, phase)
    }

    /// The same for the present leeway.
    fn find_within(&mut self, c: &Collision<T>, phase: &Phase<T>) -> bool {
        let count = self.combinations(c, phase);
        let turning = c.acting(phase).filter(|rub| rub.components > 1);
        let several = turning.count() > 1;
        if several {
            return self.relax(c, phase)
                || self.complement(c, phase)
                || count.is_some_and(|n| n <= MOST_IN_SPACE) && self.enumerate(c, phase);
        }
        if count.is_some_and(|n| n <= FEW) {
            return self.enumerate(c, phase) || self.complement(c, phase);
        }
        if self.complement(c, phase) {
            self.weigh(c, phase);
            return true;
        }
        count.is_some_and(|n| n <= MOST) && self.enumerate(c, phase)
    }

    /// Solves and judges the present combination. What comes to rest in it sticks, if it can: a cone leaves open how forces are shared.
    fn holds(&mut self, c: &Collision<T>, phase: &Phase<T>) -> bool {
        if !self.pattern.is_solution(c, phase) {
            return false;
        }
        if let Some(slides) = self.pattern.stick_at_rest(c)
            && !self.pattern.is_solution(c, phase)
        {
            self.pattern.slides = slides;
            return self.pattern.is_solution(c, phase);
        }
        true
    }
}
