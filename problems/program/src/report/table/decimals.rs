//! How many digits numbers have, and times.

/// How a column of numbers is written: with five significant digits of its largest.
#[derive(Clone, Copy)]
pub enum Decimals {
    /// With so many of them.
    Plain(usize),
    /// As 1.2345e30.
    Scientific,
}

impl Decimals {
    pub fn of(values: impl IntoIterator<Item = f64>) -> Self {
        let largest = values
            .into_iter()
            .fold(0.0, |largest: f64, value| largest.max(value.abs()));
        match largest {
            0.0 => Decimals::Plain(4),
            1e-4..1e12 => {
                Decimals::Plain((4.0 - largest.log10().floor()).clamp(0.0, 13.0) as usize)
            }
            _ => Decimals::Scientific,
        }
    }

    /// The number, without the sign of a zero.
    pub fn show(self, value: f64) -> String {
        let text = match self {
            Decimals::Plain(decimals) => format!("{value:.decimals$}"),
            Decimals::Scientific if value == 0.0 => "0".to_owned(),
            Decimals::Scientific => format!("{value:.4e}"),
        };
        match text.strip_prefix('-') {
            Some(digits) if digits.chars().all(|c| matches!(c, '0' | '.')) => digits.to_owned(),
            _ => text,
        }
    }
}

/// A time of a run that `lasts` so long: to a microsecond where that has a meaning, and to as much less as the run is shorter than 10 ms.
pub(in crate::report) fn time(t: f64, lasts: f64) -> String {
    let shorter = match lasts > 0.0 && lasts < 1e-2 {
        true => (-1.0 - lasts.log10()).ceil() as usize,
        false => 0,
    };
    match t.abs() < 1e9 && shorter < 9 {
        true => format!("{t:.0$}", 6 + shorter),
        false => format!("{t:.9e}"),
    }
}
