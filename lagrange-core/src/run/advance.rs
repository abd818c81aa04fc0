//! One turn of the loop: a step, cut short by the first thing that happens in it, and what follows from that.

use super::hit::Hit;
use super::switch::Switcher;
use super::{Progress, Run};
use crate::arithmetic::{Scalar, derivatives, epsilon};
use crate::error::Error;
use crate::modes::guard::Guard;
use crate::trajectory::{EventKind, State, Subject};

/// This many events without any progress in time are a livelock.
const MOST_EVENTS_AT_ONCE: usize = 40;

/// Nearer than this to a loss of rank what is left of a residual is amplified: it is taken away to the last bit.
const NEAR: f64 = 0.7;

/// Each so many steps it is seen how many have been tried in vain, and how far they have come:
const STEPS_OF_TRIES: usize = 1000;

/// where tries are more than so many a step, rounding or a jump says how long steps are,
const MOST_TRIES: usize = 10;

/// and there is no end to them if what is left of the run is more than so many times as long;
const NO_END: f64 = 1e3;

/// and neither where all of them together are no more than this beside the time.
const NO_PROGRESS: f64 = 1e-10;

/// Steps between two looks at rows that a step does not leave by more than rounding.
const STEPS_OF_ROUNDING: usize = 16;

/// A force this near to its limit, relative, is at it if it was,
const AT_LIMIT: f64 = 1e-13;

/// and so is one within so many tolerances by methods other than Taylor's, which are off by that much where a slip has come to rest.
const ERRORS: f64 = 10.0;

impl<T: Scalar> Run<T> {
    /// One step, cut short by the first thing that happens in it.
    pub(crate) fn advance(&mut self) -> Result<(), Error> {
        self.make_step().map_err(|error| self.cause(error))
    }

    fn make_step(&mut self) -> Result<(), Error> {
        self.check_whether_to_go_on()?;
        self.watch_stiffness();
        if self.now.valued {
            self.dynamics.note_loads();
        }
        let composites = &mut self.locator.polynomials.composites;
        composites.iter_mut().for_each(|c| c.falls_after = None);
        self.locator.vanishing.clear();
        let hit = self.accepted_step()?;
        self.refuse_watches_of_bounded_shares()?;
        let hit = self.stop_where_guards_fall(hit);
        self.check_resolution()?;
        let end = self.take_step(&hit)?;
        if end > 0.0 {
            self.slips_have_begun();
        }
        if !self.recorder.finished {
            self.meet_hit(hit, end)?;
        }
        self.recorder.finished |= self.has_seen_all();
        // The marks of the step are among them.
        match self.recorder.finished {
            true => Ok(()),
            false => self.check_limit("events", self.events(), self.settings.max_events),
        }
    }

    /// Whether the run has neither come to a limit nor been stopped.
    fn check_whether_to_go_on(&mut self) -> Result<(), Error> {
        let steps = self.recorder.trajectory.work.steps + 1;
        self.check_limit("steps", steps, self.settings.max_steps)?;
        self.check_reach()?;
        self.check_progress()?;
        if let Some(monitor) = &self.settings.monitor {
            let time = self.now.t.value();
            monitor.tell(time);
            if monitor.is_stopped() {
                return Err(Error::Interrupted { time });
            }
        }
        Ok(())
    }

    /// Whether steps come forward, and are not tried in vain again and again.
    fn check_progress(&mut self) -> Result<(), Error> {
        let work = &self.recorder.trajectory.work;
        if !work.steps.is_multiple_of(STEPS_OF_TRIES) {
            return Ok(());
        }
        let now = self.now.t.value();
        let (rejected, before) = core::mem::replace(&mut self.stepper.looked, (work.rejected, now));
        let (made, left) = (now - before, self.end - now);
        let tries = work.rejected.saturating_sub(rejected);
        let vain = tries > MOST_TRIES * STEPS_OF_TRIES && left > NO_END * made;
        let stands = work.steps > 0 && made <= NO_PROGRESS * now.abs();
        // Breaks of guards have a number of their own.
        match (vain || stands) && self.stepper.breaks == 0 {
            true => Err(self.step_too_small(self.stepper.step.h.value())),
            false => Ok(()),
        }
    }

