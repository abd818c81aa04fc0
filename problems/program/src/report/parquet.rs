//! Outcome → Parquet: the table of [`csv`](super::csv), without units in the names, for pandas, polars, DuckDB …; what the run
//! was, as metadata.
//!
//! The metadata is one JSON object under two keys: `lagrange`, and `PANDAS_ATTRS`, which pandas shows as `DataFrame.attrs`.
//! Events are rows, marked in the column `event`, and not a second file: they are rows in CSV as well, one schema does for all
//! files of a folder, and the metadata stays small whatever happens.

use super::json::summary;
use super::row_groups::Rows;
use super::rows::{Cell, Table};
use crate::outcome::Outcome;
use std::io::{self, Write};

/// Writes `outcome` as a Parquet file.
pub fn write(outcome: &Outcome, out: impl Write) -> io::Result<()> {
    let table = Table::new(outcome);
    let columns = table.columns();
    let names = columns
        .iter()
        .map(|column| (column.name.as_str(), column.kind));
    let what = serde_json::to_string(&summary(outcome))?;
    let metadata = [("lagrange", what.as_str()), ("PANDAS_ATTRS", what.as_str())];
    // The writer wants to be sent between threads; what it writes to need not be.
    let mut bytes = Vec::new();
    let mut rows = Rows::new(&mut bytes, &names.collect::<Vec<_>>(), &metadata)?;
    for row in table.rows() {
        for (index, cell) in table.cells(&row).iter().enumerate() {
            match cell {
                Cell::Number(number) => rows.number(index, *number),
                Cell::Text(text) => rows.text(index, text),
                Cell::Nothing => rows.nothing(index),
            }
        }
        rows.end_row()?;
    }
    rows.close()?;
    let mut out = out;
    out.write_all(&bytes)
}
