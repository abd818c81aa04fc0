//! Systems of textbooks as a reader of the book writes them, each in a file and as the struct that `lagrange export` makes of it, against a
//! closed form.

use super::scene;
use crate::outcome::Outcome;
use crate::request::Request;
use crate::scene::{Entry, Scene};
use expect_test::{ExpectFile, expect_file};
use lagrange_core::prelude::*;

/// What `lagrange export` makes of the files.
mod exported {
    pub mod atwood;
    pub mod falling_rod;
    pub mod foucault;
    pub mod four_bar;
    pub mod governor;
    pub mod heavy_top;
    pub mod robot_arm;
    pub mod rolling_ball;
    pub mod sleigh;
    pub mod slider_crank;
    pub mod vehicle;
    pub mod wedge;
}

/// The run of a scene from its first start, with a few samples; it keeps all that it should.
fn outcome(scene: &dyn Scene) -> Outcome {
    let request = Request {
        tolerance: 1e-11,
        samples: 40,
        certified: 1.0,
        ..Request::default()
    };
    let name = scene.name();
    let outcome = scene
        .run(&request)
        .unwrap_or_else(|refusal| panic!("{name}: {refusal}"));
    assert_eq!(outcome.failure, None, "{name}");
    let certificate = outcome.certificate.as_ref().expect("a certificate");
    assert!(certificate.holds(), "{name}: {certificate}");
    let closure = outcome.ledger.as_ref().expect("a ledger").closure;
    assert!(closure.abs() < 1e-7, "{name}: {closure:e}");
    outcome
}

/// The run of a declaration. The struct that is exported from it moves alike.
fn run<S: System<Scalar = f64> + Default>(path: &str, text: &str, export: &ExpectFile) -> Outcome {
    let written = super::export(path, text).unwrap_or_else(|refused| panic!("{refused}"));
    export.assert_eq(&written.rust);
    let scene = scene(path, text).unwrap_or_else(|refused| panic!("{refused}"));
    let read = outcome(scene);
    let compiled = outcome(&Entry::<S>::new(scene.name(), scene.until()));
    assert_eq!(compiled.events.len(), read.events.len(), "{path}");
    for (ours, theirs) in compiled.events.iter().zip(&read.events) {
        assert_eq!(
            (ours.subject, ours.kind),
            (theirs.subject, theirs.kind),
            "{path}"
        );
        near(ours.time, theirs.time);
    }
    for (ours, theirs) in compiled.samples.iter().zip(&read.samples) {
        assert_eq!(ours.mode, theirs.mode, "{path}");
        let numbers = |state: &State<f64>| [state.q.clone(), state.v.clone()].concat();
        for (ours, theirs) in numbers(&ours.state).into_iter().zip(numbers(&theirs.state)) {
            near(ours, theirs);
        }
    }
    read
}

macro_rules! run {
    ($name:literal, $module:ident::$system:ident) => {
        run::<exported::$module::$system>(
            concat!($name, ".lagrange"),
            include_str!(concat!($name, ".lagrange")),
            &expect_file![concat!("exported/", stringify!($module), ".rs")],
        )
    };
}

#[track_caller]
fn near(found: f64, expected: f64) {
    let error = (found - expected).abs();
    assert!(
        error < 1e-7 * expected.abs().max(1.0),
        "{found} is not {expected}"
    );
}

/// Index of a coordinate.
fn coordinate(run: &Outcome, name: &str) -> usize {
    let mut names = run.description.coordinates.iter();
    names.position(|c| c.name == name).expect("a coordinate")
}

/// A position and its velocity at the end.
fn end(run: &Outcome, name: &str) -> (f64, f64) {
    let (i, last) = (coordinate(run, name), run.samples.last().expect("samples"));
    (last.state.q[i], last.state.v[i])
}

#[test]
fn atwood_machine_with_a_mass_that_rubs() {
    let run = run!("atwood", atwood::Atwood);
    let acceleration: f64 = 9.81 * (1.0 - 0.2 * 2.0) / (2.0 + 1.0 + 0.01 / 0.01);
    near(
        run.events.last().expect("an event").time,
        (2.0 / acceleration).sqrt(),
    );
}

#[test]
fn vehicle_on_a_circle() {
    let run = run!("vehicle", vehicle::Vehicle);
    let rate = 5.0 * 0.1_f64.tan() / 2.5;
    near(end(&run, "psi").0, 10.0 * rate);
    // The rear axle, which is the rest of the wheel base behind the centre of mass, keeps the speed.
    let ((_, u), (_, v), (psi, _)) = (end(&run, "x"), end(&run, "y"), end(&run, "psi"));
    near(u * psi.cos() + v * psi.sin(), 5.0);
}

/// z = x + i y: z̈ + 2 i ω ż + g/l z = 0.
#[test]
fn foucault_pendulum() {
    let run = run!("foucault", foucault::Foucault);
    let (turn, t) = (7.292e-5 * 0.853_f64.sin(), 3600.0_f64);
    let w = (9.81 / 67.0 + turn * turn).sqrt();
    let (along, across) = (3.0 * (w * t).cos(), 3.0 * turn / w * (w * t).sin());
    let (s, c) = (turn * t).sin_cos();
    near(end(&run, "x").0, along * c + across * s);
    near(end(&run, "y").0, across * c - along * s);
}

