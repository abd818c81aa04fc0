//! The event log: one entry per item that changed.

use super::Run;
use crate::arithmetic::Scalar;
use crate::mode::{FrictionMode, Mode};
use crate::modes::decide::Known;
use crate::modes::impact::Impact;
use crate::trajectory::{Around, Event, EventKind, State, Subject};

/// What was just before a switch.
#[derive(Clone, Debug)]
pub(super) struct Before<T> {
    pub mode: Mode,
    pub state: State<T>,
    pub forces: Vec<T>,
    pub undetermined: Vec<bool>,
}

impl<T: Scalar> Run<T> {
    pub(super) fn log_impacts(&mut self, outcome: &Impact<T>, known: &Known) {
        let before = &self.before;
        let hit = |c: &usize| known.arriving[*c] && outcome.struck[*c];
        for c in (0..self.description().contacts.len()).filter(hit) {
            let d = self.description();
            let event = self.trajectory.events.reuse(|| Event::blank(d));
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
            event.ambiguous = outcome.ambiguous;
            event.other_impacts.clone_from(&outcome.others);
        }
    }

    /// One entry per item whose state changed; frictions that come and go with their contact are not told apart.
    pub(super) fn log_changes(&mut self, impulses: &[T], ambiguous: bool) {
        let d = self.description();
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
        let mut told = !ambiguous;
        for (subject, kind) in contacts.chain(frictions).chain(branches) {
            let event = self.trajectory.events.reuse(|| Event::blank(d));
            event.write(self.t, subject, kind, around);
            event.ambiguous = ambiguous;
            told = true;
        }
        if !told && let Some(subject) = at_issue(after) {
            let event = self.trajectory.events.reuse(|| Event::blank(d));
            event.write(self.t, subject, EventKind::Ambiguous, around);
            event.ambiguous = true;
        }
    }

    /// Logs a stop, a mark or an accumulation: the mode and the `state` of the last value go on.
    pub(super) fn log_watch(
        &mut self,
        subject: Subject,
        kind: EventKind,
        time: T,
        state: &State<T>,
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
        let d = self.description();
        let event = self.trajectory.events.reuse(|| Event::blank(d));
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

/// What a mode could do otherwise: a contact that is closed, else a friction that acts.
fn at_issue(mode: &Mode) -> Option<Subject> {
    let closed = mode.contacts.iter().position(|closed| *closed);
    let acts = |friction: &FrictionMode| *friction != FrictionMode::Inactive;
    let acting = mode.frictions.iter().position(acts);
    let contact = closed.map(Subject::Contact);
    contact.or(acting.map(Subject::Friction))
}
