//! What shares one instant: stops and impacts, the log's order, the end of a run, and roots that only touch.

use super::{PI, state};
use lagrange_core::prelude::*;
use lagrange_tests::{
    METHODS, Random, TOLERANCES, agree, all_agree, certified, methods_at, root, run, run_by, times,
    words,
};

/// A ball between floor and ceiling.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(y),
    kinetic = mass/2 * der(y)^2,
    potential = mass * gravity * y,
    contact(floor: y >= 0, restitution = 1/2),
    contact(ceiling: top >= y, restitution = 1/2),
    stop(down: (3 + y)^2 <= 9),
    mark(apex: top - y),
)]
struct Ball {
    mass: f64,
    gravity: f64,
    top: f64,
}

#[test]
fn a_stop_at_an_impact_ends_the_run_before_it() {
    let mut random = Random::new(16);
    for _ in 0..50 {
        let (gravity, height) = (random.between(1.0, 20.0), random.between(0.01, 3.0));
        let scene = Ball {
            mass: 1.0,
            gravity,
            top: 9.0,
        };
        let motion = run(&scene, state(&[height], &[0.0]), 9.0);
        assert_eq!(words(&motion), ["down stop"]);
        let speed = -(2.0 * gravity * height).sqrt();
        agree("speed", motion.final_state().v[0], speed, 1e-12);
        // The run ends with its last event.
        let [stop] = motion.events() else {
            panic!("one event");
        };
        assert_eq!(&stop.state_after, motion.final_state());
        assert_eq!(stop.time, motion.last_time());
    }
}

/// y = 2 t − t²: the ceiling at 1 is a double root, a little below it is hit and a little above it is not reached.
#[test]
fn a_ceiling_that_is_only_touched_is_not_hit() {
    let thrown = |top: f64| {
        let scene = Ball {
            mass: 1.0,
            gravity: 2.0,
            top,
        };
        let motion = run(&scene, state(&[0.0], &[2.0]), 1.5);
        (words(&motion), motion.final_state().clone())
    };
    let (events, end) = thrown(1.0);
    assert_eq!(events, ["apex mark"]);
    agree("y", end.q[0], 0.75, 1e-14);
    agree("speed", end.v[0], -1.0, 1e-14);
    assert_eq!(thrown(1.0 + 1e-9).0, [""; 0]);
    let (events, end) = thrown(1.0 - 1e-8);
    assert_eq!(events[..2], ["apex mark", "ceiling impact"]);
    // At t = 1 − 1e-4 it arrives with 2e-4, which is halved and turned.
    agree("speed", end.v[0], -1e-4 - 2.0 * (0.5 + 1e-4), 1e-11);
}

/// A block that slides against a wall which keeps it, and a load that lands with it.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, z),
    kinetic = (der(x)^2 + der(z)^2) / 2,
    contact(wall: 1 >= x),
    contact(bed: z >= 0),
    friction(grip: slip = der(x), limit = 1/2),
)]
struct Arrival {
    _unit: f64,
}

#[test]
fn entries_of_one_instant_are_in_order_of_declaration_impacts_first() {
    // x = 3/2 t − t²/4 is 1 at t = 3 − √5, where the load is at 0.
    let time = 3.0 - 5.0_f64.sqrt();
    let start = state(&[0.0, time], &[1.5, -1.0]);
    let motion = run(&Arrival { _unit: 1.0 }, start, 2.0);
    let expected = [
        "wall impact",
        "bed impact",
        "wall closed",
        "bed closed",
        "grip sticks",
    ];
    assert_eq!(words(&motion), expected);
    for event in motion.events() {
        agree("time", event.time, time, 1e-12);
    }
}

/// Two marks on one passage, one from either side.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = der(x)^2 / 2,
    mark(up: x),
    mark(down: -x),
)]
struct Passage {
    _unit: f64,
}

