//! A run with all that is needed to show it move: pictures of every sample and the energy book at some of them.

use crate::drawing::Drawing;
use crate::drawn::{self, Pictures};
use crate::outcome::{Outcome, equal};
use crate::request::Request;
use crate::space::Space;
use lagrange_core::prelude::*;

/// A run to be looked at.
pub struct Film {
    /// What happened.
    pub outcome: Outcome,
    /// One for every sample of the outcome; none if the scene does not move in a plane.
    pub drawings: Vec<Drawing>,
    /// The same for a scene in space.
    pub spaces: Vec<Space>,
    /// Time, s, and the energy book from the beginning to it; empty if it could not be drawn up.
    pub books: Vec<(f64, Ledger)>,
    /// Largest relative residual of what has to hold (constraints, closed contacts, slips that stick) at any sample; `None` if
    /// nothing ever has to.
    pub drift: Option<f64>,
}

impl Film {
    /// Of a finished run, which may have failed half-way.
    pub(crate) fn of(
        scene: &'static str,
        trajectory: &Trajectory,
        failure: Option<Error>,
        request: &Request,
    ) -> Self {
        let times = instants(trajectory, request.samples);
        let mut outcome = Outcome::sampled(scene, trajectory, failure, request, &times);
        without_rounding(&mut outcome);
        let samples = outcome.samples.iter();
        let instants = samples.map(|sample| (sample.time, &sample.mode, &sample.state));
        let drift = drift(trajectory, instants);
        let declaration = trajectory.declaration();
        let Pictures { drawings, spaces } = drawn::pictures(declaration, &outcome);
        Self {
            drawings,
            spaces,
            books: request.stage(trajectory.last_time(), || books(trajectory)),
            drift,
            outcome,
        }
    }
}

/// About so many instants of a motion, in order: half of them at equal intervals, half spread over the integrator's steps, which
/// are short where much happens in little time.
fn instants(trajectory: &Trajectory, count: usize) -> Vec<f64> {
    let mut times = equal(trajectory, count.div_ceil(2));
    let steps: Vec<f64> = trajectory
        .step_times()
        .chain([trajectory.last_time()])
        .collect();
    let half = count / 2;
    times.extend((0..half).filter_map(|k| {
        let at = k as f64 / half as f64 * (steps.len() - 1) as f64;
        let (from, to) = (steps.get(at as usize)?, steps.get(at as usize + 1)?);
        Some(from + at.fract() * (to - from))
    }));
    times.sort_by(f64::total_cmp);
    times.dedup();
    times
}

/// Makes forces zero that only rounding keeps from it: those below 1e-12 of the largest one.
fn without_rounding(outcome: &mut Outcome) {
    let samples = outcome.samples.iter().flat_map(|sample| &sample.forces);
    let events = outcome.events.iter().flat_map(|event| &event.forces);
    let sizes = samples.chain(events).map(|force| force.abs());
    let least = 1e-12 * sizes.filter(|size| size.is_finite()).fold(0.0, f64::max);
    let samples = outcome
        .samples
        .iter_mut()
        .flat_map(|sample| &mut sample.forces);
    let events = outcome
        .events
        .iter_mut()
        .flat_map(|event| &mut event.forces);
    for force in samples.chain(events).filter(|force| force.abs() < least) {
        *force = 0.0;
    }
}

/// Intervals at which the energy book is opened.
const BOOKS: usize = 120;

/// The energy book at equal intervals.
fn books(trajectory: &Trajectory) -> Vec<(f64, Ledger)> {
    let (first, last) = (trajectory.first_time(), trajectory.last_time());
    let part = |k: usize| first + (last - first) * k as f64 / BOOKS as f64;
    let times: Vec<f64> = (0..BOOKS).map(part).chain([last]).collect();
    let ledgers = trajectory.ledgers(&times).unwrap_or_default();
    times.into_iter().zip(ledgers).collect()
}

/// Largest relative residual of the rows that act, on position and velocity level, among instants of a run; `None` if none
/// ever acts.
pub(crate) fn drift<'a>(
    trajectory: &Trajectory,
    instants: impl Iterator<Item = (f64, &'a Mode, &'a State<f64>)>,
) -> Option<f64> {
    let mut dynamics = trajectory.dynamics();
    let mut entered: Option<&Mode> = None;
    let residuals = instants.filter_map(|(time, mode, state)| {
        if entered != Some(mode) {
            dynamics.set_mode(mode);
            entered = Some(mode);
        }
        if dynamics.acting_rows().is_empty() {
            return None;
        }
        let (position, velocity) = dynamics.residuals(time, &state.q, &state.v);
        Some(position.relative.max(velocity.relative))
    });
    residuals.reduce(f64::max)
}
