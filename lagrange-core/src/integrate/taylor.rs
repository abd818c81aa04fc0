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

use super::at_places::ORDERS;
use super::{StepPolynomial, Tolerance};
use crate::arithmetic::products::Row;
use crate::arithmetic::quad::{Quad, QuadBody, side_by_side, values};
use crate::arithmetic::{Scalar, epsilon};

/// Largest order that [`order`] gives.
pub const MAX_ORDER: usize = 28;
const MIN_ORDER: usize = 4;

/// What the steps of a motion cost.
#[derive(Clone, Copy, Debug)]
pub struct Costs {
    /// Products of its series, of all coefficients of one order.
    pub products: usize,
    /// Number of coordinates.
    pub coordinates: usize,
    /// Number of constraints.
    pub constraints: usize,
}

/// Order for a tolerance ε, between 4 and [`MAX_ORDER`].
///
/// A step of the order p costs F + C p², and its length is proportional to ε^(1/p). The motion is cheapest where
/// p³ = −½ ln ε (p² + F/C). C grows with the number of products, F with the constraints, onto which each step is projected; F/C is fitted to the
/// instructions of the scenes. Series of many products have a large part that is linear in p: for them ⌈3 − 0.6 ln ε⌉ is best, and so it is
/// above 20, where more orders gain little and the coefficients beside a singular point grow out of range.
pub fn order(tolerance: Tolerance, costs: Costs) -> usize {
    /// F/C of a series without products, times [`BESIDE`].
    const FIXED: f64 = 4500.0;
    /// The same of each constraint, for each unknown of the equations.
    const PROJECTED: f64 = 400.0;
    /// What every series costs, in products.
    const BESIDE: f64 = 8.0;
    /// More orders than for series of many products are taken up to this one.
    const MOST_BESIDE: f64 = 20.0;
    let digits = -tolerance.strictness().ln();
    let Costs {
        products,
        coordinates,
        constraints,
    } = costs;
    let projected = PROJECTED * (constraints * (coordinates + constraints)) as f64;
    let fixed = (FIXED + projected) / (BESIDE + products as f64);
    // A tolerance of 0 asks for infinitely many orders.
    let dear = |&p: &usize| {
        let p = p as f64;
        let best = p * p * p >= 0.5 * digits * (p * p + fixed) || p >= MOST_BESIDE;
        best && p >= 3.0 + 0.6 * digits
    };
    (MIN_ORDER..MAX_ORDER).find(dear).unwrap_or(MAX_ORDER)
}

/// Step size for series used to `order`, at most [`MAX_ORDER`]: every component's truncation error stays below its share of the tolerance
/// (`absolute` + `relative`·|value at the start|, for positions and velocities alike).
///
/// The series, of each position and of each velocity, are in powers of the time, not scaled by h. Infinite if they
/// end (polynomial motion): something else limits that step. `None` if a coefficient that is needed is not finite.
pub fn step_size<T: Scalar>(
    series: [&[Row<T>]; 2],
    order: usize,
    tolerance: Tolerance,
) -> Option<f64> {
    side_by_side::<StepSize, _>((series, order.min(MAX_ORDER), tolerance))
}

/// [`step_size`] for four coefficients at a time.
struct StepSize;

impl<T: Scalar> QuadBody<([&[Row<T>]; 2], usize, Tolerance<'_>)> for StepSize {
    type Output = Option<f64>;

    #[inline(always)]
    fn run<Q: Quad>(
        quad: Q,
        (series, order, tolerance): ([&[Row<T>]; 2], usize, Tolerance),
    ) -> Option<f64> {
        let first = (order / 2).max(3).min(order);
        let count = order + 1 - first;
        let fours = count.div_ceil(4);
        let mut sizes = [[0.0; 4]; QUADS];
        let mut sum = quad.splat(0.0);
        for rows in series {
            for (i, row) in rows.iter().enumerate() {
                let limit = quad.splat(1.0 / tolerance.scale(i, row[0].value().abs()));
                let row = row[first..first + 4 * fours].as_chunks().0;
                for (at, (&four, size)) in row.iter().zip(&mut sizes).enumerate() {
                    let four = quad.first_magnitudes(quad.four(values(four)), count - 4 * at);
                    let ratios = quad.product(four, limit);
                    sum = quad.sum(sum, ratios);
                    *size = quad.numbers(quad.larger(ratios, quad.four(*size)));
                }
            }
        }
        if !quad.total(sum).is_finite() {
            return None;
        }
        let base = -rough_log2(tolerance.strictness());
        Some(step_from_sizes(quad, &sizes, [first, count], base))
    }
}

/// Fours of coefficients in the upper half of those up to [`MAX_ORDER`].
const QUADS: usize = (MAX_ORDER / 2 + 1).div_ceil(4);

