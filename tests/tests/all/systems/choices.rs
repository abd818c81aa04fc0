//! Several modes could go on: the one that sticks comes first, then the one that stays closed, then the present one, and the event says so.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, agree, event, run, run_by, runge_kutta, words};

/// A block upon a block, both with dry friction of given limits. The upper one, which is pushed, hits a ball of its own mass,
/// takes its rest, and gives it its speed.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(lower, upper, ball),
    kinetic = light/2 * der(lower)^2 + heavy/2 * (der(upper)^2 + der(ball)^2),
    force(drive: upper = push),
    contact(clack: ball >= upper, restitution = 1),
    friction(ground: slip = der(lower), limit = (ground_static, ground_kinetic)),
    friction(between: slip = der(upper) - der(lower), limit = (between_static, between_kinetic)),
)]
struct Pile {
    light: f64,
    heavy: f64,
    push: f64,
    ground_static: f64,
    ground_kinetic: f64,
    between_static: f64,
    between_kinetic: f64,
}

/// Starts the upper block at 1 m/s, 1 m before the ball.
fn start() -> State<f64> {
    state(&[0.0, 0.0, 1.0], &[0.0, 1.0, 0.0])
}

/// Time to the ball and speed there, accelerated by `a`.
fn arrival(a: f64) -> (f64, f64) {
    let speed = (1.0 + 2.0 * a).sqrt();
    ((speed - 1.0) / a, speed)
}

#[test]
fn what_can_stick_after_a_blow_sticks() {
    // The push could both be held and go on to slip.
    let scene = Pile {
        light: 0.2,
        heavy: 1.0,
        push: 2.0,
        ground_static: 5.0,
        ground_kinetic: 4.0,
        between_static: 3.0,
        between_kinetic: 1.0,
    };
    let motion = run(&scene, start(), 3.0);
    assert_eq!(words(&motion), ["clack impact", "between sticks"]);
    assert!(motion.events().iter().all(|e| !e.ambiguous));
    let (time, speed) = arrival(1.0);
    agree("blow", event(&motion, "clack", "impact").time, time, 1e-12);
    let State { q, v, .. } = motion.final_state();
    agree("upper", q[1], 1.0, 1e-12);
    assert_eq!([v[0], v[1]], [0.0; 2]);
    agree("ball", q[2], 1.0 + speed * (3.0 - time), 1e-12);
}

#[test]
fn of_two_modes_that_stick_as_much_the_present_one_goes_on() {
    // Either block could slip alone, on what then sticks.
    let scene = Pile {
        light: 0.2,
        heavy: 1.0,
        push: 4.0,
        ground_static: 3.0,
        ground_kinetic: 0.5,
        between_static: 1.5,
        between_kinetic: 1.0,
    };
    let (time, _) = arrival(3.0);
    let motion = run(&scene, start(), time + 0.4);
    let State { q, v, .. } = motion.final_state();
    agree("lower", q[0], 0.0, 1e-12);
    agree("upper", q[1], 1.0 + 1.5 * 0.4 * 0.4, 1e-12);
    agree("its speed", v[1], 3.0 * 0.4, 1e-12);
    let last = motion.events().last().expect("the blow");
    assert!(last.ambiguous, "{:?}", words(&motion));
}

/// A cupboard that is pushed at its upper edge, harder and harder.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, tilt),
    define(
        right = [cos(tilt), -sin(tilt)],
        up = [sin(tilt), cos(tilt)],
        rear = [x, y] - width/2 * right - height/2 * up,
        front = [x, y] + width/2 * right - height/2 * up,
    ),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + mass * (width^2 + height^2)/24 * der(tilt)^2,
    potential = mass * gravity * y,
    contact(rear_foot: rear[1] >= 0),
    contact(front_foot: front[1] >= 0),
    friction(rear_grip on rear_foot: slip = der(rear[0]), static = mu, kinetic = nu),
    friction(front_grip on front_foot: slip = der(front[0]), static = mu, kinetic = nu),
    force(push: (rate * t, 0) at [x, y] + height/2 * up - width/2 * right),
    start(set: y = height/2),
)]
struct Cupboard {
    mass: f64,
    width: f64,
    height: f64,
    gravity: f64,
    mu: f64,
    nu: f64,
    rate: f64,
}

