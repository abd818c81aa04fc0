//! What is written down of a run; the event log: one entry per item that changed.

use super::Run;
use crate::arithmetic::Scalar;
use crate::dynamics::{self, dot};
use crate::mode::{Direction, FrictionMode, Mode};
use crate::modes::facts::SwitchFacts;
use crate::modes::impact::Impact;
use crate::settings::{Awaited, Settings};
use crate::system::Erased;
use crate::trajectory::{Around, Asked, Event, EventKind, State, Subject, Trajectory};

/// The record of a run, and what it is still to have.
#[derive(Debug)]
pub(super) struct Recorder<T: Scalar> {
    pub(super) trajectory: Trajectory<T>,
    pub(super) before: Before<T>,
    pub(super) forces_after: Vec<T>,
    pub(super) undetermined_after: Vec<bool>,
    /// Events after which the run is to end, but for those that earlier pieces of the record have.
    pub(super) awaited: Vec<Awaited>,
    /// How many events earlier pieces of the record have.
    pub(super) events_before: usize,
    /// What earlier runs cost.
    pub(super) work_before: dynamics::Work,
    pub(super) finished: bool,
}

impl<T: Scalar> Recorder<T> {
    pub(super) fn new(
        system: &Erased<T>,
        settings: &Settings,
        state: &State<T>,
        mode: &Mode,
    ) -> Self {
        let d = system.description();
        let rows = d.rows.len();
        let asked = Asked {
            tolerance: settings.tolerance,
            sizes: settings.sizes.clone(),
            method: settings.method,
            impacts: settings.impacts.unwrap_or(d.impacts),
        };
        let mut trajectory = Trajectory {
            monitor: settings.monitor.clone(),
            ..Trajectory::new(system, &settings.effects, settings.record, asked)
        };
        trajectory.begin(T::default(), state, mode);
        Recorder {
            trajectory,
            before: Before {
                mode: mode.clone(),
                state: state.clone(),
                forces: vec![T::default(); rows],
                undetermined: Vec::with_capacity(rows),
            },
            forces_after: vec![T::default(); rows],
            undetermined_after: Vec::with_capacity(rows),
            awaited: Vec::new(),
            events_before: 0,
            work_before: dynamics::Work::default(),
            finished: false,
        }
    }
}

/// What was just before a switch.
#[derive(Clone, Debug)]
pub(super) struct Before<T> {
    pub mode: Mode,
    pub state: State<T>,
    pub forces: Vec<T>,
    pub undetermined: Vec<bool>,
}

impl<T: Scalar> Run<T> {
    pub(super) fn log_impacts(&mut self, outcome: &Impact<T>, facts: &SwitchFacts) {
        let before = &self.recorder.before;
        let contacts = 0..self.description().contacts.len();
        let struck = contacts.clone().any(|c| outcome.struck[c]);
        let hit = |c: &usize| facts.arriving[*c] && outcome.struck[*c];
        // What is held may have the whole impulse, and its friction push away what arrives.
        let by_held = struck && !contacts.clone().any(|c| hit(&c));
        for c in contacts.filter(|c| hit(c) || by_held && facts.arriving[*c]) {
            let d = self.description();
            let event = self.recorder.trajectory.events.reuse(|| Event::blank(d));
            let around = Around {
                before: &before.mode,
                after: &before.mode,
                state: &before.state,
                state_after: &self.now.state,
                forces: &before.forces,
                forces_after: &before.forces,
                undetermined: &before.undetermined,
                undetermined_after: &before.undetermined,
                impulses: &outcome.impulses,
            };
            event.write(self.now.t, Subject::Contact(c), EventKind::Impact, around);
            event.restitution_lowered = outcome.lowered;
            event.impulses_undetermined = outcome.undetermined;
            event.ambiguous = outcome.ambiguous;
            event.other_impacts.clone_from(&outcome.others);
        }
    }

    /// Logs what changes with the impacts at this instant, of these impulses, where the motion goes on in a mode in which it has been evaluated.
    pub(super) fn log_after_impacts(&mut self, impulses: &[T], ambiguous: bool) {
        let mut forces = core::mem::take(&mut self.recorder.forces_after);
        let mut undetermined = core::mem::take(&mut self.recorder.undetermined_after);
        self.reported_forces(&mut forces, &mut undetermined);
        (self.recorder.forces_after, self.recorder.undetermined_after) = (forces, undetermined);
        self.write_changes(impulses, ambiguous);
        self.recorder.trajectory.enter(&self.now.mode);
    }

