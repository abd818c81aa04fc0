//! Slips that decay as by viscous friction, and do not come to rest.
//!
//! With μₛ = 0 and a μₖ that vanishes with the slip, nothing holds at rest. And what a spring and a dashpot move against a friction that
//! could hold it creeps to the edge of its dead band: there the friction is exactly at its limit. A slip of one component that has
//! decayed to the size of errors passes zero by them, again and again: that is no reversal, and no rest. It keeps its direction, and its
//! guard is the slip plus a margin from then on, until the slip is clear of zero again; |s| in the law goes on as ±s, which is analytic
//! there. A slip of two components has no guard, and is not looked at for its rest ([`super::rest`]).

use super::Run;
use super::guard_polynomials::GuardPolynomials;
use super::touching::ROUNDING as UNITS;
use crate::arithmetic::{Scalar, rounding};
use crate::error::Error;
use crate::integrate::polynomial_value as value;
use crate::integrate::{Method, polynomial_derivative as slope};
use crate::mode::{Direction, FrictionMode};
use crate::modes::guard::{self, Guard};

/// A slip that passes zero more slowly per step than so many errors, or is smaller at both ends of the step, passes by its error.
const MARGIN: f64 = 10.0;
/// Error of a slip that has decayed to rounding, of the size of the velocities that make it.
const ROUNDING: f64 = 1e-12;
/// A friction that is so many errors from its limit, relative, is at it.
const AT_LIMIT: f64 = 1e3;
/// A friction as far from its limit as this, relative, is not at it, whatever its errors are.
const OFF_LIMIT: f64 = 1e-2;
/// A slip turns before zero where it is more than half of its slope squared over its bend, as (1 − t)² is just so. Errors of this share of that make it seem to
/// pass.
const TURNS: f64 = 0.05;
/// Two guards are multiples of each other to this share.
const SAME: f64 = 1e-6;

impl<T: Scalar> Run<T> {
    /// Takes out of the guards that have fallen at part `end` of the step the slips of frictions that cannot hold, where they have only
    /// decayed, with the branches that turn with them.
    pub(super) fn tell_reversal_from_decay(&mut self, end: f64) {
        for f in 0..self.now.mode.frictions.len() {
            if self.passes_by_error(f, end) && guard::fades(f, &self.dynamics) {
                self.let_pass(f);
            }
        }
    }

    /// Whether nothing has fallen at part `end` of the step, where the motion is now, but slips of frictions that could hold and are at
    /// their limit, by their errors: these go on.
    ///
    /// # Errors
    /// The end of the step cannot be evaluated.
    pub(super) fn only_creeps(&mut self, end: f64) -> Result<bool, Error> {
        let frictions = 0..self.now.mode.frictions.len();
        // What begins to fall from zero, as t² does, is clear of it at the end of the step.
        let passes = |run: &Self, f: usize| run.passes_by_error(f, end) && run.is_small(f, 1.0);
        let creeps = |&guard: &Guard| {
            let mut frictions = frictions.clone();
            frictions.any(|f| self.turns_with(f, guard) && passes(self, f))
        };
        if !self.locator.rests.is_empty() || !self.locator.fallen.iter().all(creeps) {
            return Ok(false);
        }
        for f in frictions.clone() {
            if passes(self, f) && !self.is_at_its_limit(f, end)? {
                return Ok(false);
            }
        }
        for f in frictions {
            if passes(self, f) {
                self.let_pass(f);
            }
        }
        Ok(true)
    }

    /// Whether nothing has fallen at part `end` of the step, where the motion is now, but slips that turn before zero once what the step has left of the rates of
    /// rows is taken away: a follower that comes to rest on its cam as smoothly as (1 − t)² seems to turn back before. These go on.
    pub(super) fn only_residuals_fall(&mut self, end: f64) -> bool {
        let polynomials = &self.locator.polynomials;
        let slips = |&guard: &Guard| {
            matches!(guard, Guard::Slip(f) if !self.turns(f)) && !polynomials.is_lowered(guard)
        };
        let located = self.locator.rests.is_empty() && self.locator.fallen.iter().all(slips);
        if !located || self.dynamics.acting_rows().is_empty() {
            return false;
        }
        // How a slip of this size goes on from the root: whether it turns before it would be zero.
        let turns = |polynomials: &GuardPolynomials, guard: Guard, slip: f64| {
            let curve = polynomials.of(guard).unwrap_or_default();
            let slope = slope(curve, end);
            slip * bend(curve, end) > TURNS * slope * slope
        };
        let mut fallen = self.locator.fallen.iter();
        if !fallen.all(|&guard| turns(polynomials, guard, self.margin())) {
            return false;
        }
        self.hold_velocities();
        self.tape_of_all_rows();
        let (polynomials, mode) = (&self.locator.polynomials, &self.now.mode);
        let drives = |&guard: &Guard| {
            let Guard::Slip(f) = guard else { return false };
            let FrictionMode::Slip(sliding) = mode.frictions[f] else {
                return false;
            };
            let Direction::Fixed([sign, _]) = sliding.direction else {
                return false;
            };
            let mut slips = self.rates_of_slip(f);
            slips.all(|(slip, size)| {
                let least = rounding::<T>(UNITS) * size;
                let slip = sign * slip;
                slip > -least && turns(polynomials, guard, slip.max(least))
            })
        };
        if !self.locator.fallen.iter().all(drives) {
            let before = &self.switcher.before_holding.v;
            self.now.state.v.copy_from_slice(before);
            return false;
        }
        for f in 0..self.now.mode.frictions.len() {
            if self.locator.fallen.contains(&Guard::Slip(f)) {
                self.let_pass(f);
            }
        }
        self.now.outdate();
        self.ask_for_guards();
        true
    }

