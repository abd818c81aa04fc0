//! Outcome → CSV: one line per sample, two (before and after) per event, in order of time.
//!
//! Columns: `t`, `event` (empty for a sample, else `grip slips`, `grip slips (after)`), coordinates, velocities,
//! `force(item)`, `kinetic`, `potential`, `work(item)` if asked for, `observe`d names, `mode`; each with its unit where it is known, `x [m]`. Lines of events leave out the last but one group.

use super::{rate_unit, with_unit, work_name};
use crate::outcome::{Outcome, Sample, forces};
use crate::request::velocity_name;
use lagrange_core::prelude::*;
use std::io::{self, Write};

/// Writes `outcome` as CSV with a header line.
pub fn write(outcome: &Outcome, out: impl Write) -> io::Result<()> {
    let mut table = ::csv::Writer::from_writer(out);
    table.write_record(header(outcome))?;
    let mut samples = outcome.samples.iter().enumerate().peekable();
    for event in &outcome.events {
        while let Some((index, sample)) = samples.next_if(|(_, sample)| sample.time < event.time) {
            table.write_record(sample_line(outcome, index, sample))?;
        }
        for line in event_lines(outcome, event) {
            table.write_record(line)?;
        }
    }
    for (index, sample) in samples {
        table.write_record(sample_line(outcome, index, sample))?;
    }
    table.flush()
}

fn header(outcome: &Outcome) -> Vec<String> {
    let description = outcome.description;
    let units = &description.units;
    let coordinates = description.coordinates.iter();
    let mut names = vec!["t [s]".to_owned(), "event".to_owned()];
    names.extend(coordinates.clone().map(|c| with_unit(c.name, c.unit)));
    names.extend(coordinates.map(|c| with_unit(&velocity_name(c.name), &rate_unit(c.unit))));
    names.extend(
        forces(description)
            .into_iter()
            .map(|force| with_unit(&format!("force({})", force.name), units.row(force.row))),
    );
    names.extend(["kinetic", "potential"].map(|name| with_unit(name, units.energy)));
    names.extend(
        works(outcome)
            .iter()
            .map(|entry| with_unit(&format!("work({})", work_name(entry)), units.energy)),
    );
    names.extend(
        description
            .observes
            .iter()
            .map(|observe| with_unit(observe.name, observe.unit)),
    );
    names.push("mode".to_owned());
    names
}

/// The items of the ledger over time; none if it was not asked for.
fn works(outcome: &Outcome) -> &[Entry] {
    outcome.ledgers.first().map_or(&[], |ledger| &ledger.work)
}

fn sample_line(outcome: &Outcome, index: usize, sample: &Sample) -> Vec<String> {
    let mut line = vec![sample.time.to_string(), String::new()];
    line.extend(numbers(&sample.state.q));
    line.extend(numbers(&sample.state.v));
    line.extend(
        forces(outcome.description)
            .iter()
            .map(|force| sample.forces[force.row].to_string()),
    );
    line.extend(numbers(&[sample.kinetic, sample.potential]));
    if let Some(ledger) = outcome.ledgers.get(index) {
        line.extend(ledger.work.iter().map(|entry| entry.work.to_string()));
    }
    line.extend(numbers(&sample.observes));
    line.push(sample.mode.display(outcome.description).to_string());
    line
}

fn event_lines(outcome: &Outcome, event: &Event<f64>) -> [Vec<String>; 2] {
    let description = outcome.description;
    let label = format!("{} {}", event.subject.name(description), event.kind);
    let line = |label: String, state: &State<f64>, rows: &[f64], mode: String| {
        let mut line = vec![event.time.to_string(), label];
        line.extend(numbers(&state.q));
        line.extend(numbers(&state.v));
        line.extend(
            forces(description)
                .iter()
                .map(|force| rows[force.row].to_string()),
        );
        line.extend(vec![
            String::new();
            2 + works(outcome).len() + description.observes.len()
        ]);
        line.push(mode);
        line
    };
    let after = format!("{label} (after)");
    [
        line(
            label,
            &event.state,
            &event.forces,
            event.before.display(description).to_string(),
        ),
        line(
            after,
            &event.state_after,
            &event.forces_after,
            event.after.display(description).to_string(),
        ),
    ]
}

fn numbers(values: &[f64]) -> impl Iterator<Item = String> {
    values.iter().map(f64::to_string)
}
