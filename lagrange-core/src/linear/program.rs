//! A short tape made at run time: the products of mode-dependent factors (μk a, …) that fill the linear system.
//!
//! What depends on parameters only is folded into constants when the mode is set; the rest runs after the motion tape,
//! in the same arithmetic.

use crate::arithmetic::{Arithmetic, Derivative, Dual, Recorded, Recorder, Scalar, Value};
use crate::system::Place;

/// Arithmetics that sum many terms at once.
pub(crate) trait Sum: Arithmetic {
    /// Σ factor · nodes[node]
    fn sum(
        &mut self,
        to: usize,
        terms: &[(Self::Scalar, usize)],
        nodes: &[Self::Node],
    ) -> Self::Node;
}

impl<T: Scalar> Sum for Value<T> {
    #[inline(always)]
    fn sum(&mut self, _: usize, terms: &[(T, usize)], nodes: &[T]) -> T {
        terms
            .iter()
            .fold(T::zero(), |sum, &(factor, node)| sum + factor * nodes[node])
    }
}

impl<T: Scalar, const N: usize> Sum for Derivative<T, N> {
    fn sum(&mut self, _: usize, terms: &[(T, usize)], nodes: &[Dual<T, N>]) -> Dual<T, N> {
        let scaled = terms
            .iter()
            .map(|&(factor, node)| Dual::constant(factor) * nodes[node]);
        scaled.fold(Dual::default(), |sum, term| sum + term)
    }
}

impl<T: Scalar> Sum for Recorder<'_, T> {
    fn sum(&mut self, to: usize, terms: &[(T, usize)], nodes: &[Recorded]) -> Recorded {
        self.push_sum(
            to,
            terms.iter().map(|&(factor, node)| (factor, nodes[node])),
        )
    }
}

/// An operation; nodes are indices into the tape's outputs followed by the results of this program.
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

    /// Number of results.
    pub(crate) fn len(&self) -> usize {
        self.ops.len()
    }

    fn push(&mut self, op: Op) -> Place {
        self.ops.push(op);
        Place::Node(self.first + self.ops.len() - 1)
    }

    /// A new constant.
    pub(crate) fn constant(constants: &mut Vec<T>, value: T) -> Place {
        if value.is_zero() {
            return Place::Zero;
        }
        constants.push(value);
        Place::Constant(constants.len() - 1)
    }

    /// x y
    pub(crate) fn mul(&mut self, constants: &mut Vec<T>, x: Place, y: Place) -> Place {
        match (x, y) {
            (Place::Zero, _) | (_, Place::Zero) => Place::Zero,
            (Place::Constant(x), Place::Constant(y)) => {
                Self::constant(constants, constants[x] * constants[y])
            }
            (Place::Constant(constant), Place::Node(x))
            | (Place::Node(x), Place::Constant(constant)) => {
                if constants[constant].is_zero() {
                    Place::Zero
                } else if constants[constant] == T::one() {
                    Place::Node(x)
                } else {
                    self.push(Op::Scale { constant, x })
                }
            }
            (Place::Node(x), Place::Node(y)) => self.push(Op::Mul { x, y }),
        }
    }

    /// A number that is put into its node before the program runs: the node, and the operation that stands for it.
    pub(crate) fn given(&mut self) -> (usize, usize) {
        self.ops.push(Op::Given);
        (self.first + self.ops.len() - 1, self.ops.len() - 1)
    }

    /// c x
    pub(crate) fn scale(&mut self, constants: &mut Vec<T>, c: T, x: Place) -> Place {
        let c = Self::constant(constants, c);
        self.mul(constants, c, x)
    }

    /// x + y
    pub(crate) fn add(&mut self, constants: &mut Vec<T>, x: Place, y: Place) -> Place {
        match (x, y) {
            (Place::Zero, z) | (z, Place::Zero) => z,
            (Place::Constant(x), Place::Constant(y)) => {
                Self::constant(constants, constants[x] + constants[y])
            }
            (Place::Constant(constant), Place::Node(x))
            | (Place::Node(x), Place::Constant(constant)) => self.push(Op::Offset { constant, x }),
            (Place::Node(x), Place::Node(y)) => self.push(Op::Add { x, y }),
        }
    }

    /// 1 / √x; of a zero, zero.
    pub(crate) fn inverse_root(&mut self, constants: &mut Vec<T>, x: Place) -> Place {
        match x {
            Place::Zero => Place::Zero,
            Place::Constant(x) => Self::constant(constants, T::one() / constants[x].sqrt()),
            Place::Node(x) => {
                constants.push(T::one());
                self.push(Op::Sqrt { x });
                self.push(Op::Ratio {
                    constant: constants.len() - 1,
                    x: self.first + self.ops.len() - 1,
                })
            }
        }
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
            _ => {
                self.ops.push(Op::Sum { first, end });
                Some(self.first + self.ops.len() - 1)
            }
        }
    }

    /// Runs it; `nodes` begins with the tape's outputs. Result `i` writes slot `i` of the arithmetic's origin.
    #[inline]
    pub(crate) fn run<A: Sum<Scalar = T>>(
        &self,
        a: &mut A,
        constants: &[T],
        nodes: &mut [A::Node],
    ) {
        for (to, op) in self.ops.iter().enumerate() {
            nodes[self.first + to] = match *op {
                Op::Scale { constant, x } => a.scale(to, constants[constant], nodes[x]),
                Op::Offset { constant, x } => a.offset(to, constants[constant], nodes[x]),
                Op::Add { x, y } => a.add(to, nodes[x], nodes[y]),
                Op::Mul { x, y } if x == y => a.square(to, nodes[x]),
                Op::Mul { x, y } => a.mul(to, nodes[x], nodes[y]),
                Op::Sqrt { x } => a.sqrt(to, nodes[x]),
                Op::Sum { first, end } => a.sum(to, &self.terms[first..end], nodes),
                Op::Ratio { constant, x } => a.ratio(to, constants[constant], nodes[x]),
                Op::Given => continue,
            };
        }
    }
}
