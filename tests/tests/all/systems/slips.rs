//! Slips of two components in company: a belt that carries, a plane that pulls and pushes, blocks on blocks, given normal forces.

use super::state;
use core::f64::consts::PI;
use lagrange_core::mode::FrictionMode;
use lagrange_core::prelude::*;
use lagrange_tests::{Random, agree, all_agree, closure, event, integral, run, words};

/// A block on a belt that runs along x, held by springs in both directions.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, z),
    kinetic = mass/2 * (der(x)^2 + der(y)^2 + der(z)^2),
    potential = mass * gravity * z + stiffness/2 * (x^2 + y^2),
    contact(belt: z >= 0),
    friction(grip on belt: slip = (der(x) - speed, der(y)), static = mu_static, kinetic = mu_kinetic),
)]
struct Belt {
    mass: f64,
    gravity: f64,
    stiffness: f64,
    speed: f64,
    mu_static: f64,
    mu_kinetic: f64,
}

const BELT: Belt = Belt {
    mass: 1.5,
    gravity: 9.81,
    stiffness: 40.0,
    speed: 0.2,
    mu_static: 0.5,
    mu_kinetic: 0.3,
};

/// Along the belt it sticks and slips as with one component, for hundreds of cycles.
#[test]
fn stick_and_slip_along_the_belt() {
    const CYCLES: usize = 100;
    let b = BELT;
    let weight = b.mass * b.gravity;
    let (high, middle) = (
        b.mu_static * weight / b.stiffness,
        b.mu_kinetic * weight / b.stiffness,
    );
    let omega = (b.stiffness / b.mass).sqrt();
    let slide = 2.0 * (PI - (omega * (high - middle) / b.speed).atan()) / omega;
    let period = slide + 2.0 * (high - middle) / b.speed;
    let trajectory = run(
        &b,
        state(&[0.0; 3], &[0.2, 0.0, 0.0]),
        CYCLES as f64 * period + high / b.speed + 0.1,
    );
    let slips: Vec<f64> = trajectory
        .events()
        .iter()
        .filter(|e| e.kind == EventKind::Slips)
        .map(|e| e.time)
        .collect();
    assert_eq!(slips.len(), CYCLES + 1);
    agree("first", slips[0], high / b.speed, 1e-12);
    agree(
        "period",
        (slips[CYCLES] - slips[0]) / CYCLES as f64,
        period,
        1e-12,
    );
    assert!(closure(&trajectory) < 1e-10, "{}", closure(&trajectory));
    println!("{:?}", trajectory.work());
    agree("across", trajectory.final_state().q[1], 0.0, 1e-12);
}

/// Off the line it is caught and let go in ever other directions; methods and tolerances agree.
#[test]
fn stick_and_slip_across_the_belt() {
    let start = || state(&[0.1, 0.15, 0.0], &[0.0, 0.4, 0.0]);
    let trajectory = run(&BELT, start(), 10.0);
    println!("{:?} {:?}", words(&trajectory), trajectory.work());
    assert!(words(&trajectory).len() > 5);
    assert!(closure(&trajectory) < 1e-10, "{}", closure(&trajectory));
    let end = trajectory.final_state();
    for (method, tolerance, bound) in [
        ("taylor", 1e-10, 1e-7),
        ("taylor", 1e-13, 1e-9),
        ("taylor", 1e-14, 1e-9),
        ("dop853", 1e-12, 1e-8),
        ("verner98", 1e-12, 1e-8),
        ("radau5", 1e-10, 1e-6),
    ] {
        let simulation = Simulation::new(&BELT)
            .tolerance(tolerance)
            .method(method.parse().expect("a method"));
        let other = simulation
            .run(start(), 0.0..10.0)
            .unwrap_or_else(|e| panic!("{method}: {e}"));
        assert_eq!(words(&trajectory), words(&other), "{method}");
        println!(
            "{method} {tolerance} {:e}",
            end.q[0] - other.final_state().q[0]
        );
        all_agree(method, &end.q, &other.final_state().q, bound);
    }
}

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
    // The same with a force that turns.
    let turning = Blocks {
        turn: 1.0,
        ..BLOCKS
    };
    let start = || state(&[0.0; 6], &[0.0; 6]);
    let trajectory = run(&turning, start(), 6.0);
    println!(
        "{:?} {:?} {:e}",
        words(&trajectory),
        trajectory.work(),
        closure(&trajectory)
    );
    assert!(closure(&trajectory) < 1e-11);
    let other = Simulation::new(&turning)
        .tolerance(1e-11)
        .method("dop853".parse().expect("a method"))
        .run(start(), 0.0..6.0)
        .expect("it runs");
    all_agree(
        "dop853",
        &trajectory.final_state().q,
        &other.final_state().q,
        1e-9,
    );
    // Thrown crosswise: two slips, each turning the other.
    let start = || state(&[0.0; 6], &[1.0, 0.0, 0.0, 0.0, 2.0, 0.0]);
    let thrown = Blocks {
        force: 0.0,
        ..BLOCKS
    };
    let trajectory = run(&thrown, start(), 6.0);
    println!(
        "{:?} {:?} {:e}",
        words(&trajectory),
        trajectory.work(),
        closure(&trajectory)
    );
    all_agree("rest", &trajectory.final_state().v, &[0.0; 6], 1e-15);
    assert!(closure(&trajectory) < 1e-11);
    let other = Simulation::new(&thrown)
        .tolerance(1e-11)
        .method("dop853".parse().expect("a method"))
        .run(start(), 0.0..6.0)
        .expect("it runs");
    all_agree(
        "dop853",
        &trajectory.final_state().q,
        &other.final_state().q,
        1e-9,
    );
}

