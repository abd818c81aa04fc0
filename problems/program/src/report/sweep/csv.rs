//! A line per run; what a run does not have is empty, and so is the reason of a failure where there was none.

use super::{Failure, lines, names};
use crate::sweep::{Journal, Sweep};
use lagrange_core::error::Shortest;
use std::io::{self, Write};

/// Writes all runs in order, every number in full precision.
///
/// # Errors
/// The journal is not complete; those of `out`.
pub fn csv(sweep: &Sweep, journal: &Journal, out: impl Write) -> Result<(), Failure> {
    let mut table = ::csv::Writer::from_writer(out);
    table
        .write_record(names(sweep).chain(["failure"]))
        .map_err(io::Error::from)?;
    lines(sweep, journal, |point, observed, failure| {
        let number = |x: &f64| match x.is_nan() {
            true => String::new(),
            false => Shortest(*x).to_string(),
        };
        let observed = observed.iter().zip(&sweep.observed);
        let observed = observed.map(|(value, observation)| match observation.words(*value) {
            Some(words) => words.join(", "),
            None => number(value),
        });
        let line = point
            .iter()
            .map(number)
            .chain(observed)
            .chain([failure.unwrap_or_default().to_owned()]);
        Ok(table.write_record(line).map_err(io::Error::from)?)
    })?;
    Ok(table.flush()?)
}
