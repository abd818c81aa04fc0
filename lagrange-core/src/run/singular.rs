//! Isolated positions where constraints lose rank: a linkage in its dead position.
//!
//! The motion goes smoothly through such a position, but the equations cannot be solved there, and close to it rounding is
//! amplified by the inverse of the distance, and of its square. No step may *end* close to it: one that would is made longer, over it
//! ([`super::passage`]). What ends a run there, a stop, needs no equations; where the mode would change there, the way on cannot be told.
//!
//! How close is read from the pivots of G = A D⁻¹ Aᵀ (A the rows of constraints, D the diagonal of the mass matrix, each
//! element at its largest so far) in Cholesky's factorization with complete pivoting: the smallest of them that is not always zero, over its largest value
//! so far, is the square of a distance.

use super::Run;
use super::hit::Hit;
use super::passage::COEFFICIENTS;
use crate::arithmetic::{Scalar, epsilon};
use crate::dynamics::{Dynamics, Work};
use crate::effects::{Effects, Item};
use crate::error::Error;
use crate::integrate::taylor;
use crate::system::Description;

/// A step may come nearer to a loss of rank, or to its other side, by this factor.
const NEARER: f64 = 0.7;
/// Farther away than this from one it may end anywhere,
const CLOSE: f64 = 0.2;
/// or farther where a leap from there would be lost in rounding, which is so many units of it over the square of the distance,
const ROUNDINGS_OF_LEAPS: f64 = 1400.0;
/// but no farther than this.
const CLOSEST_LEAP: f64 = 0.6;
/// A leap is so many times as long as the way to the loss of rank: in the middle of an even number of points it is farthest from them.
const WAYS: [f64; 3] = [2.0, 2.2, 1.8];
/// The way may be longer than the step by this factor.
const FARTHEST: f64 = 4.0;
/// A leap is tried with any degree from this on.
pub(super) const LEAST_DEGREE: usize = 6;
/// Where no leap is good, the step is tried this much shorter.
pub(super) const RETREAT: f64 = 0.75;
/// So many times a step is tried shorter.
pub(super) const MOST_RETREATS: usize = 5;
/// Nearer than this to such a position the equations say nothing reliable about forces.
pub(super) const UNDECIDED: f64 = 1e-2;
/// What rounding makes of the direction of the motion, in units of rounding over the square of the distance.
const ROUNDINGS: f64 = 0.25;
/// Error of a leap in units of what a step may get wrong.
const GOOD: f64 = 1.0;
/// What rounding leaves of it within a leap, in the same units, is no more than this as a rule,
const CLEAN: f64 = 3.0;
/// and than this where no leap is better.
const BEARABLE: f64 = 30.0;
/// Error, in the same units, of a Taylor polynomial that is near enough to begin with.
const NEAR_ENOUGH: f64 = 1e8;

/// Where a step begins nearer than this to a loss of rank ahead, and cannot leap over it, the run ends.
const LOST: f64 = 1e-3;

/// Nearer than this the steps of other methods are left to Taylor series.
const DOUBTFUL: f64 = 0.4;

/// A pivot below this share of the first has always been zero: its row depends on others everywhere.
const DEPENDENT: f64 = 1e-10;

/// Pivots are compared with earlier ones until an inertia has grown by this factor.
const HEAVIER: f64 = 2.0;

/// Watches the rank of the constraints along a run.
#[derive(Clone, Debug)]
pub(super) struct RankWatch {
    /// Rows that may lose rank; none: nothing to watch.
    rows: Vec<usize>,
    gram: Vec<f64>,
    pivots: Vec<f64>,
    /// Largest value of each pivot so far.
    largest: Vec<f64>,
    /// Largest diagonal elements of the mass matrix so far.
    masses: Vec<f64>,
    /// The inverse roots of these.
    inverse_roots: Vec<f64>,
    /// The inverse roots when `largest` was begun.
    lighter: Vec<f64>,
    /// Which rows were held aside at the last look: they follow from the others.
    aside: Vec<bool>,
    /// How many rows acted at the last look.
    acting: usize,
    scaled: Vec<f64>,
    /// The work that had been done at the last look: as long as it is the same the pivots are those of the last evaluation.
    measured: Option<Work>,
}

