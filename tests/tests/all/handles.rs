//! Results by the handles of items are those at the places of their rows, and runs end after what handles name.

use super::systems::state;
use lagrange_core::prelude::*;
use lagrange_problems::scenes::MassOnWheel;
use lagrange_tests::{agree, closure};
use std::panic::{AssertUnwindSafe, catch_unwind};

type Wheel = MassOnWheel;

#[test]
fn a_run_tells_forces_and_states_by_handle() {
    let scene = Wheel::default();
    let simulation = Simulation::new(&scene).tolerance(1e-12);
    let trajectory = simulation
        .run(scene.at(Wheel::REST), 0.0..20.0)
        .expect("a run");
    let mut sampler = trajectory.sampler();
    // While stuck the equations of the wheel and of its rim tie the forces together.
    let now = sampler.at(2.0).expect("inside");
    assert!(now.mode.closed(Wheel::RIM) && now.mode.sticks(Wheel::GRIP));
    let (m, r, g) = (scene.mass, scene.radius, scene.gravity);
    let (s, c) = now.q(Wheel::THETA).sin_cos();
    let normal = m * (now.a(Wheel::X) * s + g * c - r * now.v(Wheel::THETA).powi(2));
    agree("N", now.force(Wheel::RIM), normal, 1e-11);
    let grip = m * (now.a(Wheel::X) * c + r * now.a(Wheel::THETA) - g * s);
    agree("F", now.force(Wheel::GRIP), grip, 1e-11);
    let rolling = (scene.wheel + m) * now.a(Wheel::X)
        + m * r * (now.a(Wheel::THETA) * c - now.v(Wheel::THETA).powi(2) * s);
    agree("λ", now.force(Wheel::ROLLING), rolling, 1e-11);
    agree("slip", now.slip(Wheel::GRIP), 0.0, 1e-12);
    agree("gap", now.gap(Wheel::RIM), 0.0, 1e-12);
    let left = scene.mu_static * normal - grip.abs();
    agree("margin", now.margin(Wheel::GRIP), left, 1e-11);
    agree("px", now.observe(Wheel::PX), now.q(Wheel::X) + r * s, 1e-12);
    let before = sampler.at(0.0).expect("the start").energy();
    agree("energy", now.energy(), before, 1e-11);

    let slips = &trajectory.events()[0];
    let (n, f) = (slips.force(Wheel::RIM), slips.force(Wheel::GRIP));
    agree("edge of the cone", f.abs(), scene.mu_static * n, 1e-10);
    let (n, f) = (
        slips.force_after(Wheel::RIM),
        slips.force_after(Wheel::GRIP),
    );
    agree("sliding", f.abs(), scene.mu_kinetic * n, 1e-10);
    assert_eq!(slips.friction_after(Wheel::GRIP), [f]);
    agree("θ̇", slips.v(Wheel::THETA), slips.v_after(Wheel::THETA), 0.0);
    assert_eq!(slips.impulse(Wheel::RIM), 0.0);
    assert!(slips.before.sticks(Wheel::GRIP) && slips.after.slips(Wheel::GRIP));
    let end = trajectory.final_state();
    agree(
        "floor",
        end.q(Wheel::R) * end.q(Wheel::THETA).cos(),
        -r,
        1e-11,
    );
}

/// What is known on both sides of an event, and at the ends, needs no record; the impact of a puck tells the sides apart.
#[test]
fn both_sides_of_an_event_and_both_ends_are_known_without_a_record() {
    let scene = Wheel::default();
    let start = scene.state().with_q(Wheel::R, scene.radius);
    let start = start.with_q(Wheel::THETA, scene.start_angle);
    let simulation = Simulation::new(&scene).tolerance(1e-12);
    let kept = simulation.run(&start, 0.0..20.0).expect("a run");
    let bare = simulation.record(false).run(&start, 0.0..20.0);
    let bare = bare.expect("a run");
    assert_eq!(bare.events(), kept.events());
    let mut sampler = bare.sampler();
    for event in bare.events() {
        let sides = [sampler.before(event), sampler.after(event)].map(|side| side.expect("known"));
        let px = event.q(Wheel::X) + event.q(Wheel::R) * event.q(Wheel::THETA).sin();
        let forces = [event.force(Wheel::GRIP), event.force_after(Wheel::GRIP)];
        for (side, force) in sides.iter().zip(forces) {
            agree("px", side.observe(Wheel::PX), px, 1e-13);
            agree("F", side.force(Wheel::GRIP), force, 1e-9);
        }
        assert_eq!(
            [&sides[0].mode, &sides[1].mode],
            [&event.before, &event.after]
        );
    }
    let last = kept.last_time();
    let [end, expected] = [&bare, &kept].map(|run| run.sampler().at(last).expect("the end"));
    agree(
        "R",
        end.force(Wheel::ROLLING),
        expected.force(Wheel::ROLLING),
        1e-12,
    );
    agree(
        "N",
        sampler.at(0.0).expect("the start").force(Wheel::RIM),
        kept.sampler().at(0.0).expect("the start").force(Wheel::RIM),
        1e-12,
    );
}

