//! Expressions that are affine in some symbols: Σ cᵢ sᵢ + rest.

use super::{ExprId, Node, Pool, Rational, Symbol};

impl Pool {
    /// If e is affine in the symbols, its coefficients ∂e/∂sᵢ and the rest e(s = 0); else None. Decided by
    /// derivatives: each must be free of all the symbols, if need be after multiplying out.
    pub fn coefficients_linear(
        &mut self,
        e: ExprId,
        symbols: &[Symbol],
    ) -> Option<(Vec<ExprId>, ExprId)> {
        let mut coefficients = Vec::with_capacity(symbols.len());
        for &symbol in symbols {
            let mut derivative = self.differentiate(e, symbol);
            if self.depends_on_any(derivative, symbols) {
                derivative = self.expand(derivative);
                if self.depends_on_any(derivative, symbols) {
                    return None;
                }
            }
            coefficients.push(derivative);
        }
        let zero = self.integer(0);
        let nowhere: Vec<_> = symbols.iter().map(|&symbol| (symbol, zero)).collect();
        let rest = self.substitute(e, &nowhere);
        if !self.divides_by_zero(rest) {
            return Some((coefficients, rest));
        }
        // A symbol cancels in e = (s² + s)/s, but not at s = 0.
        let mut terms = vec![(e, Rational::ONE)];
        for (&symbol, &coefficient) in symbols.iter().zip(&coefficients) {
            let leaf = self.leaf(symbol);
            terms.push((self.mul(leaf, coefficient), Rational::MINUS_ONE));
        }
        let rest = self.linear(Rational::ZERO, terms);
        let rest = self.expand(rest);
        (!self.depends_on_any(rest, symbols)).then_some((coefficients, rest))
    }

    /// Whether 0 to a negative power occurs.
    fn divides_by_zero(&self, e: ExprId) -> bool {
        self.iter_reachable(&[e])
            .into_iter()
            .any(|e| match self.node(e) {
                Node::Product(factors) => factors.iter().any(|&(base, _)| self.is_zero(base)),
                _ => false,
            })
    }
}
