//! Order and step size of the Taylor method, and the check that they were right.
//!
//! The step is the one at which the last term is e⁻² of the allowed error (Jorba & Zou, "A software package for the
//! numerical integration of ODEs by means of high-order Taylor methods", Experimental Mathematics 14 (2005), section 3).
//! They take the order ⌈−½ ln ε⌉ + 1, the best one if a series costs order²; what a step costs besides (events, a check)
//! makes a few orders more and fewer steps cheaper, measured on the scenes by 10 % and more.
//!
//! Their step reads the last two coefficients. Those can vanish by symmetry: a pendulum that starts from rest at exactly
//! π/2 has q₂, q₆, q₁₀ … only, and any order divides badly into such gaps. Here the upper half of the coefficients is
//! read, and each predicts the last term by the decay that the others show. Independently of all coefficients,
//! [`defect`] compares the series' acceleration at the end with a fresh evaluation.

use super::{StepPolynomial, Tolerance};
use crate::arithmetic::Scalar;

/// Largest order that [`order`] gives.
pub const MAX_ORDER: usize = 28;
const MIN_ORDER: usize = 4;

/// Order for a tolerance: ⌈3 − 0.6 ln ε⌉, between 4 and [`MAX_ORDER`].
pub fn order(tolerance: Tolerance) -> usize {
    // A tolerance of 0 asks for infinitely many, a NaN (which casts to 0) for none.
    let order = (3.0 - 0.6 * tolerance.strictness().ln()).ceil() as usize;
    order.clamp(MIN_ORDER, MAX_ORDER)
}

/// Taylor coefficients of a solution about the start of a step, in powers of the time (not scaled by h).
pub trait Series<T> {
    /// Number of coordinates.
    fn coordinates(&self) -> usize;
    /// Coefficients of the position of coordinate `i`, at least to the order used.
    fn position(&self, i: usize) -> &[T];
    /// Coefficients of the velocity of coordinate `i`, at least to the order used.
    fn velocity(&self, i: usize) -> &[T];
}

/// Step size for series used to `order`: every component's truncation error stays below its share of the tolerance
/// (`absolute` + `relative`·|value at the start|, for positions and velocities alike).
///
/// Infinite if the series end (polynomial motion): something else limits that step. `None` if a coefficient that is needed
/// is not finite.
pub fn step_size<T: Scalar>(
    series: &impl Series<T>,
    order: usize,
    tolerance: Tolerance,
) -> Option<f64> {
    let first = (order / 2).max(3).min(order);
    let mut sizes = [0.0; MAX_ORDER + 1];
    let sizes = &mut sizes[..order + 1 - first];
    // The sum of zeros is zero unless one of the factors is not finite.
    let mut poison = [0.0; MAX_ORDER + 1];
    for i in 0..series.coordinates() {
        for row in [series.position(i), series.velocity(i)] {
            let limit = 1.0 / tolerance.scale(row[0].value().abs());
            let sizes = sizes.iter_mut().zip(&mut poison);
            for ((size, poison), c) in sizes.zip(&row[first..=order]) {
                let ratio = c.value().abs() * limit;
                *poison += 0.0 * ratio;
                *size = if ratio > *size { ratio } else { *size };
            }
        }
    }
    if poison[..sizes.len()].iter().any(|&x| x != 0.0) {
        return None;
    }
    Some(step_from_sizes(sizes, first, tolerance.strictness()))
}

/// Step from the sizes of the coefficients of the orders `first`, `first` + 1, … in units of the allowed error.
fn step_from_sizes(sizes: &[f64], first: usize, strictness: f64) -> f64 {
    /// How far the decay may be steeper than the root test says (entire functions: log₂ e), as log₂.
    const STEEPER: f64 = 2.0;
    /// Bend of the logarithm that a prediction over several orders may ignore, per order, as log₂.
    const BEND: f64 = 0.6;
    /// log₂ e⁻², the last term.
    const LAST: f64 = -2.0 * core::f64::consts::LOG2_E;

    let order = (first + sizes.len() - 1) as f64;
    let base = -rough_log2(strictness);
    let mut logs = [0.0; MAX_ORDER + 1];
    let logs = &mut logs[..sizes.len()];
    // Root test: no coefficient lies above 2^(base + root·k).
    let mut root = f64::NEG_INFINITY;
    for (k, (log, &size)) in (first..).zip(logs.iter_mut().zip(sizes)) {
        *log = rough_log2(size);
        root = larger(root, (*log - base) * RECIPROCALS[k]);
    }
    if root == f64::NEG_INFINITY {
        return f64::INFINITY;
    }
    // Decay between the highest points, seen from that line, of the lower and of the upper half.
    let (lower, upper) = logs.split_at(logs.len() / 2);
    let highest = |logs: &[f64], first: usize| {
        let mut highest = (f64::NEG_INFINITY, 0.0);
        for (k, log) in (first..).zip(logs) {
            let above = log - root * k as f64;
            if above > highest.0 {
                highest = (above, k as f64);
            }
        }
        highest
    };
    let (low, j) = highest(lower, first);
    let (high, k) = highest(upper, first + lower.len());
    let slope = (high - low) / (k - j);
    // A half without any coefficient has no highest point.
    let decay = if slope.is_finite() {
        root + slope.max(-STEEPER)
    } else {
        root
    };
    // Each coefficient's prediction of the last one.
    let mut last = f64::NEG_INFINITY;
    for (k, log) in (first..).zip(logs.iter()) {
        last = larger(last, log + (order - k as f64) * (decay - BEND));
    }
    ((LAST - last) / order).exp2()
}

