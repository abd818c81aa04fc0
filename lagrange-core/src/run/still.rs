//! Stops and marks that read only what the mode holds at rest: a mark of ẋ while friction holds a body on curved ground. Rounding of velocities that
//! are zero changes the sign of such a term again and again, and nothing happens.
//!
//! A coordinate is held at rest if no motion that the rows of the mode allow moves it. A term reads nothing else if it is what it was, to the last bit, where
//! the time and all other coordinates and velocities are others.

use super::Run;
use crate::arithmetic::Scalar;
use crate::integrate::polynomial_value;
use crate::mode::Mode;
use crate::modes::guard::{self, Guard};
use crate::modes::reading::Reading;
use crate::trajectory::State;

/// A term this near to zero, relative to the state and 1, may be what rounding leaves of it.
const NEARLY_ZERO: f64 = 1e-11;

/// A velocity no more than this, relative to the largest and 1, is zero,
const AT_REST: f64 = 1e-12;

/// if the rows leave no more than this of its direction, squared.
const HELD: f64 = 1e-12;

/// A row that adds no more than this to the others, relative and squared, follows from them.
const DEPENDENT: f64 = 1e-20;

/// By this much time and coordinates are changed.
const OTHERWISE: f64 = 1e-3;

/// The terms of stops and marks that are zero in a mode, and stay so.
#[derive(Debug)]
pub(super) struct StillWatches {
    /// The mode that has been looked at.
    mode: Option<Mode>,
    terms: Vec<Guard>,
}

/// How the rows of a mode hold a coordinate.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Held {
    /// They leave it some of its direction.
    Free,
    /// At rest, whatever the others do.
    AtRest,
    /// At a velocity that they give it.
    Driven,
}

impl StillWatches {
    pub(super) fn new() -> Self {
        Self {
            mode: None,
            terms: Vec::new(),
        }
    }

    /// Forgets what belongs to another motion.
    pub(super) fn restart(&mut self) {
        self.mode = None;
        self.terms.clear();
    }

    /// Whether a term stays zero in this mode, as far as has been looked.
    pub(super) fn contains(&self, term: Guard, mode: &Mode) -> bool {
        self.terms.contains(&term) && self.mode.as_ref() == Some(mode)
    }
}

impl<T: Scalar> Run<T> {
    /// Whether a term of a stop or of a mark is known to stay zero in the present mode.
    pub(super) fn is_still(&self, term: Guard) -> bool {
        self.locator.still.contains(term, &self.now.mode)
    }

    /// Looks once in a mode for terms that stay what they are, if one is zero at part `end` of the step but for rounding, and a coordinate is at rest there.
    /// Whether there are such.
    pub(super) fn look_for_still_watches(&mut self, end: f64) -> bool {
        if self.locator.still.mode.as_ref() == Some(&self.now.mode) {
            return false;
        }
        let curves = &self.locator.polynomials;
        if curves.stops.is_empty() && curves.marks.is_empty() {
            return false;
        }
        let State { q, v, .. } = &self.now.state;
        let larger = |size: f64, x: &T| size.max(x.value().abs());
        let speed = v.iter().fold(1.0, larger);
        let size = q.iter().fold(speed, larger);
        let zero = |run: &Self, term| run.term_at(term, end).abs() <= NEARLY_ZERO * size;
        if !self.watched_terms().any(|term| zero(self, term)) {
            return false;
        }
        self.state_at_end(end);
        let at_rest = |v: &T| v.value().abs() <= AT_REST * speed;
        if !self.stepper.scratch.v.iter().any(at_rest) {
            return false;
        }
        let resting: Vec<bool> = self.stepper.scratch.v.iter().map(at_rest).collect();
        let terms = self.watched_terms().filter(|&term| zero(self, term));
        let terms: Vec<Guard> = terms.collect();
        let found = self.still_terms(&terms, &resting);
        self.ask_for_guards();
        self.now.outdate();
        self.locator.still = StillWatches {
            mode: Some(self.now.mode.clone()),
            terms: found,
        };
        !self.locator.still.terms.is_empty()
    }

    /// A term of a stop or of a mark at part `s` of the step.
    fn term_at(&self, term: Guard, s: f64) -> f64 {
        let curves = &self.locator.polynomials;
        let (curve, at_end) = match term {
            Guard::Stop(i, k) => (curves.stop_term(i, k), curves.stop_end(i, k)),
            Guard::Mark(i, k) => (curves.mark_term(i, k), curves.mark_end(i, k)),
            _ => return f64::NAN,
        };
        if s == 1.0 {
            at_end
        } else {
            polynomial_value(curve, s)
        }
    }

