//! Marks and arrows at an instant → elements of an SVG file: what in them moves, and what does not.

use super::layout::Seen;
use crate::report::picture::palette::colour;
use crate::report::picture::{Form, Mark, Place, Stroke, WIDTH, outline, part};
use lagrange_engine::inspect::print::mathml::escaped;
use std::fmt::Write;

/// An element at an instant.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Element {
    tag: &'static str,
    /// Attributes that never change, each with a space before it.
    fixed: String,
    /// Name and value of the others.
    pub moving: Vec<(&'static str, String)>,
    /// What stands in it.
    text: String,
}

impl Element {
    fn new(tag: &'static str, fixed: String, moving: Vec<(&'static str, String)>) -> Self {
        Self {
            tag,
            fixed,
            moving,
            text: String::new(),
        }
    }

    /// As text, with more inside.
    pub fn write(&self, inside: &str, out: &mut String) {
        let Self {
            tag, fixed, text, ..
        } = self;
        let _ = write!(out, "<{tag}{fixed}");
        for (name, value) in &self.moving {
            let _ = write!(out, " {name}=\"{value}\"");
        }
        let _ = match (inside, text.as_str()) {
            ("", "") => writeln!(out, "/>"),
            _ => writeln!(out, ">{text}{inside}</{tag}>"),
        };
    }
}

/// A mark at a place among the samples; nothing where its numbers are none.
pub(super) fn mark(mark: &Mark, place: Place, height: f64) -> Option<Element> {
    let n: Vec<f64> = mark.numbers.iter().map(|column| column.at(place)).collect();
    if n.iter().any(|number| !number.is_finite()) {
        return None;
    }
    let class = format!(" class=\"{}\"", mark.class);
    Some(match (&mark.form, n.as_slice()) {
        (Form::Circle, [x, y, r]) => {
            let moving = vec![("cx", short(*x)), ("cy", short(*y)), ("r", short(*r))];
            Element::new("circle", class, moving)
        }
        (Form::Polygon, points) => Element::new("polygon", class, vec![("points", pairs(points))]),
        (Form::Polyline, points) => {
            Element::new("polyline", class, vec![("points", pairs(points))])
        }
        (Form::Ground, [y]) => {
            let (width, height) = (WIDTH + 18.0, short(height + 9.0));
            let fixed = format!("{class} x=\"-9\" width=\"{width}\" height=\"{height}\"");
            Element::new("rect", fixed, vec![("y", short(*y))])
        }
        (Form::Placed { line }, [x, y, angle, stretch]) => {
            let (sin, cos) = angle.to_radians().sin_cos();
            let joint = |[along, across]: &[f64; 2]| {
                let along = along * stretch;
                [
                    x + along * cos - across * sin,
                    y + along * sin + across * cos,
                ]
            };
            let joints: Vec<f64> = line.iter().flat_map(joint).collect();
            Element::new("polyline", class, vec![("points", pairs(&joints))])
        }
        _ => return None,
    })
}

/// What of a path is drawn from one time to another; nothing if it has gaps there or stays where it is seen already.
pub(super) fn trace(strokes: &[Stroke], from: f64, to: f64) -> Option<Element> {
    let mut line = String::new();
    for stroke in strokes {
        for (k, [x, y]) in part(stroke, from, to).into_iter().enumerate() {
            let pen = if k == 0 { 'M' } else { 'L' };
            let _ = write!(line, "{pen}{} {}", short(x), short(y));
        }
    }
    let class = " class=\"trace\"".to_owned();
    (!line.is_empty()).then(|| Element::new("path", class, vec![("d", line)]))
}

/// Radius of the dot where a force acts.
const DOT: f64 = 4.0;

/// The dot where the arrow number `index` acts, which is gone with the force; nothing where that is nowhere.
pub(super) fn dot(index: usize, seen: &Seen) -> Option<Element> {
    let [x, y] = seen.acts.filter(|at| at.iter().all(|x| x.is_finite()))?;
    let radius = outline(seen.ends).map_or(0.0, |_| DOT);
    let moving = vec![("cx", short(x)), ("cy", short(y)), ("r", short(radius))];
    Some(Element::new(
        "circle",
        format!(" fill=\"{}\"", colour(index)),
        moving,
    ))
}

/// The arrow number `index`, unless it is nowhere: its outline, and its name if there is room for one.
pub(super) fn arrow(index: usize, seen: &Seen) -> [Option<Element>; 2] {
    if !seen.ends.iter().all(|end| end.is_finite()) {
        return [None, None];
    }
    let fill = format!(" fill=\"{}\"", colour(index));
    let [x, y, ..] = seen.ends;
    let corners = outline(seen.ends).unwrap_or([[x, y]; 7]);
    let points = vec![("points", pairs(&corners.concat()))];
    let name = seen.label.map(|[x, y]| Element {
        text: escaped(&seen.name),
        ..Element::new(
            "text",
            format!(" class=\"name\" text-anchor=\"middle\"{fill}"),
            vec![("x", short(x)), ("y", short(y))],
        )
    });
    [Some(Element::new("polygon", fill, points)), name]
}

/// `x,y x,y …`
pub(super) fn pairs(numbers: &[f64]) -> String {
    let mut text = String::new();
    for pair in numbers.chunks_exact(2) {
        let space = if text.is_empty() { "" } else { " " };
        let _ = write!(text, "{space}{},{}", short(pair[0]), short(pair[1]));
    }
    text
}

/// To a tenth of a unit.
fn short(x: f64) -> String {
    let tenths = (x * 10.0).round() / 10.0;
    // Not `-0`.
    (tenths + 0.0).to_string()
}
