//! Loads that begin at zero, with either sign, on what holds by more forces than the load determines.

use lagrange_core::prelude::*;
use lagrange_tests::{Random, agree, certified, first_start, methods_at, run_by, words};

/// A block that is pulled, and another one that a link moves with it. The link rubs with its own force, and the second block under a given limit.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y),
    kinetic = first/2 * der(x)^2 + second/2 * der(y)^2,
    constraint(link: y == ratio * x),
    force(pull: x = rate * t),
    friction(rub on link: slip = der(x), static = mu),
    friction(slide: slip = der(y), limit = limit),
    start(still: x = 0),
)]
struct Pair {
    first: f64,
    second: f64,
    ratio: f64,
    rate: f64,
    mu: f64,
    limit: f64,
}

#[test]
fn blocks_on_a_link_hold_until_both_frictions_are_at_their_limits() {
    for seed in 0..24 {
        let mut random = Random::new(seed);
        let pair = Pair {
            first: random.between(0.5, 3.0),
            second: random.between(0.5, 3.0),
            ratio: random.sign() * random.between(0.5, 2.0),
            rate: random.sign() * random.between(1.0, 5.0),
            mu: random.between(0.05, 0.4),
            limit: random.between(0.5, 3.0),
        };
        // What the second block is held with goes through the link, which turns it into its ratio on the first one.
        let begins = pair.limit * (pair.ratio.abs() + pair.mu) / pair.rate.abs();
        for method in methods_at(
            ["auto", "dop853", "verner98", "radau5"],
            [1e-6, 1e-9, 1e-12],
        ) {
            let what = format!("{seed} {method:?} {pair:?}");
            let trajectory = run_by(&pair, method, first_start(&pair), 1.5 * begins);
            let events = trajectory.events();
            assert!(events[0].time > 0.0, "{what}: {:?}", words(&trajectory));
            agree(&what, events[0].time, begins, 1e-9);
            certified(&what, &trajectory);
        }
    }
}
