//! Outcome → CSV: one line per sample, two (before and after) per event, in order of time; every number in full.
//!
//! Columns: `t`, `event` (empty for a sample, else `grip slips`, `grip slips (after)`), coordinates, velocities,
//! `force(item)`, `kinetic`, `potential`, `work(item)` if asked for, `observe`d names, `mode`; each with its unit where it is
//! known, `x [m]`. Samples at the instant of an event are its two lines.

use super::rows::{Cell, Table};
use super::with_unit;
use crate::outcome::Outcome;
use lagrange_core::error::Shortest;
use std::io::{self, Write};

/// Writes `outcome` as CSV with a header line.
pub fn write(outcome: &Outcome, out: impl Write) -> io::Result<()> {
    let table = Table::new(outcome);
    let mut csv = ::csv::Writer::from_writer(out);
    let columns = table.columns().into_iter();
    csv.write_record(columns.map(|column| with_unit(&column.name, &column.unit)))?;
    for row in table.rows() {
        let cells = table.cells(&row).into_iter();
        csv.write_record(cells.map(|cell| match cell {
            Cell::Number(number) => Shortest(number).to_string(),
            Cell::Text(text) => text,
            Cell::Nothing => String::new(),
        }))?;
    }
    csv.flush()
}
