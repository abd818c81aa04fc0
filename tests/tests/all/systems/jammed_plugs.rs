//! Forces that friction leaves open, and that it holds by itself: a disc that is jammed below two walls, and marks that ask for such forces.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{agree, certified, event, methods_at, run_by, words};

/// A disc hangs between two walls that meet above it, held by its own jam, while friction fades.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, phi),
    define(mu = first * exp(-t/time)),
    kinetic = mass/2*(der(x)^2 + der(y)^2) + mass*radius^2/4*der(phi)^2,
    potential = 9.81*mass*y,
    contact(left: x*cos(angle) - y*sin(angle) >= radius),
    contact(right: -x*cos(angle) - y*sin(angle) >= radius),
    friction(on_left on left: slip = der(x)*sin(angle) + der(y)*cos(angle) - radius*der(phi), static = mu),
    friction(on_right on right: slip = -der(x)*sin(angle) + der(y)*cos(angle) + radius*der(phi), static = mu),
    start(hung: y = -radius/sin(angle)),
)]
struct Plug {
    mass: f64,
    radius: f64,
    angle: f64,
    first: f64,
    time: f64,
}

/// Both walls press with N > 0, and 2 N (μ cos α − sin α) ≥ m g: N has a pole where μ = tan α, and from there on nothing holds the disc. Rounding of numbers
/// that are large beside the load places it to some 1e-8.
#[test]
fn a_jammed_disc_falls_where_friction_is_less_than_the_slope() {
    for (mass, radius, angle, first, time) in [
        (3.0, 0.4, 0.289, 0.51, 1.4),
        (0.2, 1.7, 0.61, 0.98, 0.8),
        (7.5, 0.1, 0.15, 0.42, 3.0),
        (1.0, 1.0, 0.45, 1.1, 2.2),
    ] {
        let plug = Plug {
            mass,
            radius,
            angle,
            first,
            time,
        };
        let falls = time * (first / angle.tan()).ln();
        for (method, tolerance) in methods_at(["auto", "radau5"], [1e-6, 1e-9, 1e-12]) {
            let run = run_by(&plug, (method, tolerance), plug.at(Plug::HUNG), 1.2 * falls);
            let what = format!("{plug:?} by {method} at {tolerance:e}");
            for wall in ["left", "right"] {
                agree(&what, event(&run, wall, "lost").time / falls, 1.0, 2e-7);
            }
            let drop = 0.5 * 9.81 * (0.2 * falls).powi(2);
            let y = -radius / angle.sin() - drop;
            agree(&what, run.final_state().q[1], y, 1e-6);
            let held = run_by(
                &plug,
                (method, tolerance),
                plug.at(Plug::HUNG),
                0.999 * falls,
            );
            certified(&what, &held);
        }
    }
}

/// A crate that two brakes hold against a load which grows.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = mass/2*der(x)^2,
    force(load: x = rate*t),
    friction(weak: slip = der(x), limit = small),
    friction(strong: slip = der(x), limit = large),
    mark(half: -strong >= asked),
    mark(both: -(weak + strong) >= 2*asked),
)]
struct Brakes {
    mass: f64,
    rate: f64,
    small: f64,
    large: f64,
    asked: f64,
}

/// Both carry one half until the weak one holds no more. From there on a mark would read a half, and results the rest: it is refused. Their sum is what the load is.
#[test]
fn a_mark_on_a_share_is_refused_where_a_limit_bends_it() {
    for (mass, rate, small, large) in [
        (1.0, 1.0, 1.0, 5.0),
        (4.0, 0.3, 0.7, 1.9),
        (0.5, 8.0, 3.0, 11.0),
    ] {
        let brakes = |asked: f64| Brakes {
            mass,
            rate,
            small,
            large,
            asked,
        };
        let bends = 2.0 * small / rate;
        for (method, tolerance) in
            methods_at(["auto", "dop853", "radau5", "rk4:0.01"], [1e-6, 1e-9])
        {
            let scene = brakes(0.8 * small);
            let asked = (method, tolerance);
            let before = run_by(&scene, asked, state(&[0.0], &[0.0]), 0.95 * bends);
            let what = format!("{scene:?} by {method} at {tolerance:e}");
            for mark in ["half", "both"] {
                agree(&what, event(&before, mark, "mark").time, 0.8 * bends, 1e-6);
            }
            let simulation = Simulation::new(&scene)
                .method(method.to_string().parse().expect("a method"))
                .tolerance(tolerance);
            let until = 0.9 * (small + large) / rate;
            let failure = simulation
                .run(state(&[0.0], &[0.0]), 0.0..until)
                .expect_err("a share that has no value of its own");
            let Error::Undetermined { time, item, mode } = &failure.error else {
                panic!("{what}: {failure}");
            };
            assert_eq!(*item, "half", "{what}");
            assert_eq!(mode, "weak sticks, strong sticks", "{what}");
            assert!((bends..=until).contains(time), "{what}: {time}");
        }
    }
}

/// What is pressed between a blade that turns with time and a corner.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y),
    define(angle = first + rate*t),
    kinetic = (der(x)^2 + der(y)^2)/2,
    force(push: (load*cos(angle), -load*sin(angle)) at (x, y)),
    constraint(blade: der(y)*cos(angle) == der(x)*sin(angle)),
    contact(wall: -x >= 0),
    contact(floor: y >= 0),
    start(corner),
    mark(pressed: wall >= asked),
)]
struct Corner {
    first: f64,
    rate: f64,
    load: f64,
    asked: f64,
}

/// Three forces in a plane, of which one is open, in directions that change: no series tells the share that results report.
#[test]
fn a_mark_on_a_share_is_refused_where_directions_turn() {
    for (first, rate, load) in [(0.4, 0.3, 2.0), (0.7, -0.2, 11.0)] {
        let scene = Corner {
            first,
            rate,
            load,
            asked: 0.3 * load,
        };
        let failure = Simulation::new(&scene)
            .run(scene.at(Corner::CORNER), 0.0..1.0)
            .expect_err("a share that has no value of its own");
        let Error::Undetermined { item, .. } = failure.error else {
            panic!("{failure}; {:?}", words(&failure.trajectory));
        };
        assert_eq!(item, "pressed");
    }
}
