//! Clamps of what is nothing for a while, where constraints, frictions and contacts hold something meanwhile: the outer condition is zero because the inner
//! side is, and not because anything holds it.

use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, Random, agree, certified, event, first_start, methods_at, run_by};

/// A sledge that friction holds is pushed from a time on, and a mark watches the push.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    define(push = if(t <= begin, 0, strength)),
    kinetic = mass/2 * der(x)^2,
    force(clamped: x = max(0, push)),
    friction(snow: slip = der(x), limit = hold),
    start(rest),
    mark(strong: max(0, push) >= strength/2),
    mark(either: abs(push) >= strength/3),
)]
struct Sledge {
    mass: f64,
    strength: f64,
    hold: f64,
    begin: f64,
}

/// x = (F − H)(t − t₁)²/2m, and both marks come true as the push jumps.
#[test]
fn a_clamped_push_that_begins_moves_what_friction_held() {
    let mut random = Random::new(71);
    for _ in 0..6 {
        let sledge = Sledge {
            mass: random.between(0.5, 3.0),
            strength: random.between(12.0, 40.0),
            hold: random.between(2.0, 10.0),
            begin: random.between(0.3, 1.5),
        };
        for (method, tolerance) in methods_at(METHODS, [1e-9]) {
            let motion = run_by(&sledge, (method, tolerance), first_start(&sledge), 2.0);
            let name = format!("{method} {sledge:?}");
            let rest = 2.0 - sledge.begin;
            let x = (sledge.strength - sledge.hold) / sledge.mass * rest * rest / 2.0;
            agree(&name, motion.final_state().q[0], x, 1e-7);
            for mark in ["strong", "either"] {
                agree(&name, event(&motion, mark, "mark").time, sledge.begin, 1e-8);
            }
            certified(&name, &motion);
        }
    }
}

/// Two masses that a rod ties fall into a damper that only pushes, and is clamped again.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(y, u),
    kinetic = mass/2 * (der(y)^2 + der(u)^2),
    potential = mass * gravity * (y + u),
    force(damper: y = max(0, max(0, -drag * (der(y) + fast)))),
    constraint(rod: u - y == length),
    start(dropped: u = length),
)]
struct Tied {
    mass: f64,
    gravity: f64,
    drag: f64,
    fast: f64,
    length: f64,
}

/// Free fall up to the speed at which the damper begins, then v = −v₀ − (2mg/c)(1 − exp(−c(t − t₀)/2m)).
#[test]
fn a_damper_that_is_clamped_twice_brakes() {
    let mut random = Random::new(72);
    for _ in 0..6 {
        let tied = Tied {
            mass: random.between(0.5, 2.0),
            gravity: 9.81,
            drag: random.between(5.0, 30.0),
            fast: random.between(0.5, 3.0),
            length: random.between(0.1, 1.0),
        };
        let (begin, end) = (tied.fast / tied.gravity, 1.0);
        let (rate, last) = (
            tied.drag / (2.0 * tied.mass),
            tied.gravity / (tied.drag / (2.0 * tied.mass)),
        );
        let faded = 1.0 - (-rate * (end - begin)).exp();
        let fallen =
            tied.fast * begin / 2.0 + (tied.fast + last) * (end - begin) - last / rate * faded;
        for (method, tolerance) in methods_at(METHODS, [1e-9]) {
            let motion = run_by(&tied, (method, tolerance), first_start(&tied), end);
            let name = format!("{method} {tied:?}");
            agree(
                &name,
                motion.final_state().v[0],
                -tied.fast - last * faded,
                1e-7,
            );
            agree(&name, motion.final_state().q[0], -fallen, 1e-7);
            certified(&name, &motion);
        }
    }
}

/// A crate lies on the floor of a cabin that falls onto a buffer of spring and oil, which only pushes.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(y, z),
    define(depth = max(0, if(y <= 0, -stiffness * y - drag * der(y), 0))),
    kinetic = cabin/2 * der(y)^2 + load/2 * der(z)^2,
    potential = gravity * (cabin * y + load * z),
    force(buffer: y = depth),
    contact(floor: z >= y),
    start(falls: y = height, z = height, der(y) = -speed, der(z) = -speed),
    mark(struck: y),
)]
struct Cabin {
    cabin: f64,
    load: f64,
    gravity: f64,
    stiffness: f64,
    drag: f64,
    height: f64,
    speed: f64,
}

/// As one body on spring and damper from the moment at which the buffer is struck, as long as that brakes.
#[test]
fn a_cabin_with_a_crate_is_caught_by_its_buffer() {
    let mut random = Random::new(73);
    for _ in 0..6 {
        let cabin = Cabin {
            cabin: random.between(200.0, 600.0),
            load: random.between(50.0, 100.0),
            gravity: 9.81,
            stiffness: random.between(8e3, 2e4),
            drag: random.between(1e3, 3e3),
            height: random.between(0.5, 2.0),
            speed: random.between(0.0, 3.0),
        };
        let mass = cabin.cabin + cabin.load;
        let strikes = (cabin.speed * cabin.speed + 2.0 * cabin.gravity * cabin.height).sqrt();
        let begin = (strikes - cabin.speed) / cabin.gravity;
        // y = e^{−δs}(A cos ωs + B sin ωs) − mg/k
        let (decay, sag) = (
            cabin.drag / (2.0 * mass),
            mass * cabin.gravity / cabin.stiffness,
        );
        let omega = (cabin.stiffness / mass - decay * decay).sqrt();
        let [a, b] = [sag, (decay * sag - strikes) / omega];
        let rest = 0.25 / omega;
        let y = (-decay * rest).exp() * (a * (omega * rest).cos() + b * (omega * rest).sin()) - sag;
        for (method, tolerance) in methods_at(METHODS, [1e-9]) {
            let motion = run_by(
                &cabin,
                (method, tolerance),
                first_start(&cabin),
                begin + rest,
            );
            let name = format!("{method} {cabin:?}");
            agree(&name, event(&motion, "struck", "mark").time, begin, 1e-8);
            agree(&name, motion.final_state().q[0], y, 1e-7);
            certified(&name, &motion);
        }
    }
}
