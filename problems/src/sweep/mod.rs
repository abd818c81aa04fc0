//! Sweeps: many runs of one scene, over parameters and starts, on all cores.
//!
//! The points are numbered, and the result of a run depends on its number alone: not on how many workers there are, nor on which
//! runs a worker had before. Points are worked off in chunks; a [`Journal`] keeps each chunk as it is done, so that a sweep that
//! is killed goes on where it was.

mod journal;
mod observe;
mod points;
mod summary;
mod work;
mod worker;

pub use journal::{Journal, Trouble};
pub use observe::Observation;
pub(crate) use observe::event;
pub use points::{Axis, Points, Sampling};
pub use summary::{Column, Summary};
pub use work::work;
pub(crate) use worker::worker;

use crate::catalogue::Scene;
use crate::request::{Refusal, Request};
use core::ops::Range;

/// Points of a chunk: a second's work or less.
pub const CHUNK: usize = 1024;

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
        let sweep = Self {
            scene,
            request,
            points,
            observed: observed
                .iter()
                .map(|text| Observation::new(text, scene))
                .collect::<Result<_, _>>()?,
        };
        drop(scene.worker(&sweep)?);
        Ok(sweep)
    }

    /// Numbers that are kept of a run: what is observed, then 0, or 1 if it failed.
    pub fn width(&self) -> usize {
        self.observed.len() + 1
    }

    /// Number of chunks.
    pub fn chunks(&self) -> usize {
        self.points.len().div_ceil(CHUNK)
    }

    /// Numbers of the points of a chunk.
    pub fn chunk(&self, index: usize) -> Range<usize> {
        index * CHUNK..((index + 1) * CHUNK).min(self.points.len())
    }

    /// The sweep in words: two that say the same have the same results.
    pub fn signature(&self) -> String {
        let Request {
            parameters,
            from,
            effects,
            start,
            until,
            end_after,
            tolerance,
            method,
            project,
            impacts,
            ..
        } = &self.request;
        let axes: Vec<String> = self.points.axes.iter().map(ToString::to_string).collect();
        let observed: Vec<&str> = self.observed.iter().map(|o| o.name.as_str()).collect();
        format!(
            "lagrange {} {}\nparameters {parameters:?}\nstart {from:?} {start:?}\neffects {effects:?}\n\
             until {until:?} end after {end_after:?} tolerance {tolerance:e} method {method} project {project} impacts {impacts:?}\n\
             points {axes:?} {:?}\nobserved {observed:?}\nchunks of {CHUNK}\n",
            env!("CARGO_PKG_VERSION"),
            self.scene.name(),
            self.points.sampling,
        )
    }
}

/// Runs points one after the other: from the values of the axes to the numbers of [`Sweep::width`].
pub type Worker<'a> = Box<dyn FnMut(&[f64], &mut [f64]) + Send + 'a>;
