//! Hard cases → table, JSON, CSV: one line per figure.

use super::table::{align, page, verdict};
use crate::stability::{Figure, Report};
use comfy_table::ContentArrangement;
use serde_json::{Value, json};
use std::io::{self, Write};

/// Writes a table to read.
///
/// # Errors
/// Of `out`.
pub fn table(reports: &[Report], mut out: impl Write) -> io::Result<()> {
    let mut table = page();
    table.set_content_arrangement(ContentArrangement::Disabled);
    table.set_header(["case", "what", "figure", "bound", "verdict"]);
    for report in reports {
        let case = report.case;
        table.add_row([case.name, case.trouble]);
        for Figure { what, value, bound } in &report.figures {
            let line = [
                String::new(),
                format!("  {what}"),
                format!("{value:.1e}"),
                format!("{bound:.0e}"),
                verdict(value <= bound).to_owned(),
            ];
            table.add_row(line);
        }
        if let Some(surprise) = &report.surprise {
            let line = [
                String::new(),
                format!("  {surprise}"),
                String::new(),
                String::new(),
                verdict(false).to_owned(),
            ];
            table.add_row(line);
        }
    }
    align(&mut table, 2..4);
    writeln!(out, "{}\n", table.trim_fmt())?;
    let kept = reports.iter().filter(|report| report.holds()).count();
    writeln!(
        out,
        "{kept} of {} cases keep their bounds, at tolerance 1e-12. Errors are relative unless a unit is named.",
        reports.len()
    )
}

/// Writes an array with an object per case.
///
/// # Errors
/// Of `out`.
pub fn json(reports: &[Report], mut out: impl Write) -> io::Result<()> {
    let figure = |figure: &Figure| {
        json!({
            "what": figure.what,
            "value": figure.value,
            "bound": figure.bound,
            "holds": figure.holds(),
        })
    };
    let cases = reports.iter().map(|report| {
        json!({
            "case": report.case.name,
            "scene": report.case.scene,
            "trouble": report.case.trouble,
            "figures": report.figures.iter().map(figure).collect::<Vec<_>>(),
            "surprise": report.surprise.as_ref().map(ToString::to_string),
            "holds": report.holds(),
        })
    });
    let text = serde_json::to_string_pretty(&Value::from_iter(cases))?;
    writeln!(out, "{text}")
}

/// Writes a line per figure; a case that could not be measured has one line with the reason.
///
/// # Errors
/// Of `out`.
pub fn csv(reports: &[Report], out: impl Write) -> io::Result<()> {
    let mut table = ::csv::Writer::from_writer(out);
    table.write_record(["case", "what", "value", "bound", "verdict"])?;
    for report in reports {
        for figure in &report.figures {
            let (value, bound) = (figure.value.to_string(), figure.bound.to_string());
            let verdict = verdict(figure.holds());
            table.write_record([report.case.name, &figure.what, &value, &bound, verdict])?;
        }
        if let Some(surprise) = &report.surprise {
            let reason = surprise.to_string();
            table.write_record([report.case.name, &reason, "", "", verdict(false)])?;
        }
    }
    table.flush()
}
