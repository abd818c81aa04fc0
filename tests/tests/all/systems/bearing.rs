//! Several constraints press a friction together, N = √Σλ²: journals, a bead on a helix, a sleeve on a rail, a ball joint.

use super::{PI, state};
use crate::sensitivity::Slopes;
use lagrange_core::prelude::*;
use lagrange_tests::{
    METHODS, Random, SINGLE_METHODS, TOLERANCES, agree, certified, closure, event, methods_at,
    root, run, run_by, runge_kutta, times, words,
};

/// A body on a pin of some radius, which may be struck by a ball.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, theta, b),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + inertia/2 * der(theta)^2 + ball/2 * der(b)^2,
    potential = mass * gravity * y,
    constraint(pin_x: x == arm * sin(theta)),
    constraint(pin_y: y == -arm * cos(theta)),
    friction(journal on (pin_x, pin_y): slip = radius * der(theta), static = mu),
    force(motor: theta = torque),
    contact(hit: b >= arm * sin(theta) - 1, restitution = bounce),
)]
struct Pendulum {
    mass: f64,
    inertia: f64,
    arm: f64,
    radius: f64,
    mu: f64,
    gravity: f64,
    torque: f64,
    ball: f64,
    bounce: f64,
}

const PENDULUM: Pendulum = Pendulum {
    mass: 2.0,
    inertia: 0.3,
    arm: 0.4,
    radius: 0.1,
    mu: 0.3,
    gravity: 9.81,
    torque: 0.0,
    ball: 0.5,
    bounce: 0.5,
};

/// At an angle and a rate, the ball far away at rest.
fn at(pendulum: &Pendulum, theta: f64, rate: f64) -> State<f64> {
    let (l, (s, c)) = (pendulum.arm, theta.sin_cos());
    state(
        &[l * s, -l * c, theta, 100.0],
        &[l * c * rate, l * s * rate, rate, 0.0],
    )
}

/// Without loads an unbalanced disc presses with m l √(ω⁴ + ω̇²), so that ω̇ = −k ω² with J k = μ r m l √(1 + k²), J about the pin.
#[test]
fn an_unbalanced_disc_slows_down() {
    let disc = Pendulum {
        gravity: 0.0,
        ..PENDULUM
    };
    let inertia = disc.inertia + disc.mass * disc.arm * disc.arm;
    let moment = disc.mu * disc.radius * disc.mass * disc.arm;
    let k = moment / (inertia * inertia - moment * moment).sqrt();
    for method in METHODS {
        for rate in [7.0_f64, -3.0] {
            let by = (method, 1e-9);
            let trajectory = run_by(&disc, by, at(&disc, 0.3, rate), 5.0);
            let end = trajectory.final_state();
            let slower = 1.0 + k * rate.abs() * 5.0;
            agree("rate", end.v[2], rate / slower, 1e-7);
            agree(
                "angle",
                end.q[2],
                0.3 + rate.signum() * slower.ln() / k,
                1e-7,
            );
            assert!(words(&trajectory).is_empty());
        }
    }
}

/// The acceleration of the reduced equation J₀ α = −m g l sin θ ∓ μ r N with
/// N = m √((l α + g sin θ)² + (l ω² + g cos θ)²), solved anew.
fn acceleration(p: &Pendulum, theta: f64, rate: f64, sign: f64) -> f64 {
    let inertia = p.inertia + p.mass * p.arm * p.arm;
    let (along, radial) = (
        p.gravity * theta.sin(),
        p.arm * rate * rate + p.gravity * theta.cos(),
    );
    let balance = |alpha: f64| {
        let press = p.mass * (p.arm * alpha + along).hypot(radial);
        inertia * alpha + p.mass * p.arm * along + sign * p.mu * p.radius * press
    };
    root(balance, -1e3, 1e3)
}

