//! A run with all that is needed to show it move: pictures of every sample and the energy book at some of them.

use crate::drawing::Drawing;
use crate::drawn::{self, Pictures};
use crate::number::significant;
use crate::outcome::pieces::PIECE;
use crate::outcome::{Outcome, book_times, equal};
use crate::path::Path;
use crate::request::{Refusal, Request};
use crate::scene::Scene;
use crate::space::Space;
use lagrange_core::__private::declaration::Declaration;
use lagrange_core::error::Shortest;
use lagrange_core::prelude::*;

/// A run to be looked at.
pub struct Film {
    /// What happened.
    pub outcome: Outcome,
    /// One for every sample of the outcome; none if the scene does not move in a plane.
    pub drawings: Vec<Drawing>,
    /// The same for a scene in space.
    pub spaces: Vec<Space>,
    /// The paths that are drawn, in the order of their shapes or solids.
    pub paths: Vec<Path>,
    /// What is no finite number at some sample, so that it is not drawn there, and the time of the first of these, s.
    pub nowhere: Vec<(&'static str, f64)>,
    /// Time, s, and the energy book from the beginning to it; empty if it could not be drawn up.
    pub books: Vec<(f64, Ledger)>,
    /// Largest relative residual of what has to hold (constraints, closed contacts, slips that stick) at any sample; `None` if
    /// nothing ever has to.
    pub drift: Option<f64>,
}

impl dyn Scene + '_ {
    /// Runs it to be looked at: as [`Outcome`], with pictures. Of a long motion it keeps what is looked at, as a run does.
    ///
    /// # Errors
    /// As for a run.
    pub fn film(&self, request: &Request) -> Result<Film, Refusal> {
        self.film_in_pieces(request, PIECE)
    }

    pub(crate) fn film_in_pieces(&self, request: &Request, bytes: usize) -> Result<Film, Refusal> {
        let reel = |piece: &Trajectory, failure, request: &Request, times: &[f64]| {
            Reel::of(self.name(), piece, failure, request, times)
        };
        let beginning = self.beginning(request)?;
        let reel = self.in_pieces(beginning, request, bytes, instants, reel, Reel::join)?;
        Ok(reel.film())
    }
}

impl Film {
    /// What is not drawn somewhere, and why, if there is something.
    pub fn not_drawn(&self) -> Option<String> {
        let told = |(what, first): &(&str, f64)| {
            format!("`{what}` at t = {} s", Shortest(significant(*first)))
        };
        let told: Vec<String> = self.nowhere.iter().map(told).collect();
        let sentence = || {
            format!(
                "No finite place or size: {}. What leaves its domain is not drawn there.",
                told.join(", ")
            )
        };
        (!told.is_empty()).then(sentence)
    }
}

/// What is kept of a run, or of a piece of one, to make a [`Film`] of it.
pub(crate) struct Reel {
    outcome: Outcome,
    drift: Option<f64>,
    paths: Vec<Path>,
    declaration: &'static Declaration,
}

impl Reel {
    /// Of a run, which may have failed half-way, or of a piece of one, sampled at these times, which are in order.
    pub(crate) fn of(
        scene: &'static str,
        trajectory: &Trajectory,
        failure: Option<Error>,
        request: &Request,
        times: &[f64],
    ) -> Self {
        let booked = Request {
            ledger: true,
            ..request.clone()
        };
        let mut outcome = Outcome::sampled(scene, trajectory, failure, &booked, times);
        outcome.event_ledgers = Vec::new();
        if request.plotted {
            let times = book_times(&outcome.curve);
            outcome.curve_ledgers = trajectory.ledgers(&times).unwrap_or_default();
        }
        let samples = outcome.samples.iter();
        let instants = samples.map(|sample| (sample.time, &sample.mode, &sample.state));
        Self {
            drift: drift(trajectory, instants),
            paths: drawn::paths(trajectory),
            declaration: trajectory.declaration(),
            outcome,
        }
    }

    /// Goes on with the next piece.
    pub(crate) fn join(&mut self, next: Self) {
        self.outcome.join(next.outcome);
        self.drift = self.drift.into_iter().chain(next.drift).reduce(f64::max);
        for (path, next) in self.paths.iter_mut().zip(&next.paths) {
            path.join(next);
        }
    }

    /// Draws what is kept.
    pub(crate) fn film(mut self) -> Film {
        self.paths.iter_mut().for_each(Path::straighten);
        let mut outcome = self.outcome;
        let Pictures {
            drawings,
            spaces,
            nowhere,
        } = drawn::pictures(self.declaration, &outcome);
        Film {
            drawings,
            spaces,
            paths: self.paths,
            nowhere,
            books: books(&mut outcome),
            drift: self.drift,
            outcome,
        }
    }
}

/// About so many instants of a motion, in order: half of them at equal intervals, half spread over the integrator's steps, which
/// are short where much happens in little time.
pub(crate) fn instants(trajectory: &Trajectory, count: usize) -> Vec<f64> {
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

/// At how many samples the energy books are kept at most, beside the first.
const BOOKS: usize = 120;

/// The energy books of a run at some of its samples, the first and the last among them, and on both sides of what makes one jump.
fn books(outcome: &mut Outcome) -> Vec<(f64, Ledger)> {
    let times = outcome.samples.iter().map(|sample| sample.time);
    let books: Vec<(f64, Ledger)> = times.zip(core::mem::take(&mut outcome.ledgers)).collect();
    let count = books.len();
    let apart = count.div_ceil(BOOKS).max(1);
    let jumps = |i: usize| {
        let [(at, before), (time, after)] = &books[i..i + 2] else {
            return false;
        };
        let mut works = before.work.iter().zip(&after.work);
        at == time && works.any(|(a, b)| (a.work - b.work).abs() > 1e-9 * after.scale)
    };
    let kept: Vec<bool> = (0..count)
        .map(|i| {
            let beside = i > 0 && jumps(i - 1) || i + 1 < count && jumps(i);
            i == 0 || (count - 1 - i).is_multiple_of(apart) || beside
        })
        .collect();
    let books = books.into_iter().zip(kept);
    books
        .filter(|(_, kept)| *kept)
        .map(|(book, _)| book)
        .collect()
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

#[cfg(test)]
mod tests {
    use crate::file;
    use crate::request::Request;

    /// A grain of 3 µg lies beside a tower of 5e8 kg: what it weighs is no rounding of what the tower weighs.
    #[test]
    fn a_small_force_beside_a_large_one_of_something_else_is_kept() {
        let declared = "parameters(m: \"kg\" = 3e-9, M: \"kg\" = 5e8, g: \"m/s^2\" = 9.81), coordinates(y: \"m\", z: \"m\"),
            kinetic = m/2*der(y)^2 + M/2*der(z)^2, potential = m*g*y + M*g*z, contact(grain: y >= 0), contact(tower: z >= 0), start(lie), until = 1";
        let scene = file::scene("grain.lagrange", declared).expect("a declaration");
        let film = scene.film(&Request::default()).expect("a run");
        let samples = film.outcome.samples.iter();
        let weights = samples.map(|sample| sample.forces[0] / (3e-9 * 9.81));
        assert!(weights.map(|part| part - 1.0).all(|off| off.abs() < 1e-12));
    }
}
