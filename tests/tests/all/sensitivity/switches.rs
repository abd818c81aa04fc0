//! Derivatives through the loss of a contact, and through stick and slip.

use super::ball::ball;
use super::{Slopes, TIGHT, USUAL, all, compare, run, same_slopes, seeded};
use lagrange_core::Runnable;
use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, agree, root};

/// A mass slides down a smooth shell and leaves it.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(r, theta),
    define(x = r * sin(theta), y = r * cos(theta)),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    contact(shell: r >= radius),
    start(rest: r = radius, theta = angle),
    stop(floor: y <= -radius),
)]
struct Shell<T = f64> {
    mass: T,
    gravity: T,
    radius: T,
    angle: T,
}

fn shell<T: Runnable>(
    [mass, gravity, radius, angle]: [T; 4],
    settings: (f64, Method),
) -> Trajectory<T> {
    let scene = Shell {
        mass,
        gravity,
        radius,
        angle,
    };
    run(&scene, scene.at(<Shell>::REST), 20.0, settings)
}

#[test]
fn where_and_when_a_mass_leaves_a_shell() {
    let p = [1.0, 9.81, 0.7, 0.1];
    for (settings, tolerance) in [
        (TIGHT, 1e-11),
        (USUAL, 1e-7),
        ((1e-11, Method::DormandPrince853), 1e-7),
    ] {
        let motion = shell(seeded(p), settings);
        let [lost, floor] = motion.events() else {
            panic!("{:?}", motion.events().len())
        };
        let theta = lost.state.q[1];
        agree(
            "θ",
            theta.value,
            (2.0 / 3.0 * 0.1_f64.cos()).acos(),
            tolerance,
        );
        // cos θ = ⅔ cos θ₀
        let slope = 2.0 / 3.0 * 0.1_f64.sin() / theta.value.sin();
        agree("dθ/dθ₀", theta.derivative[3], slope, tolerance);
        for event in [lost, floor] {
            let t = event.time;
            // Times go as √(R/g), whatever the mass.
            agree("dt/dm", t.derivative[0], 0.0, tolerance);
            agree("dt/dg", t.derivative[1], -0.5 * t.value / 9.81, tolerance);
            agree("dt/dR", t.derivative[2], 0.5 * t.value / 0.7, tolerance);
        }
        // On the floor y = −R.
        let [r, theta] = floor.state.q[..] else {
            panic!()
        };
        let y = r * Scalar::sin_cos(theta).1;
        agree("dy/dR", y.derivative[2], -1.0, tolerance);
        agree("dy/dθ₀", y.derivative[3], 0.0, tolerance);
    }
    let plain = |p| all(&shell(p, TIGHT));
    compare(p, plain, &all(&shell(seeded(p), TIGHT)), 1e-3, 1e-8);
}

/// A mass rides on a wheel that is free to roll away under it.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, phi, r, theta),
    define(px = x + r * sin(theta), py = r * cos(theta)),
    kinetic   = wheel/2 * der(x)^2 + inertia/2 * der(phi)^2 + mass/2 * (der(px)^2 + der(py)^2),
    potential = mass * gravity * py,
    constraint(rolling: der(x) == radius * der(phi)),
    contact(rim: r >= radius, restitution = 0),
    friction(grip on rim: slip = radius * (der(theta) - der(phi)), static = mu_static, kinetic = mu_kinetic),
    start(rest: r = radius, theta = angle),
    stop(floor: py <= -radius),
)]
struct Wheel<T = f64> {
    wheel: T,
    inertia: T,
    mass: T,
    radius: T,
    gravity: T,
    mu_static: T,
    mu_kinetic: T,
    angle: T,
}

fn scene<T: Runnable>([inertia, mass, radius, mu_static, mu_kinetic, angle]: [T; 6]) -> Wheel<T> {
    Wheel {
        wheel: T::one(),
        inertia,
        mass,
        radius,
        gravity: T::from_f64(9.81),
        mu_static,
        mu_kinetic,
        angle,
    }
}

fn wheel<T: Runnable>(parameters: [T; 6], settings: (f64, Method)) -> Trajectory<T> {
    let scene = scene(parameters);
    run(&scene, scene.at(<Wheel>::REST), 20.0, settings)
}

const WHEEL: [f64; 6] = [0.125, 0.2, 0.5, 0.6, 0.5, 0.05];

#[test]
fn a_mass_on_a_wheel_sticks_slips_and_is_thrown() {
    let dual = all(&wheel(seeded(WHEEL), TIGHT));
    compare(WHEEL, |p| all(&wheel(p, TIGHT)), &dual, 1e-3, 1e-7);
    let usual = all(&wheel(seeded(WHEEL), USUAL));
    for (a, b) in usual.iter().zip(&dual) {
        for k in 0..6 {
            agree("tolerance", a.derivative[k], b.derivative[k], 1e-6);
        }
    }
}

/// A puck slides on a table until friction stops it.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = 0,
    friction(rub: slip = (der(x), der(y)), normal = mass * gravity, static = mu, kinetic = mu),
    start(push: der(x) = u, der(y) = w),
)]
struct Puck<T = f64> {
    mass: T,
    gravity: T,
    mu: T,
    u: T,
    w: T,
}

