//! Bodies that land on rough floors: what friction does in the impact.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{
    METHODS, Random, TOLERANCES, agree, certified, closure, event, methods_at, run, run_by, times,
    words,
};

/// A body that lands on a rough plane: two directions of slip, each with a wheel of its own moment of inertia.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, z, a, b),
    kinetic = mass/2 * (der(x)^2 + der(y)^2 + der(z)^2) + first/2 * der(a)^2 + second/2 * der(b)^2,
    potential = mass * gravity * z,
    contact(floor: z >= 0, restitution = e),
    friction(grip on floor: slip = (der(x) - radius * der(a), der(y) - radius * der(b)),
        static = mu_static, kinetic = mu_kinetic),
)]
struct Lander {
    mass: f64,
    first: f64,
    second: f64,
    radius: f64,
    gravity: f64,
    e: f64,
    mu_static: f64,
    mu_kinetic: f64,
}

impl Lander {
    fn slip(&self, s: &State<f64>) -> [f64; 2] {
        [s.v[0] - self.radius * s.v[3], s.v[1] - self.radius * s.v[4]]
    }

    /// Whether the impulse of the first impact stops the slip; if not, it slides along what is left of it.
    #[track_caller]
    fn stops(&self, trajectory: &Trajectory) -> bool {
        let hit = event(trajectory, "floor", "impact");
        let (before, after) = (self.slip(&hit.state), self.slip(&hit.state_after));
        let arrival = -hit.state.v[2];
        let normal = self.mass * (1.0 + self.e) * arrival;
        agree("normal", hit.impulses[0], normal, 1e-12);
        // Compliance of each direction.
        let g = [self.first, self.second].map(|i| 1.0 / self.mass + self.radius.powi(2) / i);
        let stop = [-before[0] / g[0], -before[1] / g[1]];
        let impulse = [hit.impulses[1], hit.impulses[2]];
        if stop[0].hypot(stop[1]) <= self.mu_static * normal {
            for k in 0..2 {
                agree("stops", impulse[k], stop[k], 1e-12);
                assert!(after[k].abs() < 1e-13);
            }
            return true;
        }
        let speed = after[0].hypot(after[1]);
        for k in 0..2 {
            let friction = -self.mu_kinetic * normal * after[k] / speed;
            agree("slides", impulse[k], friction, 1e-12);
            agree("slip", after[k], before[k] + g[k] * impulse[k], 1e-12);
        }
        if self.first == self.second {
            let turn = before[0] * after[1] - before[1] * after[0];
            assert!(turn.abs() < 1e-12);
        }
        assert!(closure(trajectory) < 1e-11);
        false
    }
}

#[test]
fn slip_with_two_components_slides_along_what_is_left_of_it_or_stops() {
    let mut random = Random::new(12);
    let mut stuck = 0;
    for k in 0..100 {
        let first = random.between(0.05, 0.5);
        let scene = Lander {
            mass: 1.5,
            first,
            second: match k % 2 {
                0 => first,
                _ => random.between(0.05, 0.5),
            },
            radius: 0.6,
            gravity: 9.81,
            e: random.between(0.1, 0.9),
            mu_static: 0.12,
            mu_kinetic: 0.09,
        };
        let v: Vec<f64> = (0..5).map(|_| random.between(-3.0, 3.0)).collect();
        let start = state(&[0.0, 0.0, 0.05, 0.0, 0.0], &[v[0], v[1], -2.0, v[3], v[4]]);
        stuck += usize::from(scene.stops(&run(&scene, start, 0.04)));
    }
    assert!((16..70).contains(&stuck), "{stuck}");
}

/// A rod in space by a quaternion, whose mass matrix is singular, strikes a rough floor in the plane y = 0.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, z),
    attitude(body: q),
    kinetic = mass/2 * (der(x)^2 + der(y)^2 + der(z)^2)
        + inertia/2 * (body.body_rate[0]^2 + body.body_rate[1]^2) + spin/2 * body.body_rate[2]^2,
    define(px = x - half * body.axes[2][0], py = y - half * body.axes[2][1], pz = z - half * body.axes[2][2]),
    contact(floor: pz >= 0, restitution = e),
    friction(grip on floor: slip = (der(px), der(py)), static = mu),
)]
struct RodInSpace {
    mass: f64,
    inertia: f64,
    spin: f64,
    half: f64,
    mu: f64,
    e: f64,
}

