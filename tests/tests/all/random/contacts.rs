//! Chains over a floor, rods on it, balls between walls, blocks on blocks.

use super::{Tally, Trial};
use lagrange_tests::Random;
use lagrange_tests::families::Family;
use lagrange_tests::families::contacts::{Balls, Blocks, Chain, Rod};

#[test]
fn chains_over_a_floor() {
    let mut random = Random::new(101);
    let mut tally = Tally::default();
    for _ in 0..40 {
        let (chain, start) = Chain::draw(&mut random);
        tally.run(&chain, &start, Trial::until(2.0).rough(chain.mu));
    }
    tally.check();
}

#[test]
fn rods_on_a_floor() {
    let mut random = Random::new(102);
    let mut tally = Tally::default();
    for _ in 0..100 {
        let rod = Rod::random(&mut random);
        let start = Rod::thrown(&mut random);
        tally.run(&rod, &start, Trial::until(3.0).rough(rod.mu));
    }
    tally.check();
}

#[test]
fn balls_between_walls() {
    let mut random = Random::new(103);
    let mut tally = Tally::default();
    for k in 0..40 {
        let balls = Balls::random(&mut random, |random| match k {
            0 | 1 => 1.0,
            _ => random.between(0.1, 1.0),
        });
        let start = Balls::apart(&mut random);
        let until = if k < 2 { 1e4 } else { 5.0 };
        tally.run(&balls, &start, Trial::until(until));
    }
    tally.check();
    assert_eq!(tally.longest, 10_000);
}

#[test]
fn blocks_on_blocks() {
    let mut random = Random::new(104);
    let mut tally = Tally::default();
    for k in 0..40 {
        let blocks = Blocks::random(&mut random);
        let start = Blocks::sliding(&mut random);
        let until = if k < 2 { 200.0 } else { 10.0 };
        tally.run(&blocks, &start, Trial::until(until).rough(blocks.mu));
    }
    tally.check();
}
