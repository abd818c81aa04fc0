//! Which curves a picture has: what was asked for or, if nothing was, panels of forces, coordinates and outputs, one per unit.

use super::COLOURS;
use crate::outcome::{Outcome, Sample};
use crate::quantity::{Quantity, Show};
use crate::report::telling;
use crate::report::words::{Names, SMOOTH};
use lagrange_core::prelude::EventKind;
use lagrange_core::system::Description;

/// Dashes and gaps, in pixels; curves without are drawn through.
pub(super) const DASHES: [Option<(i32, i32)>; 4] =
    [None, Some((5, 4)), Some((2, 3)), Some((11, 4))];
/// Which of them a curve has, the limit of a friction, and curves after the colours have been used up.
const SOLID: usize = 0;
const LIMIT: usize = 1;
const LATER: [usize; 2] = [2, 3];

/// Curves that share both axes.
pub(super) struct Panel {
    pub title: String,
    pub over: Quantity,
    pub curves: Vec<Curve>,
}

/// A quantity and how it looks.
pub(super) struct Curve {
    pub quantity: Quantity,
    /// Index into the colours.
    pub colour: usize,
    /// Index into the patterns of dashes.
    pub dash: usize,
}

/// The phases as bands: (from, to, mode), and what each mode is called. Where there is one mode only, without a name, there are none.
#[derive(Default)]
pub(super) struct Bands {
    pub spans: Vec<(f64, f64, usize)>,
    pub names: Vec<String>,
}

pub(super) fn bands(outcome: &Outcome) -> Bands {
    let (called, mut names) = (Names::of(outcome, []), Vec::new());
    let spans: Vec<_> = outcome
        .phases
        .iter()
        .map(|phase| {
            let name = called.brief(&phase.mode);
            let mode = names
                .iter()
                .position(|known| *known == name)
                .unwrap_or_else(|| {
                    names.push(name);
                    names.len() - 1
                });
            (phase.from, phase.to, mode)
        })
        .collect();
    match names.as_slice() {
        [only] if only == SMOOTH => Bands::default(),
        _ => Bands { spans, names },
    }
}

/// What was asked for, a panel for each unit.
pub(super) fn shown(d: &Description, shows: &[Show]) -> Vec<Panel> {
    let of_one = |show: &Show| by_unit(d, &show.over, coloured(show.curves.clone()));
    shows.iter().flat_map(of_one).collect()
}

/// Forces, coordinates and outputs over time, a panel for each unit of each. Forces that never act in any of the runs are left out.
pub(super) fn usual(outcomes: &[&Outcome], d: &Description) -> Vec<Panel> {
    let acts = |quantity: &Quantity| {
        let mut samples = outcomes.iter().flat_map(|outcome| &outcome.samples);
        samples.any(|sample| quantity.of(d, sample).is_some())
    };
    let forces = coloured(Quantity::all_forces(d));
    let forces = forces
        .into_iter()
        .filter(|curve| acts(&curve.quantity))
        .collect();
    let mut panels = by_unit(d, &Quantity::Time, forces);
    let told = telling(d);
    // An output of a coordinate by its own name is that coordinate.
    let is_told = |output: &usize| {
        let name = d.observes[*output].name;
        told.iter().any(|&i| d.coordinates[i].name == name)
    };
    let outputs = (0..d.observes.len()).filter(|output| !is_told(output));
    let outputs = outputs.map(Quantity::Output).collect();
    let positions = told.into_iter().map(Quantity::Position);
    let (angles, others): (Vec<_>, Vec<_>) = positions.partition(|q| q.kind(d) == "angle");
    for quantities in [angles, others, outputs] {
        panels.extend(by_unit(d, &Quantity::Time, coloured(quantities)));
    }
    panels
}

/// Each its look: where there are more than colours, they are dashed in the next round. A limit is dashed in the colour of the force before it.
fn coloured(quantities: Vec<Quantity>) -> Vec<Curve> {
    let mut curves: Vec<Curve> = Vec::new();
    for quantity in quantities {
        let next = curves.last().map_or(0, |last| last.colour + 1);
        let bounds = |size: &Quantity| matches!((size, &quantity), (Quantity::Size(a), Quantity::Limit(b)) if a == b);
        let limit = curves.last().is_some_and(|last| bounds(&last.quantity));
        let colour = if limit { next - 1 } else { next };
        curves.push(Curve {
            colour,
            dash: match (limit, colour / COLOURS.len()) {
                (true, _) => LIMIT,
                (false, 0) => SOLID,
                (false, round) => LATER[(round - 1) % LATER.len()],
            },
            quantity,
        });
    }
    curves
}

