//! A crate that falls flat onto a rough floor and bounces: it stays flat, although its two edges are hit by impulses of their own.

use super::state;
use lagrange_core::integrate::Method;
use lagrange_core::prelude::*;
use lagrange_tests::{Random, agree};

/// The middle of the lower side is at (x, y − lower).
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, phi),
    define(
        left = [x - half * cos(phi) + lower * sin(phi), y - half * sin(phi) - lower * cos(phi)],
        right = [x + half * cos(phi) + lower * sin(phi), y + half * sin(phi) - lower * cos(phi)],
    ),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + inertia/2 * der(phi)^2,
    potential = mass * gravity * y,
    contact(rear: left[1] >= 0, restitution = e),
    contact(front: right[1] >= 0, restitution = e),
    friction(rear_grip on rear: slip = der(left[0]), static = mu),
    friction(front_grip on front: slip = der(right[0]), static = mu),
)]
struct Crate {
    mass: f64,
    inertia: f64,
    half: f64,
    lower: f64,
    gravity: f64,
    e: f64,
    mu: f64,
}

#[test]
fn what_falls_flat_stays_flat() {
    let mut random = Random::new(61);
    for _ in 0..12 {
        let scene = Crate {
            mass: random.between(0.4, 3.0),
            inertia: random.between(0.02, 0.2),
            half: random.between(0.3, 0.8),
            lower: random.between(0.01, 0.05),
            gravity: random.between(3.0, 12.0),
            e: random.between(0.3, 0.7),
            mu: random.between(0.05, 0.3),
        };
        let (height, speed) = (random.between(0.3, 1.5), random.between(2.0, 6.0));
        let start = state(&[0.0, scene.lower + height, 0.0], &[speed, 0.0, 0.0]);
        let fall = (2.0 * height / scene.gravity).sqrt();
        for method in [Method::Taylor, Method::DormandPrince853, Method::Verner98] {
            bounces(&scene, &start, fall, method);
        }
    }
}

/// Five bounces: each takes the time 2 eᵏ t of its flight, and μ (1 + e) eᵏ g t of the speed.
#[track_caller]
fn bounces(scene: &Crate, start: &State<f64>, fall: f64, method: Method) {
    const BOUNCES: usize = 5;
    let flights: f64 = (1..BOUNCES).map(|k| 2.0 * scene.e.powi(k as i32)).sum();
    let end = (1.0 + flights + scene.e.powi(BOUNCES as i32)) * fall;
    let simulation = Simulation::new(scene).method(method);
    let trajectory = simulation.run(start.clone(), 0.0..end).unwrap();
    let events = trajectory.events();
    assert_eq!(events.len(), 2 * BOUNCES, "{method:?} {scene:?}");
    let (mut time, mut speed) = (fall, start.v[0]);
    for (k, pair) in events.chunks_exact(2).enumerate() {
        let share = scene.e.powi(k as i32);
        speed -= scene.mu * (1.0 + scene.e) * share * scene.gravity * fall;
        speed = speed.max(0.0);
        for event in pair {
            assert_eq!(event.kind, EventKind::Impact);
            agree("time", event.time, time, 1e-11);
            agree("speed", event.state_after.v[0], speed, 1e-9);
            assert_eq!(event.state_after.v[2], 0.0);
        }
        time += 2.0 * scene.e * share * fall;
    }
    agree("x speed", trajectory.final_state().v[0], speed, 1e-9);
    assert_eq!(trajectory.final_state().q[2], 0.0);
}

/// A box that lands on its four feet and slides on.
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
    contact(foot[k in 0..4]: place[k][2] >= 0, restitution = bounce),
    friction(grip[k in 0..4] on foot[k]: slip = (der(place[k][0]), der(place[k][1])), static = mu),
)]
struct LandingBox {
    mass: f64,
    inertia: f64,
    gravity: f64,
    a: [f64; 4],
    b: [f64; 4],
    height: f64,
    bounce: f64,
    mu: f64,
}

impl LandingBox {
    fn new(bounce: f64, mu: f64) -> Self {
        LandingBox {
            mass: 2.0,
            inertia: 0.1,
            gravity: 9.81,
            a: [0.5, 0.5, -0.5, -0.5],
            b: [0.3, -0.3, 0.3, -0.3],
            height: 0.2,
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

/// All feet leave with −e times their speed, so that it does not tilt: the impulses balance the moment of friction, linear in the places of the
/// feet as those of equal springs.
#[test]
fn feet_share_the_impulse_of_a_box_that_lands_on_them() {
    for (bounce, mu, speed) in [
        (0.5, 0.3, [3.0, 0.0]),
        (0.2, 0.4, [-2.0, 1.5]),
        (0.0, 0.2, [0.6, 1.1]),
    ] {
        let scene = LandingBox::new(bounce, mu);
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
            agree("impulse", event.impulse(LandingBox::FOOT[k]), share, 1e-10);
        }
        let slowed = size - mu * (1.0 + bounce) * falls;
        agree("x", event.v_after(LandingBox::X), slowed * along[0], 1e-11);
        agree("y", event.v_after(LandingBox::Y), slowed * along[1], 1e-11);
        agree("z", event.v_after(LandingBox::Z), bounce * falls, 1e-11);
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
        let scene = LandingBox::new(bounce, mu);
        for method in [Method::Taylor, Method::DormandPrince853] {
            let run = Simulation::new(&scene)
                .method(method)
                .run(scene.start(0.01, [1.0, -0.4], spin), 0.0..3.0);
            let run = run.expect("a run");
            let end = run.final_state();
            assert!(end.v.iter().all(|v| v.abs() < 1e-9), "{:?}", end.v);
            agree("height", end.q(LandingBox::Z), scene.height, 1e-8);
            let certificate = run.verify(0).expect("recorded");
            assert!(certificate.holds(), "{certificate}");
        }
    }
}