impl RankWatch {
    /// Watches the constraints whose Jacobian depends on the state and that act at all times, as far as these effects have them.
    pub(super) fn new(d: &Description, effects: &Effects) -> Self {
        let n = d.coordinates.len();
        let constraints = d.constraints.iter().enumerate();
        let acting = constraints.filter(|(i, constraint)| {
            constraint.while_contact.is_none() && effects.includes(d, Item::Constraint(*i))
        });
        let mut rows: Vec<usize> = acting.map(|(_, constraint)| constraint.row).collect();
        // A row that is constant cannot lose rank alone, but one that is not may come to depend on it.
        if !rows.iter().any(|&row| !d.rows[row].is_constant()) {
            rows.clear();
        }
        let m = rows.len();
        RankWatch {
            gram: vec![0.0; m * m],
            pivots: vec![0.0; m],
            largest: vec![0.0; m],
            masses: vec![0.0; n],
            inverse_roots: vec![1.0; n],
            lighter: vec![0.0; n],
            aside: vec![false; m],
            acting: 0,
            scaled: vec![0.0; m * n],
            measured: None,
            rows,
        }
    }

    /// Whether there are rows that may lose rank.
    pub(super) fn watches(&self) -> bool {
        !self.rows.is_empty()
    }

    /// Forgets earlier runs.
    pub(super) fn restart(&mut self) {
        self.largest.fill(0.0);
        self.masses.fill(0.0);
        self.inverse_roots.fill(1.0);
        self.lighter.fill(0.0);
        self.measured = None;
    }

    /// [`Self::reach`] at the start of a run, before it is known which rows will be held aside: those that are then are no loss of rank.
    pub(super) fn begin<T: Scalar>(&mut self, dynamics: &Dynamics<T>) {
        self.reach(dynamics);
        self.acting = 0;
    }

    /// Takes the state that `dynamics` has evaluated for one that the motion reaches: what is the farthest so far may be farther now. Its distance.
    pub(super) fn reach<T: Scalar>(&mut self, dynamics: &Dynamics<T>) -> f64 {
        if self.rows.is_empty() {
            return 1.0;
        }
        let heavier = self.take_masses(dynamics);
        let others = self.take_rows_aside(dynamics);
        if heavier || others || self.measured != Some(dynamics.work()) {
            self.measure(dynamics);
        }
        for (largest, pivot) in self.largest.iter_mut().zip(&self.pivots) {
            *largest = largest.max(*pivot);
        }
        self.nearest()
    }

    /// Distance of the state that `dynamics` has evaluated from a loss of rank, 1 at the farthest that was reached.
    pub(super) fn distance<T: Scalar>(&mut self, dynamics: &Dynamics<T>) -> f64 {
        if self.rows.is_empty() || self.has_other_rows(dynamics) {
            return 1.0;
        }
        self.measure(dynamics);
        self.nearest()
    }

    /// How small a pivot is beside the largest of its kind.
    fn nearest(&self) -> f64 {
        let mut nearest: f64 = 1.0;
        let first = self.largest[0];
        for (largest, pivot) in self.largest.iter().zip(&self.pivots) {
            if *largest > DEPENDENT * first {
                nearest = nearest.min((pivot / largest).max(0.0).sqrt());
            }
        }
        nearest
    }

