//! One marker per method, so that a picture can be read without its colours.

use crate::report::plot::{Area, COLOURS, Drawn, FINE, px};
use plotters::prelude::*;

/// Draws marker `look` at a place, filled and with a light edge that keeps it apart from the lines.
pub(super) fn draw<'a>(root: &Area<'a>, look: usize, (x, y): (i32, i32)) -> Drawn<'a> {
    let colour = COLOURS[look % COLOURS.len()];
    let unit = |a: f64, b: f64| {
        let size = f64::from(px(1));
        (x + (a * size).round() as i32, y + (b * size).round() as i32)
    };
    let polygon = |corners: &[(f64, f64)]| -> Drawn<'a> {
        let mut outline: Vec<(i32, i32)> = corners.iter().map(|&(a, b)| unit(a, b)).collect();
        root.draw(&Polygon::new(outline.clone(), colour.filled()))?;
        outline.extend_from_within(..1);
        root.draw(&PathElement::new(outline, WHITE.stroke_width(FINE)))
    };
    let strokes = |lines: [[(f64, f64); 2]; 2]| -> Drawn<'a> {
        for (width, shade) in [(5 * FINE, WHITE), (3 * FINE, colour)] {
            for line in lines {
                let ends = line.iter().map(|&(a, b)| unit(a, b)).collect::<Vec<_>>();
                root.draw(&PathElement::new(ends, shade.stroke_width(width)))?;
            }
        }
        Ok(())
    };
    match look % 8 {
        0 => {
            root.draw(&Circle::new((x, y), px(5), colour.filled()))?;
            root.draw(&Circle::new((x, y), px(5), WHITE.stroke_width(FINE)))
        }
        1 => polygon(&[(-4.5, -4.5), (4.5, -4.5), (4.5, 4.5), (-4.5, 4.5)]),
        2 => polygon(&[(0.0, -6.0), (5.6, 4.0), (-5.6, 4.0)]),
        3 => polygon(&[(0.0, -6.2), (6.2, 0.0), (0.0, 6.2), (-6.2, 0.0)]),
        4 => polygon(&[(0.0, 6.0), (5.6, -4.0), (-5.6, -4.0)]),
        5 => strokes([[(-4.2, -4.2), (4.2, 4.2)], [(-4.2, 4.2), (4.2, -4.2)]]),
        6 => polygon(&[(-2.5, -6.0), (2.5, -6.0), (2.5, 6.0), (-2.5, 6.0)]),
        _ => strokes([[(-5.5, 0.0), (5.5, 0.0)], [(0.0, -5.5), (0.0, 5.5)]]),
    }
}
