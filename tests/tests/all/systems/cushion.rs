//! A billiard ball that stays at the cushion which it has hit: it lies there without load, and turns about the vertical.

use lagrange_core::prelude::*;
use lagrange_tests::{Random, agree, certified, event, first_start, run_by, words};

#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, z),
    attitude(ball: q),
    define(p = [x, y, z], spin = ball.space_rate),
    define(foot = der(p) + cross(spin, [0, 0, -radius]), side = der(p) + cross(spin, [radius, 0, 0])),
    kinetic = mass/2 * dot(der(p), der(p)) + mass * radius^2/5 * dot(ball.body_rate, ball.body_rate),
    potential = mass * gravity * z,
    contact(table: z >= radius),
    contact(cushion: x <= way, restitution = 0),
    friction(cloth on table: slip = (foot[0], foot[1]), static = mu),
    friction(rail on cushion: slip = (side[1], side[2]), static = nu),
    start(shot: z = radius, der(x) = speed[0], der(y) = speed[1], ball.space_rate = (turn[0], turn[1], turn[2])),
)]
struct Ball {
    mass: f64,
    radius: f64,
    gravity: f64,
    mu: f64,
    nu: f64,
    way: f64,
    speed: [f64; 2],
    turn: [f64; 3],
}

/// ω = 2 q̇ q*, in space.
fn turning(state: &State<f64>) -> [f64; 3] {
    let ([a, b, c, d], [da, db, dc, dd]) = (
        [3, 4, 5, 6].map(|i| state.q[i]),
        [3, 4, 5, 6].map(|i| state.v[i]),
    );
    [
        2.0 * (db * a - da * b - dc * d + dd * c),
        2.0 * (dc * a - da * c - dd * b + db * d),
        2.0 * (dd * a - da * d - db * c + dc * b),
    ]
}

/// The cushion carries nothing, so that its friction does nothing: the ball slows down along it, v̇ = μg, until it rolls after |u|/(7/2 μg), and
/// turns on about the vertical as fast as it did. Near to that instant errors of the velocities turn what slips, and with it the force of the
/// cushion, which no event may come of.
#[test]
fn an_unloaded_cushion_does_nothing() {
    let mut random = Random::new(8);
    for _ in 0..12 {
        let ball = Ball {
            mass: 0.17,
            radius: 0.0286,
            gravity: 9.81,
            mu: random.between(0.04, 0.2),
            nu: 1.0,
            way: 0.3,
            speed: [random.between(2.0, 3.0), random.between(-0.5, 0.5)],
            // Backspin, so that the cushion does not throw it up.
            turn: [
                random.between(-50.0, 50.0),
                random.between(-60.0, -35.0),
                random.between(-50.0, 50.0),
            ],
        };
        for how in [
            ("taylor", 1e-9),
            ("taylor", 1e-11),
            ("dop853", 1e-9),
            ("verner98", 1e-11),
        ] {
            let motion = run_by(&ball, how, first_start(&ball), 4.0);
            let name = format!("{how:?} {ball:?}");
            let hit = event(&motion, "cushion", "impact");
            let [along, up, about] = turning(&hit.state_after);
            assert!(
                up.abs() < 1e-6,
                "{name}: its friction sticks in the impact: {up:e}"
            );
            let slip = hit.state_after.v[1] + along * ball.radius;
            let slowing = ball.mu * ball.gravity;
            let lasts = slip.abs() / (3.5 * slowing);
            let rolls = event(&motion, "cloth", "sticks");
            agree(&name, rolls.time, hit.time + lasts, 1e3 * how.1);
            let last = words(&motion).last().cloned();
            assert_eq!(last.as_deref(), Some("cloth sticks"), "{name}");
            let end = motion.final_state();
            agree(
                &name,
                end.v[1],
                hit.state_after.v[1] - slip.signum() * slowing * lasts,
                1e3 * how.1,
            );
            agree(&name, turning(end)[2], about, 1e4 * how.1);
            certified(&name, &motion);
            assert!(
                motion.work().steps < 1000,
                "{name}: {} steps",
                motion.work().steps
            );
        }
    }
}
