//! A step by Taylor series: polynomials of the motion and of all guards, checked against an independent evaluation.

use super::Run;
use super::guard_polynomials::Located;
use super::hit::Hit;
use super::singular::{LEAST_DEGREE, MOST_RETREATS, RETREAT, UNDECIDED};
use super::stepping::{CAREFUL, JUST_BEFORE, Stepper};
use crate::arithmetic::quad::{Quad, QuadBody, side_by_side};
use crate::arithmetic::{Scalar, epsilon};
use crate::declaration::Operations;
use crate::dynamics::Dynamics;
use crate::error::Error;
use crate::integrate::taylor::{self, Verdict};
use crate::integrate::{onto_step, powers_of};
use crate::modes::guard::Guard;
use crate::trajectory::State;

/// Where rounding hides how a guard begins, the step is made shorter by this.
const CLOSER_LOOK: f64 = 0.1;

/// But not beyond this share of the step that the motion allows (close to time 0 its resolution is no limit).
const CLOSEST: f64 = 1e-20;

/// Coefficients that are left out at once where those of a guard are no numbers.
const LOWER: usize = 4;

/// So many breaks of guards in a row are no instants that can be passed: a slip that fades has more than a thousand before it rests.
const MOST_BREAKS: usize = 100_000;

/// So many in a row of guards that have no series are none either: what overflows does so for longer than the shortest steps go on.
const MOST_WITHOUT_SERIES: usize = 1000;

/// A step up to this share of the longest since the last switch may pass a break of stops and marks that are far from zero,
const BRIEF: f64 = 1e-4;

/// or up to this one of the step that the motion allows.
const MOMENT: f64 = 1e-7;

/// Guards that ask for steps shorter than this share of what the motion allows may be lost in rounding.
const SHORT: f64 = 0.1;

/// So many units of rounding are what positions are off by at least.
const ULPS: f64 = 16.0;

/// Roots of Taylor polynomials are sharpened within this part of the step.
pub(super) const SHARPENED: f64 = 1e-3;

/// Where a guard does not vanish at the root of its polynomial, so many steps are tried, each shorter by this factor.
const MOST_MISSES: usize = 4;
const MISSED: f64 = 0.5;

/// Steps are shorter where directions of slips are off by more than this share.
pub(super) const ASTRAY: f64 = 1e-2;

/// Steps are shorter by this factor there: their errors are then some hundredth of those allowed.
const MORE_EXACTLY: f64 = 0.75;

