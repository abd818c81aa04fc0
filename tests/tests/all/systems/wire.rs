//! Friction on a constraint: beads on wires, a sleeve on a rod. N = |λ|, and λ may change its sign.

use super::{PI, state};
use lagrange_core::prelude::*;
use lagrange_tests::{
    METHODS, TOLERANCES, agree, all_agree, certified, closure, event, methods_at, root, run,
    run_by, words,
};

/// A bead on a circle in a plane that is inclined by `slope`, x downhill.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(r, theta),
    kinetic = mass/2 * (der(r)^2 + r^2 * der(theta)^2),
    potential = -mass * gravity * sin(slope) * r * cos(theta),
    constraint(wire: r == radius),
    friction(rub on wire: slip = radius * der(theta), static = mu_static, kinetic = mu_kinetic),
)]
struct Bead {
    mass: f64,
    radius: f64,
    gravity: f64,
    slope: f64,
    mu_static: f64,
    mu_kinetic: f64,
}

const BEAD: Bead = Bead {
    mass: 0.4,
    radius: 0.8,
    gravity: 9.81,
    slope: 0.0,
    mu_static: 0.3,
    mu_kinetic: 0.3,
};

/// On a horizontal circle N = m v²/r, so that v = v₀ e^(−μθ) and θ = ln(1 + μ v₀ t/r)/μ: it never stops.
#[test]
fn a_bead_on_a_horizontal_circle_loses_speed_by_the_angle() {
    for way in [1.0, -1.0] {
        let start = state(&[0.8, 0.0], &[0.0, way * 5.0]);
        let trajectory = run(&BEAD, start, 30.0);
        assert!(words(&trajectory).is_empty());
        let end = trajectory.final_state();
        let theta = (1.0_f64 + 0.3 * 5.0 * 30.0).ln() / 0.3;
        agree("angle", end.q[1], way * theta, 1e-11);
        agree("speed", end.v[1], way * 5.0 * (-0.3 * theta).exp(), 1e-12);
        assert!(closure(&trajectory) < 1e-11);
    }
}

/// In a vertical plane u = v² obeys du/dθ = −2 g r sin θ ∓ 2 μ r |N|/m, N/m = v²/r + g cos θ, linear wherever N has one sign.
/// Kicked from the bottom (θ = 0): up to where N = 0, beyond with N < 0.
#[test]
fn the_wire_pulls_then_pushes() {
    let bead = Bead {
        slope: PI / 2.0,
        mu_static: 0.2,
        mu_kinetic: 0.2,
        ..BEAD
    };
    let (g, r, mu, w0) = (9.81_f64, 0.8_f64, 0.2_f64, 7.0_f64);
    let trajectory = run(&bead, state(&[0.8, 0.0], &[0.0, w0]), 0.75);
    // w = θ̇²: dw/dθ + 2 σ μ w = −(2 g/r)(sin θ + σ μ cos θ) with σ the sign of N; a particular solution A cos θ + B sin θ.
    let speed = |sign: f64, from: f64, start: f64, theta: f64| {
        let m = sign * mu;
        let k = 2.0 * g / r / (1.0 + 4.0 * m * m);
        let particular = |x: f64| k * ((1.0 - 2.0 * m * m) * x.cos() - 3.0 * m * x.sin());
        (start - particular(from)) * (-2.0 * m * (theta - from)).exp() + particular(theta)
    };
    let first = |theta: f64| speed(1.0, 0.0, w0 * w0, theta);
    let turn = root(|x| first(x) + g / r * x.cos(), PI / 2.0, PI);
    println!(
        "{:?} turn {turn} {:?}",
        words(&trajectory),
        trajectory.final_state()
    );
    let mut sampler = trajectory.sampler();
    let mut seen = [false; 2];
    for k in 1..=50 {
        let instant = sampler.at(0.75 * f64::from(k) / 50.0).expect("in the run");
        let (theta, w) = (instant.state.q[1], instant.state.v[1]);
        if w < 0.1 {
            break;
        }
        let expected = if theta < turn {
            first(theta)
        } else {
            speed(-1.0, turn, first(turn), theta)
        };
        seen[usize::from(theta > turn)] = true;
        agree("speed", w * w, expected, 1e-10);
    }
    assert_eq!(seen, [true, true]);
    assert!(closure(&trajectory) < 1e-11);
}

