//! What happens shortly before a body that bounces comes to rest, and impacts that rounding no longer tells apart.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, Random, TOLERANCES, agree, certified, event, methods_at, run_by};

/// A ball that is dropped, and a block beside it that is pushed from some instant on.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    potential = gravity * y,
    contact(floor: y >= 0, restitution = bounce),
    force(drive: x = if(t >= from, push, 0)),
    mark(pushed: t >= from),
    mark(top: abs(der(y)) >= 1e-6),
)]
struct Pair {
    gravity: f64,
    bounce: f64,
    push: f64,
    from: f64,
}

/// The block moves by a (T − t₁)²/2, also if it is pushed from a moment on at which what is left of the bounces is below the tolerance.
#[test]
fn what_comes_before_the_last_bounce_is_not_put_off() {
    let mut random = Random::new(573);
    for k in 0..28 {
        let [gravity, bounce, height] =
            [(3.0, 12.0), (0.3, 0.85), (0.3, 2.0)].map(|(low, high)| random.between(low, high));
        let rests = (2.0 * height / gravity).sqrt() * (1.0 + bounce) / (1.0 - bounce);
        let earlier = 10.0_f64.powf(-3.0 - (k % 7) as f64);
        let from = rests - earlier;
        let scene = Pair {
            gravity,
            bounce,
            push: 8.0,
            from,
        };
        for pair in methods_at(METHODS, TOLERANCES) {
            let what = format!("{scene:?} from {height} by {pair:?}");
            let run = run_by(&scene, pair, state(&[0.0, height], &[0.0; 2]), rests + 1.0);
            certified(&what, &run);
            let accuracy = 20.0 * pair.1;
            agree(&what, event(&run, "pushed", "mark").time, from, accuracy);
            agree(&what, event(&run, "floor", "closed").time, rests, 1e-7);
            let moved = 4.0 * (1.0 + earlier) * (1.0 + earlier);
            agree(&what, run.final_state().q[0], moved, accuracy);
        }
    }
}

/// Balls one upon the other. The floor gives back what it takes; they lose to each other what they fall with.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(low, middle, high),
    kinetic = (first * der(low)^2 + second * der(middle)^2 + der(high)^2) / 2,
    potential = 10 * (first * low + second * middle + high),
    contact(floor: low >= 0, restitution = 1),
    contact(lower: middle - low >= 0.3, restitution = bounce),
    contact(upper: high - middle >= 0.3, restitution = bounce),
)]
struct Column {
    first: f64,
    second: f64,
    bounce: f64,
}

/// A column comes to rest, or hops as one body: its energy is what it was, or less.
#[test]
fn a_column_on_an_elastic_floor_comes_to_rest() {
    let mut random = Random::new(574);
    for _ in 0..40 {
        let [first, second] = [0; 2].map(|_| random.between(0.2, 3.0));
        let scene = Column {
            first,
            second,
            bounce: random.between(0.1, 0.7),
        };
        let heights = [0.4, 0.9, 1.5].map(|height| height + random.between(0.0, 0.1));
        let simulation = Simulation::new(&scene).max_events(30_000);
        let run = simulation.run(state(&heights, &[0.0; 3]), 0.0..12.0);
        let run = run.unwrap_or_else(|error| panic!("{scene:?} from {heights:?}: {error}"));
        certified(format!("{scene:?} from {heights:?}"), &run);
        let [floor, lower, upper] = [0, 1, 2].map(|c| run.final_mode().contacts[c]);
        assert!(lower && upper, "{scene:?} from {heights:?}");
        assert!(
            floor || run.final_state().v[0].abs() < 0.5,
            "{scene:?} from {heights:?}"
        );
    }
}

/// A light plank that is pulled up, and falls onto a stop that gives nothing back; a block slides and bounces on it.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(plank, x, block),
    kinetic = (light * der(plank)^2 + heavy * (der(x)^2 + der(block)^2)) / 2,
    potential = heavy * 10 * block,
    force(up: plank = pull),
    contact(pair: block - plank >= 0, restitution = bounce),
    contact(stop: plank >= place, restitution = 0),
    friction(rub on pair: slip = der(x), static = mu),
)]
struct Plank {
    light: f64,
    heavy: f64,
    pull: f64,
    bounce: f64,
    place: f64,
    mu: f64,
}

/// Intervals between the impacts are squared from one to the next. All that presses the block comes from the plank: ẋ = u − μ (v + g t) once it lies.
#[test]
fn impacts_that_shrink_to_nothing_at_once_leave_no_rebound() {
    let mut random = Random::new(575);
    for k in 0..20 {
        let scene = Plank {
            light: random.between(0.1, 0.5),
            heavy: random.between(0.8, 3.0),
            pull: random.between(0.5, 8.0),
            bounce: random.between(0.1, 0.9),
            place: [0.0, 2.0][k % 2],
            mu: random.between(0.1, 0.5),
        };
        let height = scene.place + 0.01;
        for pair in methods_at(METHODS, [1e-9]) {
            let what = format!("{scene:?} by {pair:?}");
            let start = state(&[height, 0.0, height], &[-1.0, 4.0, -0.5]);
            let run = run_by(&scene, pair, start, 0.05);
            certified(&what, &run);
            assert_eq!(run.final_mode().contacts, [true, true], "{what}");
            let speed = 4.0 - scene.mu * (0.5 + 10.0 * 0.05);
            agree(&what, run.final_state().v[1], speed, 1e-8);
        }
    }
}