/// In the plane: (x, z, θ from the vertical).
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, z, theta),
    kinetic = mass/2 * (der(x)^2 + der(z)^2) + inertia/2 * der(theta)^2,
    contact(floor: z - half * cos(theta) >= 0, restitution = e),
    friction(grip on floor: slip = der(x - half * sin(theta)), static = mu),
)]
struct RodInPlane {
    mass: f64,
    inertia: f64,
    half: f64,
    mu: f64,
    e: f64,
}

#[test]
fn a_rod_in_quaternions_strikes_as_one_with_an_angle() {
    for (mu, vx) in [(0.2, 1.0), (0.2, -1.5), (2.0, 0.7)] {
        let theta: f64 = 0.5;
        let space = RodInSpace {
            mass: 1.2,
            inertia: 0.15,
            spin: 0.02,
            half: 0.5,
            mu,
            e: 0.4,
        };
        let plane = RodInPlane {
            mass: 1.2,
            inertia: 0.15,
            half: 0.5,
            mu,
            e: 0.4,
        };
        let height = 0.5 * theta.cos() + 0.02;
        let (s, c) = (0.5 * theta).sin_cos();
        // A turn about y by θ leans the axis to (sin θ, 0, cos θ).
        let rate = 0.3;
        let start = state(
            &[0.0, 0.0, height, c, 0.0, s, 0.0],
            &[vx, 0.0, -1.0, -0.5 * rate * s, 0.0, 0.5 * rate * c, 0.0],
        );
        let there = run(&space, start, 0.2);
        let here = run(&plane, state(&[0.0, height, theta], &[vx, -1.0, rate]), 0.2);
        let (a, b) = (
            event(&there, "floor", "impact"),
            event(&here, "floor", "impact"),
        );
        agree("time", a.time, b.time, 1e-11);
        agree("vx", a.state_after.v[0], b.state_after.v[0], 1e-10);
        agree("vz", a.state_after.v[2], b.state_after.v[1], 1e-10);
        let (last, other) = (there.final_state(), here.final_state());
        agree("x", last.q[0], other.q[0], 1e-10);
        agree("z", last.q[2], other.q[1], 1e-10);
        assert!(last.q[1].abs() < 1e-12);
        assert!(closure(&there) < 1e-10);
    }
}

/// A body on its floor, and a mass whose place is told from it.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, r, angle),
    define(px = x + r * sin(angle), py = y + r * cos(angle)),
    kinetic = mass/2 * (der(px)^2 + der(py)^2) + body/2 * (der(x)^2 + der(y)^2),
    potential = 9.81 * (mass * py + body * y),
    contact(floor: y >= 3/10),
    contact(ground: py >= 0),
)]
struct Carried {
    mass: f64,
    body: f64,
}

/// No impulse of the mass reaches the body, whatever rounding says of the coordinates that are coupled.
#[test]
fn a_mass_that_lands_does_not_lift_what_it_is_measured_from() {
    let mut random = Random::new(51);
    for _ in 0..20 {
        let scene = Carried {
            mass: random.between(0.2, 2.0),
            body: random.between(0.1, 1.0),
        };
        let (r, angle) = (random.between(0.3, 0.9), random.between(0.5, 1.4));
        let v = [
            0.0,
            0.0,
            random.between(-0.5, 0.9),
            random.between(-0.3, 0.5),
        ];
        for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
            let start = state(&[0.0, 0.3, r, angle], &v);
            let motion = run_by(&scene, (method, tolerance), start, 1.0);
            let what = format!("{scene:?} {r} {angle} {v:?} by {method} at {tolerance:e}");
            assert_eq!(words(&motion), ["ground impact", "ground closed"], "{what}");
        }
    }
}

/// A mass slides down a smooth ramp onto a rough floor.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y),
    kinetic = (der(x)^2 + der(y)^2)/2,
    potential = gravity*y,
    contact(ramp: x*sin(angle) + y*cos(angle) >= 0, restitution = off_ramp),
    contact(floor: y >= -drop, restitution = off_floor),
    friction(rub on floor: slip = der(x), static = mu),
)]
struct Ramp {
    gravity: f64,
    angle: f64,
    drop: f64,
    off_ramp: f64,
    off_floor: f64,
    mu: f64,
}

