//! What is at the edge of a surface and does not cross it: a block that has come to rest there, or slides along it.
//!
//! Its region and the rate of that vanish, and the first term of its series that does not tells whether the motion goes out. It does so at once, as where
//! a load begins to pull. No root tells that: rounding ε moves that of a region that begins with tᵏ by the k-th root of ε.

use super::Run;
use super::guard_polynomials::CLEAR;
use crate::arithmetic::{Scalar, rounding};
use crate::dynamics::EvaluationError;
use crate::integrate::taylor;
use crate::modes::composite::ONES;
use crate::modes::decide::terms;
use crate::modes::facts::SwitchFacts;
use crate::modes::guard::{self, Guard, LENGTH};
use crate::modes::reading::Reading;
use crate::trajectory::State;

/// What is no more than this beside what makes it, or 1, is what rounding has left of zero.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// Terms are compared over this part of the time over which series reach: where nothing else limits that, rounding of their last terms does.
const SOON: f64 = 1e-2;

/// So many terms of a region vanish at an edge that the motion does not cross.
const KNOWN: usize = 2;

impl<T: Scalar> Run<T> {
    /// Ends contacts over whose edge the motion goes in the mode decided, without having crossed it; whether there is one. Of the others at whose edge it is,
    /// it is noted how their regions begin.
    pub(super) fn leave_edges(&mut self, facts: &mut SwitchFacts) -> bool {
        let contacts = 0..self.description().contacts.len();
        if !contacts.clone().any(|c| self.is_closed_to_edge(c)) {
            return false;
        }
        self.tape_of_all_rows();
        (self.now.valued, self.switcher.decider.decision.expanded) = (false, false);
        if !contacts.clone().any(|c| self.is_at_edge_of(c)) {
            return false;
        }
        let accelerations = self.switcher.decider.size_of_accelerations(&self.dynamics);
        // What has no series is seen by the steps alone.
        if self.expand_as_decided().is_err() {
            return false;
        }
        let mut leaves = false;
        for c in contacts {
            let mut region = [0.0; LENGTH];
            if !self.is_closed_to_edge(c) || !self.runs_along_edge(c, &mut region) {
                continue;
            }
            match self.first_clear(&region, accelerations) {
                Some(order) if region[order] < 0.0 => {
                    (facts.touching[c], self.now.below[c], leaves) = (false, true, true);
                }
                order => {
                    let zeros = &mut self.switcher.decider.decision.zeros;
                    zeros.push((Guard::Region(c), order.unwrap_or(LENGTH)));
                }
            }
        }
        leaves
    }

    /// Whether contact `c` is closed in the mode decided and has an edge at which no other surface keeps the motion.
    fn is_closed_to_edge(&self, c: usize) -> bool {
        self.switcher.decider.decision.mode.contacts[c]
            && self.description().contacts[c].region.is_some()
            && !self.is_held_at(Guard::Region(c), 0.0)
    }

    /// Whether the present state is at such an edge of contact `c`; `dynamics` holds the numbers of all rows.
    fn is_at_edge_of(&self, c: usize) -> bool {
        let region = self.description().contacts[c].region;
        self.is_closed_to_edge(c)
            && region.is_some_and(|place| self.is_edge(c, self.dynamics.motion(place).value()))
    }

    /// Whether this region of contact `c` vanishes, as far as rounding tells.
    fn is_edge(&self, c: usize, region: f64) -> bool {
        let (guard, off) = (Guard::Region(c), region.abs());
        off <= self
            .locator
            .polynomials
            .rounding(off, guard, &self.dynamics)
    }

    /// The series of the present state in the mode decided.
    fn expand_as_decided(&mut self) -> Result<(), EvaluationError> {
        self.ask_for_guards();
        let State { q, v, .. } = &self.now.state;
        let order = self.stepper.order;
        self.dynamics.series(self.now.t, q, v, order)
    }

    /// Whether the motion is at the edge of contact `c` and does not cross it. The series of its region, which `dynamics` holds, is put in `region`.
    fn runs_along_edge(&self, c: usize, region: &mut [f64; LENGTH]) -> bool {
        let mode = &self.switcher.decider.decision.mode;
        let reading = Reading::Series(&self.dynamics);
        let region = &mut region[..=self.stepper.order];
        guard::series(Guard::Region(c), mode, &reading, &ONES, region);
        let larger = |size: f64, v: &T| size.max(v.value().abs());
        let speed = self.now.state.v.iter().fold(1.0, larger);
        self.is_edge(c, region[0]) && region[1].abs() <= rounding::<T>(ROUNDING) * speed
    }

    /// How far the series of the state at hand reach, s; 1 if they end.
    pub(super) fn reach(&self) -> f64 {
        let (series, tolerance) = (self.dynamics.state_series(), self.settings.per_step());
        let reach = taylor::step_size(series, self.stepper.order, tolerance);
        reach.filter(|reach| reach.is_finite()).unwrap_or(1.0)
    }

    /// The first term of the series of a region that is more than what rounding leaves, of positions and of accelerations of this size, beyond those that
    /// vanish at an edge that is not crossed.
    fn first_clear(&self, region: &[f64; LENGTH], accelerations: f64) -> Option<usize> {
        let ahead = SOON * self.reach();
        let sizes = || terms(region.iter().copied(), ahead).skip(KNOWN);
        let noise = CLEAR * sizes().fold(0.0, f64::max)
            + rounding::<T>(ROUNDING) * (1.0 + accelerations * ahead * ahead);
        let clear = sizes().position(|size| size > noise);
        clear.map(|k| KNOWN + k)
    }
}
