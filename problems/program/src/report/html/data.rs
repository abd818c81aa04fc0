//! Films → what the script of the page reads.

use super::super::one_mode;
use super::Shown;
use super::curves::{Output, Plot, Portrait, outputs, over, plots, portraits};
use crate::film::Film;
use crate::number::significant;
use crate::report::frames::{SPEEDS, span, usual_speed};
use crate::report::picture::{Picture, Stage, pictures, stages};
use crate::report::words::Names;
use serde::Serialize;

/// What the player of the page reads.
#[derive(Serialize)]
pub(super) struct Data {
    schema: &'static str,
    /// Speeds to choose from, and the one to begin with.
    speeds: Vec<f64>,
    speed: f64,
    runs: Vec<Run>,
}

#[derive(Serialize)]
struct Run {
    title: String,
    /// What runs have in common that are drawn on the same axes.
    scene: &'static str,
    /// Of every sample, s.
    time: Vec<f64>,
    phases: Vec<Span>,
    /// Whether there is nothing that could change.
    one_mode: bool,
    events: Vec<Happening>,
    #[serde(skip_serializing_if = "Option::is_none")]
    picture: Option<Picture>,
    #[serde(skip_serializing_if = "Option::is_none")]
    space: Option<Stage>,
    plots: Vec<Plot>,
    /// That there is no room for some plots, curves and coordinates, and what is drawn nowhere at times.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    left_out: Vec<String>,
    phase: Vec<Portrait>,
    outputs: Vec<Output>,
}

/// A mode and when.
#[derive(Serialize)]
struct Span {
    from: f64,
    to: f64,
    mode: String,
}

#[derive(Serialize)]
struct Happening {
    time: f64,
    text: String,
}

pub(super) fn data(runs: &[Shown], speed: Option<f64>) -> Data {
    let films: Vec<&Film> = runs.iter().map(|run| &run.film).collect();
    let (first, last) = span(films.iter().copied());
    let usual = usual_speed(last - first);
    let speed = speed.unwrap_or(usual);
    let mut speeds = [&SPEEDS[..], &[usual, speed]].concat();
    speeds.sort_by(f64::total_cmp);
    speeds.dedup();
    let first = |film: &Film| {
        let of_scene = |other: &&Film| other.outcome.scene == film.outcome.scene;
        let first = films.iter().copied().find(of_scene);
        first.filter(|first| !std::ptr::eq(*first, film))
    };
    let seen = pictures(&films).into_iter().zip(stages(&films));
    let runs = runs.iter().zip(seen);
    let runs = runs.map(|(shown, seen)| {
        let outcomes = films.iter().map(|film| &film.outcome);
        let names = Names::of(&shown.film.outcome, outcomes);
        run(shown, seen, first(&shown.film), &names)
    });
    Data {
        schema: "lagrange.report.3",
        speeds,
        speed,
        runs: runs.collect(),
    }
}

/// One run, and how far it is from the first one of its scene.
fn run(
    shown: &Shown,
    (picture, space): (Option<Picture>, Option<Stage>),
    first: Option<&Film>,
    names: &Names,
) -> Run {
    let outcome = &shown.film.outcome;
    let description = outcome.description;
    let phases = outcome.phases.iter().map(|phase| Span {
        from: significant(phase.from),
        to: significant(phase.to),
        mode: names.brief(&phase.mode),
    });
    let events = outcome.events.iter().map(|event| Happening {
        time: significant(event.time),
        text: format!("{} {}", event.subject.name(description), event.kind.word()),
    });
    let (plots, [forces, works]) = plots(&shown.film);
    let phase = portraits(outcome, first.map(|film| &film.outcome));
    let coordinates = (
        "Coordinates to choose from",
        description.coordinates.len() - phase.len(),
    );
    let left_out = [forces, works, coordinates].into_iter();
    let left_out = left_out.filter(|(_, count)| *count > 0);
    let left_out = left_out.map(|(what, count)| format!("{what} that are left out: {count}."));
    let left_out = shown.film.not_drawn().into_iter().chain(left_out);
    Run {
        title: shown.title.clone(),
        scene: outcome.scene,
        time: over(outcome, |sample| sample.time),
        phases: phases.collect(),
        one_mode: one_mode(description),
        events: events.collect(),
        picture,
        space,
        plots,
        left_out: left_out.collect(),
        phase,
        outputs: outputs(outcome),
    }
}
