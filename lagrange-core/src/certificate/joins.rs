//! How steps join: the motion goes on in the state where the step before ended, or where an impact has left it.

use super::Subject;
use super::motion::Examination;
use crate::arithmetic::Scalar;
use crate::integrate::least_size;
use crate::mode::FrictionMode;
use crate::system::Friction;
use crate::trajectory::{EventKind, State};

impl<T: Scalar> Examination<'_, T> {
    /// A slip of two components comes to rest a moment after the step before: until then the motion goes on as that step ends, unless it ends
    /// with an impact, the last before infinitely many that take this time.
    pub(super) fn bridge(&mut self, k: usize) {
        let record = self.record;
        let Some(before) = k.checked_sub(1).map(|k| &record.segments[k]) else {
            return;
        };
        let left = record.segments[k].t.value() - self.time;
        let d = record.description();
        let slips = |(state, friction): (&FrictionMode, &Friction)| {
            matches!(state, FrictionMode::Slip(_)) && friction.components > 1
        };
        let mut frictions = self.modes[before.mode].frictions.iter().zip(d.frictions);
        let next = record.events().get(self.events);
        let ends = next.is_some_and(|event| event.time.value() <= self.time);
        if ends || !(left > 0.0 && frictions.any(slips)) {
            return;
        }
        self.enter(before);
        if self.accelerate(before, before.end, false).is_err() {
            return;
        }
        // The direction of what is left of a slip follows the forces at once: a step of the linearly implicit method of Euler.
        let rates = self.expected.v.iter().zip(&self.acceleration);
        let errors = self.errors.q.iter_mut().zip(&mut self.errors.v);
        for ((dq, dv), (v, a)) in errors.zip(rates) {
            (*dq, *dv) = (left * v, left * a.value());
        }
        if self.damp(before, before.end.value(), left).is_err() {
            return;
        }
        let State { q, v, .. } = &mut self.expected;
        for ((q, v), change) in q.iter_mut().zip(v).zip(&self.errors.v) {
            *q += left * (*v + 0.5 * change);
            *v += change;
        }
    }

    /// Goes through the events up to a time, when the motion goes on in the state `begin`: impacts change the state that is
    /// expected. Of those at that very time some come after the next step, if it does not advance the time: that begins nearer to the state
    /// expected than to what they leave.
    pub(super) fn events_until(
        &mut self,
        time: f64,
        begin: &State<f64>,
        first: bool,
        advances: bool,
    ) {
        let record = self.record;
        while let Some(event) = record.events().get(self.events) {
            let now = event.time.value();
            if now > time || now == time && !advances && self.precedes_events(begin, now) {
                break;
            }
            let repeats = self.events > 0 && {
                let before = &record.events()[self.events - 1];
                before.time == event.time
                    && before.state == event.state
                    && before.state_after == event.state_after
            };
            self.events += 1;
            let when = event.time.value();
            match event.kind {
                EventKind::Mark => {}
                EventKind::Impact | EventKind::Accumulates { .. } if !repeats => {
                    let found = event.state.values();
                    if let EventKind::Accumulates { .. } = event.kind {
                        // The impacts that are not followed change velocities evenly until they have ended, for a time that is known as both its ends
                        // are.
                        let left = when - self.time;
                        let known = self.finest * when.abs();
                        let positions = self.expected.q.iter_mut().zip(&mut self.rounding);
                        let velocities = self.expected.v.iter().zip(&found.v);
                        for ((q, rounding), (v, after)) in positions.zip(velocities) {
                            *q += 0.5 * (v + after) * left;
                            *rounding += v.abs() * known;
                        }
                        self.expected.v.clone_from(&found.v);
                        self.time = when;
                    }
                    if !first {
                        self.join(when, &found);
                    }
                    if event.kind == EventKind::Impact {
                        let later = record.events()[self.events..].iter();
                        let mut others = later.take_while(|other| other.time == event.time);
                        let follows = others.any(|other| {
                            other.kind == EventKind::Impact && other.state != event.state
                        });
                        self.impact(event, follows);
                    }
                    self.expected = event.state_after.values();
                }
                _ => {}
            }
        }
    }

    /// Whether a step that begins so is nearer to the state expected than to what any of the events at that time leaves.
    fn precedes_events(&self, begin: &State<f64>, now: f64) -> bool {
        let events = self.record.events()[self.events..].iter();
        let at_once = events.take_while(|event| event.time.value() == now);
        let jumps = |kind| matches!(kind, EventKind::Impact | EventKind::Accumulates { .. });
        let mut jumps = at_once.filter(|event| jumps(event.kind));
        let expected = self.distance(begin, &self.expected);
        jumps.all(|event| expected <= self.distance(begin, &event.state_after.values()))
    }

    /// How far two states are from one another, in units of their sizes.
    fn distance(&self, a: &State<f64>, b: &State<f64>) -> f64 {
        let sizes = &self.record.asked.sizes;
        let square = |(i, (a, b)): (usize, (&f64, &f64))| {
            let size = least_size(sizes, i) + a.abs().max(b.abs());
            ((a - b) / size).powi(2)
        };
        let positions = a.q.iter().zip(&b.q).enumerate();
        let velocities = a.v.iter().zip(&b.v).enumerate();
        positions.chain(velocities).map(square).sum()
    }

    /// How large the state has been in a step.
    pub(super) fn take_reach(&mut self) {
        self.rounding.fill(0.0);
        let lists = [
            (&mut self.reached.q, &self.begin.q, &self.last.q),
            (&mut self.reached.v, &self.begin.v, &self.last.v),
        ];
        for (reached, begin, last) in lists {
            for i in 0..begin.len() {
                reached[i] = begin[i].abs().max(last[i].abs());
            }
        }
    }

    /// The motion goes on in the state where it was. Where that is near zero a step that comes from afar has it to the tolerance of the way.
    pub(super) fn join(&mut self, time: f64, found: &State<f64>) {
        let (expected, reached) = (&self.expected, &self.reached);
        let q = (&expected.q, &reached.q, &found.q);
        let v = (&expected.v, &reached.v, &found.v);
        let q = (&mut self.errors.q, &mut self.sizes.q, q);
        let v = (&mut self.errors.v, &mut self.sizes.v, v);
        for (errors, sizes, (expected, reached, found)) in [q, v] {
            for i in 0..found.len() {
                errors[i] = (found[i] - expected[i]).abs();
                sizes[i] = found[i].abs().max(reached[i]);
            }
        }
        for (error, rounding) in self.errors.q.iter_mut().zip(&self.rounding) {
            // What is no number stays so.
            *error -= rounding.min(*error);
        }
        let components = (2.0 * found.q.len() as f64).sqrt();
        self.book(Subject::Joins, time, components);
    }
}
