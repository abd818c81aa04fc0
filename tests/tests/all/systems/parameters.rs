//! One runner through many parameters: numbers that become 0 or ±1 and stop being so, and motions side by side in lanes.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{agree, all_agree};

/// Forces whose terms vanish, or lose a factor, with their parameters.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = m/2 * der(x)^2 + der(y)^2/2,
    force(first: x = a*x + b*y^2 + c*der(y)*x + a*b),
    force(second: y = a/(2 + b*x) - c*sin(y) + b^2*c),
)]
struct Numbers {
    m: f64,
    a: f64,
    b: f64,
    c: f64,
}

impl Numbers {
    fn accelerations(&self, [x, y]: [f64; 2], vy: f64) -> [f64; 2] {
        let Self { m, a, b, c } = *self;
        [
            (a * x + b * y * y + c * vy * x + a * b) / m,
            a / (2.0 + b * x) - c * y.sin() + b * b * c,
        ]
    }
}

/// All numbers after all others, so that each becomes special and plain again.
fn all_numbers() -> Vec<Numbers> {
    let values = [0.7, 0.0, -1.0, 1.0, -0.4];
    let digit = |i: usize, k: u32| values[i / 5_usize.pow(k) % 5];
    let numbers = |i: usize| Numbers {
        m: [1.0, 2.5][i % 2],
        a: digit(i, 0),
        b: digit(i, 1),
        c: digit(i, 2),
    };
    (0..125).map(numbers).collect()
}

#[test]
fn numbers_that_become_zero_or_one_are_taken_as_they_are() {
    let (q, v) = ([0.3, -0.8], [0.2, 0.6]);
    let all = all_numbers();
    let simulation = Simulation::new(&all[0]).tolerance(1e-6);
    let mut runner = simulation.runner();
    for scene in &all {
        runner.set_scene(scene);
        let motion = runner.run(state(&q, &v), 0.0..0.2).expect("a run");
        let mut sampler = motion.sampler();
        for t in [0.0, 0.1, 0.2] {
            let now = sampler.at(t).expect("within");
            let expected = scene.accelerations([now.state.q[0], now.state.q[1]], now.state.v[1]);
            all_agree(format!("{scene:?}"), &now.acceleration, &expected, 1e-14);
        }
        // The series as well, by what they make of the velocities.
        let (one, other) = (sampler.at(0.1), sampler.at(0.1002));
        let (one, other) = (one.expect("within"), other.expect("within"));
        let slopes = [0, 1].map(|i| (other.state.v[i] - one.state.v[i]) / 2e-4);
        let expected = scene.accelerations([one.state.q[0], one.state.q[1]], one.state.v[1]);
        all_agree(format!("{scene:?}"), &slopes, &expected, 1e-3);
    }
}

#[test]
fn motions_in_lanes_are_those_of_runs_alone_at_every_order() {
    let all = all_numbers();
    let start = || state(&[0.3, -0.8], &[0.2, 0.6]);
    let ways = [Equations::Emitted, Equations::Interpreted];
    let tolerances = [0.1, 1e-3, 1e-7, 1e-12];
    for (tolerance, equations) in tolerances.into_iter().flat_map(|t| ways.map(|w| (t, w))) {
        let simulation = |scene| {
            let simulation = Simulation::new(scene).tolerance(tolerance);
            simulation.equations(equations)
        };
        let mut ends = vec![State::default(); all.len()];
        simulation(&all[0]).ensemble().run(
            all.len(),
            0.0..1.0,
            |index, runner| {
                runner.set_scene(&all[index]);
                Some(start())
            },
            |index, outcome, motion| {
                outcome.expect("a run");
                ends[index].clone_from(motion.final_state());
            },
        );
        for (scene, end) in all.iter().zip(&ends) {
            let alone = simulation(scene).run(start(), 0.0..1.0).expect("a run");
            let case = format!("{scene:?} at {tolerance:e}, {equations:?}");
            assert_eq!(end, alone.final_state(), "{case}");
        }
    }
}

/// A drag that is defined to the right of the origin only.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = der(x)^2 / 2,
    force(drag: x = strength * sqrt(x) * der(x)),
)]
struct Half {
    strength: f64,
}

