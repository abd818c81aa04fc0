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

/// Newton steps beyond the order of the derivatives, for slopes that are taken from differences.
const MORE_STEPS: usize = 2;
/// Guards are compared over this part of the step.
const APART: f64 = 1e-3;
/// A guard that turns within this share of the way to its root from there only touches zero.
const TOUCHES: f64 = 1e-5;
/// What a step begins with is zero if it is no more than this share of what it changes by over that part.
const VANISHES: f64 = 1e-3;

impl<T: Scalar> Run<T> {
    /// The part of the step at which it ends, with derivatives; the state there in `scratch`, evaluated if that at the located
    /// end was.
    pub(super) fn exact_end(&mut self, hit: &Hit) -> T {
        let end = hit.end();
        // What follows from something that has happened at this instant has its derivatives, and the start of a run has none.
        let begins = !self.switcher.stuck.is_empty() || self.recorder.trajectory.work.steps == 0;
        if T::DERIVATIVES == 0 || end == 0.0 && begins {
            return T::from_f64(end);
        }
        if end == 0.0 {
            self.now.outdate();
        }
        let guard = match *hit {
            // At the last instant the time itself has no derivatives.
            Hit::Nothing | Hit::Turned(_) => {
                let h = self.stepper.step.h;
                if end < 1.0 || !self.is_spent(self.end - self.now.t.value() - h.value()) {
                    return T::from_f64(end);
                }
                let s = T::one() - derivatives(self.stepper.step.t + h) / h;
                return self.settle_end(s, end);
            }
            Hit::Guards(_) => match (self.locator.rests.first(), self.locator.fallen.first()) {
                (Some(rest), _) => Some((Guard::Slip(rest.friction), None)),
                (None, Some(&guard)) => {
                    let curve = self.locator.polynomials.of(guard);
                    Some((guard, curve.map(|curve| slope(curve, end))))
                }
                (None, None) => None,
            },
            Hit::Stop(i, _) => {
                let terms = 0..self.description().stops[i].terms.len();
                let nearest = nearest(terms, end, |k| self.locator.polynomials.stop_term(i, k));
                nearest.map(|(k, slope)| (Guard::Stop(i, k), Some(slope)))
            }
        };
        let root = guard.and_then(|(guard, slope)| self.root(guard, slope, end));
        let Some(s) = root else {
            return T::from_f64(end);
        };
        self.settle_end(s, end)
    }

    /// Part `s` of the step, where mark `mark` was located, with derivatives.
    pub(super) fn exact_mark(&mut self, mark: usize, s: f64) -> T {
        let located = T::from_f64(s);
        if T::DERIVATIVES == 0 {
            return located;
        }
        let terms = 0..self.description().marks[mark].terms.len();
        let nearest = nearest(terms, s, |k| self.locator.polynomials.mark_term(mark, k));
        let root = nearest.and_then(|(k, slope)| self.root(Guard::Mark(mark, k), Some(slope), s));
        root.unwrap_or(located)
    }

    /// A located root of `guard`, whose polynomial has this `slope` there, with derivatives; where the guard only touches zero, those of the instant at
    /// which it turns. Nothing where it has no value or no slope, or has jumped over zero with the start of the step.
    ///
    /// A polynomial by interpolation is good where it vanishes only, and a composite guard that has been found anew at its root has other weights.
    fn root(&mut self, guard: Guard, slope: Option<f64>, located: f64) -> Option<T> {
        let mut s = T::from_f64(located);
        let apart = match located > 2.0 * APART {
            true => APART,
            false => -APART,
        };
        // The guard may have no value there although it has one at its root.
        let values = self.up_to(guard, s, apart);
        let [bend, jumps] = values.map_or([0.0, f64::INFINITY], |values| {
            let [far, near, there] = values.map(T::value);
            let bend = (there - 2.0 * near + far) / apart.powi(2);
            [bend, (there / (near - there)).abs()]
        });
        if located == 0.0 && jumps > VANISHES {
            return None;
        }
        let sharpened = self.locator.polynomials.are_sharpened();
        let slope = match slope {
            Some(slope) if !sharpened && !matches!(guard, Guard::Composite(_)) => slope,
            _ => slope_there(values?, apart).value(),
        };
        let way = if located > 0.0 { located } else { APART };
        let touches = slope.abs() <= TOUCHES * way * bend.abs();
        let rate = if touches { bend } else { slope };
        if !(rate != 0.0 && rate.is_finite()) {
            return None;
        }
        for _ in 0..T::DERIVATIVES + MORE_STEPS {
            let vanishes = match touches {
                true => slope_there(self.up_to(guard, s, apart)?, apart),
                false => self.exact_guard(guard, s)?,
            };
            s -= derivatives(vanishes) / T::from_f64(rate);
        }
        Some(s)
    }

    /// A guard at two places so far before part `s` of the step, and there.
    fn up_to(&mut self, guard: Guard, s: T, apart: f64) -> Option<[T; 3]> {
        let [far, near] = [2.0, 1.0].map(|times| s - T::from_f64(times * apart));
        Some([
            self.exact_guard(guard, far)?,
            self.exact_guard(guard, near)?,
            self.exact_guard(guard, s)?,
        ])
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

/// The slope at the last of three places that are so far apart.
fn slope_there<T: Scalar>([far, near, there]: [T; 3], apart: f64) -> T {
    let change = T::from_f64(3.0) * there - T::from_f64(4.0) * near + far;
    change / T::from_f64(2.0 * apart)
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
