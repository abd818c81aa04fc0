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

/// What the runs along the axis have.
struct Runs {
    /// Pieces of each curve; none where no run has the observation.
    pieces: Vec<Vec<Option<Piece>>>,
    /// Pieces of the axis with a run that failed.
    failed: Vec<bool>,
    /// The least and the greatest value of each observation.
    edges: Vec<Option<(f64, f64)>>,
}

impl Runs {
    /// Reads the observations of these `numbers`.
    fn read(sweep: &Sweep, journal: &Journal, numbers: &[usize]) -> Result<Runs, Failure> {
        let axis = &sweep.points.axes[0];
        let count = axis.count.min(MOST);
        let mut runs = Runs {
            pieces: vec![vec![None; count]; numbers.len()],
            failed: vec![false; count],
            edges: vec![None; sweep.observed.len()],
        };
        let mut index = 0;
        lines(sweep, journal, |_, observed, failure| {
            let place = index * count / axis.count;
            index += 1;
            runs.failed[place] |= failure.is_some();
            for (pieces, &index) in runs.pieces.iter_mut().zip(numbers) {
                let value = observed[index];
                if value.is_nan() {
                    continue;
                }
                runs.edges[index] = joined(runs.edges[index], Some((value, value)));
                let [first, least, most, _] = pieces[place].map_or([value; 4], |piece| piece.ends);
                pieces[place] = Some(Piece {
                    ends: [first, least.min(value), most.max(value), value],
                });
            }
            Ok(())
        })?;
        Ok(runs)
    }
}

/// `None` if no run has what was observed.
pub(super) fn curves(sweep: &Sweep, journal: &Journal) -> Result<Option<Picture>, Failure> {
    let axis = &sweep.points.axes[0];
    let (_, numbers) = columns(sweep);
    let runs = Runs::read(sweep, journal, &numbers)?;
    let panels = panels(sweep, Scale::of(axis, 0.5), |numbers| {
        let edges = numbers.iter().map(|index| runs.edges[*index]);
        edges.fold(None, joined)
    });
    let Some((first, _)) = panels.first() else {
        return Ok(None);
    };
    let mut marks = Marks::of_size(px(2));
    let down = axis.from > axis.to;
    let edge = |i: usize| {
        let part = i as f64 / runs.failed.len() as f64;
        first.column(if down { 1.0 - part } else { part })
    };
    let failed = runs.failed.iter().enumerate();
    for (i, _) in failed.filter(|(_, failed)| **failed) {
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
        let pieces = place.map_or(&[][..], |place| &runs.pieces[place]);
        draw(pieces, frame, edge, look(*colour), &mut marks);
    }
    let hatched = match runs.failed.contains(&true) {
        true => " (hatched: failed)",
        false => "",
    };
    Ok(Some(Picture {
        heading: format!("{}{hatched}", sweep.scene.name()),
        colours: None,
        marks,
        key: Vec::new(),
        height: height(panels.len()),
        frames: panels.into_iter().map(|(frame, _)| frame).collect(),
    }))
}

/// One curve, given where each piece of the axis begins; it ends where runs do not have the observation.
fn draw(
    pieces: &[Option<Piece>],
    frame: &Frame,
    edge: impl Fn(usize) -> i32,
    look: Look,
    marks: &mut Marks,
) {
    let mut curve: Vec<(i32, i32)> = Vec::new();
    for (i, piece) in pieces.iter().enumerate() {
        let Some(piece) = piece else {
            marks.curve(look, &std::mem::take(&mut curve));
            continue;
        };
        let x = (edge(i) + edge(i + 1)) / 2;
        let heights = piece.ends.map(|value| (x, frame.row(frame.y.part(value))));
        curve.extend(heights);
        curve.dedup();
    }
    marks.curve(look, &curve);
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
