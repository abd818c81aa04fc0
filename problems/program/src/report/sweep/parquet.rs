//! Apache Parquet: a column per axis and observation (null where a run does not have it), and why the run failed (null
//! where it did not). The sweep itself is in the metadata of the file.

use super::{Failure, lines, names};
use crate::report::Kind;
use crate::report::row_groups::Rows;
use crate::sweep::{Journal, Sweep};
use std::io::{self, Write};

/// Under this key of the file's metadata the sweep is written down: scene, parameters, points, tolerance, method, version.
const RECIPE: &str = "lagrange.sweep";

/// Writes all runs in order.
///
/// # Errors
/// The journal is not complete; those of `out`.
pub fn parquet(sweep: &Sweep, journal: &Journal, out: impl Write + Send) -> Result<(), Failure> {
    let recipe = sweep
        .recipe()
        .map_err(|reason| Failure::File(io::Error::other(reason)))?;
    let axes = sweep.points.axes.len();
    let numbers = names(sweep).enumerate();
    let numbers = numbers.map(|(index, name)| match index < axes {
        true => (name, Kind::Number),
        false if sweep.observed[index - axes].is_sequence() => (name, Kind::MaybeText),
        false => (name, Kind::MaybeNumber),
    });
    let columns: Vec<(&str, Kind)> = numbers.chain([("failure", Kind::MaybeText)]).collect();
    let failures = columns.len() - 1;
    let mut rows = Rows::new(out, &columns, &[(RECIPE, &recipe)])?;
    lines(sweep, journal, |point, observed, failure| {
        for (column, &number) in point.iter().chain(observed).enumerate() {
            let observation = column.checked_sub(axes).map(|index| &sweep.observed[index]);
            match observation.and_then(|observation| observation.words(number)) {
                Some(words) => rows.text(column, &words.join(", ")),
                None if number.is_nan() => rows.nothing(column),
                None => rows.number(column, number),
            }
        }
        match failure {
            Some(reason) => rows.text(failures, reason),
            None => rows.nothing(failures),
        }
        Ok(rows.end_row()?)
    })?;
    Ok(rows.close()?)
}
