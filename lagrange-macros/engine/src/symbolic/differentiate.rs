//! Derivatives by one pass over the distinct nodes, with a memo per direction that lasts as long as the pool.

use super::table::Table;
use super::{ExprId, Function, Node, Pool, Rational, Symbol};

impl Pool {
    /// ∂e/∂symbol.
    pub fn differentiate(&mut self, e: ExprId, symbol: Symbol) -> ExprId {
        let one = self.integer(1);
        self.derivative_along(e, &[(symbol, one)])
    }

    /// Σ ∂e/∂sᵢ · directionᵢ: with (q, v), (v, a), (t, 1) the total time derivative. One pass over the pool.
    pub fn derivative_along(&mut self, e: ExprId, direction: &[(Symbol, ExprId)]) -> ExprId {
        let slot = match self.directions.get(direction) {
            Some(&slot) => slot,
            None => {
                let slot = self.derivatives.len();
                self.directions.insert(direction.to_vec(), slot);
                self.derivatives.push(Table::default());
                slot
            }
        };
        let mut known = std::mem::take(&mut self.derivatives[slot]);
        let symbols: Vec<Symbol> = direction.iter().map(|&(symbol, _)| symbol).collect();
        let bits = Pool::bits(&symbols);
        let constant = |pool: &Pool, e| pool.symbol_bits(e) & bits == 0;
        let derivative = self.ascend(e, &mut known, constant, |pool, e, known| {
            pool.derivative_of(e, direction, known)
        });
        self.derivatives[slot] = known;
        derivative.unwrap_or_else(|| self.integer(0))
    }

    /// Derivative of one node from those of its children; children that are not in the memo have derivative 0.
    fn derivative_of(
        &mut self,
        e: ExprId,
        direction: &[(Symbol, ExprId)],
        known: &Table,
    ) -> ExprId {
        let zero = self.integer(0);
        let of = |e: &ExprId| known.get(*e).filter(|&d| d != zero);
        match self.node(e) {
            Node::Number(_) | Node::Pi => zero,
            Node::Symbol(symbol) => direction
                .iter()
                .find(|(s, _)| s == symbol)
                .map_or(zero, |&(_, derivative)| derivative),
            Node::Sum { terms, .. } => {
                let terms = terms
                    .iter()
                    .filter_map(|(term, c)| of(term).map(|d| (d, *c)))
                    .collect();
                self.linear(Rational::ZERO, terms)
            }
            Node::Product(factors) => {
                let factors = factors.clone();
                let mut terms = Vec::new();
                let mut rest = Vec::with_capacity(factors.len() + 1);
                for (i, &(base, exponent)) in factors.iter().enumerate() {
                    let Some(derivative) = of(&base) else {
                        continue;
                    };
                    rest.clear();
                    rest.extend_from_slice(&factors);
                    rest[i].1 = self.plus(exponent, Rational::MINUS_ONE);
                    rest.push((derivative, Rational::ONE));
                    terms.push((self.monomial(exponent, &rest), Rational::ONE));
                }
                self.linear(Rational::ZERO, terms)
            }
            Node::Power(base, exponent) => {
                let (base, exponent) = (*base, *exponent);
                let mut terms = Vec::new();
                if let Some(derivative) = of(&base) {
                    // e·b^(e−1)·b′: the product merges b^e and b^(−1).
                    let list = [e, exponent, derivative, base];
                    let mut factors = list.map(|factor| (factor, Rational::ONE));
                    factors[3].1 = Rational::MINUS_ONE;
                    terms.push((self.monomial(Rational::ONE, &factors), Rational::ONE));
                }
                if let Some(derivative) = of(&exponent) {
                    let logarithm = self.call(Function::Ln, &[base]);
                    terms.push((self.product(&[e, logarithm, derivative]), Rational::ONE));
                }
                self.linear(Rational::ZERO, terms)
            }
            Node::Call(f, arguments) => {
                let f = *f;
                let derivatives = [of(&arguments[0]), arguments.get(1).and_then(of)];
                let arguments = [
                    arguments[0],
                    arguments.get(1).copied().unwrap_or(arguments[0]),
                ];
                self.derivative_of_call(e, f, arguments, derivatives)
            }
            Node::Group(e) => {
                let derivative = of(e).unwrap_or(zero);
                self.group_sum(derivative)
            }
            Node::Select {
                branch,
                then,
                otherwise,
            } => {
                let (branch, then, otherwise) = (
                    *branch,
                    of(then).unwrap_or(zero),
                    of(otherwise).unwrap_or(zero),
                );
                self.select(branch, then, otherwise)
            }
        }
    }

    /// Derivative of e = f(arguments); the second argument counts for two-argument functions only.
    fn derivative_of_call(
        &mut self,
        e: ExprId,
        f: Function,
        arguments: [ExprId; 2],
        derivatives: [Option<ExprId>; 2],
    ) -> ExprId {
        const ONE: Rational = Rational::ONE;
        const TWO: Rational = Rational::integer(2);
        const BELOW: Rational = Rational::MINUS_ONE;
        let u = arguments[0];
        if f == Function::Atan2 {
            // d atan2(y, x) = (x dy − y dx)/(x² + y²)
            let (y, x) = (arguments[0], arguments[1]);
            let squares = [self.raise(x, TWO), self.raise(y, TWO)];
            let squares = self.sum(&squares);
            let mut terms = Vec::new();
            for (derivative, other, sign) in [(derivatives[0], x, ONE), (derivatives[1], y, BELOW)]
            {
                if let Some(derivative) = derivative {
                    let factors = [(other, ONE), (derivative, ONE)];
                    terms.push((self.monomial(ONE, &factors), sign));
                }
            }
            let above = self.linear(Rational::ZERO, terms);
            return self.monomial(ONE, &[(above, ONE), (squares, BELOW)]);
        }
        let Some(derivative) = derivatives[0] else {
            return self.integer(0);
        };
        let mut quadratic = |of: ExprId, sign: Rational| {
            let square = self.raise(of, TWO);
            self.linear(ONE, vec![(square, sign)])
        };
        let (coefficient, factor, exponent) = match f {
            Function::Sin => (ONE, self.call(Function::Cos, &[u]), ONE),
            Function::Cos => (BELOW, self.call(Function::Sin, &[u]), ONE),
            Function::Tan => (ONE, quadratic(e, ONE), ONE),
            Function::Asin => (ONE, quadratic(u, BELOW), Rational::MINUS_HALF),
            Function::Acos => (BELOW, quadratic(u, BELOW), Rational::MINUS_HALF),
            Function::Atan | Function::Atan2 => (ONE, quadratic(u, ONE), BELOW),
            Function::Sinh => (ONE, self.call(Function::Cosh, &[u]), ONE),
            Function::Cosh => (ONE, self.call(Function::Sinh, &[u]), ONE),
            Function::Tanh => (ONE, quadratic(e, BELOW), ONE),
            Function::Exp => (ONE, e, ONE),
            Function::Ln => (ONE, u, BELOW),
        };
        self.monomial(coefficient, &[(factor, exponent), (derivative, ONE)])
    }
}
