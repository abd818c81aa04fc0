//! Supports and surfaces that move as time says.

use super::{Tally, Trial};
use lagrange_core::prelude::*;
use lagrange_tests::Random;
use lagrange_tests::families::Family;
use lagrange_tests::families::moving::{Feeder, Shaken};

#[test]
fn shaken_pendulums() {
    let mut random = Random::new(301);
    let mut tally = Tally::default();
    for _ in 0..40 {
        let (shaken, start) = Shaken::draw(&mut random);
        tally.run(&shaken, &start, Trial::until(4.0).rough(shaken.mu));
    }
    tally.check();
}

#[test]
fn feeders() {
    let mut random = Random::new(302);
    let mut tally = Tally::default();
    for k in 0..40 {
        let feeder = Feeder {
            mass: random.between(0.2, 2.0),
            reach: random.between(0.0, 0.02),
            lift: random.between(0.0, 0.02),
            rate: random.between(5.0, 40.0),
            bounce: random.between(0.0, 0.8),
            mu: random.between(0.05, 0.5),
        };
        let q = vec![0.0, random.between(0.0, 0.3)];
        let v = vec![random.between(-1.0, 1.0), random.between(-1.0, 1.0)];
        let until = if k < 2 { 300.0 } else { 5.0 };
        let trial = Trial::until(until).rough(1.5 * feeder.mu);
        tally.run(&feeder, &State::new(q, v), trial);
    }
    tally.check();
    assert_eq!(tally.longest, 10_000);
}
