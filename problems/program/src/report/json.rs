//! Outcome → JSON: everything, every number in full precision, names in the order of the declaration.

use super::certificate::{Verdict, verdict};
use super::rows::Table;
use super::{named_state, work_name};
use crate::notation::{rate_unit, velocity_name};
use crate::outcome::{Outcome, Sample, forces};
use lagrange_core::prelude::*;
use lagrange_core::system::Description;
use serde::{Serialize, Serializer};
use std::collections::HashSet;
use std::io::{self, Write};

/// Writes `outcome` as one JSON object and a newline.
pub fn write(outcome: &Outcome, mut out: impl Write) -> io::Result<()> {
    serde_json::to_writer_pretty(&mut out, &report(outcome)).map_err(io::Error::from)?;
    writeln!(out)
}

#[derive(Serialize)]
struct Report {
    #[serde(flatten)]
    header: Header,
    #[serde(skip_serializing_if = "Option::is_none")]
    start: Option<Instant>,
    events: Vec<Happening>,
    #[serde(rename = "final", skip_serializing_if = "Option::is_none")]
    last: Option<Instant>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    energy_over_time: Vec<Balance>,
    #[serde(flatten)]
    ending: Ending,
}

/// What was run.
#[derive(Serialize)]
pub(super) struct Header {
    scene: &'static str,
    parameters: Numbers,
    #[serde(skip_serializing_if = "Texts::is_empty")]
    units: Texts,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    without: Vec<&'static str>,
    method: String,
    tolerance: f64,
    #[serde(skip_serializing_if = "Numbers::is_empty")]
    absolute_tolerance: Numbers,
    version: &'static str,
}

/// What it came to.
#[derive(Serialize)]
pub(super) struct Ending {
    #[serde(skip_serializing_if = "Option::is_none")]
    energy: Option<Energy>,
    #[serde(skip_serializing_if = "Option::is_none")]
    certificate: Option<Verdict>,
    #[serde(skip_serializing_if = "Option::is_none")]
    estimate: Option<Errors>,
    work: Counts,
    /// Intervals, s, in which steps were bounded by stability.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    stiff: Vec<[f64; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    error: Option<String>,
}

/// Both.
#[derive(Serialize)]
pub(super) struct Summary {
    #[serde(flatten)]
    header: Header,
    #[serde(flatten)]
    ending: Ending,
}

#[derive(Serialize)]
struct Instant {
    time: f64,
    mode: String,
    state: Numbers,
    forces: Numbers,
    #[serde(skip_serializing_if = "Numbers::is_empty")]
    outputs: Numbers,
    /// Names of the forces that the motion leaves open.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    undetermined: Vec<String>,
}

#[derive(Serialize)]
struct Happening {
    time: f64,
    #[serde(flatten)]
    switch: Switch,
}

/// An event, but for its time.
#[derive(Serialize)]
pub(super) struct Switch {
    item: &'static str,
    kind: &'static str,
    from: String,
    to: String,
    state: Numbers,
    forces: Numbers,
    #[serde(skip_serializing_if = "Numbers::is_empty")]
    outputs: Numbers,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    undetermined: Vec<String>,
    state_after: Numbers,
    forces_after: Numbers,
    #[serde(skip_serializing_if = "Numbers::is_empty")]
    outputs_after: Numbers,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    undetermined_after: Vec<String>,
    impulses: Numbers,
    #[serde(skip_serializing_if = "is_false")]
    impulses_undetermined: bool,
    #[serde(skip_serializing_if = "is_false")]
    restitution_lowered: bool,
    #[serde(skip_serializing_if = "is_false")]
    ambiguous: bool,
    /// Impacts that satisfy the law as well.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    other_impacts: Vec<Other>,
}

#[derive(Serialize)]
struct Other {
    state_after: Numbers,
    impulses: Numbers,
}

#[derive(Serialize)]
struct Energy {
    start: Parts,
    end: Parts,
    work: Vec<Share>,
    scale: f64,
    closure: f64,
}

/// The ledger from the beginning to one time.
#[derive(Serialize)]
struct Balance {
    time: f64,
    kinetic: f64,
    potential: f64,
    jacobi: f64,
    work: Numbers,
    closure: f64,
}

/// Work of one item, J.
#[derive(Serialize)]
struct Share {
    name: &'static str,
    kind: &'static str,
    work: f64,
}