impl<T: Scalar> Run<T> {
    /// Makes a step by Taylor series from the present state and finds what happens first in it.
    pub(super) fn taylor_step(&mut self) -> Result<Hit, Error> {
        self.expand()?;
        let (moves, mut order) = self.longest_step()?;
        let rests = self.rests_under_load();
        let mut h = self.stepper.guarded.map_or(moves, |h| h.min(moves));
        let mut guarded = h < moves;
        let mut closer = 0;
        let (mut corrections, mut shortened, mut missed) = (0, 0, 0);
        let mut jumps = false;
        let mut careful = self.settings.careful && self.begins_polynomial(moves);
        loop {
            self.expand()?;
            self.write_polynomial(h, order);
            if !self.advances(h) {
                return match self.slips_rest_at_once() {
                    true => Ok(Hit::Guards(0.0)),
                    false => Err(self.step_too_small(h)),
                };
            }
            self.locator.polynomials.take_series(
                &self.dynamics,
                &self.now.mode,
                &self.stepper.powers[..=order],
            );
            let shorter = CLOSER_LOOK * h;
            let resolved = self.advances(shorter) && shorter > CLOSEST * moves;
            let whole = self.nothing_happens();
            let mut lowered = 0;
            let hit = if whole {
                self.locator.fallen.clear();
                self.locator.rests.clear();
                Hit::Nothing
            } else if resolved && self.hides_a_start() {
                h = shorter;
                continue;
            } else {
                lowered = self.locator.polynomials.lowered();
                self.first_hit()
            };
            let end = hit.end();
            if end == 0.0 {
                if self.corrects_composites_at_start(&hit, &mut corrections)
                    || self.is_at_edge() && self.passes_over_touches(&hit, moves / h)
                {
                    continue;
                }
                match hit {
                    // A slip that is all error begins below zero, and goes on there.
                    Hit::Turned(_) if self.locator.polynomials.lowered() > lowered => continue,
                    // It would be found again.
                    Hit::Turned(_) => return Err(self.step_too_small(h)),
                    hit => return Ok(hit),
                }
            }
            // Exact in any step, a careful run differs from another by rounding only: by that of one more step.
            let part = CAREFUL * end * h;
            if core::mem::take(&mut careful) && part > self.resolution(h) {
                h = part;
                continue;
            }
            // Evaluated here, the end of the step also serves the event log. A slip that vanishes there has no direction.
            let looked = if self.locator.rests.is_empty() {
                end
            } else {
                JUST_BEFORE * end
            };
            if let Some(shorter) = self.hides(looked, order, shortened) {
                shortened += 1;
                h = shorter;
                continue;
            }
            let mut turns = None;
            if !whole {
                if self.passes_over_touches(&hit, moves / h) {
                    continue;
                }
                turns = self.gap_that_turns(&hit, moves / h);
                self.state_at_end(looked);
            }
            let known = self.evaluate_scratch(looked).is_ok();
            let (motion, guards) = match known {
                true => {
                    // How far guards are off counts where it bounds the step.
                    let guards = match !guarded && self.guards_fit(&hit, looked) {
                        true => 0.0,
                        false => self.guard_defect(&hit, looked),
                    };
                    (self.motion_defect(whole, looked), guards)
                }
                false => (f64::INFINITY, f64::INFINITY),
            };
            let guards = match rests {
                true => taylor::worse(guards, self.guard_defect_within(&hit, looked)),
                false => guards,
            };
            let passes =
                !(guards <= 1.0) && motion <= 1.0 && self.only_watches_break(looked, moves);
            let guards = if passes { 0.0 } else { guards };
            if passes {
                self.refuse_endless_breaks()?;
            }
            // A step must not end where the constraints lose rank.
            let distance = match known {
                true => self.rank.distance(&self.dynamics),
                false => 0.0,
            };
            if self.ends_close(distance) && closer < MOST_RETREATS {
                if let Some(hit) = self.leap(h)? {
                    return Ok(hit);
                }
                closer += 1;
                if known {
                    if self.is_lost() {
                        return Err(self.lost_rank());
                    }
                    self.recorder.trajectory.work.rejected += 1;
                    h *= RETREAT;
                    continue;
                }
            }
            // Of accelerations that jump, at the cut of an `atan2` or a kink that is no branch, a step may take in the last moment only, and
            // what they change there counts whole.
            jumps |= motion > 1.0 && self.accelerations_jump(looked, distance);
            let motion = match jumps {
                true => motion * (order + 1) as f64,
                false => motion,
            };
            let defect = taylor::worse(motion, guards);
            let control = &mut self.stepper.control;
            // The polynomial is as good at its root however long the step: the next try ends before it.
            match control.judge(h * end, defect, order, jumps) {
                Verdict::Accept => {
                    if self.corrects_composites(&hit, looked, &mut corrections) {
                        continue;
                    }
                    self.stepper.undirected = turns;
                    self.now.distance = self.rank.reach(&self.dynamics);
                    self.stepper.breaks = match passes {
                        true => self.stepper.breaks + 1,
                        false => 0,
                    };
                    self.stepper.guarded = guarded.then(|| {
                        let truncation = self.guard_truncation(&hit, looked);
                        h * looked * taylor::stretch(guards.min(truncation), order)
                    });
                    if looked != end {
                        self.state_at_end(end);
                        return Ok(hit);
                    }
                    if whole {
                        return Ok(hit);
                    }
                    if let Some(hit) = self.sharpened_hit(hit, missed < MOST_MISSES) {
                        return Ok(hit);
                    }
                    missed += 1;
                    h *= MISSED;
                }
                Verdict::Redo { h: smaller } => {
                    self.recorder.trajectory.work.rejected += 1;
                    if let Some(lower) = self.order_of_guards(order) {
                        order = lower;
                        h = h.min(self.step_of(order).unwrap_or(smaller));
                        continue;
                    }
                    guarded |= motion <= 1.0;
                    if guarded && known {
                        self.refuse_watches_of_turning_shares(looked)?;
                    }
                    if motion <= 1.0 && smaller <= self.resolution(moves) {
                        if self.locator.rests.is_empty() {
                            return self.pass_break();
                        }
                        // What is left of the slip has no direction.
                        (self.now.distance, self.stepper.guarded) = (distance, None);
                        self.state_at_end(end);
                        return Ok(hit);
                    }
                    h = smaller;
                }
            }
        }
    }

