//! Composite guards within a step: at some instants, and where margins may dip between them.

use super::margins::{Margins, WIDE};
use super::{ROOT, is_like_one_of};
use crate::arithmetic::Scalar;
use crate::modes::composite::CompositeGuard;
use crate::run::Run;
use core::ops::ControlFlow::{self, Break, Continue};

/// Composite guards are also looked for at these parts of a step, at the second and each other one where the directions of forces do not turn.
const WITHIN: [f64; 7] = [0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875];

/// What is looked for.
#[derive(Clone, Copy)]
struct Search {
    /// The part of the step before which it is, where `dynamics` and `scratch` end again.
    end: f64,
    /// Whether the forces themselves are asked where they cease to keep all bounds.
    asks_forces: bool,
}

impl<T: Scalar> Run<T> {
    /// Looks for composite guards at some instants before part `end` of the step, where `dynamics` and `scratch` end again: whether
    /// there are new ones, or known ones are below zero with weights that are new; or the forces themselves are asked where they cease to keep all bounds.
    /// `last_kept` is the last of these instants at which they do.
    pub(super) fn finds_joints_within(
        &mut self,
        end: f64,
        asks_forces: bool,
        last_kept: &mut f64,
    ) -> bool {
        let search = Search { end, asks_forces };
        let mut margins = Margins::default();
        self.note_margin(end, &mut margins);
        let found = match self.finds_joints_at_parts(search, last_kept, &mut margins) {
            Continue(false) => self.finds_joints_in_dips(search, &mut margins),
            Continue(found) | Break(found) => found,
        };
        // What could be evaluated before.
        _ = self.evaluate_end(end);
        self.look_at_redundant_forces();
        found
    }

    /// The same at even parts of the step; whether nothing of what comes after needs to be looked at.
    fn finds_joints_at_parts(
        &mut self,
        search: Search,
        last_kept: &mut f64,
        margins: &mut Margins,
    ) -> ControlFlow<bool, bool> {
        let (first, each) = match self.directions_turn() {
            true => (0, 1),
            false => (1, 2),
        };
        let mut found = false;
        for part in WITHIN.into_iter().skip(first).step_by(each) {
            let part = part * search.end;
            if self.evaluate_end(part).is_err() {
                continue;
            }
            match self.finds_a_joint(part, last_kept, search, margins) {
                Continue(new) => found |= new,
                Break(new) => return Break(found || new),
            }
        }
        Continue(found)
    }

    /// The same where forces may be nearer to their bounds than at any instant looked at, until one is found or none can be.
    fn finds_joints_in_dips(&mut self, search: Search, margins: &mut Margins) -> bool {
        if !margins.may_dip(ROOT) || self.evaluate_end(0.0).is_err() {
            return false;
        }
        self.switcher.redundant.follow(&mut self.dynamics);
        self.note_margin(0.0, margins);
        while let Some(part) = margins.may_dip_at(ROOT)
            && self.evaluate_end(part).is_ok()
        {
            let mut kept = margins.before(part);
            match self.finds_a_joint(part, &mut kept, search, margins) {
                Continue(false) => {}
                Continue(found) | Break(found) => return found,
            }
        }
        false
    }

    /// Notes by how much forces keep all bounds at this part of the step, at least, where they have been looked at; the composite guard that tells of it.
    fn note_margin(&self, part: f64, margins: &mut Margins) -> Option<CompositeGuard> {
        let redundant = &self.switcher.redundant;
        let (margin, critical) = redundant.nearest(WIDE);
        margins.note(part, margin, redundant.values(), redundant.holds());
        critical
    }

    /// Looks for a composite guard at this part of the step, where the dynamics have been evaluated: whether it is new; and whether nothing of what comes
    /// after needs to be looked at. Forces are known to keep all bounds at `last_kept`.
    fn finds_a_joint(
        &mut self,
        part: f64,
        last_kept: &mut f64,
        search: Search,
        margins: &mut Margins,
    ) -> ControlFlow<bool, bool> {
        self.switcher.redundant.follow(&mut self.dynamics);
        let Some(composite) = self.note_margin(part, margins) else {
            *last_kept = part;
            return Continue(false);
        };
        let value = self.joint_value(&composite);
        let falls = value < -ROOT;
        if !falls {
            *last_kept = part;
        }
        let known = &mut self.locator.polynomials.composites;
        let place = known.iter().position(|known| known.is_like(&composite));
        // Where directions of friction turn, what is open cancels at one instant only: the root of such a guard may be none.
        let refuted = place.is_none() && is_like_one_of(&self.locator.refuted, &composite);
        if falls && (refuted || search.asks_forces) {
            return Break(self.locates_a_joint([*last_kept, part], search.end));
        }
        let found = match place {
            None if refuted => false,
            None => {
                known.push(composite);
                true
            }
            Some(k) if known[k].falls_after.is_none() => {
                known[k] = composite;
                falls
            }
            Some(_) => false,
        };
        // What comes later has other weights.
        match falls {
            true => Break(found),
            false => Continue(found),
        }
    }
}
