//! Systems that are not in the library, declared here, each with something independent to compare with.

use lagrange_core::prelude::*;
use lagrange_tests::{agree, closure, event, integral, run, words};

const PI: f64 = core::f64::consts::PI;

fn state(q: &[f64], v: &[f64]) -> State<f64> {
    State {
        q: q.to_vec(),
        v: v.to_vec(),
    }
}

/// A pendulum in Cartesian coordinates.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    constraint(rod: x^2 + y^2 == length^2),
    start(level: x = length),
)]
struct CartesianPendulum {
    mass: f64,
    gravity: f64,
    length: f64,
}

#[test]
fn a_cartesian_pendulum_keeps_its_length_and_meets_jacobi() {
    let scene = CartesianPendulum {
        mass: 0.7,
        gravity: 9.81,
        length: 1.0,
    };
    let trajectory = run(&scene, scene.at(CartesianPendulum::LEVEL), 100.0);
    let end = trajectory.final_state();
    // Jacobi elliptic functions with 32 digits (mpmath); the index-reduced equations amplify errors about a thousand times.
    agree("x", end.q[0], 0.181_513_351_427_031_38, 1e-9);
    agree("y", end.q[1], -0.983_388_480_334_057_5, 1e-9);
    let mut sampler = trajectory.sampler();
    for k in 0..=200 {
        let now = sampler.at(0.5 * f64::from(k)).expect("inside");
        assert!((now.q[0].hypot(now.q[1]) - 1.0).abs() < 1e-12);
        assert!((now.q[0] * now.v[0] + now.q[1] * now.v[1]).abs() < 1e-11);
        // Tension −2λl = m(v²/l − g y/l).
        let speed = now.v[0].powi(2) + now.v[1].powi(2);
        agree(
            "λ",
            -2.0 * now.forces[0],
            0.7 * (speed - 9.81 * now.q[1]),
            1e-9,
        );
    }
    assert!(closure(&trajectory) < 1e-12);
}

/// A block on an incline.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(s, n),
    kinetic = mass/2 * (der(s)^2 + der(n)^2),
    potential = mass * gravity * (n * cos(slope) - s * sin(slope)),
    contact(plane: n >= 0),
    friction(grip on plane: slip = der(s), static = mu),
)]
struct Block {
    mass: f64,
    gravity: f64,
    slope: f64,
    mu: f64,
}

#[test]
fn a_block_on_an_incline_stops_and_stays_or_turns_back() {
    let block = Block {
        mass: 2.0,
        gravity: 9.81,
        slope: 0.4,
        mu: 0.7,
    };
    // tan 0.4 = 0.42 < 0.7: kicked downhill it stops after v²/(2a), a = g(μ cos − sin).
    let deceleration = 9.81 * (0.7 * 0.4_f64.cos() - 0.4_f64.sin());
    let trajectory = run(&block, state(&[0.0; 2], &[3.0, 0.0]), 10.0);
    assert_eq!(words(&trajectory), ["grip sticks"]);
    agree(
        "time",
        trajectory.events()[0].time,
        3.0 / deceleration,
        1e-12,
    );
    agree(
        "way",
        trajectory.final_state().q[0],
        4.5 / deceleration,
        1e-12,
    );
    assert_eq!(trajectory.final_state().v, [0.0, 0.0]);
    // μ = 0.3 < tan: kicked uphill it stops, turns and slides down.
    let block = Block { mu: 0.3, ..block };
    let trajectory = run(&block, state(&[0.0; 2], &[-3.0, 0.0]), 2.0);
    assert_eq!(words(&trajectory), ["grip reverses"]);
    let (up, down) = (
        9.81 * (0.4_f64.sin() + 0.3 * 0.4_f64.cos()),
        9.81 * (0.4_f64.sin() - 0.3 * 0.4_f64.cos()),
    );
    let turn = 3.0 / up;
    agree("turn", trajectory.events()[0].time, turn, 1e-12);
    agree(
        "way",
        trajectory.final_state().q[0],
        -4.5 / up + 0.5 * down * (2.0 - turn).powi(2),
        1e-12,
    );
    assert!(closure(&trajectory) < 1e-12);
    // From rest with μ > tan nothing moves.
    let block = Block { mu: 0.5, ..block };
    let trajectory = run(&block, state(&[0.0; 2], &[0.0; 2]), 5.0);
    assert!(trajectory.events().is_empty());
    assert_eq!(trajectory.final_state().q, [0.0, 0.0]);
}

