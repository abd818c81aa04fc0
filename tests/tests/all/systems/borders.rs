//! Forces that change where a contact or a friction holds the motion: what is declared for equality acts there.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, TOLERANCES, agree, methods_at, words};

const G: f64 = 9.81;

/// A motion.
fn motion(
    scene: &impl System<Scalar = f64>,
    method: Method,
    tolerance: f64,
    start: State<f64>,
    until: f64,
) -> Trajectory<f64> {
    let simulation = Simulation::new(scene).method(method).tolerance(tolerance);
    let run = simulation.run(start, 0.0..until);
    run.unwrap_or_else(|failure| panic!("{method:?} at {tolerance:e}: {failure}"))
}

/// A motion, with a certificate that holds.
fn certified(
    scene: &impl System<Scalar = f64>,
    method: Method,
    tolerance: f64,
    start: State<f64>,
    until: f64,
) -> Trajectory<f64> {
    let run = motion(scene, method, tolerance, start, until);
    for seed in 0..3 {
        let certificate = run.verify(seed).expect("recorded");
        assert!(
            certificate.holds(),
            "{method:?} at {tolerance:e}: {certificate}"
        );
    }
    run
}

/// Every method at every tolerance.
fn everyhow(test: impl Fn(Method, f64)) {
    for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
        test(method, tolerance);
    }
}

/// A block whose drive grips on the floor and not above it.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic   = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    contact(floor: y >= 0, restitution = bounce),
    force(drive: x = if(y <= 0, strength, 0)),
)]
struct Driven {
    mass: f64,
    gravity: f64,
    bounce: f64,
    strength: f64,
}

/// x = F (t − t₀)²/(2 m) from the instant t₀ on at which the block lies: √(2h/g) (1 + e)/(1 − e).
#[test]
fn a_drive_grips_from_the_instant_at_which_the_block_lies() {
    for bounce in [0.0, 0.4] {
        let scene = Driven {
            mass: 2.0,
            gravity: G,
            bounce,
            strength: 3.0,
        };
        let lies = (2.0 / G).sqrt() * (1.0 + bounce) / (1.0 - bounce);
        let x = 3.0 / 4.0 * (2.5 - lies).powi(2);
        everyhow(|method, tolerance| {
            let run = certified(
                &scene,
                method,
                tolerance,
                state(&[0.0, 1.0], &[0.0, 0.0]),
                2.5,
            );
            let what = format!("{bounce} by {method:?} at {tolerance:e}");
            agree(
                &what,
                run.final_state().q[0],
                x,
                (100.0 * tolerance).max(1e-11),
            );
        });
    }
}

/// A mass on the inside of a drum, which drives it along its axis where they touch.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, z),
    define(r = sqrt(x^2 + y^2)),
    kinetic = mass/2 * (der(x)^2 + der(y)^2 + der(z)^2),
    contact(drum: r <= radius),
    force(screw: z = if(r >= radius, strength, 0)),
)]
struct Drum {
    mass: f64,
    radius: f64,
    strength: f64,
}

/// The distance from the axis is the radius to rounding, on either side of it.
#[test]
fn a_curved_wall_drives_what_slides_along_it() {
    let scene = Drum {
        mass: 1.0,
        radius: 1.0,
        strength: 3.0,
    };
    everyhow(|method, tolerance| {
        let start = state(&[1.0, 0.0, 0.0], &[0.0, 1.0, 0.0]);
        let run = certified(&scene, method, tolerance, start, 6.0);
        assert!(run.events().is_empty(), "{method:?}: {:?}", words(&run));
        let (end, bound) = (run.final_state(), (100.0 * tolerance).max(1e-11));
        agree("x", end.q[0], 6.0_f64.cos(), bound);
        agree("z", end.q[2], 1.5 * 36.0, bound);
    });
}

/// A stone in a sling that has a stiff spring beyond its length, where it never comes.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    define(r = sqrt(x^2 + y^2)),
    kinetic   = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    potential(spring: stiffness/2 * max(r - length, 0)^2),
    contact(rope: r <= length),
)]
struct Sling {
    mass: f64,
    gravity: f64,
    stiffness: f64,
    length: f64,
}

