//! The instant of an event as a number of the run's own scalar.
//!
//! A root is located in doubles. It depends on parameters and start as the guard does, dt/dp = −(∂g/∂p)/ġ: a Newton step from
//! the located root in the run's scalar, which changes derivatives only. The slope ġ is that of the guard itself: its polynomial is as
//! good as where it vanishes needs, and no better. State and time are then taken there, and an impact
//! or switch acts on them; the motion that follows has all terms of a saltation matrix (Leine & Nijmeijer 2004, chapter 7).

use super::Run;
use super::hit::Hit;
use crate::arithmetic::{Scalar, derivatives};
use crate::integrate::polynomial_derivative as slope;
use crate::integrate::polynomial_value as value;
use crate::modes::exact::{exact, slip};
use crate::modes::guard::Guard;
use core::ops::Range;

/// Newton steps beyond the order of the derivatives, because slopes are taken from differences.
const MORE_STEPS: usize = 2;
/// The slope at a root is taken from so far before it, as a share of the way to it.
const SHARE: f64 = 1e-3;
/// A guard whose slope at its root is less than this share of that just before only touches zero.
const TOUCHES: f64 = 1e-2;

impl<T: Scalar> Run<T> {
    /// The part of the step at which it ends, with derivatives; the state there in `scratch`, evaluated if that at the located
    /// end was.
    pub(super) fn exact_end(&mut self, hit: &Hit) -> T {
        let end = hit.end();
        if T::DERIVATIVES == 0 || end == 0.0 {
            return T::from_f64(end);
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
            Hit::Guards(_) => {
                let rest = self.locator.rests.first();
                let rest = rest.map(|rest| Guard::Slip(rest.friction));
                rest.or(self.locator.fallen.first().copied())
            }
            Hit::Stop(i, _) => {
                let terms = 0..self.description().stops[i].terms.len();
                let nearest = nearest(terms, end, |k| self.locator.polynomials.stop_term(i, k));
                nearest.map(|(k, _)| Guard::Stop(i, k))
            }
        };
        let root = guard.and_then(|guard| self.root(guard, end));
        let Some(s) = root else {
            return T::from_f64(end);
        };
        self.settle_end(s, end)
    }

    /// A located root of `guard` with derivatives; where the guard only touches zero, those of the instant at which it turns. Nothing where it has no
    /// value, or no slope, near there.
    pub(super) fn root(&mut self, guard: Guard, located: f64) -> Option<T> {
        let mut s = T::from_f64(located);
        let apart = match located > 0.0 {
            true => SHARE * located,
            false => -SHARE,
        };
        let [far, near, there] = self.up_to(guard, s, apart)?.map(T::value);
        let (slope, bend) = (3.0 * there - 4.0 * near + far, there - 2.0 * near + far);
        let touches = slope.abs() <= TOUCHES * 2.0 * (there - near).abs();
        let factor = match touches {
            true => 0.5 * apart / bend,
            false => 2.0 * apart / slope,
        };
        if !factor.is_finite() {
            return None;
        }
        for _ in 0..T::DERIVATIVES + MORE_STEPS {
            let vanishes = if touches {
                let [far, near, there] = self.up_to(guard, s, apart)?;
                T::from_f64(3.0) * there - T::from_f64(4.0) * near + far
            } else {
                self.exact_guard(guard, s)?
            };
            s -= derivatives(vanishes) * T::from_f64(factor);
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
