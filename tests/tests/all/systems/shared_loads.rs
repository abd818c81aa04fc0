//! Frictions that share a load in no determined way, and a load that exceeds what they hold for a moment only.

use super::{PI, state};
use lagrange_core::prelude::*;
use lagrange_tests::{
    METHODS, Random, SINGLE_METHODS, TOLERANCES, agree, certified, event, methods_at, root, run_by,
    times, words,
};

/// A sledge on two rough runners under a load that comes and goes.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, theta),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + inertia/2 * der(theta)^2,
    potential = mass * gravity * y,
    contact(rear: y - theta >= 0),
    contact(front: y + theta >= 0),
    friction(rear_grip on rear: slip = der(x), static = mu),
    friction(front_grip on front: slip = der(x), static = mu),
    force(pull: (load * sin(t)^8, 0) at (x, y)),
)]
struct Sledge {
    mass: f64,
    inertia: f64,
    gravity: f64,
    mu: f64,
    load: f64,
}

/// It slips where load sin⁸t = μ m g, however long the steps before are, and whatever the load is at their ends.
#[test]
fn a_load_that_is_too_large_for_a_moment_makes_it_slip() {
    for load in [4.01, 4.3, 6.0] {
        let scene = Sledge {
            mass: 1.0,
            inertia: 0.3,
            gravity: 10.0,
            mu: 0.4,
            load,
        };
        for (method, tolerance) in methods_at(
            ["taylor", "dop853", "verner98", "radau5", "rk4:0.01"],
            [1e-6, 1e-12],
        ) {
            let start = state(&[0.0; 3], &[0.0; 3]);
            let motion = run_by(&scene, (method, tolerance), start, 2.0);
            let asked = format!("{load} {method} {tolerance:e}");
            assert!(!words(&motion).is_empty(), "{asked}");
            for grip in ["rear_grip", "front_grip"] {
                let time = event(&motion, grip, "slips").time;
                agree(&asked, load * time.sin().powi(8), 4.0, 20.0 * tolerance);
                assert!(time < 0.5 * core::f64::consts::PI, "{asked}");
            }
        }
        let scene = Sledge {
            load: 3.99,
            ..scene
        };
        let holds = run_by(&scene, ("taylor", 1e-6), state(&[0.0; 3], &[0.0; 3]), 2.0);
        assert!(words(&holds).is_empty(), "{:?}", words(&holds));
    }
}

/// A bar that slides on three supports, of which two are enough.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, theta),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + inertia/2 * der(theta)^2,
    potential = mass * gravity * y,
    contact(support[k in 0..3]: y + (k - 1) * theta >= 0),
    friction(first on support[0]: slip = der(x), static = mu),
    friction(middle on support[1]: slip = der(x), static = nu),
    friction(last on support[2]: slip = der(x), static = mu),
)]
struct Bar {
    mass: f64,
    inertia: f64,
    gravity: f64,
    mu: f64,
    nu: f64,
}

/// With equal coefficients the sum of the forces is enough, with others the share that each support carries decides on
/// the motion, and rigid bodies do not say it.
#[test]
fn a_motion_that_depends_on_undetermined_forces_is_ambiguous() {
    for (nu, open) in [(0.2, false), (0.0, true), (0.3, true)] {
        let scene = Bar {
            mass: 1.0,
            inertia: 0.3,
            gravity: 10.0,
            mu: 0.2,
            nu,
        };
        let start = state(&[0.0; 3], &[5.0, 0.0, 0.0]);
        let motion = run_by(&scene, ("taylor", 1e-12), start, 1.0);
        let told = motion.events().iter().any(|e| e.ambiguous);
        assert_eq!(told, open, "{nu}: {:?}", words(&motion));
        assert!(motion.verify(0).expect("a certificate").holds());
        if !open {
            agree("speed", motion.final_state().v[0], 5.0 - 0.2 * 10.0, 1e-12);
        }
    }
}

