//! Which curves a picture has: one panel of forces, one per unit of the coordinates, broken where modes change.

use crate::outcome::{Outcome, Sample, Source, forces};
use crate::report::words::brief;
use crate::report::{is_angle, symbol};

/// Curves that share an axis.
pub(super) struct Panel {
    pub title: String,
    pub curves: Vec<Curve>,
}

/// One named quantity over time, in pieces: (time, value).
pub(super) struct Curve {
    pub name: String,
    pub pieces: Vec<Vec<(f64, f64)>>,
    pub dashed: bool,
    /// Index into the colours.
    pub colour: usize,
}

/// The phases as bands: (from, to, mode), and what each mode is called.
pub(super) struct Bands {
    pub spans: Vec<(f64, f64, usize)>,
    pub names: Vec<String>,
}

pub(super) fn bands(outcome: &Outcome) -> Bands {
    let mut names: Vec<String> = Vec::new();
    let spans = outcome
        .phases
        .iter()
        .map(|phase| {
            let name = brief(&phase.mode, outcome.description);
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
    Bands { spans, names }
}

pub(super) fn panels(outcome: &Outcome) -> Vec<Panel> {
    let description = outcome.description;
    let mut panels: Vec<Panel> = by_unit(force_curves(outcome), "force");
    let coordinates = description.coordinates.iter().enumerate();
    let curves = coordinates.map(|(i, coordinate)| {
        let angle = is_angle(coordinate);
        let scale = if angle {
            180.0 / core::f64::consts::PI
        } else {
            1.0
        };
        let value = |sample: &Sample| Some(sample.state.q[i] * scale);
        let curve = Curve {
            name: symbol(coordinate.name),
            pieces: pieces(outcome, value),
            dashed: false,
            colour: 0,
        };
        (if angle { "°" } else { coordinate.unit }, curve)
    });
    let (angles, others): (Vec<_>, Vec<_>) = curves.partition(|(unit, _)| *unit == "°");
    panels.extend(by_unit(recoloured(angles), "angle"));
    panels.extend(by_unit(recoloured(others), "position"));
    panels
}

/// Colours in order.
fn recoloured(curves: Vec<(&'static str, Curve)>) -> Vec<(&'static str, Curve)> {
    let curves = curves.into_iter().enumerate();
    curves
        .map(|(colour, (unit, curve))| (unit, Curve { colour, ..curve }))
        .collect()
}

/// One panel for each unit.
fn by_unit(curves: Vec<(&'static str, Curve)>, what: &str) -> Vec<Panel> {
    let mut panels: Vec<Panel> = Vec::new();
    for (unit, curve) in curves {
        let title = match unit {
            "" => what.to_owned(),
            unit => format!("{what}, {unit}"),
        };
        match panels.iter_mut().find(|panel| panel.title == title) {
            Some(panel) => panel.curves.push(curve),
            None => panels.push(Panel {
                title,
                curves: vec![curve],
            }),
        }
    }
    panels
}

/// Curves with their units.
fn force_curves(outcome: &Outcome) -> Vec<(&'static str, Curve)> {
    let description = outcome.description;
    let mut curves = Vec::new();
    let mut forces = forces(description);
    // A friction of two components is one curve, too.
    forces.dedup_by_key(|force| force.source);
    for (colour, force) in forces.into_iter().enumerate() {
        let value = |sample: &Sample| {
            let value = match force.source {
                Source::Friction(i) => {
                    let components = description.frictions[i].components;
                    let parts = &sample.forces[force.row..force.row + components];
                    parts.iter().fold(0.0, |size, x| x.hypot(size))
                }
                _ => sample.forces[force.row],
            };
            force.acts(description, &sample.mode).then_some(value)
        };
        let name = match force.source {
            Source::Friction(i) => format!("|{}|", description.frictions[i].name),
            _ => force.name.clone(),
        };
        let unit = description.units.row(force.row);
        let curve = Curve {
            name,
            pieces: pieces(outcome, value),
            dashed: false,
            colour,
        };
        curves.push((unit, curve));
        if let Source::Friction(i) = force.source {
            let limit = |sample: &Sample| sample.limits[i];
            let name = format!("μN of {}", description.frictions[i].name);
            let curve = Curve {
                name,
                pieces: pieces(outcome, limit),
                dashed: true,
                colour,
            };
            curves.push((unit, curve));
        }
    }
    curves.retain(|(_, curve)| !curve.pieces.is_empty());
    curves
}

/// The values of a quantity, broken where it does not exist or the phase changes.
fn pieces(outcome: &Outcome, value: impl Fn(&Sample) -> Option<f64>) -> Vec<Vec<(f64, f64)>> {
    let mut pieces: Vec<Vec<(f64, f64)>> = Vec::new();
    let mut phase = None;
    for sample in &outcome.samples {
        let Some(value) = value(sample) else {
            phase = None;
            continue;
        };
        if phase != Some(sample.phase) {
            pieces.push(Vec::new());
        }
        phase = Some(sample.phase);
        if let Some(piece) = pieces.last_mut() {
            piece.push((sample.time, value));
        }
    }
    pieces
}
