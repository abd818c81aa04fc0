//! Guards that break off on the way: a distance beside or through its origin, the cut of an angle, the end of a domain. Their
//! Taylor series do not show it, and go on along another branch.

use super::state;
use lagrange_core::error::NotFinite;
use lagrange_core::prelude::*;
use lagrange_tests::{TOLERANCES, agree, event, words};

const G: f64 = 9.81;

/// A bob on a string, above or below its pivot.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    define(distance = sqrt(x^2 + y^2)),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    potential = gravity * y,
    contact(string: length >= distance),
    mark(close: distance <= 0.5),
    stop(far: distance >= 1.5),
)]
struct Bob {
    gravity: f64,
    length: f64,
}

fn run_at<S: System<Scalar = f64>>(
    scene: &S,
    tolerance: f64,
    start: State<f64>,
    until: f64,
) -> Trajectory<S::Scalar> {
    let simulation = Simulation::new(scene).tolerance(tolerance);
    let run = simulation.run(start, 0.0..until);
    run.unwrap_or_else(|failure| panic!("{tolerance:e}: {failure}"))
}

#[test]
fn a_string_holds_a_bob_that_falls_past_its_pivot() {
    let scene = Bob {
        gravity: G,
        length: 1.2,
    };
    for tolerance in TOLERANCES {
        for beside in [0.0, 1e-10, -1e-7, 1e-4, 0.03] {
            let height = 0.7;
            let run = run_at(&scene, tolerance, state(&[beside, height], &[0.0; 2]), 1.0);
            let depth = |r: f64| (r * r - beside * beside).sqrt();
            let fall = |y: f64| (2.0 * (height - y) / G).sqrt();
            let what = format!("{beside:e} at {tolerance:e}");
            let small = 100.0 * tolerance;
            agree(
                &what,
                event(&run, "close", "mark").time,
                fall(depth(0.5)),
                small,
            );
            agree(
                &what,
                event(&run, "string", "impact").time,
                fall(-depth(1.2)),
                small,
            );
            assert_eq!(
                words(&run)[..3],
                ["close mark", "string impact", "string closed"]
            );
        }
    }
}

#[test]
fn a_stop_on_a_distance_fires_beyond_the_origin() {
    let scene = Bob {
        gravity: G,
        length: 9.0,
    };
    for tolerance in TOLERANCES {
        for beside in [0.0, 1e-10, 1e-3] {
            let run = run_at(&scene, tolerance, state(&[beside, 1.0], &[0.0; 2]), 3.0);
            let depth = (2.25 - beside * beside).sqrt();
            let time = (2.0 * (1.0 + depth) / G).sqrt();
            agree("time", run.last_time(), time, 100.0 * tolerance);
        }
    }
}

/// A stone that is thrown at a peg.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    potential = gravity * y,
    contact(peg: sqrt((x - 2)^2 + (y + 1)^2) >= radius, restitution = 1),
)]
struct Stone {
    gravity: f64,
    radius: f64,
}

#[test]
fn a_point_that_is_hit_has_no_direction() {
    let scene = Stone {
        gravity: G,
        radius: 0.0,
    };
    for tolerance in TOLERANCES {
        for flight in [0.3, 0.5, 0.7] {
            let start = state(&[0.0; 2], &[2.0 / flight, 0.5 * G * flight - 1.0 / flight]);
            let run = Simulation::new(&scene).tolerance(tolerance);
            let failure = run.run(start, 0.0..2.0).expect_err("no direction");
            let Error::Undirected { time, item } = failure.error else {
                panic!("{failure}");
            };
            assert_eq!(item, "peg");
            agree("time", time, flight, 10.0 * tolerance);
            // The flight up to there is kept.
            let flown = failure.trajectory;
            agree("end", flown.last_time(), time, 1e-15);
            agree("x", flown.final_state().q[0], 2.0, 10.0 * tolerance);
        }
    }
}

#[test]
fn a_point_that_is_missed_is_passed() {
    let scene = Stone {
        gravity: 0.0,
        radius: 0.0,
    };
    for tolerance in TOLERANCES {
        for beside in [20.0 * tolerance, 1e3 * tolerance] {
            let start = state(&[0.0, -1.0 + beside], &[3.0, 0.0]);
            let run = run_at(&scene, tolerance, start, 2.0);
            assert_eq!(words(&run), [""; 0]);
            agree("x", run.final_state().q[0], 6.0, 1e-14);
        }
    }
}

