//! Order and step size of the Taylor method, and the check that they were right.
//!
//! The step is the one at which the last term is e⁻² of the allowed error (Jorba & Zou, "A software package for the
//! numerical integration of ODEs by means of high-order Taylor methods", Experimental Mathematics 14 (2005), section 3).
//! They take the order ⌈−½ ln ε⌉ + 1, the best one if a step costs nothing but its series. What it costs besides (events, a
//! check) makes more orders and fewer steps cheaper, the more so the fewer products the series have: [`order`].
//!
//! Their step reads the last two coefficients. Those can vanish by symmetry: a pendulum that starts from rest at exactly
//! π/2 has q₂, q₆, q₁₀ … only, and any order divides badly into such gaps. Here the upper half of the coefficients is
//! read, and each predicts the last term by the decay that the others show. Independently of all coefficients,
//! [`defect`] compares the series' acceleration at the end with a fresh evaluation.

use super::polynomial::ORDERS;
use super::{StepPolynomial, Tolerance};
use crate::arithmetic::{Scalar, epsilon};

/// Largest order that [`order`] gives.
pub const MAX_ORDER: usize = 28;
const MIN_ORDER: usize = 4;

/// Order for a tolerance ε and series of so many products, between 4 and [`MAX_ORDER`].
///
/// A step of the order p costs F + C p², and its length is proportional to ε^(1/p). The motion is cheapest where
/// p³ = −½ ln ε (p² + F/C). C grows with the number of products; F/C is fitted to the instructions of the scenes. Series of
/// many products have a large part that is linear in p: for them ⌈3 − 0.6 ln ε⌉ is best, and so it is above 16, where more
/// orders gain little and the coefficients beside a singular point grow out of range.
pub fn order(tolerance: Tolerance, products: usize) -> usize {
    /// F/C of a series without products, times [`BESIDE`].
    const FIXED: f64 = 4500.0;
    /// What every series costs, in products.
    const BESIDE: f64 = 8.0;
    /// More orders than for series of many products are taken up to this one.
    const MOST_BESIDE: f64 = 16.0;
    let digits = -tolerance.strictness().ln();
    let fixed = FIXED / (BESIDE + products as f64);
    // A tolerance of 0 asks for infinitely many orders.
    let dear = |&p: &usize| {
        let p = p as f64;
        let best = p * p * p >= 0.5 * digits * (p * p + fixed) || p >= MOST_BESIDE;
        best && p >= 3.0 + 0.6 * digits
    };
    (MIN_ORDER..MAX_ORDER).find(dear).unwrap_or(MAX_ORDER)
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
    let mut sizes = [[0.0; 4]; (MAX_ORDER + 4) / 4];
    let mut sum = [0.0; 4];
    for i in 0..series.coordinates() {
        for row in [series.position(i), series.velocity(i)] {
            let limit = 1.0 / tolerance.scale(i, row[0].value().abs());
            let (fours, end) = row[first..=order].as_chunks::<4>();
            let (size_fours, size_end) = sizes.split_at_mut(fours.len());
            for (four, c) in size_fours.iter_mut().zip(fours) {
                let ratios = c.map(|c| c.value().abs() * limit);
                sum = core::array::from_fn(|i| sum[i] + ratios[i]);
                *four = core::array::from_fn(|i| larger(ratios[i], four[i]));
            }
            for (size, c) in size_end.as_flattened_mut().iter_mut().zip(end) {
                let ratio = c.value().abs() * limit;
                sum[0] += ratio;
                *size = larger(ratio, *size);
            }
        }
    }
    let sizes = &sizes.as_flattened()[..order + 1 - first];
    let finite = sum.iter().sum::<f64>().is_finite();
    finite.then(|| step_from_sizes(sizes, first, tolerance.strictness()))
}

