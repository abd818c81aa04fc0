//! What a step may get wrong, and how long the next one is.
//!
//! A component y may be wrong by `absolute` + `relative`·|y| in one step; errors are measured in that unit, so 1 is the
//! limit. Step sizes follow the proportional–integral controller of Hairer, Nørsett & Wanner (1993), section II.4, and
//! Hairer & Wanner (1996), section IV.2, in Gustafsson's and Söderlind's spirit.

use crate::arithmetic::Scalar;

/// Error that is allowed per step and component, as ODEPACK's `RTOL` and `ATOL(i)` (Hindmarsh 1983).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance<'a> {
    /// In units of the component.
    pub relative: f64,
    /// In the component's own unit.
    pub absolute: f64,
    /// Per coordinate, by what `absolute` is multiplied for its position and its velocity; empty: by 1.
    pub sizes: &'a [f64],
}

/// The length of a fixed step, of at most `h_max`: one that is longer by rounding only is the last of a run, and taken whole.
pub(super) fn fixed_length(step: f64, h_max: f64) -> f64 {
    const ROUNDING: f64 = 1e-6;
    match h_max <= step * (1.0 + ROUNDING) {
        true => h_max,
        false => step,
    }
}

impl Tolerance<'_> {
    /// The same number for both: an error of `tolerance` where components are of size 1 or less.
    pub const fn both(tolerance: f64) -> Self {
        Self {
            relative: tolerance,
            absolute: tolerance,
            sizes: &[],
        }
    }

    /// The larger of both: the digits that are asked for.
    pub fn strictness(self) -> f64 {
        self.relative.max(self.absolute)
    }

    /// Error allowed for the position or the velocity of a coordinate where that has the size `size` ≥ 0; never zero.
    pub fn scale(self, coordinate: usize, size: f64) -> f64 {
        let least = least_size(self.sizes, coordinate);
        (self.absolute * least + self.relative * size).max(f64::MIN_POSITIVE)
    }
}

/// A first step where nothing moves that could tell its length, s: short, but late times are rounded to no shorter ones.
pub(super) fn least_first_step(time: f64) -> f64 {
    const SHORT: f64 = 1e-6;
    const UNITS: f64 = 1e4;
    SHORT.max(UNITS * f64::EPSILON * time.abs())
}

/// The size above which errors of a coordinate are relative.
pub(crate) fn least_size(sizes: &[f64], coordinate: usize) -> f64 {
    sizes.get(coordinate).copied().unwrap_or(1.0)
}

/// √(1/n Σ (eᵢ/scaleᵢ)²), the scale taken at the larger of |before| and |after|. The components are those of the coordinates, once or
/// several times one after the other.
pub fn error_norm<T: Scalar>(error: &[T], before: &[T], after: &[T], tolerance: Tolerance) -> f64 {
    let states = before.iter().zip(after);
    let mut coordinates = (0..tolerance.sizes.len()).cycle();
    let sum: f64 = error
        .iter()
        .zip(states)
        .map(|(e, (y0, y1))| {
            let size = y0.value().abs().max(y1.value().abs());
            let ratio = e.value() / tolerance.scale(coordinates.next().unwrap_or(0), size);
            ratio * ratio
        })
        .sum();
    (sum / error.len().max(1) as f64).sqrt()
}

/// Constants of a step controller.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Control {
    /// The error estimate shrinks like h to this power.
    pub order: usize,
    /// Weight of the previous error: h grows by err^(−1/order + ¾β) · previous^β. 0: proportional only.
    pub beta: f64,
    /// Aim this much below the limit in step size.
    pub safety: f64,
    /// Strongest reduction.
    pub shrink: f64,
    /// Strongest growth.
    pub grow: f64,
}

/// A step controller and its memory.
#[derive(Clone, Debug)]
pub struct Controller {
    control: Control,
    previous: f64,
    rejected: bool,
}

impl Controller {
    /// What an error counts as that was far below the limit: one lucky step does not blow up the next.
    const FLOOR: f64 = 1e-4;

    /// A controller without memory.
    pub fn new(control: Control) -> Self {
        Self {
            control,
            previous: Self::FLOOR,
            rejected: false,
        }
    }

    /// Forgets earlier steps: the solution is another one from here on.
    pub fn restart(&mut self) {
        self.previous = Self::FLOOR;
        self.rejected = false;
    }

    /// Step size after a step `h` with an error of `error` limits: `Ok` if accepted, `Err` to try again.
    ///
    /// # Errors
    /// The smaller step to try, if the error is above 1 or not a number.
    pub fn judge(&mut self, h: f64, error: f64) -> Result<f64, f64> {
        let Control {
            order,
            beta,
            safety,
            shrink,
            grow,
        } = self.control;
        let exponent = 1.0 / order as f64;
        if error.is_nan() || error == f64::INFINITY {
            self.rejected = true;
            return Err(h * shrink);
        }
        if error > 1.0 {
            self.rejected = true;
            return Err(h * (safety * error.powf(-exponent)).clamp(shrink, 0.9));
        }
        let factor =
            safety * error.max(1e-300).powf(0.75 * beta - exponent) * self.previous.powf(beta);
        // Growing right after a rejection would only be rejected again.
        let limit = if self.rejected { 1.0 } else { grow };
        self.rejected = false;
        self.previous = error.max(Self::FLOOR);
        Ok(h * factor.clamp(shrink, limit))
    }
}
