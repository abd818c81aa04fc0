//! One panel of curves over shaded bands, and the key of the modes.

use super::curves::{Bands, Curve, DASHES, Panel, pieces, with_comma};
use super::{
    Area, COLOURS, Drawn, FINE, KEY_LINE, LETTER, MARGIN, MOST_NAMES, NAME_LINE, NAMES, TINTS,
    WIDTH, px, words,
};
use crate::outcome::Outcome;
use crate::quantity::Quantity;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, VPos};

/// What all panels of a picture share.
pub(super) struct Frame<'b> {
    pub outcomes: &'b [&'b Outcome],
    /// First and last time, s.
    pub times: (f64, f64),
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

pub(super) fn draw<'a>(area: &Area<'a>, panel: &Panel, frame: &Frame) -> Drawn<'a> {
    let d = frame.outcomes[0].description;
    let over_time = panel.over == Quantity::Time;
    let lines = || {
        let curves = panel.curves.iter();
        curves.flat_map(|curve| {
            frame
                .outcomes
                .iter()
                .enumerate()
                .map(move |(run, outcome)| Line {
                    curve,
                    run,
                    pieces: pieces(outcome, &panel.over, &curve.quantity),
                })
        })
    };
    let lines: Vec<Line> = lines().collect();
    let points = || lines.iter().flat_map(|line| line.pieces.iter().flatten());
    let (low, high) = range(points().map(|(_, y)| *y), 2.0);
    let (left, right) = match over_time {
        true => frame.times,
        false => range(points().map(|(x, _)| *x), 1.0),
    };
    let across = with_comma(&panel.over.name(d), &panel.over.unit(d));
    let mut chart = ChartBuilder::on(area)
        .margin_left(px(8))
        .margin_top(px(6))
        .margin_bottom(if frame.bottom { 0 } else { px(8) })
        .margin_right(NAMES)
        .set_label_area_size(LabelAreaPosition::Left, px(58))
        .set_label_area_size(
            LabelAreaPosition::Bottom,
            if frame.bottom { px(42) } else { 0 },
        )
        .build_cartesian_2d(left..right, low..high)?;
    let no_bands: &[(f64, f64, usize)] = &[];
    let spans = if over_time {
        &frame.bands.spans
    } else {
        no_bands
    };
    chart.draw_series(spans.iter().map(|&(from, to, mode)| {
        Rectangle::new(
            [(from, low), (to, high)],
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
        .x_labels(if frame.bottom { 10 } else { 0 })
        .y_labels(8)
        .x_label_formatter(&|x| label(*x, right - left))
        .y_label_formatter(&|y| label(*y, high - low))
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
        let wide = |&&(from, to, _): &&(f64, f64, usize)| to - from > 0.015 * (right - left);
        chart.draw_series(spans.iter().filter(wide).map(|&(from, to, mode)| {
            Text::new(
                (mode + 1).to_string(),
                (0.5 * (from + to), high),
                style.clone(),
            )
        }))?;
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
fn fitted(text: &str, room: u32) -> String {
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
fn sample<'a>(area: &Area<'a>, (left, y): (i32, i32), colour: RGBColor, dash: usize) -> Drawn<'a> {
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

/// What the numbered tints mean, or the colours of several runs.
pub(super) fn draw_key<'a>(
    area: &Area<'a>,
    names: &[String],
    columns: usize,
    several: bool,
) -> Drawn<'a> {
    let style = words(13, &BLACK, HPos::Left, VPos::Center);
    let width = (WIDTH - 2 * MARGIN) as i32 / columns as i32;
    for (mode, name) in names.iter().enumerate() {
        let x = MARGIN as i32 + (mode % columns) as i32 * width;
        let y = (mode / columns) as i32 * KEY_LINE as i32 + px(18);
        if several {
            sample(area, (x, y), COLOURS[mode % COLOURS.len()], 0)?;
            let name = fitted(name, width as u32 - px(30) as u32);
            area.draw(&Text::new(name, (x + px(30), y), style.clone()))?;
            continue;
        }
        let tint = TINTS[mode % TINTS.len()];
        area.draw(&Rectangle::new(
            [(x, y - px(7)), (x + px(18), y + px(7))],
            tint.filled(),
        ))?;
        area.draw(&Rectangle::new(
            [(x, y - px(7)), (x + px(18), y + px(7))],
            BLACK.mix(0.3).stroke_width(FINE),
        ))?;
        let name = format!("{}  {name}", mode + 1);
        area.draw(&Text::new(
            fitted(&name, width as u32 - px(26) as u32),
            (x + px(26), y),
            style.clone(),
        ))?;
    }
    Ok(())
}

/// What values differ by less than this part of their size is rounding, and they are constant on paper.
const CONSTANT: f64 = 1e-11;

/// Around all values, with `above` times as much room above as below: a constant curve gets room, too.
fn range(values: impl Iterator<Item = f64>, above: f64) -> (f64, f64) {
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
        (value.min(low), value.max(high))
    });
    if low > high {
        return (0.0, 1.0);
    }
    let size = high.abs().max(low.abs());
    let room = match high - low > CONSTANT * size {
        true => 0.08 * (high - low),
        false if size == 0.0 => 0.1,
        false => 0.1 * size,
    };
    (low - room, high + above * room)
}

/// A number on an axis of a length, without the digits that rounding adds.
fn label(value: f64, length: f64) -> String {
    if value.abs() < 1e-9 * length {
        return "0".to_owned();
    }
    let text = match (1e-5..1e7).contains(&value.abs()) {
        true => format!("{value:.9}"),
        false => format!("{value:.9e}"),
    };
    let (digits, power) = text.split_at(text.find('e').unwrap_or(text.len()));
    format!(
        "{}{power}",
        digits.trim_end_matches('0').trim_end_matches('.')
    )
}

#[cfg(test)]
mod tests {
    use super::{LETTER, fitted, label, range};

    #[test]
    fn long_names_lose_their_middle() {
        assert_eq!(fitted("|grip|", 8 * LETTER), "|grip|");
        assert_eq!(fitted("friction of the left θ", 9 * LETTER), "fric…ft θ");
    }

    /// A force of a given size is that size to rounding: noise would fill the panel.
    #[test]
    fn what_rounding_alone_changes_is_constant() {
        let force = 0.016_677;
        let (low, high) = range([force, force * (1.0 + 1e-15)].into_iter(), 2.0);
        assert!(low < 0.95 * force && high > 1.05 * force, "{low} {high}");
        let (low, high) = range([1.0, 1.0 + 1e-9].into_iter(), 2.0);
        assert!(high - low < 5e-9, "{low} {high}");
        assert_eq!(range([0.0].into_iter(), 1.0), (-0.1, 0.1));
    }

    #[test]
    fn numbers_of_axes_are_short() {
        assert_eq!(label(0.1 + 0.2, 1.0), "0.3");
        assert_eq!(label(-1e-17, 1.0), "0");
        assert_eq!(label(-2e300, 5e300), "-2e300");
        assert_eq!(label(5e-8, 1e-7), "5e-8");
        assert_eq!(label(200.0, 1000.0), "200");
    }
}
