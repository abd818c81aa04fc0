//! States that are made to satisfy their constraints: what is said of them wins over what rests, and rests only what friction holds.

use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, TOLERANCES, agree, event, methods_at, run_by};

/// A crank drives a slider on a rough guide.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(phi, beta),
    define(x = crank*cos(phi) + rod*cos(beta)),
    kinetic = inertia/2*der(phi)^2 + mass/2*der(x)^2,
    constraint(joint: crank*sin(phi) == rod*sin(beta)),
    friction(rub: slip = der(x), normal = load, static = mu),
    start(centre: der(phi) = speed, der(beta) = crank*speed/rod),
    start(nearly: phi = 0.6, beta = 0.21, der(phi) = speed),
)]
struct Crank {
    crank: f64,
    rod: f64,
    inertia: f64,
    mass: f64,
    load: f64,
    mu: f64,
    speed: f64,
}

const CRANK: Crank = Crank {
    crank: 0.1,
    rod: 0.3,
    inertia: 0.02,
    mass: 0.5,
    load: 20.0,
    mu: 0.1,
    speed: 30.0,
};

/// The motion of the joint that is nearest to velocities, in the metric of the kinetic energy: u (u·M v)/(u·M u) along its one direction u.
fn nearest(at: &State, given: [f64; 2]) -> [f64; 2] {
    let Crank {
        crank,
        rod,
        inertia,
        mass,
        ..
    } = CRANK;
    let [phi, beta] = [at.q[0], at.q[1]];
    let along = [1.0, crank * phi.cos() / (rod * beta.cos())];
    let slide = |v: [f64; 2]| -crank * phi.sin() * v[0] - rod * beta.sin() * v[1];
    let product = |a: [f64; 2], b: [f64; 2]| inertia * a[0] * b[0] + mass * slide(a) * slide(b);
    let share = product(along, given) / product(along, along);
    along.map(|x| x * share)
}

/// Where it is named the slider is at its dead centre, and its slip zero for an instant.
#[test]
fn a_crank_keeps_its_speed_where_its_slider_only_turns() {
    let simulation = Simulation::new(&CRANK);
    let named = CRANK.at(Crank::CENTRE);
    let moved = FixedComponents::default().q(Crank::PHI, 0.5);
    let found = simulation.consistent(0.0, &named, &moved).expect("a state");
    let expected = nearest(&found, [named.v[0], named.v[1]]);
    agree("turns", found.v[0], expected[0], 1e-9);
    agree("sways", found.v[1], expected[1], 1e-9);
    assert!(found.v[0] > 25.0, "{found:?}");

    let driven = moved.v(Crank::PHI, 30.0);
    let found = simulation
        .consistent(0.0, &named, &driven)
        .expect("a state");
    assert_eq!(found.v[0], 30.0);
    let sways = CRANK.crank * 0.5_f64.cos() / (CRANK.rod * found.q[1].cos());
    agree("sways", found.v[1], 30.0 * sways, 1e-9);
}

/// A slip that is zero because a start is not on its constraints is none that rests.
#[test]
fn a_start_that_is_moved_keeps_its_speed() {
    for nothing in [0.0, 1e-9] {
        let simulation = Simulation::new(&CRANK).project_start(true);
        let start = CRANK.at(Crank::NEARLY).with_v(Crank::BETA, nothing);
        let run = simulation.run(&start, 0.0..0.01).expect("runs");
        let begun = run.sampler().at(0.0).expect("recorded").state;
        let given = [start.v[0], start.v[1]];
        // The positions are moved first, and no velocity with them.
        agree("turns", begun.v[0], nearest(&begun, given)[0], 1e-6);
        assert!(begun.v[0] > 20.0, "{begun:?}");
    }
}

