//! A runner gives what single runs give, run after run; without recording the events stay.

use lagrange_core::prelude::*;
use lagrange_problems::scenes::hard::{
    BeltOscillator, CueBall, HoopBead, InclineBlock, TurningPush,
};
use lagrange_problems::scenes::*;
use lagrange_tests::agree;

/// Runs a scene from its first start in a new simulation.
fn single<S: Derived<Scalar = f64>>(
    scene: &S,
    tolerance: f64,
    until: f64,
) -> Trajectory<S::Scalar> {
    let run = Simulation::new(scene)
        .tolerance(tolerance)
        .run(start(scene), 0.0..until);
    match run {
        Ok(trajectory) => trajectory,
        Err(failure) => panic!("{failure}"),
    }
}

fn start<S: Derived<Scalar = f64>>(scene: &S) -> State<f64> {
    let n = S::DESCRIPTION.coordinates.len();
    let mut state = State::new(vec![0.0; n], vec![0.0; n]);
    scene.start(0, 0.0, &mut state.q, &mut state.v);
    state
}

fn assert_same(one: &Trajectory, other: &Trajectory) {
    assert_eq!(one.events(), other.events());
    assert_eq!(one.final_state(), other.final_state());
    assert_eq!(one.last_time(), other.last_time());
    assert_eq!(one.work().steps, other.work().steps);
    assert_eq!(one.phases().len(), other.phases().len());
    for (one, other) in one.phases().iter().zip(&other.phases()) {
        assert_eq!(one.mode, other.mode);
        assert!((one.from - other.from).abs() + (one.to - other.to).abs() < 1e-14);
    }
}

fn check<S: Derived<Scalar = f64>>(scene: &S) {
    let long = single(scene, 1e-9, 20.0);
    let short = single(scene, 1e-9, 1.0);
    let simulation = Simulation::new(scene).tolerance(1e-9);
    for record in [true, false] {
        let mut runner = simulation.clone().record(record).runner();
        for (until, expected) in [(20.0, &long), (1.0, &short), (20.0, &long)] {
            let trajectory = runner.run(&start(scene), 0.0..until).expect("runs");
            assert_same(trajectory, expected);
        }
    }
}

#[test]
fn every_run_of_a_runner_is_that_of_a_new_simulation() {
    check(&MassOnShell::default());
    check(&RollingSphere::default());
    check(&RollingSlippingSphere::default());
    check(&MassOnWheel::default());
    check(&SphereInBowl::default());
    check(&InclineBlock::default());
    check(&CueBall::default());
    check(&TurningPush::default());
    check(&HoopBead::default());
}

#[test]
fn another_scene_in_the_same_runner_is_that_scene() {
    let mut scene = RollingSlippingSphere::default();
    let mut runner = Simulation::new(&scene).tolerance(1e-9).runner();
    for mu in [0.4, 0.6, 0.9, 0.4] {
        scene.mu_static = mu;
        runner.set_scene(&scene);
        assert_eq!(runner.scene().mu_static, mu);
        let trajectory = runner.run(start(&scene), 0.0..20.0).expect("runs");
        assert_same(trajectory, &single(&scene, 1e-9, 20.0));
    }
}

/// A sled on three feet slides to rest and is pushed ever harder.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, phi),
    kinetic = (der(x)^2 + der(y)^2) / 2 + der(phi)^2 / 8,
    potential = gravity * y,
    contact(rear: y - 0.4 * sin(phi) >= 0.2),
    contact(middle: y >= 0.2),
    contact(front: y + 0.4 * sin(phi) >= 0.2),
    friction(rear_grip on rear: slip = der(x), static = mu),
    friction(middle_grip on middle: slip = der(x), static = 1.4 * mu),
    friction(front_grip on front: slip = der(x), static = 0.6 * mu),
    force(hand: (push * t, 0) at (x, y + 0.1)),
    start(slides: y = 0.2, der(x) = 1.2),
)]
struct ThreeFeet {
    gravity: f64,
    mu: f64,
    push: f64,
}

