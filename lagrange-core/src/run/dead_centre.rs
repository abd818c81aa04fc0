//! Frictions whose slip vanishes at the start however the motion begins: a slider at its dead centre is at rest for an instant, and no
//! friction there holds what moves it.
//!
//! Rounding leaves some 1e-17 of the slip's Jacobian (the cosine of π/2), and a friction that stuck would seem to be as many times
//! larger than what it is to hold.

use super::{Progress, Run};
use crate::arithmetic::Scalar;
use crate::integrate::{Tolerance, taylor};
use crate::mode::FrictionMode;
use crate::modes::guard;
use crate::modes::reading::Reading;

/// What is this small beside what it becomes within a step begins with zero.
const ROUNDING: f64 = 1e-13;

impl<T: Scalar> Run<T> {
    /// Whether a friction sticks in the mode of the start that cannot hold; `dynamics` holds its values.
    pub(super) fn overcomes_a_friction(&self) -> bool {
        let d = self.description();
        let mode = &self.now.mode;
        let reading = Reading::Values(&self.dynamics);
        mode.sticking().any(|f| {
            let mut guards = guard::stick_guards(f, &d.frictions[f]);
            guards.any(|guard| guard::value(guard, mode, &reading) < 0.0)
        })
    }

    /// Lets go of the frictions that stick at a dead centre.
    pub(super) fn release_dead_centres(&mut self) {
        let mut free = self.now.mode.clone();
        free.release_sticking();
        self.dynamics.set_mode(&free);
        self.dynamics.set_extra_needs(&self.switcher.status.needs);
        let (state, order) = (&self.now.state, self.stepper.order);
        let expanded = self
            .dynamics
            .series(self.now.t, &state.q, &state.v, order)
            .is_ok();
        let held: Vec<usize> = self.now.mode.sticking().collect();
        for f in held.into_iter().filter(|_| expanded) {
            if self.slip_vanishes_only_here(f) {
                self.now.mode.frictions[f] = FrictionMode::Inactive;
            }
        }
        self.dynamics.set_mode(&self.now.mode);
        self.hold_guards();
        (self.now.valued, self.now.series) = (false, Progress::None);
    }

    /// Whether the Jacobian of the slip of friction `f` begins with zero in the series that `dynamics` holds, beside what it becomes.
    fn slip_vanishes_only_here(&self, f: usize) -> bool {
        let d = self.description();
        let allowed = Tolerance::both(self.settings.tolerance);
        let step = taylor::step_size(&self.dynamics, self.stepper.order, allowed);
        let h = step.filter(|h| h.is_finite()).unwrap_or(1.0);
        let largest = |series: &[T]| {
            let powers = core::iter::successors(Some(1.0), |power| Some(power * h));
            let terms = series.iter().zip(powers);
            terms.fold(0.0_f64, |largest, (c, power)| {
                largest.max(c.value().abs() * power)
            })
        };
        let friction = &d.frictions[f];
        let rows = &d.rows[friction.row..friction.row + friction.components];
        let (mut begins, mut becomes) = (0.0, 0.0);
        for &(j, place) in rows.iter().flat_map(|row| row.jacobian) {
            let terms = Reading::Series(&self.dynamics).motion(place);
            let speed = largest(self.dynamics.velocity_series(j));
            begins += terms.first().value().abs() * speed;
            becomes += largest(terms.as_slice()) * speed;
        }
        begins < ROUNDING * becomes
    }
}
