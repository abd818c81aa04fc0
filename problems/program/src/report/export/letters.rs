//! Text in an SVG file → the same text as shapes, so that what draws them needs no font.
//!
//! It knows what the pictures of this program use: one line per `text` element, `x`, `y`, a `dy` in em or ex, `text-anchor`,
//! `font-size`. Everything else of the element (colour, class, transform) stays with its shapes.

use roxmltree::{Document, Node};
use std::fmt::Write;
use std::io;
use ttf_parser::{Face, GlyphId, OutlineBuilder};

/// DejaVu Sans, the Latin, Greek and mathematical characters of it.
const FONT: &[u8] = include_bytes!("../../../fonts/DejaVuSans-subset.ttf");

/// Attributes of a text that have no meaning for shapes.
const OF_TEXT: [&str; 6] = ["x", "y", "dy", "text-anchor", "font-family", "font-size"];

/// The file with shapes for letters.
pub(super) fn as_shapes(svg: &str) -> io::Result<String> {
    let document = Document::parse(svg).map_err(io::Error::other)?;
    let face = Face::parse(FONT, 0).map_err(io::Error::other)?;
    let mut out = String::with_capacity(2 * svg.len());
    let mut done = 0;
    for node in document.descendants() {
        if node.has_tag_name((SVG, "text")) {
            let range = node.range();
            out.push_str(&svg[done..range.start]);
            shapes(&face, node, &mut out);
            done = range.end;
        }
    }
    out.push_str(&svg[done..]);
    Ok(out)
}

const SVG: &str = "http://www.w3.org/2000/svg";

/// A text as one path.
fn shapes(face: &Face, text: Node, out: &mut String) {
    let number = |name: &str| {
        let given = text.attribute(name).and_then(|value| value.parse().ok());
        given.unwrap_or(0.0)
    };
    let inherited = |name: &str| text.ancestors().find_map(|node| node.attribute(name));
    let size: f32 = inherited("font-size")
        .and_then(|size| size.parse().ok())
        .unwrap_or(16.0);
    let scale = size / f32::from(face.units_per_em());
    let shift =
        text.attribute("dy")
            .map_or(0.0, |dy| match dy.split_at(dy.len().saturating_sub(2)) {
                (count, "em") => count.parse().unwrap_or(0.0) * size,
                (count, "ex") => {
                    count.parse().unwrap_or(0.0) * scale * f32::from(face.x_height().unwrap_or(0))
                }
                _ => dy.parse().unwrap_or(0.0),
            });
    let glyphs: Vec<(GlyphId, f32)> = text
        .text()
        .unwrap_or_default()
        .trim()
        .chars()
        .map(|letter| {
            let glyph = face.glyph_index(letter).unwrap_or_default();
            (
                glyph,
                scale * f32::from(face.glyph_hor_advance(glyph).unwrap_or(0)),
            )
        })
        .collect();
    let length: f32 = glyphs.iter().map(|(_, advance)| advance).sum();
    let before = match inherited("text-anchor") {
        Some("middle") => 0.5,
        Some("end") => 1.0,
        _ => 0.0,
    };
    let mut pen = Pen {
        x: number("x") - before * length,
        y: number("y") + shift,
        scale,
        path: String::new(),
    };
    for (glyph, advance) in glyphs {
        face.outline_glyph(glyph, &mut pen);
        pen.x += advance;
    }
    out.push_str("<path");
    for attribute in text.attributes().filter(|a| !OF_TEXT.contains(&a.name())) {
        // Writing to a text cannot fail.
        let _ = write!(out, " {}=\"{}\"", attribute.name(), attribute.value());
    }
    let _ = write!(out, " d=\"{}\"/>", pen.path);
}

/// Writes outlines, of which y points upward, where the text stands.
struct Pen {
    x: f32,
    y: f32,
    scale: f32,
    path: String,
}

impl Pen {
    fn put(&mut self, command: char, points: &[(f32, f32)]) {
        self.path.push(command);
        for (x, y) in points {
            let _ = write!(
                self.path,
                "{:.3} {:.3} ",
                self.x + self.scale * x,
                self.y - self.scale * y
            );
        }
    }
}

impl OutlineBuilder for Pen {
    fn move_to(&mut self, x: f32, y: f32) {
        self.put('M', &[(x, y)]);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.put('L', &[(x, y)]);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        self.put('Q', &[(x1, y1), (x, y)]);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        self.put('C', &[(x1, y1), (x2, y2), (x, y)]);
    }

    fn close(&mut self) {
        self.path.push('Z');
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every character that pictures take from elsewhere than the user's names.
    #[test]
    fn the_font_has_the_letters_of_pictures() {
        let face = Face::parse(FONT, 0).expect("a font");
        let letters = "azAZ09 |.,:;()[]+-−=→·²°µμΩαβγθφψχωₛₖ₀₁₂₃⁰¹²³⁴⁵⁶⁷⁸⁹⁻×…";
        let missing: Vec<char> = letters
            .chars()
            .filter(|c| face.glyph_index(*c).is_none())
            .collect();
        assert!(missing.is_empty(), "{missing:?}");
    }

    #[test]
    fn a_text_stands_where_its_anchor_says() {
        let draw = |anchor: &str| {
            let text = format!(
                "<svg xmlns=\"{SVG}\" font-size=\"10\"><text x=\"50\" y=\"20\" text-anchor=\"{anchor}\">I\n</text></svg>"
            );
            as_shapes(&text).expect("shapes")
        };
        // An I is 604 of 2048 units wide.
        let wide = 10.0 * 604.0 / 2048.0;
        let left = |svg: &str| -> f32 {
            let path = svg.split("d=\"M").nth(1).expect("a path");
            path.split(' ')
                .next()
                .expect("x")
                .parse()
                .expect("a number")
        };
        let start = left(&draw("start"));
        assert!((start - left(&draw("middle")) - 0.5 * wide).abs() < 2e-3);
        assert!((start - left(&draw("end")) - wide).abs() < 2e-3);
        assert!(start > 50.0 && start < 50.0 + wide);
    }
}
