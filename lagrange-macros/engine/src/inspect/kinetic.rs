//! The kinetic energy, by velocities where that reads better, and what a Lagrangian has beside T − V.

use super::formula::Formula;
use super::work::Work;
use crate::symbolic::{ExprId, Rational, Symbol};

/// Of more velocities T is shown as it is computed.
const MOST_VELOCITIES: usize = 12;

impl Work<'_> {
    /// T: as it is computed, or by velocities, ½ vᵀM v, where that is all of it and reads better.
    pub fn kinetic(&mut self) -> Formula {
        let structure = &self.equations.structure;
        let declared = self.output(structure.energy.0);
        let as_is = self.reader.formula(declared);
        match self.quadratic_form(declared) {
            Some(quadratic) => {
                let by_velocities = self.reader.formula(quadratic);
                // The form of the textbook, if it is not much longer.
                match 3 * by_velocities.effort() <= 4 * as_is.effort() {
                    true => by_velocities,
                    false => as_is,
                }
            }
            None => as_is,
        }
    }

    /// What a declared Lagrangian has beside T − V where that is linear in the velocities, as of a charge in a magnetic field.
    pub fn linear(&mut self) -> Option<Formula> {
        let system = &self.equations.system;
        if !system.from_lagrangian {
            return None;
        }
        let velocities: Vec<Symbol> = system.coordinates.iter().map(|c| c.velocity).collect();
        let declared: Vec<ExprId> = system.kinetic.iter().map(|term| term.energy).collect();
        let kinetic = self.output(self.equations.structure.energy.0);
        let pool = self.pool();
        let declared = pool.sum(&declared);
        let rest = pool.sub(declared, kinetic);
        let rest = self.reader.multiplied_out(rest).unwrap_or(rest);
        let (coefficients, beside) = self.pool().coefficients_linear(rest, &velocities)?;
        let pool = self.pool();
        if pool.is_zero(rest) || !pool.is_zero(beside) {
            return None;
        }
        let terms = coefficients.into_iter().zip(velocities);
        let terms: Vec<ExprId> = terms
            .map(|(coefficient, velocity)| {
                let velocity = pool.leaf(velocity);
                pool.mul(coefficient, velocity)
            })
            .collect();
        let sum = pool.sum(&terms);
        Some(self.reader.formula(sum))
    }

    /// ½ vᵀM v if that is T: it is, if M is free of v, and T and ∂T/∂v vanish with v.
    fn quadratic_form(&mut self, kinetic: ExprId) -> Option<ExprId> {
        let coordinates = &self.equations.system.coordinates;
        let velocities: Vec<Symbol> = coordinates.iter().map(|c| c.velocity).collect();
        if velocities.len() > MOST_VELOCITIES {
            return None;
        }
        let zero = self.pool().integer(0);
        let rest: Vec<_> = velocities.iter().map(|&v| (v, zero)).collect();
        let mut vanishing = vec![kinetic];
        for &velocity in &velocities {
            vanishing.push(self.pool().differentiate(kinetic, velocity));
        }
        for e in vanishing {
            let pool = self.pool();
            let at_rest = pool.substitute(e, &rest);
            if !pool.is_zero(at_rest) {
                return None;
            }
        }
        let mut terms = Vec::new();
        for &(i, j, entry) in &self.equations.structure.mass {
            let entry = self.output(entry);
            let pool = self.pool();
            if pool.depends_on_any(entry, &velocities) {
                return None;
            }
            let (a, b) = (pool.leaf(velocities[i]), pool.leaf(velocities[j]));
            let term = pool.product(&[entry, a, b]);
            let half = pool.scale(term, Rational::HALF);
            terms.push(if i == j { half } else { term });
        }
        Some(self.pool().sum(&terms))
    }
}
