//! A table on six feet, which may do more together than is looked at mode by mode.

use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, agree, certified, methods_at, run_by, times};

/// A round table on six feet that hardly tilts, pushed through its centre at some height over the floor.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, turn, z, a, b),
    define(
        east[k in 0..6] = cos(pi/3*k)*cos(turn) - sin(pi/3*k)*sin(turn),
        north[k in 0..6] = cos(pi/3*k)*sin(turn) + sin(pi/3*k)*cos(turn),
    ),
    kinetic = mass/2*(der(x)^2 + der(y)^2 + der(z)^2) + mass/8*(der(a)^2 + der(b)^2 + der(turn)^2),
    potential = 10*mass*z,
    contact(foot[k in 0..6]: z + a*east[k] + b*north[k] >= 0),
    friction(grip[k in 0..6] on foot[k]: slip = (der(x) - der(turn)*north[k], der(y) + der(turn)*east[k]), static = mu, kinetic = rub),
    force(push: x = grows*t),
    force(lever: a = -height*grows*t),
    start(rest),
)]
struct Table {
    mass: f64,
    mu: f64,
    rub: f64,
    height: f64,
    grows: f64,
}

/// All feet lie on the floor while it slides, and carry what six equal springs would: loads that are linear in their places.
#[test]
fn six_feet_slide_on_and_share_the_load_as_springs_do() {
    for (mass, mu, rub, height) in [
        (4.9, 0.4, 0.2, 0.0),
        (1.0, 0.3, 0.3, 0.0),
        (2.0, 0.5, 0.25, 0.3),
    ] {
        let table = Table {
            mass,
            mu,
            rub,
            height,
            grows: 6.0 * mass,
        };
        let begins = mu * 10.0 * mass / table.grows;
        for (method, tolerance) in methods_at(METHODS, [1e-9]) {
            let what = format!("{table:?} by {method} at {tolerance:e}");
            let end = begins + 0.4;
            let run = run_by(&table, (method, tolerance), table.at(Table::REST), end);
            let at = run.sampler().at(end).expect("a time of the run");
            for k in 0..6 {
                assert!(
                    times(&run, &format!("foot[{k}]"), "lost").is_empty(),
                    "{what}"
                );
                let slips = times(&run, &format!("grip[{k}]"), "slips");
                agree(&what, slips[0], begins, 1e-7);
                // Σ N east = height·push, with Σ east² = 3.
                let place = (core::f64::consts::PI / 3.0 * k as f64).cos();
                let load = 10.0 * mass / 6.0 + height * table.grows * end * place / 3.0;
                agree(&what, at.force(Table::FOOT[k]), load, 1e-6);
            }
            let cubic = |t: f64| table.grows / mass * t * t * t / 6.0 - rub * 5.0 * t * t;
            let speed = table.grows / mass * begins * begins / 2.0 - rub * 10.0 * begins;
            let goes = cubic(end) - cubic(begins) - speed * (end - begins);
            agree(&what, run.final_state().q[0], goes, 1e-7);
            certified(&what, &run);
        }
    }
}
