//! Sweep → SVG: curves over one axis, or a map over two.

use super::{Failure, lines};
use crate::report::plot::{COLOURS, FINE, WIDTH, px, words};
use crate::sweep::{Axis, Journal, Sampling, Sweep};
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, VPos};
use std::io;

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Drawn<'a> = Result<(), DrawingAreaErrorKind<<SVGBackend<'a> as DrawingBackend>::ErrorType>>;

const HEIGHT: u32 = 520 * FINE;
/// Room for the scale of a map.
const SCALE: i32 = 110;

/// The picture, as the text of an SVG file: the first observation over one axis or two.
///
/// # Errors
/// The journal is not complete; the sweep has no grid of one or two axes; nothing was observed.
pub fn svg(sweep: &Sweep, journal: &Journal) -> Result<String, Failure> {
    let reason = |text: &str| Failure::File(io::Error::other(text.to_owned()));
    let axes = &sweep.points.axes;
    if sweep.points.sampling != Sampling::Grid || !(1..=2).contains(&axes.len()) {
        return Err(reason("a picture needs a grid of one or two axes"));
    }
    let mut values: Vec<Vec<f64>> = vec![Vec::new(); sweep.observed.len()];
    lines(sweep, journal, |_, observed, _| {
        for (values, value) in values.iter_mut().zip(observed) {
            values.push(*value);
        }
        Ok(())
    })?;
    let seen = values.iter().flatten().any(|value| value.is_finite());
    if !seen {
        return Err(reason(
            "there is nothing to draw: no run has what was observed",
        ));
    }
    let mut text = String::new();
    {
        let root = SVGBackend::with_string(&mut text, (WIDTH, HEIGHT)).into_drawing_area();
        draw(&root, sweep, &values).map_err(|e| reason(&e.to_string()))?;
        root.present().map_err(|e| reason(&e.to_string()))?;
    }
    let drawn = format!("width=\"{WIDTH}\" height=\"{HEIGHT}\"");
    let shown = format!("width=\"{}\" height=\"{}\"", WIDTH / FINE, HEIGHT / FINE);
    Ok(text.replacen(&drawn, &shown, 1))
}

fn draw<'a>(root: &Area<'a>, sweep: &Sweep, values: &[Vec<f64>]) -> Drawn<'a> {
    root.fill(&WHITE)?;
    let heading = words(17, &BLACK, HPos::Left, VPos::Center);
    let names: Vec<&str> = sweep.observed.iter().map(|o| o.name.as_str()).collect();
    match &sweep.points.axes[..] {
        [axis] => {
            let title = sweep.scene.name().to_owned();
            root.draw_text(&title, &heading, (px(14), px(20)))?;
            curves(root, axis, &names, values)
        }
        [x, y, ..] => {
            let title = format!("{}: {}", sweep.scene.name(), names[0]);
            root.draw_text(&title, &heading, (px(14), px(20)))?;
            map(root, x, y, &values[0])
        }
        [] => Ok(()),
    }
}

/// Position of an axis' values: themselves, or their logarithms.
fn position(axis: &Axis, value: f64) -> f64 {
    if axis.logarithmic {
        value.log10()
    } else {
        value
    }
}

fn number(axis: &Axis, position: f64) -> String {
    let value = if axis.logarithmic {
        10_f64.powf(position)
    } else {
        position
    };
    short(value)
}

/// A number in four digits.
fn short(value: f64) -> String {
    let text = format!("{value:.3e}");
    match text.split_once('e') {
        Some((_, power)) if (-3..5).contains(&power.parse().unwrap_or(0)) => {
            let digits = (3 - power.parse::<i32>().unwrap_or(0)).max(0) as usize;
            let plain = format!("{value:.digits$}");
            match plain.contains('.') {
                true => plain.trim_end_matches('0').trim_end_matches('.').to_owned(),
                false => plain,
            }
        }
        _ => text,
    }
}

/// Edges of the finite numbers.
fn range<'v>(values: impl Iterator<Item = &'v f64>) -> (f64, f64) {
    let finite = values.filter(|v| v.is_finite());
    let (low, high) = finite.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &v| {
        (low.min(v), high.max(v))
    });
    let room = if high > low {
        0.0
    } else {
        0.5 * low.abs().max(1.0)
    };
    (low - room, high + room)
}

