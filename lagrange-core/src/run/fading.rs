//! Slips whose friction fades with them: they decay as by viscous friction, and do not come to rest.
//!
//! With μₛ = 0 and a μₖ that vanishes with the slip, nothing holds at rest. A slip of one component that has decayed to the size
//! of errors passes zero by them, again and again: that is no reversal. It keeps its direction, and its guard is the slip plus a
//! margin from then on, until the slip is clear of zero again; |s| in the law goes on as ±s, which is analytic there. A slip of
//! two components has no guard, and is not looked at for its rest ([`super::rest`]).

use super::Run;
use super::hits::value;
use crate::arithmetic::Scalar;
use crate::integrate::{Method, polynomial_derivative as slope};
use crate::modes::guard::{self, Guard};

/// A slip that passes zero more slowly per step than so many tolerances, or is smaller at both ends of the step, passes by its
/// error.
const MARGIN: f64 = 100.0;
/// Error of a slip that has decayed to rounding, of the size of the velocities that make it.
const ROUNDING: f64 = 1e-12;
/// Two guards are multiples of each other to this share.
const SAME: f64 = 1e-6;

impl<T: Scalar> Run<T> {
    /// Takes out of the guards that have fallen at part `end` of the step the slips that have only decayed, with the branches that
    /// turn with them.
    pub(super) fn tell_reversal_from_decay(&mut self, end: f64) {
        for f in 0..self.now.mode.frictions.len() {
            let falls = Guard::Slip(f);
            let Some(slip) = self.locator.polynomials.of(falls) else {
                continue;
            };
            // Fixed steps do not grow until they are bounded by stability: their slips decay to rounding.
            let margin = match self.settings.method {
                Method::RungeKutta4 { .. } | Method::Gauss6 { .. } => MARGIN * ROUNDING,
                _ => MARGIN * self.settings.tolerance,
            };
            let small = |s: f64| value(slip, s).abs() <= margin;
            let passes_by_error = slope(slip, end).abs() <= margin || small(0.0) && small(1.0);
            if !passes_by_error
                || self.locator.polynomials.is_lowered(falls)
                || !guard::fades(f, &self.dynamics)
            {
                continue;
            }
            let turns = |(guard, curve): (Guard, &[f64])| match guard {
                Guard::Slip(g) if g == f => Some((guard, margin)),
                Guard::Branch(_) => multiple(curve, slip).map(|times| (guard, times * margin)),
                _ => None,
            };
            let together: Vec<_> = self
                .locator
                .polynomials
                .of_mode()
                .filter_map(turns)
                .collect();
            if together
                .iter()
                .any(|(guard, _)| self.locator.fallen.contains(guard))
            {
                self.locator
                    .fallen
                    .retain(|guard| together.iter().all(|(other, _)| other != guard));
                for (guard, margin) in together {
                    self.locator.polynomials.lower(guard, margin);
                }
            }
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