#[test]
fn a_pendulum_swings_as_its_reduced_equation_says() {
    let p = &PENDULUM;
    let trajectory = run(p, at(p, 2.0, 0.0), 3.0);
    println!("{:?}", words(&trajectory));
    let mut turns = trajectory.events().iter();
    let turns = turns.by_ref().filter(|e| e.kind.word() == "reverses");
    let (mut theta, mut rate, mut time, mut sign) = (2.0, 0.0, 0.0, -1.0);
    let mut count = 0;
    for turn in turns {
        let steps = 4000;
        let h = (turn.time - time) / f64::from(steps);
        let slope = |_, [theta, rate]: [f64; 2]| [rate, acceleration(p, theta, rate, sign)];
        for _ in 0..steps {
            [theta, rate] = runge_kutta(slope, (0.0, [theta, rate]), h);
        }
        agree("rate at the turn", rate, 0.0, 1e-9);
        agree("angle at the turn", turn.state.q[2], theta, 1e-9);
        (time, sign, count) = (turn.time, -sign, count + 1);
    }
    assert!(count >= 2, "{count} turns");
    assert!(closure(&trajectory) < 1e-10);
}

/// It rests where m g l sin θ ≤ μ r N with N = m g.
#[test]
fn a_pendulum_rests_within_the_circle_of_friction() {
    let p = &PENDULUM;
    let limit = (p.mu * p.radius / p.arm).asin();
    for (part, rests) in [
        (0.999, true),
        (1.001, false),
        (-0.999, true),
        (-1.001, false),
    ] {
        let trajectory = run(p, at(p, part * limit, 0.0), 0.5);
        assert_eq!(words(&trajectory).is_empty(), rests, "{part}");
        let moved = (trajectory.final_state().q[2] - part * limit).abs();
        assert_eq!(moved == 0.0, rests, "{part}: {moved:e}");
    }
}

/// A motor starts it from rest without any load: with α constant at first, and as ω grows N = m l √(α² + ω⁴).
#[test]
fn a_rotor_starts_without_load() {
    let rotor = Pendulum {
        gravity: 0.0,
        torque: 1.0,
        ..PENDULUM
    };
    let inertia = rotor.inertia + rotor.mass * rotor.arm * rotor.arm;
    let moment = rotor.mu * rotor.radius * rotor.mass * rotor.arm;
    for method in METHODS {
        let trajectory = run_by(&rotor, (method, 1e-9), at(&rotor, 0.0, 0.0), 3.0);
        // dt = dω / α(ω), where J α = τ − m l μ r √(α² + ω⁴).
        let alpha = |w: f64| root(|a| inertia * a - 1.0 + moment * a.hypot(w * w), 0.0, 10.0);
        let rate = trajectory.final_state().v[2];
        let time = lagrange_tests::integral(|w| 1.0 / alpha(w), 0.0, rate);
        agree("time", time, 3.0, 1e-7);
    }
}

/// A blow P across: the pin answers with m l Δω, whatever its direction, and its friction takes μ r m l |Δω|.
#[test]
fn a_blow_on_a_journal() {
    for theta in [0.0, 0.5, -1.2] {
        let p = Pendulum {
            gravity: 0.0,
            ..PENDULUM
        };
        let mut start = at(&p, theta, 0.0);
        let gap = 0.1;
        (start.q[3], start.v[3]) = (p.arm * theta.sin() - 1.0 + gap, -4.0);
        let trajectory = run(&p, start, 0.03);
        let blow = event(&trajectory, "hit", "impact");
        let lever = p.arm * theta.cos();
        let inertia = p.inertia + p.mass * p.arm * p.arm + p.mu * p.radius * p.mass * p.arm;
        // The ball turns it backwards: inertia ω = lever P, ball (v + 4) = P, v + lever ω = e 4 after.
        let push = 4.0 * (1.0 + p.bounce) / (1.0 / p.ball + lever * lever / inertia);
        agree("impulse", blow.impulse(Pendulum::HIT), push, 1e-11);
        agree(
            "rate",
            blow.state_after.v[2],
            -lever * push / inertia,
            1e-11,
        );
        let pin = p.mass * p.arm * lever * push / inertia;
        let [x, y] = [Pendulum::PIN_X, Pendulum::PIN_Y].map(|pin| blow.impulse(pin));
        agree("pin", x.hypot(y), pin, 1e-11);
        agree(
            "friction",
            blow.impulse(Pendulum::JOURNAL),
            p.mu * pin,
            1e-11,
        );
    }
}

