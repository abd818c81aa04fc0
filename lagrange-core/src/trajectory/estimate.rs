//! How far two runs of one system are apart: at the end, and event by event.
//!
//! Errors of a coordinate or velocity x are |Δx| / max(1, |x|), relative where x is large and absolute, in its own unit, where it
//! is small; errors of times are the same in seconds. Where a coordinate has an absolute tolerance of its own, that size takes the place of 1.
//!
//! Rounding decides in which order a run finds what happens at one instant, so that this order is not compared; where it matters to the motion, what
//! follows tells. Marks do not change the motion: their order is not compared at all, and the difference of their times is their error.
//!
//! Impacts that accumulate are infinitely many, and how many of them a run
//! follows one by one depends on its tolerance: those that only one of two runs follows have the error of the instant at which
//! they end. The same holds of the last turns of contacts that come to rest in turn, infinitely often, each by
//! impacts that accumulate.

use super::{EventKind, State, Trajectory};
use crate::arithmetic::Scalar;
use crate::error::Error;
use crate::handle::Subject;
use crate::integrate::Method;
use crate::integrate::least_size;
use crate::shortest::Shortest;
use crate::system::Description;
use core::fmt;
use core::iter::repeat_n;

/// What happened to which item, and when, s.
type Happening = (Subject, EventKind, f64);

/// What is compared of a run.
#[derive(Clone, Debug)]
pub struct Summary {
    /// Names.
    pub description: &'static Description,
    /// What happened to which item, and when, s; in order.
    pub events: Vec<Happening>,
    /// Last time, s.
    pub time: f64,
    /// State at the end.
    pub state: State<f64>,
    /// Per coordinate: the size below which its errors are absolute; empty: 1 for all.
    pub sizes: Vec<f64>,
}

/// How far two runs are apart.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// |Δ| of every position and velocity at the end, each in its own unit; empty where the runs part.
    pub state: State<f64>,
    /// |Δt| of every event, s; up to where the runs part.
    pub events: Vec<f64>,
    /// Largest error of the final state; infinite where the runs part.
    pub state_error: f64,
    /// The coordinate (`theta`) or velocity (`der(theta)`) that has it.
    pub coordinate: String,
    /// Largest error of the time of an event, or of the end; `None` where nothing happens.
    pub event_error: Option<f64>,
    /// From where on the runs cannot be compared.
    pub parting: Option<Parting>,
}

/// Two runs part: something else happens in each.
#[derive(Clone, Debug, PartialEq)]
pub struct Parting {
    /// Time, s.
    pub time: f64,
    /// What happens in this run, `rim lost`, or `the end`.
    pub here: String,
    /// What happens in the other run.
    pub there: String,
}

/// How far off a run is, judged by another one.
#[derive(Clone, Debug, PartialEq)]
pub struct Estimate {
    /// Method of the other run, with its step if it has fixed ones.
    pub method: Method,
    /// Tolerance of the other run.
    pub tolerance: f64,
    /// How far the two are apart.
    pub difference: Difference,
}

/// Share of a time, s, or of a second: what goes on for longer than this is a motion, and neither one instant, of which two runs tell in another order,
/// nor the last turns after impacts have accumulated.
const INSTANT: f64 = 1e-4;

/// Until when it is the instant of this time.
fn end_of_instant(time: f64) -> f64 {
    time + INSTANT * time.abs().max(1.0)
}

fn accumulates((_, kind, _): &Happening) -> bool {
    matches!(kind, EventKind::Accumulates { .. })
}

fn is_mark((_, kind, _): &Happening) -> bool {
    matches!(kind, EventKind::Mark)
}

/// Whether the same happens to one item. How many impacts have accumulated depends on the tolerance.
fn is_same(a: &Happening, b: &Happening) -> bool {
    a.0 == b.0 && (a.1 == b.1 || accumulates(a) && accumulates(b))
}

/// The last change of mode of an item.
fn last_change(events: &[Happening], subject: Subject) -> Option<EventKind> {
    use EventKind::{Closed, Lost, Slips, Sticks};
    let changes = |kind: &EventKind| matches!(kind, Closed | Lost | Slips | Sticks);
    let mut before = events.iter().rev();
    let change = before.find(|(of, kind, _)| *of == subject && changes(kind));
    change.map(|event| event.1)
}

/// |Δ| / max(size, |x|)
fn relative(difference: f64, x: f64, size: f64) -> f64 {
    difference / x.abs().max(size)
}

impl Summary {
    /// What is compared of this run.
    pub fn of<T: Scalar>(record: &Trajectory<T>) -> Self {
        let events = record.events().iter();
        Summary {
            description: record.description(),
            events: events
                .map(|event| (event.subject, event.kind, event.time.value()))
                .collect(),
            time: record.last_time(),
            state: record.final_state().values(),
            sizes: record.asked.sizes.clone(),
        }
    }

