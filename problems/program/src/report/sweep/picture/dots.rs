//! The points of a sample: values over one axis, colours over two.

use super::colours::{Colours, Look};
use super::curves::{height, look, panels};
use super::frame::Frame;
use super::marks::Marks;
use super::regions::Regions;
use super::scale::Scale;
use super::{HEIGHT, Picture, heading, observed, varied};
use crate::report::plot::{COLOURS, px};
use crate::report::sweep::{Failure, lines};
use crate::sweep::{Journal, Sweep};

/// Most points that are drawn: the first, which are as well spread as all.
const MOST: usize = 5000;

/// A point that is drawn.
struct Dot {
    point: Vec<f64>,
    observed: Vec<f64>,
    failed: bool,
}

fn dots(sweep: &Sweep, journal: &Journal) -> Result<Vec<Dot>, Failure> {
    let mut dots = Vec::new();
    lines(sweep, journal, |point, observed, failure| {
        if dots.len() < MOST {
            dots.push(Dot {
                point: point.to_vec(),
                observed: observed.to_vec(),
                failed: failure.is_some(),
            });
        }
        Ok(())
    })?;
    Ok(dots)
}

/// Least and greatest.
fn edges<'d>(values: impl Iterator<Item = &'d f64>) -> Option<(f64, f64)> {
    values.filter(|v| !v.is_nan()).fold(None, |edges, &v| {
        let (low, high) = edges.unwrap_or((v, v));
        Some((v.min(low), v.max(high)))
    })
}

fn marks(dots: &[Dot]) -> Marks {
    Marks::of_size(px(if dots.len() > 1000 { 4 } else { 6 }))
}

/// What is said of points that are not drawn.
fn note(sweep: &Sweep, dots: &[Dot]) -> String {
    match sweep.points.len() {
        all if all > dots.len() => format!(", the first {} of {all} points", dots.len()),
        _ => String::new(),
    }
}

/// `None` if no run has what was observed.
pub(super) fn over_one(sweep: &Sweep, journal: &Journal) -> Result<Option<Picture>, Failure> {
    let dots = dots(sweep, journal)?;
    let panels = panels(sweep, Scale::of(&sweep.points.axes[0], 0.0), |numbers| {
        edges(
            dots.iter()
                .flat_map(|dot| numbers.iter().map(|index| &dot.observed[*index])),
        )
    });
    if panels.is_empty() {
        return Ok(None);
    }
    let mut marks = marks(&dots);
    for (dot, (frame, numbers)) in dots
        .iter()
        .flat_map(|dot| panels.iter().map(move |panel| (dot, panel)))
    {
        for (index, colour) in numbers.iter().zip(COLOURS.iter().cycle()) {
            let value = dot.observed[*index];
            if !value.is_nan() {
                marks.dot(look(*colour), frame.place(dot.point[0], value));
            }
        }
        if dot.failed {
            let x = frame.column(frame.x.part(dot.point[0]));
            marks.dot(Look::Failed, (x, frame.bottom - px(5)));
        }
    }
    let crosses = if dots.iter().any(|dot| dot.failed) {
        " (crosses: failed)"
    } else {
        ""
    };
    Ok(Some(Picture {
        heading: format!("{}{}{crosses}", sweep.scene.name(), note(sweep, &dots)),
        colours: None,
        marks,
        key: Vec::new(),
        height: height(panels.len()),
        frames: panels.into_iter().map(|(frame, _)| frame).collect(),
    }))
}

/// `None` if no run has what was observed.
pub(super) fn over_two(sweep: &Sweep, journal: &Journal) -> Result<Option<Picture>, Failure> {
    let dots = dots(sweep, journal)?;
    let Some((low, high)) = edges(dots.iter().map(|dot| &dot.observed[0])) else {
        return Ok(None);
    };
    let sequences = sweep.observed[0].is_sequence();
    let regions = Regions::of(
        dots.iter()
            .map(|dot| dot.observed[0])
            .filter(|v| sequences && !v.is_nan()),
    );
    let colours = Colours::new(low, high, observed(sweep, 0));
    let axes = &sweep.points.axes;
    let frame = Frame::new(
        (Scale::of(&axes[0], 0.0), varied(sweep, 0)),
        (Scale::of(&axes[1], 0.0), varied(sweep, 1)),
    );
    let mut marks = marks(&dots);
    for dot in &dots {
        let look = match dot.observed[0] {
            value if !value.is_nan() && sequences => regions.look(value),
            value if !value.is_nan() => colours.look(value),
            _ if dot.failed => Look::Failed,
            _ => Look::None,
        };
        marks.dot(look, frame.place(dot.point[0], dot.point[1]));
    }
    marks.explain();
    let mut picture = Picture {
        heading: heading(sweep) + &note(sweep, &dots),
        frames: vec![frame],
        colours: (!sequences).then_some(colours),
        marks,
        key: Vec::new(),
        height: HEIGHT,
    };
    if sequences {
        regions.explain(&sweep.observed[0], &mut picture);
    }
    Ok(Some(picture))
}
