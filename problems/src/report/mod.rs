//! Printers of an [`Outcome`](crate::outcome::Outcome): a table to read, JSON and CSV to compute with, a plot to look at;
//! in [`accuracy`] the same of an [`Accuracy`](crate::accuracy::Accuracy).

pub mod accuracy;
pub mod cost;
pub mod csv;
pub mod frames;
pub mod html;
pub mod json;
mod picture;
pub mod plot;
pub mod stability;
pub mod sweep;
pub mod table;

use clap::ValueEnum;
use lagrange_core::prelude::Entry;
use lagrange_core::system::{Coordinate, Description};
use serde::{Deserialize, Serialize};

/// In what form to print.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum, Deserialize, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Format {
    /// To read.
    Table,
    /// Every number in full precision.
    Json,
    /// One line per sample (and event), or per method and tolerance.
    Csv,
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