/// A bead on a helix. Both constraints that press are distances across the wire, in directions at right angles; the slip is the bead's own velocity.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, z, phi),
    define(c = radius / sqrt(radius^2 + pitch^2)),
    kinetic = mass/2 * (der(x)^2 + der(y)^2 + der(z)^2),
    potential = mass * gravity * z,
    constraint(radial: sqrt(x^2 + y^2) == radius),
    constraint(place: x * sin(phi) == y * cos(phi)),
    constraint(binormal: c * (z - pitch * phi) == 0),
    friction(rub on (radial, binormal):
        slip = c * (der(y) * cos(phi) - der(x) * sin(phi) + pitch / radius * der(z)), static = mu),
)]
struct Helix {
    mass: f64,
    radius: f64,
    pitch: f64,
    gravity: f64,
    mu: f64,
}

/// v̇ = −μ v²/ρ with ρ = R/cos²α; with gravity, v̇ = −μ √((v²/ρ)² + (g cos α)²) − g sin α.
#[test]
fn a_bead_climbs_a_helix() {
    let (radius, pitch, mu, speed) = (0.5_f64, 0.2_f64, 0.25, 3.0);
    let c = radius / radius.hypot(pitch);
    for gravity in [0.0, 9.81] {
        let helix = Helix {
            mass: 0.2,
            radius,
            pitch,
            gravity,
            mu,
        };
        let turn = speed * c / radius;
        let start = state(
            &[radius, 0.0, 0.0, 0.0],
            &[0.0, speed * c, pitch * turn, turn],
        );
        let until = 0.25;
        let trajectory = run(&helix, start, until);
        let slow = |v: f64| {
            mu * (v * v * c * c / radius).hypot(gravity * c) + gravity * (1.0 - c * c).sqrt()
        };
        let end = trajectory.final_state().v[3] * radius / c;
        let time = lagrange_tests::integral(|more| 1.0 / slow(end + more), end, speed);
        agree("time", time, until, 1e-11);
    }
}

/// A sleeve on a rail, pressed by a force across that changes its sign, and by a small one down.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, z),
    kinetic = mass/2 * (der(x)^2 + der(y)^2 + der(z)^2),
    force(across: y = side * cos(rate * t)),
    force(weight: z = -down),
    constraint(wall: y == 0),
    constraint(floor: z == 0),
    friction(rub on (wall, floor): slip = der(x), static = mu),
)]
struct Sleeve {
    mass: f64,
    side: f64,
    rate: f64,
    down: f64,
    mu: f64,
}

