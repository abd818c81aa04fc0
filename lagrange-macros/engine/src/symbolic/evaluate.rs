//! Values of expressions in f64: the plain meaning of the forms, for checks.

use super::{ExprId, Function, Node, Pool, Rational, Symbol};

impl Pool {
    /// Value at given symbol values (by symbol index) and branches.
    pub fn evaluate(
        &self,
        e: &[ExprId],
        symbols: &dyn Fn(Symbol) -> f64,
        then: &dyn Fn(usize) -> bool,
    ) -> Vec<f64> {
        let reachable = self.iter_reachable(e);
        let mut values = vec![f64::NAN; e.iter().map(|e| e.index() + 1).max().unwrap_or(0)];
        for &e in &reachable {
            let at = |e: ExprId| values[e.index()];
            values[e.index()] = match self.node(e) {
                Node::Number(n) => n.to_f64(),
                Node::Pi => std::f64::consts::PI,
                Node::Symbol(symbol) => symbols(*symbol),
                Node::Sum { constant, terms } => terms
                    .iter()
                    .fold(constant.to_f64(), |sum, &(e, c)| sum + c.to_f64() * at(e)),
                Node::Product(factors) => factors
                    .iter()
                    .fold(1.0, |product, &(e, r)| product * power(at(e), r)),
                Node::Power(base, exponent) => at(*base).powf(at(*exponent)),
                Node::Call(Function::Atan2, arguments) => at(arguments[0]).atan2(at(arguments[1])),
                Node::Call(f, arguments) => apply(*f, at(arguments[0])),
                Node::Group(e) => at(*e),
                Node::Select {
                    branch,
                    then: first,
                    otherwise,
                } => at(if then(*branch) { *first } else { *otherwise }),
            };
        }
        e.iter().map(|e| values[e.index()]).collect()
    }
}

/// x^r
fn power(x: f64, r: Rational) -> f64 {
    match r.to_integer().map(i32::try_from) {
        Some(Ok(n)) => x.powi(n),
        _ if r == Rational::HALF => x.sqrt(),
        _ if r == Rational::MINUS_HALF => 1.0 / x.sqrt(),
        _ => x.powf(r.to_f64()),
    }
}

/// f(x) of one argument.
fn apply(f: Function, x: f64) -> f64 {
    match f {
        Function::Sin => x.sin(),
        Function::Cos => x.cos(),
        Function::Tan => x.tan(),
        Function::Asin => x.asin(),
        Function::Acos => x.acos(),
        // Atan2 has two arguments; the point (1, x) has this angle.
        Function::Atan | Function::Atan2 => x.atan(),
        Function::Sinh => x.sinh(),
        Function::Cosh => x.cosh(),
        Function::Tanh => x.tanh(),
        Function::Exp => x.exp(),
        Function::Ln => x.ln(),
    }
}