/// A mat of three hinged rods, dropped flat onto a rough floor.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, a[3]),
    define(
        px[k in 0..4] = x + sum(i in 0..k: length * cos(a[i])),
        py[k in 0..4] = y + sum(i in 0..k: length * sin(a[i])),
    ),
    kinetic = sum(k in 0..3: mass/2 * ((der(px[k] + px[k+1])^2 + der(py[k] + py[k+1])^2)/4 + length^2/12 * der(a[k])^2)),
    potential = sum(k in 0..3: mass * gravity * (py[k] + py[k+1])/2),
    contact(floor[k in 0..4]: py[k] >= 0),
    friction(grip[k in 0..4] on floor[k]: slip = der(px[k]), static = mu),
)]
struct Mat {
    mass: f64,
    length: f64,
    gravity: f64,
    mu: f64,
}

/// It slides and comes to rest on four points, of whose slips one is enough: the others turn the rods by what rounding leaves.
#[test]
fn a_mat_lies_flat() {
    let mat = Mat {
        mass: 0.5,
        length: 0.3,
        gravity: 9.81,
        mu: 0.2,
    };
    let (height, speed): (f64, f64) = (0.2, 1.5);
    let (fall, braking) = ((2.0 * height / mat.gravity).sqrt(), mat.mu * mat.gravity);
    // The impact brakes it as well.
    let slides = speed - braking * fall;
    let (rest, x) = (
        fall + slides / braking,
        speed * fall + slides * slides / (2.0 * braking),
    );
    for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
        let what = format!("{method} at {tolerance:e}");
        let start = |y, v, tilt: [f64; 3]| {
            let q = [&[0.0, y], &tilt[..]].concat();
            State::new(q, vec![v, 0.0, 0.0, 0.0, 0.0])
        };
        let run = run_by(
            &mat,
            (method, tolerance),
            start(height, speed, [0.0; 3]),
            4.0,
        );
        let bound = (100.0 * tolerance).max(1e-11);
        let (sticks, end) = (event(&run, "grip[0]", "sticks"), run.final_state());
        agree(&what, sticks.time, rest, bound);
        agree(&what, end.q(Mat::X), x, bound);
        let run = run_by(
            &mat,
            (method, tolerance),
            start(0.4, 0.5, [-0.2, 0.3, 0.1]),
            4.0,
        );
        let end = run.final_state();
        for q in &end.q[1..] {
            agree(&what, *q, 0.0, bound);
        }
        let last = run.events().last().expect("it lands");
        let loads = (0..4).map(|k| last.force_after(Mat::FLOOR[k]));
        agree(&what, loads.sum(), 3.0 * mat.mass * mat.gravity, bound);
    }
}

/// A tooth between the two flanks of a gap without play, whose wheel swings; nothing else acts on it.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(tooth),
    kinetic = inertia/2 * der(tooth)^2,
    contact(drive: tooth >= swing * sin(rate * t)),
    contact(coast: tooth <= swing * sin(rate * t)),
)]
struct Tooth {
    inertia: f64,
    swing: f64,
    rate: f64,
}

/// One flank pushes, the other carries nothing, although only the flanks themselves drive.
#[test]
fn of_two_flanks_one_pushes() {
    let gear = Tooth {
        inertia: 0.3,
        swing: 0.2,
        rate: 5.0,
    };
    for method in ["taylor", "dop853"] {
        let start = state(&[0.0], &[gear.swing * gear.rate]);
        let motion = run_by(&gear, (method, 1e-9), start, 2.0);
        for k in 1..40 {
            let t = 0.05 * f64::from(k);
            let now = motion.sampler().at(t).expect("inside");
            let push = -gear.inertia * gear.swing * gear.rate.powi(2) * (gear.rate * t).sin();
            let asked = format!("{method} at {t}");
            agree(&asked, now.force(Tooth::DRIVE), push.max(0.0), 1e-8);
            agree(&asked, now.force(Tooth::COAST), (-push).max(0.0), 1e-8);
        }
    }
}

/// A disc that turns between two pads without play, pressed now onto one, now onto the other.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(z, theta),
    kinetic = mass/2 * der(z)^2 + inertia/2 * der(theta)^2,
    force(press: z = -load * cos(rate * t)),
    contact(front: z >= 0),
    contact(back: z <= 0),
    friction(front_pad on front: slip = radius * der(theta), static = mu),
    friction(back_pad on back: slip = radius * der(theta), static = mu),
)]
struct Disc {
    mass: f64,
    inertia: f64,
    load: f64,
    rate: f64,
    radius: f64,
    mu: f64,
}

