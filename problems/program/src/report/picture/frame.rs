//! Which part of the plane is seen, and how long arrows are.

use super::impulse::{self, Rows};
use super::{Column, WIDTH};
use crate::drawing::{Shape, union};
use crate::film::Film;
use crate::outcome::Outcome;

/// Part of the picture that the strongest force takes.
const LONGEST: f64 = 0.2;
/// Part of the forces that is drawn to scale at least: few peaks must not make all others invisible.
const TO_SCALE: f64 = 0.95;
/// Arrows of stronger forces, in terms of the strongest one that is to scale, are cut.
const CUT: f64 = 1.2;

/// A window on the plane.
pub(crate) struct Frame {
    left: f64,
    right: f64,
    low: f64,
    high: f64,
    /// Largest extent of what is drawn, m.
    pub size: f64,
    /// Units per metre.
    pub scale: f64,
    /// How long arrows of forces are.
    pub newtons: Newtons,
    /// How long arrows of impulses are.
    pub blows: Newtons,
}

/// How long the arrows of forces are.
pub(crate) struct Newtons {
    /// The strongest force that is drawn to scale, N; 0 if there are none.
    pub strongest: f64,
    /// Metres of an arrow for each newton.
    pub reach: f64,
}

impl Newtons {
    /// For forces of these sizes, N, in a picture of `size` metres.
    pub fn new(sizes: impl Iterator<Item = f64>, size: f64) -> Self {
        let mut sizes: Vec<f64> = sizes.filter(|f| f.is_finite() && *f > 0.0).collect();
        sizes.sort_by(f64::total_cmp);
        let at = (TO_SCALE * sizes.len() as f64) as usize;
        Self::to_scale(sizes.get(at).copied().unwrap_or(0.0), size)
    }

    /// For forces of which the strongest that is to scale is this one, N.
    pub fn to_scale(strongest: f64, size: f64) -> Self {
        Self {
            strongest,
            reach: if strongest > 0.0 {
                LONGEST * size / strongest
            } else {
                0.0
            },
        }
    }

    /// The force from which on arrows are cut, N.
    pub fn most(&self) -> f64 {
        CUT * self.strongest
    }

    /// The arrow of a force, m.
    pub fn arrow<const D: usize>(&self, force: [f64; D]) -> [f64; D] {
        let size = force.iter().fold(0.0, |sum: f64, f| sum.hypot(*f));
        let cut = if size > self.most() {
            self.most() / size
        } else {
            1.0
        };
        force.map(|f| f * cut * self.reach)
    }
}

/// The largest of numbers over time.
pub(super) fn largest(column: &Column) -> f64 {
    match column {
        Column::Constant(value) => *value,
        Column::Varying(values) => values.iter().copied().fold(f64::NEG_INFINITY, f64::max),
    }
}

impl Frame {
    /// Around all that is ever drawn in these films, arrows too.
    pub fn around<'a>(films: impl Iterator<Item = &'a Film> + Clone) -> Option<Self> {
        let drawings = films.clone().flat_map(|film| &film.drawings);
        let extents = drawings.flat_map(|d| &d.shapes).map(Shape::extent);
        let [left, right, low, high] = extents.reduce(union)?;
        let size = [right - left, high - low, 1e-9]
            .into_iter()
            .filter(|x| x.is_finite())
            .fold(0.0, f64::max);
        let all = |rows: fn(&Outcome) -> Rows, impulse: bool| -> Vec<[f64; 4]> {
            films
                .clone()
                .flat_map(|film| pushes(film, &rows(&film.outcome), impulse))
                .collect()
        };
        let forces = all(impulse::forces, false);
        let impulses = all(impulse::impulses, true);
        let sizes = |pushes: &[[f64; 4]]| -> Vec<f64> {
            pushes.iter().map(|[_, _, x, y]| x.hypot(*y)).collect()
        };
        let strongest = sizes(&impulses).into_iter().fold(0.0, f64::max);
        let mut frame = Self {
            left,
            right,
            low,
            high,
            size,
            scale: 1.0,
            newtons: Newtons::new(sizes(&forces).into_iter(), size),
            blows: Newtons::to_scale(strongest, size),
        };
        // Far ends: the tips of forces, the beginnings of impulses.
        let far = |pushes: &[[f64; 4]], newtons: &Newtons, sign: f64| -> Vec<[f64; 2]> {
            let end = |&[x, y, fx, fy]: &[f64; 4]| {
                let [dx, dy] = newtons.arrow([fx, fy]);
                [x + sign * dx, y + sign * dy]
            };
            pushes.iter().map(end).collect()
        };
        let ends = [
            far(&forces, &frame.newtons, 1.0),
            far(&impulses, &frame.blows, -1.0),
        ]
        .concat();
        for [x, y] in ends {
            (frame.left, frame.right) = (frame.left.min(x), frame.right.max(x));
            (frame.low, frame.high) = (frame.low.min(y), frame.high.max(y));
        }
        let grow = |from: f64, to: f64, least: f64| {
            let more = (0.5 * (least - (to - from))).max(0.0) + 0.06 * size;
            (from - more, to + more)
        };
        (frame.left, frame.right) = grow(frame.left, frame.right, 0.5 * size);
        (frame.low, frame.high) = grow(frame.low, frame.high, 0.25 * size);
        frame.scale = WIDTH / (frame.right - frame.left);
        Some(frame)
    }

    /// Units across.
    pub fn x(&self, x: f64) -> f64 {
        (x - self.left) * self.scale
    }

    /// Units down.
    pub fn y(&self, y: f64) -> f64 {
        (self.high - y) * self.scale
    }

    /// Units from top to bottom.
    pub fn height(&self) -> f64 {
        (self.high - self.low) * self.scale
    }

    /// A length for a ruler, m.
    pub fn ruler(&self) -> f64 {
        super::nice((self.right - self.left) / 6.0)
    }
}

/// Places of all arrows at all samples and what acts there: x and y, m, and the components, N or N s.
fn pushes(film: &Film, acting: &Rows, impulse: bool) -> Vec<[f64; 4]> {
    let samples = film.drawings.iter().zip(acting);
    let pushes = samples.flat_map(|(drawing, acting)| {
        drawing.arrows.iter().map(move |arrow| {
            let ([x, y], [fx, fy]) = (arrow.at, arrow.sum(acting, impulse));
            [x, y, fx, fy]
        })
    });
    pushes.collect()
}
