//! A run from its start to its end: the loop of steps, and the pieces that its trajectory is given away in.

use super::Run;
use super::hidden::Hidden;
use crate::arithmetic::Scalar;
use crate::error::Error;
use crate::mode::{FrictionMode, Mode};
use crate::modes::guard::Guard;
use crate::modes::start;
use crate::settings::{Awaited, check_span, check_start};
use crate::state::FixedComponents;
use crate::trajectory::{State, Trajectory, Work};
use core::ops::Range;

impl<T: Scalar> Run<T> {
    /// Runs from `start` over `span`; the trajectory is written `into` a record. Once that has more than so many `bytes` it is given to
    /// `take`, and goes on with the motion from there; the last piece stays.
    pub(crate) fn execute(
        &mut self,
        start: &State<T>,
        span: Range<f64>,
        into: &mut Trajectory<T>,
        bytes: usize,
        take: &mut dyn FnMut(&Trajectory<T>),
    ) -> Result<(), Error> {
        let mut outcome = self.launch(start, span, into);
        while outcome.is_ok() && self.goes_on() {
            outcome = self.advance();
            if outcome.is_ok() && self.may_cut(bytes) {
                self.close();
                take(&self.recorder.trajectory);
                self.begin_piece();
            }
        }
        if let Some(monitor) = &self.settings.monitor {
            monitor.tell(self.now.t.value());
        }
        self.land(into);
        outcome
    }

    /// Begins a run whose trajectory is written `into` a record; [`Self::land`] gives it back.
    pub(crate) fn launch(
        &mut self,
        start: &State<T>,
        span: Range<f64>,
        into: &mut Trajectory<T>,
    ) -> Result<(), Error> {
        core::mem::swap(&mut self.recorder.trajectory, into);
        let t = T::from_f64(span.start);
        self.now.mode.clear();
        self.now.t = t;
        // Single precision has no number for most last times.
        (self.begin, self.end) = (t.value(), T::from_f64(span.end).value());
        self.looks = [self.begin; 3];
        self.now.state.clone_from(start);
        self.now.state.name(self.dynamics.description());
        let state = &self.now.state;
        self.recorder.trajectory.begin(t, state, &self.now.mode);
        self.dynamics.restart();
        self.recorder.work_before = self.dynamics.work();
        self.settings
            .check(&**self.dynamics.system(), start, &span)?;
        self.stepper.restart();
        self.rank.restart();
        self.now.distance = 1.0;
        self.locator.restart();
        self.switcher.restart();
        self.hidden.iter_mut().for_each(Hidden::restart);
        self.recorder.awaited.clone_from(&self.settings.last_events);
        (self.recorder.events_before, self.recorder.finished) = (0, false);
        let begun = self.enter_start().and_then(|()| self.check_logarithms());
        let begun = begun.and_then(|()| self.settle());
        begun.map_err(|error| {
            let extremal = self.extremal_constraint(&error);
            extremal.unwrap_or_else(|| self.overflow(error))
        })?;
        self.begin_sides();
        self.recorder.finished |= self.has_seen_all();
        Ok(())
    }

    /// What the start is like, in the mode with every touching contact closed and every vanishing slip at rest.
    pub(super) fn enter_start(&mut self) -> Result<(), Error> {
        let outcome = start::begin(
            &mut self.dynamics,
            self.now.t,
            &self.recorder.trajectory.start,
            &mut self.now.state,
            self.settings.per_step(),
            self.settings.project_start,
            &mut self.switcher.status,
        );
        if outcome.is_err() {
            // A projection that fails leaves off half-way, and a run that does not begin ends where it was to start.
            let start = &self.recorder.trajectory.start;
            self.now.state.clone_from(start);
        }
        outcome?;
        // Where nothing can close or rub no question is asked of sizes.
        let d = self.description();
        if !(d.contacts.is_empty() && d.frictions.is_empty()) {
            self.switcher.decider.take_sizes(&self.dynamics);
        }
        self.measure_gaps();
        self.recorder.trajectory.start.clone_from(&self.now.state);
        self.now.outdate();
        self.now.mode.clone_from(&self.switcher.status.mode);
        self.release_contacts_without_direction();
        self.ask_for_guards();
        if self.evaluate().is_ok() {
            self.rank.begin(&self.dynamics);
            self.release_dead_centres();
        } else {
            self.release_start();
        }
        self.recorder.trajectory.modes.clear();
        self.recorder.trajectory.modes.push(&self.now.mode);
        self.now.below.fill(false);
        for &c in &self.switcher.status.below {
            self.now.below[c] = true;
        }
        Ok(())
    }