/// A wheel on a road, and a flap on it that rubs.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, phi, flap),
    kinetic = mass/2*(der(x)^2 + der(y)^2) + inertia/2*(der(phi)^2 + der(flap)^2),
    potential = mass*gravity*y,
    contact(road: y >= radius),
    friction(grip on road: slip = der(x) - radius*der(phi), static = 0.3),
    friction(hinge: slip = der(flap), limit = 2),
    start(rolls: y = radius, der(x) = speed, der(phi) = speed/radius),
)]
struct Wheel {
    mass: f64,
    inertia: f64,
    gravity: f64,
    radius: f64,
    speed: f64,
}

#[test]
fn what_is_held_lifts_contacts_and_moves_what_rubs() {
    let wheel = Wheel {
        mass: 2.0,
        inertia: 0.1,
        gravity: 9.81,
        radius: 0.3,
        speed: 2.0,
    };
    let simulation = Simulation::new(&wheel);
    let consistent = |fixed: FixedComponents| {
        let found = simulation.consistent(0.0, wheel.at(Wheel::ROLLS), &fixed);
        found.expect("a state")
    };
    let none = FixedComponents::default;
    // It goes on to roll where it can.
    let faster = consistent(none().v(Wheel::PHI, 10.0));
    assert_eq!((faster.v[0], faster.v[2]), (3.0, 10.0));
    // It slips where both are held.
    let slips = consistent(none().v(Wheel::PHI, 10.0).v(Wheel::X, 1.0));
    assert_eq!((slips.q[1], slips.v[0], slips.v[2]), (0.3, 1.0, 10.0));
    // It flies, or is about to, where its height or its rise is.
    let high = consistent(none().q(Wheel::Y, 0.5).v(Wheel::PHI, 10.0));
    assert_eq!((high.q[1], high.v[0], high.v[2]), (0.5, 2.0, 10.0));
    let rises = consistent(none().v(Wheel::Y, 1.0));
    assert_eq!((rises.q[1], rises.v[1], rises.v[0]), (0.3, 1.0, 2.0));
    let flaps = consistent(none().v(Wheel::FLAP, 1.5));
    assert_eq!((flaps.v[3], flaps.v[0]), (1.5, 2.0));
    // Nothing but the constraints of a system can refuse what is held.
    let named = CRANK.at(Crank::CENTRE);
    let beyond = none().q(Crank::BETA, 0.5);
    let refused = Simulation::new(&CRANK).consistent(0.0, named, &beyond);
    assert!(
        matches!(refused, Err(Error::Projection { item: "joint", .. })),
        "{refused:?}"
    );
}

/// A parallelogram of rods, which closes wherever it lies flat in two ways.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(a, b, c),
    kinetic = inertia/2 * (der(a)^2 + der(b)^2 + der(c)^2),
    constraint(ahead: side*cos(a) + base*cos(c) == base + side*cos(b)),
    constraint(aside: side*sin(a) + base*sin(c) == side*sin(b)),
    start(flat: a = 0),
)]
struct Parallelogram {
    side: f64,
    base: f64,
    inertia: f64,
}

/// Newton's method finds no way out of the flat position by one angle alone.
#[test]
fn an_angle_takes_a_linkage_out_of_its_flat_position() {
    let scene = Parallelogram {
        side: 1e-3,
        base: 2e-3,
        inertia: 1e-9,
    };
    let simulation = Simulation::new(&scene);
    for angle in [-2.5, -0.3, 0.01, 0.5, 1.0, 2.0, 3.0] {
        let held = FixedComponents::default().q(Parallelogram::A, angle);
        let flat = scene.at(Parallelogram::FLAT);
        let found = simulation.consistent(0.0, &flat, &held).expect("a state");
        assert_eq!(found.q[0], angle);
        agree("side", found.q[1], angle, 1e-9);
        agree("coupler", found.q[2], 0.0, 1e-9);
    }
}

/// A ladder on a floor and against a wall.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, lean),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + mass*length^2/24 * der(lean)^2,
    potential = mass * gravity * y,
    contact(floor: y - length/2 * sin(lean) >= 0),
    contact(wall: x - length/2 * cos(lean) >= 0),
    start(leans: lean = 1.2, x = length/2 * cos(1.2), y = length/2 * sin(1.2)),
)]
struct Ladder {
    mass: f64,
    length: f64,
    gravity: f64,
}