/// In a vertical plane a resting bead stays within the angle of friction of the bottom (and of the top).
#[test]
fn a_bead_rests_within_the_angle_of_friction() {
    let bead = Bead {
        slope: PI / 2.0,
        ..BEAD
    };
    let angle = 0.3_f64.atan();
    for (theta, stays) in [
        (0.99 * angle, true),
        (1.01 * angle, false),
        (PI - 0.99 * angle, true),
        (PI - 1.01 * angle, false),
    ] {
        let trajectory = run(&bead, state(&[0.8, theta], &[0.0; 2]), 0.05);
        let moved = trajectory.final_state().q[1] != theta;
        assert_eq!(moved, !stays, "{theta}: {:?}", words(&trajectory));
    }
    // And one that slides to and fro ends there.
    let trajectory = run(&bead, state(&[0.8, 1.2], &[0.0; 2]), 20.0);
    let last = trajectory.events().last().expect("events");
    assert_eq!(last.kind, EventKind::Sticks);
    assert!(trajectory.final_state().q[1].abs() <= angle);
    assert!(closure(&trajectory) < 1e-11);
}

/// A sleeve on a rod at an angle, in Cartesian coordinates: a block on an incline, whichever way the rod pushes.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    constraint(rod: x * sin(slope) + y * cos(slope) == 0),
    friction(rub on rod: slip = der(x) * cos(slope) - der(y) * sin(slope), static = mu),
    force(push: (lift * sin(slope), lift * cos(slope)) at (x, y)),
)]
struct Sleeve {
    mass: f64,
    gravity: f64,
    slope: f64,
    mu: f64,
    lift: f64,
}

#[test]
fn a_sleeve_on_a_rod_slides_like_a_block() {
    let (g, slope, mass) = (9.81_f64, 0.5_f64, 1.3_f64);
    let weight = mass * g * slope.cos();
    // Pressed down by its weight, held by a push, pressed up by a larger one.
    for lift in [0.0, 0.5 * weight, weight, 1.7 * weight, 4.0 * weight] {
        let sleeve = Sleeve {
            mass,
            gravity: g,
            slope,
            mu: 0.35,
            lift,
        };
        let start = state(&[0.0; 2], &[-2.0 * slope.cos(), 2.0 * slope.sin()]);
        let trajectory = run(&sleeve, start, 2.0);
        let drag = 0.35 * (weight - lift).abs() / mass;
        let pull = g * slope.sin();
        let turn = 2.0 / (pull + drag);
        let along = |state: &State<f64>| state.q[0] * slope.cos() - state.q[1] * slope.sin();
        let up = -2.0 / (pull + drag);
        let left = 2.0 - turn;
        let stays = drag > pull;
        let down = if stays {
            0.0
        } else {
            0.5 * (pull - drag) * left * left
        };
        agree("way", along(trajectory.final_state()), up + down, 1e-11);
        let kind = if stays { "sticks" } else { "reverses" };
        agree("turn", event(&trajectory, "rub", kind).time, turn, 1e-11);
        assert!(closure(&trajectory) < 1e-11);
    }
}

/// A sleeve on a rod that turns at a constant rate in a level plane.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    constraint(rod: y * cos(rate * t) == x * sin(rate * t)),
    friction(rub on rod: slip = der(x) * cos(rate * t) + der(y) * sin(rate * t), static = mu),
    observe(r = x * cos(rate * t) + y * sin(rate * t)),
)]
struct Turning {
    mass: f64,
    rate: f64,
    mu: f64,
}

