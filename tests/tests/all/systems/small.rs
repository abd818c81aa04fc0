//! Systems that are small in the units in which they are written.

use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, agree, certified, event, run_by};

/// Two masses on a stiff rod run against a wall.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
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