#[derive(Serialize)]
struct Parts {
    kinetic: f64,
    potential: f64,
    total: f64,
    /// What the works balance.
    jacobi: f64,
}

/// How far off the run is, judged by another one.
#[derive(Serialize)]
struct Errors {
    /// The other run.
    method: String,
    tolerance: f64,
    /// Largest errors, relative above 1 and absolute below; none where the runs part.
    state_error: Option<f64>,
    event_error: Option<f64>,
    /// Of the final state.
    state: Numbers,
    /// Of the time of each event, s.
    events: Vec<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    parting: Option<String>,
}

#[derive(Serialize)]
struct Counts {
    steps: usize,
    rejected: usize,
    evaluations: usize,
    series: usize,
    factorizations: usize,
    projections: usize,
    events: usize,
}

/// A JSON object that keeps its order.
pub(super) struct Numbers(pub Vec<(String, f64)>);

impl Numbers {
    fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

impl Serialize for Numbers {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        // A sum with +0 is never −0.
        serializer.collect_map(self.0.iter().map(|(name, value)| (name, value + 0.0)))
    }
}

/// A JSON object of texts that keeps its order; what has no text is left out.
struct Texts(Vec<(String, String)>);

impl Texts {
    fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

impl Serialize for Texts {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(name, text)| (name, text)))
    }
}

/// What was run; units are those of the names in a JSON object.
fn named(outcome: &Outcome, units: Texts) -> Header {
    let names = outcome.description.parameters.iter();
    let names = names.map(|p| p.name.to_owned());
    Header {
        scene: outcome.scene,
        parameters: Numbers(names.zip(outcome.parameters.iter().copied()).collect()),
        units,
        without: outcome.left_out(),
        method: outcome.method.to_string(),
        tolerance: outcome.tolerance,
        absolute_tolerance: Numbers(outcome.absolute.clone()),
        version: env!("CARGO_PKG_VERSION"),
    }
}

/// What was run; units are those of parameters and of the columns of a table.
pub(super) fn header(outcome: &Outcome) -> Header {
    let parameters = outcome.description.parameters.iter();
    let parameters = parameters.map(|p| (p.name.to_owned(), p.unit.to_owned()));
    let columns = Table::new(outcome).columns().into_iter();
    let columns = columns.map(|column| (column.name, column.unit));
    let mut units: Vec<(String, String)> = parameters.chain(columns).collect();
    units.retain(|(_, unit)| !unit.is_empty());
    named(outcome, Texts(units))
}

/// What it came to.
pub(super) fn ending(outcome: &Outcome) -> Ending {
    let description = outcome.description;
    Ending {
        energy: outcome.ledger.as_ref().map(energy),
        certificate: outcome.certificate.as_ref().map(verdict),
        estimate: outcome
            .estimate
            .as_ref()
            .map(|estimate| errors(description, estimate)),
        work: counts(outcome),
        stiff: outcome.stiff.iter().map(|s| [s.start, s.end]).collect(),
        error: outcome.failure.as_ref().map(Error::to_string),
    }
}

/// What was run and what it came to, beside a table.
pub(super) fn summary(outcome: &Outcome) -> Summary {
    Summary {
        header: header(outcome),
        ending: ending(outcome),
    }
}

/// Units by name: of parameters, the state, forces, observed quantities and energies, as far as they are known.
fn units(description: &Description) -> Texts {
    let units = &description.units;
    let parameters = description.parameters.iter();
    let mut texts: Vec<(String, String)> = parameters
        .map(|parameter| (parameter.name.to_owned(), parameter.unit.to_owned()))
        .collect();
    for coordinate in description.coordinates {
        texts.push((coordinate.name.to_owned(), coordinate.unit.to_owned()));
        texts.push((velocity_name(coordinate.name), rate_unit(coordinate.unit)));
    }
    let forces = forces(description).into_iter();
    texts.extend(forces.map(|force| (force.name, units.row(force.row).to_owned())));
    let observes = description.observes.iter();
    texts.extend(observes.map(|observe| (observe.name.to_owned(), observe.unit.to_owned())));
    texts.push(("energy".to_owned(), units.energy.to_owned()));
    // A coordinate that is observed has its unit already.
    let mut names = HashSet::new();
    texts.retain(|(name, unit)| !unit.is_empty() && names.insert(name.clone()));
    Texts(texts)
}

