//! Derivatives of a mark on the way and of the limit of infinitely many impacts, on a platform that rises.

use super::{Slopes, run, same_slopes, seeded};
use lagrange_core::prelude::*;

/// A ball above a platform that rises uniformly.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(y),
    kinetic = der(y)^2 / 2,
    potential = gravity * y,
    contact(platform: y >= rise * t, restitution = bounce),
    start(drop: y = height),
    mark(passes: level - y),
)]
struct Platform<T = f64> {
    gravity: T,
    bounce: T,
    height: T,
    rise: T,
    level: T,
}

/// Seen from the platform the ball starts at −w: it arrives with s = √(w² + 2 g h) after (s − w)/g, and Σ 2 s eⁱ/g later lies.
#[test]
fn a_mark_and_an_accumulation_on_a_rising_platform() {
    let p: [Slopes; 5] = seeded([9.81, 0.8, 0.8, 0.3, 0.6]);
    let [gravity, bounce, height, rise, level] = p;
    let scene = Platform {
        gravity,
        bounce,
        height,
        rise,
        level,
    };
    // In flight all is exact at any tolerance; the larger it is, the more is left over for the sum of the last impacts.
    let settings = (1e-4, Method::Taylor);
    let motion = run(&scene, scene.at(<Platform>::DROP), 5.0, settings);
    let two: Slopes = Scalar::from_f64(2.0);
    let one: Slopes = Scalar::from_f64(1.0);
    let find = |word: &str| {
        let mut events = motion.events().iter();
        events.find(|e| e.kind.word() == word).expect(word)
    };
    let passes = (two * (height - level) / gravity).sqrt();
    let mark = find("mark");
    same_slopes("mark", mark.time, passes, 1e-10);
    same_slopes("height", mark.state.q[0], level, 1e-10);
    same_slopes("speed", mark.state.v[0], -gravity * passes, 1e-10);
    let arrival: Slopes = (rise * rise + two * gravity * height).sqrt();
    let limit = (arrival - rise) / gravity + two * arrival * bounce / (gravity * (one - bounce));
    let rest = find("accumulates");
    same_slopes("limit", rest.time, limit, 1e-7);
    same_slopes(
        "place",
        motion.final_state().q[0],
        rise * Scalar::from_f64(5.0),
        1e-10,
    );
}
