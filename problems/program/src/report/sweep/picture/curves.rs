//! Curves over the one axis of a grid, and the panels of what is drawn over one axis: what has one unit is on one scale.

use super::colours::Look;
use super::frame::Frame;
use super::marks::Marks;
use super::scale::Scale;
use super::{HEIGHT, Picture, columns, observed, varied};
use crate::report::plot::{COLOURS, FINE, px};
use crate::report::sweep::{Failure, lines};
use crate::sweep::{Journal, Sweep};
use plotters::style::RGBColor;

/// Height of one of several panels.
const PANEL: u32 = 320 * FINE;

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
    let mut edges: Vec<Option<(f64, f64)>> = vec![None; sweep.observed.len()];
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
            edges[index] = joined(edges[index], Some((value, value)));
            let [first, least, most, _] = pieces[place].map_or([value; 4], |piece| piece.ends);
            pieces[place] = Some(Piece {
                ends: [first, least.min(value), most.max(value), value],
            });
        }
        Ok(())
    })?;
    let panels = panels(sweep, Scale::of(axis, 0.5), |numbers| {
        numbers.iter().map(|index| edges[*index]).fold(None, joined)
    });
    let Some((first, _)) = panels.first() else {
        return Ok(None);
    };
    let mut marks = Marks::of_size(px(2));
    let down = axis.from > axis.to;
    let edge = |i: usize| {
        let part = i as f64 / count as f64;
        first.column(if down { 1.0 - part } else { part })
    };
    for (i, _) in failed.iter().enumerate().filter(|(_, failed)| **failed) {
        let (from, to) = (edge(i).min(edge(i + 1)), edge(i).max(edge(i + 1)));
        for (frame, _) in &panels {
            marks.cell(Look::Failed, (from, frame.top), (to, frame.bottom));
        }
    }
    let curves = panels.iter().flat_map(|(frame, indices)| {
        let coloured = indices.iter().zip(COLOURS.iter().cycle());
        coloured.map(move |(index, colour)| (frame, index, colour))
    });
    for (frame, index, colour) in curves {
        let place = numbers.iter().position(|number| number == index);
        let pieces = place.map_or(&[][..], |place| &pieces[place]);
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
        colours: None,
        marks,
        key: Vec::new(),
        height: height(panels.len()),
        frames: panels.into_iter().map(|(frame, _)| frame).collect(),
    }))
}

pub(super) fn look(RGBColor(r, g, b): RGBColor) -> Look {
    Look::Plain(r, g, b)
}

/// What two ranges span.
fn joined(one: Option<(f64, f64)>, other: Option<(f64, f64)>) -> Option<(f64, f64)> {
    match (one, other) {
        (Some((low, high)), Some((below, above))) => Some((low.min(below), high.max(above))),
        _ => one.or(other),
    }
}

/// A panel of values over the first axis for each unit, with the observations in it; none for what no run has.
pub(super) fn panels(
    sweep: &Sweep,
    x: Scale,
    edges: impl Fn(&[usize]) -> Option<(f64, f64)>,
) -> Vec<(Frame, Vec<usize>)> {
    let mut units: Vec<(String, Vec<usize>)> = Vec::new();
    for index in columns(sweep).1 {
        let unit = sweep.unit_observed(index);
        match units.iter_mut().find(|(known, _)| *known == unit) {
            Some((_, numbers)) => numbers.push(index),
            None => units.push((unit, vec![index])),
        }
    }
    let spans = units.into_iter();
    let spans: Vec<_> = spans
        .filter_map(|(unit, numbers)| Some((edges(&numbers)?, unit, numbers)))
        .collect();
    let height = height(spans.len()) as i32 / spans.len().max(1) as i32;
    let framed = (0..)
        .zip(spans)
        .map(|(place, ((low, high), unit, numbers))| {
            let names: Vec<String> = numbers
                .iter()
                .map(|index| observed(sweep, *index))
                .collect();
            let (name, names) = match &names[..] {
                [only] => (only.clone(), Vec::new()),
                _ => (unit, names),
            };
            let names = names.into_iter().zip(COLOURS.iter().copied().cycle());
            let y = (Scale::around(low, high, 0.05), name);
            let frame = Frame::new((x, varied(sweep, 0)), y);
            (
                frame.lined((place * height, height), names.collect()),
                numbers,
            )
        });
    framed.collect()
}

/// Height of a picture with so many panels.
pub(super) fn height(panels: usize) -> u32 {
    match panels {
        0 | 1 => HEIGHT,
        several => several as u32 * PANEL,
    }
}
