//! Slips of two components: they begin with a step of their own, and come to rest where both components vanish at once.
//!
//! Along a straight line the slip falls through zero like any guard. On a curved path |s| has no sign change, and near its
//! end the direction turns like a power of the time that is left: Taylor series reach no further than that end, steps shrink
//! with what is left, and the slip is at rest once all that can still change is below the tolerance. A slip that only
//! passes near zero is followed through.

use super::Run;
use super::fall::Fall;
use super::stepping::{JUST_BEFORE, Stepper};
use crate::arithmetic::{GOLDEN, Scalar, derivatives, uneven};
use crate::dynamics::{approach, dot, rounding_of_residuals};
use crate::error::Error;
use crate::mode::{Direction, FrictionMode, Sliding};
use crate::modes::exact;
use crate::modes::guard::{self, Guard};
use crate::trajectory::State;

/// What may still change until rest, in units of the tolerance.
const LEFT: f64 = 1.0;
/// The same for a slip that comes to rest with another one: half of what a certificate lets states jump by.
const LEFT_TOGETHER: f64 = 8.0;
/// A slip no larger than this share of its terms counts as zero.
const NOTHING: f64 = 1e-13;
/// A slip is off by so much of what it is made of.
const ROUNDING: f64 = 1e-15;
/// Forces are off by so many times as much as the direction of the slip.
const BLUR: f64 = 16.0;
/// A slip of so many errors of what it is made of is lost among them.
pub(super) const ERRORS: f64 = 2.0;
/// Friction that is below its limit by so many tolerances holds.
const CLEAR: f64 = 100.0;
/// A step of another method than Taylor series in which a slip that goes on as it begins falls below this share of itself, or changes by as much, is too
/// long.
const NEAR: f64 = 0.5;
/// How a slip goes on is seen from this share of a step.
const SOON: f64 = 1e-3;

/// A slip that comes to rest.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rest {
    pub friction: usize,
    /// Its last direction.
    pub along: [f64; 2],
    /// The part of the last step at which it has that; 0 if it has the direction that the slip was known to have.
    end: f64,
    /// Time that is left, s.
    left: f64,
    /// Change of the slip along `along` per second.
    pub slope: f64,
}

impl<T: Scalar> Run<T> {
    /// Whether friction `f` slips with two components along itself.
    pub(super) fn turns(&self, f: usize) -> bool {
        matches!(
            self.now.mode.frictions[f],
            FrictionMode::Slip(Sliding {
                direction: Direction::AlongSlip | Direction::Incipient(_),
                ..
            })
        )
    }

    /// Takes the slips that have only turned out of the fallen guards; the others are listed in `rests`.
    pub(super) fn tell_rest_from_turn(&mut self, end: f64) {
        self.locator.rests.clear();
        let mut fallen = core::mem::take(&mut self.locator.fallen);
        fallen.retain(|&guard| match guard {
            Guard::Slip(f) if self.turns(f) => {
                let rest = self.rest(f, end, LEFT);
                self.locator.rests.extend(rest);
                rest.is_some()
            }
            _ => true,
        });
        self.locator.fallen = fallen;
        self.rest_together(end);
    }

    /// Other slips that come to rest with those in `rests`, to within what the others leave of them.
    fn rest_together(&mut self, end: f64) {
        if self.locator.rests.is_empty() {
            return;
        }
        for f in 0..self.description().frictions.len() {
            if self.turns(f)
                && !self.locator.fallen.contains(&Guard::Slip(f))
                && let Some(rest) = self.rest(f, end, LEFT_TOGETHER)
            {
                self.locator.rests.push(rest);
                self.locator.fallen.push(Guard::Slip(f));
            }
        }
    }

    /// After a step up to part `end` in which nothing was hit: whether slips come to rest now. The state then is that at rest,
    /// and the guards of the slips are the fallen ones.
    pub(super) fn slips_come_to_rest(&mut self, end: f64) -> bool {
        self.locator.rests.clear();
        if end == 0.0 {
            return false;
        }
        self.locator.fallen.clear();
        for f in 0..self.description().frictions.len() {
            if self.turns(f)
                && let Some(rest) = self.rest(f, end, LEFT)
            {
                self.locator.rests.push(rest);
                self.locator.fallen.push(Guard::Slip(f));
            }
        }
        if self.locator.rests.is_empty() {
            return self.slips_rest_within_errors();
        }
        let left = self
            .locator
            .rests
            .iter()
            .fold(0.0_f64, |m, rest| m.max(rest.left));
        self.rest_together(end);
        let left = left.min(self.end - self.now.t.value()).max(0.0);
        let time = T::from_f64(left);
        let half = T::from_f64(0.5 * left);
        // From the difference over the last part of the step to that over what is left.
        let back = (1.0 - JUST_BEFORE) * end * self.stepper.step.h.value();
        let share = T::from_f64(left / back);
        let State { q, v, .. } = &mut self.now.state;
        for ((q, v), &earlier) in q.iter_mut().zip(v).zip(&self.locator.earlier) {
            let change = share * (*v - earlier);
            *q += time * *v + half * change;
            *v += change;
        }
        self.now.t += time;
        self.exact_rest(T::from_f64(back));
        self.now.outdate();
        true
    }

