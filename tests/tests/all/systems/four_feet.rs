//! A box on four feet, which depend on one another: what they share, at rest and when they land.

use lagrange_core::integrate::Method;
use lagrange_core::prelude::*;
use lagrange_tests::{agree, all_agree};

/// A box on four feet, turned about the vertical, that may be pushed along its length at the height of its mass centre.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, z),
    attitude(body: q),
    define(
        place[k in 0..4] = [x, y, z] + a[k] * body.axes[0] + b[k] * body.axes[1] - height * body.axes[2],
    ),
    kinetic = mass/2 * (der(x)^2 + der(y)^2 + der(z)^2)
        + inertia/2 * (body.body_rate[0]^2 + body.body_rate[1]^2 + body.body_rate[2]^2),
    potential = mass * gravity * z,
    force(push: (strength * cos(yaw), strength * sin(yaw), 0) at (x, y, z)),
    contact(foot[k in 0..4]: place[k][2] >= 0, restitution = bounce),
    friction(grip[k in 0..4] on foot[k]: slip = (der(place[k][0]), der(place[k][1])), static = mu),
    start(stands: z = height, q[0] = cos(yaw/2), q[3] = sin(yaw/2)),
)]
struct FourFeet {
    mass: f64,
    inertia: f64,
    gravity: f64,
    a: [f64; 4],
    b: [f64; 4],
    height: f64,
    yaw: f64,
    strength: f64,
    bounce: f64,
    mu: f64,
}

impl FourFeet {
    fn new(bounce: f64, mu: f64) -> Self {
        FourFeet {
            mass: 2.0,
            inertia: 0.1,
            gravity: 9.81,
            a: [0.5, 0.5, -0.5, -0.5],
            b: [0.3, -0.3, 0.3, -0.3],
            height: 0.2,
            yaw: 0.0,
            strength: 0.0,
            bounce,
            mu,
        }
    }

    /// Above the floor by so much, moved and turned so fast.
    fn start(&self, above: f64, speed: [f64; 2], spin: f64) -> State {
        State::new(
            vec![0.0, 0.0, self.height + above, 1.0, 0.0, 0.0, 0.0],
            vec![speed[0], speed[1], 0.0, 0.0, 0.0, 0.0, 0.5 * spin],
        )
    }
}

/// Least are loads that are linear in the places of the feet, and equal frictions: the multiplier of a unit quaternion does not count, or
/// feet of a box that nothing pushes would spread it.
#[test]
fn feet_of_a_box_at_rest_do_not_spread_it() {
    for (yaw, strength) in [(0.0, 0.0), (0.7, 0.0), (0.7, 20.0), (-2.4, 11.0)] {
        let scene = FourFeet {
            mass: 10.0,
            inertia: 0.5,
            height: 0.3,
            yaw,
            strength,
            ..FourFeet::new(0.0, 0.5)
        };
        let run = Simulation::new(&scene).run(scene.at(FourFeet::STANDS), 0.0..1.0);
        let run = run.expect("a run");
        assert!(run.events().is_empty());
        let now = run.sampler().at(0.5).expect("recorded");
        let lever = strength * scene.height / (4.0 * 0.5);
        for (k, a) in scene.a.into_iter().enumerate() {
            let load = scene.mass * scene.gravity / 4.0 + lever * a.signum();
            agree("load", now.force(FourFeet::FOOT[k]), load, 1e-11);
            let share = [yaw.cos(), yaw.sin()].map(|part| -strength / 4.0 * part);
            all_agree("grip", now.friction(FourFeet::GRIP[k]), &share, 1e-10);
        }
        assert!(run.verify(0).expect("a certificate").holds());
    }
}

/// All feet leave with −e times their speed, so that it does not tilt: the impulses balance the moment of friction, linear in the places of the
/// feet as those of equal springs.
#[test]
fn feet_share_the_impulse_of_a_box_that_lands_on_them() {
    for (bounce, mu, speed) in [
        (0.5, 0.3, [3.0, 0.0]),
        (0.2, 0.4, [-2.0, 1.5]),
        (0.0, 0.2, [0.6, 1.1]),
    ] {
        let scene = FourFeet::new(bounce, mu);
        let run = Simulation::new(&scene).run(scene.start(0.05, speed, 0.0), 0.0..0.11);
        let run = run.expect("a run");
        let event = &run.events()[0];
        assert_eq!(event.kind, EventKind::Impact);
        let falls = (2.0_f64 * 9.81 * 0.05).sqrt();
        agree("time", event.time, falls / 9.81, 1e-12);
        let size = f64::hypot(speed[0], speed[1]);
        let along = speed.map(|v| v / size);
        let whole = scene.mass * (1.0 + bounce) * falls;
        for k in 0..4 {
            let [a, b] = [scene.a[k], scene.b[k]];
            let lever = along[0] * a / 0.25 + along[1] * b / 0.09;
            let share = 0.25 * whole * (1.0 + mu * scene.height * lever);
            agree("impulse", event.impulse(FourFeet::FOOT[k]), share, 1e-10);
        }
        let slowed = size - mu * (1.0 + bounce) * falls;
        agree("x", event.v_after(FourFeet::X), slowed * along[0], 1e-11);
        agree("y", event.v_after(FourFeet::Y), slowed * along[1], 1e-11);
        agree("z", event.v_after(FourFeet::Z), bounce * falls, 1e-11);
        assert!(run.verify(0).expect("recorded").holds());
    }
}

/// It lands again and again and comes to rest, whether it turns or not.
#[test]
fn a_box_that_turns_while_it_lands_comes_to_rest_on_its_feet() {
    for (bounce, mu, spin) in [
        (0.2, 0.3, 1.0),
        (0.5, 0.3, -2.0),
        (0.6, 0.5, 3.0),
        (0.3, 0.1, 0.5),
    ] {
        let scene = FourFeet::new(bounce, mu);
        for method in [Method::Taylor, Method::DormandPrince853] {
            let run = Simulation::new(&scene)
                .method(method)
                .run(scene.start(0.01, [1.0, -0.4], spin), 0.0..3.0);
            let run = run.expect("a run");
            let end = run.final_state();
            assert!(end.v.iter().all(|v| v.abs() < 1e-9), "{:?}", end.v);
            agree("height", end.q(FourFeet::Z), scene.height, 1e-8);
            let certificate = run.verify(0).expect("recorded");
            assert!(certificate.holds(), "{certificate}");
        }
    }
}
