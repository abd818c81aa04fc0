//! Slips of two components that hardly begin or hardly go on: their direction follows the forces in a time that is far shorter than they last.

use super::{PI, state};
use lagrange_core::prelude::*;
use lagrange_tests::{Random, TOLERANCES, agree, certified, event, methods_at, run_by, words};

/// A puck on a rough table that moves, pulled by a little more than friction holds.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2)/2,
    define(over = [der(x) - table[0], der(y) - table[1]]),
    force(pull: (load*cos(angle), load*sin(angle)) at (x, y)),
    friction(grip: slip = (over[0], over[1]), limit = load - more),
)]
struct Puck {
    load: f64,
    more: f64,
    angle: f64,
    table: [f64; 2],
}

/// Beside the table it goes by (what is more) t²/2 along the pull, in steps whose number does not grow as that gets less.
#[test]
fn a_puck_that_is_hardly_pulled_goes_along_the_pull() {
    for (more, table) in [
        (1e-5, [0.0; 2]),
        (1e-6, [0.3, 1.1]),
        (1e-7, [0.0; 2]),
        (3e-8, [0.3, -0.7]),
        (1e-8, [0.0; 2]),
    ] {
        let scene = Puck {
            load: 5.0,
            more,
            angle: 0.3,
            table,
        };
        // Less than the tolerance may be nothing.
        let finer = TOLERANCES.into_iter().filter(|&tolerance| tolerance < more);
        for (method, tolerance) in finer.flat_map(|finer| [("auto", finer), ("radau5", finer)]) {
            let what = format!("{scene:?} by {method} at {tolerance:e}");
            let start = state(&[0.0; 2], &table);
            let run = run_by(&scene, (method, tolerance), start, 2.0);
            assert_eq!(words(&run), ["grip slips"], "{what}");
            assert!(run.work().steps < 1000, "{what}: {:?}", run.work());
            let end = run.final_state();
            for (k, part) in [0.3_f64.cos(), 0.3_f64.sin()].into_iter().enumerate() {
                let place = 2.0 * table[k] + 2.0 * more * part;
                agree(&what, end.q[k], place, 20.0 * tolerance);
            }
            certified(&what, &run);
        }
    }
}

/// A puck on springs that comes to rest by friction, along a straight line across both coordinates.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2)/2,
    potential = (x^2 + y^2)/2,
    friction(grip: slip = (der(x), der(y)), limit = 1),
)]
struct Swing {}

/// From 3 + ε, where the spring holds less than friction takes by 2, it comes to 1 + ε on the other side after half a swing, and rests at 1 − ε
/// after another one.
#[test]
fn a_last_swing_that_is_small_lasts_as_long_as_others() {
    for small in [1e-3, 1e-4, 1e-5] {
        for (method, tolerance) in methods_at(["auto", "radau5"], [1e-9, 1e-12]) {
            let what = format!("{small:e} by {method} at {tolerance:e}");
            let along = [0.7_f64.cos(), 0.7_f64.sin()];
            let from = along.map(|x| (3.0 + small) * x);
            let run = run_by(&Swing {}, (method, tolerance), state(&from, &[0.0; 2]), 8.0);
            assert!(run.work().steps < 3000, "{what}: {:?}", run.work());
            // Its speed is ε sin t: an error of the speed is an error of the time.
            let rests = event(&run, "grip", "sticks").time;
            agree(&what, rests, 2.0 * PI, 20.0 * tolerance / small);
            for (x, part) in run.final_state().q.iter().zip(along) {
                agree(&what, *x, -(1.0 - small) * part, 20.0 * tolerance);
            }
            certified(&what, &run);
        }
    }
}

