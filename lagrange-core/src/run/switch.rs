//! A switch: forces just before, impact if something is hit, the next mode, the log.

use super::Run;
use crate::arithmetic::Scalar;
use crate::effects::Item;
use crate::error::Error;
use crate::mode::{FrictionMode, Mode};
use crate::modes::decide::{Known, decide};
use crate::modes::guard::Guard;
use crate::modes::impact::{Impact, impact};
use crate::system::{Normal, System};
use crate::trajectory::{Event, EventKind, State, Subject};

impl<S: System> Run<'_, S> {
    /// Leaves the present mode because the guards in `self.fallen` fell through zero.
    pub(super) fn switch(&mut self) -> Result<(), Error> {
        let d = S::DESCRIPTION;
        let known = Known {
            touching: (0..d.contacts.len())
                .map(|c| self.mode.contacts[c] || self.fallen.contains(&Guard::Gap(c)))
                .collect(),
            arriving: (0..d.contacts.len())
                .map(|c| self.fallen.contains(&Guard::Gap(c)))
                .collect(),
            parting: vec![false; d.contacts.len()],
            resting: (0..d.frictions.len())
                .map(|f| {
                    self.mode.frictions[f] == FrictionMode::Stick
                        || self.fallen.contains(&Guard::Slip(f))
                })
                .collect(),
            balanced: (0..d.branches.len())
                .map(|b| self.fallen.contains(&Guard::Branch(b)))
                .collect(),
            located: self.fallen.clone(),
        };
        self.settle(known)
    }

    /// Impact if needed, then the next mode; logs what changed. `known` says what vanishes at this instant.
    pub(super) fn settle(&mut self, mut known: Known) -> Result<(), Error> {
        let d = S::DESCRIPTION;
        let before = self.mode.clone();
        let state = self.state.clone();
        self.evaluate_all_rows()?;
        let forces = self.forces();
        let hit: Vec<usize> = (0..d.contacts.len())
            .filter(|&c| known.arriving[c] && self.approaching(c))
            .collect();
        let mut struck = None;
        if !hit.is_empty() {
            let near: Vec<usize> = (0..d.contacts.len())
                .filter(|&c| known.touching[c])
                .collect();
            let outcome = impact(&self.dynamics, self.t.value(), &self.state.v, &near)?;
            self.state.v.copy_from_slice(&outcome.v);
            self.log_impacts(&outcome, &hit, &before, &state, &forces);
            self.after_impact(&outcome, &near, &mut known);
            self.close_accumulated(&outcome, &mut known)?;
            struck = Some(outcome);
        } else {
            self.rest_where_slip_vanishes(&mut known);
        }
        let decision = decide(
            &mut self.dynamics,
            self.t,
            &self.state.q,
            &self.state.v,
            &self.mode,
            &known,
            self.order,
            self.simulation.tolerance,
        )?;
        self.set_mode(decision.mode);
        self.zeros = decision.zeros;
        self.project(true)?;
        self.refresh()?;
        let impulses = struck.map(|s| s.impulses).unwrap_or_default();
        self.log_changes(&before, &state, &forces, &impulses, decision.ambiguous);
        self.stops_of_the_mode(&before)
    }

    /// Whether the gap of contact `c` closes at the present state.
    fn approaching(&self, c: usize) -> bool {
        let d = S::DESCRIPTION;
        self.dynamics.effects().includes(d, Item::Contact(c))
            && self
                .dynamics
                .motion(d.rows[d.contacts[c].row].velocity)
                .value()
                < 0.0
    }

    /// Ends the infinitely many impacts of contacts that bounce ever less.
    fn close_accumulated(
        &mut self,
        outcome: &Impact<S::Scalar>,
        known: &mut Known,
    ) -> Result<(), Error> {
        let d = S::DESCRIPTION;
        for c in 0..d.contacts.len() {
            if !outcome.struck[c] || !known.parting[c] {
                continue;
            }
            let Some(count) = self.accumulate(c, known) else {
                continue;
            };
            let mut closed = self.mode.clone();
            for (contact, touching) in closed.contacts.iter_mut().zip(&known.touching) {
                *contact = *touching;
            }
            self.dynamics.set_mode(&closed);
            self.project(true)?;
            self.evaluate_all_rows()?;
            for (f, friction) in d.frictions.iter().enumerate() {
                if matches!(friction.normal, Normal::Contact(on) if known.touching[on]) {
                    let (slip, size) = self.slip(friction.row);
                    known.resting[f] = slip.abs() <= 1e-13 * size;
                }
            }
            let state = self.state.clone();
            self.log_watch(
                Subject::Contact(c),
                EventKind::Accumulates { impacts: count },
                self.t,
                state,
            );
        }
        Ok(())
    }

    /// What is known after an impact.
    fn after_impact(&self, outcome: &Impact<S::Scalar>, near: &[usize], known: &mut Known) {
        let d = S::DESCRIPTION;
        for &c in near {
            known.touching[c] = outcome.stays[c];
            known.parting[c] = !outcome.stays[c];
        }
        for f in 0..d.frictions.len() {
            if let Normal::Contact(c) = d.frictions[f].normal
                && near.contains(&c)
            {
                known.resting[f] = outcome.sticks[f];
            }
        }
        // Velocities have jumped: what was located for the old ones says nothing about the new.
        known.located.clear();
    }

    /// A contact that closes without impact carries frictions whose slip nobody has looked at.
    fn rest_where_slip_vanishes(&mut self, known: &mut Known) {
        let d = S::DESCRIPTION;
        for (f, friction) in d.frictions.iter().enumerate() {
            let active = self.mode.frictions[f] != FrictionMode::Inactive;
            if active || known.resting[f] {
                continue;
            }
            let (slip, size) = self.slip(friction.row);
            known.resting[f] = slip.abs() <= 1e-13 * size;
        }
    }

    /// Slip of a friction row and the size of the terms that make it.
    pub(super) fn slip(&self, row: usize) -> (f64, f64) {
        let row = &S::DESCRIPTION.rows[row];
        let number = |place| self.dynamics.motion(place).value();
        let size = row
            .jacobian
            .iter()
            .map(|&(j, place)| (number(place) * self.state.v[j].value()).abs())
            .sum();
        (number(row.velocity), size)
    }

    fn log_impacts(
        &mut self,
        outcome: &Impact<S::Scalar>,
        hit: &[usize],
        before: &Mode,
        state: &State<S::Scalar>,
        forces: &[S::Scalar],
    ) {
        for &c in hit.iter().filter(|c| outcome.struck[**c]) {
            self.trajectory.events.push(Event {
                time: self.t,
                subject: Subject::Contact(c),
                kind: EventKind::Impact,
                before: before.clone(),
                after: before.clone(),
                state: state.clone(),
                state_after: self.state.clone(),
                forces: forces.to_vec(),
                forces_after: forces.to_vec(),
                impulses: outcome.impulses.clone(),
                restitution_lowered: outcome.lowered,
                ambiguous: false,
            });
        }
    }

    /// One entry per item whose state changed; frictions that come and go with their contact are not told apart.
    fn log_changes(
        &mut self,
        before: &Mode,
        state: &State<S::Scalar>,
        forces: &[S::Scalar],
        impulses: &[S::Scalar],
        ambiguous: bool,
    ) {
        let d = S::DESCRIPTION;
        let after = self.mode.clone();
        let mut list: Vec<(Subject, EventKind)> = Vec::new();
        for c in 0..d.contacts.len() {
            match (before.contacts[c], after.contacts[c]) {
                (true, false) => list.push((Subject::Contact(c), EventKind::Lost)),
                (false, true) => list.push((Subject::Contact(c), EventKind::Closed)),
                _ => {}
            }
        }
        for f in 0..d.frictions.len() {
            let kind = match (before.frictions[f], after.frictions[f]) {
                (FrictionMode::Stick, FrictionMode::Slip(_)) => EventKind::Slips,
                (FrictionMode::Slip(_), FrictionMode::Stick) => EventKind::Sticks,
                (FrictionMode::Slip(a), FrictionMode::Slip(b)) if a.direction != b.direction => {
                    EventKind::Reverses
                }
                _ => continue,
            };
            list.push((Subject::Friction(f), kind));
        }
        for b in 0..d.branches.len() {
            if before.branch(b) != after.branch(b) {
                list.push((Subject::Branch(b), EventKind::Branches));
            }
        }
        // The impacts of this instant end in the mode that has now been found.
        let forces_after = self.forces_from_series();
        for event in self.trajectory.events.iter_mut().rev() {
            if event.kind != EventKind::Impact || event.time != self.t {
                break;
            }
            event.after = after.clone();
            event.forces_after.clone_from(&forces_after);
        }
        for (subject, kind) in list {
            self.trajectory.events.push(Event {
                time: self.t,
                subject,
                kind,
                before: before.clone(),
                after: after.clone(),
                state: state.clone(),
                state_after: self.state.clone(),
                forces: forces.to_vec(),
                forces_after: forces_after.clone(),
                impulses: impulses.to_vec(),
                restitution_lowered: false,
                ambiguous,
            });
        }
    }

    /// Logs a stop or a mark at the present instant.
    pub(super) fn log_watch(
        &mut self,
        subject: Subject,
        kind: EventKind,
        time: S::Scalar,
        state: State<S::Scalar>,
    ) {
        let forces = self.forces();
        self.trajectory.events.push(Event {
            time,
            subject,
            kind,
            before: self.mode.clone(),
            after: self.mode.clone(),
            state_after: state.clone(),
            state,
            forces_after: forces.clone(),
            forces,
            impulses: Vec::new(),
            restitution_lowered: false,
            ambiguous: false,
        });
    }
}
