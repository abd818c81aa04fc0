//! Curves over time that need more points than the samples of a page are: those of fast oscillations.

use super::digits::told;
use crate::outcome::{Outcome, Sample};
use crate::report::picture::{Column, Place};
use crate::report::plot::{CONSTANT, over_time};
use crate::straight::straightened;
use serde::Serialize;

/// Points of a curve of its own: what lies in a column of a picture is seen as what it spans.
#[derive(Serialize)]
pub(super) struct Fine {
    time: Vec<f64>,
    values: Vec<Option<f64>>,
}

/// Part of the height of a plot by which a curve may be off without being seen to be: about the width of its stroke.
const UNSEEN: f64 = 0.012;

/// A number over time as it is drawn: lines through points.
pub(super) type Lines = Vec<Vec<(f64, f64)>>;

/// A number of the motion over time, as it is drawn.
pub(super) fn lines(outcome: &Outcome, of: impl Fn(&Sample) -> Option<f64>) -> Lines {
    over_time(outcome, |sample| of(sample).filter(|x| x.is_finite()))
}

/// Of curves on the same axes, those that are drawn with lines of their own, as the values at the times of the page do not show what
/// one of them spans.
pub(super) fn fine(times: &[f64], curves: &[(&[Option<f64>], Lines)]) -> Vec<Option<Fine>> {
    let coarse = curves
        .iter()
        .flat_map(|(values, _)| values.iter().copied().flatten());
    let points = curves.iter().flat_map(|(_, lines)| lines.iter().flatten());
    let all = || {
        coarse
            .clone()
            .chain(points.clone().map(|(_, value)| *value))
    };
    let span = all().fold(f64::MIN, f64::max) - all().fold(f64::MAX, f64::min);
    let size = all().fold(0.0, |size: f64, x| size.max(x.abs()));
    let unseen = UNSEEN * span;
    let missed = |(values, lines): &(&[Option<f64>], Lines)| {
        let values = Column::of(values.iter().map(|value| value.unwrap_or(f64::NAN)));
        let off = |(time, value): &(f64, f64)| {
            let place = Place::of(*time, times);
            place.part > 0.0 && (values.at(place) - value).abs() > unseen
        };
        lines.iter().flatten().any(off)
    };
    let needed = span > CONSTANT * size && curves.iter().any(missed);
    let fine = |(_, lines): &(&[Option<f64>], Lines)| needed.then(|| Fine::of(lines, unseen));
    curves.iter().map(fine).collect()
}

impl Fine {
    /// Lines one after the other, with no value between them, which may be off by so much.
    fn of(lines: &Lines, off: f64) -> Self {
        let points = lines.iter().flat_map(|line| {
            let end = line.last().map(|(time, _)| (*time, None));
            let points = straightened(line, off, |&(time, value)| (time, [value])).into_iter();
            let points = points.map(|(time, value)| (time, Some(value)));
            points.chain(end)
        });
        let (times, values): (Vec<f64>, Vec<Option<f64>>) = points.unzip();
        let times = told(&times.into_iter().map(Some).collect::<Vec<_>>());
        Self {
            time: times.into_iter().flatten().collect(),
            values: told(&values),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::curves::{outputs, plots, portraits};
    use super::Fine;
    use crate::file;
    use crate::film::Film;
    use crate::request::Request;

    /// A mass on a spring that is declared as a force, set out with a speed of 0.3 m/s, at so many radians a second.
    fn film(rate: f64) -> Film {
        let declared = format!(
            "parameters(m: \"kg\" = 2, w = {rate:?}), coordinates(y: \"m\"), kinetic = m/2*der(y)^2, force(spring: y = -m*w^2*y),
             observe(square = (w*y)^2), start(go: der(y) = 0.3), until = 20"
        );
        let scene = file::scene("fine.lagrange", &declared).expect("a declaration");
        let request = Request {
            samples: 900,
            plotted: true,
            ..Request::default()
        };
        scene.film(&request).expect("a film")
    }

    /// 740 oscillations: everything in them goes from end to end in every fiftieth of the run.
    #[test]
    fn a_fast_oscillation_has_points_of_its_own() {
        let rate = core::f64::consts::TAU * 37.0;
        let film = film(rate);
        let fills = |fine: Option<&Fine>, [low, high]: [f64; 2]| {
            let fine = fine.expect("points of its own");
            assert!(fine.time.len() < 3000, "{}", fine.time.len());
            for part in 0..50 {
                let begin = 0.4 * f64::from(part);
                let values = fine.time.iter().zip(&fine.values);
                let inside = values.filter(|(t, _)| (begin..begin + 0.4).contains(*t));
                let ends = inside.filter_map(|(_, value)| *value);
                let ends = ends.fold([f64::MAX, f64::MIN], |[a, b], x| [a.min(x), b.max(x)]);
                let off = (ends[0] - low).abs().max((ends[1] - high).abs());
                assert!(off < 0.02 * (high - low), "{begin}: {ends:?}");
            }
        };
        let [portrait] = &portraits(&film.outcome, None)[..] else {
            panic!("one coordinate");
        };
        let far = 0.3 / rate;
        fills(portrait.q_fine.as_ref(), [-far, far]);
        fills(portrait.v_fine.as_ref(), [-0.3, 0.3]);
        fills(outputs(&film.outcome)[0].fine.as_ref(), [0.0, 0.09]);
        let (plots, _) = plots(&film);
        let [energies, works] = &plots[..] else {
            panic!("two plots: {}", plots.len());
        };
        fills(energies.curves[0].fine.as_ref(), [0.0, 0.09]);
        fills(works.curves[0].fine.as_ref(), [-0.09, 0.0]);
    }

    #[test]
    fn a_slow_motion_is_drawn_through_the_samples() {
        let film = film(0.3);
        let (plots, _) = plots(&film);
        let curves = plots.iter().flat_map(|plot| &plot.curves);
        assert!(curves.map(|curve| &curve.fine).all(Option::is_none));
        let portraits = portraits(&film.outcome, None);
        assert!(portraits[0].q_fine.is_none() && portraits[0].v_fine.is_none());
    }
}
