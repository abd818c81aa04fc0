//! What a mode and the conditions of a check decide beforehand: branches, and the directions of slips.

use super::Court;
use super::modes::{Grip, Mode};
use crate::model::{Check, Normal, Premise};
use crate::symbolic::{ExprId, Pool, Rational};

impl Court<'_> {
    /// Whether the conditions on the state exclude the direction of a slip.
    pub(super) fn contradicts(&mut self, check: &Check, mode: &Mode) -> bool {
        let system = &mut self.equations.system;
        let mut slips = system.frictions.iter().zip(&mode.grips);
        let at_least = check.premises.iter().filter_map(|premise| match premise {
            Premise::AtLeast(e) => Some(*e),
            Premise::Zero(_) => None,
        });
        let at_least: Vec<ExprId> = at_least.collect();
        slips.any(|(friction, grip)| match (grip, &friction.slip[..]) {
            (Grip::Slips { forward }, &[(slip, _)]) => at_least.iter().any(|&e| {
                let ratio = ratio(&mut system.pool, e, slip);
                ratio.is_some_and(|ratio| ratio.is_negative() == *forward)
            }),
            _ => false,
        })
    }

    /// Branches on what the mode or the conditions say: a closed contact pushes, an open gap is positive, a slip has its
    /// direction.
    pub(super) fn decided(&mut self, check: &Check, mode: &Mode) -> Vec<(usize, bool)> {
        let system = &mut self.equations.system;
        let mut positive = Vec::new();
        for (contact, &closed) in system.contacts.iter().zip(&mode.closed) {
            positive.push(if closed {
                system.pool.leaf(contact.force)
            } else {
                contact.gap
            });
        }
        for (friction, grip) in system.frictions.iter().zip(&mode.grips) {
            if let (Grip::Slips { forward }, [(slip, _)]) = (grip, &friction.slip[..]) {
                positive.push(if *forward {
                    *slip
                } else {
                    system.pool.neg(*slip)
                });
            }
        }
        // Friction acts against the slip, and the mode says which way the constraint pushes that carries it.
        for (friction, grip) in system.frictions.iter().zip(&mode.grips) {
            let (Grip::Slips { forward }, [(_, force)]) = (grip, &friction.slip[..]) else {
                continue;
            };
            let mut signed = vec![(*force, !forward)];
            if let Normal::Constraint(i) = friction.normal {
                signed.push((system.constraints[i].force, mode.positive[i]));
            }
            for (force, is_positive) in signed {
                let force = system.pool.leaf(force);
                positive.push(if is_positive {
                    force
                } else {
                    system.pool.neg(force)
                });
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
            let ratio = known.find_map(|&known| ratio(&mut system.pool, branch.guard, known));
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
