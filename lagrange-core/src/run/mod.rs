//! The loop of a run: step, look for the first thing that happens, switch, go on.

mod accumulation;
mod acting;
mod cause;
mod corners;
mod dead_centre;
mod extremal;
mod fading;
mod failure;
mod feasible;
mod guard_polynomials;
mod hidden;
mod hit;
mod hits;
mod instant;
mod jam;
pub(crate) mod lockstep;
mod log;
mod outlook;
mod piece;
mod redundant;
mod region;
mod resolution;
mod rest;
mod sampled_step;
mod samples;
mod sides;
mod singular;
mod stepping;
mod stiffness;
mod still;
mod switch;
mod taylor_step;

use crate::arithmetic::{Scalar, epsilon};
use crate::dynamics::{Dynamics, EvaluationError, OutputMask};
use crate::error::Error;
use crate::mode::Mode;
use crate::modes::domain;
use crate::modes::facts::{EvaluationPoint, SwitchContext, SwitchFacts};
use crate::modes::guard::{self, Guard};
use crate::modes::reading::Reading;
use crate::modes::start;
use crate::settings::{Awaited, Settings};
use crate::state::FixedComponents;
use crate::system::Erased;
use crate::system::{Description, Watch};
use crate::trajectory::{EventKind, State, Subject, Trajectory, Work};
use acting::acting;
use core::ops::Range;
use corners::Lagrangian;
use hidden::Hidden;
use hit::Hit;
use hits::Locator;
use log::Recorder;
use singular::Rank;
use stepping::Stepper;
use switch::Switcher;

/// This many events without any progress in time are a livelock.
const MOST_EVENTS_AT_ONCE: usize = 40;

/// Nearer than this to a loss of rank what is left of a residual is amplified: it is taken away to the last bit.
const NEAR: f64 = 0.7;

/// Steps between two looks at rows that a step does not leave by more than rounding.
const STEPS_OF_ROUNDING: usize = 16;

/// A force this near to its limit, relative, is at it if it was.
const AT_LIMIT: f64 = 1e-13;

/// How much of a Taylor series there is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Progress {
    None,
    /// The values: coefficients of order 0.
    Begun,
    Complete,
}

/// A run: where the motion is, and what makes its steps, finds what ends them, changes its mode and writes it down.
#[derive(Debug)]
pub(crate) struct Run<T: Scalar> {
    settings: Settings,
    dynamics: Dynamics<T>,
    now: Now<T>,
    stepper: Stepper<T>,
    /// Of what is declared, if there are any.
    hidden: Option<Hidden>,
    /// Whether the strength of a friction follows from the state.
    strengths_vary: bool,
    /// Whether accelerations may jump where no branch says so.
    may_jump: bool,
    /// Whether what acts is a function of time.
    changes_with_time: bool,
    /// Of what is declared, if a choice in it may change.
    lagrangian: Option<Lagrangian>,
    /// Watches for positions where constraints lose rank.
    rank: Rank,
    locator: Locator<T>,
    switcher: Switcher<T>,
    recorder: Recorder<T>,
    /// First instant of the span,
    begin: f64,
    /// and its last one.
    end: f64,
}

/// Where the motion is.
#[derive(Debug)]
struct Now<T> {
    t: T,
    state: State<T>,
    mode: Mode,
    /// Per contact: the motion is beyond its surface, where it passed outside its region.
    below: Vec<bool>,
    /// Whether a step can leave the rows of the mode.
    drifts: bool,
    /// How much of the Taylor series at this state `dynamics` holds.
    series: Progress,
    /// Whether `dynamics` holds the values of this state, for the needs of the mode.
    valued: bool,
    /// Distance from a position where constraints lose rank.
    distance: f64,
}

impl<T: Scalar> Now<T> {
    /// What `dynamics` holds is of another state or mode.
    fn outdate(&mut self) {
        (self.valued, self.series) = (false, Progress::None);
    }