    /// How far it is from another run of the same system.
    pub fn compare(&self, other: &Summary) -> Difference {
        let (events, event_error, parting) = self.compare_events(other);
        let mut difference = Difference {
            state: State::default(),
            events,
            state_error: f64::INFINITY,
            coordinate: String::new(),
            event_error,
            parting,
        };
        if difference.parting.is_none() {
            self.compare_states(other, &mut difference);
            let end = relative((self.time - other.time).abs(), self.time, 1.0);
            if end > 0.0 {
                difference.event_error = Some(event_error.map_or(end, |error| error.max(end)));
            }
        }
        difference
    }

    fn compare_states(&self, other: &Summary, difference: &mut Difference) {
        let apart = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b).abs()).collect();
        difference.state = State::new(
            apart(&self.state.q, &other.state.q),
            apart(&self.state.v, &other.state.v),
        );
        let names = || self.description.coordinates.iter().map(|c| c.name);
        let positions = names().map(str::to_owned);
        let names = positions.chain(names().map(|name| format!("der({name})")));
        let values = self.state.q.iter().chain(&self.state.v);
        let apart = difference.state.q.iter().chain(&difference.state.v);
        difference.state_error = 0.0;
        let coordinates = (0..self.state.q.len()).cycle();
        for (i, (name, (&apart, &x))) in coordinates.zip(names.zip(apart.zip(values))) {
            let error = relative(apart, x, least_size(&self.sizes, i));
            if error > difference.state_error || difference.coordinate.is_empty() {
                (difference.state_error, difference.coordinate) = (error, name);
            }
        }
    }

    /// |Δt| of each event, the largest error of them, and where the runs part.
    fn compare_events(&self, other: &Summary) -> (Vec<f64>, Option<f64>, Option<Parting>) {
        let (mut i, mut k) = (0, 0);
        let (mut differences, mut largest): (Vec<f64>, Option<f64>) = (Vec::new(), None);
        let mut other = other.clone();
        loop {
            other.bring_forward(k, self, i);
            let (here, there) = (self.events.get(i), other.events.get(k));
            let ends =
                |event: Option<&Happening>| event.filter(|e| accumulates(e)).map(|e| (e.0, e.2));
            let pair = if let Some(end) = ends(here).or(ends(there)) {
                let here = self.end_of_impacts(i, end);
                here.zip(other.end_of_impacts(k, end))
            } else {
                let same = here
                    .zip(there)
                    .is_some_and(|(a, b)| (a.0, a.1) == (b.0, b.1));
                same.then_some(((i, i + 1), (k, k + 1)))
            };
            let next = pair.map(|((event, i_next), (counterpart, k_next))| {
                let apart = self.events[event].2 - other.events[counterpart].2;
                ((i_next, k_next), apart.abs(), self.events[event].2)
            });
            let next = next.or_else(|| self.last_turns(i, &other, k));
            let Some(((i_next, k_next), apart, time)) = next else {
                let parting = (here.is_some() || there.is_some()).then(|| Parting {
                    time: here.or(there).map_or(self.time, |event| event.2),
                    here: self.words(i),
                    there: other.words(k),
                });
                return (differences, largest, parting);
            };
            differences.extend(repeat_n(apart, i_next - i));
            let error = relative(apart, time, 1.0);
            largest = Some(largest.map_or(error, |largest| largest.max(error)));
            (i, k) = (i_next, k_next);
        }
    }

    /// Brings the counterpart of event `i` of another run forward to place `k`, if something else stands there that has a counterpart too.
    fn bring_forward(&mut self, k: usize, other: &Summary, i: usize) {
        let heads = self.events.get(k).zip(other.events.get(i));
        if heads.is_none_or(|(a, b)| is_same(a, b)) || other.counterpart(i, self, k).is_none() {
            return;
        }
        if let Some(found) = self.counterpart(k, other, i) {
            self.events[k..=found].rotate_right(1);
        }
    }

    /// Where this run has, from event `from` on, event `at` of another one: each is the nearest to the other. It may come after what happens to others at
    /// the same instant, and a mark after anything, and anything after marks.
    fn counterpart(&self, from: usize, other: &Summary, at: usize) -> Option<usize> {
        let event = &other.events[at];
        let found = self.nearest(from, event)?;
        let mut passed = self.events[from..found].iter();
        let instant = |e: &Happening| self.events[found].2 <= end_of_instant(e.2);
        let may_come_first = |e: &Happening| is_mark(event) || is_mark(e) || instant(e);
        let is_mutual = other.nearest(at, &self.events[found]) == Some(at);
        (is_mutual && passed.all(may_come_first)).then_some(found)
    }

    /// Of what is the same as this event, from `from` on, the nearest in time: as times ascend, distances fall and then rise.
    fn nearest(&self, from: usize, event: &Happening) -> Option<usize> {
        let off = |at: usize| (self.events[at].2 - event.2).abs();
        let mut same = (from..self.events.len()).filter(|&at| is_same(&self.events[at], event));
        let mut nearest = same.next()?;
        while let Some(next) = same.next().filter(|&next| off(next) < off(nearest)) {
            nearest = next;
        }
        Some(nearest)
    }

    /// The end of infinitely many impacts from event `from` on that is nearest to that of a contact in another run, and the first event after
    /// its instant. A contact whose last impact leaves it closed has made finitely many.
    fn end_of_impacts(
        &self,
        from: usize,
        (contact, time): (Subject, f64),
    ) -> Option<(usize, usize)> {
        let coming = &self.events[from..];
        let closes = |event: &Happening| (event.0, event.1) == (contact, EventKind::Closed);
        let ends = coming.iter().enumerate();
        let ends = ends.filter(|(_, event)| accumulates(event) || closes(event));
        let off = |event: &Happening| (event.2 - time).abs();
        let (found, _) = ends.min_by(|a, b| off(a.1).total_cmp(&off(b.1)))?;
        let time = coming[found].2;
        let after = coming[found..].iter().take_while(|event| event.2 == time);
        Some((from + found, from + found + after.count()))
    }

    /// Where contacts come to rest in turn, from event `i` of this run and `k` of another one: the first events after that, how far apart the ends of it
    /// are, and when it ends. Both runs end in the same mode.
    fn last_turns(
        &self,
        i: usize,
        other: &Summary,
        k: usize,
    ) -> Option<((usize, usize), f64, f64)> {
        let first = [self.events.get(i), other.events.get(k)];
        let begin = first.into_iter().flatten().map(|event| event.2);
        let until = end_of_instant(begin.min_by(f64::total_cmp)?);
        let (i_next, k_next) = (self.after_turns(i, until), other.after_turns(k, until));
        let (here, there) = (&self.events[..i_next], &other.events[..k_next]);
        let told = || here[i..].iter().chain(&there[k..]);
        let mut events = here.iter().chain(there);
        let in_turn =
            events.any(|event| accumulates(event) && told().any(|told| told.0 == event.0));
        let alike =
            |&(subject, ..): &Happening| last_change(here, subject) == last_change(there, subject);
        if !in_turn || !told().all(alike) {
            return None;
        }
        let end = here.last()?.2;
        Some(((i_next, k_next), (end - there.last()?.2).abs(), end))
    }

    /// The first event from `from` on that is later than this, or none of a contact or of its friction.
    fn after_turns(&self, from: usize, time: f64) -> usize {
        let switches = self.events[from..]
            .iter()
            .take_while(|(subject, kind, at)| {
                matches!(subject, Subject::Contact(_) | Subject::Friction(_))
                    && *kind != EventKind::Ambiguous
                    && *at <= time
            });
        from + switches.count()
    }

    /// `rim lost`, or `the end`.
    pub fn words(&self, index: usize) -> String {
        match self.events.get(index) {
            None => "the end".to_owned(),
            Some((subject, kind, _)) => format!("{} {kind}", subject.name(self.description)),
        }
    }
}