/// When the push lifts the rear foot, both feet could also slide, on the friction of motion, which is less than what holds them: a motion
/// that nothing begins.
#[test]
fn what_holds_goes_on_to_hold_though_a_contact_opens() {
    let cupboard = Cupboard {
        mass: 43.0,
        width: 0.6,
        height: 0.9,
        gravity: 9.81,
        mu: 0.45,
        nu: 0.2,
        rate: 70.0,
    };
    let Cupboard {
        mass,
        width,
        height,
        gravity,
        rate,
        ..
    } = cupboard;
    let lifted = mass * gravity * width / (2.0 * height * rate);
    // Turning about the front foot, J = m (b² + h²)/3.
    let inertia = mass * (width * width + height * height) / 3.0;
    let slope = |t: f64, [angle, spin]: [f64; 2]| {
        let (s, c) = angle.sin_cos();
        let push = rate * t * (height * c + width * s);
        let weight = mass * gravity * (height * s - width * c) / 2.0;
        [spin, (push + weight) / inertia]
    };
    let until = lifted + 0.35;
    let (steps, mut tilt) = (2000, [0.0; 2]);
    let h = (until - lifted) / f64::from(steps);
    for k in 0..steps {
        tilt = runge_kutta(slope, (lifted + h * f64::from(k), tilt), h);
    }
    for method in METHODS {
        let start = state(&[0.0, height / 2.0, 0.0], &[0.0; 3]);
        let motion = run_by(&cupboard, (method, 1e-9), start, until);
        assert_eq!(words(&motion), ["rear_foot lost"], "{method}");
        assert!(!motion.events()[0].ambiguous, "{method}");
        agree(method, motion.events()[0].time, lifted, 1e-8);
        let State { q, v, .. } = motion.final_state();
        agree(method, q[2], tilt[0], 1e-7);
        agree(method, v[2], tilt[1], 1e-7);
    }
}

/// A lift that stands on the ground and is held by its guide, which could not hold it alone, beside a cart whose brake a motor overcomes.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(cart, lift),
    kinetic = cart_mass/2 * der(cart)^2 + mass/2 * der(lift)^2,
    potential = mass * gravity * lift,
    contact(ground: lift >= 0),
    friction(brake: slip = der(cart), limit = brakes),
    friction(guide: slip = der(lift), limit = guides),
    force(motor: cart = rate * t),
)]
struct LiftBesideCart {
    cart_mass: f64,
    mass: f64,
    gravity: f64,
    brakes: f64,
    guides: f64,
    rate: f64,
}

/// How ground and guide share the weight is open, and on equal springs the guide would have more than it can hold; the cart, which slips, knows nothing of it.
#[test]
fn what_slips_elsewhere_does_not_make_shared_loads_a_choice() {
    for (guides, rate) in [(3.0, 10.0), (0.5, 7.0), (100.0, 10.0)] {
        let scene = LiftBesideCart {
            cart_mass: 0.3,
            mass: 1.2,
            gravity: 9.81,
            brakes: 5.6,
            guides,
            rate,
        };
        for method in METHODS {
            let run = run_by(&scene, (method, 1e-9), state(&[0.0; 2], &[0.0; 2]), 1.0);
            assert_eq!(words(&run), ["brake slips"], "{method}");
            let event = &run.events()[0];
            assert!(!event.ambiguous, "{method}: {guides}");
            agree("slips", event.time, scene.brakes / rate, 1e-9);
        }
    }
}

/// A rod that slides on its tip (Painlevé 1895), beside four blocks that rest.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, phi, across[4], up[4]),
    define(tip_x = x - cos(phi), tip_y = y - sin(phi)),
    kinetic = (der(x)^2 + der(y)^2) / 2 + der(phi)^2 / 6 + (dot(der(across), der(across)) + dot(der(up), der(up))) / 2,
    potential = gravity * (y + up[0] + up[1] + up[2] + up[3]),
    contact(tip: tip_y >= 0),
    contact(first: up[0] >= 0),
    contact(second: up[1] >= 0),
    contact(third: up[2] >= 0),
    contact(fourth: up[3] >= 0),
    friction(grip on tip: slip = der(tip_x), static = mu),
    friction(first_grip on first: slip = der(across[0]), static = 0.5),
    friction(second_grip on second: slip = der(across[1]), static = 0.5),
    friction(third_grip on third: slip = der(across[2]), static = 0.5),
    friction(fourth_grip on fourth: slip = der(across[3]), static = 0.5),
    start(pushed: y = sin(1), phi = 1, der(x) = -1 - rate * sin(1), der(y) = rate * cos(1), der(phi) = rate),
)]
struct RodBesideBlocks {
    gravity: f64,
    mu: f64,
    rate: f64,
}

/// The tip would rise, for the normal force without friction, g - ω² sin φ, is negative, and friction of more than 1.2 or so presses it down all the same: it may
/// also fly. Of a thousand modes of all bodies together those of each are looked at by themselves, at the start too.
#[test]
fn a_rod_may_fly_or_stay_beside_any_number_of_blocks() {
    for (mu, rate) in [(1.6, 4.0), (1.7, 4.5), (1.8, 5.0)] {
        let scene = RodBesideBlocks {
            gravity: 9.81,
            mu,
            rate,
        };
        // Of the tip that slides backward, per unit of normal force: its rise, 1 + 3 c (c - μ s).
        let (s, c) = 1.0_f64.sin_cos();
        let lifts = rate * rate * s - scene.gravity;
        assert!(lifts > 0.0 && 1.0 + 3.0 * c * (c - mu * s) < 0.0);
        for method in METHODS {
            let setting = (method, 1e-9);
            let record = run_by(&scene, setting, scene.at(RodBesideBlocks::PUSHED), 0.005);
            assert_eq!(words(&record), ["tip ambiguous"], "{method} {mu}");
        }
    }
}