#[test]
fn numbers_are_shown_by_their_names() {
    let scene = Wheel::default();
    let run = Simulation::new(&scene).run(scene.at(Wheel::REST), 0.0..20.0);
    let run = run.expect("a run");
    let named = "State { x: 0.0, phi: 0.0, r: 0.5, theta: 0.05, der(x): 0.0, der(phi): 0.0, der(r): 0.0, der(theta): 0.0 }";
    assert_eq!(format!("{:?}", run.first_state()), named);
    assert_eq!(
        format!("{:?}", State::new(vec![1.0], vec![2.0])),
        "State { q: [1.0], v: [2.0] }"
    );
    let last = format!("{:?}", run.events().last().expect("an event"));
    assert!(
        last.contains("subject: floor, kind: Stop") && last.contains("der(theta): "),
        "{last}"
    );
    assert!(last.contains("forces: {rolling: "), "{last}");
    let now = format!("{:?}", run.sampler().at(1.0).expect("inside"));
    for part in [
        "mode: rim closed, grip sticks",
        "q: {x: ",
        "gaps: {rim: ",
        "observes: {px: ",
    ] {
        assert!(now.contains(part), "{now}");
    }
}

#[test]
fn runs_end_after_what_handles_name() {
    let scene = Wheel::default();
    let ends = |simulation: Simulation<'_, Wheel>| {
        let trajectory = simulation.run(scene.at(Wheel::REST), 0.0..20.0);
        let trajectory = trajectory.expect("a run");
        let last = trajectory.events().last().expect("an event").clone();
        (last.subject, last.kind)
    };
    let simulation = || Simulation::new(&scene);
    let slips = (Subject::from(Wheel::GRIP), EventKind::Slips);
    assert_eq!(ends(simulation().end_after(Wheel::GRIP)), slips);
    let lost = (Subject::from(Wheel::RIM), EventKind::Lost);
    assert_eq!(
        ends(simulation().end_after((Wheel::RIM, EventKind::Lost))),
        lost
    );
    let both = simulation().end_after(Wheel::RIM).end_after(Wheel::GRIP);
    assert_eq!(ends(both), lost);
    let floor = (Subject::from(Wheel::FLOOR), EventKind::Stop);
    assert_eq!(ends(simulation().end_after(Wheel::FLOOR)), floor);
}

