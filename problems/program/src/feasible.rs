//! All modes in which a motion can go on at an instant: where a run takes one of several.

use crate::request::{Refusal, Request};
use crate::scene::{Beginning, Scene};
use lagrange_core::prelude::*;
use lagrange_core::system::{AnySystem, Description};

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
    /// Whether more modes are possible than are all tried: then there is only the one that a run takes.
    pub many: bool,
}

impl dyn Scene + '_ {
    /// All modes in which the motion can go on at the start, or at a later time of the run; of more than can all be tried the one that a run takes.
    ///
    /// # Errors
    /// The request makes no sense, the start does not exist, the run does not come so far, or there is no mode.
    pub fn modes(&self, request: &Request, at: Option<f64>) -> Result<Feasible, Refusal> {
        let Beginning { system, start, .. } = self.beginning(request)?;
        let simulation = request.simulation(&system)?;
        let (time, state) = match at.filter(|time| *time > 0.0) {
            None => (0.0, start),
            Some(time) => {
                // Where it comes to is all that is read of it.
                let run = simulation.clone().record(false).run(start, 0.0..time);
                let run = run.map_err(|failure| match failure.trajectory.work().steps {
                    0 => Refusal::Begin(failure.error),
                    _ => Refusal::Run(failure.error),
                })?;
                let last = run.last_time();
                if last < time {
                    let d = run.description();
                    let by = run.events().last();
                    let by = by.map(|by| format!(" ({} {})", by.subject.name(d), by.kind));
                    return Err(Refusal::Ended {
                        asked: time,
                        last,
                        by: by.unwrap_or_default(),
                    });
                }
                (time, run.final_state().clone())
            }
        };
        let (modes, many) = match simulation.feasible_modes(time, &state) {
            Err(Error::Limit { .. }) => (taken(&simulation, time, &state), true),
            modes => (modes, false),
        };
        Ok(Feasible {
            scene: self.name(),
            description: system.description(),
            time,
            modes: modes.map_err(match time > 0.0 {
                true => Refusal::Run,
                false => Refusal::Begin,
            })?,
            many,
        })
    }
}

/// The mode that a run takes.
fn taken(
    simulation: &Simulation<'_, AnySystem<f64>>,
    time: f64,
    state: &State<f64>,
) -> Result<Vec<Instant<f64>>, Error> {
    let run = simulation.run(state.clone(), time..time);
    let run = run.map_err(|failure| failure.error)?;
    Ok(vec![run.sampler().at(time)?])
}