    /// Whether slips no larger than the errors of the velocities that make them come to rest now, because friction takes more away than
    /// there is to hold. Where it is hardly more, the direction of a slip follows the forces in a time that is far shorter than its fall: steps
    /// are bounded by stability, and each leaves a slip of the size of its error. An instant that errors choose has no derivatives, so where
    /// these are asked for the steps go on.
    fn slips_rest_within_errors(&mut self) -> bool {
        let d = self.description();
        let State { q, v, .. } = &self.now.state;
        let frictions = 0..d.frictions.len();
        let may_turn = frictions.clone().any(|f| self.turns(f));
        self.stepper.astray = 0.0;
        if T::DERIVATIVES > 0 || self.now.mode.has_incipient_slip() || !may_turn {
            return false;
        }
        self.dynamics.tape(self.now.t, q, v);
        for f in frictions {
            if !self.turns(f) {
                continue;
            }
            let astray = self.error_of_direction(f);
            self.stepper.astray = astray.max(self.stepper.astray);
            if astray * ERRORS >= 1.0 && !guard::fades(f, &self.dynamics) {
                self.rest_as_it_is(f);
            }
        }
        if self.locator.rests.is_empty() {
            return false;
        }
        self.now.valued = false;
        let held = self.are_held() && self.stop_within_errors();
        self.dynamics.set_mode(&self.now.mode);
        self.ask_for_guards();
        if !held {
            self.locator.fallen.clear();
            self.locator.rests.clear();
        }
        held
    }

    /// How far forces at their limit are off, relative to what makes them, because velocities are, and with them the directions of slips. The dynamics hold
    /// the values of the state, before and after.
    pub(super) fn blur_at_limit(&mut self) -> f64 {
        if !self.now.valued || !self.now.mode.has_turning_slip() {
            return 0.0;
        }
        let mut blur = 0.0_f64;
        for k in 0..self.locator.at_limit.len() {
            let (guard, largest) = self.locator.at_limit[k];
            let (value, size) = self.force_beside(guard, |_| 0.0);
            // There may be nothing at an instant.
            let size = size.max(largest).max(f64::MIN_POSITIVE);
            for sign in [ERRORS, -ERRORS] {
                for other in [sign, -sign] {
                    let side = |j: usize| if j.is_multiple_of(2) { sign } else { other };
                    // Equal errors would cancel in the slip of one body on another.
                    let errors = |j: usize| side(j) * uneven(j, GOLDEN);
                    let (off, _) = self.force_beside(guard, errors);
                    blur = blur.max((off - value).abs() / size);
                }
            }
            self.force_beside(guard, |_| 0.0);
        }
        blur.min(1.0)
    }

    /// A guard of a force, and the size of what makes it, with velocities so many errors beside those of the state.
    fn force_beside(&mut self, guard: Guard, errors: impl Fn(usize) -> f64) -> (f64, f64) {
        let State { q, v, .. } = &self.now.state;
        let beside = &mut self.stepper.scratch.v;
        for (j, (beside, v)) in beside.iter_mut().zip(v).enumerate() {
            let error = errors(j) * self.settings.allowed(j, v.value().abs());
            *beside = *v + T::from_f64(error);
        }
        // Where there is no value the last one stands.
        _ = self.dynamics.value(self.now.t, q, beside);
        let decider = &mut self.switcher.decider;
        decider.force(&mut self.dynamics, &self.now.mode, guard)
    }

    /// The error of a slip of two components, at the state of the last tape, from those of the velocities, beside the slip.
    pub(super) fn error_of_direction(&self, f: usize) -> f64 {
        let row = self.description().frictions[f].row;
        let error = |row: usize| self.error_of_rate(row, &self.now.state.v);
        let slip = self.slip(f);
        error(row).hypot(error(row + 1)) / slip[0].hypot(slip[1])
    }

