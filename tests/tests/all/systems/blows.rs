//! Impacts while other contacts, frictions and constraints act, and impacts in turn.

use super::state;
use lagrange_core::prelude::*;
use lagrange_tests::{Random, agree, closure, event, run, words};

/// A block slides on the floor into a wall that leans over it by β.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    contact(floor: y >= 0),
    contact(wall: distance - x * cos(lean) - y * sin(lean) >= 0, restitution = e),
    friction(rub on floor: slip = der(x), static = mu),
)]
struct LeaningWall {
    mass: f64,
    gravity: f64,
    distance: f64,
    lean: f64,
    mu: f64,
    e: f64,
}

/// The wall presses the block onto the floor, where the impulse has its friction.
#[test]
fn a_contact_that_is_closed_takes_part_in_an_impact_with_its_friction() {
    let (mass, lean, mu, e) = (2.0, 0.4_f64, 0.3, 0.5);
    let scene = LeaningWall {
        mass,
        gravity: 9.81,
        distance: 1.0,
        lean,
        mu,
        e,
    };
    let trajectory = run(&scene, state(&[0.0, 0.0], &[4.0, 0.0]), 0.5);
    let hit = event(&trajectory, "wall", "impact");
    let v = (16.0_f64 - 2.0 * mu * 9.81 / lean.cos()).sqrt();
    agree("arrives with", hit.state.v[0], v, 1e-11);
    // It slides back: friction pushes forward. vx⁺ = −e vx, vy⁺ = 0.
    let blow = mass * (1.0 + e) * v / (lean.cos() - mu * lean.sin());
    agree("blow", hit.impulses[1], blow, 1e-11);
    agree("floor", hit.impulses[0], blow * lean.sin(), 1e-11);
    agree("friction", hit.impulses[2], mu * blow * lean.sin(), 1e-11);
    agree("leaves with", hit.state_after.v[0], -e * v, 1e-11);
    assert_eq!(hit.state_after.v[1], 0.0);
    assert!(hit.after.contacts[0] && !hit.after.contacts[1]);
    assert!(closure(&trajectory) < 1e-11);
}

#[test]
fn an_impact_at_the_first_instant_is_an_impact() {
    let scene = LeaningWall {
        mass: 1.0,
        gravity: 9.81,
        distance: 0.0,
        lean: 0.0,
        mu: 0.0,
        e: 0.25,
    };
    let trajectory = run(&scene, state(&[0.0, 0.0], &[2.0, 0.0]), 1.0);
    assert_eq!(words(&trajectory), ["wall impact", "rub reverses"]);
    assert_eq!(trajectory.events()[0].time, 0.0);
    agree("v", trajectory.final_state().v[0], -0.5, 1e-14);
    // At rest on the wall, or leaving it, nothing happens.
    for v in [0.0, -1.0] {
        let trajectory = run(&scene, state(&[0.0, 0.0], &[v, 0.0]), 1.0);
        let hits = words(&trajectory);
        assert!(!hits.iter().any(|w| w == "wall impact"), "{hits:?}");
        agree("v", trajectory.final_state().v[0], v, 1e-14);
    }
}

/// A bead on a rough straight wire flies against an inclined plate.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    constraint(wire: y == 0),
    contact(plate: distance - x * cos(lean) - y * sin(lean) >= 0, restitution = e),
    friction(rub on wire: slip = der(x), static = mu),
)]
struct BeadAndPlate {
    mass: f64,
    distance: f64,
    lean: f64,
    mu: f64,
    e: f64,
}

#[test]
fn friction_on_a_constraint_acts_in_an_impact_whichever_side_presses() {
    for lean in [0.4_f64, -0.4] {
        let (mass, mu, e) = (2.0, 0.3, 0.5);
        let scene = BeadAndPlate {
            mass,
            distance: 1.0,
            lean,
            mu,
            e,
        };
        let trajectory = run(&scene, state(&[0.0, 0.0], &[4.0, 0.0]), 0.5);
        let hit = event(&trajectory, "plate", "impact");
        let blow = mass * (1.0 + e) * 4.0 / (lean.cos() - mu * lean.sin().abs());
        agree("blow", hit.impulses[1], blow, 1e-13);
        agree("wire", hit.impulses[0], blow * lean.sin(), 1e-13);
        agree(
            "friction",
            hit.impulses[2],
            mu * blow * lean.sin().abs(),
            1e-13,
        );
        agree("leaves with", hit.state_after.v[0], -2.0, 1e-13);
        assert!(closure(&trajectory) < 1e-12);
    }
}

/// A block that a clamp holds, struck by a ball.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, ball),
    kinetic = mass/2 * der(x)^2 + light/2 * der(ball)^2,
    contact(face: x >= ball, restitution = e),
    friction(clamp: slip = der(x), limit = (hold, drag)),
)]
struct Clamped {
    mass: f64,
    light: f64,
    e: f64,
    hold: f64,
    drag: f64,
}

