//! The loop of a run: step, look for the first thing that happens, switch, go on.

mod accumulation;
mod curves;
mod hits;
mod singular;
mod stepping;
mod switch;
#[cfg(test)]
mod tests;

use crate::arithmetic::Scalar;
use crate::dynamics::{Dynamics, EvaluationError, NeedSet, add_guards};
use crate::error::Error;
use crate::integrate::{StepPolynomial, Tolerance};
use crate::mode::Mode;
use crate::modes::guard::{self, Guard};
use crate::modes::start;
use crate::simulation::{Failure, Simulation};
use crate::system::System;
use crate::trajectory::{EventKind, State, Subject, Trajectory, Work};
use accumulation::Impacts;
use core::ops::Range;
use curves::Curves;
use hits::Hit;
use singular::Rank;
use stepping::Stepper;

/// This many events without any progress in time are a livelock.
const MOST_EVENTS_AT_ONCE: usize = 40;

/// Nearer than this to a loss of rank what is left of a residual is amplified: it is taken away to the last bit.
const NEAR: f64 = 0.7;

/// The state of a run.
pub(crate) struct Run<'a, S: System> {
    simulation: &'a Simulation<'a, S>,
    dynamics: Dynamics<S>,
    stepper: Stepper<S::Scalar>,
    tolerance: Tolerance,
    /// Order of Taylor series.
    order: usize,
    t: S::Scalar,
    end: f64,
    state: State<S::Scalar>,
    mode: Mode,
    /// Guards of the mode.
    guards: Vec<Guard>,
    /// Guards whose leading coefficients vanish at the start of the coming step.
    zeros: Vec<(Guard, usize)>,
    /// Needs of the guards, stops and marks.
    needs: NeedSet,
    /// Whether `dynamics` holds the Taylor series at the present state.
    expanded: bool,
    /// Falling guards found in the present step: (guard, part of the step, half width).
    falls: Vec<(Guard, f64, f64)>,
    fallen: Vec<Guard>,
    stop_below: Vec<Vec<bool>>,
    mark_below: Vec<Vec<bool>>,
    step: StepPolynomial<S::Scalar>,
    curves: Curves,
    scratch: State<S::Scalar>,
    /// Per contact: its impacts so far.
    impacts: Vec<Impacts>,
    /// Watches for positions where constraints lose rank.
    rank: Rank,
    /// Distance from such a position at the start of the coming step.
    distance: f64,
    /// Modes of the switches since time last advanced.
    stuck: Vec<Mode>,
    finished: bool,
    trajectory: Trajectory<S>,
}

impl<'a, S: System> Run<'a, S> {
    /// Runs a simulation.
    pub(crate) fn execute(
        simulation: &'a Simulation<'a, S>,
        start: State<S::Scalar>,
        span: Range<f64>,
    ) -> Result<Trajectory<S>, Failure<S>> {
        let d = S::DESCRIPTION;
        let t = S::Scalar::from_f64(span.start);
        let mode = Mode::open(d);
        let trajectory = Trajectory::new(
            simulation.scene,
            &simulation.effects,
            t,
            start.clone(),
            mode.clone(),
        );
        if let Err(error) = simulation.check(&start, &span) {
            return Err(Failure {
                error,
                trajectory: Box::new(trajectory),
            });
        }
        let tolerance = Tolerance::both(simulation.tolerance);
        let mut run = Run {
            simulation,
            dynamics: Dynamics::new(simulation.scene, &simulation.effects),
            stepper: Stepper::new(simulation.method, d.coordinates.len()),
            tolerance,
            order: crate::integrate::taylor::order(tolerance),
            t,
            end: span.end,
            scratch: start.clone(),
            state: start,
            mode,
            guards: Vec::new(),
            zeros: Vec::new(),
            needs: NeedSet::new(d),
            expanded: false,
            falls: Vec::new(),
            fallen: Vec::new(),
            stop_below: d.stops.iter().map(|w| vec![false; w.terms.len()]).collect(),
            mark_below: d.marks.iter().map(|w| vec![false; w.terms.len()]).collect(),
            step: StepPolynomial::new(d.coordinates.len(), 1),
            curves: Curves::new::<S>(),
            impacts: vec![Impacts::default(); d.contacts.len()],
            rank: Rank::new::<S>(),
            distance: 1.0,
            stuck: Vec::new(),
            finished: false,
            trajectory,
        };
        let outcome = run.go();
        run.close();
        match outcome {
            Ok(()) => Ok(run.trajectory),
            Err(error) => Err(Failure {
                error,
                trajectory: Box::new(run.trajectory),
            }),
        }
    }

