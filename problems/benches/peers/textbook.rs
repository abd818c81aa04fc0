//! The four textbook scenes: modes, events, and the flight to the floor.

use crate::crates::Peer;
use crate::hand::{self, G, sphere, wheel};
use crate::references as exact;
use crate::scenes::Scene;
use lagrange_core::prelude::*;
use lagrange_problems::scenes::*;

/// No run lasts longer, s.
const LONGEST: f64 = 20.0;

/// [x, ẋ, ẏ] from (r, θ) and their rates, upward vertical.
fn cartesian(r: f64, theta: f64, radial: f64, turn: f64) -> [f64; 3] {
    let (s, c) = theta.sin_cos();
    let across = r * turn;
    [r * s, radial * s + across * c, radial * c - across * s]
}

/// Flies by hand from distance `r` at the time `from` until the height is −`floor`; time and (r, θ, ṙ, θ̇).
fn fly<P: Peer>(
    peer: P,
    from: f64,
    start: [f64; 4],
    floor: f64,
    tolerance: f64,
) -> Option<(f64, [f64; 4])> {
    let above = move |y: &[f64; 4]| y[0] * y[1].cos() + floor;
    peer.until_zero(hand::flight, above, start, from, tolerance)
}

/// [`MassOnShell`]
pub struct Slide;

impl Scene for Slide {
    const NAME: &'static str = "1 mass on shell";
    const REFERENCE: &'static [f64] = &exact::MASS_ON_SHELL;
    const UNTIL: f64 = LONGEST;
    type Declared = MassOnShell;

    fn seen(trajectory: &Trajectory) -> Option<Vec<f64>> {
        if trajectory.events().len() != 2 {
            return None;
        }
        let lost = &trajectory.events()[0];
        let State { q, v, .. } = trajectory.final_state();
        let [x, vx, vy] = cartesian(q[0], q[1], v[0], v[1]);
        let end = trajectory.last_time();
        let State { q, v, .. } = &lost.state;
        Some(vec![lost.time, q[1], v[1], end, x, vx, vy])
    }

    fn by_hand<P: Peer>(peer: P, tolerance: f64) -> Option<Vec<f64>> {
        let pressed = |y: &[f64; 2]| G * y[0].cos() - y[1] * y[1];
        let slope = hand::on_shell(G);
        let (lost, [theta, turn]) = peer.until_zero(slope, pressed, [0.01, 0.0], 0.0, tolerance)?;
        let (end, y) = fly(peer, lost, [1.0, theta, 0.0, turn], 1.0, tolerance)?;
        let [x, vx, vy] = cartesian(y[0], y[1], y[2], y[3]);
        Some(vec![lost, theta, turn, end, x, vx, vy])
    }
}

/// [`RollingSphere`]
pub struct Roll;

/// Turns of the sphere per turn about the shell while it rolls.
const GEAR: f64 = sphere::REACH / sphere::A;

fn sphere_pressed(theta: f64, turn: f64) -> f64 {
    G * theta.cos() - sphere::REACH * turn * turn
}

impl Scene for Roll {
    const NAME: &'static str = "2 rolling sphere";
    const REFERENCE: &'static [f64] = &exact::ROLLING_SPHERE;
    const UNTIL: f64 = LONGEST;
    type Declared = RollingSphere;

    fn seen(trajectory: &Trajectory) -> Option<Vec<f64>> {
        if trajectory.events().len() != 2 {
            return None;
        }
        let lost = &trajectory.events()[0];
        let State { q, v, .. } = trajectory.final_state();
        let [x, vx, vy] = cartesian(q[0], q[1], v[0], v[1]);
        let end = [trajectory.last_time(), x, vx, vy, q[2], v[2]];
        let State { q, v, .. } = &lost.state;
        Some([&[lost.time, q[1], v[1]][..], &end].concat())
    }

    fn by_hand<P: Peer>(peer: P, tolerance: f64) -> Option<Vec<f64>> {
        let pressed = |y: &[f64; 2]| sphere_pressed(y[0], y[1]);
        let slope = hand::on_shell(5.0 / 7.0 * G / sphere::REACH);
        let (lost, [theta, turn]) = peer.until_zero(slope, pressed, [0.01, 0.0], 0.0, tolerance)?;
        let start = [sphere::REACH, theta, 0.0, turn];
        let (end, y) = fly(peer, lost, start, 1.0, tolerance)?;
        let [x, vx, vy] = cartesian(y[0], y[1], y[2], y[3]);
        let spin = GEAR * turn;
        let phi = GEAR * (theta - 0.01) + spin * (end - lost);
        Some(vec![lost, theta, turn, end, x, vx, vy, phi, spin])
    }
}

