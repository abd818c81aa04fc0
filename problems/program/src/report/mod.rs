//! Printers of an [`Outcome`]: a table to read, JSON, JSON lines, CSV and Parquet to compute with, a plot to look at;
//! in [`accuracy`] the same of an [`Accuracy`](crate::accuracy::Accuracy).

pub mod accuracy;
pub mod certificate;
pub mod cost;
pub mod csv;
pub mod export;
pub mod frames;
pub mod html;
pub mod json;
pub mod jsonl;
mod letters;
pub mod modes;
pub mod parquet;
mod picture;
pub mod plot;
mod row_groups;
mod rows;
pub mod stability;
pub mod sweep;
pub mod table;
mod words;

use crate::format::RunFormat;
use crate::outcome::Outcome;
use lagrange_core::prelude::Entry;
use lagrange_core::system::Description;
use std::io::{self, Write};

impl RunFormat {
    /// Writes a run.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn write(self, outcome: &Outcome, out: &mut dyn Write) -> io::Result<()> {
        match self {
            RunFormat::Table => table::write(outcome, out),
            RunFormat::Json => json::write(outcome, out),
            RunFormat::Jsonl => jsonl::write(outcome, out),
            RunFormat::Csv => csv::write(outcome, out),
            RunFormat::Parquet => parquet::write(outcome, out),
        }
    }

    /// The same with the error of a run that failed, which stands on stderr beside a story on stdout.
    ///
    /// # Errors
    /// Of `out`.
    pub(crate) fn write_whole(self, outcome: &Outcome, out: &mut dyn Write) -> io::Result<()> {
        self.write(outcome, out)?;
        match (self, &outcome.failure) {
            (RunFormat::Table, Some(error)) => writeln!(out, "\n{error}"),
            _ => Ok(()),
        }
    }
}

/// What a column of a table holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    /// A number in every row.
    Number,
    /// A number, or nothing.
    MaybeNumber,
    /// A text in every row.
    Text,
    /// A text, or nothing.
    MaybeText,
}

/// The coordinates that say something by themselves: all but the quaternions of bodies, unless there is nothing else.
fn telling(description: &Description) -> Vec<usize> {
    let attitudes = description.constraints.iter();
    let quaternions: Vec<_> = attitudes
        .filter_map(|c| Some(c.attitude?..c.attitude? + 4))
        .collect();
    let all = 0..description.coordinates.len();
    let telling: Vec<usize> = all
        .clone()
        .filter(|i| !quaternions.iter().any(|four| four.contains(i)))
        .collect();
    match telling.is_empty() && description.observes.is_empty() {
        true => all.collect(),
        false => telling,
    }
}

/// A name with its unit, `x [m]`, or the name alone.
pub(crate) fn with_unit(name: &str, unit: &str) -> String {
    match unit {
        "" => name.to_owned(),
        unit => format!("{name} [{unit}]"),
    }
}

/// Name of an item of the ledger: a contact does work by its force (where its surface moves) and by impacts.
pub(crate) fn work_name(entry: &Entry) -> String {
    match entry.kind {
        "impact" => format!("{} impact", entry.name),
        _ => entry.name.to_owned(),
    }
}

/// A state as (name, value) pairs in the order of the coordinates: positions, then velocities.
pub(crate) fn named_state(description: &Description, q: &[f64], v: &[f64]) -> Vec<(String, f64)> {
    let names = || description.coordinates.iter().map(|c| c.name);
    let positions = names().map(str::to_owned).zip(q.iter().copied());
    let velocities = names()
        .map(crate::notation::velocity_name)
        .zip(v.iter().copied());
    positions.chain(velocities).collect()
}

/// Whether nothing in a scene can switch.
pub(crate) fn one_mode(description: &Description) -> bool {
    let d = description;
    d.contacts.is_empty() && d.frictions.is_empty() && d.branches.is_empty()
}

/// A ball without spin that strikes a corner of two rough walls along its bisector: its impact has two solutions.
#[cfg(test)]
const CORNER: &str = "
    parameters(r = 0.1, reach = 1, mu = 1), coordinates(x, y, phi),
    kinetic = (der(x)^2 + der(y)^2) / 2 + r^2/5 * der(phi)^2,
    contact(right: reach - x >= 0, restitution = 1/2), contact(top: reach - y >= 0, restitution = 1/2),
    friction(side on right: slip = der(y) + r * der(phi), static = mu, kinetic = mu/2),
    friction(ceiling on top: slip = der(x) - r * der(phi), static = mu, kinetic = mu/2),
    start(thrown: der(x) = 1, der(y) = 1), until = 1.5,";

/// A plank that falls flat on three feet, for tests of several reports.
#[cfg(test)]
const PLANK: &str = "
    coordinates(y, phi), kinetic = (der(y)^2 + der(phi)^2) / 2, potential = 10 * y,
    contact(foot[k in 0..3]: y + (k - 1) * phi >= 0, restitution = 1/2), start(level: y = 1/5), until = 0.3,";
