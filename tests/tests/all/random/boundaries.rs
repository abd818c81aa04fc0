//! Starts exactly on a boundary, tolerances from loose to tight, every method.

use super::{Tally, Trial};
use lagrange_core::prelude::*;
use lagrange_tests::Random;
use lagrange_tests::families::contacts::{Balls, Block, Blocks, Rod};

#[test]
fn rods_that_start_on_the_floor() {
    let mut random = Random::new(401);
    let mut tally = Tally::default();
    for k in 0..60 {
        let rod = Rod::random(&mut random);
        // Lying on both ends, or standing on one, at rest, sliding, or with an end that just lifts off.
        let angle = if k % 2 == 0 {
            0.0
        } else {
            random.between(0.1, 1.5)
        };
        let q = vec![0.0, rod.half * angle.sin(), angle];
        let (slide, turn) = match k % 3 {
            0 => (0.0, 0.0),
            1 => (random.between(-1.0, 1.0), 0.0),
            _ => (0.0, random.between(-1.0, 1.0)),
        };
        // The left end stays on the floor; without sliding it also stays where it is.
        let (sine, cosine) = angle.sin_cos();
        let v = vec![
            slide - rod.half * sine * turn,
            rod.half * cosine * turn,
            turn,
        ];
        tally.run(&rod, &State::new(q, v), Trial::until(3.0).rough(rod.mu));
    }
    tally.check();
}

#[test]
fn blocks_whose_friction_just_suffices() {
    let mut random = Random::new(402);
    let mut tally = Tally::default();
    for k in 0..30 {
        let slope: f64 = random.between(0.1, 1.2);
        // Exactly the coefficient that holds it, or off by rounding.
        let mu = slope.tan() * (1.0 + f64::from(k % 3 - 1) * f64::EPSILON);
        let block = Block {
            mass: random.between(0.1, 10.0),
            slope,
            mu,
        };
        let v = vec![
            if k % 2 == 0 {
                0.0
            } else {
                random.between(-1.0, 1.0)
            },
            0.0,
        ];
        tally.run(
            &block,
            &State::new(vec![0.0; 2], v),
            Trial::until(3.0).rough(mu),
        );
    }
    tally.check();
}

#[test]
fn every_tolerance() {
    let mut random = Random::new(403);
    let mut tally = Tally::default();
    for k in 0..42 {
        let tolerance = 10_f64.powi(-6 - k % 7);
        let rod = Rod::random(&mut random);
        let start = Rod::thrown(&mut random);
        let trial = Trial {
            tolerance,
            ..Trial::until(3.0).rough(rod.mu)
        };
        tally.run(&rod, &start, trial);
    }
    tally.check();
}

#[test]
fn every_method() {
    let mut random = Random::new(404);
    let mut tally = Tally::default();
    let methods = [
        Method::DormandPrince54,
        Method::DormandPrince853,
        Method::Verner98,
        Method::Radau5,
    ];
    for k in 0..24 {
        let method = methods[k % 4];
        let trial = Trial {
            method,
            tolerance: 1e-8,
            ..Trial::until(2.0)
        };
        let rod = Rod::random(&mut random);
        let start = Rod::thrown(&mut random);
        tally.run(&rod, &start, trial.rough(rod.mu));
        let balls = Balls::random(&mut random, |random| random.between(0.1, 1.0));
        let start = Balls::apart(&mut random);
        tally.run(&balls, &start, trial);
        let blocks = Blocks::random(&mut random);
        let start = Blocks::sliding(&mut random);
        tally.run(&blocks, &start, trial.rough(blocks.mu));
    }
    tally.check();
}