    /// Where the mode may end, for who decides on the next.
    fn context<'a>(
        &'a self,
        order: usize,
        tolerance: f64,
        facts: &'a SwitchFacts,
    ) -> SwitchContext<'a, T> {
        SwitchContext {
            moment: EvaluationPoint {
                t: self.t,
                q: &self.state.q,
                v: &self.state.v,
                order,
                tolerance,
            },
            present: &self.mode,
            facts,
        }
    }
}

impl<T: Scalar> Run<T> {
    /// Makes everything ready.
    pub(crate) fn new(system: Erased<T>, settings: &Settings) -> Self {
        let d = system.description();
        let n = d.coordinates.len();
        let mut state = State::new(vec![T::default(); n], vec![T::default(); n]);
        state.name(d);
        let mode = Mode::open(d);
        let acting = acting(&system, &settings.effects);
        let mut run = Run {
            dynamics: Dynamics::of(system.clone(), &settings.effects),
            stepper: Stepper::new(settings, d, &state),
            hidden: Hidden::new(&system, &acting),
            strengths_vary: domain::strengths_vary(d),
            may_jump: acting.may_jump(),
            changes_with_time: acting.reads_time(),
            lagrangian: Lagrangian::new(&system, &settings.effects),
            rank: Rank::new(d, &settings.effects),
            locator: Locator::new(d, settings, &mode),
            switcher: Switcher::new(d, &state, &mode),
            recorder: Recorder::new(&system, settings, &state, &mode),
            now: Now {
                t: T::default(),
                below: vec![false; d.contacts.len()],
                drifts: true,
                series: Progress::None,
                valued: false,
                distance: 1.0,
                state,
                mode,
            },
            begin: 0.0,
            end: 0.0,
            settings: settings.clone(),
        };
        run.dynamics.set_equations(settings.equations);
        run.watch();
        run
    }

