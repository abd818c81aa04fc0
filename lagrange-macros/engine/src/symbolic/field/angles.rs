//! Arguments of circular functions and exponentials as sums of basis terms: Σ cᵢ tᵢ.

use super::super::{ExprId, Function, Node, Pool, Rational, Symbol};
use crate::sorted::{SortedMap, SortedSet};

/// How the arguments of circular functions and exponentials are made of basis terms.
#[derive(Clone, Default, Debug)]
pub struct Angles {
    /// D: every coefficient times D is an integer; None if D does not fit.
    pub(super) denominator: Option<i128>,
    /// Argument → multiplied out.
    pub(super) arguments: SortedMap<ExprId, ExprId>,
    /// Whether all basis terms are products of free symbols.
    pub(super) independent: bool,
    /// Those that are.
    pub(super) plain: SortedSet<ExprId>,
}

impl Angles {
    /// Whether all basis terms are products of free symbols. Different ones are then linearly independent, and so
    /// functions of them are independent (Ax, Annals of Mathematics 93, 1971).
    pub fn are_independent(&self) -> bool {
        self.independent
    }
}

/// Longer common denominators make degrees that prove little.
const LARGEST_DENOMINATOR: i128 = 1 << 40;

impl Pool {
    /// The basis for all arguments in the expressions. `dependent`: symbols that will be bound to what depends on others.
    pub fn angles(&mut self, roots: &[ExprId], dependent: &[Symbol]) -> Angles {
        let mut angles = Angles {
            denominator: Some(1),
            arguments: SortedMap::new(),
            independent: true,
            plain: SortedSet::new(),
        };
        for e in self.iter_reachable(roots) {
            if let Node::Call(f, arguments) = self.node(e)
                && is_additive(*f)
            {
                let argument = arguments[0];
                let expanded = self.expand(argument);
                angles.arguments.insert(argument, expanded);
                let (constant, terms) = self.affine(expanded);
                let coefficients = terms.iter().map(|&(_, c)| c).chain([constant]);
                for c in coefficients {
                    angles.denominator = angles.denominator.and_then(|d| common(d, c));
                }
                for (term, _) in terms {
                    if self.is_plain(term, dependent) {
                        angles.plain.insert(term);
                    } else {
                        angles.independent = false;
                    }
                }
            }
        }
        angles
    }

    /// Whether it is a product of whole powers of free symbols.
    fn is_plain(&self, term: ExprId, dependent: &[Symbol]) -> bool {
        let is_free = |e: ExprId| match self.node(e) {
            Node::Symbol(symbol) => !dependent.contains(symbol),
            Node::Pi => true,
            _ => false,
        };
        match self.node(term) {
            Node::Product(factors) => factors
                .iter()
                .all(|&(base, r)| r.is_integer() && is_free(base)),
            _ => is_free(term),
        }
    }

    /// Degree of a function of the argument in the atoms: 2 Σ |cᵢ| D.
    pub(super) fn turns(&self, argument: ExprId, angles: &Angles) -> f64 {
        let expanded = angles.arguments.get(&argument).copied();
        let Some(expanded) = expanded else {
            return 2.0;
        };
        let (constant, terms) = self.affine(expanded);
        let sizes = terms.iter().map(|&(_, c)| c).chain([constant]);
        let sum: f64 = sizes.map(|c| c.to_f64().abs()).sum();
        2.0 * sum * angles.denominator.unwrap_or(i128::MAX) as f64
    }

    /// constant + Σ cᵢ tᵢ
    pub(super) fn affine(&self, e: ExprId) -> (Rational, Vec<(ExprId, Rational)>) {
        match self.node(e) {
            Node::Number(n) => (*n, Vec::new()),
            Node::Sum { constant, terms } => (*constant, terms.clone()),
            _ => (Rational::ZERO, vec![(e, Rational::ONE)]),
        }
    }
}

/// Functions of a sum that are made of functions of its terms.
pub(super) fn is_additive(f: Function) -> bool {
    matches!(
        f,
        Function::Sin
            | Function::Cos
            | Function::Tan
            | Function::Sinh
            | Function::Cosh
            | Function::Tanh
            | Function::Exp
    )
}

/// Least common multiple of d and the denominator of c.
fn common(d: i128, c: Rational) -> Option<i128> {
    let shared = Rational::new(d, c.denominator())?.denominator();
    d.checked_mul(shared).filter(|&d| d <= LARGEST_DENOMINATOR)
}