/// A finite force does nothing in no time: the block moves off and is then braked.
#[test]
fn a_friction_of_given_limit_slips_after_a_blow() {
    let scene = Clamped {
        mass: 2.0,
        light: 0.5,
        e: 0.5,
        hold: 8.0,
        drag: 3.0,
    };
    let trajectory = run(&scene, state(&[0.0, -1.0], &[0.0, 4.0]), 2.0);
    let v = 0.5 * 1.5 * 4.0 / 2.5;
    let hit = event(&trajectory, "face", "impact");
    agree("block", hit.state_after.v[0], v, 1e-14);
    assert_eq!(
        words(&trajectory),
        ["face impact", "clamp slips", "clamp sticks"]
    );
    let stop = event(&trajectory, "clamp", "sticks");
    agree("stops", stop.time, 0.25 + v * 2.0 / 3.0, 1e-11);
    agree("after", stop.state.q[0], v * v * 2.0 / 6.0, 1e-11);
    assert!(closure(&trajectory) < 1e-11);
}

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

#[test]
fn slip_with_two_components_slides_along_what_is_left_of_it_or_stops() {
    let mut random = Random::new(12);
    let (mut slid, mut stuck) = (0, 0);
    for k in 0..100 {
        let isotropic = k % 2 == 0;
        let first = random.between(0.05, 0.5);
        let scene = Lander {
            mass: 1.5,
            first,
            second: if isotropic {
                first
            } else {
                random.between(0.05, 0.5)
            },
            radius: 0.6,
            gravity: 9.81,
            e: random.between(0.1, 0.9),
            mu_static: 0.12,
            mu_kinetic: 0.09,
        };
        let v: Vec<f64> = (0..5).map(|_| random.between(-3.0, 3.0)).collect();
        let start = state(&[0.0, 0.0, 0.05, 0.0, 0.0], &[v[0], v[1], -2.0, v[3], v[4]]);
        let trajectory = run(&scene, start, 0.04);
        let hit = event(&trajectory, "floor", "impact");
        let slip = |s: &State<f64>| {
            [
                s.v[0] - scene.radius * s.v[3],
                s.v[1] - scene.radius * s.v[4],
            ]
        };
        let (before, after) = (slip(&hit.state), slip(&hit.state_after));
        let arrival = -hit.state.v[2];
        let normal = scene.mass * (1.0 + scene.e) * arrival;
        agree("normal", hit.impulses[0], normal, 1e-12);
        // Compliance of each direction.
        let g = [scene.first, scene.second].map(|i| 1.0 / scene.mass + scene.radius.powi(2) / i);
        let stop = [-before[0] / g[0], -before[1] / g[1]];
        let impulse = [hit.impulses[1], hit.impulses[2]];
        if stop[0].hypot(stop[1]) <= scene.mu_static * normal {
            stuck += 1;
            for k in 0..2 {
                agree("stops", impulse[k], stop[k], 1e-12);
                assert!(after[k].abs() < 1e-13);
            }
            continue;
        }
        slid += 1;
        let speed = after[0].hypot(after[1]);
        for k in 0..2 {
            let along = after[k] / speed;
            agree(
                "slides",
                impulse[k],
                -scene.mu_kinetic * normal * along,
                1e-12,
            );
            agree("slip", after[k], before[k] + g[k] * impulse[k], 1e-12);
        }
        if isotropic {
            let turn = before[0] * after[1] - before[1] * after[0];
            assert!(turn.abs() < 1e-12);
        }
        assert!(closure(&trajectory) < 1e-11);
    }
    assert!(slid > 30 && stuck > 15, "{slid} {stuck}");
}

/// Balls on a line.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x[5]),
    kinetic = sum(i in 0..5: mass/2 * der(x[i])^2),
    contact(pair[k in 0..4]: x[k+1] - x[k] >= 0, restitution = e),
    impacts = in_turn,
)]
struct Row {
    mass: f64,
    e: f64,
}

#[test]
fn in_turn_as_many_balls_leave_a_cradle_as_come() {
    for released in 1..=3 {
        let scene = Row { mass: 0.2, e: 1.0 };
        let x: Vec<f64> = (0..5)
            .map(|i| if i < released { -1.0 } else { 0.0 })
            .collect();
        let v: Vec<f64> = (0..5)
            .map(|i| if i < released { 1.5 } else { 0.0 })
            .collect();
        let trajectory = run(&scene, state(&x, &v), 2.0);
        for (i, v) in trajectory.final_state().v.iter().enumerate() {
            let expected = if i >= 5 - released { 1.5 } else { 0.0 };
            agree("v", *v, expected, 1e-14);
        }
        assert!(closure(&trajectory) < 1e-14);
    }
    // A simulation may say otherwise: the last four then move as one.
    let scene = Row { mass: 0.2, e: 1.0 };
    let start = state(&[-1.0, 0.0, 0.0, 0.0, 0.0], &[1.0, 0.0, 0.0, 0.0, 0.0]);
    let together = Simulation::new(&scene)
        .impacts(Impacts::Together)
        .run(start, 0.0..2.0)
        .expect("a run");
    for (i, v) in together.final_state().v.iter().enumerate() {
        agree("v", *v, if i == 0 { -0.6 } else { 0.4 }, 1e-14);
    }
}

