//! Numbers outside the domain in which the equations mean something: friction, restitution, inertia.
//!
//! Outside it the laws of contact may have no solution although nothing is paradoxical, or one that is not physical: a kinetic
//! coefficient above the static one leaves no mode at the onset of slip, a negative inertia makes a blow accelerate.

use crate::arithmetic::Scalar;
use crate::dynamics::Dynamics;
use crate::effects::Item;
use crate::error::Error;
use crate::mode::{Direction, FrictionMode, Mode, Sliding};
use crate::system::{Description, Friction, Normal, ValueRef};

/// Coefficients given by different formulas may differ by this share and still be meant as equal.
const ROUNDING: f64 = 1e-9;

/// A coefficient of friction that depends on the state is below zero from here on.
const DECAYED: f64 = 1e-6;

/// Weight of the constraints beside the mass matrix, relative.
const WEIGHT: f64 = 1e6;

/// A pivot this small beside the terms that make it is zero.
const NOISE: f64 = 1e-12;

/// Looks for numbers outside their domain in the state that `dynamics` holds, with the Jacobians and coefficients of all rows;
/// `form` is memory.
///
/// Coefficients and given forces that depend on the state count only where their friction acts in `mode`.
///
/// # Errors
/// [`Error::Domain`]: the first that is.
pub fn check<T: Scalar>(
    dynamics: &Dynamics<T>,
    mode: &Mode,
    t: f64,
    form: &mut Vec<f64>,
) -> Result<(), Error> {
    let d = dynamics.description();
    for f in 0..d.frictions.len() {
        check_friction(dynamics, mode, t, f)?;
    }
    for c in 0..d.contacts.len() {
        if !d.contacts[c].restitution.place().varies() {
            check_restitution(dynamics, t, c)?;
        }
    }
    check_inertia(dynamics, t, form)
}

/// Looks at the values of parameters, which the motion is not needed for.
///
/// # Errors
/// [`Error::Domain`]: the first that is not what its field says.
pub fn check_parameters<T: Scalar>(dynamics: &Dynamics<T>, t: f64) -> Result<(), Error> {
    let parameters = dynamics.description().parameters.iter();
    for (i, parameter) in parameters.enumerate() {
        let value = dynamics.system().parameter(i).value();
        if !parameter.domain.contains(value) {
            return Err(Error::Domain {
                time: t,
                item: parameter.name,
                what: "value",
                value,
                expected: parameter.domain.to_string(),
                fields: Vec::new(),
            });
        }
    }
    Ok(())
}

/// Looks at the restitution of contact `c` in the state that `dynamics` holds.
///
/// # Errors
/// [`Error::Domain`] if it is not between 0 and 1.
pub fn check_restitution<T: Scalar>(dynamics: &Dynamics<T>, t: f64, c: usize) -> Result<(), Error> {
    let d = dynamics.description();
    let contact = &d.contacts[c];
    let value = dynamics.motion(contact.restitution.place()).value();
    let outside = !(0.0..=1.0).contains(&value);
    if !(outside && dynamics.effects().includes(d, Item::Contact(c))) {
        return Ok(());
    }
    Err(Error::Domain {
        time: t,
        item: contact.name,
        what: "restitution",
        value,
        expected: "between 0 and 1".to_owned(),
        fields: values_of(dynamics, contact.restitution_parameters),
    })
}

/// Looks at the strength of the frictions that act, in the values that `dynamics` holds: below zero they would push.
///
/// # Errors
/// [`Error::Domain`]: the first that is.
pub fn check_acting<T: Scalar>(dynamics: &Dynamics<T>, t: f64) -> Result<(), Error> {
    let d = dynamics.description();
    for (f, friction) in d.frictions.iter().enumerate() {
        let coefficient = match dynamics.mode().frictions[f] {
            FrictionMode::Inactive => continue,
            FrictionMode::Stick => static_friction(friction),
            FrictionMode::Slip(_) => kinetic_friction(friction),
        };
        let coefficient = (!slips_back(dynamics, f)).then_some(coefficient);
        let numbers = normal_force(friction).into_iter().chain(coefficient);
        let numbers = numbers.filter(|number| number.place.varies());
        refuse_meaningless(dynamics, t, f, numbers)?;
    }
    Ok(())
}