    /// Takes the inertias where they are larger than ever; whether one is.
    fn take_masses<T: Scalar>(&mut self, dynamics: &Dynamics<T>) -> bool {
        let d = dynamics.description();
        let mut heavier = false;
        for &(i, _, place) in d.mass.iter().filter(|(i, j, _)| i == j) {
            let mass = dynamics.motion(place).value();
            if mass > self.masses[i] {
                (self.masses[i], heavier) = (mass, true);
            }
        }
        if !heavier {
            return false;
        }
        // The four elements of an attitude are of one kind: which of them has hardly any inertia depends on where the body is turned.
        for first in d.constraints.iter().filter_map(|c| c.attitude) {
            let elements = &mut self.masses[first..first + 4];
            let largest = elements.iter().copied().fold(0.0, f64::max);
            elements.fill(largest);
        }
        for (inverse, &mass) in self.inverse_roots.iter_mut().zip(&self.masses) {
            if mass > 0.0 {
                *inverse = 1.0 / mass.sqrt();
            }
        }
        // Pivots that were large because there was hardly any inertia say nothing: a quaternion that was nearly 1.
        let mut pairs = self.masses.iter().zip(&self.lighter);
        if pairs.any(|(mass, lighter)| *mass > HEAVIER * lighter) {
            self.largest.fill(0.0);
            self.lighter.copy_from_slice(&self.masses);
        }
        true
    }

    /// Whether other rows than at the last look are held aside because other rows act: a body that rests on a contact and by friction needs no rod, and the
    /// pivots are those of other rows now.
    fn has_other_rows<T: Scalar>(&self, dynamics: &Dynamics<T>) -> bool {
        let mut pairs = self.aside.iter().zip(&self.rows);
        dynamics.acting_rows().len() != self.acting
            && pairs.any(|(aside, &row)| *aside != dynamics.holds_aside(row))
    }

    /// Takes which rows are held aside; whether they are others.
    fn take_rows_aside<T: Scalar>(&mut self, dynamics: &Dynamics<T>) -> bool {
        let others = self.has_other_rows(dynamics);
        if others {
            self.largest.fill(0.0);
        }
        self.acting = dynamics.acting_rows().len();
        for (aside, &row) in self.aside.iter_mut().zip(&self.rows) {
            *aside = dynamics.holds_aside(row);
        }
        others
    }

    /// Pivots at the state that `dynamics` has evaluated.
    fn measure<T: Scalar>(&mut self, dynamics: &Dynamics<T>) {
        self.measured = Some(dynamics.work());
        let d = dynamics.description();
        let n = d.coordinates.len();
        self.scaled.fill(0.0);
        let m = self.rows.len();
        for (k, &row) in self.rows.iter().enumerate() {
            if !dynamics.holds_aside(row) {
                for &(j, place) in d.rows[row].jacobian {
                    self.scaled[k * n + j] = dynamics.motion(place).value() * self.inverse_roots[j];
                }
            }
        }
        for i in 0..m {
            let row = &self.scaled[i * n..(i + 1) * n];
            for j in 0..=i {
                let other = &self.scaled[j * n..(j + 1) * n];
                let sum = row.iter().zip(other).map(|(x, y)| x * y).sum();
                (self.gram[i * m + j], self.gram[j * m + i]) = (sum, sum);
            }
        }
        self.eliminate();
    }

    /// Pivots of the Gram matrix, descending.
    fn eliminate(&mut self) {
        let m = self.rows.len();
        self.pivots.fill(0.0);
        for step in 0..m {
            let best =
                (step..m).max_by(|&a, &b| self.gram[a * m + a].total_cmp(&self.gram[b * m + b]));
            let best = best.unwrap_or(step);
            if best != step {
                for k in 0..m {
                    self.gram.swap(step * m + k, best * m + k);
                }
                for k in 0..m {
                    self.gram.swap(k * m + step, k * m + best);
                }
            }
            let pivot = self.gram[step * m + step];
            if !(pivot > 0.0) {
                break;
            }
            self.pivots[step] = pivot;
            for i in step + 1..m {
                let factor = self.gram[i * m + step] / pivot;
                for j in step + 1..m {
                    self.gram[i * m + j] -= factor * self.gram[step * m + j];
                }
            }
        }
    }
}

