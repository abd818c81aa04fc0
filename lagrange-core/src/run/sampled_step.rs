//! A step by another method than Taylor's, whose guards are known by samples.

use super::hit::Hit;
use super::stepping::CAREFUL;
use super::taylor_step::ASTRAY;
use super::{Progress, Run};
use crate::arithmetic::Scalar;
use crate::dynamics::EvaluationError;
use crate::error::Error;
use crate::integrate::Integrator;
use crate::trajectory::State;

/// So many times a step is made shorter because the interpolation of its guards does not hold.
const MOST_TRIES: usize = 10;

/// What exponents may rise by in a step of other methods than Taylor's, as an order.
const SLOW_ORDER: usize = 4;

/// A step that is made again to end at a hit ends so much later, as a share of it, to see it once more; and then once more so near that what
/// lies before the end of a step is as good as the end.
const PAST: [f64; 2] = [1e-3, 1e-6];

/// A step in which an interpolation vanishes and its guard does not is made shorter by this factor.
const NO_ROOT: f64 = 0.5;

/// Careful steps grow by this factor at most, where methods have 5 to 10.
const GROWTH: f64 = 1.5;

/// Up to this order series tell how forces change in a step of a stiff method; terms of higher ones are those of fast motions that have died out.
const STIFF_ORDER: usize = 5;

/// Steps of so many times the resolution of time are left to Taylor series.
const KINK: f64 = 1e4;

impl<T: Scalar> Run<T> {
    /// Makes a step by the method from the present state and finds what happens first in it; by Taylor series where that is beyond the method.
    pub(super) fn sampled_step(&mut self) -> Result<Hit, Error> {
        if self.now.series == Progress::Begun {
            // What it begins with does not stay.
            self.now.series = Progress::None;
        }
        if self.dynamics.has_rows_aside() {
            self.dynamics.hold_rows_aside(false);
            self.evaluate()?;
            self.dynamics.hold_rows_aside(!self.is_undecided());
        }
        if self.flies_low() {
            return self.taylor_step();
        }
        let longest = self.end - self.now.t.value();
        let Some(method) = &mut self.stepper.other else {
            return Ok(Hit::Nothing);
        };
        let (from, tolerance) = (self.now.start(), self.settings.per_step());
        let first = match self.stepper.wanted {
            Some(h) => Ok(h),
            None => method.first_step(&mut self.dynamics, from, longest, tolerance),
        };
        // Long steps make derivatives of fast motions grow that have died out.
        let stiff = method.is_stiff() && T::DERIVATIVES == 0;
        let first = first.map_err(|e| self.no_step(e))?;
        let first = match self.settings.careful {
            true => self.careful_step(first),
            false => first,
        };
        let shown = self.longest_of_slips(first, stiff);
        // Explicit steps that stability bounds leave of a slip whose direction is stiff errors of the size that is allowed, and friction along them does not bring
        // it to rest where it is hardly more than what drives it. Those of Taylor series are smaller in steps that are hardly shorter.
        if self.stepper.astray > ASTRAY && !stiff {
            return self.taylor_step();
        }
        // Where a slip is about to vanish its direction may follow the forces faster than Taylor series can.
        if shown < first && !(stiff && shown > KINK * self.resolution(first)) {
            return self.taylor_step();
        }
        let mut h = self.whole_step(shown, longest).min(longest);
        h = h.min(self.longest_at_rest());
        if self.switcher.redundant.has_open() && self.expand().is_ok() {
            let order = if stiff {
                STIFF_ORDER
            } else {
                self.stepper.order
            };
            h = h.min(self.longest_of_shared_loads(order));
        }
        let shortest = KINK * self.resolution(h);
        let (mut tries, mut shortened) = (0, 0);
        while tries < MOST_TRIES {
            if h <= shortest && self.locator.polynomials.get(0).is_some() {
                break;
            }
            let next = self.integrate(h)?;
            if let Some(step) = self.loses_motion() {
                return Err(self.step_too_large(step));
            }
            if self.passes_close() {
                break;
            }
            if let Some(shorter) = self.hides(1.0, SLOW_ORDER, shortened) {
                shortened += 1;
                self.recorder.trajectory.work.rejected += 1;
                h = shorter;
                continue;
            }
            let sampled = self.sample().and_then(|()| self.interpolation_defect());
            let defect = match sampled {
                Ok(defect) => defect,
                // Something has no value beyond a place that the step passes.
                Err(_) if self.stepper.step.h.value() > shortest => {
                    h = NO_ROOT * self.stepper.step.h.value();
                    self.recorder.trajectory.work.rejected += 1;
                    continue;
                }
                Err(error) => return Err(self.error(error)),
            };
            h = self.stretch(defect) * self.stepper.step.h.value();
            self.stepper.wanted = Some(next.min(h));
            if defect <= 1.0 {
                if let Some(hit) = self.hit_among_samples()? {
                    return Ok(hit);
                }
                h = NO_ROOT * self.stepper.step.h.value();
            }
            self.recorder.trajectory.work.rejected += 1;
            tries += 1;
        }
        // Where a guard has a kink no interpolation holds; where constraints lose rank no step does.
        self.stepper.wanted = None;
        self.taylor_step()
    }

