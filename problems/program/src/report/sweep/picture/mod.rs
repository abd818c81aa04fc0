//! Sweep → SVG: curves over one axis, a panel for each unit; a map over two; the points of a sample.
//!
//! Where `modes` are observed, sequences of modes are regions, or have lines between them. Where runs failed the picture is hatched, where they do not have what was observed it is grey. Pictures do not grow with the sweep: cells that are too
//! many are put together, of many points the first are drawn.

mod colours;
mod curves;
mod dots;
mod frame;
mod map;
mod marks;
mod regions;
mod scale;

use super::Failure;
use crate::report::letters::Letters;
use crate::report::plot::{Area, Drawn, FINE, draw_in, px, words};
use crate::report::with_unit;
use crate::sweep::{Journal, Sampling, Sweep};
use colours::Colours;
use frame::Frame;
use marks::Marks;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, VPos};
use std::io;

const HEIGHT: u32 = 520 * FINE;

/// What a kind of picture puts together before anything is drawn.
struct Picture {
    heading: String,
    /// The panels, one below the other.
    frames: Vec<Frame>,
    /// The scale of colours, with its name.
    colours: Option<Colours>,
    marks: Marks,
    /// Words below the frame, and where they go.
    key: Vec<(String, (i32, i32))>,
    height: u32,
}

/// Whether there is a picture for what is observed, which can be said before anything is run.
///
/// # Errors
/// A sentence that says what would have one.
pub fn drawable(sweep: &Sweep) -> Result<(), &'static str> {
    match sweep.points.axes.len() == 1 && columns(sweep).1.is_empty() {
        true => Err("modes are drawn over two axes; over one, observe something beside them"),
        false => Ok(()),
    }
}

/// The picture, as the text of an SVG file: all observations over one axis, the first one over two or more. None if no run has what was observed.
///
/// # Errors
/// The journal is not complete.
pub fn svg(sweep: &Sweep, journal: &Journal) -> Result<Option<String>, Failure> {
    let one = sweep.points.axes.len() == 1;
    drawable(sweep).map_err(|words| reason(words.to_owned()))?;
    let picture = match (sweep.points.sampling, one) {
        (Sampling::Grid, true) => curves::curves(sweep, journal)?,
        (Sampling::Grid, false) => map::map(sweep, journal)?,
        (Sampling::Sample { .. }, true) => dots::over_one(sweep, journal)?,
        (Sampling::Sample { .. }, false) => dots::over_two(sweep, journal)?,
    };
    let Some(picture) = picture else {
        return Ok(None);
    };
    let mut text = draw_in(picture.height, |root| draw(root, &picture)).map_err(reason)?;
    // What is drawn first is the background; marks come before axes and words.
    if let Some(place) = text.find("/>") {
        text.insert_str(place + 2, &picture.marks.svg());
    }
    Ok(Some(text))
}

fn reason(text: String) -> Failure {
    Failure::File(io::Error::other(text))
}

fn draw<'a>(root: &Area<'a>, picture: &Picture) -> Drawn<'a> {
    let heading = words(17, &BLACK, HPos::Left, VPos::Center);
    root.draw_text(&picture.heading, &heading, (px(14), px(20)))?;
    for frame in &picture.frames {
        frame.draw(root)?;
    }
    if let Some(colours) = &picture.colours {
        frame::colour_scale(root, colours)?;
    }
    for (text, place) in &picture.key {
        let style = words(13, &BLACK, HPos::Left, VPos::Center);
        root.draw_text(text, &style, *place)?;
    }
    for (text, place) in picture.marks.key() {
        let style = words(13, &BLACK, HPos::Left, VPos::Center);
        root.draw_text(text, &style, *place)?;
    }
    Ok(())
}

/// Columns of `modes` among the observations, and of numbers.
fn columns(sweep: &Sweep) -> (Option<usize>, Vec<usize>) {
    let (sequences, numbers): (Vec<_>, Vec<_>) =
        (0..sweep.observed.len()).partition(|index| sweep.observed[*index].is_sequence());
    (sequences.first().copied(), numbers)
}

/// The scene, and the first observation with its unit.
fn heading(sweep: &Sweep) -> String {
    format!("{}: {}", sweep.scene.name(), observed(sweep, 0))
}

/// An observation with its unit, each word of it that is a name as a letter.
fn observed(sweep: &Sweep, index: usize) -> String {
    let letters = Letters::of(sweep.scene.derivation());
    let name = &sweep.observed[index].name;
    let (what, rest) = name
        .split_once(' ')
        .map_or((name.as_str(), String::new()), |(what, rest)| {
            (what, format!(" {rest}"))
        });
    with_unit(&(letters.letter(what) + &rest), &sweep.unit_observed(index))
}

/// An axis as a letter, with its unit.
fn varied(sweep: &Sweep, index: usize) -> String {
    let letters = Letters::of(sweep.scene.derivation());
    with_unit(
        &letters.letter(&sweep.points.axes[index].name),
        &sweep.unit_varied(index),
    )
}
