//! From numbers to places on an axis, and the round numbers that are written beside it.

use crate::number::without_zeros;
use crate::report::plot::Axis as Plain;
use crate::sweep::Axis;

/// An axis of a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Scale {
    from: f64,
    to: f64,
    /// Whether equal ratios are equally far apart.
    logarithmic: bool,
}

impl Scale {
    /// Around values from `low` to `high`, with `room` of that to both sides.
    pub(super) fn around(low: f64, high: f64, room: f64) -> Self {
        // Numbers that are all the same, but for rounding.
        let least = 1e-9 * low.abs().max(high.abs()).max(1e-300);
        let room = match high - low > least {
            true => room * (high - low),
            false => 0.5 * low.abs().max(1e-6),
        };
        Self {
            from: low - room,
            to: high + room,
            logarithmic: false,
        }
    }

    /// Of what is varied, with this part of a cell to both sides.
    pub(super) fn of(axis: &Axis, part: f64) -> Self {
        let (from, to) = match axis.logarithmic {
            true => (axis.from.ln(), axis.to.ln()),
            false => (axis.from, axis.to),
        };
        let (low, high) = (from.min(to), from.max(to));
        let cell = match high > low {
            true => (high - low) / (axis.count.max(2) - 1) as f64,
            false => 1e-3 * low.abs().max(1e-3),
        };
        let (low, high) = (low - part * cell, high + part * cell);
        match axis.logarithmic {
            true => Self {
                from: low.exp(),
                to: high.exp(),
                logarithmic: true,
            },
            false => Self {
                from: low,
                to: high,
                logarithmic: false,
            },
        }
    }

    /// Where a number is, 0 … 1.
    pub(super) fn part(&self, number: f64) -> f64 {
        match self.logarithmic {
            true => (number / self.from).ln() / (self.to / self.from).ln(),
            false => (number - self.from) / (self.to - self.from),
        }
    }

    /// A number of the axis as it is written beside it: of an axis over whole decades in full.
    pub(super) fn label(&self, number: f64) -> String {
        let plain = Plain::between(self.from, self.to);
        match self.decades() < 1.0 {
            true => plain.label(plain.at(number)),
            false => short(number),
        }
    }

    /// A name, with what the numbers of the axis are counted from, if it is not zero.
    pub(super) fn named(&self, name: &str) -> String {
        match Plain::between(self.from, self.to).origin() {
            Some(origin) => format!("{name}, {origin}"),
            None => name.to_owned(),
        }
    }

    /// How many powers of ten it spans, if equal ratios are equally far apart.
    fn decades(&self) -> f64 {
        match self.logarithmic {
            true => (self.to / self.from).log10(),
            false => 0.0,
        }
    }

    /// Round numbers on the axis, some six of them.
    pub(super) fn ticks(&self) -> Vec<f64> {
        let decades = self.decades();
        if decades < 1.0 {
            return self.even_ticks();
        }
        let digits: &[f64] = match decades {
            ..2.5 => &[1.0, 2.0, 5.0],
            _ => &[1.0],
        };
        let every = (decades / 6.0).ceil() as usize;
        let powers = self.from.log10().floor() as i32..=self.to.log10().ceil() as i32;
        let numbers = powers
            .step_by(every)
            .flat_map(|power| digits.iter().map(move |digit| digit * 10_f64.powi(power)));
        numbers.filter(|x| self.has(*x)).collect()
    }

    fn even_ticks(&self) -> Vec<f64> {
        let rough = (self.to - self.from) / 6.0;
        let power = 10_f64.powf(rough.log10().floor());
        let digit = [1.0, 2.0, 2.5, 5.0, 10.0]
            .into_iter()
            .find(|digit| digit * power >= rough);
        let step = digit.unwrap_or(10.0) * power;
        let first = (self.from / step).ceil();
        let numbers = (0..20).map(|i| (first + f64::from(i)) * step);
        numbers.filter(|x| self.has(*x)).collect()
    }

    fn has(&self, number: f64) -> bool {
        (-1e-9..=1.0 + 1e-9).contains(&self.part(number))
    }
}

/// A number of an axis, without digits that say nothing.
fn short(value: f64) -> String {
    let text = format!("{value:.3e}");
    let (digits, power) = text.split_once('e').unwrap_or((&text, "0"));
    match power.parse::<i32>() {
        Ok(power @ -3..5) => {
            let after = (3 - power).max(0) as usize;
            without_zeros(&format!("{value:.after$}")).to_owned()
        }
        _ => format!("{}e{power}", without_zeros(digits)),
    }
}

#[cfg(test)]
mod tests {
    use super::Scale;

    #[test]
    fn ticks_are_round() {
        let ticks = |scale: Scale| -> Vec<String> {
            let ticks = scale.ticks().into_iter();
            ticks.map(|number| scale.label(number)).collect()
        };
        let of = |axis: &str| Scale::of(&axis.parse().expect("an axis"), 0.0);
        assert_eq!(ticks(of("a=0.3..1:8")), ["0.4", "0.6", "0.8", "1"]);
        assert_eq!(
            ticks(of("a=-2..4:8")),
            ["-2", "-1", "0", "1", "2", "3", "4"]
        );
        assert_eq!(
            ticks(of("a=1e-2..1:8:log")),
            ["0.01", "0.02", "0.05", "0.1", "0.2", "0.5", "1"]
        );
        assert_eq!(ticks(of("a=1e-2..1e4:8:log")).len(), 7);
        assert_eq!(ticks(of("a=1e3..1e9:8:log"))[6], "1e9");
        assert_eq!(
            ticks(Scale::around(1.0, 1.0, 0.1)),
            ["0.6", "0.8", "1", "1.2", "1.4"]
        );
        assert_eq!(of("a=1..100:8:log").part(10.0), 0.5);
        let close = ["3.001", "3.0012", "3.0014", "3.0016", "3.0018", "3.002"];
        assert_eq!(ticks(of("a=3.001..3.002:9")), close);
        let closer = of("a=7.00000095..7.00000145:9");
        assert_eq!(closer.named("a"), "a, from 7.000001");
        assert_eq!(ticks(closer), ["0", "1e-7", "2e-7", "3e-7", "4e-7"]);
        assert_eq!(of("a=0..1:8").named("a"), "a");
    }
}