    fn go(&mut self) -> Result<(), Error> {
        self.watch();
        let known = start::begin(
            &mut self.dynamics,
            self.t,
            &mut self.state,
            self.simulation.tolerance,
            self.simulation.project_start,
        )?;
        self.trajectory.start.clone_from(&self.state);
        let mode = self.dynamics.mode().clone();
        self.trajectory.modes[0].clone_from(&mode);
        self.set_mode(mode);
        self.settle(known)?;
        while !self.finished && self.t.value() < self.end {
            if self.trajectory.work.steps >= self.simulation.max_steps {
                return Err(self.limit("steps", self.simulation.max_steps));
            }
            self.advance()?;
        }
        Ok(())
    }

    /// One step, cut short by the first thing that happens in it.
    fn advance(&mut self) -> Result<(), Error> {
        let hit = self.accepted_step()?;
        let end = hit.end();
        self.log_marks(end);
        self.remember_sides_at(end);
        self.trajectory.push(&self.step, S::Scalar::from_f64(end));
        self.trajectory.work.steps += 1;
        if end > 0.0 {
            let whole = end == 1.0;
            self.t = self.step.t + self.step.h * S::Scalar::from_f64(end);
            if whole
                && (self.end - self.t.value()).abs()
                    <= 1e-15 * self.end.abs().max(self.step.h.value())
            {
                self.t = S::Scalar::from_f64(self.end);
            }
            self.step.state_into(
                S::Scalar::from_f64(end),
                &mut self.state.q,
                &mut self.state.v,
            );
            self.stuck.clear();
            self.zeros.clear();
            self.expanded = false;
            self.project(self.distance < NEAR)?;
        }
        match hit {
            Hit::Nothing => Ok(()),
            Hit::Stop(stop, _) => {
                self.evaluate()?;
                self.finish(stop)
            }
            Hit::Guards(_) => {
                self.count_switch()?;
                self.stepper.restart();
                self.switch()
            }
        }
    }

