//! Normal forces that grow without bound: friction that slips presses its contact on, and that the friction.
//!
//! Where the normal force of a contact follows from b/p, and the friction on it takes p through zero, forces may become as large as they like within a
//! finite time (Painlevé 1895; Génot & Brogliato 1999, European Journal of Mechanics A 18, 653). No step reaches that instant.

use super::Run;
use crate::arithmetic::Scalar;
use crate::error::Error;
use crate::mode::FrictionMode;
use crate::trajectory::State;

/// A force that grows without bound has become so many times as large as where its mode began.
const LARGE: f64 = 10.0;

/// A force that grows without bound grew in each of so many steps before the mode ends.
const STEPS: usize = 4;

/// Friction does not make it where it is more than this share of it without.
const BY_ITSELF: f64 = 0.5;

impl<T: Scalar> Run<T> {
    /// The error that names the contact whose force grows without bound, if that is why the motion came to this `error`.
    pub(super) fn jammed_contact(&mut self, error: &Error) -> Option<Error> {
        if !matches!(error, Error::StepTooSmall { .. } | Error::Singular { .. }) {
            return None;
        }
        let d = self.description();
        let rubs = |c: usize| {
            let mut frictions = d.frictions.iter().zip(&self.now.mode.frictions);
            frictions.any(|(friction, state)| {
                friction.normal.is_of(c) && matches!(state, FrictionMode::Slip(_))
            })
        };
        let pressed = (0..d.contacts.len()).filter(|&c| self.now.mode.contacts[c] && rubs(c));
        let pressed: Vec<usize> = pressed.collect();
        if pressed.is_empty() {
            return None;
        }
        let looks = self.forces_in_mode(&pressed)?;
        let grows = |k: &usize| {
            let force = |look: &Vec<f64>| look[*k].abs();
            let latest = looks[looks.len() - STEPS - 1..].windows(2);
            let mut latest = latest.map(|pair| [force(&pair[0]), force(&pair[1])]);
            latest.all(|[before, after]| after > before)
                && force(&looks[looks.len() - 1]) > LARGE * force(&looks[0])
        };
        let last = &looks[looks.len() - 1];
        let k = (0..pressed.len()).filter(grows).find(|&k| {
            let smooth = self.force_without_friction(pressed[k]);
            smooth.is_some_and(|smooth| smooth.abs() < BY_ITSELF * last[k].abs())
        })?;
        Some(Error::Unbounded {
            time: self.now.t.value(),
            mode: self.mode_in_words(),
            item: d.contacts[pressed[k]].name,
            from: looks[0][k],
            to: last[k],
        })
    }

    /// The force of contact `c` at the present state if nothing rubbed on it.
    fn force_without_friction(&mut self, c: usize) -> Option<f64> {
        let d = self.description();
        let mut mode = self.now.mode.clone();
        for (friction, state) in d.frictions.iter().zip(&mut mode.frictions) {
            if friction.normal.is_of(c) {
                *state = FrictionMode::Inactive;
            }
        }
        self.dynamics.set_mode(&mode);
        let State { q, v, .. } = &self.now.state;
        self.dynamics.value(self.now.t, q, v).ok()?;
        Some(self.dynamics.force(d.contacts[c].row).value())
    }

    /// The forces of these contacts where the present mode began, where each of the last steps in it did, and now. `None` where there are not so
    /// many, as where nothing is recorded.
    fn forces_in_mode(&mut self, contacts: &[usize]) -> Option<Vec<Vec<f64>>> {
        let d = self.description();
        let record = &self.recorder.trajectory;
        let segments = &record.segments;
        let last = segments.last().filter(|_| record.recorded)?.mode;
        let is_under_way = record.modes[last].under_way() == self.now.mode.under_way();
        let in_mode = segments.iter().rev();
        let in_mode = in_mode.take_while(|segment| segment.mode == last).count();
        if !is_under_way || in_mode < STEPS {
            return None;
        }
        let first = segments.len() - in_mode;
        let latest = segments.len() - STEPS..segments.len();
        let mut places = Vec::with_capacity(STEPS + 2);
        let mut scratch = self.now.state.clone();
        for k in core::iter::once(first).chain(latest) {
            let State { q, v, .. } = &mut scratch;
            record.state_at(&segments[k], T::zero(), q, v);
            places.push((segments[k].t, scratch.clone()));
        }
        places.push((self.now.t, self.now.state.clone()));
        self.dynamics.set_mode(&self.now.mode);
        let look = |(t, State { q, v, .. }): (T, State<T>)| {
            self.dynamics.value_along(t, &q, &v).ok()?;
            let force = |c: &usize| self.dynamics.force(d.contacts[*c].row).value();
            Some(contacts.iter().map(force).collect())
        };
        places.into_iter().map(look).collect()
    }
}