/// One panel for each unit.
fn by_unit(d: &Description, over: &Quantity, curves: Vec<Curve>) -> Vec<Panel> {
    let mut groups: Vec<(String, Vec<Curve>)> = Vec::new();
    for curve in curves {
        let unit = curve.quantity.unit(d);
        match groups.iter_mut().find(|(known, _)| *known == unit) {
            Some((_, group)) => group.push(curve),
            None => groups.push((unit, vec![curve])),
        }
    }
    let panel = |(unit, curves): (String, Vec<Curve>)| {
        let mut kinds: Vec<&str> = curves.iter().map(|curve| curve.quantity.kind(d)).collect();
        kinds.dedup();
        Panel {
            title: with_comma(&kinds.join(", "), &unit),
            over: over.clone(),
            curves,
        }
    };
    groups.into_iter().map(panel).collect()
}

/// `force, N`
pub(super) fn with_comma(name: &str, unit: &str) -> String {
    match unit {
        "" => name.to_owned(),
        unit => format!("{name}, {unit}"),
    }
}

/// Impacts closer together than this part of the run are one on paper.
const APART: f64 = 1.0 / 2000.0;

/// Columns of a picture, about: what lies within one is seen as what it spans.
const COLUMNS: f64 = 700.0;

/// The line through points over this time, of which so many are left as a picture shows.
pub(in crate::report) fn shown_line(points: &[(f64, f64)], duration: f64) -> Vec<(f64, f64)> {
    thinned(points, duration / COLUMNS)
}

/// Of many points in a column the first, the lowest, the highest and the last: a fast oscillation fills what it spans, and never looks
/// like a slow one.
fn thinned(points: &[(f64, f64)], column: f64) -> Vec<(f64, f64)> {
    let number = |(x, _): &(f64, f64)| (x / column).floor();
    let mut thinned = Vec::new();
    for within in points.chunk_by(|a, b| number(a) == number(b)) {
        let by_height = |a: &&(f64, f64), b: &&(f64, f64)| a.1.total_cmp(&b.1);
        let ends = [within.first(), within.last()];
        let [lowest, highest] = [
            within.iter().min_by(by_height),
            within.iter().max_by(by_height),
        ];
        match (ends, lowest, highest) {
            ([Some(first), Some(last)], Some(lowest), Some(highest)) if within.len() > 4 => {
                let mut inner = [*lowest, *highest];
                inner.sort_by(|a, b| a.0.total_cmp(&b.0));
                thinned.extend([*first, inner[0], inner[1], *last]);
            }
            _ => thinned.extend_from_slice(within),
        }
    }
    thinned
}

/// What is drawn of the motion: the samples, and between them what is just before and just after each impact within a phase, so that
/// velocities jump there.
fn drawn(outcome: &Outcome) -> Vec<(usize, &Sample)> {
    let end = outcome.last().map_or(0.0, |last| last.time);
    let begin = outcome.first().map_or(0.0, |first| first.time);
    let jumps = outcome.events.iter().zip(&outcome.around);
    let jumps = jumps.filter(|(event, _)| event.kind == EventKind::Impact);
    let mut jumps =
        jumps.filter_map(|(_, [before, after])| Some([before.as_ref()?, after.as_ref()?]));
    let mut jump = jumps.next();
    let mut drawn: Vec<(usize, &Sample)> = Vec::new();
    let mut latest = f64::NEG_INFINITY;
    let samples = match outcome.curve.is_empty() {
        true => &outcome.samples,
        false => &outcome.curve,
    };
    for sample in samples {
        while let Some(sides) = jump.filter(|[before, _]| before.time <= sample.time) {
            let time = sides[0].time;
            let within = drawn
                .last()
                .is_some_and(|(phase, last)| *phase == sample.phase && last.time < time);
            if within && time < sample.time && time - latest > APART * (end - begin) {
                drawn.extend(sides.map(|side| (sample.phase, side)));
                latest = time;
            }
            jump = jumps.next();
        }
        drawn.push((sample.phase, sample));
    }
    drawn
}

/// Rounding of a coordinate, in units of its absolute tolerance.
const ROUNDING: f64 = 1e-6;

