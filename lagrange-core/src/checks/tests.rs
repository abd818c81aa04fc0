//! SwitchFacts formulas match, wrong ones are told with the worst state.

use super::Checks;
use crate::assert_matches;
use crate::prelude::*;
use core::cell::RefCell;

#[derive(Lagrangian, Clone)]
#[lagrange(
    coordinates(r, theta, phi),
    define(x = r * sin(theta), y = r * cos(theta)),
    kinetic   = mass/2 * (der(x)^2 + der(y)^2) + 1/5 * mass * size^2 * der(phi)^2,
    potential = mass * gravity * y,
    contact(shell: r >= radius + size),
    friction(grip on shell: slip = radius * der(theta) - size * (der(phi) - der(theta)), static = mu),
)]
struct Sphere {
    mass: f64,
    radius: f64,
    size: f64,
    gravity: f64,
    mu: f64,
}

const SPHERE: Sphere = Sphere {
    mass: 1.2,
    radius: 1.0,
    size: 0.2,
    gravity: 9.81,
    mu: 0.4,
};

#[test]
fn rolling_slipping_and_flying() {
    let checks = Checks::new(&SPHERE).vary_parameters(0.3);
    let rolling = checks.clone().sticks(Sphere::GRIP);
    assert_matches!(rolling, |s, now| now.force(Sphere::GRIP) =>
        -2.0 / 7.0 * s.mass * s.gravity * now.q(Sphere::THETA).sin());
    assert_matches!(rolling, |s, now| now.a(Sphere::THETA) =>
        5.0 / 7.0 * s.gravity * now.q(Sphere::THETA).sin() / (s.radius + s.size));
    assert_matches!(rolling, |s, now| now.margin(Sphere::GRIP) =>
        s.mu * now.force(Sphere::SHELL) - (2.0 / 7.0 * s.mass * s.gravity * now.q(Sphere::THETA).sin()).abs());
    let slipping = checks.clone().slips(Sphere::GRIP);
    assert_matches!(slipping, |s, now| now.force(Sphere::GRIP) =>
        -s.mu * now.force(Sphere::SHELL) * now.slip(Sphere::GRIP).signum());
    let flying = checks.around(State::new(vec![3.0, 0.0, 0.0], vec![0.0; 3]));
    assert_matches!(flying, |s, now| now.a(Sphere::R) =>
        now.q(Sphere::R) * now.v(Sphere::THETA).powi(2) - s.gravity * now.q(Sphere::THETA).cos());
    assert_matches!(flying, |s, now| now.gap(Sphere::SHELL) =>
        now.q(Sphere::R) - s.radius - s.size);
}

#[test]
fn a_wrong_formula_is_told_with_its_worst_state() {
    let checks = Checks::new(&SPHERE)
        .closed(Sphere::SHELL)
        .seed(7)
        .states(40);
    let weight = |s: &Sphere, now: &Instant<f64>| s.mass * s.gravity * now.q(Sphere::THETA).cos();
    let comparison = checks.compare(|s, now| (now.force(Sphere::SHELL), weight(s, now)));
    let comparison = comparison.unwrap();
    assert!(!comparison.holds());
    assert_eq!(comparison.states, 40);
    let theta_rate = comparison
        .state
        .iter()
        .find(|(name, _)| name == "der(theta)");
    let rate = theta_rate.unwrap().1;
    // What is missing is the centripetal part, largest where it turns fastest.
    let missing = SPHERE.mass * 1.2 * rate * rate;
    assert!((comparison.worst.by_hand - comparison.worst.derived - missing).abs() < 1e-12);
    let text = comparison.to_string();
    assert!(
        text.contains("worst of 40 states, shell closed) at mass = 1.2, "),
        "{text}"
    );
}

/// A mass on a spring, on a table that is shaken.
#[derive(Lagrangian, Clone)]
#[lagrange(
    coordinates(x),
    define(place = x + amplitude * sin(omega * t)),
    kinetic   = mass/2 * der(place)^2,
    potential = stiffness/2 * x^2,
)]
struct Shaken {
    mass: f64,
    stiffness: f64,
    amplitude: f64,
    omega: f64,
}

const SHAKEN: Shaken = Shaken {
    mass: 1.2,
    stiffness: 30.0,
    amplitude: 0.1,
    omega: 5.0,
};

#[test]
fn a_wrong_term_of_time_is_found() {
    // m (ẍ − A ω² sin ωt) = −k x; the wrong one turns twice as fast, which cannot be seen where the sine is zero.
    let swings = |turns: f64| {
        move |s: &Shaken, now: &Instant<f64>| {
            let pushed = s.amplitude * s.omega.powi(2) * (turns * s.omega * now.time).sin();
            (
                now.a(Shaken::X),
                pushed - s.stiffness / s.mass * now.q(Shaken::X),
            )
        }
    };
    let checks = Checks::new(&SHAKEN).vary_parameters(0.3);
    let late = checks.clone().times(100.0..200.0);
    for checks in [&checks, &late] {
        assert!(checks.compare(swings(1.0)).unwrap().holds());
        assert!(!checks.compare(swings(2.0)).unwrap().holds());
    }
    let times = |checks: Checks<'_, Shaken>| {
        let times = RefCell::new(Vec::new());
        let outcome = checks.compare(|_, now| {
            times.borrow_mut().push(now.time);
            (0.0, 0.0)
        });
        outcome.unwrap();
        times.into_inner()
    };
    assert_eq!(times(checks.clone()), times(checks.clone()));
    assert!(times(late).iter().all(|t| (100.0..200.0).contains(t)));
    let still = checks.times(0.0..0.0);
    assert!(still.compare(swings(2.0)).unwrap().holds());
    let text = still.compare(swings(2.0)).unwrap().to_string();
    assert!(text.ends_with(", t = 0"), "{text}");
}

#[test]
#[should_panic(expected = "`now.a(Sphere::R)` is not `0.5`: derived 0, by hand 0.5")]
fn the_assertion_panics() {
    let checks = Checks::new(&SPHERE).closed(Sphere::SHELL);
    assert_matches!(checks, |_, now| now.a(Sphere::R) => 0.5);
}
