//! What is known between the stages of a step by interpolation: the dense output is compared with the equations, and guards that are known
//! by samples with the guards themselves.
//!
//! A step of a Runge–Kutta method is chosen for the motion, and the motion of a ball in free flight allows any step. The
//! gap above a table that shakes does not: where the interpolation is off between its samples the step is made shorter.
//! Roots of the interpolation are then moved to where the guard vanishes on the dense output.

use super::guard_polynomials::Located;
use super::hit::Hit;
use super::instant::nearest;
use super::taylor_step::SHARPENED;
use super::{Run, rest_under_load};
use crate::arithmetic::Scalar;
use crate::dynamics::EvaluationError;
use crate::events::{Direction, Root, RootList, bracket, roots, zero_between};
use crate::integrate::polynomial_derivative as slope;
use crate::integrate::taylor::{defect, worse};
use crate::modes::guard::Guard;

/// What the next step aims at, in units of what is allowed.
const AIM: f64 = 0.3;
/// Part of a step at which the dense output is compared with the equations, where no guard is sampled.
const WITHIN: [f64; 1] = [0.4];
/// Step sizes change by these factors at most.
const FACTORS: [f64; 2] = [0.1, 5.0];

/// Roots of a polynomial and of its part are the same if they are no farther apart, as a part of the step.
const SAME: f64 = 1e-3;

/// A root of a guard, sharpened.
#[derive(Clone, Copy, Debug)]
pub(super) struct SharpRoot {
    guard: Guard,
    /// The root of its polynomial.
    interpolated: f64,
    /// The root of the guard on the dense output, or that of its polynomial where none is near.
    exact: f64,
    /// Whether the guard vanishes there.
    is_found: bool,
    /// Half the width of the interval within which rounding lets the root be.
    width: f64,
}

impl<T: Scalar> Run<T> {
    /// How far the dense output and the interpolated guards are off between their samples, in units of what is allowed.
    ///
    /// The error estimate of an explicit method is that of the end of the step. Where stability bounds the steps, fast motions are damped
    /// there that the dense output does not follow.
    pub(super) fn interpolation_defect(&mut self) -> Result<f64, EvaluationError> {
        let explicit = self.stepper.is_explicit();
        let guarded = self.locator.polynomials.get(0).is_some();
        if !guarded && !explicit {
            return Ok(0.0);
        }
        let mut worst = 0.0_f64;
        let mut note = |defect: f64| worst = worse(worst, defect);
        let places = self.locator.polynomials.between_samples();
        for &s in places.as_ref().map_or(&WITHIN[..], |places| places) {
            let known = self.evaluate_end(s);
            if known.is_err() {
                if !self.rank.watches() {
                    return known.map(|()| f64::NAN);
                }
                self.look_at_end(s);
            }
            if explicit && known.is_ok() {
                let accelerations = self.dynamics.acceleration();
                let tolerance = self.settings.per_step();
                note(defect(&self.stepper.step, s, accelerations, tolerance));
            }
            if guarded {
                note(self.defect_of_interpolation(s));
            }
        }
        if guarded && self.rests_under_load() {
            for s in rest_under_load::WITHIN {
                self.evaluate_end(s)?;
                worst = worse(worst, self.defect_of_interpolation(s));
            }
        }
        Ok(worst)
    }

    /// How far interpolated guards are off at part `s` of the step, which the dynamics have evaluated.
    fn defect_of_interpolation(&mut self, s: f64) -> f64 {
        let (curves, tolerance) = (&self.locator.polynomials, self.settings.tolerance);
        curves.interpolation_defect(&mut self.dynamics, &self.now.mode, s, tolerance)
    }

    /// By which factor a step with this defect may be longer, or has to be shorter.
    pub(super) fn stretch(&self, defect: f64) -> f64 {
        let [least, most] = FACTORS;
        let sampled = self.locator.polynomials.get(0).map(|(_, c)| c.len());
        let degree = sampled.unwrap_or(self.stepper.step.degree);
        let factor = (AIM / defect).powf(1.0 / degree as f64);
        if factor.is_nan() {
            least
        } else {
            factor.clamp(least, most)
        }
    }