/// A run that comes to rest and slips again, after one in which the same sled was a hundred times heavier.
#[test]
fn loads_of_an_earlier_run_are_forgotten() {
    let heavy = ThreeFeet {
        gravity: 900.0,
        mu: 0.3,
        push: 4.0,
    };
    let mut runner = Simulation::new(&heavy).runner();
    for k in 0..20 {
        let light = ThreeFeet {
            gravity: 10.4 + 0.04 * f64::from(k),
            mu: 0.344 + 0.001 * f64::from(k),
            push: 5.3 + 0.02 * f64::from(k),
        };
        runner.set_scene(&heavy);
        let first = runner.run(heavy.at(ThreeFeet::SLIDES), 0.0..2.0);
        first.expect("runs");
        runner.set_scene(&light);
        let slides = light.at(ThreeFeet::SLIDES);
        let alone = Simulation::new(&light).run(&slides, 0.0..2.0);
        let again = runner.run(&slides, 0.0..2.0).expect("runs");
        assert_same(again, &alone.expect("runs"));
    }
}

/// Two bobs on rods in the plane.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x[2], y[2]),
    kinetic = (der(x[0])^2 + der(y[0])^2 + der(x[1])^2 + der(y[1])^2) / 2,
    potential = 10 * (y[0] + y[1]),
    constraint(upper: x[0]^2 + y[0]^2 == upper_length^2),
    constraint(lower: (x[1] - x[0])^2 + (y[1] - y[0])^2 == lower_length^2),
    start(level: x[0] = upper_length, x[1] = upper_length + lower_length),
)]
struct Bobs {
    upper_length: f64,
    lower_length: f64,
}

/// Rows that depend on others in one run are independent in the next: a rod of length zero holds nothing.
#[test]
fn rows_aside_in_an_earlier_run_are_forgotten() {
    let none = Bobs {
        upper_length: 1.0,
        lower_length: 0.0,
    };
    let mut runner = Simulation::new(&none).runner();
    let refused = runner.run(none.at(Bobs::LEVEL), 0.0..5.0);
    refused.expect_err("no force can keep the length of that rod");
    for k in 0..12 {
        let bobs = Bobs {
            upper_length: 0.3 + 0.05 * f64::from(k),
            lower_length: 1.0 + 0.1 * f64::from(k),
        };
        runner.set_scene(&bobs);
        let level = bobs.at(Bobs::LEVEL);
        let alone = Simulation::new(&bobs).run(&level, 0.0..5.0);
        let again = runner.run(&level, 0.0..5.0).expect("runs");
        assert_same(again, &alone.expect("runs"));
    }
}

/// What a sampler finds at instants in a mixed order is what a new one finds at each.
fn assert_alike_in_any_order(run: &Trajectory) {
    let mut reused = run.sampler();
    for part in (0..=25).map(|k| 7 * k % 26) {
        let time = run.last_time() * f64::from(part) / 25.0;
        let [again, alone] = [&mut reused, &mut run.sampler()].map(|sampler| {
            let Instant { forces, held, .. } = sampler.at(time).expect("recorded");
            (forces, held)
        });
        assert_eq!(again, alone, "at {time}");
    }
}

/// Forces of the feet are shared as they are at an instant, whatever else was looked at before.
#[test]
fn samples_do_not_depend_on_one_another() {
    let sled = ThreeFeet {
        gravity: 10.4,
        mu: 0.344,
        push: 5.3,
    };
    let run = Simulation::new(&sled).run(sled.at(ThreeFeet::SLIDES), 0.0..2.5);
    assert_alike_in_any_order(&run.expect("runs"));
}

/// A pendulum on a rough pin.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    emit = data,
    coordinates(x, y, theta),
    kinetic = (der(x)^2 + der(y)^2) / 2 + inertia/2 * der(theta)^2,
    potential = 9.81 * y,
    constraint(pin_x: x == sin(theta)),
    constraint(pin_y: y == -cos(theta)),
    friction(pin on (pin_x, pin_y): slip = radius * der(theta), static = mu),
    start(spun: y = -1, der(x) = 9, der(theta) = 9),
)]
struct RoughPin {
    inertia: f64,
    radius: f64,
    mu: f64,
}