/// I ω̇ = −μ R F |cos νt|, so that it stops where ∫|cos νt| ν dt is I ω ν/(μ R F).
#[test]
fn a_load_that_reverses_brakes_on_the_other_side() {
    let disc = Disc {
        mass: 2.0,
        inertia: 0.4,
        load: 9.0,
        rate: 2.0,
        radius: 0.25,
        mu: 0.3,
    };
    for (spin, angle, pad) in [
        (0.6, 0.6_f64.asin(), "front_pad"),
        (1.3, PI - 0.7_f64.asin(), "back_pad"),
        (3.3, 2.0 * PI - 0.7_f64.asin(), "front_pad"),
    ] {
        let omega = spin * disc.mu * disc.radius * disc.load / (disc.inertia * disc.rate);
        for (method, tolerance) in methods_at(["auto", "taylor", "dop853"], TOLERANCES) {
            let start = state(&[0.0; 2], &[0.0, omega]);
            let motion = run_by(&disc, (method, tolerance), start, 3.0);
            let asked = format!("{spin} {method} {tolerance:e}");
            let time = event(&motion, pad, "sticks").time;
            agree(&asked, disc.rate * time, angle, 100.0 * tolerance);
        }
    }
}

/// A tray with four feet in a line, of which two are enough, falls askew onto a rough table.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, theta),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + inertia/2 * der(theta)^2,
    potential = mass * gravity * y,
    contact(foot[k in 0..4]: y + place[k] * sin(theta) >= 0, restitution = bounce),
    friction(rub[k in 0..4] on foot[k]: slip = der(x), static = mu),
)]
struct Tray {
    mass: f64,
    inertia: f64,
    gravity: f64,
    place: [f64; 4],
    bounce: f64,
    mu: f64,
}

/// Once it has rattled to rest on two feet it lies on all four, and whatever each impact does, all of them together stop the fall and
/// take μ of that from the speed.
#[test]
fn what_lies_on_two_of_its_feet_lies_on_all() {
    for (place, bounce, tilt) in [
        ([-0.9, -0.25, 0.2, 0.8], 0.3, 0.3),
        ([-0.4, -0.1, 0.3, 0.6], 0.1, -0.2),
        ([-0.7, 0.1, 0.2, 0.5], 0.45, 0.1),
    ] {
        let scene = Tray {
            mass: 1.5,
            inertia: 0.2,
            gravity: 10.0,
            place,
            bounce,
            mu: 0.2,
        };
        let (fall, until) = (0.5, 1.8);
        let slides = 6.0 - scene.mu * (scene.gravity * until + fall);
        for (method, tolerance) in methods_at(SINGLE_METHODS, TOLERANCES) {
            let start = state(&[0.0, 0.6, tilt], &[6.0, -fall, 0.4]);
            let motion = run_by(&scene, (method, tolerance), start, until);
            let asked = format!("{place:?} {method} {tolerance:e}");
            let speed = motion.final_state().v[0];
            agree(&asked, speed, slides, (1e3 * tolerance).max(1e-10));
            assert_eq!(motion.final_mode().contacts, [true; 4], "{asked}");
        }
    }
}

/// A plank slides on three supports in a row, of which only the first is rough.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, theta),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + inertia/2 * der(theta)^2,
    potential = mass * gravity * y,
    contact(support[k in 0..3]: y + place[k] * sin(theta) >= 0),
    friction(rough on support[0]: slip = der(x), static = mu),
)]
struct Plank {
    mass: f64,
    inertia: f64,
    gravity: f64,
    place: [f64; 3],
    mu: f64,
}

/// Which of them carry it is open; told are forces that balance, that push, and that the friction belongs to, all the time.
#[test]
fn forces_that_are_open_are_possible_ones() {
    for place in [
        [-0.6, -0.2, 0.9],
        [-0.6, 0.2, 0.9],
        [-0.3, 0.2, 0.5],
        [0.5, 0.1, -0.8],
    ] {
        let scene = Plank {
            mass: 0.8,
            inertia: 0.1,
            gravity: 10.0,
            place,
            mu: 0.3,
        };
        for method in ["taylor", "dop853", "radau5"] {
            let (until, start) = (1.0, state(&[0.0; 3], &[5.0, 0.0, 0.0]));
            let motion = run_by(&scene, (method, 1e-9), start, until);
            let asked = format!("{place:?} {method}");
            assert!(motion.events().iter().any(|e| e.ambiguous), "{asked}");
            let mut sampler = motion.sampler();
            let now = sampler.at(until).expect("the end");
            let normal = [0, 1, 2].map(|k| now.force(Plank::SUPPORT[k]));
            let friction = now.force(Plank::ROUGH);
            let moment: f64 = normal.iter().zip(place).map(|(n, p)| n * p).sum();
            assert!(normal.iter().all(|&n| n >= -1e-9), "{asked}: {normal:?}");
            agree(
                &asked,
                normal.iter().sum(),
                scene.mass * scene.gravity,
                1e-9,
            );
            agree(&asked, moment, 0.0, 1e-9);
            agree(&asked, friction, -scene.mu * normal[0], 1e-9);
            let speed = 5.0 + friction / scene.mass * until;
            agree(&asked, motion.final_state().v[0], speed, 1e-8);
        }
    }
}

