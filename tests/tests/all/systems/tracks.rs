//! Pieces of a track, and belts, that adjoin: one surface begins where another one ends, whichever words say where that is.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, Random, TOLERANCES, agree, certified, methods_at, run_by, words};

/// A bead slides down an arc onto a level strip and up another arc; the strip is where a product is positive, and the arcs where sums and products are.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2)/2,
    potential = gravity*y,
    contact(left: sqrt(x^2 + (y - radius)^2) <= radius, where -x*(length + 2 + x) >= 0),
    contact(strip: y >= 0, where x*(length - x) >= 0),
    contact(right: (x - length)^2 + (y - radius)^2 <= radius^2 at (x, y), where x - length + y*(x - length) >= 0),
)]
struct HalfPipe {
    gravity: f64,
    radius: f64,
    length: f64,
}

/// Without friction it comes as high on the other side, and passes the strip at √(2 g h).
#[test]
fn a_half_pipe_of_three_pieces_is_passed_to_and_fro() {
    for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
        let mut random = Random::new(7);
        for _ in 0..6 {
            let scene = HalfPipe {
                gravity: 9.81,
                radius: random.between(0.6, 1.4),
                length: random.between(0.5, 2.0),
            };
            let (sin, cos) = random.between(0.3, 1.2).sin_cos();
            let height = scene.radius * (1.0 - cos);
            let start = state(&[-scene.radius * sin, height], &[0.0; 2]);
            let run = run_by(&scene, (method, tolerance), start, 4.0);
            let asked = format!("{method} {tolerance:e} {scene:?}: {:?}", words(&run));
            let speed = (2.0 * scene.gravity * height).sqrt();
            let at = |k: usize| run.events()[k].time;
            // It comes onto the strip and leaves it at the same instants at which it leaves one arc and comes onto the other.
            assert_eq!(
                words(&run)[..4],
                ["left lost", "strip closed", "strip lost", "right closed"],
                "{asked}"
            );
            agree(&asked, at(2) - at(1), scene.length / speed, 1e3 * tolerance);
            assert_eq!(at(0), at(1), "{asked}");
            assert_eq!(at(2), at(3), "{asked}");
            assert!(run.events().iter().all(|event| !event.ambiguous), "{asked}");
            let energy = run.final_state();
            let [q, v] = [&energy.q, &energy.v];
            let total = (v[0] * v[0] + v[1] * v[1]) / 2.0 + scene.gravity * q[1];
            agree(&asked, total, scene.gravity * height, 1e3 * tolerance);
            certified(asked, &run);
        }
    }
}

/// A block on two belts that adjoin at the origin and run towards each other.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2)/2,
    potential = gravity*y,
    contact(west: y >= 0, where x <= 0),
    contact(east: y >= 0, where x >= 0),
    friction(eastward on west: slip = der(x) - belt, static = rough),
    friction(westward on east: slip = der(x) + belt, static = smooth),
)]
struct TwoBelts {
    gravity: f64,
    belt: f64,
    rough: f64,
    smooth: f64,
}

/// It is sent back over the border at its speed. No instant leaves a choice, and none has the load on both belts.
#[test]
fn a_block_that_crosses_from_belt_to_belt_has_one_motion() {
    for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
        let mut random = Random::new(11);
        for _ in 0..6 {
            let scene = TwoBelts {
                gravity: 9.81,
                belt: 4.0,
                rough: random.between(0.4, 0.7),
                smooth: random.between(0.1, 0.3),
            };
            let speed = random.between(0.05, 0.9);
            let run = run_by(
                &scene,
                (method, tolerance),
                state(&[0.01, 0.0], &[-speed, 0.0]),
                0.5,
            );
            let asked = format!(
                "{method} {tolerance:e} {scene:?} {speed}: {:?}",
                words(&run)
            );
            for event in run.events() {
                assert!(!event.ambiguous, "{asked}");
            }
            // v² = u² + 2 a s to the border, and by as much each way after it: the time on the other belt is 2 v/a.
            let over = (speed * speed + 2.0 * scene.smooth * scene.gravity * 0.01).sqrt();
            let crossed = run
                .events()
                .iter()
                .filter(|event| event.subject.name(run.description()) == "west");
            let times: Vec<f64> = crossed.map(|event| event.time).collect();
            if let [first, second, ..] = times[..] {
                let there = 2.0 * over / (scene.rough * scene.gravity);
                agree(&asked, second - first, there, 1e3 * tolerance);
            }
            certified(asked, &run);
        }
    }
}
