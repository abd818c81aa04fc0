//! Numbers as colours. Those of one sign from dark to light: Viridis (Smith and van der Walt 2015); those of both signs from blue
//! through white to red: RdBu (Harrower and Brewer 2003), as far on either side of zero. Colour-blind readers can tell both apart.

use super::scale::Scale;
use plotters::prelude::ViridisRGB;
use plotters::style::RGBColor;
use plotters::style::colors::colormaps::ColorMap;

/// A part of the range on the other side of zero that is no rounding.
const BOTH: f64 = 0.01;

/// Steps of the colours, an even number of them, so that zero has one of a scale around it.
const LEVELS: f64 = 64.0;

/// How a cell or a dot looks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Look {
    /// A value: one of the colours from low to high.
    Level(u8),
    /// The same, from below zero to above it.
    Signed(u8),
    /// A curve.
    Plain(u8, u8, u8),
    /// No run has it.
    None,
    /// A run failed.
    Failed,
}

impl Look {
    pub(super) fn colour(self) -> String {
        let hex = |RGBColor(r, g, b): RGBColor| format!("#{r:02x}{g:02x}{b:02x}");
        match self {
            Look::Level(level) => hex(shade(f64::from(level) / LEVELS)),
            Look::Signed(level) => hex(signed(f64::from(level) / LEVELS)),
            Look::Plain(r, g, b) => hex(RGBColor(r, g, b)),
            Look::None => "#d4d4d4".to_owned(),
            Look::Failed => "url(#failed)".to_owned(),
        }
    }
}

/// The scale of colours of a picture.
pub(super) struct Colours {
    pub(super) scale: Scale,
    /// Name and unit of what is shown.
    pub(super) name: String,
    signed: bool,
}

impl Colours {
    /// For values from `low` to `high`.
    pub(super) fn new(low: f64, high: f64, name: String) -> Self {
        let most = high.max(-low);
        let signed = high.min(-low) > BOTH * most;
        let (low, high) = if signed { (-most, most) } else { (low, high) };
        Self {
            scale: Scale::around(low, high, 0.0),
            name,
            signed,
        }
    }

    /// How a value looks.
    pub(super) fn look(&self, value: f64) -> Look {
        let level = (self.scale.part(value).clamp(0.0, 1.0) * LEVELS).round() as u8;
        if self.signed {
            Look::Signed(level)
        } else {
            Look::Level(level)
        }
    }

    /// The colour at a part of the scale.
    pub(super) fn at(&self, part: f64) -> RGBColor {
        if self.signed {
            signed(part)
        } else {
            shade(part)
        }
    }
}

/// From dark blue to yellow, each step lighter than the last.
fn shade(part: f64) -> RGBColor {
    ViridisRGB.get_color(part.clamp(0.0, 1.0))
}

/// From blue to red, white in the middle.
fn signed(part: f64) -> RGBColor {
    const STOPS: [[u8; 3]; 9] = [
        [33, 102, 172],
        [67, 147, 195],
        [146, 197, 222],
        [209, 229, 240],
        [247, 247, 247],
        [253, 219, 199],
        [244, 165, 130],
        [214, 96, 77],
        [178, 24, 43],
    ];
    let place = part.clamp(0.0, 1.0) * (STOPS.len() - 1) as f64;
    let stop = (place as usize).min(STOPS.len() - 2);
    let mix = |k: usize| {
        let (from, to) = (f64::from(STOPS[stop][k]), f64::from(STOPS[stop + 1][k]));
        (from + (place - stop as f64) * (to - from)).round() as u8
    };
    RGBColor(mix(0), mix(1), mix(2))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zero_is_white_where_values_change_sign() {
        let both = Colours::new(-1.0, 3.0, String::new());
        assert_eq!(both.look(0.0), Look::Signed(32));
        assert_eq!(both.at(0.5), RGBColor(247, 247, 247));
        assert_eq!(
            (both.look(3.0), both.look(-3.0)),
            (Look::Signed(64), Look::Signed(0))
        );
        let one = Colours::new(-1e-9, 3.0, String::new());
        assert_eq!(one.look(3.0), Look::Level(64));
    }
}