    /// Whether the step is the first one of a phase whose motion allows any step, as a polynomial does. Flights between impacts that shrink do not count:
    /// these forget what rounding has made of the motion, and rounding in the middle of one that hardly rises would say when it ends.
    fn begins_polynomial(&self, moves: f64) -> bool {
        let mut contacts = 0..self.switcher.impacts.len();
        moves >= self.end - self.now.t.value()
            && self.stepper.resolution.longest() == 0.0
            && !contacts.any(|c| self.bounces(c))
    }

    /// What ends the step, at the root of the guard itself where that of its polynomial is farther from it than rounding: the motion may be a polynomial and
    /// the surface of a table that shakes not. The state there is in `scratch`, evaluated as that at the end of `hit` was. Nothing where the guard does not
    /// vanish and a shorter step may tell whether it does, unless that has been tried (`again` is false): a force may come close to its limit and turn back.
    fn sharpened_hit(&mut self, hit: Hit, again: bool) -> Option<Hit> {
        if !self.is_off_root(&hit, Located::Exactly) {
            return Some(hit);
        }
        self.sharpen_roots(hit.end() + SHARPENED, SHARPENED);
        let sharper = self.first_hit();
        let same = matches!(
            (&hit, &sharper),
            (Hit::Guards(_), Hit::Guards(_)) | (Hit::Stop(..), Hit::Stop(..))
        );
        let near = (sharper.end() - hit.end()).abs() <= SHARPENED;
        if same
            && near
            && self.evaluate_end(sharper.end()).is_ok()
            && !(again && self.is_off_root(&sharper, Located::Exactly))
        {
            return Some(sharper);
        }
        self.locator.polynomials.roots.clear();
        if again {
            return None;
        }
        let hit = self.first_hit();
        // It could be evaluated before.
        _ = self.evaluate_end(hit.end());
        Some(hit)
    }

    /// The step that the motion allows by the series at hand, and the order up to which that is used.
    fn longest_step(&mut self) -> Result<(f64, usize), Error> {
        let (series, order) = self
            .longest_series()
            .ok_or_else(|| self.not_finite("a Taylor coefficient"))?;
        // Errors of the size that is allowed would be all that is left of a slip whose direction is stiff.
        let moves = match self.stepper.astray > ASTRAY {
            true => MORE_EXACTLY * series,
            false => series,
        };
        let longest = (self.end - self.now.t.value()).min(self.longest_at_rest());
        let moves = moves.min(longest).min(self.longest_of_shared_loads(order));
        Ok((moves, order))
    }

    /// The step that the series at hand allows, and the order up to which it is used: close to where a slip vanishes that turns, the last
    /// coefficients are beyond all numbers.
    fn longest_series(&self) -> Option<(f64, usize)> {
        let highest = self.stepper.order;
        let mut orders = (LEAST_DEGREE.min(highest)..=highest).rev();
        orders.find_map(|order| Some((self.step_of(order)?, order)))
    }

    /// The step that the series at hand allows, used up to this order.
    fn step_of(&self, order: usize) -> Option<f64> {
        let (series, tolerance) = (self.dynamics.state_series(), self.settings.per_step());
        taylor::step_size(series, order, tolerance)
    }

    /// A lower order, if coefficients of a guard are beyond all numbers where those of the motion are not, as those of forces of 1e300 N.
    fn order_of_guards(&self, order: usize) -> Option<usize> {
        let lower = order.saturating_sub(LOWER).max(LEAST_DEGREE);
        let without = lower < order && self.locator.polynomials.without_series().is_some();
        without.then_some(lower)
    }

    /// Passes an instant at which a guard breaks off (the cut of `atan2`, a kink) by the step at hand, the shortest that time
    /// resolves: nothing is located in it, and the next step begins on the side on which the guards then are.
    ///
    /// # Errors
    /// Beyond the break a guard is infinite or no number, or a gap or the guard of a branch has jumped below zero; or there is one break
    /// after the other.
    fn pass_break(&mut self) -> Result<Hit, Error> {
        self.refuse_endless_breaks()?;
        self.stepper.breaks += 1;
        self.evaluate_end(1.0).map_err(|e| self.error(e))?;
        let (curves, dynamics) = (&mut self.locator.polynomials, &mut self.dynamics);
        if let Some((guard, before, after)) = curves.hold(dynamics, &self.now.mode) {
            let d = self.description();
            let item = guard.name(d).unwrap_or(d.name);
            return Err(if !after.is_finite() {
                self.no_value_of("the guard", guard)
            } else {
                Error::Discontinuous {
                    time: self.now.t.value(),
                    item,
                    before,
                    after,
                }
            });
        }
        self.locator.fallen.clear();
        self.locator.rests.clear();
        self.now.distance = self.rank.reach(&self.dynamics);
        Ok(Hit::Nothing)
    }