/// A beam on three supports, of which the load lifts it again and again.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(y, theta),
    kinetic = der(y)^2/2 + der(theta)^2/6,
    potential = gravity * y,
    contact(under[k in 0..3]: y + (k - 1)*sin(theta) >= 0),
    force(lift: y = load * sin(rate*t)),
)]
struct Lifted {
    gravity: f64,
    load: f64,
    rate: f64,
}

/// Nothing moves before it lifts, so that nothing but the forces bounds the steps; and where it does, nothing is left of any of them.
#[test]
fn what_is_shared_ends_with_the_load_each_time() {
    let scene = Lifted {
        gravity: 9.81,
        load: 12.0,
        rate: 1.3,
    };
    let first = (scene.gravity / scene.load).asin() / scene.rate;
    let period = 2.0 * PI / scene.rate;
    for (method, tolerance) in [
        ("taylor", 1e-6),
        ("taylor", 1e-9),
        ("taylor", 1e-12),
        ("dop853", 1e-9),
        ("radau5", 1e-6),
    ] {
        let asked = format!("{method} {tolerance:e}");
        let motion = run_by(
            &scene,
            (method, tolerance),
            state(&[0.0; 2], &[0.0; 2]),
            50.0,
        );
        for support in ["under[0]", "under[1]", "under[2]"] {
            let times = times(&motion, support, "lost");
            assert_eq!(times.len(), 11, "{asked} {support}: {times:?}");
            for (k, time) in times.iter().enumerate() {
                agree(&asked, *time, first + k as f64 * period, 20.0 * tolerance);
            }
        }
        agree("angle", motion.final_state().q[1], 0.0, 20.0 * tolerance);
    }
}

/// A block that two frictions hold together, and a load that shakes it.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x),
    kinetic = der(x)^2/2,
    force(shake: x = load * sin(rate*t)),
    friction(strong: slip = der(x), limit = 0.7),
    friction(weak: slip = der(x), limit = 0.1),
)]
struct Held {
    load: f64,
    rate: f64,
}

/// It slips as a block does that one friction of their sum holds.
#[test]
fn two_frictions_hold_as_one_of_their_sum() {
    let held = Held {
        load: 0.9,
        rate: 1.3,
    };
    let first = (0.8_f64 / 0.9).asin() / 1.3;
    for method in ["taylor", "dop853", "verner98", "radau5"] {
        let motion = run_by(&held, (method, 1e-9), state(&[0.0], &[0.0]), 30.0);
        let [strong, weak] = ["strong", "weak"].map(|name| times(&motion, name, "slips"));
        agree(method, strong[0], first, 1e-8);
        // Half a turn of the load later it slips the other way, and so on.
        assert_eq!(strong.len(), 13, "{method}: {strong:?}");
        for (k, (strong, weak)) in strong.iter().zip(&weak).enumerate() {
            agree(method, *strong, *weak, 1e-8);
            agree(method, *strong, first + k as f64 * PI / 1.3, 1e-7);
        }
    }
}

/// A beam on three supports, whose load wanders; a gauge is pushed by the first support.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(y, theta, u, x),
    kinetic = (der(y)^2 + der(u)^2 + der(x)^2)/2 + der(theta)^2/6,
    potential = gravity * y,
    force(lift: y = load * sin(rate*t)),
    force(turn: theta = torque * sin(rate*t)),
    contact(under[k in 0..3]: y + (k - 1) * sin(theta) >= 0),
    force(gauge: u = under[0]),
    friction(grip on under[2]: slip = der(x), static = mu),
    mark(high: under[0] >= limit),
)]
struct Weighed {
    gravity: f64,
    load: f64,
    rate: f64,
    torque: f64,
    limit: f64,
    mu: f64,
}

