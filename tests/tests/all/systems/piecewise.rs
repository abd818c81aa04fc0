//! Forces with `abs`, `max`, `sign` and `if`: their switching is located.

use super::{PI, state};
use lagrange_core::prelude::*;
use lagrange_tests::{
    Random, TOLERANCES, agree, all_agree, certified, closure, methods_at, run, run_by, times,
};

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

/// A mass between constant forces that turn with its side, said in four ways.
macro_rules! relay {
    ($name:ident $($energy:tt)*) => {
        #[derive(Lagrangian, Clone, Debug)]
        #[lagrange(
            coordinates(x),
            kinetic = mass/2 * der(x)^2,
            $($energy)*
        )]
        struct $name {
            mass: f64,
            force: f64,
        }
    };
}

relay!(Absolute potential = force * abs(x),);
relay!(Largest potential = force * max(x, -x),);
relay!(Smallest potential = -force * min(x, -x),);
relay!(Signed force(relay: x = -force * sign(x)),);
relay!(Chosen force(relay: x = if(x >= 0, -force, force)),);

/// Four falls of √(2 m x₀/F) make a period.
fn check_relay<S: Derived<Scalar = f64>>(scene: &S) {
    let name = S::DESCRIPTION.name;
    let quarter = (2.0 * 2.0 * 0.7 / 3.0_f64).sqrt();
    let trajectory = run(scene, state(&[0.7], &[0.0]), 20.5 * quarter);
    let branches = trajectory.events().iter();
    let times: Vec<f64> = branches
        .filter(|e| e.kind == EventKind::Branches)
        .map(|e| e.time)
        .collect();
    assert_eq!(times.len(), 10, "{name}: {times:?}");
    for (k, time) in times.iter().enumerate() {
        agree(name, *time, (2 * k + 1) as f64 * quarter, 1e-11);
    }
    // Half of a quarter from rest: a quarter of the way.
    agree(name, trajectory.final_state().q[0], 0.75 * 0.7, 1e-11);
    assert!(closure(&trajectory) < 1e-11, "{name}");
}

#[test]
fn a_relay_said_in_five_ways_has_one_period() {
    let (mass, force) = (2.0, 3.0);
    check_relay(&Absolute { mass, force });
    check_relay(&Largest { mass, force });
    check_relay(&Smallest { mass, force });
    check_relay(&Signed { mass, force });
    check_relay(&Chosen { mass, force });
}

/// A spring that is softer to one side.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = mass/2 * der(x)^2,
    potential = if(x >= 0, hard, soft)/2 * x^2,
)]
struct Bilinear {
    mass: f64,
    hard: f64,
    soft: f64,
}

#[test]
fn half_periods_of_a_bilinear_spring_add_up() {
    let scene = Bilinear {
        mass: 1.0,
        hard: 100.0,
        soft: 4.0,
    };
    let period = PI / 10.0 + PI / 2.0;
    let trajectory = run(&scene, state(&[0.1], &[0.0]), 4.0 * period);
    agree("x", trajectory.final_state().q[0], 0.1, 1e-11);
    agree("v", trajectory.final_state().v[0], 0.0, 1e-10);
    let mut sampler = trajectory.sampler();
    let far = sampler.at(0.5 * period).expect("inside");
    agree("on the soft side", far.state.q[0], -0.1 * 10.0 / 2.0, 1e-11);
}

/// Dry friction written with `sign`: it would have to switch infinitely fast.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = mass/2 * der(x)^2,
    force(brake: x = -force * sign(der(x))),
)]
struct Chattering {
    mass: f64,
    force: f64,
}

#[test]
fn a_sign_that_would_chatter_is_a_typed_error_at_its_time() {
    let scene = Chattering {
        mass: 2.0,
        force: 3.0,
    };
    let failure = Simulation::new(&scene)
        .tolerance(1e-12)
        .run(state(&[0.0], &[1.5]), 0.0..5.0)
        .expect_err("it cannot stop");
    agree("until", failure.trajectory.last_time(), 1.0, 1e-12);
    agree("x", failure.trajectory.final_state().q[0], 0.75, 1e-12);
    let said = failure.to_string();
    assert!(said.contains("friction"), "{said}");
}

/// A mass that falls; what is observed has sides, what moves has none.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = der(x)^2/2,
    potential = -pull * x,
    observe(
        speed = if(der(x) >= 1, 1, 2),
        leader = max(x, t/4),
        pressed = if(if(der(der(x)) >= pull/2, x, 0) >= 1/10, 3, 4),
    ),
)]
struct Falling {
    pull: f64,
}

#[test]
fn outputs_are_on_the_side_of_the_state() {
    let scene = Falling { pull: 10.0 };
    let trajectory = run(&scene, state(&[0.0], &[0.0]), 0.5);
    assert!(trajectory.events().is_empty());
    let mut sampler = trajectory.sampler();
    for k in 0..50 {
        let t = 0.003 + 0.01 * f64::from(k);
        let now = sampler.at(t).expect("a time of the run");
        let x = 5.0 * t * t;
        let speed = if 10.0 * t >= 1.0 { 1.0 } else { 2.0 };
        let pressed = if x >= 0.1 { 3.0 } else { 4.0 };
        agree("speed", now.observe(Falling::SPEED), speed, 0.0);
        agree(
            "leader",
            now.observe(Falling::LEADER),
            x.max(t / 4.0),
            1e-12,
        );
        agree("pressed", now.observe(Falling::PRESSED), pressed, 0.0);
    }
}