/// A block on four feet that is pushed by a little more than they hold.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x[3]),
    attitude(block: q),
    define(
        arm = [wide*block.axes[0] + deep*block.axes[1], deep*block.axes[1] - wide*block.axes[0],
            -wide*block.axes[0] - deep*block.axes[1], wide*block.axes[0] - deep*block.axes[1]],
        foot[k in 0..4] = x + arm[k] - high*block.axes[2],
    ),
    kinetic = dot(der(x), der(x))/2 + ((deep^2 + high^2)/6*block.body_rate[0]^2 + (wide^2 + high^2)/6*block.body_rate[1]^2
        + (wide^2 + deep^2)/6*block.body_rate[2]^2),
    potential = 10*x[2],
    contact(stands[k in 0..4]: foot[k][2] >= 0),
    friction(grip[k in 0..4] on stands[k]: slip = (der(foot[k][0]), der(foot[k][1])), static = mu),
    force(push: (load*cos(angle), load*sin(angle), 0) at x),
    start(rest: x[2] = high),
)]
struct Block {
    wide: f64,
    deep: f64,
    high: f64,
    mu: f64,
    load: f64,
    angle: f64,
}

#[test]
fn a_block_on_four_feet_that_is_hardly_pushed_slides() {
    for (more, angle) in [(3e-6, 0.0), (1e-6, 0.0)] {
        let scene = Block {
            wide: 1.0,
            deep: 0.8,
            high: 0.4,
            mu: 0.5,
            load: 5.0 + more,
            angle,
        };
        let run = run_by(&scene, ("auto", 1e-9), scene.at(Block::REST), 1.0);
        let what = format!("{scene:?}");
        let end = run.final_state();
        for (k, part) in [angle.cos(), angle.sin()].into_iter().enumerate() {
            agree(&what, end.q[k], 0.5 * more * part, 1e-8);
        }
        agree(&what, end.q[2], scene.high, 1e-8);
        certified(&what, &run);
    }
}

/// A point on a plate, with a friction of two components, that a friction along an oblique line holds as well.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, z),
    kinetic = (der(x)^2 + der(y)^2 + der(z)^2)/2,
    define(line = [cos(turn)*sin(tilt), sin(turn)*sin(tilt), cos(tilt)]),
    contact(plate: z >= 0),
    friction(rub on plate: slip = (der(x), der(y)), static = mu),
    friction(joint: slip = line[0]*der(x) + line[1]*der(y) + line[2]*der(z), limit = holds),
    force(press: -weight along der(z)),
    force(pull: grows*t along cos(heading)*der(x) + sin(heading)*der(y) + lift*der(z)),
)]
struct Oblique {
    holds: f64,
    turn: f64,
    mu: f64,
    weight: f64,
    grows: f64,
    heading: f64,
    tilt: f64,
    lift: f64,
}

/// Where no shares of the load are left it begins to slide along the line on the plate that the joint leaves open. With u that direction, N, the
/// force J of the joint and the acceleration a u solve three equations, and there a is positive and J within what the joint holds.
#[test]
fn a_slip_begins_in_the_only_direction_that_another_friction_leaves() {
    for (holds, turn, mu, weight, grows, heading, tilt, lift) in [
        (0.676, 0.44, 0.724, 0.946, 1.36, 1.7, 0.769, 0.163),
        (0.577, 2.37, 0.518, 1.3, 1.62, -2.66, 0.952, -0.0791),
        (0.331, -0.839, 0.262, 1.84, 1.51, -2.09, 0.803, -0.541),
    ] {
        let scene = Oblique {
            holds,
            turn,
            mu,
            weight,
            grows,
            heading,
            tilt,
            lift,
        };
        for (method, tolerance) in methods_at(["auto", "dop853", "radau5"], TOLERANCES) {
            let what = format!("{scene:?} by {method} at {tolerance:e}");
            let run = run_by(
                &scene,
                (method, tolerance),
                state(&[0.0; 3], &[0.0; 3]),
                0.9,
            );
            let slips = event(&run, "rub", "slips");
            let (along, force) = ([turn.cos(), turn.sin()], grows * slips.time);
            let pull = [force * heading.cos(), force * heading.sin()];
            let begins = |sign: f64| {
                let u = [-sign * along[1], sign * along[0]];
                // Along the line and on the plate: J from what the joint keeps at zero, N from the height.
                let across = pull[0] * along[0] + pull[1] * along[1];
                let joint = -across / tilt.sin();
                let normal = weight - force * lift - joint * tilt.cos();
                let acceleration = pull[0] * u[0] + pull[1] * u[1] - mu * normal;
                (acceleration, joint, normal)
            };
            let (acceleration, joint, normal) = [1.0, -1.0]
                .map(begins)
                .into_iter()
                .find(|(a, _, _)| *a > 0.0)
                .expect("one of both");
            assert!(joint.abs() < holds && normal > 0.0, "{what}");
            agree(&what, slips.forces_after[0], normal, 1e-5);
            agree(&what, slips.forces_after[3], joint, 1e-5);
            let mut sampler = run.sampler();
            let after = sampler.after(slips).expect("recorded");
            let [x, y] = [0, 1].map(|k| after.acceleration[k]);
            agree(&what, x.hypot(y), acceleration, 1e-5);
            certified(&what, &run);
        }
    }
}

