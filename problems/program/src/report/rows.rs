//! Outcome → the rows of a table over time, for [`csv`](super::csv) (which tells the columns), [`jsonl`](super::jsonl) and
//! [`parquet`](super::parquet): one per sample, two (before and after) per event, in order of time.
//!
//! Between two events at one instant, and before one at the start, energies and what is observed are not known; work is not known
//! just before an event.

use super::{Kind, work_name};
use crate::notation::{rate_unit, velocity_name};
use crate::outcome::{Force, Outcome, Sample, forces};
use lagrange_core::prelude::*;

/// A column.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Column {
    /// Name, without a unit.
    pub name: String,
    /// Unit; empty where none is known.
    pub unit: String,
    /// What it holds.
    pub kind: Kind,
}

/// An element of a row.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Cell {
    /// A number.
    Number(f64),
    /// A text.
    Text(String),
    /// Nothing.
    Nothing,
}

/// A row, and what it is about.
pub(super) enum Row<'a> {
    /// A sample, with its number.
    Sample(usize, &'a Sample),
    /// The instant before an event, with its number.
    Before(usize, &'a Event<f64>),
    /// The instant after it.
    After(usize, &'a Event<f64>),
}

/// Reads rows of a run.
pub(super) struct Table<'a> {
    outcome: &'a Outcome,
    forces: Vec<Force>,
    /// The items of the ledger over time; none if it was not asked for.
    works: &'a [Entry],
}

impl<'a> Table<'a> {
    pub(super) fn new(outcome: &'a Outcome) -> Self {
        Self {
            outcome,
            forces: forces(outcome.description),
            works: outcome.ledgers.first().map_or(&[], |ledger| &ledger.work),
        }
    }

    /// All columns.
    pub(super) fn columns(&self) -> Vec<Column> {
        let d = self.outcome.description;
        let column = |name: &str, unit: &str, kind| Column {
            name: name.to_owned(),
            unit: unit.to_owned(),
            kind,
        };
        let number = |name: &str, unit: &str| column(name, unit, Kind::Number);
        let maybe = |name: &str, unit: &str| column(name, unit, Kind::MaybeNumber);
        let energy = d.units.energy;
        let mut columns = vec![number("t", "s"), column("event", "", Kind::MaybeText)];
        columns.extend(d.coordinates.iter().map(|c| number(c.name, c.unit)));
        let rate = |c: &lagrange_core::system::Coordinate| {
            number(&velocity_name(c.name), &rate_unit(c.unit))
        };
        columns.extend(d.coordinates.iter().map(rate));
        let force =
            |force: &Force| number(&format!("force({})", force.name), d.units.row(force.row));
        columns.extend(self.forces.iter().map(force));
        columns.extend(["kinetic", "potential"].map(|name| maybe(name, energy)));
        let work = |entry: &Entry| maybe(&format!("work({})", work_name(entry)), energy);
        columns.extend(self.works.iter().map(work));
        let mode = column("mode", "", Kind::Text);
        // No two columns have one name: an output may be called as a coordinate or an energy is.
        let mut taken: Vec<String> = columns.iter().map(|column| column.name.clone()).collect();
        taken.push(mode.name.clone());
        columns.extend(
            d.observes
                .iter()
                .map(|o| match taken.iter().any(|name| name == o.name) {
                    true => maybe(&format!("output({})", o.name), o.unit),
                    false => maybe(o.name, o.unit),
                }),
        );
        columns.push(mode);
        columns
    }

    /// All rows in order of time. Samples at the instant of an event are its two rows.
    pub(super) fn rows(&self) -> Vec<Row<'a>> {
        let mut rows = Vec::new();
        let mut samples = self.outcome.samples.iter().enumerate().peekable();
        for (index, event) in self.outcome.events.iter().enumerate() {
            while let Some((index, sample)) = samples.next_if(|(_, s)| s.time < event.time) {
                rows.push(Row::Sample(index, sample));
            }
            while samples.next_if(|(_, s)| s.time == event.time).is_some() {}
            rows.extend([Row::Before(index, event), Row::After(index, event)]);
        }
        rows.extend(samples.map(|(index, sample)| Row::Sample(index, sample)));
        rows
    }

    /// The cells of a row, one for each column.
    pub(super) fn cells(&self, row: &Row) -> Vec<Cell> {
        let outcome = self.outcome;
        let d = outcome.description;
        let around = |index: usize, side: usize| outcome.around.get(index)?[side].as_ref();
        let (mut cells, sample, ledger, mode) = match *row {
            Row::Sample(index, sample) => {
                let cells = self.motion(sample.time, None, &sample.state, &sample.forces);
                let ledger = outcome.ledgers.get(index);
                (cells, Some(sample), ledger, &sample.mode)
            }
            Row::Before(index, event) => {
                let label = name(event, d);
                let cells = self.motion(event.time, Some(label), &event.state, &event.forces);
                (cells, around(index, 0), None, &event.before)
            }
            Row::After(index, event) => {
                let label = format!("{} (after)", name(event, d));
                let (state, forces) = (&event.state_after, &event.forces_after);
                let cells = self.motion(event.time, Some(label), state, forces);
                let ledger = outcome.event_ledgers.get(index);
                (cells, around(index, 1), ledger, &event.after)
            }
        };
        self.energies(&mut cells, sample, ledger);
        cells.push(Cell::Text(mode.display(d).to_string()));
        for cell in &mut cells {
            if let Cell::Number(number) = cell {
                // A sum with +0 is never −0.
                *number += 0.0;
            }
        }
        cells
    }

    fn motion(
        &self,
        time: f64,
        event: Option<String>,
        state: &State<f64>,
        rows: &[f64],
    ) -> Vec<Cell> {
        let mut cells = vec![Cell::Number(time), event.map_or(Cell::Nothing, Cell::Text)];
        cells.extend(state.q.iter().chain(&state.v).copied().map(Cell::Number));
        let forces = self.forces.iter();
        cells.extend(forces.map(|force| Cell::Number(rows[force.row])));
        cells
    }

    /// Energies, work and what is observed, as far as they are known.
    fn energies(&self, cells: &mut Vec<Cell>, sample: Option<&Sample>, ledger: Option<&Ledger>) {
        let number = |number: Option<f64>| number.map_or(Cell::Nothing, Cell::Number);
        cells.push(number(sample.map(|sample| sample.energies.kinetic)));
        cells.push(number(sample.map(|sample| sample.energies.potential)));
        let works = 0..self.works.len();
        cells.extend(works.map(|i| number(ledger.map(|ledger| ledger.work[i].work))));
        let observes = 0..self.outcome.description.observes.len();
        cells.extend(observes.map(|i| number(sample.map(|sample| sample.observes[i]))));
    }
}

/// `grip slips`
fn name(event: &Event<f64>, description: &'static Description) -> String {
    format!("{} {}", event.subject.name(description), event.kind)
}