/// N = 2 m ω ṙ: r̈ + 2 μ ω ṙ − ω² r = 0 whichever way it slips; where it turns, slip and normal force vanish together. From
/// rest λ = 0 exactly at the start.
#[test]
fn a_sleeve_on_a_turning_rod() {
    let scene = Turning {
        mass: 0.3,
        rate: 2.0,
        mu: 0.4,
    };
    let (w, mu, r0) = (scene.rate, scene.mu, 0.5);
    let root = (mu * mu + 1.0_f64).sqrt();
    let (k1, k2) = (w * (root - mu), -w * (root + mu));
    for inward in [0.0, 0.3, -0.3, 0.8] {
        let start = state(&[r0, 0.0], &[-inward, w * r0]);
        let trajectory = run(&scene, start, 2.0);
        // r = a exp(k₁ t) + b exp(k₂ t)
        let b = (-inward - k1 * r0) / (k2 - k1);
        let a = r0 - b;
        println!("{inward} {:?} {:?}", words(&trajectory), trajectory.work());
        let mut sampler = trajectory.sampler();
        for k in 0..=20 {
            let t = 0.1 * f64::from(k);
            let r = a * (k1 * t).exp() + b * (k2 * t).exp();
            agree(
                "r",
                sampler.at(t).expect("in the run").observes[0],
                r,
                1e-11,
            );
        }
        assert!(closure(&trajectory) < 1e-11);
        if inward > 0.0 {
            let turn = ((-b * k2) / (a * k1)).ln() / (k1 - k2);
            agree(
                "turn",
                event(&trajectory, "rub", "reverses").time,
                turn,
                1e-9,
            );
        }
    }
}

/// All methods go through the change of sides and come to rest.
#[test]
fn all_methods_follow_the_bead() {
    let bead = Bead {
        slope: PI / 2.0,
        ..BEAD
    };
    let start = || state(&[0.8, 1.2], &[0.0, 3.0]);
    let trajectory = run(&bead, start(), 10.0);
    for (method, tolerance, bound) in [
        ("dopri5", 1e-10, 1e-7),
        ("dop853", 1e-11, 1e-9),
        ("verner98", 1e-11, 1e-9),
        ("radau5", 1e-10, 1e-7),
        ("rk4:1e-3", 1e-9, 1e-6),
        ("gauss6:1e-2", 1e-9, 1e-6),
    ] {
        let other = run_by(&bead, (method, tolerance), start(), 10.0);
        assert_eq!(words(&trajectory), words(&other), "{method}");
        all_agree(
            method,
            &trajectory.final_state().q,
            &other.final_state().q,
            bound,
        );
    }
}

/// Two slides joined by a slanting rod (Klein 1909): the lower one rubs in its guide, the upper one is pushed.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, u),
    kinetic = lower/2 * (der(x)^2 + der(y)^2) + upper/2 * der(u)^2,
    constraint(rod: sqrt((u - x)^2 + (height - y)^2) == length),
    constraint(guide: y == 0),
    friction(rub on guide: slip = der(x), static = mu),
    force(push: u = thrust * cos(rate*t)),
)]
struct Slides {
    lower: f64,
    upper: f64,
    height: f64,
    length: f64,
    mu: f64,
    thrust: f64,
    rate: f64,
}

