//! N-ary graph → binary operations: balanced sums and products, power chains, one sin_cos for sine and cosine.

use super::constants::Constants;
use super::graph::{Graph, NodeId, Shape, Term, Unary};
use super::tape::{Coefficient, Operation, Value};
use crate::symbolic::{ExprId, Pool};
use std::collections::HashMap;

/// The operations of a tape before they are put into blocks; equal operations are one.
pub(super) struct Lowered {
    /// (first value that it defines, operation), operands first.
    pub operations: Vec<(Value, Operation)>,
    /// Number of values, with the inputs.
    pub values: usize,
    known: HashMap<Operation, Value>,
}

/// Lowers the nodes of a graph on demand.
pub(super) struct Lowerer<'a> {
    pool: &'a mut Pool,
    graph: &'a Graph,
    constants: &'a mut Constants,
    out: Lowered,
    values: HashMap<NodeId, Value>,
}

impl Lowered {
    fn push(&mut self, operation: Operation) -> Value {
        if let Some(value) = self.known.get(&operation) {
            return *value;
        }
        let value = Value(self.values);
        self.values += operation.values();
        self.operations.push((value, operation));
        self.known.insert(operation, value);
        value
    }
}

impl<'a> Lowerer<'a> {
    /// For a tape with this number of inputs.
    pub fn new(
        pool: &'a mut Pool,
        graph: &'a Graph,
        constants: &'a mut Constants,
        inputs: usize,
    ) -> Lowerer<'a> {
        let out = Lowered {
            operations: Vec::new(),
            values: inputs,
            known: HashMap::new(),
        };
        Lowerer {
            pool,
            graph,
            constants,
            out,
            values: HashMap::new(),
        }
    }

    /// What has been lowered.
    pub fn finish(self) -> Lowered {
        self.out
    }

    /// The value 0.
    pub fn zero(&mut self) -> Value {
        let zero = self.pool.integer(0);
        let zero = self.coefficient(zero);
        self.out.push(Operation::Constant(zero))
    }

    /// The value of a node.
    pub fn value(&mut self, node: NodeId) -> Value {
        if let Some(value) = self.values.get(&node) {
            return *value;
        }
        let value = match self.graph.shape(node).clone() {
            Shape::Input(input) => Value(input),
            Shape::Fixed(e) => {
                let c = self.coefficient(e);
                self.out.push(Operation::Constant(c))
            }
            Shape::Sum { offset, terms } => self.sum(offset, &terms),
            Shape::Product(factors) => self.product(node, &factors),
            Shape::Quotient {
                numerator: Some(numerator),
                denominator,
            } => {
                let (x, y) = (self.value(numerator), self.value(denominator));
                self.out.push(Operation::Div(x, y))
            }
            Shape::Quotient {
                numerator: None,
                denominator,
            } => {
                let one = self.pool.integer(1);
                self.ratio(one, denominator)
            }
            Shape::Powf(x, exponent) => {
                let x = self.value(x);
                self.out.push(Operation::Powf(x, exponent))
            }
            Shape::Unary(function, x) => {
                let x = self.value(x);
                self.unary(function, x)
            }
            Shape::Atan2(y, x) => {
                let (y, x) = (self.value(y), self.value(x));
                self.out.push(Operation::Atan2(y, x))
            }
            Shape::Select(branch, x, y) => {
                let (x, y) = (self.value(x), self.value(y));
                self.out.push(Operation::Select(branch, x, y))
            }
            Shape::Choose(guard, x, y) => {
                let (guard, x, y) = (self.value(guard), self.value(x), self.value(y));
                self.out.push(Operation::Choose(guard, x, y))
            }
        };
        self.values.insert(node, value);
        value
    }

    fn coefficient(&mut self, e: ExprId) -> Coefficient {
        self.constants.coefficient(self.pool, e)
    }

    fn unary(&mut self, function: Unary, x: Value) -> Value {
        let (operation, second) = match function {
            Unary::Sqrt => (Operation::Sqrt(x), false),
            Unary::Exp => (Operation::Exp(x), false),
            Unary::Ln => (Operation::Ln(x), false),
            Unary::Sin => (Operation::SinCos(x), false),
            Unary::Cos => (Operation::SinCos(x), true),
            Unary::Sinh => (Operation::SinhCosh(x), false),
            Unary::Cosh => (Operation::SinhCosh(x), true),
            Unary::Tan => (Operation::Tan(x), false),
            Unary::Tanh => (Operation::Tanh(x), false),
            Unary::Asin => (Operation::Asin(x), false),
            Unary::Acos => (Operation::Acos(x), false),
            Unary::Atan => (Operation::Atan(x), false),
        };
        let value = self.out.push(operation);
        Value(value.0 + usize::from(second))
    }

    fn ratio(&mut self, c: ExprId, denominator: NodeId) -> Value {
        let c = self.coefficient(c);
        let denominator = self.value(denominator);
        self.out.push(Operation::Ratio(c, denominator))
    }

    /// c x
    fn scaled(&mut self, node: NodeId, c: ExprId) -> Value {
        if self.pool.is_one(c) {
            return self.value(node);
        }
        if let Shape::Quotient {
            numerator: None,
            denominator,
        } = *self.graph.shape(node)
        {
            return self.ratio(c, denominator);
        }
        let c = self.coefficient(c);
        let x = self.value(node);
        self.out.push(Operation::Scale(c, x))
    }

    fn sum(&mut self, offset: Option<ExprId>, terms: &[Term]) -> Value {
        let (mut plus, mut minus) = (Vec::new(), Vec::new());
        // Without a positive term, one that is scaled anyway is scaled by the negative.
        let all_negative = terms.iter().all(|term| term.negative);
        let turned = terms
            .iter()
            .find(|term| all_negative && self.is_scaled(term))
            .copied();
        for &term in terms {
            if Some(term) == turned {
                plus.push(self.negated(term));
                continue;
            }
            let value = self.scaled(term.node, term.magnitude);
            if term.negative {
                minus.push(value)
            } else {
                plus.push(value)
            }
        }
        let offset = offset.map(|offset| self.coefficient(offset));
        let plus = self.balanced(plus, &|x, y| Operation::Add(x, y));
        let minus = self.balanced(minus, &|x, y| Operation::Add(x, y));
        match (plus, minus, offset) {
            (Some(x), None, None) => x,
            (Some(x), None, Some(c)) => self.out.push(Operation::Offset(c, x)),
            (Some(x), Some(y), None) => self.out.push(Operation::Sub(x, y)),
            (Some(x), Some(y), Some(c)) => {
                let difference = self.out.push(Operation::Sub(x, y));
                self.out.push(Operation::Offset(c, difference))
            }
            (None, Some(y), Some(c)) => {
                let c = self.out.push(Operation::Constant(c));
                self.out.push(Operation::Sub(c, y))
            }
            (None, Some(y), None) => self.out.push(Operation::Neg(y)),
            (None, None, _) => self.zero(),
        }
    }

    /// The fixed factor of a product.
    fn fixed_factor(&self, node: NodeId) -> Option<(NodeId, ExprId)> {
        let Shape::Product(factors) = self.graph.shape(node) else {
            return None;
        };
        factors
            .iter()
            .find_map(|(factor, exponent)| match self.graph.shape(*factor) {
                Shape::Fixed(e) if *exponent == 1 => Some((*factor, *e)),
                _ => None,
            })
    }

    /// Whether a term costs a scaling that can as well be one by the negative.
    fn is_scaled(&self, term: &Term) -> bool {
        !self.pool.is_one(term.magnitude) || self.fixed_factor(term.node).is_some()
    }

    /// −term, by scaling with the negative.
    fn negated(&mut self, term: Term) -> Value {
        if !self.pool.is_one(term.magnitude) {
            let scale = self.pool.neg(term.magnitude);
            return self.scaled(term.node, scale);
        }
        match (self.fixed_factor(term.node), self.graph.shape(term.node)) {
            (Some((fixed, e)), Shape::Product(factors)) => {
                let rest: Vec<_> = factors
                    .iter()
                    .filter(|(factor, _)| *factor != fixed)
                    .copied()
                    .collect();
                let scale = self.pool.neg(e);
                self.scaled_product(scale, &rest)
            }
            _ => unreachable!("a scaled term has a fixed factor"),
        }
    }

    fn product(&mut self, node: NodeId, factors: &[(NodeId, i32)]) -> Value {
        match self.fixed_factor(node) {
            Some((fixed, e)) if factors.len() > 1 => {
                let rest: Vec<_> = factors
                    .iter()
                    .filter(|(factor, _)| *factor != fixed)
                    .copied()
                    .collect();
                self.scaled_product(e, &rest)
            }
            _ => self.plain_product(factors),
        }
    }

    fn scaled_product(&mut self, scale: ExprId, factors: &[(NodeId, i32)]) -> Value {
        let x = self.plain_product(factors);
        let scale = self.coefficient(scale);
        self.out.push(Operation::Scale(scale, x))
    }

    fn plain_product(&mut self, factors: &[(NodeId, i32)]) -> Value {
        // (x y)² is cheaper than x² y².
        let common = factors
            .iter()
            .fold(0, |divisor, (_, exponent)| gcd(divisor, *exponent));
        let mut values = Vec::with_capacity(factors.len());
        for &(node, exponent) in factors {
            let x = self.value(node);
            values.push(self.power(x, exponent / common));
        }
        let base = self.balanced(values, &|x, y| {
            if x == y {
                Operation::Square(x)
            } else {
                Operation::Mul(x, y)
            }
        });
        let base = base.expect("a product has factors");
        self.power(base, common)
    }

    /// xᵏ, k ≥ 1, by squaring.
    fn power(&mut self, x: Value, exponent: i32) -> Value {
        if exponent == 1 {
            return x;
        }
        let half = self.power(x, exponent / 2);
        let even = self.out.push(Operation::Square(half));
        if exponent % 2 == 0 {
            even
        } else {
            self.commutative(even, x, &|x, y| Operation::Mul(x, y))
        }
    }

    fn commutative(
        &mut self,
        x: Value,
        y: Value,
        join: &dyn Fn(Value, Value) -> Operation,
    ) -> Value {
        self.out.push(join(x.min(y), x.max(y)))
    }

    /// Joins neighbours until one is left: the shortest chain of dependent operations.
    fn balanced(
        &mut self,
        mut values: Vec<Value>,
        join: &dyn Fn(Value, Value) -> Operation,
    ) -> Option<Value> {
        values.sort();
        while values.len() > 1 {
            let mut joined = Vec::with_capacity(values.len().div_ceil(2));
            for pair in values.chunks(2) {
                joined.push(match *pair {
                    [x, y] => self.commutative(x, y, join),
                    _ => pair[0],
                });
            }
            values = joined;
        }
        values.pop()
    }
}

fn gcd(a: i32, b: i32) -> i32 {
    if b == 0 { a } else { gcd(b, a % b) }
}
