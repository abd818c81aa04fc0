//! Guards with products of readings in them: cones of friction, and normal forces that have no sign, or are not multipliers.

use super::coefficients::{add, add_product, add_root, numbers};
use super::linear::linear_limit;
use super::{Guard, LENGTH, pressed_by_constraints};
use crate::arithmetic::Scalar;
use crate::mode::{Direction, FrictionMode, Mode, Sliding};
use crate::modes::reading::{Reading, Terms};
use crate::system::Normal;

/// The plane μs N − u·F = 0 that touches the cone of a sticking friction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConePlane {
    /// Its direction u.
    pub along: [f64; 2],
    /// N is the sum of the forces of the constraints that press times these, the sign of one or the direction of several; or that of a contact.
    pub pressing: [f64; 3],
}

/// Adds a guard that is not [`Linear`].
pub(super) fn of_products<T: Scalar>(
    guard: Guard,
    mode: &Mode,
    reading: &Reading<'_, T>,
    out: &mut [f64],
) {
    let d = reading.description();
    match guard {
        Guard::StickUpper(f) => {
            limit(f, mode, reading, out);
            add(out, (-1.0, reading.force(d.frictions[f].row)));
        }
        Guard::StickLower(f) => {
            limit(f, mode, reading, out);
            add(out, (1.0, reading.force(d.frictions[f].row)));
        }
        Guard::StickCone(f) => stick_cone(f, mode, reading, out),
        Guard::NormalForceSign(f) => match d.frictions[f].normal {
            Normal::Resultant(i) => {
                let along = reading.resultant_direction(i).map(|u| u.value());
                add_pressing(f, along, reading, out);
            }
            _ => normal_force(f, mode, reading, out),
        },
        Guard::Slip(f) => {
            let friction = &d.frictions[f];
            let rows = &d.rows[friction.rows()];
            let along = match mode.frictions[f] {
                FrictionMode::Slip(Sliding {
                    direction: Direction::Fixed(along),
                    ..
                }) => along,
                FrictionMode::Slip(_) => reading.slip_direction(f).map(|x| x.value()),
                _ => return,
            };
            for (row, along) in rows.iter().zip(along) {
                add(out, (along, reading.motion(row.velocity)));
            }
        }
        // The others are linear; the parts of a composite guard are known to `redundant` only.
        _ => {}
    }
}

/// Adds μs N.
fn limit<T: Scalar>(f: usize, mode: &Mode, reading: &Reading<'_, T>, out: &mut [f64]) {
    if let Some((coefficient, normal)) = linear_limit(f, reading.dynamics()) {
        return add(out, (coefficient, normal.read(reading)));
    }
    let mut normal = [0.0; LENGTH];
    let normal = &mut normal[..out.len()];
    normal_force(f, mode, reading, normal);
    add_static_share(f, normal, reading, out);
}

/// Adds μs times the series `normal`.
fn add_static_share<T: Scalar>(f: usize, normal: &[f64], reading: &Reading<T>, out: &mut [f64]) {
    let friction = &reading.description().frictions[f];
    match reading.motion(friction.static_coefficient) {
        Terms::One(coefficient) => {
            for (c, x) in out.iter_mut().zip(normal) {
                *c += coefficient.value() * *x;
            }
        }
        coefficient => add_product(out, 1.0, &numbers(coefficient), normal),
    }
}

/// What the forces of a cone are divided by before they are squared, of their values at an instant: 1, or where squares are soon no numbers, beyond 1e38 N
/// and below 1e-38 N, a power of two.
pub fn cone_unit(forces: impl Iterator<Item = f64>) -> f64 {
    const STEP: f64 = 256.0;
    let largest = forces.fold(0.0, |largest: f64, force| largest.max(force.abs()));
    if largest > 0.0 {
        (STEP * (largest.log2() / STEP).round().clamp(-3.0, 3.0)).exp2()
    } else {
        1.0
    }
}

