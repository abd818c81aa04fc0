//! Outcome → lines of the story: its start, a line for each switch, its end.

use crate::outcome::{Force, Outcome, Sample};
use crate::report::words::{FEW, MANY, Names, changed};
use lagrange_core::mode::Mode;
use lagrange_core::prelude::*;
use lagrange_core::system::Description;

/// One line of the story, before it is laid out.
pub(super) struct Line {
    pub time: f64,
    /// How far off the time is, s.
    pub error: Option<f64>,
    pub event: String,
    /// Coordinates and outputs; `None` between two events of one instant, where outputs are not known.
    pub state: Vec<Option<f64>>,
    /// Force or impulse per force, above and below; `None` where it does not act.
    pub upper: Vec<Option<f64>>,
    pub lower: Vec<Option<f64>>,
    pub impulse: bool,
    pub mode: String,
    /// So many lines like it, before it, are left out.
    pub left_out: usize,
}

/// So many impacts of one contact in a row are told one by one.
const SERIES: usize = 8;

/// Of a longer series of impacts in one mode the first line and the last.
fn folded(lines: Vec<Line>) -> Vec<Line> {
    let goes_on = |a: &Line, b: &Line| {
        let one = a.impulse && b.impulse && a.event == b.event;
        one && a.mode.is_empty()
    };
    let series = lines.chunk_by(goes_on).map(<[Line]>::len);
    let series: Vec<usize> = series.collect();
    let mut lines = lines.into_iter();
    let mut folded = Vec::new();
    for count in series {
        if count <= SERIES {
            folded.extend(lines.by_ref().take(count));
            continue;
        }
        folded.extend(lines.next());
        folded.extend(lines.nth(count - 2).map(|last| Line {
            left_out: count - 2,
            ..last
        }));
    }
    folded
}

/// The lines of an outcome, with the forces of these `items`.
pub(super) fn lines(outcome: &Outcome, items: &[Force]) -> Vec<Line> {
    let names = Names::of(outcome, []);
    let teller = Teller {
        outcome,
        items,
        names,
    };
    let groups = instants(&outcome.events);
    let first = groups.first().map(|(_, group)| *group);
    let first = first.filter(|group| outcome.is_decided_at_start(&group[0]));
    // An impact at the start is told by itself, after what was before it.
    let decided = first.is_some_and(|group| group[0].kind != EventKind::Impact);
    let start = outcome.first().map(|sample| match first {
        Some(group) => teller.decided_start(sample, group),
        None => teller.instant(sample, "start"),
    });
    let told = groups.iter().skip(usize::from(decided));
    let switches = told.filter_map(|(index, group)| teller.switch(*index, group));
    let mut lines: Vec<Line> = start.into_iter().chain(switches).collect();
    lines.extend(teller.end());
    folded(lines)
}

/// What the lines are told of.
struct Teller<'a> {
    outcome: &'a Outcome,
    items: &'a [Force],
    names: Names,
}