    /// Counts a switch; too many at one time, or in all, end the run.
    fn count_switch(&mut self) -> Result<(), Error> {
        if self.trajectory.events.len() >= self.simulation.max_events {
            return Err(self.limit("events", self.simulation.max_events));
        }
        self.stuck.push(self.mode.clone());
        if self.stuck.len() < MOST_EVENTS_AT_ONCE {
            return Ok(());
        }
        let d = S::DESCRIPTION;
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
    fn finish(&mut self, stop: usize) -> Result<(), Error> {
        let state = self.state.clone();
        self.log_watch(Subject::Stop(stop), EventKind::Stop, self.t, state);
        self.finished = true;
        Ok(())
    }

    fn log_marks(&mut self, end: f64) {
        for (mark, s) in self.marks_until(&self.curves, end) {
            let s = S::Scalar::from_f64(s);
            let mut state = self.state.clone();
            self.step.state_into(s, &mut state.q, &mut state.v);
            let time = self.step.t + self.step.h * s;
            if self.dynamics.value(time, &state.q, &state.v).is_ok() {
                self.log_watch(Subject::Mark(mark), EventKind::Mark, time, state);
            }
        }
    }

    fn remember_sides_at(&mut self, end: f64) {
        let curves = core::mem::take(&mut self.curves);
        self.remember_sides(&curves, end);
        self.curves = curves;
    }

    /// Stops whose conditions the switch has just made true.
    fn stops_of_the_mode(&mut self, before: &Mode) -> Result<(), Error> {
        let d = S::DESCRIPTION;
        for (i, watch) in d.stops.iter().enumerate() {
            if watch.conditions.is_empty()
                || hits::holds(watch, before)
                || !hits::holds(watch, &self.mode)
            {
                continue;
            }
            let reading = guard::first_values(
                &self.dynamics,
                &self.mode,
                (0..watch.terms.len()).map(|k| Guard::Stop(i, k)),
            );
            if reading.iter().all(|x| *x >= 0.0) {
                return self.finish(i);
            }
        }
        for (i, watch) in d.marks.iter().enumerate() {
            if watch.conditions.is_empty()
                || hits::holds(watch, before)
                || !hits::holds(watch, &self.mode)
            {
                continue;
            }
            let reading = guard::first_values(
                &self.dynamics,
                &self.mode,
                (0..watch.terms.len()).map(|k| Guard::Mark(i, k)),
            );
            if reading.iter().all(|x| *x >= 0.0) {
                let state = self.state.clone();
                self.log_watch(Subject::Mark(i), EventKind::Mark, self.t, state);
            }
        }
        Ok(())
    }

    /// Enters a mode: its guards, its needs.
    fn set_mode(&mut self, mode: Mode) {
        self.dynamics.set_mode(&mode);
        self.mode = mode;
        self.trajectory.enter(&self.mode);
        self.expanded = false;
        self.hold_guards();
    }

    /// Holds what the guards of the mode need.
    fn hold_guards(&mut self) {
        let d = S::DESCRIPTION;
        self.needs.clone_from(self.dynamics.motion_needs());
        self.needs.extend(self.dynamics.report_needs());
        add_guards(d, self.dynamics.effects(), &self.mode, &mut self.needs);
        guard::guards_of_mode(&self.mode, &self.dynamics, &self.needs, &mut self.guards);
        self.dynamics.set_extra_needs(&self.needs);
    }

    /// Asks for the stops and marks that take part.
    fn watch(&mut self) {
        use crate::effects::Item;
        let d = S::DESCRIPTION;
        let mut needs = NeedSet::new(d);
        for (i, stop) in d.stops.iter().enumerate() {
            if self.simulation.effects.includes(d, Item::Stop(i)) {
                needs.insert(stop.need);
            }
        }
        for (i, mark) in d.marks.iter().enumerate() {
            if self.simulation.effects.includes(d, Item::Mark(i)) {
                needs.insert(mark.need);
            }
        }
        self.dynamics.set_report_needs(&needs);
    }

    /// Values at the present state in the present mode, with every row's Jacobian and rate.
    fn evaluate_all_rows(&mut self) -> Result<(), Error> {
        self.dynamics
            .set_extra_needs(&guard::all_row_needs(S::DESCRIPTION, &self.needs));
        self.evaluate()?;
        Ok(())
    }

    fn evaluate(&mut self) -> Result<(), Error> {
        let outcome = self.dynamics.value(self.t, &self.state.q, &self.state.v);
        outcome.map_err(|e| self.error(e))
    }

    /// Taylor series at the present state.
    fn refresh(&mut self) -> Result<(), Error> {
        self.hold_guards();
        let outcome = self
            .dynamics
            .series(self.t, &self.state.q, &self.state.v, self.order);
        outcome.map_err(|e| self.error(e))?;
        self.expanded = true;
        Ok(())
    }

    /// λ of every row at the last value.
    fn forces(&self) -> Vec<S::Scalar> {
        (0..S::DESCRIPTION.rows.len())
            .map(|row| self.dynamics.force(row))
            .collect()
    }

    /// λ of every row at the start of the series.
    fn forces_from_series(&self) -> Vec<S::Scalar> {
        let rows = 0..S::DESCRIPTION.rows.len();
        rows.map(|row| {
            self.dynamics
                .force_series(row)
                .first()
                .copied()
                .unwrap_or_default()
        })
        .collect()
    }

    fn limit(&self, what: &'static str, limit: usize) -> Error {
        Error::Limit {
            time: self.t.value(),
            what,
            limit,
        }
    }

    fn error(&self, error: EvaluationError) -> Error {
        Error::from_evaluation(error, self.t.value(), &self.mode, S::DESCRIPTION)
    }

    /// Completes the trajectory.
    fn close(&mut self) {
        self.trajectory.last_time = self.t;
        self.trajectory.last.clone_from(&self.state);
        let work = self.dynamics.work();
        self.trajectory.work = Work {
            evaluations: work.values,
            series: work.series,
            factorizations: work.factorizations,
            ..self.trajectory.work
        };
    }
}