fn is_false(flag: &bool) -> bool {
    !flag
}

fn report(outcome: &Outcome) -> Report {
    let description = outcome.description;
    let instant = |sample: &Sample| Instant {
        time: sample.time,
        mode: sample.mode.display(description).to_string(),
        state: state(description, &sample.state),
        forces: rows(description, &sample.forces),
        outputs: outputs(description, Some(sample)),
        undetermined: flagged(description, &sample.undetermined),
    };
    Report {
        header: named(outcome, units(description)),
        start: outcome.first().map(instant),
        events: (outcome.events.iter().enumerate())
            .map(|(index, event)| Happening {
                time: event.time,
                switch: switch(outcome, index, event),
            })
            .collect(),
        last: outcome.last().map(instant),
        energy_over_time: outcome
            .samples
            .iter()
            .zip(&outcome.ledgers)
            .map(|(sample, ledger)| balance(sample.time, ledger))
            .collect(),
        ending: ending(outcome),
    }
}

/// An event, but for its time; it is the one with this number.
pub(super) fn switch(outcome: &Outcome, index: usize, event: &Event<f64>) -> Switch {
    let description = outcome.description;
    let around = outcome.around.get(index);
    let [before, after] = [0, 1].map(|side| around?[side].as_ref());
    let others = event.other_impacts.iter().map(|other| Other {
        state_after: Numbers(named_state(
            description,
            &event.state_after.q,
            &other.v_after,
        )),
        impulses: rows(description, &other.impulses),
    });
    Switch {
        item: event.subject.name(description),
        kind: event.kind.word(),
        from: event.before.display(description).to_string(),
        to: event.after.display(description).to_string(),
        state: state(description, &event.state),
        forces: rows(description, &event.forces),
        outputs: outputs(description, before),
        undetermined: flagged(description, &event.undetermined),
        state_after: state(description, &event.state_after),
        forces_after: rows(description, &event.forces_after),
        outputs_after: outputs(description, after),
        undetermined_after: flagged(description, &event.undetermined_after),
        impulses: rows(description, &event.impulses),
        impulses_undetermined: event.impulses_undetermined,
        restitution_lowered: event.restitution_lowered,
        ambiguous: event.ambiguous,
        other_impacts: others.collect(),
    }
}

pub(super) fn state(description: &Description, state: &State<f64>) -> Numbers {
    Numbers(named_state(description, &state.q, &state.v))
}

/// Values per row under the names of their items; none if there are no values.
fn rows(description: &Description, values: &[f64]) -> Numbers {
    if values.is_empty() {
        return Numbers(Vec::new());
    }
    Numbers(
        forces(description)
            .into_iter()
            .map(|force| (force.name, values[force.row]))
            .collect(),
    )
}

/// What the declaration observes; nothing where that is not known, as between two events of one instant.
fn outputs(description: &Description, sample: Option<&Sample>) -> Numbers {
    let values = sample.map_or(&[][..], |sample| &sample.observes);
    let names = description
        .observes
        .iter()
        .map(|output| output.name.to_owned());
    Numbers(names.zip(values.iter().copied()).collect())
}

/// Names of the flagged rows.
fn flagged(description: &Description, flags: &[bool]) -> Vec<String> {
    let all = forces(description).into_iter();
    all.filter(|force| flags.get(force.row) == Some(&true))
        .map(|force| force.name)
        .collect()
}

fn energy(ledger: &Ledger) -> Energy {
    let parts = |energies: &Energies| Parts {
        kinetic: energies.kinetic,
        potential: energies.potential,
        total: energies.total(),
        jacobi: energies.jacobi,
    };
    Energy {
        start: parts(&ledger.start),
        end: parts(&ledger.end),
        work: ledger
            .work
            .iter()
            .map(|e| Share {
                name: e.name,
                kind: e.kind,
                work: e.work,
            })
            .collect(),
        scale: ledger.scale,
        closure: ledger.closure,
    }
}

fn errors(description: &Description, estimate: &Estimate) -> Errors {
    let difference = &estimate.difference;
    Errors {
        method: estimate.method.to_string(),
        tolerance: estimate.tolerance,
        state_error: difference
            .state_error
            .is_finite()
            .then_some(difference.state_error),
        event_error: difference.event_error,
        state: state(description, &difference.state),
        events: difference.events.clone(),
        parting: difference.parting.as_ref().map(ToString::to_string),
    }
}

