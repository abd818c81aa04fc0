//! On which side of their conditions piecewise expressions are at a switch, where no root says so.
//!
//! Conditions in the coefficients of a contact are not watched while it is open. Velocities that jump carry conditions along. And what touches
//! may hold a condition at its border.

use super::Run;
use crate::arithmetic::{Scalar, rounding};
use crate::error::Error;
use crate::mode::FrictionMode;
use crate::modes::composite::ONES;
use crate::modes::decide::terms;
use crate::modes::facts::SwitchFacts;
use crate::modes::guard::{self, Guard, LENGTH};
use crate::modes::held::conditions;
use crate::modes::reading::Reading;
use crate::modes::status::take_sides;

/// What is left of a condition after an impact is rounding, beside what it was or the largest speed.
const ROUNDING: f64 = 1e-12;

/// A condition that has been located as zero is no more than this of its terms.
const LOCATED: f64 = 1e-6;

impl<T: Scalar> Run<T> {
    /// Whether there are branches that the motion depends on.
    fn has_sides(&self) -> bool {
        let mut branches = self.description().branches.iter();
        branches.any(|branch| !branch.after_solve)
    }

    /// Puts the branches on their sides that the mode does not watch.
    pub(super) fn take_sides_not_watched(&mut self) {
        if !self.has_sides() {
            return;
        }
        self.dynamics.set_mode(&self.now.mode);
        let guards = &self.switcher.table.of(&self.dynamics).guards;
        self.switcher.watched.clone_from(guards);
        let mut branches = self.description().branches.iter().enumerate();
        let watched = &self.switcher.watched;
        if branches.all(|(b, branch)| branch.after_solve || watched.contains(&Guard::Branch(b))) {
            return;
        }
        self.take_sides(|watched, _, guard| (!watched && guard != 0.0).then_some(guard > 0.0));
    }

    /// Remembers the conditions of branches just before an impact, from the values of all rows.
    pub(super) fn note_conditions(&mut self) {
        self.switcher.conditions.clear();
        if !self.has_sides() {
            return;
        }
        let conditions = conditions(&self.dynamics);
        self.switcher.conditions.extend(conditions);
    }

    /// Puts branches on their sides that an impact has moved them to; what it has moved to their borders is balanced.
    pub(super) fn take_sides_after_impact(&mut self, facts: &mut SwitchFacts) {
        if self.switcher.conditions.is_empty() {
            return;
        }
        let before = core::mem::take(&mut self.switcher.conditions);
        let speeds = self.now.state.v.iter();
        let fastest = speeds.fold(0.0_f64, |fastest, v| fastest.max(v.value().abs()));
        let sides = self.now.mode.clone();
        self.take_sides(|_, b, guard| {
            // One that depends on the side of another may have been on the other side on the way.
            if guard == before[b] {
                return Some(sides.branch(b));
            }
            let size = before[b].abs().max(fastest);
            let vanishes = guard.abs() <= rounding::<T>(ROUNDING) * size;
            facts.balanced[b] |= vanishes;
            (!vanishes).then_some(guard > 0.0)
        });
        self.switcher.conditions = before;
    }

    /// Puts branches on their sides whose conditions have fallen because they jumped beyond zero, with the side of another, not because they vanish.
    pub(super) fn take_sides_that_jumped(&mut self, facts: &mut SwitchFacts) {
        let d = self.description();
        let fallen = core::mem::take(&mut self.locator.fallen);
        let mut jumped = false;
        for guard in &fallen {
            if let Guard::Branch(b) = *guard
                && !d.branches[b].after_solve
                && let Some(curve) = self.locator.polynomials.of(*guard)
            {
                let size: f64 = curve.iter().map(|c| c.abs()).sum();
                let condition = self.dynamics.motion(d.branches[b].guard).value();
                let polynomials = &self.locator.polynomials;
                let rounding = polynomials.rounding(condition.abs(), *guard, &self.dynamics);
                if condition.abs() > LOCATED * size + rounding {
                    (facts.balanced[b], jumped) = (false, true);
                }
            }
        }
        if jumped {
            let follows = |b: usize| fallen.contains(&Guard::Branch(b)) && !facts.balanced[b];
            self.take_sides(|_, b, condition| follows(b).then_some(condition >= 0.0));
            let vanishes = |guard: &Guard| !matches!(*guard, Guard::Branch(b) if follows(b));
            facts.located.retain(vanishes);
        }
        self.locator.fallen = fallen;
    }

