//! Film → plots: forces beside their limits, energies, work, and the phase plots.

use super::super::with_unit;
use super::difference::difference;
use super::digits::{short, told};
use super::fine::{Fine, Lines, fine, lines};
use crate::film::Film;
use crate::notation::symbol;
use crate::number::significant;
use crate::outcome::{Force, Outcome, Sample, Source, forces};
use crate::quantity::{Quantity, force_word, limit_name};
use crate::report::plot::shown_line;
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
    pub curves: Vec<Curve>,
}

#[derive(Serialize)]
pub(super) struct Curve {
    name: String,
    /// Whether it bounds the other one.
    #[serde(skip_serializing_if = "is_false")]
    limit: bool,
    values: Vec<Option<f64>>,
    /// Points of its own, where those are too few.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fine: Option<Fine>,
}

/// A coordinate and its rate.
#[derive(Serialize)]
pub(super) struct Portrait {
    name: String,
    unit: String,
    rate_unit: String,
    q: Vec<f64>,
    v: Vec<f64>,
    /// Points of their own, where those are too few.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub q_fine: Option<Fine>,
    /// See `q_fine`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub v_fine: Option<Fine>,
    /// Less that of the first run of the scene.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    apart: Vec<Option<f64>>,
}

/// An extra output over time.
#[derive(Serialize)]
pub(super) struct Output {
    name: &'static str,
    unit: String,
    values: Vec<Option<f64>>,
    /// Points of its own, where those are too few.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fine: Option<Fine>,
}

/// What the declaration observes.
pub(super) fn outputs(outcome: &Outcome) -> Vec<Output> {
    let list = outcome.description.observes.iter().enumerate();
    let output = |(i, observe): (usize, &lagrange_core::system::Observe)| {
        let quantity = Quantity::Output(i);
        let of = |sample: &Sample| quantity.of(outcome.description, sample);
        Output {
            name: observe.name,
            unit: quantity.unit(outcome.description),
            values: told(&outcome.samples.iter().map(of).collect::<Vec<_>>()),
            fine: fine_alone(outcome, &quantity),
        }
    };
    list.map(output).collect()
}

/// More coordinates than this do not have portraits.
const PORTRAITS: usize = 12;
/// More plots of forces than this are left out.
const PLOTS: usize = 12;
/// More items than this do not have curves in one plot.
const CURVES: usize = 6;

