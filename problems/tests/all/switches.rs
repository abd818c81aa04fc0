//! What a sweep tells of the switches of a run are those of the run by itself.

use lagrange_core::prelude::EventKind;
use lagrange_problems::catalogue::scenes;
use lagrange_program::request::Request;
use lagrange_program::sweep::{Points, Sampling, Sweep};

/// For every scene the words are those of its events, as far as there is room.
#[test]
fn numbers_stand_for_the_events_of_a_run() {
    for scene in scenes() {
        let (name, d) = (scene.name(), scene.description());
        let request = Request {
            until: Some(scene.until().min(3.0)),
            ..Request::default()
        };
        let outcome = scene.run(&request).expect("a run");
        let mut told: Vec<String> = Vec::new();
        for event in &outcome.events {
            let words = format!("{} {}", event.subject.name(d), event.kind.word());
            let switches = !matches!(event.kind, EventKind::Mark | EventKind::Ambiguous);
            if switches && told.last() != Some(&words) {
                told.push(words);
            }
        }
        let points = Points {
            axes: Vec::new(),
            sampling: Sampling::Grid,
        };
        let sweep = Sweep::new(scene, request, points, &["modes".to_owned()]).expect("a sweep");
        let mut row = [0.0; 2];
        scene.worker(&sweep).expect("a worker")(0..1, &mut row);
        let mut said = sweep.observed[0].words(row[0]).expect(name);
        if said.last().is_some_and(|words| words.starts_with("… ")) {
            said.pop();
            assert!(told.len() > said.len() + 1, "{name}");
            told.truncate(said.len());
        }
        assert_eq!(said, told, "{name}");
    }
}
