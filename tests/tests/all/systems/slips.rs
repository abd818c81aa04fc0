//! Slips of two components in company: a plane that pulls and pushes, blocks on blocks, a contact that is lost.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{
    SINGLE_METHODS, TOLERANCES, agree, all_agree, closure, event, methods_at, run, run_by, words,
};

/// A bead between two plates: the plane pulls as well as pushes, friction goes with |λ|.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, z),
    kinetic = mass/2 * (der(x)^2 + der(y)^2 + der(z)^2),
    potential = mass * gravity * z,
    constraint(plates: z == 0),
    friction(rub on plates: slip = (der(x), der(y)), static = mu),
    force(pull: z = lift * t),
)]
struct Plates {
    mass: f64,
    gravity: f64,
    mu: f64,
    lift: f64,
}

/// v falls by μ |m g − lift t|/m along a straight line; through the instant at which the plates change sides.
#[test]
fn the_normal_force_changes_its_sign() {
    let scene = Plates {
        mass: 0.5,
        gravity: 9.81,
        mu: 0.2,
        lift: 5.0,
    };
    let (a, b) = (0.2 * 9.81, 0.2 * 5.0 / 0.5);
    let even = a / b;
    let (v0, along) = (2.5, [0.6, -0.8]);
    let trajectory = run(
        &scene,
        state(&[0.0; 3], &[v0 * along[0], v0 * along[1], 0.0]),
        5.0,
    );
    assert_eq!(words(&trajectory), ["rub sticks"]);
    // Up to `even` v = v₀ − a t + b t²/2, then v₁ − b (t − even)²/2.
    let v1 = v0 - 0.5 * a * even;
    let rest = even + (2.0 * v1 / b).sqrt();
    let way = v0 * even - a * even * even / 2.0 + b * even.powi(3) / 6.0 + v1 * (rest - even)
        - b * (rest - even).powi(3) / 6.0;
    agree(
        "rest",
        event(&trajectory, "rub", "sticks").time,
        rest,
        1e-12,
    );
    all_agree(
        "place",
        &trajectory.final_state().q[..2],
        &along.map(|u| u * way),
        1e-12,
    );
    assert!(closure(&trajectory) < 1e-12);
}

/// It rests while λ goes through zero: nothing pulls, so it stays.
#[test]
fn a_bead_at_rest_stays_through_the_change_of_sides() {
    let scene = Plates {
        mass: 0.5,
        gravity: 9.81,
        mu: 0.2,
        lift: 5.0,
    };
    let trajectory = run(&scene, state(&[0.0; 3], &[0.0; 3]), 3.0);
    assert!(words(&trajectory).is_empty());
    assert_eq!(trajectory.final_state().q, [0.0; 3]);
    // And starts where λ is zero at the very beginning.
    let floating = Plates {
        lift: 3.0,
        gravity: 0.0,
        ..scene
    };
    let trajectory = run(&floating, state(&[0.0; 3], &[0.3, 0.4, 0.0]), 3.0);
    assert_eq!(words(&trajectory), ["rub sticks"]);
    agree(
        "rest",
        event(&trajectory, "rub", "sticks").time,
        (2.0 * 0.5 / (0.2 * 3.0 / 0.5_f64)).sqrt(),
        1e-12,
    );
}

/// A block on a block on the floor, the lower one pushed by a growing force.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, z, u, v, w),
    kinetic = lower/2 * (der(x)^2 + der(y)^2 + der(z)^2) + upper/2 * (der(u)^2 + der(v)^2 + der(w)^2),
    potential = gravity * (lower * z + upper * w),
    contact(floor: z >= 0),
    contact(top: w >= z),
    friction(under on floor: slip = (der(x), der(y)), static = mu_floor),
    friction(between on top: slip = (der(u) - der(x), der(v) - der(y)), static = mu_top),
    force(push: (force * t * cos(turn * t), force * t * sin(turn * t)) at (x, y)),
)]
struct Blocks {
    lower: f64,
    upper: f64,
    gravity: f64,
    mu_floor: f64,
    mu_top: f64,
    force: f64,
    turn: f64,
}

const BLOCKS: Blocks = Blocks {
    lower: 2.0,
    upper: 1.0,
    gravity: 9.81,
    mu_floor: 0.3,
    mu_top: 0.2,
    force: 4.0,
    turn: 0.0,
};

#[test]
fn the_lower_slips_then_the_upper() {
    let trajectory = run(&BLOCKS, state(&[0.0; 6], &[0.0; 6]), 6.0);
    assert_eq!(words(&trajectory), ["under slips", "between slips"]);
    let b = BLOCKS;
    let total = b.lower + b.upper;
    let first = b.mu_floor * total * b.gravity / b.force;
    let second = (b.mu_floor + b.mu_top) * total * b.gravity / b.force;
    agree(
        "lower",
        event(&trajectory, "under", "slips").time,
        first,
        1e-12,
    );
    agree(
        "upper",
        event(&trajectory, "between", "slips").time,
        second,
        1e-12,
    );
    let v =
        b.force / total * (second - first).powi(2) / 2.0 + b.mu_top * b.gravity * (6.0 - second);
    agree("upper's speed", trajectory.final_state().v[3], v, 1e-12);
    assert!(closure(&trajectory) < 1e-12);
}

