//! Roots of squares: (s²)^(1/2) → |s|, which has a Taylor series on each side of s = 0.

use super::node::{ExprId, Node};
use super::table::Table;
use super::{Pool, Rational};

impl Pool {
    /// e with square^r, where r is not an integer, written as root^(2r); `root` is the non-negative root of `square`.
    pub fn extract_root(&mut self, e: ExprId, square: ExprId, root: ExprId) -> ExprId {
        let mut known = Table::default();
        let nothing = |_: &Pool, _| false;
        let extracted = self.ascend(e, &mut known, nothing, |pool, e, known| {
            let e = pool.with_children(e, known);
            let Node::Product(factors) = pool.node(e) else {
                return e;
            };
            let rooted = |&(base, exponent): &(ExprId, Rational)| {
                let twice = exponent
                    .checked_add(exponent)
                    .filter(|_| !exponent.is_integer());
                match twice {
                    Some(twice) if base == square => (root, twice),
                    _ => (base, exponent),
                }
            };
            let changed: Vec<_> = factors.iter().map(rooted).collect();
            if changed == *factors {
                return e;
            }
            pool.monomial(Rational::ONE, &changed)
        });
        extracted.unwrap_or(e)
    }
}