/// The larger of two numbers that are not NaN, in one instruction.
fn larger(x: f64, y: f64) -> f64 {
    if x > y { x } else { y }
}

/// 1/k
const RECIPROCALS: [f64; MAX_ORDER + 1] = {
    let mut table = [0.0; MAX_ORDER + 1];
    let mut k = 1;
    while k <= MAX_ORDER {
        table[k] = 1.0 / k as f64;
        k += 1;
    }
    table
};

/// log₂ x to within 0.1, monotone: the exponent and mantissa bits read as one number. −∞ for 0 and subnormals.
fn rough_log2(x: f64) -> f64 {
    if x < f64::MIN_POSITIVE {
        return f64::NEG_INFINITY;
    }
    // As a signed number, which converts in one instruction; x is not negative.
    (x.to_bits() as i64 as f64) * (1.0 / (1u64 << 52) as f64) - 1023.0
}

/// Truncation error of a Taylor step, in units of the allowed error, from the accelerations `dv` evaluated afresh at the
/// state that the polynomial has at `s` (usually 1, or where an event ended the step).
///
/// The remainder of v behaves like s^(order+1), so its derivative, which is what the comparison shows, is
/// (order + 1)/(h s) times larger. What rounding explains is subtracted. Above 1 (or not a number) the step must be
/// repeated: [`DefectControl`] says how.
pub fn defect<T: Scalar>(step: &StepPolynomial<T>, s: f64, dv: &[T], tolerance: Tolerance) -> f64 {
    const ROUNDING: f64 = 16.0 * f64::EPSILON;
    let h = step.h.value();
    let share = s / (step.degree + 1) as f64;
    let mut worst = 0.0;
    for (row, dv) in step.v.chunks_exact(step.degree + 1).zip(dv) {
        let expected = derivative_value(row, s, |c| c);
        let error = (h * dv.value() - expected).abs();
        let limit = tolerance.scale(row[0].value().abs() + s * row[1].value().abs());
        let mut ratio = share * error / limit;
        if ratio > 1.0 {
            ratio = share * (error - ROUNDING * derivative_value(row, s, f64::abs)) / limit;
        }
        if ratio.is_nan() {
            return ratio;
        }
        worst = ratio.max(worst);
    }
    worst
}

/// Σ k f(cₖ) sᵏ⁻¹
fn derivative_value<T: Scalar>(row: &[T], s: f64, f: impl Fn(f64) -> f64) -> f64 {
    if s == 1.0 {
        // In four chains, so that no addition waits for the one before.
        let mut k = [1.0, 2.0, 3.0, 4.0];
        let mut sums = [0.0; 4];
        let chunks = row[1..].chunks_exact(4);
        let end = chunks.remainder();
        for four in chunks {
            for ((sum, k), c) in sums.iter_mut().zip(&mut k).zip(four) {
                *sum += *k * f(c.value());
                *k += 4.0;
            }
        }
        for ((sum, k), c) in sums.iter_mut().zip(k).zip(end) {
            *sum += k * f(c.value());
        }
        return (sums[2] + sums[3]) + (sums[0] + sums[1]);
    }
    let mut k = row.len() as f64;
    row[1..].iter().rev().fold(0.0, |sum, c| {
        k -= 1.0;
        sum * s + k * f(c.value())
    })
}

/// What to do after a [`defect`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Verdict {
    /// Go on.
    Accept,
    /// Repeat the step from its start (same coefficients) with this size.
    Redo {
        /// The smaller step.
        h: f64,
    },
}

/// Judges defects, and notices when a smaller step does not help because what remains is rounding.
#[derive(Clone, Debug, Default)]
pub struct DefectControl {
    previous: Option<f64>,
}

impl DefectControl {
    /// Judges a step `h` of `order` with the given [`defect`].
    pub fn judge(&mut self, h: f64, defect: f64, order: usize) -> Verdict {
        // Any smooth error falls by 0.7⁵ < ½ with the step; rounding does not.
        let stagnant = self
            .previous
            .is_some_and(|previous| defect > 0.5 * previous);
        if defect <= 1.0 || (stagnant && defect < 1e3) {
            self.previous = None;
            return Verdict::Accept;
        }
        let factor = if defect.is_finite() {
            self.previous = Some(defect);
            (0.9 * defect.powf(-1.0 / (order + 1) as f64)).clamp(0.1, 0.7)
        } else {
            0.1
        };
        Verdict::Redo { h: h * factor }
    }
}