fn balance(time: f64, ledger: &Ledger) -> Balance {
    let work = ledger.work.iter();
    Balance {
        time,
        kinetic: ledger.end.kinetic,
        potential: ledger.end.potential,
        jacobi: ledger.end.jacobi,
        work: Numbers(work.map(|e| (work_name(e), e.work)).collect()),
        closure: ledger.closure,
    }
}

fn counts(outcome: &Outcome) -> Counts {
    let work = outcome.work;
    Counts {
        steps: work.steps,
        rejected: work.rejected,
        evaluations: work.evaluations,
        series: work.series,
        factorizations: work.factorizations,
        projections: work.projections,
        events: outcome.events.len(),
    }
}

#[cfg(test)]
mod tests {
    use crate::file::scene;
    use crate::report::{CORNER, PLANK};
    use crate::request::Request;
    use serde_json::Value;

    /// It falls for 0.2 s, and each foot may take any part of m (1 + e) v = 3 N s with the others.
    #[test]
    fn impulses_that_are_not_determined_are_marked() {
        let scene = scene("plank.lagrange", PLANK).expect("a declaration");
        let outcome = scene.run(&Request::default()).expect("a run");
        let mut bytes = Vec::new();
        super::write(&outcome, &mut bytes).expect("memory");
        let whole: Value = serde_json::from_slice(&bytes).expect("JSON");
        let events = whole["events"].as_array().expect("events");
        assert_eq!(events.len(), 3, "{whole:#}");
        for event in events {
            assert_eq!(event["impulses_undetermined"], true, "{event:#}");
            let impulses = ["foot[0]", "foot[1]", "foot[2]"].map(|name| &event["impulses"][name]);
            let sum: f64 = impulses.iter().filter_map(|impulse| impulse.as_f64()).sum();
            assert!((sum - 3.0).abs() < 1e-9, "{event:#}");
        }
        let mut lines = Vec::new();
        crate::report::jsonl::write(&outcome, &mut lines).expect("memory");
        let lines = String::from_utf8(lines).expect("text");
        assert_eq!(
            lines.matches("\"impulses_undetermined\":true").count(),
            3,
            "{lines}"
        );
    }

    /// The ball sticks to one wall and slides along the other: of two ways one is the mirror image of the other.
    #[test]
    fn the_other_solutions_of_an_impact_are_told() {
        let scene = scene("corner.lagrange", CORNER).expect("a declaration");
        let outcome = scene.run(&Request::default()).expect("a run");
        let written = |write: &dyn Fn(&mut Vec<u8>)| {
            let mut bytes = Vec::new();
            write(&mut bytes);
            String::from_utf8(bytes).expect("text")
        };
        let read = |text: &str| serde_json::from_str::<Value>(text).expect("JSON");
        let whole = read(&written(&|to| super::write(&outcome, to).expect("memory")));
        let lines = written(&|to| crate::report::jsonl::write(&outcome, to).expect("memory"));
        let line = lines.lines().map(read).find(|line| line["type"] == "event");
        let event = &whole["events"][0];
        let others = event["other_impacts"].as_array().expect("others");
        assert_eq!(
            line.expect("an event")["other_impacts"],
            event["other_impacts"]
        );
        let numbers = |solution: &Value, names: [&str; 7]| {
            let [velocities, impulses] = ["state_after", "impulses"].map(|of| &solution[of]);
            let of = |name: &str| velocities.get(name).or(impulses.get(name));
            names.map(|name| of(name).and_then(Value::as_f64).expect("a number"))
        };
        let names = [
            "der(x)", "der(y)", "right", "top", "side", "ceiling", "der(phi)",
        ];
        let in_mirror = [
            "der(y)", "der(x)", "top", "right", "ceiling", "side", "der(phi)",
        ];
        let mut image = numbers(event, in_mirror);
        image[6] *= -1.0;
        let is_image = |other: &Value| {
            let mut pairs = numbers(other, names).into_iter().zip(image);
            pairs.all(|(one, image)| (one - image).abs() < 1e-9)
        };
        assert!(others.iter().any(is_image), "{event:#}");
    }
}
