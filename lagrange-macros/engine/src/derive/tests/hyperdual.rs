//! Exact first and mixed second derivatives of an expression by hyper-dual numbers (Fike & Alonso 2011),
//! independent of the symbolic differentiation and simplification that they check.

use crate::symbolic::{ExprId, Function, Node, Pool, Symbol};

/// a + b ε₁ + c ε₂ + d ε₁ε₂
#[derive(Clone, Copy, Debug)]
pub struct HyperDual(pub [f64; 4]);

impl HyperDual {
    fn constant(a: f64) -> Self {
        Self([a, 0.0, 0.0, 0.0])
    }

    fn add(self, other: Self) -> Self {
        Self([0, 1, 2, 3].map(|i| self.0[i] + other.0[i]))
    }

    fn mul(self, other: Self) -> Self {
        let ([a, b, c, d], [e, f, g, h]) = (self.0, other.0);
        Self([
            a * e,
            a * f + b * e,
            a * g + c * e,
            a * h + b * g + c * f + d * e,
        ])
    }

    /// f(x) from f, f′, f″ at the value.
    fn chain(self, f: f64, first: f64, second: f64) -> Self {
        let [_, b, c, d] = self.0;
        Self([f, first * b, first * c, first * d + second * b * c])
    }

    fn power(self, p: f64) -> Self {
        let x = self.0[0];
        let derivative = |factor: f64, p: f64| {
            if factor == 0.0 {
                0.0
            } else {
                factor * x.powf(p)
            }
        };
        self.chain(
            x.powf(p),
            derivative(p, p - 1.0),
            derivative(p * (p - 1.0), p - 2.0),
        )
    }

    fn call(self, f: Function) -> Self {
        let x = self.0[0];
        let (s, c) = x.sin_cos();
        let r = 1.0 - x * x;
        match f {
            Function::Sin => self.chain(s, c, -s),
            Function::Cos => self.chain(c, -s, -c),
            Function::Tan => self.chain(s / c, 1.0 / (c * c), 2.0 * s / (c * c * c)),
            Function::Asin => self.chain(x.asin(), r.powf(-0.5), x * r.powf(-1.5)),
            Function::Acos => self.chain(x.acos(), -r.powf(-0.5), -x * r.powf(-1.5)),
            Function::Atan => {
                let d = 1.0 / (1.0 + x * x);
                self.chain(x.atan(), d, -2.0 * x * d * d)
            }
            Function::Sinh => self.chain(x.sinh(), x.cosh(), x.sinh()),
            Function::Cosh => self.chain(x.cosh(), x.sinh(), x.cosh()),
            Function::Tanh => {
                let (h, d) = (x.tanh(), 1.0 - x.tanh() * x.tanh());
                self.chain(h, d, -2.0 * h * d)
            }
            Function::Exp => self.chain(x.exp(), x.exp(), x.exp()),
            Function::Ln => self.chain(x.ln(), 1.0 / x, -1.0 / (x * x)),
            Function::Atan2 => unreachable!("not used by these tests"),
        }
    }
}

/// An expression at `value + ε₁ first + ε₂ second` of each symbol.
pub fn evaluate(
    pool: &Pool,
    e: ExprId,
    at: &dyn Fn(Symbol) -> [f64; 3],
    then: &dyn Fn(usize) -> bool,
) -> HyperDual {
    let go = |e: ExprId| evaluate(pool, e, at, then);
    match pool.node(e) {
        Node::Group(e) => go(*e),
        Node::Number(n) => HyperDual::constant(n.to_f64()),
        Node::Pi => HyperDual::constant(std::f64::consts::PI),
        Node::Symbol(s) => {
            let [value, first, second] = at(*s);
            HyperDual([value, first, second, 0.0])
        }
        Node::Sum { constant, terms } => terms
            .iter()
            .fold(HyperDual::constant(constant.to_f64()), |sum, &(term, c)| {
                sum.add(go(term).mul(HyperDual::constant(c.to_f64())))
            }),
        Node::Product(factors) => factors
            .iter()
            .fold(HyperDual::constant(1.0), |product, &(base, exponent)| {
                product.mul(go(base).power(exponent.to_f64()))
            }),
        Node::Power(base, exponent) => go(*base)
            .call(Function::Ln)
            .mul(go(*exponent))
            .call(Function::Exp),
        Node::Call(f, arguments) => go(arguments[0]).call(*f),
        Node::Select {
            branch,
            then: yes,
            otherwise,
        } => go(if then(*branch) { *yes } else { *otherwise }),
    }
}
