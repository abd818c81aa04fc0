//! Sweep → SVG: curves over one axis, a map over two, the points of a sample.
//!
//! Colours are Viridis (Smith and van der Walt 2015), which colour-blind readers and printers in grey keep apart. Where runs failed the
//! picture is hatched, where they do not have what was observed it is grey. Pictures do not grow with the sweep: cells that are too
//! many are put together, of many points the first are drawn.

mod curves;
mod dots;
mod frame;
mod map;
mod marks;
mod scale;

use super::Failure;
use crate::report::plot::{FINE, WIDTH, px, words};
use crate::report::with_unit;
use crate::sweep::{Journal, Sampling, Sweep};
use frame::Frame;
use marks::Marks;
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, VPos};
use std::io;

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Drawn<'a> = Result<(), DrawingAreaErrorKind<<SVGBackend<'a> as DrawingBackend>::ErrorType>>;

const HEIGHT: u32 = 520 * FINE;

/// What a kind of picture puts together before anything is drawn.
struct Picture {
    heading: String,
    /// Names in colours, at the top.
    names: Vec<(String, RGBColor)>,
    frame: Frame,
    /// The scale of colours, with its name.
    colours: Option<(scale::Scale, String)>,
    marks: Marks,
}

/// The picture, as the text of an SVG file: all observations over one axis, the first one over two or more.
///
/// # Errors
/// The journal is not complete; no run has what was observed.
pub fn svg(sweep: &Sweep, journal: &Journal) -> Result<String, Failure> {
    let one = sweep.points.axes.len() == 1;
    let picture = match (sweep.points.sampling, one) {
        (Sampling::Grid, true) => curves::curves(sweep, journal)?,
        (Sampling::Grid, false) => map::map(sweep, journal)?,
        (Sampling::Sample { .. }, true) => dots::over_one(sweep, journal)?,
        (Sampling::Sample { .. }, false) => dots::over_two(sweep, journal)?,
    };
    let picture = picture.ok_or_else(|| {
        reason("there is nothing to draw: no run has what was observed".to_owned())
    })?;
    let mut text = String::new();
    {
        let root = SVGBackend::with_string(&mut text, (WIDTH, HEIGHT)).into_drawing_area();
        draw(&root, &picture).map_err(|e| reason(e.to_string()))?;
        root.present().map_err(|e| reason(e.to_string()))?;
    }
    let drawn = format!("width=\"{WIDTH}\" height=\"{HEIGHT}\"");
    let shown = format!("width=\"{}\" height=\"{}\"", WIDTH / FINE, HEIGHT / FINE);
    let mut text = text.replacen(&drawn, &shown, 1);
    // What is drawn first is the background; marks come before axes and words.
    if let Some(place) = text.find("/>") {
        text.insert_str(place + 2, &picture.marks.svg());
    }
    Ok(text)
}

fn reason(text: String) -> Failure {
    Failure::File(io::Error::other(text))
}

fn draw<'a>(root: &Area<'a>, picture: &Picture) -> Drawn<'a> {
    root.fill(&WHITE)?;
    let heading = words(17, &BLACK, HPos::Left, VPos::Center);
    root.draw_text(&picture.heading, &heading, (px(14), px(20)))?;
    for (line, (name, colour)) in picture.names.iter().enumerate() {
        let style = words(14, colour, HPos::Right, VPos::Center);
        let place = (picture.frame.right, px(20 + 18 * line as i32));
        root.draw_text(name, &style, place)?;
    }
    picture.frame.draw(root)?;
    if let Some((scale, name)) = &picture.colours {
        frame::colour_scale(root, scale, name)?;
    }
    for (text, place) in picture.marks.key() {
        let style = words(13, &BLACK, HPos::Left, VPos::Center);
        root.draw_text(text, &style, *place)?;
    }
    Ok(())
}

/// The scene, and the first observation with its unit.
fn heading(sweep: &Sweep) -> String {
    format!("{}: {}", sweep.scene.name(), observed(sweep, 0))
}

/// An observation with its unit.
fn observed(sweep: &Sweep, index: usize) -> String {
    with_unit(&sweep.observed[index].name, &sweep.unit_observed(index))
}

/// An axis with its unit.
fn varied(sweep: &Sweep, index: usize) -> String {
    with_unit(&sweep.points.axes[index].name, &sweep.unit_varied(index))
}

/// From dark blue to yellow, each step lighter than the last.
fn shade(part: f64) -> RGBColor {
    ViridisRGB.get_color(part.clamp(0.0, 1.0))
}
