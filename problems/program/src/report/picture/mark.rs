//! Shapes of a scene → marks on the page: circles, polygons and lines, each with its numbers over time.

use super::frame::Frame;
use super::{Column, finely, hundredths};
use crate::drawing::{Point, Shape};
use crate::film::Film;
use crate::path::{self, Path};
use crate::space::Vector;
use serde::Serialize;
use std::cell::Cell;

/// A mark.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct Mark {
    /// How it looks.
    pub class: &'static str,
    /// What it is.
    #[serde(flatten)]
    pub form: Form,
    /// Its numbers over time.
    pub numbers: Vec<Column>,
}

/// What a mark is.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "lowercase", tag = "form")]
pub(crate) enum Form {
    /// x, y, radius
    Circle,
    /// x, y of every corner
    Polygon,
    /// x, y of every joint
    Polyline,
    /// Everything below y
    Ground,
    /// A path
    Trace {
        /// It is drawn stroke by stroke.
        strokes: Vec<Stroke>,
    },
    /// A line on the unit length, moved to x, y, turned by degrees clockwise and stretched along.
    Placed {
        /// Joints, x along from 0 to 1, y across.
        line: Vec<Point>,
    },
}

/// A line that is drawn while time passes: time, s, x and y of every point.
pub(crate) type Stroke = Vec<[f64; 3]>;

/// The part of a stroke that is drawn from one time to another.
pub(crate) fn part(stroke: &[[f64; 3]], from: f64, to: f64) -> Vec<Point> {
    let until = |time: f64| stroke.partition_point(|[t, ..]| *t <= time);
    // Between two points it goes straight on.
    let between = |time: f64| {
        let after = until(time);
        let ([t, x, y], [end, u, v]) = (stroke[after.checked_sub(1)?], *stroke.get(after)?);
        let part = (time - t) / (end - t);
        Some([x + part * (u - x), y + part * (v - y)])
    };
    let inner = stroke[until(from)..until(to)]
        .iter()
        .map(|[_, x, y]| [*x, *y]);
    between(from)
        .into_iter()
        .chain(inner)
        .chain(between(to))
        .collect()
}

/// The strokes of a path, whose points are seen at these places.
fn strokes(path: &Path, place: impl Fn(&Vector) -> Point) -> Vec<Stroke> {
    let seen = |point: &path::Point| {
        let [x, y] = place(&point.at);
        [finely(point.time), hundredths(x), hundredths(y)]
    };
    let strokes = path.strokes.iter();
    strokes
        .map(|stroke| stroke.iter().map(seen).collect())
        .collect()
}

/// Zigzags of a spring.
const TURNS: usize = 16;

/// Half the width of what holds a pivot.
const BRACKET: f64 = 12.0;

/// A mark for each shape, but two for a disc, its rim and its spoke, and for a pivot, its bracket and its pin.
pub(super) fn marks(film: &Film, frame: &Frame) -> Vec<Mark> {
    let drawings = &film.drawings;
    let mut paths = film.paths.iter();
    let Some(first) = drawings.first() else {
        return Vec::new();
    };
    let masses = first.shapes.iter();
    let masses = masses.filter(|s| matches!(s, Shape::Mass(_))).count();
    // Many masses are small.
    let dot = 0.016 * frame.size * frame.scale / (masses as f64 / 4.0).max(1.0);
    let mut marks = Vec::new();
    for (i, shape) in first.shapes.iter().enumerate() {
        let shapes = || drawings.iter().map(move |drawing| &drawing.shapes[i]);
        let mut add = |class, form, numbers: &dyn Fn(&Shape) -> Vec<f64>| {
            let lists: Vec<Vec<f64>> = shapes().map(numbers).collect();
            let width = lists.iter().map(Vec::len).min().unwrap_or(0);
            let column = |k: usize| Column::of(lists.iter().map(|list| hundredths(list[k])));
            marks.push(Mark {
                class,
                form,
                numbers: (0..width).map(column).collect(),
            });
        };
        let points = |shape: &Shape| points(shape, frame);
        let circle = |shape: &Shape| circle(shape, dot, frame);
        match shape {
            Shape::Floor(_) => add("ground", Form::Ground, &|shape| match shape {
                Shape::Floor(y) => vec![frame.y(*y)],
                _ => Vec::new(),
            }),
            Shape::Fixed(_) => add("ground", Form::Polygon, &points),
            Shape::Block(_) => add("body", Form::Polygon, &points),
            Shape::Rod(_) => add("rod", Form::Polyline, &points),
            Shape::Rope(_) => add("rope", Form::Polyline, &points),
            Shape::Shell(..) => add("ground", Form::Circle, &circle),
            Shape::Bowl(..) => add("hollow", Form::Circle, &circle),
            Shape::Mass(_) => add("point", Form::Circle, &circle),
            Shape::Disc(..) => {
                add("body", Form::Circle, &circle);
                add("rod", spoke(), &|shape| radius(shape, frame));
            }
            Shape::Spring(..) => {
                let before = Cell::new(0.0);
                let lengths = shapes().map(|shape| match shape {
                    Shape::Spring([x1, y1], [x2, y2]) => (x2 - x1).hypot(y2 - y1),
                    _ => 0.0,
                });
                let longest = lengths.fold(0.0, f64::max);
                add("rod", spring(frame, longest), &|shape| {
                    let numbers = stretched(shape, before.get(), frame);
                    if let [_, _, angle, _] = numbers[..]
                        && angle.is_finite()
                    {
                        before.set(angle);
                    }
                    numbers
                });
            }
            Shape::Pivot(_) => {
                add("ground", Form::Polygon, &|shape| bracket(shape, frame));
                add("pivot", Form::Circle, &circle);
            }
            Shape::Trace(_) => {
                let seen = |at: &Vector| [frame.x(at.x), frame.y(at.y)];
                let strokes = paths.next().map(|path| strokes(path, seen));
                let strokes = strokes.unwrap_or_default();
                add("trace", Form::Trace { strokes }, &|_| Vec::new());
            }
        }
    }
    marks
}

