//! Values → an axis: what it spans, what its numbers are counted from, and how they are written.
//!
//! Where values hardly change beside their size (an energy that is kept to 1e-9) numbers in full would be long and alike: they are counted
//! from a round number near them, which is written once.

use crate::number::without_zeros;
use plotters::coord::ranged1d::{BoldPoints, Ranged};
use plotters::coord::types::RangedCoordf64;

/// An axis from one value to another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::report) struct Axis {
    /// What its numbers are counted from.
    from: f64,
    /// Decimals of that.
    decimals: usize,
    /// Its ends, counted from there.
    pub low: f64,
    /// See `low`.
    pub high: f64,
}

/// What values differ by less than this part of their size is rounding, and they are constant on paper.
pub(in crate::report) const CONSTANT: f64 = 1e-11;

/// Numbers of an axis that spans less than this part of their size are counted from another one than zero.
const SMALL: f64 = 1e-4;

impl Axis {
    /// From one value to another.
    pub fn between(low: f64, high: f64) -> Self {
        let (length, size) = (high - low, high.abs().max(low.abs()));
        let mut axis = Self {
            from: 0.0,
            decimals: 0,
            low,
            high,
        };
        if length > 0.0 && length < SMALL * size {
            let power = length.log10().ceil();
            let unit = 10_f64.powf(power);
            axis.decimals = (-power).max(0.0) as usize;
            axis.from = (0.5 * (low + high) / unit).round() * unit;
            (axis.low, axis.high) = (axis.at(low), axis.at(high));
        }
        axis
    }

    /// Around all values, with `above` times as much room above as below: a constant curve gets room, too.
    pub fn around(values: impl Iterator<Item = f64>, above: f64) -> Self {
        let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
            (value.min(low), value.max(high))
        });
        if low > high {
            return Self::between(0.0, 1.0);
        }
        let size = high.abs().max(low.abs());
        let room = match high - low > CONSTANT * size {
            true => 0.08 * (high - low),
            false if size == 0.0 => 0.1,
            false => 0.1 * size,
        };
        Self::between(low - room, high + above * room)
    }

    /// A value, counted from where its numbers are.
    pub fn at(&self, value: f64) -> f64 {
        value - self.from
    }

    /// How long it is.
    pub fn length(&self) -> f64 {
        self.high - self.low
    }

    /// `from 1200.5`, if its numbers are counted from something.
    pub fn origin(&self) -> Option<String> {
        let decimals = self.decimals;
        (self.from != 0.0).then(|| format!("from {:.decimals$}", self.from))
    }

    /// A number on it, with the digits that its length gives a meaning.
    pub fn label(&self, number: f64) -> String {
        let power = (self.length().log10().floor() as i32 - 3).max(-300);
        let unit = 10_f64.powi(power);
        let number = (number / unit).round() * unit;
        if number == 0.0 {
            return "0".to_owned();
        }
        let text = match (1e-5..1e7).contains(&number.abs()) {
            true => format!("{number:.0$}", (-power).max(0) as usize),
            false => {
                let digits = number.abs().log10().floor() as i32 - power;
                format!("{number:.0$e}", digits.clamp(0, 15) as usize)
            }
        };
        let (digits, power) = text.split_at(text.find('e').unwrap_or(text.len()));
        format!("{}{power}", without_zeros(digits))
    }

    /// Letters of its longest number, of about `count`.
    pub fn letters(&self, count: usize) -> usize {
        let ticks = RangedCoordf64::from(self.low..self.high).key_points(BoldPoints(count));
        let letters = ticks
            .iter()
            .map(|number| self.label(*number).chars().count());
        letters.max().unwrap_or(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A force of a given size is that size to rounding: noise would fill the panel.
    #[test]
    fn what_rounding_alone_changes_is_constant() {
        let force = 0.016_677;
        let axis = Axis::around([force, force * (1.0 + 1e-15)].into_iter(), 2.0);
        assert!(
            axis.low < 0.95 * force && axis.high > 1.05 * force,
            "{axis:?}"
        );
        assert_eq!(axis.origin(), None);
        let zero = Axis::around([0.0].into_iter(), 1.0);
        assert_eq!((zero.low, zero.high), (-0.1, 0.1));
    }

    #[test]
    fn numbers_of_axes_are_short() {
        let label = |number: f64, length: f64| Axis::between(0.0, length).label(number);
        assert_eq!(label(0.1 + 0.2, 1.0), "0.3");
        assert_eq!(label(-1e-17, 1.0), "0");
        assert_eq!(label(-2e300, 5e300), "-2e300");
        assert_eq!(label(5e-8, 1e-7), "5e-8");
        assert_eq!(label(200.0, 1000.0), "200");
        assert_eq!(label(4.00000001e6, 1e7), "4000000");
    }

    /// An energy that is kept to 1e-9: its numbers are short and differ, and with what they are counted from they are its values.
    #[test]
    fn what_hardly_changes_is_counted_from_a_number_near_it() {
        let energy = -80.953_533_45;
        let axis = Axis::around([energy, energy + 3e-9].into_iter(), 2.0);
        let origin = axis.origin().expect("an origin");
        let from: f64 = origin["from ".len()..].parse().expect("a number");
        assert!((from - energy).abs() < 1e-8, "{origin}");
        let ticks = RangedCoordf64::from(axis.low..axis.high).key_points(BoldPoints(8));
        let labels: Vec<String> = ticks.iter().map(|tick| axis.label(*tick)).collect();
        assert!(labels.len() > 3 && axis.letters(8) <= 7, "{labels:?}");
        for (label, tick) in labels.iter().zip(&ticks) {
            let value: f64 = label.parse().expect("a number");
            assert!(
                (value - tick).abs() < 1e-3 * axis.length(),
                "{label} {tick}"
            );
            assert_eq!(labels.iter().filter(|other| *other == label).count(), 1);
        }
        assert!((axis.at(energy) + from - energy).abs() < 1e-13);
    }
}
