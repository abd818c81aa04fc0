//! What sticks or rolls passes from one contact to the next, and does so there: what the run has left of its slip is none.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, Random, TOLERANCES, agree, certified, methods_at, run_by, times};

/// A parcel on two belts of one speed. It would slide if it ever slipped: what holds is more than what rubs.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, z),
    define(speed = mean + swing*sin(rate*t + phase)),
    kinetic = (der(x)^2 + der(y)^2 + der(z)^2)/2,
    potential = 9.81*z,
    contact(first: z >= 0, where x <= seam + overlap),
    contact(second: z >= 0, where x >= seam),
    friction(of_first on first: slip = (der(x) - speed, der(y)), static = 0.6, kinetic = 0.1),
    friction(of_second on second: slip = (der(x) - speed, der(y)), static = 0.6, kinetic = 0.1),
)]
struct Belts {
    mean: f64,
    swing: f64,
    rate: f64,
    phase: f64,
    seam: f64,
    overlap: f64,
}

#[test]
fn a_parcel_rides_from_one_belt_to_the_next() {
    let mut random = Random::new(21);
    for case in 0..20 {
        let rate = random.between(1.0, 3.0);
        let scene = Belts {
            mean: 2.0,
            swing: random.between(0.5, 1.5),
            rate,
            phase: random.between(-3.0, 3.0),
            seam: random.between(0.5, 2.0),
            overlap: [0.0, 0.2][case % 2],
        };
        let place = |t: f64| {
            let turned = scene.phase.cos() - (rate * t + scene.phase).cos();
            scene.mean * t + scene.swing / rate * turned
        };
        let start = state(
            &[0.0; 3],
            &[scene.mean + scene.swing * scene.phase.sin(), 0.0, 0.0],
        );
        for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
            let what = format!("{case}: {scene:?} by {method} at {tolerance:e}");
            let run = run_by(&scene, (method, tolerance), start.clone(), 2.0);
            for friction in ["of_first", "of_second"] {
                assert!(times(&run, friction, "slips").is_empty(), "{what}");
            }
            assert_eq!(times(&run, "second", "closed").len(), 1, "{what}");
            agree(&what, run.final_state().q[0], place(2.0), 20.0 * tolerance);
            certified(&what, &run);
        }
    }
}

/// A part of a cylinder, whose arc ends at an edge, rolls onto that edge and tips on.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, turn),
    define(centre = [x + off*sin(turn), y + off*cos(turn)], tip = turn - end),
    kinetic = (der(x)^2 + der(y)^2)/2 + inertia/2*der(turn)^2,
    potential = 9.81*y,
    contact(arc: centre[1] >= 1, where turn <= end),
    contact(edge: centre[1] >= cos(tip), where turn >= end),
    friction(of_arc on arc: slip = der(centre[0]) - der(turn), static = 0.6, kinetic = 0.05),
    friction(of_edge on edge: slip = der(centre[0] - sin(tip)), static = 0.6, kinetic = 0.05),
)]
struct Rocker {
    off: f64,
    inertia: f64,
    end: f64,
}

#[test]
fn a_rocker_rolls_onto_its_edge() {
    let mut random = Random::new(22);
    for case in 0..10 {
        let scene = Rocker {
            off: random.between(0.2, 0.4),
            inertia: random.between(0.05, 0.2),
            end: random.between(0.4, 0.7),
        };
        let rate = random.between(2.4, 3.0);
        let start = state(
            &[0.0, 1.0 - scene.off, 0.0],
            &[rate * (1.0 - scene.off), 0.0, rate],
        );
        for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
            let what = format!("{case}: {scene:?} {rate} by {method} at {tolerance:e}");
            let run = run_by(&scene, (method, tolerance), start.clone(), 0.35);
            // It rolls on, without work of friction, and its point of support is where rolling without slip puts it.
            for friction in ["of_arc", "of_edge"] {
                assert!(times(&run, friction, "slips").is_empty(), "{what}");
            }
            let State { q, .. } = run.final_state();
            let [x, turn] = [q[0], q[2]];
            if turn > scene.end + 0.01 {
                assert_eq!(times(&run, "edge", "closed").len(), 1, "{what}");
                let support = x + scene.off * turn.sin() - (turn - scene.end).sin();
                agree(&what, support, scene.end, 100.0 * tolerance);
            }
            let energy = |State { q, v, .. }: &State<f64>| {
                let speed = v[0] * v[0] + v[1] * v[1];
                (speed + scene.inertia * v[2] * v[2]) / 2.0 + 9.81 * q[1]
            };
            let [before, after] = [&start, run.final_state()].map(energy);
            agree(&what, after, before, 100.0 * tolerance);
            certified(&what, &run);
        }
    }
}

/// A pendulum whose string lays itself round a peg: both strings are taut there.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y),
    define(
        bob = [x - origin, y],
        peg = [depth*sin(lean), -depth*cos(lean)],
        side = bob[0]*cos(lean) + bob[1]*sin(lean),
    ),
    kinetic = (der(x)^2 + der(y)^2)/2,
    potential = gravity*y,
    contact(long: norm(bob) <= length, where side <= 0),
    contact(short: norm(bob - peg) <= length - depth, where side >= 0),
)]
struct Peg {
    length: f64,
    depth: f64,
    lean: f64,
    gravity: f64,
    origin: f64,
}

