//! The event log: one entry per item that changed.

use super::Run;
use crate::arithmetic::Scalar;
use crate::mode::{FrictionMode, Mode};
use crate::modes::decide::Known;
use crate::modes::impact::Impact;
use crate::system::System;
use crate::trajectory::{Around, Event, EventKind, State, Subject};

/// What was just before a switch.
#[derive(Clone, Debug)]
pub(super) struct Before<T> {
    pub mode: Mode,
    pub state: State<T>,
    pub forces: Vec<T>,
    pub undetermined: Vec<bool>,
}

impl<S: System> Run<S> {
    pub(super) fn log_impacts(&mut self, outcome: &Impact<S::Scalar>, known: &Known) {
        let before = &self.before;
        let hit = |c: &usize| known.arriving[*c] && outcome.struck[*c];
        for c in (0..S::DESCRIPTION.contacts.len()).filter(hit) {
            let event = self
                .trajectory
                .events
                .reuse(|| Event::blank(S::DESCRIPTION));
            let around = Around {
                before: &before.mode,
                after: &before.mode,
                state: &before.state,
                state_after: &self.state,
                forces: &before.forces,
                forces_after: &before.forces,
                undetermined: &before.undetermined,
                undetermined_after: &before.undetermined,
                impulses: &outcome.impulses,
            };
            event.write(self.t, Subject::Contact(c), EventKind::Impact, around);
            event.restitution_lowered = outcome.lowered;
            event.impulses_undetermined = outcome.undetermined;
        }
    }

    /// One entry per item whose state changed; frictions that come and go with their contact are not told apart.
    pub(super) fn log_changes(&mut self, impulses: &[S::Scalar], ambiguous: bool) {
        let d = S::DESCRIPTION;
        if !self.dynamics.has_dependent_rows() {
            write_forces(&mut self.forces_after, |row| {
                let series = self.dynamics.force_series(row);
                series.first().copied().unwrap_or_default()
            });
            self.undetermined_after.clear();
        }
        let (before, after) = (&self.before.mode, &self.mode);
        // The impacts of this instant end in the mode that has now been found.
        for event in self.trajectory.events.iter_mut().rev() {
            if event.kind != EventKind::Impact || event.time != self.t {
                break;
            }
            event.after.clone_from(after);
            event.forces_after.clone_from(&self.forces_after);
            event
                .undetermined_after
                .clone_from(&self.undetermined_after);
        }
        let contacts =
            (0..d.contacts.len()).filter_map(|c| match (before.contacts[c], after.contacts[c]) {
                (true, false) => Some((Subject::Contact(c), EventKind::Lost)),
                (false, true) => Some((Subject::Contact(c), EventKind::Closed)),
                _ => None,
            });
        let frictions = (0..d.frictions.len()).filter_map(|f| {
            let kind = match (before.frictions[f], after.frictions[f]) {
                (FrictionMode::Stick, FrictionMode::Slip(_)) => EventKind::Slips,
                (FrictionMode::Slip(_), FrictionMode::Stick) => EventKind::Sticks,
                (FrictionMode::Slip(a), FrictionMode::Slip(b)) if a.direction != b.direction => {
                    EventKind::Reverses
                }
                _ => return None,
            };
            Some((Subject::Friction(f), kind))
        });
        let branches = (0..d.branches.len())
            .filter(|&b| before.branch(b) != after.branch(b))
            .map(|b| (Subject::Branch(b), EventKind::Branches));
        let around = Around {
            before,
            after,
            state: &self.before.state,
            state_after: &self.state,
            forces: &self.before.forces,
            forces_after: &self.forces_after,
            undetermined: &self.before.undetermined,
            undetermined_after: &self.undetermined_after,
            impulses,
        };
        for (subject, kind) in contacts.chain(frictions).chain(branches) {
            let event = self.trajectory.events.reuse(|| Event::blank(d));
            event.write(self.t, subject, kind, around);
            event.ambiguous = ambiguous;
        }
    }

    /// Logs a stop, a mark or an accumulation: the mode and the `state` of the last value go on.
    pub(super) fn log_watch(
        &mut self,
        subject: Subject,
        kind: EventKind,
        time: S::Scalar,
        state: &State<S::Scalar>,
    ) {
        let mut forces = core::mem::take(&mut self.forces_after);
        let mut undetermined = core::mem::take(&mut self.undetermined_after);
        self.reported_forces(&mut forces, &mut undetermined);
        let around = Around {
            before: &self.mode,
            after: &self.mode,
            state,
            state_after: state,
            forces: &forces,
            forces_after: &forces,
            undetermined: &undetermined,
            undetermined_after: &undetermined,
            impulses: &[],
        };
        let event = self
            .trajectory
            .events
            .reuse(|| Event::blank(S::DESCRIPTION));
        event.write(time, subject, kind, around);
        (self.forces_after, self.undetermined_after) = (forces, undetermined);
    }

    /// Mode, state and forces of the last value, before they change.
    pub(super) fn remember_before(&mut self) {
        self.before.mode.clone_from(&self.mode);
        self.before.state.clone_from(&self.state);
        let mut forces = core::mem::take(&mut self.before.forces);
        let mut undetermined = core::mem::take(&mut self.before.undetermined);
        self.reported_forces(&mut forces, &mut undetermined);
        (self.before.forces, self.before.undetermined) = (forces, undetermined);
    }
}

/// One number per row.
fn write_forces<T: Scalar>(out: &mut [T], force: impl Fn(usize) -> T) {
    for (row, out) in out.iter_mut().enumerate() {
        *out = force(row);
    }
}
