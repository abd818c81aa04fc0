//! A number that is varied, over which range, in which steps.

use crate::number::{count, finite};
use core::fmt;
use core::str::FromStr;
use lagrange_core::error::Shortest;

/// One number that is varied.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// A parameter, a coordinate (`theta`) or a velocity (`der(theta)`) of the start.
    pub name: String,
    /// First value.
    pub from: f64,
    /// Last value.
    pub to: f64,
    /// Number of values; 0 if it is not said, as for a sample, which takes them anywhere.
    pub count: usize,
    /// Whether values are spaced by equal ratios.
    pub logarithmic: bool,
}

impl Axis {
    /// The value at a part of the way, 0 … 1.
    pub(super) fn at(&self, part: f64) -> f64 {
        if part == 1.0 {
            self.to
        } else if self.logarithmic {
            // Their ratio might be too large for a number.
            self.from.powf(1.0 - part) * self.to.powf(part)
        } else {
            // So might their difference be, but not that of their halves.
            let (from, to) = (0.5 * self.from, 0.5 * self.to);
            2.0 * (from + (to - from) * part)
        }
    }

    /// Value number `index` of a grid. What is a short decimal fraction but for rounding is that fraction.
    pub(super) fn value(&self, index: usize) -> f64 {
        match (self.count, index) {
            (0 | 1, _) | (_, 0) => self.from,
            (count, index) if index + 1 == count => self.to,
            (count, index) => {
                let value = self.at(index as f64 / (count - 1) as f64);
                let size = match self.logarithmic {
                    true => value.abs(),
                    false => self.from.abs().max(self.to.abs()),
                };
                meant(value, size)
            }
        }
    }
}

/// A number of twelve digits where that is all a value is, to the rounding of numbers of this size.
fn meant(value: f64, size: f64) -> f64 {
    let decimals = 11.0 - size.log10().floor();
    if !(0.0..300.0).contains(&decimals) {
        return value;
    }
    let short: f64 = format!("{value:.0$}", decimals as usize)
        .parse()
        .unwrap_or(value);
    match (short - value).abs() <= 8.0 * f64::EPSILON * size {
        // Zero has no sign.
        true => short + 0.0,
        false => value,
    }
}

/// `name=from..to`, `name=from..to:count` or `name=from..to:count:log`.
impl FromStr for Axis {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let form = "expected name=from..to:count, for example mass=0.1..2:50";
        let (name, range) = text.split_once('=').ok_or(form)?;
        let (from, rest) = range.split_once("..").ok_or(form)?;
        let mut rest = rest.split(':');
        let (from, to) = (finite(from)?, finite(rest.next().ok_or(form)?)?);
        let count = match rest.next() {
            None => 0,
            Some(text) => {
                count(text).ok_or_else(|| format!("`{}` is not a number of values", text.trim()))?
            }
        };
        let logarithmic = match rest.next().map(str::trim) {
            None => false,
            Some("log") => true,
            Some(other) => return Err(format!("`{other}` is not a spacing; there is `log`")),
        };
        if logarithmic && !(from > 0.0 && to > 0.0) {
            return Err("equal ratios need values above 0".to_owned());
        }
        match (name.trim(), rest.next()) {
            ("", _) | (_, Some(_)) => Err(form.to_owned()),
            (name, None) => Ok(Axis {
                name: name.to_owned(),
                from,
                to,
                count,
                logarithmic,
            }),
        }
    }
}

impl fmt::Display for Axis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [from, to] = [self.from, self.to].map(Shortest);
        write!(f, "{}={from}..{to}", self.name)?;
        if self.count > 0 {
            write!(f, ":{}", self.count)?;
        }
        match self.logarithmic {
            true => write!(f, ":log"),
            false => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Axis;

    /// Decimal fractions are those that are read from their digits; a third keeps all of its own.
    #[test]
    fn values_of_a_grid_are_those_that_are_meant() {
        for (axis, step, count) in [("mu=0..0.6:13", 0.05, 13), ("a=-1..1:21", 0.1, 21)] {
            let axis: Axis = axis.parse().expect("an axis");
            for i in 0..count {
                let exact = format!("{:.2}", axis.from + step * i as f64);
                assert_eq!(Ok(axis.value(i)), exact.parse(), "{i}");
            }
        }
        let axis: Axis = "a=0..1:4".parse().expect("an axis");
        assert_eq!(axis.value(1), 1.0 / 3.0);
        let axis: Axis = "a=1e-30..4e-30:4".parse().expect("an axis");
        assert_eq!(axis.value(1), 2e-30);
        let axis: Axis = "mu=-0.3..0.6:4".parse().expect("an axis");
        assert_eq!(axis.value(1).to_string(), "0");
    }

    #[test]
    fn the_widest_axes_are_finite() {
        for (axis, middle) in [
            ("a=1e-300..1e300:3:log", 1.0),
            ("a=1e300..1e-300:3:log", 1.0),
            ("a=-1e308..1e308:3", 0.0),
            ("a=-1.7e308..-1.5e308:3", -1.6e308),
        ] {
            let axis: Axis = axis.parse().expect("an axis");
            assert_eq!(axis.value(1), middle, "{axis}");
            let (low, high) = (axis.from.min(axis.to), axis.from.max(axis.to));
            for part in [0.0, 0.1, 1.0 / 3.0, 0.9, 1.0] {
                assert!((low..=high).contains(&axis.at(part)), "{axis}");
            }
        }
    }

    #[test]
    fn axes_are_read() {
        let axis: Axis = "mu = 0.1..1:4".parse().expect("an axis");
        assert_eq!((axis.name.as_str(), axis.count), ("mu", 4));
        let values: Vec<f64> = (0..4).map(|i| axis.value(i)).collect();
        for (value, expected) in values.iter().zip([0.1, 0.4, 0.7, 1.0]) {
            assert!((value - expected).abs() < 1e-15);
        }
        let axis: Axis = "mu=0.1..1".parse().expect("an axis");
        assert_eq!((axis.count, axis.to_string().as_str()), (0, "mu=0.1..1"));
        let axis: Axis = "k=1e-2..1e4:7:log".parse().expect("an axis");
        assert!(axis.value(3) == 10.0 && axis.value(6) == 1e4);
        for wrong in [
            "",
            "mu",
            "mu=1",
            "mu=1..",
            "=1..2:3",
            "mu=1..2:0",
            "mu=1..2:3:lin",
            "mu=0..2:3:log",
            "mu=1..inf:2",
        ] {
            assert!(wrong.parse::<Axis>().is_err(), "{wrong}");
        }
    }
}
