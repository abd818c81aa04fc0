//! A die with eight corners: thrown, rolled from one edge onto the next, and free in the air.

use lagrange_core::integrate::Method;
use lagrange_core::prelude::*;
use lagrange_tests::{Random, agree, all_agree};

/// A cube with sides of twice `half`.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, z),
    attitude(body: q),
    define(
        corner[k in 0..8] = [x, y, z]
            + half * (side[3*k] * body.axes[0] + side[3*k + 1] * body.axes[1] + side[3*k + 2] * body.axes[2]),
    ),
    kinetic = mass/2 * (der(x)^2 + der(y)^2 + der(z)^2)
        + mass * half^2 / 3 * (body.body_rate[0]^2 + body.body_rate[1]^2 + body.body_rate[2]^2),
    potential = mass * gravity * z,
    contact(touch[k in 0..8]: corner[k][2] >= 0, restitution = bounce),
    friction(grip[k in 0..8] on touch[k]: slip = (der(corner[k][0]), der(corner[k][1])), static = mu),
)]
struct Die {
    mass: f64,
    half: f64,
    gravity: f64,
    bounce: f64,
    mu: f64,
    side: [f64; 24],
}

impl Die {
    fn new(bounce: f64, mu: f64) -> Self {
        Die {
            mass: 0.01,
            half: 0.008,
            gravity: 9.81,
            bounce,
            mu,
            side: core::array::from_fn(|i| match ((i / 3) >> (2 - i % 3)) & 1 {
                0 => 1.0,
                _ => -1.0,
            }),
        }
    }

    /// Thrown from a height of 0.1 m with its faces along the axes, at this speed along x and these rates about the axes.
    fn thrown(&self, speed: f64, rates: [f64; 3]) -> State {
        let [a, b, c] = rates.map(|rate| 0.5 * rate);
        State::new(
            vec![0.0, 0.0, 0.1, 1.0, 0.0, 0.0, 0.0],
            vec![speed, 0.0, 0.0, 0.0, a, b, c],
        )
    }
}

/// Near the attitude in which one element of a quaternion is 1 this has next to no inertia. Forces of a small die were off by 5e-12 there, beside
/// the unit condition, whose elements are about 1.
#[test]
fn forces_of_a_small_body_are_exact_where_it_is_not_turned() {
    for half in [8e-3, 1.0, 30.0] {
        let scene = Die {
            half,
            ..Die::new(0.5, 0.3)
        };
        let rates = [3.459, 2.306, 0.0].map(|rate| rate / half.sqrt());
        let air = (0..8).fold(Effects::all(), |effects, k| effects.without(Die::TOUCH[k]));
        let simulation = Simulation::new(&scene).effects(air);
        let run = simulation.run(scene.thrown(0.0, rates), 0.0..0.1);
        let run = run.expect("a run");
        let certificate = run.verify(0).expect("recorded");
        assert!(certificate.holds(), "{certificate}");
    }
}

/// On the edge behind it turns at the rate ω, and strikes with the one in front, which holds: about that it turns at ω/4, and leaves the other one, for an
/// edge takes up 5/4 m ω h upwards and 3/4 m ω h against the motion.
#[test]
fn a_die_that_rolls_from_edge_to_edge_keeps_a_quarter_of_its_rate() {
    for (yaw, mu) in [(0.0_f64, 0.7), (0.3, 0.61), (-2.0, 0.62), (1.1, 1.0)] {
        let scene = Die::new(0.0, mu);
        let (h, rate) = (scene.half, 20.0);
        let (sin, cos) = yaw.sin_cos();
        let [across, along] = [[cos, sin], [-sin, cos]];
        // About the edge at −h across, forward and down: the middle moves forward at ω h and down at ω h.
        let (s, c) = (0.5 * yaw).sin_cos();
        let start = State::new(
            vec![0.0, 0.0, h, c, 0.0, 0.0, s],
            vec![
                rate * h * across[0],
                rate * h * across[1],
                -rate * h,
                0.0,
                0.5 * rate * (c * along[0] + s * along[1]),
                0.5 * rate * (c * along[1] - s * along[0]),
                0.0,
            ],
        );
        let run = Simulation::new(&scene).run(start, 0.0..1e-4);
        let run = run.expect("a run");
        let event = &run.events()[0];
        assert_eq!(event.kind, EventKind::Impact, "{yaw} {mu}");
        let after = rate * h / 4.0;
        let expected = [after * across[0], after * across[1], after];
        all_agree("speeds", &event.state_after.v[..3], &expected, 1e-9);
        let share = 5.0 / 8.0 * scene.mass * rate * h;
        let front = (0..8).filter(|&k| event.impulse(Die::TOUCH[k]) > 0.0);
        let front: Vec<usize> = front.collect();
        assert_eq!(front.len(), 2, "{yaw} {mu}");
        for k in front {
            agree("impulse", event.impulse(Die::TOUCH[k]), share, 1e-9);
            let row = run.description().frictions[k].row;
            let against = across.map(|x| -0.6 * share * x);
            all_agree("friction", &event.impulses[row..row + 2], &against, 1e-9);
        }
    }
}

