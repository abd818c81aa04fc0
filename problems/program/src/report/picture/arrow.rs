//! Forces as arrows.

use super::frame::{Frame, Newtons};
use super::impulse::{self, Rows};
use super::{Column, hundredths, strength};
use crate::drawing;
use crate::film::Film;
use serde::Serialize;

/// A force over time.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct Arrow {
    /// Name of the item.
    pub name: String,
    /// Whether it is an impulse, seen for a while after its impact.
    #[serde(skip_serializing_if = "is_false")]
    pub impulse: bool,
    /// How large it is, N or N s.
    pub size: Column,
    /// Where it begins, and the arrow from there: x, y, x, y. Forces begin where they act, impulses end there.
    pub numbers: [Column; 4],
}

/// Shorter arrows are not drawn.
pub(crate) const SHORTEST: f64 = 2.0;

pub(super) fn is_false(flag: &bool) -> bool {
    !flag
}

/// Forces, then impulses, which end where they act.
pub(super) fn arrows(film: &Film, frame: &Frame) -> Vec<Arrow> {
    let forces = of(
        film,
        frame,
        &impulse::forces(&film.outcome),
        &frame.newtons,
        false,
    );
    let impulses = of(
        film,
        frame,
        &impulse::impulses(&film.outcome),
        &frame.blows,
        true,
    )
    .into_iter();
    let ever = impulses.filter(|arrow| arrow.size != Column::Constant(0.0));
    let named = ever.map(|arrow| Arrow {
        name: format!("impulse of {}", arrow.name),
        ..arrow
    });
    forces.into_iter().chain(named).collect()
}

/// A number of an arrow, from where it acts, m, and its components, N or N s.
type Number<'n> = &'n dyn Fn([f64; 2], [f64; 2]) -> f64;

/// An arrow for each force of the drawing, or each impulse.
fn of(film: &Film, frame: &Frame, acting: &Rows, newtons: &Newtons, impulse: bool) -> Vec<Arrow> {
    let Some(first) = film.drawings.first().filter(|_| !acting.is_empty()) else {
        return Vec::new();
    };
    // The part of it that is before the place where it acts.
    let back = if impulse { 1.0 } else { 0.0 };
    let arrow = |(i, arrow): (usize, &drawing::Arrow<2>)| {
        let samples = film.drawings.iter().zip(acting);
        let pushes: Vec<([f64; 2], [f64; 2])> = samples
            .map(|(drawing, acting)| {
                let arrow = &drawing.arrows[i];
                (arrow.at, arrow.sum(acting, impulse))
            })
            .collect();
        let over = |number: Number| {
            let numbers = pushes.iter().map(|(at, force)| number(*at, *force));
            Column::of(numbers.map(hundredths))
        };
        Arrow {
            name: arrow.name.to_owned(),
            impulse,
            size: Column::of(pushes.iter().map(|(_, [x, y])| strength(x.hypot(*y)))),
            numbers: [
                over(&|at, force| frame.x(at[0] - back * newtons.arrow(force)[0])),
                over(&|at, force| frame.y(at[1] - back * newtons.arrow(force)[1])),
                over(&|_, force| frame.scale * newtons.arrow(force)[0]),
                over(&|_, force| -frame.scale * newtons.arrow(force)[1]),
            ],
        }
    };
    first.arrows.iter().enumerate().map(arrow).collect()
}

/// The outline of an arrow from one point to another; nothing if it is too short to be seen.
pub(crate) fn outline([x1, y1, x2, y2]: [f64; 4]) -> Option<[[f64; 2]; 7]> {
    let length = (x2 - x1).hypot(y2 - y1);
    if !(length >= SHORTEST) {
        return None;
    }
    let (ux, uy) = ((x2 - x1) / length, (y2 - y1) / length);
    let tip = (0.5 * length).min(18.0);
    // Along the arrow from its beginning, and to its left.
    let corners = [
        (0.0, 1.5),
        (length - tip, 1.5),
        (length - tip, 0.45 * tip),
        (length, 0.0),
        (length - tip, -0.45 * tip),
        (length - tip, -1.5),
        (0.0, -1.5),
    ];
    Some(corners.map(|(along, left)| [x1 + along * ux - left * uy, y1 + along * uy + left * ux]))
}

/// Where the middle of the foot of an arrow's name stands, in letters of a size: beyond its tip, inside the picture. None for
/// arrows so short that the name would hide them.
pub(crate) fn label(
    [x1, y1, x2, y2]: [f64; 4],
    characters: usize,
    letter: f64,
    height: f64,
) -> Option<[f64; 2]> {
    let length = (x2 - x1).hypot(y2 - y1);
    if !(length >= 0.5 * letter) {
        return None;
    }
    let half = 0.3 * letter * characters as f64;
    let x = x2 + (x2 - x1) / length * (half + 6.0);
    let middle = y2 + (y2 - y1) / length * (0.5 * letter + 6.0);
    let within = |value: f64, most: f64, margin: f64| value.min(most - margin).max(margin);
    Some([
        within(x, super::WIDTH, half),
        within(middle, height, 0.6 * letter) + 0.35 * letter,
    ])
}