/// How many of these are left out.
pub(super) type LeftOut = (&'static str, usize);

/// All plots over time, and what is left out of them.
pub(super) fn plots(film: &Film) -> (Vec<Plot>, [LeftOut; 2]) {
    let outcome = &film.outcome;
    let mut plots = frictions(outcome);
    plots.extend(pushes(outcome, "Contact forces", |source| {
        matches!(source, Source::Contact(_))
    }));
    plots.extend(pushes(outcome, "Constraint forces", |source| {
        matches!(source, Source::Constraint(_))
    }));
    let forces = plots.len().saturating_sub(PLOTS);
    plots.truncate(PLOTS);
    plots.push(energies(outcome));
    let (work, works) = work(film);
    plots.extend(work);
    (
        plots,
        [("Plots of forces", forces), ("Curves of work", works)],
    )
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
        let curves = vec![
            curve(outcome, format!("|{name}|"), false, held),
            curve(outcome, limit_name(friction).to_owned(), true, |sample| {
                sample.limits[i]
            }),
        ];
        Plot {
            title: format!("Friction {name} and what it can hold"),
            axis: force_axis(description.units.row(friction.row)),
            time: Vec::new(),
            curves: drawn_finely(&times(outcome), curves),
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
            curves: drawn_finely(&times(outcome), some.iter().map(curve).collect()),
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
        curves: drawn_finely(&times(outcome), curves.collect()),
    }
}

/// The work, from the beginning, of the items that do most of it, and how many others do some.
fn work(film: &Film) -> (Option<Plot>, usize) {
    let Some((_, last)) = film.books.last() else {
        return (None, 0);
    };
    let worked = |i: usize| {
        let books = film.books.iter();
        books
            .map(|(_, ledger)| ledger.work[i].work.abs())
            .fold(0.0, f64::max)
    };
    let items = 0..last.work.len();
    let mut items: Vec<usize> = items.filter(|&i| worked(i) > 1e-9 * last.scale).collect();
    items.sort_by(|&a, &b| worked(b).total_cmp(&worked(a)));
    let left_out = items.len().saturating_sub(CURVES);
    items.truncate(CURVES);
    items.sort_unstable();
    let books = film.books.iter();
    let times: Vec<f64> = books.clone().map(|(time, _)| *time).collect();
    let outcome = &film.outcome;
    let curve = |i: usize| {
        let works = books.clone().map(|(_, ledger)| ledger.work[i].work);
        let dense = outcome.curve.iter().zip(&outcome.curve_ledgers);
        let dense = dense.map(|(sample, ledger)| (sample.time, ledger.work[i].work));
        let curve = Curve {
            name: format!("{} ({})", last.work[i].name, last.work[i].kind),
            limit: false,
            values: short(works.collect()).into_iter().map(Some).collect(),
            fine: None,
        };
        let line = shown_line(&dense.collect::<Vec<_>>(), outcome.lasts());
        (curve, vec![line])
    };
    let plot = (!items.is_empty()).then(|| Plot {
        title: "Work since the start".to_owned(),
        axis: with_unit("work", outcome.description.units.energy),
        curves: drawn_finely(&times, items.iter().map(|&i| curve(i)).collect()),
        time: short(times),
    });
    (plot, left_out)
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
            q_fine: fine_alone(outcome, &q),
            v_fine: fine_alone(outcome, &v),
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

/// A curve through the samples, and the lines of a finer one.
fn curve(
    outcome: &Outcome,
    name: String,
    limit: bool,
    of: impl Fn(&Sample) -> Option<f64>,
) -> (Curve, Lines) {
    let lines = lines(outcome, &of);
    let values: Vec<Option<f64>> = outcome.samples.iter().map(of).collect();
    let curve = Curve {
        name,
        limit,
        values: told(&values),
        fine: None,
    };
    (curve, lines)
}

/// Curves of one plot, with lines of their own where the values at these times are too few.
fn drawn_finely(times: &[f64], curves: Vec<(Curve, Lines)>) -> Vec<Curve> {
    let (mut curves, lines): (Vec<Curve>, Vec<Lines>) = curves.into_iter().unzip();
    let pairs = curves.iter().map(|curve| &curve.values[..]).zip(lines);
    let fine = fine(times, &pairs.collect::<Vec<_>>());
    for (curve, fine) in curves.iter_mut().zip(fine) {
        curve.fine = fine;
    }
    curves
}

/// The lines of a number that is drawn alone, where the samples are too few.
fn fine_alone(outcome: &Outcome, quantity: &Quantity) -> Option<Fine> {
    let of = |sample: &Sample| quantity.of(outcome.description, sample);
    let values: Vec<Option<f64>> = outcome.samples.iter().map(of).collect();
    fine(&times(outcome), &[(&values, lines(outcome, of))])
        .pop()
        .flatten()
}

/// When the samples are.
fn times(outcome: &Outcome) -> Vec<f64> {
    outcome.samples.iter().map(|sample| sample.time).collect()
}

pub(super) fn over(outcome: &Outcome, of: impl Fn(&Sample) -> f64) -> Vec<f64> {
    short(outcome.samples.iter().map(of).collect())
}

fn is_false(flag: &bool) -> bool {
    !flag
}

#[cfg(test)]
mod tests {
    use super::{plots, portraits};
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

    /// A bead on a rod of 2 m that swings by 1/500: the rod pulls with 3 m g (cos θ − cos α) + m g cos α, which changes by 6e-6 of itself.
    #[test]
    fn a_force_that_hardly_changes_is_a_curve() {
        let declared = "parameters(m: \"kg\" = 3, g: \"m/s^2\" = 10, l: \"m\" = 2, a = 0.002), coordinates(x: \"m\", y: \"m\"),
            kinetic = m/2*(der(x)^2 + der(y)^2), potential = m*g*y, constraint(rod: sqrt(x^2 + y^2) == l),
            start(small: x = l*sin(a), y = -l*cos(a)), until = 3";
        let scene = file::scene("small.lagrange", declared).expect("a declaration");
        let film = scene
            .film(&Request {
                samples: 100,
                ..Request::default()
            })
            .expect("a run");
        let (plots, _) = plots(&film);
        let told = &plots[0].curves[0].values;
        for (sample, told) in film.outcome.samples.iter().zip(told) {
            let cosine = -sample.state.q[1] / 2.0;
            let pull = 30.0 * (3.0 * cosine - 2.0 * 0.002_f64.cos());
            let told = told.expect("a force").abs();
            assert!((told - pull).abs() < 3e-8, "{told} {pull}");
        }
    }

    /// Eight masses that dampers slow down, of which the last two are by far the fastest and the first the slowest: six curves.
    #[test]
    fn what_does_most_work_has_a_curve() {
        let declared = "coordinates(x[14]), kinetic = sum(k in 0..14: der(x[k])^2/2), dissipation(d[k in 0..8]: der(x[k])^2/2),
            start(go: der(x[0]) = 1, der(x[1]) = 2, der(x[2]) = 5, der(x[3]) = 3, der(x[4]) = 4, der(x[5]) = 6, der(x[6]) = 9, der(x[7]) = 8),
            until = 1";
        let scene = file::scene("dampers.lagrange", declared).expect("a declaration");
        let film = scene.film(&Request::default()).expect("a run");
        let (plots, left_out) = plots(&film);
        let work = plots.last().expect("a plot");
        let names: Vec<&str> = work.curves.iter().map(|curve| &curve.name[..4]).collect();
        assert_eq!(names, ["d[2]", "d[3]", "d[4]", "d[5]", "d[6]", "d[7]"]);
        assert_eq!(left_out[1], ("Curves of work", 2));
        // v = 9 e^−t.
        let lost = work.curves[4]
            .values
            .last()
            .expect("a value")
            .expect("work");
        assert!(
            (lost + 40.5 * (1.0 - (-2.0_f64).exp())).abs() < 1e-4,
            "{lost}"
        );
    }
}
