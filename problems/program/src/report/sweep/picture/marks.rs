//! What fills a picture: many cells and dots of few looks, gathered so that each look is one element of the file.

use super::HEIGHT;
use super::colours::Look;
use super::frame::beside;
use crate::report::plot::px;
use std::collections::BTreeMap;
use std::fmt::Write;

/// Paths by look.
#[derive(Default)]
pub(super) struct Marks {
    cells: BTreeMap<Look, String>,
    dots: BTreeMap<Look, String>,
    /// Lines between regions.
    borders: String,
    /// Diameter of a dot.
    size: i32,
    key: Vec<(&'static str, (i32, i32))>,
}

impl Marks {
    /// With dots of a diameter, or curves of a width.
    pub(super) fn of_size(size: i32) -> Self {
        Self {
            size,
            ..Self::default()
        }
    }

    /// A rectangle between two corners.
    pub(super) fn cell(&mut self, look: Look, from: (i32, i32), to: (i32, i32)) {
        let path = self.cells.entry(look).or_default();
        let (wide, high) = (to.0 - from.0, to.1 - from.1);
        // Writing to a text cannot fail.
        let _ = write!(path, "M{} {}h{wide}v{high}h{}z", from.0, from.1, -wide);
    }

    /// A line between two regions.
    pub(super) fn border(&mut self, from: (i32, i32), to: (i32, i32)) {
        let _ = write!(self.borders, "M{} {}L{} {}", from.0, from.1, to.0, to.1);
    }

    /// A dot; a cross for a run that failed.
    pub(super) fn dot(&mut self, look: Look, (x, y): (i32, i32)) {
        let half = self.size / 2;
        let path = self.dots.entry(look).or_default();
        let _ = match look {
            Look::Failed => {
                let (left, top, size) = (x - half, y - half, 2 * half);
                write!(path, "M{left} {top}l{size} {size}m0 -{size}l-{size} {size}")
            }
            _ => write!(path, "M{x} {y}h0"),
        };
    }

    /// A curve through places; a dot if it is one place.
    pub(super) fn curve(&mut self, look: Look, places: &[(i32, i32)]) {
        let path = self.dots.entry(look).or_default();
        if let [(x, y), rest @ ..] = places {
            let _ = match rest.is_empty() {
                true => write!(path, "M{x} {y}h0"),
                false => write!(path, "M{x} {y}L"),
            };
        }
        for (x, y) in places.iter().skip(1) {
            let _ = write!(path, "{x} {y} ");
        }
    }

    /// Says below the scale of colours what is grey and what is hatched or crossed, if anything is.
    pub(super) fn explain(&mut self) {
        let used = |look: &Look| self.cells.contains_key(look) || self.dots.contains_key(look);
        let looks = [(Look::Failed, "failed"), (Look::None, "no value")];
        let used: Vec<(Look, &'static str)> =
            looks.into_iter().filter(|(look, _)| used(look)).collect();
        for (line, (look, words)) in used.into_iter().enumerate() {
            let (left, y) = (beside(), HEIGHT as i32 - px(86 - 22 * line as i32));
            match self.dots.contains_key(&look) {
                true => self.dot(look, (left + px(8), y)),
                false => self.cell(look, (left, y - px(7)), (left + px(16), y + px(7))),
            }
            self.key.push((words, (left + px(24), y)));
        }
    }

    /// Words of the key, and where they go.
    pub(super) fn key(&self) -> &[(&'static str, (i32, i32))] {
        &self.key
    }

    /// The elements.
    pub(super) fn svg(&self) -> String {
        let mut text = "\n<defs><pattern id=\"failed\" width=\"70\" height=\"70\" patternUnits=\"userSpaceOnUse\" \
                        patternTransform=\"rotate(45)\"><rect width=\"70\" height=\"70\" fill=\"#ffffff\"/>\
                        <rect width=\"22\" height=\"70\" fill=\"#777777\"/></pattern></defs>"
            .to_owned();
        for (look, path) in &self.cells {
            let colour = look.colour();
            let _ = write!(
                text,
                "\n<path fill=\"{colour}\" shape-rendering=\"crispEdges\" d=\"{path}\"/>"
            );
        }
        if !self.borders.is_empty() {
            let (width, path) = (px(1), &self.borders);
            let _ = write!(
                text,
                "\n<path fill=\"none\" stroke=\"#000000\" stroke-width=\"{width}\" stroke-linecap=\"square\" d=\"{path}\"/>"
            );
        }
        for (look, path) in &self.dots {
            let (colour, width) = match look {
                Look::Failed => ("#555555".to_owned(), self.size / 5),
                look => (look.colour(), self.size),
            };
            let _ = write!(
                text,
                "\n<path fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width}\" stroke-linecap=\"round\" stroke-linejoin=\"round\" d=\"{path}\"/>"
            );
        }
        text
    }
}