/// With k = μ tan α and r = m₁/m₂ the force T along the guides obeys P r = (1 + r) T − k |T|: one answer for k < 1 + r, beyond
/// it none for P > 0 and two for P < 0.
#[test]
fn two_slides_on_a_slanting_rod() {
    let scene = Slides {
        lower: 1.0,
        upper: 2.0,
        height: 0.4,
        length: 0.5,
        mu: 0.6,
        thrust: 3.0,
        rate: 0.0,
    };
    let (slope, r) = (4.0 / 3.0, 0.5);
    let start = || state(&[0.0, 0.0, 0.3], &[1.0, 0.0, 1.0]);
    for thrust in [3.0, -3.0] {
        let k = scene.mu * slope * f64::signum(thrust);
        let scene = Slides { thrust, ..scene };
        let trajectory = run(&scene, start(), 0.2);
        let force = thrust * r / (1.0 + r - k);
        let acceleration = (thrust - force) / scene.upper;
        let now = trajectory.sampler().at(0.1).expect("in the run");
        agree("acceleration", now.acceleration[0], acceleration, 1e-12);
        assert!(closure(&trajectory) < 1e-12);
    }
    let rough = Slides { mu: 1.5, ..scene };
    let refused = Simulation::new(&rough).run(start(), 0.0..0.2);
    let error = refused.expect_err("no answer").error;
    assert!(
        matches!(error, Error::NoMode { item: "rub", .. }),
        "{error}"
    );
    let pulled = Slides {
        thrust: -3.0,
        ..rough
    };
    let trajectory = run(&pulled, start(), 0.1);
    assert!(
        trajectory.events().iter().all(|e| e.ambiguous),
        "{:?}",
        words(&trajectory)
    );
}

/// Two answers while the rod is pulled, none once it is pushed: the run ends where the thrust turns. The last root lies closer than
/// time resolves, and a mode that went on from there for ever would never say so.
#[test]
fn a_paradox_in_the_middle_of_a_run_keeps_the_trajectory() {
    let scene = Slides {
        lower: 1.0,
        upper: 2.0,
        height: 0.4,
        length: 0.5,
        mu: 1.5,
        thrust: -3.0,
        rate: 2.0,
    };
    for digits in 5..=16 {
        let tolerance = 10f64.powi(-digits);
        let failure = Simulation::new(&scene)
            .tolerance(tolerance)
            .max_steps(1000)
            .run(state(&[0.0, 0.0, 0.3], &[1.0, 0.0, 1.0]), 0.0..2.0)
            .expect_err("no answer");
        let Error::NoMode { time, item, .. } = failure.error else {
            panic!("{tolerance:e}: {failure}")
        };
        assert_eq!(item, "rub");
        agree("time of the paradox", time, PI / 4.0, tolerance.max(1e-11));
        assert_eq!(failure.trajectory.last_time(), time);
        assert!(failure.trajectory.work().steps > 0);
    }
}

/// A bead on a straight rough wire is pushed against a wall, which leans by `lean`, and pulled away from it later.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    potential = weight * y,
    constraint(wire: y == 0),
    contact(wall: x * cos(lean) + y * sin(lean) >= 0),
    friction(rub on wire: slip = der(x), static = mu),
    force(push: x = -strength * cos(t)),
)]
struct Pressed {
    weight: f64,
    strength: f64,
    lean: f64,
    mu: f64,
}

impl Pressed {
    /// The least N, λ and F that balance the push P, N cos α + F = P and N sin α + λ = W, and keep N ≥ 0 and |F| ≤ μ |λ|: at the foot of
    /// the perpendicular onto this line, or where one of the bounds is met.
    fn least_forces(&self, push: f64) -> Option<[f64; 3]> {
        let (sin, cos) = self.lean.sin_cos();
        let forces = |n: f64| [n, self.weight - n * sin, push - n * cos];
        let met = |side: f64| (push - side * self.weight) / (cos - side * sin);
        let foot = 0.5 * (push * cos + self.weight * sin);
        let candidates = [foot, 0.0, met(self.mu), met(-self.mu)].map(forces);
        let allowed = |[n, wire, rub]: &[f64; 3]| {
            *n >= 0.0 && rub.abs() <= self.mu * wire.abs() * (1.0 + 1e-12)
        };
        let square = |forces: &[f64; 3]| forces.iter().map(|x| x * x).sum::<f64>();
        let allowed = candidates.into_iter().filter(allowed);
        allowed.min_by(|x, y| square(x).total_cmp(&square(y)))
    }
}