/// Marks, forces and frictions read the load that is reported, that of equal springs: λ = g/3 − (load/3 + (k − 1) torque/2) sin ωt. The support in
/// the middle has a constant row and the others have not.
#[test]
fn what_reads_a_shared_force_reads_the_one_reported() {
    let scene = Weighed {
        gravity: 9.81,
        load: 1.5,
        rate: 1.3,
        torque: 3.0,
        limit: 4.0,
        mu: 0.1,
    };
    let first = (0.73_f64).asin() / scene.rate;
    let (until, period) = (12.0, 2.0 * PI / scene.rate);
    let waves = |t: f64| t / scene.rate - (scene.rate * t).sin() / scene.rate.powi(2);
    let smooth = Effects::all().without(Weighed::GRIP);
    let light = smooth.clone().without(Weighed::GAUGE);
    for (effects, gauged, rubs) in [
        (Effects::all(), true, true),
        (smooth, true, false),
        (light, false, false),
    ] {
        for method in ["taylor", "dop853", "radau5"] {
            let simulation = Simulation::new(&scene)
                .effects(effects.clone())
                .method(method.parse().expect("a method"));
            let start = state(&[0.0; 4], &[0.0, 0.0, 0.0, 20.0]);
            let motion = simulation.run(start, 0.0..until).expect(method);
            certified(method, &motion);
            let marks = times(&motion, "high", "mark");
            assert_eq!(marks.len(), 3, "{method}: {marks:?}");
            for (k, time) in marks.iter().enumerate() {
                agree(method, *time, first + k as f64 * period, 1e-7);
            }
            let end = motion.final_state();
            if gauged {
                agree(
                    method,
                    end.q[2],
                    9.81 / 6.0 * until.powi(2) + waves(until),
                    1e-6,
                );
            }
            if rubs {
                // −2 sin ωt at the other end: the speed is lost by 0.1 of its integral.
                let lost = 3.27 * until - 2.0 * (1.0 - (1.3 * until).cos()) / 1.3;
                agree(method, end.v[3], 20.0 - 0.1 * lost, 1e-6);
            }
        }
    }
}

/// A plate leans on a wall and turns freely; one friction is along its heading, where it is pushed, and one across.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, p),
    kinetic = (der(x)^2 + der(y)^2)/2 + der(p)^2/2,
    potential = -press * x,
    contact(wall: x <= 0),
    force(push: 2 along der(x)*cos(p) + der(y)*sin(p)),
    friction(across: slip = der(y)*cos(p) - der(x)*sin(p), limit = 2),
    friction(along_it: slip = der(x)*cos(p) + der(y)*sin(p), limit = 3/2),
    start(leans: p = 1/5, der(p) = rate),
)]
struct Plate {
    press: f64,
    rate: f64,
}

/// It is held as long as 2 cos p ≥ sin p/2, whatever the forces on it are, which are open: their directions turn with the plate. Then
/// ÿ = sin p/2 − 2 |cos p|, here until after p = π/2.
#[test]
fn frictions_whose_directions_turn_hold_together_as_long_as_they_can() {
    let begin = 4.0_f64.atan();
    let (side, up) = (begin.cos(), begin.sin());
    let end = 1.8;
    for rate in [0.6, 1.0, 1.7] {
        let plate = Plate { press: 3.0, rate };
        let upright = PI / 2.0;
        // ω ẏ and ω² y by p.
        let speed = 0.5 * side - 2.0 + 2.0 * up;
        let first = -0.5 * (1.0 - up) + (0.5 * side + 2.0 * up) * (upright - begin) - 2.0 * side;
        let second = (speed - 2.0) * (end - upright) - 0.5 * (end.sin() - 1.0) - 2.0 * end.cos();
        for by in methods_at(METHODS, TOLERANCES) {
            let what = format!("{rate} rad/s by {by:?}");
            let run = run_by(&plate, by, plate.at(Plate::LEANS), (end - 0.2) / rate);
            let bound = (100.0 * by.1).max(1e-11);
            for item in ["across", "along_it"] {
                let slips = event(&run, item, "slips").time;
                agree(&what, slips, (begin - 0.2) / rate, bound);
            }
            let y = (first + second) / (rate * rate);
            agree(&what, run.final_state().q[1], y, bound);
            certified(&what, &run);
        }
    }
}