#[test]
fn a_small_peg_turns_the_stone_back() {
    let scene = Stone {
        gravity: 0.0,
        radius: 1e-3,
    };
    for tolerance in TOLERANCES {
        let start = state(&[0.0, -1.0], &[4.0, 0.0]);
        let run = run_at(&scene, tolerance, start, 1.0);
        let hit = (2.0 - scene.radius) / 4.0;
        agree(
            "time",
            event(&run, "peg", "impact").time,
            hit,
            10.0 * tolerance,
        );
        agree(
            "x",
            run.final_state().q[0],
            4.0 * (2.0 * hit - 1.0),
            100.0 * tolerance,
        );
    }
}

/// Two stones that part from close by, far from the origin: their distance is known to roundings of their places.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, u, w),
    kinetic = (der(x)^2 + der(y)^2 + der(u)^2 + der(w)^2) / 2,
    contact(touch: sqrt((x - u)^2 + (y - w)^2) >= 0),
)]
struct Stones {
    _unit: f64,
}

#[test]
fn roundings_of_a_distance_do_not_hold_up_the_motion() {
    for far in [40.0, 170.0, 300.0] {
        let start = state(&[far, far, far + 1e-11, far - 1e-11], &[0.0, 0.0, 7.0, 5.0]);
        let run = run_at(&Stones { _unit: 1.0 }, 1e-9, start, 2.0);
        agree("u", run.final_state().q[2], far + 14.0, 1e-11);
        let steps = run.work().steps;
        assert!(steps < 100, "{steps} from {far}");
    }
}

/// A bead on a line between two stops that are one distance.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(y),
    kinetic = der(y)^2 / 2,
    contact(rope: 1 >= sqrt(y^2), restitution = 1),
)]
struct Bead {
    _unit: f64,
}

#[test]
fn a_rope_through_its_anchor() {
    for tolerance in TOLERANCES {
        let run = run_at(&Bead { _unit: 1.0 }, tolerance, state(&[0.5], &[-1.0]), 8.0);
        let times = run.events().iter().map(|e| e.time);
        for (time, exact) in times.zip([1.5, 3.5, 5.5, 7.5]) {
            agree("impact", time, exact, 100.0 * tolerance);
        }
        assert_eq!(words(&run), ["rope impact"; 4]);
    }
}

/// A bob on a rod that goes over the top, where the angle jumps from π to −π.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y),
    define(angle = atan2(x, -y)),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    potential = gravity * y,
    constraint(rod: x^2 + y^2 == 1),
    contact(side: angle >= floor),
    mark(right: angle >= 1),
    stop(never: angle >= 3.2),
    stop(left: -3 >= angle),
)]
struct Over {
    gravity: f64,
    floor: f64,
}

#[test]
fn the_cut_of_an_angle_is_no_passage_to_beyond_pi() {
    // Without weight it goes round at 2 rad/s.
    let scene = Over {
        gravity: 0.0,
        floor: -9.0,
    };
    for tolerance in TOLERANCES {
        let run = run_at(&scene, tolerance, state(&[0.0, -1.0], &[2.0, 0.0]), 9.0);
        assert_eq!(words(&run), ["right mark", "left stop"]);
        // The stop becomes true where the angle jumps.
        let top = core::f64::consts::FRAC_PI_2;
        agree("top", run.last_time(), top, 100.0 * tolerance);
    }
}

#[test]
fn a_gap_that_jumps_below_zero_is_an_error() {
    let scene = Over {
        gravity: 0.0,
        floor: -2.0,
    };
    let start = state(&[0.0, -1.0], &[2.0, 0.0]);
    let failure = Simulation::new(&scene).run(start, 0.0..9.0);
    let Err(Failure {
        error:
            Error::Discontinuous {
                time,
                item,
                before,
                after,
            },
        ..
    }) = failure
    else {
        panic!("{failure:?}");
    };
    let pi = core::f64::consts::PI;
    assert_eq!(item, "side");
    agree("time", time, 0.5 * pi, 1e-10);
    agree("before", before, 2.0 + pi, 1e-10);
    agree("after", after, 2.0 - pi, 1e-10);
}

/// A mass that leaves the domain of what is watched.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = der(x)^2 / 2,
    stop(level: ln(1 + x) >= 5),
)]
struct Domain {
    _unit: f64,
}

