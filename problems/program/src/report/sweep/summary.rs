//! What came out of a sweep, to read and as JSON.

use crate::number::without_zeros;
use crate::report::table::{align, page};
use crate::sweep::{Column, Observation, QUANTILES, Sequence, Summary, Sweep};
use comfy_table::ContentArrangement;
use serde_json::{Map, Value, json};
use std::io::{self, Write};

/// Writes a table with a line per observation, where the extremes are, and what failed.
///
/// # Errors
/// Of `out`.
pub fn table(sweep: &Sweep, summary: &Summary, mut out: impl Write) -> io::Result<()> {
    let mut table = page();
    table.set_content_arrangement(ContentArrangement::Disabled);
    let parts = QUANTILES.map(|part| format!("{} %", 100.0 * part));
    let parts = parts.iter().map(String::as_str);
    let header = ["observed", "runs", "mean", "deviation", "least"].into_iter();
    table.set_header(header.chain(parts).chain(["greatest"]));
    let numbers = summary
        .columns
        .iter()
        .filter(|column| column.sequences.is_empty());
    let numbers = || numbers.clone().filter(|column| column.count > 0);
    for column in numbers() {
        let mut cells = vec![column.name.clone(), column.count.to_string()];
        let spread = [column.mean, column.deviation(), column.least.0];
        let numbers = spread.iter().chain(&column.quantiles);
        let numbers = numbers.chain([&column.greatest.0]);
        cells.extend(numbers.map(|x| figure(*x)));
        table.add_row(cells);
    }
    align(&mut table, 1..);
    if numbers().next().is_some() {
        writeln!(out, "{}\n", table.trim_fmt())?;
    }
    for column in summary.columns.iter().filter(|column| column.count == 0) {
        writeln!(out, "{}: no run has it", column.name)?;
    }
    for (column, observed) in summary.columns.iter().zip(&sweep.observed) {
        let sequences = column.sequences.iter().take(SEQUENCES);
        for Sequence {
            number,
            count,
            first,
        } in sequences
        {
            let words = told(observed, *number);
            let (runs, place) = (
                if *count == 1 { "run" } else { "runs" },
                place(sweep, *first),
            );
            writeln!(out, "{words}: {count} {runs}, the first at {place}")?;
        }
        let others = column.sequences.iter().skip(SEQUENCES);
        let (kinds, runs) = others.fold((0, 0), |(kinds, runs), other| {
            (kinds + 1, runs + other.count)
        });
        if kinds > 0 {
            writeln!(out, "{kinds} other sequences: {runs} runs")?;
        }
    }
    for column in numbers() {
        let (name, least, greatest) = (&column.name, column.least.1, column.greatest.1);
        let (least, greatest) = (place(sweep, least), place(sweep, greatest));
        writeln!(out, "{name}: least at {least}; greatest at {greatest}")?;
    }
    let (runs, failures) = (summary.runs, summary.failures());
    let failed = match failures {
        0 => String::new(),
        _ => format!(", of which {failures} failed"),
    };
    writeln!(out, "{runs} runs of {}{failed}.", sweep.scene.name())?;
    for failed in &summary.failed {
        let (reason, count) = (failed.reason, failed.count);
        let first = place(sweep, failed.first);
        writeln!(out, "  {reason}: {count}, the first at {first}")?;
        if !failed.message.is_empty() {
            writeln!(out, "    {}", failed.message)?;
        }
    }
    Ok(())
}

