//! Film → the numbers of the page: columns over time, each number to six digits.

use super::super::{is_angle, rate_unit, symbol};
use crate::drawing::{Drawing, Shape, union};
use crate::film::Film;
use crate::outcome::{Outcome, Sample, Source, forces};
use serde::Serialize;

/// What the player of the page reads.
#[derive(Serialize)]
pub(super) struct Data {
    schema: &'static str,
    runs: Vec<Run>,
}

#[derive(Serialize)]
struct Run {
    title: String,
    /// Of every sample, s.
    time: Vec<f64>,
    phases: Vec<Span>,
    events: Vec<Happening>,
    #[serde(skip_serializing_if = "Option::is_none")]
    picture: Option<Picture>,
    plots: Vec<Plot>,
    phase: Vec<Portrait>,
}

/// A mode and when.
#[derive(Serialize)]
struct Span {
    from: f64,
    to: f64,
    mode: String,
}

#[derive(Serialize)]
struct Happening {
    time: f64,
    text: String,
}

/// The scene, to scale.
#[derive(Serialize)]
struct Picture {
    /// Lowest and highest x, lowest and highest y of all that is ever drawn, m.
    frame: [f64; 4],
    shapes: Vec<Columns>,
    arrows: Vec<Arrow>,
}

/// A shape: its numbers, each over time, or alone if it does not change.
#[derive(Serialize)]
struct Columns {
    kind: &'static str,
    numbers: Vec<Column>,
}

#[derive(Serialize)]
struct Arrow {
    name: String,
    unit: String,
    /// Place of the force and its two components in newtons.
    numbers: [Column; 4],
}

#[derive(Serialize, PartialEq, Debug)]
#[serde(untagged)]
enum Column {
    Constant(f64),
    Varying(Vec<f64>),
}

/// Curves over a common axis.
#[derive(Serialize)]
struct Plot {
    title: String,
    unit: String,
    /// Of every value, s; the samples if there are none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    time: Vec<f64>,
    curves: Vec<Curve>,
}

#[derive(Serialize)]
struct Curve {
    name: String,
    /// Whether it bounds the other one.
    #[serde(skip_serializing_if = "is_false")]
    limit: bool,
    values: Vec<Option<f64>>,
}

/// A coordinate and its rate.
#[derive(Serialize)]
struct Portrait {
    name: String,
    unit: String,
    rate_unit: String,
    q: Vec<f64>,
    v: Vec<f64>,
}

/// More coordinates than this do not have portraits.
const PORTRAITS: usize = 12;
/// More rows than this do not have plots.
const PLOTS: usize = 12;

pub(super) fn data<'a>(films: impl Iterator<Item = (&'a str, &'a Film)>) -> Data {
    Data {
        schema: "lagrange.report.1",
        runs: films.map(|(title, film)| run(title, film)).collect(),
    }
}

fn run(title: &str, film: &Film) -> Run {
    let outcome = &film.outcome;
    let description = outcome.description;
    let phases = outcome.phases.iter().map(|phase| Span {
        from: rounded(phase.from),
        to: rounded(phase.to),
        mode: phase.mode.display(description).to_string(),
    });
    let events = outcome.events.iter().map(|event| Happening {
        time: rounded(event.time),
        text: format!("{} {}", event.subject.name(description), event.kind.word()),
    });
    Run {
        title: title.to_owned(),
        time: over(outcome, |sample| sample.time),
        phases: phases.collect(),
        events: events.collect(),
        picture: picture(outcome, &film.drawings),
        plots: plots(film),
        phase: portraits(outcome),
    }
}

fn picture(outcome: &Outcome, drawings: &[Drawing]) -> Option<Picture> {
    let first = drawings.first()?;
    let extents = drawings.iter().flat_map(|d| &d.shapes).map(Shape::extent);
    let frame = extents.reduce(union)?.map(rounded);
    let shape = |(i, shape): (usize, &Shape)| {
        let lists: Vec<Vec<f64>> = drawings.iter().map(|d| d.shapes[i].numbers()).collect();
        let width = lists.iter().map(Vec::len).min().unwrap_or(0);
        Columns {
            kind: shape.kind(),
            numbers: (0..width)
                .map(|k| column(lists.iter().map(|list| list[k])))
                .collect(),
        }
    };
    let rows = forces(outcome.description);
    let arrow = |(i, arrow): (usize, &crate::drawing::Arrow)| {
        let row = rows.iter().find(|force| force.name == arrow.force)?.row;
        let placed = || drawings.iter().map(move |d| &d.arrows[i]);
        let pushes = |k: usize| {
            let samples = outcome.samples.iter();
            column(
                placed()
                    .zip(samples)
                    .map(move |(a, s)| a.along[k] * s.forces[row]),
            )
        };
        Some(Arrow {
            name: arrow.force.to_owned(),
            unit: "N".to_owned(),
            numbers: [
                column(placed().map(|a| a.at[0])),
                column(placed().map(|a| a.at[1])),
                pushes(0),
                pushes(1),
            ],
        })
    };
    Some(Picture {
        frame,
        shapes: first.shapes.iter().enumerate().map(shape).collect(),
        arrows: first.arrows.iter().enumerate().filter_map(arrow).collect(),
    })
}