#[test]
fn a_mark_is_logged_where_it_passes_zero_and_not_where_it_begins() {
    let motion = run(&Passage { _unit: 1.0 }, state(&[-1.0], &[2.0]), 1.0);
    assert_eq!(words(&motion), ["up mark", "down mark"]);
    for event in motion.events() {
        agree("time", event.time, 0.5, 1e-15);
    }
}

/// A spring that is pulled ever more.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(y),
    kinetic = der(y)^2/2,
    potential = y^2,
    force(pull: y = k * t),
    stop(back: y <= 0),
    start(rest),
)]
struct Pulled {
    k: f64,
}

/// y = k/2 (t − sin(√2 t)/√2) begins at the zero of the stop with t³ and never returns.
#[test]
fn what_begins_at_a_stop_with_its_cube_is_not_stopped() {
    for k in [0.3, 0.9, 1.3, 7.0] {
        let pulled = Pulled { k };
        for (method, tolerance) in methods_at(METHODS, [1e-6, 1e-9, 1e-10, 1e-12]) {
            let run = run_by(&pulled, (method, tolerance), pulled.at(Pulled::REST), 5.0);
            let what = format!("{k} by {method} at {tolerance:e}: {:?}", words(&run));
            assert!(run.events().is_empty(), "{what}");
            let root = 2.0_f64.sqrt();
            let y = k / 2.0 * (5.0 - (root * 5.0).sin() / root);
            agree(&what, run.final_state().q[0], y, 300.0 * tolerance);
        }
    }
}

/// x = (t − a)(t − b)(t − c)
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = der(x)^2 / 2,
    force(push: x = 6 * t - 2 * (a + b + c)),
    mark(passes: x),
    mark(rises: x >= 0),
    start(below: x = -a * b * c, der(x) = a * b + b * c + c * a),
)]
struct Cubic {
    a: f64,
    b: f64,
    c: f64,
}

#[test]
fn a_mark_that_becomes_true_twice_in_a_step_is_logged_twice() {
    let mut random = Random::new(46);
    for _ in 0..20 {
        let a = random.between(0.1, 0.3);
        let b = a + random.between(0.05, 0.3);
        let cubic = Cubic {
            a,
            b,
            c: b + random.between(0.05, 0.3),
        };
        for method in METHODS {
            let run = run_by(&cubic, (method, 1e-9), cubic.at(Cubic::BELOW), 1.0);
            let what = format!("{cubic:?} by {method}");
            for (item, expected) in [
                ("passes", vec![cubic.a, cubic.b, cubic.c]),
                ("rises", vec![cubic.a, cubic.c]),
            ] {
                let times = times(&run, item, "mark");
                assert_eq!(times.len(), expected.len(), "{what}: {times:?}");
                all_agree(&what, &times, &expected, 1e-7);
            }
        }
    }
}

/// x = t² (end − t) begins at rest at zero, which is the sum of two coordinates and a number.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(u, v),
    define(x = 0.769 * u + 0.13 * v + 0.226),
    kinetic = (der(x)^2 + der(v)^2) / 2,
    force(push: (2 * end - 6 * t) along der(x)),
    mark(passes: x),
    mark(falls: x <= 0),
    stop(back: x <= 0),
)]
struct Returning {
    end: f64,
}

#[test]
fn what_begins_at_rest_at_a_zero_of_rounding_comes_back_once() {
    let mut random = Random::new(47);
    for k in 0..40 {
        let end = match k % 2 {
            0 => random.between(0.05, 0.4),
            _ => random.between(0.001, 0.05),
        };
        let [v, rate] = [(); 2].map(|()| random.between(-1.0, 1.0));
        let start = || {
            state(
                &[(-0.226 - 0.13 * v) / 0.769, v],
                &[-0.13 * rate / 0.769, rate],
            )
        };
        let returning = Returning { end };
        for method in ["auto", "dop853", "verner98", "radau5"] {
            let what = format!("{end} {v} {rate} by {method}");
            let stopped = run_by(&returning, (method, 1e-9), start(), 1.0);
            agree(&what, stopped.last_time(), end, 1e-6);
            let simulation = Simulation::new(&returning)
                .effects(Effects::all().without(Returning::BACK))
                .method(method.parse().unwrap());
            let run = simulation.run(start(), 0.0..1.0).unwrap();
            for item in ["passes", "falls"] {
                // Where it begins it is zero, too, as far as rounding can tell.
                let times = times(&run, item, "mark").into_iter();
                let later: Vec<f64> = times.filter(|time| *time > 1e-6).collect();
                assert_eq!(later.len(), 1, "{what}: {item} {later:?}");
                agree(&what, later[0], end, 1e-6);
            }
        }
    }
}

