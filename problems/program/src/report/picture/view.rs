//! A view of a stage: where on a page its points are seen, in perspective from the front, the right and above.

use super::{Stage, WIDTH, hundredths};
use crate::space::Vector;

/// Turn about the vertical, and height above the level, rad.
const FROM: [f64; 2] = [0.5, 0.4];
/// Distance of the eye from the middle, in sizes of the scene.
const AWAY: f64 = 3.0;
/// Part of the page's width that stays free on each side.
const AIR: f64 = 0.06;

/// An eye and a page.
pub(crate) struct View {
    pub eye: Vector,
    side: Vector,
    up: Vector,
    /// From the scene to the eye.
    back: Vector,
    /// Units of the page for what is seen at an angle of 1.
    scale: f64,
    left: f64,
    top: f64,
    /// Units from top to bottom.
    pub height: f64,
}

impl View {
    /// Of all that is ever on a stage.
    pub fn of(stage: &Stage) -> Self {
        let (low, high) = (Vector::from(stage.low), Vector::from(stage.high));
        let ((s, c), (f, e)) = (FROM[0].sin_cos(), FROM[1].sin_cos());
        let (side, back) = (Vector::new(c, s, 0.0), Vector::new(s * e, -c * e, f));
        let mut view = Self {
            eye: 0.5 * (low + high) + AWAY * (high - low).norm() * back,
            side,
            up: back.cross(&side),
            back,
            scale: 1.0,
            left: 0.0,
            top: 0.0,
            height: 0.0,
        };
        let corner = |k: usize| {
            Vector::from_fn(|axis, _| {
                if k >> axis & 1 == 0 {
                    low[axis]
                } else {
                    high[axis]
                }
            })
        };
        let seen: Vec<[f64; 2]> = (0..8).map(|k| view.place(corner(k))).collect();
        let ends = |k: usize| {
            let values = seen.iter().map(|place| place[k]);
            (
                values.clone().fold(f64::INFINITY, f64::min),
                values.fold(f64::NEG_INFINITY, f64::max),
            )
        };
        let ((left, right), (top, bottom)) = (ends(0), ends(1));
        // No flatter than 1 : 4, no higher than 3 : 4.
        let wide = (right - left).max((bottom - top) / 0.75).max(1e-12) / (1.0 - 2.0 * AIR);
        let high = (bottom - top + 2.0 * AIR * wide).max(0.25 * wide);
        view.scale = WIDTH / wide;
        view.left = 0.5 * (left + right - wide);
        view.top = 0.5 * (top + bottom - high);
        view.height = hundredths(high * view.scale);
        view
    }

    /// Where a point is seen: to the right and down from the page's corner.
    pub fn place(&self, at: Vector) -> [f64; 2] {
        let from_eye = at - self.eye;
        let away = -from_eye.dot(&self.back);
        let (x, y) = (
            from_eye.dot(&self.side) / away,
            -from_eye.dot(&self.up) / away,
        );
        [(x - self.left) * self.scale, (y - self.top) * self.scale]
    }

    /// How many units long a metre is seen at a point.
    pub fn scale_at(&self, at: Vector) -> f64 {
        self.scale / (self.eye - at).dot(&self.back)
    }
}