#[test]
fn friction_stops_a_puck() {
    let [g, mu, u, w] = seeded([9.81, 0.2, 0.6, 0.8]);
    let scene = Puck {
        mass: Scalar::from_f64(1.0),
        gravity: g,
        mu,
        u,
        w,
    };
    let motion = run(&scene, scene.at(<Puck>::PUSH), 2.0, USUAL);
    let speed = (u * u + w * w).sqrt();
    let time = speed / (mu * g);
    let half: Slopes = Scalar::from_f64(0.5);
    let [event] = motion.events() else {
        panic!("{}", motion.events().len())
    };
    let end = motion.final_state();
    same_slopes("t", event.time, time, 1e-9);
    same_slopes("x", end.q[0], half * u * time, 1e-9);
    same_slopes("y", end.q[1], half * w * time, 1e-9);
}

/// Time and motion have 24 bits: what they cannot resolve is refused, not tried for ever.
#[test]
fn single_precision_ends_and_says_what_can_be_had() {
    let scene = scene(WHEEL.map(|x| x as f32));
    let start = || scene.at(<Wheel>::REST);
    let exact = wheel(WHEEL, TIGHT);
    let methods = [
        Method::Auto,
        Method::DormandPrince54,
        Method::DormandPrince853,
        Method::Verner98,
        Method::Radau5,
        Method::Gauss6 { step: 0.01 },
    ];
    for method in methods {
        let usual = Simulation::new(&scene).method(method);
        let usual = usual.run(start(), 0.0..20.0).expect("runs");
        assert_eq!(usual.events().len(), exact.events().len());
        for (event, exact) in usual.events().iter().zip(exact.events()) {
            agree("time", f64::from(event.time), exact.time, 1e-4);
        }
    }
    for tolerance in [5e-8, 1e-9, 1e-17] {
        let run = Simulation::new(&scene).tolerance(tolerance);
        let failure = run.run(start(), 0.0..20.0).expect_err("too tight");
        assert!(
            failure.to_string().contains("single precision"),
            "{failure}"
        );
    }
}

#[test]
fn single_precision() {
    let single = wheel(WHEEL.map(|x| x as f32), (1e-6, Method::Taylor));
    let double = wheel(WHEEL, TIGHT);
    assert_eq!(single.events().len(), double.events().len());
    for (a, b) in all(&single).iter().zip(all(&double)) {
        agree("single", f64::from(*a), b, 1e-5);
    }
    // Single precision rounds most of these last times, some of them down.
    for until in [0.7, 0.9, 1.0, 1.3, 3.3] {
        for method in METHODS {
            let motion = ball([9.81_f32, 0.8, 100.0, 0.3], until, (1e-6, method));
            agree("end", motion.last_time(), until, 1e-7);
        }
    }
    let motion = ball([9.81_f32, 0.8, 1.0, 0.3], 1.0, (1e-6, Method::Taylor));
    agree(
        "impact",
        f64::from(motion.events()[0].time),
        (2.0 / 9.81_f64).sqrt(),
        1e-6,
    );
}

/// A bob on a rod whose length is a root swings against a wall.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    potential = 9.81 * y,
    constraint(rod: sqrt(x^2 + y^2) == 1),
    dissipation(drag: damping * der(x)^2),
    contact(wall: x >= -wide, restitution = bounce),
    start(held: x = 3/5, y = -4/5),
)]
struct Clapper<T = f64> {
    damping: T,
    wide: T,
    bounce: T,
}

fn clapper<T: Runnable>([damping, wide, bounce]: [T; 3], settings: (f64, Method)) -> Trajectory<T> {
    let scene = Clapper {
        damping,
        wide,
        bounce,
    };
    run(&scene, scene.at(<Clapper>::HELD), 3.0, settings)
}

/// What a root might hide is looked for at the end of a step, whose instant moves with the parameters.
#[test]
fn a_rod_given_by_a_root_changes_no_derivative() {
    let p = [0.3, 0.2, 0.5];
    for method in [Method::Taylor, Method::DormandPrince853] {
        let dual = all(&clapper(seeded(p), (1e-12, method)));
        compare(p, |p| all(&clapper(p, TIGHT)), &dual, 1e-4, 1e-6);
    }
}

/// A mass that lies on a rough table is pulled ever more, in a direction that turns.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    friction(rub: slip = (der(x), der(y)), normal = 9.81, static = mu, kinetic = mu/2),
    force(hand: (pull * t, sin(2*t)) at (x, y)),
    start(lies),
)]
struct Pulled<T = f64> {
    mu: T,
    pull: T,
}

/// Its slip begins in a direction that depends on both parameters: up to there the instant has its derivatives, and then the run ends.
#[test]
fn a_slip_that_begins_in_space_ends_derivatives() {
    let [mu, pull] = seeded([0.3, 1.0]);
    let scene = Pulled { mu, pull };
    let simulation = Simulation::new(&scene);
    let failure = simulation.run(scene.at(<Pulled>::LIES), 0.0..4.0);
    let failure = failure.expect_err("no derivatives of what follows");
    let Error::NoDerivatives { time, item } = failure.error else {
        panic!("{failure}")
    };
    assert_eq!(item, "rub");
    let beyond = |t: f64| t.hypot((2.0 * t).sin()) - 0.3 * 9.81;
    agree("instant", time, root(beyond, 2.0, 4.0), 1e-8);
}
