//! How far the polynomials of the guards are off in a step, and how far they may be.

use super::GuardPolynomials;
use crate::arithmetic::{self, Scalar, epsilon};
use crate::dynamics::Dynamics;
use crate::integrate::polynomial_value as at;
use crate::integrate::taylor::worse;
use crate::mode::Mode;
use crate::modes::guard::Guard;
use crate::run::touching::UNITS_OF_TIME;

/// A guard on the other side of zero than its polynomial is off by more than rounding explains: this much more is counted.
const OTHER_SIDE: f64 = 1e3;

/// What presses a friction may be off by what changes velocities in the step by this share of what they may be off by: where nothing presses it, as the rounding of
/// 1 − tanh², it has no other size.
const IDLE: f64 = 1e-3;

/// A guard that changes by no more than this share of its value hardly changes.
const STEADY: f64 = 1e-2;

/// So much a guard of size 1 is off by rounding; see [`GuardPolynomials::rounding`].
pub(super) const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// How far the polynomial of a guard is off at a part of the step.
struct GuardError {
    error: f64,
    /// What is allowed but for rounding.
    allowed: f64,
    rounding: f64,
    /// Whether the guard is on the other side of zero.
    other_side: bool,
}

impl GuardPolynomials {
    /// Whether all polynomials are clearly good enough at part `s` of the step, where `dynamics` holds the values: on the side of zero on which the guards
    /// are, and off by no more than what is allowed for certain, also of guards that may be `located` there. Most steps satisfy that; if not,
    /// [`Self::defect`] tells.
    #[inline(never)]
    pub(in crate::run) fn fit<T: Scalar>(
        &self,
        dynamics: &mut Dynamics<T>,
        mode: &Mode,
        s: f64,
        tolerance: f64,
        located: bool,
    ) -> bool {
        if !self.watches.is_empty() {
            dynamics.report_value();
        }
        self.compared(dynamics, mode, s)
            .all(|(guard, c, [found, value])| {
                let allowed = allowance::<T>(guard, tolerance, located) * size(value, c);
                let off = (found - value).abs();
                off <= allowed && allowed.is_finite() && (found < 0.0) == (value < 0.0)
            })
    }

    /// How far the polynomials are off at part `s` of the step, in units of what is `allowed` by the tolerance and, of forces, by their blur, and of what
    /// `rounding` of the state makes of each, if that is known; `dynamics` holds the values of the state there, `known` tells of a guard whether this is its
    /// root, and how large what makes it is at least.
    ///
    /// The step is chosen for the coordinates, but a guard is a function of them whose series may converge no further than
    /// a part of it: in free flight the coordinates are polynomials, the distance √(x² + y²) is not. Where the flight passes
    /// through 0 even a series that has ended, and looks exact, goes on along the wrong branch.
    #[inline(never)]
    pub(in crate::run) fn defect<T: Scalar>(
        &self,
        dynamics: &mut Dynamics<T>,
        mode: &Mode,
        s: f64,
        allowed: [f64; 2],
        rounding: &[f64],
        known: impl Fn(Guard) -> (bool, f64),
    ) -> f64 {
        let ratio = |off: GuardError| {
            let ratio = off.error / (off.allowed + off.rounding);
            match off.other_side && off.error > off.rounding {
                true => ratio * OTHER_SIDE,
                false => ratio,
            }
        };
        let errors = self.errors(dynamics, mode, s, allowed, rounding, known);
        errors.map(ratio).fold(0.0, worse)
    }

    /// The same without what rounding explains: a guard that is a small difference of large numbers is off by as much however short
    /// the step.
    pub(in crate::run) fn truncation<T: Scalar>(
        &self,
        dynamics: &mut Dynamics<T>,
        mode: &Mode,
        s: f64,
        tolerance: f64,
        rounding: &[f64],
        known: impl Fn(Guard) -> (bool, f64),
    ) -> f64 {
        let errors = self.errors(dynamics, mode, s, [tolerance, 0.0], rounding, known);
        let ratios = errors.map(|off| (off.error - off.rounding) / off.allowed);
        ratios.fold(0.0, f64::max)
    }