    /// A step that is shorter than `h`, which the method would take, where it is the first or has grown fast.
    fn careful_step(&self, h: f64) -> f64 {
        match self.stepper.wanted {
            Some(_) => h.min(GROWTH * self.stepper.made),
            None => CAREFUL * h,
        }
    }

    /// A step with which whole steps meet the end if fixed steps of length `h` do but for rounding: what rounding leaves of the time
    /// would be a step of its own, too short for its accelerations to mean anything.
    fn whole_step(&self, h: f64, longest: f64) -> f64 {
        let fixed = self.settings.method.has_fixed_steps();
        let whole = (longest / h).round();
        // Each step ends at a time that is rounded.
        let rounding = whole * self.resolution(longest);
        match fixed && whole >= 1.0 && (whole * h - longest).abs() <= rounding {
            true => longest / whole,
            false => h,
        }
    }

    /// One step of a method other than Taylor's, of at most `h`; the step that it would like to take next.
    fn integrate(&mut self, h: f64) -> Result<f64, Error> {
        let Some(method) = &mut self.stepper.other else {
            return Ok(h);
        };
        // The stages of the step leave other numbers than those of the present state, where it may yet end.
        self.now.valued = false;
        let (from, tolerance) = (self.now.start(), self.settings.per_step());
        let (dynamics, step) = (&mut self.dynamics, &mut self.stepper.step);
        match method.step(dynamics, from, h, tolerance, step) {
            Ok(accepted) => {
                self.recorder.trajectory.work.rejected += accepted.rejected;
                Ok(accepted.h_next)
            }
            Err(error) => Err(self.no_step(error)),
        }
    }

    /// Samples the guards along the step.
    pub(super) fn sample(&mut self) -> Result<(), EvaluationError> {
        let State { q, v, .. } = &mut self.stepper.scratch;
        let (curves, dynamics) = (&mut self.locator.polynomials, &mut self.dynamics);
        curves.sample(dynamics, &self.now.mode, &self.stepper.step, q, v)
    }

    /// What happens first in a step whose guards were sampled; nothing where it is a guard that does not vanish there: its interpolation
    /// does, between samples that are all much farther from zero.
    fn hit_among_samples(&mut self) -> Result<Option<Hit>, Error> {
        let (mut corrections, mut closer, mut turned) = (0, PAST.iter(), false);
        loop {
            self.sharpen_roots(1.0, 1.0);
            let hit = self.first_hit();
            // What happens close to the start is for a method that can make any step.
            if hit.end() == 0.0 || self.hides_a_start() {
                return self.taylor_step().map(Some);
            }
            if self.passes_over_touches(&hit, 1.0) {
                self.sample().map_err(|e| self.error(e))?;
                continue;
            }
            // Where something has no value at the end the step has passed that place.
            if self.evaluate_end(hit.end()).is_err() {
                return Ok(None);
            }
            if self.misses_a_mark(hit.end()) || self.misses_its_root(&hit) {
                return Ok(None);
            }
            self.now.distance = self.rank.reach(&self.dynamics);
            if !self.corrects_composites(&hit, hit.end(), &mut corrections) {
                // What happens, and what only just does or does not, is as exact as the ends of steps are.
                let method = self.stepper.other.as_deref();
                let best = method.is_some_and(Integrator::is_best_at_end);
                let turn = if best && !turned {
                    self.locator.polynomials.first_turn(hit.end())
                } else {
                    None
                };
                let part = match turn {
                    Some(turn) => {
                        turned = true;
                        turn
                    }
                    None if best => closer.next().map_or(1.0, |past| hit.end() * (1.0 + past)),
                    None => 1.0,
                };
                if part >= 1.0 {
                    self.stepper.breaks = 0;
                    return Ok(Some(hit));
                }
                let h = part * self.stepper.step.h.value();
                if h <= KINK * self.resolution(h) {
                    return self.taylor_step().map(Some);
                }
                self.integrate(h)?;
            }
            self.sample().map_err(|e| self.error(e))?;
        }
    }
}
