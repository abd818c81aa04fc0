//! Friction on a constraint that holds while a contact is closed: the bearing of a wheel that rolls. In the air nothing presses it, and in an impact it rubs
//! with μ times the impulse of the rolling.

use lagrange_core::prelude::*;
use lagrange_tests::{
    Random, SINGLE_METHODS, agree, certified, event, first_start, methods_at, run_by,
};

/// A disc that is thrown onto a floor on which it rolls, with a rough pin.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, phi),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + inertia/2 * der(phi)^2,
    potential = mass * gravity * y,
    contact(floor: y >= 0, restitution = bounce),
    constraint(roll while floor: der(x) == radius * der(phi)),
    friction(bearing on roll: slip = pin * der(phi), static = mu),
    start(thrown: y = height, der(x) = speed),
)]
struct Disc {
    mass: f64,
    inertia: f64,
    radius: f64,
    pin: f64,
    mu: f64,
    gravity: f64,
    bounce: f64,
    height: f64,
    speed: f64,
}

/// With Λ of the rolling, I φ̇ = (R − μ p) Λ and m (u − ẋ) = Λ after the first impact; whatever rolls or flies then goes on at that speed, without a force.
#[test]
fn a_disc_that_lands_rolls_as_its_bearing_lets_it() {
    let mut random = Random::new(81);
    for k in 0..8 {
        let disc = Disc {
            mass: random.between(0.5, 2.0),
            inertia: random.between(0.05, 0.5),
            radius: random.between(0.2, 0.6),
            pin: random.between(0.05, 0.15),
            mu: random.between(0.1, 0.9),
            gravity: 9.81,
            bounce: [0.0, random.between(0.3, 0.6)][k % 2],
            height: random.between(0.1, 0.5),
            speed: random.between(1.0, 4.0),
        };
        let lands = (2.0 * disc.height / disc.gravity).sqrt();
        let share = disc.mass * disc.radius * (disc.radius - disc.mu * disc.pin) / disc.inertia;
        let after = disc.speed * share / (1.0 + share);
        let until = 3.0 * lands;
        for (method, tolerance) in methods_at(SINGLE_METHODS, [1e-9]) {
            let motion = run_by(&disc, (method, tolerance), first_start(&disc), until);
            let name = format!("{method} {disc:?}");
            let struck = event(&motion, "floor", "impact");
            let roll = struck.impulse(Disc::ROLL);
            agree(&name, roll, -disc.mass * (disc.speed - after), 1e-9);
            agree(&name, struck.impulse(Disc::BEARING), disc.mu * roll, 1e-9);
            let end = motion.final_state();
            agree(&name, end.v[0], after, 1e-9);
            agree(&name, end.v[2], after / disc.radius, 1e-9);
            agree(
                &name,
                end.q[0],
                disc.speed * lands + after * (until - lands),
                1e-8,
            );
            certified(&name, &motion);
        }
    }
}

/// A cart stands on wheels with rough bearings, and a ball strikes it from behind.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, phi, z),
    kinetic = cart/2 * (der(x)^2 + der(y)^2) + inertia/2 * der(phi)^2 + ball/2 * der(z)^2,
    potential = cart * gravity * y,
    contact(ground: y >= 0),
    contact(bumper: x >= z, restitution = bounce),
    constraint(roll while ground: der(x) == radius * der(phi)),
    friction(bearing on roll: slip = pin * der(phi), static = mu),
    start(shot: z = -1, der(z) = speed),
)]
struct Cart {
    cart: f64,
    inertia: f64,
    ball: f64,
    radius: f64,
    pin: f64,
    mu: f64,
    gravity: f64,
    bounce: f64,
    speed: f64,
}

/// The wheels are as heavy as a mass I/(R (R − μ p)): the cart leaves with (1 + e) m u/(m + M + I/(R (R − μ p))).
#[test]
fn a_cart_that_is_struck_sets_its_wheels_turning() {
    let mut random = Random::new(82);
    for _ in 0..8 {
        let cart = Cart {
            cart: random.between(1.0, 3.0),
            inertia: random.between(0.05, 0.3),
            ball: random.between(0.1, 1.0),
            radius: random.between(0.2, 0.5),
            pin: random.between(0.05, 0.15),
            mu: random.between(0.1, 0.9),
            gravity: 9.81,
            bounce: random.between(0.0, 1.0),
            speed: random.between(1.0, 4.0),
        };
        let wheels = cart.inertia / (cart.radius * (cart.radius - cart.mu * cart.pin));
        let share = (1.0 + cart.bounce) * cart.ball / (cart.ball + cart.cart + wheels);
        let after = share * cart.speed;
        for (method, tolerance) in methods_at(SINGLE_METHODS, [1e-9]) {
            let motion = run_by(&cart, (method, tolerance), first_start(&cart), 1.5);
            let name = format!("{method} {cart:?}");
            let struck = event(&motion, "bumper", "impact");
            assert!(!struck.ambiguous, "{name}");
            agree(&name, struck.time, 1.0 / cart.speed, 1e-9);
            agree(&name, struck.state_after.v[0], after, 1e-9);
            agree(&name, struck.state_after.v[2], after / cart.radius, 1e-9);
            certified(&name, &motion);
        }
    }
}