/// The wheel has four coordinates, a friction and a stop, the ball one coordinate and neither of the others: handles of the wheel that name nothing of the ball are told.
#[test]
fn a_handle_of_another_system_is_refused() {
    let ball = Ball {
        gravity: 9.81,
        bounce: 0.5,
    };
    let run = Simulation::new(&ball).run(ball.at(Ball::HELD), 0.0..0.1);
    let run = run.expect("a run");
    let ask: [(&str, &dyn Fn()); 4] = [
        ("coordinate 3 among 1", &|| {
            run.final_state().q(Wheel::THETA);
        }),
        ("coordinate 3 among 1", &|| {
            let _ = ball.state().with_v(Wheel::THETA, 1.0);
        }),
        ("friction 0 among 0", &|| {
            let now = run.sampler().at(0.0).expect("the start");
            now.force(Wheel::GRIP);
        }),
        ("start 1 among 1", &|| {
            ball.at(StartId(1));
        }),
    ];
    for (what, ask) in ask {
        let told = catch_unwind(AssertUnwindSafe(ask)).expect_err("a panic");
        let told = told.downcast::<String>().expect("a sentence");
        let expected =
            format!("there is no {what}, counted from 0: this handle is one of another system");
        assert_eq!(*told, expected);
    }
    let refused = |simulation: Simulation<'_, Ball>| {
        let outcome = simulation.run(ball.at(Ball::HELD), 0.0..0.1);
        let error = outcome.expect_err("no such item").error;
        assert!(
            matches!(error, Error::Argument { value: 0.0, .. }),
            "{error}"
        );
    };
    refused(Simulation::new(&ball).effects(Effects::all().without(Wheel::GRIP)));
    refused(Simulation::new(&ball).end_after(Wheel::FLOOR));
    // What is left out has no events, a floor does not slip, and there is no event number 0.
    let without = Simulation::new(&ball).effects(Effects::all().without(Ball::FLOOR));
    refused(without.end_after(Ball::FLOOR));
    refused(Simulation::new(&ball).end_after((Ball::FLOOR, EventKind::Slips)));
    refused(Simulation::new(&ball).end_after((Ball::FLOOR, EventKind::Impact, 0)));
}

/// A ball that bounces.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(y),
    kinetic = der(y)^2/2,
    potential = gravity * y,
    contact(floor: y >= 0, restitution = bounce),
    start(held: y = 1),
)]
struct Ball {
    gravity: f64,
    bounce: f64,
}

/// Impact n comes after a fall √(2/g) and n − 1 flights, each as long as the one before times e and the first 2 e falls; also where
/// the run is told in pieces.
#[test]
fn runs_end_after_the_nth_event_of_a_kind() {
    let ball = Ball {
        gravity: 9.81,
        bounce: 0.8,
    };
    let fall = (2.0 / ball.gravity).sqrt();
    // Of a parabola a Runge–Kutta method makes no error, and short steps make many pieces.
    let steps: Method = "rk4:0.01".parse().expect("a method");
    for number in [1, 2, 7] {
        let simulation = Simulation::new(&ball).method(steps).end_after((
            Ball::FLOOR,
            EventKind::Impact,
            number,
        ));
        let run = simulation.run(ball.at(Ball::HELD), 0.0..20.0);
        let run = run.expect("a run");
        let flights: f64 = (1..number as i32).map(|k| 2.0 * ball.bounce.powi(k)).sum();
        let time = fall * (1.0 + flights);
        assert!((run.last_time() - time).abs() < 1e-9, "{number}");
        assert_eq!(run.events().len(), number);
        let mut runner = simulation.runner();
        let (mut events, mut pieces) = (0, 1);
        let outcome = runner.run_in_pieces(ball.at(Ball::HELD), 0.0..20.0, 1, |piece| {
            (events, pieces) = (events + piece.events().len(), pieces + 1);
        });
        outcome.expect("a run");
        let last = runner.trajectory();
        assert_eq!(events + last.events().len(), number);
        assert_eq!(last.last_time(), run.last_time());
        assert!(pieces > number);
    }
}

/// A puck that slides over a table while it is pushed down, and hits a wall.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, z),
    kinetic = mass/2 * (der(x)^2 + der(y)^2 + der(z)^2),
    force(load: z = -push),
    contact(wall: 1 >= x, restitution = bounce),
    contact(table: z >= 0),
    friction(rub on table: slip = (der(x), der(y)), static = mu),
)]
struct Puck {
    mass: f64,
    push: f64,
    mu: f64,
    bounce: f64,
}

#[test]
fn friction_in_space_loads_and_impulses_have_handles() {
    let scene = Puck {
        mass: 0.5,
        push: 2.0,
        mu: 0.3,
        bounce: 0.8,
    };
    let trajectory = Simulation::new(&scene)
        .tolerance(1e-12)
        .run(state(&[0.0; 3], &[3.0, 4.0, 0.0]), 0.0..0.5)
        .expect("a run");
    let now = trajectory.sampler().at(0.1).expect("inside");
    agree("load", now.load(Puck::LOAD), -2.0, 1e-14);
    agree("N", now.force(Puck::TABLE), 2.0, 1e-12);
    let speed = now.v(Puck::X).hypot(now.v(Puck::Y));
    let [along, across] = *now.friction(Puck::RUB) else {
        panic!("two components")
    };
    agree("along", along, -0.6 * now.v(Puck::X) / speed, 1e-12);
    agree("across", across, -0.6 * now.v(Puck::Y) / speed, 1e-12);
    agree("margin", now.margin(Puck::RUB), 0.0, 1e-12);
    agree("slip", now.slip(Puck::RUB), now.v(Puck::X), 1e-14);
    let impact = &trajectory.events()[0];
    agree(
        "rebound",
        impact.v_after(Puck::X),
        -0.8 * impact.v(Puck::X),
        1e-12,
    );
    agree(
        "impulse",
        impact.impulse(Puck::WALL),
        0.5 * 1.8 * impact.v(Puck::X),
        1e-12,
    );
    assert!(closure(&trajectory) < 1e-11);
}

