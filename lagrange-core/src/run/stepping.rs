//! One accepted step: polynomials of the motion and of all guards, checked against an independent evaluation.

use super::hit::Hit;
use super::resolution::Resolution;
use super::singular::{LEAST_DEGREE, MOST_RETREATS, RETREAT, UNDECIDED};
use super::stiffness::Stiffness;
use super::{Progress, Run};
use crate::arithmetic::products::{ROW, Row};
use crate::arithmetic::quad::{Quad, QuadBody, side_by_side};
use crate::arithmetic::{Scalar, epsilon};
use crate::dynamics::{Dynamics, EvaluationError};
use crate::error::Error;
use crate::integrate::taylor::{self, Costs, DefectControl, Verdict};
use crate::integrate::{
    Integrator, Method, StepPolynomial, horner, onto_step, polynomial_derivative, powers_of,
};
use crate::modes::guard::Guard;
use crate::settings::Settings;
use crate::system::Description;
use crate::trajectory::State;

/// A slip close to its rest is looked at from this part of the way.
pub(super) const JUST_BEFORE: f64 = 0.999;

/// How far beyond a hit its gap is looked at, in units of the tolerance.
const BEYOND: f64 = 10.0;
/// Where rounding hides how a guard begins, the step is made shorter by this.
const CLOSER_LOOK: f64 = 0.1;
/// But not beyond this share of the step that the motion allows (close to time 0 its resolution is no limit).
const CLOSEST: f64 = 1e-20;

/// Coefficients that are left out at once where those of a guard are no numbers.
const LOWER: usize = 4;

/// So many times a step is made shorter because the interpolation of its guards does not hold.
const MOST_TRIES: usize = 10;
/// What exponents may rise by in a step of other methods than Taylor's, as an order.
const SLOW_ORDER: usize = 4;
/// So many times a step is made shorter for what it hides.
const MOST_SHORTENED: usize = 16;
/// So many breaks of guards in a row are no instants that can be passed: a slip that fades has more than a thousand before it rests.
const MOST_BREAKS: usize = 100_000;
/// A step that is made again to end at a hit ends so much later, as a share of it, to see it once more; and then once more so near that what
/// lies before the end of a step is as good as the end.
const PAST: [f64; 2] = [1e-3, 1e-6];
/// A step in which an interpolation vanishes and its guard does not is made shorter by this factor.
const NO_ROOT: f64 = 0.5;
/// Steps of so many times the resolution of time are left to Taylor series.
const KINK: f64 = 1e4;

/// Where directions of slips are off by more than this share,
const ASTRAY: f64 = 1e-2;
/// steps are shorter by this factor: their errors are then some hundredth of those allowed.
const MORE_EXACTLY: f64 = 0.75;

/// What makes the polynomials of a step, and the step at hand.
#[derive(Debug)]
pub(super) struct Stepper<T> {
    /// Order of Taylor series.
    pub(super) order: usize,
    /// Judges the steps of Taylor series.
    control: DefectControl,
    /// The method, if it is not that of Taylor series at present,
    pub(super) other: Option<Box<Integrator<T>>>,
    /// and the step that it would like to take.
    pub(super) wanted: Option<f64>,
    /// Longest step of Taylor series for which guards that bend more than the motion are good, while they are what bounds the steps.
    guarded: Option<f64>,
    /// The share by which directions of slips are off at the present state.
    pub(super) astray: f64,
    /// Breaks of guards that were passed since the last step that no guard has bounded so.
    breaks: usize,
    pub(super) stiffness: Stiffness<T>,
    pub(super) resolution: Resolution,
    pub(super) step: StepPolynomial<T>,
    /// Powers of the length of the step.
    pub(super) powers: Row<f64>,
    /// State where the step ends.
    pub(super) scratch: State<T>,
    /// Σ k vₖ of the polynomials of the velocities.
    pub(super) slopes: Vec<f64>,
}

impl<T: Scalar> Stepper<T> {
    /// Room for the steps of states like this one.
    pub(super) fn new(settings: &Settings, d: &Description, state: &State<T>) -> Self {
        let n = state.q.len();
        let costs = Costs {
            products: d.motion.products(),
            coordinates: n,
            constraints: d.constraints.len(),
        };
        Stepper {
            order: taylor::order(settings.per_step(), costs),
            control: DefectControl::default(),
            other: Integrator::new(settings.method, n).map(Box::new),
            wanted: None,
            guarded: None,
            astray: 0.0,
            breaks: 0,
            stiffness: Stiffness::new(settings.method),
            resolution: Resolution::default(),
            step: StepPolynomial::new(n, 1),
            powers: [0.0; ROW],
            scratch: state.clone(),
            slopes: vec![0.0; n],
        }
    }

    /// Whether the steps are those of Taylor series.
    pub(super) fn is_taylor(&self) -> bool {
        self.other.is_none()
    }

