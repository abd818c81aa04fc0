//! The size of what cancels in a guard: rounding leaves about 1e-16 of it, a located root about the tolerance.
//!
//! With a the row, f the forcing and m the diagonal of the mass matrix, the compliance of the row is Σaⱼ²/mⱼ, the
//! acceleration along it at most √(Σaⱼ²/mⱼ · Σfⱼ²/mⱼ), and the multiplier that over the compliance: all independent of
//! the units of the coordinates, and not small where the force along the row happens to cancel.

use crate::arithmetic::Scalar;
use crate::dynamics::Dynamics;
use crate::modes::guard::Guard;
use crate::system::{Normal, Place, System};

/// Size of the terms that make a guard: an acceleration for gaps and slips, a force for the others.
pub fn scale<S: System>(guard: Guard, dynamics: &Dynamics<S>) -> f64 {
    let d = S::DESCRIPTION;
    match guard {
        Guard::Gap(c) => Row::of(d.contacts[c].row, dynamics).acceleration,
        Guard::Normal(c) => Row::of(d.contacts[c].row, dynamics).force,
        Guard::Slip(f) => {
            let row = Row::of(d.frictions[f].row, dynamics);
            row.acceleration
                + row.compliance * friction(f, d.frictions[f].kinetic_coefficient, dynamics)
        }
        Guard::StickUpper(f) | Guard::StickLower(f) => limit(f, dynamics),
        Guard::StickCone(f) => limit(f, dynamics).powi(2),
        Guard::Bearing(f) => normal(f, dynamics),
        Guard::Branch(_) | Guard::Stop(..) | Guard::Mark(..) => 0.0,
    }
}

/// Sizes along one row.
struct Row {
    acceleration: f64,
    compliance: f64,
    force: f64,
}

impl Row {
    fn of<S: System>(row: usize, dynamics: &Dynamics<S>) -> Row {
        let d = S::DESCRIPTION;
        let number = |place: Place| dynamics.motion(place).value();
        let mass = |j: usize| {
            let diagonal = d.mass.iter().find(|(r, c, _)| *r == j && *c == j);
            diagonal.map_or(0.0, |(_, _, place)| number(*place))
        };
        let jacobian = d.rows[row]
            .jacobian
            .iter()
            .map(|&(j, place)| (j, number(place)));
        let compliance: f64 = jacobian
            .filter(|(j, _)| mass(*j) > 0.0)
            .map(|(j, a)| a * a / mass(j))
            .sum();
        let coordinates = (0..d.coordinates.len()).filter(|j| mass(*j) > 0.0);
        let drive: f64 = coordinates
            .map(|j| number(d.forcing[j]).powi(2) / mass(j))
            .sum();
        let acceleration = (compliance * drive).sqrt();
        let needed = if compliance > 0.0 {
            acceleration / compliance
        } else {
            0.0
        };
        Row {
            acceleration,
            compliance,
            force: needed.max(dynamics.force(row).value().abs()),
        }
    }
}

/// Size of the normal force of friction `f`.
fn normal<S: System>(f: usize, dynamics: &Dynamics<S>) -> f64 {
    let d = S::DESCRIPTION;
    match d.frictions[f].normal {
        Normal::Contact(c) => {
            let factor = d.contacts[c]
                .normal_factor
                .map_or(1.0, |place| dynamics.motion(place).value());
            Row::of(d.contacts[c].row, dynamics).force * factor
        }
        Normal::Constraint(i) => Row::of(d.constraints[i].row, dynamics).force,
        Normal::Given(place) => dynamics.motion(place).value().abs(),
    }
}

fn friction<S: System>(f: usize, coefficient: Place, dynamics: &Dynamics<S>) -> f64 {
    dynamics.motion(coefficient).value().abs() * normal(f, dynamics)
}

fn limit<S: System>(f: usize, dynamics: &Dynamics<S>) -> f64 {
    let friction_of = &S::DESCRIPTION.frictions[f];
    Row::of(friction_of.row, dynamics).force + friction(f, friction_of.static_coefficient, dynamics)
}
