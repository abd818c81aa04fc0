//! Outcome → SVG: forces and state over time, with the modes as shaded bands.
//!
//! ```text
//!   title
//!   forces  N   │ 1 │2│ 3      ─ rim   ─ |grip|   ┄ μN of grip
//!   angles  °   │   │ │        ─ θ     ─ φ
//!   others  m   │   │ │        ─ r     ─ x
//!   1 rim closed, grip sticks   2 rim closed, grip slips   3 rim open
//! ```

mod curves;
mod panel;

use crate::outcome::Outcome;
use curves::{bands, panels};
use panel::Frame;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// Subdivision of a pixel. The drawing library knows whole numbers only, so the picture is drawn this much larger
/// and scaled down by its view box.
pub(super) const FINE: u32 = 10;

pub(super) const WIDTH: u32 = 900 * FINE;
const TITLE: u32 = 34 * FINE;
const PANEL: u32 = 210 * FINE;
const AXIS: u32 = 38 * FINE;
const KEY_LINE: u32 = 20 * FINE;
/// Room for the names of the curves, right of the panels.
const NAMES: u32 = 150 * FINE;
/// Room around the key.
const MARGIN: u32 = 14 * FINE;

/// Colours that colour-blind readers can tell apart (Okabe & Ito 2008).
pub(super) const COLOURS: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(86, 180, 233),
    RGBColor(230, 159, 0),
    RGBColor(60, 60, 60),
];

/// Tints of the modes.
const TINTS: [RGBColor; 6] = [
    RGBColor(226, 238, 248),
    RGBColor(252, 233, 216),
    RGBColor(229, 243, 232),
    RGBColor(246, 231, 241),
    RGBColor(253, 245, 214),
    RGBColor(236, 236, 236),
];

/// The picture, as the text of an SVG file.
///
/// # Errors
/// A sentence, if there is nothing to draw or the drawing fails.
pub fn svg(outcome: &Outcome) -> Result<String, String> {
    let (Some(first), Some(last)) = (outcome.first(), outcome.last()) else {
        return Err("there is nothing to plot: the run did not begin".to_owned());
    };
    if last.time <= first.time {
        return Err("there is nothing to plot: the run ended at its first instant".to_owned());
    }
    let panels = panels(outcome);
    let bands = bands(outcome);
    let columns = key_columns(&bands.names);
    let key = bands.names.len().div_ceil(columns) as u32 * KEY_LINE;
    let height = TITLE + panels.len() as u32 * PANEL + AXIS + key + 8 * FINE;
    let mut text = String::new();
    {
        let root = SVGBackend::with_string(&mut text, (WIDTH, height)).into_drawing_area();
        root.fill(&WHITE).map_err(|e| e.to_string())?;
        let (title, rest) = root.split_vertically(TITLE);
        let heading = words(17, &BLACK, HPos::Left, VPos::Center);
        title
            .draw_text(outcome.scene, &heading, (MARGIN as i32, TITLE as i32 / 2))
            .map_err(|e| e.to_string())?;
        let (body, foot) = rest.split_vertically(panels.len() as u32 * PANEL + AXIS);
        let count = panels.len();
        let mut rest = body;
        for (index, panel) in panels.iter().enumerate() {
            let bottom = index + 1 == count;
            let (area, below) = rest.split_vertically(PANEL + if bottom { AXIS } else { 0 });
            rest = below;
            let frame = Frame {
                from: first.time,
                to: last.time,
                bands: &bands,
                top: index == 0,
                bottom,
            };
            panel::draw(&area, panel, &frame).map_err(|e| e.to_string())?;
        }
        panel::draw_key(&foot, &bands.names, columns).map_err(|e| e.to_string())?;
        root.present().map_err(|e| e.to_string())?;
    }
    let drawn = format!("width=\"{WIDTH}\" height=\"{height}\"");
    let shown = format!("width=\"{}\" height=\"{}\"", WIDTH / FINE, height / FINE);
    Ok(text.replacen(&drawn, &shown, 1))
}

/// As many columns as the longest name of a mode allows.
fn key_columns(names: &[String]) -> usize {
    let longest = names
        .iter()
        .map(|name| name.chars().count())
        .max()
        .unwrap_or(0) as u32;
    let width = (longest * 7 + 50) * FINE;
    (((WIDTH - 2 * MARGIN) / width) as usize).clamp(1, names.len().max(1))
}

/// Text of a height in pixels.
pub(super) fn words<'a>(
    height: u32,
    colour: &impl Color,
    horizontal: HPos,
    vertical: VPos,
) -> TextStyle<'a> {
    let font = ("sans-serif", height * FINE).into_font();
    font.color(colour).pos(Pos::new(horizontal, vertical))
}

/// A length in pixels.
pub(super) fn px(length: i32) -> i32 {
    length * FINE as i32
}