/// A puck pressed onto a table by a force that depends on place and time; friction that depends on speed.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    friction(pressed: slip = (der(x), der(y)), normal = press * (1 + x), static = mu),
)]
struct Pressed {
    mass: f64,
    press: f64,
    mu: f64,
}

/// v v′ = −(μ p/m)(1 + x u) along the line x = u ξ.
#[test]
fn a_given_normal_force() {
    let scene = Pressed {
        mass: 0.5,
        press: 2.0,
        mu: 0.3,
    };
    let (v0, u) = (1.1, [0.8, 0.6]);
    let trajectory = run(&scene, state(&[0.0; 2], &u.map(|u| u * v0)), 5.0);
    assert_eq!(words(&trajectory), ["pressed sticks"]);
    let k = scene.mu * scene.press / scene.mass;
    // ξ + u ξ²/2 = v₀²/(2 k)
    let way = ((1.0 + u[0] * v0 * v0 / k).sqrt() - 1.0) / u[0];
    all_agree(
        "place",
        &trajectory.final_state().q,
        &u.map(|u| u * way),
        1e-12,
    );
    let omega = (k * u[0]).sqrt();
    // ξ + 1/u oscillates with ω.
    let time = (omega * v0 / k).atan() / omega;
    agree(
        "time",
        event(&trajectory, "pressed", "sticks").time,
        time,
        1e-12,
    );
    assert!(closure(&trajectory) < 1e-12);
}

/// A puck on a level table, pushed so that its slip is known: with s = ρ(t) u(t), u = (cos ω t, sin ω t), the push is
/// m (ρ̇ + μk g) u + m ρ ω u⊥.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    define(
        rho = jump * t + growth * t^2 / 2,
        forward = mass * (jump + growth * t + mu_kinetic * gravity),
        sideways = mass * rho * turn,
        c = cos(turn * t),
        s = sin(turn * t),
    ),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    friction(grip: slip = (der(x), der(y)), normal = mass * gravity, static = mu_static, kinetic = mu_kinetic),
    force(push: (forward * c - sideways * s, forward * s + sideways * c) at (x, y)),
)]
struct Pushed {
    mass: f64,
    gravity: f64,
    jump: f64,
    growth: f64,
    turn: f64,
    mu_static: f64,
    mu_kinetic: f64,
}

/// Slip that begins with a jump of its acceleration, smoothly, or in between; turning slowly, fast, and very fast.
#[test]
fn a_slip_begins_and_turns() {
    for (jump, growth) in [
        (1.0, 0.3),
        (0.0, 0.8),
        (1e-3, 0.5),
        (1e-6, 0.5),
        (0.0, 1e-3),
    ] {
        for turn in [0.5, 5.0, 40.0] {
            let mu_kinetic = 0.3;
            let mut scene = Pushed {
                mass: 0.7,
                gravity: 9.81,
                jump,
                growth,
                turn,
                mu_static: mu_kinetic + 0.5 * jump / 9.81,
                mu_kinetic,
            };
            if jump == 0.0 {
                scene.mu_static = mu_kinetic;
            }
            let until = 2.0;
            let trajectory = run(&scene, state(&[0.0; 2], &[0.0; 2]), until);
            assert_eq!(words(&trajectory), ["grip slips"], "{jump} {growth} {turn}");
            let rho = |t: f64| jump * t + 0.5 * growth * t * t;
            let end = trajectory.final_state();
            let (s, c) = (turn * until).sin_cos();
            let errors = [end.v[0] - rho(until) * c, end.v[1] - rho(until) * s];
            println!("{jump} {growth} {turn} {errors:?} {:?}", trajectory.work());
            all_agree("velocity", &end.v, &[rho(until) * c, rho(until) * s], 1e-11);
            let place = [
                integral(|t| rho(t) * (turn * t).cos(), 0.0, until),
                integral(|t| rho(t) * (turn * t).sin(), 0.0, until),
            ];
            all_agree("place", &end.q, &place, 1e-11);
            let after = &trajectory.events()[0].forces_after;
            all_agree("friction at first", after, &[-0.3 * 0.7 * 9.81, 0.0], 1e-9);
            assert!(closure(&trajectory) < 1e-10);
        }
    }
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

/// Friction with limits in newtons, and with coefficients that depend on speed and place.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    define(speed = sqrt(der(x)^2 + der(y)^2 + small^2)),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = stiffness/2 * (x^2 + y^2),
    friction(seal: slip = (der(x), der(y)), limit = (high, low + (high - low) / (1 + (speed / stribeck)^2))),
)]
struct Seal {
    mass: f64,
    stiffness: f64,
    small: f64,
    high: f64,
    low: f64,
    stribeck: f64,
}