fn plots(film: &Film) -> Vec<Plot> {
    let outcome = &film.outcome;
    let description = outcome.description;
    let mut plots = Vec::new();
    let all = forces(description);
    for force in &all {
        let Source::Friction(i) = force.source else {
            continue;
        };
        let components = description.frictions[i].components;
        if force.row != description.frictions[i].row {
            continue;
        }
        let held = |sample: &Sample| {
            let rows = &sample.forces[force.row..force.row + components];
            sample.limits[i].map(|_| rows.iter().fold(0.0, |sum: f64, f| sum.hypot(*f)))
        };
        let name = description.frictions[i].name;
        plots.push(Plot {
            title: format!("Friction {name} and what it can hold"),
            unit: description.units.row(force.row).to_owned(),
            time: Vec::new(),
            curves: vec![
                curve(outcome, format!("|{name}|"), false, held),
                curve(outcome, "μN".to_owned(), true, |sample| sample.limits[i]),
            ],
        });
    }
    type Kind = (&'static str, fn(Source) -> bool);
    let kinds: [Kind; 2] = [
        ("Contact forces", |s| matches!(s, Source::Contact(_))),
        ("Constraint forces", |s| matches!(s, Source::Constraint(_))),
    ];
    for (title, of_kind) in kinds {
        let mut units: Vec<&str> = Vec::new();
        for force in all.iter().filter(|force| of_kind(force.source)) {
            let unit = description.units.row(force.row);
            if !units.contains(&unit) {
                units.push(unit);
            }
        }
        for unit in units {
            let same = |force: &&crate::outcome::Force| {
                of_kind(force.source) && description.units.row(force.row) == unit
            };
            let curves = all.iter().filter(same).take(6).map(|force| {
                curve(outcome, force.name.clone(), false, |sample| {
                    let acts = force.acts(description, &sample.mode);
                    acts.then_some(sample.forces[force.row])
                })
            });
            plots.push(Plot {
                title: title.to_owned(),
                unit: unit.to_owned(),
                time: Vec::new(),
                curves: curves.collect(),
            });
        }
    }
    plots.truncate(PLOTS);
    type Energy = (&'static str, fn(&Sample) -> f64);
    let energies: [Energy; 3] = [
        ("kinetic", |s| s.kinetic),
        ("potential", |s| s.potential),
        ("sum", |s| s.kinetic + s.potential),
    ];
    let energies =
        energies.map(|(name, of)| curve(outcome, name.to_owned(), false, move |s| Some(of(s))));
    plots.push(Plot {
        title: "Energy".to_owned(),
        unit: description.units.energy.to_owned(),
        time: Vec::new(),
        curves: energies.into(),
    });
    plots.extend(work(film));
    plots
}

/// The work of every item that does some, from the beginning.
fn work(film: &Film) -> Option<Plot> {
    let (_, last) = film.books.last()?;
    let worked = |i: usize| {
        let books = film.books.iter();
        books
            .map(|(_, ledger)| ledger.work[i].work.abs())
            .fold(0.0, f64::max)
    };
    let curves: Vec<Curve> = last
        .work
        .iter()
        .enumerate()
        .filter(|(i, _)| worked(*i) > 1e-9 * last.scale)
        .take(6)
        .map(|(i, entry)| Curve {
            name: format!("{} ({})", entry.name, entry.kind),
            limit: false,
            values: film
                .books
                .iter()
                .map(|(_, ledger)| Some(rounded(ledger.work[i].work)))
                .collect(),
        })
        .collect();
    (!curves.is_empty()).then(|| Plot {
        title: "Work since the start".to_owned(),
        unit: film.outcome.description.units.energy.to_owned(),
        time: film.books.iter().map(|(time, _)| rounded(*time)).collect(),
        curves,
    })
}

fn portraits(outcome: &Outcome) -> Vec<Portrait> {
    let coordinates = outcome.description.coordinates;
    let shown = coordinates.iter().enumerate().take(PORTRAITS);
    shown
        .map(|(i, coordinate)| {
            let unit = match is_angle(coordinate) {
                true => "rad",
                false => coordinate.unit,
            };
            Portrait {
                name: symbol(coordinate.name),
                unit: unit.to_owned(),
                rate_unit: rate_unit(unit),
                q: over(outcome, |sample| sample.state.q[i]),
                v: over(outcome, |sample| sample.state.v[i]),
            }
        })
        .collect()
}

fn curve(
    outcome: &Outcome,
    name: String,
    limit: bool,
    of: impl Fn(&Sample) -> Option<f64>,
) -> Curve {
    let values = outcome.samples.iter().map(of);
    Curve {
        name,
        limit,
        values: values.map(|value| value.map(rounded)).collect(),
    }
}

fn over(outcome: &Outcome, of: impl Fn(&Sample) -> f64) -> Vec<f64> {
    outcome.samples.iter().map(|s| rounded(of(s))).collect()
}

fn column(values: impl Iterator<Item = f64>) -> Column {
    let values: Vec<f64> = values.map(rounded).collect();
    match values.first() {
        Some(first) if values.iter().all(|value| value == first) => Column::Constant(*first),
        _ => Column::Varying(values),
    }
}

/// To six significant digits: no picture shows more. What is not finite is 0: pages cannot hold it.
fn rounded(x: f64) -> f64 {
    if !x.is_finite() || x == 0.0 {
        return 0.0;
    }
    format!("{x:.5e}").parse().unwrap_or(0.0)
}

fn is_false(flag: &bool) -> bool {
    !flag
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_finite() {
        assert_eq!(rounded(1.0 / 3.0), 0.333333);
        assert_eq!(rounded(-0.0), 0.0);
        assert_eq!(rounded(f64::NAN), 0.0);
        assert_eq!(column([2.0, 2.0].into_iter()), Column::Constant(2.0));
        let varying = Column::Varying(vec![1.0, 2.0]);
        assert_eq!(column([1.0, 2.0].into_iter()), varying);
    }
}
