//! The ledger over time, against closed forms.

use lagrange_core::prelude::*;
use lagrange_tests::{Random, agree, closure, event, run};

/// A damped oscillator.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = mass/2 * der(x)^2,
    potential = stiffness/2 * x^2,
    dissipation(damper: drag/2 * der(x)^2),
    force(drive: x = push * cos(rate * t)),
)]
struct Oscillator {
    mass: f64,
    stiffness: f64,
    drag: f64,
    push: f64,
    rate: f64,
}

/// A particle on a support that is moved up and down by a constraint.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    constraint(lift: y == reach * sin(rate * t)),
    friction(brake: slip = der(x), limit = hold),
)]
struct Lift {
    mass: f64,
    gravity: f64,
    reach: f64,
    rate: f64,
    hold: f64,
}

/// A ball that bounces.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(y),
    kinetic = mass/2 * der(y)^2,
    potential = mass * gravity * y,
    contact(floor: y >= 0, restitution = bounce),
)]
struct Ball {
    mass: f64,
    gravity: f64,
    bounce: f64,
}

/// Two balls that have nothing to do with one another.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(y, z),
    kinetic = light/2 * der(y)^2 + heavy/2 * der(z)^2,
    contact(floor: y >= 0, restitution = bounce),
    contact(table: z >= 0, restitution = bounce/2),
    start(thrown: y = fast, z = slow, der(y) = -fast, der(z) = -slow),
)]
struct TwoBalls {
    light: f64,
    heavy: f64,
    bounce: f64,
    fast: f64,
    slow: f64,
}

/// A puck that is thrown slantingly onto a belt that runs across.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    contact(belt: y >= 0),
    friction(cloth on belt: slip = der(x) - run, static = mu),
    start(thrown: y = speed, der(y) = -speed),
)]
struct OntoBelt {
    mass: f64,
    speed: f64,
    run: f64,
    mu: f64,
}

/// A block that a belt carries against a spring.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential(weight: mass * gravity * y),
    potential(spring: stiffness/2 * x^2),
    contact(belt: y >= 0),
    friction(grip on belt: slip = der(x) - speed, static = 10, kinetic = 10),
)]
struct Belt {
    mass: f64,
    gravity: f64,
    stiffness: f64,
    speed: f64,
}

/// A block that is slowed down in proportion to the force of the floor.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * (gravity * y + if(t >= 1, 5, 3)),
    constraint(floor: y == 0),
    force(rub: x = -share * floor),
)]
struct Rubbed {
    mass: f64,
    gravity: f64,
    share: f64,
}

fn work(ledger: &Ledger, name: &str, kind: &str) -> f64 {
    let mut entries = ledger.work.iter();
    let entry = entries.find(|e| e.name == name && e.kind == kind);
    entry.expect("booked").work
}

#[test]
fn a_damper_takes_what_the_oscillation_loses() {
    let scene = Oscillator {
        mass: 1.3,
        stiffness: 20.0,
        drag: 0.4,
        push: 0.0,
        rate: 0.0,
    };
    let start = State::new(vec![0.3], vec![0.0]);
    let trajectory = run(&scene, start, 5.0);
    let mut random = Random::new(7);
    let times: Vec<f64> = (0..50).map(|_| random.between(0.0, 5.0)).collect();
    let ledgers = trajectory.ledgers(&times).expect("recorded");
    // x = A e^(−δt) cos(ωt − φ), energies of it.
    let decay = scene.drag / (2.0 * scene.mass);
    let rate = (scene.stiffness / scene.mass - decay * decay).sqrt();
    let energy = |t: f64| {
        let (s, c) = (rate * t).sin_cos();
        let envelope = 0.3 * (-decay * t).exp();
        let x = envelope * (c + decay / rate * s);
        let v = -envelope * (rate + decay * decay / rate) * s;
        0.5 * scene.mass * v * v + 0.5 * scene.stiffness * x * x
    };
    for (t, ledger) in times.iter().zip(&ledgers) {
        agree(
            "loss",
            work(ledger, "damper", "dissipation"),
            energy(*t) - energy(0.0),
            1e-12,
        );
        assert!(ledger.closure.abs() < 1e-12, "{:e}", ledger.closure);
    }
}