/// A trestle that is pushed ever harder through the middle of its feet.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, turn, z, tilt[2]),
    define(
        place[k in 0..4] = [x + a[k]*cos(turn) - b[k]*sin(turn), y + a[k]*sin(turn) + b[k]*cos(turn)],
    ),
    kinetic = mass/2*(der(x)^2 + der(y)^2 + der(z)^2) + inertia/2*(der(turn)^2 + der(tilt[0])^2 + der(tilt[1])^2),
    potential = mass * 9.81 * z,
    contact(foot[k in 0..4]: z + b[k] * tilt[0] - a[k] * tilt[1] >= 0),
    friction(grip[k in 0..4] on foot[k]: slip = (der(place[k][0]), der(place[k][1])), static = mu),
    force(push: (rate*t*cos(heading), rate*t*sin(heading)) at (x, y)),
)]
struct Trestle {
    mass: f64,
    inertia: f64,
    mu: f64,
    a: [f64; 4],
    b: [f64; 4],
    rate: f64,
    heading: f64,
}

/// The same on three feet, each of which carries a third.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, turn),
    define(
        place[k in 0..3] = [x + a[k]*cos(turn) - b[k]*sin(turn), y + a[k]*sin(turn) + b[k]*cos(turn)],
    ),
    kinetic = mass/2*(der(x)^2 + der(y)^2) + inertia/2*der(turn)^2,
    friction(grip[k in 0..3]: slip = (der(place[k][0]), der(place[k][1])), normal = mass*9.81/3, static = mu),
    force(push: (rate*t*cos(heading), rate*t*sin(heading)) at (x, y)),
)]
struct Tripod {
    mass: f64,
    inertia: f64,
    mu: f64,
    a: [f64; 3],
    b: [f64; 3],
    rate: f64,
    heading: f64,
}

/// All feet begin to slip where the push is as much as friction, with no acceleration, and go straight on along it: r (t − t₀)³ / (6 m).
fn goes_straight<S: System<Scalar = f64> + core::fmt::Debug>(
    scene: &S,
    coordinates: usize,
    [mass, mu, rate, heading]: [f64; 4],
) {
    let slips = mu * mass * 9.81 / rate;
    let way = |time: f64| rate * time.powi(3) / (6.0 * mass);
    for (method, tolerance) in [("auto", 1e-9), ("dop853", 1e-9), ("dop853", 1e-12)] {
        let what = format!("{scene:?} by {method} at {tolerance:e}");
        let start = state(&vec![0.0; coordinates], &vec![0.0; coordinates]);
        let run = run_by(scene, (method, tolerance), start, slips + 1.0);
        assert!(
            words(&run).iter().all(|word| word.ends_with("slips")),
            "{what}: {:?}",
            words(&run)
        );
        assert!(run.work().steps < 500, "{what}: {:?}", run.work());
        let end = &run.final_state().q;
        let straight = [way(1.0) * heading.cos(), way(1.0) * heading.sin(), 0.0];
        for (q, expected) in end.iter().zip(straight) {
            agree(&what, *q, expected, 50.0 * tolerance);
        }
    }
}