    /// Makes stops and marks constant whose polynomials are off at part `s` of the step, if they hardly change up to there and no other guard is off. Whether
    /// that is so.
    #[cold]
    pub(in crate::run) fn holds_watches<T: Scalar>(
        &mut self,
        dynamics: &mut Dynamics<T>,
        mode: &Mode,
        s: f64,
        tolerance: f64,
    ) -> bool {
        let errors = self.errors(dynamics, mode, s, [tolerance, 0.0], &[], |_| (false, 0.0));
        let is_off =
            |off: GuardError| !(off.error.is_finite() && off.error <= off.allowed + off.rounding);
        let off: Vec<usize> = errors
            .enumerate()
            .filter_map(|(k, off)| is_off(off).then_some(k))
            .collect();
        let is_steady = |&index: &usize| {
            let now = self.value(index, mode, dynamics);
            let [before, rate, ..] = *self.curve(index) else {
                return false;
            };
            let little = STEADY * before.abs();
            let watches = matches!(self.list[index].guard, Guard::Stop(..) | Guard::Mark(..));
            // Where there is no series there is no rate.
            watches && (now - before).abs() <= little && !(rate.is_finite() && rate.abs() > little)
        };
        let steady = off.iter().all(is_steady);
        if steady {
            for index in off {
                self.coefficients[index * self.width..][..self.width][1..].fill(0.0);
            }
        }
        steady
    }

    /// The values of all guards at the last value of `dynamics`.
    pub(in crate::run) fn values<T: Scalar>(
        &self,
        mode: &Mode,
        dynamics: &mut Dynamics<T>,
    ) -> Vec<f64> {
        if !self.watches.is_empty() {
            dynamics.report_value();
        }
        let guards = 0..self.list.len();
        guards
            .map(|index| self.value(index, mode, dynamics))
            .collect()
    }

    /// The errors of all polynomials at part `s` of the step.
    #[inline(always)]
    fn errors<T: Scalar>(
        &self,
        dynamics: &mut Dynamics<T>,
        mode: &Mode,
        s: f64,
        [tolerance, blur]: [f64; 2],
        rounding: &[f64],
        known: impl Fn(Guard) -> (bool, f64),
    ) -> impl Iterator<Item = GuardError> {
        if !self.watches.is_empty() {
            dynamics.report_value();
        }
        let dynamics = &*dynamics;
        let compared = self.compared(dynamics, mode, s);
        compared
            .enumerate()
            .map(move |(index, (guard, c, [found, value]))| {
                let (located, least) = known(guard);
                let blur = if guard.is_force() { blur } else { 0.0 };
                let allowed = allowance::<T>(guard, tolerance, located).max(blur);
                let error = (found - value).abs();
                let rounding = rounding.get(index).copied().unwrap_or(0.0);
                GuardError {
                    error,
                    allowed: allowed * size(value, c).max(least),
                    rounding: self
                        .rounding(error, guard, dynamics)
                        .max(rounding)
                        .max(self.change_in_no_time(guard, c, value, dynamics))
                        .max(self.idle_force(guard, tolerance)),
                    other_side: !located && (found < 0.0) != (value < 0.0),
                }
            })
    }

    /// All guards with their polynomials: what these say at part `s` of the step, and the value there.
    #[inline(always)]
    fn compared<T: Scalar>(
        &self,
        dynamics: &Dynamics<T>,
        mode: &Mode,
        s: f64,
    ) -> impl Iterator<Item = (Guard, &[f64], [f64; 2])> {
        let curves = self.list.iter();
        let curves = curves.zip(self.coefficients.chunks_exact(self.width));
        curves.enumerate().map(move |(index, (curve, c))| {
            let found = if s == 1.0 { curve.sums.end } else { at(c, s) };
            (curve.guard, c, [found, self.value(index, mode, dynamics)])
        })
    }

