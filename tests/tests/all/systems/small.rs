//! Systems that are small in the units in which they are written.

use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, agree, certified, event, run_by};

/// Two masses on a stiff rod run against a wall.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(front, rear),
    kinetic = light/2*der(front)^2 + heavy/2*der(rear)^2,
    constraint(rod: front + length == rear),
    contact(wall: front >= 0, restitution = bounce),
    start(run: front = way, rear = way + length, der(front) = -speed, der(rear) = -speed),
)]
struct Rod {
    light: f64,
    heavy: f64,
    length: f64,
    bounce: f64,
    way: f64,
    speed: f64,
}

/// The unit of mass cancels from the motion, and impulses are in proportion to it.
#[test]
fn impacts_with_constraints_do_not_depend_on_the_unit_of_mass() {
    for unit in [1e-30, 1e-21, 1e-14, 1.0, 1e12, 1e25] {
        let rod = Rod {
            light: 2.0 * unit,
            heavy: 5.0 * unit,
            length: 0.4,
            bounce: 0.3,
            way: 0.8,
            speed: 1.6,
        };
        let motion = run_by(&rod, ("taylor", 1e-11), rod.at(Rod::RUN), 1.0);
        let impact = event(&motion, "wall", "impact");
        agree("time", impact.time, 0.5, 1e-12);
        let impulse = impact.impulse(Rod::WALL) / unit;
        agree("impulse", impulse, 7.0 * 1.6 * 1.3, 1e-11);
        let pull = impact.impulse(Rod::ROD).abs() / unit;
        agree("rod", pull, 5.0 * 1.6 * 1.3, 1e-11);
        agree("end", motion.final_state().q[0], 0.5 * 0.3 * 1.6, 1e-11);
        certified(unit, &motion);
    }
}

/// The tip of a switch half a micrometre above its contact, drawn down by a constant force.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = mass/2*der(x)^2,
    force(drawn: x = -pull),
    contact(pad: x >= 0),
    start(up: x = height),
)]
struct Switch {
    mass: f64,
    pull: f64,
    height: f64,
}

/// A start is closed by no more than its absolute tolerance.
#[test]
fn what_is_open_by_half_a_micrometre_is_open() {
    let switch = Switch {
        mass: 1e-11,
        pull: 8e-7,
        height: 5e-7,
    };
    let time = (2.0 * switch.height * switch.mass / switch.pull).sqrt();
    for method in METHODS {
        let simulation = Simulation::new(&switch)
            .method(method)
            .tolerance(1e-6)
            .absolute_tolerance(Switch::X, 1e-14);
        let motion = simulation.run(switch.at(Switch::UP), 0.0..2.0 * time);
        let motion = motion.expect("it closes");
        let closes = event(&motion, "pad", "impact").time;
        agree(method, closes / time, 1.0, 1e-6);
    }
}

/// A pendulum in Cartesian coordinates whose angle has no inertia of its own.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, angle),
    kinetic = mass/2*(der(x)^2 + der(y)^2),
    potential = 9.81*mass*y,
    constraint(across: x == length*sin(angle)),
    constraint(down: y == -length*cos(angle)),
    start(out: x = length*sin(1), y = -length*cos(1), angle = 1),
)]
struct Bob {
    mass: f64,
    length: f64,
}

/// From the angle 1 its speed at angle φ is √(2 g l (cos φ − cos 1)), in any unit of mass.
#[test]
fn an_angle_without_inertia_follows_in_any_unit_of_mass() {
    for mass in [1e-21, 1e-13, 1.0, 1e15, 1e25] {
        for (length, method) in [
            (1.0, "auto"),
            (0.2, "auto"),
            (0.7, "dop853"),
            (2.0, "radau5"),
        ] {
            let bob = Bob { mass, length };
            let run = run_by(&bob, (method, 1e-11), bob.at(Bob::OUT), 0.9);
            let end = run.final_state();
            let speed = (2.0 * 9.81 * length * (end.q[2].cos() - f64::cos(1.0))).sqrt();
            let what = format!("{bob:?} by {method}");
            agree(&what, (length * end.v[2]).abs(), speed, 1e-8);
            certified(&what, &run);
        }
    }
}

/// A bob on a rod, told by its place.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2*(der(x)^2 + der(y)^2),
    potential = mass*gravity*y,
    constraint(rod: x^2 + y^2 == length^2),
    start(level: x = length),
)]
struct Tiny {
    mass: f64,
    gravity: f64,
    length: f64,
}

/// A rod is as long as it was to rounding of what its ends are as small as they are asked for, and the bob has the speed of its height.
#[test]
fn rods_keep_their_length_in_any_unit() {
    for (length, gravity, until) in [
        (0.5, 9.81, 200.0),
        (5e-7, 9.81, 0.2),
        (5e-10, 9.81e-9, 200.0),
    ] {
        for method in [Method::Auto, Method::DormandPrince853, Method::Verner98] {
            let tiny = Tiny {
                mass: 0.3,
                gravity,
                length,
            };
            let simulation = Simulation::new(&tiny)
                .method(method)
                .tolerance(1e-10)
                .absolute_tolerance(Tiny::X, 1e-10 * length)
                .absolute_tolerance(Tiny::Y, 1e-10 * length);
            let run = simulation.run(tiny.at(Tiny::LEVEL), 0.0..until);
            let end = run.expect("a run").final_state().clone();
            let what = format!("{length:e} by {method}");
            agree(&what, end.q[0].hypot(end.q[1]) / length, 1.0, 1e-10);
            let speed = (-2.0 * gravity * end.q[1]).sqrt();
            agree(&what, end.v[0].hypot(end.v[1]) / speed, 1.0, 1e-6);
        }
    }
}

