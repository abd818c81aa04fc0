//! What is true only just, or for a moment: every method finds it, and finds nothing where it is only just not true.

use super::state;
use core::f64::consts::PI;
use lagrange_core::prelude::*;
use lagrange_tests::{TOLERANCES, agree, event, methods_at, run_by, words};

const METHODS: [&str; 7] = [
    "taylor",
    "dop853",
    "dopri5",
    "verner98",
    "radau5",
    "rk4:1e-3",
    "gauss6:0.01",
];

/// Tolerances, and depths that are far above the errors that they leave.
const DEPTHS: [(f64, f64); 4] = [(1e-9, 1e-5), (1e-12, 5e-7), (1e-12, 5e-8), (1e-12, 5e-9)];

/// A satellite on an ellipse about a planet of radius `planet`, seen from a station within `seen`.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    potential = -1 / sqrt(x^2 + y^2),
    contact(planet: sqrt(x^2 + y^2) >= surface, restitution = 1),
    stop(near: sqrt(x^2 + y^2) <= seen),
    mark(passes: sqrt(x^2 + y^2) - marked),
)]
struct Orbit {
    surface: f64,
    seen: f64,
    marked: f64,
}

/// Of the ellipse: its major half axis and eccentricity.
const HALF_AXIS: f64 = 1.0;
const ECCENTRICITY: f64 = 0.6;
const NEAREST: f64 = HALF_AXIS * (1.0 - ECCENTRICITY);

/// It begins where it is farthest.
fn farthest() -> State<f64> {
    let far = HALF_AXIS * (1.0 + ECCENTRICITY);
    state(&[far, 0.0], &[0.0, ((1.0 - ECCENTRICITY) / far).sqrt()])
}

/// When it comes to a distance for the first time, by Kepler's equation.
fn comes_to(distance: f64) -> f64 {
    let anomaly = 2.0 * PI - ((1.0 - distance / HALF_AXIS) / ECCENTRICITY).acos();
    anomaly - ECCENTRICITY * anomaly.sin() - PI
}

const AWAY: Orbit = Orbit {
    surface: 0.1,
    seen: 0.1,
    marked: 0.1,
};

#[test]
fn what_only_just_becomes_true_is_found() {
    for (tolerance, depth) in DEPTHS {
        let distance = NEAREST + depth;
        // By symmetry it passes the same distance before and after its nearest point, which is half a period after the start.
        let before = 2.0 * PI - comes_to(distance);
        let [first, second] = if before < PI {
            [before, 2.0 * PI - before]
        } else {
            [2.0 * PI - before, before]
        };
        // Near the nearest point the distance is hardly a function of the time.
        let resolved = 1e3 * tolerance / depth.sqrt();
        for method in METHODS {
            let asked = format!("{method} {tolerance:e}, {depth:e}");
            let run = |orbit: Orbit| run_by(&orbit, (method, tolerance), farthest(), 5.0);
            let strikes = run(Orbit {
                surface: distance,
                ..AWAY
            });
            agree(
                &asked,
                event(&strikes, "planet", "impact").time,
                first,
                resolved,
            );
            let seen = run(Orbit {
                seen: distance,
                ..AWAY
            });
            agree(&asked, event(&seen, "near", "stop").time, first, resolved);
            let marked = run(Orbit {
                marked: distance,
                ..AWAY
            });
            assert_eq!(words(&marked), ["passes mark"; 2], "{asked}");
            for (mark, time) in marked.events().iter().zip([first, second]) {
                agree(&asked, mark.time, time, resolved);
            }
        }
    }
}

#[test]
fn what_only_just_does_not_become_true_is_not_found() {
    for (tolerance, depth) in DEPTHS {
        let distance = NEAREST - depth;
        let orbit = Orbit {
            surface: distance,
            seen: distance,
            marked: distance,
        };
        for method in METHODS {
            let asked = format!("{method} {tolerance:e}, {depth:e}");
            let run = run_by(&orbit, (method, tolerance), farthest(), 5.0);
            assert!(run.events().is_empty(), "{asked}: {:?}", words(&run));
        }
    }
}

/// A bead in a circular groove, which it leaves where it is too slow at the top.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(r, phi),
    define(x = r * sin(phi), y = -r * cos(phi)),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    potential = gravity * y,
    contact(groove: r <= radius),
)]
struct Groove {
    gravity: f64,
    radius: f64,
}

#[test]
fn a_force_that_only_just_vanishes_is_found() {
    let scene = Groove {
        gravity: 2.0,
        radius: 0.5,
    };
    for (tolerance, depth) in DEPTHS {
        for method in METHODS {
            let asked = format!("{method} {tolerance:e}, {depth:e}");
            let run = |depth: f64| {
                // v² = 5 g r at the lowest point is just enough.
                let rate = (5.0 * scene.gravity * scene.radius - depth).sqrt() / scene.radius;
                let start = state(&[scene.radius, 0.0], &[0.0, rate]);
                run_by(&scene, (method, tolerance), start, 1.2)
            };
            let slow = run(depth);
            assert_eq!(words(&slow)[0], "groove lost", "{asked}");
            // N r = v₀² − g r (2 − 3 cos φ) vanishes there.
            let cosine = -1.0 + depth / (3.0 * scene.gravity * scene.radius);
            let angle = slow.events()[0].q(Groove::PHI);
            agree(&asked, angle.cos(), cosine, 100.0 * tolerance);
            let fast = run(-depth);
            assert!(words(&fast).is_empty(), "{asked}: {:?}", words(&fast));
        }
    }
}

