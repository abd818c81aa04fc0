//! Bodies that several pads hold with friction in two directions: how they share that is open, and all cones together bound it.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{Random, agree, root, run_by, runge_kutta, words};

/// A bar on two pads at its ends, pulled ever harder at a place `off` its middle.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, phi),
    define(
        e = [cos(phi), sin(phi)],
        a = [x, y] - length/2 * e,
        b = [x, y] + length/2 * e,
        hook = [x, y] + off * e,
    ),
    kinetic = (der(x)^2 + der(y)^2) / 2 + length^2 / 24 * der(phi)^2,
    friction(first: slip = (der(a[0]), der(a[1])), normal = press[0], static = mu, kinetic = drags * mu),
    friction(second: slip = (der(b[0]), der(b[1])), normal = press[1], static = mu, kinetic = drags * mu),
    force(pull: (strength[0] * t, strength[1] * t) at hook),
)]
struct Bar {
    length: f64,
    off: f64,
    press: [f64; 2],
    mu: f64,
    /// Kinetic over static coefficient.
    drags: f64,
    strength: [f64; 2],
}

impl Bar {
    fn pulled(random: &mut Random, direction: f64) -> Self {
        Bar {
            length: 1.0,
            off: random.between(-0.5, 0.5),
            press: [random.between(3.0, 9.0), random.between(3.0, 9.0)],
            mu: 0.5,
            drags: 0.8,
            strength: [direction.cos(), direction.sin()],
        }
    }
}

/// When the first pad slips.
fn first_slip(motion: &Trajectory) -> f64 {
    let slips = motion.events().iter().find(|e| e.kind.word() == "slips");
    slips.expect("a pad that slips").time
}

/// However it is pulled, it holds at first: the accelerations that its forces keep at zero leave rounding, which grows with the time looked at.
#[test]
fn a_bar_holds_under_a_load_that_grows_from_nothing() {
    let mut random = Random::new(11);
    for k in 0..40 {
        let tilt = random.between(0.0, 3.0);
        let direction = random.between(0.0, 6.0);
        let bar = Bar::pulled(&mut random, direction);
        for (method, tolerance) in [("taylor", 1e-6), ("dop853", 1e-9), ("radau5", 1e-12)] {
            let start = state(&[0.0, 0.0, tilt], &[0.0; 3]);
            let motion = run_by(&bar, (method, tolerance), start, 1.4);
            assert!(
                words(&motion).is_empty(),
                "{method}, bar {k}: {:?}",
                words(&motion)
            );
            // One pad alone holds 1.5 N.
            let still = motion.final_state().v.iter().all(|v| v.abs() < 1e-14);
            assert!(still, "{method}, bar {k}: {:?}", motion.final_state().v);
        }
    }
}

/// Across the bar each pad has its share by the lever; along it they hold the rest together, √(μ²N₁² − F₁²) + √(μ²N₂² − F₂²) at most. Where the
/// pull is across the bar, only one pad is at its limit, and what it may hold along the bar vanishes as a root does.
#[test]
fn a_bar_slips_when_both_cones_cannot_hold_it() {
    let mut random = Random::new(11);
    for k in 0..40 {
        let tilt = random.between(0.0, 3.0);
        let across = match k % 4 {
            0 => 0.0,
            1 => random.between(-1e-4, 1e-4),
            2 => random.between(-0.1, 0.1),
            _ => random.between(-1.4, 1.4),
        };
        let direction = tilt + core::f64::consts::FRAC_PI_2 + across;
        let bar = Bar::pulled(&mut random, direction);
        let holds = |t: f64| {
            let shares = [0.5 - bar.off, 0.5 + bar.off].map(|share| share * across.cos() * t);
            let [a, b] = [0, 1].map(|i| (bar.mu * bar.press[i]).powi(2) - shares[i].powi(2));
            a >= 0.0 && b >= 0.0 && a.sqrt() + b.sqrt() >= (across.sin() * t).abs()
        };
        let held = root(|t| if holds(t) { 1.0 } else { -1.0 }, 0.0, 100.0);
        for (method, tolerance) in [
            ("taylor", 1e-6),
            ("taylor", 1e-11),
            ("dop853", 1e-9),
            ("radau5", 1e-8),
        ] {
            let start = state(&[0.0, 0.0, tilt], &[0.0; 3]);
            let motion = run_by(&bar, (method, tolerance), start, held + 0.01);
            agree(
                format!("{method}, bar {k}"),
                first_slip(&motion),
                held,
                1e-8,
            );
        }
    }
}