/// Corners.
fn points(shape: &Shape, frame: &Frame) -> Vec<f64> {
    match shape {
        Shape::Fixed(points) | Shape::Block(points) | Shape::Rod(points) | Shape::Rope(points) => {
            let points = points.iter();
            points
                .flat_map(|[x, y]| [frame.x(*x), frame.y(*y)])
                .collect()
        }
        _ => Vec::new(),
    }
}

/// Centre and radius; that of a mass is `dot`.
fn circle(shape: &Shape, dot: f64, frame: &Frame) -> Vec<f64> {
    match shape {
        Shape::Shell([x, y], r) | Shape::Bowl([x, y], r) | Shape::Disc([x, y], r, _) => {
            vec![frame.x(*x), frame.y(*y), r * frame.scale]
        }
        Shape::Mass([x, y]) => vec![frame.x(*x), frame.y(*y), dot],
        Shape::Pivot([x, y]) => vec![frame.x(*x), frame.y(*y), 0.4 * BRACKET],
        _ => Vec::new(),
    }
}

/// What holds a pivot.
fn bracket(shape: &Shape, frame: &Frame) -> Vec<f64> {
    match shape {
        Shape::Pivot([x, y]) => {
            let (x, y, half, top) = (frame.x(*x), frame.y(*y), BRACKET, 1.7 * BRACKET);
            vec![x, y, x - half, y - top, x + half, y - top]
        }
        _ => Vec::new(),
    }
}

/// Where a spoke begins, its angle and its length.
fn radius(shape: &Shape, frame: &Frame) -> Vec<f64> {
    match shape {
        Shape::Disc([x, y], r, angle) => {
            let angle = -angle.to_degrees() - 90.0;
            vec![frame.x(*x), frame.y(*y), angle, r * frame.scale]
        }
        _ => Vec::new(),
    }
}

/// Where a spring begins, its angle and its length; of all angles that mean the same, the nearest to the one `before`: a spring does not spin.
fn stretched(shape: &Shape, before: f64, frame: &Frame) -> Vec<f64> {
    match shape {
        Shape::Spring([x1, y1], [x2, y2]) => {
            let (dx, dy) = (x2 - x1, y1 - y2);
            let angle = dy.atan2(dx).to_degrees();
            let angle = angle + 360.0 * ((before - angle) / 360.0_f64).round();
            vec![
                frame.x(*x1),
                frame.y(*y1),
                angle,
                dx.hypot(dy) * frame.scale,
            ]
        }
        _ => Vec::new(),
    }
}

/// From the centre to the rim.
fn spoke() -> Form {
    Form::Placed {
        line: vec![[0.0, 0.0], [1.0, 0.0]],
    }
}

/// A zigzag of the same width however long it is at the time; one that is always short beside the picture is narrow.
fn spring(frame: &Frame, longest: f64) -> Form {
    let wide = hundredths((0.025 * frame.size).min(longest / 6.0) * frame.scale);
    let joint = |i: usize| {
        let side = match i {
            0 | TURNS => 0.0,
            i if i % 2 == 0 => wide,
            _ => -wide,
        };
        [i as f64 / TURNS as f64, side]
    };
    Form::Placed {
        line: (0..=TURNS).map(joint).collect(),
    }
}