/// Whether a friction slips against its direction. It does so by its error only, by which a coefficient that grows steeply with |s|, in which ±s stands for that,
/// may be below zero.
fn slips_back<T: Scalar>(dynamics: &Dynamics<T>, f: usize) -> bool {
    let d = dynamics.description();
    let slip = dynamics.motion(d.rows[d.frictions[f].row].velocity).value();
    match dynamics.mode().frictions[f] {
        FrictionMode::Slip(Sliding {
            direction: Direction::Fixed([sign, 0.0]),
            ..
        }) => sign * slip < 0.0,
        _ => false,
    }
}

/// Whether the motion may take the strength of a friction below zero.
pub fn strengths_vary(d: &Description) -> bool {
    let numbers = d.frictions.iter().flat_map(|friction| {
        let coefficients = [static_friction(friction), kinetic_friction(friction)];
        normal_force(friction).into_iter().chain(coefficients)
    });
    numbers.into_iter().any(|number| number.place.varies())
}

/// A number that a friction is made of.
struct Number {
    what: &'static str,
    place: ValueRef,
    /// The parameters in it.
    parameters: &'static [usize],
}

fn static_friction(friction: &Friction) -> Number {
    Number {
        what: "static friction",
        place: friction.static_coefficient,
        parameters: friction.static_parameters,
    }
}

fn kinetic_friction(friction: &Friction) -> Number {
    Number {
        what: "kinetic friction",
        place: friction.kinetic_coefficient,
        parameters: friction.kinetic_parameters,
    }
}

fn normal_force(friction: &Friction) -> Option<Number> {
    match friction.normal {
        Normal::Given(place) => Some(Number {
            what: "normal force",
            place,
            parameters: &[],
        }),
        _ => None,
    }
}

/// A number that vanishes with the slip has the sign of its error where that has decayed.
fn least(place: ValueRef) -> f64 {
    if place.varies() { -DECAYED } else { 0.0 }
}

fn refuse_meaningless<T: Scalar>(
    dynamics: &Dynamics<T>,
    t: f64,
    f: usize,
    numbers: impl Iterator<Item = Number>,
) -> Result<(), Error> {
    for Number {
        what,
        place,
        parameters,
    } in numbers
    {
        let value = dynamics.motion(place).value();
        let infinite = !value.is_finite() && !place.varies();
        if value < least(place) || infinite {
            return Err(Error::Domain {
                time: t,
                item: dynamics.description().frictions[f].name,
                what,
                value,
                expected: match place.varies() {
                    _ if infinite => "a finite number".to_owned(),
                    true => "at least 0; where nothing presses write `max(…, 0)`".to_owned(),
                    false => "at least 0".to_owned(),
                },
                fields: values_of(dynamics, parameters),
            });
        }
    }
    Ok(())
}

fn check_friction<T: Scalar>(
    dynamics: &Dynamics<T>,
    mode: &Mode,
    t: f64,
    f: usize,
) -> Result<(), Error> {
    let d = dynamics.description();
    if !dynamics.effects().includes(d, Item::Friction(f)) {
        return Ok(());
    }
    let friction = &d.frictions[f];
    let mode = mode.frictions[f];
    let numbers = [static_friction(friction), kinetic_friction(friction)];
    let numbers = numbers.into_iter().chain(normal_force(friction));
    let counts = |number: &Number| !number.place.varies() || mode != FrictionMode::Inactive;
    refuse_meaningless(dynamics, t, f, numbers.filter(counts))?;
    // Where the coefficients depend on the slip it is those at rest that must agree.
    let (at_rest, sliding) = (friction.static_coefficient, friction.kinetic_coefficient);
    let [limit, value] = [at_rest, sliding].map(|place| dynamics.motion(place).value());
    let comparable = !at_rest.varies() && !sliding.varies() || mode == FrictionMode::Stick;
    if comparable && value > (1.0 + ROUNDING) * limit - least(sliding) {
        return Err(Error::Domain {
            time: t,
            item: friction.name,
            what: "kinetic friction",
            value,
            expected: format!("at most that of static friction, {limit}"),
            fields: values_of(dynamics, friction.kinetic_parameters),
        });
    }
    Ok(())
}

