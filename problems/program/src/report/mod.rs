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
mod thrift;
mod words;

use crate::outcome::Outcome;
use clap::ValueEnum;
use core::fmt;
use lagrange_core::prelude::Entry;
use lagrange_core::system::{Coordinate, Description};
use std::io::{self, Write};
use std::path::Path;

/// In what form to print.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// To read.
    Table,
    /// Every number in full precision.
    Json,
    /// One line each.
    Csv,
}

impl Format {
    /// The format that the name of a file says, if it says one.
    pub fn of(path: &Path) -> Option<Self> {
        Some(match path.extension()?.to_str()? {
            "json" => Format::Json,
            "csv" => Format::Csv,
            "txt" => Format::Table,
            _ => return None,
        })
    }
}

/// In what form to write a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum RunFormat {
    /// To read.
    Table,
    /// Every number in full precision.
    Json,
    /// The same over time: a line per sample and event.
    Jsonl,
    /// A line per sample, two per event.
    Csv,
    /// The same for pandas, polars and the like.
    Parquet,
}

impl RunFormat {
    /// The format that the name of a file says, if it says one.
    pub fn of(path: &Path) -> Option<Self> {
        Some(match path.extension()?.to_str()? {
            "json" => RunFormat::Json,
            "jsonl" | "ndjson" => RunFormat::Jsonl,
            "csv" => RunFormat::Csv,
            "parquet" => RunFormat::Parquet,
            "txt" => RunFormat::Table,
            _ => return None,
        })
    }

    /// Whether it says how the run was between its events.
    pub fn is_sampled(self) -> bool {
        matches!(self, RunFormat::Jsonl | RunFormat::Csv | RunFormat::Parquet)
    }

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
}

impl fmt::Display for RunFormat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = self.to_possible_value();
        f.write_str(name.as_ref().map_or("", |name| name.get_name()))
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

/// Whether a coordinate is an angle, so that people read it in degrees: its unit is declared as `rad`, or its
/// name is that of a Greek letter customary for angles (`theta`, `phi2`, `psi_left`, `alpha[3]`).
pub fn is_angle(coordinate: &Coordinate) -> bool {
    const LETTERS: [&str; 7] = ["theta", "phi", "psi", "alpha", "beta", "gamma", "chi"];
    if !coordinate.unit.is_empty() {
        return coordinate.unit == "rad";
    }
    let stem = coordinate
        .name
        .split(|c: char| !c.is_ascii_alphabetic())
        .next()
        .unwrap_or_default();
    LETTERS.contains(&stem)
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

/// The unit of a velocity: `m/s`, `rad/s`; empty for a coordinate without a unit.
pub(crate) fn rate_unit(unit: &str) -> String {
    match unit {
        "" => String::new(),
        unit if unit.contains(['/', ' ']) => format!("({unit})/s"),
        unit => format!("{unit}/s"),
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
        .map(crate::request::velocity_name)
        .zip(v.iter().copied());
    positions.chain(velocities).collect()
}

/// Greek letters for the names of Greek letters; other names as they are.
pub(crate) fn symbol(name: &str) -> String {
    const GREEK: [(&str, &str); 7] = [
        ("theta", "θ"),
        ("phi", "φ"),
        ("psi", "ψ"),
        ("alpha", "α"),
        ("beta", "β"),
        ("gamma", "γ"),
        ("chi", "χ"),
    ];
    let split = name
        .find(|c: char| !c.is_ascii_alphabetic())
        .unwrap_or(name.len());
    let (stem, rest) = name.split_at(split);
    match GREEK.iter().find(|(word, _)| *word == stem) {
        Some((_, letter)) => format!("{letter}{rest}"),
        None => name.to_owned(),
    }
}

/// Whether nothing in a scene can switch.
pub(crate) fn one_mode(description: &Description) -> bool {
    let d = description;
    d.contacts.is_empty() && d.frictions.is_empty() && d.branches.is_empty()
}

/// To six significant digits: no picture shows more. What is not finite is 0: JSON cannot hold it.
pub(crate) fn significant(x: f64) -> f64 {
    if !x.is_finite() || x == 0.0 {
        return 0.0;
    }
    format!("{x:.5e}").parse().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::significant;

    #[test]
    fn numbers_are_short_and_finite() {
        assert_eq!(significant(1.0 / 3.0), 0.333333);
        assert_eq!(significant(-0.0), 0.0);
        assert_eq!(significant(f64::NAN), 0.0);
    }
}
