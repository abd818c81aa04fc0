//! What the dynamics hold of the present state and mode: values, series, and the numbers that guards read.

use super::{Progress, Run};
use crate::arithmetic::Scalar;
use crate::dynamics::EvaluationError;
use crate::error::Error;
use crate::mode::Mode;
use crate::trajectory::State;

impl<T: Scalar> Run<T> {
    pub(super) fn evaluate(&mut self) -> Result<(), Error> {
        let outcome = self
            .dynamics
            .value(self.now.t, &self.now.state.q, &self.now.state.v);
        outcome.map_err(|e| self.error(e))?;
        self.now.valued = true;
        Ok(())
    }

    /// Values at the present state in the present mode, with every row's Jacobian and rate.
    pub(super) fn evaluate_all_rows(&mut self) -> Result<(), Error> {
        self.ask_for_all_rows();
        self.evaluate()?;
        self.now.valued = false;
        Ok(())
    }

    /// The numbers of all rows at the present state; the mode is the one that `dynamics` is in.
    pub(super) fn tape_of_all_rows(&mut self) {
        self.ask_for_all_rows();
        let State { q, v, .. } = &self.now.state;
        self.dynamics.tape(self.now.t, q, v);
    }

    /// What the numbers of all rows say beside the present state, or that at a part of the step at hand: `later` by so much, with each coordinate changed
    /// by a function of its index and velocity. The dynamics are left with the numbers of the present state.
    pub(super) fn beside<R>(
        &mut self,
        part: Option<f64>,
        later: T,
        change: impl Fn(usize, T) -> T,
        read: impl FnOnce(&Self) -> R,
    ) -> R {
        self.ask_for_all_rows();
        let (step, beside) = (&self.stepper.step, &mut self.stepper.scratch);
        let time = match part.map(T::from_f64) {
            None => {
                beside.clone_from(&self.now.state);
                self.now.t
            }
            Some(s) => {
                step.state_into(s, &mut beside.q, &mut beside.v);
                step.time(s)
            }
        };
        for (j, (q, &v)) in beside.q.iter_mut().zip(&beside.v).enumerate() {
            *q += change(j, v);
        }
        self.dynamics.tape(time + later, &beside.q, &beside.v);
        let numbers = read(self);
        self.tape_of_all_rows();
        self.now.valued = false;
        numbers
    }

    /// What the numbers of all rows at the present state say in the mode before a change and in that after it, which `dynamics` is left in.
    pub(super) fn on_both_sides<R>(
        &mut self,
        modes: [&Mode; 2],
        read: impl Fn(&Self) -> R,
    ) -> [R; 2] {
        modes.map(|mode| {
            self.dynamics.set_mode(mode);
            self.tape_of_all_rows();
            read(self)
        })
    }

    /// At least the leading coefficients at the present state.
    pub(super) fn begin_series(&mut self) -> Result<(), EvaluationError> {
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

    /// Taylor series at the present state, unless they are there.
    pub(super) fn expand(&mut self) -> Result<(), Error> {
        self.begin_series().map_err(|e| self.error(e))?;
        if self.now.series == Progress::Begun {
            self.dynamics.end_series(self.stepper.order);
            self.now.series = Progress::Complete;
        }
        Ok(())
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

    /// Enters the mode that the decider has found.
    pub(super) fn set_mode_decided(&mut self) {
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
        self.locator.polynomials.forces = self.switcher.decider.size_of_forces();
        let redundant = &mut self.switcher.redundant;
        let composites = &self.switcher.decider.decision.composites;
        redundant.take_signs_of(composites, self.dynamics.description());
        self.now.outdate();
        self.hold_guards();
        if self.locator.polynomials.watch_signs_of_normal_forces() {
            let speeds = self.now.state.v.iter().enumerate();
            let speeds = speeds.map(|(j, v)| v.value().abs() + self.dynamics.at_rest(j));
            self.locator.polynomials.momentum = self.switcher.decider.momentum(speeds);
        }
    }

    /// Holds what the guards of the mode, which `dynamics` is in, need.
    pub(super) fn hold_guards(&mut self) {
        self.ask_for_guards();
        let watched = self.switcher.table.of(&self.dynamics);
        self.now.drifts = watched.drifts;
        let guards = watched.guards.iter().copied();
        self.locator
            .polynomials
            .arm(guards, &self.now.mode, &self.dynamics);
    }
}
