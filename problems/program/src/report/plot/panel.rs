//! One panel of curves over shaded bands.

use super::axis::Axis;
use super::curves::{Bands, Curve, DASHES, Panel, pieces, with_comma};
use super::{
    Area, COLOURS, Drawn, FINE, LETTER, MOST_NAMES, NAME_LINE, NAMES, TINTS, WIDTH, px, words,
};
use crate::outcome::Outcome;
use crate::quantity::Quantity;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, VPos};

/// What all panels of a picture share.
pub(super) struct Frame<'b> {
    pub outcomes: &'b [&'b Outcome],
    /// Room left of all panels.
    pub beside: u32,
    pub bands: &'b Bands,
    /// Whether it carries the numbers of the modes.
    pub top: bool,
    /// Whether it carries the axis from left to right.
    pub bottom: bool,
}

/// A curve with its points, as it is drawn.
struct Line<'p> {
    curve: &'p Curve,
    /// Number of its run.
    run: usize,
    pieces: Vec<Vec<(f64, f64)>>,
}

/// Of several runs each has its colour and quantities have dashes, of one run quantities have colours.
fn look(curve: &Curve, order: usize, several: bool) -> (usize, usize) {
    match several {
        true => (COLOURS.len() - 1, order % DASHES.len()),
        false => (curve.colour, curve.dash),
    }
}

/// A panel with its curves as points, and its axes.
pub(super) struct Ready<'p> {
    panel: &'p Panel,
    lines: Vec<Line<'p>>,
    x: Axis,
    y: Axis,
}

/// Numbers on the axis from left to right, and on the one upwards, about.
const ACROSS: usize = 10;
const UPWARD: usize = 8;

impl<'p> Ready<'p> {
    pub fn new(panel: &'p Panel, outcomes: &[&Outcome], (first, last): (f64, f64)) -> Self {
        let of_one = |curve: &'p Curve| {
            let runs = outcomes.iter().enumerate();
            runs.map(move |(run, outcome)| Line {
                curve,
                run,
                pieces: pieces(outcome, &panel.over, &curve.quantity),
            })
        };
        let mut lines: Vec<Line> = panel.curves.iter().flat_map(of_one).collect();
        let points = || lines.iter().flat_map(|line| line.pieces.iter().flatten());
        let y = Axis::around(points().map(|(_, y)| *y), 2.0);
        let x = match panel.over == Quantity::Time {
            true => Axis::between(first, last),
            false => Axis::around(points().map(|(x, _)| *x), 1.0),
        };
        for point in lines
            .iter_mut()
            .flat_map(|line| line.pieces.iter_mut().flatten())
        {
            *point = (x.at(point.0), y.at(point.1));
        }
        Self { panel, lines, x, y }
    }

    /// Room for the numbers left of it and what they are.
    pub fn beside(&self) -> u32 {
        (22 + 8 * self.y.letters(UPWARD) as u32) * FINE
    }
}

