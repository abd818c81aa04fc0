//! A block in thick oil on dry ground: its slip is far below the tolerance, and what damps it is far faster than what moves it.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{Random, agree, certified, run_by};

/// Pulled ever harder; the oil is a damper beside the ground, or the ground is as rough as the slip is fast.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2) / 2,
    force(rope: x = pull * t),
    force(also: y = pull * t),
    dissipation(oil: thick / 2 * der(x)^2),
    friction(ground: slip = der(x), limit = (holds, slides)),
    friction(mud: slip = der(y), normal = 1, static = holds, kinetic = slides + thick * abs(slip)),
    start(go),
)]
struct Block {
    pull: f64,
    thick: f64,
    holds: f64,
    slides: f64,
}

/// Once it slides, c v = p t − μ − p/c but for what has long been damped away.
#[test]
fn thick_oil_is_followed_by_long_steps() {
    let mut random = Random::new(572);
    for k in 0..24 {
        let thick = 10.0_f64.powf(random.between(5.0, 12.0));
        let slides = random.between(0.1, 0.4);
        let scene = Block {
            pull: random.between(0.3, 2.0),
            thick,
            slides,
            holds: slides + [0.0, 0.1][k % 2],
        };
        for pair in [("auto", 1e-9), ("auto", 1e-12), ("radau5", 1e-9)] {
            let what = format!("{scene:?} by {pair:?}");
            let run = run_by(&scene, pair, state(&[0.0; 2], &[0.0; 2]), 4.0);
            certified(&what, &run);
            assert!(
                run.work().steps < 2000,
                "{what}: {} steps",
                run.work().steps
            );
            let speed = (4.0 * scene.pull - slides) / thick - scene.pull / (thick * thick);
            for v in run.final_state().v.iter() {
                agree(&what, *v, speed, 10.0 * pair.1);
            }
        }
    }
}
