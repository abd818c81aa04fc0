//! What is left of the equations of a mode → its linear system K w = b.

use super::masked::Masked;
use super::program::LinearSystem;
use super::reduce::Reduced;
use super::whole::Whole;
use crate::symbolic::{ExprId, Pool, Symbol};

/// The linear system; with `whole`, K and b of the accelerations are those of the whole equations, and the system has their balance.
/// None where a balance has the acceleration of a coordinate that is not free.
pub(super) fn linear_system(
    pool: &mut Pool,
    reduced: &Reduced,
    whole: Option<Whole>,
    state: &[Symbol],
) -> Option<LinearSystem<Masked>> {
    let mut system = elements(pool, reduced)?;
    if let Some(whole) = whole {
        for (row, own) in system.matrix.iter_mut().zip(&whole.matrix) {
            row[..own.len()].clone_from_slice(own);
        }
        let of_accelerations = system.right.iter_mut().zip(whole.right);
        of_accelerations.for_each(|(right, own)| *right = own);
        system.balance = Some(whole.balance);
    }
    if system.symmetric {
        mirror(&mut system);
    }
    divide(pool, &mut system, state);
    Some(system)
}

/// K and b, element by element.
fn elements(pool: &mut Pool, reduced: &Reduced) -> Option<LinearSystem<Masked>> {
    let free = reduced.free.len();
    let size = free + reduced.kept.len();
    let mut matrix = vec![vec![Masked::default(); size]; size];
    let mut right = Vec::with_capacity(size);
    for (i, balance) in reduced.balances.iter().enumerate() {
        for (k, entry) in reduced.inertia(pool, &balance.mass) {
            matrix[i][reduced.index(k)?] = entry;
        }
        for (m, (row, ..)) in reduced.kept.iter().enumerate() {
            if let Some(force) = balance.forces.get(row) {
                matrix[i][free + m] = force.simplified(pool);
            }
        }
        right.push(balance.load.simplified(pool));
    }
    for (m, (_, along, bias)) in reduced.kept.iter().enumerate() {
        for (&k, &a) in along {
            matrix[free + m][reduced.index(k)?] = Masked::always(pool, a);
        }
        let minus = pool.neg(*bias);
        right.push(Masked::always(pool, minus));
    }
    Some(LinearSystem {
        accelerations: free,
        symmetric: reduced.symmetric,
        matrix,
        right,
        reciprocals: vec![None; size],
        positive: Vec::new(),
        units: vec![false; size],
        balance: None,
    })
}

/// Equal elements among the accelerations are written alike.
fn mirror(system: &mut LinearSystem<Masked>) {
    for i in 0..system.accelerations {
        let (above, below) = system.matrix.split_at_mut(i);
        let upper = above.iter_mut().zip(&below[0]);
        upper.for_each(|(row, entry)| row[i] = entry.clone());
    }
}

/// Divides by the inertias of parameters alone: at once where an unknown stands alone, otherwise the solution multiplies by the reciprocal.
fn divide(pool: &mut Pool, system: &mut LinearSystem<Masked>, state: &[Symbol]) {
    let one = pool.integer(1);
    let quotient = |pool: &mut Pool, inverse: ExprId, sum: &Masked| {
        let mut quotient = Masked::default();
        quotient.add_scaled(pool, inverse, sum);
        quotient
    };
    for i in 0..system.accelerations {
        let matrix = &system.matrix;
        let diagonal = matrix[i][i].whole(pool).filter(|&e| {
            !pool.is_zero(e) && !pool.depends_on_any(e, state) && pool.branches(e).is_empty()
        });
        let Some((inertia, inverse)) = diagonal.and_then(|e| Some((e, pool.div(one, e)?))) else {
            continue;
        };
        system.positive.push(Masked::always(pool, inertia));
        let mut others = (0..matrix.len()).filter(|&j| j != i);
        if others.all(|j| matrix[i][j].is_zero() && matrix[j][i].is_zero()) {
            system.right[i] = quotient(pool, inverse, &system.right[i]).simplified(pool);
            system.units[i] = true;
            if let Some(balance) = &mut system.balance {
                balance[i] = quotient(pool, inverse, &balance[i]);
            }
        } else {
            system.reciprocals[i] = Some(Masked::always(pool, inverse));
        }
    }
}