/// Where it has come to rest, cos θ = (m + M) g/(m ω² l).
#[test]
fn governor() {
    let run = run!("governor", governor::Governor);
    near(
        end(&run, "theta").0,
        (1.5 * 9.81 / (0.5 * 225.0 * 0.2_f64)).acos(),
    );
}

/// Freudenstein's equation of the four bars.
#[test]
fn four_bar_linkage() {
    let run = run!("four-bar", four_bar::FourBar);
    let [a, c] = ["a", "c"].map(|name| coordinate(&run, name));
    for sample in &run.samples {
        let (a, c) = (sample.state.q[a], sample.state.q[c]);
        let constant = (0.01 - 0.16 + 0.09 + 0.16) / (2.0 * 0.1 * 0.3);
        near(
            4.0 * c.cos() - 0.4 / 0.3 * a.cos() + constant,
            (a - c).cos(),
        );
    }
}

/// Both joints hold in the end, with less than they could, and gravity's moments.
#[test]
fn robot_arm_with_dry_joints() {
    let run = run!("robot-arm", robot_arm::RobotArm);
    let last = run.samples.last().expect("samples");
    let (upper, lower) = (last.state.q[0], last.state.q[0] + last.state.q[1]);
    let hand = 9.81 * 0.4 * lower.cos() * (2.0 / 2.0 + 0.5);
    let elbow = 9.81 * 0.5 * upper.cos() * (3.0 / 2.0 + 2.0 + 0.5);
    near(last.forces[1], hand);
    near(last.forces[0], elbow + hand);
    assert!(last.state.v.iter().all(|v| v.abs() < 1e-12));
}

/// From its dead centre on, where it rests for an instant and cannot be held, the slider turns at dead centres only.
#[test]
fn slider_crank_with_friction() {
    let run = run!("slider-crank", slider_crank::SliderCrank);
    assert!(run.events.len() > 10);
    let theta = coordinate(&run, "theta");
    for event in &run.events {
        near((event.state.q[theta]).sin(), 0.0);
    }
}

/// Relative acceleration (M + m) g sin α/(M + m sin² α) along the face.
#[test]
fn mass_on_a_wedge() {
    let run = run!("wedge", wedge::Wedge);
    let sine = 0.5_f64.sin();
    let acceleration = 4.0 * 9.81 * sine / (3.0 + sine * sine);
    near(
        run.events.last().expect("an event").time,
        (2.0 / acceleration).sqrt(),
    );
}

/// Where the nodding turns, k (1 − u²) = p² (u₀ − u), u = cos θ, k = 2 A m g a, p = C ω.
#[test]
fn heavy_top() {
    let run = run!("heavy-top", heavy_top::HeavyTop);
    let (p, k, upper) = (0.01 * 100.0_f64, 2.0 * 0.02 * 9.81 * 0.1, 0.5_f64.cos());
    let lower = (p * p - (p.powi(4) - 4.0 * k * (p * p * upper - k)).sqrt()) / (2.0 * k);
    let theta = coordinate(&run, "theta");
    assert!(run.events.len() > 10);
    for (i, event) in run.events.iter().enumerate() {
        near(
            event.state.q[theta].cos(),
            if i % 2 == 0 { lower } else { upper },
        );
    }
}

/// About points of the incline only gravity has a moment: v + 2/5 r ω = g sin α t, whatever bounces and slips.
#[test]
fn ball_that_bounces_and_rolls() {
    let run = run!("rolling-ball", rolling_ball::RollingBall);
    near(end(&run, "x").1, 5.0 / 7.0 * 9.81 * 0.2_f64.sin() * 4.0);
    let stays = run
        .events
        .iter()
        .find(|event| event.kind.word() == "accumulates");
    let fall = (2.0 * 0.3 / (9.81 * 0.2_f64.cos())).sqrt();
    near(stays.expect("it stays down").time, fall * 1.6 / 0.4);
}

/// The first blow: Λ = (1 + e) u/(1/m + r²/I), r the distance of the end from the centre along the floor.
#[test]
fn rod_that_falls_on_its_end() {
    let run = run!("falling-rod", falling_rod::FallingRod);
    let time = (2.0 * (1.0 - 0.5 * 0.5_f64.sin()) / 9.81).sqrt();
    let arm = 0.5 * 0.5_f64.cos();
    let blow = &run.events[0];
    near(blow.time, time);
    near(
        blow.impulses[0],
        1.5 * 9.81 * time / (1.0 + 12.0 * arm * arm),
    );
}

/// Chaplygin 1911: from a turn on the spot the sleigh comes to run straight on, v = V tanh kt, ω = W sech kt.
#[test]
fn sleigh_on_a_skate() {
    let run = run!("sleigh", sleigh::Sleigh);
    let (mass, inertia, arm, turn): (f64, f64, f64, f64) = (1.0, 0.02, 0.2, 6.0);
    let about_skate = inertia + mass * arm * arm;
    let last = turn * (about_skate / mass).sqrt();
    let k = mass * arm * last / about_skate;
    for sample in &run.samples {
        let kt = k * sample.time;
        near(sample.observes[0], last * kt.tanh());
        near(sample.state.q[2], 2.0 * turn / k * (kt / 2.0).tanh().atan());
    }
}
