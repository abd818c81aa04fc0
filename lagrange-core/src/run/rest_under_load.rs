//! Steps of what rests under loads that change with time.
//!
//! Nothing of the motion bounds them, and a guard tells of what comes only by its series: a load sin²⁰t has none but zeros where it is zero, and
//! has come and gone within a second. Such a step is not much longer than the last one, and its guards are looked at within it.

use super::Run;
use super::hit::Hit;
use crate::arithmetic::Scalar;
use crate::integrate::taylor::worse;

/// Parts of a step at which guards are looked at: no two differ by the same, so that no load has the same value at all of them by its period.
pub(super) const WITHIN: [f64; 8] = [0.06, 0.17, 0.31, 0.42, 0.57, 0.69, 0.83, 0.95];
/// A step is so many times longer than the last one at most.
const GROWTH: f64 = 2.0;
/// The first step is this part of the span.
const FIRST: f64 = 1.0 / 64.0;

impl<T: Scalar> Run<T> {
    /// Whether nothing moves, and what is watched may change with time.
    pub(super) fn rests_under_load(&self) -> bool {
        let rests = |(j, v): (usize, &T)| v.value().abs() <= self.settings.allowed(j, 0.0);
        self.changes_with_time
            && (self.locator.polynomials.get(0).is_some() || self.switcher.redundant.has_open())
            && !self.now.mode.has_slips()
            && self.now.state.v.iter().enumerate().all(rests)
    }

    /// How long a step may be at rest under load.
    pub(super) fn longest_at_rest(&self) -> f64 {
        if !self.rests_under_load() {
            return f64::INFINITY;
        }
        match self.recorder.trajectory.work.steps {
            0 => FIRST * (self.end - self.begin),
            _ => GROWTH * self.stepper.made,
        }
    }

    /// The largest [`Self::guard_defect`] within part `looked` of the step, where `dynamics` and `scratch` end again.
    pub(super) fn guard_defect_within(&mut self, hit: &Hit, looked: f64) -> f64 {
        let mut worst = 0.0;
        for part in WITHIN {
            worst = match self.evaluate_end(part * looked) {
                Ok(()) => worse(worst, self.guard_defect(hit, part * looked)),
                Err(_) => f64::INFINITY,
            };
        }
        match self.evaluate_end(looked) {
            Ok(()) => worst,
            Err(_) => f64::INFINITY,
        }
    }
}