    /// The terms of the stops and marks that take part.
    fn watched_terms(&self) -> impl Iterator<Item = Guard> {
        let d = self.description();
        let curves = &self.locator.polynomials;
        let stops = curves.stops.iter().flat_map(|&i| {
            let terms = 0..d.stops[i].terms.len();
            terms.map(move |k| Guard::Stop(i, k))
        });
        let marks = curves.marks.iter().flat_map(|&i| {
            let terms = 0..d.marks[i].terms.len();
            terms.map(move |k| Guard::Mark(i, k))
        });
        stops.chain(marks)
    }

    /// Those of these terms that read nothing but coordinates that are held, of those that are `resting`, at the state in `scratch`.
    fn still_terms(&mut self, terms: &[Guard], resting: &[bool]) -> Vec<Guard> {
        let n = resting.len();
        let here = self.stepper.scratch.clone();
        let changed = |x: T| x + T::from_f64(OTHERWISE * (1.0 + x.value().abs()));
        let zero = vec![T::zero(); n];
        self.ask_for_all_rows();
        let (t, later) = (self.now.t, changed(self.now.t));
        self.dynamics.tape(t, &here.q, &zero);
        let now = self.held_by_rows();
        let mut held: Vec<bool> = (0..n)
            .map(|j| resting[j] && now[j] == Held::AtRest)
            .collect();
        let there = loop {
            if !held.contains(&true) {
                return Vec::new();
            }
            let mut there = here.clone();
            for j in (0..n).filter(|&j| !held[j]) {
                there.q[j] = changed(here.q[j]);
                there.v[j] = changed(here.v[j]);
            }
            self.dynamics.tape(later, &there.q, &zero);
            let beside = self.held_by_rows();
            // At its turning point a coordinate is held for an instant.
            if (0..n).any(|j| held[j] && beside[j] == Held::Free) {
                return Vec::new();
            }
            if (0..n).all(|j| !held[j] || beside[j] == Held::AtRest) {
                break there;
            }
            // What is driven may be at rest for an instant.
            (0..n).for_each(|j| held[j] &= beside[j] == Held::AtRest);
        };
        let [before, after] = [(t, &here), (later, &there)].map(|(t, state)| {
            let known = self.dynamics.value(t, &state.q, &state.v);
            known.is_ok().then(|| {
                self.dynamics.report_value();
                let reading = Reading::Values(&self.dynamics);
                let values = terms.iter();
                let values = values.map(|&term| guard::value(term, &self.now.mode, &reading));
                values.collect::<Vec<f64>>()
            })
        });
        let (Some(before), Some(after)) = (before, after) else {
            return Vec::new();
        };
        let same = terms.iter().zip(before.iter().zip(&after));
        same.filter(|(_, (x, y))| x == y)
            .map(|(term, _)| *term)
            .collect()
    }

    /// How the rows of the mode hold each coordinate: what they leave of its direction, squared, in the metric of the diagonal of the mass matrix (Gram and
    /// Schmidt), and the velocity that they give it; `dynamics` holds the numbers of all rows at velocities that are zero.
    fn held_by_rows(&self) -> Vec<Held> {
        let d = self.description();
        let n = d.coordinates.len();
        let mut scales = vec![1.0; n];
        for &(i, j, place) in d.mass {
            let mass = self.dynamics.motion(place).value();
            if i == j && mass > 0.0 {
                scales[i] = 1.0 / mass.sqrt();
            }
        }
        let mut free = vec![1.0; n];
        // The velocity of least norm, and the sum of its parts without their signs.
        let mut given = vec![(0.0_f64, 0.0_f64); n];
        let mut basis: Vec<(Vec<f64>, f64)> = Vec::new();
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        for &row in self.dynamics.acting_rows() {
            let mut along = vec![0.0; n];
            for &(j, place) in d.rows[row].jacobian {
                along[j] = self.dynamics.motion(place).value() * scales[j];
            }
            let mut rate = self.dynamics.motion(d.rows[row].velocity).value();
            let whole = dot(&along, &along);
            for (other, of_other) in basis.iter().chain(&basis) {
                let share = dot(&along, other);
                along
                    .iter_mut()
                    .zip(other)
                    .for_each(|(x, y)| *x -= share * y);
                rate -= share * of_other;
            }
            let left = dot(&along, &along);
            if left > DEPENDENT * whole {
                along.iter_mut().for_each(|x| *x /= left.sqrt());
                rate /= left.sqrt();
                for ((free, given), x) in free.iter_mut().zip(&mut given).zip(&along) {
                    *free -= x * x;
                    *given = (given.0 + rate * x, given.1 + (rate * x).abs());
                }
                basis.push((along, rate));
            }
        }
        let held = free.iter().zip(given).map(|(&free, (velocity, size))| {
            if free > HELD {
                Held::Free
            } else if velocity.abs() > AT_REST * size {
                Held::Driven
            } else {
                Held::AtRest
            }
        });
        held.collect()
    }
}
