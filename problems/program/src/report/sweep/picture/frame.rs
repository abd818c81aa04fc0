//! The frame of a picture: axes with names, units and numbers; the scale of colours beside it.

use super::HEIGHT;
use super::colours::Colours;
use super::scale::Scale;
use crate::report::plot::{Area, Drawn, FINE, WIDTH, px, words};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, VPos};

/// Room to the right for a scale of colours and a key.
const BESIDE: i32 = 150;

/// Height of a name.
const LINE: i32 = 18;

/// Room to the left for numbers and the name of an axis.
pub(super) const LEFT: i32 = 86;

/// Where a panel is, and what its edges mean.
pub(super) struct Frame {
    pub(super) left: i32,
    pub(super) right: i32,
    pub(super) top: i32,
    pub(super) bottom: i32,
    pub(super) x: Scale,
    pub(super) y: Scale,
    x_name: String,
    y_name: String,
    /// Of what there are lines to read heights from, in their colours; a single one is named on the axis.
    names: Vec<(String, RGBColor)>,
    lines: bool,
}

impl Frame {
    /// The only panel of a picture, with scales and names, and with room for a scale of colours beside it.
    pub(super) fn new(x: (Scale, String), y: (Scale, String)) -> Self {
        Self {
            left: px(LEFT),
            right: WIDTH as i32 - px(BESIDE),
            top: px(42),
            bottom: HEIGHT as i32 - px(58),
            x: x.0,
            y: y.0,
            x_name: x.1,
            y_name: y.1,
            names: Vec::new(),
            lines: false,
        }
    }

    /// A panel of this height at this place, as wide as the picture, with lines to read heights from.
    pub(super) fn lined(self, (above, height): (i32, i32), names: Vec<(String, RGBColor)>) -> Self {
        Self {
            right: WIDTH as i32 - px(24),
            top: above + px(42 + LINE * (names.len().max(1) as i32 - 1)),
            bottom: above + height - px(58),
            names,
            lines: true,
            ..self
        }
    }

    /// Where a point is drawn.
    pub(super) fn place(&self, x: f64, y: f64) -> (i32, i32) {
        (self.column(self.x.part(x)), self.row(self.y.part(y)))
    }

    /// From a part of the width.
    pub(super) fn column(&self, part: f64) -> i32 {
        self.left + (part * f64::from(self.right - self.left)).round() as i32
    }

    /// From a part of the height.
    pub(super) fn row(&self, part: f64) -> i32 {
        self.bottom - (part * f64::from(self.bottom - self.top)).round() as i32
    }

    pub(super) fn draw<'a>(&self, root: &Area<'a>) -> Drawn<'a> {
        let (left, right, top, bottom) = (self.left, self.right, self.top, self.bottom);
        for (line, (name, colour)) in self.names.iter().rev().enumerate() {
            let style = words(14, colour, HPos::Right, VPos::Center);
            let place = (right, top - px(22 + LINE * line as i32));
            root.draw_text(name, &style, place)?;
        }
        let line = |from, to, shade: f64| {
            let style = BLACK.mix(shade).stroke_width(FINE);
            root.draw(&PathElement::new(vec![from, to], style))
        };
        for number in self.x.ticks() {
            let x = self.column(self.x.part(number));
            if self.lines {
                line((x, top), (x, bottom), 0.1)?;
            }
            line((x, bottom), (x, bottom + px(5)), 1.0)?;
            let style = words(13, &BLACK, HPos::Center, VPos::Top);
            root.draw(&Text::new(self.x.label(number), (x, bottom + px(9)), style))?;
        }
        for number in self.y.ticks() {
            let y = self.row(self.y.part(number));
            if self.lines {
                line((left, y), (right, y), 0.1)?;
            }
            line((left - px(5), y), (left, y), 1.0)?;
            let style = words(13, &BLACK, HPos::Right, VPos::Center);
            root.draw(&Text::new(self.y.label(number), (left - px(9), y), style))?;
        }
        line((left, bottom), (right, bottom), 1.0)?;
        line((left, top), (left, bottom), 1.0)?;
        let name = words(14, &BLACK, HPos::Center, VPos::Top);
        let middle = ((left + right) / 2, bottom + px(32));
        root.draw(&Text::new(self.x.named(&self.x_name), middle, name.clone()))?;
        let upward = name.transform(FontTransform::Rotate270);
        let beside = (px(8), (top + bottom) / 2);
        root.draw(&Text::new(self.y.named(&self.y_name), beside, upward))
    }
}

/// Left edge of what is drawn beside the frame.
pub(super) fn beside() -> i32 {
    WIDTH as i32 - px(BESIDE - 24)
}

/// The colours with their numbers.
pub(super) fn colour_scale<'a>(root: &Area<'a>, colours: &Colours) -> Drawn<'a> {
    let (scale, name) = (&colours.scale, &colours.name);
    const STEPS: i32 = 64;
    let (left, top, bottom) = (beside(), px(42), HEIGHT as i32 - px(110));
    let place = |part: f64| bottom - (part * f64::from(bottom - top)).round() as i32;
    for step in 0..STEPS {
        let part = |step: i32| f64::from(step) / f64::from(STEPS);
        let colour = colours.at((f64::from(step) + 0.5) / f64::from(STEPS));
        // Each a trifle too high: no line shows between them.
        let over = if step + 1 < STEPS { px(1) } else { 0 };
        let corners = [
            (left, place(part(step + 1)) - over),
            (left + px(16), place(part(step))),
        ];
        root.draw(&Rectangle::new(corners, colour.filled()))?;
    }
    for number in scale.ticks() {
        let y = place(scale.part(number));
        let style = BLACK.stroke_width(FINE);
        let tick = vec![(left + px(16), y), (left + px(20), y)];
        root.draw(&PathElement::new(tick, style))?;
        let style = words(13, &BLACK, HPos::Left, VPos::Center);
        root.draw(&Text::new(scale.label(number), (left + px(24), y), style))?;
    }
    let upward = words(14, &BLACK, HPos::Center, VPos::Top).transform(FontTransform::Rotate270);
    let beside = (left + px(84), (top + bottom) / 2);
    root.draw(&Text::new(scale.named(name), beside, upward))
}
