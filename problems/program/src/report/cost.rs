//! Costs of effects → table, JSON, CSV.

use super::table::{WIDTH, align, page};
use super::words::Names;
use crate::cost::{Cost, Costs, EffectCost, ModeCost};
use comfy_table::{ContentArrangement, Table};
use core::ops::Range;
use serde_json::{Value, json};
use std::io::{self, Write};

/// Writes two tables to read: modes, then what each effect adds to each of them.
///
/// # Errors
/// Of `out`.
pub fn table(costs: &Costs, mut out: impl Write) -> io::Result<()> {
    let mut modes = page();
    modes.set_content_arrangement(ContentArrangement::Disabled);
    modes.set_header(["mode", "", "operations", "ns"]);
    let every = costs.modes.iter().map(|mode| &mode.mode);
    let names = Names::new(costs.description, every);
    for (index, mode) in costs.modes.iter().enumerate() {
        let Cost {
            operations,
            nanoseconds,
        } = mode.cost;
        modes.add_row([
            (index + 1).to_string(),
            names.brief(&mode.mode),
            operations.to_string(),
            format!("{nanoseconds:.0}"),
        ]);
    }
    align(&mut modes, 2..);
    writeln!(out, "A right-hand side:\n\n{}\n", modes.trim_fmt())?;
    writeln!(out, "What each effect adds, mode by mode:\n")?;
    // As many modes side by side as a page is wide.
    let mut first = 0;
    while first < costs.modes.len() {
        let tables = (first + 1..=costs.modes.len()).map(|end| (end, added(costs, first..end)));
        let fitting = tables.take_while(|(end, table)| *end == first + 1 || fits(table));
        let Some((end, table)) = fitting.last() else {
            break;
        };
        writeln!(out, "{}\n", table.trim_fmt())?;
        first = end;
    }
    writeln!(
        out,
        "A whole run with everything takes {:.1} µs. 0: the effect does not act in the mode, or adds no operation.",
        costs.run * 1e6
    )?;
    for effect in &costs.effects {
        if let Err(error) = &effect.run {
            writeln!(out, "Without {} the run fails: {error}", effect.name)?;
        }
    }
    Ok(())
}

/// What each effect adds to some of the modes; beside the last one, what a whole run takes without it.
fn added(costs: &Costs, modes: Range<usize>) -> Table {
    let mut table = page();
    table.set_content_arrangement(ContentArrangement::Disabled);
    let mut header = vec!["\neffect".to_owned()];
    for number in modes.clone() {
        header.extend([
            format!("mode {}\noperations", number + 1),
            "\nns".to_owned(),
        ]);
    }
    let last = modes.end == costs.modes.len();
    header.extend(last.then(|| "whole run\nwithout it".to_owned()));
    table.set_header(header);
    for effect in &costs.effects {
        let mut line = vec![format!("{} ({})", effect.name, effect.kind)];
        for share in shares(costs, effect).skip(modes.start).take(modes.len()) {
            match share {
                Some((0, _)) => line.extend(["0".to_owned(), String::new()]),
                Some((operations, ns)) => {
                    line.extend([format!("{operations:+}"), format!("{ns:+.0}")]);
                }
                None => line.extend(["needed".to_owned(), String::new()]),
            }
        }
        line.extend(last.then(|| match &effect.run {
            Ok(time) => format!("{:.1} µs", time * 1e6),
            Err(_) => "fails".to_owned(),
        }));
        table.add_row(line);
    }
    align(&mut table, 1..);
    table
}

/// Whether no line is wider than a page.
fn fits(table: &Table) -> bool {
    let mut lines = table.lines();
    lines.all(|line| line.trim_end().chars().count() <= usize::from(WIDTH))
}

/// What an effect adds to each mode: operations and ns; `None` where nothing moves without it.
fn shares<'a>(
    costs: &'a Costs,
    effect: &'a EffectCost,
) -> impl Iterator<Item = Option<(i64, f64)>> + 'a {
    costs
        .modes
        .iter()
        .zip(&effect.without)
        .map(|(mode, without)| {
            without.map(|without| {
                (
                    mode.cost.operations as i64 - without.operations as i64,
                    mode.cost.nanoseconds - without.nanoseconds,
                )
            })
        })
}

fn cost(cost: &Cost) -> Value {
    json!({ "operations": cost.operations, "nanoseconds": cost.nanoseconds })
}

/// Writes one object.
///
/// # Errors
/// Of `out`.
pub fn json(costs: &Costs, mut out: impl Write) -> io::Result<()> {
    let effect = |effect: &EffectCost| {
        let run = effect.run.as_ref();
        json!({
            "name": effect.name,
            "kind": effect.kind,
            "without": effect.without.iter().map(|c| c.as_ref().map(cost)).collect::<Vec<_>>(),
            "run_seconds": run.ok(),
            "run_error": run.err().map(ToString::to_string),
        })
    };
    let words = |mode: &ModeCost| mode.mode.display(costs.description).to_string();
    let mode = |mode: &ModeCost| json!({ "mode": words(mode), "cost": cost(&mode.cost) });
    let value = json!({
        "scene": costs.scene,
        "run_seconds": costs.run,
        "modes": costs.modes.iter().map(mode).collect::<Vec<_>>(),
        "effects": costs.effects.iter().map(effect).collect::<Vec<_>>(),
    });
    writeln!(out, "{}", serde_json::to_string_pretty(&value)?)
}

/// Writes a line per mode and effect left out; the first lines of a mode leave out none.
///
/// # Errors
/// Of `out`.
pub fn csv(costs: &Costs, out: impl Write) -> io::Result<()> {
    let mut table = ::csv::Writer::from_writer(out);
    table.write_record(["mode", "without", "operations", "nanoseconds"])?;
    for (index, mode) in costs.modes.iter().enumerate() {
        let words = mode.mode.display(costs.description).to_string();
        let without = costs.effects.iter().map(|e| (e.name, e.without[index]));
        for (name, cost) in core::iter::once(("", Some(mode.cost))).chain(without) {
            let operations = cost.map(|c| c.operations.to_string()).unwrap_or_default();
            let nanoseconds = cost.map(|c| c.nanoseconds.to_string()).unwrap_or_default();
            table.write_record([&words, name, &operations, &nanoseconds])?;
        }
    }
    table.flush()
}