    /// Puts branches on the sides that follow from the values of their guards at the present state, from whether the mode watches one, its number, and
    /// the value; that of one may depend on the side of another.
    fn take_sides(&mut self, mut side: impl FnMut(bool, usize, f64) -> Option<bool>) {
        let (now, switcher) = (&mut self.now, &self.switcher);
        let before = &mut self.recorder.before.mode;
        let needs = &switcher.status.needs;
        let side = |b: usize, guard: f64| {
            let watched = switcher.watched.contains(&Guard::Branch(b));
            let side = side(watched, b, guard)?;
            // What nothing watches is no event.
            if !watched {
                before.set_branch(b, side);
            }
            Some(side)
        };
        let moved = take_sides(
            &mut self.dynamics,
            now.t,
            &now.state,
            needs,
            &mut now.mode,
            side,
        );
        if moved {
            self.recorder.trajectory.enter(&self.now.mode);
        }
        self.dynamics.set_mode(&self.now.mode);
        self.ask_for_guards();
        self.now.valued = false;
    }

    /// Branches are at their border where everything that touches and rests holds them there: a contact that closes may not do so at the
    /// root of their guard.
    pub(super) fn balance_what_is_held(&mut self, facts: &mut SwitchFacts) {
        if !self.has_sides() {
            return;
        }
        let d = self.description();
        let mode = &mut self.switcher.scratch_mode;
        mode.clone_from(&self.now.mode);
        mode.contacts.copy_from_slice(&facts.touching);
        for (f, friction) in d.frictions.iter().enumerate() {
            let rests = facts.resting[f] && friction.normal.presses(d, |c| facts.touching[c]);
            mode.frictions[f] = match rests {
                true => FrictionMode::Stick,
                false => FrictionMode::Inactive,
            };
        }
        self.dynamics.set_mode(mode);
        let here = self
            .now
            .context(self.stepper.order, self.settings.tolerance, facts);
        let needs = &self.switcher.status.needs;
        let held = &mut self.switcher.held;
        held.look(&mut self.dynamics, needs, here.moment);
        for (balanced, held) in facts.balanced.iter_mut().zip(held.held()) {
            *balanced |= held;
        }
        facts.held.copy_from_slice(held.held());
        facts.lying.copy_from_slice(held.of_positions());
        self.dynamics.set_mode(&self.now.mode);
        self.now.valued = false;
    }

    /// Puts the branches that read accelerations or forces on the sides on which they are just after a switch. The motion does not depend on them,
    /// and what they read may have jumped, so that none of the sides before says anything.
    ///
    /// # Errors
    /// The motion has no series here.
    pub(super) fn take_sides_of_outputs(&mut self) -> Result<(), Error> {
        let d = self.description();
        let guards = self.switcher.table.of(&self.dynamics).guards.iter();
        self.switcher.watched.clear();
        self.switcher
            .watched
            .extend(guards.copied().filter(|guard| guard.is_of_outputs(d)));
        // One may read what has the side of another, and so on; the last time nothing changes.
        let count = self.switcher.watched.len();
        if count == 0 {
            return Ok(());
        }
        for pass in 0..=count {
            self.expand()?;
            self.locator
                .zeros
                .retain(|(guard, _)| !guard.is_of_outputs(d));
            let mut changes = false;
            for k in 0..count {
                let guard = self.switcher.watched[k];
                let (vanishing, stays) = self.begins(guard);
                match guard {
                    Guard::Branch(b) if !stays && pass < count => {
                        self.now.mode.set_branch(b, !self.now.mode.branch(b));
                        changes = true;
                    }
                    _ if vanishing > 0 => self.locator.zeros.push((guard, vanishing)),
                    _ => {}
                }
            }
            if !changes {
                break;
            }
            self.recorder.trajectory.enter(&self.now.mode);
            self.dynamics.set_mode(&self.now.mode);
            self.now.outdate();
            self.hold_guards();
        }
        Ok(())
    }

    /// How many of the first coefficients of the guard of a branch vanish, by the series at hand, and whether the branch is on its side then.
    fn begins(&self, guard: Guard) -> (usize, bool) {
        let order = self.stepper.order;
        let mut row = [0.0; LENGTH];
        let row = &mut row[..=order];
        let reading = Reading::Series(&self.dynamics);
        guard::series(guard, &self.now.mode, &reading, &ONES, row);
        let reach = self.reach();
        let largest = terms(row.iter().copied(), reach).fold(0.0, f64::max);
        let is_root = self.locator.fallen.contains(&guard) && row[0].abs() <= LOCATED * largest;
        let mut sizes = terms(row.iter().copied(), reach).enumerate();
        let first = sizes
            .find(|&(k, size)| size > rounding::<T>(ROUNDING) * largest && !(k == 0 && is_root));
        match (first, guard) {
            (Some((k, _)), _) => (k, row[k] > 0.0),
            (None, Guard::Branch(b)) => (LENGTH, self.now.mode.branch(b)),
            (None, _) => (LENGTH, true),
        }
    }
}