impl Difference {
    /// The larger of the errors of the final state and of the times; infinite where the runs part.
    pub fn error(&self) -> f64 {
        self.state_error.max(self.event_error.unwrap_or(0.0))
    }

    /// The other run ended early, at `time`.
    pub(crate) fn ends(&mut self, time: f64, error: &Error) {
        self.state_error = f64::INFINITY;
        self.parting = Some(Parting {
            time,
            here: "the motion goes on".to_owned(),
            there: error.to_string(),
        });
    }
}

impl fmt::Display for Parting {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Parting { time, here, there } = self;
        write!(f, "t = {}: {here} here, {there} there", Shortest(*time))
    }
}

/// One line for people.
impl fmt::Display for Estimate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let other = match self.method {
            method @ (Method::RungeKutta4 { .. } | Method::Gauss6 { .. }) => format!("by {method}"),
            _ => format!("at tolerance {:.0e}", self.tolerance),
        };
        let difference = &self.difference;
        if let Some(parting) = &difference.parting {
            return write!(
                f,
                "Error: known only until t = {:.6} s; from there on {} here, but {} in a run {other}.",
                parting.time, parting.here, parting.there
            );
        }
        let figure = |error: f64| match error < 1e-15 {
            true => "less than 1e-15".to_owned(),
            false => format!("about {error:.1e}"),
        };
        let state = figure(difference.state_error);
        write!(
            f,
            "Error: {state} in the final state (`{}`)",
            difference.coordinate
        )?;
        if let Some(error) = difference.event_error {
            write!(f, ", {} in the times of events", figure(error))?;
        }
        write!(f, ", the difference from a run {other}.")
    }
}
