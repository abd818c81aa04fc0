//! Frictions that constraints leave nothing to do: the slip is what the constraint says, whatever the friction does.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, Random, all_agree, certified, methods_at, run_by};

/// A disc that is geared to a rack falls onto a moving belt.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, u),
    kinetic = (der(x)^2 + der(y)^2) / 2 + inertia/2 * der(u)^2,
    potential = 10 * y,
    constraint(rack: der(x) == radius * der(u)),
    contact(floor: y >= radius, restitution = bounce),
    friction(rub on floor: slip = der(x) - radius * der(u) - belt, static = mu),
)]
struct Disc {
    inertia: f64,
    radius: f64,
    bounce: f64,
    belt: f64,
    mu: f64,
}

/// Along the floor nothing changes, and upwards it bounces as without friction.
#[test]
fn a_geared_disc_is_not_moved_by_its_belt() {
    let mut random = Random::new(563);
    for _ in 0..20 {
        let [inertia, radius, bounce, height] = [(0.1, 2.0), (0.1, 2.0), (0.55, 0.9), (0.1, 1.0)]
            .map(|(low, high)| random.between(low, high));
        let (belt, mu) = (random.between(-2.0, 2.0), random.between(0.1, 1.0));
        let disc = Disc {
            inertia,
            radius,
            bounce,
            belt,
            mu,
        };
        let speed = random.between(-2.0, 2.0);
        let start = state(&[0.0, radius + height, 0.0], &[speed, 0.0, speed / radius]);
        // Up to the middle of the second flight.
        let fall = (height / 5.0).sqrt();
        let until = fall + 3.0 * bounce * fall;
        let rise = 10.0 * bounce * bounce * fall;
        let late = bounce * fall;
        let after = radius + rise * late - 5.0 * late * late;
        for pair in methods_at(METHODS, [1e-9]) {
            let what = format!("{disc:?} by {pair:?}");
            let run = run_by(&disc, pair, start.clone(), until);
            let expected = [speed * until, after, speed / radius * until];
            all_agree(&what, &run.final_state().q, &expected, 1e-8);
            certified(&what, &run);
        }
    }
}

/// A bar falls flat on both its ends; a rod along the floor holds its middle.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, u),
    kinetic = (der(x)^2 + der(y)^2) / 2 + inertia/2 * der(u)^2,
    potential = 10 * y,
    constraint(rod: sqrt((x + long)^2 + y^2) == long),
    contact(left: y - half * sin(u) >= 0, restitution = bounce),
    contact(right: y + half * sin(u) >= 0, restitution = bounce),
    friction(fl on left: slip = der(x - half * cos(u)), static = mu),
    friction(fr on right: slip = der(x + half * cos(u)), static = mu),
)]
struct Bar {
    inertia: f64,
    long: f64,
    half: f64,
    bounce: f64,
    mu: f64,
}

/// Friction has nothing to stop where the rod lies along the floor: the speed comes back by the coefficient of restitution.
#[test]
fn a_bar_on_a_rod_bounces_as_without_friction() {
    let mut random = Random::new(564);
    for _ in 0..10 {
        let [inertia, long, half, bounce, mu, height] = [
            (0.1, 1.0),
            (0.3, 2.0),
            (0.2, 1.0),
            (0.2, 0.9),
            (0.1, 1.0),
            (0.05, 0.25),
        ]
        .map(|(low, high)| random.between(low, high));
        let bar = Bar {
            inertia,
            long,
            half,
            bounce,
            mu,
        };
        let start = || {
            state(
                &[(long * long - height * height).sqrt() - long, height, 0.0],
                &[0.0; 3],
            )
        };
        for pair in methods_at(METHODS, [1e-9]) {
            let what = format!("{bar:?} by {pair:?}");
            let run = run_by(&bar, pair, start(), 0.6);
            let hit = &run.events()[0];
            let speed = hit.state_after.v[1] / (10.0 * height).sqrt();
            // The energy of a pendulum that falls from this height.
            all_agree(&what, &[speed], &[bounce * 2.0_f64.sqrt()], 1e-8);
            certified(&what, &run);
        }
    }
}