/// With v² = 7/2 g l below, the rope goes slack where cos φ = −1/2 with v² = g l/2, and the stone falls along a parabola until r = l again.
#[test]
fn a_spring_at_the_end_of_a_rope_changes_nothing() {
    let scene = Sling {
        mass: 1.0,
        gravity: G,
        stiffness: 800.0,
        length: 0.5,
    };
    let l = scene.length;
    let v = (3.5 * G * l).sqrt();
    // From 120° on, upward at 60° to the vertical: r² = l² again where t = 2 √3 v/g.
    let fall = 2.0 * 3.0_f64.sqrt() * (G * l / 2.0).sqrt() / G;
    everyhow(|method, tolerance| {
        let start = state(&[0.0, -l], &[v, 0.0]);
        let run = motion(&scene, method, tolerance, start, 1.5);
        let what = format!("{method:?} at {tolerance:e}");
        let expected = ["rope lost", "r - length >= 0 branches", "rope impact"];
        let told = words(&run);
        assert_eq!(told[..3], expected, "{what}: {told:?}");
        assert_eq!(told.len(), 5, "{what}: {told:?}");
        let (slack, taut) = (&run.events()[0], &run.events()[2]);
        let bound = (1e3 * tolerance).max(1e-10);
        agree(&what, slack.q(Sling::Y), l / 2.0, bound);
        agree(&what, taut.time - slack.time, fall, bound);
    });
}

/// A block comes to rest by friction, which lets a latch go.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, z),
    kinetic = mass/2 * (der(x)^2 + der(z)^2),
    friction(rub: slip = der(x), limit = dry),
    force(latch: z = if(der(x) <= 0, strength, 0)),
)]
struct Latched {
    mass: f64,
    dry: f64,
    strength: f64,
}

/// v₀ m/F later it rests.
#[test]
fn what_rests_has_no_velocity() {
    let scene = Latched {
        mass: 1.0,
        dry: 3.0,
        strength: 2.0,
    };
    everyhow(|method, tolerance| {
        let run = certified(
            &scene,
            method,
            tolerance,
            state(&[0.0, 0.0], &[2.0, 0.0]),
            3.0,
        );
        let z = (3.0 - 2.0 / 3.0_f64).powi(2);
        agree(
            "z",
            run.final_state().q[1],
            z,
            (100.0 * tolerance).max(1e-11),
        );
    });
}

/// A block on a belt and on a floor, both of which stop at once.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y),
    kinetic   = (der(x)^2 + der(y)^2) / 2,
    potential = gravity * y,
    contact(floor: y >= if(t <= 1, rise * t, rise)),
    friction(belt on floor: slip = der(x) - if(t <= 1, speed, 0), static = 0.3),
)]
struct Stopped {
    gravity: f64,
    rise: f64,
    speed: f64,
}

/// No acceleration tells that they do. The velocity does not follow the floor; on the belt friction slows the block down.
#[test]
fn a_floor_that_stops_at_once_ends_the_run_and_a_belt_does_not() {
    let scene = |rise, speed| Stopped {
        gravity: G,
        rise,
        speed,
    };
    everyhow(|method, tolerance| {
        let run = |scene: &Stopped| {
            let simulation = Simulation::new(scene).method(method).tolerance(tolerance);
            simulation.run(state(&[0.0; 2], &[scene.speed, scene.rise]), 0.0..2.0)
        };
        let failure = run(&scene(0.5, 0.0)).expect_err("the floor stops");
        let Error::Corner { time, item, rate } = failure.error else {
            panic!("{failure}");
        };
        assert_eq!(item, "floor");
        agree("time", time, 1.0, 1e-12);
        agree("rate", rate, 0.5, 1e-9);
        let slides = run(&scene(0.0, 0.5)).expect("the belt stops");
        let place = 0.5 + 0.5 * 0.5 / (2.0 * 0.3 * G);
        agree("place", slides.final_state().q[0], place, 10.0 * tolerance);
    });
}