const METHODS: [(&str, f64); 6] = [
    ("taylor", 1e-6),
    ("taylor", 1e-12),
    ("dop853", 1e-9),
    ("radau5", 1e-7),
    ("verner98", 1e-12),
    ("dopri5", 1e-8),
];

/// With one coefficient of friction a slip begins as the square of the time, and here it can only go about the other pad: ⅓ l² φ̈ is the moment
/// of the pull about it, less that of the friction.
#[test]
fn a_bar_begins_to_turn_smoothly_about_the_pad_that_holds() {
    let mut random = Random::new(3);
    for k in 0..12 {
        let tilt = random.between(0.0, 3.0);
        let side = if k % 2 == 0 { 1.0 } else { -1.0 };
        let away = random.between(0.1, 0.4);
        let direction = tilt + side * core::f64::consts::FRAC_PI_2;
        let slips = random.between(3.0, 6.0);
        let bar = Bar {
            length: 1.0,
            off: -away,
            press: [slips, 9.0],
            mu: 0.5,
            drags: 1.0,
            strength: [direction.cos(), direction.sin()],
        };
        let begin = bar.mu * slips / (0.5 + away);
        let until = begin + 0.2;
        // The angle from the start; pull and friction act across the bar as it was.
        let rates = |t: f64, [phi, rate]: [f64; 2]| {
            let moment = t * (0.5 + away) * phi.cos() - bar.mu * slips;
            [rate, -side * 3.0 * moment]
        };
        let mut turn = [0.0; 2];
        let steps = 2000;
        let h = 0.2 / f64::from(steps);
        for i in 0..steps {
            turn = runge_kutta(rates, (begin + h * f64::from(i), turn), h);
        }
        for (method, tolerance) in METHODS {
            let start = state(&[0.0, 0.0, tilt], &[0.0; 3]);
            let motion = run_by(&bar, (method, tolerance), start, until);
            let what = format!("{method}, bar {k}");
            assert_eq!(words(&motion), ["first slips"], "{what}");
            let within = (10.0 * tolerance).max(1e-10);
            agree(&what, motion.final_state().q[2], tilt + turn[0], within);
            agree(&what, motion.final_state().v[2], turn[1], within);
        }
    }
}

/// Pulled at its middle across itself, a bar that presses both pads equally slips on both at once: ẍ = t − 2 μ N, without a turn.
#[test]
fn a_bar_begins_to_slip_smoothly_on_both_pads() {
    let mut random = Random::new(4);
    for k in 0..6 {
        let tilt = random.between(0.0, 3.0);
        let direction = tilt + core::f64::consts::FRAC_PI_2;
        let press = random.between(3.0, 6.0);
        let bar = Bar {
            length: 1.0,
            off: 0.0,
            press: [press; 2],
            mu: 0.5,
            drags: 1.0,
            strength: [direction.cos(), direction.sin()],
        };
        for (method, tolerance) in METHODS {
            let start = state(&[0.0, 0.0, tilt], &[0.0; 3]);
            let motion = run_by(&bar, (method, tolerance), start, press + 0.5);
            let what = format!("{method}, bar {k}");
            assert_eq!(words(&motion), ["first slips", "second slips"], "{what}");
            let within = (10.0 * tolerance).max(1e-10);
            let end = motion.final_state();
            let speed = end.v[0] * bar.strength[0] + end.v[1] * bar.strength[1];
            agree(&what, speed, 0.125, within);
            agree(&what, end.q[2], tilt, within);
        }
    }
}

