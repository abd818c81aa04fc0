//! Laws of friction.

use super::formula::{Formula, Statement};
use super::motion::Known;
use super::work::Work;
use crate::model::Normal;
use crate::modes::FrictionState;
use crate::symbolic::{ExprId, Rational};

impl Work<'_> {
    /// F = ∓μ N
    pub(super) fn sliding(&mut self, friction: usize, state: FrictionState) -> Vec<Statement> {
        if !state.slips() {
            return Vec::new();
        }
        let item = &self.equations.system.frictions[friction];
        let strength = self.strength(friction, item.kinetic_coefficient);
        let letters = self.forces(friction);
        if let Some(forward) = state.is_forward() {
            let law = if forward {
                strength.negated()
            } else {
                strength
            };
            return vec![Statement::equal(letters[0].clone(), law)];
        }
        let slip = self.slip(friction, &[]);
        let size = norm(&slip);
        letters
            .into_iter()
            .zip(slip)
            .map(|(letter, slip)| {
                let share = Formula::Fraction(Box::new(slip), Box::new(size.clone()));
                let force = Formula::Product(vec![strength.clone(), share]);
                Statement::equal(letter, force.negated())
            })
            .collect()
    }

    /// F ± μ N where that is linear in the forces.
    pub(super) fn sliding_residual(
        &mut self,
        friction: usize,
        state: FrictionState,
    ) -> Option<ExprId> {
        let sign = match state.is_forward()? {
            true => Rational::ONE,
            false => Rational::MINUS_ONE,
        };
        let item = &self.equations.system.frictions[friction];
        let normal = match item.normal {
            Normal::Contact(contact) => self.normal_force(contact),
            Normal::Constraint(_) | Normal::Resultant(_) => return None,
            Normal::Given(e) => e,
        };
        let pool = self.pool();
        let strength = pool.mul(item.kinetic_coefficient, normal);
        let strength = pool.scale(strength, sign);
        let force = pool.leaf(item.slip[0].1);
        Some(pool.add(force, strength))
    }

    /// μ N
    pub(super) fn strength(&mut self, friction: usize, coefficient: ExprId) -> Formula {
        let system = &self.equations.system;
        let coefficient = self.reader.formula(coefficient);
        let normal = match system.frictions[friction].normal {
            Normal::Contact(contact) => {
                let normal = self.normal_force(contact);
                self.reader.formula(normal)
            }
            Normal::Constraint(constraint) => {
                let letter = self.names.letter(system.constraints[constraint].force);
                Formula::Absolute(Box::new(Formula::Letter(letter)))
            }
            Normal::Resultant(resultant) => {
                let constraints = system.resultants[resultant].iter();
                let letter =
                    |&i: &usize| Formula::Letter(self.names.letter(system.constraints[i].force));
                norm(&constraints.map(letter).collect::<Vec<_>>())
            }
            Normal::Given(e) if self.pool().is_one(e) => return coefficient,
            Normal::Given(e) => self.reader.formula(e),
        };
        let factors = |formula| match formula {
            Formula::Product(factors) => factors,
            other => vec![other],
        };
        Formula::Product([factors(coefficient), factors(normal)].concat())
    }

    /// N of a contact.
    fn normal_force(&mut self, contact: usize) -> ExprId {
        let item = &self.equations.system.contacts[contact];
        let pool = self.pool();
        let force = pool.leaf(item.force);
        match item.normal_factor {
            Some(factor) => pool.mul(force, factor),
            None => force,
        }
    }

    /// Letters of the components of a friction force.
    pub(super) fn forces(&self, friction: usize) -> Vec<Formula> {
        let components = self.system().frictions[friction].slip.iter();
        components
            .map(|&(_, force)| Formula::Letter(self.names.letter(force)))
            .collect()
    }

    /// Components of a slip.
    pub(super) fn slip(&mut self, friction: usize, known: &Known) -> Vec<Formula> {
        let rows = self.system().slip_rows(friction);
        rows.map(|row| self.rate(row, known)).collect()
    }
}

/// |a| of one component, √(a² + b²) of two.
pub(super) fn norm(components: &[Formula]) -> Formula {
    let two = || Box::new(Formula::Number(Rational::integer(2)));
    match components {
        [one] => Formula::Absolute(Box::new(one.clone())),
        many => {
            let squares = many
                .iter()
                .map(|c| (false, Formula::Power(Box::new(c.clone()), two())));
            Formula::Root(Box::new(Formula::Sum(squares.collect())))
        }
    }
}
