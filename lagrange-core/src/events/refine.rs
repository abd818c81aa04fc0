//! From an interval that holds one root to the root: Newton's iteration kept inside a shrinking bracket.

use core::ops::Range;

/// A polynomial by its coefficients of the powers of s, and what rounding does to its values.
#[derive(Clone, Copy, Debug)]
pub(super) struct Powers<'a>(pub &'a [f64]);

impl Powers<'_> {
    /// p, p′ and p″ at s.
    pub fn taylor(self, s: f64) -> [f64; 3] {
        let [mut p, mut dp, mut half] = [0.0; 3];
        for &c in self.0.iter().rev() {
            half = half * s + dp;
            dp = dp * s + p;
            p = p * s + c;
        }
        [p, dp, 2.0 * half]
    }

    /// p and p′ at s.
    pub fn newton(self, s: f64) -> (f64, f64) {
        let [mut p, mut dp] = [0.0; 2];
        for &c in self.0.iter().rev() {
            dp = dp * s + p;
            p = p * s + c;
        }
        (p, dp)
    }

    /// Bound of the rounding error of p(s): Horner's scheme on |cₖ| (Higham 2002, section 5.1).
    pub fn noise(self, s: f64) -> f64 {
        let size = self.0.iter().rev().fold(0.0, |sum, c| sum * s + c.abs());
        noise_factor(self.0.len()) * size
    }
}

/// Rounding bound of sums of `terms` products, relative to the sum of their sizes.
pub(super) fn noise_factor(terms: usize) -> f64 {
    (terms + 2) as f64 * f64::EPSILON
}

/// The zero of p in `bracket`, on whose upper side p is positive if `rising`, and the slope there; `guess` lies in the
/// bracket.
pub(super) fn root(p: Powers, bracket: Range<f64>, rising: bool, guess: f64) -> (f64, f64) {
    bracketed_newton(|s| p.newton(s), bracket, rising, guess)
}

/// The zero of p′ in `bracket`, a minimum of p if `rising`, and p″ there.
pub(super) fn extremum(p: Powers, bracket: Range<f64>, rising: bool, guess: f64) -> (f64, f64) {
    let derivatives = |s| {
        let [_, dp, ddp] = p.taylor(s);
        (dp, ddp)
    };
    bracketed_newton(derivatives, bracket, rising, guess)
}

/// Newton's iteration; bisection where it would leave the bracket or shrinks its steps too slowly.
fn bracketed_newton(
    f: impl Fn(f64) -> (f64, f64),
    bracket: Range<f64>,
    rising: bool,
    guess: f64,
) -> (f64, f64) {
    // 60 bisections exhaust the 53 bits of a number in [0, 1]; each is preceded by at most one Newton step.
    const MAX_ITERATIONS: usize = 120;
    let Range {
        start: mut lo,
        end: mut hi,
    } = bracket;
    let mut s = guess;
    let mut previous = hi - lo;
    // Number of Newton steps in a row.
    let mut newtons = 0;
    let mut slope = 0.0;
    for _ in 0..MAX_ITERATIONS {
        let value;
        (value, slope) = f(s);
        if value == 0.0 {
            break;
        }
        if (value > 0.0) == rising {
            hi = s;
        } else {
            lo = s;
        }
        let newton = s - value / slope;
        let step = (newton - s).abs();
        // Also false where the slope is zero and `newton` is not a number.
        let inside = newton > lo && newton < hi && step <= 0.5 * previous;
        s = if inside { newton } else { 0.5 * (lo + hi) };
        newtons = if inside { newtons + 1 } else { 0 };
        // Newton's steps shrink quadratically: once the next one is below rounding it need not be computed.
        let ratio = step / previous;
        if newtons > 1 && step * ratio * ratio <= 0.1 * f64::EPSILON * s
            || hi - lo <= f64::EPSILON * hi
        {
            break;
        }
        previous = if inside { step } else { hi - lo };
    }
    (s, slope)
}
