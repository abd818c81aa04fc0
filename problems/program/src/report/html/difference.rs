//! Two runs of one scene → how far they are apart, coordinate by coordinate.
//!
//! Between samples positions are cubic Hermite polynomials of positions and velocities: exact to the fourth power of the
//! distance between samples, so that what is seen is the difference of the runs and not that of their sampling.

use crate::outcome::{Outcome, Sample};
use crate::report::picture::Place;

/// Coordinate `i` of a run less that of another one, at the samples of the first; `None` where the other one has ended.
pub(super) fn difference(run: &Outcome, other: &Outcome, i: usize) -> Vec<Option<f64>> {
    let times: Vec<f64> = other.samples.iter().map(|sample| sample.time).collect();
    let apart = |sample: &Sample| {
        let place = Place::of(sample.time, &times);
        let from = other.samples.get(place.sample)?;
        if place.part == 0.0 {
            return (from.time == sample.time).then(|| sample.state.q[i] - from.state.q[i]);
        }
        let to = other.samples.get(place.sample + 1)?;
        Some(sample.state.q[i] - hermite(from, to, i, place.part))
    };
    run.samples.iter().map(apart).collect()
}

/// Coordinate `i` at a part of the way from one sample to the next.
fn hermite(from: &Sample, to: &Sample, i: usize, part: f64) -> f64 {
    let width = to.time - from.time;
    let (q0, q1) = (from.state.q[i], to.state.q[i]);
    let (v0, v1) = (from.state.v[i] * width, to.state.v[i] * width);
    let (s, r) = (part, 1.0 - part);
    r * r * ((1.0 + 2.0 * s) * q0 + s * v0) + s * s * ((1.0 + 2.0 * r) * q1 - r * v1)
}