/// The direction of the load on a pin follows from the friction that it causes, and is looked for at each instant anew.
#[test]
fn samples_of_a_load_do_not_depend_on_one_another() {
    for mu in [0.1, 0.4, 0.7] {
        let pin = RoughPin {
            inertia: 0.4,
            radius: 0.3,
            mu,
        };
        let run = Simulation::new(&pin).run(pin.at(RoughPin::SPUN), 0.0..2.0);
        assert_alike_in_any_order(&run.expect("runs"));
    }
}

#[test]
fn what_was_not_recorded_is_refused() {
    let scene = MassOnShell::default();
    let run = Simulation::new(&scene)
        .record(false)
        .run(start(&scene), 0.0..20.0);
    let trajectory = run.expect("runs");
    assert!(matches!(
        trajectory.sampler().at(0.5),
        Err(Error::NotRecorded)
    ));
    assert!(matches!(trajectory.ledger(), Err(Error::NotRecorded)));
    assert_eq!(
        Error::NotRecorded.to_string(),
        "the run kept its events and its ends only; leave `record(false)` out"
    );
}

#[test]
fn the_end_is_the_same_whether_the_run_is_recorded_or_not() {
    fn check<S: Derived<Scalar = f64>>(scene: &S, until: f64) {
        for method in ["taylor", "dop853", "radau5"] {
            let simulation = Simulation::new(scene).method(method.parse().expect("a method"));
            let ends = [true, false].map(|record| {
                let run = simulation
                    .clone()
                    .record(record)
                    .run(start(scene), 0.0..until);
                let run = run.expect("runs");
                let end = run.sampler().at(run.last_time()).expect("the end");
                (end.state, end.mode, end.acceleration, end.forces)
            });
            assert_eq!(ends[0], ends[1], "{method}");
        }
    }
    check(&CartesianPendulum::default(), 3.0);
    check(&MassOnWheel::default(), 2.0);
    check(&MassOnWheel::default(), 20.0);
    check(&DoublePendulum::default(), 5.0);
}

/// A ball with spin that is thrown onto the floor that it lies on, and slips on it then.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x, y, phi),
    kinetic = der(x)^2 / 2 + der(y)^2 / 2 + radius^2 / 5 * der(phi)^2,
    potential = gravity * y,
    contact(floor: y >= radius, restitution = 0.4),
    friction(grip on floor: slip = der(x) - radius * der(phi), static = 0.1),
    start(thrown: y = radius, der(x) = 2, der(y) = -1),
    start(slides: y = radius, der(x) = -2),
)]
struct ThrownBall {
    gravity: f64,
    radius: f64,
}

/// What happens at the start is over then: the floor has thrown the ball up, and one that slides is braked by μ g, as closed forms have it.
#[test]
fn the_start_is_the_same_whether_the_run_is_recorded_or_not() {
    let ball = ThrownBall {
        gravity: 9.81,
        radius: 0.2,
    };
    for method in ["taylor", "dop853", "radau5"] {
        for record in [true, false] {
            let simulation = Simulation::new(&ball).method(method.parse().expect("a method"));
            let simulation = simulation.record(record);
            let first = |start| {
                let run = simulation.run(ball.at(start), 0.0..0.05).expect("runs");
                run.sampler().at(0.0).expect("the start")
            };
            let thrown = first(ThrownBall::THROWN);
            // Of the impulse 1 + 0.4 the share 0.1 turns the ball by its moment of inertia 2/5 r².
            agree("x", thrown.state.v[0], 2.0 - 0.14, 1e-12);
            agree("y", thrown.state.v[1], 0.4, 1e-12);
            agree("phi", thrown.state.v[2], 0.14 * 2.5 / 0.2, 1e-12);
            agree("fall", thrown.acceleration[1], -9.81, 1e-12);
            assert!(!thrown.mode.contacts[0]);
            let slides = first(ThrownBall::SLIDES);
            assert_eq!(slides.state.v, [-2.0, 0.0, 0.0]);
            agree("brakes", slides.acceleration[0], 0.981, 1e-12);
            agree("spins", slides.acceleration[2], -0.981 * 2.5 / 0.2, 1e-12);
        }
    }
}

