//! What came out of a sweep, to read and as JSON.

use crate::report::table::page;
use crate::sweep::{Summary, Sweep};
use comfy_table::{CellAlignment, ContentArrangement};
use serde_json::json;
use std::io::{self, Write};

/// Writes a table with a line per observation.
///
/// # Errors
/// Of `out`.
pub fn table(sweep: &Sweep, summary: &Summary, mut out: impl Write) -> io::Result<()> {
    let mut table = page();
    table.set_content_arrangement(ContentArrangement::Disabled);
    table.set_header(["observed", "runs", "least", "mean", "greatest", "deviation"]);
    for column in &summary.columns {
        let number = |x: f64| match column.count {
            0 => String::new(),
            _ => format!("{x:.6}"),
        };
        table.add_row([
            column.name.clone(),
            column.count.to_string(),
            number(column.least),
            number(column.mean),
            number(column.greatest),
            number(column.deviation()),
        ]);
    }
    for (index, column) in table.column_iter_mut().enumerate() {
        column.set_padding((if index == 0 { 0 } else { 1 }, 1));
        if index > 0 {
            column.set_cell_alignment(CellAlignment::Right);
        }
    }
    writeln!(out, "{}\n", table.trim_fmt())?;
    let failed = match summary.failed {
        0 => String::new(),
        failed => format!(", of which {failed} failed"),
    };
    writeln!(
        out,
        "{} runs of {}{failed}.",
        summary.runs,
        sweep.scene.name()
    )
}

/// Writes one object.
///
/// # Errors
/// Of `out`.
pub fn json(sweep: &Sweep, summary: &Summary, mut out: impl Write) -> io::Result<()> {
    let column = |column: &crate::sweep::Column| {
        json!({
            "name": column.name,
            "runs": column.count,
            "least": column.least,
            "mean": column.mean,
            "greatest": column.greatest,
            "deviation": column.deviation(),
        })
    };
    let value = json!({
        "scene": sweep.scene.name(),
        "runs": summary.runs,
        "failed": summary.failed,
        "observed": summary.columns.iter().map(column).collect::<Vec<_>>(),
    });
    writeln!(out, "{}", serde_json::to_string_pretty(&value)?)
}
