//! The loop of a run: step, look for the first thing that happens, switch, go on.

mod accumulation;
mod cause;
mod curves;
mod hits;
mod instant;
mod log;
mod region;
mod rest;
pub(crate) mod round;
mod samples;
mod shares;
mod singular;
mod stepping;
mod stiffness;
mod switch;
#[cfg(test)]
mod tests;

use crate::arithmetic::Scalar;
use crate::dynamics::{Dynamics, EvaluationError, NeedSet};
use crate::erased::Erased;
use crate::error::Error;
use crate::integrate::{StepPolynomial, Tolerance};
use crate::mode::Mode;
use crate::modes::decide::Decider;
use crate::modes::guard::{self, Guard};
use crate::modes::impact::Collider;
use crate::modes::reading::Reading;
use crate::modes::sharing::Sharing;
use crate::modes::start;
use crate::modes::survey::Survey;
use crate::modes::table::Table;
use crate::pool::Pool;
use crate::settings::{Awaited, Settings};
use crate::state::Held;
use crate::system::{Description, Watch};
use crate::trajectory::{Asked, EventKind, Record, State, Subject, Work};
use accumulation::{Impacts, Train};
use core::ops::Range;
use curves::Curves;
use hits::Hit;
use log::Before;
use rest::Rest;
use singular::Rank;
use stepping::Stepper;
use stiffness::Stiffness;

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

/// The state of a run, and everything that it works with.
#[derive(Debug)]
pub(crate) struct Run<T: Scalar> {
    settings: Settings,
    dynamics: Dynamics<T>,
    stepper: Stepper<T>,
    stiffness: Stiffness<T>,
    tolerance: Tolerance,
    /// Order of Taylor series.
    order: usize,
    t: T,
    end: f64,
    state: State<T>,
    mode: Mode,
    table: Table,
    /// Whether a step can leave the rows of the mode.
    drifts: bool,
    /// Per contact: the motion is beyond its surface, where it passed outside its region.
    below: Vec<bool>,
    /// Guards whose leading coefficients vanish at the start of the coming step.
    zeros: Vec<(Guard, usize)>,
    /// Forces that are at their limit, with their sizes.
    at_limit: Vec<(Guard, f64)>,
    /// How much of the Taylor series at the present state `dynamics` holds.
    series: Progress,
    /// Whether `dynamics` holds the values of the present state, for the needs of the mode.
    valued: bool,
    /// Falling guards found in the present step: (guard, part of the step, half width).
    falls: Vec<(Guard, f64, f64)>,
    fallen: Vec<Guard>,
    /// Slips of two components that come to rest with it.
    rests: Vec<Rest>,
    /// The mode with those at rest.
    resting: Mode,
    /// Velocities a little before that.
    earlier: Vec<T>,
    stop_below: Vec<Vec<bool>>,
    mark_below: Vec<Vec<bool>>,
    marks: Vec<(usize, f64)>,
    step: StepPolynomial<T>,
    /// Of the length of the step.
    powers: Vec<f64>,
    curves: Curves,
    scratch: State<T>,
    /// Σ k vₖ of the polynomials of the velocities.
    slopes: Vec<f64>,
    survey: Survey,
    collider: Collider<T>,
    /// Contacts whose gap vanishes at an impact.
    near: Vec<usize>,
    decider: Decider<T>,
    /// Of undetermined forces at the present state.
    sharing: Sharing<T>,
    before: Before<T>,
    forces_after: Vec<T>,
    undetermined_after: Vec<bool>,
    /// Per contact: its impacts so far.
    impacts: Vec<Impacts<T>>,
    /// All impacts so far.
    train: Train,
    scratch_mode: Mode,
    /// Watches for positions where constraints lose rank.
    rank: Rank,
    /// Distance from such a position at the start of the coming step.
    distance: f64,
    /// Modes of the switches since time last advanced.
    stuck: Pool<Mode>,
    finished: bool,
    /// Events after which the run is to end, but for those that earlier pieces of the record have,
    awaited: Vec<Awaited>,
    /// and how many events these have.
    events_before: usize,
    /// What earlier runs cost.
    work_before: crate::dynamics::Work,
    trajectory: Record<T>,
}