#[test]
fn a_watch_that_is_no_number_any_more_is_named() {
    let start = state(&[0.0], &[-1.0]);
    let failure = Simulation::new(&Domain { _unit: 1.0 }).run(start, 0.0..3.0);
    let Err(Failure {
        error: Error::NotFinite { time, what, .. },
        ..
    }) = failure
    else {
        panic!("{failure:?}");
    };
    agree("time", time, 1.0, 1e-10);
    assert_eq!(what, "the guard of `level`");
}

/// A mass passes the narrow beam of a light barrier: what reads it is close to 0 before and to 1 beyond, and stops the run halfway.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = der(x)^2 / 2,
    stop(logistic: 1 / (1 + exp((place - x) / width)) >= 1/2),
    stop(tangent: (1 + tanh((x - place) / (2 * width))) / 2 >= 1/2),
)]
struct Barrier {
    place: f64,
    width: f64,
}

#[test]
fn a_watch_that_overflows_is_an_error_that_says_so() {
    let scene = Barrier {
        place: 2.0,
        width: 1e-3,
    };
    let run = |without| {
        let effects = Effects::all().without(without);
        let simulation = Simulation::new(&scene).effects(effects);
        simulation.run(state(&[0.0], &[1.0]), 0.0..3.0)
    };
    // exp(2000) is beyond all numbers.
    let failure = run(Barrier::TANGENT).expect_err("no series of this");
    let Error::NotFinite { cause, what, .. } = &failure.error else {
        panic!("{failure}");
    };
    assert_eq!(*cause, NotFinite::Exponential, "{failure}");
    assert_eq!(what, "a Taylor coefficient of the guard of `logistic`");
    assert!(failure.to_string().contains("(1 + tanh(z/2))/2"));
    // The same, written as that message says.
    let run = run(Barrier::LOGISTIC).unwrap_or_else(|failure| panic!("{failure}"));
    agree("time", run.last_time(), 2.0, 1e-12);
}

/// A ram falls onto a pile in soil that holds it the better the deeper it is.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(ram, pile),
    kinetic = mass/2 * (der(ram)^2 + der(pile)^2),
    potential = gravity * mass * (ram + pile),
    contact(head: ram >= pile, restitution = 1/5),
    friction(soil: slip = der(pile), limit = skin * (1 + pile^2)),
    start(lifted: ram = 1),
)]
struct Ram {
    mass: f64,
    gravity: f64,
    skin: f64,
}

/// The soil stops so light a pile with an acceleration whose square is beyond all numbers; a hundred orders of magnitude below it drives on.
#[test]
fn numbers_out_of_range_are_an_error_that_says_so() {
    let run = |mass: f64, skin: f64| {
        let scene = Ram {
            mass,
            gravity: 9.81,
            skin,
        };
        Simulation::new(&scene)
            .run(scene.at(Ram::LIFTED), 0.0..3.0)
            .map(drop)
    };
    let failure = run(1e-290, 4000.0).expect_err("no series of this");
    let Error::NotFinite { cause, .. } = &failure.error else {
        panic!("{failure}");
    };
    assert_eq!(*cause, NotFinite::Range, "{failure}");
    assert!(failure.to_string().contains("choose other units"));
    run(1e-290, 4e-287).unwrap_or_else(|failure| panic!("{failure}"));
}

/// A mass beside a cycloid, told by the place along it and the height along its normal, which turns over in the cusp at u = π: the kinetic energy jumps there,
/// and close to it rounding of 0/0 says how long steps are.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(u, h),
    define(l = sqrt((1 + cos(u))^2 + sin(u)^2), nx = sin(u)/l, ny = (1 + cos(u))/l),
    define(px = u + sin(u) + h*nx, py = 1 + cos(u) + h*ny),
    kinetic = (der(px)^2 + der(py)^2)/2,
)]
struct Cusp {
    _unit: f64,
}

#[test]
fn steps_that_rounding_makes_ever_shorter_end_the_run() {
    for tolerance in [1e-9, 1e-12] {
        let simulation = Simulation::new(&Cusp { _unit: 1.0 }).tolerance(tolerance);
        let failure = simulation.run(state(&[2.5, 0.2], &[1.0, 0.0]), 0.0..5.0);
        let Err(Failure { error, trajectory }) = failure else {
            panic!("{tolerance:e}: it has passed the cusp");
        };
        assert!(matches!(error, Error::StepTooSmall { .. }), "{error}");
        let [u, _] = trajectory.final_state().q[..] else {
            panic!("two coordinates");
        };
        assert!((0.0..1e-2).contains(&(std::f64::consts::PI - u)), "{u}");
        assert!(trajectory.work().steps < 10_000, "{error}");
    }
}
