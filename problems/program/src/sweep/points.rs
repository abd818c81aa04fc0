//! The points of a sweep: a grid, or a sample of a box. Point number i is the same whoever asks for it.

use super::{Axis, sample, sobol};
use crate::number::count;
use core::fmt;
use core::str::FromStr;

/// How points are chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sampling {
    /// Every combination of the values of the axes; the last axis runs fastest.
    Grid,
    /// So many points of the box.
    Sample {
        /// How they are spread.
        kind: Kind,
        /// Number of points.
        count: usize,
        /// Chooses one of many such samples.
        seed: u32,
    },
}

/// How the points of a sample are spread.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A Sobol sequence, scrambled (Owen 1995): fills the box more evenly than random points. The first 2ᵏ points are the most even.
    Sobol,
    /// Independently of each other.
    Random,
    /// A Latin hypercube (McKay, Beckman and Conover 1979): of as many slices of an axis as there are points, each has one.
    Latin,
}

impl Kind {
    const ALL: [(&'static str, Kind); 3] = [
        ("sobol", Kind::Sobol),
        ("random", Kind::Random),
        ("lhs", Kind::Latin),
    ];
}

impl Sampling {
    /// The sample of the same kind and size with this seed.
    pub fn seeded(self, seed: u32) -> Self {
        match self {
            Sampling::Grid => Sampling::Grid,
            Sampling::Sample { kind, count, .. } => Sampling::Sample { kind, count, seed },
        }
    }

    /// Which of many samples, if it is one.
    pub fn seed(self) -> Option<u32> {
        match self {
            Sampling::Grid => None,
            Sampling::Sample { seed, .. } => Some(seed),
        }
    }
}

/// `sobol:N`, `random:N` or `lhs:N`, with the seed 0.
impl FromStr for Sampling {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (word, number) = text.split_once(':').unwrap_or((text, ""));
        let kind = Kind::ALL.iter().find(|(name, _)| *name == word);
        match (kind, count(number)) {
            (Some(&(_, kind)), Some(count)) => Ok(Sampling::Sample {
                kind,
                count,
                seed: 0,
            }),
            _ => Err("expected sobol:N, random:N or lhs:N with a number of points N".to_owned()),
        }
    }
}

/// Without the seed.
impl fmt::Display for Sampling {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Sampling::Grid => write!(f, "grid"),
            Sampling::Sample { kind, count, .. } => {
                let known = Kind::ALL.iter().find(|(_, other)| other == kind);
                let word = known.map_or("", |(name, _)| name);
                write!(f, "{word}:{count}")
            }
        }
    }
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
    /// Number of points, which may be more than can be counted.
    pub(super) fn size(&self) -> f64 {
        match self.sampling {
            Sampling::Grid => self.axes.iter().map(|axis| axis.count as f64).product(),
            Sampling::Sample { count, .. } => count as f64,
        }
    }

    /// Number of points.
    pub fn len(&self) -> usize {
        match self.sampling {
            Sampling::Grid => self
                .axes
                .iter()
                .fold(1, |count, axis| count.saturating_mul(axis.count)),
            Sampling::Sample { count, .. } => count,
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
            Sampling::Sample { kind, count, seed } => {
                for ((dimension, axis), value) in self.axes.iter().enumerate().zip(point) {
                    let (seed, index) = (seed.into(), index as u64);
                    *value = axis.at(match kind {
                        Kind::Sobol => sobol::coordinate(seed, dimension, index),
                        Kind::Random => sample::random(seed, dimension, index),
                        Kind::Latin => sample::latin(seed, dimension, index, count as u64),
                    });
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Points, Sampling};

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

    /// All points of a sample of the unit square.
    fn square(sample: &str) -> Vec<[f64; 2]> {
        let axes = ["a=0..1", "b=0..1"].map(|axis| axis.parse().expect("an axis"));
        let sampling: Sampling = sample.parse().expect("a sample");
        let points = Points {
            axes: axes.to_vec(),
            sampling: sampling.seeded(7),
        };
        let mut point = [0.0; 2];
        let mut all = Vec::new();
        for i in 0..points.len() {
            points.write(i, &mut point);
            all.push(point);
        }
        all
    }

    #[test]
    fn a_sobol_sample_fills_the_box_evenly() {
        // Elementary intervals: each box of 2ᵃ × 2ᵇ with a + b = 10 holds one of 1024 points of a (0, 2)-sequence, also of those
        // after the first 2¹⁶.
        let points = square("sobol:132096");
        for run in [0..1024, 131_072..132_096] {
            for wide in 0..=10 {
                let mut boxes = vec![0; 1024];
                for [x, y] in &points[run.clone()] {
                    let cell = |x: f64, power: i32| (x * 2_f64.powi(power)) as usize;
                    boxes[cell(*x, wide) << (10 - wide) | cell(*y, 10 - wide)] += 1;
                }
                assert!(boxes.iter().all(|count| *count == 1), "{run:?} {wide}");
            }
        }
    }

    #[test]
    fn a_latin_hypercube_has_a_point_in_each_slice() {
        for count in [1, 2, 3, 1000, 1024, 1025] {
            let points = square(&format!("lhs:{count}"));
            for axis in 0..2 {
                let mut slices = vec![0; count];
                for point in &points {
                    slices[(point[axis] * count as f64) as usize] += 1;
                }
                assert!(slices.iter().all(|n| *n == 1), "{count}");
            }
        }
    }

    #[test]
    fn random_points_are_spread_as_chance_would() {
        // χ² over 1024 boxes with 1023 degrees of freedom: mean 1023, deviation √2046 = 45.
        let points = square("random:102400");
        let mut boxes = vec![0.0; 1024];
        let mut product = 0.0;
        for [x, y] in &points {
            boxes[((x * 32.0) as usize) * 32 + (y * 32.0) as usize] += 1.0;
            product += (x - 0.5) * (y - 0.5);
        }
        let chi: f64 = boxes
            .iter()
            .map(|n: &f64| (n - 100.0).powi(2) / 100.0)
            .sum();
        assert!((chi - 1023.0).abs() < 4.0 * 45.2, "{chi}");
        // Covariance 0 with deviation 1/12 √n.
        assert!(product.abs() < 4.0 / 12.0 * 320.0, "{product}");
    }

    #[test]
    fn seeds_and_samples_are_read() {
        for wrong in ["sobol", "sobol:0", "sobol:x", "halton:5", ""] {
            assert!(wrong.parse::<Sampling>().is_err(), "{wrong}");
        }
        for right in ["sobol:10", "random:3", "lhs:100"] {
            let sampling: Sampling = right.parse().expect("a sample");
            assert_eq!(sampling.to_string(), right);
        }
        assert_ne!(square("random:3"), square("lhs:3"));
    }
}