impl<T: Scalar> Run<T> {
    /// Makes everything ready.
    pub(crate) fn new(system: Erased<T>, settings: &Settings) -> Self {
        let d = system.description();
        let (n, rows) = (d.coordinates.len(), d.rows.len());
        let zero = T::default();
        let state = State {
            q: vec![zero; n],
            v: vec![zero; n],
        };
        let mode = Mode::open(d);
        let tolerance = Tolerance::both(settings.tolerance);
        let mut run = Run {
            settings: settings.clone(),
            dynamics: Dynamics::of(system.clone(), &settings.effects),
            stepper: Stepper::new(settings.method, n),
            stiffness: Stiffness::new(settings.method),
            tolerance,
            order: crate::integrate::taylor::order(tolerance),
            t: zero,
            end: 0.0,
            scratch: state.clone(),
            slopes: vec![0.0; n],
            before: Before {
                mode: mode.clone(),
                state: state.clone(),
                forces: vec![zero; rows],
                undetermined: Vec::with_capacity(rows),
            },
            forces_after: vec![zero; rows],
            undetermined_after: Vec::with_capacity(rows),
            table: Table::default(),
            drifts: true,
            below: vec![false; d.contacts.len()],
            zeros: Vec::new(),
            at_limit: Vec::new(),
            series: Progress::None,
            valued: false,
            falls: Vec::new(),
            fallen: Vec::new(),
            rests: Vec::new(),
            resting: mode.clone(),
            earlier: vec![zero; n],
            stop_below: d.stops.iter().map(|w| vec![false; w.terms.len()]).collect(),
            mark_below: d.marks.iter().map(|w| vec![false; w.terms.len()]).collect(),
            marks: Vec::new(),
            step: StepPolynomial::new(n, 1),
            powers: Vec::new(),
            curves: Curves::new(d, &settings.effects),
            survey: Survey::new(d),
            decider: Decider::new(d),
            collider: Collider::default(),
            near: Vec::with_capacity(d.contacts.len()),
            sharing: Sharing::default(),
            impacts: vec![Impacts::default(); d.contacts.len()],
            train: Train::default(),
            scratch_mode: mode.clone(),
            rank: Rank::new(d, &settings.effects),
            distance: 1.0,
            stuck: Pool::default(),
            finished: false,
            awaited: Vec::new(),
            events_before: 0,
            work_before: crate::dynamics::Work::default(),
            trajectory: Record {
                monitor: settings.monitor.clone(),
                ..Record::new(
                    &system,
                    &settings.effects,
                    settings.record,
                    Asked {
                        tolerance: settings.tolerance,
                        method: settings.method,
                        impacts: settings.impacts.unwrap_or(d.impacts),
                    },
                )
            },
            state,
            mode,
        };
        run.dynamics.set_equations(settings.equations);
        run.trajectory.begin(zero, &run.state, &run.mode);
        run.watch();
        run
    }

