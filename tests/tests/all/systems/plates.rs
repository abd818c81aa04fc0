//! Plates that fall flat, in space and in the plane: near the unit quaternion its real part has hardly any inertia.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, Random, TOLERANCES, agree, certified, methods_at, run_by};

/// A plate on two feet, which moves in a plane.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(p[3]),
    attitude(body: q),
    define(
        side = [-wide, wide],
        foot[k in 0..2] = p + side[k]*body.axes[0] - high*body.axes[2],
    ),
    kinetic = dot(der(p), der(p))/2 + inertia/2*dot(body.body_rate, body.body_rate),
    potential = 9.81*p[2],
    contact(ground[k in 0..2]: foot[k][2] >= 0, restitution = bounce),
    friction(rub[k in 0..2] on ground[k]: slip = (der(foot[k][0]), der(foot[k][1])), static = mu),
    start(drop: p = [0, 0, fall], der(p) = [speed, 0, 0], body.turn = (0, -tilt, 0), body.space_rate = (0, -spin, 0)),
)]
struct InSpace {
    wide: f64,
    high: f64,
    inertia: f64,
    bounce: f64,
    mu: f64,
    fall: f64,
    speed: f64,
    tilt: f64,
    spin: f64,
}

/// The same plate in the coordinates of its plane.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, theta),
    define(
        side = [-wide, wide],
        ahead[k in 0..2] = x + side[k]*cos(theta) + high*sin(theta),
        above[k in 0..2] = y + side[k]*sin(theta) - high*cos(theta),
    ),
    kinetic = (der(x)^2 + der(y)^2)/2 + inertia/2*der(theta)^2,
    potential = 9.81*y,
    contact(ground[k in 0..2]: above[k] >= 0, restitution = bounce),
    friction(rub[k in 0..2] on ground[k]: slip = der(ahead[k]), static = mu),
)]
struct InPlane {
    wide: f64,
    high: f64,
    inertia: f64,
    bounce: f64,
    mu: f64,
}

#[test]
fn a_plate_falls_flat_in_space_as_in_its_plane() {
    let mut random = Random::new(1);
    for case in 0..24 {
        let bounce = [0.0, 0.2][case % 2];
        let scene = InSpace {
            wide: random.between(0.15, 0.3),
            high: random.between(0.05, 0.25),
            inertia: random.between(0.01, 0.04),
            bounce,
            mu: random.between(0.1, 0.6),
            fall: 0.6,
            speed: random.between(-1.0, 1.0),
            tilt: random.between(-0.7, 0.7),
            spin: [0.0, random.between(-2.0, 2.0)][case / 2 % 2],
        };
        let plane = InPlane {
            wide: scene.wide,
            high: scene.high,
            inertia: scene.inertia,
            bounce,
            mu: scene.mu,
        };
        let start = state(&[0.0, 0.6, scene.tilt], &[scene.speed, 0.0, scene.spin]);
        let flat = run_by(&plane, ("dop853", 1e-12), start, 0.9);
        for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
            let what = format!("{case}: {scene:?} by {method} at {tolerance:e}");
            let drop = scene.at(InSpace::DROP);
            let run = run_by(&scene, (method, tolerance), drop, 0.9);
            let [x, _, z, ..] = run.final_state().q[..] else {
                panic!("seven coordinates")
            };
            agree(&what, x, flat.final_state().q[0], 1e3 * tolerance);
            agree(&what, z, flat.final_state().q[1], 1e3 * tolerance);
            certified(&what, &run);
        }
    }
}

/// A box on four feet, which moves in a plane, with Poisson's law of impact.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(p[3]),
    attitude(body: q),
    define(
        side = [[-long, -wide], [-long, wide], [long, -wide], [long, wide]],
        foot[k in 0..4] = p + side[k][0]*body.axes[0] + side[k][1]*body.axes[1] - high*body.axes[2],
    ),
    kinetic = dot(der(p), der(p))/2 + inertia/2*dot(body.body_rate, body.body_rate),
    potential = 9.81*p[2],
    contact(ground[k in 0..4]: foot[k][2] >= 0, restitution = poisson(bounce)),
    friction(rub[k in 0..4] on ground[k]: slip = (der(foot[k][0]), der(foot[k][1])), static = mu),
    start(drop: p = [0, 0, fall], der(p) = [speed, 0, -1], body.turn = (0, tilt, 0), body.space_rate = (0, spin, 0)),
)]
struct BoxInSpace {
    long: f64,
    wide: f64,
    high: f64,
    inertia: f64,
    bounce: f64,
    mu: f64,
    fall: f64,
    speed: f64,
    tilt: f64,
    spin: f64,
}

/// The same box in the coordinates of its plane.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, z, theta),
    define(
        side = [-long, long],
        ahead[k in 0..2] = x + side[k]*cos(theta) - high*sin(theta),
        above[k in 0..2] = z - side[k]*sin(theta) - high*cos(theta),
    ),
    kinetic = (der(x)^2 + der(z)^2)/2 + inertia/2*der(theta)^2,
    potential = 9.81*z,
    contact(ground[k in 0..2]: above[k] >= 0, restitution = poisson(bounce)),
    friction(rub[k in 0..2] on ground[k]: slip = der(ahead[k]), static = mu),
)]
struct BoxInPlane {
    long: f64,
    high: f64,
    inertia: f64,
    bounce: f64,
    mu: f64,
}

/// Four frictions of two components hold what their tilt, an error of the state, keeps from holding to the last digit.
#[test]
fn a_box_slaps_flat_in_space_as_in_its_plane() {
    let mut random = Random::new(5);
    let mut slapped = 0;
    for case in 0..16 {
        let scene = BoxInSpace {
            long: 0.2,
            wide: random.between(0.08, 0.12),
            high: 0.1,
            inertia: random.between(0.01, 0.02),
            bounce: random.between(0.3, 0.6),
            mu: random.between(0.08, 0.15),
            fall: 0.72,
            speed: random.between(0.8, 1.6),
            tilt: 0.5,
            spin: random.between(5.0, 6.5),
        };
        let plane = BoxInPlane {
            long: scene.long,
            high: scene.high,
            inertia: scene.inertia,
            bounce: scene.bounce,
            mu: scene.mu,
        };
        let start = state(&[0.0, 0.72, scene.tilt], &[scene.speed, -1.0, scene.spin]);
        let flat = run_by(&plane, ("dop853", 1e-12), start, 1.5);
        // Up to a little after the first impact that takes in both edges.
        let both = flat.events().iter().find(|event| {
            let impulses = event.impulses.iter();
            impulses.filter(|impulse| impulse.abs() > 1e-6).count() > 2
        });
        let Some(both) = both else { continue };
        slapped += 1;
        let until = both.time + 1e-3;
        let flat = run_by(&plane, ("dop853", 1e-12), flat.first_state().clone(), until);
        for (method, tolerance) in methods_at(["auto", "dop853", "verner98"], [1e-8, 1e-9, 1e-10]) {
            let what = format!("{case}: {scene:?} by {method} at {tolerance:e}");
            let drop = scene.at(BoxInSpace::DROP);
            let run = run_by(&scene, (method, tolerance), drop, until);
            for (i, k) in [(0, 0), (2, 1)] {
                agree(
                    &what,
                    run.final_state().v[i],
                    flat.final_state().v[k],
                    1e3 * tolerance,
                );
            }
            certified(&what, &run);
        }
    }
    assert!(slapped > 4, "{slapped}");
}
