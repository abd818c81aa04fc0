//! What follows from the unknowns w of the linear system: all accelerations and all forces.

use super::balance::Slide;
use super::masked::Masked;
use super::reduce::Reduced;
use crate::symbolic::{ExprId, Pool};

/// v̇ of w
pub(super) fn accelerations(
    pool: &mut Pool,
    reduced: &Reduced,
    w: &[ExprId],
) -> Option<Vec<Masked>> {
    let mut accelerations = Vec::with_capacity(reduced.accelerations.len());
    for combination in &reduced.accelerations {
        let mut terms = Vec::with_capacity(combination.len());
        for (&k, &z) in combination {
            terms.push(pool.mul(z, w[reduced.index(k)?]));
        }
        let sum = pool.sum(&terms);
        accelerations.push(Masked::always(pool, sum));
    }
    Some(accelerations)
}

/// λ of (t, q, v, w), of as many rows; nothing for a row without a force.
pub(super) fn forces(
    pool: &mut Pool,
    reduced: &Reduced,
    slides: &[Slide],
    w: &[ExprId],
    rows: usize,
) -> Option<Vec<Option<Masked>>> {
    let mut forces: Vec<Option<Masked>> = vec![None; rows];
    for (&(row, ..), &unknown) in reduced.kept.iter().zip(&w[reduced.free.len()..]) {
        let minus = pool.neg(unknown);
        forces[row] = Some(Masked::always(pool, minus));
    }
    let one = pool.integer(1);
    let minus_one = pool.integer(-1);
    // A balance may hold forces of rows that are eliminated later.
    for solved in reduced.solved.iter().rev() {
        let balance = &solved.balance;
        let inverse = pool.div(one, solved.coefficient)?;
        let mut sum = Masked::default();
        for (&k, entry) in &reduced.inertia(pool, &balance.mass) {
            sum.add_scaled(pool, w[reduced.index(k)?], entry);
        }
        sum.add_scaled(pool, minus_one, &balance.load);
        for (&row, factor) in balance.forces.iter().filter(|(row, _)| **row != solved.row) {
            let factor = factor.whole(pool)?;
            let factor = pool.neg(factor);
            sum.add_scaled(pool, factor, forces[row].as_ref()?);
        }
        let mut force = Masked::default();
        force.add_scaled(pool, inverse, &sum);
        forces[solved.row] = Some(force.simplified(pool));
    }
    for slide in slides {
        let mut force = Masked::default();
        match slide.source {
            Some(source) => force.add_scaled(pool, slide.factor, forces[source].as_ref()?),
            None => force = Masked::always(pool, slide.factor),
        }
        forces[slide.row] = Some(force);
    }
    Some(forces)
}
