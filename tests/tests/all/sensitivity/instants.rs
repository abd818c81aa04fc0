//! Derivatives of the instants of events, dt/dp = −(∂g/∂p)/ġ, by every method and at every tolerance as exact as the instants are.

use super::{Slopes, run, same_slopes, seeded};
use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, TOLERANCES, methods_at, root};

/// A ball falls onto a plate that shakes.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(y),
    kinetic = der(y)^2 / 2,
    potential = gravity * y,
    contact(plate: y >= amplitude * sin(rate * t)),
    start(held: y = height),
    stop(hit: closed(plate)),
)]
struct ShakenPlate<T = f64> {
    gravity: T,
    amplitude: T,
    rate: T,
    height: T,
}

/// The impact solves h − g t²/2 = a sin ωt. Runge–Kutta steps are long, and what is watched in them is known well where it vanishes only.
#[test]
fn a_plate_that_shakes_is_hit() {
    let cases = [
        (0.28, 18.1, 1.34),
        (0.16, 29.2, 1.44),
        (0.26, 27.5, 0.68),
        (0.05, 11.0, 0.9),
    ];
    for ((amplitude, rate, height), (method, tolerance)) in cases
        .into_iter()
        .flat_map(|case| methods_at(METHODS, TOLERANCES).map(move |settings| (case, settings)))
    {
        let p = [9.7, amplitude, rate, height];
        let [gravity, amplitude, rate, height] = seeded(p);
        let plate = ShakenPlate {
            gravity,
            amplitude,
            rate,
            height,
        };
        let start = plate.at(<ShakenPlate>::HELD);
        let record = run(&plate, start, 5.0, (tolerance, method));
        let time = record.events()[0].time;
        let [g, a, w, h] = p;
        let gap = |t: f64| h - 0.5 * g * t * t - a * (w * t).sin();
        let t = root(gap, time.value - 1e-4, time.value + 1e-4);
        let rate = -g * t - a * w * (w * t).cos();
        let by = [-0.5 * t * t, -(w * t).sin(), -a * t * (w * t).cos(), 1.0];
        let mut expected = Slopes::constant(t);
        for (slope, by) in expected.derivative.iter_mut().zip(by) {
            *slope = -by / rate;
        }
        let what = format!("{method:?} at {tolerance:e}");
        same_slopes(&what, time, expected, (1e3 * tolerance).max(1e-10));
    }
}

/// A mass under a constant force, with marks that pass zero and touch it where it comes to a place.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = der(x)^2 / 2,
    potential = -force * x,
    start(goes: der(x) = speed),
    mark(passes: x - place),
    mark(touches: cos(x - place) - 1),
    mark(cube: (x - place)^3),
)]
struct Passes<T = f64> {
    force: T,
    speed: T,
    place: T,
}

/// All of them move as x = u t + f t²/2 comes to the place, although the last two have no slope there.
#[test]
fn what_only_touches_zero_moves_with_where_it_turns() {
    for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
        let [force, speed, place] = seeded([0.3, 1.2, 0.9]);
        let scene = Passes {
            force,
            speed,
            place,
        };
        let start = scene.at(<Passes>::GOES);
        let record = run(&scene, start, 2.0, (tolerance, method));
        let root = (speed * speed + Slopes::constant(2.0) * force * place).sqrt();
        let expected = (root - speed) / force;
        let d = record.description();
        for event in record.events() {
            let name = event.subject.name(d);
            // What is touched is located to the root of the tolerance.
            let allowed = match name == "touches" {
                true => 1e-4,
                false => (100.0 * tolerance).max(1e-10),
            };
            same_slopes(
                &format!("{name} by {method:?}"),
                event.time,
                expected,
                allowed,
            );
        }
    }
}

/// A ball falls for a second.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(y),
    kinetic = der(y)^2 / 2,
    potential = gravity * y,
    contact(floor: y >= 0, restitution = 0.5),
    start(held: y = height),
)]
struct Fall<T = f64> {
    gravity: T,
    height: T,
}

/// What happens at the last instant of a span moves with it, t = √(2h/g).
#[test]
fn the_instant_of_an_impact_at_the_end_of_a_run_moves() {
    for (height, until) in [(1.0, 1.0), (4.0, 2.0)] {
        let [gravity, height] = seeded([2.0, height]);
        let ball = Fall { gravity, height };
        let record = run(&ball, ball.at(<Fall>::HELD), until, (1e-9, Method::Auto));
        assert_eq!(record.last_time(), until);
        let [impact] = record.events() else {
            panic!("{record}");
        };
        let expected = (Slopes::constant(2.0) * height / gravity).sqrt();
        same_slopes("impact", impact.time, expected, 1e-12);
    }
}

/// A mass on its way to a wall and back, across which a wind changes.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    force(wind: y = if(x >= 1.5 * unit, 1, -1)),
    contact(wall: x <= 3 * unit, restitution = 1/2),
    mark(half: x - unit / 2),
    mark(far: x - 2 * unit),
    stop(back: x <= unit and t >= 4 * unit),
    start(goes: der(x) = 1),
)]
struct Way<T = f64> {
    unit: T,
}

/// All that happens at multiples of the unit of length does so in proportion to it, also where fixed steps end there: in these and in those that
/// follow.
#[test]
fn what_happens_where_steps_end_moves() {
    for method in [
        "rk4:0.1",
        "gauss6:0.1",
        "rk4:0.125",
        "auto",
        "dopri5",
        "radau5",
    ] {
        let method: Method = method.parse().expect("a method");
        for tenths in 1..20 {
            let [unit] = seeded([0.1 * f64::from(tenths)]);
            let scene = Way { unit };
            let record = run(&scene, scene.at(<Way>::GOES), 40.0, (1e-9, method));
            let times = record.events().iter().map(|event| event.time);
            let times: Vec<Slopes> = times.collect();
            let multiples = [0.5, 1.5, 2.0, 3.0, 5.0, 6.0, 7.0];
            assert_eq!(times.len(), multiples.len(), "{method:?}: {record}");
            for (time, multiple) in times.into_iter().zip(multiples) {
                let expected = Slopes::constant(multiple) * unit;
                let what = format!("{multiple} of {tenths} by {method:?}");
                same_slopes(&what, time, expected, 1e-9);
            }
        }
    }
}