#[test]
fn a_drive_pays_for_the_damper_in_the_steady_state() {
    let scene = Oscillator {
        mass: 1.0,
        stiffness: 9.0,
        drag: 0.5,
        push: 2.0,
        rate: 2.5,
    };
    // The steady state: x = Re(push e^(iωt) / (k − mω² + icω)).
    let (a, b) = (9.0 - 2.5 * 2.5, 0.5 * 2.5);
    let size = a * a + b * b;
    let start = State::new(vec![2.0 * a / size], vec![2.0 * b * 2.5 / size]);
    let period = 2.0 * core::f64::consts::PI / 2.5;
    let trajectory = run(&scene, start, 3.0 * period);
    let times = [period, 2.0 * period, 3.0 * period];
    let ledgers = trajectory.ledgers(&times).expect("recorded");
    for (k, ledger) in ledgers.iter().enumerate() {
        // Over a period: π c ω |x|².
        let loss = core::f64::consts::PI * 0.5 * 2.5 * 4.0 / size * (k + 1) as f64;
        agree("drive", work(ledger, "drive", "force"), loss, 1e-11);
        agree(
            "damper",
            work(ledger, "damper", "dissipation"),
            -loss,
            1e-11,
        );
    }
}

/// What is left out does no work: the ledger is that of a scene without it.
#[test]
fn what_is_left_out_is_not_booked() {
    let scene = Oscillator {
        mass: 1.0,
        stiffness: 9.0,
        drag: 0.5,
        push: 2.0,
        rate: 2.5,
    };
    let effects = Effects::all()
        .without(Oscillator::DAMPER)
        .without(Oscillator::DRIVE);
    let start = State::new(vec![0.3], vec![0.0]);
    let run = Simulation::new(&scene)
        .tolerance(1e-13)
        .effects(effects)
        .run(start, 0.0..5.0);
    let run = run.expect("a run");
    let ledger = run.ledger().expect("recorded");
    assert_eq!(work(&ledger, "drive", "force"), 0.0);
    assert_eq!(work(&ledger, "damper", "dissipation"), 0.0);
    assert!(ledger.closure.abs() < 1e-12, "{:e}", ledger.closure);
    let now = run.sampler().at(2.0).expect("recorded");
    assert_eq!(now.load(Oscillator::DRIVE), 0.0);
    // x = 0.3 cos(3t)
    agree("x", now.q(Oscillator::X), 0.3 * 6.0_f64.cos(), 1e-9);
}

#[test]
fn a_moving_constraint_and_a_brake() {
    let scene = Lift {
        mass: 2.0,
        gravity: 9.81,
        reach: 0.2,
        rate: 3.0,
        hold: 1.0,
    };
    let start = State::new(vec![0.0, 0.0], vec![1.0, 0.6]);
    let trajectory = run(&scene, start, 4.0);
    let times: Vec<f64> = (0..40).map(|k| 0.1 * f64::from(k)).collect();
    for (t, ledger) in times
        .iter()
        .zip(trajectory.ledgers(&times).expect("recorded"))
    {
        let (s, c) = (3.0 * t).sin_cos();
        let lifted = 2.0 * 9.81 * 0.2 * s + 0.36 * (c * c - 1.0);
        agree("lift", work(&ledger, "lift", "constraint"), lifted, 1e-11);
        // It stops after 2 s.
        let x = if *t < 2.0 { t - 0.25 * t * t } else { 1.0 };
        agree("brake", work(&ledger, "brake", "friction"), -x, 1e-11);
        assert!(ledger.closure.abs() < 1e-11, "{:e}", ledger.closure);
    }
}

#[test]
fn impacts_are_booked_when_they_happen_and_to_the_last() {
    let scene = Ball {
        mass: 1.0,
        gravity: 10.0,
        bounce: 0.5,
    };
    let start = State::new(vec![0.2], vec![0.0]);
    let trajectory = run(&scene, start, 2.0);
    // Falls 0.2 s at 2 m/s, then is away for 0.2 s, 0.1 s, …, and rests after 0.6 s.
    let ledgers = trajectory
        .ledgers(&[0.1, 0.3, 0.45, 2.0])
        .expect("recorded");
    let expected = [0.0, -1.5, -1.875, -2.0];
    for (ledger, expected) in ledgers.iter().zip(expected) {
        agree("impact", work(ledger, "floor", "impact"), expected, 1e-12);
        assert!(ledger.closure.abs() < 1e-11, "{:e}", ledger.closure);
    }
    let outside = trajectory.ledgers(&[2.5]);
    assert!(matches!(outside, Err(Error::OutsideTrajectory { .. })));
}