/// A ball above a floor that is higher all at once.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(y),
    kinetic = der(y)^2 / 2,
    contact(floor: y >= if(t <= raised, 0, higher)),
    start(go: y = 2, der(y) = -speed),
)]
struct Raised {
    raised: f64,
    higher: f64,
    speed: f64,
}

#[test]
fn a_floor_that_jumps_above_a_ball_ends_the_run() {
    for (raised, higher, speed) in [(1.0, 5.0, 0.1), (0.7, 1.8, 0.4), (1.0, 0.5, 0.2)] {
        let scene = Raised {
            raised,
            higher,
            speed,
        };
        everyhow(|method, tolerance| {
            let simulation = Simulation::new(&scene).method(method).tolerance(tolerance);
            let run = simulation.run(scene.at(Raised::GO), 0.0..2.0);
            let height = 2.0 - speed * raised;
            match (run, higher < height) {
                (Ok(run), true) => {
                    agree(
                        "height",
                        run.final_state().q[0],
                        2.0 - 2.0 * speed,
                        tolerance,
                    );
                }
                (Err(failure), false) => {
                    let Error::Discontinuous {
                        time,
                        item,
                        before,
                        after,
                    } = failure.error
                    else {
                        panic!("{failure}")
                    };
                    assert_eq!(item, "floor");
                    agree("time", time, raised, 1e-12);
                    agree("before", before, height, tolerance);
                    agree("after", after, height - higher, tolerance);
                }
                (run, _) => panic!("{scene:?}: {:?}", run.map(|_| ())),
            }
        });
    }
}

/// What is told to move to and fro by angles of what turns evenly: in a zigzag, and in steps.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, turn),
    kinetic = (der(x)^2 + der(turn)^2) / 2,
    define(zigzag = asin(sin(turn)), saw = atan2(sin(turn), cos(turn))),
    constraint(moved: x == size*(share*zigzag + (1 - share)*saw)),
    start(go: der(turn) = rate, der(x) = size*rate),
)]
struct Told {
    size: f64,
    share: f64,
    rate: f64,
}

/// Their series know nothing of the corners and jumps, and steps could pass many of them.
#[test]
fn angles_at_their_ends_end_the_run() {
    for (size, rate, until) in [(0.1, 1.0, 20.0), (0.01, 6.0, 20.0), (1.0, 0.7, 12.0)] {
        everyhow(|method, tolerance| {
            for share in [1.0, 0.0] {
                let scene = Told { size, share, rate };
                let simulation = Simulation::new(&scene).method(method).tolerance(tolerance);
                let failure = simulation
                    .run(scene.at(Told::GO), 0.0..until)
                    .expect_err("it passes an end");
                let at_end = match failure.error {
                    Error::Corner { item, .. } => item == "moved" && share > 0.0,
                    Error::Discontinuous { item, .. } => item == "moved" && share == 0.0,
                    _ => false,
                };
                assert!(at_end, "{share} {method}: {failure}");
            }
        });
    }
}

/// A cart that is pulled against a wall, where a push begins that is stronger.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = mass/2 * der(x)^2,
    contact(wall: x >= 0),
    force(draws: x = -pull),
    force(throws: x = if(x <= 0, push, 0)),
)]
struct Thrown {
    mass: f64,
    pull: f64,
    push: f64,
}

/// It can neither stay, as the push is stronger than the pull, nor leave, as the push is then over: that is said with what to do.
#[test]
fn a_push_that_ends_where_it_has_pushed_leaves_no_mode() {
    let scene = Thrown {
        mass: 2.0,
        pull: 3.0,
        push: 5.0,
    };
    let arrives = (2.0 * scene.mass * 0.2 / scene.pull).sqrt();
    for method in METHODS {
        let simulation = Simulation::new(&scene).method(method).tolerance(1e-9);
        let failure = simulation.run(state(&[0.2], &[0.0]), 0.0..3.0);
        let error = failure.expect_err("no mode").error;
        let Error::NoMode { time, item, .. } = error else {
            panic!("{method:?}: {error}");
        };
        assert_eq!(item, "wall", "{method:?}");
        agree(format!("{method:?}"), time, arrives, 1e-9);
        assert!(
            error.to_string().contains("jumps at the surface"),
            "{error}"
        );
    }
}