/// The speed lost is μ ∫ √(a² cos² ωt + d²) dt / m, smooth or, where d = 0, with corners at which nothing presses. No step passes them by.
#[test]
fn loads_that_vanish_or_nearly() {
    for down in [0.0, 1e-12, 1e-9, 1e-6, 1e-4, 1e-2, 1.0] {
        let sleeve = Sleeve {
            mass: 1.0,
            side: 5.0,
            rate: 2.0,
            down,
            mu: 0.3,
        };
        let load = |t: f64| (5.0 * (2.0 * t).cos()).hypot(down);
        let corners = [0.0, PI / 4.0, 3.0 * PI / 4.0, 3.0];
        let lost: f64 = corners
            .windows(2)
            .map(|of| {
                // Close to a corner the load is all but |t − t₀|: parts that halve towards both ends.
                let [from, to] = [of[0], of[1]];
                let parts = (0..40).flat_map(|k| {
                    let share = |k: i32| 0.5_f64.powi(k) * 0.5;
                    let (near, far) = (share(k + 1), share(k));
                    [
                        (from + near * (to - from), from + far * (to - from)),
                        (to - far * (to - from), to - near * (to - from)),
                    ]
                });
                parts
                    .map(|(a, b)| lagrange_tests::integral(|more| load(a + more), a, b))
                    .sum::<f64>()
            })
            .sum();
        for (method, tolerance) in methods_at(METHODS, [1e-6, 1e-9]) {
            let start = state(&[0.0; 3], &[10.0, 0.0, 0.0]);
            let trajectory = run_by(&sleeve, (method, tolerance), start, 3.0);
            let end = trajectory.final_state().v[0];
            let most = 30.0 * tolerance + 1e-10;
            agree(
                format!("{method} {tolerance:e} {down:e}"),
                end,
                10.0 - 0.3 * lost,
                most,
            );
            assert!(words(&trajectory).is_empty());
        }
    }
}

/// A heavy top in a ball joint with friction about its own axis.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, z),
    attitude(top: q),
    kinetic = mass/2 * (der(x)^2 + der(y)^2 + der(z)^2)
        + transverse/2 * (top.body_rate[0]^2 + top.body_rate[1]^2) + axial/2 * top.body_rate[2]^2,
    potential = mass * gravity * z,
    constraint(joint_x: x == arm * top.axes[2][0]),
    constraint(joint_y: y == arm * top.axes[2][1]),
    constraint(joint_z: z == arm * top.axes[2][2]),
    friction(joint on (joint_x, joint_y, joint_z): slip = radius * top.body_rate[2], static = mu),
    start(upright: z = arm, top.body_rate[2] = spin),
    start(tilted: y = -arm * sin(tilt), z = arm * cos(tilt), top.turn = (tilt, 0, 0), top.body_rate[2] = spin),
)]
struct Top {
    mass: f64,
    transverse: f64,
    axial: f64,
    arm: f64,
    gravity: f64,
    radius: f64,
    mu: f64,
    spin: f64,
    tilt: f64,
}

/// Upright it carries its weight, and its spin falls by μ r m g t / C; tilted, the work of the joint is what its energy loses, and the
/// spin falls by μ r ∫N dt / C.
#[test]
fn a_top_in_a_ball_joint() {
    let top = Top {
        mass: 1.0,
        transverse: 0.02,
        axial: 0.01,
        arm: 0.3,
        gravity: 9.81,
        radius: 0.02,
        mu: 0.2,
        spin: 100.0,
        tilt: 0.5,
    };
    let trajectory = run(&top, top.at(Top::UPRIGHT), 2.0);
    let spin = |trajectory: &Trajectory| {
        let end = trajectory.final_state();
        // The body's rate about its own axis: 2 (q̄ q̇)₃.
        let (q, v) = (&end.q[3..7], &end.v[3..7]);
        2.0 * (q[0] * v[3] - q[3] * v[0] - q[1] * v[2] + q[2] * v[1])
    };
    let slow = top.mu * top.radius * top.mass * top.gravity / top.axial;
    agree("spin", spin(&trajectory), 100.0 - slow * 2.0, 1e-10);
    let trajectory = run(&top, top.at(Top::TILTED), 1.0);
    assert!(closure(&trajectory) < 1e-9);
    let mut sampler = trajectory.sampler();
    let mut load = |t: f64| {
        let now = sampler.at(t).expect("in the run");
        let forces = [Top::JOINT_X, Top::JOINT_Y, Top::JOINT_Z].map(|joint| now.force(joint));
        forces.into_iter().fold(0.0, f64::hypot)
    };
    let steps = 2000;
    let h = 1.0 / f64::from(steps);
    // Simpson's rule.
    let sum: f64 = (0..=2 * steps)
        .map(|k| {
            let weight = match k {
                0 => 1.0,
                k if k == 2 * steps => 1.0,
                k if k % 2 == 1 => 4.0,
                _ => 2.0,
            };
            weight * load(f64::from(k) * h / 2.0)
        })
        .sum();
    let lost = top.mu * top.radius * sum * h / 6.0 / top.axial;
    agree("spin", spin(&trajectory), 100.0 - lost, 1e-9);
}

