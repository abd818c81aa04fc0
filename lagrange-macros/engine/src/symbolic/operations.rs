//! Number of operations of an expression as a graph, each distinct node once.
//!
//! A sum of k terms is k − 1 additions; ±1 as a coefficient is free, and terms with coefficients of one size share
//! a multiplication. Powers x^n go by squaring and are shared; all divisors of a product are one division; sin and
//! cos of one argument are one operation. What holds no symbol is a constant and free.

use super::hash::Memo;
use super::{ExprId, Function, Node, Pool, Rational};

/// exp(v ln u)
const GENERAL_POWER: usize = 3;

impl Pool {
    /// Number of operations of the expressions as one graph.
    pub fn operations(&self, e: &[ExprId]) -> usize {
        let mut count = Count {
            total: 0,
            powers: Memo::default(),
            pairs: Memo::default(),
        };
        let mut seen: Memo<ExprId, ()> = Memo::default();
        let mut stack = e.to_vec();
        while let Some(e) = stack.pop() {
            if self.symbol_bits(e) != 0 && seen.insert(e, ()).is_none() {
                self.count_node(e, &mut count);
                self.node(e).for_each_child(|child| stack.push(child));
            }
        }
        count.total
    }

    fn count_node(&self, e: ExprId, count: &mut Count) {
        match self.node(e) {
            Node::Number(_) | Node::Pi | Node::Symbol(_) => {}
            Node::Sum { constant, terms } => {
                count.total += terms.len() - 1 + usize::from(!constant.is_zero());
                let mut sizes: Vec<_> = terms
                    .iter()
                    .filter(|(_, c)| !c.is_unit())
                    .map(|(_, c)| (c.numerator().unsigned_abs(), c.denominator()))
                    .collect();
                sizes.sort();
                sizes.dedup();
                count.total += sizes.len();
            }
            Node::Product(factors) => {
                let mut above = 0;
                let mut below = 0;
                for &(base, exponent) in factors {
                    count.power(base, exponent);
                    if exponent.is_negative() {
                        below += 1
                    } else {
                        above += 1
                    }
                }
                count.total += usize::max(above, 1) - 1 + below;
            }
            Node::Power(..) => count.total += GENERAL_POWER,
            Node::Call(Function::Sin | Function::Cos, arguments) => count.pair(arguments[0], false),
            Node::Call(Function::Sinh | Function::Cosh, arguments) => {
                count.pair(arguments[0], true)
            }
            Node::Call(..) | Node::Select { .. } => count.total += 1,
        }
    }
}

struct Count {
    total: usize,
    powers: Memo<(ExprId, u64), ()>,
    pairs: Memo<(ExprId, bool), ()>,
}

impl Count {
    fn pair(&mut self, argument: ExprId, hyperbolic: bool) {
        if self.pairs.insert((argument, hyperbolic), ()).is_none() {
            self.total += 1;
        }
    }

    /// base^|exponent|
    fn power(&mut self, base: ExprId, exponent: Rational) {
        let size = exponent.numerator().unsigned_abs();
        let whole = (size / exponent.denominator().unsigned_abs()) as u64;
        let broken = !exponent.is_integer();
        if whole >= 2 && self.powers.insert((base, whole), ()).is_none() {
            self.total += (whole.ilog2() + whole.count_ones() - 1) as usize;
        }
        if broken && self.powers.insert((base, 0), ()).is_none() {
            self.total += 1;
        }
        self.total += usize::from(broken && whole > 0);
    }
}