/// A ball that bounces on the floor while it moves sideways.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    contact(floor: y >= 0, restitution = bounce),
)]
struct Ball {
    mass: f64,
    gravity: f64,
    bounce: f64,
}

#[test]
fn a_bouncing_ball_comes_to_rest_at_the_limit_of_its_impacts() {
    for bounce in [0.3, 0.5, 0.8, 0.9] {
        let ball = Ball {
            mass: 1.0,
            gravity: 9.81,
            bounce,
        };
        let trajectory = run(&ball, state(&[0.0, 1.0], &[0.0, 0.0]), 50.0);
        let fall = (2.0 / 9.81_f64).sqrt();
        let impacts: Vec<f64> = trajectory
            .events()
            .iter()
            .filter(|e| e.kind == EventKind::Impact)
            .map(|e| e.time)
            .collect();
        let mut expected = fall;
        for (k, time) in impacts.iter().take(8).enumerate() {
            agree("impact", *time, expected, 1e-12);
            expected += 2.0 * fall * bounce.powi(k as i32 + 1);
        }
        let limit = fall * (1.0 + bounce) / (1.0 - bounce);
        let rest = event(&trajectory, "floor", "accumulates");
        agree("limit", rest.time, limit, 1e-12);
        assert_eq!(trajectory.final_mode().contacts, [true]);
        assert_eq!(trajectory.final_state().v[1], 0.0);
        assert!(closure(&trajectory) < 1e-10);
    }
}

#[test]
fn a_ball_that_moves_sideways_does_not_come_to_rest_too_early() {
    let ball = Ball {
        mass: 1.0,
        gravity: 9.81,
        bounce: 0.5,
    };
    let trajectory = run(&ball, state(&[0.0, 1.0], &[2.0, 0.0]), 3.0);
    agree("x", trajectory.final_state().q[0], 6.0, 1e-11);
    agree(
        "limit",
        event(&trajectory, "floor", "accumulates").time,
        3.0 * (2.0 / 9.81_f64).sqrt(),
        1e-11,
    );
}

/// A bead on a hoop that is turned about its vertical diameter at a given rate.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, z),
    kinetic = mass/2 * (der(x)^2 + der(y)^2 + der(z)^2),
    potential = mass * gravity * z,
    constraint(sphere: x^2 + y^2 + z^2 == radius^2),
    constraint(plane: x * sin(rate * t) == y * cos(rate * t)),
)]
struct Hoop {
    mass: f64,
    gravity: f64,
    radius: f64,
    rate: f64,
}

/// The same with one coordinate, θ from the bottom.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(theta),
    kinetic = mass/2 * radius^2 * (der(theta)^2 + rate^2 * sin(theta)^2),
    potential = -mass * gravity * radius * cos(theta),
)]
struct ReducedHoop {
    mass: f64,
    gravity: f64,
    radius: f64,
    rate: f64,
}

#[test]
fn a_bead_on_a_turning_hoop_agrees_with_its_one_coordinate() {
    let (mass, gravity, radius, rate) = (0.4, 9.81, 0.8, 5.0);
    let hoop = Hoop {
        mass,
        gravity,
        radius,
        rate,
    };
    let theta: f64 = 0.6;
    let start = state(
        &[radius * theta.sin(), 0.0, -radius * theta.cos()],
        &[0.0, radius * theta.sin() * rate, 0.0],
    );
    let full = run(&hoop, start, 4.0);
    let reduced = run(
        &ReducedHoop {
            mass,
            gravity,
            radius,
            rate,
        },
        state(&[theta], &[0.0]),
        4.0,
    );
    let (q, th) = (&full.final_state().q, reduced.final_state().q[0]);
    agree("z", q[2], -radius * th.cos(), 1e-10);
    agree("x", q[0], radius * th.sin() * (4.0 * rate).cos(), 1e-10);
    // The plane does work; the Jacobi integral of the reduced bead stays.
    assert!(closure(&full) < 1e-10, "{}", closure(&full));
    let ledger = full.ledger().expect("sampled");
    let plane = ledger
        .work
        .iter()
        .find(|e| e.name == "plane")
        .expect("the plane");
    agree(
        "work of the plane",
        plane.work,
        ledger.end.jacobi - ledger.start.jacobi,
        1e-10,
    );
    assert!(closure(&reduced) < 1e-12);
}

