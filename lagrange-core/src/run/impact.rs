//! Impact: contacts whose gaps close with a velocity.

use super::Run;
use super::touching::ROUNDING;
use crate::arithmetic::{Scalar, rounding};
use crate::effects::Item;
use crate::error::Error;
use crate::mode::FrictionMode;
use crate::modes::domain;
use crate::modes::facts::SwitchFacts;
use crate::modes::guard::Guard;
use crate::modes::impact::Impact;
use crate::system::Normal;

/// A gap that changes by no more than so many tolerances per second where its region begins neither closes nor opens there.
const ENTERS: f64 = 10.0;

impl<T: Scalar> Run<T> {
    /// The impact of the contacts whose gaps close, if there is one.
    pub(super) fn hit(&mut self, facts: &mut SwitchFacts) -> Result<bool, Error> {
        let d = self.description();
        self.evaluate_all_rows()?;
        self.measure_gaps();
        self.note_conditions();
        for c in 0..d.contacts.len() {
            if self.now.mode.contacts[c] || !facts.arriving[c] {
                continue;
            }
            if self.has_no_direction(c) {
                (facts.touching[c], facts.arriving[c]) = (false, false);
                facts.located.retain(|guard| *guard != Guard::Gap(c));
                continue;
            }
            let (rate, size) = self.rate(d.contacts[c].row);
            let enters = facts.located.contains(&Guard::Region(c));
            if enters && rate.abs() <= ENTERS * self.settings.tolerance * size {
                // It rolls onto the surface.
                facts.arriving[c] = false;
            } else if rate > rounding::<T>(1e-12) * size {
                // A gap that rounding has left below zero may be growing.
                (facts.touching[c], facts.arriving[c], facts.parting[c]) = (false, false, true);
                let of_contact = [Guard::Gap(c), Guard::Region(c)];
                facts.located.retain(|guard| !of_contact.contains(guard));
            }
        }
        if !(0..d.contacts.len()).any(|c| facts.arriving[c] && self.approaching(c)) {
            return Ok(false);
        }
        // What has just parted may be pushed back, and so may what is away by no more than rounding.
        let mut near = core::mem::take(&mut self.switcher.near);
        near.clear();
        let off = self.largest_gap(|c| facts.touching[c]);
        for c in 0..d.contacts.len() {
            if facts.touching[c] || facts.parting[c] {
                near.push(c);
            } else if self.may_touch(c, facts)
                && self.is_within_rounding(c, off)
                && !self.has_no_direction(c)
            {
                near.push(c);
                facts.arriving[c] |= self.approaching(c);
            }
        }
        let impacts = self.settings.impacts.unwrap_or(d.impacts);
        let time = self.now.t.value();
        let mut solved =
            (near.iter()).try_for_each(|&c| domain::check_restitution(&self.dynamics, time, c));
        if solved.is_ok() {
            solved = self.switcher.collider.solve(
                &self.dynamics,
                time,
                &self.now.state.v,
                &near,
                impacts,
            );
        }
        self.switcher.near = near;
        solved?;
        let mut outcome = core::mem::take(&mut self.switcher.collider.outcome);
        let accumulated = self.take_impact(&outcome, facts);
        if let Ok(true) = accumulated {
            let rest = &self.switcher.collider.rest;
            outcome.impulses.clone_from(&rest.impulses);
        }
        self.switcher.collider.outcome = outcome;
        accumulated?;
        Ok(true)
    }

    /// Changes velocities by an impact, and makes those that are left with it where it is the last one that is followed; whether it is.
    fn take_impact(&mut self, outcome: &Impact<T>, facts: &mut SwitchFacts) -> Result<bool, Error> {
        self.switcher.train.blurred = self.is_blurred(outcome);
        if let Some(c) = self.collapsing(outcome) {
            self.after_impact(outcome, facts);
            self.close_collapsed(c, outcome, facts)?;
            return Ok(true);
        }
        self.now.state.v.copy_from_slice(&outcome.v);
        self.log_impacts(outcome, facts);
        self.after_impact(outcome, facts);
        self.close_accumulated(outcome, facts)
    }

    /// Whether the gap of contact `c` closes at the present state: faster than rounding does.
    pub(super) fn approaching(&self, c: usize) -> bool {
        let d = self.description();
        let (rate, size) = self.rate(d.contacts[c].row);
        self.dynamics.effects().includes(d, Item::Contact(c))
            && rate < -rounding::<T>(ROUNDING) * size
    }

    /// What is known after an impact; `dynamics` still holds the state before.
    fn after_impact(&self, outcome: &Impact<T>, facts: &mut SwitchFacts) {
        let d = self.description();
        for &c in &self.switcher.near {
            facts.touching[c] = outcome.stays[c];
            facts.parting[c] = !outcome.stays[c];
        }
        for (f, friction) in d.frictions.iter().enumerate() {
            // A body that falls flat on its face while a corner of it sticks pushes that corner by the error of its angle.
            let sticks_on = self.now.mode.frictions[f] == FrictionMode::Stick
                && outcome.slips[f] <= self.settings.tolerance;
            let elsewhere = |c: usize| !self.switcher.near.contains(&c);
            facts.resting[f] = match friction.normal {
                // No impulse acts there, but the impact may have begun or ended its slip. What sticks on is left with the error of the step.
                Normal::Given(_) => {
                    facts.resting[f] && !self.slip_jumps(outcome, f) || self.rests_after(outcome, f)
                }
                normal if normal.contact(d).is_some_and(elsewhere) => facts.resting[f],
                // Others that stick may have ended its slip.
                _ => outcome.sticks[f] || sticks_on || self.rests_after(outcome, f),
            };
        }
        // Velocities have jumped: what was located for the old ones says nothing about the new.
        facts.jumped = true;
        facts.located.clear();
        facts.touched.clear();
    }

    /// Whether the slip of friction `f` vanishes after an impact.
    fn rests_after(&self, outcome: &Impact<T>, f: usize) -> bool {
        self.description().frictions[f].rows().all(|row| {
            let (slip, size) = self.rate(row);
            let (jump, parts) = self.jump(outcome, row);
            (slip + jump).abs() <= rounding::<T>(ROUNDING) * (size + parts)
        })
    }

    /// Whether an impact changes the slip of friction `f`.
    fn slip_jumps(&self, outcome: &Impact<T>, f: usize) -> bool {
        self.description().frictions[f].rows().any(|row| {
            let (_, size) = self.rate(row);
            let (jump, parts) = self.jump(outcome, row);
            jump.abs() > rounding::<T>(ROUNDING) * (size + parts)
        })
    }

    /// By how much an impact changes the rate of a row, and the size of the terms that make that.
    fn jump(&self, outcome: &Impact<T>, row: usize) -> (f64, f64) {
        let jacobian = self.description().rows[row].jacobian.iter();
        jacobian.fold((0.0, 0.0), |(sum, size), &(j, place)| {
            let jump = (outcome.v[j] - self.recorder.before.state.v[j]).value();
            let part = self.dynamics.motion(place).value() * jump;
            (sum + part, size + part.abs())
        })
    }
}
