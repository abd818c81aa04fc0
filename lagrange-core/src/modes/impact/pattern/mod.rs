//! One combination of what each contact and friction does in a phase of an impact: solved as equations, then judged.
//!
//! | state | equation | condition |
//! |---|---|---|
//! | contact pressed | rate⁺ = aim | Λ ≥ least |
//! | contact free | Λ = least | rate⁺ ≥ aim |
//! | friction sticks | s⁺ = 0 | \|Λₜ\| ≤ μs N |
//! | friction slides | Λₜ = −μk N s⁺/\|s⁺\| | |
//!
//! With two slip components the direction s⁺/|s⁺| is an unknown too: Newton's method from a given direction.

mod bounds;
mod judgement;
mod shares;

use super::collision::{Collision, FrictionRow, NormalSource};
use crate::arithmetic::{Scalar, rounding};
use crate::linear::{Equilibrated, ForceBounds};
pub(super) use judgement::Violation;
pub(super) use shares::Share;

/// Rounding relative to the terms that a rate is summed from.
pub(super) const ROUNDING: f64 = 1e-13;
/// The same for the terms a·v, which are summed before.
pub(super) const TERMS: f64 = 4e-16;
/// The same for what an impulse does in other rows, beside what it does in its own: it comes from a solution with all inertias.
const ANSWERS: f64 = 4e-15;
/// Equations hold that miss no more than so many times what is known of their rates.
const AGREES: f64 = 10.0;

/// What a friction does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Slide {
    /// Nothing presses it.
    Idle,
    Stick,
    /// One component: s⁺ has this sign (times that of the bearing impulse, on a constraint).
    Along(f64),
    /// Two components, from this direction on.
    Turning([f64; 2]),
}

/// What is asked of a phase.
#[derive(Clone, Debug, Default)]
pub(super) struct Phase<T> {
    /// Rates at its beginning.
    pub rates: Vec<T>,
    /// Per touch: least rate after it.
    pub aims: Vec<T>,
    /// Per touch: least impulse.
    pub least: Vec<T>,
    /// Per touch: has had an impulse before, so that its `while` rows hold.
    pub struck: Vec<bool>,
    /// Per touch: takes part.
    pub within: Vec<bool>,
    /// Per row: nothing ties it to the touches that take part. Empty where that is not looked at.
    pub apart: Vec<bool>,
}

impl<T> Phase<T> {
    /// Whether what presses a friction takes part.
    pub fn includes(&self, rub: &FrictionRow<T>) -> bool {
        match rub.bearer {
            NormalSource::ContactRow(k) => self.within[k],
            NormalSource::ConstraintRow(row) => !self.apart.get(row).is_some_and(|apart| *apart),
        }
    }
}

/// A combination and its solution.
#[derive(Clone, Debug, Default)]
pub(super) struct Pattern<T> {
    pub pressed: Vec<bool>,
    pub slides: Vec<Slide>,
    /// Λ of every row.
    pub impulses: Vec<T>,
    /// Rates after.
    pub after: Vec<T>,
    /// What rounding leaves of them.
    pub noise: Vec<f64>,
    /// Frictions with two components obey their law, and stick, to so many times that.
    pub leeway: f64,
    /// Whether impulses are not determined (they are then the least that contacts and friction allow).
    pub undetermined: bool,
    pub(super) unknowns: Vec<usize>,
    /// In the place of equations that say nothing new: how impulses are shared.
    pub(super) shares: Vec<Share<T>>,
    dependence: Equilibrated<T>,
    bounds: ForceBounds<T>,
    pub(super) matrix: Vec<T>,
    pub(super) right: Vec<T>,
    pub(super) factors: Equilibrated<T>,
}

impl<T: Scalar> Pattern<T> {
    /// Whether friction `rub` can have an impulse.
    pub fn bears(&self, rub: &FrictionRow<T>, phase: &Phase<T>) -> bool {
        rub.is_rough()
            && phase.includes(rub)
            && match rub.bearer {
                NormalSource::ContactRow(k) => self.pressed[k] || phase.least[k].value() > 0.0,
                NormalSource::ConstraintRow(_) => {
                    rub.while_touch.is_none_or(|k| self.holds(k, phase))
                }
            }
    }