    /// Finds where the guards vanish on the dense output, next to the roots of their polynomials up to part `until` of the step: no farther away than `within`
    /// of the step, for of several roots at a corner another may be found.
    pub(super) fn sharpen_roots(&mut self, until: f64, within: f64) {
        self.locator.polynomials.roots.clear();
        let mut all = RootList::new();
        let mut index = 0;
        while let Some((guard, curve)) = self.locator.polynomials.get(index) {
            roots(self.judged(guard, curve).unwrap_or_default(), &mut all);
            for root in all.iter().filter(|root| root.s <= until) {
                let exact = self.sharpened(index, root);
                let exact = exact.filter(|exact| (exact - root.s).abs() <= within);
                // What rounding does to the coefficients it does to the samples as well.
                let width = (0.5 * root.width).max(2.0 * f64::EPSILON * root.s);
                self.locator.polynomials.roots.push(SharpRoot {
                    guard,
                    interpolated: root.s,
                    exact: exact.unwrap_or(root.s),
                    is_found: exact.is_some(),
                    width,
                });
            }
            index += 1;
        }
    }

    /// Where a mark is passed, near the root `s` of its Taylor polynomial; of interpolations that is known.
    pub(super) fn sharpened_mark(&mut self, mark: usize, s: f64) -> f64 {
        let curves = &self.locator.polynomials;
        let mut known = curves.roots.iter();
        if s == 0.0 || known.any(|root| matches!(root.guard, Guard::Mark(..))) {
            return s;
        }
        let terms = 0..self.description().marks[mark].terms.len();
        let nearest = nearest(terms, s, |k| curves.mark_term(mark, k));
        let Some((k, rate)) = nearest else {
            return s;
        };
        let root = Root {
            s,
            width: 0.0,
            direction: match rate > 0.0 {
                true => Direction::Rising,
                false => Direction::Falling,
            },
            grazing: false,
        };
        let index = curves.mark_terms(mark).nth(k);
        let exact = index.and_then(|index| self.sharpened(index, &root));
        self.now.valued = false;
        match exact {
            Some(exact) if (exact - s).abs() <= SHARPENED => exact,
            _ => s,
        }
    }

    /// Where guard number `index` vanishes next to a root of its interpolation. Nothing where it only touches zero, or vanishes
    /// beyond the step.
    fn sharpened(&mut self, index: usize, root: &Root) -> Option<f64> {
        /// A root is no farther from that of the interpolation than this share of its part of the step.
        const NEAR: f64 = 0.1;
        /// What is left of a guard is rounding where it moves the root by no more than this share of that.
        const SHARP: f64 = 1e-10;
        /// Secants that come closer make a guard smaller by this factor at least.
        const CLOSER: f64 = 0.1;
        if root.grazing {
            return None;
        }
        let (guard, curve) = self.locator.polynomials.get(index)?;
        let known = curve.len() - self.judged(guard, curve)?.len();
        let rate = slope(curve, root.s).abs();
        let side = match root.direction {
            Direction::Falling => 1.0,
            Direction::Rising => -1.0,
        };
        // Positive before the root.
        let guard_at = |run: &mut Self, s: f64| -> Option<f64> {
            run.look_at_end(s);
            run.dynamics.report_value();
            let curves = &run.locator.polynomials;
            let value = side * curves.value(index, &run.now.mode, &run.dynamics);
            (!value.is_nan()).then_some(value)
        };
        // Secants, the first of them along the interpolation, as long as they come closer.
        let mut nearest = (root.s, guard_at(self, root.s)?);
        let mut fall = rate;
        loop {
            let (s, size) = (nearest.0 + nearest.1 / fall, nearest.1.abs());
            if !((s - root.s).abs() <= NEAR * root.s && s <= 1.0) {
                break;
            }
            let rounding = self
                .locator
                .polynomials
                .rounding(size, guard, &self.dynamics);
            // Where a guard hardly passes zero rounding leaves more than that.
            let there = if size <= rounding {
                SHARP
            } else {
                2.0 * f64::EPSILON
            };
            if (s - nearest.0).abs() <= there * s {
                return Some(s);
            }
            let value = guard_at(self, s)?;
            fall = (nearest.1 - value) / (s - nearest.0);
            if !(value.abs() <= CLOSER * size && fall > 0.0) {
                break;
            }
            nearest = (s, value);
        }
        let reach = (2.0 * nearest.1 / rate).abs();
        let reach = reach.max(4.0 * f64::EPSILON * nearest.0);
        let [before, after] = bracket(nearest, reach, |s| guard_at(self, s))?;
        if before.1 < 0.0 || after.1 > 0.0 || known > 0 && before.0 == 0.0 {
            return None;
        }
        zero_between([before, after], |s| guard_at(self, s))
    }