    /// Opens contacts whose gap has no gradient where it is zero, as that above a floor which is exactly as low as a pendulum hangs: they carry nothing.
    fn release_contacts_without_direction(&mut self) {
        self.locator.fallen.clear();
        self.dynamics.set_mode(&self.now.mode);
        let closed = self.now.mode.contacts.iter().enumerate();
        let mut closed = closed.filter_map(|(c, closed)| closed.then_some(c));
        if !closed.any(|c| self.gradient_varies(c)) {
            return;
        }
        self.tape_of_all_rows();
        for c in 0..self.description().contacts.len() {
            if self.now.mode.contacts[c] && self.has_no_direction(c) {
                self.now.mode.contacts[c] = false;
                let rubbing = self.description().frictions_on(c);
                rubbing.for_each(|f| self.now.mode.frictions[f] = FrictionMode::Inactive);
                self.switcher.status.facts.touching[c] = false;
                self.locator.fallen.push(Guard::Gap(c));
            }
        }
        self.dynamics.set_mode(&self.now.mode);
    }

    /// Lets go of what cannot be held together at the start: what is at rest for an instant, as a slider at its dead centre, and surfaces that touch where
    /// they bend otherwise, as a floor does the edge that it ends in. Which of them the motion follows is decided then.
    fn release_start(&mut self) {
        for release in [Mode::release_sticking, Mode::release_contacts] {
            if release(&mut self.now.mode) {
                self.dynamics.set_mode(&self.now.mode);
                self.ask_for_guards();
            }
            if self.evaluate().is_ok() {
                break;
            }
        }
    }

    /// Ends a run, whatever came of it.
    pub(crate) fn land(&mut self, into: &mut Trajectory<T>) {
        self.close();
        core::mem::swap(&mut self.recorder.trajectory, into);
    }

    /// Completes the trajectory.
    fn close(&mut self) {
        self.note_stiffness();
        self.recorder.trajectory.last_time = self.now.t;
        self.recorder.trajectory.last.clone_from(&self.now.state);
        let work = self.dynamics.work();
        self.recorder.trajectory.work = Work {
            evaluations: work.values - self.recorder.work_before.values,
            series: work.series - self.recorder.work_before.series,
            factorizations: work.factorizations - self.recorder.work_before.factorizations,
            ..self.recorder.trajectory.work
        };
    }

    /// Whether there is more to do.
    pub(crate) fn goes_on(&self) -> bool {
        !self.recorder.finished && self.now.t.value() < self.end
    }

    /// Whether everything has happened that the run is to end after.
    pub(super) fn has_seen_all(&self) -> bool {
        let happened = |awaited: &Awaited| {
            let events = self.recorder.trajectory.events.iter();
            events.filter(|event| awaited.is(event)).count() >= awaited.number
        };
        !self.settings.last_events.is_empty() && self.recorder.awaited.iter().all(happened)
    }

    /// Whether the record, which is to have about so many `bytes`, ends here, where the motion can be told from here on by itself: nothing that began
    /// earlier is under way but the mode. More may happen at an instant at which something has, so that it is the last resort where every step ends in an event.
    fn may_cut(&self, bytes: usize) -> bool {
        let most = match self.switcher.stuck.is_empty() {
            true => bytes,
            false => bytes.saturating_mul(2),
        };
        self.recorder.trajectory.bytes() > most && self.goes_on() && !self.now.below.contains(&true)
    }

    /// Goes on with an empty record.
    fn begin_piece(&mut self) {
        let events = &self.recorder.trajectory.events;
        self.recorder.awaited.retain_mut(|awaited| {
            let seen = events.iter().filter(|event| awaited.is(event)).count();
            awaited.number = awaited.number.saturating_sub(seen);
            awaited.number > 0
        });
        self.recorder.events_before += events.len();
        let work = self.recorder.trajectory.work;
        self.recorder
            .trajectory
            .begin(self.now.t, &self.now.state, &self.now.mode);
        self.recorder.trajectory.work = work;
        self.stepper.stiffness.since = self.stepper.stiffness.since.map(|_| self.now.t.value());
    }

    /// See [`crate::Simulation::consistent`].
    pub(crate) fn consistent(
        &mut self,
        time: f64,
        reference: &State<T>,
        fixed: &FixedComponents<T>,
    ) -> Result<State<T>, Error> {
        let d = self.description();
        check_span(&(time..time))?;
        reference.check_dimension(d.coordinates.len())?;
        let mut given = reference.clone();
        let held = fixed.write(&mut given)?;
        check_start(d, &given, time)?;
        let begun = self.mode_at(time, reference);
        let tolerance = self.settings.per_step();
        let dynamics = &mut self.dynamics;
        dynamics.restart();
        let fixed = (&given, &held);
        start::consistent(dynamics, time, tolerance, reference, fixed, begun.as_ref())
    }

    /// The mode in which the motion begins in a state, or next to it where it is off its constraints; `None` if it does not begin.
    fn mode_at(&mut self, time: f64, state: &State<T>) -> Option<Mode> {
        let project = core::mem::replace(&mut self.settings.project_start, true);
        let mut record = self.recorder.trajectory.clone();
        let begun = self.launch(state, time..time, &mut record);
        self.settings.project_start = project;
        let mode = begun.is_ok().then(|| self.now.mode.clone());
        self.land(&mut record);
        mode
    }
}