    /// Whether the step is short and the guards that are off at part `looked` of it are terms of stops and of marks that stay far from zero; they are taken
    /// for constant then. acos(cos x) is known to within 1e-16/δ only at a distance δ from its kink, and within 1e-8 it is rounding alone.
    fn only_watches_break(&mut self, looked: f64, moves: f64) -> bool {
        let longest = (BRIEF * self.stepper.resolution.longest()).max(MOMENT * moves);
        let (curves, dynamics) = (&mut self.locator.polynomials, &mut self.dynamics);
        let tolerance = self.settings.tolerance;
        // Coefficients beyond all numbers are something else.
        let told = dynamics.is_without_watches() || curves.without_series().is_none();
        told && looked * self.stepper.step.h.value() <= longest
            && curves.holds_watches(dynamics, &self.now.mode, looked, tolerance)
    }

    /// Refuses guards that bound step after step.
    fn refuse_endless_breaks(&self) -> Result<(), Error> {
        if self.stepper.breaks < MOST_WITHOUT_SERIES {
            return Ok(());
        }
        match self.locator.polynomials.without_series() {
            Some(guard) => Err(self.no_value_of("a Taylor coefficient of the guard", guard)),
            None if self.stepper.breaks < MOST_BREAKS => Ok(()),
            None => Err(self.step_too_small(self.resolution(0.0))),
        }
    }

    /// How far the motion is off at part `looked` of the step, the end of it if it is a `whole` one, in units of what is allowed.
    fn motion_defect(&self, whole: bool, looked: f64) -> f64 {
        let (step, accelerations) = (&self.stepper.step, self.dynamics.acceleration());
        if whole {
            taylor::defect_at_end(
                step,
                &self.stepper.slopes,
                accelerations,
                self.settings.per_step(),
            )
        } else {
            taylor::defect(step, looked, accelerations, self.settings.per_step())
        }
    }

    /// Whether accelerations jump up to part `looked` of the step, so far from a loss of rank.
    fn accelerations_jump(&mut self, looked: f64, distance: f64) -> bool {
        /// What is larger than this, relative, is not rounding.
        const JUMP: f64 = 1e-5;
        self.may_jump && !self.is_undecided() && distance >= UNDECIDED && {
            let rounding = JUMP + self.blur_of_directions();
            let accelerations = self.dynamics.acceleration();
            taylor::differs(&self.stepper.step, looked, accelerations, rounding)
        }
    }

    /// Whether the polynomials of the guards are clearly good enough at part `looked` of the step, which ends with `hit`.
    fn guards_fit(&mut self, hit: &Hit, looked: f64) -> bool {
        let located = !matches!(hit, Hit::Nothing);
        let (curves, dynamics) = (&self.locator.polynomials, &mut self.dynamics);
        let tolerance = self.settings.tolerance;
        curves.fit(dynamics, &self.now.mode, looked, tolerance, located)
    }

    /// How far the guards are off there.
    pub(super) fn guard_defect(&mut self, hit: &Hit, looked: f64) -> f64 {
        let defect = self.guard_defect_beyond(0.0, &[], hit, looked);
        if defect <= 1.0 {
            return defect;
        }
        let blur = self.blur_of_directions().max(self.locator.blur);
        let defect = match blur {
            0.0 => defect,
            blur => self.guard_defect_beyond(blur, &[], hit, looked),
        };
        if defect <= 1.0 || !self.is_short() {
            return defect;
        }
        let rounding = self.rounding_of_guards(looked);
        self.guard_defect_beyond(blur, &rounding, hit, looked)
    }

    /// Whether the step at hand is much shorter than the motion allows.
    fn is_short(&self) -> bool {
        let h = self.stepper.step.h.value();
        self.longest_series()
            .is_some_and(|(moves, _)| h < SHORT * moves)
    }

    /// The same where forces are known to within `blur` only, relative; of those at their limit, relative to what makes them; and guards to within
    /// what `rounding` makes of them, if that is known.
    fn guard_defect_beyond(&mut self, blur: f64, rounding: &[f64], hit: &Hit, looked: f64) -> f64 {
        let tolerance = self.settings.tolerance;
        self.locator.polynomials.defect(
            &mut self.dynamics,
            &self.now.mode,
            looked,
            [tolerance, blur],
            rounding,
            self.locator.known(hit),
        )
    }

