//! Which mode sequences a picture tells apart: the most frequent, each with a colour and a line of a key below the picture.

use super::colours::Look;
use super::frame::LEFT;
use super::marks::Marks;
use super::{HEIGHT, Picture};
use crate::report::plot::px;
use crate::report::sweep::summary::told;
use crate::sweep::Observation;

/// Colours that colour-blind readers can tell apart (Tol 2021, "light").
const COLOURS: [[u8; 3]; 8] = [
    [119, 170, 221],
    [238, 136, 102],
    [238, 221, 136],
    [68, 187, 153],
    [255, 170, 187],
    [187, 204, 51],
    [153, 221, 255],
    [170, 170, 0],
];

/// Of sequences that are too many.
const OTHER: [u8; 3] = [150, 150, 150];

/// Room for a line of the key.
const LINE: i32 = 22;

/// The sequences with a colour.
pub(super) struct Regions {
    /// Numbers that stand for them, the most frequent first.
    numbers: Vec<u64>,
}

impl Regions {
    /// Of the sequences of cells or points.
    pub(super) fn of(values: impl Iterator<Item = f64>) -> Self {
        let mut counts: Vec<(u64, usize)> = Vec::new();
        for value in values {
            match counts
                .iter_mut()
                .find(|(number, _)| *number == value as u64)
            {
                Some((_, count)) => *count += 1,
                None => counts.push((value as u64, 1)),
            }
        }
        counts.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
        Self {
            numbers: counts.into_iter().map(|(number, _)| number).collect(),
        }
    }

    /// How a sequence looks.
    pub(super) fn look(&self, value: f64) -> Look {
        let place = self
            .numbers
            .iter()
            .position(|number| *number == value as u64);
        let [r, g, b] = place
            .and_then(|place| COLOURS.get(place))
            .copied()
            .unwrap_or(OTHER);
        Look::Plain(r, g, b)
    }

    /// Adds the key to a picture.
    pub(super) fn explain(&self, observed: &Observation, picture: &mut Picture) {
        let shown = self.numbers.iter().take(COLOURS.len());
        let mut lines: Vec<(Look, String)> = shown
            .map(|number| (self.look(*number as f64), told(observed, *number as f64)))
            .collect();
        if let Some(others @ 1..) = self.numbers.len().checked_sub(COLOURS.len()) {
            let [r, g, b] = OTHER;
            lines.push((Look::Plain(r, g, b), format!("{others} other sequences")));
        }
        for (line, (look, words)) in (0..).zip(lines) {
            let y = HEIGHT as i32 + LINE * px(line) + px(4);
            let (left, right) = (px(LEFT), px(LEFT + 16));
            picture
                .marks
                .cell(look, (left, y - px(7)), (right, y + px(7)));
            picture.key.push((words, (right + px(8), y)));
            picture.height = (y + px(16)) as u32;
        }
    }
}

/// Lines between cells of different sequences; cells without one have none.
pub(super) fn borders(
    columns: usize,
    rows: usize,
    sequence: impl Fn(usize, usize) -> Option<u64>,
    corner: impl Fn(usize, usize) -> (i32, i32),
    marks: &mut Marks,
) {
    let differ = |a: Option<u64>, b: Option<u64>| a.is_some() && b.is_some() && a != b;
    for i in 0..columns {
        for j in 0..rows {
            if i + 1 < columns && differ(sequence(i, j), sequence(i + 1, j)) {
                marks.border(corner(i + 1, j), corner(i + 1, j + 1));
            }
            if j + 1 < rows && differ(sequence(i, j), sequence(i, j + 1)) {
                marks.border(corner(i, j + 1), corner(i + 1, j + 1));
            }
        }
    }
}
