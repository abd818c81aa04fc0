//! A body that rolls on a floor by constraints and is held by a rough wall as well: its rows depend on each other, as far as the constraints are satisfied.

use lagrange_core::prelude::*;
use lagrange_tests::{Random, all_agree, certified, first_start, methods_at, run_by};
use nalgebra::{Matrix3, Vector3};

/// A wheel, flat or thick, that rolls on a floor against an upright wall, at any angle.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x[3]),
    attitude(wheel: q),
    define(
        speed = [der(x[0]), der(x[1]), der(x[2])],
        w = wheel.space_rate,
        axle = wheel.axes[2],
        out = [cos(facing), sin(facing), 0],
        lean = sqrt(1 - axle[2]^2),
        foot = radius * ([0, 0, -1] + axle[2] * axle) / lean,
        turn = sqrt(1 - dot(out, axle)^2),
        side = radius * (out - dot(out, axle) * axle) / turn,
        at_foot = speed + cross(w, foot),
        at_side = speed + cross(w, side),
    ),
    kinetic = mass/2 * dot(speed, speed) + transverse/2 * (wheel.body_rate[0]^2 + wheel.body_rate[1]^2) + polar/2 * wheel.body_rate[2]^2,
    potential = 9.81 * mass * x[2],
    constraint(floor: x[2] == radius * lean),
    constraint(rolls[k in 0..2]: at_foot[k] == 0),
    contact(wall: distance - dot(x, out) >= radius * turn),
    friction(rub on wall: slip = (dot(at_side, [-sin(facing), cos(facing), 0]), at_side[2]), static = mu),
    start(rolling:
        x[2] = radius * sin(tilt),
        der(x[0]) = -radius * (heading_rate * cos(tilt) + spin) * cos(heading) + radius * tilt_rate * sin(tilt) * sin(heading),
        der(x[1]) = -radius * (heading_rate * cos(tilt) + spin) * sin(heading) - radius * tilt_rate * sin(tilt) * cos(heading),
        der(x[2]) = radius * tilt_rate * cos(tilt),
        wheel.turn = ((0, 0, heading), (tilt, 0, 0)),
        wheel.space_rate = (tilt_rate * cos(heading) + spin * sin(heading) * sin(tilt), tilt_rate * sin(heading) - spin * cos(heading) * sin(tilt),
            heading_rate + spin * cos(tilt))),
    observe(v = speed, rate = w, axis = axle, below = foot, beside = side),
)]
struct Wheel {
    mass: f64,
    transverse: f64,
    polar: f64,
    radius: f64,
    facing: f64,
    distance: f64,
    mu: f64,
    heading: f64,
    tilt: f64,
    heading_rate: f64,
    tilt_rate: f64,
    spin: f64,
}

impl Wheel {
    fn random(seed: u64) -> Self {
        let mut random = Random::new(seed);
        let (mass, radius) = (random.between(0.3, 3.0), random.between(0.05, 0.3));
        let inertia = mass * radius * radius;
        Self {
            mass,
            transverse: inertia * random.between(0.25, 0.4),
            polar: inertia * random.between(0.4, 0.9),
            radius,
            facing: random.between(-3.0, 3.0),
            distance: radius * random.between(1.5, 4.0),
            mu: random.between(0.7, 2.0),
            heading: random.between(-2.0, 2.0),
            tilt: random.between(1.0, 2.0),
            heading_rate: random.between(-4.0, 4.0),
            tilt_rate: random.between(-4.0, 4.0),
            spin: random.between(-25.0, 25.0),
        }
    }

    /// The angular velocity with which it turns about both points that are held, by its motion before: impulses act at these points, and the angular momentum
    /// about the line through them stays.
    fn held(&self, before: &Instant<f64>) -> Vector3<f64> {
        let of = |outputs: [ObserveId; 3]| Vector3::from(outputs.map(|k| before.observe(k)));
        let [v, w, axle] = [Wheel::V, Wheel::RATE, Wheel::AXIS].map(of);
        let [foot, side] = [Wheel::BELOW, Wheel::BESIDE].map(of);
        let line = (side - foot).normalize();
        let inertia = Matrix3::identity() * self.transverse
            + axle * axle.transpose() * (self.polar - self.transverse);
        let momentum = inertia * w - foot.cross(&(self.mass * v));
        let about = line.dot(&(inertia * line)) + self.mass * line.cross(&foot).norm_squared();
        line * (line.dot(&momentum) / about)
    }
}

/// An impact without restitution that a friction of any size holds leaves the wheel turning about the line through the points at the floor and at the wall;
/// it stays there, whatever the method has left of the constraints' residuals.
#[test]
fn a_wheel_that_rolls_against_a_wall_is_held_at_two_points() {
    let mut held = 0;
    for seed in 0..40 {
        let wheel = Wheel::random(seed);
        let reference = run_by(&wheel, (Method::Auto, 1e-12), first_start(&wheel), 0.5);
        let closes = |run: &Trajectory| {
            let mut events = run.events().iter().enumerate();
            let mut closings = events
                .by_ref()
                .filter(|(_, event)| event.kind == EventKind::Closed);
            let (index, event) = closings.next()?;
            let sticks = event.after.frictions[0] == FrictionMode::Stick;
            sticks.then_some((index, event.time))
        };
        let Some((index, time)) = closes(&reference) else {
            continue;
        };
        held += 1;
        for pair in methods_at([Method::Auto, Method::DormandPrince853], [1e-7, 1e-9]) {
            let what = format!("{wheel:?} by {pair:?}");
            let run = run_by(&wheel, pair, first_start(&wheel), 0.5);
            certified(&what, &run);
            assert!(
                closes(&run).is_some_and(|(at, t)| at == index && (t - time).abs() < 1e-5),
                "{what}"
            );
            let mut sampler = run.sampler();
            let impact = &run.events()[index - 1];
            assert_eq!(impact.kind, EventKind::Impact, "{what}");
            let turns = wheel.held(&sampler.before(impact).expect("recorded"));
            let after = sampler.after(impact).expect("recorded");
            let rate = Wheel::RATE.map(|k| after.observe(k));
            all_agree(&what, &rate, turns.as_slice(), 1e-10);
        }
    }
    assert!(held >= 8, "{held}");
}
