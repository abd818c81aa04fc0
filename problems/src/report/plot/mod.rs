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

const WIDTH: u32 = 900;
const TITLE: u32 = 34;
const PANEL: u32 = 210;
const AXIS: u32 = 30;
const KEY_LINE: u32 = 20;
/// Room for the names of the curves, right of the panels.
const NAMES: u32 = 150;

/// Colours that colour-blind readers can tell apart (Okabe & Ito 2008).
const COLOURS: [RGBColor; 7] = [
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
    let key = key_lines(bands.names.len());
    let height = TITLE + panels.len() as u32 * PANEL + AXIS + key * KEY_LINE + 8;
    let mut text = String::new();
    {
        let root = SVGBackend::with_string(&mut text, (WIDTH, height)).into_drawing_area();
        root.fill(&WHITE).map_err(|e| e.to_string())?;
        let (title, rest) = root.split_vertically(TITLE);
        let heading = ("sans-serif", 17)
            .into_font()
            .color(&BLACK)
            .pos(Pos::new(HPos::Left, VPos::Center));
        title
            .draw_text(outcome.scene, &heading, (14, TITLE as i32 / 2))
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
        panel::draw_key(&foot, &bands.names, key_columns(bands.names.len()))
            .map_err(|e| e.to_string())?;
        root.present().map_err(|e| e.to_string())?;
    }
    Ok(text)
}

fn key_columns(modes: usize) -> usize {
    modes.clamp(1, 3)
}

fn key_lines(modes: usize) -> u32 {
    modes.div_ceil(key_columns(modes)) as u32
}
