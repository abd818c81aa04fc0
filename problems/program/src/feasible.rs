//! All modes in which a motion can go on at an instant: where a run takes one of several.

use crate::request::{Refusal, Request};
use crate::scene::{Beginning, Scene};
use lagrange_core::prelude::*;
use lagrange_core::system::Description;

/// The feasible modes of an instant.
pub struct Feasible {
    /// Name of the scene.
    pub scene: &'static str,
    /// Its names.
    pub description: &'static Description,
    /// Time, s.
    pub time: f64,
    /// One instant for each mode, with its forces and accelerations; first the one that a run takes.
    pub modes: Vec<Instant<f64>>,
}

impl dyn Scene + '_ {
    /// All modes in which the motion can go on at the start, or at a later time of the run.
    ///
    /// # Errors
    /// The request makes no sense, the start does not exist, the run does not come so far, or there is no mode.
    pub fn modes(&self, request: &Request, at: Option<f64>) -> Result<Feasible, Refusal> {
        let Beginning { system, start, .. } = self.beginning(request)?;
        let simulation = request.simulation(&system)?;
        let (time, state) = match at.filter(|time| *time > 0.0) {
            None => (0.0, start),
            Some(time) => {
                let run = simulation.run(start, 0.0..time);
                let run = run.map_err(|failure| match failure.trajectory.work().steps {
                    0 => Refusal::Begin(failure.error),
                    _ => Refusal::Run(failure.error),
                })?;
                let (first, last) = (run.first_time(), run.last_time());
                if last < time {
                    return Err(Refusal::Run(Error::OutsideTrajectory { time, first, last }));
                }
                (time, run.final_state().clone())
            }
        };
        let modes = simulation.feasible_modes(time, &state);
        Ok(Feasible {
            scene: self.name(),
            description: system.description(),
            time,
            modes: modes.map_err(match time > 0.0 {
                true => Refusal::Run,
                false => Refusal::Begin,
            })?,
        })
    }
}
