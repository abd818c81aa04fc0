//! Which coordinates are cyclic (ignorable): nothing that acts depends on them, so their momentum changes by
//! named forces only (Goldstein, Poole & Safko 2002, section 2.6; Lanczos 1970, section V.4).

use super::euler_lagrange::Inertia;
use super::sheet::Sheet;
use crate::sorted::{SortedMap, SortedSet};
use crate::symbolic::{ExprId, Node, Pool, Rational, Symbol};

/// Per coordinate: whether neither energies nor `others` (rows, forces, coefficients) depend on its position.
pub(super) fn cyclic(sheet: &mut Sheet, inertias: &[Inertia], others: &[ExprId]) -> Vec<bool> {
    let guards: Vec<ExprId> = sheet.system.branches.iter().map(|b| b.guard).collect();
    let pool = &mut sheet.system.pool;
    let mut present: SortedSet<Symbol> = SortedSet::new();
    let mut energies = Vec::new();
    for part in inertias
        .iter()
        .flat_map(|inertia| inertia.parts.iter().chain([&inertia.potential]))
    {
        present.extend(behind_guards(pool, &guards, *part));
        energies.push(terms_with(pool, *part));
    }
    for &e in others {
        present.extend(behind_guards(pool, &guards, e));
        present.extend(pool.symbols(e));
    }
    let mut free = |q: Symbol| {
        !present.contains(&q)
            && energies
                .iter()
                .all(|terms| terms.get(&q).is_none_or(|terms| is_flat(pool, terms, q)))
    };
    let mut cyclic: Vec<bool> = sheet.x.positions.iter().map(|&q| free(q)).collect();
    // The momentum of a turn changes with the axis that it is about.
    for &first in &sheet.x.turns {
        cyclic[first..first + 3].fill(false);
    }
    cyclic
}

/// Symbols that decide the branches of an expression.
fn behind_guards(pool: &Pool, guards: &[ExprId], e: ExprId) -> SortedSet<Symbol> {
    let mut symbols = SortedSet::new();
    let mut seen = SortedSet::new();
    let mut open = pool.branches(e);
    while let Some(branch) = open.pop() {
        if seen.insert(branch) {
            symbols.extend(pool.symbols(guards[branch]));
            open.extend(pool.branches(guards[branch]));
        }
    }
    symbols
}

/// The terms of a sum in which each symbol occurs: a large energy has many, each with few symbols.
fn terms_with(pool: &Pool, e: ExprId) -> SortedMap<Symbol, Vec<(ExprId, Rational)>> {
    let mut terms_with: SortedMap<_, Vec<_>> = SortedMap::new();
    let mut put = |term, number| {
        for symbol in pool.symbols(term) {
            terms_with.get_or_default(symbol).push((term, number));
        }
    };
    match pool.node(e) {
        Node::Sum { terms, .. } => terms.iter().for_each(|&(term, c)| put(term, c)),
        _ => put(e, Rational::ONE),
    }
    terms_with
}

/// Whether terms contain a position by form only.
fn is_flat(pool: &mut Pool, terms: &[(ExprId, Rational)], q: Symbol) -> bool {
    let slopes = terms.iter().map(|&(e, c)| (pool.differentiate(e, q), c));
    let slopes = slopes.collect();
    let slope = pool.linear(Rational::ZERO, slopes);
    let slope = pool.simplify(slope);
    pool.is_zero(slope)
}
