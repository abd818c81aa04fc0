//! Curves over the one axis of a grid.

use super::colours::Look;
use super::frame::Frame;
use super::marks::Marks;
use super::scale::Scale;
use super::{HEIGHT, Picture, columns, observed, varied};
use crate::report::plot::{COLOURS, px};
use crate::report::sweep::{Failure, lines};
use crate::sweep::{Journal, Sweep};
use plotters::style::RGBColor;

/// Most pieces that a curve is drawn in.
const MOST: usize = 1500;

/// Values of one piece of an axis: the first, the least, the greatest, the last.
#[derive(Clone, Copy)]
struct Piece {
    ends: [f64; 4],
}

/// `None` if no run has what was observed.
pub(super) fn curves(sweep: &Sweep, journal: &Journal) -> Result<Option<Picture>, Failure> {
    let axis = &sweep.points.axes[0];
    let count = axis.count.min(MOST);
    let (_, numbers) = columns(sweep);
    let mut pieces: Vec<Vec<Option<Piece>>> = vec![vec![None; count]; numbers.len()];
    let mut failed = vec![false; count];
    let mut edges: Option<(f64, f64)> = None;
    let mut index = 0;
    lines(sweep, journal, |_, observed, failure| {
        let place = index * count / axis.count;
        index += 1;
        failed[place] |= failure.is_some();
        for (pieces, &index) in pieces.iter_mut().zip(&numbers) {
            let value = observed[index];
            if value.is_nan() {
                continue;
            }
            let (low, high) = edges.unwrap_or((value, value));
            edges = Some((low.min(value), high.max(value)));
            let [first, least, most, _] = pieces[place].map_or([value; 4], |piece| piece.ends);
            pieces[place] = Some(Piece {
                ends: [first, least.min(value), most.max(value), value],
            });
        }
        Ok(())
    })?;
    let Some((low, high)) = edges else {
        return Ok(None);
    };
    let frame = frame(sweep, Scale::of(axis, 0.5), (low, high));
    let mut marks = Marks::of_size(px(2));
    let down = axis.from > axis.to;
    let edge = |i: usize| {
        let part = i as f64 / count as f64;
        frame.column(if down { 1.0 - part } else { part })
    };
    for (i, _) in failed.iter().enumerate().filter(|(_, failed)| **failed) {
        let (from, to) = (edge(i).min(edge(i + 1)), edge(i).max(edge(i + 1)));
        marks.cell(Look::Failed, (from, frame.top), (to, frame.bottom));
    }
    for (pieces, colour) in pieces.iter().zip(COLOURS.iter().cycle()) {
        let mut curve: Vec<(i32, i32)> = Vec::new();
        for (i, piece) in pieces.iter().enumerate() {
            let Some(piece) = piece else {
                // A curve ends where runs do not have the observation.
                marks.curve(look(*colour), &std::mem::take(&mut curve));
                continue;
            };
            let x = (edge(i) + edge(i + 1)) / 2;
            let heights = piece.ends.map(|value| (x, frame.row(frame.y.part(value))));
            curve.extend(heights);
            curve.dedup();
        }
        marks.curve(look(*colour), &curve);
    }
    Ok(Some(Picture {
        heading: sweep.scene.name().to_owned()
            + if failed.contains(&true) {
                " (hatched: failed)"
            } else {
                ""
            },
        names: names(sweep),
        frame,
        colours: None,
        marks,
        key: Vec::new(),
        height: HEIGHT,
    }))
}

pub(super) fn look(RGBColor(r, g, b): RGBColor) -> Look {
    Look::Plain(r, g, b)
}

/// Observations in their colours, if there are several; one is named on the axis.
pub(super) fn names(sweep: &Sweep) -> Vec<(String, RGBColor)> {
    let (_, several) = columns(sweep);
    let names = several.iter().map(|index| observed(sweep, *index));
    names
        .filter(|_| several.len() > 1)
        .zip(COLOURS.iter().copied().cycle())
        .collect()
}

/// The frame of values over the first axis.
pub(super) fn frame(sweep: &Sweep, x: Scale, (low, high): (f64, f64)) -> Frame {
    let (_, numbers) = columns(sweep);
    let all: Vec<String> = numbers.iter().map(|i| sweep.unit_observed(*i)).collect();
    let y = match (&all[..], &numbers[..]) {
        (_, [one]) => observed(sweep, *one),
        // A unit that all have in common.
        ([first, rest @ ..], _) if rest.iter().all(|unit| unit == first) => first.clone(),
        _ => String::new(),
    };
    let y = (Scale::around(low, high, 0.05), y);
    Frame::new((x, varied(sweep, 0)), y, true, numbers.len())
}