    /// By how much what presses a friction may be off and yet not be felt.
    #[inline]
    fn idle_force(&self, guard: Guard, tolerance: f64) -> f64 {
        match guard {
            Guard::NormalForceSign(_) => IDLE * tolerance * self.momentum / self.length,
            _ => 0.0,
        }
    }

    /// What a stop or mark with this curve and value changes by within the time that rounding resolves, as long as it keeps its sign: close to a pole, 1/x,
    /// that is more than what is allowed.
    #[inline]
    fn change_in_no_time<T: Scalar>(
        &self,
        guard: Guard,
        curve: &[f64],
        value: f64,
        dynamics: &Dynamics<T>,
    ) -> f64 {
        let watched = matches!(guard, Guard::Stop(..) | Guard::Mark(..));
        if !watched || (curve[0] < 0.0) != (value < 0.0) {
            return 0.0;
        }
        let time = dynamics.time_and_state()[0].value();
        UNITS_OF_TIME * epsilon::<T>() * time.abs() / self.length * curve[1].abs()
    }

    /// What rounding makes of a guard at the last value of `dynamics`, to be told from an `error`. Gaps and slips are differences of positions and of
    /// velocities, which may be large: those of two satellites on a rope, from the centre of the Earth. What is watched, and where branches change, may be
    /// made of all of them. A force is off by rounding of all forces, a cone of their squares: those on a grain of dust are no more than 1e-12 N.
    #[inline]
    pub(in crate::run) fn rounding<T: Scalar>(
        &self,
        error: f64,
        guard: Guard,
        dynamics: &Dynamics<T>,
    ) -> f64 {
        let least = arithmetic::rounding::<T>(ROUNDING);
        if error <= least && !guard.is_single_force() {
            return least;
        }
        let state = dynamics.time_and_state();
        let n = state.len() / 2;
        let (terms, extent) = match guard {
            Guard::Gap(c) => (&state[1..=n], self.extents[c]),
            Guard::Slip(_) => (&state[1 + n..], 1.0),
            Guard::Region(_) => (&state[1..=n], 1.0),
            Guard::Stop(..) | Guard::Mark(..) | Guard::Branch(_) => (state, 1.0),
            Guard::StickCone(_) => {
                let force = self.largest_force(dynamics);
                return (least * force * force).max(f64::MIN_POSITIVE);
            }
            force if force.is_single_force() => {
                return (least * self.largest_force(dynamics)).max(f64::MIN_POSITIVE);
            }
            _ => return least,
        };
        let larger = |size: f64, x: &T| size.max(x.value().abs());
        least * terms.iter().fold(extent, larger)
    }

    /// The largest of the forces of all rows at the last value of `dynamics` and of those that the forces of the mode were made of as it began; no more than 1: of
    /// larger ones polynomials are as exact as they can be, and roots are sharpened by it.
    fn largest_force<T: Scalar>(&self, dynamics: &Dynamics<T>) -> f64 {
        let rows = 0..dynamics.description().rows.len();
        let forces = rows.map(|row| dynamics.force(row).value().abs());
        forces.fold(self.forces, f64::max).min(1.0)
    }
}

/// The size of a guard with this value and these coefficients. Not all of them: where the series has stopped converging they are large and cancel.
#[inline]
pub(super) fn size(value: f64, c: &[f64]) -> f64 {
    value.abs() + (c[0].abs() + c[1].abs())
}

/// Error that a guard of size 1 may have at the end of a step.
///
/// Forces are second derivatives, and the worse for it. Where a guard has been located it has to be exact, else it only must not
/// be missed.
#[inline]
pub(super) fn allowance<T: Scalar>(guard: Guard, tolerance: f64, located: bool) -> f64 {
    let (share, floor) = match (guard.is_force(), located) {
        (true, true) => (10.0, 1e-12),
        (true, false) => (1e4, 1e-10),
        (false, true) => (0.1, 1e-14),
        (false, false) => (10.0, 1e-13),
    };
    (share * tolerance).max(arithmetic::rounding::<T>(floor))
}