/// A block that is pushed to and fro on a rough table.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = der(x)^2 / 2,
    friction(table: slip = der(x), limit = 1/2),
    force(shaking: x = push * sin(3 * t)),
    mark(turns: der(x)),
    mark(also: der(x) * (t - 9)),
    start(go: der(x) = 7/10),
)]
struct Rubbed {
    push: f64,
}

/// Where its friction reverses, the velocity 0.7 − t/2 + push (1 − cos 3t)/3 passes zero.
#[test]
fn a_mark_is_passed_where_a_friction_reverses() {
    for push in [0.62, 0.8, 0.93] {
        let velocity = |t: f64| 0.7 - t / 2.0 + push * (1.0 - (3.0 * t).cos()) / 3.0;
        let turns = root(velocity, 1.4, 2.1);
        let rubbed = Rubbed { push };
        for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
            let run = run_by(&rubbed, (method, tolerance), rubbed.at(Rubbed::GO), 1.95);
            let what = format!("{push} by {method} at {tolerance:e}");
            for mark in ["turns", "also"] {
                let times = times(&run, mark, "mark");
                assert!(!times.is_empty(), "{what}: {mark}");
                agree(&what, times[0], turns, 100.0 * tolerance);
            }
        }
    }
}

/// A swing, x = cos t, that is watched by powers.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = der(x)^2 / 2,
    potential = x^2 / 2,
    mark(once: x - place),
    mark(twice: 3 * (x - place)^2),
    mark(thrice: (x - place)^3 / 7),
    mark(falls: (x - place)^5 <= 0),
    start(out: x = 1),
)]
struct Swing {
    place: f64,
}

/// None of them but the first has a slope there.
#[test]
fn powers_are_zero_where_their_bases_are() {
    let fixed = [
        Method::RungeKutta4 { step: 0.01 },
        Method::Gauss6 { step: 0.05 },
    ];
    for place in [0.1, -0.37, 0.8] {
        let swing = Swing { place };
        let first = place.acos();
        for (method, tolerance) in methods_at(METHODS.into_iter().chain(fixed), TOLERANCES) {
            let run = run_by(&swing, (method, tolerance), swing.at(Swing::OUT), 6.2);
            let what = format!("{place} by {method} at {tolerance:e}");
            for mark in ["once", "twice", "thrice"] {
                let times = times(&run, mark, "mark");
                let expected = [first, core::f64::consts::TAU - first];
                all_agree(
                    format!("{what}: {mark}"),
                    &times,
                    &expected,
                    (10.0 * tolerance).max(1e-8),
                );
            }
            let falls = times(&run, "falls", "mark");
            all_agree(&what, &falls, &[first], (10.0 * tolerance).max(1e-8));
        }
    }
}

/// A wind across a track blows beyond a place that is marked.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    force(wind: y = if(x >= place, 2, 0)),
    mark(passes: x - place),
    start(goes: der(x) = speed),
)]
struct Track {
    place: f64,
    speed: f64,
}

/// Steps of 0.1 s end, to rounding, at the place: the mark is passed in this step or the next one.
#[test]
fn a_mark_where_a_force_changes_is_passed_once() {
    for method in ["rk4:0.1", "gauss6:0.1", "auto", "dopri5", "radau5"] {
        for (tenths, speed) in (1..=24).flat_map(|tenths| [1.0, 1.7].map(|speed| (tenths, speed))) {
            let time = 0.1 * f64::from(tenths);
            let place = speed * time;
            let track = Track { place, speed };
            let run = run_by(&track, (method, 1e-9), track.at(Track::GOES), 2.5);
            let what = format!("{place} at {speed} by {method}");
            assert_eq!(
                words(&run),
                ["passes mark", "x >= place branches"],
                "{what}"
            );
            for event in run.events() {
                agree(&what, event.time, time, 1e-12);
            }
        }
    }
}