impl<T: Scalar> Run<T> {
    /// Whether a step that ends at this distance from a loss of rank ends too close to it.
    pub(super) fn ends_close(&self, distance: f64) -> bool {
        self.rank.watches()
            && distance < NEARER * self.now.distance
            && distance
                < self
                    .distance_for(ROUNDINGS_OF_LEAPS)
                    .clamp(CLOSE, CLOSEST_LEAP)
    }

    /// Whether the step at hand begins near a loss of rank, ends near one or passes it: only Taylor series leap over it, other
    /// methods may go on along another branch of the constraints.
    pub(super) fn passes_close(&mut self) -> bool {
        if !self.rank.watches() {
            return false;
        }
        self.now.distance < DOUBTFUL
            || [0.5, 1.0].into_iter().any(|s| {
                self.evaluate_end(s).is_err() || self.rank.distance(&self.dynamics) < DOUBTFUL
            })
    }

    /// Tries a step over the loss of rank that one of length `h` comes too close to; what happens first in it.
    ///
    /// Nothing if none is good enough; else the step is made up to the first hit in it or the end of the run, and its end evaluated.
    ///
    /// # Errors
    /// The mode would have to change so near to the loss of rank that rounding decides how.
    pub(super) fn leap(&mut self, h: f64) -> Result<Option<Hit>, Error> {
        let Some(way) = self.way_to_loss(h) else {
            return Ok(None);
        };
        let Some(h) = self.steps_over(way) else {
            return Ok(None);
        };
        let longest = self.end - self.now.t.value();
        if longest < h {
            self.stepper.step.shorten(longest / h);
        }
        if !self.samples_hold() {
            return Ok(None);
        }
        self.sharpen_roots(1.0, 1.0);
        let hit = self.first_hit();
        let distance = self.distance_at(hit.end());
        let near = distance < self.least_distance();
        if hit.end() == 0.0 || self.misses_a_mark(hit.end()) || !self.keeps_bounds_until(hit.end())
        {
            return Ok(None);
        }
        self.look_at_end(hit.end());
        if self.misses_its_root(&hit) {
            return Ok(None);
        }
        if near && matches!(hit, Hit::Guards(_)) {
            return Err(self.undecided_hit(&hit, distance));
        }
        if near {
            self.now.distance = distance;
            self.evaluate_at_or_before(T::from_f64(hit.end()));
        } else {
            self.evaluate_end(hit.end()).map_err(|e| self.error(e))?;
            self.now.distance = self.rank.reach(&self.dynamics);
        }
        Ok(Some(hit))
    }

    /// Nearer than this to a loss of rank, velocities are known less exactly than a step may be off.
    pub(super) fn least_distance(&self) -> f64 {
        self.distance_for(ROUNDINGS).min(CLOSE)
    }

    /// The distance at which so many units of rounding, over its square, are what a step may be off. Positions are known to rounding, the rows of
    /// constraints to rounding by the distance, and the way along them to rounding by its square.
    fn distance_for(&self, roundings: f64) -> f64 {
        (roundings * epsilon::<T>() / self.settings.tolerance).sqrt()
    }

    /// Why the motion cannot go on from a hit so near to a loss of rank.
    fn undecided_hit(&self, hit: &Hit, distance: f64) -> Error {
        let d = self.description();
        let names = self.locator.fallen.iter().filter_map(|guard| guard.name(d));
        Error::Singular {
            time: self.stepper.step.time(T::from_f64(hit.end())).value(),
            mode: self.mode_in_words(),
            items: names.collect(),
            reason: format!(
                "something happens where constraints lose rank, as those of aligned bars do (at {distance:.1e} of the largest distance from there): \
                 rounding decides how the motion goes on; let it happen elsewhere, or ask for less accuracy"
            ),
        }
    }

    /// Whether the motion has come so near to a loss of rank that its equations say nothing reliable any more.
    pub(super) fn is_lost(&self) -> bool {
        self.now.distance < self.least_distance().max(LOST)
    }