/// A quantity over another one, broken where one of them does not exist or the phase changes.
pub(super) fn pieces(
    outcome: &Outcome,
    over: &Quantity,
    quantity: &Quantity,
) -> Vec<Vec<(f64, f64)>> {
    let d = outcome.description;
    // What is far below the tolerance is rounding, however large a panel would show it.
    let sizes = outcome.samples.iter();
    let sizes = sizes.filter_map(|sample| Some(quantity.of(d, sample)?.abs()));
    let tolerance = quantity.tolerance(outcome);
    let flat = tolerance.is_some_and(|it| sizes.fold(0.0, f64::max) < ROUNDING * it);
    let value = |sample: &Sample| Some(quantity.of(d, sample)? * if flat { 0.0 } else { 1.0 });
    let pieces = lines(outcome, |sample| {
        Some((over.of(d, sample)?, value(sample)?))
    });
    match over {
        Quantity::Time => seen(outcome, pieces),
        _ => pieces,
    }
}

/// Lines over time as a picture shows them.
fn seen(outcome: &Outcome, lines: Vec<Vec<(f64, f64)>>) -> Vec<Vec<(f64, f64)>> {
    let lines = lines.iter();
    lines
        .map(|line| shown_line(line, outcome.lasts()))
        .collect()
}

/// A number over time, as a picture shows it, broken where it does not exist or the phase changes.
pub(in crate::report) fn over_time(
    outcome: &Outcome,
    value: impl Fn(&Sample) -> Option<f64>,
) -> Vec<Vec<(f64, f64)>> {
    let lines = lines(outcome, |sample| Some((sample.time, value(sample)?)));
    seen(outcome, lines)
}