/// A plate on five pads, pulled ever harder at its hook.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, phi),
    define(
        e = [cos(phi), sin(phi)],
        g = [-sin(phi), cos(phi)],
        hook = [x, y] + arm[0] * e + arm[1] * g,
        a = [x, y] + px[0] * e + py[0] * g,
        b = [x, y] + px[1] * e + py[1] * g,
        c = [x, y] + px[2] * e + py[2] * g,
        d = [x, y] + px[3] * e + py[3] * g,
        f = [x, y] + px[4] * e + py[4] * g,
    ),
    kinetic = (der(x)^2 + der(y)^2) / 2 + der(phi)^2 / 4,
    friction(first: slip = (der(a[0]), der(a[1])), normal = press[0], static = mu, kinetic = 0.8 * mu),
    friction(second: slip = (der(b[0]), der(b[1])), normal = press[1], static = mu, kinetic = 0.8 * mu),
    friction(third: slip = (der(c[0]), der(c[1])), normal = press[2], static = mu, kinetic = 0.8 * mu),
    friction(fourth: slip = (der(d[0]), der(d[1])), normal = press[3], static = mu, kinetic = 0.8 * mu),
    friction(fifth: slip = (der(f[0]), der(f[1])), normal = press[4], static = mu, kinetic = 0.8 * mu),
    force(pull: (strength[0] * t, strength[1] * t) at hook),
)]
struct Plate {
    px: [f64; 5],
    py: [f64; 5],
    press: [f64; 5],
    mu: f64,
    arm: [f64; 2],
    strength: [f64; 2],
}

impl Plate {
    /// The least load at which some motion gets from it what friction takes: the smallest Σ μ N |v| of all rigid motions with the power 1
    /// (limit analysis, the kinematic theorem; Goyal, Ruina & Papadopoulos 1991, Wear 143, 307).
    fn limit(&self) -> f64 {
        let [px, py] = self.strength;
        let moment = self.arm[0] * py - self.arm[1] * px;
        let cost = |across: f64, turn: f64| {
            let along = 1.0 - turn * moment;
            let v = [along * px - across * py, along * py + across * px];
            (0..5)
                .map(|i| {
                    let [x, y] = [v[0] - turn * self.py[i], v[1] + turn * self.px[i]];
                    self.mu * self.press[i] * x.hypot(y)
                })
                .sum::<f64>()
        };
        // Convex in each: one search within the other.
        let least = |f: &dyn Fn(f64) -> f64| {
            let (mut low, mut high) = (-30.0, 30.0);
            for _ in 0..80 {
                let third = (high - low) / 3.0;
                if f(low + third) < f(high - third) {
                    high -= third;
                } else {
                    low += third;
                }
            }
            f(0.5 * (low + high))
        };
        least(&|turn| least(&|across| cost(across, turn)))
    }
}

#[test]
fn a_plate_slips_when_all_cones_cannot_hold_it() {
    let mut random = Random::new(5);
    for k in 0..12 {
        let mut five =
            |low, high| -> [f64; 5] { core::array::from_fn(|_| random.between(low, high)) };
        let (px, py) = (five(-1.0, 1.0), five(-1.0, 1.0));
        let press = if k % 2 == 0 { [4.0; 5] } else { five(1.0, 9.0) };
        let direction = random.between(0.0, 6.0);
        let plate = Plate {
            px,
            py,
            press,
            mu: 0.5,
            arm: [random.between(-0.7, 0.7), random.between(-0.7, 0.7)],
            strength: [direction.cos(), direction.sin()],
        };
        let limit = plate.limit();
        for (method, tolerance) in [("taylor", 1e-9), ("dop853", 1e-9), ("radau5", 1e-8)] {
            let start = state(&[0.0; 3], &[0.0; 3]);
            let motion = run_by(&plate, (method, tolerance), start, limit + 0.01);
            agree(
                format!("{method}, plate {k}"),
                first_slip(&motion),
                limit,
                1e-7,
            );
        }
    }
}
