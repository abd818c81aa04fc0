//! How high the degree of a claim's numerator can be.
//!
//! Velocities and accelerations solve linear equations: by Cramer's rule they are quotients of determinants, whose
//! degree is at most the sum of the degrees of their rows, brought to common denominators.

use super::case::Case;
use crate::model::Normal;
use crate::symbolic::field::{Angles, Degree};
use crate::symbolic::{ExprId, Pool, Symbol};

/// A bound of the degree of the claim's numerator.
pub(super) fn degree(pool: &Pool, case: &Case, angles: &Angles) -> f64 {
    let bounds = Bounds { pool, case, angles };
    let active = case.mode.acting_rows(case.mechanics.system);
    let velocity = bounds.velocity(&active);
    let moving = |symbol: Symbol| {
        let mut coordinates = case.mechanics.coordinates.iter();
        match coordinates.any(|q| q[1] == symbol) {
            true => velocity,
            false => bounds.free(symbol),
        }
    };
    let factors = bounds.factors(&moving);
    let solved = determinant(&bounds.equations(&active, &factors, &moving));
    let known = |symbol: Symbol| {
        let mechanics = case.mechanics;
        if mechanics.coordinates.iter().any(|q| q[2] == symbol) {
            return solved;
        }
        let own = mechanics.rows.iter().position(|r| r.force == symbol);
        own.map_or_else(|| moving(symbol), |r| solved.times(factors[r]))
    };
    bounds.of(&[case.claim], &known)[0].above
}

/// Degrees of symbols.
type Known<'a> = &'a dyn Fn(Symbol) -> Degree;

struct Bounds<'a> {
    pool: &'a Pool,
    case: &'a Case<'a>,
    angles: &'a Angles,
}

impl Bounds<'_> {
    fn of(&self, e: &[ExprId], known: Known) -> Vec<Degree> {
        self.pool.degrees(e, self.angles, known)
    }

    /// A symbol with a random value; fields are squares of random elements.
    fn free(&self, symbol: Symbol) -> Degree {
        Degree::polynomial(match self.case.mechanics.parameters.contains(&symbol) {
            true => 2.0,
            false => 1.0,
        })
    }

    /// Velocities, which rows and ties determine.
    fn velocity(&self, active: &[usize]) -> Degree {
        let rows = active.iter().map(|&r| {
            let row = &self.case.mechanics.rows[r];
            (&row.jacobian, row.velocity)
        });
        let ties = self.case.ties.iter().map(|tie| (&tie.jacobian, tie.whole));
        let equations: Vec<Vec<Degree>> = rows
            .chain(ties)
            .map(|(jacobian, rest)| {
                let entries = jacobian.iter().map(|&(_, e)| e).chain([rest]);
                self.of(&entries.collect::<Vec<_>>(), &|s| self.free(s))
            })
            .collect();
        match equations.is_empty() {
            true => Degree::polynomial(1.0),
            false => determinant(&equations),
        }
    }

    /// What slipping frictions multiply their rows by.
    fn factors(&self, moving: Known) -> Vec<Degree> {
        let mechanics = self.case.mechanics;
        let mut factors = vec![Degree::NUMBER; mechanics.rows.len()];
        for (friction, state) in mechanics.frictions.iter().zip(&self.case.mode.frictions) {
            if !state.slips() {
                continue;
            }
            let mut parts = vec![friction.kinetic_coefficient];
            match friction.normal {
                Normal::Given(e) => parts.push(e),
                Normal::Contact(contact) => parts.extend(mechanics.contacts[contact].0),
                Normal::Constraint(_) | Normal::Resultant(_) => {}
            }
            if friction.rows.len() > 1 {
                // Slip over speed: the speed is a root of squares.
                for _ in 0..2 {
                    parts.extend(friction.rows.iter().map(|&r| mechanics.rows[r].velocity));
                }
            }
            let parts = self.of(&parts, moving).into_iter();
            let factor = parts.fold(Degree::NUMBER, Degree::times);
            for &r in &friction.rows {
                factors[r] = factor;
            }
        }
        factors
    }

    /// Entries of the equations of accelerations and forces.
    fn equations(&self, active: &[usize], factors: &[Degree], moving: Known) -> Vec<Vec<Degree>> {
        let mechanics = self.case.mechanics;
        let forcing = self.of(&mechanics.forcing, moving);
        let mut rows: Vec<Vec<Degree>> = forcing.into_iter().map(|f| vec![f]).collect();
        let mass: Vec<ExprId> = mechanics.mass.iter().map(|m| m.2).collect();
        for (&(i, j, _), degree) in mechanics.mass.iter().zip(self.of(&mass, moving)) {
            rows[i].push(degree);
            if i != j {
                rows[j].push(degree);
            }
        }
        for (r, factor) in factors.iter().enumerate() {
            let row = &mechanics.rows[r];
            let entries: Vec<ExprId> = row.jacobian.iter().map(|&(_, e)| e).collect();
            let mut entries = self.of(&entries, moving);
            for (&(j, _), degree) in row.jacobian.iter().zip(&entries) {
                rows[j].push(degree.times(*factor));
            }
            if active.contains(&r) {
                entries.extend(self.of(&[row.bias], moving));
                rows.push(entries);
            }
        }
        for &(i, r, e) in &mechanics.couplings {
            rows[i].push(self.of(&[e], moving)[0].times(factors[r]));
        }
        rows
    }
}

/// A quotient of determinants with these rows.
fn determinant(rows: &[Vec<Degree>]) -> Degree {
    let heights = rows.iter().map(|row| Degree::of_sum(row).above);
    let total: f64 = heights.sum();
    Degree {
        above: total,
        below: total,
    }
}
