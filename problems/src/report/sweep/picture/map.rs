//! A map over the first two axes of a grid.

use super::frame::Frame;
use super::marks::{Look, Marks};
use super::scale::Scale;
use super::{Picture, heading, observed, varied};
use crate::report::sweep::{Failure, lines};
use crate::sweep::{Journal, Sweep};

/// Most cells of a map, sideways and upward.
const MOST: (usize, usize) = (300, 200);

/// What is known of the runs of a cell.
#[derive(Clone, Copy, Default)]
struct Cell {
    sum: f64,
    count: usize,
    failed: bool,
}

impl Cell {
    /// The mean of what is known.
    fn value(&self) -> Option<f64> {
        (self.count > 0).then(|| self.sum / self.count as f64)
    }
}

/// `None` if no run has what was observed.
pub(super) fn map(sweep: &Sweep, journal: &Journal) -> Result<Option<Picture>, Failure> {
    let axes = &sweep.points.axes;
    let (x, y) = (&axes[0], &axes[1]);
    let (columns, rows) = (x.count.min(MOST.0), y.count.min(MOST.1));
    let others: usize = axes[2..].iter().map(|axis| axis.count).product();
    let mut cells = vec![Cell::default(); columns * rows];
    let mut index = 0;
    lines(sweep, journal, |_, observed, failure| {
        let (i, j) = (index / others / y.count, index / others % y.count);
        let cell = &mut cells[i * columns / x.count * rows + j * rows / y.count];
        if !observed[0].is_nan() {
            cell.sum += observed[0];
            cell.count += 1;
        }
        cell.failed |= failure.is_some();
        index += 1;
        Ok(())
    })?;
    let values = cells.iter().filter_map(Cell::value);
    let Some((low, high)) = values.fold(None, |edges, v| {
        let (low, high) = edges.unwrap_or((v, v));
        Some((v.min(low), v.max(high)))
    }) else {
        return Ok(None);
    };
    let colours = Scale::around(low, high, 0.0);
    let frame = Frame::new(
        (Scale::of(x, 0.5), varied(sweep, 0)),
        (Scale::of(y, 0.5), varied(sweep, 1)),
        false,
        0,
    );
    let look = |cell: &Cell| match cell.value() {
        Some(value) => Look::at(colours.part(value)),
        None if cell.failed => Look::Failed,
        None => Look::None,
    };
    let mut marks = Marks::default();
    // An axis may go down.
    let column = |i: usize| frame.column(turned(i, columns, x.from > x.to));
    let row = |j: usize| frame.row(turned(j, rows, y.from > y.to));
    for j in 0..rows {
        let mut i = 0;
        while i < columns {
            let first = look(&cells[i * rows + j]);
            let alike = (i..columns).take_while(|i| look(&cells[i * rows + j]) == first);
            let end = i + alike.count();
            marks.cell(first, (column(i), row(j)), (column(end), row(j + 1)));
            i = end;
        }
    }
    marks.explain();
    let mut heading = heading(sweep);
    if axes.len() > 2 {
        let names: Vec<&str> = axes[2..].iter().map(|axis| axis.name.as_str()).collect();
        heading += &format!(", mean over {}", names.join(", "));
    }
    Ok(Some(Picture {
        heading,
        names: Vec::new(),
        frame,
        colours: Some((colours, observed(sweep, 0))),
        marks,
    }))
}

/// Edge number `index` of `count` cells, as a part of the way.
fn turned(index: usize, count: usize, down: bool) -> f64 {
    let part = index as f64 / count as f64;
    if down { 1.0 - part } else { part }
}