fn curves<'a>(root: &Area<'a>, axis: &Axis, names: &[&str], values: &[Vec<f64>]) -> Drawn<'a> {
    let (low, high) = range(values.iter().flatten());
    let room = 0.05 * (high - low);
    let (from, to) = (position(axis, axis.from), position(axis, axis.to));
    let mut chart = ChartBuilder::on(root)
        .margin_left(px(8))
        .margin_top(px(42))
        .margin_right(px(24))
        .set_label_area_size(LabelAreaPosition::Left, px(64))
        .set_label_area_size(LabelAreaPosition::Bottom, px(48))
        .build_cartesian_2d(from.min(to)..to.max(from), low - room..high + room)?;
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(BLACK.mix(0.10).stroke_width(FINE))
        .axis_style(BLACK.stroke_width(FINE))
        .set_all_tick_mark_size(px(5))
        .x_label_formatter(&|x| number(axis, *x))
        .y_label_formatter(&|y| short(*y))
        .x_desc(axis.name.as_str())
        .axis_desc_style(("sans-serif", 14 * FINE))
        .label_style(("sans-serif", 13 * FINE))
        .draw()?;
    for (index, (name, values)) in names.iter().zip(values).enumerate() {
        let style = COLOURS[index % COLOURS.len()].stroke_width(2 * FINE);
        let part = |i: usize| i as f64 / (values.len().max(2) - 1) as f64;
        let points = values
            .iter()
            .enumerate()
            .map(|(i, v)| (from + (to - from) * part(i), *v));
        let points: Vec<(f64, f64)> = points.collect();
        // A curve ends where runs do not have the observation.
        for piece in points.split(|(_, v)| !v.is_finite()) {
            if piece.len() == 1 {
                chart.draw_series([Circle::new(piece[0], 2 * FINE, style.filled())])?;
            }
            chart.draw_series(LineSeries::new(piece.iter().copied(), style))?;
        }
        let y = px(20 + 18 * index as i32);
        let colour = COLOURS[index % COLOURS.len()];
        let label = words(14, &colour, HPos::Right, VPos::Center);
        root.draw_text(name, &label, (WIDTH as i32 - px(24), y))?;
    }
    Ok(())
}

fn map<'a>(root: &Area<'a>, x: &Axis, y: &Axis, values: &[f64]) -> Drawn<'a> {
    let (low, high) = range(values.iter());
    let edge = |axis: &Axis| {
        let (from, to) = (position(axis, axis.from), position(axis, axis.to));
        let half = 0.5 * (to - from) / (axis.count.max(2) - 1) as f64;
        (from - half, to + half)
    };
    let ((left, right), (bottom, top)) = (edge(x), edge(y));
    let mut chart = ChartBuilder::on(root)
        .margin_left(px(8))
        .margin_top(px(42))
        .margin_right(px(SCALE))
        .set_label_area_size(LabelAreaPosition::Left, px(64))
        .set_label_area_size(LabelAreaPosition::Bottom, px(48))
        .build_cartesian_2d(left..right, bottom..top)?;
    chart
        .configure_mesh()
        .disable_mesh()
        .axis_style(BLACK.stroke_width(FINE))
        .set_all_tick_mark_size(px(5))
        .x_label_formatter(&|p| number(x, *p))
        .y_label_formatter(&|p| number(y, *p))
        .x_desc(x.name.as_str())
        .y_desc(y.name.as_str())
        .axis_desc_style(("sans-serif", 14 * FINE))
        .label_style(("sans-serif", 13 * FINE))
        .draw()?;
    let (width, height) = (
        (right - left) / x.count as f64,
        (top - bottom) / y.count as f64,
    );
    let cells = values
        .iter()
        .enumerate()
        .filter(|(_, value)| value.is_finite());
    chart.draw_series(cells.map(|(index, value)| {
        let (column, row) = ((index / y.count) as f64, (index % y.count) as f64);
        let corner = (left + column * width, bottom + row * height);
        let colour = shade((value - low) / (high - low));
        Rectangle::new(
            // Each a trifle too large: no line shows between them.
            [corner, (corner.0 + 1.1 * width, corner.1 + 1.1 * height)],
            colour.filled(),
        )
    }))?;
    scale(root, low, high)
}

/// The colours of a map with their numbers.
fn scale<'a>(root: &Area<'a>, low: f64, high: f64) -> Drawn<'a> {
    const STEPS: i32 = 64;
    let (left, top, bottom) = (
        WIDTH as i32 - px(SCALE - 24),
        px(48),
        HEIGHT as i32 - px(60),
    );
    let place = |step: i32| bottom - (bottom - top) * step / STEPS;
    for step in 0..STEPS {
        let colour = shade((f64::from(step) + 0.5) / f64::from(STEPS));
        let corners = [(left, place(step + 1) - 1), (left + px(16), place(step))];
        root.draw(&Rectangle::new(corners, colour.filled()))?;
    }
    for quarter in 0..=4 {
        let value = low + (high - low) * f64::from(quarter) / 4.0;
        let style = words(13, &BLACK, HPos::Left, VPos::Center);
        let at = (left + px(22), place(quarter * STEPS / 4));
        root.draw(&Text::new(short(value), at, style))?;
    }
    Ok(())
}

/// From dark blue to yellow, each step lighter than the last (Viridis; Smith and van der Walt 2015).
fn shade(part: f64) -> RGBColor {
    ViridisRGB.get_color(part.clamp(0.0, 1.0))
}
