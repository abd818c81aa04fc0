//! Numbers over time: a list with one for every sample, or a single one for all.

use serde::Serialize;

/// Values at every sample.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub(crate) enum Column {
    /// The same at all.
    Constant(f64),
    /// One for each.
    Varying(Vec<f64>),
}

impl Column {
    /// Of one value for every sample.
    pub fn of(values: impl Iterator<Item = f64>) -> Self {
        let values: Vec<f64> = values.collect();
        match values.first() {
            Some(first) if values.iter().all(|value| value == first) => Self::Constant(*first),
            _ => Self::Varying(values),
        }
    }

    /// At a place among the samples.
    pub fn at(&self, place: Place) -> f64 {
        let values = match self {
            Self::Constant(value) => return *value,
            Self::Varying(values) => values,
        };
        let value = |i: usize| values.get(i).copied().unwrap_or(0.0);
        let from = value(place.sample);
        match place.part {
            0.0 => from,
            part => from + part * (value(place.sample + 1) - from),
        }
    }
}

/// A time among samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Place {
    /// The last sample that is not after it.
    pub sample: usize,
    /// Part of the way to the next one, from 0 to 1.
    pub part: f64,
}

impl Place {
    /// Where `time` lies among ascending times; the first or last of them if it lies outside. Of equal ones the last counts.
    pub fn of(time: f64, times: &[f64]) -> Self {
        let after = times.partition_point(|t| *t <= time);
        let sample = after.saturating_sub(1);
        let width = match (times.get(sample), times.get(sample + 1)) {
            (Some(from), Some(to)) if after > 0 => to - from,
            _ => 0.0,
        };
        let part = match width > 0.0 {
            true => (time - times[sample]) / width,
            false => 0.0,
        };
        Self { sample, part }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_between_samples() {
        let times = [0.0, 1.0, 1.0, 3.0];
        let column = Column::of([5.0, 6.0, 0.0, 4.0].into_iter());
        let at = |time| column.at(Place::of(time, &times));
        assert_eq!(
            [-1.0, 0.0, 0.5, 1.0, 2.5, 3.0, 9.0].map(at),
            [5.0, 5.0, 5.5, 0.0, 3.0, 4.0, 4.0]
        );
        assert_eq!(Column::of([2.0, 2.0].into_iter()), Column::Constant(2.0));
        assert_eq!(
            Place::of(1.0, &[]),
            Place {
                sample: 0,
                part: 0.0
            }
        );
    }
}