/// Static friction does work where its slip is that beside something that moves; the force of a floor at rest does exactly none.
/// Each contact takes (1 − e²) of what its own ball had, although both are hit at one instant, t = 1.
#[test]
fn impacts_at_one_instant_are_booked_to_their_contacts() {
    let mut random = Random::new(5);
    for _ in 0..8 {
        let balls = TwoBalls {
            light: random.between(0.1, 1.0),
            heavy: random.between(2.0, 9.0),
            bounce: random.between(0.2, 0.9),
            fast: random.between(3.0, 5.0),
            slow: random.between(0.5, 2.0),
        };
        let record = run(&balls, balls.at(TwoBalls::THROWN), 2.0);
        let ledger = record.ledger().expect("a recorded run");
        let lost = |mass: f64, speed: f64, e: f64| -mass / 2.0 * speed.powi(2) * (1.0 - e * e);
        let floor = lost(balls.light, balls.fast, balls.bounce);
        let table = lost(balls.heavy, balls.slow, balls.bounce / 2.0);
        agree(
            format!("{balls:?}"),
            work(&ledger, "floor", "impact"),
            floor,
            1e-12,
        );
        agree(
            format!("{balls:?}"),
            work(&ledger, "table", "impact"),
            table,
            1e-12,
        );
        assert!(closure(&record) < 1e-12, "{:e}", closure(&record));
    }
}

/// The belt stops the fall, −m v²/2, and its friction impulse μ m v works by the mean speed μ v/2 of the puck, which slips on.
#[test]
fn what_friction_does_in_an_impact_is_its_own() {
    let puck = OntoBelt {
        mass: 0.3,
        speed: 2.0,
        run: 5.0,
        mu: 0.4,
    };
    // The puck slips on after that without weight.
    let record = run(&puck, puck.at(OntoBelt::THROWN), 1.5);
    let ledger = record.ledger().expect("a recorded run");
    let energy = puck.mass / 2.0 * puck.speed.powi(2);
    agree("belt", work(&ledger, "belt", "impact"), -energy, 1e-12);
    agree(
        "cloth",
        work(&ledger, "cloth", "impact"),
        puck.mu.powi(2) * energy,
        1e-12,
    );
    agree(
        "after",
        record.final_state().v[0],
        puck.mu * puck.speed,
        1e-12,
    );
}

#[test]
fn a_belt_works_while_it_carries() {
    let scene = Belt {
        mass: 2.0,
        gravity: 9.81,
        stiffness: 30.0,
        speed: 0.25,
    };
    let trajectory = run(&scene, State::new(vec![0.1, 0.0], vec![0.25, 0.0]), 4.0);
    assert!(trajectory.events().is_empty());
    for (t, ledger) in [0.5, 1.7, 4.0]
        .into_iter()
        .zip(trajectory.ledgers(&[0.5, 1.7, 4.0]).expect("recorded"))
    {
        let x = 0.1 + 0.25 * t;
        let stretched = 15.0 * (x * x - 0.01);
        agree("grip", work(&ledger, "grip", "friction"), stretched, 1e-13);
        assert_eq!(work(&ledger, "belt", "contact"), 0.0);
    }
}

/// A force that contains that of a constraint is known when the equations of motion are solved. What a potential jumps by in time
/// is work of time, where no force feels it.
#[test]
fn a_force_in_proportion_to_another_is_booked() {
    let scene = Rubbed {
        mass: 2.0,
        gravity: 10.0,
        share: 0.1,
    };
    let trajectory = run(&scene, State::new(vec![0.0, 0.0], vec![3.0, 0.0]), 2.0);
    let ledger = trajectory.ledger().expect("recorded");
    // It is slowed down by 1 m/s² over 3 t − t²/2 = 4 m.
    agree("rub", work(&ledger, "rub", "force"), -8.0, 1e-12);
    assert_eq!((ledger.start.potential, ledger.end.potential), (6.0, 10.0));
    agree("time", work(&ledger, "explicit time", "time"), 4.0, 1e-12);
    agree("closure", ledger.closure, 0.0, 1e-12);
}

/// A machine on the ground with a part in it that goes up and down, and lifts it off.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(y),
    define(part = y + stroke * sin(rate * t)),
    kinetic = mass/2 * der(y)^2 + moved/2 * der(part)^2,
    potential = gravity * (mass * y + moved * part),
    contact(ground: y >= 0, restitution = bounce),
)]
struct Rammer {
    mass: f64,
    moved: f64,
    stroke: f64,
    rate: f64,
    gravity: f64,
    bounce: f64,
}

/// Impacts that die out take some time, in which what moves by itself goes on; the ledger counts that time.
#[test]
fn what_goes_on_while_impacts_die_out_is_booked() {
    let rammer = Rammer {
        mass: 6.0,
        moved: 1.0,
        stroke: 0.05,
        rate: 50.0,
        gravity: 9.81,
        bounce: 0.3,
    };
    let trajectory = run(&rammer, State::new(vec![0.0], vec![0.0]), 3.0);
    let died_out = event(&trajectory, "ground", "accumulates").time;
    assert!(died_out < 1.0, "{died_out}");
    assert!(closure(&trajectory) < 1e-11, "{:e}", closure(&trajectory));
}