    /// How far the rate of a row may be off because velocities like these are.
    fn error_of_rate(&self, row: usize, v: &[T]) -> f64 {
        let allowed = |j: usize| self.settings.allowed(j, v[j].value().abs());
        self.dynamics.size_of_row(row, allowed)
    }

    /// Whether what is listed in `rests` would stay at rest by less friction than it slips with. Leaves `dynamics` in the mode in which it
    /// does.
    fn are_held(&mut self) -> bool {
        let d = self.description();
        let mode = &mut self.locator.resting;
        mode.clone_from(&self.now.mode);
        for rest in &self.locator.rests {
            mode.frictions[rest.friction] = FrictionMode::Stick;
        }
        self.dynamics.set_mode(mode);
        self.ask_for_all_rows();
        let State { q, v, .. } = &self.now.state;
        if self.dynamics.value(self.now.t, q, v).is_err() {
            return false;
        }
        let clear = (CLEAR * self.settings.tolerance).clamp(ROUNDING, 1.0);
        self.locator.rests.iter().all(|rest| {
            let f = rest.friction;
            let row = d.frictions[f].row;
            let [a, b] = [row, row + 1].map(|row| self.dynamics.force(row).value());
            let limit = exact::kinetic_limit(f, &self.locator.resting, &self.dynamics);
            a.hypot(b) < (1.0 - clear) * limit.value()
        })
    }

    /// Whether rest changes velocities by no more than their errors: a slip that is small beside what moves in it may be all that turns a small body.
    /// `dynamics` is in the mode at rest; the velocities at rest are left in `earlier`.
    pub(super) fn stop_within_errors(&mut self) -> bool {
        let State { q, v, .. } = &self.now.state;
        let stopped = &mut self.locator.earlier;
        stopped.copy_from_slice(v);
        let projected = self.dynamics.project_velocities(
            self.now.t,
            q,
            stopped,
            &[],
            rounding_of_residuals::<T>(),
        );
        let mut changes = v.iter().zip(&*stopped).enumerate();
        projected.is_ok()
            && changes.all(|(i, (now, stopped))| {
                let allowed = self.settings.allowed(i, now.value().abs());
                (*stopped - *now).value().abs() <= LEFT_TOGETHER * allowed
            })
    }

    /// Where a step would be too short for time to resolve: whether slips that turn have all but vanished, so that they come to rest here. They are then
    /// the fallen guards.
    pub(super) fn slips_rest_at_once(&mut self) -> bool {
        self.locator.rests.clear();
        self.locator.fallen.clear();
        let State { q, v, .. } = &self.now.state;
        self.dynamics.tape(self.now.t, q, v);
        // One that begins has no length yet.
        if !self.now.mode.has_incipient_slip() {
            self.rest_what_has_vanished();
        }
        !self.locator.rests.is_empty()
    }

    /// Gives the instant of rest its derivatives; `earlier` has the velocities `back` seconds before the last step's end.
    fn exact_rest(&mut self, back: T) {
        let Some(&rest) = self.locator.rests.first() else {
            return;
        };
        let State { q, v, .. } = &mut self.now.state;
        for _ in 0..T::DERIVATIVES {
            self.dynamics.tape(self.now.t, q, v);
            let slip = exact::slip(rest.friction, rest.along.map(T::from_f64), &self.dynamics);
            let later = -derivatives(slip) / T::from_f64(rest.slope);
            for ((q, v), &earlier) in q.iter_mut().zip(&mut *v).zip(&self.locator.earlier) {
                *q += later * *v;
                *v += later * (*v - earlier) / back;
            }
            self.now.t += later;
        }
    }

    /// Whether friction `f` comes to rest at part `end` of the step, or so soon after it that what still changes is below so
    /// many tolerances.
    fn rest(&mut self, f: usize, end: f64, allowed: f64) -> Option<Rest> {
        if guard::fades(f, &self.dynamics) {
            return None;
        }
        let fall = self.fall_of_slip(f, end);
        let size = self.dynamics.slip_size(f, &self.stepper.scratch.v);
        let grows = fall.speed() > ROUNDING * size && fall.grows();
        if !(fall.length() > 0.0) || grows {
            return None;
        }
        if fall.speed() > NOTHING * size && self.still_changes(f, &fall, allowed) {
            return None;
        }
        let along = self.direction_into_rest(f, T::from_f64(end))?;
        let along = along.map(T::value);
        let interval = (1.0 - JUST_BEFORE) * end * self.stepper.step.h.value();
        Some(Rest {
            friction: f,
            along,
            end,
            left: fall.left() * interval,
            slope: dot(along, fall.change()) / interval,
        })
    }