    /// Why the motion cannot go on so near to a loss of rank.
    pub(super) fn lost_rank(&self) -> Error {
        Error::Singular {
            time: self.now.t.value(),
            mode: self.mode_in_words(),
            items: Vec::new(),
            reason: format!(
                "constraints lose rank here, as those of aligned bars do (at {:.1e} of the largest distance from there), and no step over the \
                 position is exact enough; another tolerance may pass it, an offset of a part avoids it",
                self.now.distance,
            ),
        }
    }

    /// Samples the guards along a leap: what is a function of the motion may be no polynomial of its degree. Whether their interpolation is good.
    fn samples_hold(&mut self) -> bool {
        self.sample().is_ok()
            && self
                .interpolation_defect()
                .is_ok_and(|defect| defect <= 1.0)
    }

    /// Whether constraints are about to lose their rank at the present state: their forces belong to another instant.
    pub(super) fn is_undecided(&self) -> bool {
        self.now.distance < UNDECIDED
    }

    /// Distance from a loss of rank at part `s` of the step at hand; 0 where the equations cannot be solved.
    fn distance_at(&mut self, s: f64) -> f64 {
        match self.evaluate_end(s) {
            Ok(()) => self.rank.distance(&self.dynamics),
            Err(_) => 0.0,
        }
    }

    /// How long it is to the loss of rank that a step of length `h` comes near: where the square of the distance has its least value, as a parabola has it.
    fn way_to_loss(&mut self, h: f64) -> Option<f64> {
        self.write_polynomial(h, self.stepper.order);
        let places = [0.5, 0.75, 1.0];
        let squares = places.map(|s| self.distance_at(s).powi(2));
        let (slope, bend) = (
            squares[2] - squares[0],
            squares[2] - 2.0 * squares[1] + squares[0],
        );
        let least = places[1] - 0.25 * 0.5 * slope / bend;
        (bend > 0.0 && least > 0.0 && least < FARTHEST).then_some(least * h)
    }

    /// Makes a step over a loss of rank that is this `way` off; its length, if one is good.
    fn steps_over(&mut self, way: f64) -> Option<f64> {
        let mut bearable = None;
        for h in WAYS.map(|ways| ways * way) {
            match self.leaps(h) {
                Some(left) if left <= CLEAN => return Some(h),
                Some(left) if left <= BEARABLE => bearable = bearable.or(Some(h)),
                _ => {}
            }
        }
        let h = bearable?;
        // The step at hand is that of another length.
        self.leaps(h).map(|_| h)
    }

    /// Makes a step of length `h` over a loss of rank; what rounding leaves of its error, if it is good otherwise.
    fn leaps(&mut self, h: f64) -> Option<f64> {
        let mut best = (NEAR_ENOUGH, None);
        for degree in LEAST_DEGREE..=self.stepper.order.min(COEFFICIENTS) {
            let defect = self.defect_of_series(h, degree);
            if defect < best.0 {
                best = (defect, Some(degree));
            }
        }
        self.write_polynomial(h, best.1?);
        let left = self.collocate()?;
        let defect = self.defect_onto_constraints()?;
        let distance = self.rank.distance(&self.dynamics);
        (defect <= GOOD && !self.ends_close(distance)).then_some(left)
    }

    /// How far the series at hand, up to this degree, is off after a step of length `h`, in units of what a step may get wrong.
    fn defect_of_series(&mut self, h: f64, degree: usize) -> f64 {
        self.write_polynomial(h, degree);
        self.defect_onto_constraints().unwrap_or(f64::INFINITY)
    }

    /// How far the step at hand is off at its end, in units of what a step may get wrong, by the accelerations of the state that is nearest to it on the
    /// constraints: off these, where one follows from others, there are none.
    fn defect_onto_constraints(&mut self) -> Option<f64> {
        self.evaluate_onto_constraints(1.0).ok()?;
        let acceleration = self.dynamics.acceleration();
        let tolerance = self.settings.per_step();
        Some(taylor::defect(
            &self.stepper.step,
            1.0,
            acceleration,
            tolerance,
        ))
    }
}
