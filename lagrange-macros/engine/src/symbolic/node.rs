//! The forms that an expression can have.

use super::Rational;

/// An expression of a pool.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct ExprId(pub(crate) u32);

impl ExprId {
    /// Position in the pool; ascending positions are a topological order.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// A leaf symbol of a pool.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Symbol(pub(crate) u32);

impl Symbol {
    /// Number of the symbol, in order of creation.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// A function of the language (piecewise ones are [`Node::Select`]).
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[allow(missing_docs)]
pub enum Function {
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    Atan2,
    Sinh,
    Cosh,
    Tanh,
    Exp,
    Ln,
}

impl Function {
    /// Name in the language.
    pub fn name(self) -> &'static str {
        match self {
            Function::Sin => "sin",
            Function::Cos => "cos",
            Function::Tan => "tan",
            Function::Asin => "asin",
            Function::Acos => "acos",
            Function::Atan => "atan",
            Function::Atan2 => "atan2",
            Function::Sinh => "sinh",
            Function::Cosh => "cosh",
            Function::Tanh => "tanh",
            Function::Exp => "exp",
            Function::Ln => "ln",
        }
    }

    /// The function of a name of the language.
    pub fn from_name(name: &str) -> Option<Function> {
        Some(match name {
            "sin" => Function::Sin,
            "cos" => Function::Cos,
            "tan" => Function::Tan,
            "asin" => Function::Asin,
            "acos" => Function::Acos,
            "atan" => Function::Atan,
            "atan2" => Function::Atan2,
            "sinh" => Function::Sinh,
            "cosh" => Function::Cosh,
            "tanh" => Function::Tanh,
            "exp" => Function::Exp,
            "ln" => Function::Ln,
            _ => return None,
        })
    }

    /// Number of arguments.
    pub fn arity(self) -> usize {
        if self == Function::Atan2 { 2 } else { 1 }
    }
}

/// The form of an expression.
#[derive(Clone, PartialEq, Eq, Hash, Debug)]
pub enum Node {
    /// An exact number.
    Number(Rational),
    /// π
    Pi,
    /// A leaf.
    Symbol(Symbol),
    /// constant + Σ cᵢ termᵢ; terms are sorted, distinct, without numeric factor, and no sums.
    Sum {
        /// The number.
        constant: Rational,
        /// (termᵢ, cᵢ ≠ 0)
        terms: Vec<(ExprId, Rational)>,
    },
    /// The coefficient is outside (in the sum); Π baseᵢ^exponentᵢ with rational exponents ≠ 0; sorted, distinct
    /// bases. A numeric base is a prime (or a cofactor without small primes) with an exponent between 0 and 1.
    Product(Vec<(ExprId, Rational)>),
    /// base^exponent with an exponent that is not a number.
    Power(ExprId, ExprId),
    /// f(arguments)
    Call(Function, Vec<ExprId>),
    /// A part that is computed as a whole: its value is that of the expression, but sums and products around it do not
    /// take it apart. See [`super::Pool::group`].
    Group(ExprId),
    /// Branch `branch` on its `then` side: first, else second.
    Select {
        /// Number of the branch.
        branch: usize,
        /// Value on the `then` side.
        then: ExprId,
        /// Value on the other side.
        otherwise: ExprId,
    },
}

impl Node {
    /// Calls `visit` with each direct sub-expression, in order.
    pub fn for_each_child(&self, mut visit: impl FnMut(ExprId)) {
        match self {
            Node::Number(_) | Node::Pi | Node::Symbol(_) => {}
            Node::Sum { terms: list, .. } | Node::Product(list) => {
                for &(e, _) in list {
                    visit(e);
                }
            }
            Node::Power(base, exponent) => {
                visit(*base);
                visit(*exponent);
            }
            Node::Call(_, arguments) => {
                for &e in arguments {
                    visit(e);
                }
            }
            Node::Group(e) => visit(*e),
            Node::Select {
                then, otherwise, ..
            } => {
                visit(*then);
                visit(*otherwise);
            }
        }
    }
}