#[test]
fn limits_and_coefficients_that_depend_on_the_state() {
    let flat = Seal {
        mass: 1.0,
        stiffness: 9.0,
        small: 1e-3,
        high: 0.5,
        low: 0.5,
        stribeck: 0.2,
    };
    // Along a line: half swings lose 2 F/k each.
    let along = [0.6, 0.8];
    let trajectory = run(&flat, state(&along.map(|u| 0.5 * u), &[0.0; 2]), 20.0);
    assert_eq!(
        words(&trajectory),
        [
            "seal slips",
            "seal reverses",
            "seal reverses",
            "seal reverses",
            "seal sticks"
        ]
    );
    let last = trajectory.final_state();
    let place = 0.5 - 8.0 * 0.5 / 9.0;
    all_agree("rests", &last.q, &along.map(|u| u * place), 1e-11);
    // Off the line, with friction that falls with speed.
    let falling = Seal { low: 0.2, ..flat };
    let start = || state(&[0.6, 0.0], &[0.0, 1.0]);
    let trajectory = run(&falling, start(), 20.0);
    println!(
        "{:?} {:?} {}",
        words(&trajectory),
        trajectory.work(),
        closure(&trajectory)
    );
    assert!(closure(&trajectory) < 1e-11);
    let other = Simulation::new(&falling)
        .tolerance(1e-11)
        .method("dop853".parse().expect("a method"));
    let other = other.run(start(), 0.0..20.0).expect("it runs");
    all_agree(
        "dop853",
        &trajectory.final_state().q,
        &other.final_state().q,
        1e-9,
    );
}

/// Blocks on belts of any direction, at random: friction stays in its cone and against the slip, the ledger closes.
#[test]
fn blocks_on_belts_at_random() {
    let mut random = Random::new(5);
    for run_number in 0..40 {
        let low = random.between(0.05, 0.6);
        let belt = Belt {
            mass: random.between(0.2, 3.0),
            gravity: 9.81,
            stiffness: random.between(1.0, 60.0),
            speed: if run_number % 5 == 0 {
                0.0
            } else {
                random.between(0.05, 1.0)
            },
            mu_static: low
                * if run_number % 3 == 0 {
                    1.0
                } else {
                    random.between(1.0, 2.0)
                },
            mu_kinetic: low,
        };
        let mut four = || random.between(-0.8, 0.8);
        let at_rest = run_number % 4 == 0;
        let v = if at_rest {
            [belt.speed, 0.0, 0.0]
        } else {
            [four(), four(), 0.0]
        };
        let start = state(&[four(), four(), 0.0], &v);
        let trajectory = run(&belt, start, 10.0);
        let ledger = trajectory.ledger().expect("recorded");
        assert!(
            ledger.closure.abs() < 1e-10 * ledger.scale.max(1.0),
            "{run_number}: {}",
            ledger.closure
        );
        let weight = belt.mass * belt.gravity;
        let mut sampler = trajectory.sampler();
        for k in 0..200 {
            let now = sampler.at(0.05 * f64::from(k)).expect("in the run");
            let force = [now.forces[1], now.forces[2]];
            let size = force[0].hypot(force[1]);
            if now.mode.frictions[0] == FrictionMode::Stick {
                assert!(
                    size <= belt.mu_static * weight * (1.0 + 1e-10),
                    "{run_number}"
                );
                assert!(now.slips[0].hypot(now.slips[1]) < 1e-14);
            } else {
                agree("size", size, belt.mu_kinetic * weight, 1e-12);
                let along = force[0] * now.slips[0] + force[1] * now.slips[1];
                let slip = now.slips[0].hypot(now.slips[1]);
                assert!(
                    along <= -size * slip * (1.0 - 1e-9),
                    "{run_number} {along} {slip}"
                );
            }
        }
    }
}
