//! Certificate → table, JSON, CSV: one line per check.

use super::table::{align, page};
use comfy_table::ContentArrangement;
use lagrange_core::certificate::{Certificate, Check};
use serde::Serialize;
use std::io::{self, Write};

/// A certificate in data.
#[derive(Serialize)]
pub(super) struct Verdict {
    holds: bool,
    steps: usize,
    looked: usize,
    unevaluated: usize,
    checks: Vec<Line>,
}

#[derive(Serialize)]
struct Line {
    check: &'static str,
    figure: Option<f64>,
    bound: Option<f64>,
    holds: bool,
    count: usize,
    time: f64,
    item: &'static str,
}

/// The certificate as it is written into JSON.
pub(super) fn verdict(certificate: &Certificate) -> Verdict {
    let finite = |x: f64| x.is_finite().then_some(x);
    let line = |check: &Check| Line {
        check: check.subject.words(),
        figure: finite(check.figure),
        bound: finite(check.bound),
        holds: check.holds(),
        count: check.count,
        time: check.time,
        item: check.item,
    };
    Verdict {
        holds: certificate.holds(),
        steps: certificate.steps,
        looked: certificate.looked,
        unevaluated: certificate.unevaluated,
        checks: certificate.checks.iter().map(line).collect(),
    }
}

/// Writes a table to read.
///
/// # Errors
/// Of `out`.
pub fn table(certificate: &Certificate, mut out: impl Write) -> io::Result<()> {
    let mut table = page();
    table.set_content_arrangement(ContentArrangement::Disabled);
    table.set_header(["check", "looked at", "figure", "bound", "verdict", "worst"]);
    for check in &certificate.checks {
        table.add_row([
            check.subject.words().to_owned(),
            check.count.to_string(),
            format!("{:.1e}", check.figure),
            match check.bound.is_finite() {
                true => format!("{:.1e}", check.bound),
                false => "none".to_owned(),
            },
            super::table::verdict(check.holds()).to_owned(),
            match check.figure > 0.0 {
                true => format!("{} at t = {:.6} s", check.item, check.time),
                false => String::new(),
            },
        ]);
    }
    align(&mut table, 1..4);
    writeln!(out, "{}\n\n{certificate}", table.trim_fmt())
}

/// Writes one JSON object and a newline.
///
/// # Errors
/// Of `out`.
pub fn json(certificate: &Certificate, mut out: impl Write) -> io::Result<()> {
    serde_json::to_writer_pretty(&mut out, &verdict(certificate)).map_err(io::Error::from)?;
    writeln!(out)
}

/// Writes a line per check.
///
/// # Errors
/// Of `out`.
pub fn csv(certificate: &Certificate, mut out: impl Write) -> io::Result<()> {
    writeln!(out, "check,looked at,figure,bound,holds,time,item")?;
    for check in &certificate.checks {
        let words = check.subject.words();
        let (figure, bound, holds) = (check.figure, check.bound, check.holds());
        let (count, time, item) = (check.count, check.time, check.item);
        writeln!(
            out,
            "{words},{count},{figure:e},{bound:e},{holds},{time},{item}"
        )?;
    }
    Ok(())
}
