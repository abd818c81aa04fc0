//! Isolated positions where constraints lose rank: a linkage in its dead position.
//!
//! The motion goes smoothly through such a position, but the equations cannot be solved there, and close to it rounding is
//! amplified by the inverse of the distance. A Taylor polynomial from some way before it is good beyond it: a step must
//! only not *end* close to it.
//!
//! How close is read from the pivots of G = A D⁻¹ Aᵀ (A the rows of constraints, D the diagonal of the mass matrix, each
//! element at its largest so far) in Cholesky's factorization with complete pivoting: the smallest of them that is not always zero, over its largest value
//! so far, is the square of a distance.

use super::Run;
use super::hit::Hit;
use crate::arithmetic::Scalar;
use crate::dynamics::Dynamics;
use crate::effects::{Effects, Item};
use crate::integrate::taylor;
use crate::system::{Description, ValueRef};

/// A step may come nearer to a loss of rank, or to its other side, by this factor.
const NEARER: f64 = 0.35;
/// Farther away than this from one it may end anywhere.
const CLOSE: f64 = 0.2;
/// A step that would end near such a position is tried this much longer, over it.
const LEAPS: [f64; 4] = [1.25, 1.5, 1.8, 2.2];
/// A leap is tried with any degree from this on.
pub(super) const LEAST_DEGREE: usize = 6;
/// Where no leap is good, the step is tried this much shorter.
pub(super) const RETREAT: f64 = 0.75;
/// So many times a step is tried shorter.
pub(super) const MOST_RETREATS: usize = 5;
/// Nearer than this to such a position the equations say nothing reliable about forces.
pub(super) const UNDECIDED: f64 = 1e-2;
/// Error of a leap in units of what is allowed for a step: no more than steps have, so that passages do not cost more digits than they do.
const GOOD: f64 = 0.3;
/// Error of a leap in the same units where a step begins so near that nothing better can be had any more.
const BEARABLE: f64 = 1e4;

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
    }

    /// Distance of the state that `dynamics` has evaluated from a loss of rank, 1 at the farthest so far.
    pub(super) fn distance<T: Scalar>(&mut self, dynamics: &Dynamics<T>) -> f64 {
        if self.rows.is_empty() {
            return 1.0;
        }
        self.fill(dynamics);
        self.eliminate();
        let mut nearest: f64 = 1.0;
        for (largest, pivot) in self.largest.iter_mut().zip(&self.pivots) {
            *largest = largest.max(*pivot);
        }
        let first = self.largest[0];
        for (largest, pivot) in self.largest.iter().zip(&self.pivots) {
            if *largest > DEPENDENT * first {
                nearest = nearest.min((pivot / largest).max(0.0).sqrt());
            }
        }
        nearest
    }

    fn fill<T: Scalar>(&mut self, dynamics: &Dynamics<T>) {
        let d = dynamics.description();
        let n = d.coordinates.len();
        let number = |place: ValueRef| dynamics.motion(place).value();
        for &(i, j, place) in d.mass {
            let mass = number(place);
            if i == j && mass > self.masses[i] {
                self.masses[i] = mass;
                self.inverse_roots[i] = 1.0 / mass.sqrt();
            }
        }
        // Pivots that were large because there was hardly any inertia say nothing: a quaternion that was nearly 1.
        let mut pairs = self.masses.iter().zip(&self.lighter);
        if pairs.any(|(mass, lighter)| *mass > HEAVIER * lighter) {
            self.largest.fill(0.0);
            self.lighter.copy_from_slice(&self.masses);
        }
        self.scaled.fill(0.0);
        let m = self.rows.len();
        let acting = dynamics.acting_rows().len();
        let switched = acting != self.acting;
        self.acting = acting;
        for (k, &row) in self.rows.iter().enumerate() {
            let aside = dynamics.holds_aside(row);
            if aside != self.aside[k] && switched {
                // A body that rests on a contact and by friction needs no rod: the pivots are those of other rows now.
                self.largest.fill(0.0);
            }
            self.aside[k] = aside;
            if !aside {
                for &(j, place) in d.rows[row].jacobian {
                    self.scaled[k * n + j] = number(place) * self.inverse_roots[j];
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
        distance < CLOSE && distance < NEARER * self.now.distance
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
    /// Rounding enters the equations amplified and grows through the coefficients as if the solution had a pole there; the
    /// truncation error falls with the order. The length and order with the least defect beyond are the best compromise. Nothing if none
    /// is good enough, or if the mode would have to be decided close to the loss of rank; else the step is made up to the first hit
    /// in it or the end of the run, and its end evaluated.
    pub(super) fn leap(&mut self, h: f64) -> Option<Hit> {
        let mut least = if self.now.distance < CLOSE {
            BEARABLE
        } else {
            GOOD
        };
        let mut best = None;
        for leap in LEAPS {
            for degree in LEAST_DEGREE..=self.stepper.order {
                if let Some((defect, distance)) = self.beyond(leap * h, degree)
                    && defect < least
                    && distance >= NEARER * NEARER * self.now.distance
                {
                    (least, best) = (defect, Some((leap * h, degree)));
                }
            }
        }
        let (h, degree) = best?;
        self.write_polynomial(h.min(self.end - self.now.t.value()), degree);
        if self.samples_hold() {
            self.sharpen_roots(1.0);
        } else {
            self.locator.polynomials.take_series(
                &self.dynamics,
                &self.now.mode,
                &self.stepper.powers[..=degree],
            );
        }
        let hit = self.first_hit();
        let distance = self.distance_at(hit.end());
        let decides = matches!(hit, Hit::Guards(_));
        if hit.end() == 0.0 || decides && distance < UNDECIDED {
            return None;
        }
        let false_stop = matches!(hit, Hit::Stop(..)) && self.misses_its_root(&hit);
        if false_stop || self.misses_a_mark(hit.end()).is_ok_and(|misses| misses) {
            return None;
        }
        self.now.distance = distance;
        if distance < UNDECIDED {
            // Forces are known a little before only.
            let parts = [0.99, 0.9, 0.7, 0.4];
            _ = parts
                .into_iter()
                .find(|part| self.distance_at(part * hit.end()) >= UNDECIDED);
            self.state_at_end(hit.end());
        }
        Some(hit)
    }

    /// Samples the guards along a leap: the degree that is best for the motion may be too low for what is a function of it. Whether their interpolation is
    /// good; forces have no values close to the loss of rank.
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

    /// Defect and distance from a loss of rank at the end of a step of length `h` with a polynomial of this degree; nothing
    /// if it cannot be evaluated there.
    fn beyond(&mut self, h: f64, degree: usize) -> Option<(f64, f64)> {
        self.write_polynomial(h, degree);
        self.evaluate_end(1.0).ok()?;
        let acceleration = self.dynamics.acceleration();
        let defect = taylor::defect(
            &self.stepper.step,
            1.0,
            acceleration,
            self.settings.per_step(),
        );
        Some((defect, self.rank.distance(&self.dynamics)))
    }
}