/// Points of the motion, broken where one does not exist or the phase changes.
fn lines(outcome: &Outcome, point: impl Fn(&Sample) -> Option<(f64, f64)>) -> Vec<Vec<(f64, f64)>> {
    let mut pieces: Vec<Vec<(f64, f64)>> = Vec::new();
    let mut phase = None;
    for (of, sample) in drawn(outcome) {
        let Some(point) = point(sample) else {
            phase = None;
            continue;
        };
        if phase != Some(of) {
            pieces.push(Vec::new());
        }
        phase = Some(of);
        if let Some(piece) = pieces.last_mut() {
            piece.push(point);
        }
    }
    pieces
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::file;
    use crate::request::Request;

    /// A ball falls 1 m for √(2/g) and bounces with half its speed.
    #[test]
    fn velocities_jump_at_an_impact() {
        let declared = "parameters(gravity = 8, height = 1), coordinates(y), kinetic = der(y)^2/2, potential = gravity * y,
            contact(floor: y >= 0, restitution = 0.5), start(drop: y = height), until = 0.9";
        let scene = file::scene("ball.lagrange", declared).expect("a declaration");
        let request = Request {
            samples: 7,
            ..Request::default()
        };
        let outcome = scene.run(&request).expect("a run");
        let pieces = pieces(&outcome, &Quantity::Time, &Quantity::Velocity(0));
        let [piece] = &pieces[..] else {
            panic!("one phase: {pieces:?}");
        };
        let jump = piece.windows(2).find(|pair| pair[0].0 == pair[1].0);
        let [(time, before), (_, after)] = jump.expect("a jump") else {
            panic!("two points");
        };
        assert!(
            (time - 0.5).abs() < 1e-12 && (before + 4.0).abs() < 1e-9 && (after - 2.0).abs() < 1e-9
        );
        assert!(piece.is_sorted_by(|a, b| a.0 <= b.0));
    }

    fn plotted(declared: &str) -> Outcome {
        let scene = file::scene("plotted.lagrange", declared).expect("a declaration");
        let request = Request {
            samples: 400,
            plotted: true,
            ..Request::default()
        };
        scene.run(&request).expect("a run")
    }

    /// 200.5 Hz for 2 s: at the 400 samples alone it looks like 0.5 Hz. Every hundredth of the picture has both peaks.
    #[test]
    fn a_fast_oscillation_fills_what_it_spans() {
        let outcome = plotted(
            "parameters(w = 1259.7787), coordinates(x, still), kinetic = (der(x)^2 + der(still)^2)/2,
             potential = w^2 * x^2/2, start(out: x = 1, still = 1e-17), until = 2,",
        );
        assert_eq!(outcome.samples.len(), 401);
        let pieces = pieces(&outcome, &Quantity::Time, &Quantity::Position(0));
        let [piece] = &pieces[..] else {
            panic!("one phase: {}", pieces.len());
        };
        assert!(piece.len() < 3000, "{}", piece.len());
        assert!(piece.is_sorted_by(|a, b| a.0 <= b.0));
        for part in 0..100 {
            let begin = f64::from(part) * 0.02;
            let inside = piece
                .iter()
                .filter(|(t, _)| (begin..begin + 0.02).contains(t));
            let (low, high) = inside.fold((0.0_f64, 0.0_f64), |(low, high), (_, x)| {
                (low.min(*x), high.max(*x))
            });
            assert!(low < -0.95 && high > 0.95, "{begin}: {low} {high}");
        }
        let still = super::pieces(&outcome, &Quantity::Time, &Quantity::Position(1));
        assert!(still[0].iter().all(|(_, x)| *x == 0.0));
    }

    #[test]
    fn what_is_observed_is_drawn_once() {
        let outcome = plotted(
            "parameters(m: \"kg\" = 1, g: \"m/s^2\" = 10, l: \"m\" = 2), coordinates(theta: \"rad\", s: \"m\"),
             kinetic = m/2 * (l^2 * der(theta)^2 + der(s)^2), potential = -m * g * l * cos(theta),
             observe(height = -l * cos(theta), s, speed = l * der(theta), across = l * sin(theta)), start(up: theta = 1), until = 1",
        );
        let d = outcome.description;
        let names = |panel: &Panel| {
            let names = panel.curves.iter().map(|curve| curve.quantity.name(d));
            names.collect::<Vec<_>>().join(" ")
        };
        let panels: Vec<String> = usual(&[&outcome], d).iter().map(names).collect();
        assert_eq!(panels, ["θ", "s", "height across", "speed"]);
    }

    #[test]
    fn no_two_curves_look_alike() {
        let outcome = plotted(
            "coordinates(x[12]), kinetic = sum(i in 0..12: der(x[i])^2), friction(rub: slip = der(x[0]), limit = 1), until = 1",
        );
        let panels = usual(&[&outcome], outcome.description);
        let limit = &panels[0].curves[1];
        assert_eq!(limit.quantity.name(outcome.description), "limit of rub");
        for panel in &panels {
            let looks = panel
                .curves
                .iter()
                .map(|c| (c.colour % COLOURS.len(), c.dash));
            let looks: std::collections::BTreeSet<_> = looks.collect();
            assert_eq!(looks.len(), panel.curves.len());
        }
    }

    #[test]
    fn names_are_found_and_mistakes_told() {
        let declared =
            "coordinates(r, theta), kinetic = der(r)^2 + r^2 * der(theta)^2, contact(rim: r >= 1),
            friction(grip on rim: slip = der(theta), static = 1)";
        let scene = file::scene("wheel.lagrange", declared).expect("a declaration");
        let d = scene.description();
        let show = Show::new("theta, grip ,limit( grip ) vs der(theta)", d).expect("curves");
        assert_eq!((show.curves.len(), &show.over), (3, &Quantity::Velocity(1)));
        assert_eq!(Show::new("energy", d).expect("curves").over, Quantity::Time);
        let said = |text: &str| Show::new(text, d).expect_err("a mistake").to_string();
        assert!(said("thet vs t").contains("did you mean `theta`?"));
        assert!(said("theta vs thetadot").contains("did you mean `der(theta)`?"));
        assert!(said("limit(grib)").contains("did you mean `limit(grip)`?"));
        assert!(said("theta,").contains("no quantity is called ``"));
        assert!(said("der(der(r)) + 1").contains("`observe(u = der(der(r))+1)`"));
        assert!(said("slip(grip)").contains("`observe(u = slip(grip))`"));
        for unknown in ["force(rim)", "limit(rim)", "dr/dt", "r +", "theta(2)"] {
            assert!(
                said(unknown).starts_with("no quantity is called `"),
                "{unknown}"
            );
        }
    }

    #[test]
    fn an_array_means_all_of_its_elements() {
        let declared = "coordinates(x[2], y), kinetic = der(y)^2 + sum(i in 0..2: der(x[i])^2), force(pull: y = 1)";
        let scene = file::scene("array.lagrange", declared).expect("a declaration");
        let d = scene.description();
        let show = Show::new("x, y, der(x)", d).expect("curves");
        let [x, y] = [Quantity::Position, Quantity::Velocity].map(|of| [of(0), of(1)]);
        assert_eq!(show.curves, [&x[..], &[Quantity::Position(2)], &y].concat());
        let said = |text: &str| Show::new(text, d).expect_err("a mistake").to_string();
        assert!(said("y vs x").contains("did you mean `x[0]`?"));
        assert!(said("pull").contains("`observe(u = pull)`"));
    }
}