/// As it lands the friction stops what goes ahead, so that it falls straight back into the corner. Ramp and floor throw it off together there, and where
/// it lands next the friction stops it for good.
#[test]
fn a_mass_that_falls_back_into_a_corner_meets_both_its_sides() {
    let mut random = Random::new(7);
    for _ in 0..12 {
        let scene = Ramp {
            gravity: 9.81,
            angle: random.between(0.55, 1.3),
            drop: random.between(0.3, 4.0),
            off_ramp: 0.6,
            off_floor: 0.3,
            mu: 1.5,
        };
        let speed = random.between(0.05, 0.5);
        let (sine, cosine) = scene.angle.sin_cos();
        // At the foot of the ramp, then up from the floor and back.
        let foot = (speed * speed + 2.0 * scene.gravity * scene.drop).sqrt();
        let back = scene.off_floor * foot * sine;
        let ahead = back * cosine / sine * (scene.off_ramp - scene.off_floor);
        let flight = 2.0 * scene.off_floor * back / scene.gravity;
        let rests = scene.drop * cosine / sine + ahead * flight;
        for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
            let start = state(&[0.0, 0.0], &[speed * cosine, -speed * sine]);
            let run = run_by(&scene, (method, tolerance), start, 4.0);
            let what = format!("{scene:?} {speed} {method} {tolerance}");
            agree(&what, run.final_state().q[0], rests, 100.0 * tolerance);
            certified(&what, &run);
        }
    }
}

/// A box on two feet with three brakes of given strength, which falls onto one foot and then the other.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, turn),
    define(
        left_x = x - wide*cos(turn) + tall*sin(turn),
        left = y - wide*sin(turn) - tall*cos(turn),
        right_x = x + wide*cos(turn) + tall*sin(turn),
        right = y + wide*sin(turn) - tall*cos(turn),
    ),
    kinetic = (der(x)^2 + der(y)^2)/2 + inertia/2*der(turn)^2,
    potential = 10*y,
    contact(heel: left >= 0, restitution = 0),
    contact(toe: right >= 0, restitution = 0),
    friction(rear on heel: slip = der(left_x), static = mu),
    friction(front on toe: slip = der(right_x), static = mu),
    friction(down: slip = der(y), limit = (strength, strength/10)),
    friction(about: slip = der(turn), limit = (1, 0.2)),
    friction(ahead: slip = der(x), limit = (2, 0.3)),
    force(lift: y = 20*max(0, t - 2)),
    start(tilted: x = 0, y = tall*cos(tilt) + wide*abs(sin(tilt)), turn = tilt),
)]
struct Braked {
    wide: f64,
    tall: f64,
    inertia: f64,
    mu: f64,
    strength: f64,
    tilt: f64,
}

/// Once it rests its brakes hold, whatever rounding the impact has left of their slips: it is lifted when the pull carries its weight and overcomes the brake
/// that holds it down.
#[test]
fn brakes_hold_what_has_landed_on_all_its_feet() {
    for (wide, tall, inertia, mu) in [
        (0.5, 0.3, 0.1, 0.9),
        (1.0, 0.3, 0.3, 0.9),
        (0.5, 0.1, 0.05, 2.0),
    ] {
        for tilt in [0.1, -0.2, 0.05, 0.3, -0.137] {
            let body = Braked {
                wide,
                tall,
                inertia,
                mu,
                strength: 3.0,
                tilt,
            };
            let all = methods_at(METHODS, TOLERANCES);
            for (method, tolerance) in all.filter(|(_, tolerance)| tilt > 0.2 || *tolerance > 1e-12)
            {
                let what = format!("{body:?} by {method} at {tolerance:e}");
                let run = run_by(&body, (method, tolerance), body.at(Braked::TILTED), 3.0);
                let late = run.events().iter().filter(|event| event.time > 2.0 + 1e-6);
                assert!(
                    late.clone().all(|event| (event.time - 2.65).abs() < 1e-6),
                    "{what}: {:?}",
                    words(&run)
                );
                let lifted = ["heel", "toe"]
                    .map(|foot| *times(&run, foot, "lost").last().expect("it is lifted"));
                lifted
                    .iter()
                    .for_each(|&time| agree(&what, time, 2.65, 1e-6));
                certified(&what, &run);
            }
        }
    }
}
