//! Film → plots: forces beside their limits, energies, work, and the phase plots.

use super::super::with_unit;
use super::difference::difference;
use crate::film::Film;
use crate::notation::symbol;
use crate::number::significant;
use crate::outcome::{Force, Outcome, Sample, Source, forces};
use crate::quantity::{Quantity, force_word, limit_name};
use lagrange_core::prelude::Ledger;
use lagrange_core::system::Friction;
use serde::Serialize;

/// Curves over a common axis.
#[derive(Serialize)]
pub(super) struct Plot {
    title: String,
    /// What its values are, with the unit.
    axis: String,
    /// Of every value, s; the samples if there are none.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    time: Vec<f64>,
    curves: Vec<Curve>,
}

#[derive(Serialize)]
pub(super) struct Curve {
    name: String,
    /// Whether it bounds the other one.
    #[serde(skip_serializing_if = "is_false")]
    limit: bool,
    values: Vec<Option<f64>>,
}

/// A coordinate and its rate.
#[derive(Serialize)]
pub(super) struct Portrait {
    name: String,
    unit: String,
    rate_unit: String,
    q: Vec<f64>,
    v: Vec<f64>,
    /// Less that of the first run of the scene.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    apart: Vec<Option<f64>>,
}

/// An extra output over time.
#[derive(Serialize)]
pub(super) struct Output {
    name: &'static str,
    unit: String,
    values: Vec<f64>,
}

/// What the declaration observes.
pub(super) fn outputs(outcome: &Outcome) -> Vec<Output> {
    let list = outcome.description.observes.iter().enumerate();
    let output = |(i, observe): (usize, &lagrange_core::system::Observe)| Output {
        name: observe.name,
        unit: Quantity::Output(i).unit(outcome.description),
        values: over(outcome, |sample| {
            Quantity::Output(i).scale(outcome.description) * sample.observes[i]
        }),
    };
    list.map(output).collect()
}

/// More coordinates than this do not have portraits.
const PORTRAITS: usize = 12;
/// More plots of forces than this are left out.
const PLOTS: usize = 12;
/// More items than this do not have curves in one plot.
const CURVES: usize = 6;

/// All plots over time, and how many of forces are left out.
pub(super) fn plots(film: &Film) -> (Vec<Plot>, usize) {
    let outcome = &film.outcome;
    let mut plots = frictions(outcome);
    plots.extend(pushes(outcome, "Contact forces", |source| {
        matches!(source, Source::Contact(_))
    }));
    plots.extend(pushes(outcome, "Constraint forces", |source| {
        matches!(source, Source::Constraint(_))
    }));
    let left_out = plots.len().saturating_sub(PLOTS);
    plots.truncate(PLOTS);
    plots.push(energies(outcome));
    plots.extend(work(film));
    (plots, left_out)
}

/// Each friction that acts at some time beside what it can hold.
fn frictions(outcome: &Outcome) -> Vec<Plot> {
    let description = outcome.description;
    let plot = |(i, friction): (usize, &Friction)| {
        let held = |sample: &Sample| {
            let rows = &sample.forces[friction.row..friction.row + friction.components];
            sample.limits[i].map(|_| rows.iter().fold(0.0, |sum: f64, f| sum.hypot(*f)))
        };
        let name = friction.name;
        Plot {
            title: format!("Friction {name} and what it can hold"),
            axis: force_axis(description.units.row(friction.row)),
            time: Vec::new(),
            curves: vec![
                curve(outcome, format!("|{name}|"), false, held),
                curve(outcome, limit_name(friction).to_owned(), true, |sample| {
                    sample.limits[i]
                }),
            ],
        }
    };
    let list = description.frictions.iter().enumerate();
    let acts = |i: usize| {
        outcome
            .samples
            .iter()
            .any(|sample| sample.limits[i].is_some())
    };
    let present = list.filter(|(i, _)| outcome.includes(Source::Friction(*i)) && acts(*i));
    present.map(plot).collect()
}

/// Forces of one kind that act at some time, those of one unit together as far as a plot has room.
fn pushes(outcome: &Outcome, title: &str, of_kind: fn(Source) -> bool) -> Vec<Plot> {
    let description = outcome.description;
    let acts = |force: &Force| {
        let mut samples = outcome.samples.iter();
        samples.any(|sample| force.acts(description, &sample.mode))
    };
    let all = forces(description);
    let present =
        |force: &&Force| of_kind(force.source) && outcome.includes(force.source) && acts(force);
    let all: Vec<&Force> = all.iter().filter(present).collect();
    let unit = |force: &Force| description.units.row(force.row);
    let mut units: Vec<&str> = Vec::new();
    for force in &all {
        if !units.contains(&unit(force)) {
            units.push(unit(force));
        }
    }
    let curve = |force: &&Force| {
        curve(outcome, force.name.clone(), false, |sample| {
            let acts = force.acts(description, &sample.mode);
            acts.then_some(sample.forces[force.row])
        })
    };
    let mut plots = Vec::new();
    for of in units {
        let same = all.iter().copied().filter(|force| unit(force) == of);
        let same: Vec<&Force> = same.collect();
        plots.extend(same.chunks(CURVES).map(|some| Plot {
            title: title.to_owned(),
            axis: force_axis(of),
            time: Vec::new(),
            curves: some.iter().map(curve).collect(),
        }));
    }
    plots
}

