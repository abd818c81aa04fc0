//! Many runs of one system in the same memory.

use crate::arithmetic::Scalar;
use crate::error::Error;
use crate::precompiled::Runnable;
use crate::run::Run;
use crate::run::lockstep::Member;
use crate::settings::{Goal, Settings};
use crate::state::FixedComponents;
use crate::system::{Erased, System};
use crate::trajectory::{Instant, State, Trajectory};
use core::borrow::Borrow;
use core::ops::Range;

/// Runs one system again and again: what a run works with is made once, and the trajectory is written into the same memory.
/// From the second run on nothing is allocated, unless a run meets a mode or needs an amount of recording that none before
/// did, or has forces that the motion leaves open. Where an error or an estimate is asked for, further runs have memory of their
/// own.
///
/// Made by [`Simulation::runner`](crate::Simulation::runner).
#[derive(Debug)]
pub struct Runner<S: System> {
    scene: S,
    work: Work<S::Scalar>,
}

impl<S: System<Scalar: Runnable>> Runner<S> {
    pub(crate) fn new(scene: &S, settings: &Settings) -> Self {
        Self {
            scene: scene.copy(),
            work: Work::new(scene.erased().system, settings),
        }
    }

    /// Integrates from `start` over `span` (s), or until a stop. The trajectory is that of this run until the next one
    /// begins.
    ///
    /// # Errors
    /// Why the run ended early; [`Self::trajectory`] has the motion until then.
    pub fn run(
        &mut self,
        start: impl Borrow<State<S::Scalar>>,
        span: Range<f64>,
    ) -> Result<&Trajectory<S::Scalar>, Error> {
        self.work.run(start.borrow(), span)?;
        Ok(self.trajectory())
    }

    /// The same, with a memory of the motion that does not grow with its length: about every so many `bytes` what there is of it is
    /// given to `take`, as the trajectory of a run of its own (but its work counts from the beginning), and forgotten. It is cut between two
    /// steps at a time when nothing happens; where there is none before twice as many bytes, just after what has happened. The trajectory that
    /// stays is the last piece, which has the estimate if one was asked for. A run whose error is asked for is one piece.
    ///
    /// # Errors
    /// As of [`Self::run`].
    pub fn run_in_pieces(
        &mut self,
        start: impl Borrow<State<S::Scalar>>,
        span: Range<f64>,
        bytes: usize,
        mut take: impl FnMut(&Trajectory<S::Scalar>),
    ) -> Result<(), Error> {
        self.work
            .run_in_pieces(start.borrow(), span, bytes, &mut take)
    }

    /// Begins a run without going on with it.
    pub(super) fn launch(
        &mut self,
        start: &State<S::Scalar>,
        span: Range<f64>,
    ) -> Result<(), Error> {
        let work = &mut self.work;
        (S::Scalar::functions().launch)(&mut work.run, start, span, &mut work.trajectory)
    }

    /// Whether the run that has begun has more to do.
    pub(super) fn goes_on(&self) -> bool {
        self.work.run.goes_on()
    }

    /// The run, among others.
    pub(super) fn member(&mut self) -> Member<'_, S::Scalar> {
        Member {
            run: &mut self.work.run,
            outcome: None,
        }
    }

    /// Ends the run that has begun; its trajectory.
    pub(super) fn land(&mut self) -> &Trajectory<S::Scalar> {
        let work = &mut self.work;
        (S::Scalar::functions().land)(&mut work.run, &mut work.trajectory);
        &work.trajectory
    }

    /// As [`Simulation::consistent`](crate::Simulation::consistent).
    ///
    /// # Errors
    /// [`Error::Projection`] if there is no such state.
    pub fn consistent(
        &mut self,
        time: f64,
        reference: impl Borrow<State<S::Scalar>>,
        fixed: &FixedComponents<S::Scalar>,
    ) -> Result<State<S::Scalar>, Error> {
        (S::Scalar::functions().consistent)(&mut self.work.run, time, reference.borrow(), fixed)
    }

    /// As [`Simulation::feasible_modes`](crate::Simulation::feasible_modes).
    ///
    /// # Errors
    /// As there.
    pub fn feasible_modes(
        &mut self,
        time: f64,
        state: impl Borrow<State<S::Scalar>>,
    ) -> Result<Vec<Instant<S::Scalar>>, Error> {
        (S::Scalar::functions().feasible_modes)(&mut self.work.run, time, state.borrow())
    }

    /// The trajectory of the last run.
    pub fn trajectory(&self) -> &Trajectory<S::Scalar> {
        &self.work.trajectory
    }

    /// The trajectory of the last run, to keep.
    pub fn into_trajectory(self) -> Trajectory<S::Scalar> {
        self.work.trajectory
    }

    /// The system.
    pub fn scene(&self) -> &S {
        &self.scene
    }

    /// Takes another system of the same kind, as a sweep over parameters does.
    pub fn set_scene(&mut self, scene: &S) {
        let system = scene.erased().system;
        self.scene = scene.copy();
        self.work.trajectory.system = system.clone();
        (S::Scalar::functions().set_system)(&mut self.work.run, system);
    }
}

/// What runs of a system are made with. The type of the system is forgotten here, so that this is compiled once for all.
#[derive(Debug)]
pub(super) struct Work<T: Scalar> {
    run: Run<T>,
    pub(super) trajectory: Trajectory<T>,
    pub(super) settings: Settings,
}

impl<T: Runnable> Work<T> {
    pub(super) fn new(system: Erased<T>, settings: &Settings) -> Self {
        let run = (T::functions().run)(system, settings);
        Self {
            trajectory: run.record().clone(),
            settings: settings.clone(),
            run,
        }
    }

    /// See [`Runner::run`].
    pub(super) fn run(&mut self, start: &State<T>, span: Range<f64>) -> Result<(), Error> {
        self.run_in_pieces(start, span, usize::MAX, &mut |_| ())
    }

    /// See [`Runner::run_in_pieces`].
    fn run_in_pieces(
        &mut self,
        start: &State<T>,
        span: Range<f64>,
        bytes: usize,
        take: &mut dyn FnMut(&Trajectory<T>),
    ) -> Result<(), Error> {
        match self.settings.goal {
            Goal::Tolerance => self.execute(start, span, bytes, take),
            Goal::Estimate => self.run_twice(start, span, bytes, take),
            Goal::Error(error) => self.run_within(error, start, span),
        }
    }

    /// One run as the tolerance has it.
    pub(super) fn run_once(&mut self, start: &State<T>, span: Range<f64>) -> Result<(), Error> {
        self.execute(start, span, usize::MAX, &mut |_| ())
    }

    /// One run, given away piece by piece.
    pub(super) fn execute(
        &mut self,
        start: &State<T>,
        span: Range<f64>,
        bytes: usize,
        take: &mut dyn FnMut(&Trajectory<T>),
    ) -> Result<(), Error> {
        (T::functions().execute)(
            &mut self.run,
            start,
            span,
            &mut self.trajectory,
            bytes,
            take,
        )
    }
}
