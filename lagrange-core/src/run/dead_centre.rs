//! Frictions whose slip is zero at an instant however fast the motion is: the slider of a crank in its dead centre.
//!
//! Nothing holds a crank there by rubbing on its slider. The cosine of π/2 is 6e-17 in numbers, and a friction that stuck would have
//! to be as many times larger than what it holds.

use super::Run;
use crate::arithmetic::Scalar;
use crate::mode::FrictionMode;
use crate::modes::guard;
use crate::modes::reading::Reading;

/// Positions are known to so many units of rounding.
const ROUNDING: f64 = 8.0;
/// A row is rounding if it becomes so many times larger by that of the positions.
const GROWS: f64 = 2.0;

impl<T: Scalar> Run<T> {
    /// Lets go of the frictions that stick at the start, are beyond their limit and act by rounding alone.
    pub(super) fn release_dead_centres(&mut self) {
        for f in 0..self.description().frictions.len() {
            let sticks = self.now.mode.frictions[f] == FrictionMode::Stick;
            if !sticks || !self.is_beyond_its_limit(f) {
                continue;
            }
            if self.acts_by_rounding(f) {
                self.now.mode.frictions[f] = FrictionMode::Inactive;
            }
            self.now.outdate();
            self.dynamics.set_mode(&self.now.mode);
            self.ask_for_guards();
        }
    }

    /// Whether friction `f`, which sticks, would have to be larger than it can be.
    fn is_beyond_its_limit(&mut self, f: usize) -> bool {
        if !self.now.valued && self.evaluate().is_err() {
            return false;
        }
        let reading = Reading::Values(&self.dynamics);
        let mut guards = guard::stick_guards(f, &self.description().frictions[f]);
        guards.any(|guard| guard::value(guard, &self.now.mode, &reading) < 0.0)
    }

    /// Whether the Jacobian of the slip of friction `f` is no larger than what the rounding of the positions makes of it.
    pub(super) fn acts_by_rounding(&mut self, f: usize) -> bool {
        let [less, here, more] =
            [-ROUNDING, 0.0, ROUNDING].map(|units| self.jacobian_beside(f, units));
        less.max(more) > GROWS * here
    }

    /// Size of the Jacobian of the slip of friction `f` so many units of rounding beside the present state. No two positions are off by the same,
    /// so that differences of them are off as well.
    fn jacobian_beside(&mut self, f: usize, units: f64) -> f64 {
        let d = self.description();
        let sizes = self.now.state.q.iter().map(|q| q.value().abs());
        let rounding = units * f64::EPSILON * sizes.fold(1.0, f64::max);
        let moved = |j: usize, _| T::from_f64(rounding * (1.0 + j as f64).sqrt());
        self.beside(None, T::zero(), moved, |run| {
            let rows = &d.rows[d.frictions[f].rows()];
            let elements = rows.iter().flat_map(|row| row.jacobian);
            let sizes = elements.map(|&(_, place)| run.dynamics.motion(place).value().abs());
            sizes.sum()
        })
    }
}