impl Teller<'_> {
    /// The forces that act in a mode.
    fn acting(&self, rows: &[f64], mode: &Mode) -> Vec<Option<f64>> {
        let description = self.outcome.description;
        let items = self.items.iter();
        items
            .map(|item| item.acts(description, mode).then(|| rows[item.row]))
            .collect()
    }

    /// Coordinates, and outputs where there is a sample.
    fn known(&self, q: &[f64], sample: Option<&Sample>) -> Vec<Option<f64>> {
        let outputs = 0..self.outcome.description.observes.len();
        let outputs = outputs.map(|i| Some(sample?.observes[i]));
        q.iter().copied().map(Some).chain(outputs).collect()
    }

    /// The sample just before an event.
    fn before(&self, index: usize) -> Option<&Sample> {
        self.outcome.around.get(index)?[0].as_ref()
    }

    /// The motion at a sample, where nothing switches.
    fn instant(&self, sample: &Sample, event: &str) -> Line {
        Line {
            time: sample.time,
            error: None,
            event: event.to_owned(),
            state: self.known(&sample.state.q, Some(sample)),
            upper: self.acting(&sample.forces, &sample.mode),
            lower: Vec::new(),
            impulse: false,
            mode: self.names.brief(&sample.mode),
            left_out: 0,
        }
    }

    /// The start, where the mode is decided by these first events: after them, or before them if they are an impact.
    fn decided_start(&self, sample: &Sample, group: &[Event<f64>]) -> Line {
        let description = self.outcome.description;
        let (start, event) = (self.instant(sample, "start"), &group[0]);
        match event.kind {
            EventKind::Impact => Line {
                state: self.known(&event.state.q, self.before(0)),
                upper: self.acting(&event.forces, &event.before),
                mode: self.names.brief(&event.before),
                ..start
            },
            _ => Line {
                event: format!("start\n{}", named(group, description)),
                upper: self.acting(&event.forces_after, &event.after),
                mode: self.names.brief(&event.after),
                ..start
            },
        }
    }

    /// The events of one switch, of which the first has this index.
    fn switch(&self, index: usize, group: &[Event<f64>]) -> Option<Line> {
        let (outcome, event) = (self.outcome, group.first()?);
        let description = outcome.description;
        let impulse = event.kind == EventKind::Impact;
        // What an impact changes is told by the events that follow at its instant, where there are any.
        let next = outcome.events.get(index + group.len());
        let told_next = next.is_some_and(|next| {
            (next.time, &next.before, &next.after) == (event.time, &event.before, &event.after)
        });
        let changed = changed(&event.before, &event.after, description);
        let changed = changed.filter(|_| !(impulse && told_next));
        let impulses = || {
            let rows = self.items.iter().map(|item| event.impulses[item.row]);
            rows.map(|j| Some(j).filter(|j| *j != 0.0)).collect()
        };
        let errors = outcome.estimate.as_ref();
        let errors = errors.map_or(&[][..], |estimate| &estimate.difference.events);
        let errors = errors.iter().skip(index).take(group.len());
        Some(Line {
            time: event.time,
            error: errors.copied().reduce(f64::max),
            event: named(group, description),
            state: self.known(&event.state.q, self.before(index)),
            upper: match impulse {
                true => impulses(),
                false => self.acting(&event.forces, &event.before),
            },
            lower: match impulse || changed.is_none() {
                true => Vec::new(),
                false => self.acting(&event.forces_after, &event.after),
            },
            impulse,
            mode: match (changed, event.kind) {
                (Some(changed), _) if impulse => format!("→ {changed}"),
                (Some(changed), _) => format!("\n→ {changed}"),
                (None, EventKind::Stop) => self.names.brief(&event.after),
                (None, _) => String::new(),
            },
            left_out: 0,
        })
    }

    /// The end, unless it is an event.
    fn end(&self) -> Option<Line> {
        let outcome = self.outcome;
        let last = outcome.events.last();
        if last.is_some_and(|event| event.kind == EventKind::Stop) {
            return None;
        }
        let how = match outcome.failure {
            None => "end",
            Some(Error::Interrupted { .. }) => "interrupted",
            Some(_) => "failed",
        };
        Some(self.instant(outcome.last()?, how))
    }
}

/// Events that are one switch, each with the index of its first: all that happens at one instant between the same modes and states.
pub(super) fn instants(events: &[Event<f64>]) -> Vec<(usize, &[Event<f64>])> {
    let is_impact = |event: &Event<f64>| event.kind == EventKind::Impact;
    let one = |a: &Event<f64>, b: &Event<f64>| {
        (a.time, is_impact(a)) == (b.time, is_impact(b))
            && (&a.before, &a.after) == (&b.before, &b.after)
            && (&a.state, &a.state_after) == (&b.state, &b.state_after)
    };
    let mut index = 0;
    let groups = events.chunk_by(one).map(|group| {
        index += group.len();
        (index - group.len(), group)
    });
    groups.collect()
}

/// What happens in one switch, a line each; of many events the first ones.
fn named(group: &[Event<f64>], description: &'static Description) -> String {
    let told = match group.len() > FEW {
        true => MANY,
        false => group.len(),
    };
    let name = |event: &Event<f64>| format!("{} {}", event.subject.name(description), event.kind);
    let mut lines: Vec<String> = group[..told].iter().map(name).collect();
    if group.len() > told {
        lines.push(format!("and {} more", group.len() - told));
    }
    lines.join("\n")
}
