//! Balls on a line: impacts of several contacts at once.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{METHODS, Random, TOLERANCES, agree, closure, methods_at, run};

/// Two balls on a line, and a wall.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x[3]),
    kinetic = sum(i in 0..3: mass[i]/2 * der(x[i])^2),
    contact(pair[k in 0..2]: x[k+1] - x[k] >= 0, restitution = bounce),
)]
struct Cradle {
    mass: [f64; 3],
    bounce: f64,
}

#[test]
fn three_balls_together_and_two_balls_alone() {
    let cradle = Cradle {
        mass: [1.0; 3],
        bounce: 1.0,
    };
    // The second and third touch: Newton's law for both contacts at once (Glocker 2001).
    let trajectory = run(&cradle, state(&[-1.0, 0.0, 0.0], &[1.0, 0.0, 0.0]), 2.0);
    for (v, expected) in trajectory
        .final_state()
        .v
        .iter()
        .zip([-1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0])
    {
        agree("v", *v, expected, 1e-14);
    }
    // Apart, with different masses and e = 0.4: momentum and the law of restitution.
    let pair = Cradle {
        mass: [2.0, 3.0, 1.0],
        bounce: 0.4,
    };
    let trajectory = run(&pair, state(&[-1.0, 0.0, 50.0], &[1.0, 0.2, 9.0]), 2.0);
    let v = &trajectory.final_state().v;
    agree("momentum", 2.0 * v[0] + 3.0 * v[1], 2.6, 1e-14);
    agree("restitution", v[1] - v[0], 0.4 * 0.8, 1e-14);
    assert_eq!(Cradle::PAIR[1], ContactId(1));
}

/// Balls at any distance, one collision after the other, by hand: free flight, and for each collision the law of restitution
/// with conserved momentum.
fn by_hand(
    mass: [f64; 3],
    bounce: f64,
    mut x: [f64; 3],
    mut v: [f64; 3],
    until: f64,
) -> ([f64; 3], [f64; 3], usize) {
    let (mut t, mut collisions) = (0.0, 0);
    loop {
        let next = (0..2)
            .filter(|&k| v[k] > v[k + 1] && x[k + 1] - x[k] > 1e-13)
            .map(|k| ((x[k + 1] - x[k]) / (v[k] - v[k + 1]), k))
            .min_by(|a, b| a.0.total_cmp(&b.0));
        let Some((wait, k)) = next.filter(|(wait, _)| t + wait < until) else {
            let rest = until - t;
            return (core::array::from_fn(|i| x[i] + v[i] * rest), v, collisions);
        };
        t += wait;
        for i in 0..3 {
            x[i] += v[i] * wait;
        }
        let impulse = (1.0 + bounce) * (v[k] - v[k + 1]) / (1.0 / mass[k] + 1.0 / mass[k + 1]);
        v[k] -= impulse / mass[k];
        v[k + 1] += impulse / mass[k + 1];
        collisions += 1;
    }
}

#[test]
fn collisions_one_after_the_other_agree_with_those_by_hand() {
    let mut random = Random::new(31);
    let mut most = 0;
    for _ in 0..100 {
        let mass = [(); 3].map(|()| random.between(0.1, 5.0));
        let bounce = random.between(0.5, 1.0);
        let x = [
            random.between(-3.0, -1.0),
            random.between(-0.5, 0.5),
            random.between(1.0, 3.0),
        ];
        let v = [
            random.between(1.0, 4.0),
            random.between(-1.0, 1.0),
            random.between(-4.0, -1.0),
        ];
        let (place, speed, collisions) = by_hand(mass, bounce, x, v, 4.0);
        most = most.max(collisions);
        let trajectory = run(&Cradle { mass, bounce }, state(&x, &v), 4.0);
        let impacts = trajectory
            .events()
            .iter()
            .filter(|e| e.kind == EventKind::Impact);
        assert_eq!(impacts.count(), collisions);
        for i in 0..3 {
            agree("x", trajectory.final_state().q[i], place[i], 1e-10);
            agree("v", trajectory.final_state().v[i], speed[i], 1e-10);
        }
        assert!(closure(&trajectory) < 1e-10);
    }
    assert!(most > 3);
}