    /// The direction in which the slip of friction `f` goes to zero at part `end` of the step.
    fn direction_into_rest(&mut self, f: usize, end: T) -> Option<[T; 2]> {
        let Self {
            dynamics, stepper, ..
        } = self;
        let Stepper { step, scratch, .. } = stepper;
        approach(|part| {
            let s = T::from_f64(part) * end;
            step.state_into(s, &mut scratch.q, &mut scratch.v);
            dynamics.tape(step.time(s), &scratch.q, &scratch.v);
            dynamics.slip(f)
        })
    }

    /// The last directions of the slips in `rests` by friction, at the instant of rest, which moves; none of numbers without derivatives.
    fn exact_directions(&mut self) -> Vec<(usize, [T; 2])> {
        let mut directions = Vec::new();
        if T::DERIVATIVES == 0 {
            return directions;
        }
        let step = &self.stepper.step;
        let moves = derivatives((self.now.t - step.t) / step.h);
        for i in 0..self.locator.rests.len() {
            let Rest { friction, end, .. } = self.locator.rests[i];
            if end > 0.0 {
                let along = self.direction_into_rest(friction, T::from_f64(end) + moves);
                directions.extend(along.map(|along| (friction, along)));
            }
        }
        directions
    }

    /// The slip of friction `f` at part `end` of the step, where `scratch` is then, and just before it, from where `earlier` has the velocities.
    fn fall_of_slip(&mut self, f: usize, end: f64) -> Fall {
        let mut slips = [[0.0; 2]; 2];
        for (slip, s) in slips.iter_mut().zip([JUST_BEFORE * end, end]) {
            self.locator
                .earlier
                .copy_from_slice(&self.stepper.scratch.v);
            self.state_at_end(s);
            let State { q, v, .. } = &self.stepper.scratch;
            let time = self.stepper.step.time(T::from_f64(s));
            self.dynamics.tape(time, q, v);
            *slip = self.slip(f);
        }
        let [before, now] = slips;
        Fall { before, now }
    }

    /// Whether more changes until the slip of friction `f` ends than so many tolerances: of the velocities, and of the slip itself, which falls by time
    /// alone where what slips is held.
    fn still_changes(&self, f: usize, fall: &Fall, allowed: f64) -> bool {
        let v = &self.stepper.scratch.v;
        let parts = fall.speed() / fall.length();
        let of_velocity = |j: usize| self.settings.allowed(j, v[j].value().abs());
        let mut velocities = v.iter().zip(&self.locator.earlier).enumerate();
        if velocities.any(|(j, (now, before))| {
            (*now - *before).value().abs() * parts > allowed * of_velocity(j)
        }) {
            return true;
        }
        let rows = self.description().frictions[f].rows();
        let of_rows = rows.map(|row| self.error_of_rate(row, v));
        let by_time = self.settings.tolerance * self.dynamics.slip_size(f, v);
        fall.missed() > allowed * (of_rows.sum::<f64>() + by_time)
    }

    /// How far forces are off, relative, because the directions of slips are: what rounding leaves of one that has nearly vanished. The
    /// values are those of the state in `scratch`.
    pub(super) fn blur_of_directions(&mut self) -> f64 {
        if !self.now.mode.has_turning_slip() {
            return 0.0;
        }
        self.dynamics.complete_outputs();
        let turning = (0..self.now.mode.frictions.len()).filter(|&f| self.turns(f));
        let shares = turning.map(|f| {
            let slip = self.slip(f);
            let size = self.dynamics.slip_size(f, &self.stepper.scratch.v);
            BLUR * ROUNDING * size / slip[0].hypot(slip[1])
        });
        shares.fold(0.0, f64::max).min(1.0)
    }

    /// The state at rest exactly, and the forces just before, in the directions that the slips had.
    pub(super) fn come_to_rest(&mut self) -> Result<(), Error> {
        let directions = self.exact_directions();
        self.locator.resting.clone_from(&self.now.mode);
        for rest in &self.locator.rests {
            self.locator.resting.frictions[rest.friction] = FrictionMode::Stick;
        }
        self.dynamics.set_mode(&self.locator.resting);
        // What holds a slip otherwise leaves it what time makes of it at an instant that is off by rounding.
        self.hold_rows();
        self.rest_of_necessity();
        self.locator.resting.clone_from(&self.now.mode);
        for rest in &self.locator.rests {
            let last = Direction::Incipient(rest.along);
            self.locator.resting.turn(rest.friction, last);
        }
        self.dynamics.set_mode(&self.locator.resting);
        for (friction, along) in directions {
            self.dynamics.set_slip_direction(friction, along);
        }
        self.locator.rests.clear();
        self.evaluate()
    }

