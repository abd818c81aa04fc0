//! Accuracy → JSON: everything, every number in full precision.

use crate::accuracy::{Accuracy, Measured, Row, Setting};
use crate::report::json::{Numbers, state};
use serde::Serialize;
use std::io::{self, Write};

/// Writes `accuracy` as one JSON object and a newline; with the answer, if an error is aimed at.
pub fn write(accuracy: &Accuracy, target: Option<f64>, mut out: impl Write) -> io::Result<()> {
    let report = report(accuracy, target);
    serde_json::to_writer_pretty(&mut out, &report).map_err(io::Error::from)?;
    writeln!(out)
}

#[derive(Serialize)]
struct Report {
    scene: &'static str,
    parameters: Numbers,
    reference: Known,
    rows: Vec<Line>,
    #[serde(skip_serializing_if = "Option::is_none")]
    target: Option<Answer>,
}

#[derive(Serialize)]
struct Known {
    by: String,
    checked_by: String,
    difference: f64,
    floor: f64,
    events: Vec<Happening>,
    time: f64,
    state: Numbers,
}

#[derive(Serialize)]
struct Happening {
    event: String,
    time: f64,
}

/// The fastest setting of each method that reaches an error, fastest first.
#[derive(Serialize)]
struct Answer {
    error: f64,
    fastest: Vec<Line>,
}

#[derive(Serialize)]
struct Line {
    method: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    tolerance: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    step: Option<f64>,
    #[serde(flatten)]
    result: Achieved,
}

#[derive(Serialize)]
#[serde(untagged)]
enum Achieved {
    Numbers(Costs),
    Failure { failure: String },
}

#[derive(Serialize)]
struct Costs {
    error: f64,
    state_error: f64,
    event_error: Option<f64>,
    energy_drift: Option<f64>,
    constraint_drift: Option<f64>,
    steps: usize,
    rejected: usize,
    evaluations: usize,
    series: usize,
    factorizations: usize,
    time: f64,
    time_median: f64,
    rounds: usize,
    ratio: f64,
}

fn report(accuracy: &Accuracy, target: Option<f64>) -> Report {
    let names = accuracy.description.parameters.iter();
    let names = names.map(|p| p.name.to_owned());
    let known = &accuracy.reference;
    let truth = &known.truth;
    let happening = |index: usize| Happening {
        event: truth.words(index),
        time: truth.events[index].2,
    };
    let of_row = |row: &Row| {
        let result = match &row.result {
            Ok(measured) => Achieved::Numbers(costs(accuracy, measured)),
            Err(reason) => Achieved::Failure {
                failure: reason.clone(),
            },
        };
        line(row.setting, result)
    };
    let answer = |error: f64| Answer {
        error,
        fastest: accuracy
            .fastest_of_each(error)
            .into_iter()
            .map(|(setting, measured)| line(setting, Achieved::Numbers(costs(accuracy, measured))))
            .collect(),
    };
    Report {
        scene: accuracy.scene,
        parameters: Numbers(names.zip(accuracy.parameters.iter().copied()).collect()),
        reference: Known {
            by: known.by.clone(),
            checked_by: known.checked_by.clone(),
            difference: known.difference,
            floor: known.floor,
            events: (0..truth.events.len()).map(happening).collect(),
            time: truth.time,
            state: state(accuracy.description, &truth.state),
        },
        rows: accuracy.rows.iter().map(of_row).collect(),
        target: target.map(answer),
    }
}

fn line(setting: Setting, result: Achieved) -> Line {
    let step = setting.step();
    Line {
        method: setting.name(),
        tolerance: step.is_none().then_some(setting.tolerance),
        step,
        result,
    }
}

fn costs(accuracy: &Accuracy, measured: &Measured) -> Costs {
    let (work, time) = (measured.work, measured.time);
    Costs {
        error: measured.error(),
        state_error: measured.state_error,
        event_error: measured.event_error,
        energy_drift: measured.energy_drift,
        constraint_drift: measured.constraint_drift,
        steps: work.steps,
        rejected: work.rejected,
        evaluations: work.evaluations,
        series: work.series,
        factorizations: work.factorizations,
        time: time.best,
        time_median: time.median,
        rounds: time.rounds,
        ratio: accuracy.ratio(measured),
    }
}
