//! Powers that begin where a branch does, as the force k max(0, −y)^(3/2) of two bodies that are pressed together (Hertz 1882).
//!
//! d^(3/2) has no Taylor series where d = 0, which is where its branch begins, and no value where rounding has put d below. So the other side of the branch
//! holds until its guard is a little beyond zero. From there on series reach as far as d does.

use super::kept::places;
use crate::model::System;
use crate::sorted::SortedSet;
use crate::symbolic::{ExprId, Node, Pool, Rational, Symbol};

/// One over this beyond zero the side begins in which something is raised to a power, in the unit of the guard: above what rounding makes of places of a metre,
/// and small enough that a power above one is no force there.
const PARTS: i128 = 1_000_000_000_000;

/// Raises what is chosen where it is, and lets the sides with such powers begin a little later.
pub(super) fn delay(system: &mut System) {
    let Some(onset) = Rational::new(1, PARTS) else {
        return;
    };
    if system.branches.is_empty() {
        return;
    }
    let roots: Vec<ExprId> = places(system).into_iter().map(|e| *e).collect();
    let roots = system.pool.raise_sides(&roots);
    for (place, &raised) in places(system).into_iter().zip(&roots) {
        *place = raised;
    }
    let parameters: Vec<Symbol> = system.parameters.iter().map(|p| p.symbol).collect();
    let reachable = system.pool.iter_reachable(&roots);
    if reachable.iter().all(|&e| system.pool.begun(e).is_empty()) {
        return;
    }
    for (number, branch) in system.branches.iter_mut().enumerate() {
        let pool = &mut system.pool;
        let sides = sides(pool, &reachable, number);
        let begins = sides.map(|side| {
            let parts = pool.iter_reachable(&side).into_iter();
            let bases: SortedSet<ExprId> = parts.flat_map(|e| pool.begun(e)).collect();
            let mut bases = bases.into_iter();
            bases.any(|base| are_multiples(pool, &parameters, base, branch.declared))
        });
        let later = match begins {
            [true, false] => Rational::MINUS_ONE,
            [false, true] => Rational::ONE,
            _ => continue,
        };
        let onset = pool.number(onset);
        let later = pool.scale(onset, later);
        branch.guard = pool.add(branch.guard, later);
    }
}

/// What is chosen on both sides of a branch: of the branch itself, and of products in which it decides whether there is a power.
fn sides(pool: &mut Pool, reachable: &[ExprId], branch: usize) -> [Vec<ExprId>; 2] {
    let mut sides = [const { Vec::new() }; 2];
    for &e in reachable {
        let chooses = match *pool.node(e) {
            Node::Select { branch: this, .. } => this == branch,
            _ => !pool.begun(e).is_empty() && pool.branches(e).contains(&branch),
        };
        if chooses {
            sides[0].push(pool.on_side(e, branch, true));
            sides[1].push(pool.on_side(e, branch, false));
        }
    }
    sides
}

/// Whether two expressions are zero together in all motions: their ratio is a number, or does not change while they do.
fn are_multiples(pool: &mut Pool, parameters: &[Symbol], a: ExprId, b: ExprId) -> bool {
    let Some(ratio) = pool.div(a, b) else {
        return false;
    };
    if pool.as_number(ratio).is_some() {
        return true;
    }
    let moving = |pool: &Pool, e| {
        let mut symbols = pool.symbols(e);
        symbols.retain(|symbol| !parameters.contains(symbol));
        symbols
    };
    let changing = moving(pool, ratio);
    !moving(pool, a).is_empty()
        && changing.into_iter().all(|symbol| {
            let slope = pool.differentiate(ratio, symbol);
            pool.vanishes(slope)
        })
}