    /// Slips that have vanished with those that were brought to rest: a body with two points at rest is at rest.
    fn rest_of_necessity(&mut self) {
        self.tape_of_all_rows();
        self.rest_what_has_vanished();
        self.ask_for_guards();
    }

    /// Adds a slip to `rests` that ends at the state of the last tape, in the direction that it has.
    fn rest_as_it_is(&mut self, f: usize) {
        self.locator.fallen.push(Guard::Slip(f));
        self.locator.rests.push(Rest {
            friction: f,
            along: self.dynamics.slip_direction(f).map(|x| x.value()),
            end: 0.0,
            left: 0.0,
            slope: 0.0,
        });
    }

    /// Adds to `rests` the other slips that are no larger than rounding of what makes them, at the state of the last tape.
    fn rest_what_has_vanished(&mut self) {
        for f in 0..self.description().frictions.len() {
            if !self.turns(f)
                || self.locator.fallen.contains(&Guard::Slip(f))
                || guard::fades(f, &self.dynamics)
            {
                continue;
            }
            let slip = self.slip(f);
            if slip[0].hypot(slip[1]) <= NOTHING * self.dynamics.slip_size(f, &self.now.state.v) {
                self.rest_as_it_is(f);
            }
        }
    }

    /// After the first step of slips that begin: from here on they go along themselves.
    pub(super) fn slips_have_begun(&mut self) {
        if !self.now.mode.has_incipient_slip() {
            return;
        }
        for f in 0..self.now.mode.frictions.len() {
            if self.turns(f) {
                self.now.mode.turn(f, Direction::AlongSlip);
            }
        }
        self.dynamics.set_mode(&self.now.mode);
        self.recorder.trajectory.enter(&self.now.mode);
        self.now.outdate();
        self.hold_guards();
        if self.switcher.redundant.has_open() {
            self.list_guards();
        }
    }

    /// How much of a step of length `h` the slips of frictions with two components allow: nothing where one begins; else as long as none vanishes, or, of
    /// methods that are not `stiff`, changes much.
    pub(super) fn longest_of_slips(&mut self, h: f64, stiff: bool) -> f64 {
        if !self.now.mode.has_turning_slip() {
            return h;
        }
        let State { q, v, .. } = &self.now.state;
        if self.now.mode.has_incipient_slip() || self.dynamics.value(self.now.t, q, v).is_err() {
            return 0.0;
        }
        let mut slips = core::mem::take(&mut self.locator.slips);
        slips.clear();
        let turning = (0..self.now.mode.frictions.len()).filter(|&f| self.turns(f));
        slips.extend(turning.map(|f| (f, self.slip(f))));
        self.tape_soon(SOON * h);
        let longest = slips.iter().fold(h, |longest, &(f, before)| {
            let fall = Fall {
                before,
                now: self.slip(f),
            };
            let parts = match stiff {
                true => fall.until(NEAR),
                false => NEAR * before[0].hypot(before[1]) / fall.length(),
            };
            longest.min(SOON * h * parts)
        });
        self.locator.slips = slips;
        longest
    }

    /// The slip of friction `f` at the state of the last tape.
    pub(super) fn slip(&self, f: usize) -> [f64; 2] {
        self.dynamics.slip(f).map(|s| s.value())
    }

    /// Tapes where the motion will be soon, on the parabola of the accelerations that `dynamics` holds.
    fn tape_soon(&mut self, after: f64) {
        let (after, half) = (T::from_f64(after), T::from_f64(0.5));
        let State { q, v, .. } = &mut self.stepper.scratch;
        let now = self.now.state.q.iter().zip(&self.now.state.v);
        let moved = now.zip(self.dynamics.acceleration());
        for ((q, v), ((&q_now, &v_now), &a)) in q.iter_mut().zip(v).zip(moved) {
            *q = q_now + after * (v_now + half * after * a);
            *v = v_now + after * a;
        }
        let State { q, v, .. } = &self.stepper.scratch;
        self.dynamics.tape(self.now.t + after, q, v);
    }
}
