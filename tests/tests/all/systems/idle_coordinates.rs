//! Coordinates without inertia of their own that constraints tie to others: the same motion is written with them and without.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, TOLERANCES, agree, all_agree, certified, methods_at, run_by, times};

/// A slider-crank whose guide rubs.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(a, b, x, y),
    constraint(joint_x: x == crank * cos(a) + rod * cos(b)),
    constraint(joint_y: y == crank * sin(a) - rod * sin(b)),
    constraint(guide: y == 0),
    kinetic = wheel/2 * der(a)^2 + der(b)^2/400 + piston/2 * (der(x)^2 + der(y)^2),
    potential = 9.81 * piston * y,
    friction(rub on guide: slip = der(x), static = mu),
)]
struct Crank {
    crank: f64,
    rod: f64,
    wheel: f64,
    piston: f64,
    mu: f64,
}

/// The same with the piston at `u`, which is where `x` is.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(a, b, x, y, u),
    constraint(red: u == x),
    constraint(joint_x: x == crank * cos(a) + rod * cos(b)),
    constraint(joint_y: y == crank * sin(a) - rod * sin(b)),
    constraint(guide: y == 0),
    kinetic = wheel/2 * der(a)^2 + der(b)^2/400 + piston/2 * (der(u)^2 + der(y)^2),
    potential = 9.81 * piston * y,
    friction(rub on guide: slip = der(x), static = mu),
)]
struct Doubled {
    crank: f64,
    rod: f64,
    wheel: f64,
    piston: f64,
    mu: f64,
}

/// In its dead centres nothing but the joint tells the place that has no inertia how it moves.
#[test]
fn a_crank_reverses_where_it_does_with_a_place_that_is_told_twice() {
    for (wheel, piston, mu) in [(0.05, 1.0, 0.1), (0.02, 0.4, 0.3), (0.3, 2.0, 0.05)] {
        let (crank, rod) = (0.1, 0.3);
        let once = Crank {
            crank,
            rod,
            wheel,
            piston,
            mu,
        };
        let twice = Doubled {
            crank,
            rod,
            wheel,
            piston,
            mu,
        };
        let (q, v) = ([0.0, 0.0, 0.4, 0.0, 0.4], [30.0, 10.0, 0.0, 0.0, 0.0]);
        let reference = run_by(&once, ("verner98", 1e-12), state(&q[..4], &v[..4]), 0.6);
        let expected = times(&reference, "rub", "reverses");
        assert!(expected.len() > 3, "{expected:?}");
        for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
            let motion = run_by(&twice, (method, tolerance), state(&q, &v), 0.6);
            let what = format!("{twice:?} by {method} at {tolerance:e}");
            let bound = (1e3 * tolerance).max(1e-10);
            all_agree(&what, &times(&motion, "rub", "reverses"), &expected, bound);
            certified(&what, &motion);
        }
    }
}

/// A mass on a damper whose force grows with the square of its rate; its place is told twice, and two others have nothing to do with it.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(s, z, th, x, u, w),
    constraint(red_x: u == x),
    constraint(red_z: w == z),
    kinetic = (m * der(s)^2 + der(u)^2 + m * der(w)^2 + der(th)^2) / 2,
    force(pull: -load along der(z)),
    dissipation(oil: abs(der(z) - der(s))^3),
    start(still),
)]
struct Damped {
    m: f64,
    load: f64,
}

/// With r = ż − ṡ from rest, m r' = −load + 6 r²: r = −√(load/6) tanh(√(6 load) t/m), and z = (−load t²/(2 m) + ∫r)/2.
#[test]
fn a_damper_brakes_whatever_other_coordinates_there_are() {
    for (m, load) in [(2.0, 1.0), (1.0, 3.0), (0.5, 0.2)] {
        let scene = Damped { m, load };
        let (rate, end) = ((6.0 * load).sqrt() / m, 1.0_f64);
        let between = -(load / 6.0).sqrt() * (rate * end).cosh().ln() / rate;
        let z = (between - load * end * end / (2.0 * m)) / 2.0;
        for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
            let motion = run_by(&scene, (method, tolerance), scene.at(Damped::STILL), end);
            let what = format!("{scene:?} by {method} at {tolerance:e}");
            agree(&what, motion.final_state().q[1], z, 10.0 * tolerance);
            certified(&what, &motion);
        }
    }
}