    /// Whether the `while` rows of touch `k` hold.
    pub(super) fn holds(&self, k: usize, phase: &Phase<T>) -> bool {
        phase.within[k] && (self.pressed[k] || phase.struck[k])
    }

    /// Solves the equations, from the given directions of slip; false if they have no solution.
    pub fn solve(&mut self, c: &Collision<T>, phase: &Phase<T>) -> bool {
        let turning = self.slides.iter().any(|s| matches!(s, Slide::Turning(_)));
        self.solve_held(c, phase) && (!turning || self.turn(c, phase)) && self.is_finite()
    }

    /// Solves the equations with these directions of slip, whether the slip is along them or not.
    pub fn solve_held(&mut self, c: &Collision<T>, phase: &Phase<T>) -> bool {
        self.begin(c, phase);
        self.solve_linear(c, phase) && self.is_finite()
    }

    fn is_finite(&self) -> bool {
        self.impulses.iter().all(|x| x.value().is_finite())
    }

    /// Lists the unknown impulses and sets the others.
    fn begin(&mut self, c: &Collision<T>, phase: &Phase<T>) {
        self.undetermined = false;
        self.impulses.clear();
        self.impulses.resize(c.size, T::zero());
        self.unknowns.clear();
        self.unknowns.extend(0..c.links);
        for &(row, touch) in &c.conditional {
            if self.holds(touch, phase) {
                self.unknowns.push(row);
            }
        }
        for (k, touch) in c.touches.iter().enumerate() {
            if !phase.within[k] {
                continue;
            } else if self.pressed[k] {
                self.unknowns.push(touch.row);
            } else {
                self.impulses[touch.row] = phase.least[k];
            }
        }
        self.find_shares(c);
        for (rub, slide) in c.rubs.iter().zip(&self.slides) {
            if *slide == Slide::Stick {
                self.unknowns.extend(rub.rows());
            }
        }
    }

    /// What a unit impulse of `row` does to rate `i`, with the sliding friction that it brings along in each `direction`.
    pub(super) fn effect(
        &self,
        c: &Collision<T>,
        i: usize,
        row: usize,
        direction: fn(&Slide) -> Option<[f64; 2]>,
    ) -> T {
        let mut effect = c.g(i, row);
        for (rub, slide) in c.rubs.iter().zip(&self.slides) {
            if c.bearing_row(rub) == row
                && let Some(direction) = direction(slide)
            {
                for (k, part) in direction.into_iter().enumerate().take(rub.components) {
                    let share = T::from_f64(-part) * rub.slide * rub.factor;
                    effect += share * c.g(i, rub.row + k);
                }
            }
        }
        effect
    }

    /// Directions of slip held: a linear system, with one step of refinement.
    fn solve_linear(&mut self, c: &Collision<T>, phase: &Phase<T>) -> bool {
        let count = self.unknowns.len();
        let mut matrix = core::mem::take(&mut self.matrix);
        matrix.clear();
        for (at, &i) in self.unknowns.iter().enumerate() {
            match self.share_at(at) {
                Some(share) => share.write(count, &mut matrix),
                None => matrix.extend(
                    self.unknowns
                        .iter()
                        .map(|&row| self.effect(c, i, row, held)),
                ),
            }
        }
        self.factors.factor(&mut matrix, count);
        self.matrix = matrix;
        for &row in &self.unknowns {
            self.impulses[row] = T::zero();
        }
        for _ in 0..2 {
            self.improve(c, phase);
        }
        self.move_on(c, phase, held);
        let agrees = self.agrees(c, phase);
        if !agrees || !self.factors.is_deficient() {
            return agrees;
        }
        self.undetermined = true;
        self.share(c, phase);
        self.move_on(c, phase, held);
        let agrees = self.agrees(c, phase);
        for &i in &self.unknowns {
            self.noise[i] = self.noise[i].max(self.missed(c, phase, i));
        }
        agrees
    }

