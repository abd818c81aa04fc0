//! Expressions → n-ary forms: what is fixed during a run is separated from what varies.
//!
//! A product m l² sin θ θ̇² becomes the fixed scale m l² and the node sin θ · θ̇²; a sum takes a common fixed
//! factor out when that saves an operation. The fixed parts stay expressions of the pool: the constants
//! program computes them.

mod sums;

use super::graph::{Form, Graph, NodeId, Shape, Term, Unary};
use crate::sorted::SortedMap;
use crate::symbolic::{ExprId, Function, Node, Pool, Rational, Symbol};
use std::collections::HashMap;

/// What counts as fixed.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Fixed {
    /// Whatever contains no input and no branch.
    Parameters,
    /// Exact numbers only.
    Numbers,
}

/// Turns expressions into forms.
pub(super) struct Former<'a> {
    pool: &'a mut Pool,
    inputs: &'a SortedMap<Symbol, usize>,
    fixed: Fixed,
    /// Guards of the branches, where no branch is held (in starts).
    guards: Option<&'a [ExprId]>,
    graph: Graph,
    forms: HashMap<ExprId, Form>,
    varies: HashMap<ExprId, bool>,
}

impl<'a> Former<'a> {
    /// With the inputs by symbol.
    pub fn new(
        pool: &'a mut Pool,
        inputs: &'a SortedMap<Symbol, usize>,
        fixed: Fixed,
        guards: Option<&'a [ExprId]>,
    ) -> Former<'a> {
        let (graph, forms, varies) = (Graph::default(), HashMap::new(), HashMap::new());
        Former {
            pool,
            inputs,
            fixed,
            guards,
            graph,
            forms,
            varies,
        }
    }

    /// The nodes made, for the next pass.
    pub fn into_graph(self) -> Graph {
        self.graph
    }

    /// The expression as a form.
    pub fn form(&mut self, e: ExprId) -> Form {
        if let Some(form) = self.forms.get(&e) {
            return *form;
        }
        let form = if self.varies(e) {
            self.varying(e)
        } else {
            Form {
                scale: e,
                node: None,
            }
        };
        self.forms.insert(e, form);
        form
    }

    /// The number 0 as a node.
    pub fn zero(&mut self) -> NodeId {
        let zero = self.pool.integer(0);
        self.fixed(zero)
    }

    /// A fixed number as a node.
    pub fn fixed(&mut self, e: ExprId) -> NodeId {
        self.graph.node(Shape::Fixed(e))
    }

    /// start + form as a node; the start is not folded into the form's own numbers.
    pub fn offset(&mut self, start: ExprId, form: Form) -> NodeId {
        let (negative, node) = self.signed_node(form);
        let magnitude = self.pool.integer(1);
        self.graph.node(Shape::Sum {
            offset: Some(start),
            terms: vec![Term {
                node,
                magnitude,
                negative,
            }],
        })
    }

    /// The form as one node.
    pub fn node(&mut self, form: Form) -> NodeId {
        let Some(node) = form.node else {
            return self.fixed(form.scale);
        };
        if self.pool.is_one(form.scale) {
            return node;
        }
        let (negative, magnitude) = self.magnitude(form.scale);
        self.graph.node(Shape::Sum {
            offset: None,
            terms: vec![Term {
                node,
                magnitude,
                negative,
            }],
        })
    }

    /// The form as a sign and one node, for whoever can subtract.
    pub fn signed_node(&mut self, form: Form) -> (bool, NodeId) {
        if form.node.is_none() {
            return (false, self.node(form));
        }
        let (negative, scale) = self.magnitude(form.scale);
        (
            negative,
            self.node(Form {
                scale,
                node: form.node,
            }),
        )
    }

    /// Whether the expression changes during a run.
    pub fn varies(&mut self, e: ExprId) -> bool {
        if let Some(known) = self.varies.get(&e) {
            return *known;
        }
        let varies = match (self.pool.node(e).clone(), self.fixed) {
            (Node::Number(_), _) => false,
            (_, Fixed::Numbers) | (Node::Select { .. }, _) => true,
            (Node::Pi, _) => false,
            (Node::Symbol(symbol), _) => self.inputs.contains_key(&symbol),
            (Node::Sum { terms, .. }, _) => terms.iter().any(|(term, _)| self.varies(*term)),
            (Node::Product(factors), _) => factors.iter().any(|(base, _)| self.varies(*base)),
            (Node::Power(base, exponent), _) => self.varies(base) || self.varies(exponent),
            (Node::Group(inner), _) => self.varies(inner),
            (Node::Call(_, arguments), _) => {
                arguments.iter().any(|argument| self.varies(*argument))
            }
        };
        self.varies.insert(e, varies);
        varies
    }

    fn varying(&mut self, e: ExprId) -> Form {
        let node = match self.pool.node(e).clone() {
            Node::Number(_) | Node::Pi => self.fixed(e),
            Node::Symbol(symbol) => match self.inputs.get(&symbol) {
                Some(input) => self.graph.node(Shape::Input(*input)),
                None => panic!("`{}` is not an input of this stage", self.pool.name(symbol)),
            },
            Node::Sum { constant, terms } => return self.sum(constant, &terms),
            Node::Product(factors) => return self.product(&factors),
            Node::Power(base, exponent) => {
                let ln = self.pool.call(Function::Ln, &[base]);
                let power = self.pool.mul(exponent, ln);
                let power = self.form(power);
                let power = self.node(power);
                self.graph.node(Shape::Unary(Unary::Exp, power))
            }
            Node::Call(function, arguments) => {
                let mut nodes = Vec::with_capacity(arguments.len());
                for argument in arguments {
                    let form = self.form(argument);
                    nodes.push(self.node(form));
                }
                self.graph.node(call(function, &nodes))
            }
            Node::Group(inner) => {
                let form = self.form(inner);
                // A scaled product is wanted as such; the scale of a sum may join those around it.
                match self.pool.node(inner) {
                    Node::Sum { constant, terms } if terms.len() > 1 || !constant.is_zero() => {
                        return form;
                    }
                    _ => self.node(form),
                }
            }
            Node::Select {
                branch,
                then,
                otherwise,
            } => {
                let (then, otherwise) = (self.form(then), self.form(otherwise));
                let (then, otherwise) = (self.node(then), self.node(otherwise));
                match self.guards {
                    Some(guards) => {
                        let guard = self.form(guards[branch]);
                        let guard = self.node(guard);
                        self.graph.node(Shape::Choose(guard, then, otherwise))
                    }
                    None => self.graph.node(Shape::Select(branch, then, otherwise)),
                }
            }
        };
        Form {
            scale: self.pool.integer(1),
            node: Some(node),
        }
    }

    fn product(&mut self, factors: &[(ExprId, Rational)]) -> Form {
        let mut scales = Vec::new();
        let mut powers: SortedMap<NodeId, i32> = SortedMap::new();
        for &(base, exponent) in factors {
            if !self.varies(base) && (self.fixed == Fixed::Parameters || exponent.is_integer()) {
                scales.push(self.power(base, exponent));
                continue;
            }
            let form = self.form(base);
            let half = exponent.denominator() == 2;
            if !half && !exponent.is_integer() {
                let base = self.node(form);
                let power = self.graph.node(Shape::Powf(base, exponent));
                *powers.get_or_default(power) += 1;
                continue;
            }
            // x^(k/2) is x^trunc(k/2) · √x^±1; the integer part alone may take the scale apart.
            let whole = (exponent.numerator() / exponent.denominator()) as i32;
            let form = if half {
                let base = self.node(form);
                let root = self.graph.node(Shape::Unary(Unary::Sqrt, base));
                *powers.get_or_default(root) += exponent.numerator().signum() as i32;
                Form {
                    scale: self.pool.integer(1),
                    node: Some(base),
                }
            } else {
                form
            };
            if whole != 0 {
                scales.push(self.power(form.scale, Rational::integer(i64::from(whole))));
                self.multiply(&mut powers, form.node, whole);
            }
        }
        powers.retain(|_, exponent| *exponent != 0);
        let scale = self.pool.product(&scales);
        let node = (!powers.is_empty()).then(|| self.graph.product(powers.into_iter().collect()));
        Form { scale, node }
    }

    /// Multiplies nodeᵏ into the powers; a product enters factor by factor.
    fn multiply(
        &mut self,
        powers: &mut SortedMap<NodeId, i32>,
        node: Option<NodeId>,
        exponent: i32,
    ) {
        let Some(node) = node else { return };
        match self.graph.shape(node) {
            Shape::Product(factors) => {
                for (factor, k) in factors {
                    *powers.get_or_default(*factor) += k * exponent;
                }
            }
            _ => *powers.get_or_default(node) += exponent,
        }
    }

    fn magnitude(&mut self, e: ExprId) -> (bool, ExprId) {
        magnitude(self.pool, e)
    }

    fn power(&mut self, base: ExprId, exponent: Rational) -> ExprId {
        let exponent = self.pool.number(exponent);
        self.pool.pow(base, exponent).expect("a factor is not zero")
    }
}

/// Sign and magnitude of a fixed expression; the sign of a longer sum is that of its first term.
pub(super) fn magnitude(pool: &mut Pool, e: ExprId) -> (bool, ExprId) {
    let negative = match pool.node(e) {
        Node::Number(number) => number.is_negative(),
        Node::Sum { terms, .. } => terms
            .first()
            .is_some_and(|(_, coefficient)| coefficient.is_negative()),
        _ => false,
    };
    (negative, if negative { pool.neg(e) } else { e })
}

fn call(function: Function, arguments: &[NodeId]) -> Shape {
    let unary = match function {
        Function::Sin => Unary::Sin,
        Function::Cos => Unary::Cos,
        Function::Tan => Unary::Tan,
        Function::Asin => Unary::Asin,
        Function::Acos => Unary::Acos,
        Function::Atan => Unary::Atan,
        Function::Atan2 => return Shape::Atan2(arguments[0], arguments[1]),
        Function::Sinh => Unary::Sinh,
        Function::Cosh => Unary::Cosh,
        Function::Tanh => Unary::Tanh,
        Function::Exp => Unary::Exp,
        Function::Ln => Unary::Ln,
    };
    Shape::Unary(unary, arguments[0])
}