/// Two balls on a line, and a wall.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x[3]),
    kinetic = sum(i in 0..3: mass[i]/2 * der(x[i])^2),
    contact(pair[k in 0..2]: x[k+1] - x[k] >= 0, restitution = bounce),
)]
struct Cradle {
    mass: [f64; 3],
    bounce: f64,
}

#[test]
fn three_balls_together_and_two_balls_alone() {
    let cradle = Cradle {
        mass: [1.0; 3],
        bounce: 1.0,
    };
    // The second and third touch: Newton's law for both contacts at once (Glocker 2001).
    let trajectory = run(&cradle, state(&[-1.0, 0.0, 0.0], &[1.0, 0.0, 0.0]), 2.0);
    for (v, expected) in trajectory
        .final_state()
        .v
        .iter()
        .zip([-1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0])
    {
        agree("v", *v, expected, 1e-14);
    }
    // Apart, with different masses and e = 0.4: momentum and the law of restitution.
    let pair = Cradle {
        mass: [2.0, 3.0, 1.0],
        bounce: 0.4,
    };
    let trajectory = run(&pair, state(&[-1.0, 0.0, 50.0], &[1.0, 0.2, 9.0]), 2.0);
    let v = &trajectory.final_state().v;
    agree("momentum", 2.0 * v[0] + 3.0 * v[1], 2.6, 1e-14);
    agree("restitution", v[1] - v[0], 0.4 * 0.8, 1e-14);
    assert_eq!(Cradle::PAIR[1], ContactId(1));
}

/// A chain of n links in ten lines.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(theta[2]),
    define(
        x[k in 0..2] = sum(i in 0..k+1: length[i] * sin(theta[i])),
        y[k in 0..2] = sum(i in 0..k+1: -length[i] * cos(theta[i])),
    ),
    kinetic = sum(k in 0..2: mass[k]/2 * (der(x[k])^2 + der(y[k])^2)),
    potential = sum(k in 0..2: mass[k] * gravity * y[k]),
)]
struct Chain {
    mass: [f64; 2],
    length: [f64; 2],
    gravity: f64,
}

#[test]
fn a_chain_of_two_links_is_the_double_pendulum() {
    let chain = Chain {
        mass: [1.0; 2],
        length: [1.0; 2],
        gravity: 9.81,
    };
    let trajectory = run(&chain, state(&[2.0, 2.5], &[0.0; 2]), 5.0);
    let end = trajectory.final_state();
    // heyoka in multiple precision (170 bits); the motion amplifies errors about 1e4 times.
    agree("θ₀", end.q[0], 8.191_078_459_414_503, 1e-8);
    agree("θ₁", end.q[1], 0.015_016_920_586_249_179, 1e-8);
    agree("ω₀", end.v[0], 2.561_275_215_857_095_5, 1e-8);
    assert!(closure(&trajectory) < 1e-11);
}

/// The Kepler problem.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2)/2,
    potential = -mu / sqrt(x^2 + y^2),
)]
struct Kepler {
    mu: f64,
}

#[test]
fn an_eccentric_orbit_returns() {
    let e: f64 = 0.9;
    let start = state(&[1.0 - e, 0.0], &[0.0, ((1.0 + e) / (1.0 - e)).sqrt()]);
    let trajectory = run(&Kepler { mu: 1.0 }, start.clone(), 10.0 * 2.0 * PI);
    agree("x", trajectory.final_state().q[0], start.q[0], 1e-9);
    agree("y", trajectory.final_state().q[1], 0.0, 1e-8);
}

/// A damped oscillator between two stops made with `max`.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = mass/2 * der(x)^2,
    potential = stiffness/2 * max(abs(x) - clearance, 0)^2,
    dissipation(oil: damping/2 * der(x)^2),
)]
struct Stops {
    mass: f64,
    stiffness: f64,
    clearance: f64,
    damping: f64,
}