    /// What rounding of the state at part `looked` of the step makes of each guard, as far as guesses say: positions may be counted from far away, and springs
    /// be stiff. Nothing is known where that cannot be evaluated, and nothing of what is watched close to its poles: there rounding explains everything. `dynamics` and `scratch` end as they were.
    fn rounding_of_guards(&mut self, looked: f64) -> Vec<f64> {
        let values = |run: &mut Self| {
            let curves = &run.locator.polynomials;
            curves.values(&run.now.mode, &mut run.dynamics)
        };
        let exact = values(self);
        let mut most = vec![0.0_f64; exact.len()];
        for alternates in [false, true] {
            self.state_at_end(looked);
            let State { q, v, .. } = &mut self.stepper.scratch;
            for (j, x) in q.iter_mut().chain(v).enumerate() {
                let sign = if alternates && j % 2 == 1 { -1.0 } else { 1.0 };
                *x *= T::from_f64(1.0 + sign * ULPS * epsilon::<T>());
            }
            if self.evaluate_scratch(looked).is_ok() {
                for (most, (x, y)) in most.iter_mut().zip(values(self).iter().zip(&exact)) {
                    *most = most.max((x - y).abs());
                }
            }
        }
        for (index, most) in most.iter_mut().enumerate() {
            let guard = self.locator.polynomials.get(index).map(|(guard, _)| guard);
            if guard.is_some_and(|guard| self.has_poles(guard)) {
                *most = 0.0;
            }
        }
        match self.evaluate_end(looked) {
            Ok(()) => most,
            Err(_) => Vec::new(),
        }
    }

    /// Whether what a stop or mark watches is divided by what varies.
    fn has_poles(&self, guard: Guard) -> bool {
        let declaration = self.dynamics.system().declaration();
        let terms = match guard {
            Guard::Stop(i, _) => declaration.stops[i],
            Guard::Mark(i, _) => declaration.marks[i],
            _ => None,
        };
        let mut terms = terms.unwrap_or_default().iter();
        terms.any(|&value| Operations::of(declaration, [value]).has_poles(value))
    }

    /// The same as far as a shorter step makes it smaller.
    fn guard_truncation(&mut self, hit: &Hit, looked: f64) -> f64 {
        let rounding = match self.is_short() {
            true => self.rounding_of_guards(looked),
            false => Vec::new(),
        };
        self.locator.polynomials.truncation(
            &mut self.dynamics,
            &self.now.mode,
            looked,
            self.settings.tolerance,
            &rounding,
            self.locator.known(hit),
        )
    }

    /// Scales the series, up to `degree`, onto a step of length `h`; the state at its end is left in `scratch`, the changes of
    /// the velocities per step there in `slopes`.
    #[inline(never)]
    pub(super) fn write_polynomial(&mut self, h: f64, degree: usize) {
        self.stepper.step.set_degree(degree);
        self.stepper.step.t = self.now.t;
        self.stepper.step.h = T::from_f64(h);
        side_by_side::<OntoStep, _>((&self.dynamics, &mut self.stepper));
    }
}

/// Writes the series that `dynamics` holds onto the step, the state at its end and the changes of the velocities.
struct OntoStep;

impl<T: Scalar> QuadBody<(&Dynamics<T>, &mut Stepper<T>)> for OntoStep {
    type Output = ();

    #[inline(always)]
    fn run<Q: Quad>(quad: Q, (dynamics, stepper): (&Dynamics<T>, &mut Stepper<T>)) {
        let Stepper {
            step,
            powers,
            scratch,
            slopes,
            ..
        } = stepper;
        powers_of(quad, step.h.value(), step.degree, powers);
        let [positions, velocities] = dynamics.state_series();
        let width = step.degree + 1;
        let onto_q = step.q.chunks_exact_mut(width).zip(&mut scratch.q);
        let onto_v = step.v.chunks_exact_mut(width).zip(&mut scratch.v);
        let onto = onto_q.zip(onto_v).zip(slopes);
        for ((q, v), (((row_q, end_q), (row_v, end_v)), slope)) in
            positions.iter().zip(velocities).zip(onto)
        {
            (*end_q, _) = onto_step::<T, Q, false>(quad, row_q, q, powers);
            (*end_v, *slope) = onto_step::<T, Q, true>(quad, row_v, v, powers);
        }
    }
}
