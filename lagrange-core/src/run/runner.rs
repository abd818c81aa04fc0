//! Many runs of one system in the same memory.

use super::Run;
use crate::error::Error;
use crate::simulation::{Held, Settings};
use crate::system::System;
use crate::trajectory::{State, Trajectory};
use core::ops::Range;

/// Runs one system again and again: what a run works with is made once, and the trajectory is written into the same memory.
/// From the second run on nothing is allocated, unless a run meets a mode or needs an amount of recording that none before
/// did, has impacts, or forces that the motion leaves open.
///
/// Made by [`Simulation::runner`](crate::Simulation::runner).
#[derive(Debug)]
pub struct Runner<S: System> {
    run: Run<S>,
}

impl<S: System> Runner<S> {
    pub(crate) fn new(scene: &S, settings: &Settings) -> Self {
        Self {
            run: Run::new(scene, settings),
        }
    }

    /// Integrates from `start` over `span` (s), or until a stop. The trajectory is that of this run until the next one
    /// begins.
    ///
    /// # Errors
    /// Why the run ended early; [`Self::trajectory`] has the motion until then.
    pub fn run(
        &mut self,
        start: &State<S::Scalar>,
        span: Range<f64>,
    ) -> Result<&Trajectory<S>, Error> {
        self.run.execute(start, span)?;
        Ok(&self.run.trajectory)
    }

    /// As [`Simulation::consistent`](crate::Simulation::consistent).
    ///
    /// # Errors
    /// [`Error::Projection`] if there is no such state.
    pub fn consistent(
        &mut self,
        time: f64,
        reference: &State<S::Scalar>,
        wanted: &State<S::Scalar>,
        held: &Held,
    ) -> Result<State<S::Scalar>, Error> {
        self.run.consistent(time, reference, wanted, held)
    }

    /// The trajectory of the last run.
    pub fn trajectory(&self) -> &Trajectory<S> {
        &self.run.trajectory
    }

    /// The trajectory of the last run, to keep.
    pub fn into_trajectory(self) -> Trajectory<S> {
        self.run.trajectory
    }

    /// The system.
    pub fn scene(&self) -> &S {
        self.run.dynamics.scene()
    }

    /// Takes another system of the same kind, as a sweep over parameters does.
    pub fn set_scene(&mut self, scene: &S) {
        self.run.set_scene(scene);
    }
}
