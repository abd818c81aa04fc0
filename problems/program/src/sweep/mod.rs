//! Sweeps: many runs of one scene, over parameters and starts, on all cores.
//!
//! The points are numbered, and the result of a run depends on its number alone: not on how many workers there are, nor on which
//! runs a worker had before. Points are worked off in chunks; a [`Journal`] keeps each chunk as it is done, so that a sweep that
//! is killed goes on where it was.

mod axis;
mod failure;
mod journal;
pub mod launch;
mod modes;
mod observe;
mod points;
mod quantile;
mod recipe;
mod sample;
mod shard;
mod sobol;
mod summary;
#[cfg(feature = "mpi")]
pub mod team;
mod work;
mod worker;

pub use axis::Axis;
pub use failure::reason;
pub use journal::{Journal, Missing, Trouble};
pub use observe::Observation;
pub use points::{Kind, Points, Sampling};
pub use shard::Shard;
pub use summary::{Column, Failed, QUANTILES, Sequence, Summary};
pub use work::work;

use crate::blame;
use crate::notation::rate_unit;
use crate::request::{Quantity, Refusal, Request, find_state};
use crate::scene::Scene;
use core::ops::Range;
use lagrange_core::system::Description;

/// Points of a chunk: a second's work or less.
pub const CHUNK: usize = 1024;

/// Most events of a run, unless the request says otherwise.
const MOST_EVENTS: usize = 10_000;

/// Most points of a sweep: as many as a Sobol sequence of 32 bits has.
const MOST_POINTS: usize = 1 << 32;

/// A sweep as asked for.
#[derive(Clone)]
pub struct Sweep {
    /// The scene.
    pub scene: &'static dyn Scene,
    /// What all runs have in common.
    pub request: Request,
    /// What differs.
    pub points: Points,
    /// What is read from each.
    pub observed: Vec<Observation>,
}

impl Sweep {
    /// Checks names and numbers.
    ///
    /// # Errors
    /// Why the sweep makes no sense.
    pub fn new(
        scene: &'static dyn Scene,
        request: Request,
        points: Points,
        observed: &[String],
    ) -> Result<Self, Refusal> {
        if points.sampling == Sampling::Grid
            && let Some(axis) = points.axes.iter().find(|axis| axis.count == 0)
        {
            return Err(Refusal::Uncounted {
                axis: axis.to_string(),
            });
        }
        let mut columns: Vec<Observation> = Vec::new();
        for text in observed {
            let mut column = Observation::new(text, scene)?;
            if points.axes.iter().any(|axis| axis.name == column.name) {
                column = Observation::new(&format!("{} at the end", column.name), scene)?;
            }
            if let Some(event) = column.ends_with() {
                request.can_happen(&column.name, event.subject, scene.description())?;
            }
            if columns.iter().any(|other| other.name == column.name) {
                return Err(Refusal::Repeated { name: column.name });
            }
            columns.push(column);
        }
        let sweep = Self {
            scene,
            request,
            points,
            observed: columns,
        };
        if sweep.points.len() > MOST_POINTS {
            let points = sweep.points.size();
            return Err(Refusal::TooMany {
                points,
                bytes: points * (8 * sweep.width()) as f64,
                most: MOST_POINTS,
            });
        }
        drop(scene.worker(&sweep)?);
        Ok(sweep)
    }

    /// Numbers that are kept of a run: what is observed, then 0, or the number of the [`reason`] why it failed.
    pub fn width(&self) -> usize {
        self.observed.len() + 1
    }

    /// Most events of each run.
    fn most_events(&self) -> usize {
        self.request.max_events.unwrap_or(MOST_EVENTS)
    }

    /// Why the run of a point fails, if it does: it is made once more, since of a run that fails a number is kept and no words.
    pub(crate) fn message(&self, point: usize) -> Option<String> {
        let mut values = vec![0.0; self.points.axes.len()];
        self.points.write(point, &mut values);
        let mut request = Request {
            max_events: Some(self.most_events()),
            ..self.request.clone()
        };
        let parameters = self.scene.description().parameters;
        for (axis, value) in self.points.axes.iter().zip(values) {
            let list = match parameters.iter().any(|p| p.name == axis.name) {
                true => &mut request.parameters,
                false => &mut request.start,
            };
            list.push((axis.name.clone(), value));
        }
        match self.scene.run(&request) {
            Err(refused) => Some(blame::refusal(self.scene, &request, &refused)),
            Ok(outcome) => blame::failure(self.scene, &request, &outcome),
        }
    }

    /// Unit of what an axis varies; empty for a plain number.
    pub fn unit_varied(&self, axis: usize) -> String {
        let (name, description) = (&self.points.axes[axis].name, self.scene.description());
        let parameter = description.parameters.iter().find(|p| p.name == name);
        match (parameter, find_state(description, name)) {
            (Some(parameter), _) => parameter.unit.to_owned(),
            (None, Ok((index, level))) => unit(description, index, level),
            (None, Err(_)) => String::new(),
        }
    }

    /// Unit of what is observed; empty for a plain number.
    pub fn unit_observed(&self, index: usize) -> String {
        self.observed[index].unit(self.scene.description())
    }

    /// Number of chunks.
    pub fn chunks(&self) -> usize {
        self.points.len().div_ceil(CHUNK)
    }

    /// Numbers of the points of a chunk.
    pub fn chunk(&self, index: usize) -> Range<usize> {
        index * CHUNK..((index + 1) * CHUNK).min(self.points.len())
    }
}

/// Unit of a coordinate or a velocity.
fn unit(description: &Description, index: usize, level: Quantity) -> String {
    let unit = description.coordinates[index].unit;
    match level {
        Quantity::Position => unit.to_owned(),
        Quantity::Velocity => rate_unit(unit),
    }
}

/// Runs a range of points and writes the numbers of [`Sweep::width`] of each, one after the other.
pub type Worker<'a> = Box<dyn FnMut(Range<usize>, &mut [f64]) + Send + 'a>;
