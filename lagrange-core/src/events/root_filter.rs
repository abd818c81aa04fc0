//! What a few additions tell of a polynomial on [0, 1]. Most guards of most steps have no root, and most that have one are
//! monotone; both are seen from the first coefficients in the Bernstein basis and the sizes of the others.

use super::refine::noise_factor;

/// Coefficients that are looked at one by one.
const HEAD: usize = 4;

/// What is certain about a polynomial on (0, 1].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum RootFilter {
    /// It keeps one sign.
    NoRoots,
    /// It only rises or only falls; with Σ|cₖ|.
    Monotone {
        /// Σ|cₖ|
        size: f64,
    },
    /// Nothing; with Σ|cₖ|.
    Unclear {
        /// Σ|cₖ|
        size: f64,
    },
}

/// Whether Σ cₖ sᵏ certainly keeps one sign on [0, 1] and begins with a value of more than `share` of Σ|cₖ|, given Σ|cₖ| without
/// the first two.
#[inline]
pub fn keeps_its_sign(c: &[f64], rest: f64, share: f64) -> bool {
    let [c0, c1, c2, c3, ..] = *c else {
        return false;
    };
    let size = c0.abs() + c1.abs() + rest;
    // The other coefficients in the Bernstein basis of the cubic that the first four make.
    let sign = c0.signum();
    let second = sign * (c0 + c1 / 3.0);
    let third = sign * (c0 + (2.0 * c1 + c2) / 3.0);
    let last = sign * (c0 + c1 + c2 + c3);
    let margin = rest - (c2.abs() + c3.abs()) + 2.0 * noise_factor(c.len()) * size;
    let lowest = smaller(smaller(c0.abs(), second), smaller(third, last));
    lowest > margin && c0.abs() > share * size
}

/// The smaller of two numbers, the first if either is not a number.
#[inline]
fn smaller(x: f64, y: f64) -> f64 {
    if x > y { y } else { x }
}

/// Looks at Σ cₖ sᵏ.
#[inline]
pub(super) fn root_filter(c: &[f64]) -> RootFilter {
    let mut head = [0.0; HEAD];
    let length = c.len().min(HEAD);
    head[..length].copy_from_slice(&c[..length]);
    let [c0, c1, c2, c3] = head;
    let tail = &c[length..];

    let rest = sum_of_sizes(tail);
    let size = c0.abs() + c1.abs() + c2.abs() + c3.abs() + rest;
    let cubic = [
        c0,
        c0 + c1 / 3.0,
        c0 + (2.0 * c1 + c2) / 3.0,
        c0 + c1 + c2 + c3,
    ];
    if same_sign(cubic, rest + noise_factor(c.len()) * size) {
        return RootFilter::NoRoots;
    }
    let rest = weighted_sum_of_sizes(tail);
    let derivative = [c1, c1 + c2, c1 + 2.0 * c2 + 3.0 * c3];
    // The noise of a derivative's coefficients is at most the degree times that of the values.
    if same_sign(
        derivative,
        rest + noise_factor(c.len()) * c.len() as f64 * size,
    ) {
        return RootFilter::Monotone { size };
    }
    RootFilter::Unclear { size }
}

/// Whether all numbers lie above `margin`, or all below −`margin`. False if any is NaN.
fn same_sign<const N: usize>(numbers: [f64; N], margin: f64) -> bool {
    numbers.iter().all(|&x| x > margin) || numbers.iter().all(|&x| x < -margin)
}

/// Σ|cₖ|, in four chains so that no addition waits for the one before.
fn sum_of_sizes(c: &[f64]) -> f64 {
    let chunks = c.chunks_exact(4);
    let rest: f64 = chunks.remainder().iter().map(|c| c.abs()).sum();
    let sums = chunks.fold([0.0; 4], |mut sums, four| {
        for (sum, c) in sums.iter_mut().zip(four) {
            *sum += c.abs();
        }
        sums
    });
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
}

/// Σ k |cₖ|, the first coefficient being that of s^[`HEAD`].
fn weighted_sum_of_sizes(c: &[f64]) -> f64 {
    let mut k = [0.0, 1.0, 2.0, 3.0].map(|i| i + HEAD as f64);
    let mut sums = [0.0; 4];
    let chunks = c.chunks_exact(4);
    let rest = chunks.remainder();
    for four in chunks {
        for ((sum, k), c) in sums.iter_mut().zip(&mut k).zip(four) {
            *sum += *k * c.abs();
            *k += 4.0;
        }
    }
    let rest: f64 = rest.iter().zip(k).map(|(c, k)| k * c.abs()).sum();
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decay_is_seen() {
        assert_eq!(
            root_filter(&[1.0, -0.5, 0.2, -0.1, 0.05]),
            RootFilter::NoRoots
        );
        // |c₀| < Σ|cₖ|, but the signs differ.
        assert_eq!(root_filter(&[1.0, -1.2, 1.2, -0.3]), RootFilter::NoRoots);
        assert!(matches!(
            root_filter(&[1.0, -2.0, 0.2, -0.1, 0.1]),
            RootFilter::Monotone { .. }
        ));
        assert!(matches!(
            root_filter(&[0.25, -1.0, 1.0]),
            RootFilter::Unclear { .. }
        ));
        assert!(matches!(
            root_filter(&[f64::NAN, 1.0]),
            RootFilter::Unclear { .. }
        ));
        assert!(matches!(
            root_filter(&[0.0; 3]),
            RootFilter::Unclear { size: 0.0 }
        ));
    }

    #[test]
    fn sums_do_not_depend_on_the_chunks() {
        for n in 0..14 {
            let c: Vec<f64> = (0..n)
                .map(|k| if k % 2 == 0 { 1.0 } else { -1.0 })
                .collect();
            assert_eq!(sum_of_sizes(&c), n as f64);
            let weighted: usize = (0..n).map(|k| k + HEAD).sum();
            assert_eq!(weighted_sum_of_sizes(&c), weighted as f64);
        }
    }
}
