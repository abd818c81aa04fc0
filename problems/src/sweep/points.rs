//! The points of a sweep: a grid, or a sample of a box. Point number i is the same whoever asks for it.

use core::fmt;
use core::str::FromStr;

/// One number that is varied.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// A parameter, a coordinate (`theta`) or a velocity (`der(theta)`) of the start.
    pub name: String,
    /// First value.
    pub from: f64,
    /// Last value.
    pub to: f64,
    /// Number of values; 1 for a sample, which takes them anywhere.
    pub count: usize,
    /// Whether values are spaced by equal ratios.
    pub logarithmic: bool,
}

impl Axis {
    /// The value at a part of the way, 0 … 1.
    fn at(&self, part: f64) -> f64 {
        if part == 1.0 {
            self.to
        } else if self.logarithmic {
            self.from * (self.to / self.from).powf(part)
        } else {
            self.from + (self.to - self.from) * part
        }
    }

    /// Value number `index` of a grid.
    fn value(&self, index: usize) -> f64 {
        match self.count {
            1 => self.from,
            _ => self.at(index as f64 / (self.count - 1) as f64),
        }
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
        let number = |text: &str| match text.trim().parse::<f64>() {
            Ok(value) if value.is_finite() => Ok(value),
            _ => Err(format!("`{}` is not a finite number", text.trim())),
        };
        let (from, to) = (number(from)?, number(rest.next().ok_or(form)?)?);
        let count = match rest.next() {
            None => 1,
            Some(count) => match count.trim().parse::<usize>() {
                Ok(count) if count > 0 => count,
                _ => return Err(format!("`{}` is not a number of values", count.trim())),
            },
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
        write!(f, "{}={}..{}:{}", self.name, self.from, self.to, self.count)?;
        match self.logarithmic {
            true => write!(f, ":log"),
            false => Ok(()),
        }
    }
}

/// How points are chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sampling {
    /// Every combination of the values of the axes; the last axis runs fastest.
    Grid,
    /// Points of a Sobol sequence with Owen's scrambling (Burley 2020, Practical hash-based Owen scrambling): they fill the box
    /// more evenly than random ones.
    Sobol {
        /// Number of points.
        count: usize,
        /// Chooses one of many such sequences.
        seed: u32,
    },
}

/// The points of a sweep.
#[derive(Clone, Debug, PartialEq)]
pub struct Points {
    /// What is varied.
    pub axes: Vec<Axis>,
    /// How.
    pub sampling: Sampling,
}

impl Points {
    /// Number of points.
    pub fn len(&self) -> usize {
        match self.sampling {
            Sampling::Grid => self.axes.iter().map(|axis| axis.count).product(),
            Sampling::Sobol { count, .. } => count,
        }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Writes point number `index`, one number per axis.
    pub fn write(&self, index: usize, point: &mut [f64]) {
        match self.sampling {
            Sampling::Grid => {
                let mut rest = index;
                for (axis, value) in self.axes.iter().zip(point).rev() {
                    *value = axis.value(rest % axis.count);
                    rest /= axis.count;
                }
            }
            Sampling::Sobol { seed, .. } => {
                let dimensions = self.axes.iter().zip(point).zip(0..);
                for ((axis, value), dimension) in dimensions {
                    let part = sobol_burley::sample(index as u32, dimension, seed);
                    *value = axis.at(f64::from(part));
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Axis, Points, Sampling};

    #[test]
    fn axes_are_read() {
        let axis: Axis = "mu = 0.1..1:4".parse().expect("an axis");
        assert_eq!((axis.name.as_str(), axis.count), ("mu", 4));
        let values: Vec<f64> = (0..4).map(|i| axis.value(i)).collect();
        for (value, expected) in values.iter().zip([0.1, 0.4, 0.7, 1.0]) {
            assert!((value - expected).abs() < 1e-15);
        }
        let axis: Axis = "k=1e-2..1e4:7:log".parse().expect("an axis");
        assert!((axis.value(3) - 10.0).abs() < 1e-13 && axis.value(6) == 1e4);
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

    #[test]
    fn a_grid_has_every_combination_once() {
        let axes = ["a=0..1:2", "b=0..2:3"].map(|axis| axis.parse().expect("an axis"));
        let points = Points {
            axes: axes.to_vec(),
            sampling: Sampling::Grid,
        };
        let mut point = [0.0; 2];
        let all: Vec<[f64; 2]> = (0..points.len())
            .map(|i| {
                points.write(i, &mut point);
                point
            })
            .collect();
        assert_eq!(
            all,
            [
                [0.0, 0.0],
                [0.0, 1.0],
                [0.0, 2.0],
                [1.0, 0.0],
                [1.0, 1.0],
                [1.0, 2.0]
            ]
        );
    }

    #[test]
    fn a_sobol_sample_fills_the_box_evenly() {
        let axes = ["a=0..1", "b=2..4"].map(|axis| axis.parse().expect("an axis"));
        let points = Points {
            axes: axes.to_vec(),
            sampling: Sampling::Sobol {
                count: 1024,
                seed: 7,
            },
        };
        // Elementary intervals: each of 32 × 32 boxes holds one of 1024 points of a (0, 2)-sequence.
        let mut boxes = vec![0; 1024];
        let mut point = [0.0; 2];
        for i in 0..1024 {
            points.write(i, &mut point);
            let cell = |x: f64| (x * 32.0) as usize;
            boxes[cell(point[0]) * 32 + cell((point[1] - 2.0) / 2.0)] += 1;
        }
        assert!(boxes.iter().all(|count| *count == 1));
    }
}
