//! A switch: forces just before, impact if something is hit, the next mode, the log.

use super::{Progress, Run};
use crate::arithmetic::Scalar;
use crate::effects::Item;
use crate::error::Error;
use crate::mode::FrictionMode;
use crate::modes::decide::{Juncture, Known, Moment};
use crate::modes::domain;
use crate::modes::guard::Guard;
use crate::modes::impact::Impact;
use crate::system::Normal;

impl<T: Scalar> Run<T> {
    /// Leaves the present mode because the guards in `self.fallen` fell through zero.
    pub(super) fn switch(&mut self) -> Result<(), Error> {
        let d = self.description();
        if !self.rests.is_empty() {
            self.come_to_rest()?;
        }
        if !self.valued {
            self.evaluate()?;
        }
        let known = &mut self.survey.known;
        known.clear(d);
        known.residue = self
            .decider
            .residue(&mut self.dynamics, &self.mode, &self.fallen);
        known.touching.copy_from_slice(&self.mode.contacts);
        for (resting, friction) in known.resting.iter_mut().zip(&self.mode.frictions) {
            *resting = friction.rests();
        }
        for &guard in &self.fallen {
            match guard {
                Guard::Gap(c) => (known.touching[c], known.arriving[c]) = (true, true),
                Guard::Slip(f) => known.resting[f] = true,
                Guard::Branch(b) => known.balanced[b] = true,
                Guard::Region(c) => known.touching[c] = false,
                _ => {}
            }
        }
        self.hand_over();
        let known = &mut self.survey.known;
        known.located.extend_from_slice(&self.fallen);
        for guard in &self.fallen {
            if let Guard::Joint(k) = *guard {
                let parts = self.curves.joints[k].parts.iter().map(|part| part.guard);
                self.survey.known.located.extend(parts);
                let residue = self.joint_residue(&self.curves.joints[k]);
                let known = &mut self.survey.known;
                known.residue = known.residue.max(residue);
            }
        }
        self.settle()
    }

    /// Impact if needed, then the next mode; logs what changed. `self.survey.known` says what vanishes at this instant.
    pub(super) fn settle(&mut self) -> Result<(), Error> {
        let mut known = core::mem::take(&mut self.survey.known);
        let outcome = self.settle_knowing(&mut known);
        self.survey.known = known;
        outcome
    }

    fn settle_knowing(&mut self, known: &mut Known) -> Result<(), Error> {
        if !self.valued {
            self.evaluate()?;
        }
        self.remember_before();
        let hit = known.arriving.contains(&true) && self.hit(known)?;
        if !hit {
            self.rest_where_slip_vanishes(known)?;
        }
        let here = Juncture {
            moment: Moment {
                t: self.t,
                q: &self.state.q,
                v: &self.state.v,
                order: self.order,
                tolerance: self.settings.tolerance,
            },
            present: &self.mode,
            known,
        };
        self.decider
            .decide(&mut self.dynamics, &mut self.table, here)?;
        self.zeros.clone_from(&self.decider.decision.zeros);
        let edges = self.fallen.iter().filter(|g| matches!(g, Guard::Region(_)));
        self.zeros.extend(edges.map(|&edge| (edge, 1)));
        self.set_mode_decided();
        if self.decider.decision.expanded {
            self.series = Progress::Complete;
        }
        if hit || self.rows_have_joined() {
            self.project(true)?;
        }
        self.begin_series().map_err(|e| self.error(e))?;
        if self.dynamics.has_dependent_rows() {
            let valued = self.valued;
            self.evaluate_all_rows()?;
            self.decider.decision.ambiguous |= self.dynamics.leaves_motion_open();
            self.ask_for_guards();
            self.series = Progress::None;
            self.expand()?;
            self.evaluate()?;
            self.valued = valued;
            self.note_shares();
        } else {
            self.sharing.clear();
        }
        let outcome = core::mem::take(&mut self.collider.outcome);
        let impulses = if hit { &outcome.impulses[..] } else { &[] };
        self.log_changes(impulses, self.decider.decision.ambiguous);
        self.collider.outcome = outcome;
        self.stops_of_the_mode()
    }

    /// The impact of the contacts whose gaps close, if there is one.
    fn hit(&mut self, known: &mut Known) -> Result<bool, Error> {
        let d = self.description();
        self.evaluate_all_rows()?;
        for c in (0..d.contacts.len()).filter(|&c| !self.mode.contacts[c]) {
            // A gap that rounding has left below zero may be growing.
            let (rate, size) = self.rate(d.contacts[c].row);
            if known.arriving[c] && rate > 1e-12 * size {
                (known.touching[c], known.arriving[c], known.parting[c]) = (false, false, true);
                known.located.retain(|guard| *guard != Guard::Gap(c));
            }
        }
        if !(0..d.contacts.len()).any(|c| known.arriving[c] && self.approaching(c)) {
            return Ok(false);
        }
        // What has just parted may be pushed back.
        let mut near = core::mem::take(&mut self.near);
        near.clear();
        near.extend((0..d.contacts.len()).filter(|&c| known.touching[c] || known.parting[c]));
        let impacts = self.settings.impacts.unwrap_or(d.impacts);
        let time = self.t.value();
        let mut solved =
            (near.iter()).try_for_each(|&c| domain::check_restitution(&self.dynamics, time, c));
        if solved.is_ok() {
            solved = self
                .collider
                .solve(&self.dynamics, time, &self.state.v, &near, impacts);
        }
        self.near = near;
        solved?;
        let outcome = core::mem::take(&mut self.collider.outcome);
        self.state.v.copy_from_slice(&outcome.v);
        self.log_impacts(&outcome, known);
        self.after_impact(&outcome, known);
        let closed = self.close_accumulated(&outcome, known);
        self.collider.outcome = outcome;
        closed?;
        Ok(true)
    }

