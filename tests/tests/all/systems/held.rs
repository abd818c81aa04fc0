//! What an impact elsewhere does to contacts that are closed, and to the rows that hold with them.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{agree, run, words};

/// A wheel that rolls on the floor against a smooth ramp.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, phi),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + inertia/2 * der(phi)^2,
    potential = mass * gravity * y,
    contact(floor: y >= 0),
    constraint(rolls while floor: der(x) == radius * der(phi)),
    contact(ramp: y * cos(slope) >= x * sin(slope), restitution = bounce),
)]
struct Wheel {
    mass: f64,
    inertia: f64,
    radius: f64,
    gravity: f64,
    slope: f64,
    bounce: f64,
}

/// The blow lifts it off the floor, which then holds it no more: v⁺ = v⁻ − (1 + e)(n·v⁻) n, and the spin stays.
#[test]
fn a_contact_that_parts_in_an_impact_does_not_hold_what_it_carries() {
    let scene = Wheel {
        mass: 2.0,
        inertia: 0.3,
        radius: 0.5,
        gravity: 9.81,
        slope: 0.6,
        bounce: 0.4,
    };
    let speed = 1.5;
    let start = state(&[-0.3, 0.0, 0.0], &[speed, 0.0, speed / scene.radius]);
    let motion = run(&scene, start, 0.21);
    assert_eq!(words(&motion), ["ramp impact", "floor lost"]);
    let (sin, cos) = scene.slope.sin_cos();
    let share = (1.0 + scene.bounce) * sin * speed;
    let v = &motion.events()[0].state_after.v;
    agree("ẋ", v[0], speed - share * sin, 1e-13);
    agree("ẏ", v[1], share * cos, 1e-13);
    agree("φ̇", v[2], speed / scene.radius, 1e-14);
}

/// A bead that slides in a bowl, up to a lid that presses it into the bowl.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    potential = gravity * y,
    contact(bowl: 1 >= sqrt(x^2 + y^2), restitution = 0.9),
    contact(lid: top >= y, restitution = bounce),
)]
struct Bead {
    gravity: f64,
    top: f64,
    bounce: f64,
}

/// A closed contact approaches at no rate, whatever drift has left of it: nothing to be thrown back.
#[test]
fn a_closed_contact_does_not_bounce_in_the_impact_of_another() {
    let scene = Bead {
        gravity: 9.81,
        top: -0.5,
        bounce: 0.7,
    };
    for tolerance in [1e-3, 1e-5, 1e-7] {
        let motion = Simulation::new(&scene)
            .tolerance(tolerance)
            .run(state(&[0.0, -1.0], &[4.0, 0.0]), 0.0..0.5)
            .expect("a run");
        let hits = words(&motion);
        assert!(hits.iter().all(|word| word == "lid impact"), "{hits:?}");
        // The lid returns its part of ẏ, and the bowl takes what is radial: v⁺ = −e v⁻ along the circle.
        let hit = &motion.events()[0];
        let (before, after) = (&hit.state.v, &hit.state_after.v);
        for (before, after) in before.iter().zip(after) {
            agree("rate", *after, -scene.bounce * before, tolerance);
        }
    }
}