    /// One entry per item whose state changed; frictions that come and go with their contact are not told apart.
    pub(super) fn log_changes(&mut self, impulses: &[T], ambiguous: bool) {
        if !self.dynamics.has_dependent_rows() {
            write_forces(&mut self.recorder.forces_after, |row| {
                let series = self.dynamics.force_series(row);
                series.first().copied().unwrap_or_default()
            });
            self.recorder.undetermined_after.clear();
        }
        self.write_changes(impulses, ambiguous);
    }

    /// Writes down what changes from the mode before to the present one, with the forces after it.
    fn write_changes(&mut self, impulses: &[T], ambiguous: bool) {
        let d = self.description();
        let (before, after) = (&self.recorder.before.mode, &self.now.mode);
        // The impacts of this instant end in the mode that has now been found.
        for event in self.recorder.trajectory.events.iter_mut().rev() {
            if event.kind != EventKind::Impact || event.time != self.now.t {
                break;
            }
            event.after.clone_from(after);
            event.forces_after.clone_from(&self.recorder.forces_after);
            event
                .undetermined_after
                .clone_from(&self.recorder.undetermined_after);
        }
        // What has only begun, and begins anew, turns where it goes back.
        let turns = |before: Direction, after: Direction| match (before, after) {
            (Direction::Incipient(a), Direction::Incipient(b)) => dot(a, b) < 0.0,
            (before, after) => before != after,
        };
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
                (FrictionMode::Slip(a), FrictionMode::Slip(b))
                    if turns(a.direction, b.direction) =>
                {
                    EventKind::Reverses
                }
                _ => return None,
            };
            Some((Subject::Friction(f), kind))
        });
        let branches = (0..d.branches.len())
            .filter(|&b| before.branch(b) != after.branch(b) && d.branch_moves(b))
            .map(|b| (Subject::Branch(b), EventKind::Branches));
        let around = Around {
            before,
            after,
            state: &self.recorder.before.state,
            state_after: &self.now.state,
            forces: &self.recorder.before.forces,
            forces_after: &self.recorder.forces_after,
            undetermined: &self.recorder.before.undetermined,
            undetermined_after: &self.recorder.undetermined_after,
            impulses,
        };
        let mut told = !ambiguous;
        for (subject, kind) in contacts.chain(frictions).chain(branches) {
            let event = self.recorder.trajectory.events.reuse(|| Event::blank(d));
            event.write(self.now.t, subject, kind, around);
            event.ambiguous = ambiguous;
            told = true;
        }
        if !told && let Some(subject) = at_issue(after) {
            let event = self.recorder.trajectory.events.reuse(|| Event::blank(d));
            event.write(self.now.t, subject, EventKind::Ambiguous, around);
            event.ambiguous = true;
        }
    }

    /// Logs a stop, a mark or an accumulation at the present state, which is that of the last value.
    pub(super) fn log_here(&mut self, subject: Subject, kind: EventKind) {
        let state = core::mem::take(&mut self.now.state);
        self.log_watch(subject, kind, self.now.t, &state);
        self.now.state = state;
    }

    /// Logs a stop, a mark or an accumulation: the mode and the `state` of the last value go on.
    pub(super) fn log_watch(
        &mut self,
        subject: Subject,
        kind: EventKind,
        time: T,
        state: &State<T>,
    ) {
        let mut forces = core::mem::take(&mut self.recorder.forces_after);
        let mut undetermined = core::mem::take(&mut self.recorder.undetermined_after);
        self.reported_forces(&mut forces, &mut undetermined);
        let around = Around {
            before: &self.now.mode,
            after: &self.now.mode,
            state,
            state_after: state,
            forces: &forces,
            forces_after: &forces,
            undetermined: &undetermined,
            undetermined_after: &undetermined,
            impulses: &[],
        };
        let d = self.description();
        let event = self.recorder.trajectory.events.reuse(|| Event::blank(d));
        event.write(time, subject, kind, around);
        (self.recorder.forces_after, self.recorder.undetermined_after) = (forces, undetermined);
    }

    /// Mode, state and forces of the last value, before they change.
    pub(super) fn remember_before(&mut self) {
        self.recorder.before.mode.clone_from(&self.now.mode);
        self.recorder.before.state.clone_from(&self.now.state);
        let mut forces = core::mem::take(&mut self.recorder.before.forces);
        let mut undetermined = core::mem::take(&mut self.recorder.before.undetermined);
        self.reported_forces(&mut forces, &mut undetermined);
        (
            self.recorder.before.forces,
            self.recorder.before.undetermined,
        ) = (forces, undetermined);
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