    /// Error of velocities. Fixed steps do not grow until they are bounded by stability: their slips decay to rounding.
    fn error_of_velocities(&self) -> f64 {
        match self.settings.method {
            Method::RungeKutta4 { .. } | Method::Gauss6 { .. } => ROUNDING,
            _ => self.settings.tolerance,
        }
    }

    /// How far a slip passes zero by its error.
    fn margin(&self) -> f64 {
        MARGIN * self.error_of_velocities()
    }

    /// Whether the slip of friction `f`, or a branch that turns with it, falls through zero at part `end` of the step by its error.
    fn passes_by_error(&self, f: usize, end: f64) -> bool {
        let polynomials = &self.locator.polynomials;
        let Some(slip) = polynomials.of(Guard::Slip(f)) else {
            return false;
        };
        let mut fallen = self.locator.fallen.iter();
        fallen.any(|&guard| self.turns_with(f, guard))
            && (slope(slip, end).abs() <= self.margin()
                || self.is_small(f, 0.0) && self.is_small(f, 1.0))
            && !polynomials.is_lowered(Guard::Slip(f))
    }

    /// Whether the slip of friction `f` is of the size of its errors at part `s` of the step.
    fn is_small(&self, f: usize, s: f64) -> bool {
        let slip = self.locator.polynomials.of(Guard::Slip(f));
        slip.is_some_and(|slip| value(slip, s).abs() <= self.margin())
    }

    /// Whether a guard belongs to the slip of friction `f`, or to a branch that turns with it.
    fn turns_with(&self, f: usize, guard: Guard) -> bool {
        let polynomial = |guard| self.locator.polynomials.of(guard);
        let slip = Guard::Slip(f);
        let Guard::Branch(_) = guard else {
            return guard == slip;
        };
        let curves = polynomial(guard).zip(polynomial(slip));
        curves.is_some_and(|(curve, slip)| multiple(curve, slip).is_some())
    }

    /// Whether the slip of friction `f`, which is zero at part `end` of the step, where the motion is now, does not change beside what
    /// the forces along it would do: the friction that would hold it is at its limit.
    fn is_at_its_limit(&mut self, f: usize, end: f64) -> Result<bool, Error> {
        if !self.now.valued {
            self.evaluate()?;
        }
        let falls = Guard::Slip(f);
        let slip = self.locator.polynomials.of(falls).unwrap_or_default();
        let change = slope(slip, end) / self.stepper.step.h.value();
        let (mode, decider) = (&self.now.mode, &mut self.switcher.decider);
        let (_, size) = decider.force(&mut self.dynamics, mode, falls);
        let near = (AT_LIMIT * self.error_of_velocities()).min(OFF_LIMIT);
        Ok(change.abs() <= near * size)
    }

    /// Takes the slip of friction `f` out of the fallen guards, with the branches that turn with it, and gives them their margin.
    fn let_pass(&mut self, f: usize) {
        let margin = self.margin();
        let polynomials = &self.locator.polynomials;
        let slip = polynomials.of(Guard::Slip(f)).unwrap_or_default();
        let turns = |(guard, curve): (Guard, &[f64])| match guard {
            Guard::Slip(g) if g == f => Some((guard, margin)),
            Guard::Branch(_) => multiple(curve, slip).map(|times| (guard, times * margin)),
            _ => None,
        };
        let together: Vec<_> = polynomials.of_mode().filter_map(turns).collect();
        for (guard, margin) in together {
            self.locator.fallen.retain(|&fallen| fallen != guard);
            self.locator.polynomials.lower(guard, margin);
        }
    }
}

/// By which positive number one curve is a multiple of another, if it is.
fn multiple(curve: &[f64], of: &[f64]) -> Option<f64> {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    let times = dot(curve, of) / dot(of, of);
    let off = |(x, y): (&f64, &f64)| (x - times * y).abs();
    let size = curve.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
    let same = curve.iter().zip(of).map(off).all(|off| off <= SAME * size);
    (same && times > 0.0).then_some(times)
}

/// Σ k (k − 1) cₖ sᵏ⁻²
fn bend(curve: &[f64], s: f64) -> f64 {
    let terms = curve.iter().enumerate().skip(2).rev();
    terms.fold(0.0, |sum, (k, c)| sum * s + (k * (k - 1)) as f64 * c)
}