    /// Whether what ends the step, whose values `dynamics` holds there, is no zero of the guard but of its interpolation only.
    pub(super) fn misses_its_root(&mut self, hit: &Hit) -> bool {
        self.is_off_root(hit, Located::ByInterpolation(self.settings.tolerance))
    }

    /// The same to what is located in this way.
    pub(super) fn is_off_root(&mut self, hit: &Hit, located: Located) -> bool {
        self.dynamics.report_value();
        let (curves, mode, end) = (&self.locator.polynomials, &self.now.mode, hit.end());
        let is_found = |index| {
            let guard = curves.get(index).map(|(guard, _)| guard);
            let of_guard = |root: &&SharpRoot| Some(root.guard) == guard && root.is_found;
            let mut known = curves.roots.iter().filter(of_guard);
            known.any(|root| (root.exact - end).abs() <= root.width)
        };
        let vanishes =
            |index| is_found(index) || curves.vanishes(index, mode, &self.dynamics, located);
        match *hit {
            Hit::Nothing | Hit::Turned(_) => false,
            Hit::Guards(_) => {
                let fallen = self.locator.fallen.iter();
                let mut indices = fallen.filter_map(|&guard| curves.index_of(guard));
                !indices.all(vanishes)
            }
            Hit::Stop(i, _) => !curves.stop_terms(i).any(vanishes),
        }
    }

    /// Whether a mark up to part `end` of the step is no zero of its term but of the interpolation only. What `dynamics` and `scratch` hold at
    /// the end of the step stays.
    pub(super) fn misses_a_mark(&mut self, end: f64) -> bool {
        let mut marks = core::mem::take(&mut self.locator.marks);
        self.marks_until(end, &mut marks);
        let mut misses = false;
        for &(mark, s) in marks.iter().filter(|(_, s)| *s > 0.0) {
            self.look_at_end(s);
            self.dynamics.report_value();
            let curves = &self.locator.polynomials;
            let located = Located::ByInterpolation(self.settings.tolerance);
            let vanishes = |index| curves.vanishes(index, &self.now.mode, &self.dynamics, located);
            misses |= !curves.mark_terms(mark).any(vanishes);
        }
        if !marks.is_empty() {
            self.look_at_end(end);
        }
        self.locator.marks = marks;
        misses
    }

    /// Where a root of a guard's polynomial is, and half its width: of what was sampled, on the dense output.
    pub(super) fn place(&self, guard: Guard, root: &Root) -> (f64, f64) {
        let of_guard = self
            .locator
            .polynomials
            .roots
            .iter()
            .filter(|known| known.guard == guard);
        let distance = |known: &&SharpRoot| (known.interpolated - root.s).abs();
        let nearest = of_guard.min_by(|a, b| distance(a).total_cmp(&distance(b)));
        let same = nearest.filter(|known| distance(known) <= SAME);
        same.map_or((root.s, 0.5 * root.width), |known| {
            (known.exact, known.width)
        })
    }

    /// The part of the step at which a guard's polynomial is what the guard is at part `s` on the dense output: roots are where they
    /// have been found, if one is near.
    pub(super) fn interpolated(&self, guard: Guard, s: f64) -> f64 {
        let roots = self.locator.polynomials.roots.iter();
        let distance = |known: &&SharpRoot| (known.exact - s).abs();
        let of_guard = roots.filter(|known| known.guard == guard && distance(known) <= SAME);
        let nearest = of_guard.min_by(|a, b| distance(a).total_cmp(&distance(b)));
        let moved = nearest.map_or(0.0, |known| known.interpolated - known.exact);
        (s + moved).clamp(0.0, 1.0)
    }
}