/// Whether the kinetic energy is positive in every direction that the constraints leave: M + w JᵀJ is positive definite for a
/// large w (Finsler 1937), which elimination shows. Directions without inertia are for the solver to complain of.
fn check_inertia<T: Scalar>(
    dynamics: &Dynamics<T>,
    t: f64,
    form: &mut Vec<f64>,
) -> Result<(), Error> {
    let d = dynamics.description();
    let Some(parameters) = d.inertia else {
        return Ok(());
    };
    let n = d.coordinates.len();
    let number = |place: ValueRef| dynamics.motion(place).value();
    form.clear();
    form.resize(n * n, 0.0);
    let mut size = 0.0_f64;
    for &(i, j, place) in d.mass {
        let m = number(place);
        (form[i * n + j], form[j * n + i]) = (m, m);
        size = size.max(m.abs());
    }
    let always = |(i, c): &(usize, &crate::system::Constraint)| {
        c.while_contact.is_none() && dynamics.effects().includes(d, Item::Constraint(*i))
    };
    for (_, constraint) in d.constraints.iter().enumerate().filter(always) {
        let row = d.rows[constraint.row].jacobian;
        let square: f64 = row.iter().map(|&(_, a)| number(a).powi(2)).sum();
        let weight = WEIGHT * size / square;
        if weight.is_finite() {
            for &(i, a) in row {
                for &(j, b) in row {
                    form[i * n + j] += weight * number(a) * number(b);
                }
            }
        }
    }
    let Some((coordinate, value)) = negative_pivot(form, n) else {
        return Ok(());
    };
    let own = |&&(i, j, place): &&(usize, usize, ValueRef)| i == j && number(place) < 0.0;
    let (coordinate, value) = match d.mass.iter().find(own) {
        Some(&(i, _, place)) => (i, number(place)),
        None => (coordinate, value),
    };
    let mut fields = values_of(dynamics, parameters);
    fields.retain(|(_, value)| *value < 0.0);
    Err(Error::Domain {
        time: t,
        item: d.coordinates[coordinate].name,
        what: "inertia",
        value,
        expected: "positive".to_owned(),
        fields,
    })
}

/// The first pivot of a symmetric matrix of size `n` that is negative beyond rounding, and its place. The elimination works in
/// the lower triangle of `a`; a pivot that is rounding becomes 0, and its column stays.
fn negative_pivot(a: &mut [f64], n: usize) -> Option<(usize, f64)> {
    for k in 0..n {
        let pivot = a[k * n + k];
        let earlier = (0..k).filter(|&i| a[i * n + i] > 0.0);
        let subtracted: f64 = earlier.map(|i| a[k * n + i].powi(2) / a[i * n + i]).sum();
        let noise = NOISE * (pivot.abs() + subtracted);
        if pivot < -noise {
            return Some((k, pivot));
        }
        if pivot <= noise {
            a[k * n + k] = 0.0;
            continue;
        }
        for i in k + 1..n {
            let factor = a[i * n + k] / pivot;
            for j in k + 1..=i {
                a[i * n + j] -= factor * a[j * n + k];
            }
        }
    }
    None
}

/// Names and values of parameters.
fn values_of<T: Scalar>(dynamics: &Dynamics<T>, parameters: &[usize]) -> Vec<(&'static str, f64)> {
    let names = dynamics.description().parameters;
    let values = parameters.iter();
    values
        .map(|&i| (names[i].name, dynamics.system().parameter(i).value()))
        .collect()
}