/// A bead on a circle comes down onto a stop, and rests there: it is held by the circle, the stop and by friction, two of them would do.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, h),
    kinetic = mass/2 * (der(x)^2 + der(h)^2),
    potential = mass * gravity * h,
    constraint(circle: x^2 + h^2 == 1),
    friction(grip: slip = der(x), limit = (4, holds)),
    contact(rest: h >= low),
    force(shake: h = sin(5*t)),
    start(above: x = 3/5, h = 4/5),
)]
struct Bead {
    mass: f64,
    gravity: f64,
    holds: f64,
    low: f64,
}

/// Steps at rest are as long as those of a motion that begins there, and the energy is lost in the impact.
#[test]
fn what_rests_on_more_than_it_needs_does_not_lose_rank() {
    for (mass, holds, low) in [(1.0, 0.4, 0.7), (1.0, 1.0, 0.6), (2.0, 0.1, 0.72)] {
        let bead = Bead {
            mass,
            gravity: 9.81,
            holds,
            low,
        };
        for by in [
            ("auto", 1e-9),
            ("auto", 1e-12),
            ("dopri5", 1e-9),
            ("radau5", 1e-9),
        ] {
            let what = format!("{mass} {holds} {low} by {by:?}");
            let run = run_by(&bead, by, bead.at(Bead::ABOVE), 2.0);
            let end = run.final_state();
            agree(&what, end.q[1], low, 1e-12);
            agree(&what, end.q[0], (1.0 - low * low).sqrt(), 1e-9);
            agree(&what, end.v[0], 0.0, 1e-12);
            assert!(run.work().steps < 300, "{what}: {} steps", run.work().steps);
            certified(&what, &run);
        }
    }
}

/// A beam on three supports, one of which is drawn inwards.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(y, p),
    kinetic = der(y)^2 + der(p)^2/2,
    potential = load * (y + arm * p),
    contact(left: y - p >= 0),
    contact(middle: y + inner * p >= 0),
    contact(right: y + (1 - rate * t) * p >= 0),
)]
struct Drawn {
    load: f64,
    arm: f64,
    inner: f64,
    rate: f64,
}

/// It tips where the support passes the load, at (1 − arm)/rate.
#[test]
fn a_beam_tips_over_a_support_that_moves() {
    let mut random = Random::new(52);
    for _ in 0..8 {
        let beam = Drawn {
            load: random.between(2.0, 10.0),
            arm: random.between(0.2, 0.7),
            inner: random.between(-0.8, 0.1),
            rate: random.between(0.2, 0.6),
        };
        let tips = (1.0 - beam.arm) / beam.rate;
        for (method, tolerance) in methods_at(["auto", "dop853", "verner98", "radau5"], TOLERANCES)
        {
            let start = state(&[0.0; 2], &[0.0; 2]);
            let motion = run_by(&beam, (method, tolerance), start, tips + 0.2);
            let what = format!("{beam:?} by {method} at {tolerance:e}");
            for support in ["left", "middle"] {
                agree(&what, event(&motion, support, "lost").time, tips, 1e-7);
            }
            certified(&what, &motion);
        }
    }
}

/// A block that a pad and the end of a lever hold, which moves ever faster than the block.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x),
    kinetic = der(x)^2/2,
    friction(pad: slip = der(x), limit = own),
    friction(end: slip = (1 + growth * t) * der(x), limit = far),
    force(pull: x = rise * t^3),
)]
struct Lever {
    own: f64,
    far: f64,
    growth: f64,
    rise: f64,
}

/// It lets go where rise t³ = own + far (1 + growth t).
#[test]
fn what_holds_by_a_ratio_that_changes_lets_go_where_both_are_overcome() {
    let mut random = Random::new(53);
    for _ in 0..20 {
        let lever = Lever {
            own: random.between(0.3, 1.5),
            far: random.between(0.3, 1.5),
            growth: random.between(0.3, 1.5),
            rise: random.between(1.0, 4.0),
        };
        let excess =
            |t: f64| lever.rise * t.powi(3) - lever.own - lever.far * (1.0 + lever.growth * t);
        let overcome = root(excess, 0.0, 4.0);
        for (method, tolerance) in methods_at(["auto", "dop853", "verner98", "radau5"], TOLERANCES)
        {
            let motion = run_by(&lever, (method, tolerance), state(&[0.0], &[0.0]), 4.0);
            let what = format!("{lever:?} by {method} at {tolerance:e}");
            for friction in ["pad", "end"] {
                agree(
                    &what,
                    event(&motion, friction, "slips").time,
                    overcome,
                    1e-7,
                );
            }
        }
    }
}

