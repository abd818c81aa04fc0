//! Elastic bodies that are pressed together, with the force k d^p of Hertz (1882) and its likes: it begins where they touch, and has no Taylor series there.

use super::{PI, state};
use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, Random, agree, certified, integral, methods_at};

/// Two balls in a row: their masses, the stiffness of what is between them, other parameters, and the items that say how it acts.
macro_rules! balls {
    ($(#[$words:meta])* $name:ident { $($other:ident)? } $($items:tt)*) => {
        $(#[$words])*
        #[derive(Lagrangian, Clone, Debug)]
        #[lagrange(
            coordinates(x, z),
            kinetic = first/2 * der(x)^2 + second/2 * der(z)^2,
            $($items)*
        )]
        struct $name {
            first: f64,
            second: f64,
            stiffness: f64,
            $($other: f64,)?
        }
    };
}

balls! {
    /// Two balls in a row; the force is written as that of the larger of zero and the depth.
    Balls { apart }
    define(depth = x - z + apart),
    force(elastic: stiffness * max(0, depth)^(3/2) along der(z) - der(x)),
}

balls! {
    /// The same as a choice, with another power.
    Chosen { apart }
    define(depth = x - z + apart),
    force(elastic: if(depth >= 0, stiffness * depth^2.2, 0) along der(z) - der(x)),
}

balls! {
    /// The same as a potential, with a third one.
    Stored { apart }
    define(depth = x - z + apart),
    potential = stiffness/2.1 * max(depth, 0)^2.1,
}

balls! {
    /// The depth against a length, raised with it.
    Against { unit }
    force(elastic: stiffness * (max(0, x - z + 0.3)/unit)^(3/2) along der(z) - der(x)),
}

balls! {
    /// A condition on another multiple of the depth than the one that is raised, as a product with its root.
    Ratio { apart }
    define(depth = x - z + apart),
    force(elastic: if((z - x)/apart <= 1, stiffness * depth * sqrt(depth), 0) along der(z) - der(x)),
}

balls! {
    /// A depth that is written with its size, in a potential.
    Folded {}
    define(depth = x - z + 0.1),
    potential = stiffness/2.7 * ((abs(depth) + depth)/2)^2.7,
}

balls! {
    /// A distance that is compared with a number, whose square decides.
    Apart {}
    force(elastic: stiffness * max(0, 0.4 - norm([x - z, 0]))^2.5 along der(z) - der(x)),
}

/// A ball on an elastic ground, with the losses of Hunt and Crossley (1975).
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(y),
    kinetic = der(y)^2 / 2,
    potential = 9.81 * y,
    force(ground: y = stiffness * max(0, -y)^(3/2) * (1 - loss * der(y))),
)]
struct Dropped {
    stiffness: f64,
    loss: f64,
}

/// Two bodies meet with a speed: what they do by the laws of impact without losses, and the time for which they touch, 2/v ∫ dδ/√(1 − (δ/d)^(p+1)).
struct Meeting {
    masses: [f64; 2],
    speed: f64,
    deepest: f64,
    power: f64,
    gap: f64,
}

impl Meeting {
    fn drawn(random: &mut Random, power: f64) -> Self {
        Self {
            masses: [0; 2].map(|_| random.between(-2.0, 1.0).exp2()),
            speed: random.between(0.02, 5.0),
            deepest: 10.0_f64.powf(random.between(-5.0, -2.0)),
            power,
            gap: random.between(0.01, 0.2),
        }
    }

    fn stiffness(&self) -> f64 {
        let [a, b] = self.masses;
        let energy = a * b / (a + b) * self.speed * self.speed / 2.0;
        energy * (self.power + 1.0) / self.deepest.powf(self.power + 1.0)
    }

    fn lasts(&self) -> f64 {
        // δ = d sin²(s): the root at the deepest place is gone.
        let n = self.power + 1.0;
        let slope = |s: f64| {
            let (sin, cos) = s.sin_cos();
            // 1 − sin²ⁿ, without its loss of digits where cos is small.
            let left = -(n * (-cos * cos).ln_1p()).exp_m1();
            if left > 0.0 {
                2.0 * sin * cos / left.sqrt()
            } else {
                2.0 / n.sqrt()
            }
        };
        2.0 * self.deepest / self.speed * integral(slope, 0.0, PI / 2.0)
    }

