//! Accuracy → CSV: one line per method and tolerance; what does not apply is empty.

use crate::accuracy::{Accuracy, Measured, Row};
use std::io::{self, Write};

const HEADER: [&str; 18] = [
    "method",
    "tolerance",
    "step",
    "error",
    "state_error",
    "event_error",
    "energy_drift",
    "constraint_drift",
    "steps",
    "rejected",
    "evaluations",
    "series",
    "factorizations",
    "time",
    "time_median",
    "rounds",
    "ratio",
    "failure",
];

/// Writes `accuracy` with a header line; only what reaches `target`, if there is one.
pub fn write(accuracy: &Accuracy, target: Option<f64>, out: impl Write) -> io::Result<()> {
    let mut table = ::csv::Writer::from_writer(out);
    table.write_record(HEADER)?;
    let wanted = |row: &&Row| match (target, &row.result) {
        (None, _) => true,
        (Some(target), Ok(measured)) => accuracy.resolved(measured) <= target,
        (Some(_), Err(_)) => false,
    };
    for row in accuracy.rows.iter().filter(wanted) {
        table.write_record(line(accuracy, row))?;
    }
    table.flush()
}

fn line(accuracy: &Accuracy, row: &Row) -> Vec<String> {
    let step = row.setting.step();
    let demand = match step {
        None => [format!("{:e}", row.setting.tolerance), String::new()],
        Some(step) => [String::new(), step.to_string()],
    };
    let mut line = vec![row.setting.name().to_owned()];
    line.extend(demand);
    match &row.result {
        Ok(measured) => {
            line.extend(numbers(accuracy, measured));
            line.push(String::new());
        }
        Err(reason) => {
            line.resize(HEADER.len() - 1, String::new());
            line.push(reason.clone());
        }
    }
    line
}

fn numbers(accuracy: &Accuracy, measured: &Measured) -> [String; 14] {
    let maybe = |value: Option<f64>| value.map_or(String::new(), |v| format!("{v:e}"));
    let (work, time) = (measured.work, measured.time);
    [
        format!("{:e}", measured.error()),
        format!("{:e}", measured.state_error),
        maybe(measured.event_error),
        maybe(measured.energy_drift),
        maybe(measured.constraint_drift),
        work.steps.to_string(),
        work.rejected.to_string(),
        work.evaluations.to_string(),
        work.series.to_string(),
        work.factorizations.to_string(),
        format!("{:e}", time.best),
        format!("{:e}", time.median),
        time.rounds.to_string(),
        accuracy.ratio(measured).to_string(),
    ]
}