/// A plate on three feet, one of which comes nearer and nearer to the load.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(y, p),
    kinetic = der(y)^2 + 2/5 * der(p)^2,
    potential = 8 * (y + at_load * p),
    contact(left: y - p >= 0),
    contact(middle: y + 2/5 * p >= 0),
    contact(right: y + (1 - rate * t) * p >= 0),
)]
struct OnThreeFeet {
    at_load: f64,
    rate: f64,
}

/// It tips over the foot that has come under the load, also where a step begins just before that.
#[test]
fn a_plate_tips_where_a_foot_has_come_under_its_load() {
    for tips in [0.524_3, 0.525, 0.7, 1.048_59, 1.048_8, 1.05, 1.1] {
        let scene = OnThreeFeet {
            at_load: 0.57,
            rate: 0.43 / tips,
        };
        for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
            let start = state(&[0.0; 2], &[0.0; 2]);
            let motion = run_by(&scene, (method, tolerance), start, 1.199);
            let what = format!("{method} at {tolerance:e}");
            assert_eq!(words(&motion)[..2], ["left lost", "middle lost"], "{what}");
            agree(&what, times(&motion, "left", "lost")[0], tips, 1e-6);
            certified(&what, &motion);
        }
    }
}

/// A pendulum in x and y hangs from a slider that rests against a stop; its guide rubs.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, s),
    kinetic = bob/2*(der(x)^2 + der(y)^2) + slider/2*der(s)^2,
    potential = 9.81*bob*y,
    constraint(rod: (x - s)^2 + y^2 == length^2),
    contact(wall: s >= 0),
    friction(guide: slip = der(s), limit = strength),
    start(swung: x = length*sin(angle), y = -length*cos(angle), der(x) = length*cos(angle)*rate, der(y) = length*sin(angle)*rate),
)]
struct HungFromSlider {
    bob: f64,
    slider: f64,
    length: f64,
    strength: f64,
    angle: f64,
    rate: f64,
}

/// Wall and guide share a load whose sign is that of the angle: the slider leaves with m (g cos φ + l ω²) sin φ = F, where l ω² = l ω₀² + 2 g (cos φ − cos φ₀). A heavy
/// bob beside a light slider seems to lose its rod as that hangs down.
#[test]
fn a_slider_leaves_its_stop_as_soon_as_its_guide_cannot_hold_it() {
    for (bob, slider, length, strength, angle, rate) in [
        (16.0, 0.12, 0.86, 1.9, -0.69, -2.3),
        (17.5, 0.15, 0.83, 1.6, -0.5, 1.0),
        (13.5, 0.43, 0.443, 0.1, -0.726, -2.27),
        (1.0, 1.0, 0.5, 0.5, -1.0, 0.0),
        (0.2, 8.0, 0.7, 0.02, -0.4, -1.0),
    ] {
        let scene = HungFromSlider {
            bob,
            slider,
            length,
            strength,
            angle,
            rate,
        };
        let centripetal =
            |phi: f64| length * rate * rate + 2.0 * 9.81 * (phi.cos() - f64::cos(angle));
        let pull = |phi: f64| bob * (9.81 * phi.cos() + centripetal(phi)) * phi.sin() - strength;
        let leaves = root(pull, 0.0, 0.3);
        for (method, tolerance) in methods_at(METHODS, [1e-6, 1e-9, 1e-12]) {
            let run = run_by(
                &scene,
                (method, tolerance),
                scene.at(HungFromSlider::SWUNG),
                1.5,
            );
            let lost = event(&run, "wall", "lost");
            let what = format!("{scene:?} by {method} at {tolerance:e}");
            let phi = lost.state.q[0].atan2(-lost.state.q[1]);
            agree(&what, phi, leaves, (1e3 * tolerance).max(1e-9));
        }
    }
}