    /// Whether the switch has brought rows that the state need not satisfy to rounding.
    fn rows_have_joined(&self) -> bool {
        let (before, after) = (&self.before.mode, &self.mode);
        let mut contacts = before.contacts.iter().zip(&after.contacts);
        let mut frictions = before.frictions.iter().zip(&after.frictions);
        contacts.any(|(before, after)| !before & after)
            || frictions.any(|(before, after)| before != after && *after == FrictionMode::Stick)
            || before.branches != after.branches
    }

    /// Whether the gap of contact `c` closes at the present state: faster than rounding does.
    fn approaching(&self, c: usize) -> bool {
        let d = self.description();
        let (rate, size) = self.rate(d.contacts[c].row);
        self.dynamics.effects().includes(d, Item::Contact(c)) && rate < -f64::EPSILON * size
    }

    /// What is known after an impact; `dynamics` still holds the state before.
    fn after_impact(&self, outcome: &Impact<T>, known: &mut Known) {
        let d = self.description();
        for &c in &self.near {
            known.touching[c] = outcome.stays[c];
            known.parting[c] = !outcome.stays[c];
        }
        for (f, friction) in d.frictions.iter().enumerate() {
            known.resting[f] = match friction.normal {
                Normal::Contact(c) if !self.near.contains(&c) => known.resting[f],
                Normal::Contact(_) | Normal::Constraint(_) => outcome.sticks[f],
                // No impulse acts there, but the impact may have begun or ended its slip.
                Normal::Given(_) => self.rests_after(outcome, f),
            };
        }
        // Velocities have jumped: what was located for the old ones says nothing about the new.
        known.jumped = true;
        known.located.clear();
    }

    /// Whether the slip of friction `f` vanishes after an impact.
    fn rests_after(&self, outcome: &Impact<T>, f: usize) -> bool {
        let friction = &self.description().frictions[f];
        (friction.row..friction.row + friction.components).all(|row| {
            let (mut slip, mut size) = self.rate(row);
            let jacobian = self.description().rows[row].jacobian.iter();
            for &(j, place) in jacobian {
                let jump = (outcome.v[j] - self.before.state.v[j]).value();
                let part = self.dynamics.motion(place).value() * jump;
                slip += part;
                size += part.abs();
            }
            slip.abs() <= 1e-13 * size
        })
    }

    /// A contact that closes without impact carries frictions whose slip nobody has looked at.
    fn rest_where_slip_vanishes(&mut self, known: &mut Known) -> Result<(), Error> {
        let d = self.description();
        let wakes = |run: &Self, known: &Known, f: usize| {
            let closes = match d.frictions[f].normal {
                Normal::Contact(c) => known.touching[c],
                Normal::Constraint(_) | Normal::Given(_) => true,
            };
            closes
                && !known.resting[f]
                && run.mode.frictions[f] == FrictionMode::Inactive
                && run.dynamics.effects().includes(d, Item::Friction(f))
        };
        if !(0..d.frictions.len()).any(|f| wakes(self, known, f)) {
            return Ok(());
        }
        self.evaluate_all_rows()?;
        for f in 0..d.frictions.len() {
            if wakes(self, known, f) {
                known.resting[f] = self.slip_vanishes(f);
            }
        }
        Ok(())
    }

    /// Whether the slip of friction `f` is zero beside the terms that make it.
    pub(super) fn slip_vanishes(&self, f: usize) -> bool {
        let friction = &self.description().frictions[f];
        let rows = friction.row..friction.row + friction.components;
        let rates = || rows.clone().map(|row| self.rate(row));
        let size = rates().map(|(_, size)| size).fold(0.0, f64::max);
        rates().all(|(rate, _)| rate.abs() <= 1e-13 * size)
    }

    /// Rate of a row (slip, rate of a gap) and the size of the terms that make it; a velocity that is zero is so only to some
    /// 1e-16 of the unit, as projections leave it.
    pub(super) fn rate(&self, row: usize) -> (f64, f64) {
        let row = &self.description().rows[row];
        let number = |place| self.dynamics.motion(place).value();
        let size = |j: usize| self.state.v[j].value().abs() + 1e-2;
        let terms = row.jacobian.iter();
        let sizes = terms.map(|&(j, place)| number(place).abs() * size(j));
        (number(row.velocity), sizes.sum())
    }
}
