//! Gaps without a gradient where they are zero: a floor exactly as low as a pendulum hangs.

use super::state;
use core::fmt::{Debug, Display};
use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, all_agree, certified, methods_at, run_by};

/// Two rods that hang; the lower one cannot swing behind the upper one.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(a, b),
    kinetic = (upper * der(a))^2 / 2 + mass/2 * (der(upper * sin(a) + lower * sin(b))^2 + der(upper * cos(a) + lower * cos(b))^2),
    potential = -10 * upper * cos(a) - mass * 10 * (upper * cos(a) + lower * cos(b)),
    contact(knee: b - a >= 0),
    contact(floor: upper + lower - upper * cos(a) - lower * cos(b) >= 0),
)]
struct Leg {
    upper: f64,
    lower: f64,
    mass: f64,
}

/// The same with a force that pushes the upper rod, and no knee.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(a, b),
    kinetic = (upper * der(a))^2 / 2 + mass/2 * (der(upper * sin(a) + lower * sin(b))^2 + der(upper * cos(a) + lower * cos(b))^2),
    potential = -10 * upper * cos(a) - mass * 10 * (upper * cos(a) + lower * cos(b)),
    force(side: a = push),
    contact(floor: upper + lower - upper * cos(a) - lower * cos(b) >= 0),
)]
struct Pushed {
    upper: f64,
    lower: f64,
    mass: f64,
    push: f64,
}

/// It hangs straight down on the floor and is pushed aside: the floor carries nothing and holds nothing.
#[test]
fn what_hangs_down_to_the_floor_swings_off() {
    for (upper, lower, mass, push) in [
        (1.0, 0.5, 1.0, 0.0),
        (0.4, 0.7, 2.0, 0.6),
        (0.6, 0.3, 0.5, 1.5),
    ] {
        let leg = Pushed {
            upper,
            lower,
            mass,
            push: 2.0,
        };
        for (method, tolerance) in methods_at(METHODS, [1e-6, 1e-9]) {
            let start = || state(&[0.0; 2], &[0.0, push]);
            let simulation = Simulation::new(&leg).method(method).tolerance(tolerance);
            let free = simulation.effects(Effects::all().without(Pushed::FLOOR));
            let free = free.run(start(), 0.0..0.4).expect("a run");
            let run = run_by(&leg, (method, tolerance), start(), 0.4);
            let what = format!("{leg:?} by {method}");
            all_agree(
                what,
                &run.final_state().q,
                &free.final_state().q,
                20.0 * tolerance,
            );
        }
    }
}

/// Straight down both rods touch the floor at the instant at which the lower one swings ahead: the floor changes nothing.
#[test]
fn a_floor_as_low_as_a_leg_reaches_is_grazed() {
    for (upper, lower, mass, from) in [
        (1.0, 0.5, 1.0, -0.5),
        (0.5, 0.659, 2.0, -0.773),
        (0.3, 0.5, 2.0, -0.2),
        (0.5, 0.3, 2.0, -0.757),
        (1.7, 0.4, 0.6, -0.35),
    ] {
        let leg = Leg { upper, lower, mass };
        for (method, tolerance) in methods_at(METHODS, [1e-9]) {
            let start = || state(&[from; 2], &[0.0; 2]);
            let simulation = Simulation::new(&leg).method(method).tolerance(tolerance);
            let free = simulation.effects(Effects::all().without(Leg::FLOOR));
            let free = free.run(start(), 0.0..1.0).expect("a run");
            let run = run_by(&leg, (method, tolerance), start(), 1.0);
            let what = format!("{leg:?} by {method}");
            all_agree(what, &run.final_state().q, &free.final_state().q, 1e-7);
        }
    }
}

/// A bob on a rod in the plane: the rod alone determines how high it is where it hangs.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    potential = 10 * y,
    constraint(rod: x^2 + y^2 == length^2),
    contact(floor: y >= depth - length, restitution = bounce),
    contact(wall: x <= length, restitution = bounce),
)]
struct Bob {
    length: f64,
    depth: f64,
    bounce: f64,
}

/// Nothing happens in three seconds, and what is touched changes nothing: without it the motion ends where it does.
#[track_caller]
fn passes<S: System<Scalar = f64> + Debug>(
    scene: &S,
    (method, tolerance): (impl Display + Copy, f64),
    without: Effects,
    start: State<f64>,
) {
    let what = format!("{scene:?} by {method}");
    let simulation = Simulation::new(scene).tolerance(tolerance);
    let simulation = simulation.method(method.to_string().parse().expect("a method"));
    let free = simulation.effects(without).run(start.clone(), 0.0..3.0);
    let run = run_by(scene, (method, tolerance), start, 3.0);
    assert!(run.events().is_empty(), "{what}");
    all_agree(
        &what,
        &run.final_state().q,
        &free.expect("a run").final_state().q,
        100.0 * tolerance,
    );
}