    /// Whether an explicit method chooses the steps.
    pub(super) fn is_explicit(&self) -> bool {
        let method = self.other.as_deref();
        method.is_some_and(Integrator::is_explicit_and_adaptive)
    }

    /// Forgets what belongs to another motion; the method is the one that was asked for.
    pub(super) fn restart(&mut self) {
        self.control = DefectControl::default();
        (self.wanted, self.guarded, self.breaks) = (None, None, 0);
        self.astray = 0.0;
        self.resolution = Resolution::default();
        if let Some(method) = &mut self.other {
            method.restart();
        }
        self.stiffness.restart(&mut self.other);
    }
}

impl<T: Scalar> Run<T> {
    /// Makes a step from the present state and finds what happens first in it.
    pub(super) fn accepted_step(&mut self) -> Result<Hit, Error> {
        if self.stepper.is_taylor() {
            return self.taylor_step();
        }
        self.stepper.control = DefectControl::default();
        let hit = self.other_step();
        if hit.is_err() && self.settings.method == Method::Auto {
            // What Radau cannot do may still be within reach of Taylor series.
            self.leave_stiffness();
            return self.taylor_step();
        }
        hit
    }

    fn taylor_step(&mut self) -> Result<Hit, Error> {
        self.expand()?;
        let longest = self.end - self.now.t.value();
        let (moves, mut order) = self
            .longest_series()
            .ok_or_else(|| self.not_finite("a Taylor coefficient"))?;
        // Errors of the size that is allowed would be all that is left of a slip whose direction is stiff.
        let moves = match self.stepper.astray > ASTRAY {
            true => MORE_EXACTLY * moves,
            false => moves,
        };
        let rests = self.rests_under_load();
        let longest = match rests {
            true => longest.min(self.longest_at_rest()),
            false => longest,
        };
        let moves = moves.min(longest).min(self.longest_of_shared_loads(order));
        let mut h = self.stepper.guarded.map_or(moves, |h| h.min(moves));
        let mut guarded = h < moves;
        let mut closer = 0;
        let (mut corrections, mut shortened) = (0, 0);
        let mut jumps = false;
        loop {
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
                if self.corrects_composites_at_start(&hit, &mut corrections) {
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
            let turns = self.gap_that_turns(&hit, moves / h);
            if !whole {
                self.state_at_end(looked);
            }
            let (motion, guards) = match self.evaluate_scratch(looked) {
                Ok(()) => (
                    self.motion_defect(whole, looked),
                    self.guard_defect(&hit, looked),
                ),
                Err(_) => (f64::INFINITY, f64::INFINITY),
            };
            let guards = match rests {
                true => taylor::worse(guards, self.guard_defect_within(&hit, looked)),
                false => guards,
            };
            // A step must not end where the constraints lose rank.
            let distance = self.rank.distance(&self.dynamics);
            if self.ends_close(distance) && closer < MOST_RETREATS {
                if let Some(hit) = self.leap(h) {
                    return Ok(hit);
                }
                closer += 1;
                self.recorder.trajectory.work.rejected += 1;
                h *= RETREAT;
                continue;
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
                    if let Some(item) = turns {
                        let time = self.stepper.step.time(T::from_f64(end)).value();
                        return Err(Error::Undirected { time, item });
                    }
                    self.now.distance = distance;
                    self.stepper.breaks = 0;
                    self.stepper.guarded = guarded.then(|| {
                        let truncation = self.guard_truncation(&hit, looked);
                        h * looked * taylor::stretch(guards.min(truncation), order)
                    });
                    if looked != end {
                        self.state_at_end(end);
                    }
                    return Ok(hit);
                }
                Verdict::Redo { h: smaller } => {
                    self.recorder.trajectory.work.rejected += 1;
                    if let Some(lower) = self.order_of_guards(order) {
                        order = lower;
                        h = h.min(self.step_of(order).unwrap_or(smaller));
                        continue;
                    }
                    guarded |= motion <= 1.0;
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

    /// The length of a step that hides nothing from a method of this order, if that at hand, up to `end`, is longer; it has been shortened so
    /// many times for that.
    fn hides(&mut self, end: f64, order: usize, shortened: usize) -> Option<f64> {
        let hidden = self.hidden.as_mut()?;
        // An exponent that jumps (at the cut of an atan2) does so in all steps.
        if shortened == MOST_SHORTENED {
            return None;
        }
        let part = hidden.shown(&self.stepper.step, end, order);
        (part < end).then(|| part * self.stepper.step.h.value())
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

    /// Whether time is another after a step.
    fn advances(&self, h: f64) -> bool {
        (self.now.t + T::from_f64(h)).value() > self.now.t.value()
    }

    /// Shorter steps do not advance time clearly within the next `h`.
    fn resolution(&self, h: f64) -> f64 {
        let now = self.now.t.value();
        2.0 * epsilon::<T>() * now.abs().max((now + h).abs())
    }

    /// Passes an instant at which a guard breaks off (the cut of `atan2`, a kink) by the step at hand, the shortest that time
    /// resolves: nothing is located in it, and the next step begins on the side on which the guards then are.
    ///
    /// # Errors
    /// Beyond the break a guard is no number, or a gap or the guard of a branch has jumped below zero; or there is one break
    /// after the other.
    fn pass_break(&mut self) -> Result<Hit, Error> {
        self.stepper.breaks += 1;
        if self.stepper.breaks > MOST_BREAKS {
            return Err(self.breaks_on());
        }
        self.evaluate_end(1.0).map_err(|e| self.error(e))?;
        let (curves, dynamics) = (&mut self.locator.polynomials, &mut self.dynamics);
        if let Some((guard, before, after)) = curves.hold(dynamics, &self.now.mode) {
            let d = self.description();
            let item = guard.name(d).unwrap_or(d.name);
            return Err(if after.is_nan() {
                self.not_finite(&format!("the guard of `{item}`"))
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
        self.now.distance = self.rank.distance(&self.dynamics);
        Ok(Hit::Nothing)
    }

    /// What is wrong with guards that bound step after step.
    fn breaks_on(&self) -> Error {
        match self.locator.polynomials.without_series() {
            Some(guard) => {
                let d = self.description();
                let item = guard.name(d).unwrap_or(d.name);
                self.not_finite(&format!("a Taylor coefficient of the guard of `{item}`"))
            }
            None => self.step_too_small(self.resolution(0.0)),
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

    /// The same of the guards.
    pub(super) fn guard_defect(&mut self, hit: &Hit, looked: f64) -> f64 {
        let defect = self.guard_defect_beyond(0.0, hit, looked);
        if defect <= 1.0 {
            return defect;
        }
        let blur = self.blur_of_directions().max(self.locator.blur);
        match blur {
            0.0 => defect,
            blur => self.guard_defect_beyond(blur, hit, looked),
        }
    }

    /// The same where forces are known to within `blur` only, relative; of those at their limit, relative to what makes them.
    fn guard_defect_beyond(&mut self, blur: f64, hit: &Hit, looked: f64) -> f64 {
        let tolerance = self.settings.tolerance;
        self.locator.polynomials.defect(
            &mut self.dynamics,
            &self.now.mode,
            looked,
            [tolerance, blur],
            self.locator.known(hit),
        )
    }

    /// The same as far as a shorter step makes it smaller.
    fn guard_truncation(&mut self, hit: &Hit, looked: f64) -> f64 {
        self.locator.polynomials.truncation(
            &mut self.dynamics,
            &self.now.mode,
            looked,
            self.settings.tolerance,
            self.locator.known(hit),
        )
    }

    /// The contact that is hit by its polynomial but whose gap rises beyond, as far as the motion is known there, up to part `known` of the
    /// step: a distance √(x² + y²), which has no direction where it vanishes.
    ///
    /// Positions are known to the tolerance, so that is what is looked at beyond the hit.
    fn gap_that_turns(&mut self, hit: &Hit, known: f64) -> Option<&'static str> {
        let Hit::Guards(end) = *hit else {
            return None;
        };
        for k in 0..self.locator.fallen.len() {
            let guard = self.locator.fallen[k];
            let Guard::Gap(contact) = guard else {
                continue;
            };
            self.state_at_end(end);
            let index = self.locator.polynomials.index_of(guard)?;
            let (_, curve) = self.locator.polynomials.get(index)?;
            let q = self.stepper.scratch.q.iter();
            let size = q.fold(1.0_f64, |size, q| size.max(q.value().abs()));
            let depth = BEYOND * self.settings.tolerance.max(1e-13) * size;
            let beyond = end + depth / polynomial_derivative(curve, end).abs();
            let fallen = horner(curve, beyond);
            if beyond > known || fallen > -0.5 * depth {
                continue;
            }
            self.state_at_end(beyond);
            let State { q, v, .. } = &self.stepper.scratch;
            let time = self.stepper.step.time(T::from_f64(beyond));
            self.dynamics.tape(time, q, v);
            let curves = &self.locator.polynomials;
            let gap = curves.value(index, &self.now.mode, &self.dynamics);
            // A distance is then what its polynomial is, of the other sign; where the series of a gap has stopped converging it is something else.
            if gap > 0.5 * depth && (gap + fallen).abs() < 0.5 * depth {
                return Some(self.description().contacts[contact].name);
            }
        }
        None
    }

    /// The state at part `end` of the step, in `scratch`, and the equations of motion there.
    pub(super) fn evaluate_end(&mut self, end: f64) -> Result<(), EvaluationError> {
        self.state_at_end(end);
        self.evaluate_scratch(end)
    }

    /// The equations of motion for the state in `scratch`, that at part `end` of the step.
    fn evaluate_scratch(&mut self, end: f64) -> Result<(), EvaluationError> {
        let State { q, v, .. } = &self.stepper.scratch;
        let time = self.stepper.step.time(T::from_f64(end));
        self.dynamics.value_along(time, q, v)
    }

    /// The state at part `end` of the step, in `scratch`.
    pub(super) fn state_at_end(&mut self, end: f64) {
        let State { q, v, .. } = &mut self.stepper.scratch;
        self.stepper.step.state_into(T::from_f64(end), q, v);
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

    fn other_step(&mut self) -> Result<Hit, Error> {
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
        let (q, v) = (&self.now.state.q, &self.now.state.v);
        let first = match self.stepper.wanted {
            Some(h) => Ok(h),
            None => method.first_step(
                &mut self.dynamics,
                self.now.t,
                q,
                v,
                longest,
                self.settings.per_step(),
            ),
        };
        if let Ok(h) = first
            && self.slip_may_vanish(h)
        {
            return self.taylor_step();
        }
        let mut h = first.map_err(|e| self.no_step(e))?.min(longest);
        if self.rests_under_load() {
            h = h.min(self.longest_at_rest());
        }
        if self.switcher.redundant.has_open() && self.expand().is_ok() {
            h = h.min(self.longest_of_shared_loads(self.stepper.order));
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
            self.sample()?;
            let defect = self.interpolation_defect().map_err(|e| self.error(e))?;
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

    /// One step of a method other than Taylor's, of at most `h`; the step that it would like to take next.
    fn integrate(&mut self, h: f64) -> Result<f64, Error> {
        let Some(method) = &mut self.stepper.other else {
            return Ok(h);
        };
        let (q, v) = (&self.now.state.q, &self.now.state.v);
        let (dynamics, step) = (&mut self.dynamics, &mut self.stepper.step);
        match method.step(
            dynamics,
            self.now.t,
            q,
            v,
            h,
            self.settings.per_step(),
            step,
        ) {
            Ok(accepted) => {
                self.recorder.trajectory.work.rejected += accepted.rejected;
                Ok(accepted.h_next)
            }
            Err(error) => Err(self.no_step(error)),
        }
    }

    /// Samples the guards along the step.
    fn sample(&mut self) -> Result<(), Error> {
        let State { q, v, .. } = &mut self.stepper.scratch;
        let (curves, dynamics) = (&mut self.locator.polynomials, &mut self.dynamics);
        let sampled = curves.sample(dynamics, &self.now.mode, &self.stepper.step, q, v);
        sampled.map_err(|e| self.error(e))
    }

    /// What happens first in a step whose guards were sampled; nothing where it is a guard that does not vanish there: its interpolation
    /// does, between samples that are all much farther from zero.
    fn hit_among_samples(&mut self) -> Result<Option<Hit>, Error> {
        let (mut corrections, mut closer, mut turned) = (0, PAST.iter(), false);
        loop {
            self.sharpen_roots();
            let hit = self.first_hit();
            // What happens close to the start is for a method that can make any step.
            if hit.end() == 0.0 || self.hides_a_start() {
                return self.taylor_step().map(Some);
            }
            self.evaluate_end(hit.end()).map_err(|e| self.error(e))?;
            let false_mark = self.misses_a_mark(hit.end());
            if false_mark.map_err(|e| self.error(e))? || self.misses_its_root(&hit) {
                return Ok(None);
            }
            self.now.distance = self.rank.distance(&self.dynamics);
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
            self.sample()?;
        }
    }

    /// Moves the state back onto the constraints of the mode where its residual calls for it (`always`: in any case).
    pub(super) fn project(&mut self, always: bool) -> Result<(), Error> {
        let tolerance = 1e-2 * self.settings.tolerance.max(1e-14);
        let outcome = self.dynamics.project(
            self.now.t,
            &mut self.now.state.q,
            &mut self.now.state.v,
            if always { 0.0 } else { tolerance },
        );
        match outcome {
            Ok(changed) => {
                self.recorder.trajectory.work.projections += usize::from(changed);
                self.now.valued &= !changed;
                if changed {
                    self.now.series = Progress::None;
                }
                Ok(())
            }
            Err(e) => Err(self.error(e)),
        }
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
        for (i, (q, v)) in positions.iter().zip(velocities).enumerate() {
            let (onto_q, onto_v) = step.rows_mut(i);
            (scratch.q[i], _) = onto_step::<T, Q, false>(quad, onto_q, q, powers);
            (scratch.v[i], slopes[i]) = onto_step::<T, Q, true>(quad, onto_v, v, powers);
        }
    }
}