/// The effect is not there where its factor vanishes, also if it was there in the run before.
#[test]
fn a_term_whose_factor_became_zero_does_not_spoil_the_run() {
    let mut runner = Simulation::new(&Half { strength: -0.3 }).runner();
    for strength in [-0.3, 0.0, 0.5, 0.0] {
        runner.set_scene(&Half { strength });
        let outcome = runner.run(state(&[0.5], &[-1.0]), 0.0..2.0);
        match outcome {
            Ok(motion) => {
                assert_eq!(strength, 0.0);
                all_agree("x", &motion.final_state().q, &[-1.5], 1e-14);
            }
            Err(error) => assert_ne!(strength, 0.0, "{error}"),
        }
    }
}

/// A block that is pulled over a floor by a spring: without friction it never rests.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = der(x)^2 / 2,
    potential = stiffness/2 * x^2,
    friction(rub: slip = der(x), normal = weight, static = mu),
    start(pulled: x = 1),
)]
struct Dragged {
    stiffness: f64,
    weight: f64,
    mu: f64,
}

/// Each half swing takes 2 μN/k of the amplitude, until the spring no longer moves the block.
#[test]
fn friction_holds_although_there_was_none_in_the_run_before() {
    let scene = |mu| Dragged {
        stiffness: 4.0,
        weight: 1.0,
        mu,
    };
    let mut runner = Simulation::new(&scene(0.0)).tolerance(1e-12).runner();
    for (mu, rests_at) in [
        (0.0, None),
        (0.3, Some(0.05)),
        (0.0, None),
        (0.5, Some(0.0)),
    ] {
        let scene = scene(mu);
        runner.set_scene(&scene);
        let run = runner
            .run(scene.at(Dragged::PULLED), 0.0..20.0)
            .expect("a run");
        let rests = run.final_mode().sticks(Dragged::RUB);
        assert_eq!(rests, rests_at.is_some(), "mu = {mu}");
        if let Some(place) = rests_at {
            agree(
                "amplitude",
                run.final_state().q(Dragged::X).abs(),
                place,
                1e-10,
            );
        }
    }
}

/// A bead slides down outside a smooth parabola.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    contact(parabola: y >= -x^2 / 2),
    friction(grip on parabola: slip = der(x) - x * der(y), static = mu),
    start(pushed: der(x) = speed),
)]
struct Heavy {
    mass: f64,
    gravity: f64,
    mu: f64,
    speed: f64,
}

/// What a mass cannot change: squares of its weight are no numbers from 1e154 kg on. Faster than v² = g R it leaves the top at once, with a speed below
/// that never, and with friction it comes to rest where the one of 1 kg does.
#[test]
fn motions_do_not_know_their_mass() {
    let run = |mass: f64, mu: f64, speed: f64, method: &str| {
        let scene = Heavy {
            mass,
            gravity: 9.0,
            mu,
            speed,
        };
        let start = scene.at(Heavy::PUSHED);
        let simulation = Simulation::new(&scene).method(method.parse().unwrap());
        let run = simulation.run(start, 0.0..2.0).unwrap();
        let events = run.events().iter();
        let events: Vec<_> = events
            .map(|event| (event.kind, event.time, event.state.q[0]))
            .collect();
        (events, run.final_state().q.clone())
    };
    for method in ["taylor", "dop853", "radau5"] {
        for mass in [1e150, 1e160, 1e300] {
            for (mu, speed) in [(0.0, 3.5), (0.0, 1.0), (0.6, 0.5), (0.3, 2.0)] {
                let what = format!("{mass:e} {mu} {speed} {method}");
                let (events, end) = run(mass, mu, speed, method);
                let (expected, expected_end) = run(1.0, mu, speed, method);
                assert_eq!(
                    events.len(),
                    expected.len(),
                    "{what}: {events:?} {expected:?}"
                );
                for (event, expected) in events.iter().zip(&expected) {
                    assert_eq!(event.0, expected.0, "{what}");
                    agree(&what, event.1, expected.1, 1e-8);
                    agree(&what, event.2, expected.2, 1e-8);
                }
                all_agree(&what, &end, &expected_end, 1e-7);
            }
        }
        // It falls freely from the top.
        let (events, end) = run(1e300, 0.0, 3.5, method);
        assert_eq!(events[0].0, EventKind::Lost);
        all_agree(method, &end, &[7.0, -18.0], 1e-8);
    }
}

