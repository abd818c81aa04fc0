//! Feasible modes → table, JSON, CSV: one line per mode, with its forces and accelerations.

use super::json::Numbers;
use super::table::{Decimals, align, page};
use super::with_unit;
use super::words::Names;
use crate::feasible::Feasible;
use crate::notation::{rate_unit, velocity_name};
use crate::outcome::forces;
use crate::outcome::rounding::{self, ROUNDING};
use comfy_table::{ColumnConstraint, Width};
use lagrange_core::error::Shortest;
use lagrange_core::prelude::Instant;
use serde::Serialize;
use std::io::{self, Write};

/// Columns of a mode at least.
const LEAST: u16 = 24;

/// A number of every mode: name, unit, and whether it acts, with its value, in each.
struct Column {
    name: String,
    unit: String,
    values: Vec<(bool, f64)>,
}

/// The unit of an acceleration: `m/s²`; empty for a coordinate without a unit.
fn acceleration_unit(unit: &str) -> String {
    match rate_unit(unit) {
        rate if rate.is_empty() => rate,
        rate => format!("{rate}²"),
    }
}

/// Forces, then accelerations.
fn columns(found: &Feasible) -> Vec<Column> {
    let d = found.description;
    let every =
        |value: &dyn Fn(&Instant<f64>) -> (bool, f64)| found.modes.iter().map(value).collect();
    let forces = forces(d).into_iter().map(|force| Column {
        values: every(&|now| {
            let value = rounding::force(now.forces[force.row], now.held[force.row]);
            (force.acts(d, &now.mode), value)
        }),
        unit: d.units.row(force.row).to_owned(),
        name: force.name,
    });
    let accelerations = d
        .coordinates
        .iter()
        .enumerate()
        .map(|(i, coordinate)| Column {
            values: every(&|now| (true, now.acceleration[i])),
            unit: acceleration_unit(coordinate.unit),
            name: velocity_name(&velocity_name(coordinate.name)),
        });
    forces.chain(accelerations).collect()
}

/// What rounding leaves of the largest number of its unit is 0.
fn forget_rounding(columns: &mut [Column]) {
    let largest = |column: &Column| {
        let values = column.values.iter();
        values.fold(0.0, |a: f64, (_, value)| a.max(value.abs()))
    };
    let sizes: Vec<f64> = columns.iter().map(largest).collect();
    let of_unit = |unit: &str| {
        let alike = columns.iter().zip(&sizes).filter(|(c, _)| c.unit == unit);
        alike.fold(0.0, |a: f64, (_, size)| a.max(*size))
    };
    let least = columns.iter().map(|c| ROUNDING * of_unit(&c.unit));
    let least: Vec<f64> = least.collect();
    for (column, least) in columns.iter_mut().zip(least) {
        for (_, value) in &mut column.values {
            if value.abs() < least {
                *value = 0.0;
            }
        }
    }
}

/// Writes a table to read.
///
/// # Errors
/// Of `out`.
pub fn table(found: &Feasible, mut out: impl Write) -> io::Result<()> {
    let mut columns = columns(found);
    forget_rounding(&mut columns);
    let mut table = page();
    let header = |column: &Column| format!("{}\n{}", column.name, column.unit);
    let names = columns.iter().map(header);
    table.set_header(["".to_owned(), "mode".to_owned()].into_iter().chain(names));
    let decimals: Vec<Decimals> = columns
        .iter()
        .map(|column| Decimals::of(column.values.iter().map(|(_, value)| *value)))
        .collect();
    let every = found.modes.iter().map(|now| &now.mode);
    let names = Names::new(found.description, every);
    for (k, now) in found.modes.iter().enumerate() {
        let numbers = columns.iter().zip(&decimals).map(|(column, decimals)| {
            let (acts, value) = column.values[k];
            if acts {
                decimals.show(value)
            } else {
                String::new()
            }
        });
        let mode = names.brief(&now.mode);
        table.add_row([(k + 1).to_string(), mode].into_iter().chain(numbers));
    }
    align(&mut table, 2..);
    for (index, column) in table.column_iter_mut().enumerate().skip(1) {
        column.set_constraint(match index {
            // Beside many numbers, which are wider than a page, modes need not be narrow.
            1 => ColumnConstraint::LowerBoundary(Width::Fixed(LEAST)),
            // Neither a number nor the name of an acceleration is broken.
            _ => ColumnConstraint::ContentWidth,
        });
    }
    writeln!(out, "{}\n", table.trim_fmt())?;
    let time = Shortest(found.time);
    match found.modes.len() {
        _ if found.many => writeln!(
            out,
            "At t = {time} s a run goes on in this mode; more are possible than are all tried, and the others are not known."
        ),
        1 => writeln!(
            out,
            "At t = {time} s the motion can go on in this mode only."
        ),
        count => writeln!(
            out,
            "At t = {time} s the motion can go on in {count} modes; a run takes the first."
        ),
    }
}

#[derive(Serialize)]
struct Page {
    scene: &'static str,
    time: f64,
    modes: Vec<Line>,
    /// More modes are possible than are all tried: the one listed is that of a run.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    others_unknown: bool,
}

#[derive(Serialize)]
struct Line {
    mode: String,
    forces: Numbers,
    accelerations: Numbers,
}

