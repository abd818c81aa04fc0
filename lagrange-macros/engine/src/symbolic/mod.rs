//! A hash-consed pool of expressions: build, differentiate, simplify, evaluate, print. Std only.
//!
//! Building is canonical: sums and products are flat, sorted, with like terms collected and numbers folded
//! exactly, so equal forms have equal ids. sin²u + cos²u = 1 is applied by sums.

/// An expression of a pool.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct ExprId(pub(crate) u32);

/// A leaf symbol of a pool.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Symbol(pub(crate) u32);

/// An exact number p/q in lowest terms, q > 0.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Rational {
    numerator: i128,
    denominator: i128,
}

/// A function of the language (piecewise ones are [`Node::Select`]).
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[allow(missing_docs)]
pub enum Function {
    Sin, Cos, Tan, Asin, Acos, Atan, Atan2, Sinh, Cosh, Tanh, Exp, Ln,
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
    /// constant + Σ cᵢ termᵢ; terms are sorted, distinct, without numeric factor.
    Sum { constant: Rational, terms: Vec<(ExprId, Rational)> },
    /// coefficient is outside (in the sum); Π baseᵢ^exponentᵢ with rational exponents; sorted, distinct bases.
    Product(Vec<(ExprId, Rational)>),
    /// base^exponent with an exponent that is not a number.
    Power(ExprId, ExprId),
    /// f(arguments)
    Call(Function, Vec<ExprId>),
    /// Branch `branch` on its `then` side: first, else second.
    Select { branch: usize, then: ExprId, otherwise: ExprId },
}

/// All expressions of a system.
pub struct Pool {}

impl Pool {
    /// An empty pool.
    pub fn new() -> Pool { todo!() }
    /// A new symbol; names are for printing, two symbols may share one.
    pub fn symbol(&mut self, name: &str) -> Symbol { todo!() }
    /// Name of a symbol.
    pub fn name(&self, symbol: Symbol) -> &str { todo!() }
    /// The expression that is just this symbol.
    pub fn leaf(&mut self, symbol: Symbol) -> ExprId { todo!() }
    /// An integer.
    pub fn integer(&mut self, n: i64) -> ExprId { todo!() }
    /// An exact number.
    pub fn number(&mut self, n: Rational) -> ExprId { todo!() }
    /// π
    pub fn pi(&mut self) -> ExprId { todo!() }
    /// The form of an expression.
    pub fn node(&self, e: ExprId) -> &Node { todo!() }
    /// Σ
    pub fn sum(&mut self, terms: &[ExprId]) -> ExprId { todo!() }
    /// Π
    pub fn product(&mut self, factors: &[ExprId]) -> ExprId { todo!() }
    /// a + b
    pub fn add(&mut self, a: ExprId, b: ExprId) -> ExprId { todo!() }
    /// a − b
    pub fn sub(&mut self, a: ExprId, b: ExprId) -> ExprId { todo!() }
    /// −a
    pub fn neg(&mut self, a: ExprId) -> ExprId { todo!() }
    /// a b
    pub fn mul(&mut self, a: ExprId, b: ExprId) -> ExprId { todo!() }
    /// a / b; None if b is the number 0.
    pub fn div(&mut self, a: ExprId, b: ExprId) -> Option<ExprId> { todo!() }
    /// c a
    pub fn scale(&mut self, a: ExprId, c: Rational) -> ExprId { todo!() }
    /// base^exponent; None for 0 to a negative power.
    pub fn pow(&mut self, base: ExprId, exponent: ExprId) -> Option<ExprId> { todo!() }
    /// f(arguments)
    pub fn call(&mut self, f: Function, arguments: &[ExprId]) -> ExprId { todo!() }
    /// √a = a^(1/2)
    pub fn sqrt(&mut self, a: ExprId) -> ExprId { todo!() }
    /// Selection on a branch (equal sides: that side).
    pub fn select(&mut self, branch: usize, then: ExprId, otherwise: ExprId) -> ExprId { todo!() }
    /// Whether it is the number 0.
    pub fn is_zero(&self, e: ExprId) -> bool { todo!() }
    /// ∂e/∂symbol.
    pub fn differentiate(&mut self, e: ExprId, symbol: Symbol) -> ExprId { todo!() }
    /// Σ ∂e/∂sᵢ · directionᵢ: with (q, v), (v, a), (t, 1) the total time derivative. One pass over the pool.
    pub fn derivative_along(&mut self, e: ExprId, direction: &[(Symbol, ExprId)]) -> ExprId { todo!() }
    /// e with symbols replaced.
    pub fn substitute(&mut self, e: ExprId, replacement: &[(Symbol, ExprId)]) -> ExprId { todo!() }
    /// Whether the symbol occurs.
    pub fn depends_on(&self, e: ExprId, symbol: Symbol) -> bool { todo!() }
    /// All symbols that occur, ascending.
    pub fn symbols(&self, e: ExprId) -> Vec<Symbol> { todo!() }
    /// All branches that occur, ascending.
    pub fn branches(&self, e: ExprId) -> Vec<usize> { todo!() }
    /// Products over sums multiplied out (within a term budget, else unchanged).
    pub fn expand(&mut self, e: ExprId) -> ExprId { todo!() }
    /// The cheapest of the forms tried (as is, expanded with sin² + cos² = 1, common factors taken out).
    pub fn simplify(&mut self, e: ExprId) -> ExprId { todo!() }
    /// Number of operations of the expression as a graph.
    pub fn operations(&self, e: &[ExprId]) -> usize { todo!() }
    /// Value at given symbol values (by symbol index) and branches.
    pub fn evaluate(&self, e: &[ExprId], symbols: &dyn Fn(Symbol) -> f64, then: &dyn Fn(usize) -> bool) -> Vec<f64> { todo!() }
    /// Plain text, parseable by the language.
    pub fn print(&self, e: ExprId) -> String { todo!() }
    /// Whether an exact number overflowed on the way (then forms are unreliable; reported as an error).
    pub fn overflowed(&self) -> bool { todo!() }
    /// Number of nodes.
    pub fn len(&self) -> usize { todo!() }
}