/// (μs N)² − Σ F², in [units of their own](cone_unit).
fn stick_cone<T: Scalar>(f: usize, mode: &Mode, reading: &Reading<'_, T>, out: &mut [f64]) {
    let friction = &reading.description().frictions[f];
    let rows = friction.rows();
    let mut greatest = [0.0; LENGTH];
    let first = |row: usize| reading.force(row).first().value();
    let values = rows.clone().map(first);
    let part = if let normal @ Normal::Resultant(_) = friction.normal {
        // The square has a series also where the root has none.
        let presses = normal.rows(reading.description()).map(first);
        let part = 1.0 / cone_unit(values.chain(presses));
        let coefficient = numbers(reading.motion(friction.static_coefficient));
        let [mut square, mut one] = [[0.0; LENGTH]; 2];
        add_squares(&mut square, part, normal, reading);
        add_product(&mut one, 1.0, &coefficient, &coefficient);
        add_product(out, 1.0, &one, &square);
        part
    } else {
        limit(f, mode, reading, &mut greatest[..out.len()]);
        let part = 1.0 / cone_unit(values.chain([greatest[0]]));
        greatest.iter_mut().for_each(|c| *c *= part);
        add_product(out, 1.0, &greatest, &greatest);
        part
    };
    for row in rows {
        let mut force = [0.0; LENGTH];
        add(&mut force, (part, reading.force(row)));
        add_product(out, -1.0, &force, &force);
    }
}

/// μs N − u·F: how far the force of a sticking friction is inside a plane that touches its cone.
pub fn cone_side<T: Scalar>(
    f: usize,
    plane: ConePlane,
    mode: &Mode,
    reading: &Reading<'_, T>,
    out: &mut [f64],
) {
    let friction = &reading.description().frictions[f];
    out.fill(0.0);
    if pressed_by_constraints(friction) {
        let mut normal = [0.0; LENGTH];
        let normal = &mut normal[..out.len()];
        add_pressing(f, plane.pressing, reading, normal);
        add_static_share(f, normal, reading, out);
    } else {
        limit(f, mode, reading, out);
    }
    for (k, &part) in plane.along.iter().enumerate().take(friction.components) {
        add(out, (-part, reading.force(friction.row + k)));
    }
}

/// Adds the normal force N of friction `f`.
fn normal_force<T: Scalar>(f: usize, mode: &Mode, reading: &Reading<'_, T>, out: &mut [f64]) {
    let d = reading.description();
    match d.frictions[f].normal {
        Normal::Contact(c) => {
            let contact = &d.contacts[c];
            let multiplier = reading.force(contact.row);
            match contact.normal_factor.map(|factor| reading.motion(factor)) {
                None => add(out, (1.0, multiplier)),
                Some(Terms::One(factor)) => add(out, (factor.value(), multiplier)),
                Some(factor) => add_product(out, 1.0, &numbers(factor), &numbers(multiplier)),
            }
        }
        Normal::Constraint(i) => {
            let sign = match mode.frictions[f] {
                FrictionMode::Slip(sliding) => sliding.normal_sign,
                _ => 1.0,
            };
            add(out, (sign, reading.force(d.constraints[i].row)));
        }
        normal @ Normal::Resultant(_) => {
            let mut square = [0.0; LENGTH];
            let square = &mut square[..out.len()];
            add_squares(square, 1.0, normal, reading);
            add_root(out, square);
        }
        Normal::Given(place) => add(out, (1.0, reading.motion(place))),
    }
}

/// Adds Σ part λ of the rows that press friction `f`.
fn add_pressing<T: Scalar>(f: usize, parts: [f64; 3], reading: &Reading<'_, T>, out: &mut [f64]) {
    let d = reading.description();
    for (row, part) in d.frictions[f].normal.rows(d).zip(parts) {
        add(out, (part, reading.force(row)));
    }
}

/// Adds Σ (part λ)² of the rows that press.
fn add_squares<T: Scalar>(out: &mut [f64], part: f64, normal: Normal, reading: &Reading<'_, T>) {
    for row in normal.rows(reading.description()) {
        let mut force = [0.0; LENGTH];
        add(&mut force, (part, reading.force(row)));
        add_product(out, 1.0, &force, &force);
    }
}
