//! The degree of an expression in some symbols: by form where that is enough, else by derivatives.

use super::elaboration::Elaboration;
use crate::symbolic::{ExprId, Node, Pool, Symbol};

/// The degree by form: an upper bound, since what cancels is not seen. `None`: not a polynomial in the symbols.
pub(super) fn degree(pool: &Pool, e: ExprId, symbols: &[Symbol]) -> Option<i64> {
    // Ascending ids: what a node is made of comes before it.
    let mut degrees: Vec<Option<i64>> = vec![None; e.index() + 1];
    for node in pool.iter_reachable(&[e]) {
        let of = |child: ExprId| degrees[child.index()];
        let is_free = |child: &ExprId| of(*child) == Some(0);
        degrees[node.index()] = match pool.node(node) {
            Node::Number(_) | Node::Pi => Some(0),
            Node::Symbol(symbol) => Some(i64::from(symbols.contains(symbol))),
            Node::Sum { terms, .. } => terms
                .iter()
                .try_fold(0, |most, (term, _)| Some(of(*term)?.max(most))),
            Node::Product(factors) => factors.iter().try_fold(0i64, |sum, (base, exponent)| {
                let inner = of(*base)?;
                match (inner, exponent.to_integer()) {
                    (0, _) => Some(sum),
                    (_, Some(power)) if power > 0 => sum.checked_add(inner.checked_mul(power)?),
                    _ => None,
                }
            }),
            Node::Power(base, exponent) => (is_free(base) && is_free(exponent)).then_some(0),
            Node::Call(_, arguments) => arguments.iter().all(is_free).then_some(0),
            Node::Group(e) => of(*e),
            Node::Select {
                then, otherwise, ..
            } => of(*then).zip(of(*otherwise)).map(|(a, b)| a.max(b)),
        };
    }
    degrees[e.index()]
}

impl Elaboration<'_> {
    /// A symbol of these in which an expression is not linear.
    pub fn nonlinear_in(&mut self, e: ExprId, symbols: &[Symbol]) -> Option<Symbol> {
        if let Some(symbol) = self.switched_by(e, symbols) {
            return Some(symbol);
        }
        if degree(&self.system.pool, e, symbols).is_some_and(|degree| degree <= 1) {
            return None;
        }
        let occurring = self.system.pool.symbols(e);
        for &symbol in symbols.iter().filter(|symbol| occurring.contains(symbol)) {
            let slope = self.system.pool.differentiate(e, symbol);
            if !self.system.pool.depends_on_any(slope, symbols) {
                continue;
            }
            let slope = self.system.pool.simplify(slope);
            if self.system.pool.depends_on_any(slope, symbols) {
                return Some(symbol);
            }
        }
        None
    }

    /// A symbol of these that decides a branch of an expression, as in `abs(der(x))`: each side may be a polynomial,
    /// the whole is not.
    fn switched_by(&self, e: ExprId, symbols: &[Symbol]) -> Option<Symbol> {
        let pool = &self.system.pool;
        let guards = pool
            .branches(e)
            .into_iter()
            .map(|branch| self.system.branches[branch].guard);
        let deciding: Vec<Symbol> = guards.flat_map(|guard| pool.symbols(guard)).collect();
        symbols
            .iter()
            .copied()
            .find(|symbol| deciding.contains(symbol))
    }

    /// A symbol of these in which an expression is not of second degree.
    pub fn not_quadratic_in(&mut self, e: ExprId, symbols: &[Symbol]) -> Option<Symbol> {
        if let Some(symbol) = self.switched_by(e, symbols) {
            return Some(symbol);
        }
        if degree(&self.system.pool, e, symbols).is_some_and(|degree| degree <= 2) {
            return None;
        }
        symbols.iter().copied().find(|&symbol| {
            let slope = self.system.pool.differentiate(e, symbol);
            self.nonlinear_in(slope, symbols).is_some()
        })
    }
}
