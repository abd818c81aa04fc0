//! Films → pictures: what is drawn where, in units of a page 1000 wide, over all samples.
//!
//! Pages, single frames and animated pictures are drawn from this; what is left to them is to put the shapes down.

mod arrow;
mod column;
mod frame;
mod impulse;
mod mark;
mod painter;
pub(crate) mod palette;
mod stage;
mod view;

use crate::film::Film;
use crate::number::significant;
pub(crate) use arrow::{Arrow, label, outline};
pub(crate) use column::{Column, Place};
use frame::{Frame, largest};
pub(crate) use mark::{Form, Mark, Stroke, part};
pub(crate) use painter::Painter;
use serde::Serialize;
pub(crate) use stage::{Stage, stages};

/// Units from left to right.
pub(crate) const WIDTH: f64 = 1000.0;

/// A scene over time.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct Picture {
    /// Units from top to bottom.
    pub height: f64,
    /// Shapes from the back to the front.
    pub marks: Vec<Mark>,
    /// Forces, in front of the shapes.
    pub arrows: Vec<Arrow>,
    /// What lengths mean: one of metres, one of newtons if there are forces, one of newton seconds if there are impulses.
    pub rulers: Vec<Ruler>,
    /// Whether some arrows are drawn shorter than the force is large.
    pub cut: bool,
}

/// A length of the picture and what it stands for.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(crate) struct Ruler {
    /// Units.
    pub length: f64,
    /// `0.2 m`
    pub text: String,
}

/// A picture for each film, `None` where a scene does not say how it is drawn. Films of one scene have one scale.
pub(crate) fn pictures(films: &[&Film]) -> Vec<Option<Picture>> {
    let picture = |film: &&Film| {
        let alike = films.iter().copied();
        let alike = alike.filter(|other| other.outcome.scene == film.outcome.scene);
        let frame = Frame::around(alike)?;
        let first = film.drawings.first()?;
        let marks = mark::marks(film, &frame);
        let arrows = arrow::arrows(film, &frame);
        let mut rulers = vec![Ruler::new(frame.ruler(), frame.scale, "m")];
        if !first.arrows.is_empty() && frame.newtons.strongest > 0.0 {
            let newton = frame.newtons.reach * frame.scale;
            rulers.push(Ruler::new(nice(0.6 * frame.newtons.strongest), newton, "N"));
        }
        if frame.blows.strongest > 0.0 {
            let blow = frame.blows.reach * frame.scale;
            rulers.push(Ruler::new(nice(0.6 * frame.blows.strongest), blow, "N s"));
        }
        Some(Picture {
            height: hundredths(frame.height()),
            marks,
            cut: arrows
                .iter()
                .any(|arrow| !arrow.impulse && largest(&arrow.size) > frame.newtons.most()),
            arrows,
            rulers,
        })
    };
    films.iter().map(picture).collect()
}

impl Ruler {
    /// So many of a unit that takes `scale` units of the page.
    fn new(count: f64, scale: f64, unit: &str) -> Self {
        Self {
            length: hundredths(count * scale),
            text: format!("{} {unit}", short(count)),
        }
    }
}

/// The largest of 1, 2 and 5 times a power of ten that is not above x; 1 where there is none.
pub(crate) fn nice(x: f64) -> f64 {
    if !(x.is_finite() && x > 0.0) {
        return 1.0;
    }
    let power = 10_f64.powi(x.log10().floor() as i32);
    let steps = [5.0, 2.0, 1.0].into_iter();
    steps
        .map(|step| step * power)
        .find(|length| *length <= x * (1.0 + 1e-9))
        .unwrap_or(power)
}

/// One of [`nice`] to read.
fn short(x: f64) -> String {
    match (1e-3..1e5).contains(&x) {
        // Not 0.30000000000000004.
        true => ((x * 1e6).round() / 1e6).to_string(),
        false => format!("{x:.0e}"),
    }
}

/// A time to nine digits: a path may go round many times.
fn finely(time: f64) -> f64 {
    format!("{time:.8e}").parse().unwrap_or(time)
}

/// To hundredths of a unit, which nobody sees.
fn hundredths(x: f64) -> f64 {
    (x * 100.0).round() / 100.0 + 0.0
}

/// The size of a force, with the digits that are told; none where it is no number.
fn strength(size: f64) -> f64 {
    if size.is_finite() {
        significant(size)
    } else {
        f64::NAN
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rulers_have_round_lengths() {
        let texts = [0.3, 0.7, 2.0, 1234.0, 3e-5, 2e7].map(|x| short(nice(x)));
        assert_eq!(texts, ["0.2", "0.5", "2", "1000", "2e-5", "2e7"]);
        assert_eq!(nice(0.0), 1.0);
        assert_eq!(hundredths(-0.001).to_string(), "0");
    }
}
