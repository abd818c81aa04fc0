//! One run, again and again with other methods; and what is read from a run.

use super::Setting;
use crate::film::drift;
use core::hint::black_box;
use lagrange_core::error::Shortest;
use lagrange_core::prelude::*;
use lagrange_core::system::AnySystem;
use std::time::Instant;

/// Most events of a run: what has more goes in circles.
const MAX_EVENTS: usize = 10_000;

/// A system, and the run of it that a study is about.
pub(crate) struct Motion<'a> {
    /// The system.
    pub system: &'a AnySystem<f64>,
    /// State at time 0.
    pub start: State<f64>,
    /// How it is run, but for the setting.
    pub simulation: Simulation<'a, AnySystem<f64>>,
    /// Last time, s.
    pub until: f64,
    /// Most steps of a run: what needs more is no choice for this scene.
    pub max_steps: usize,
}

impl Motion<'_> {
    fn simulation(&self, setting: Setting) -> Simulation<'_, AnySystem<f64>> {
        self.simulation
            .clone()
            .estimate(false)
            .method(setting.method)
            .tolerance(setting.tolerance)
            .max_steps(self.max_steps)
            .max_events(MAX_EVENTS)
    }

    /// Runs it.
    ///
    /// # Errors
    /// Why it ended early, for who can end it earlier still: no option raises the limits of a study.
    pub(super) fn run(&self, setting: Setting) -> Result<Trajectory, String> {
        self.simulation(setting)
            .run(self.start.clone(), 0.0..self.until)
            .map_err(|stopped| match stopped.error {
                Error::Limit { time, what, limit } => format!(
                    "t = {}: more than {limit} {what}; end earlier, with --until",
                    Shortest(time)
                ),
                error => error.to_string(),
            })
    }

    /// A clock for a setting: from a number of runs in a row to the seconds that one of them takes. Nothing is recorded
    /// and no memory made ready but in the first run.
    pub(super) fn clock(&self, setting: Setting) -> impl FnMut(usize) -> f64 {
        let mut runner = self.simulation(setting).record(false).runner();
        move |runs| {
            let begin = Instant::now();
            for _ in 0..runs {
                let done = runner.run(black_box(&self.start), 0.0..self.until);
                let _ = black_box(done.is_ok());
            }
            begin.elapsed().as_secs_f64() / runs as f64
        }
    }

    /// Value of every parameter.
    pub(super) fn parameters(&self) -> Vec<f64> {
        (0..self.system.description().parameters.len())
            .map(|i| self.system.parameter(i))
            .collect()
    }
}

/// What the energy book leaves unexplained, over the scale of the energies.
pub(super) fn energy_drift(trajectory: &Trajectory) -> Option<f64> {
    let ledger = trajectory.ledger().ok()?;
    Some(ledger.closure.abs() / ledger.scale.max(f64::MIN_POSITIVE))
}

/// What has to hold is off by this much just before each event and at the end; `None` if nothing ever has to.
pub(super) fn constraint_drift(trajectory: &Trajectory) -> Option<f64> {
    let events = trajectory.events().iter();
    let before = events.map(|event| (event.time, &event.before, &event.state));
    let end = (
        trajectory.last_time(),
        trajectory.final_mode(),
        trajectory.final_state(),
    );
    drift(trajectory, before.chain([end]))
}