/// A time that is never reached resolves nothing: methods keep their steps, and guards that bend are followed as closely.
#[test]
fn the_motion_does_not_depend_on_an_end_far_away() {
    let scene = MassOnWheel::default();
    for method in ["auto", "taylor", "dop853", "verner98", "dopri5", "radau5"] {
        let simulation = Simulation::new(&scene)
            .method(method.parse().expect("a method"))
            .end_after(<MassOnWheel>::RIM);
        let [near, far] = [20.0, 1e13].map(|end| {
            let run = simulation.clone().run(start(&scene), 0.0..end);
            run.unwrap_or_else(|failure| panic!("{method} until {end}: {failure}"))
        });
        assert_eq!(near.events().len(), far.events().len(), "{method}");
        assert_eq!(near.work(), far.work(), "{method}");
        let [a, b] = [near.last_time(), far.last_time()];
        assert!((a / b - 1.0).abs() < 1e-14, "{method}: {a} or {b}");
    }
}

#[test]
fn an_error_leaves_the_motion_until_then() {
    let scene = MassOnShell::default();
    let mut runner = Simulation::new(&scene).max_steps(3).runner();
    let outcome = runner.run(start(&scene), 0.0..20.0).map(|_| ());
    assert!(matches!(outcome, Err(Error::Limit { what: "steps", .. })));
    assert_eq!(runner.trajectory().work().steps, 3);
    assert!(runner.trajectory().last_time() > 0.0);
    assert!(runner.trajectory().sampler().at(0.01).is_ok());
}

/// Events stay the same ones, however loose the tolerance that they can be told apart at.
#[test]
fn loose_tolerances_find_the_same_events() {
    fn names<S: Derived<Scalar = f64>>(
        scene: &S,
        tolerance: f64,
    ) -> Vec<(&'static str, EventKind)> {
        let trajectory = single(scene, tolerance, 20.0);
        let events = trajectory.events().iter();
        events
            .map(|e| (e.subject.name(S::DESCRIPTION), e.kind))
            .collect()
    }
    fn check<S: Derived<Scalar = f64>>(scene: &S) {
        let expected = names(scene, 1e-12);
        for k in 0..24 {
            let tolerance = 10f64.powf(-1.5 - 0.125 * f64::from(k));
            assert_eq!(names(scene, tolerance), expected, "at {tolerance:e}");
        }
    }
    check(&MassOnShell::default());
    check(&RollingSphere::default());
    check(&RollingSlippingSphere::default());
    check(&MassOnWheel::default());
}

#[test]
fn pieces_follow_each_other() {
    let scene = BeltOscillator::default();
    let simulation = Simulation::new(&scene);
    let whole = simulation.run(start(&scene), 0.0..20.0).expect("a run");
    let mut runner = simulation.runner();
    let (mut pieces, mut events, mut last) = (0, 0, 0.0);
    let taken = runner.run_in_pieces(start(&scene), 0.0..20.0, 3000, |piece| {
        assert_eq!(piece.first_time(), last);
        assert!(piece.verify(pieces).expect("recorded").holds());
        (pieces, last) = (pieces + 1, piece.last_time());
        events += piece.events().len();
    });
    taken.expect("a run");
    let end = runner.trajectory();
    assert_eq!(end.first_time(), last);
    assert_eq!(events + end.events().len(), whole.events().len());
    assert_eq!(end.final_state(), whole.final_state());
    assert_eq!(end.work(), whole.work());
    assert!(pieces > 5, "{pieces} pieces");
}

/// A mark is passed half-way to a stop, with the speed 1.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = der(x)^2 / 2,
    start(goes: der(x) = 1),
    mark(half: x - way / 2),
    stop(there: x >= way),
)]
struct Way {
    way: f64,
}

/// Steps of 0.1 s end, to rounding, where the mark and the stop are.
#[test]
fn pieces_have_what_happens_where_they_are_cut() {
    for method in ["rk4:0.1", "gauss6:0.1", "radau5"] {
        let method: Method = method.parse().expect("a method");
        for tenths in [2, 4, 6, 8, 12, 14, 16, 22] {
            let scene = Way {
                way: 0.1 * f64::from(tenths),
            };
            let mut runner = Simulation::new(&scene).method(method).runner();
            let mut times = Vec::new();
            let mut look = |piece: &Trajectory| times.extend(piece.events().iter().map(|e| e.time));
            let outcome = runner.run_in_pieces(scene.at(Way::GOES), 0.0..9.0, 1, &mut look);
            outcome.expect("a run");
            look(runner.trajectory());
            assert_eq!(times.len(), 2, "{method:?}, {}: {times:?}", scene.way);
            agree("mark", times[0], scene.way / 2.0, 1e-12);
            agree("stop", times[1], scene.way, 1e-12);
        }
    }
}