/// Where it cannot reach from the floor to the wall it leaves the wall.
#[test]
fn a_place_that_two_contacts_do_not_allow_opens_one() {
    let scene = Ladder {
        mass: 3.0,
        length: 1.0,
        gravity: 9.81,
    };
    let simulation = Simulation::new(&scene);
    let leans = scene.at(Ladder::LEANS);
    let far = FixedComponents::default().q(Ladder::X, 0.8);
    let found = simulation.consistent(0.0, &leans, &far).expect("a state");
    agree("leans", found.q[2], 1.2, 1e-12);
    agree("height", found.q[1], 0.5 * 1.2_f64.sin(), 1e-12);
    let near = FixedComponents::default().q(Ladder::X, 0.3);
    let found = simulation.consistent(0.0, &leans, &near).expect("a state");
    agree("leans", found.q[2], 0.6_f64.acos(), 1e-12);
    agree("height", found.q[1], 0.4, 1e-12);
}

/// A mass in a slot, pushed to and fro.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = mass/2 * der(x)^2,
    force(push: x = strength * cos(rate * t)),
    contact(right: x <= play),
    contact(left: x >= -play),
    start(middle: x = 0),
)]
struct Slot {
    mass: f64,
    play: f64,
    strength: f64,
    rate: f64,
}

/// Where both sides of a slot are as near as what counts as zero one of them stays open. The mass lies at the right until the push turns, at ωt = π/2,
/// and crosses in u/ω, with u − sin u = 2 play mω²/F.
#[test]
fn a_slot_may_be_narrower_than_what_counts_as_zero() {
    for (play, strength, tolerance) in [
        (1e-6, 1.0, 1e-6),
        (3e-7, 2.0, 1e-6),
        (2e-8, 1.0, 1e-6),
        (4e-10, 0.5, 1e-9),
        (9e-10, 3.0, 1e-9),
    ] {
        let scene = Slot {
            mass: 0.7,
            play,
            strength,
            rate: 30.0,
        };
        let begin = core::f64::consts::FRAC_PI_2 / scene.rate;
        let width = 2.0 * play * scene.mass * scene.rate.powi(2) / strength;
        let mut u = (6.0 * width).cbrt();
        for _ in 0..20 {
            u -= (u - u.sin() - width) / (1.0 - u.cos());
        }
        for method in ["auto", "dop853", "dopri5", "radau5"] {
            let what = format!("{play:e} by {method} at {tolerance:e}");
            let run = run_by(&scene, (method, tolerance), scene.at(Slot::MIDDLE), 0.1);
            let lost = event(&run, "right", "lost").time;
            let met = event(&run, "left", "impact").time;
            agree(&what, lost, begin, 10.0 * tolerance);
            agree(&what, met - begin, u / scene.rate, 10.0 * tolerance);
        }
    }
}

/// A mass above a small ball, told by the square of its distance.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(y),
    kinetic = der(y)^2 / 2,
    potential = 9.81 * y,
    contact(ball: factor * (y^2 - radius^2) >= 0),
    start(above: y = 3 * radius),
)]
struct Above {
    radius: f64,
    factor: f64,
}

/// What counts as zero of a gap is what the errors of places make of it, whatever its unit: the mass falls from where it is.
#[test]
fn a_gap_is_as_small_as_the_way_that_it_stands_for() {
    for (radius, factor) in [
        (1e-5, 1.0),
        (1e-4, 1.0),
        (1e-3, 1e-4),
        (0.1, 1e-10),
        (2.0, 1e-12),
    ] {
        let scene = Above { radius, factor };
        let falls = (4.0 * radius / 9.81_f64).sqrt();
        for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
            let motion = run_by(
                &scene,
                (method, tolerance),
                scene.at(Above::ABOVE),
                2.0 * falls,
            );
            let what = format!("{scene:?} by {method} at {tolerance:e}");
            let time = event(&motion, "ball", "impact").time;
            agree(&what, time / falls, 1.0, 1e3 * tolerance);
        }
    }
}
