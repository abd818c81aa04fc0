//! A trolley at rest between a rough wall and its wheels, whose front wheel turns through straight ahead: the forces that hold it turn with it.

use lagrange_core::prelude::*;
use lagrange_tests::{Random, agree, first_start, methods_at, run_by, times};

/// The front wheel is held at its lock by the motor that steers it, until this turns it back. A dry friction in the head is overcome by then.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, th, de),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + inertia/2 * der(th)^2 + wheel/2 * (der(th) + der(de))^2,
    constraint(rear: -der(x) * sin(th) + der(y) * cos(th) - behind * der(th) == 0),
    constraint(front: -der(x) * sin(th + de) + der(y) * cos(th + de) + ahead * cos(de) * der(th) == 0),
    friction(head: slip = der(de), limit = (1.4 * rubs, rubs)),
    force(steer: de = torque * cos(rate * t)),
    contact(lock: de <= 0.6),
    contact(wall: y + ahead * sin(th) <= 0),
    friction(scrape on wall: slip = der(x) - ahead * sin(th) * der(th), static = 0.3),
    start(held: th = heading, y = -ahead * sin(heading), de = 0.6),
)]
struct Trolley {
    mass: f64,
    inertia: f64,
    wheel: f64,
    behind: f64,
    ahead: f64,
    rubs: f64,
    torque: f64,
    rate: f64,
    heading: f64,
}

impl Trolley {
    fn random(seed: u64) -> Self {
        let mut random = Random::new(seed);
        Self {
            mass: random.between(60.0, 100.0),
            inertia: random.between(8.0, 12.0),
            wheel: random.between(0.4, 0.7),
            behind: random.between(0.3, 0.5),
            ahead: random.between(0.5, 0.7),
            rubs: random.between(1.2, 1.7),
            torque: random.between(7.0, 9.0),
            rate: random.between(1.8, 2.3),
            heading: random.between(0.3, 0.4),
        }
    }

    /// When the motor overcomes the friction, and the angle of the wheel after that, of a trolley that rests.
    fn turned(&self) -> (f64, impl Fn(f64) -> f64) {
        let begins = (-1.4 * self.rubs / self.torque).acos() / self.rate;
        let (rate, phase) = (self.rate, self.rate * begins);
        let angle = move |t: f64| {
            let gone = t - begins;
            let by_motor = ((phase.cos() - (rate * t).cos()) / rate - phase.sin() * gone) / rate;
            0.6 + (self.torque * by_motor + self.rubs * gone * gone / 2.0) / self.wheel
        };
        (begins, angle)
    }
}

#[test]
fn a_trolley_lets_go_where_its_front_wheel_is_straight() {
    for seed in 0..12 {
        let trolley = Trolley::random(seed);
        let (begins, angle) = trolley.turned();
        // The wheel turns one way.
        let (mut before, mut after) = (begins, begins + 1.2);
        for _ in 0..60 {
            let middle = 0.5 * (before + after);
            match angle(middle) > 0.0 {
                true => before = middle,
                false => after = middle,
            }
        }
        for method in methods_at(
            ["auto", "dop853", "verner98", "radau5"],
            [1e-6, 1e-9, 1e-12],
        ) {
            let what = format!("{seed} {method:?}");
            let trajectory = run_by(&trolley, method, first_start(&trolley), after + 0.01);
            agree(&what, times(&trajectory, "lock", "lost")[0], begins, 1e-9);
            let lost = times(&trajectory, "wall", "lost");
            assert_eq!(lost.len(), 1, "{what}: {lost:?}");
            agree(&what, lost[0], after, 1e-9);
        }
    }
}