/// Step from the sizes of the coefficients of the orders `first`, `first` + 1, …, `count` of them, in units of the allowed error 2^−`base`.
#[inline(always)]
fn step_from_sizes<Q: Quad>(
    quad: Q,
    sizes: &[[f64; 4]; QUADS],
    [first, count]: [usize; 2],
    base: f64,
) -> f64 {
    /// How far the decay may be steeper than the root test says (entire functions: log₂ e), as log₂.
    const STEEPER: f64 = 2.0;
    /// Bend of the logarithm that a prediction over several orders may ignore, per order, as log₂.
    const BEND: f64 = 0.6;
    /// log₂ e⁻², the last term.
    const LAST: f64 = -2.0 * core::f64::consts::LOG2_E;

    let last = first + count - 1;
    let tables = first..first + 4 * count.div_ceil(4);
    let (orders, reciprocals) = (&ORDERS[tables.clone()], &RECIPROCALS[tables]);
    let (orders, reciprocals) = (orders.as_chunks().0, reciprocals.as_chunks().0);
    // Root test: no coefficient lies above 2^(base + root·k).
    let mut logs = [[f64::NEG_INFINITY; 4]; QUADS];
    let mut roots = quad.splat(f64::NEG_INFINITY);
    for ((log, &size), &reciprocal) in logs.iter_mut().zip(sizes).zip(reciprocals) {
        let [a, b, c, d] = size;
        *log = [rough_log2(a), rough_log2(b), rough_log2(c), rough_log2(d)];
        let above = quad.sum(quad.four(*log), quad.splat(-base));
        roots = quad.larger(quad.product(above, quad.four(reciprocal)), roots);
    }
    let root = quad.largest(roots);
    if root == f64::NEG_INFINITY {
        return f64::INFINITY;
    }
    // Decay between the highest points, seen from that line, of the lower and of the upper half.
    let flat = logs.as_flattened();
    let half = count / 2;
    let (low, j) = highest(&flat[..half], first, root);
    let (high, k) = highest(&flat[half..count], first + half, root);
    let slope = (high - low) / (k - j);
    // A half without any coefficient has no highest point.
    let decay = if slope.is_finite() {
        root + slope.max(-STEEPER)
    } else {
        root
    };
    // Each coefficient's prediction of the last one.
    let fall = quad.splat(BEND - decay);
    let mut sizes = quad.splat(f64::NEG_INFINITY);
    for (&log, &k) in logs.iter().zip(orders) {
        let ahead = quad.sum(quad.four(k), quad.splat(-(last as f64)));
        let size = quad.sum(quad.four(log), quad.product(ahead, fall));
        sizes = quad.larger(size, sizes);
    }
    ((LAST - quad.largest(sizes)) / last as f64).exp2()
}

/// The highest of these logarithms, which belong to the orders from `first` on, above a line through the origin with the slope `root`, and
/// its order.
#[inline(always)]
fn highest(logs: &[f64], first: usize, root: f64) -> (f64, f64) {
    let (mut highest, mut at) = (f64::NEG_INFINITY, 0.0);
    let mut k = first as f64;
    let mut i = 0;
    while i < logs.len() {
        let above = logs[i] - root * k;
        at = if above > highest { k } else { at };
        highest = larger(above, highest);
        k += 1.0;
        i += 1;
    }
    (highest, at)
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
const RECIPROCALS: [f64; 64] = {
    let mut table = [0.0; 64];
    let mut k = 1;
    while k < 64 {
        table[k] = 1.0 / k as f64;
        k += 1;
    }
    table
};

/// log₂ x to within 0.1, monotone: the exponent and mantissa bits read as one number. −∞ for 0 and subnormals.
#[inline(always)]
fn rough_log2(x: f64) -> f64 {
    /// 2⁵², whose mantissa takes up the leading bits of x, and what that number is off by then.
    const WHOLE: u64 = 0x4330 << 48;
    const OFFSET: f64 = 1023.0 + 4096.0;
    // x is not negative.
    let whole = f64::from_bits(x.to_bits() >> 12 | WHOLE);
    let log = whole * (1.0 / (1u64 << 40) as f64) - OFFSET;
    if x < f64::MIN_POSITIVE {
        f64::NEG_INFINITY
    } else {
        log
    }
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

/// Whether accelerations `dv` at `s` differ from those of the polynomial by more than this part of its terms.
pub fn differs<T: Scalar>(step: &StepPolynomial<T>, s: f64, dv: &[T], part: f64) -> bool {
    let (h, width) = (step.h.value(), step.degree + 1);
    dv.iter().enumerate().any(|(i, dv)| {
        let row = &step.v[i * width..][..width];
        let error = (h * dv.value() - derivative_value(row, s, |c| c)).abs();
        error > part * derivative_value(row, s, f64::abs)
    })
}

/// Σ k f(cₖ) sᵏ⁻¹
fn derivative_value<T: Scalar>(row: &[T], s: f64, f: impl Fn(f64) -> f64) -> f64 {
    let terms = row[1..].iter().zip(&ORDERS[1..row.len()]);
    terms
        .rev()
        .fold(0.0, |sum, (c, k)| sum * s + k * f(c.value()))
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
    /// Judges a step `h` of `order` with the given [`defect`]; `jumps` if rounding cannot be what makes it.
    pub fn judge(&mut self, h: f64, defect: f64, order: usize, jumps: bool) -> Verdict {
        // Any smooth error falls by 0.7⁵ < ½ with the step; rounding does not.
        let stagnant = self
            .previous
            .is_some_and(|previous| defect > 0.5 * previous);
        if defect <= 1.0 || (stagnant && defect < 1e3 && !jumps) {
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
