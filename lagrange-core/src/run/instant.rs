//! The instant of an event as a number of the run's own scalar.
//!
//! A root is located in doubles. It depends on parameters and start as the guard does, dt/dp = −(∂g/∂p)/ġ: a Newton step from
//! the located root in the run's scalar, which changes derivatives only. State and time are then taken there, and an impact
//! or switch acts on them; the motion that follows has all terms of a saltation matrix (Leine & Nijmeijer 2004, chapter 7).

use super::Run;
use super::hit::Hit;
use crate::arithmetic::{Scalar, derivatives};
use crate::integrate::polynomial_derivative as slope;
use crate::integrate::polynomial_value as value;
use crate::modes::exact::{exact, slip};
use crate::modes::guard::Guard;
use core::ops::Range;

/// Newton steps beyond the order of the derivatives, because the slope is known to interpolation only.
const MORE_STEPS: usize = 2;

impl<T: Scalar> Run<T> {
    /// The part of the step at which it ends, with derivatives; the state there in `scratch`, evaluated if that at the located
    /// end was.
    pub(super) fn exact_end(&mut self, hit: &Hit) -> T {
        let end = hit.end();
        if T::DERIVATIVES == 0 || end == 0.0 {
            return T::from_f64(end);
        }
        let h = self.stepper.step.h.value();
        let (guard, slope) = match *hit {
            // At the last instant the time itself has no derivatives.
            Hit::Nothing | Hit::Turned(_) => {
                if end < 1.0 || !self.is_spent(self.end - self.now.t.value() - h) {
                    return T::from_f64(end);
                }
                let s = T::one()
                    - derivatives(self.stepper.step.t + self.stepper.step.h) / self.stepper.step.h;
                return self.settle_end(s, end);
            }
            Hit::Guards(_) => {
                if let Some(rest) = self.locator.rests.first() {
                    (Guard::Slip(rest.friction), rest.slope * h)
                } else if let Some(&guard) = self.locator.fallen.first()
                    && let Some(curve) = self.locator.polynomials.of(guard)
                {
                    (guard, slope(curve, end))
                } else {
                    return T::from_f64(end);
                }
            }
            Hit::Stop(i, _) => {
                let terms = 0..self.description().stops[i].terms.len();
                match nearest(terms, end, |k| self.locator.polynomials.stop_term(i, k)) {
                    Some((k, slope)) => (Guard::Stop(i, k), slope),
                    None => return T::from_f64(end),
                }
            }
        };
        let slope = match guard {
            Guard::Composite(_) => self.slope_before(guard, end).unwrap_or(slope),
            _ => slope,
        };
        let s = self.root(guard, slope, end);
        self.settle_end(s, end)
    }

    /// What a guard changes by per step just before part `end` of the step. A composite guard that has been found anew at its root has other weights
    /// than its polynomial.
    fn slope_before(&mut self, guard: Guard, end: f64) -> Option<f64> {
        /// The share of the way to the root over which the slope is taken.
        const SHARE: f64 = 1e-4;
        let [before, there] = [1.0 - SHARE, 1.0].map(|share| T::from_f64(share * end));
        let (before, there) = (
            self.exact_guard(guard, before)?,
            self.exact_guard(guard, there)?,
        );
        Some((there - before).value() / (SHARE * end))
    }

    /// A located root of `guard`, which changes by `slope` per step there, with derivatives. The value stays.
    pub(super) fn root(&mut self, guard: Guard, slope: f64, located: f64) -> T {
        let mut s = T::from_f64(located);
        if T::DERIVATIVES == 0 || !(slope != 0.0 && slope.is_finite()) {
            return s;
        }
        for _ in 0..T::DERIVATIVES + MORE_STEPS {
            let Some(value) = self.exact_guard(guard, s) else {
                return T::from_f64(located);
            };
            s -= derivatives(value) / T::from_f64(slope);
        }
        s
    }

    /// Part `s` of the step, where mark `mark` was located, with derivatives.
    pub(super) fn exact_mark(&mut self, mark: usize, s: f64) -> T {
        if T::DERIVATIVES == 0 || s == 0.0 {
            return T::from_f64(s);
        }
        let terms = 0..self.description().marks[mark].terms.len();
        match nearest(terms, s, |k| self.locator.polynomials.mark_term(mark, k)) {
            Some((k, slope)) => self.root(Guard::Mark(mark, k), slope, s),
            None => T::from_f64(s),
        }
    }

    /// A guard at part `s` of the step.
    fn exact_guard(&mut self, guard: Guard, s: T) -> Option<T> {
        let (q, v) = (&mut self.stepper.scratch.q, &mut self.stepper.scratch.v);
        self.stepper.step.state_into(s, q, v);
        let time = self.stepper.step.time(s);
        if let Guard::Slip(f) = guard
            && let Some(rest) = self.locator.rests.iter().find(|rest| rest.friction == f)
        {
            self.dynamics.tape(time, q, v);
            return Some(slip(f, rest.along.map(T::from_f64), &self.dynamics));
        }
        self.dynamics.value_along(time, q, v).ok()?;
        if matches!(guard, Guard::Stop(..) | Guard::Mark(..) | Guard::Branch(_)) {
            self.dynamics.report_value();
        }
        if let Guard::Composite(_) = guard {
            self.take_admissible_forces();
        }
        Some(exact(
            guard,
            &self.locator.polynomials.composites,
            &self.now.mode,
            &self.dynamics,
        ))
    }

    /// The state at part `s` of the step, in `scratch`, evaluated; at `located` if that cannot be.
    fn settle_end(&mut self, s: T, located: f64) -> T {
        for s in [s, T::from_f64(located)] {
            let (q, v) = (&mut self.stepper.scratch.q, &mut self.stepper.scratch.v);
            self.stepper.step.state_into(s, q, v);
            if !self.locator.rests.is_empty()
                || self
                    .dynamics
                    .value_along(self.stepper.step.time(s), q, v)
                    .is_ok()
            {
                return s;
            }
        }
        T::from_f64(located)
    }
}

/// The term whose root is nearest to `s`, and its slope there.
pub(super) fn nearest<'c>(
    terms: Range<usize>,
    s: f64,
    curve: impl Fn(usize) -> &'c [f64],
) -> Option<(usize, f64)> {
    let slopes = terms.map(|k| (k, slope(curve(k), s)));
    let distance = |&(k, slope): &(usize, f64)| (value(curve(k), s) / slope).abs();
    slopes.min_by(|a, b| distance(a).total_cmp(&distance(b)))
}