    fn check<S: System<Scalar = f64> + core::fmt::Debug>(
        &self,
        apart: f64,
        system: impl Fn([f64; 2], f64) -> S,
    ) {
        let system = &system(self.masses, self.stiffness());
        let [a, b] = self.masses;
        let after = [
            (a - b) / (a + b) * self.speed,
            2.0 * a / (a + b) * self.speed,
        ];
        let (meets, lasts) = (self.gap / self.speed, self.lasts());
        for (method, tolerance) in methods_at(METHODS, [1e-7, 1e-10]) {
            let what = format!("{system:?} by {method:?} at {tolerance:e}");
            let start = state(&[-apart - self.gap, 0.0], &[self.speed, 0.0]);
            let simulation = Simulation::new(system).method(method).tolerance(tolerance);
            let run = simulation
                .run(start, 0.0..1.2 * (meets + lasts))
                .expect("a run");
            let times: Vec<f64> = run.events().iter().map(|event| event.time).collect();
            let [begins, ends] = times[..] else {
                panic!("{what}: {times:?}");
            };
            // Errors of the state are beside 1, and depths are as much smaller.
            let within = 1e3 * tolerance / self.deepest.sqrt();
            agree(&what, begins, meets, 1e3 * tolerance);
            agree(&what, ends, meets + lasts, within);
            for (v, after) in run.final_state().v.iter().zip(after) {
                agree(&what, *v, after, within * self.speed.max(1.0));
            }
            certified(&what, &run);
        }
    }
}

#[test]
fn elastic_bodies_part_as_the_laws_of_impact_say_and_when_hertz_says() {
    let mut random = Random::new(1882);
    for round in 0..6 {
        let apart = [0.0, 0.3][round % 2];
        Meeting::drawn(&mut random, 1.5).check(apart, |[first, second], stiffness| Balls {
            first,
            second,
            stiffness,
            apart,
        });
        Meeting::drawn(&mut random, 2.2).check(apart, |[first, second], stiffness| Chosen {
            first,
            second,
            stiffness,
            apart,
        });
        Meeting::drawn(&mut random, 1.1).check(apart, |[first, second], stiffness| Stored {
            first,
            second,
            stiffness,
            apart,
        });
    }
}

#[test]
fn elastic_bodies_part_alike_however_their_depth_is_written() {
    let mut random = Random::new(1883);
    for unit in [0.02, 0.5] {
        Meeting::drawn(&mut random, 1.5).check(0.3, |[first, second], stiffness| Against {
            first,
            second,
            stiffness: stiffness * unit.powf(1.5),
            unit,
        });
    }
    for apart in [0.15, 0.37] {
        Meeting::drawn(&mut random, 1.5).check(apart, |[first, second], stiffness| Ratio {
            first,
            second,
            stiffness,
            apart,
        });
    }
    Meeting::drawn(&mut random, 1.7).check(0.1, |[first, second], stiffness| Folded {
        first,
        second,
        stiffness,
    });
    Meeting::drawn(&mut random, 2.5).check(0.4, |[first, second], stiffness| Apart {
        first,
        second,
        stiffness,
    });
}

/// It bounces lower and lower, and all methods say how.
#[test]
fn a_ball_on_an_elastic_ground_loses_what_the_ground_takes() {
    let dropped = Dropped {
        stiffness: 2e4,
        loss: 0.2,
    };
    let runs = methods_at(METHODS, [1e-10]).map(|(method, tolerance)| {
        let simulation = Simulation::new(&dropped)
            .method(method)
            .tolerance(tolerance);
        let run = simulation
            .run(state(&[0.5], &[0.0]), 0.0..2.0)
            .expect("a run");
        certified(format!("{method:?}"), &run);
        (method, run)
    });
    let runs: Vec<(Method, Trajectory)> = runs.collect();
    let (_, first) = &runs[0];
    assert!(first.events().len() >= 4);
    for (method, run) in &runs[1..] {
        let what = format!("{method:?}");
        assert_eq!(run.events().len(), first.events().len(), "{what}");
        agree(
            &what,
            run.final_state().q[0],
            first.final_state().q[0],
            1e-6,
        );
        for (event, other) in run.events().iter().zip(first.events()) {
            agree(&what, event.time, other.time, 1e-6);
        }
    }
}