    /// The table of names and places of the system.
    pub(crate) fn description(&self) -> &'static Description {
        self.dynamics.description()
    }

    /// Takes another system of the same kind.
    pub(crate) fn set_system(&mut self, system: Erased<T>) {
        if self.hidden.is_some() {
            self.hidden = Hidden::new(&system, &acting(&system, &self.settings.effects));
        }
        if self.lagrangian.is_some() {
            self.lagrangian = Lagrangian::new(&system, &self.settings.effects);
        }
        self.dynamics.set_system(system);
    }

    /// See [`crate::Simulation::consistent`].
    pub(crate) fn consistent(
        &mut self,
        time: f64,
        reference: &State<T>,
        fixed: &FixedComponents<T>,
    ) -> Result<State<T>, Error> {
        let begun = self.mode_at(time, reference);
        let tolerance = self.settings.per_step();
        let dynamics = &mut self.dynamics;
        dynamics.restart();
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

    /// An empty trajectory.
    pub(crate) fn record(&self) -> &Trajectory<T> {
        &self.recorder.trajectory
    }

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
            if outcome.is_ok() && self.recorder.trajectory.bytes() > bytes && self.may_cut() {
                self.close();
                take(&self.recorder.trajectory);
                self.begin_piece();
            }
        }
        self.land(into);
        outcome
    }

    /// Whether the motion can be told from here on by itself: nothing has happened at this instant, and nothing that began earlier is
    /// under way but the mode.
    fn may_cut(&self) -> bool {
        self.goes_on() && self.switcher.stuck.is_empty() && !self.now.below.contains(&true)
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
        (self.begin, self.end) = (span.start, span.end);
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
        let begun = self.enter_start().and_then(|()| self.settle());
        begun.map_err(|error| {
            let extremal = self.extremal_constraint(&error);
            extremal.unwrap_or_else(|| self.overflow(error))
        })?;
        self.begin_sides();
        self.recorder.finished |= self.has_seen_all();
        Ok(())
    }

    /// What the start is like, in the mode with every touching contact closed and every vanishing slip at rest.
    fn enter_start(&mut self) -> Result<(), Error> {
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
        self.recorder.trajectory.start.clone_from(&self.now.state);
        self.now.outdate();
        self.now.mode.clone_from(&self.switcher.status.mode);
        self.hold_guards();
        if self.evaluate().is_ok() {
            self.release_dead_centres();
        } else if self.now.mode.release_sticking() {
            // What is at rest for an instant, as a slider at its dead centre, may be held there by nothing.
            self.dynamics.set_mode(&self.now.mode);
            self.hold_guards();
        }
        self.recorder.trajectory.modes.clear();
        self.recorder.trajectory.modes.push(&self.now.mode);
        self.now.below.fill(false);
        for &c in &self.switcher.status.below {
            self.now.below[c] = true;
        }
        Ok(())
    }

    /// A mark that begins below zero has not passed it: remembers on which side the marks begin.
    fn begin_sides(&mut self) {
        let reading = Reading::Series(&self.dynamics);
        for (i, below) in self.locator.mark_below.iter_mut().enumerate() {
            for (k, below) in below.iter_mut().enumerate() {
                *below = guard::value(Guard::Mark(i, k), &self.now.mode, &reading) < 0.0;
            }
        }
    }

    /// Ends a run, whatever came of it.
    pub(crate) fn land(&mut self, into: &mut Trajectory<T>) {
        self.close();
        core::mem::swap(&mut self.recorder.trajectory, into);
    }

    /// Whether there is more to do.
    pub(crate) fn goes_on(&self) -> bool {
        !self.recorder.finished && self.now.t.value() < self.end
    }

    /// One step, cut short by the first thing that happens in it.
    pub(crate) fn advance(&mut self) -> Result<(), Error> {
        self.make_step().map_err(|error| self.cause(error))
    }

    fn make_step(&mut self) -> Result<(), Error> {
        if self.recorder.trajectory.work.steps >= self.settings.max_steps {
            return Err(self.limit("steps", self.settings.max_steps));
        }
        self.check_outlook()?;
        if let Some(monitor) = &self.settings.monitor {
            let time = self.now.t.value();
            monitor.tell(time);
            if monitor.is_stopped() {
                return Err(Error::Interrupted { time });
            }
        }
        self.watch_stiffness();
        if self.now.valued {
            self.dynamics.note_loads();
        }
        let hit = self.accepted_step()?;
        self.check_resolution()?;
        let mut end = hit.end();
        let mut exact = self.exact_end(&hit);
        self.refuse_hidden_corners(end)?;
        let refused = self.friction_that_pushes(end);
        if let Some((first, _)) = &refused {
            (end, exact) = (*first, T::from_f64(*first));
        }
        if end > 0.0 {
            // The step left there the state at its end, evaluated.
            core::mem::swap(&mut self.now.state, &mut self.stepper.scratch);
            (self.now.valued, self.now.series) = (self.locator.rests.is_empty(), Progress::None);
        }
        self.log_marks(end);
        self.remember_sides(end);
        self.remember_regions(end);
        self.locator.polynomials.raise(end);
        let aside = self.dynamics.holds_rows_aside();
        let trajectory = &mut self.recorder.trajectory;
        trajectory.push(&self.stepper.step, exact, aside);
        self.recorder.trajectory.work.steps += 1;
        if end > 0.0 {
            let whole = end == 1.0;
            self.now.t = self.stepper.step.t + self.stepper.step.h * exact;
            if whole && self.is_spent(self.end - self.now.t.value()) {
                self.now.t = T::from_f64(self.end);
            }
            // Time may be too coarse for the step.
            let (before, now) = (self.stepper.step.t.value(), self.now.t.value());
            if now - before > 2.0 * epsilon::<T>() * now.abs() {
                self.switcher.stuck.clear();
            }
            if let Some((_, error)) = refused {
                return Err(error);
            }
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
        if end > 0.0 {
            self.slips_have_begun();
        }
        match hit {
            Hit::Nothing | Hit::Turned(_) => {
                if self.slips_come_to_rest(end) {
                    self.count_switch()?;
                    self.leave_stiffness();
                    self.switch()?;
                }
            }
            Hit::Stop(stop, _) => {
                if !self.now.valued {
                    self.evaluate()?;
                }
                self.finish(stop);
            }
            Hit::Guards(_) => {
                if !self.only_creeps(end)? {
                    self.count_switch()?;
                    if !self.only_shares_otherwise()? {
                        self.leave_stiffness();
                        self.switch()?;
                    }
                }
            }
        }
        self.recorder.finished |= self.has_seen_all();
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
        self.locator.blur = self.error_of_directions();
        let Switcher { decider, .. } = &mut self.switcher;
        let limit = AT_LIMIT.max(self.locator.blur);
        self.locator.at_limit.retain_mut(|(guard, size)| {
            let (value, now) = decider.force(&mut self.dynamics, &self.now.mode, *guard);
            *size = size.max(now);
            self.now.valued && value.abs() <= limit * *size
        });
    }

    /// Whether everything has happened that the run is to end after.
    fn has_seen_all(&self) -> bool {
        let happened = |awaited: &Awaited| {
            let events = self.recorder.trajectory.events.iter();
            events.filter(|event| awaited.is(event)).count() >= awaited.number
        };
        !self.settings.last_events.is_empty() && self.recorder.awaited.iter().all(happened)
    }

    /// Counts a switch; too many at one time, or in all, end the run.
    fn count_switch(&mut self) -> Result<(), Error> {
        let events = self.recorder.events_before + self.recorder.trajectory.events.len();
        if events >= self.settings.max_events {
            return Err(self.limit("events", self.settings.max_events));
        }
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
    fn finish(&mut self, stop: usize) {
        self.log_here(Subject::Stop(stop), EventKind::Stop);
        self.recorder.finished = true;
    }

    fn log_marks(&mut self, end: f64) {
        if self.locator.polynomials.marks.is_empty() {
            return;
        }
        let mut marks = core::mem::take(&mut self.locator.marks);
        self.marks_until(end, &mut marks);
        for &(mark, s) in &marks {
            let s = self.exact_mark(mark, s);
            let mut state = core::mem::take(&mut self.stepper.scratch);
            self.stepper.step.state_into(s, &mut state.q, &mut state.v);
            let time = self.stepper.step.time(s);
            self.now.valued = false;
            if self.dynamics.value_along(time, &state.q, &state.v).is_ok() {
                self.log_watch(Subject::Mark(mark), EventKind::Mark, time, &state);
            }
            self.stepper.scratch = state;
        }
        self.locator.marks = marks;
    }

    /// Stops whose conditions the switch has just made true.
    fn stops_of_the_mode(&mut self) -> Result<(), Error> {
        let d = self.description();
        for at in 0..self.locator.polynomials.stops.len() {
            let i = self.locator.polynomials.stops[at];
            if self.has_become_true(&d.stops[i], |k| Guard::Stop(i, k)) {
                self.evaluate()?;
                self.finish(i);
                return Ok(());
            }
        }
        for at in 0..self.locator.polynomials.marks.len() {
            let i = self.locator.polynomials.marks[at];
            if self.has_become_true(&d.marks[i], |k| Guard::Mark(i, k)) {
                self.evaluate()?;
                self.log_here(Subject::Mark(i), EventKind::Mark);
            }
        }
        Ok(())
    }

    /// Whether the switch has made the conditions of a watch hold while its terms do.
    fn has_become_true(&self, watch: &Watch, term: impl Fn(usize) -> Guard) -> bool {
        let reading = Reading::Series(&self.dynamics);
        let value = |k| guard::value(term(k), &self.now.mode, &reading);
        !watch.conditions.is_empty()
            && !self.recorder.before.mode.satisfies(watch.conditions)
            && self.now.mode.satisfies(watch.conditions)
            && (0..watch.terms.len()).all(|k| value(k) >= 0.0)
    }

    /// Enters the mode that the decider has found.
    fn set_mode_decided(&mut self) {
        self.locator.at_limit.clear();
        self.locator.blur = 0.0;
        self.locator.opened = false;
        self.now
            .mode
            .clone_from(&self.switcher.decider.decision.mode);
        self.recorder.trajectory.enter(&self.now.mode);
        self.locator
            .polynomials
            .composites
            .clone_from(&self.switcher.decider.decision.composites);
        self.locator
            .polynomials
            .held
            .clone_from(&self.switcher.decider.decision.held);
        self.now.outdate();
        self.hold_guards();
    }

    /// Holds what the guards of the mode, which `dynamics` is in, need.
    fn hold_guards(&mut self) {
        self.ask_for_guards();
        let watched = self.switcher.table.of(&self.dynamics);
        self.now.drifts = watched.drifts;
        let guards = watched.guards.iter().copied();
        self.locator
            .polynomials
            .arm(guards, &self.now.mode, &self.dynamics);
    }

    /// Asks for the numbers that the guards of the mode read.
    pub(super) fn ask_for_guards(&mut self) {
        let watched = self.switcher.table.of(&self.dynamics);
        // The rank is read from the rows.
        if self.rank.watches() && !self.dynamics.gives_rows() {
            self.dynamics.set_extra_needs(&watched.needs);
        } else {
            self.dynamics.set_guard_needs(&watched.needs);
        }
    }

    /// Asks for the numbers of all rows, whether or not the mode reads them.
    pub(super) fn ask_for_all_rows(&mut self) {
        self.dynamics.set_extra_needs(&self.switcher.status.needs);
    }

    /// The numbers of all rows at the present state; the mode is the one that `dynamics` is in.
    pub(super) fn tape_of_all_rows(&mut self) {
        self.ask_for_all_rows();
        let State { q, v, .. } = &self.now.state;
        self.dynamics.tape(self.now.t, q, v);
    }

    /// Asks for the stops and marks that take part.
    fn watch(&mut self) {
        let d = self.description();
        let mut needs = OutputMask::new(d);
        for &i in &self.locator.polynomials.stops {
            needs.insert(d.stops[i].need);
        }
        for &i in &self.locator.polynomials.marks {
            needs.insert(d.marks[i].need);
        }
        self.dynamics.set_report_needs(&needs);
    }

    /// Values at the present state in the present mode, with every row's Jacobian and rate.
    fn evaluate_all_rows(&mut self) -> Result<(), Error> {
        self.ask_for_all_rows();
        self.evaluate()?;
        self.now.valued = false;
        Ok(())
    }

    fn evaluate(&mut self) -> Result<(), Error> {
        let outcome = self
            .dynamics
            .value(self.now.t, &self.now.state.q, &self.now.state.v);
        outcome.map_err(|e| self.error(e))?;
        self.now.valued = true;
        Ok(())
    }

    /// Taylor series at the present state, unless they are there.
    fn expand(&mut self) -> Result<(), Error> {
        self.begin_series().map_err(|e| self.error(e))?;
        if self.now.series == Progress::Begun {
            self.dynamics.end_series(self.stepper.order);
            self.now.series = Progress::Complete;
        }
        Ok(())
    }

    /// At least the leading coefficients at the present state.
    fn begin_series(&mut self) -> Result<(), EvaluationError> {
        if self.now.series == Progress::None {
            self.dynamics.hold_rows_aside(false);
            let State { q, v, .. } = &self.now.state;
            let rest = self
                .dynamics
                .begin_series(self.now.t, q, v, self.stepper.order)?;
            self.dynamics.hold_rows_aside(!self.is_undecided());
            self.now.series = if rest {
                Progress::Begun
            } else {
                Progress::Complete
            };
        }
        Ok(())
    }

    /// Whether the time that a step leaves of the run is rounding.
    fn is_spent(&self, rest: f64) -> bool {
        rest.abs() <= 4.5 * epsilon::<T>() * self.end.abs().max(self.stepper.step.h.value())
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
}
