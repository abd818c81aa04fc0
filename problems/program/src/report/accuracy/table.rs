//! Accuracy → text: one line per method and tolerance, and below it what there is no line about.

use super::{demand, duration, reference};
use crate::accuracy::{Accuracy, Measured};
use crate::report::table::page;
use comfy_table::{CellAlignment, ContentArrangement};
use std::io::{self, Write};

/// Writes the table.
pub fn write(accuracy: &Accuracy, mut out: impl Write) -> io::Result<()> {
    let mut table = page();
    table.set_content_arrangement(ContentArrangement::Disabled);
    table.set_header([
        "method",
        "tolerance",
        "error of\nstate",
        "\nevents",
        "drift of\nenergy",
        "\nconstraints",
        "steps",
        "evalua-\ntions",
        "series",
        "time",
        "times the\nfastest",
    ]);
    let mut before = "";
    for row in &accuracy.rows {
        if let Ok(measured) = &row.result {
            let name = row.setting.name();
            let shown = if name == before { "" } else { name };
            before = name;
            let mut line = vec![shown.to_owned(), demand(row.setting)];
            line.extend(numbers(accuracy, measured));
            table.add_row(line);
        }
    }
    for (index, column) in table.column_iter_mut().enumerate() {
        column.set_padding((1, 0));
        if index > 0 {
            column.set_cell_alignment(CellAlignment::Right);
        }
    }
    let rounds = rounds(accuracy);
    // Without results there are only the reasons for that.
    if rounds > 0 {
        writeln!(out, "{}\n", table.trim_fmt())?;
    }
    for row in &accuracy.rows {
        if let Err(reason) = &row.result {
            writeln!(out, "{}: {reason}", row.setting)?;
        }
    }
    writeln!(out, "{}", reference(accuracy))?;
    if rounds > 0 {
        writeln!(
            out,
            "Time: the best of up to {rounds} rounds, nothing recorded; over that of the fastest line that is at least as exact."
        )?;
    }
    Ok(())
}

fn numbers(accuracy: &Accuracy, measured: &Measured) -> Vec<String> {
    let floor = accuracy.reference.floor;
    let error = |value: f64| match value < floor {
        true => format!("<{floor:.0e}"),
        false => format!("{value:.1e}"),
    };
    let drift = |value: Option<f64>| match value {
        None => String::new(),
        Some(0.0) => "0".to_owned(),
        Some(value) => format!("{value:.1e}"),
    };
    let ratio = accuracy.ratio(measured);
    vec![
        error(measured.state_error),
        measured.event_error.map_or(String::new(), error),
        drift(measured.energy_drift),
        drift(measured.constraint_drift),
        measured.work.steps.to_string(),
        measured.work.evaluations.to_string(),
        measured.work.series.to_string(),
        duration(measured.time.best),
        match ratio <= 1.0 {
            true => "fastest".to_owned(),
            false => format!("{ratio:.2}"),
        },
    ]
}

fn rounds(accuracy: &Accuracy) -> usize {
    let results = accuracy.rows.iter().flat_map(|row| &row.result);
    results
        .map(|measured| measured.time.rounds)
        .max()
        .unwrap_or(0)
}
