//! Bodies that slide on more feet than are needed: how these share the load moves them. Equal springs below a rigid body carry what is
//! linear in their places.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{
    Random, SINGLE_METHODS, TOLERANCES, agree, all_agree, methods_at, root, run_by, runge_kutta,
    words,
};
use nalgebra::{Matrix3, Vector2, Vector3};

/// A stool on four feet slides and turns; `tilt` are its small turns about its own axes.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, turn, z, tilt[2]),
    define(
        east = [cos(turn), sin(turn)],
        north = [-sin(turn), cos(turn)],
        place[k in 0..4] = [x, y] + (a[k] - height * tilt[1]) * east + (b[k] + height * tilt[0]) * north,
    ),
    kinetic = (der(x)^2 + der(y)^2 + der(z)^2 + inertia * (der(turn)^2 + der(tilt[0])^2 + der(tilt[1])^2)) / 2,
    potential = gravity * z,
    contact(foot[k in 0..4]: z + b[k] * tilt[0] - a[k] * tilt[1] >= 0),
    friction(grip[k in 0..4] on foot[k]: slip = (der(place[k][0]), der(place[k][1])), static = mu[k]),
)]
struct Stool {
    a: [f64; 4],
    b: [f64; 4],
    mu: [f64; 4],
    height: f64,
    inertia: f64,
    gravity: f64,
}

/// (x, y, turn) and their rates.
type Planar = [f64; 6];

impl Stool {
    fn random(random: &mut Random) -> Self {
        let mut corner = |sign: f64| sign * random.between(0.2, 0.5);
        let a = [corner(1.0), corner(-1.0), corner(-1.0), corner(1.0)];
        let b = [corner(1.0), corner(1.0), corner(-1.0), corner(-1.0)];
        Stool {
            a,
            b,
            mu: core::array::from_fn(|_| random.between(0.1, 0.4)),
            height: random.between(0.5, 1.0),
            inertia: random.between(0.05, 0.2),
            gravity: 9.81,
        }
    }

    /// How fast each foot slips, in the axes of the body.
    fn slips(&self, s: &Planar) -> [Vector2<f64>; 4] {
        let [_, _, turn, vx, vy, spin] = *s;
        let (sine, cosine) = turn.sin_cos();
        let body = Vector2::new(cosine * vx + sine * vy, cosine * vy - sine * vx);
        [0, 1, 2, 3].map(|k| body + spin * Vector2::new(-self.b[k], self.a[k]))
    }

    /// Accelerations and loads, from the balance of forces and moments of loads α + β a + γ b.
    fn balance(&self, s: &Planar) -> (Vector3<f64>, [f64; 4]) {
        let (sine, cosine) = s[2].sin_cos();
        let mut matrix = Matrix3::zeros();
        let slips = self.slips(s);
        // Friction of a unit load.
        let drag = [0, 1, 2, 3].map(|k| -self.mu[k] * slips[k].normalize());
        let terms = |k: usize| Vector3::new(1.0, self.a[k], self.b[k]);
        for (k, drag) in drag.iter().enumerate() {
            let lever = Vector3::new(
                1.0,
                self.a[k] + self.height * drag.x,
                self.b[k] + self.height * drag.y,
            );
            matrix += lever * terms(k).transpose();
        }
        let weight = Vector3::new(self.gravity, 0.0, 0.0);
        let share = matrix.lu().solve(&weight).expect("feet that span a plane");
        let loads = [0, 1, 2, 3].map(|k| share.dot(&terms(k)));
        let (mut force, mut moment) = (Vector2::zeros(), 0.0);
        for k in 0..4 {
            let friction = loads[k] * drag[k];
            force += friction;
            moment += self.a[k] * friction.y - self.b[k] * friction.x;
        }
        let world = Vector3::new(
            cosine * force.x - sine * force.y,
            sine * force.x + cosine * force.y,
            moment / self.inertia,
        );
        (world, loads)
    }

    /// The speed of the slowest foot.
    fn slowest(&self, s: &Planar) -> f64 {
        let speeds = self.slips(s).map(|slip| slip.norm());
        speeds.into_iter().fold(f64::INFINITY, f64::min)
    }

    /// One step of the classical Runge–Kutta method.
    fn step(&self, s: &Planar, h: f64) -> Planar {
        let rate = |_, s: Planar| {
            let (a, _) = self.balance(&s);
            [s[3], s[4], s[5], a[0], a[1], a[2]]
        };
        runge_kutta(rate, (0.0, *s), h)
    }

    /// The least load, and whose it is.
    fn least(&self, s: &Planar) -> (usize, f64) {
        let (_, loads) = self.balance(s);
        let feet = loads.into_iter().enumerate();
        feet.min_by(|x, y| x.1.total_cmp(&y.1)).expect("four feet")
    }
}

const STEP: f64 = 2e-4;

