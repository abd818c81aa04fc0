//! The products of mode-dependent factors (μk a, …) that fill the linear system.
//!
//! What depends on parameters only is folded into constants when the mode is set; the rest runs after the motion program.

use crate::arithmetic::Scalar;
use crate::program::{Builder, Op as Run, Register};
use crate::system::ValueRef;

/// An operation; nodes are indices into the outputs of the motion program followed by the results of this one.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Op {
    Scale {
        constant: usize,
        x: usize,
    },
    Offset {
        constant: usize,
        x: usize,
    },
    Add {
        x: usize,
        y: usize,
    },
    Mul {
        x: usize,
        y: usize,
    },
    Sqrt {
        x: usize,
    },
    Ratio {
        constant: usize,
        x: usize,
    },
    Sum {
        first: usize,
        end: usize,
    },
    /// What is in the node already.
    Given,
}

/// Operations in order; the result of operation `i` is node `first + i`.
#[derive(Clone, Debug, Default)]
pub(crate) struct Program<T> {
    ops: Vec<Op>,
    /// (factor, node) of the sums.
    terms: Vec<(T, usize)>,
    /// Where the terms of the sum under construction begin.
    open: usize,
    first: usize,
}

impl<T: Scalar> Program<T> {
    /// Forgets all operations; results are numbered from `first` on.
    pub(crate) fn restart(&mut self, first: usize) {
        self.ops.clear();
        self.terms.clear();
        self.first = first;
    }

    /// Its own numbers; the others are among the constants.
    pub(crate) fn numbers(&self) -> impl Iterator<Item = T> + '_ {
        self.terms.iter().map(|&(factor, _)| factor)
    }

    /// Whether it has the same operations as another, with other numbers perhaps.
    pub(crate) fn is_like(&self, other: &Self) -> bool {
        let mut terms = self.terms.iter().zip(&other.terms);
        self.ops == other.ops
            && self.terms.len() == other.terms.len()
            && terms.all(|(x, y)| x.1 == y.1)
    }

    /// Appends an operation; the node of its result.
    fn push(&mut self, op: Op) -> usize {
        self.ops.push(op);
        self.first + self.ops.len() - 1
    }

    /// Begins Σ factor · node.
    pub(crate) fn begin_sum(&mut self) {
        self.open = self.terms.len();
    }

    /// Adds a term to it.
    pub(crate) fn add_term(&mut self, factor: T, node: usize) {
        if !factor.is_zero() {
            self.terms.push((factor, node));
        }
    }

    /// The node of the sum; none if it has no terms.
    pub(crate) fn end_sum(&mut self) -> Option<usize> {
        let (first, end) = (self.open, self.terms.len());
        match self.terms[first..] {
            [] => None,
            [(one, node)] if one == T::one() => {
                self.terms.truncate(first);
                Some(node)
            }
            _ => Some(self.push(Op::Sum { first, end })),
        }
    }

    /// Appends it to a program. `nodes` begins with the outputs of the motion program and takes the results; constants and
    /// factors are in registers from these numbers on.
    pub(crate) fn load(
        &self,
        builder: &mut Builder,
        constants: usize,
        factors: usize,
        nodes: &mut Vec<Register>,
    ) {
        let constant = |index: usize| Register::new(constants + index);
        for op in &self.ops {
            let result = match *op {
                Op::Scale { constant: c, x } => builder.push(Run::Scale, constant(c), nodes[x]),
                Op::Offset { constant: c, x } => builder.push(Run::Add, constant(c), nodes[x]),
                Op::Add { x, y } => builder.push(Run::Add, nodes[x], nodes[y]),
                Op::Mul { x, y } if x == y => builder.push(Run::Square, nodes[x], Register::ZERO),
                Op::Mul { x, y } => builder.push(Run::Mul, nodes[x], nodes[y]),
                Op::Sqrt { x } => builder.push(Run::Sqrt, nodes[x], Register::ZERO),
                Op::Ratio { constant: c, x } => builder.push(Run::Div, constant(c), nodes[x]),
                Op::Sum { first, end } => {
                    let terms = self.terms[first..end].iter().zip(factors + first..);
                    builder
                        .sum(terms.map(|(&(_, node), factor)| (Register::new(factor), nodes[node])))
                }
                Op::Given => builder.fresh(),
            };
            nodes.push(result);
        }
    }
}

/// Writes a program: what can be done with constants is done at once, and gives another constant.
pub(crate) struct ProgramWriter<'a, T> {
    pub(crate) program: &'a mut Program<T>,
    pub(crate) constants: &'a mut Vec<T>,
}

impl<T: Scalar> ProgramWriter<'_, T> {
    /// A new constant.
    pub(crate) fn constant(&mut self, value: T) -> ValueRef {
        if value.is_zero() {
            return ValueRef::Zero;
        }
        self.constants.push(value);
        ValueRef::Constant(self.constants.len() - 1)
    }

    /// x y
    pub(crate) fn mul(&mut self, x: ValueRef, y: ValueRef) -> ValueRef {
        match (x, y) {
            (ValueRef::Zero, _) | (_, ValueRef::Zero) => ValueRef::Zero,
            (ValueRef::Constant(x), ValueRef::Constant(y)) => {
                self.constant(self.constants[x] * self.constants[y])
            }
            (ValueRef::Constant(constant), ValueRef::Node(x))
            | (ValueRef::Node(x), ValueRef::Constant(constant)) => {
                if self.constants[constant].is_zero() {
                    ValueRef::Zero
                } else if self.constants[constant] == T::one() {
                    ValueRef::Node(x)
                } else {
                    ValueRef::Node(self.program.push(Op::Scale { constant, x }))
                }
            }
            (ValueRef::Node(x), ValueRef::Node(y)) => {
                ValueRef::Node(self.program.push(Op::Mul { x, y }))
            }
        }
    }

    /// A number that is put into its node before the program runs: the node.
    pub(crate) fn given(&mut self) -> usize {
        self.program.push(Op::Given)
    }

    /// c x
    pub(crate) fn scale(&mut self, c: T, x: ValueRef) -> ValueRef {
        let c = self.constant(c);
        self.mul(c, x)
    }

    /// x + y
    pub(crate) fn add(&mut self, x: ValueRef, y: ValueRef) -> ValueRef {
        match (x, y) {
            (ValueRef::Zero, z) | (z, ValueRef::Zero) => z,
            (ValueRef::Constant(x), ValueRef::Constant(y)) => {
                self.constant(self.constants[x] + self.constants[y])
            }
            (ValueRef::Constant(constant), ValueRef::Node(x))
            | (ValueRef::Node(x), ValueRef::Constant(constant)) => {
                ValueRef::Node(self.program.push(Op::Offset { constant, x }))
            }
            (ValueRef::Node(x), ValueRef::Node(y)) => {
                ValueRef::Node(self.program.push(Op::Add { x, y }))
            }
        }
    }

    /// 1 / √x; of a zero, zero.
    pub(crate) fn inverse_root(&mut self, x: ValueRef) -> ValueRef {
        match x {
            ValueRef::Zero => ValueRef::Zero,
            ValueRef::Constant(x) => self.constant(T::one() / self.constants[x].sqrt()),
            ValueRef::Node(x) => {
                self.constants.push(T::one());
                let constant = self.constants.len() - 1;
                let x = self.program.push(Op::Sqrt { x });
                ValueRef::Node(self.program.push(Op::Ratio { constant, x }))
            }
        }
    }
}
