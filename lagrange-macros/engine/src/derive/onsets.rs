//! Powers that begin where a branch does, as the force k max(0, −y)^(3/2) of two bodies that are pressed together (Hertz 1882).
//!
//! d^(3/2) has no Taylor series where d = 0, which is where its branch begins, and no value where rounding has put d below. So the other side of the branch
//! holds until d is a little above zero. From there on series reach as far as d does.

use super::kept::places;
use crate::model::System;
use crate::sorted::SortedSet;
use crate::symbolic::{ExprId, Node, Rational};

/// One over this above zero begins what is raised to a power, in its own unit: above what rounding makes of places of a metre, and small enough that a power above
/// one is no force there.
const PARTS: i128 = 1_000_000_000_000;

/// Raises what is chosen where it is, and lets the branches of such powers begin a little later.
pub(super) fn delay(system: &mut System) {
    let Some(onset) = Rational::new(1, PARTS) else {
        return;
    };
    if system.branches.is_empty() {
        return;
    }
    let roots: Vec<ExprId> = places(system).into_iter().map(|e| *e).collect();
    let roots = system.pool.raise_sides(&roots);
    let mut raised = SortedSet::new();
    for e in system.pool.iter_reachable(&roots) {
        if let Node::Product(factors) = system.pool.node(e) {
            let above_one = |exponent: Rational| exponent > Rational::ONE && !exponent.is_integer();
            let bases = factors.iter().filter(|&&(_, p)| above_one(p));
            raised.extend(bases.map(|&(base, _)| base));
        }
    }
    for (place, raised) in places(system).into_iter().zip(roots) {
        *place = raised;
    }
    for branch in &mut system.branches {
        let pool = &mut system.pool;
        let opposite = pool.scale(branch.guard, Rational::MINUS_ONE);
        let later = match [branch.guard, opposite].map(|side| raised.contains(&side)) {
            [true, false] => Rational::MINUS_ONE,
            [false, true] => Rational::ONE,
            _ => continue,
        };
        let onset = pool.number(onset);
        let later = pool.scale(onset, later);
        branch.guard = pool.add(branch.guard, later);
    }
}