    /// Moves the state to the end of the step at hand, up to what ends it, and writes that down. The part of the step up to there.
    fn take_step(&mut self, hit: &Hit) -> Result<f64, Error> {
        let mut end = hit.end();
        self.refuse_hidden_corners(end)?;
        let mut exact = self.exact_end(hit);
        let undirected = self.stepper.undirected.take().map(|item| {
            let time = self.stepper.step.time(T::from_f64(end)).value();
            (end, Error::Undirected { time, item })
        });
        let refused = self.friction_that_pushes(end).or(undirected);
        if let Some((first, _)) = &refused {
            (end, exact) = (*first, T::from_f64(*first));
            self.locator.vanishing.clear();
        }
        // Also a step that ends where it begins may move derivatives.
        let moves = exact != T::zero();
        if moves {
            // The step left there the state at its end, evaluated.
            core::mem::swap(&mut self.now.state, &mut self.stepper.scratch);
            (self.now.valued, self.now.series) = (self.locator.rests.is_empty(), Progress::None);
        }
        if let Some(last) = self.log_marks(end, exact.value()) {
            let State { q, v, .. } = &mut self.now.state;
            self.stepper.step.state_into(last, q, v);
            (end, exact) = (last.value(), last);
            self.recorder.finished = true;
        }
        self.look_for_still_watches(end);
        self.remember_sides(end);
        self.remember_regions(end);
        self.locator.polynomials.raise(end);
        let aside = self.dynamics.holds_rows_aside();
        let trajectory = &mut self.recorder.trajectory;
        trajectory.push(&self.stepper.step, exact, aside);
        self.recorder.trajectory.work.steps += 1;
        if moves {
            let whole = end == 1.0;
            self.now.t = self.stepper.step.t + self.stepper.step.h * exact;
            if whole && self.is_spent(self.end - self.now.t.value()) {
                let of_event = match *hit {
                    Hit::Nothing | Hit::Turned(_) => T::zero(),
                    Hit::Guards(_) | Hit::Stop(..) => derivatives(self.now.t),
                };
                self.now.t = T::from_f64(self.end) + of_event;
            }
            // Time may be too coarse for the step.
            let (before, now) = (self.stepper.step.t.value(), self.now.t.value());
            if now - before > 2.0 * epsilon::<T>() * now.abs() {
                self.switcher.stuck.clear();
            }
        }
        if let Some((_, error)) = refused.filter(|_| !self.recorder.finished) {
            return Err(error);
        }
        if moves {
            self.forget_zeros();
            let steps = self.recorder.trajectory.work.steps;
            let stays = self.stepper.is_taylor() && !self.now.drifts;
            // What is left of a residual makes rows seem independent that are not.
            let near = self.now.distance < NEAR || self.dynamics.has_rows_aside();
            let projects = near || !stays || steps.is_multiple_of(STEPS_OF_ROUNDING);
            if projects && !self.is_undecided() {
                self.project(near)?;
            }
        }
        Ok(end)
    }

    /// Goes on with what has ended the step at part `end` of it.
    fn meet_hit(&mut self, hit: Hit, end: f64) -> Result<(), Error> {
        match hit {
            Hit::Nothing | Hit::Turned(_) => {
                self.note_edges_at(end);
                if self.slips_come_to_rest(end) {
                    self.count_switch()?;
                    self.leave_mode()?;
                }
            }
            Hit::Stop(stop, _) => {
                // The last mark may have been evaluated since.
                match self.now.valued {
                    true => {}
                    false if self.is_undecided() => self.evaluate_at_or_before(T::from_f64(end)),
                    false => self.evaluate()?,
                }
                self.finish(stop);
            }
            Hit::Guards(_) => {
                if !self.only_creeps(end)? && !self.only_residuals_fall(end) {
                    self.count_switch()?;
                    if !self.only_shares_otherwise()? {
                        self.leave_mode()?;
                    }
                }
            }
        }
        Ok(())
    }

    /// Switches. Where nothing is logged the mode is the same, as where a slip far below the tolerance is zero by the error of the step, and the motion is as
    /// stiff as before.
    fn leave_mode(&mut self) -> Result<(), Error> {
        let events = self.recorder.trajectory.events.len();
        self.switch()?;
        if self.recorder.trajectory.events.len() > events {
            self.leave_stiffness();
        } else {
            self.switcher.silent += 1;
        }
        Ok(())
    }

    /// What began at zero with the last step is an ordinary guard in the next, but for a force that is still at its limit to
    /// rounding, or to what errors make of the directions of slips: a block that is just held, a contact that carries nothing. Its size is the
    /// largest so far, for there may be nothing at an instant.
    fn forget_zeros(&mut self) {
        let gap = |(guard, _): &(Guard, usize)| matches!(guard, Guard::Gap(_));
        self.locator.opened = self.locator.zeros.iter().any(gap);
        self.locator.zeros.clear();
        let at_limit = &mut self.switcher.decider.decision.at_limit;
        self.locator.at_limit.append(at_limit);
        if self.locator.at_limit.is_empty() {
            return;
        }
        let error = match self.stepper.other {
            Some(_) => ERRORS * self.settings.tolerance,
            None => 0.0,
        };
        self.locator.blur = self.blur_at_limit().max(error);
        let Switcher { decider, .. } = &mut self.switcher;
        let limit = AT_LIMIT.max(self.locator.blur);
        self.locator.at_limit.retain_mut(|(guard, size)| {
            let (value, now) = decider.force(&mut self.dynamics, &self.now.mode, *guard);
            *size = size.max(now);
            self.now.valued && value.abs() <= limit * *size
        });
    }

    /// Events so far, and switches that change nothing.
    fn events(&self) -> usize {
        let recorder = &self.recorder;
        recorder.events_before + recorder.trajectory.events.len() + self.switcher.silent
    }

    /// Counts a switch; too many at one time, or in all, those that change nothing among them, end the run.
    fn count_switch(&mut self) -> Result<(), Error> {
        self.check_limit("events", self.events() + 1, self.settings.max_events)?;
        self.switcher.stuck.push(&self.now.mode);
        if self.switcher.stuck.len() < MOST_EVENTS_AT_ONCE {
            return Ok(());
        }
        let d = self.description();
        let last = self.switcher.stuck.iter().rev().take(4).rev();
        Err(Error::NoProgress {
            time: self.now.t.value(),
            modes: last.map(|m| m.display(d).to_string()).collect(),
            item: self
                .recorder
                .trajectory
                .events
                .last()
                .map_or(d.name, |e| e.subject.name(d)),
        })
    }

    /// Ends the run at a stop.
    pub(super) fn finish(&mut self, stop: usize) {
        self.log_here(Subject::Stop(stop), EventKind::Stop);
        self.recorder.finished = true;
    }

    /// Whether the time that a step leaves of the run is rounding.
    pub(super) fn is_spent(&self, rest: f64) -> bool {
        rest.abs() <= 4.5 * epsilon::<T>() * self.end.abs().max(self.stepper.step.h.value())
    }
}