/// Step from the sizes of the coefficients of the orders `first`, `first` + 1, … in units of the allowed error.
fn step_from_sizes(sizes: &[f64], first: usize, strictness: f64) -> f64 {
    /// How far the decay may be steeper than the root test says (entire functions: log₂ e), as log₂.
    const STEEPER: f64 = 2.0;
    /// Bend of the logarithm that a prediction over several orders may ignore, per order, as log₂.
    const BEND: f64 = 0.6;
    /// log₂ e⁻², the last term.
    const LAST: f64 = -2.0 * core::f64::consts::LOG2_E;

    let count = sizes.len();
    let order = (first + count - 1) as f64;
    let base = -rough_log2(strictness);
    let mut logs = [0.0; MAX_ORDER + 1];
    let logs = &mut logs[..count];
    let (orders, reciprocals) = (&ORDERS[first..][..count], &RECIPROCALS[first..][..count]);
    // Root test: no coefficient lies above 2^(base + root·k).
    let mut root = f64::NEG_INFINITY;
    for ((log, &size), reciprocal) in logs.iter_mut().zip(sizes).zip(reciprocals) {
        *log = rough_log2(size);
        root = larger(root, (*log - base) * reciprocal);
    }
    if root == f64::NEG_INFINITY {
        return f64::INFINITY;
    }
    // Decay between the highest points, seen from that line, of the lower and of the upper half.
    let half = count / 2;
    let highest = |logs: &[f64], orders: &[f64]| {
        let mut highest = (f64::NEG_INFINITY, 0.0);
        for (log, &k) in logs.iter().zip(orders) {
            let above = log - root * k;
            if above > highest.0 {
                highest = (above, k);
            }
        }
        highest
    };
    let (low, j) = highest(&logs[..half], &orders[..half]);
    let (high, k) = highest(&logs[half..], &orders[half..]);
    let slope = (high - low) / (k - j);
    // A half without any coefficient has no highest point.
    let decay = if slope.is_finite() {
        root + slope.max(-STEEPER)
    } else {
        root
    };
    // Each coefficient's prediction of the last one.
    let mut last = f64::NEG_INFINITY;
    for (log, k) in logs.iter().zip(orders) {
        last = larger(last, log + (order - k) * (decay - BEND));
    }
    ((LAST - last) / order).exp2()
}

/// The worse of two errors: the larger one, or that which is not a number.
#[inline(always)]
pub(crate) fn worse(x: f64, y: f64) -> f64 {
    if x >= y || x.is_nan() { x } else { y }
}

/// The larger of two numbers, the second if one is not a number, in one instruction.
#[inline(always)]
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
#[inline(always)]
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
    defect_by(step, s, dv, tolerance, |row, _| {
        derivative_value(row, s, |c| c)
    })
}

/// [`defect`] at the end of the step, given the changes per step Σ k vₖ of all velocities there.
#[inline(never)]
pub(crate) fn defect_at_end<T: Scalar>(
    step: &StepPolynomial<T>,
    slopes: &[f64],
    dv: &[T],
    tolerance: Tolerance,
) -> f64 {
    defect_by(step, 1.0, dv, tolerance, |_, i| slopes[i])
}

#[inline(always)]
fn defect_by<T: Scalar>(
    step: &StepPolynomial<T>,
    s: f64,
    dv: &[T],
    tolerance: Tolerance,
    slope: impl Fn(&[T], usize) -> f64,
) -> f64 {
    let rounding = 16.0 * epsilon::<T>();
    let (h, width) = (step.h.value(), step.degree + 1);
    let share = s / width as f64;
    let mut worst = 0.0;
    for (i, dv) in dv.iter().enumerate() {
        let row = &step.v[i * width..][..width];
        let error = (h * dv.value() - slope(row, i)).abs();
        let limit = tolerance.scale(i, row[0].value().abs() + s * row[1].value().abs());
        let mut ratio = share * error / limit;
        if ratio > 1.0 {
            ratio = share * (error - rounding * derivative_value(row, s, f64::abs)) / limit;
        }
        if ratio.is_nan() {
            return ratio;
        }
        worst = larger(ratio, worst);
    }
    worst
}

/// Σ k f(cₖ) sᵏ⁻¹
fn derivative_value<T: Scalar>(row: &[T], s: f64, f: impl Fn(f64) -> f64) -> f64 {
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

/// By which factor a step may be longer than one that had this [`defect`].
pub fn stretch(defect: f64, order: usize) -> f64 {
    (0.9 * defect.powf(-1.0 / (order + 1) as f64)).min(5.0)
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
            stretch(defect, order).clamp(0.1, 0.7)
        } else {
            0.1
        };
        Verdict::Redo { h: h * factor }
    }
}
