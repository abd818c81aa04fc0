//! A guard as a number of the run's own scalar: what located the root is a double, its derivatives come from here.

use super::composite::CompositeGuard;
use super::guard::{Guard, cone_unit, pressed_by_constraints};

use crate::arithmetic::Scalar;
use crate::dynamics::Dynamics;
use crate::mode::{Direction, FrictionMode, Mode};
use crate::system::{Normal, ValueRef};

/// A guard at the last value of `dynamics`, as [`super::composite::value`] with all derivatives that its parts carry. Stops,
/// marks and branches of forces read the report tape.
pub fn exact<T: Scalar>(
    guard: Guard,
    composites: &[CompositeGuard],
    mode: &Mode,
    dynamics: &Dynamics<T>,
) -> T {
    let d = dynamics.description();
    let motion = |place: Option<ValueRef>| dynamics.motion(place.unwrap_or(ValueRef::Zero));
    let force = |f: usize, k: usize| dynamics.force(d.frictions[f].row + k);
    match guard {
        Guard::Gap(c) => motion(d.rows[d.contacts[c].row].position),
        Guard::Normal(c) => dynamics.force(d.contacts[c].row),
        Guard::Region(c) => motion(d.contacts[c].region),
        Guard::StickUpper(f) => limit(f, mode, dynamics) - force(f, 0),
        Guard::StickLower(f) => limit(f, mode, dynamics) + force(f, 0),
        Guard::StickCone(f) => {
            let limit = limit(f, mode, dynamics);
            let forces = (0..d.frictions[f].components).map(|k| force(f, k));
            let values = forces.clone().chain([limit]).map(|x| x.value());
            let part = T::from_f64(1.0 / cone_unit(values));
            let square = |force: T| (force * part) * (force * part);
            forces.fold(square(limit), |rest, force| rest - square(force))
        }
        Guard::Slip(f) => {
            let along = match mode.frictions[f] {
                FrictionMode::Slip(sliding) => match sliding.direction {
                    Direction::Fixed(along) => along.map(T::from_f64),
                    Direction::AlongSlip | Direction::Incipient(_) => dynamics.slip_direction(f),
                },
                _ => [T::zero(); 2],
            };
            slip(f, along, dynamics)
        }
        Guard::NormalForceSign(f) => match d.frictions[f].normal {
            Normal::Resultant(i) => pressing(f, dynamics.resultant_direction(i), dynamics),
            _ => normal(f, mode, dynamics),
        },
        Guard::Branch(b) => {
            let branch = &d.branches[b];
            let value = if branch.after_solve {
                dynamics.report(branch.guard)
            } else {
                dynamics.motion(branch.guard)
            };
            if mode.branch(b) { value } else { -value }
        }
        Guard::Stop(i, k) => dynamics.report(d.stops[i].terms[k]),
        Guard::Mark(i, k) => dynamics.report(d.marks[i].terms[k]),
        Guard::Composite(index) => composites[index].parts.iter().fold(T::zero(), |sum, part| {
            let value = match (part.guard, part.plane) {
                (Guard::StickCone(f), Some(plane)) => {
                    let along = plane.along.into_iter().enumerate();
                    let along = along.take(d.frictions[f].components);
                    let friction = &d.frictions[f];
                    let limit = if pressed_by_constraints(friction) {
                        dynamics.motion(friction.static_coefficient)
                            * pressing(f, plane.pressing.map(T::from_f64), dynamics)
                    } else {
                        limit(f, mode, dynamics)
                    };
                    along.fold(limit, |rest, (k, part)| {
                        rest - T::from_f64(part) * force(f, k)
                    })
                }
                (guard, _) => exact(guard, &[], mode, dynamics),
            };
            sum + T::from_f64(part.weight) * value
        }),
    }
}

/// The slip of friction `f` in direction `along`.
pub fn slip<T: Scalar>(f: usize, along: [T; 2], dynamics: &Dynamics<T>) -> T {
    let d = dynamics.description();
    let friction = &d.frictions[f];
    let parts = along.into_iter().enumerate().take(friction.components);
    parts.fold(T::zero(), |sum, (k, part)| {
        sum + part * dynamics.motion(d.rows[friction.row + k].velocity)
    })
}

/// μs N.
pub fn limit<T: Scalar>(f: usize, mode: &Mode, dynamics: &Dynamics<T>) -> T {
    let coefficient = dynamics.description().frictions[f].static_coefficient;
    dynamics.motion(coefficient) * normal(f, mode, dynamics)
}

/// μk N.
pub fn kinetic_limit<T: Scalar>(f: usize, mode: &Mode, dynamics: &Dynamics<T>) -> T {
    let coefficient = dynamics.description().frictions[f].kinetic_coefficient;
    dynamics.motion(coefficient) * normal(f, mode, dynamics)
}

/// Normal force of friction `f`.
fn normal<T: Scalar>(f: usize, mode: &Mode, dynamics: &Dynamics<T>) -> T {
    let d = dynamics.description();
    match d.frictions[f].normal {
        Normal::Contact(c) => {
            let multiplier = dynamics.force(d.contacts[c].row);
            let factor = d.contacts[c].normal_factor;
            factor.map_or(multiplier, |factor| dynamics.motion(factor) * multiplier)
        }
        Normal::Constraint(i) => {
            let force = dynamics.force(d.constraints[i].row);
            match mode.frictions[f] {
                FrictionMode::Slip(sliding) => T::from_f64(sliding.normal_sign) * force,
                _ => force,
            }
        }
        Normal::Resultant(_) => {
            let rows = d.frictions[f].normal.rows(d);
            length(rows.map(|row| dynamics.force(row)))
        }
        Normal::Given(place) => dynamics.motion(place),
    }
}

/// Σ part λ of the rows that press friction `f`.
fn pressing<T: Scalar>(f: usize, parts: [T; 3], dynamics: &Dynamics<T>) -> T {
    let d = dynamics.description();
    let forces = d.frictions[f].normal.rows(d).map(|row| dynamics.force(row));
    forces
        .zip(parts)
        .fold(T::zero(), |sum, (x, part)| sum + part * x)
}

/// √Σx², without derivatives where that is zero.
pub fn length<T: Scalar>(x: impl Iterator<Item = T>) -> T {
    let square = x.fold(T::zero(), |sum, x| sum + x * x);
    match square.value() > 0.0 {
        true => square.sqrt(),
        false => T::zero(),
    }
}
