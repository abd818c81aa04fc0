//! Logarithmic axes: error to the right, time upward.

use super::HEIGHT;
use crate::report::plot::{Area, Drawn, FINE, WIDTH, px, words};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, VPos};

/// Where the diagram is, and what its edges mean: logarithms to the base of ten.
pub(super) struct Frame {
    error: (f64, f64),
    time: (f64, f64),
    floor: f64,
}

impl Frame {
    /// A frame for points (error, time) with errors of at least `floor`; `None` without points.
    pub(super) fn around(points: impl Iterator<Item = (f64, f64)>, floor: f64) -> Option<Self> {
        let logs = points.map(|(error, time)| (error.log10(), time.max(1e-9).log10()));
        let (largest, least, most) = logs.fold(None, |edges, (error, time)| {
            let (largest, least, most) = edges.unwrap_or((error, time, time));
            Some((error.max(largest), time.min(least), time.max(most)))
        })?;
        let floor = floor.log10();
        let room = 0.06 * (most - least).max(1.0);
        Some(Self {
            error: (floor - 0.5, (largest + 0.2).max(floor + 1.0)),
            time: (least - 1.5 * room, most + room),
            floor,
        })
    }

    pub(super) fn left(&self) -> i32 {
        px(82)
    }

    pub(super) fn right(&self) -> i32 {
        WIDTH as i32 - px(196)
    }

    pub(super) fn top(&self) -> i32 {
        px(42)
    }

    pub(super) fn bottom(&self) -> i32 {
        HEIGHT as i32 - px(98)
    }

    /// Where (error, time) is drawn.
    pub(super) fn place(&self, (error, time): (f64, f64)) -> (i32, i32) {
        (self.column(error.log10()), self.row(time.max(1e-9).log10()))
    }

    fn column(&self, log: f64) -> i32 {
        let part = (log - self.error.0) / (self.error.1 - self.error.0);
        self.left() + (part * f64::from(self.right() - self.left())).round() as i32
    }

    fn row(&self, log: f64) -> i32 {
        let part = (log - self.time.0) / (self.time.1 - self.time.0);
        self.bottom() - (part * f64::from(self.bottom() - self.top())).round() as i32
    }
}

/// Grid, floor, numbers, titles.
pub(super) fn draw<'a>(root: &Area<'a>, frame: &Frame) -> Drawn<'a> {
    let (left, right, top, bottom) = (frame.left(), frame.right(), frame.top(), frame.bottom());
    let floor = frame.column(frame.floor);
    root.draw(&Rectangle::new(
        [(left, top), (floor, bottom)],
        BLACK.mix(0.07).filled(),
    ))?;
    let line = |from, to, shade: f64| {
        let style = BLACK.mix(shade).stroke_width(FINE);
        root.draw(&PathElement::new(vec![from, to], style))
    };
    let numbers = |horizontal, vertical| words(13, &BLACK, horizontal, vertical);

    let (first, last) = (frame.error.0.ceil() as i32, frame.error.1.floor() as i32);
    let every = if last - first > 10 { 2 } else { 1 };
    for power in first..=last {
        let x = frame.column(f64::from(power));
        let named = power % every == 0;
        line((x, top), (x, bottom), if named { 0.14 } else { 0.07 })?;
        if named {
            line((x, bottom), (x, bottom + px(5)), 1.0)?;
            let style = numbers(HPos::Center, VPos::Top);
            root.draw(&Text::new(scientific(power), (x, bottom + px(9)), style))?;
        }
    }
    // In a narrow range of times every line has its number, in a wide one only the powers of ten.
    let wide = frame.time.1 - frame.time.0 > 2.2;
    for power in frame.time.0.floor() as i32..=frame.time.1.ceil() as i32 {
        for digit in 1..10 {
            let log = f64::from(power) + f64::from(digit).log10();
            if !(frame.time.0..=frame.time.1).contains(&log) {
                continue;
            }
            let y = frame.row(log);
            let named = digit == 1 || !wide && [2, 5].contains(&digit);
            line((left, y), (right, y), if named { 0.14 } else { 0.05 })?;
            if named {
                line((left - px(5), y), (left, y), 1.0)?;
                let style = numbers(HPos::Right, VPos::Center);
                root.draw(&Text::new(time(digit, power), (left - px(9), y), style))?;
            }
        }
    }
    line((left, bottom), (right, bottom), 1.0)?;
    line((left, top), (left, bottom), 1.0)?;

    let title = words(14, &BLACK, HPos::Center, VPos::Top);
    let middle = ((left + right) / 2, bottom + px(31));
    root.draw(&Text::new("error, more exact to the left", middle, title))?;
    let upward = words(14, &BLACK, HPos::Center, VPos::Top).transform(FontTransform::Rotate270);
    let beside = (px(8), (top + bottom) / 2);
    root.draw(&Text::new("time of one run", beside, upward))?;
    let style =
        words(12, &BLACK.mix(0.55), HPos::Center, VPos::Bottom).transform(FontTransform::None);
    let above = ((left + floor) / 2, top - px(4));
    root.draw(&Text::new("floor", above, style))
}

/// 10⁻¹⁵
fn scientific(power: i32) -> String {
    let superscript = |c: char| match c {
        '-' => '⁻',
        digit => ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'][digit as usize - '0' as usize],
    };
    match power {
        0 => "1".to_owned(),
        _ => format!(
            "10{}",
            power
                .to_string()
                .chars()
                .map(superscript)
                .collect::<String>()
        ),
    }
}

/// `digit`·10^`power` seconds with a unit.
fn time(digit: i32, power: i32) -> String {
    let (unit, base) = match power {
        ..-6 => ("ns", -9),
        -6..-3 => ("µs", -6),
        -3..0 => ("ms", -3),
        _ => ("s", 0),
    };
    format!(
        "{digit}{} {unit}",
        "0".repeat((power - base).max(0) as usize)
    )
}

#[cfg(test)]
mod tests {
    use super::{scientific, time};

    #[test]
    fn numbers_on_the_axes() {
        assert_eq!(
            [-15, -2, 0, 1].map(scientific),
            ["10⁻¹⁵", "10⁻²", "1", "10¹"]
        );
        let times = [(1, -9), (2, -5), (5, -4), (1, -3), (2, -1), (1, 1)].map(|(d, p)| time(d, p));
        assert_eq!(times, ["1 ns", "20 µs", "500 µs", "1 ms", "200 ms", "10 s"]);
    }
}