/// Corners, edges and faces strike, slide, stick and rock, again and again, until one face lies on the table.
fn comes_to_rest(scene: &Die, speed: f64, rates: [f64; 3], method: Method, tolerance: f64) {
    let Die { bounce, mu, .. } = scene;
    let asked = format!("{bounce} {mu} {speed} {rates:?} {method:?} {tolerance:e}");
    let run = Simulation::new(scene)
        .method(method)
        .tolerance(tolerance)
        .run(scene.thrown(speed, rates), 0.0..3.0);
    let run = run.unwrap_or_else(|failure| panic!("{asked}: {failure}"));
    let end = run.final_state();
    assert!(end.v.iter().all(|v| v.abs() < 1e-5), "{asked}: {:?}", end.v);
    agree(&asked, end.q(Die::Z), scene.half, 1e-6);
    let certificate = run.verify(0).expect("recorded");
    assert!(certificate.holds(), "{asked}: {certificate}");
}

#[test]
fn a_thrown_die_comes_to_rest_on_a_face() {
    let mut random = Random::new(7);
    for (bounce, mu) in [
        (0.0, 0.3),
        (0.2, 0.9),
        (0.5, 0.1),
        (0.5, 0.55),
        (0.5, 0.9),
        (0.8, 0.3),
    ] {
        let scene = Die::new(bounce, mu);
        let speed = random.between(0.0, 1.0);
        let rates = [0, 1, 2].map(|_| random.between(-30.0, 30.0));
        for (method, tolerance) in [
            (Method::Taylor, 1e-6),
            (Method::Taylor, 1e-9),
            (Method::DormandPrince853, 1e-9),
            (Method::Radau5, 1e-9),
        ] {
            comes_to_rest(&scene, speed, rates, method, tolerance);
        }
    }
}

/// Throws in which all corners of a face land at once, slide together and rattle, and in which a corner that holds reaches its limit.
#[test]
fn dice_that_land_flat_or_hold_at_their_limit_come_to_rest() {
    use Method::{DormandPrince54, DormandPrince853, Radau5, Taylor, Verner98};
    for (mu, bounce, rates, speed, tolerance, method) in [
        (0.55, 0.2, [6.816, 6.431, 15.341], 0.881, 1e-6, Taylor),
        (0.9, 0.0, [-13.280, 29.770, -15.340], -2.793, 1e-12, Taylor),
        (0.55, 0.2, [3.943, 8.362, 28.330], -1.189, 1e-6, Taylor),
        (0.55, 0.2, [23.983, 0.423, -15.697], 1.129, 1e-12, Radau5),
        (
            0.9,
            0.8,
            [28.840, -25.157, -7.296],
            0.427,
            1e-6,
            DormandPrince54,
        ),
        (
            0.3,
            0.5,
            [14.362, 21.362, -26.321],
            -1.335,
            1e-12,
            DormandPrince853,
        ),
        (0.55, 0.8, [-3.911, -7.416, -21.907], 1.443, 1e-9, Radau5),
        (0.55, 0.8, [-7.765, 22.093, 6.006], 2.239, 1e-9, Verner98),
        (0.9, 0.5, [29.281, 16.738, -12.333], 1.155, 1e-6, Taylor),
        (0.9, 0.0, [-14.143, -9.380, -16.620], 0.313, 1e-12, Taylor),
        (0.55, 0.0, [-15.413, 18.393, -14.892], 1.153, 1e-6, Taylor),
        (0.3, 0.5, [12.719, 10.776, -15.530], 2.191, 1e-9, Radau5),
    ] {
        comes_to_rest(&Die::new(bounce, mu), speed, rates, method, tolerance);
    }
}