/// Two bars on rough pins, the lower of which may strike a wall; of numbers with derivatives, or without.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x[2], y[2], theta[2]),
    define(
        right[k in 0..2] = length/2 * sin(theta[k]),
        down[k in 0..2] = length/2 * cos(theta[k]),
        turn[k in 0..2] = der(theta[k]) - sum(i in 0..k: der(theta[i])),
    ),
    kinetic = sum(k in 0..2: mass/2 * (der(x[k])^2 + der(y[k])^2 + length^2/12 * der(theta[k])^2)),
    potential = sum(k in 0..2: mass * 9.81 * y[k]),
    constraint(pin_x[k in 0..2]: x[k] - right[k] == sum(i in 0..k: x[i] + right[i])),
    constraint(pin_y[k in 0..2]: y[k] + down[k] == sum(i in 0..k: y[i] - down[i])),
    friction(rub[k in 0..2] on (pin_x[k], pin_y[k]): slip = radius * turn[k], static = mu),
    contact(wall: x[1] + right[1] <= far, restitution = 0.6),
    start(hanging: y[0] = -length/2, y[1] = -3*length/2, theta[0] = 0, der(theta[0]) = rate, der(theta[1]) = 2*rate,
        der(x[0]) = length/2 * rate, der(x[1]) = 2*length * rate),
)]
struct Bars<T = f64> {
    mass: T,
    length: T,
    radius: T,
    mu: T,
    far: T,
    rate: T,
}

/// Derivatives by friction, radius and start go through reversals and an impact, as differences of runs do.
#[test]
fn derivatives_go_through_bearings() {
    const NUMBERS: [f64; 3] = [0.3, 0.08, 3.0];
    let until = 1.2;
    let plain = |[mu, radius, rate]: [f64; 3]| {
        let bars = Bars {
            mass: 1.5,
            length: 0.6,
            radius,
            mu,
            far: 0.7,
            rate,
        };
        let trajectory = run(&bars, bars.at(<Bars>::HANGING), until);
        let times: Vec<f64> = trajectory.events().iter().map(|e| e.time).collect();
        (
            words(&trajectory),
            times,
            trajectory.final_state().q.clone(),
        )
    };
    let [mu, radius, rate] = [0, 1, 2].map(|k| Slopes::variable(NUMBERS[k], k));
    let bars = Bars {
        mass: Slopes::constant(1.5),
        length: Slopes::constant(0.6),
        radius,
        mu,
        far: Slopes::constant(0.7),
        rate,
    };
    let simulation = Simulation::new(&bars).tolerance(1e-12);
    let dual = simulation
        .run(bars.at(<Bars>::HANGING), 0.0..until)
        .expect("runs");
    let (names, times, _) = plain(NUMBERS);
    println!("{names:?} {times:?}");
    assert!(names.iter().any(|name| name == "wall impact"), "{names:?}");
    assert!(
        names.iter().any(|name| name.ends_with("reverses")),
        "{names:?}"
    );
    for k in 0..3 {
        let h = 1e-5 * NUMBERS[k];
        let at = |step: f64| {
            let mut numbers = NUMBERS;
            numbers[k] += step * h;
            let (others, times, q) = plain(numbers);
            assert_eq!(names, others);
            [times, q].concat()
        };
        // Of order four.
        let sides = [at(-2.0), at(-1.0), at(1.0), at(2.0)];
        let events = dual.events().iter().map(|event| event.time.derivative[k]);
        let end = dual.final_state().q.iter().map(|q| q.derivative[k]);
        for (i, found) in events.chain(end).enumerate() {
            let [a, b, c, d] = [0, 1, 2, 3].map(|side: usize| sides[side][i]);
            let difference = (a - 8.0 * b + 8.0 * c - d) / (12.0 * h);
            agree(format!("{k}, {i}"), found, difference, 2e-5);
        }
    }
}

