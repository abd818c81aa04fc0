//! Nodes and weights of quadrature.

/// Nodes and weights of Radau's quadrature with three places in [0, 1], the last of them the end (Hairer & Wanner 1996, section IV.5).
pub(super) const RADAU: [(f64, f64); 3] = [
    (0.155_051_025_721_682_2, 0.376_403_062_700_467_3),
    (0.644_948_974_278_317_8, 0.512_485_826_188_421_6),
    (1.0, 1.0 / 9.0),
];

/// Nodes and weights of Gauss–Legendre quadrature on [−1, 1], by Newton's method on the Legendre polynomial (Davis & Rabinowitz
/// 1984, section 2.7).
pub(super) fn gauss(points: usize) -> Vec<(f64, f64)> {
    let n = points as f64;
    let node = |k: usize| {
        let mut x = -(core::f64::consts::PI * (k as f64 + 0.75) / (n + 0.5)).cos();
        let mut slope = 1.0;
        for _ in 0..8 {
            let (mut before, mut p) = (1.0, x);
            for j in 2..=points {
                let j = j as f64;
                (before, p) = (p, ((2.0 * j - 1.0) * x * p - (j - 1.0) * before) / j);
            }
            slope = n * (x * p - before) / (x * x - 1.0);
            x -= p / slope;
        }
        (x, 2.0 / ((1.0 - x * x) * slope * slope))
    };
    (0..points).map(node).collect()
}