/// A crate on a rough floor that is pulled ever harder, in a direction of the plane.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, z),
    kinetic = mass/2 * (der(x)^2 + der(y)^2 + der(z)^2),
    potential = mass * gravity * z,
    contact(floor: z >= 0),
    friction(grip on floor: slip = (der(x), der(y)), static = mu),
    force(pull: (3/5 * mass * rate * t, 4/5 * mass * rate * t, 0) at (x, y, z)),
)]
struct Pulled {
    mass: f64,
    gravity: f64,
    mu: f64,
    rate: f64,
}

/// It slips from t₀ = μ g/rate on, v = rate (t² − t₀²)/2 − μ g (t − t₀).
#[test]
fn cones_of_friction_hold_as_much_of_any_mass() {
    for mass in [1e-250, 1e-200, 1e-150, 1.0, 1e150, 1e200, 1e250] {
        let scene = Pulled {
            mass,
            gravity: 10.0,
            mu: 0.3,
            rate: 2.0,
        };
        let simulation = Simulation::new(&scene).tolerance(1e-12);
        let run = simulation.run(state(&[0.0; 3], &[0.0; 3]), 0.0..4.0);
        let run = run.expect("a run");
        let slips = run.events().first().expect("it slips");
        agree("time", slips.time, 1.5, 1e-12);
        let speed = (16.0 - 2.25) - 3.0 * 2.5;
        let expected = [0.6 * speed, 0.8 * speed, 0.0];
        all_agree(format!("{mass:e}"), &run.final_state().v, &expected, 1e-11);
    }
}

/// A puck of 1 kg that slides on a table, which ends at its rim, after an edge of its own.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, z),
    kinetic = (der(x)^2 + der(y)^2 + der(z)^2) / 2,
    potential = gravity * z,
    contact(table: z >= 0, where x <= rim),
    friction(rub on table: slip = (der(x), der(y)), static = mu),
    start(pushed: der(x) = speed * cos(angle), der(y) = speed * sin(angle)),
)]
struct Puck {
    gravity: f64,
    rim: f64,
    mu: f64,
    speed: f64,
    angle: f64,
}

/// Friction takes μ g from the speed, whatever it was in the run before, and the puck leaves the table at the time at which it is at the rim, also
/// where the run before ended there.
#[test]
fn runs_do_not_know_how_the_one_before_them_ended() {
    let scene = |[mu, speed]: [f64; 2]| Puck {
        gravity: 9.81,
        rim: 1.0,
        mu,
        speed,
        angle: 0.4,
    };
    let first = scene([0.0, 1.0]);
    let exact = || Simulation::new(&first).tolerance(1e-12);
    let mut leaves = exact().end_after(Puck::TABLE).runner();
    let mut slides = exact().runner();
    for numbers in [
        [0.0, 3.0],
        [0.2, 4.0],
        [0.0, 2.5],
        [0.1, 3.5],
        [0.3, 5.0],
        [0.0, 7.0],
        [0.2, 3.0],
    ] {
        let [mu, speed] = numbers;
        let what = format!("mu = {mu}, speed {speed}");
        let scene = scene(numbers);
        // s = v t − μ g t²/2.
        let (brake, way) = (mu * scene.gravity, scene.rim / scene.angle.cos());
        let at_rim = 2.0 * way / (speed + (speed * speed - 2.0 * brake * way).sqrt());
        leaves.set_scene(&scene);
        let run = leaves.run(scene.at(Puck::PUSHED), 0.0..5.0).expect(&what);
        agree(&what, run.last_time(), at_rim, 1e-11);
        slides.set_scene(&scene);
        let half = 0.5 * at_rim;
        let run = slides.run(scene.at(Puck::PUSHED), 0.0..half).expect(&what);
        let way = speed * half - brake * half * half / 2.0;
        agree(
            &what,
            run.final_state().q(Puck::X),
            way * scene.angle.cos(),
            1e-11,
        );
    }
}