/// A pendulum of a millimetre's unit, of a metre's, and one that is counted from afar: its string never goes slack, and its energy is kept.
#[test]
fn a_string_lays_itself_round_a_peg() {
    let mut random = Random::new(23);
    for case in 0..12 {
        let (length, origin) = [(1.0, 0.0), (1000.0, 0.0), (1.0, 1000.0)][case % 3];
        let scene = Peg {
            length,
            depth: length * random.between(0.1, 0.45),
            lean: random.between(0.0, 0.5),
            gravity: 9.81 * length,
            origin,
        };
        let from = random.between(0.7, 1.1);
        let start = [origin - length * from.sin(), -length * from.cos()];
        let mut settings: Vec<(Method, f64)> = methods_at(METHODS, TOLERANCES).collect();
        settings.push((Method::Auto, 1e-13));
        for (method, tolerance) in settings {
            let what = format!("{case}: {scene:?} from {from} by {method} at {tolerance:e}");
            let run = run_by(&scene, (method, tolerance), state(&start, &[0.0; 2]), 2.5);
            let last = run.final_state();
            let [x, y] = [last.q[0] - origin, last.q[1]];
            let peg = [
                scene.depth * scene.lean.sin(),
                -scene.depth * scene.lean.cos(),
            ];
            let taut = match x * scene.lean.cos() + y * scene.lean.sin() <= 0.0 {
                true => x.hypot(y),
                false => (x - peg[0]).hypot(y - peg[1]) + scene.depth,
            };
            let error = (1e3 * tolerance).max(1e-11 * origin);
            agree(&what, taut / length, 1.0, error);
            let speed = (last.v[0] * last.v[0] + last.v[1] * last.v[1]) / 2.0;
            let fallen = scene.gravity * (start[1] - y);
            agree(
                &what,
                speed / length.powi(2),
                fallen / length.powi(2),
                error,
            );
        }
    }
}

/// A mass on a lift that sinks away from an instant on, at which another one has come up.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(y),
    kinetic = mass/2*der(y)^2,
    potential = mass*9.81*y,
    contact(first: y >= -steep*max(t - meet, 0)^3),
    contact(second: y >= -steep*max(meet - t, 0)^3),
)]
struct Lifts {
    mass: f64,
    steep: f64,
    meet: f64,
}

/// Both carry it for no longer than that instant, at which nothing but their third derivatives tells them apart.
#[test]
fn a_lift_hands_its_load_over() {
    for (mass, steep, meet) in [(1.0, 1.0, 1.71), (2.0, 0.3, 0.9), (0.5, 2.5, 1.4)] {
        let scene = Lifts { mass, steep, meet };
        for tolerance in TOLERANCES {
            let what = format!("{scene:?} at {tolerance:e}");
            let run = run_by(&scene, ("auto", tolerance), state(&[0.0], &[0.0]), 3.0);
            let end = run.sampler().at(3.0).expect("the end");
            agree(&what, end.force(Lifts::SECOND), 9.81 * mass, 1e-9);
            agree(&what, end.force(Lifts::FIRST), 0.0, 0.0);
            agree(&what, run.final_state().q[0], 0.0, 10.0 * tolerance);
            certified(&what, &run);
        }
    }
}

/// A block that sticks to a moving lift, and then to another one of the same speed; slips have two components.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, z),
    kinetic = (der(x)^2 + der(y)^2 + der(z)^2)/2,
    potential = 9.81*y,
    define(speed = swing*sin(rate*t + phase)/rate),
    contact(first: y >= -steep*max(t - meet, 0)^2),
    contact(second: y >= -steep*max(meet - t, 0)^2),
    friction(on_first on first: slip = (der(x) - speed, der(z)), static = 0.5, kinetic = 0.1),
    friction(on_second on second: slip = (der(x) - speed, der(z)), static = 0.5, kinetic = 0.1),
)]
struct MovingLifts {
    swing: f64,
    rate: f64,
    phase: f64,
    steep: f64,
    meet: f64,
}

/// The second lift arrives at no speed; to the tolerance it may hit the block a little before.
#[test]
fn a_lift_hands_over_what_sticks_to_it() {
    let mut random = Random::new(24);
    for case in 0..20 {
        let scene = MovingLifts {
            swing: random.between(1.0, 3.0),
            rate: random.between(1.0, 3.0),
            phase: random.between(-3.0, 3.0),
            steep: random.between(0.1, 2.0),
            meet: random.between(0.5, 2.0),
        };
        let MovingLifts {
            swing, rate, phase, ..
        } = scene;
        let begins = swing * phase.sin() / rate;
        let carried = swing / rate / rate * (phase.cos() - (2.5 * rate + phase).cos());
        for tolerance in [1e-6, 1e-7, 1e-9] {
            let what = format!("{case}: {scene:?} at {tolerance:e}");
            let start = state(&[0.0; 3], &[begins, 0.0, 0.0]);
            let run = run_by(&scene, ("auto", tolerance), start, 2.5);
            assert!(times(&run, "on_second", "slips").is_empty(), "{what}");
            agree(&what, run.final_state().q[0], carried, 100.0 * tolerance);
            certified(&what, &run);
        }
    }
}