/// Writes one object.
///
/// # Errors
/// Of `out`.
pub fn json(sweep: &Sweep, summary: &Summary, mut out: impl Write) -> io::Result<()> {
    let column = |(column, observed): (&Column, &Observation)| {
        if column.count == 0 {
            return json!({ "name": column.name, "runs": 0 });
        }
        if !column.sequences.is_empty() {
            let sequences = column.sequences.iter().map(|sequence| {
                json!({
                    "switches": observed.words(sequence.number),
                    "runs": sequence.count,
                    "first_at": point(sweep, sequence.first),
                })
            });
            let sequences: Vec<Value> = sequences.collect();
            return json!({ "name": column.name, "runs": column.count, "sequences": sequences });
        }
        let quantiles = QUANTILES.iter().zip(&column.quantiles);
        let quantiles = quantiles.map(|(part, x)| (part.to_string(), json!(x)));
        json!({
            "name": column.name,
            "runs": column.count,
            "mean": column.mean,
            "deviation": column.deviation(),
            "least": column.least.0,
            "least_at": point(sweep, column.least.1),
            "quantiles": quantiles.collect::<Map<String, Value>>(),
            "greatest": column.greatest.0,
            "greatest_at": point(sweep, column.greatest.1),
        })
    };
    let failed = summary.failed.iter().map(|failed| {
        json!({
            "reason": failed.reason,
            "message": failed.message,
            "runs": failed.count,
            "first_at": point(sweep, failed.first),
        })
    });
    let value = json!({
        "scene": sweep.scene.name(),
        "runs": summary.runs,
        "failed": summary.failures(),
        "failures": failed.collect::<Vec<_>>(),
        "observed": summary.columns.iter().zip(&sweep.observed).map(column).collect::<Vec<_>>(),
    });
    writeln!(out, "{}", serde_json::to_string_pretty(&value)?)
}

/// Most sequences that are told.
const SEQUENCES: usize = 12;
/// Most switches of a cycle that is told once.
const CYCLE: usize = 4;

/// A sequence of switches in a line; of a cycle, how often it comes: `(grip slips → grip sticks) × 7`.
pub(super) fn told(observed: &Observation, number: f64) -> String {
    let words = observed.words(number).unwrap_or_default();
    match words.is_empty() {
        true => "no switch".to_owned(),
        false => in_cycles(&words),
    }
}

fn in_cycles<W: AsRef<str> + PartialEq>(words: &[W]) -> String {
    let mut told: Vec<String> = Vec::new();
    let mut rest = words;
    while !rest.is_empty() {
        let times = |length: usize| {
            let cycle = rest.get(..length)?;
            Some((
                length,
                rest.chunks(length)
                    .take_while(|chunk| *chunk == cycle)
                    .count(),
            ))
        };
        let cycles = (2..=CYCLE)
            .filter_map(times)
            .filter(|(_, times)| *times > 1);
        // Of equally long ones the shortest cycle.
        let (length, times) = cycles
            .rev()
            .max_by_key(|(length, times)| length * times)
            .unwrap_or((1, 1));
        let cycle: Vec<&str> = rest[..length].iter().map(AsRef::as_ref).collect();
        let cycle = cycle.join(" → ");
        told.push(if times > 1 {
            format!("({cycle}) × {times}")
        } else {
            cycle
        });
        rest = &rest[length * times..];
    }
    told.join(" → ")
}

/// The values of a point, by name.
fn values(sweep: &Sweep, index: usize) -> impl Iterator<Item = (&str, f64)> {
    let mut point = vec![0.0; sweep.points.axes.len()];
    sweep.points.write(index, &mut point);
    let names = sweep.points.axes.iter().map(|axis| axis.name.as_str());
    names.zip(point)
}

/// `a = 1, b = 2`
fn place(sweep: &Sweep, index: usize) -> String {
    let values = values(sweep, index);
    let values: Vec<String> = values
        .map(|(name, x)| format!("{name} = {}", figure(x)))
        .collect();
    values.join(", ")
}

fn point(sweep: &Sweep, index: usize) -> Map<String, Value> {
    let values = values(sweep, index);
    values
        .map(|(name, x)| (name.to_owned(), json!(x)))
        .collect()
}

/// A number in six digits.
fn figure(x: f64) -> String {
    let text = format!("{x:.5e}");
    let power = text
        .split_once('e')
        .and_then(|(_, power)| power.parse().ok());
    match power {
        Some(power @ -4..6) => {
            let digits = (5 - power) as usize;
            without_zeros(&format!("{x:.digits$}")).to_owned()
        }
        _ => text,
    }
}

#[cfg(test)]
mod tests {
    use super::in_cycles;

    #[test]
    fn cycles_are_told_once() {
        assert_eq!(in_cycles(&["a", "b", "c"]), "a → b → c");
        assert_eq!(
            in_cycles(&["x", "a", "b", "a", "b", "a", "b", "a"]),
            "x → (a → b) × 3 → a"
        );
        assert_eq!(
            in_cycles(&["a", "b", "c", "a", "b", "c", "…"]),
            "(a → b → c) × 2 → …"
        );
    }
}