pub(super) fn draw<'a>(area: &Area<'a>, ready: &Ready, frame: &Frame) -> Drawn<'a> {
    let Ready { panel, lines, x, y } = ready;
    let d = frame.outcomes[0].description;
    let over_time = panel.over == Quantity::Time;
    let mut across = with_comma(&panel.over.name(d), &panel.over.unit(d));
    if let Some(origin) = x.origin() {
        across = format!("{across}, {origin}");
    }
    let mut chart = ChartBuilder::on(area)
        .margin_left(px(8))
        .margin_top(px(6))
        .margin_bottom(if frame.bottom { 0 } else { px(8) })
        .margin_right(NAMES)
        .set_label_area_size(LabelAreaPosition::Left, frame.beside)
        .set_label_area_size(
            LabelAreaPosition::Bottom,
            if frame.bottom { px(42) } else { 0 },
        )
        .build_cartesian_2d(x.low..x.high, y.low..y.high)?;
    let no_bands: &[(f64, f64, usize)] = &[];
    let spans = if over_time {
        &frame.bands.spans
    } else {
        no_bands
    };
    chart.draw_series(spans.iter().map(|&(from, to, mode)| {
        Rectangle::new(
            [(x.at(from), y.low), (x.at(to), y.high)],
            TINTS[mode % TINTS.len()].filled(),
        )
    }))?;
    let mut mesh = chart.configure_mesh();
    if over_time {
        mesh.disable_x_mesh();
    }
    mesh.light_line_style(TRANSPARENT)
        .bold_line_style(BLACK.mix(0.10).stroke_width(FINE))
        .axis_style(BLACK.stroke_width(FINE))
        .set_all_tick_mark_size(px(5))
        .x_labels(if frame.bottom { ACROSS } else { 0 })
        .y_labels(UPWARD)
        .x_label_formatter(&|number| x.label(*number))
        .y_label_formatter(&|number| y.label(*number))
        .x_desc(if frame.bottom { across.as_str() } else { "" })
        .y_desc(panel.title.as_str())
        .axis_desc_style(("sans-serif", 14 * FINE))
        .label_style(("sans-serif", 13 * FINE))
        .draw()?;
    let several = frame.outcomes.len() > 1;
    for (index, line) in lines.iter().enumerate() {
        let (colour, dash) = look(line.curve, index / frame.outcomes.len(), several);
        let colour = if several { line.run } else { colour };
        let style = COLOURS[colour % COLOURS.len()].stroke_width(2 * FINE);
        for piece in &line.pieces {
            let points = piece.iter().copied();
            match DASHES[dash] {
                Some((dash, gap)) => {
                    chart.draw_series(DashedLineSeries::new(points, px(dash), px(gap), style))?
                }
                None => chart.draw_series(LineSeries::new(points, style))?,
            };
        }
    }
    if frame.top {
        let style = words(13, &BLACK.mix(0.6), HPos::Center, VPos::Top);
        let wide = |&&(from, to, _): &&(f64, f64, usize)| to - from > 0.015 * x.length();
        chart.draw_series(spans.iter().filter(wide).map(|&(from, to, mode)| {
            Text::new(
                (mode + 1).to_string(),
                (x.at(0.5 * (from + to)), y.high),
                style.clone(),
            )
        }))?;
    }
    if let Some(origin) = y.origin() {
        let style = words(13, &BLACK.mix(0.6), HPos::Left, VPos::Top);
        let corner = (x.low + 0.006 * x.length(), y.high);
        chart.draw_series([Text::new(origin, corner, style)])?;
    }
    draw_names(area, panel, frame)
}

/// Names of the curves, right of the panel.
fn draw_names<'a>(area: &Area<'a>, panel: &Panel, frame: &Frame) -> Drawn<'a> {
    let style = words(13, &BLACK, HPos::Left, VPos::Center);
    let left = (WIDTH - NAMES) as i32 + px(10);
    let (d, several) = (frame.outcomes[0].description, frame.outcomes.len() > 1);
    let line = |order: usize| px(16) + order as i32 * NAME_LINE as i32;
    for (order, curve) in panel.curves.iter().take(MOST_NAMES).enumerate() {
        let y = line(order);
        let (colour, dash) = look(curve, order, several);
        sample(area, (left, y), COLOURS[colour % COLOURS.len()], dash)?;
        area.draw(&Text::new(
            fitted(&curve.quantity.name(d), NAMES - px(38) as u32),
            (left + px(28), y),
            style.clone(),
        ))?;
    }
    if let Some(more) = panel.curves.len().checked_sub(MOST_NAMES + 1) {
        let more = format!("and {} more", more + 1);
        area.draw(&Text::new(more, (left + px(28), line(MOST_NAMES)), style))?;
    }
    Ok(())
}

/// A text with its middle left out where it is longer than the room.
pub(super) fn fitted(text: &str, room: u32) -> String {
    let most = (room / LETTER) as usize;
    let letters: Vec<char> = text.chars().collect();
    if letters.len() <= most {
        return text.to_owned();
    }
    let (begin, end) = (most / 2, most - most / 2 - 1);
    let begin = letters.iter().take(begin);
    let end = letters.iter().skip(letters.len() - end);
    begin.chain(&['…']).chain(end).collect()
}

/// A piece of a curve, beside its name.
pub(super) fn sample<'a>(
    area: &Area<'a>,
    (left, y): (i32, i32),
    colour: RGBColor,
    dash: usize,
) -> Drawn<'a> {
    const LONG: i32 = 22;
    let (dash, gap) = DASHES[dash].unwrap_or((LONG, 0));
    for from in (0..LONG).step_by((dash + gap) as usize) {
        let ends = [from, (from + dash).min(LONG)].map(|x| (left + px(x), y));
        area.draw(&PathElement::new(
            ends.to_vec(),
            colour.stroke_width(2 * FINE),
        ))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::{LETTER, fitted};

    #[test]
    fn long_names_lose_their_middle() {
        assert_eq!(fitted("|grip|", 8 * LETTER), "|grip|");
        assert_eq!(fitted("friction of the left θ", 9 * LETTER), "fric…ft θ");
    }
}
