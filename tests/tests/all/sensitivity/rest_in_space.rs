//! Derivatives of the friction just before a slip in space comes to rest: its direction is that of the slip, which has none there.

use super::{Slopes, run, same_slopes, seeded};
use lagrange_core::prelude::*;

/// A puck that a table brakes.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2*(der(x)^2 + der(y)^2),
    friction(rub: slip = (der(x), der(y)), normal = weight, static = mu),
    start(pushed: der(x) = speed*cos(angle), der(y) = speed*sin(angle)),
)]
struct Puck<T = f64> {
    mass: T,
    weight: T,
    mu: T,
    speed: T,
    angle: T,
}

/// It goes straight on, so that the friction is −μ N (cos α, sin α) up to the end.
#[test]
fn friction_turns_with_the_start_up_to_the_instant_of_rest() {
    let p: [Slopes; 5] = seeded([1.4, 11.0, 0.3, 2.1, -0.8]);
    let [mass, weight, mu, speed, angle] = p;
    let scene = Puck {
        mass,
        weight,
        mu,
        speed,
        angle,
    };
    for (tolerance, method) in [
        (1e-9, Method::Auto),
        (1e-12, Method::Taylor),
        (1e-9, Method::DormandPrince853),
        (1e-9, Method::Radau5),
    ] {
        let start = scene.at(<Puck>::PUSHED);
        let motion = run(&scene, start, 2.0, (tolerance, method));
        let [rests] = motion.events() else {
            panic!("{:?}", motion.events())
        };
        same_slopes("time", rests.time, speed * mass / (mu * weight), 1e-8);
        let mut sampler = motion.sampler();
        let before = sampler.before(rests).expect("a state");
        let (sin, cos) = Scalar::sin_cos(angle);
        for (k, part) in [cos, sin].into_iter().enumerate() {
            let expected = -mu * weight * part;
            let what = format!("{k} by {method}");
            same_slopes(&what, rests.forces[k], expected, 1e-8);
            same_slopes(&what, before.forces[k], expected, 1e-8);
            same_slopes(&what, before.acceleration[k], expected / mass, 1e-8);
        }
    }
}
