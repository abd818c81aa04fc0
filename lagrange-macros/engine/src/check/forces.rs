//! The forces of a mode in its unknowns: those of active rows are unknown, slipping frictions follow from what presses them.

use super::arithmetic::Arithmetic;
use super::mechanics::{Friction, Mechanics};
use super::stuck::Stuck;
use crate::model::Normal;
use crate::modes::{FrictionState, Mode, Sign};
use crate::symbolic::{ExprId, Pool};

/// Σ cₖ xₖ + constant over the unknowns.
pub(super) struct Affine<N> {
    pub terms: Vec<(usize, N)>,
    pub constant: N,
}

/// The force of every row, in the unknowns: v̇, then the forces of the active rows.
pub(super) fn forces<A: Arithmetic>(
    a: &mut A,
    pool: &Pool,
    mechanics: &Mechanics,
    mode: &Mode,
    active: &[usize],
) -> Result<Vec<Affine<A::Number>>, Stuck> {
    let n = mechanics.coordinates.len();
    let mut forces: Vec<Affine<A::Number>> = Vec::new();
    for row in 0..mechanics.rows.len() {
        let place = active.iter().position(|&r| r == row);
        forces.push(Affine {
            terms: place.map(|k| (n + k, a.integer(1))).into_iter().collect(),
            constant: a.integer(0),
        });
    }
    for (friction, &state) in mechanics.frictions.iter().zip(&mode.frictions) {
        if !state.slips() {
            continue;
        }
        let mu = a.values(pool, &[friction.kinetic_coefficient])?[0];
        let directions = directions(a, pool, mechanics, friction, state)?;
        let normal = normal_force(a, pool, mechanics, mode, friction.normal, &forces)?;
        for (&row, direction) in friction.rows.iter().zip(directions) {
            let factor = a.mul(mu, direction);
            let scaled = |&(k, c): &(usize, A::Number)| (k, a.mul(factor, c));
            forces[row] = Affine {
                terms: normal.terms.iter().map(scaled).collect(),
                constant: a.mul(factor, normal.constant),
            };
        }
    }
    Ok(forces)
}

/// −s/|s|, component by component.
fn directions<A: Arithmetic>(
    a: &mut A,
    pool: &Pool,
    mechanics: &Mechanics,
    friction: &Friction,
    state: FrictionState,
) -> Result<Vec<A::Number>, Stuck> {
    if let Some(forward) = state.is_forward() {
        return Ok(vec![a.integer(if forward { -1 } else { 1 })]);
    }
    let rows = friction.rows.iter();
    let slips: Vec<ExprId> = rows.map(|&row| mechanics.rows[row].velocity).collect();
    let slips = a.values(pool, &slips)?;
    let square = slips
        .iter()
        .fold(a.integer(0), |sum, &s| a.add(sum, a.mul(s, s)));
    let speed = a.sqrt(square)?;
    let mut directions = Vec::new();
    for s in slips {
        directions.push(a.sub(a.integer(0), a.div(s, speed)?));
    }
    Ok(directions)
}

/// What presses a friction, in the unknowns.
fn normal_force<A: Arithmetic>(
    a: &mut A,
    pool: &Pool,
    mechanics: &Mechanics,
    mode: &Mode,
    normal: Normal,
    forces: &[Affine<A::Number>],
) -> Result<Affine<A::Number>, Stuck> {
    let (row, factor) = match normal {
        Normal::Given(e) => {
            return Ok(Affine {
                terms: Vec::new(),
                constant: a.values(pool, &[e])?[0],
            });
        }
        Normal::Contact(contact) => {
            let factor = match mechanics.contacts[contact].0 {
                None => a.integer(1),
                Some(factor) => a.values(pool, &[factor])?[0],
            };
            (mechanics.system.contact_row(contact), factor)
        }
        // No check looks at modes in which such a friction slips.
        Normal::Resultant(_) => return Err(Stuck::Impossible),
        Normal::Constraint(constraint) => {
            let negative = mode.normal_signs[constraint] == Sign::Negative;
            (constraint, a.integer(if negative { -1 } else { 1 }))
        }
    };
    let scaled = |&(k, c): &(usize, A::Number)| (k, a.mul(factor, c));
    Ok(Affine {
        terms: forces[row].terms.iter().map(scaled).collect(),
        constant: a.integer(0),
    })
}