/// A block on a floor whose gap is told in units of 0.2 m; a rod leans on it with its normal force.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y),
    kinetic = mass/2 * (der(x)^2 + der(y)^2),
    potential = mass * gravity * y,
    contact(floor: 5*y >= 0 at (x, y)),
    force(lean: x = floor/3),
    observe(normal = floor),
    start(put),
)]
struct Block {
    mass: f64,
    gravity: f64,
}

/// With `at`, the name of a contact is N wherever it is written, as friction takes it; results tell the multiplier of the gap, N/|∂gap/∂p|.
#[test]
fn a_contact_at_a_point_is_called_by_its_normal_force() {
    let block = Block {
        mass: 2.0,
        gravity: 10.0,
    };
    let run = Simulation::new(&block).run(block.at(Block::PUT), 0.0..1.0);
    let end = run.expect("a run").sampler().at(1.0).expect("the end");
    agree("N", end.observe(Block::NORMAL), 20.0, 1e-14);
    agree("lean", end.load(Block::LEAN), 20.0 / 3.0, 1e-14);
    agree("x", end.q(Block::X), 20.0 / 3.0 / 2.0 / 2.0, 1e-13);
    agree("λ", end.force(Block::FLOOR), 4.0, 1e-14);
}

/// A sledge on a floor; what pulls another mass, which a brake holds back, grows with its weight.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, u),
    kinetic = mass/2 * (der(x)^2 + der(y)^2) + other/2 * der(u)^2,
    potential = mass * gravity * y,
    contact(floor: y >= 0),
    friction(rub on floor: slip = der(x), static = mu),
    friction(brake: slip = der(u), limit = hold),
    force(pull: u = share * floor),
    start(go: der(x) = 1, der(u) = 2),
)]
struct Sledge {
    mass: f64,
    other: f64,
    gravity: f64,
    mu: f64,
    hold: f64,
    share: f64,
}

/// M v̇ = f + Aᵀ λ + c, with c of the frictions that slip and of the pull by hand, before and after the sledge has come to rest at 1/(μ g).
#[test]
fn the_matrices_of_an_instant_make_its_accelerations() {
    for [mu, hold, share] in [[0.3, 1.5, 0.2], [0.7, 2.0, 0.4]] {
        let sledge = Sledge {
            mass: 1.4,
            other: 0.6,
            gravity: 9.81,
            mu,
            hold,
            share,
        };
        let run = Simulation::new(&sledge).run(sledge.at(Sledge::GO), 0.0..1.0);
        let run = run.expect("a run");
        let mut sampler = run.sampler();
        let weight = 1.4 * 9.81;
        for (t, rubs, rows) in [(0.05, -mu * weight, 1), (0.9, 0.0, 2)] {
            let now = sampler.at(t).expect("inside");
            let equations = sampler.dynamics();
            let coupled = equations.coupled_forces();
            agree("rub", coupled[0], rubs, 1e-12);
            agree("floor", coupled[1], 0.0, 1e-12);
            agree("pull and brake", coupled[2], share * weight - hold, 1e-12);
            let acting = equations.constraint_jacobian();
            assert_eq!(acting.nrows(), rows);
            let forces = equations.forcing() + acting.transpose() * equations.multipliers();
            let inertial = equations.mass_matrix() * now.accelerations();
            assert!((inertial - forces - coupled).norm() < 1e-12);
            agree("u", now.a(Sledge::U), (share * weight - hold) / 0.6, 1e-12);
        }
    }
}