/// [`RollingSlippingSphere`]
pub struct Slip;

impl Scene for Slip {
    const NAME: &'static str = "3 sphere that rolls, then slips";
    const REFERENCE: &'static [f64] = &exact::SLIPPING_SPHERE;
    const UNTIL: f64 = LONGEST;
    type Declared = RollingSlippingSphere;

    fn seen(trajectory: &Trajectory) -> Option<Vec<f64>> {
        if trajectory.events().len() != 3 {
            return None;
        }
        let [events @ .., _] = trajectory.events() else {
            return None;
        };
        let seen = events
            .iter()
            .flat_map(|e| [e.time, e.state.q[1], e.state.v[1]]);
        let State { q, v, .. } = trajectory.final_state();
        let [x, vx, vy] = cartesian(q[0], q[1], v[0], v[1]);
        let end = [trajectory.last_time(), x, vx, vy, q[2], v[2]];
        Some(seen.chain(end).collect())
    }

    fn by_hand<P: Peer>(peer: P, tolerance: f64) -> Option<Vec<f64>> {
        let grips = |y: &[f64; 2]| 0.4 * sphere_pressed(y[0], y[1]) - 2.0 / 7.0 * G * y[0].sin();
        let slope = hand::on_shell(5.0 / 7.0 * G / sphere::REACH);
        let (slips, [theta, turn]) = peer.until_zero(slope, grips, [0.01, 0.0], 0.0, tolerance)?;
        let pressed = |y: &[f64; 4]| sphere_pressed(y[0], y[2]);
        let start = [theta, GEAR * (theta - 0.01), turn, GEAR * turn];
        let (lost, y) = peer.until_zero(hand::sphere_slips, pressed, start, slips, tolerance)?;
        let start = [sphere::REACH, y[0], 0.0, y[2]];
        let (end, z) = fly(peer, lost, start, 1.0, tolerance)?;
        let [x, vx, vy] = cartesian(z[0], z[1], z[2], z[3]);
        let phi = y[1] + y[3] * (end - lost);
        let seen = [slips, theta, turn, lost, y[0], y[2]];
        Some([&seen[..], &[end, x, vx, vy, phi, y[3]]].concat())
    }
}

/// [`MassOnWheel`]
pub struct Wheel;

impl Scene for Wheel {
    const NAME: &'static str = "4 mass on wheel";
    const REFERENCE: &'static [f64] = &exact::MASS_ON_WHEEL;
    const UNTIL: f64 = LONGEST;
    type Declared = MassOnWheel;

    fn seen(trajectory: &Trajectory) -> Option<Vec<f64>> {
        if trajectory.events().len() != 3 {
            return None;
        }
        let [slips, lost, _] = trajectory.events() else {
            return None;
        };
        let State { q, v, .. } = trajectory.final_state();
        let [x, vx, vy] = cartesian(q[2], q[3], v[2], v[3]);
        let end = [trajectory.last_time(), q[0] + x, q[0], v[0] + vx, vy, v[0]];
        let seen = [slips, lost].map(|e| [e.time, e.state.q[3], e.state.v[3]]);
        let seen = seen.concat();
        Some([&seen[..], &[lost.state.v[1]], &end].concat())
    }

    fn by_hand<P: Peer>(peer: P, tolerance: f64) -> Option<Vec<f64>> {
        let grips = |y: &[f64; 2]| {
            let (s, c) = y[0].sin_cos();
            let pushed = wheel::R * hand::wheel_stuck_turn(y[0], y[1]);
            let normal = G * c - wheel::R * y[1] * y[1] + pushed * s;
            let along = pushed * (1.0 + c) - G * s;
            0.6 * normal - along.abs()
        };
        let start = [0.05, 0.0];
        let (slips, [theta, turn]) =
            peer.until_zero(hand::wheel_sticks, grips, start, 0.0, tolerance)?;
        let pressed = |y: &[f64; 4]| hand::wheel_slip_forces(y[0], y[2]).0;
        let start = [theta, theta - 0.05, turn, turn];
        let (lost, y) = peer.until_zero(hand::wheel_slips, pressed, start, slips, tolerance)?;
        let [lost_theta, phi, lost_turn, spin] = y;
        let start = [wheel::R, lost_theta, 0.0, lost_turn];
        let (end, z) = fly(peer, lost, start, wheel::R, tolerance)?;
        let [x, vx, vy] = cartesian(z[0], z[1], z[2], z[3]);
        let speed = wheel::R * spin;
        let centre = wheel::R * phi + speed * (end - lost);
        let seen = [slips, theta, turn, lost, lost_theta, lost_turn, spin];
        Some([&seen[..], &[end, centre + x, centre, speed + vx, vy, speed]].concat())
    }
}