/// A push that is chosen twice, from a number that jumps.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, z),
    define(g = if(t <= 1/2, up, -down)),
    kinetic = (der(x)^2 + der(y)^2 + der(z)^2) / 2,
    force(largest: x = max(least, g, 0)),
    force(smallest: y = min(-least, -g, 0)),
    force(both: z = abs(max(least, g) - least/2)),
)]
struct Nested {
    least: f64,
    up: f64,
    down: f64,
}

/// An inner choice decides on the outer one; both come up where the number jumps.
#[test]
fn choices_within_choices_follow_a_jump() {
    let mut random = Random::new(50);
    for _ in 0..20 {
        let least = random.between(0.1, 0.4);
        let chosen = Nested {
            least,
            up: least + random.between(0.2, 1.0),
            down: random.between(0.1, 2.0),
        };
        for method in ["auto", "dop853", "verner98", "radau5"] {
            let motion = run_by(&chosen, (method, 1e-9), state(&[0.0; 3], &[0.0; 3]), 1.0);
            let what = format!("{chosen:?} by {method}");
            // Half a second with the first push, then half a second with the second.
            let gone = |first: f64, second: f64| 3.0 / 8.0 * first + second / 8.0;
            let push = gone(chosen.up, least);
            let expected = [push, -push, gone(chosen.up - least / 2.0, least / 2.0)];
            all_agree(&what, &motion.final_state().q, &expected, 1e-8);
            certified(&what, &motion);
        }
    }
}

/// Marks on a side of which others have a kink.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = der(x)^2 / 2,
    potential = x,
    mark(passes: (x - edge) * (t - 9)),
    mark(beyond: x >= edge and der(x) <= 0),
    mark(bent: max(x, edge) - edge - 0.01),
    start(thrown: der(x) = 1),
)]
struct Kinks {
    edge: f64,
}

/// x = t − t²/2 passes the edge twice, and beyond becomes true at the top alone.
#[test]
fn a_kink_where_another_mark_passes_zero_hides_nothing() {
    let mut random = Random::new(51);
    for _ in 0..40 {
        let kinks = Kinks {
            edge: random.between(0.02, 0.45),
        };
        let root = |height: f64| (1.0 - 2.0 * height).sqrt();
        for method in ["auto", "dop853", "verner98", "radau5"] {
            let motion = run_by(&kinks, (method, 1e-9), kinks.at(Kinks::THROWN), 2.2);
            let what = format!("{kinks:?} by {method}");
            let (edge, bent) = (root(kinks.edge), root(kinks.edge + 0.01));
            for (mark, expected) in [
                ("passes", vec![1.0 - edge, 1.0 + edge]),
                ("beyond", vec![1.0]),
                ("bent", vec![1.0 - bent, 1.0 + bent]),
            ] {
                let times = times(&motion, mark, "mark");
                assert_eq!(times.len(), expected.len(), "{what} {mark}: {times:?}");
                all_agree(&what, &times, &expected, 1e-7);
            }
        }
    }
}

/// Marks and a stop on what is 1 or −1.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = der(x)^2 / 2,
    mark(there: sign(x - edge) >= 0),
    mark(late: if(t >= 2*edge, 1, -1) >= 0),
    stop(beyond: if(x >= 3*edge, 1, -1) >= 0),
    start(go: der(x) = 1),
)]
struct Signs {
    edge: f64,
}

#[test]
fn what_has_one_of_two_values_becomes_true_where_it_jumps() {
    let signs = Signs { edge: 0.23 };
    for method in ["auto", "dop853", "radau5"] {
        let motion = run_by(&signs, (method, 1e-9), signs.at(Signs::GO), 1.0);
        let events = motion.events().iter();
        let watched = events.filter(|e| matches!(e.kind, EventKind::Mark | EventKind::Stop));
        let found: Vec<f64> = watched.map(|event| event.time).collect();
        all_agree(method, &found, &[0.23, 0.46, 0.69], 1e-9);
    }
}

/// A seat belt in a car that moves: a mass at its stop, in front of a spring that pushes one way, and across a brake that holds.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(u, w),
    define(x = u + sway * sin(0.6*t + 0.5), y = w + sway * sin(0.6*t)),
    kinetic = mass/2 * der(x)^2 + der(y)^2/2,
    potential = stiff/2 * max(x - 3/100*y, 0)^2,
    force(inert: if(t <= 0.1, 0, push) along der(x)),
    friction(lock: slip = der(y), limit = 50000),
    contact(seat: x >= 0),
    start(sits: u = -sway * sin(1/2), der(u) = -sway * 0.6 * cos(1/2), der(w) = -sway * 0.6),
)]
struct Belt {
    sway: f64,
    mass: f64,
    stiff: f64,
    push: f64,
}

/// Squares of rounding in its kinetic energy are no kick; then x = (F/k)(1 − cos ωt).
#[test]
fn rounding_of_a_frame_that_moves_is_no_kick() {
    for (sway, mass, stiff) in [(1.2, 70.0, 3e4), (0.7, 50.0, 2e4), (2.0, 80.0, 5e4)] {
        let belt = Belt {
            sway,
            mass,
            stiff,
            push: 100.0,
        };
        let frequency = (stiff / mass).sqrt();
        let x = belt.push / stiff * (1.0 - (frequency * 0.2).cos());
        for (method, tolerance) in methods_at([Method::Auto], TOLERANCES) {
            let motion = run_by(&belt, (method, tolerance), belt.at(Belt::SITS), 0.3);
            let found = motion.final_state().q[0] + sway * (0.6_f64 * 0.3 + 0.5).sin();
            let what = format!("{belt:?} by {method} at {tolerance:e}");
            agree(&what, found, x, 10.0 * tolerance);
        }
    }
}
