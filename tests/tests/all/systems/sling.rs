//! A mass on a string that goes slack.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{agree, closure, event, integral, root, run};

/// A mass on a string: a contact from inside.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    contact(string: length^2 >= x^2 + y^2),
    stop(top: y >= 10),
)]
struct Sling {
    mass: f64,
    gravity: f64,
    length: f64,
}

#[test]
fn a_string_goes_slack_where_the_tension_vanishes() {
    let (gravity, length, speed): (f64, f64, f64) = (9.81, 1.2, 7.0);
    let scene = Sling {
        mass: 1.0,
        gravity,
        length,
    };
    let trajectory = run(&scene, state(&[0.0, -length], &[speed, 0.0]), 1.0);
    let slack = event(&trajectory, "string", "lost");
    // T = m(v² − g y)/l = 0 with v² = v₀² − 2 g (y + l): y = (v₀² − 2 g l)/(3 g).
    agree(
        "height",
        slack.state.q[1],
        (speed * speed - 2.0 * gravity * length) / (3.0 * gravity),
        1e-11,
    );
    let angle = (-slack.state.q[1] / length).acos();
    let rate = |d: f64| (speed * speed - 2.0 * gravity * length * (1.0 - d.cos())).sqrt() / length;
    agree(
        "time",
        slack.time,
        integral(|d| rate(d).recip(), 0.0, angle),
        1e-11,
    );
}

/// After a parabola the string is taut again: it takes the radial velocity away and leaves the rest.
#[test]
fn a_slack_string_is_taut_again() {
    let (gravity, length, speed): (f64, f64, f64) = (9.81, 1.2, 7.0);
    let scene = Sling {
        mass: 2.0,
        gravity,
        length,
    };
    let trajectory = run(&scene, state(&[0.0, -length], &[speed, 0.0]), 3.0);
    let slack = event(&trajectory, "string", "lost");
    let ([x, y], [vx, vy]) = (
        [slack.state.q[0], slack.state.q[1]],
        [slack.state.v[0], slack.state.v[1]],
    );
    let place = |t: f64| [x + vx * t, y + vy * t - 0.5 * gravity * t * t];
    let flight = root(|t| place(t)[0].hypot(place(t)[1]) - length, 0.05, 3.0);
    let hit = event(&trajectory, "string", "impact");
    agree("time", hit.time - slack.time, flight, 1e-10);
    let [x, y] = place(flight);
    let (vx, vy) = (vx, vy - gravity * flight);
    let (nx, ny) = (x / length, y / length);
    let radial = vx * nx + vy * ny;
    agree("vx", hit.state_after.v[0], vx - radial * nx, 1e-10);
    agree("vy", hit.state_after.v[1], vy - radial * ny, 1e-10);
    // The multiplier belongs to the gap l² − r², whose gradient has length 2 r.
    agree(
        "impulse",
        2.0 * length * hit.impulses[0],
        2.0 * radial,
        1e-9,
    );
    let ledger = trajectory.ledger().expect("sampled");
    let jerk = ledger
        .work
        .iter()
        .find(|e| e.kind == "impact")
        .expect("the jerk");
    agree("energy lost", jerk.work, -radial * radial, 1e-9);
    assert!(closure(&trajectory) < 1e-10);
}
