//! What is driven by a law in pieces comes to rest with a piece, smoothly: its slip vanishes there and does not pass zero.

use lagrange_core::prelude::*;
use lagrange_tests::{Random, agree, certified, event, first_start, methods_at, run_by, times};

const METHODS: [&str; 5] = ["auto", "dop853", "verner98", "dopri5", "radau5"];

/// A follower under its weight on a cam that comes down to its dwell as (1 − t/T)ⁿ. A guide rubs on it, and a pull that grows takes it off.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(y),
    kinetic = mass/2 * der(y)^2,
    potential = 10 * mass * y,
    contact(cam: y >= if(t <= end, rise * (1 - t/end)^3 * (1 + skew * (1 - t/end)), 0)),
    friction(guide: slip = der(y), limit = (holds, rubs)),
    force(pull: y = rate * max(0, t - end - rest)),
    start(up: y = rise * (1 + skew), der(y) = -rise/end * (3 + 4 * skew)),
)]
struct Follower {
    mass: f64,
    rise: f64,
    end: f64,
    skew: f64,
    holds: f64,
    rubs: f64,
    rate: f64,
    rest: f64,
}

impl Follower {
    fn random(seed: u64) -> Self {
        let mut random = Random::new(seed);
        let rubs = random.between(0.1, 2.0);
        Self {
            mass: random.between(0.5, 3.0),
            rise: random.between(0.05, 0.4),
            end: random.between(0.8, 1.5),
            skew: random.between(0.0, 0.5),
            holds: rubs * random.between(1.0, 2.0),
            rubs,
            rate: random.between(20.0, 60.0),
            rest: random.between(0.1, 0.5),
        }
    }

    /// When the pull is the weight and all that the guide holds.
    fn taken_off(&self) -> f64 {
        self.end + self.rest + (10.0 * self.mass + self.holds) / self.rate
    }
}

#[test]
fn a_follower_sticks_where_its_cam_ends_and_is_held_by_what_holds_at_rest() {
    for seed in 0..8 {
        let follower = Follower::random(seed);
        let taken_off = follower.taken_off();
        for method in methods_at(METHODS, [1e-6, 1e-9, 1e-12]) {
            let what = format!("{seed} {method:?}");
            let until = taken_off + 0.1;
            let trajectory = run_by(&follower, method, first_start(&follower), until);
            let sticks = times(&trajectory, "guide", "sticks");
            agree(&what, sticks[0], follower.end, 1e-12);
            assert_eq!(sticks.len(), 1, "{what}");
            let reverses = times(&trajectory, "guide", "reverses");
            assert!(reverses.is_empty(), "{what}: {reverses:?}");
            let lost = event(&trajectory, "cam", "lost");
            agree(&what, lost.time, taken_off, 1e-9);
            certified(&what, &trajectory);
        }
    }
}

/// A slide on a table that an axis moves by the polynomial of degree five with which it begins and ends without acceleration, and back again.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, z),
    define(
        there = t / there_in,
        back = (t - there_in - rest) / there_in,
        law = if(t <= there_in, 10 * there^3 - 15 * there^4 + 6 * there^5,
            if(t <= there_in + rest, 1, 1 - 10 * back^3 + 15 * back^4 - 6 * back^5)),
    ),
    kinetic = mass/2 * (der(x)^2 + der(z)^2),
    potential = 9.81 * mass * z,
    contact(table: z >= 0),
    constraint(axis: x == stroke * law),
    friction(rub on table: slip = der(x), static = 1.5 * mu, kinetic = mu),
    start(still: x = 0),
)]
struct Slide {
    mass: f64,
    there_in: f64,
    rest: f64,
    stroke: f64,
    mu: f64,
}

#[test]
fn a_driven_slide_rests_between_its_strokes() {
    for seed in 0..6 {
        let mut random = Random::new(seed);
        let slide = Slide {
            mass: random.between(0.5, 3.0),
            there_in: random.between(0.3, 0.8),
            rest: random.between(0.1, 0.5),
            stroke: random.between(0.1, 0.5),
            mu: random.between(0.05, 0.4),
        };
        let back = slide.there_in + slide.rest;
        for method in methods_at(METHODS, [1e-9, 1e-12]) {
            let what = format!("{seed} {method:?}");
            let until = back + 0.5 * slide.there_in;
            let trajectory = run_by(&slide, method, first_start(&slide), until);
            let sticks = times(&trajectory, "rub", "sticks");
            let reverses = times(&trajectory, "rub", "reverses");
            assert!(reverses.is_empty(), "{what}: {reverses:?}");
            let slips = times(&trajectory, "rub", "slips");
            agree(&what, sticks[0], slide.there_in, 1e-12);
            agree(&what, *slips.last().expect("it moves back"), back, 1e-12);
            // At rest nothing asks for a force along the table.
            let middle = slide.there_in + 0.5 * slide.rest;
            let sample = trajectory.sampler().at(middle).expect("inside");
            agree(&what, sample.force(Slide::AXIS), 0.0, 1e-9);
            agree(&what, sample.force(Slide::RUB), 0.0, 1e-9);
            certified(&what, &trajectory);
        }
    }
}
