//! A right-hand side, called again and again: what a stepper waits for.

use core::hint::black_box;
use lagrange_core::dynamics::Dynamics;
use lagrange_core::prelude::*;
use std::time::{Duration, Instant};

/// Part of an acceleration that a call moves the state by: less than rounding, so that calls form a chain.
pub const MOVE: f64 = 1e-13;

/// A mode met at a state.
#[derive(Clone, Debug)]
pub struct Place {
    /// The mode.
    pub mode: Mode,
    /// Time, s.
    pub time: f64,
    /// Positions and velocities.
    pub state: State<f64>,
}

/// The middle of the first phase in each mode.
pub fn places(trajectory: &Trajectory) -> Vec<Place> {
    let mut sampler = trajectory.sampler();
    let mut places: Vec<Place> = Vec::new();
    for phase in trajectory.phases() {
        let time = 0.5 * (phase.from + phase.to);
        if places.iter().any(|place| place.mode == phase.mode) {
            continue;
        }
        let Ok(instant) = sampler.at(time) else {
            continue;
        };
        places.push(Place {
            mode: phase.mode,
            time,
            state: instant.state,
        });
    }
    places
}

/// The accelerations of all coordinates in one mode.
pub struct RightSide {
    dynamics: Dynamics<f64>,
    time: f64,
    start: State<f64>,
    rates: Vec<f64>,
}

impl RightSide {
    /// Of a system with some effects, in the mode of a place as far as these effects have it; `None` if there are no
    /// accelerations.
    pub fn new<S: System<Scalar = f64>>(
        system: &S,
        effects: &Effects,
        place: &Place,
    ) -> Option<Self> {
        let mut dynamics = Dynamics::new(system, effects);
        dynamics.set_mode(&remaining(system.description(), effects, &place.mode));
        let State { q, v, .. } = &place.state;
        dynamics.value(place.time, q, v).ok()?;
        Some(Self {
            dynamics,
            time: place.time,
            start: place.state.clone(),
            rates: vec![0.0; v.len()],
        })
    }

    /// Arithmetic operations and function calls.
    pub fn operations(&mut self) -> usize {
        self.dynamics.operations().accelerations
    }

    /// The accelerations of the last call.
    pub fn accelerations(&self) -> &[f64] {
        self.dynamics.acceleration()
    }

    /// How long so many calls take from the beginning, each on the state that the last one has moved: the latency, which is
    /// what an integrator waits for.
    pub fn chain(&mut self, calls: u64) -> Duration {
        let State { mut q, mut v, .. } = black_box(self.start.clone());
        let right_side = self.dynamics.right_side();
        let begin = Instant::now();
        for _ in 0..calls {
            let rates = &mut self.rates;
            // An error would leave the last accelerations; none occurred at the start.
            let done = right_side.acceleration(self.time, &q, &v, rates);
            let _ = black_box(done.is_ok());
            for (q, v) in q.iter_mut().zip(&v) {
                *q += MOVE * v;
            }
            for (v, a) in v.iter_mut().zip(&self.rates) {
                *v += MOVE * a;
            }
        }
        black_box((&q, &v));
        begin.elapsed()
    }
}

/// The mode without the contacts and frictions that are left out.
fn remaining(description: &Description, effects: &Effects, mode: &Mode) -> Mode {
    let mut mode = mode.clone();
    for (i, contact) in mode.contacts.iter_mut().enumerate() {
        *contact &= effects.includes(description, Item::Contact(i));
    }
    for (i, friction) in mode.frictions.iter_mut().enumerate() {
        if !effects.includes(description, Item::Friction(i)) {
            *friction = FrictionMode::Inactive;
        }
    }
    mode
}
