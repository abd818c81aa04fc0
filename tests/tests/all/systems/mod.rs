//! Systems that are not in the library, declared here, each with something independent to compare with.

mod aligned;
mod at_limit;
mod backlash;
mod ball;
mod bearing;
mod belt;
mod bending_guards;
mod bicycle;
mod block;
mod blows;
mod borders;
mod brakes;
mod breaks;
mod cart_pole;
mod chain;
mod choices;
mod chute;
mod cradle;
mod creeping;
mod crowd;
mod cue_ball;
mod damped;
mod dead_points;
mod dependent;
mod die;
mod drag;
mod fading;
mod falls_flat;
mod far;
mod feasible;
mod four_feet;
mod groove;
mod held;
mod hoop;
mod in_a_row;
mod in_turn;
mod incline;
mod instants;
mod joint_stops;
mod just_true;
mod kepler;
mod landings;
mod last_bounces;
mod late;
mod lifts;
mod metric;
mod mirrored;
mod multiples_of_pi;
mod onset;
mod oriented;
mod pads;
mod parameters;
mod peg;
mod pendulum;
mod permuted;
mod piecewise;
mod plate;
mod powers;
mod pressed;
mod pulses;
mod quaternion;
mod region;
mod rigid_bodies;
mod rocking_block;
mod shared_loads;
mod skate;
mod sling;
mod slips;
mod stewart;
mod stiff;
mod stools;
mod stretched;
mod striking_rod;
mod turntable;
mod wire;
mod woodpecker;
mod yoke;

use lagrange_core::prelude::*;

const PI: f64 = core::f64::consts::PI;

pub fn state(q: &[f64], v: &[f64]) -> State<f64> {
    State::new(q.to_vec(), v.to_vec())
}
