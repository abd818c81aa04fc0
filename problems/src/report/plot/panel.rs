//! One panel of curves over shaded bands, and the key of the modes.

use super::curves::{Bands, Panel};
use super::{COLOURS, FINE, KEY_LINE, MARGIN, NAMES, TINTS, WIDTH, px, words};
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, VPos};

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Drawn<'a> = Result<(), DrawingAreaErrorKind<<SVGBackend<'a> as DrawingBackend>::ErrorType>>;

/// What all panels of a picture share.
pub(super) struct Frame<'b> {
    pub from: f64,
    pub to: f64,
    pub bands: &'b Bands,
    /// Whether it carries the numbers of the modes.
    pub top: bool,
    /// Whether it carries the time axis.
    pub bottom: bool,
}

pub(super) fn draw<'a>(area: &Area<'a>, panel: &Panel, frame: &Frame) -> Drawn<'a> {
    let (low, high) = range(panel);
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
        .build_cartesian_2d(frame.from..frame.to, low..high)?;
    chart.draw_series(frame.bands.spans.iter().map(|&(from, to, mode)| {
        Rectangle::new(
            [(from, low), (to, high)],
            TINTS[mode % TINTS.len()].filled(),
        )
    }))?;
    chart
        .configure_mesh()
        .disable_x_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(BLACK.mix(0.10).stroke_width(FINE))
        .axis_style(BLACK.stroke_width(FINE))
        .set_all_tick_mark_size(px(5))
        .x_labels(if frame.bottom { 10 } else { 0 })
        .y_labels(8)
        .x_label_formatter(&label)
        .y_label_formatter(&label)
        .x_desc(if frame.bottom { "time, s" } else { "" })
        .y_desc(panel.title.as_str())
        .axis_desc_style(("sans-serif", 14 * FINE))
        .label_style(("sans-serif", 13 * FINE))
        .draw()?;
    for curve in &panel.curves {
        let style = COLOURS[curve.colour % COLOURS.len()].stroke_width(2 * FINE);
        for piece in &curve.pieces {
            let points = piece.iter().copied();
            match curve.dashed {
                true => chart.draw_series(DashedLineSeries::new(points, px(5), px(4), style))?,
                false => chart.draw_series(LineSeries::new(points, style))?,
            };
        }
    }
    if frame.top {
        let style = words(13, &BLACK.mix(0.6), HPos::Center, VPos::Top);
        let wide =
            |&&(from, to, _): &&(f64, f64, usize)| to - from > 0.015 * (frame.to - frame.from);
        chart.draw_series(
            frame
                .bands
                .spans
                .iter()
                .filter(wide)
                .map(|&(from, to, mode)| {
                    Text::new(
                        (mode + 1).to_string(),
                        (0.5 * (from + to), high),
                        style.clone(),
                    )
                }),
        )?;
    }
    draw_names(area, panel)
}

/// Names of the curves, right of the panel.
fn draw_names<'a>(area: &Area<'a>, panel: &Panel) -> Drawn<'a> {
    let style = words(13, &BLACK, HPos::Left, VPos::Center);
    let left = (WIDTH - NAMES) as i32 + px(10);
    for (line, curve) in panel.curves.iter().enumerate() {
        let y = px(16 + line as i32 * 19);
        let colour = COLOURS[curve.colour % COLOURS.len()].stroke_width(2 * FINE);
        let dashes: &[(i32, i32)] = if curve.dashed {
            &[(0, 6), (9, 15), (18, 22)]
        } else {
            &[(0, 22)]
        };
        for (from, to) in dashes {
            area.draw(&PathElement::new(
                vec![(left + px(*from), y), (left + px(*to), y)],
                colour,
            ))?;
        }
        area.draw(&Text::new(
            curve.name.clone(),
            (left + px(28), y),
            style.clone(),
        ))?;
    }
    Ok(())
}

/// What the numbered tints mean.
pub(super) fn draw_key<'a>(area: &Area<'a>, names: &[String], columns: usize) -> Drawn<'a> {
    let style = words(13, &BLACK, HPos::Left, VPos::Center);
    let width = (WIDTH - 2 * MARGIN) as i32 / columns as i32;
    for (mode, name) in names.iter().enumerate() {
        let x = MARGIN as i32 + (mode % columns) as i32 * width;
        let y = (mode / columns) as i32 * KEY_LINE as i32 + px(8);
        let tint = TINTS[mode % TINTS.len()];
        area.draw(&Rectangle::new(
            [(x, y - px(7)), (x + px(18), y + px(7))],
            tint.filled(),
        ))?;
        area.draw(&Rectangle::new(
            [(x, y - px(7)), (x + px(18), y + px(7))],
            BLACK.mix(0.3).stroke_width(FINE),
        ))?;
        area.draw(&Text::new(
            format!("{}  {name}", mode + 1),
            (x + px(26), y),
            style.clone(),
        ))?;
    }
    Ok(())
}

/// All values and zero-width safety: a constant curve still gets room.
fn range(panel: &Panel) -> (f64, f64) {
    let values = panel
        .curves
        .iter()
        .flat_map(|curve| &curve.pieces)
        .flatten()
        .map(|(_, value)| *value);
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
        (value.min(low), value.max(high))
    });
    if low > high {
        return (0.0, 1.0);
    }
    let room = if high > low {
        0.08 * (high - low)
    } else {
        0.1 * high.abs().max(1.0)
    };
    (low - room, high + 2.0 * room)
}

/// A number on an axis, without the digits that rounding adds.
fn label(value: &f64) -> String {
    let text = format!("{value:.9}");
    let short = text.trim_end_matches('0').trim_end_matches('.');
    if short == "-0" {
        "0".to_owned()
    } else {
        short.to_owned()
    }
}
