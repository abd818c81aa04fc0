//! A finished sweep → CSV or Parquet with a line per run, a table of what came out, pictures.

mod csv;
mod parquet;
mod picture;
mod summary;

pub use csv::csv;
pub use parquet::parquet;
pub use picture::{drawable, svg};
pub use summary::{json, table};

use crate::sweep::{Journal, Sweep, Trouble, reason};
use std::io;

/// Why results could not be written.
#[derive(Debug)]
#[non_exhaustive]
pub enum Failure {
    /// They could not be read.
    Journal(Trouble),
    /// The file could not be written.
    File(io::Error),
}

impl core::fmt::Display for Failure {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Failure::Journal(trouble) => trouble.fmt(f),
            Failure::File(error) => error.fmt(f),
        }
    }
}

impl core::error::Error for Failure {}

impl From<Trouble> for Failure {
    fn from(trouble: Trouble) -> Self {
        Failure::Journal(trouble)
    }
}

impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Self {
        Failure::File(error)
    }
}

/// Calls `each` with every run in order: the point, what was observed (NaN: nothing), and why the run failed, if it did.
fn lines(
    sweep: &Sweep,
    journal: &Journal,
    mut each: impl FnMut(&[f64], &[f64], Option<&'static str>) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let mut point = vec![0.0; sweep.points.axes.len()];
    journal.read(sweep, |first, rows| {
        for (index, row) in rows.chunks_exact(sweep.width()).enumerate() {
            sweep.points.write(first + index, &mut point);
            let (observed, code) = row.split_at(sweep.observed.len());
            each(&point, observed, reason(code[0]))?;
        }
        Ok(())
    })
}

/// Names of the columns: axes, observations.
fn names(sweep: &Sweep) -> impl Iterator<Item = &str> {
    let axes = sweep.points.axes.iter().map(|axis| axis.name.as_str());
    axes.chain(sweep.observed.iter().map(|o| o.name.as_str()))
}