/// Writes one JSON object and a newline.
///
/// # Errors
/// Of `out`.
pub fn json(found: &Feasible, mut out: impl Write) -> io::Result<()> {
    let d = found.description;
    let line = |now: &Instant<f64>| {
        let forces = forces(d).into_iter();
        let coordinates = d.coordinates.iter().zip(&now.acceleration);
        Line {
            mode: now.mode.display(d).to_string(),
            forces: Numbers(
                forces
                    .map(|force| (force.name, now.forces[force.row]))
                    .collect(),
            ),
            accelerations: Numbers(
                coordinates
                    .map(|(coordinate, value)| (coordinate.name.to_owned(), *value))
                    .collect(),
            ),
        }
    };
    let page = Page {
        scene: found.scene,
        time: found.time,
        modes: found.modes.iter().map(line).collect(),
        others_unknown: found.many,
    };
    serde_json::to_writer_pretty(&mut out, &page).map_err(io::Error::from)?;
    writeln!(out)
}

/// Writes a line per mode.
///
/// # Errors
/// Of `out`.
pub fn csv(found: &Feasible, out: impl Write) -> io::Result<()> {
    let columns = columns(found);
    let mut writer = csv::Writer::from_writer(out);
    let names = columns
        .iter()
        .map(|column| with_unit(&column.name, &column.unit));
    writer.write_record(core::iter::once("mode".to_owned()).chain(names))?;
    for (k, now) in found.modes.iter().enumerate() {
        let numbers = columns
            .iter()
            .map(|column| Shortest(column.values[k].1).to_string());
        let mode = now.mode.display(found.description).to_string();
        writer.write_record(core::iter::once(mode).chain(numbers))?;
    }
    writer.flush()
}

#[cfg(test)]
mod tests {
    use super::table;

    /// Six boxes in a stack: each layer carries what is above it, and nothing pushes.
    #[test]
    fn of_more_modes_than_are_tried_the_one_that_a_run_takes_is_told() {
        let declared = "parameters(mu = 0.5), coordinates(x[6], y[6]), kinetic = sum(k in 0..6: (der(x[k])^2 + der(y[k])^2) / 2),
            potential = sum(k in 0..6: 10 * y[k]), contact(ground: y[0] >= 0), contact(up[k in 0..5]: y[k+1] >= y[k]),
            friction(rough on ground: slip = der(x[0]), static = mu), friction(rub[k in 0..5] on up[k]: slip = der(x[k+1] - x[k]), static = mu),
            start(still: x[0] = 0)";
        let scene = crate::file::scene("stack.lagrange", declared).expect("a declaration");
        let found = scene
            .modes(&Default::default(), None)
            .expect("the mode of a run");
        let mut text = Vec::new();
        table(&found, &mut text).expect("memory");
        let text = String::from_utf8(text).expect("text");
        let [stack] = &found.modes[..] else {
            panic!("{text}");
        };
        assert!(
            (stack.forces[0] - 60.0).abs() < 1e-9 && (stack.forces[5] - 10.0).abs() < 1e-9,
            "{text}"
        );
        assert!(text.contains("the others are not known"), "{text}");
    }

    /// A lorry on a ramp that its brake holds: a load of 1e-15 N beside 5 N moves nothing.
    #[test]
    fn what_is_rounding_beside_its_unit_is_shown_as_zero() {
        let declared = "parameters(m: \"kg\" = 2, push: \"N\" = 1e-15, pull: \"N\" = 5), coordinates(x: \"m\", y: \"m\", turn: \"rad\"),
            parameters(j: \"kg*m^2\" = 1, twist: \"N*m\" = 1e-15), kinetic = m/2 * (der(x)^2 + der(y)^2) + j/2 * der(turn)^2,
            force(a: x = push), force(b: y = pull), force(c: turn = twist)";
        let scene = crate::file::scene("held.lagrange", declared).expect("a declaration");
        let found = scene.modes(&Default::default(), None).expect("modes");
        let mut text = Vec::new();
        table(&found, &mut text).expect("memory");
        let text = String::from_utf8(text).expect("text");
        let words = |line: &str| line.split_whitespace().collect::<Vec<_>>().join(" ");
        // Alone in its unit, 1e-15 rad/s² is what there is.
        let told = "1 smooth 0.0000 2.5000 1.0000e-15";
        assert!(text.lines().any(|line| words(line) == told), "{text}");
    }

    /// It falls 1.25 m in 0.5 s.
    #[test]
    fn what_ends_a_run_before_the_time_that_is_asked_for_is_told() {
        let declared = "coordinates(y), kinetic = der(y)^2 / 2, potential = 10 * y, stop(ground: y <= 0), start(high: y = 1.25), until = 1";
        let scene = crate::file::scene("falls.lagrange", declared).expect("a declaration");
        let refused = scene.modes(&Default::default(), Some(0.75)).err();
        let told = refused.expect("an end").to_string();
        assert_eq!(
            told,
            "the run ends at t = 0.5 (ground stop), before t = 0.75; ask for an earlier time"
        );
    }

    /// Ten sliders on ten frictions: a table wider than a page keeps its names and numbers whole.
    #[test]
    fn no_name_of_an_acceleration_is_broken() {
        let declared = "coordinates(position[10]), kinetic = sum(k in 0..10: der(position[k])^2/2),
            friction(rub[k in 0..2]: slip = der(position[k]), limit = 1), force(pull: position[9] = 1),";
        let scene = crate::file::scene("sliders.lagrange", declared).expect("a declaration");
        let found = scene.modes(&Default::default(), None).expect("modes");
        let mut text = Vec::new();
        table(&found, &mut text).expect("memory");
        let text = String::from_utf8(text).expect("text");
        let head = text.lines().next().expect("a header");
        for k in 0..10 {
            assert!(head.contains(&format!("der(der(position[{k}]))")), "{text}");
        }
    }
}
