//! Which coordinates are cyclic (ignorable): nothing that acts depends on them, so their momentum changes by
//! named forces only (Goldstein, Poole & Safko 2002, section 2.6; Lanczos 1970, section V.4).

use super::euler_lagrange::Inertia;
use super::sheet::Sheet;
use crate::symbolic::{ExprId, Pool, Symbol};
use std::collections::BTreeSet;

/// Per coordinate: whether neither energies nor `others` (rows, forces, coefficients) depend on its position.
pub(super) fn cyclic(sheet: &mut Sheet, inertias: &[Inertia], others: &[ExprId]) -> Vec<bool> {
    let guards: Vec<ExprId> = sheet.system.branches.iter().map(|b| b.guard).collect();
    let pool = &mut sheet.system.pool;
    let mut present = BTreeSet::new();
    for &e in others {
        present.extend(reach(pool, &guards, e));
    }
    sheet
        .x
        .positions
        .iter()
        .map(|&q| {
            !present.contains(&q)
                && inertias.iter().all(|inertia| {
                    free_of(pool, &guards, inertia.kinetic, q)
                        && free_of(pool, &guards, inertia.potential, q)
                })
        })
        .collect()
}

/// Symbols that an expression depends on, also by the guards of its branches.
fn reach(pool: &Pool, guards: &[ExprId], e: ExprId) -> BTreeSet<Symbol> {
    let mut symbols: BTreeSet<Symbol> = pool.symbols(e).into_iter().collect();
    let mut seen = BTreeSet::new();
    let mut open = pool.branches(e);
    while let Some(branch) = open.pop() {
        if seen.insert(branch) {
            symbols.extend(pool.symbols(guards[branch]));
            open.extend(pool.branches(guards[branch]));
        }
    }
    symbols
}

/// Whether an energy is free of a position, if not by form then because its derivative vanishes.
fn free_of(pool: &mut Pool, guards: &[ExprId], energy: ExprId, q: Symbol) -> bool {
    if !reach(pool, guards, energy).contains(&q) {
        return true;
    }
    let by_guard = pool
        .branches(energy)
        .into_iter()
        .any(|b| reach(pool, guards, guards[b]).contains(&q));
    if by_guard {
        return false;
    }
    let slope = pool.differentiate(energy, q);
    let slope = pool.simplify(slope);
    pool.is_zero(slope)
}
