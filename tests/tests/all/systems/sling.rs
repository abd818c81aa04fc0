//! A mass on a string that goes slack.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{agree, event, integral, run};

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