fn force_axis(unit: &str) -> String {
    with_unit(force_word(unit), unit)
}

fn energies(outcome: &Outcome) -> Plot {
    type Energy = (&'static str, fn(&Sample) -> f64);
    let mut energies: Vec<Energy> = vec![
        ("kinetic", |s| s.energies.kinetic),
        ("potential", |s| s.energies.potential),
        ("sum", |s| s.energies.total()),
    ];
    if outcome.ledger.as_ref().is_some_and(Ledger::has_own_jacobi) {
        energies.push(("Jacobi integral", |s| s.energies.jacobi));
    }
    let energies = energies.into_iter();
    let curves =
        energies.map(|(name, of)| curve(outcome, name.to_owned(), false, move |s| Some(of(s))));
    Plot {
        title: "Energy".to_owned(),
        axis: with_unit("energy", outcome.description.units.energy),
        time: Vec::new(),
        curves: curves.collect(),
    }
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
        .take(CURVES)
        .map(|(i, entry)| Curve {
            name: format!("{} ({})", entry.name, entry.kind),
            limit: false,
            values: film
                .books
                .iter()
                .map(|(_, ledger)| Some(significant(ledger.work[i].work)))
                .collect(),
        })
        .collect();
    (!curves.is_empty()).then(|| Plot {
        title: "Work since the start".to_owned(),
        axis: with_unit("work", film.outcome.description.units.energy),
        time: film
            .books
            .iter()
            .map(|(time, _)| significant(*time))
            .collect(),
        curves,
    })
}

/// The coordinates; with how far they are from those of another run, if one is given.
pub(super) fn portraits(outcome: &Outcome, other: Option<&Outcome>) -> Vec<Portrait> {
    let d = outcome.description;
    let portrait = |i: usize| {
        let (q, v) = (Quantity::Position(i), Quantity::Velocity(i));
        Portrait {
            name: symbol(d.coordinates[i].name),
            unit: q.unit(d),
            rate_unit: v.unit(d),
            q: over(outcome, |sample| q.scale(d) * sample.state.q[i]),
            v: over(outcome, |sample| v.scale(d) * sample.state.v[i]),
            apart: other.map_or(Vec::new(), |other| {
                let apart = difference(outcome, other, i).into_iter();
                apart
                    .map(|value| value.map(|x| significant(q.scale(d) * x)))
                    .collect()
            }),
        }
    };
    (0..d.coordinates.len().min(PORTRAITS))
        .map(portrait)
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
        values: values.map(|value| value.map(significant)).collect(),
    }
}

pub(super) fn over(outcome: &Outcome, of: impl Fn(&Sample) -> f64) -> Vec<f64> {
    short(outcome.samples.iter().map(of).collect())
}

/// Numbers with the digits that a curve shows: six, or so many that a hundred-thousandth of what they span is left of what is
/// almost constant.
fn short(values: Vec<f64>) -> Vec<f64> {
    let finite = || values.iter().copied().filter(|x| x.is_finite());
    let span = finite().fold(f64::MIN, f64::max) - finite().fold(f64::MAX, f64::min);
    let unit = 10_f64.powf(5.0 - span.log10().floor());
    let short = |x: f64| {
        let six = significant(x);
        let fine = (x * unit).round() / unit;
        let coarse = (six - x).abs() > 1e-5 * span;
        if coarse && fine.is_finite() {
            fine
        } else {
            six
        }
    };
    values.iter().map(|&x| short(x)).collect()
}

fn is_false(flag: &bool) -> bool {
    !flag
}

#[cfg(test)]
mod tests {
    use super::{portraits, short};
    use crate::file;
    use crate::request::Request;

    /// Half a turn in a second.
    #[test]
    fn angles_are_in_degrees() {
        let declared = "coordinates(phi: \"rad\"), parameters(j: \"kg m^2\" = 1), kinetic = j/2*der(phi)^2, start(spun: der(phi) = pi), until = 1";
        let scene = file::scene("spun.lagrange", declared).expect("a declaration");
        let outcome = scene
            .run(&Request {
                samples: 2,
                ..Request::default()
            })
            .expect("a run");
        let [portrait] = &portraits(&outcome, None)[..] else {
            panic!("one coordinate")
        };
        assert_eq!(
            (portrait.unit.as_str(), portrait.rate_unit.as_str()),
            ("°", "°/s")
        );
        assert_eq!(
            (&portrait.q[..], portrait.v[1]),
            (&[0.0, 90.0, 180.0][..], 180.0)
        );
    }

    /// A length that changes by a hundred-thousandth is a curve, not three steps.
    #[test]
    fn what_is_almost_constant_keeps_its_changes() {
        let length = |k: usize| 1.0 + 1e-5 * (k as f64 * 0.1).sin();
        let exact: Vec<f64> = (0..60).map(length).collect();
        let told = short(exact.clone());
        for (a, b) in told.iter().zip(&exact) {
            assert!((a - b).abs() < 1e-9, "{a} {b}");
            assert!(a.to_string().len() <= 12, "{a}");
        }
        assert_eq!(short(vec![1234567.0, 0.0, f64::NAN]), [1234570.0, 0.0, 0.0]);
        assert_eq!(short(vec![0.1 + 0.2; 3]), [0.3; 3]);
        assert_eq!(short(Vec::new()), Vec::<f64>::new());
    }
}
