//! Accuracy → SVG, the work–precision diagram: time of a run over the error of its result, both logarithmic.
//!
//! More exact is to the left, faster is below. Each method is one curve, from its loosest tolerance to its tightest; at
//! the left edge is the floor, where errors cannot be told from those of the reference.

mod axes;
mod marks;

use super::demand;
use crate::accuracy::{Accuracy, Family, Setting};
use crate::report::plot::{Area, COLOURS, Drawn, FINE, draw_in, px, words};
use axes::Frame;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, VPos};

const HEIGHT: u32 = 560 * FINE;

/// An error that is no result.
const USELESS: f64 = 1.0;

/// One method: its points (error, time) in the order of the tolerances.
struct Curve {
    setting: Setting,
    /// Index into colours and markers: the same for a method in every picture.
    look: usize,
    points: Vec<(f64, f64)>,
}

/// The picture, as the text of an SVG file.
///
/// # Errors
/// A sentence, if there is nothing to draw or the drawing fails.
pub fn svg(accuracy: &Accuracy) -> Result<String, String> {
    let curves = curves(accuracy);
    let points = || curves.iter().flat_map(|curve| &curve.points);
    let frame = Frame::around(points().copied(), accuracy.reference.floor)
        .ok_or("there is nothing to plot: no method got to the end with an error below 1")?;
    draw_in(HEIGHT, |root| draw(root, accuracy, &frame, &curves))
}

/// The curves in the order of the study; a method without a single point keeps its place in the key.
fn curves(accuracy: &Accuracy) -> Vec<Curve> {
    let mut curves: Vec<Curve> = Vec::new();
    for row in &accuracy.rows {
        let name = row.setting.name();
        let known = curves.iter().position(|curve| curve.setting.name() == name);
        let index = known.unwrap_or_else(|| {
            curves.push(Curve {
                setting: row.setting,
                look: look(name),
                points: Vec::new(),
            });
            curves.len() - 1
        });
        if let Ok(measured) = &row.result
            && accuracy.resolved(measured) < USELESS
        {
            let point = (accuracy.resolved(measured), measured.time.best);
            curves[index].points.push(point);
        }
    }
    curves
}

fn look(name: &str) -> usize {
    let names = Family::ALL.map(|family| family.to_string());
    names.iter().position(|known| known == name).unwrap_or(0)
}

fn draw<'a>(root: &Area<'a>, accuracy: &Accuracy, frame: &Frame, curves: &[Curve]) -> Drawn<'a> {
    let heading = words(17, &BLACK, HPos::Left, VPos::Center);
    root.draw_text(accuracy.scene, &heading, (px(14), px(20)))?;
    axes::draw(root, frame)?;
    for curve in curves {
        let colour = COLOURS[curve.look % COLOURS.len()];
        let points: Vec<(i32, i32)> = curve.points.iter().map(|&p| frame.place(p)).collect();
        root.draw(&PathElement::new(
            points.clone(),
            colour.mix(0.75).stroke_width(2 * FINE),
        ))?;
        for point in points {
            marks::draw(root, curve.look, point)?;
        }
    }
    key(root, frame, curves)?;
    foot(root, accuracy)
}

/// Room between the diagram and the key.
const BESIDE: i32 = 18;

/// Room before a name of the key, for a piece of the curve.
const BEFORE: i32 = 36;

/// What the key says of a method without a point.
fn without_result(name: &str) -> String {
    format!("{name}: no result")
}

/// Names of the methods, right of the diagram.
fn key<'a>(root: &Area<'a>, frame: &Frame, curves: &[Curve]) -> Drawn<'a> {
    let left = frame.right() + px(BESIDE);
    for (line, curve) in curves.iter().enumerate() {
        let y = frame.top() + px(12 + 24 * line as i32);
        let there = !curve.points.is_empty();
        let colour = COLOURS[curve.look % COLOURS.len()];
        if there {
            root.draw(&PathElement::new(
                vec![(left, y), (left + px(28), y)],
                colour.mix(0.75).stroke_width(2 * FINE),
            ))?;
            marks::draw(root, curve.look, (left + px(14), y))?;
        }
        let shade = BLACK.mix(if there { 1.0 } else { 0.45 });
        let name = match there {
            true => curve.setting.name().to_owned(),
            false => without_result(curve.setting.name()),
        };
        let style = words(14, &shade, HPos::Left, VPos::Center);
        root.draw(&Text::new(name, (left + px(BEFORE), y), style))?;
    }
    Ok(())
}

/// What was asked of the methods, and what their errors are measured against.
fn foot<'a>(root: &Area<'a>, accuracy: &Accuracy) -> Drawn<'a> {
    let style = words(12, &BLACK.mix(0.65), HPos::Left, VPos::Center);
    let demands: Vec<String> = accuracy
        .rows
        .iter()
        .filter(|row| row.setting.step().is_none())
        .map(|row| demand(row.setting))
        .collect();
    let asked = match (demands.first(), demands.last()) {
        (Some(first), Some(last)) => format!("Tolerances from {first} to {last}. "),
        _ => String::new(),
    };
    let known = &accuracy.reference;
    let lines = [
        format!("{asked}Error: the largest of the final state and the times of the events."),
        format!(
            "Reference: {}; {} differs by {:.0e}.",
            known.by, known.checked_by, known.difference
        ),
    ];
    for (line, text) in lines.into_iter().enumerate() {
        let y = HEIGHT as i32 - px(32 - 17 * line as i32);
        root.draw(&Text::new(text, (px(14), y), style.clone()))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::plot::{LETTER, WIDTH};

    #[test]
    fn the_key_ends_before_the_picture_does() {
        let frame = Frame::around([(1e-6, 1e-3)].into_iter(), 1e-15).expect("a point");
        for family in Family::ALL {
            let text = without_result(&family.to_string());
            let end =
                frame.right() + px(BESIDE + BEFORE) + (text.chars().count() as u32 * LETTER) as i32;
            assert!(end <= WIDTH as i32, "{text}");
        }
    }
}