/// How wall and friction share the push is open, and with a wall that leans the wire's force is too, with its sign. The bead leaves the
/// wall, and slips, where friction alone holds no longer: −P = μ |W|.
#[test]
fn what_a_wire_shares_with_a_wall_stays_within_its_friction() {
    // The wire's force of the last has its sign from the share of the wall, as long as P > W.
    let cases = [
        (10.0, 0.0, 2.0),
        (-10.0, 0.0, 2.0),
        (4.0, -0.3, 2.0),
        (6.0, PI / 4.0, 0.9),
    ];
    for (weight, lean, until) in cases {
        let scene = Pressed {
            weight,
            strength: 10.0,
            lean,
            mu: 0.1,
        };
        let leaves = (-0.1 * f64::abs(weight) / 10.0).acos();
        for (method, tolerance) in methods_at(["taylor", "dop853", "radau5"], [1e-6, 1e-12]) {
            let asked = format!("{weight} {lean} {method} {tolerance:e}");
            let start = state(&[0.0; 2], &[0.0; 2]);
            let motion = run_by(&scene, (method, tolerance), start, until);
            if until < leaves {
                assert!(words(&motion).is_empty(), "{asked}: {:?}", words(&motion));
            } else {
                for (item, word) in [("wall", "lost"), ("rub", "slips")] {
                    let time = event(&motion, item, word).time;
                    agree(&asked, time, leaves, 20.0 * tolerance);
                }
            }
            certified(&asked, &motion);
            let mut sampler = motion.sampler();
            for t in (0..16).map(|k| 0.1 * f64::from(k)).filter(|t| *t < until) {
                let now = sampler.at(t).expect("within the run");
                let least = scene.least_forces(10.0 * t.cos()).expect("it holds");
                let forces = [
                    now.force(Pressed::WALL),
                    now.force(Pressed::WIRE),
                    now.force(Pressed::RUB),
                ];
                all_agree(format!("{asked} at {t}"), &forces, &least, 1e-9);
            }
        }
    }
}

/// A bead on a straight rough wire that lies on a floor: a load presses it down or lifts it, and a pull along the wire is held by its friction.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    constraint(wire: y == 0),
    contact(floor: y >= 0),
    friction(rub on wire: slip = der(x), static = mu),
    force(load: (pull, -weight - swing * cos(2 * t)) at (x, y)),
)]
struct Lying {
    pull: f64,
    weight: f64,
    swing: f64,
    mu: f64,
}

/// The floor may push as much as it likes against the wire, λ + N = W: whatever the load, they hold the bead, and nothing is told where the least of
/// such forces has the wire pull where it has pushed. These are λ = N = W/2 while that holds the bead, or the nearest to it: μ |λ| = P.
#[test]
fn a_wire_that_pulls_where_it_has_pushed_tells_nothing() {
    let scene = Lying {
        pull: 0.3,
        weight: 2.0,
        swing: 5.0,
        mu: 0.5,
    };
    for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
        let simulation = Simulation::new(&scene).method(method).tolerance(tolerance);
        let motion = simulation
            .run(state(&[0.0; 2], &[0.0; 2]), 0.0..6.0)
            .unwrap();
        assert!(
            motion.events().is_empty(),
            "{method} {tolerance:e}: {:?}",
            words(&motion)
        );
        assert_eq!(motion.final_state().q, [0.0; 2]);
        let mut sampler = motion.sampler();
        for k in 0..=60 {
            let t = 0.1 * f64::from(k);
            let load = 2.0 + 5.0 * (2.0 * t).cos();
            let least: f64 = 0.3 / 0.5;
            let pushes = least.max(0.5 * load);
            let wire = if pushes <= load {
                pushes
            } else {
                (-least).min(load)
            };
            let instant = sampler.at(t).unwrap();
            agree("wire", instant.force(Lying::WIRE), wire, 1e-7);
            agree("floor", instant.force(Lying::FLOOR), load - wire, 1e-7);
            agree("rub", instant.force(Lying::RUB), -0.3, 1e-7);
        }
        let certificate = motion.verify(0).unwrap();
        assert!(certificate.holds(), "{method} {tolerance:e}");
    }
}
