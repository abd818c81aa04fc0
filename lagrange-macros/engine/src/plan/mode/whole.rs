//! The equations of motion of a mode with what they share kept whole: K w − b as one sum for each coordinate.

use super::balance::{Balances, attitudes};
use super::masked::{ALWAYS, Masked};
use super::reduce::Reduced;
use crate::derive::Equations;
use crate::symbolic::{ExprId, Symbol};

/// The equations of a mode with what they share kept whole.
pub(super) struct Whole {
    /// K of the accelerations.
    pub matrix: Vec<Vec<Masked>>,
    /// The part of b that is of accelerations.
    pub right: Vec<Masked>,
    /// The same part of K w − b.
    pub balance: Vec<Masked>,
}

/// The whole equations of a mode; none where rows have been eliminated, where something of it besides loads can be left out, or where
/// there is no such form, as for unit quaternions.
pub(super) fn whole_balance(
    equations: &mut Equations,
    balances: &Balances,
    reduced: &Reduced,
    acting: &[usize],
    unknowns: &[Symbol],
) -> Option<Whole> {
    let n = equations.system.coordinates.len();
    let pressed = balances.slides.iter().all(|slide| slide.source.is_some());
    let augmented = !attitudes(equations, acting).is_empty();
    if reduced.free.len() < n || !reduced.solved.is_empty() || !pressed || augmented {
        return None;
    }
    let found = equations.balance.as_ref()?;
    let pool = &mut equations.system.pool;
    let zero = pool.integer(0);
    let coordinates = equations.system.coordinates.iter();
    let accelerations: Vec<Symbol> = coordinates.map(|c| c.acceleration).collect();
    let pairs = accelerations.iter().zip(unknowns);
    let unknown: Vec<(Symbol, ExprId)> = pairs.map(|(&a, &w)| (a, pool.leaf(w))).collect();
    let at_rest: Vec<(Symbol, ExprId)> = accelerations.iter().map(|&a| (a, zero)).collect();
    let mut whole = Whole {
        matrix: vec![vec![Masked::default(); n]; n],
        right: Vec::with_capacity(n),
        balance: Vec::with_capacity(n),
    };
    for (&(i, j), terms) in &found.mass {
        let mut sum = Masked::default();
        for &(need, e) in terms {
            sum.add(pool, need, e);
        }
        whole.matrix[i][j] = sum.clone();
        whole.matrix[j][i] = sum;
    }
    for terms in &found.balance {
        let (mut right, mut balance) = (Masked::default(), Masked::default());
        for &(need, e) in terms {
            if need != ALWAYS && pool.depends_on_any(e, &accelerations) {
                return None;
            }
            let moving = pool.substitute(e, &unknown);
            balance.add(pool, need, moving);
            let load = pool.substitute(e, &at_rest);
            let load = pool.neg(load);
            right.add(pool, need, load);
        }
        whole.right.push(right);
        whole.balance.push(balance);
    }
    Some(whole)
}