#[test]
fn feet_that_begin_to_slip_together_do_not_turn() {
    let mut random = Random::new(77);
    for _ in 0..8 {
        let [mass, mu] = [random.between(1.0, 15.0), random.between(0.1, 0.9)];
        let [long, wide] = [random.between(0.3, 2.0), random.between(0.3, 1.0)];
        let (rate, heading) = (random.between(5.0, 40.0), random.between(-3.0, 3.0));
        let inertia = random.between(0.3, 3.0);
        let trestle = Trestle {
            mass,
            inertia,
            mu,
            a: [long, long, -long, -long],
            b: [wide, -wide, wide, -wide],
            rate,
            heading,
        };
        goes_straight(&trestle, 6, [mass, mu, rate, heading]);
        let tripod = Tripod {
            mass,
            inertia,
            mu,
            a: [long, -long / 2.0, -long / 2.0],
            b: [0.0, wide, -wide],
            rate,
            heading,
        };
        goes_straight(&tripod, 3, [mass, mu, rate, heading]);
    }
}

/// A disc on three pads that a fast force shakes.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, turn),
    kinetic = der(x)^2 + der(y)^2 + der(turn)^2/10,
    friction(a: slip = (der(x + 0.6*cos(turn)), der(y + 0.6*sin(turn))), limit = 1),
    friction(b: slip = (der(x - 0.3*cos(turn) - 0.4*sin(turn)), der(y - 0.3*sin(turn) + 0.4*cos(turn))), limit = 1),
    friction(c: slip = (der(x - 0.3*cos(turn) + 0.4*sin(turn)), der(y - 0.3*sin(turn) - 0.4*cos(turn))), limit = 1),
    force(shake: (strength*sin(rate*t)*cos(angle), strength*sin(rate*t)*sin(angle)) at (x, y)),
)]
struct Shaken {
    strength: f64,
    rate: f64,
    angle: f64,
}

/// All three slip as the force reaches 3 N, and the disc is carried along without a turn: 2 ẍ = F sin ωt − 3. Seconds or milliseconds are all one to it.
#[test]
fn pads_begin_to_slip_together_however_fast_they_are_shaken() {
    for (strength, rate, angle) in [
        (3.6, 100.0, 0.3),
        (3.6, 1e4, 2.0),
        (3.1, 80.0, -0.7),
        (4.0, 3.0, 1.1),
    ] {
        let scene = Shaken {
            strength,
            rate,
            angle,
        };
        let slips = f64::asin(3.0 / strength) / rate;
        let until = 1.5 / rate;
        let lasts = until - slips;
        let gone = (strength / rate * f64::cos(rate * slips) * lasts
            - strength / rate.powi(2) * (f64::sin(rate * until) - f64::sin(rate * slips))
            - 1.5 * lasts * lasts)
            / 2.0;
        for (method, tolerance) in methods_at(["auto", "dop853", "radau5"], [1e-9, 1e-12]) {
            let what = format!("{scene:?} by {method} at {tolerance:e}");
            let run = run_by(
                &scene,
                (method, tolerance),
                state(&[0.0; 3], &[0.0; 3]),
                until,
            );
            assert_eq!(words(&run), ["a slips", "b slips", "c slips"], "{what}");
            agree(
                &what,
                event(&run, "a", "slips").time,
                slips,
                1e-7 / rate.max(1.0),
            );
            agree(
                &what,
                run.final_state().q[0],
                gone * angle.cos(),
                10.0 * tolerance,
            );
            agree(
                &what,
                run.final_state().q[1],
                gone * angle.sin(),
                10.0 * tolerance,
            );
            certified(&what, &run);
        }
    }
}