/// Carts side by side, each on a spring of its own, and one that strikes the others.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x[4]),
    kinetic = sum(k in 0..4: mass/2 * der(x[k])^2),
    potential = sum(k in 0..4: stiffness/2 * x[k]^2),
    contact(pair[k in 0..3]: x[k+1] >= x[k], restitution = bounce),
    start(struck: x[0] = -0.4),
    start(together: der(x) = [0.3, 0.3, 0.3, 0.3]),
)]
struct Carts {
    mass: f64,
    stiffness: f64,
    bounce: f64,
}

#[test]
fn what_touches_and_carries_nothing_stays_closed() {
    let carts = Carts {
        mass: 1.3,
        stiffness: 7.0,
        bounce: 0.5,
    };
    let half = core::f64::consts::PI / (7.0_f64 / 1.3).sqrt();
    for (method, tolerance) in methods_at(METHODS, TOLERANCES) {
        let run = |start| {
            let simulation = Simulation::new(&carts).method(method).tolerance(tolerance);
            simulation.run(start, 0.0..10.0).unwrap()
        };
        // All swing as one: nothing happens.
        let together = run(carts.at(Carts::TOGETHER));
        assert!(together.events().is_empty(), "{method} {tolerance}");
        // All swing through the middle at the same times, whatever an impact makes of their speeds: they meet there, and never else.
        let struck = run(carts.at(Carts::STRUCK));
        let events = struck.events();
        assert_eq!(events.len(), 7, "{method} {tolerance}");
        for (k, event) in events.iter().enumerate() {
            assert_eq!(event.kind, EventKind::Impact);
            assert_eq!(event.subject, Carts::PAIR[0].into());
            agree("t", event.time, (k as f64 + 0.5) * half, 20.0 * tolerance);
        }
    }
}

/// Balls on springs of one frequency, which all pass their middle at once.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x[4]),
    kinetic = sum(i in 0..4: mass[i]/2 * der(x[i])^2),
    potential = sum(i in 0..4: mass[i]/2 * x[i]^2),
    contact(pair[k in 0..3]: x[k+1] - x[k] >= 0, restitution = bounce[k]),
    impacts = in_turn,
)]
struct Sprung {
    mass: [f64; 4],
    bounce: [f64; 3],
}

/// The first strikes three that touch at their middle, where no force presses any together: what plastic impacts in turn leave of their rates, which
/// converge to zero, must not tell contacts open or closed.
#[test]
fn impacts_in_turn_that_converge_leave_nothing() {
    let mut random = Random::new(48);
    for k in 0..200 {
        let mass = core::array::from_fn(|_| random.between(0.3, 3.0));
        let bounce = match k % 2 {
            0 => [0.0; 3],
            _ => core::array::from_fn(|i| [0.0, 0.3, 0.5, 0.8][random.below(4).min(3 * i)]),
        };
        let sprung = Sprung { mass, bounce };
        let start = state(&[-1.0, 0.0, 0.0, 0.0], &[0.0; 4]);
        let motion = run(&sprung, start, 3.0);
        let v = &motion.final_state().v;
        let momentum: f64 = mass.iter().zip(v).map(|(m, v)| m * v).sum();
        // All turn at the time π, each with cos(t − π/2) of the speed that the impact gave it.
        let phase = 3.0_f64.sin();
        agree("momentum", momentum, mass[0] * phase, 1e-9);
        if bounce == [0.0; 3] {
            for v in v {
                agree("v", *v, mass[0] * phase / mass.iter().sum::<f64>(), 1e-9);
            }
        }
    }
}
