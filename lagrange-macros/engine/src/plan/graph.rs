//! The n-ary form between expressions and operations: sums and products still whole, parameters already apart.
//!
//! Every expression that varies during a run is a [`Form`], scale · node, where the scale is fixed during a run.
//! Equal nodes have equal ids.

use crate::sorted::SortedMap;
use crate::symbolic::{ExprId, Rational};
use std::collections::HashMap;

/// A node of the graph.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub(super) struct NodeId(pub usize);

/// scale · node, or just the scale.
#[derive(Clone, Copy, Debug)]
pub(super) struct Form {
    /// Fixed during a run.
    pub scale: ExprId,
    /// Varies during a run.
    pub node: Option<NodeId>,
}

/// A function of one argument.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub(super) enum Unary {
    Sqrt,
    Exp,
    Ln,
    Sin,
    Cos,
    Sinh,
    Cosh,
    Tan,
    Tanh,
    Asin,
    Acos,
    Atan,
}

/// A term of a sum: ± magnitude · node.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub(super) struct Term {
    /// Varies.
    pub node: NodeId,
    /// Fixed, with its sign taken out.
    pub magnitude: ExprId,
    /// The sign.
    pub negative: bool,
}

/// What a node is.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub(super) enum Shape {
    /// Input i.
    Input(usize),
    /// A fixed number used as a node.
    Fixed(ExprId),
    /// offset + Σ terms; sorted by node.
    Sum {
        offset: Option<ExprId>,
        terms: Vec<Term>,
    },
    /// Π nodeᵏ; sorted; before [`Graph::split_quotients`] exponents may be negative, after it they are not.
    Product(Vec<(NodeId, i32)>),
    /// numerator / denominator
    Quotient {
        numerator: Option<NodeId>,
        denominator: NodeId,
    },
    /// nodeᶜ
    Powf(NodeId, Rational),
    /// f(node)
    Unary(Unary, NodeId),
    /// Angle of the point (x, y): (y, x).
    Atan2(NodeId, NodeId),
    /// First while the branch is on its `then` side, else second.
    Select(usize, NodeId, NodeId),
    /// Second if the first is ≥ 0, else third.
    Choose(NodeId, NodeId, NodeId),
}

impl Shape {
    /// The nodes that it reads.
    pub fn children(&self) -> Vec<NodeId> {
        match self {
            Shape::Input(_) | Shape::Fixed(_) => Vec::new(),
            Shape::Sum { terms, .. } => terms.iter().map(|term| term.node).collect(),
            Shape::Product(factors) => factors.iter().map(|(node, _)| *node).collect(),
            Shape::Quotient {
                numerator,
                denominator,
            } => numerator.iter().chain([denominator]).copied().collect(),
            Shape::Powf(x, _) | Shape::Unary(_, x) => vec![*x],
            Shape::Atan2(x, y) | Shape::Select(_, x, y) => vec![*x, *y],
            Shape::Choose(x, y, z) => vec![*x, *y, *z],
        }
    }
}

/// All nodes of a tape.
#[derive(Default)]
pub(super) struct Graph {
    shapes: Vec<Shape>,
    ids: HashMap<Shape, NodeId>,
}

impl Graph {
    /// The node of this shape.
    pub fn node(&mut self, shape: Shape) -> NodeId {
        if let Some(id) = self.ids.get(&shape) {
            return *id;
        }
        let id = NodeId(self.shapes.len());
        self.shapes.push(shape.clone());
        self.ids.insert(shape, id);
        id
    }

    /// The shape of a node.
    pub fn shape(&self, id: NodeId) -> &Shape {
        &self.shapes[id.0]
    }

    /// Gives a node another shape of the same value.
    pub fn reshape(&mut self, id: NodeId, shape: Shape) {
        self.shapes[id.0] = shape;
    }

    /// Π nodeᵏ; a single first power is the node itself.
    pub fn product(&mut self, factors: Vec<(NodeId, i32)>) -> NodeId {
        match factors[..] {
            [(node, 1)] => node,
            _ => self.node(Shape::Product(factors)),
        }
    }

    /// How often each node is read by the nodes that the roots reach, roots counted; 0 is unreachable.
    pub fn uses(&self, roots: &[NodeId]) -> Vec<usize> {
        let mut uses = vec![0; self.shapes.len()];
        let mut stack = roots.to_vec();
        while let Some(id) = stack.pop() {
            uses[id.0] += 1;
            if uses[id.0] == 1 {
                stack.extend(self.shape(id).children());
            }
        }
        uses
    }

    /// Negative powers of a product become one division; where several products have the same denominator, a
    /// multiplication by its reciprocal.
    pub fn split_quotients(&mut self, roots: &[NodeId]) {
        let uses = self.uses(roots);
        let mut quotients = Vec::new();
        let mut sharers: SortedMap<NodeId, usize> = SortedMap::new();
        for (index, uses) in uses.iter().enumerate() {
            let Shape::Product(factors) = &self.shapes[index] else {
                continue;
            };
            let (above, below): (Vec<_>, Vec<_>) =
                factors.iter().copied().partition(|(_, k)| *k > 0);
            if *uses > 0 && !below.is_empty() {
                let denominator =
                    self.product(below.into_iter().map(|(node, k)| (node, -k)).collect());
                *sharers.get_or_default(denominator) += 1;
                quotients.push((NodeId(index), above, denominator));
            }
        }
        for (id, mut above, denominator) in quotients {
            let shape = if sharers[&denominator] > 1 {
                let reciprocal = Shape::Quotient {
                    numerator: None,
                    denominator,
                };
                above.push((self.node(reciprocal), 1));
                above.sort();
                Shape::Product(above)
            } else {
                let numerator = (!above.is_empty()).then(|| self.product(above));
                Shape::Quotient {
                    numerator,
                    denominator,
                }
            };
            self.reshape(id, shape);
        }
    }
}
