//! Outcomes → SVG: quantities of a run over time or over each other; of one run with the modes as shaded bands.
//!
//! ```text
//!   title
//!   forces  N   │ 1 │2│ 3      ─ rim   ─ |grip|   ┄ μN of grip
//!   angles  °   │   │ │        ─ θ     ─ φ
//!   others  m   │   │ │        ─ r     ─ x
//!   1 rim closed, grip sticks   2 rim closed, grip slips   3 rim open
//! ```

mod axis;
mod curves;
mod key;
mod panel;

pub(super) use axis::{Axis, CONSTANT};
pub(super) use curves::{over_time, shown_line};

use crate::outcome::Outcome;
use crate::quantity::{Quantity, Show};
use curves::{Bands, bands, shown, usual};
use key::Key;
use panel::{Frame, Ready};
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

pub(super) type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
pub(super) type Drawn<'a> =
    Result<(), DrawingAreaErrorKind<<SVGBackend<'a> as DrawingBackend>::ErrorType>>;

/// Subdivision of a pixel. The drawing library knows whole numbers only, so the picture is drawn this much larger
/// and scaled down by its view box.
pub(super) const FINE: u32 = 10;

pub(super) const WIDTH: u32 = 900 * FINE;
const TITLE: u32 = 34 * FINE;
const PANEL: u32 = 210 * FINE;
/// A panel over something else than time.
const PORTRAIT: u32 = 420 * FINE;
const AXIS: u32 = 46 * FINE;
/// Room left of the panels, at least.
const BESIDE: u32 = 58 * FINE;
/// Room around the key at the foot.
const FOOT: u32 = 18 * FINE;
const KEY_LINE: u32 = 20 * FINE;
/// Room for the names of the curves, right of the panels.
const NAMES: u32 = 150 * FINE;
/// Height of each of them, and how many are written.
const NAME_LINE: u32 = 19 * FINE;
const MOST_NAMES: usize = 40;
/// Width of a letter of a name, about.
pub(super) const LETTER: u32 = 7 * FINE;
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

/// Tints of the modes: six, and the same darker.
const TINTS: [RGBColor; 12] = [
    RGBColor(226, 238, 248),
    RGBColor(252, 233, 216),
    RGBColor(229, 243, 232),
    RGBColor(246, 231, 241),
    RGBColor(253, 245, 214),
    RGBColor(236, 236, 236),
    RGBColor(200, 220, 239),
    RGBColor(248, 214, 183),
    RGBColor(202, 229, 208),
    RGBColor(233, 203, 223),
    RGBColor(245, 234, 180),
    RGBColor(216, 216, 216),
];

/// A run in a picture.
#[derive(Clone, Copy)]
pub struct Run<'a> {
    /// What it is called where there are several.
    pub title: &'a str,
    /// What happened.
    pub outcome: &'a Outcome,
}

/// Runs of one scene upon each other, as the text of an SVG file: what is asked for or, if nothing is, forces, coordinates and
/// outputs over time.
///
/// # Errors
/// A sentence, if there is nothing to draw or the drawing fails.
pub fn svg(runs: &[Run], shows: &[Show]) -> Result<String, String> {
    let ends = runs
        .iter()
        .filter_map(|run| Some((run.outcome.first()?.time, run.outcome.last()?.time)));
    let Some((first, last)) = ends.reduce(|(a, b), (c, d)| (a.min(c), b.max(d))) else {
        return Err("there is nothing to plot: the run did not begin".to_owned());
    };
    if last <= first {
        return Err("there is nothing to plot: the run ended at its first instant".to_owned());
    }
    let outcomes: Vec<&Outcome> = runs.iter().map(|run| run.outcome).collect();
    let d = outcomes[0].description;
    let panels = match shows {
        [] => usual(&outcomes, d),
        shows => shown(d, shows),
    };
    // Runs upon each other are not in the same modes.
    let bands = match outcomes[..] {
        [one] => bands(one),
        _ => Bands::default(),
    };
    let keys: Vec<String> = match runs {
        [_] => bands.names.clone(),
        runs => runs.iter().map(|run| run.title.to_owned()).collect(),
    };
    let key = Key::new(&keys, runs.len() > 1);
    let alone = |i: usize| {
        panels
            .get(i + 1)
            .is_none_or(|next| next.over != panels[i].over)
    };
    let heights = (0..panels.len()).map(|i| {
        let (panel, axis) = match (alone(i), &panels[i].over) {
            (true, Quantity::Time) => (PANEL, AXIS),
            (true, _) => (PORTRAIT, AXIS),
            (false, _) => (PANEL, 0),
        };
        let names = panels[i].curves.len().min(MOST_NAMES + 1) as u32 * NAME_LINE;
        panel.max(names + FOOT) + axis
    });
    let heights: Vec<u32> = heights.collect();
    let body: u32 = heights.iter().sum();
    let ready = panels
        .iter()
        .map(|panel| Ready::new(panel, &outcomes, (first, last)));
    let ready: Vec<Ready> = ready.collect();
    let beside = ready.iter().map(Ready::beside).fold(BESIDE, u32::max);
    draw_in(TITLE + body + key.height(), |root| {
        let (title, rest) = root.split_vertically(TITLE);
        let heading = words(17, &BLACK, HPos::Left, VPos::Center);
        title.draw_text(
            outcomes[0].scene,
            &heading,
            (MARGIN as i32, TITLE as i32 / 2),
        )?;
        let (mut rest, foot) = rest.split_vertically(body);
        for (index, (panel, height)) in ready.iter().zip(&heights).enumerate() {
            let (area, below) = rest.split_vertically(*height);
            rest = below;
            let frame = Frame {
                outcomes: &outcomes,
                beside,
                bands: &bands,
                top: index == 0,
                bottom: alone(index),
            };
            panel::draw(&area, panel, &frame)?;
        }
        key.draw(&foot)
    })
}

/// A picture of a height as the text of an SVG file.
///
/// # Errors
/// A sentence, if the drawing fails.
pub(super) fn draw_in(
    height: u32,
    draw: impl for<'a> FnOnce(&Area<'a>) -> Drawn<'a>,
) -> Result<String, String> {
    let mut text = String::new();
    {
        let root = SVGBackend::with_string(&mut text, (WIDTH, height)).into_drawing_area();
        root.fill(&WHITE).map_err(|e| e.to_string())?;
        draw(&root).map_err(|e| e.to_string())?;
        root.present().map_err(|e| e.to_string())?;
    }
    let drawn = format!("width=\"{WIDTH}\" height=\"{height}\"");
    let shown = format!("width=\"{}\" height=\"{}\"", WIDTH / FINE, height / FINE);
    // Half of an x is below the middle of figures and capitals.
    Ok(text
        .replacen(&drawn, &shown, 1)
        .replace("dy=\"0.5ex\"", "dy=\"0.36em\""))
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
