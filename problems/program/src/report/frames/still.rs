//! One instant.

use super::element::{self, Element};
use super::layout::{CURSOR, LETTER, Layout, Place, letters};
use super::{Clock, Panel};
use crate::report::picture::{self, Form, WIDTH};
use lagrange_engine::inspect::print::mathml::escaped;
use std::fmt::Write;

/// The pictures of a clock's instants, each as the text of an SVG file.
pub fn stills<'a>(panels: &'a [Panel], clock: &'a Clock) -> impl Iterator<Item = String> + 'a {
    let layout = Layout::new(panels);
    let decimals = decimals(layout.last - layout.first);
    clock.instants.iter().map(move |&time| {
        let mut out = layout.open("");
        for (i, panel) in layout.panels.iter().enumerate() {
            panel.open(&mut out, layout.panels.len() > 1);
            let _ = writeln!(out, "<g clip-path=\"url(#clip{i})\">");
            marks(panel, time, &mut out);
            arrows(panel, time, &mut out);
            panel.rulers(&mut out);
            out.push_str("</g>\n");
            panel.bar(&layout, &mut out);
            let x = WIDTH * layout.part(time);
            let (top, y) = (panel.bar_top() - 4.0, panel.words_at());
            let (mode, words) = (layout.mode(panel, time), 9.0 * LETTER);
            let _ = writeln!(
                out,
                "<path class=\"cursor\" d=\"M{x:.1} {top:.1}v{CURSOR}\"/><text class=\"words\" y=\"{y:.1}\">\
                 {}</text><text class=\"words\" x=\"{words:.1}\" y=\"{y:.1}\"{}>{}</text>\n</g>",
                reading(time, decimals),
                letters(&mode, words),
                escaped(&mode)
            );
        }
        out + "</svg>\n"
    })
}

/// Digits after the point with which times of a film are told.
pub(super) fn decimals(duration: f64) -> usize {
    match duration > 0.0 {
        true => (3 - duration.log10().floor() as i32).max(0) as usize,
        false => 0,
    }
}

/// What the clock shows, with so many digits after the point; more of them than there is room for follow a power of ten.
pub(super) fn reading(time: f64, decimals: usize) -> String {
    const ROOM: usize = 9;
    match decimals.checked_sub(3).filter(|_| decimals > ROOM) {
        Some(power) => format!("t = {:.3}e-{power} s", time * 10_f64.powi(power as i32)),
        None => format!("t = {time:.decimals$} s"),
    }
}

/// The scene at an instant, without forces.
pub(super) fn marks(panel: &Place, time: f64, out: &mut String) {
    let place = picture::Place::of(time, &panel.times);
    if let Some(painter) = &panel.painter {
        painter.grid(out);
        painter.below(place, out);
        for trace in &painter.traces {
            put(element::trace(trace, f64::NEG_INFINITY, time), out);
        }
        painter.above(place, out);
    }
    for mark in panel.picture.iter().flat_map(|picture| &picture.marks) {
        match &mark.form {
            Form::Trace { strokes } => {
                put(element::trace(strokes, f64::NEG_INFINITY, time), out);
            }
            _ => put(element::mark(mark, place, panel.seen_height()), out),
        }
    }
}

/// Forces at an instant.
pub(super) fn arrows(panel: &Place, time: f64, out: &mut String) {
    let place = picture::Place::of(time, &panel.times);
    for (i, arrow) in panel.arrows(place).iter().enumerate() {
        let dot = element::dot(i, arrow);
        let [arrow, name] = element::arrow(i, arrow);
        put([dot, arrow, name].into_iter().flatten(), out);
    }
}

fn put(elements: impl IntoIterator<Item = Element>, out: &mut String) {
    for element in elements {
        element.write("", out);
    }
}