#[test]
fn piecewise_forces_are_located() {
    let scene = Stops {
        mass: 1.0,
        stiffness: 400.0,
        clearance: 0.5,
        damping: 0.0,
    };
    let trajectory = run(&scene, state(&[0.0], &[2.0]), 3.0);
    // Free for 0.5/2, half a period π/ω in the stop, free for 1/2, …
    let (free, half) = (0.25, PI / 20.0);
    let times: Vec<f64> = trajectory
        .events()
        .iter()
        .filter(|e| e.kind == EventKind::Branches)
        .map(|e| e.time)
        .collect();
    for expected in [
        free,
        free + half,
        3.0 * free + half,
        3.0 * free + 2.0 * half,
    ] {
        assert!(
            times.iter().any(|t| (t - expected).abs() < 1e-11),
            "{expected} not in {times:?}"
        );
    }
    assert!(closure(&trajectory) < 1e-12);
    // With oil: x and v decay as e^{−ct/m} in the gap.
    let scene = Stops {
        damping: 1.5,
        ..scene
    };
    let trajectory = run(&scene, state(&[0.0], &[0.3]), 2.0);
    agree(
        "v",
        trajectory.final_state().v[0],
        0.3 * (-3.0_f64).exp(),
        1e-12,
    );
    let ledger = trajectory.ledger().expect("sampled");
    agree(
        "oil",
        ledger.work[0].work,
        -0.045 * (1.0 - (-6.0_f64).exp()),
        1e-12,
    );
}

/// A mass on a string: a contact from inside.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    contact(string: length^2 >= x^2 + y^2),
    stop(top: y >= 10),
)]
struct Sling {
    mass: f64,
    gravity: f64,
    length: f64,
}

#[test]
fn a_string_goes_slack_where_the_tension_vanishes() {
    let (gravity, length, speed): (f64, f64, f64) = (9.81, 1.2, 7.0);
    let scene = Sling {
        mass: 1.0,
        gravity,
        length,
    };
    let trajectory = run(&scene, state(&[0.0, -length], &[speed, 0.0]), 1.0);
    let slack = event(&trajectory, "string", "lost");
    // T = m(v² − g y)/l = 0 with v² = v₀² − 2 g (y + l): y = (v₀² − 2 g l)/(3 g).
    agree(
        "height",
        slack.state.q[1],
        (speed * speed - 2.0 * gravity * length) / (3.0 * gravity),
        1e-11,
    );
    let angle = (-slack.state.q[1] / length).acos();
    let rate = |d: f64| (speed * speed - 2.0 * gravity * length * (1.0 - d.cos())).sqrt() / length;
    agree(
        "time",
        slack.time,
        integral(|d| rate(d).recip(), 0.0, angle),
        1e-11,
    );
}

#[test]
fn methods_agree() {
    let chain = Chain {
        mass: [1.0, 0.5],
        length: [1.0, 0.7],
        gravity: 9.81,
    };
    let start = state(&[0.4, -0.3], &[0.0, 1.0]);
    let reference = run(&chain, start.clone(), 2.0);
    for (method, tolerance, accuracy) in [
        ("dop853", 1e-12, 1e-10),
        ("dopri5", 1e-11, 1e-9),
        ("verner98", 1e-12, 1e-10),
        ("rk4:0.0005", 1e-9, 1e-9),
    ] {
        let method: Method = method.parse().expect("a method");
        let run = Simulation::new(&chain)
            .method(method)
            .tolerance(tolerance)
            .run(start.clone(), 0.0..2.0);
        let end = run.expect("smooth");
        for (a, b) in end.final_state().q.iter().zip(&reference.final_state().q) {
            agree(&method.to_string(), *a, *b, accuracy);
        }
    }
}

#[test]
fn methods_agree_through_contacts() {
    use lagrange_problems::scenes::MassOnWheel;
    let scene = MassOnWheel::default();
    for (method, accuracy) in [("dop853", 1e-9), ("verner98", 1e-9), ("dopri5", 1e-8)] {
        let method: Method = method.parse().expect("a method");
        let start = scene.at(<MassOnWheel>::REST);
        let run = Simulation::new(&scene)
            .method(method)
            .tolerance(1e-11)
            .run(start, 0.0..20.0);
        let trajectory = run.unwrap_or_else(|f| panic!("{method}: {f}"));
        assert_eq!(
            words(&trajectory),
            ["grip slips", "rim lost", "floor stop"],
            "{method}"
        );
        agree(
            &format!("{method}: slip"),
            event(&trajectory, "grip", "slips").time,
            2.461_759_150_431_957,
            accuracy,
        );
        agree(
            &format!("{method}: leave"),
            event(&trajectory, "rim", "lost").time,
            2.732_115_771_286_596,
            accuracy,
        );
    }
}
