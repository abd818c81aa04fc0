//! What the emitted functions leave to the core gives the same motion: every scene with its functions, and by the interpreter of the
//! same equations with the solver that looks for the best pivots.

use lagrange_core::prelude::*;
use lagrange_problems::catalogue::scenes;
use lagrange_program::outcome::Outcome;
use lagrange_program::request::{Refusal, Request};

/// Runs a scene for a short while, perhaps with a constraint left out.
fn run(
    scene: &'static dyn lagrange_program::scene::Scene,
    without: Option<&str>,
    equations: Equations,
) -> Result<Outcome, Refusal> {
    scene.run(&Request {
        until: Some(scene.until().min(1.5)),
        effects: without
            .map(|item| (item.to_owned(), false))
            .into_iter()
            .collect(),
        equations,
        tolerance: 1e-11,
        ..Request::default()
    })
}

/// Events in words with their times, and the state at the end.
fn story(outcome: &Outcome) -> (Vec<(String, f64)>, Vec<f64>) {
    let d = outcome.description;
    let events = outcome.events.iter();
    let events = events.map(|event| {
        let name = format!("{} {}", event.subject.name(d), event.kind.word());
        (name, event.time)
    });
    let last = outcome.samples.last();
    let state = last.map_or(Vec::new(), |last| {
        [&last.state.q[..], &last.state.v].concat()
    });
    (events.collect(), state)
}

/// Both ways find the same events, and end alike, or are refused for the same reason.
fn compare(scene: &'static dyn lagrange_program::scene::Scene, without: Option<&str>) {
    let words = format!("{} without {without:?}", scene.name());
    let run = |equations| run(scene, without, equations);
    let (emitted, interpreted) = match (run(Equations::Emitted), run(Equations::Interpreted)) {
        (Ok(emitted), Ok(interpreted)) => (emitted, interpreted),
        (Err(one), Err(other)) => {
            assert!(without.is_some(), "{words}: {one}");
            assert_eq!(one.to_string(), other.to_string(), "{words}");
            return;
        }
        (Err(refusal), _) | (_, Err(refusal)) => panic!("{words}: {refusal}"),
    };
    assert_eq!(
        emitted.failure.as_ref().map(Error::to_string),
        interpreted.failure.as_ref().map(Error::to_string),
        "{words}"
    );
    assert!(emitted.failure.is_none() || without.is_some(), "{words}");
    let ((events, end), (others, other_end)) = (story(&emitted), story(&interpreted));
    assert_eq!(end.len(), other_end.len(), "{words}");
    let names = |events: &[(String, f64)]| -> Vec<String> {
        events.iter().map(|(name, _)| name.clone()).collect()
    };
    assert_eq!(names(&events), names(&others), "{words}");
    for ((name, time), (_, other)) in events.iter().zip(&others) {
        assert!(
            (time - other).abs() < 1e-8,
            "{words}, {name}: {time}, interpreted {other}"
        );
    }
    for (x, y) in end.iter().zip(&other_end) {
        let allowed = 1e-6 * x.abs().max(1.0);
        assert!((x - y).abs() < allowed, "{words}: {x}, interpreted {y}");
    }
}

#[test]
fn interpreted_equations_give_the_same_events_and_the_same_end() {
    for scene in scenes() {
        compare(scene, None);
        for constraint in scene.system().description().constraints {
            compare(scene, Some(constraint.name));
        }
    }
}

/// A declaration in each of the forms that its equations can be written in.
macro_rules! forms {
    ($($name:ident $form:ident)*) => {
        $(
            #[derive(Lagrangian, Clone, Debug)]
            #[lagrange(
                emit = $form,
                coordinates(x, y, theta),
                define(px = x + length * sin(theta), py = y - length * cos(theta)),
                kinetic = cart/2 * (der(x)^2 + der(y)^2) + bob/2 * (der(px)^2 + der(py)^2),
                potential = g * (cart * y + bob * py),
                contact(floor: y >= 0, restitution = 1/2),
                friction(grip on floor: slip = der(x), static = 2/5, kinetic = 3/10),
                start(thrown: y = 1/5, theta = 2, der(x) = 1),
            )]
            struct $name {
                cart: f64,
                bob: f64,
                length: f64,
                g: f64,
            }

            impl Default for $name {
                fn default() -> Self {
                    Self { cart: 1.5, bob: 0.7, length: 0.9, g: 9.81 }
                }
            }
        )*
    };
}

forms! { Unrolled unrolled Loops loops Data data }

#[test]
fn a_declaration_chooses_what_its_equations_are_written_as() {
    fn run<S: System<Scalar = f64> + Starts + Default + core::fmt::Debug>() -> (Vec<f64>, Vec<f64>)
    {
        let scene = S::default();
        // Orders beyond those that have code of their own are among them.
        let simulation = Simulation::new(&scene).tolerance(1e-14);
        let trajectory = simulation
            .run(scene.at(StartId(0)), 0.0..1.5)
            .expect("runs");
        let state = trajectory.final_state();
        let times = trajectory.events().iter().map(|event| event.time);
        (times.collect(), [&state.q[..], &state.v].concat())
    }
    assert_eq!(Data::MODES.len(), 0);
    assert_eq!((Loops::MODES.len(), Unrolled::MODES.len()), (4, 4));
    let (times, end) = run::<Data>();
    assert!(times.len() > 3, "{times:?}");
    for (others, other_end) in [run::<Loops>(), run::<Unrolled>()] {
        assert_eq!(times.len(), others.len());
        let pairs = times.iter().zip(&others).chain(end.iter().zip(&other_end));
        for (x, y) in pairs {
            assert!((x - y).abs() < 1e-10 * x.abs().max(1.0), "{x}, {y}");
        }
    }
}
