//! Linkages with a loop, and a bead on a wire between walls.

use super::{Tally, Trial};
use lagrange_core::prelude::*;
use lagrange_tests::Random;
use lagrange_tests::families::linkages::{Bead, FourBar};

#[test]
fn four_bars() {
    let mut random = Random::new(201);
    let mut tally = Tally::default();
    for k in 0..40 {
        let length = [(); 3].map(|()| random.between(0.3, 1.5));
        // Any three angles are a start: the pivot is where they lead.
        let q: Vec<f64> = (0..3).map(|_| random.between(-3.0, 3.0)).collect();
        let end = |f: fn(f64) -> f64| length.iter().zip(&q).map(|(l, q)| l * f(*q)).sum::<f64>();
        let bars = FourBar {
            mass: [(); 3].map(|()| random.between(0.2, 2.0)),
            length,
            pivot: [end(f64::cos), end(f64::sin)],
            drag: if k % 2 == 0 {
                0.0
            } else {
                random.between(0.0, 0.1)
            },
            torque: if k % 3 == 0 {
                random.between(-3.0, 3.0)
            } else {
                0.0
            },
        };
        let v = (0..3).map(|_| random.between(-3.0, 3.0)).collect();
        tally.run(&bars, &State::new(q, v), Trial::until(5.0));
    }
    tally.check();
}

#[test]
fn beads_on_wires() {
    let mut random = Random::new(202);
    let mut tally = Tally::default();
    for k in 0..40 {
        let bead = Bead {
            mass: random.between(0.1, 3.0),
            bend: random.between(-1.0, 2.0),
            wave: random.between(-0.3, 0.3),
            number: random.between(1.0, 12.0),
            bounce: if k < 2 {
                1.0
            } else {
                random.between(0.0, 0.95)
            },
        };
        let x = random.between(-0.9, 0.9);
        let q = vec![x, bead.bend * x * x + bead.wave * (bead.number * x).sin()];
        let v = vec![random.between(-3.0, 3.0), 0.0];
        let until = if k < 2 { 1e4 } else { 10.0 };
        tally.run(&bead, &State::new(q, v), Trial::until(until));
    }
    tally.check();
    assert_eq!(tally.longest, 10_000);
}
