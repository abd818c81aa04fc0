//! What changes from one picture of a film to the next.

use super::raster::Raster;

/// A rectangle of a raster.
pub(super) struct Patch {
    pub left: usize,
    pub top: usize,
    pub width: usize,
    pub height: usize,
}

impl Patch {
    /// Where two rasters of a size differ; a corner if they do not.
    pub(super) fn between(before: Option<&Raster>, now: &Raster) -> Self {
        let Some(before) = before else {
            return Self {
                left: 0,
                top: 0,
                width: now.width(),
                height: now.height(),
            };
        };
        let (mut left, mut right, mut top, mut bottom) = (usize::MAX, 0, usize::MAX, 0);
        for (index, (a, b)) in before.colours().zip(now.colours()).enumerate() {
            if a != b {
                let (x, y) = (index % now.width(), index / now.width());
                (left, right) = (left.min(x), right.max(x));
                (top, bottom) = (top.min(y), bottom.max(y));
            }
        }
        match left <= right {
            true => Self {
                left,
                top,
                width: right - left + 1,
                height: bottom - top + 1,
            },
            false => Self {
                left: 0,
                top: 0,
                width: 1,
                height: 1,
            },
        }
    }

    /// Its colours line by line; nothing where they are as before.
    pub(super) fn colours<'r>(
        &'r self,
        before: Option<&'r Raster>,
        now: &'r Raster,
    ) -> impl Iterator<Item = Option<[u8; 3]>> + 'r {
        let lines = self.top..self.top + self.height;
        let places = lines.flat_map(|y| (self.left..self.left + self.width).map(move |x| (x, y)));
        places.map(move |(x, y)| {
            let colour = now.colour(x, y);
            before
                .is_none_or(|before| before.colour(x, y) != colour)
                .then_some(colour)
        })
    }
}