/// Two pointers that swing a quarter of a period apart, and a window between them.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    potential = (x^2 + y^2) / 2,
    stop(window: x >= opens and y >= closes),
)]
struct Window {
    opens: f64,
    closes: f64,
}

/// sin t ≥ sin a from a on, cos t ≥ cos b up to b.
#[test]
fn two_conditions_that_hold_together_for_a_moment() {
    let opens: f64 = 0.9;
    for (tolerance, width) in [(1e-9, 1e-6), (1e-12, 1e-9), (1e-12, 1e-10)] {
        for method in METHODS {
            let asked = format!("{method} {tolerance:e}, {width:e}");
            let run = |closes: f64| {
                let scene = Window {
                    opens: opens.sin(),
                    closes: closes.cos(),
                };
                run_by(
                    &scene,
                    (method, tolerance),
                    state(&[0.0, 1.0], &[1.0, 0.0]),
                    3.0,
                )
            };
            let open = run(opens + width);
            agree(
                &asked,
                event(&open, "window", "stop").time,
                opens,
                100.0 * tolerance,
            );
            let shut = run(opens - width);
            assert!(shut.events().is_empty(), "{asked}: {:?}", words(&shut));
        }
    }
}

#[test]
fn two_conditions_that_become_true_at_once() {
    let opens: f64 = 0.9;
    for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
        let scene = Window {
            opens: opens.sin(),
            closes: opens.sin(),
        };
        let together = state(&[0.0, 0.0], &[1.0, 1.0]);
        let run = run_by(&scene, (method, tolerance), together, 3.0);
        let asked = format!("{method} {tolerance:e}");
        agree(
            &asked,
            event(&run, "window", "stop").time,
            opens,
            100.0 * tolerance,
        );
    }
}

/// A weight that swings on a spring while it falls.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    potential = gravity * y + stiffness/2 * x^2,
    contact(anvil: y >= 0, restitution = 1/2),
)]
struct Falling {
    gravity: f64,
    stiffness: f64,
}

/// The state of an impact is as exact as the ends of steps are, with a method that knows less between them.
#[test]
fn impacts_are_as_exact_as_ends_of_steps() {
    let scene = Falling {
        gravity: 2.0,
        stiffness: 30.0,
    };
    let rate = scene.stiffness.sqrt();
    for tolerance in [1e-9, 1e-10, 1e-11, 1e-12] {
        for height in [0.1, 0.23, 0.41, 0.67] {
            let start = state(&[0.4, height], &[1.0, 0.0]);
            let run = run_by(&scene, ("radau5", tolerance), start, 1.0);
            let impact = event(&run, "anvil", "impact");
            let time = height.sqrt();
            let [sine, cosine] = [(rate * time).sin(), (rate * time).cos()];
            let asked = format!("{tolerance:e}, {height}");
            agree(&asked, impact.time, time, tolerance);
            agree(
                &asked,
                impact.q(Falling::X),
                0.4 * cosine + sine / rate,
                10.0 * tolerance,
            );
            agree(
                &asked,
                impact.v(Falling::X),
                cosine - 0.4 * rate * sine,
                100.0 * tolerance,
            );
        }
    }
}

/// A ball bounces; marks at the surface itself, and just above it.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(y),
    kinetic = der(y)^2/2,
    potential = gravity * y,
    contact(floor: y >= 0, restitution = bounce),
    mark(height: y),
    mark(twice: 2*y),
    mark(down: y <= 0),
    mark(near: y <= 0.01),
    mark(turns: der(y)),
    start(drop: y = 1),
)]
struct Bouncing {
    gravity: f64,
    bounce: f64,
}

/// Each blow passes the marks at the surface once; and a mark that begins with zero has not passed it.
#[test]
fn marks_at_a_surface_are_passed_once_a_blow() {
    let ball = Bouncing {
        gravity: 9.81,
        bounce: 0.5,
    };
    let fall = (2.0_f64 / ball.gravity).sqrt();
    for method in lagrange_tests::METHODS {
        let motion =
            lagrange_tests::run_by(&ball, (method, 1e-9), ball.at(Bouncing::DROP), 2.3 * fall);
        let times = |kind: EventKind, name: &str| -> Vec<f64> {
            let events = motion.events().iter();
            let own =
                events.filter(|e| e.kind == kind && e.subject.name(motion.description()) == name);
            own.map(|e| e.time).collect()
        };
        let blows = times(EventKind::Impact, "floor");
        assert_eq!(blows.len(), 2, "{method}");
        for name in ["height", "twice", "down"] {
            let marks = times(EventKind::Mark, name);
            assert_eq!(marks.len(), 2, "{method} {name}: {marks:?}");
            for (mark, blow) in marks.iter().zip(&blows) {
                assert!((mark - blow).abs() < 1e-9, "{method} {name}");
            }
        }
        assert_eq!(times(EventKind::Mark, "near").len(), 2, "{method}");
        // Not where it is let go, but at the height of its bounce.
        let turns = times(EventKind::Mark, "turns");
        let top = turns.iter().filter(|t| (*t - 1.5 * fall).abs() < 1e-8);
        assert_eq!(top.count(), 1, "{method}: {turns:?}");
        assert!(turns.iter().all(|t| *t > 0.1), "{method}: {turns:?}");
    }
}