#[test]
fn feet_share_the_load_of_what_slides_on_them() {
    let mut random = Random::new(3);
    let mut unloaded = 0;
    for case in 0..24 {
        let stool = Stool::random(&mut random);
        let rates = [0.0; 3].map(|_| random.sign() * random.between(1.0, 4.0));
        let mut now = [0.0, 0.0, 0.0, rates[0], rates[1], rates[2]];
        if stool.least(&now).1 < 0.1 {
            // It stands on three from the start.
            continue;
        }
        let mut time = 0.0;
        let mut lifts = None;
        while time < 0.6 && stool.slowest(&now) > 0.2 {
            let next = stool.step(&now, STEP);
            let (foot, load) = stool.least(&next);
            if load < 0.0 {
                let left = root(|h| stool.least(&stool.step(&now, h)).1, 0.0, STEP);
                lifts = Some((foot, time + left));
                break;
            }
            now = next;
            time += STEP;
        }
        unloaded += usize::from(lifts.is_some());
        for (method, tolerance) in methods_at(SINGLE_METHODS, TOLERANCES) {
            let asked = format!("case {case} by {method} at {tolerance:e}");
            let v = [&rates[..], &[0.0; 3]].concat();
            let end = time + if lifts.is_some() { 0.05 } else { 0.0 };
            let run = run_by(&stool, (method, tolerance), state(&[0.0; 6], &v), end);
            let bound = 200.0 * tolerance.max(1e-12);
            let at = run.sampler().at(time).expect("inside");
            all_agree(&asked, &at.state.q[..3], &now[..3], bound);
            all_agree(&asked, &at.state.v[..3], &now[3..], bound);
            let (_, loads) = stool.balance(&now);
            let found = [0, 1, 2, 3].map(|k| at.force(Stool::FOOT[k]));
            all_agree(&asked, &found, &loads, 100.0 * bound);
            if let Some((foot, instant)) = lifts {
                let name = format!("foot[{foot}]");
                let mut events = run.events().iter();
                let event =
                    events.find(|e| e.subject.name(run.description()) == name && e.time > 0.0);
                let event = event.unwrap_or_else(|| panic!("{asked}: {:?}", words(&run)));
                agree(&asked, event.time, instant, 100.0 * bound);
            }
            assert!(run.verify(0).expect("a certificate").holds(), "{asked}");
        }
    }
    assert!(unloaded > 2, "only {unloaded} lose the load of a foot");
}

/// A plate on four feet in a square, without height: each carries a quarter of the weight, however it slides.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, turn, z, tilt[2]),
    define(
        a = [radius, 0, -radius, 0],
        b = [0, radius, 0, -radius],
        place[k in 0..4] = [x + a[k]*cos(turn) - b[k]*sin(turn), y + a[k]*sin(turn) + b[k]*cos(turn)],
    ),
    kinetic = (der(x)^2 + der(y)^2 + der(z)^2 + inertia * (der(turn)^2 + der(tilt[0])^2 + der(tilt[1])^2)) / 2,
    potential = gravity * z,
    contact(foot[k in 0..4]: z + b[k] * tilt[0] - a[k] * tilt[1] >= 0),
    friction(grip[k in 0..4] on foot[k]: slip = (der(place[k][0]), der(place[k][1])), static = mu),
    force(shove: (push*cos(heading), push*sin(heading)) at (x, y)),
)]
struct Plate {
    radius: f64,
    inertia: f64,
    gravity: f64,
    mu: f64,
    push: f64,
    heading: f64,
}

/// The same with the normal forces given.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, turn),
    define(
        a = [radius, 0, -radius, 0],
        b = [0, radius, 0, -radius],
        place[k in 0..4] = [x + a[k]*cos(turn) - b[k]*sin(turn), y + a[k]*sin(turn) + b[k]*cos(turn)],
    ),
    kinetic = (der(x)^2 + der(y)^2 + inertia * der(turn)^2) / 2,
    friction(grip[k in 0..4]: slip = (der(place[k][0]), der(place[k][1])), normal = gravity/4, static = mu),
    force(shove: (push*cos(heading), push*sin(heading)) at (x, y)),
)]
struct Loaded {
    radius: f64,
    inertia: f64,
    gravity: f64,
    mu: f64,
    push: f64,
    heading: f64,
}

/// It turns about one of its feet, or a point beside it, which may stick for a while: the two feet beside that one could be open, and the load on the
/// others, but nothing lifts them.
#[test]
fn a_plate_that_turns_about_a_foot_stands_on_all_of_them() {
    for (speed, spin, push, heading) in [
        (1.0, 1.0, 0.0, 0.0),
        (1.0, 1.0, 1.0, 0.0),
        (1.0, 1.0, 2.5, 0.7),
        (-2.0, -2.0, 1.0, 0.7),
        (-2.0, -2.000_01, 1.0, 0.7),
        (0.5, 0.5, 2.5, 0.0),
        (0.7, 0.7, 1.4, 2.0),
    ] {
        let [radius, inertia, gravity, mu] = [1.0, 1.0, 10.0, 0.3];
        let plate = Plate {
            radius,
            inertia,
            gravity,
            mu,
            push,
            heading,
        };
        let loaded = Loaded {
            radius,
            inertia,
            gravity,
            mu,
            push,
            heading,
        };
        for (method, tolerance) in methods_at(["auto", "dop853", "verner98"], [1e-9, 1e-12]) {
            let what = format!("{plate:?} from {speed}, {spin} by {method} at {tolerance:e}");
            let start = state(&[0.0; 6], &[speed, 0.0, spin, 0.0, 0.0, 0.0]);
            let stands = run_by(&plate, (method, tolerance), start, 2.0);
            let start = state(&[0.0; 3], &[speed, 0.0, spin]);
            let slides = run_by(&loaded, (method, tolerance), start, 2.0);
            let lost = words(&stands)
                .into_iter()
                .find(|word| word.ends_with("lost"));
            assert_eq!(lost, None, "{what}");
            let end = &stands.final_state().q[..3];
            all_agree(&what, end, &slides.final_state().q, 1e3 * tolerance);
        }
    }
}