/// A floor as low as it reaches changes nothing, nor does a wall that it touches where it is held aside; a higher floor is hit.
#[test]
fn a_bob_swings_past_what_it_only_touches() {
    for (length, bounce, angle) in [
        (0.5, 0.5, 0.4),
        (1.0, 0.0, -0.7),
        (0.83, 1.0, 1.2),
        (2.0, 0.3, core::f64::consts::FRAC_PI_2),
    ] {
        let bob = Bob {
            length,
            depth: 0.0,
            bounce,
        };
        let higher = Bob {
            depth: 1e-5 * length,
            ..bob.clone()
        };
        for (method, tolerance) in methods_at(METHODS, [1e-6, 1e-9]) {
            let start = || state(&[length * angle.sin(), -length * angle.cos()], &[0.0; 2]);
            let without = Effects::all().without(Bob::FLOOR).without(Bob::WALL);
            passes(&bob, (method, tolerance), without, start());
            let run = run_by(&higher, (method, tolerance), start(), 3.0);
            assert!(!run.events().is_empty(), "{higher:?} by {method}: hits");
        }
    }
}

/// A bead on a wire whose lowest point is on a floor, at `low`; a wheel turns the plane of the wire.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, z),
    kinetic = (der(x)^2 + der(y)^2 + der(z)^2) / 2,
    potential = 10 * z,
    constraint(wire: z == low + bend * (x^2 + y^2) + steep * (x^2 + y^2)^2),
    constraint(plane: y * cos(rate * t) == x * sin(rate * t)),
    contact(floor: z >= low - deep, restitution = bounce),
)]
struct Bead {
    low: f64,
    bend: f64,
    steep: f64,
    rate: f64,
    deep: f64,
    bounce: f64,
}

/// The floor that it touches changes nothing, wherever heights are counted from; one that is a little higher is hit.
#[test]
fn a_bead_slides_over_the_lowest_point_of_its_wire() {
    for (low, bend, steep, rate, bounce, from) in [
        (0.0, 0.3, 0.0, 0.0, 0.6, 0.3),
        (0.0, 1.0, 0.0, 2.0, 0.0, 1.0),
        (0.0, 2.0, 0.7, 0.0, 1.0, 0.5),
        (0.4, 0.8, 0.0, 1.0, 0.6, 0.7),
        (0.0, 0.5, 1.0, 3.0, 0.3, 0.4),
        (0.0, 0.0, 0.2, 0.0, 1.0, 0.9),
        (0.0, 0.0, 1.0, 0.0, 0.0, 0.6),
    ] {
        let bead = Bead {
            low,
            bend,
            steep,
            rate,
            deep: 0.0,
            bounce,
        };
        let higher = Bead {
            deep: -1e-5,
            ..bead.clone()
        };
        let height = low + bend * from * from + steep * from.powi(4);
        for (method, tolerance) in methods_at(METHODS, [1e-6, 1e-9]) {
            let start = || state(&[from, 0.0, height], &[0.0, rate * from, 0.0]);
            let without = Effects::all().without(Bead::FLOOR);
            passes(&bead, (method, tolerance), without, start());
            if rate == 0.0 {
                let run = run_by(&higher, (method, tolerance), start(), 3.0);
                assert!(!run.events().is_empty(), "{higher:?} by {method}: hits");
            }
        }
    }
}

/// The sum of the lengths may be larger than their rounded one: the floor is above the foot then by what rounding makes of it, which is no penetration.
#[test]
fn rounding_of_a_gap_without_a_slope_is_no_penetration() {
    for (upper, lower, mass, from) in [
        (0.5, 1.807970676603743, 0.5, -0.5),
        (1.8938243203498186, 0.3, 0.5, -0.5),
        (0.5, 0.6056732239734838, 1.5, -0.2),
    ] {
        let leg = Leg { upper, lower, mass };
        let run = Simulation::new(&leg).run(state(&[from; 2], &[0.0; 2]), 0.0..1.0);
        certified(format!("{leg:?}"), &run.expect("a run"));
    }
}

/// Two rods, the lower one told by its angle to the upper one, whose end hangs down to a floor.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(hip, knee),
    kinetic = mass/2 * (der(sin(hip) + length * sin(hip + knee))^2 + der(cos(hip) + length * cos(hip + knee))^2) + der(hip)^2/2,
    potential = -10 * cos(hip) - 10 * mass * (cos(hip) + length * cos(hip + knee)),
    force(turn: hip = push),
    contact(shin: 1 - cos(hip + knee) >= 0),
    contact(thigh: 1 - cos(hip - knee) >= 0),
)]
struct Jointed {
    mass: f64,
    length: f64,
    push: f64,
}

/// A gap of a sum or a difference of angles has no more of a direction than that of one angle.
#[test]
fn what_hangs_by_joints_swings_off() {
    for (mass, length, push) in [(1.0, 1.0, 2.0), (0.5, 0.7, -3.0), (3.0, 1.2, 1.0)] {
        let leg = Jointed { mass, length, push };
        for (method, tolerance) in methods_at(METHODS, [1e-6, 1e-9, 1e-12]) {
            let start = || state(&[0.0; 2], &[0.0; 2]);
            let simulation = Simulation::new(&leg).method(method).tolerance(tolerance);
            let neither = Effects::all()
                .without(Jointed::SHIN)
                .without(Jointed::THIGH);
            let free = simulation.effects(neither).run(start(), 0.0..0.5);
            let free = free.expect("a run");
            let run = run_by(&leg, (method, tolerance), start(), 0.5);
            let what = format!("{leg:?} by {method} at {tolerance:e}");
            all_agree(
                what,
                &run.final_state().q,
                &free.final_state().q,
                20.0 * tolerance,
            );
        }
    }
}
