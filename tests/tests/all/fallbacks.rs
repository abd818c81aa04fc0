//! What the emitted functions leave to the core gives the same motion: every scene with its functions, and by the interpreter of the
//! same equations with the solver that looks for the best pivots.

use lagrange_core::prelude::*;
use lagrange_problems::catalogue::scenes;
use lagrange_problems::outcome::Outcome;
use lagrange_problems::request::Request;

/// Runs a scene for a short while.
fn run(scene: &'static dyn lagrange_problems::catalogue::Scene, equations: Equations) -> Outcome {
    let request = Request {
        until: Some(scene.until().min(1.5)),
        equations,
        tolerance: 1e-11,
        ..Request::default()
    };
    let outcome = scene.run(&request);
    outcome.unwrap_or_else(|refusal| panic!("{}: {refusal}", scene.name()))
}

/// Events in words with their times, and the state at the end.
fn story(outcome: &Outcome) -> (Vec<(String, f64)>, Vec<f64>) {
    let d = outcome.description;
    let events = outcome.events.iter();
    let events = events.map(|event| {
        let name = format!("{} {}", event.subject.name(d), event.kind.word());
        (name, event.time)
    });
    let last = outcome.samples.last().expect("a run that begins");
    let state = last.state.q.iter().chain(&last.state.v).copied();
    (events.collect(), state.collect())
}

#[test]
fn interpreted_equations_give_the_same_events_and_the_same_end() {
    let equations = Equations::Interpreted;
    for scene in scenes() {
        let (events, end) = story(&run(scene, Equations::Emitted));
        let (others, other_end) = story(&run(scene, equations));
        let names = |events: &[(String, f64)]| -> Vec<String> {
            events.iter().map(|(name, _)| name.clone()).collect()
        };
        assert_eq!(
            names(&events),
            names(&others),
            "{}: {equations:?}",
            scene.name()
        );
        for ((name, time), (_, other)) in events.iter().zip(&others) {
            assert!(
                (time - other).abs() < 1e-8,
                "{}, {name}: {time}, {equations:?} {other}",
                scene.name()
            );
        }
        for (x, y) in end.iter().zip(&other_end) {
            let allowed = 1e-6 * x.abs().max(1.0);
            assert!(
                (x - y).abs() < allowed,
                "{}: {x}, {equations:?} {y}",
                scene.name()
            );
        }
    }
}
