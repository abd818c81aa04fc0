//! What a mode and the conditions of a check decide beforehand: branches, and the directions of slips.

use super::Prover;
use crate::model::{Check, Normal, Premise};
use crate::modes::{Mode, Sign};
use crate::symbolic::{ExprId, Pool, Rational};

impl Prover<'_> {
    /// Whether the conditions on the state exclude the direction of a slip.
    pub(super) fn contradicts(&mut self, check: &Check, mode: &Mode) -> bool {
        let mut slips = self.system.frictions.iter().zip(&mode.frictions);
        let at_least = check.premises.iter().filter_map(|premise| match premise {
            Premise::AtLeast(e) => Some(*e),
            Premise::Zero(_) => None,
        });
        let at_least: Vec<ExprId> = at_least.collect();
        slips.any(|(friction, state)| {
            state.is_forward().is_some_and(|forward| {
                let slip = friction.slip[0].0;
                at_least
                    .iter()
                    .any(|&e| self.needs_direction(e, slip, !forward))
            })
        })
    }

    /// Whether e ≥ 0 needs a slip forward or backward: e is a multiple of the slip and something that is never positive.
    fn needs_direction(&mut self, e: ExprId, slip: ExprId, forward: bool) -> bool {
        let pool = &mut *self.pool;
        let speeds = self.mechanics.coordinates.iter().map(|q| q[1]);
        let speed = speeds.clone().find(|&v| pool.depends_on(slip, v));
        let Some(speed) = speed else {
            return false;
        };
        let [of_e, of_slip] = [e, slip].map(|e| pool.differentiate(e, speed));
        let Some(multiple) = ratio(pool, of_e, of_slip) else {
            return false;
        };
        let share = pool.scale(slip, multiple);
        let rest = pool.sub(share, e);
        // Fields are positive; written as squares they show it.
        let fields = self.mechanics.parameters.iter();
        let squares: Vec<_> = fields
            .map(|&field| {
                let leaf = pool.leaf(field);
                (field, pool.mul(leaf, leaf))
            })
            .collect();
        let rest = pool.substitute(rest, &squares);
        let rest = pool.simplify(rest);
        multiple.is_negative() != forward && pool.is_never_negative(rest)
    }

    /// Branches on what the mode or the conditions say: a closed contact pushes, an open gap is positive, a slip has its
    /// direction, against which friction acts, and a constraint that carries it pushes as the mode says.
    pub(super) fn decided(&mut self, check: &Check, mode: &Mode) -> Vec<(usize, bool)> {
        let pool = &mut *self.pool;
        let mut positive = Vec::new();
        for (contact, &closed) in self.system.contacts.iter().zip(&mode.contacts) {
            positive.push(if closed {
                pool.leaf(contact.force)
            } else {
                contact.gap
            });
        }
        for (friction, state) in self.system.frictions.iter().zip(&mode.frictions) {
            let Some(forward) = state.is_forward() else {
                continue;
            };
            let (slip, force) = friction.slip[0];
            let mut signed = vec![(slip, forward), (pool.leaf(force), !forward)];
            if let Normal::Constraint(i) = friction.normal {
                let force = pool.leaf(self.system.constraints[i].force);
                signed.push((force, mode.normal_signs[i] == Sign::Positive));
            }
            for (e, is_positive) in signed {
                positive.push(if is_positive { e } else { pool.neg(e) });
            }
        }
        for premise in &check.premises {
            if let Premise::AtLeast(e) = *premise {
                positive.push(e);
            }
        }
        let mut decided = Vec::new();
        for (i, branch) in self.branches.iter().enumerate() {
            let mut known = positive.iter();
            let ratio = known.find_map(|&known| ratio(pool, branch.guard, known));
            decided.extend(ratio.map(|ratio| (i, !ratio.is_negative())));
        }
        decided
    }
}

/// a/b, if that is a number.
fn ratio(pool: &mut Pool, a: ExprId, b: ExprId) -> Option<Rational> {
    let ratio = pool.div(a, b)?;
    let ratio = pool.simplify(ratio);
    pool.as_number(ratio).filter(|ratio| !ratio.is_zero())
}