    /// The table of names and places of the system.
    pub(crate) fn description(&self) -> &'static Description {
        self.dynamics.description()
    }

    /// Takes another system of the same kind.
    pub(crate) fn set_system(&mut self, system: Erased<T>) {
        self.dynamics.set_system(system);
    }

    /// See [`crate::Simulation::consistent`].
    pub(crate) fn consistent(
        &mut self,
        time: f64,
        reference: &State<T>,
        wanted: &State<T>,
        held: &Held,
    ) -> Result<State<T>, Error> {
        let tolerance = self.settings.tolerance;
        self.dynamics.restart();
        start::consistent(&mut self.dynamics, time, tolerance, reference, wanted, held)
    }

    /// An empty trajectory.
    pub(crate) fn record(&self) -> &Record<T> {
        &self.trajectory
    }

    /// Runs from `start` over `span`; the trajectory is written `into` a record. Once that has more than so many `bytes` it is given to
    /// `take`, and goes on with the motion from there; the last piece stays.
    pub(crate) fn execute(
        &mut self,
        start: &State<T>,
        span: Range<f64>,
        into: &mut Record<T>,
        bytes: usize,
        take: &mut dyn FnMut(&Record<T>),
    ) -> Result<(), Error> {
        let mut outcome = self.launch(start, span, into);
        while outcome.is_ok() && self.goes_on() {
            outcome = self.advance();
            if outcome.is_ok() && self.trajectory.bytes() > bytes && self.may_cut() {
                self.close();
                take(&self.trajectory);
                self.begin_piece();
            }
        }
        self.land(into);
        outcome
    }

    /// Whether the motion can be told from here on by itself: nothing has happened at this instant, and nothing that began earlier is
    /// under way but the mode.
    fn may_cut(&self) -> bool {
        self.goes_on() && self.stuck.is_empty() && !self.below.contains(&true)
    }

    /// Goes on with an empty record.
    fn begin_piece(&mut self) {
        let events = &self.trajectory.events;
        self.awaited
            .retain(|awaited| !events.iter().any(|e| awaited.is(e)));
        self.events_before += events.len();
        let work = self.trajectory.work;
        self.trajectory.begin(self.t, &self.state, &self.mode);
        self.trajectory.work = work;
        self.stiffness.since = self.stiffness.since.map(|_| self.t.value());
    }

    /// Begins a run whose trajectory is written `into` a record; [`Self::land`] gives it back.
    pub(crate) fn launch(
        &mut self,
        start: &State<T>,
        span: Range<f64>,
        into: &mut Record<T>,
    ) -> Result<(), Error> {
        core::mem::swap(&mut self.trajectory, into);
        let t = T::from_f64(span.start);
        self.mode.clear();
        self.trajectory.begin(t, start, &self.mode);
        (self.t, self.end) = (t, span.end);
        self.state.clone_from(start);
        self.dynamics.restart();
        self.work_before = self.dynamics.work();
        self.settings
            .check(&**self.dynamics.system(), start, &span)?;
        self.stepper.restart();
        self.stiffness.restart(&mut self.stepper);
        self.stop_below
            .iter_mut()
            .for_each(|terms| terms.fill(false));
        self.mark_below
            .iter_mut()
            .for_each(|terms| terms.fill(false));
        self.impacts.iter_mut().for_each(Impacts::restart);
        self.train.restart();
        self.rank.restart();
        self.distance = 1.0;
        self.stuck.clear();
        self.curves.joints.clear();
        self.sharing.clear();
        self.finished = false;
        self.awaited.clone_from(&self.settings.last_events);
        self.events_before = 0;
        self.settle_start()
    }

    /// The mode in which the motion begins.
    fn settle_start(&mut self) -> Result<(), Error> {
        start::begin(
            &mut self.dynamics,
            self.t,
            &mut self.state,
            self.settings.tolerance,
            self.settings.project_start,
            &mut self.survey,
        )?;
        self.trajectory.start.clone_from(&self.state);
        (self.series, self.valued) = (Progress::None, false);
        self.mode.clone_from(&self.survey.mode);
        self.trajectory.modes.clear();
        self.trajectory.modes.push(&self.mode);
        self.hold_guards();
        self.below.fill(false);
        for &c in &self.survey.below {
            self.below[c] = true;
        }
        self.settle()?;
        self.begin_sides();
        self.finished |= self.has_seen_all();
        Ok(())
    }

    /// A mark that begins below zero has not passed it: remembers on which side the marks begin.
    fn begin_sides(&mut self) {
        let reading = Reading::Series(&self.dynamics);
        for (i, below) in self.mark_below.iter_mut().enumerate() {
            for (k, below) in below.iter_mut().enumerate() {
                *below = guard::value(Guard::Mark(i, k), &self.mode, &reading) < 0.0;
            }
        }
    }

    /// Ends a run, whatever came of it.
    pub(crate) fn land(&mut self, into: &mut Record<T>) {
        self.close();
        core::mem::swap(&mut self.trajectory, into);
    }

    /// Whether there is more to do.
    pub(crate) fn goes_on(&self) -> bool {
        !self.finished && self.t.value() < self.end
    }

    /// One step, cut short by the first thing that happens in it.
    pub(crate) fn advance(&mut self) -> Result<(), Error> {
        self.make_step().map_err(|error| self.cause(error))
    }

    fn make_step(&mut self) -> Result<(), Error> {
        if self.trajectory.work.steps >= self.settings.max_steps {
            return Err(self.limit("steps", self.settings.max_steps));
        }
        if let Some(monitor) = &self.settings.monitor {
            let time = self.t.value();
            monitor.tell(time);
            if monitor.is_stopped() {
                return Err(Error::Interrupted { time });
            }
        }
        self.watch_stiffness();
        let hit = self.accepted_step()?;
        let end = hit.end();
        let exact = self.exact_end(&hit);
        if end > 0.0 {
            // The step left there the state at its end, evaluated.
            core::mem::swap(&mut self.state, &mut self.scratch);
            (self.valued, self.series) = (self.rests.is_empty(), Progress::None);
        }
        self.log_marks(end);
        self.remember_sides(end);
        self.remember_regions(end);
        self.trajectory.push(&self.step, exact);
        self.trajectory.work.steps += 1;
        if end > 0.0 {
            let whole = end == 1.0;
            self.t = self.step.t + self.step.h * exact;
            if whole
                && (self.end - self.t.value()).abs()
                    <= 1e-15 * self.end.abs().max(self.step.h.value())
            {
                self.t = T::from_f64(self.end);
            }
            self.stuck.clear();
            self.forget_zeros();
            let steps = self.trajectory.work.steps;
            let stays = self.stepper.is_taylor() && !self.drifts;
            // What is left of a residual makes rows seem independent that are not.
            let near = self.distance < NEAR || self.dynamics.has_rows_aside();
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
                if !self.valued {
                    self.evaluate()?;
                }
                self.finish(stop);
            }
            Hit::Guards(_) => {
                self.count_switch()?;
                self.leave_stiffness();
                self.switch()?;
            }
        }
        self.finished |= self.has_seen_all();
        Ok(())
    }

    /// What began at zero with the last step is an ordinary guard in the next, but for a force that is still at its limit to
    /// rounding: a block that is just held.
    fn forget_zeros(&mut self) {
        let is_single = |guard: &Guard| guard.is_force() && !matches!(guard, Guard::Joint(_));
        let zeros = self.zeros.drain(..);
        let stay = zeros.filter(|(guard, order)| *order >= guard::LENGTH && is_single(guard));
        let mut held = core::mem::take(&mut self.at_limit);
        held.extend(stay.map(|(guard, _)| (guard, 0.0)));
        held.retain_mut(|(guard, size)| {
            let value;
            (value, *size) = self.decider.force(&mut self.dynamics, &self.mode, *guard);
            self.valued && value.abs() <= AT_LIMIT * *size
        });
        self.at_limit = held;
    }

    /// Whether everything has happened that the run is to end after.
    fn has_seen_all(&self) -> bool {
        let happened = |awaited: &Awaited| self.trajectory.events.iter().any(|e| awaited.is(e));
        !self.settings.last_events.is_empty() && self.awaited.iter().all(happened)
    }

    /// Counts a switch; too many at one time, or in all, end the run.
    fn count_switch(&mut self) -> Result<(), Error> {
        let events = self.events_before + self.trajectory.events.len();
        if events >= self.settings.max_events {
            return Err(self.limit("events", self.settings.max_events));
        }
        self.stuck.push(&self.mode);
        if self.stuck.len() < MOST_EVENTS_AT_ONCE {
            return Ok(());
        }
        let d = self.description();
        let last = self.stuck.iter().rev().take(4).rev();
        Err(Error::NoProgress {
            time: self.t.value(),
            modes: last.map(|m| m.display(d).to_string()).collect(),
            item: self
                .trajectory
                .events
                .last()
                .map_or(d.name, |e| e.subject.name(d)),
        })
    }

    /// Ends the run at a stop.
    fn finish(&mut self, stop: usize) {
        let state = core::mem::take(&mut self.state);
        self.log_watch(Subject::Stop(stop), EventKind::Stop, self.t, &state);
        self.state = state;
        self.finished = true;
    }

    fn log_marks(&mut self, end: f64) {
        if self.curves.marks.is_empty() {
            return;
        }
        let mut marks = core::mem::take(&mut self.marks);
        self.marks_until(end, &mut marks);
        for &(mark, s) in &marks {
            let s = self.exact_mark(mark, s);
            let mut state = core::mem::take(&mut self.scratch);
            self.step.state_into(s, &mut state.q, &mut state.v);
            let time = self.step.time(s);
            self.valued = false;
            if self.dynamics.value_along(time, &state.q, &state.v).is_ok() {
                self.log_watch(Subject::Mark(mark), EventKind::Mark, time, &state);
            }
            self.scratch = state;
        }
        self.marks = marks;
    }

    /// Stops whose conditions the switch has just made true.
    fn stops_of_the_mode(&mut self) -> Result<(), Error> {
        let d = self.description();
        for at in 0..self.curves.stops.len() {
            let i = self.curves.stops[at];
            if self.has_become_true(&d.stops[i], |k| Guard::Stop(i, k)) {
                self.evaluate()?;
                self.finish(i);
                return Ok(());
            }
        }
        for at in 0..self.curves.marks.len() {
            let i = self.curves.marks[at];
            if self.has_become_true(&d.marks[i], |k| Guard::Mark(i, k)) {
                self.evaluate()?;
                let state = core::mem::take(&mut self.state);
                self.log_watch(Subject::Mark(i), EventKind::Mark, self.t, &state);
                self.state = state;
            }
        }
        Ok(())
    }

    /// Whether the switch has made the conditions of a watch hold while its terms do.
    fn has_become_true(&self, watch: &Watch, term: impl Fn(usize) -> Guard) -> bool {
        let reading = Reading::Series(&self.dynamics);
        let value = |k| guard::value(term(k), &self.mode, &reading);
        !watch.conditions.is_empty()
            && !hits::holds(watch, &self.before.mode)
            && hits::holds(watch, &self.mode)
            && (0..watch.terms.len()).all(|k| value(k) >= 0.0)
    }

    /// Enters the mode that the decider has found.
    fn set_mode_decided(&mut self) {
        self.at_limit.clear();
        self.mode.clone_from(&self.decider.decision.mode);
        self.trajectory.enter(&self.mode);
        self.curves.joints.clone_from(&self.decider.decision.joints);
        (self.series, self.valued) = (Progress::None, false);
        self.hold_guards();
    }

    /// Holds what the guards of the mode, which `dynamics` is in, need.
    fn hold_guards(&mut self) {
        self.ask_for_guards();
        let watched = self.table.of(&self.dynamics);
        self.drifts = watched.drifts;
        let guards = watched.guards.iter().copied();
        self.curves.arm(guards, &self.mode, &self.dynamics);
    }

    /// Asks for the numbers that the guards of the mode read.
    fn ask_for_guards(&mut self) {
        let watched = self.table.of(&self.dynamics);
        if self.rank.watches() {
            self.dynamics.set_extra_needs(&watched.needs);
        } else {
            self.dynamics.set_guard_needs(&watched.needs);
        }
    }

    /// Asks for the stops and marks that take part.
    fn watch(&mut self) {
        let d = self.description();
        let mut needs = NeedSet::new(d);
        for &i in &self.curves.stops {
            needs.insert(d.stops[i].need);
        }
        for &i in &self.curves.marks {
            needs.insert(d.marks[i].need);
        }
        self.dynamics.set_report_needs(&needs);
    }

    /// Values at the present state in the present mode, with every row's Jacobian and rate.
    fn evaluate_all_rows(&mut self) -> Result<(), Error> {
        self.dynamics.set_extra_needs(&self.survey.needs);
        self.evaluate()?;
        self.valued = false;
        Ok(())
    }

    fn evaluate(&mut self) -> Result<(), Error> {
        let outcome = self.dynamics.value(self.t, &self.state.q, &self.state.v);
        outcome.map_err(|e| self.error(e))?;
        self.valued = true;
        Ok(())
    }

    /// Taylor series at the present state, unless they are there.
    fn expand(&mut self) -> Result<(), Error> {
        self.begin_series().map_err(|e| self.error(e))?;
        if self.series == Progress::Begun {
            self.dynamics.end_series(self.order);
            self.series = Progress::Complete;
        }
        Ok(())
    }

    /// At least the leading coefficients at the present state.
    fn begin_series(&mut self) -> Result<(), EvaluationError> {
        if self.series == Progress::None {
            self.dynamics.hold_rows_aside(false);
            let State { q, v } = &self.state;
            let rest = self.dynamics.begin_series(self.t, q, v, self.order)?;
            self.dynamics.hold_rows_aside(!self.is_undecided());
            self.series = if rest {
                Progress::Begun
            } else {
                Progress::Complete
            };
        }
        Ok(())
    }

    fn limit(&self, what: &'static str, limit: usize) -> Error {
        Error::Limit {
            time: self.t.value(),
            what,
            limit,
        }
    }

    fn error(&self, error: EvaluationError) -> Error {
        Error::from_evaluation(error, self.t.value(), &self.mode, self.description())
    }

    /// Completes the trajectory.
    fn close(&mut self) {
        self.note_stiffness();
        self.trajectory.last_time = self.t;
        self.trajectory.last.clone_from(&self.state);
        let work = self.dynamics.work();
        self.trajectory.work = Work {
            evaluations: work.values - self.work_before.values,
            series: work.series - self.work_before.series,
            factorizations: work.factorizations - self.work_before.factorizations,
            ..self.trajectory.work
        };
    }
}
