//! Polynomials on [0, 1] in the Bernstein basis: p(s) = Σ bᵢ C(d,i) sⁱ (1 − s)^(d−i).
//!
//! The number of sign changes in b₀ … b_d bounds the number of roots in (0, 1), and differs from it by an even
//! number (Descartes' rule of signs in this basis). Subdivision at an inner point is de Casteljau's algorithm,
//! whose convex combinations do not amplify rounding errors (Farouki & Rajan 1987).

/// Largest degree of a guard.
pub const MAX_DEGREE: usize = 40;

/// Bernstein coefficients, the first degree + 1 in use.
pub(super) type Coefficients = [f64; MAX_DEGREE + 1];

/// 1 / C(d, k). Every C(d, k) up to d = 40 is an exact `f64`.
static INVERSE_BINOMIALS: [Coefficients; MAX_DEGREE + 1] = inverse_binomials();

const fn inverse_binomials() -> [Coefficients; MAX_DEGREE + 1] {
    let mut table = [[0.0; MAX_DEGREE + 1]; MAX_DEGREE + 1];
    let mut d = 0;
    while d <= MAX_DEGREE {
        let mut binomial = 1.0;
        let mut k = 0;
        while k <= d {
            table[d][k] = 1.0 / binomial;
            binomial = binomial * (d - k) as f64 / (k + 1) as f64;
            k += 1;
        }
        d += 1;
    }
    table
}

/// bᵢ = Σₖ C(i,k)/C(d,k) cₖ from the coefficients `c` of the powers of s.
pub(super) fn from_powers(c: &[f64]) -> Coefficients {
    let d = c.len() - 1;
    let mut b = [0.0; MAX_DEGREE + 1];
    for ((b, c), inverse) in b.iter_mut().zip(c).zip(&INVERSE_BINOMIALS[d]) {
        *b = c * inverse;
    }
    for r in 1..=d {
        let mut before = b[r - 1];
        for b in &mut b[r..=d] {
            before = core::mem::replace(b, *b + before);
        }
    }
    b
}

/// The polynomial on [0, t] and on [t, 1].
pub(super) fn split(b: &[f64], t: f64) -> (Coefficients, Coefficients) {
    let d = b.len() - 1;
    let mut left = [0.0; MAX_DEGREE + 1];
    let mut right = [0.0; MAX_DEGREE + 1];
    right[..=d].copy_from_slice(b);
    for (r, left) in left[..=d].iter_mut().enumerate() {
        *left = right[0];
        for i in 0..d - r {
            right[i] = (1.0 - t) * right[i] + t * right[i + 1];
        }
    }
    (left, right)
}

/// Sign changes of a sequence, numbers not above `noise` left out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Variations {
    /// Number of changes.
    pub count: usize,
    /// Whether the first number that counts is positive; `None` if none counts.
    pub first_positive: Option<bool>,
}

/// Counts the sign changes of `numbers`.
pub(super) fn variations(numbers: impl Iterator<Item = f64>, noise: f64) -> Variations {
    let mut count = 0;
    let mut first_positive = None;
    let mut positive = false;
    for x in numbers.filter(|x| x.abs() > noise) {
        match first_positive {
            None => first_positive = Some(x > 0.0),
            Some(_) => count += usize::from(positive != (x > 0.0)),
        }
        positive = x > 0.0;
    }
    Variations {
        count,
        first_positive,
    }
}
