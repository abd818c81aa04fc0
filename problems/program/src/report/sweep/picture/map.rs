//! A map over the first two axes of a grid.

use super::colours::{Colours, Look};
use super::frame::Frame;
use super::marks::Marks;
use super::regions::{Regions, borders};
use super::scale::Scale;
use super::{HEIGHT, Picture, columns as columns_of, heading, observed, varied};
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
    /// The sequence of modes of the first run that has one.
    sequence: Option<u64>,
}

impl Cell {
    /// The mean of what is known.
    fn value(&self) -> Option<f64> {
        (self.count > 0).then(|| self.sum / self.count as f64)
    }
}

/// The cells of a map, column by column.
struct Cells {
    columns: usize,
    rows: usize,
    list: Vec<Cell>,
}

impl Cells {
    fn read(sweep: &Sweep, journal: &Journal) -> Result<Cells, Failure> {
        let axes = &sweep.points.axes;
        let (x, y) = (&axes[0], &axes[1]);
        let (columns, rows) = (x.count.min(MOST.0), y.count.min(MOST.1));
        let others: usize = axes[2..].iter().map(|axis| axis.count).product();
        let mut list = vec![Cell::default(); columns * rows];
        let (sequences, _) = columns_of(sweep);
        let mut index = 0;
        lines(sweep, journal, |_, observed, failure| {
            let (i, j) = (index / others / y.count, index / others % y.count);
            let cell = &mut list[i * columns / x.count * rows + j * rows / y.count];
            if !observed[0].is_nan() {
                cell.sum += observed[0];
                cell.count += 1;
            }
            cell.failed |= failure.is_some();
            let known = sequences
                .map(|index| observed[index])
                .filter(|value| !value.is_nan());
            cell.sequence = cell.sequence.or(known.map(|value| value as u64));
            index += 1;
            Ok(())
        })?;
        Ok(Cells {
            columns,
            rows,
            list,
        })
    }

    fn at(&self, column: usize, row: usize) -> &Cell {
        &self.list[column * self.rows + row]
    }

    /// The least and the greatest value, if there is one.
    fn range(&self) -> Option<(f64, f64)> {
        let values = self.list.iter().filter_map(Cell::value);
        values.fold(None, |edges, v| {
            let (low, high) = edges.unwrap_or((v, v));
            Some((v.min(low), v.max(high)))
        })
    }

    /// Marks for all of them, those that look alike side by side as one, and lines between different modes.
    fn draw(
        &self,
        look: impl Fn(&Cell) -> Look,
        column: impl Fn(usize) -> i32,
        row: impl Fn(usize) -> i32,
    ) -> Marks {
        let mut marks = Marks::default();
        for j in 0..self.rows {
            let mut i = 0;
            while i < self.columns {
                let first = look(self.at(i, j));
                let alike = (i..self.columns).take_while(|i| look(self.at(*i, j)) == first);
                let end = i + alike.count();
                marks.cell(first, (column(i), row(j)), (column(end), row(j + 1)));
                i = end;
            }
        }
        let sequence = |i: usize, j: usize| self.at(i, j).sequence;
        let corner = |i, j| (column(i), row(j));
        borders(self.columns, self.rows, sequence, corner, &mut marks);
        marks.explain();
        marks
    }
}

/// `None` if no run has what was observed.
pub(super) fn map(sweep: &Sweep, journal: &Journal) -> Result<Option<Picture>, Failure> {
    let axes = &sweep.points.axes;
    let (x, y) = (&axes[0], &axes[1]);
    let cells = Cells::read(sweep, journal)?;
    let Some((low, high)) = cells.range() else {
        return Ok(None);
    };
    let colours = Colours::new(low, high, observed(sweep, 0));
    let (sequences, _) = columns_of(sweep);
    let by_modes = sequences == Some(0);
    let known = cells.list.iter().filter_map(|cell| cell.sequence);
    let regions = Regions::of(known.filter(|_| by_modes).map(|number| number as f64));
    let frame = Frame::new(
        (Scale::of(x, 0.5), varied(sweep, 0)),
        (Scale::of(y, 0.5), varied(sweep, 1)),
    );
    let look = |cell: &Cell| match (cell.value(), cell.sequence) {
        (_, Some(number)) if by_modes => regions.look(number as f64),
        (Some(value), _) => colours.look(value),
        (None, _) if cell.failed => Look::Failed,
        (None, _) => Look::None,
    };
    // An axis may go down.
    let column = |i: usize| frame.column(turned(i, cells.columns, x.from > x.to));
    let row = |j: usize| frame.row(turned(j, cells.rows, y.from > y.to));
    let marks = cells.draw(look, column, row);
    let mut heading = heading(sweep);
    if axes.len() > 2 {
        let names: Vec<&str> = axes[2..].iter().map(|axis| axis.name.as_str()).collect();
        let how = if by_modes { "the first" } else { "mean" };
        heading += &format!(", {how} over {}", names.join(", "));
    }
    if sequences.is_some() && !by_modes {
        heading += "; lines: other modes";
    }
    let mut picture = Picture {
        heading,
        frames: vec![frame],
        colours: (!by_modes).then_some(colours),
        marks,
        key: Vec::new(),
        height: HEIGHT,
    };
    if by_modes {
        regions.explain(&sweep.observed[0], &mut picture);
    }
    Ok(Some(picture))
}

/// Edge number `index` of `count` cells, as a part of the way.
fn turned(index: usize, count: usize, down: bool) -> f64 {
    let part = index as f64 / count as f64;
    if down { 1.0 - part } else { part }
}