/// A bar on a journal, at rest beside a wall from which a motor pulls it away.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, theta),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + inertia/2 * der(theta)^2,
    potential = mass * gravity * y,
    force(motor: theta = torque - rate * t),
    constraint(pin_x: x == arm * sin(theta)),
    constraint(pin_y: y == -arm * cos(theta)),
    contact(wall: x <= 0),
    friction(journal on (pin_x, pin_y): slip = radius * der(theta), static = mu, kinetic = share * mu),
)]
struct Resting {
    mass: f64,
    inertia: f64,
    arm: f64,
    gravity: f64,
    radius: f64,
    mu: f64,
    share: f64,
    torque: f64,
    rate: f64,
}

/// What the wall presses would only load the journal in another direction: at last the friction of the weight alone holds the bar, to r μ m g.
#[test]
fn a_bar_beside_a_wall_slips_at_the_load_that_its_weight_gives() {
    for (method, tolerance) in methods_at(SINGLE_METHODS, TOLERANCES) {
        let mut random = Random::new(8);
        for case in 0..8 {
            let bar = Resting {
                mass: random.between(0.5, 3.0),
                inertia: random.between(0.05, 0.5),
                arm: random.between(0.2, 1.0),
                gravity: random.between(2.0, 12.0),
                radius: random.between(0.05, 0.4),
                mu: random.between(0.1, 0.9),
                share: [1.0, 0.99, 0.7][case % 3],
                torque: random.between(-0.5, 2.0),
                rate: random.between(0.5, 3.0),
            };
            let holds = bar.radius * bar.mu * bar.mass * bar.gravity;
            let torque = bar.torque.max(-0.5 * holds);
            let bar = Resting { torque, ..bar };
            let slips = (bar.torque + holds) / bar.rate;
            let start = state(&[0.0, -bar.arm, 0.0], &[0.0; 3]);
            let run = run_by(&bar, (method, tolerance), start, 1.05 * slips);
            let what = format!("{method} at {tolerance:e}, {case}");
            assert_eq!(
                times(&run, "journal", "slips").len(),
                1,
                "{what}: {:?}",
                words(&run)
            );
            agree(
                &what,
                event(&run, "journal", "slips").time,
                slips,
                100.0 * tolerance * slips.max(1.0),
            );
            certified(&what, &run);
        }
    }
}

/// On a helix the load does not depend on the friction, and from whichever speed it starts a bead slows down as it should.
#[test]
fn beads_of_any_mass_slide_on_a_helix() {
    let mut random = Random::new(4);
    for case in 0..200 {
        let helix = Helix {
            mass: random.between(0.5, 2.0),
            radius: random.between(0.1, 1.0),
            pitch: random.between(0.1, 1.0),
            gravity: random.between(0.5, 10.0),
            mu: random.between(0.2, 0.9),
        };
        let (c, speed) = (
            helix.radius / helix.radius.hypot(helix.pitch),
            random.between(0.5, 2.0),
        );
        let turn = speed * c / helix.radius;
        let start = state(
            &[helix.radius, 0.0, 0.0, 0.0],
            &[0.0, speed * c, helix.pitch * turn, turn],
        );
        let slow = |v: f64| {
            helix.mu * (v * v * c * c / helix.radius).hypot(helix.gravity * c)
                + helix.gravity * (1.0 - c * c).sqrt()
        };
        let end = 0.5 * speed;
        let time = lagrange_tests::integral(|more| 1.0 / slow(end + more), end, speed);
        let found = run(&helix, start, time).final_state().v[3] * helix.radius / c;
        agree(format!("{case}"), found, end, 1e-8);
    }
}
