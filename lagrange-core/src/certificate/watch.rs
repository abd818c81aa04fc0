//! Gaps, stops and marks along the motion, also between the instants that are looked at.
//!
//! Where a guard has an extremum between three neighbouring instants it is looked at once more where the parabola through them has
//! it, if the parabola crosses zero there.

use super::equations::{Equations, Situation};
use super::{Findings, Subject};
use crate::arithmetic::Scalar;
use crate::declaration::Declaration;
use crate::effects::Item;
use crate::mode::{FrictionMode, Mode};
use crate::system::{Condition, Watch};
use crate::trajectory::{self, Trajectory};

/// What is followed along the motion.
#[derive(Debug)]
pub(super) struct Watches {
    guards: Vec<Guard>,
    /// Times of logged marks, by mark.
    marks: Vec<Vec<f64>>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Gap(usize),
    Stop(usize),
    Mark(usize),
}

/// A guard and its last values, with their times.
#[derive(Debug)]
struct Guard {
    kind: Kind,
    /// Whether a stop has been false.
    armed: bool,
    last: Vec<(f64, f64)>,
}

impl Watches {
    pub fn new<T: Scalar>(record: &Trajectory<T>, declaration: &Declaration) -> Self {
        let d = record.description();
        let known = |list: &[Option<_>], i: usize| list.get(i).is_some_and(Option::is_some);
        let gaps = (0..declaration.contacts.len()).map(|c| (Kind::Gap(c), Item::Contact(c)));
        let stops = (0..d.stops.len()).filter(|&i| known(declaration.stops, i));
        let stops = stops.map(|i| (Kind::Stop(i), Item::Stop(i)));
        let marks = (0..d.marks.len()).filter(|&i| known(declaration.marks, i));
        let marks = marks.map(|i| (Kind::Mark(i), Item::Mark(i)));
        let all = gaps.chain(stops).chain(marks);
        let taking = all.filter(|(_, item)| record.effects.includes(d, *item));
        let guards = taking.map(|(kind, _)| Guard {
            kind,
            armed: false,
            last: Vec::new(),
        });
        let times = |i: usize| {
            let events = record.events().iter();
            let own = events.filter(|e| e.subject == trajectory::Subject::Mark(i));
            own.map(|e| e.time.value()).collect()
        };
        Self {
            guards: guards.collect(),
            marks: (0..d.marks.len()).map(times).collect(),
        }
    }

    /// Whether there is nothing to follow in a mode.
    pub fn is_idle(&self, mode: &Mode) -> bool {
        let closed = |guard: &Guard| matches!(guard.kind, Kind::Gap(c) if mode.contacts[c]);
        self.guards.iter().all(closed)
    }

    /// The motion has jumped or is in another mode.
    pub fn forget(&mut self) {
        self.guards.iter_mut().for_each(|guard| guard.last.clear());
    }

    /// Looks at the state that `equations` has taken; adds the times at which to look again.
    pub fn see(
        &mut self,
        equations: &mut Equations,
        findings: &mut Findings,
        (at, mode): (Situation<'_>, &Mode),
        passed: &mut [bool],
        again: &mut Vec<f64>,
    ) {
        let d = equations.d;
        for guard in &mut self.guards {
            let Some((value, term)) = guard.kind.value(equations, mode) else {
                guard.last.clear();
                continue;
            };
            if let Kind::Gap(c) = guard.kind {
                passed[c] = equations.has_passed(c, value, passed[c]);
            }
            // What is as it should be is not measured.
            let mut book = |subject, error: f64, name| {
                let reach = if error > 0.0 {
                    equations.reach(term, 0, at)
                } else {
                    0.0
                };
                // Forces do not follow from the state alone.
                let reach = if reach > 0.0 { reach } else { 1.0 };
                findings.book(subject, error, reach, at.time, name);
            };
            let from = guard.last.last().copied();
            match guard.kind {
                Kind::Gap(c) if !passed[c] => {
                    book(Subject::Gaps, -value, d.contacts[c].name);
                }
                Kind::Gap(_) => {}
                Kind::Stop(i) => {
                    if guard.armed {
                        book(Subject::Stops, value, d.stops[i].name);
                    }
                    guard.armed |= value < 0.0;
                }
                Kind::Mark(i) => {
                    if let Some((before, earlier)) = from {
                        let zeros = d.marks[i].zeros;
                        let crossed = earlier < 0.0 && value > 0.0;
                        let crossed = crossed || zeros && earlier > 0.0 && value < 0.0;
                        let blur = 1e-9 * (at.time - before);
                        let near = before - blur..=at.time + blur;
                        let logged = self.marks[i].iter().any(|t| near.contains(t));
                        let missed = crossed && !logged;
                        let error = if missed {
                            earlier.abs().min(value.abs())
                        } else {
                            0.0
                        };
                        book(Subject::Marks, error, d.marks[i].name);
                    }
                }
            }
            again.extend(guard.remember(at.time, value));
        }
    }
}

impl Guard {
    /// Keeps the last three values; where the parabola through them has an extremum beyond zero.
    fn remember(&mut self, time: f64, value: f64) -> Option<f64> {
        self.last.push((time, value));
        let &[(t0, a), (t1, b), (t2, c)] = self.last.last_chunk::<3>()?;
        self.last.remove(0);
        let extreme = (b - a) * (c - b) < 0.0 && (b < a) == (b > 0.0);
        if !extreme {
            return None;
        }
        let (left, right) = ((b - a) / (t1 - t0), (c - b) / (t2 - t1));
        let bend = (right - left) / (t2 - t0);
        let slope = left + bend * (t1 - t0);
        let shift = -slope / (2.0 * bend);
        let lowest = b + slope * shift + bend * shift * shift;
        (lowest * b < 0.0).then_some(t1 + shift)
    }
}

impl Kind {
    /// The value of a guard and which it is; of a gap while its contact is open. Stops and marks are true where it is ≥ 0.
    fn value(self, equations: &Equations, mode: &Mode) -> Option<(f64, usize)> {
        let (declaration, d) = (equations.declaration, equations.d);
        let value = |term: usize| equations.values.value(term);
        let terms = match self {
            Kind::Gap(c) if mode.contacts[c] => return None,
            Kind::Gap(c) => {
                let gap = declaration.contacts[c].gap;
                return Some((value(gap), gap));
            }
            Kind::Stop(i) if !holds(&d.stops[i], mode) => return None,
            Kind::Mark(i) if !holds(&d.marks[i], mode) => return None,
            Kind::Stop(i) => declaration.stops[i]?,
            Kind::Mark(i) => declaration.marks[i]?,
        };
        let values = terms.iter().map(|&term| (value(term), term));
        values.min_by(|a, b| a.0.total_cmp(&b.0))
    }
}

/// Whether the mode is as the conditions of a stop or mark say.
fn holds(watch: &Watch, mode: &Mode) -> bool {
    watch.conditions.iter().all(|condition| match *condition {
        Condition::Closed(c) => mode.contacts[c],
        Condition::Open(c) => !mode.contacts[c],
        Condition::Sticks(f) => mode.frictions[f] == FrictionMode::Stick,
        Condition::Slips(f) => matches!(mode.frictions[f], FrictionMode::Slip(_)),
    })
}
