//! All modes in which a state can go on, with their forces.

use super::switch::Switcher;
use super::{Progress, Run};
use crate::arithmetic::Scalar;
use crate::error::Error;
use crate::state::State;
use crate::trajectory::{Instant, instant, report_everything};

impl<T: Scalar> Run<T> {
    /// See [`crate::Simulation::feasible_modes`].
    pub(crate) fn feasible_modes(
        &mut self,
        time: f64,
        state: &State<T>,
    ) -> Result<Vec<Instant<T>>, Error> {
        let listed = self.list_feasible(time, state);
        listed.map_err(|error| self.overflow(error))
    }

    fn list_feasible(&mut self, time: f64, state: &State<T>) -> Result<Vec<Instant<T>>, Error> {
        let system = self.dynamics.system();
        self.settings.check(&**system, state, &(time..time))?;
        self.now.t = T::from_f64(time);
        self.now.state.clone_from(state);
        self.recorder.trajectory.start.clone_from(state);
        self.dynamics.restart();
        self.enter_start()?;
        let modes = self.knowing(|run, facts| {
            run.meet(facts)?;
            let here = run
                .now
                .context(run.stepper.order, run.settings.tolerance, facts);
            let Switcher { decider, table, .. } = &mut run.switcher;
            decider.feasible(&mut run.dynamics, table, here)
        })?;
        self.now.series = Progress::None;
        report_everything(&mut self.dynamics);
        let instants = modes.iter().map(|mode| {
            self.dynamics.set_mode(mode);
            self.dynamics.set_extra_needs(&self.switcher.status.needs);
            let State { q, v, .. } = &self.now.state;
            let outcome = self.dynamics.value(self.now.t, q, v);
            let (dynamics, redundant) = (&mut self.dynamics, &mut self.switcher.redundant);
            let outcome =
                outcome.and_then(|()| instant(dynamics, redundant, self.now.t, &self.now.state));
            outcome.map_err(|e| self.error(e))
        });
        let instants = instants.collect();
        self.watch();
        instants
    }
}