/// Runs for 6 s; another method arrives at the same place.
#[track_caller]
fn confirmed(scene: &Blocks, start: &State<f64>) -> Trajectory {
    let trajectory = run(scene, start.clone(), 6.0);
    let (told, off) = (words(&trajectory), closure(&trajectory));
    println!("{told:?} {:?} {off:e}", trajectory.work());
    assert!(off < 1e-11);
    let other = run_by(scene, ("dop853", 1e-11), start.clone(), 6.0);
    let (end, other) = (trajectory.final_state(), other.final_state());
    all_agree("dop853", &end.q, &other.q, 1e-9);
    trajectory
}

#[test]
fn a_push_that_turns() {
    let turning = Blocks {
        turn: 1.0,
        ..BLOCKS
    };
    confirmed(&turning, &state(&[0.0; 6], &[0.0; 6]));
}

/// Two slips, each turning the other.
#[test]
fn blocks_thrown_crosswise() {
    let thrown = Blocks {
        force: 0.0,
        ..BLOCKS
    };
    let start = state(&[0.0; 6], &[1.0, 0.0, 0.0, 0.0, 2.0, 0.0]);
    let trajectory = confirmed(&thrown, &start);
    all_agree("rest", &trajectory.final_state().v, &[0.0; 6], 1e-15);
}

/// A puck over whose table the lift grows: it slides, turns in a side wind, and leaves the table while it slips.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, z),
    kinetic = mass/2 * (der(x)^2 + der(y)^2 + der(z)^2),
    potential = mass * gravity * z,
    contact(table: z >= 0),
    friction(grip on table: slip = (der(x), der(y)), static = mu),
    force(pull: z = rise * t),
)]
struct Lifted {
    mass: f64,
    gravity: f64,
    mu: f64,
    rise: f64,
}

#[test]
fn contact_is_lost_while_it_slips() {
    let scene = Lifted {
        mass: 0.5,
        gravity: 9.81,
        mu: 0.2,
        rise: 5.0,
    };
    let trajectory = run(&scene, state(&[0.0; 3], &[1.5, 2.0, 0.0]), 2.0);
    assert_eq!(words(&trajectory), ["table lost"]);
    let leaves = 0.5 * 9.81 / 5.0;
    agree(
        "leaves",
        event(&trajectory, "table", "lost").time,
        leaves,
        1e-12,
    );
    let speed = 2.5 - 0.5 * 0.2 * 9.81 * leaves;
    let end = trajectory.final_state();
    all_agree("velocity", &end.v[..2], &[0.6 * speed, 0.8 * speed], 1e-12);
    agree(
        "height",
        end.q[2],
        5.0 / 0.5 * (2.0 - leaves).powi(3) / 6.0,
        1e-12,
    );
    assert!(closure(&trajectory) < 1e-12);
    // Resting, it leaves and slip is nowhere.
    let trajectory = run(&scene, state(&[0.0; 3], &[0.0; 3]), 2.0);
    assert_eq!(words(&trajectory), ["table lost"]);
}

/// A block on a ramp that is tilted ever more, to either side; its friction falls with the speed.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(s, n),
    kinetic = (der(s)^2 + der(n)^2) / 2,
    force(weight: (side * gravity * sin(rate * t), -gravity * cos(rate * t)) at (s, n)),
    contact(ramp: n >= 0),
    friction(grip on ramp: slip = der(s), static = mu_kinetic + (mu_static - mu_kinetic) * exp(-abs(slip) / scale)),
)]
struct Tilting {
    side: f64,
    gravity: f64,
    rate: f64,
    mu_static: f64,
    mu_kinetic: f64,
    scale: f64,
}

/// The friction lets go where tan(rate t) is its coefficient. The branch of |slip| changes with it: that the slip begins with the square of the
/// time, its own acceleration being a rounding, both have to know.
#[test]
fn a_slip_that_begins_smoothly_takes_the_branches_of_its_size_with_it() {
    for (method, tolerance) in methods_at(SINGLE_METHODS, TOLERANCES) {
        for k in 0..12 {
            let scene = Tilting {
                side: if k % 2 == 0 { 1.0 } else { -1.0 },
                gravity: 9.81,
                rate: 0.3 + 0.0837 * f64::from(k),
                mu_static: 0.4,
                mu_kinetic: 0.2,
                scale: 0.1,
            };
            let slips = 0.4_f64.atan() / scene.rate;
            let start = state(&[0.0; 2], &[0.0; 2]);
            let motion = run_by(&scene, (method, tolerance), start, 1.3 * slips);
            let asked = format!("{method} {tolerance:e} {scene:?}");
            let error = tolerance.max(1e-11);
            agree(&asked, event(&motion, "grip", "slips").time, slips, error);
            assert_eq!(motion.final_state().v[0].signum(), scene.side, "{asked}");
        }
    }
}