/// A ball that never comes to rest.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(y),
    kinetic = der(y)^2 / 2,
    potential = gravity * y,
    contact(floor: y >= 0, restitution = 1),
    start(held: y = height),
)]
struct ElasticBall {
    gravity: f64,
    height: f64,
}

/// Each step ends in an impact, at √(2h/g) (2k − 1): the run is cut just after some of them.
#[test]
fn a_run_whose_steps_all_end_in_events_has_pieces() {
    for (gravity, height) in [(9.81, 0.3), (1.6, 0.7)] {
        let ball = ElasticBall { gravity, height };
        let fall = (2.0 * height / gravity).sqrt();
        let mut runner = Simulation::new(&ball).runner();
        let (mut pieces, mut impacts, mut last) = (0, 0, 0.0);
        let mut look = |piece: &Trajectory| {
            assert_eq!(piece.first_time(), last);
            assert!(piece.step_times().count() <= 20);
            assert!(piece.verify(pieces).expect("recorded").holds());
            for impact in piece.events() {
                impacts += 1;
                let time = fall * f64::from(2 * impacts - 1);
                agree("impact", impact.time, time, 1e-9);
            }
            (pieces, last) = (pieces + 1, piece.last_time());
        };
        let held = ball.at(ElasticBall::HELD);
        let outcome = runner.run_in_pieces(held, 0.0..100.0, 1000, &mut look);
        outcome.expect("a run");
        look(runner.trajectory());
        assert_eq!(last, 100.0);
        assert!(pieces > 5, "{pieces} pieces");
        assert_eq!(impacts, ((100.0 / fall + 1.0) / 2.0) as i32);
    }
}

/// A mass leaves the flat top of a hill.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(x),
    kinetic = der(x)^2 / 2,
    potential = -steepness * x^4,
    start(beside: x = 0.1),
)]
struct Hilltop {
    steepness: f64,
}

#[test]
fn the_last_phase_ends_with_the_run() {
    let scene = Hilltop { steepness: 1.0 };
    let simulation = Simulation::new(&scene).method(Method::Verner98);
    let simulation = simulation.tolerance(1e-6);
    for k in 1..80 {
        // The sum of the start of the last step and its length is rounded to a later time in some of these.
        let until = 0.0371 * f64::from(k);
        let run = simulation.run(start(&scene), 0.0..until);
        let run = run.unwrap_or_else(|failure| panic!("{failure}"));
        let end = run.phases().last().map(|phase| phase.to);
        assert_eq!(end, Some(run.last_time()));
        assert!(run.sampler().at(until).is_ok());
    }
}

/// A cam at a given speed and its follower: all accelerations are prescribed. Where an inertia is left out, their equations are solved by factors that stay
/// from one run to the next.
#[derive(Lagrangian, Clone, Debug)]
#[lagrange(
    coordinates(turn, lift),
    kinetic(of_cam: inertia/2 * der(turn)^2),
    kinetic(of_follower: mass/2 * der(lift)^2),
    constraint(motor: turn == t),
    constraint(cam: lift == cos(turn)),
    start(running: der(turn) = 1, lift = 1),
)]
struct Cam {
    inertia: f64,
    mass: f64,
}

#[test]
fn what_is_prescribed_runs_again() {
    let scene = Cam {
        inertia: 1.0,
        mass: 1.0,
    };
    for effects in [
        Effects::all(),
        Effects::all().without(Cam::OF_CAM),
        Effects::all().without(Cam::OF_FOLLOWER),
    ] {
        let mut runner = Simulation::new(&scene).effects(effects).runner();
        for _ in 0..3 {
            let run = runner.run(scene.at(Cam::RUNNING), 0.0..1.0);
            let end = run.expect("a run").final_state();
            agree("lift", end.q[1], 1.0_f64.cos(), 1e-9);
        }
    }
}