    /// Whether the equations hold: those that depend on each other may contradict each other, by more than what rows that are at rest move. The
    /// slips of two feet of a body that lies almost flat do by its tilt, which is an error of the state.
    fn agrees(&self, c: &Collision<T>, phase: &Phase<T>) -> bool {
        let far = |&i: &usize| {
            let turns = |rub: &FrictionRow<T>| rub.components > 1 && rub.rows().contains(&i);
            let leeway = match c.rubs.iter().any(turns) {
                true => self.leeway,
                false => 1.0,
            };
            let known = leeway * self.noise[i] + c.strength(i) * c.drift;
            self.missed(c, phase, i) > AGREES * known
        };
        !self.unknowns.iter().any(far)
    }

    /// By how much the rate of row `i` misses what it is to be.
    fn missed(&self, c: &Collision<T>, phase: &Phase<T>, i: usize) -> f64 {
        (self.after[i] - aim(c, phase, i)).value().abs()
    }

    /// Adds to the unknowns what the equations miss.
    fn improve(&mut self, c: &Collision<T>, phase: &Phase<T>) {
        self.move_on(c, phase, held);
        let mut right = core::mem::take(&mut self.right);
        right.clear();
        right.extend((0..self.unknowns.len()).map(|at| self.missing(c, phase, at)));
        self.factors.solve(&mut right);
        for (&row, &x) in self.unknowns.iter().zip(&right) {
            self.impulses[row] += x;
        }
        self.right = right;
    }

    /// What is missing in the equation of an unknown.
    pub(super) fn missing(&self, c: &Collision<T>, phase: &Phase<T>, at: usize) -> T {
        match self.share_at(at) {
            Some(share) => -share.sum(&self.unknowns, &self.impulses),
            None => {
                let row = self.unknowns[at];
                aim(c, phase, row) - self.after[row]
            }
        }
    }

    /// Friction impulses of what slides in a `direction`, rates after all impulses, and what rounding leaves of them.
    pub(super) fn move_on(
        &mut self,
        c: &Collision<T>,
        phase: &Phase<T>,
        direction: fn(&Slide) -> Option<[f64; 2]>,
    ) {
        for (rub, slide) in c.rubs.iter().zip(&self.slides) {
            if let Some(direction) = direction(slide) {
                let normal = rub.factor * self.impulses[c.bearing_row(rub)];
                for (k, part) in direction.into_iter().enumerate().take(rub.components) {
                    self.impulses[rub.row + k] = T::from_f64(-part) * rub.slide * normal;
                }
            }
        }
        self.after.clear();
        self.noise.clear();
        let effort = c.effort(&self.impulses);
        for i in 0..c.size {
            let (mut rate, mut size) = (phase.rates[i], phase.rates[i].value().abs());
            for (j, &impulse) in self.impulses.iter().enumerate() {
                let part = c.g(i, j) * impulse;
                rate += part;
                size += part.value().abs();
            }
            self.after.push(rate);
            let noise = ROUNDING * size + TERMS * c.terms[i] + ANSWERS * c.strength(i) * effort;
            self.noise.push(rounding::<T>(noise));
        }
    }
}

/// Direction of a sliding friction that is held while a linear system is solved.
pub(super) fn held(slide: &Slide) -> Option<[f64; 2]> {
    match *slide {
        Slide::Along(sign) => Some([sign, 0.0]),
        Slide::Turning(direction) => Some(direction),
        Slide::Idle | Slide::Stick => None,
    }
}

/// The rate that row `i` is to have if it is an equation.
fn aim<T: Scalar>(c: &Collision<T>, phase: &Phase<T>, i: usize) -> T {
    let first = c.touches.first().map_or(usize::MAX, |touch| touch.row);
    match i.checked_sub(first).and_then(|k| phase.aims.get(k)) {
        Some(&aim) => aim,
        None => T::zero(),
    }
}

/// √Σ x²
pub(super) fn length<T: Scalar>(x: &[T]) -> f64 {
    match x {
        [x] => x.value().abs(),
        x => x.iter().map(|x| x.value() * x.value()).sum::<f64>().sqrt(),
    }
}