/// Two balls of mass 1 : 3 fall together; with e = 1 the heavy one bounces first and stays down.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(low, high),
    kinetic = heavy/2 * der(low)^2 + light/2 * der(high)^2,
    potential = gravity * (heavy * low + light * high),
    contact(floor: low >= 0, restitution = e),
    contact(pair: high >= low, restitution = e),
    impacts = in_turn,
)]
struct Stack {
    heavy: f64,
    light: f64,
    gravity: f64,
    e: f64,
}

#[test]
fn a_light_ball_on_a_heavy_one_takes_all_the_energy() {
    let scene = Stack {
        heavy: 3.0,
        light: 1.0,
        gravity: 9.81,
        e: 1.0,
    };
    let trajectory = run(&scene, state(&[0.5, 0.5], &[0.0, 0.0]), 0.6);
    let v = (9.81_f64).sqrt();
    let hit = event(&trajectory, "floor", "impact");
    // The floor turns the heavy ball round, then it meets the light one: 0 and twice the speed.
    agree("heavy", hit.state_after.v[0], 0.0, 1e-12);
    agree("light", hit.state_after.v[1], 2.0 * v, 1e-12);
    assert!(closure(&trajectory) < 1e-12);
}

#[test]
fn two_balls_on_each_other_come_to_rest() {
    for (e, impacts) in [
        (0.5, Impacts::Together),
        (0.5, Impacts::InTurn),
        (0.7, Impacts::Together),
    ] {
        let scene = Stack {
            heavy: 1.0,
            light: 0.7,
            gravity: 9.81,
            e,
        };
        let trajectory = Simulation::new(&scene)
            .tolerance(1e-12)
            .impacts(impacts)
            .run(state(&[0.5, 0.9], &[0.0, 0.0]), 0.0..8.0)
            .unwrap_or_else(|f| panic!("{f}"));
        assert_eq!(trajectory.final_mode().contacts, [true, true]);
        let end = trajectory.final_state();
        assert!(
            end.q.iter().chain(&end.v).all(|x| x.abs() < 1e-9),
            "{end:?}"
        );
        let lost = trajectory.ledger().expect("a ledger").end;
        assert!(lost.potential.abs() < 1e-8);
        assert!(closure(&trajectory) < 1e-9);
    }
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

/// Three supports under a beam that falls flat: more contacts than a plane needs.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(y, theta),
    kinetic = mass/2 * der(y)^2 + inertia/2 * der(theta)^2,
    potential = mass * gravity * y,
    contact(support[k in 0..3]: y + place[k] * sin(theta) >= 0, restitution = e),
)]
struct Beam {
    mass: f64,
    inertia: f64,
    gravity: f64,
    place: [f64; 3],
    e: f64,
}

#[test]
fn impulses_of_three_supports_are_shared_and_flagged() {
    let scene = Beam {
        mass: 3.0,
        inertia: 0.4,
        gravity: 9.81,
        place: [-1.0, 0.0, 1.0],
        e: 0.5,
    };
    let trajectory = run(&scene, state(&[0.2, 0.0], &[0.0, 0.0]), 0.3);
    let hits: Vec<_> = trajectory
        .events()
        .iter()
        .filter(|e| e.kind == EventKind::Impact)
        .collect();
    assert_eq!(hits.len(), 3, "{:?}", words(&trajectory));
    let v = (2.0_f64 * 9.81 * 0.2).sqrt();
    for hit in hits {
        assert!(hit.impulses_undetermined);
        // Least norm: a third each.
        for k in 0..3 {
            agree("share", hit.impulses[k], 1.5 * v, 1e-11);
        }
        agree("v", hit.state_after.v[0], 0.5 * v, 1e-11);
        assert!(hit.state_after.v[1].abs() < 1e-13);
    }
}

/// A ball dropped onto a belt that runs, over a floor that rises.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    contact(floor: y >= rise * t, restitution = e),
    friction(rub on floor: slip = der(x) - belt, static = mu),
)]
struct Belt {
    mass: f64,
    rise: f64,
    belt: f64,
    mu: f64,
    e: f64,
}

#[test]
fn surfaces_that_move_do_work_that_the_ledger_books() {
    let scene = Belt {
        mass: 0.7,
        rise: 0.5,
        belt: 3.0,
        mu: 0.2,
        e: 0.8,
    };
    let trajectory = run(&scene, state(&[0.0, 1.0], &[0.0, -2.0]), 1.0);
    let hit = event(&trajectory, "floor", "impact");
    agree("time", hit.time, 0.4, 1e-13);
    agree("up", hit.state_after.v[1], 0.5 + 0.8 * 2.5, 1e-13);
    agree("along", hit.state_after.v[0], 0.2 * 1.8 * 2.5, 1e-13);
    assert!(!hit.restitution_lowered);
    assert!(closure(&trajectory) < 1e-13);
}