/// A body in free flight past marks that are given by time alone, and a ball above a table that shakes.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    potential = 10 * y,
    mark(beat: sin(rate * t + phase) <= 0),
    contact(table: y >= 0.05 * sin(rate * t + phase), restitution = 0.9),
    start(go: y = 1, der(x) = 1),
)]
struct Beats {
    rate: f64,
    phase: f64,
}

/// The motion between impacts is a polynomial and the guards are not: their zeros are exact all the same, whatever the tolerance.
#[test]
fn zeros_of_guards_are_exact_where_the_motion_is_simpler() {
    let mut random = Random::new(565);
    for _ in 0..10 {
        let beats = Beats {
            rate: random.between(1.0, 9.0),
            phase: random.between(0.1, 3.0),
        };
        let pairs = methods_at([Method::Auto, Method::DormandPrince853], TOLERANCES);
        for pair in pairs {
            let what = format!("{beats:?} by {pair:?}");
            let run = run_by(&beats, pair, state(&[0.0, 1.0], &[1.0, 0.0]), 5.0);
            let beaten = times(&run, "beat", "mark");
            assert!(!beaten.is_empty(), "{what}");
            for (k, time) in beaten.iter().enumerate() {
                let expected = ((2 * k + 1) as f64 * PI - beats.phase) / beats.rate;
                assert!(
                    (time - expected).abs() < 1e-14 * time.max(1.0),
                    "{what}: {time} {expected}"
                );
            }
            for hit in run
                .events()
                .iter()
                .filter(|event| event.kind == EventKind::Impact)
            {
                let gap = hit.state_after.q[1] - 0.05 * (beats.rate * hit.time + beats.phase).sin();
                assert!(gap.abs() < 1e-12, "{what}: {gap}");
            }
        }
    }
}

/// A ball that bounces and is looked at where it meets the floor.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    potential = gravity * y,
    contact(floor: y >= 0, restitution = bounce),
    mark(place: x - fall * speed),
    mark(low: y),
    mark(instant: t >= fall),
)]
struct Looked {
    gravity: f64,
    bounce: f64,
    fall: f64,
    speed: f64,
}

/// Marks that coincide with an impact are told before it, whichever of all their roots rounding puts first, and the motion goes on as it would.
#[test]
fn marks_at_an_impact_change_nothing() {
    let mut random = Random::new(161);
    for case in 0..60 {
        let tenths = |x: f64| match case % 2 {
            0 => (10.0 * x).round() / 10.0,
            _ => x,
        };
        let looked = Looked {
            gravity: tenths(random.between(1.0, 20.0)),
            bounce: tenths(random.between(0.2, 0.9)),
            fall: tenths(random.between(0.3, 1.5)),
            speed: tenths(random.between(0.5, 3.0)),
        };
        let Looked {
            gravity,
            bounce,
            fall,
            speed,
        } = looked;
        let start = state(&[0.0, 0.5 * gravity * fall * fall], &[speed, 0.0]);
        let later = 0.5 * bounce * fall;
        let motion = run(&looked, start, fall + later);
        let what = format!("{looked:?}");
        certified(&what, &motion);
        let up = gravity * later * (fall * bounce - 0.5 * later);
        all_agree(
            &what,
            &motion.final_state().q,
            &[speed * (fall + later), up],
            1e-9 * (1.0 + gravity),
        );
        let mut told = words(&motion);
        assert_eq!(told.pop().as_deref(), Some("floor impact"), "{what}");
        told.sort();
        assert_eq!(told, ["instant mark", "low mark", "place mark"], "{what}");
    }
}