/// A box on a rough floor, pulled aside ever harder.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, z),
    kinetic = mass/2*(der(x)^2 + der(y)^2 + der(z)^2),
    potential = mass*gravity*z,
    force(pull: x = 3*rate*t),
    force(push: y = 4*rate*t),
    contact(floor: z >= 0),
    friction(rub on floor: slip = (der(x), der(y)), static = mu),
    start(still: x = 0),
)]
struct Pulled {
    mass: f64,
    gravity: f64,
    rate: f64,
    mu: f64,
}

/// With F = 5 r t it slips from t₀ = μ m g/(5 r) on, and has gone 5 r (t³/3 − t₀² t + 2 t₀³/3)/(2 m) − μ g (t − t₀)²/2.
#[test]
fn a_box_begins_to_slip_in_any_unit_of_mass_and_length() {
    let (mass, gravity, rate, mu, until): (f64, f64, f64, f64, f64) = (0.8, 9.81, 0.5, 0.3, 2.0);
    let begins = mu * mass * gravity / (5.0 * rate);
    let way =
        5.0 * rate * (until.powi(3) / 3.0 - begins.powi(2) * until + 2.0 * begins.powi(3) / 3.0)
            / (2.0 * mass)
            - mu * gravity * (until - begins).powi(2) / 2.0;
    for (kilogram, metre) in [
        (1e-9, 1e-6),
        (1e-12, 1e-3),
        (1e-15, 1.0),
        (1e9, 1e6),
        (1e12, 1e-2),
    ] {
        for method in ["auto", "dop853", "radau5"] {
            let pulled = Pulled {
                mass: mass * kilogram,
                gravity: gravity * metre,
                rate: rate * kilogram * metre,
                mu,
            };
            let what = format!("{pulled:?} by {method}");
            let motion = run_by(&pulled, (method, 1e-13), pulled.at(Pulled::STILL), until);
            agree(&what, event(&motion, "rub", "slips").time, begins, 1e-7);
            let end = motion.final_state();
            agree(&what, end.q[0] / metre, 0.6 * way, 3e-6);
            agree(&what, end.q[1] / metre, 0.8 * way, 3e-6);
        }
    }
}

/// A crank that pushes a slider with a rod of its own; the guide rubs.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(crank, rod, x, y),
    kinetic = inertia*der(crank)^2/2 + mass*length^2*der(rod)^2/120 + mass*(der(x)^2 + der(y)^2)/2,
    potential = mass*gravity*y,
    force(motor: crank = torque*cos(2*t) - damping*der(crank)),
    constraint(ahead: x == radius*cos(crank) + length*cos(rod)),
    constraint(aside: y == radius*sin(crank) - length*sin(rod)),
    constraint(guide: y == 0),
    friction(rub on guide: slip = der(x), static = mu, kinetic = 0.7*mu),
    start(turned: crank = 1.1, rod = asin(radius*sin(1.1)/length), x = radius*cos(1.1) + length*cos(asin(radius*sin(1.1)/length))),
)]
struct SliderCrank {
    radius: f64,
    length: f64,
    mass: f64,
    inertia: f64,
    torque: f64,
    damping: f64,
    gravity: f64,
    mu: f64,
}

/// The same machine in other units passes its dead centres at the same times.
#[test]
fn a_slider_crank_turns_alike_in_any_unit_of_mass_and_length() {
    let machine = |kilogram: f64, metre: f64| {
        let moment = kilogram * metre * metre;
        SliderCrank {
            radius: 0.25 * metre,
            length: 0.6 * metre,
            mass: 1.4 * kilogram,
            inertia: 0.3 * moment,
            torque: 6.0 * moment,
            damping: 0.1 * moment,
            gravity: 9.81 * metre,
            mu: 0.2,
        }
    };
    for method in ["auto", "dop853"] {
        let run = |scene: &SliderCrank| {
            run_by(scene, (method, 1e-10), scene.at(SliderCrank::TURNED), 3.0)
        };
        let usual = run(&machine(1.0, 1.0));
        assert!(usual.events().len() > 2);
        for (kilogram, metre) in [
            (1e9, 1e6),
            (1e12, 1.0),
            (1e3, 1e3),
            (1e-9, 1.0),
            (1e-6, 1e-3),
        ] {
            let what = format!("{kilogram:e} and {metre:e} by {method}");
            let motion = run(&machine(kilogram, metre));
            assert_eq!(usual.events().len(), motion.events().len(), "{what}");
            for (one, other) in usual.events().iter().zip(motion.events()) {
                agree(&what, one.time, other.time, 1e-6);
            }
            agree(
                &what,
                motion.final_state().q[0],
                usual.final_state().q[0],
                1e-6,
            );
            certified(&what, &motion);
        }
    }
}
