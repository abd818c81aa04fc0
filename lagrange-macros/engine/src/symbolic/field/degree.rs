//! Upper bounds of degrees: how improbable it is that what is not zero vanishes at a random point.
//!
//! A value of degree d in random elements, and in points of the circle counted twice (a polynomial of degree d has at
//! most 2 d zeros on a conic), vanishes with probability ≤ d/p unless it is zero everywhere.

use super::super::{ExprId, Node, Pool, Symbol};
use super::Angles;

/// Degrees of numerator and denominator.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Degree {
    /// Of the numerator.
    pub above: f64,
    /// Of the denominator.
    pub below: f64,
}

impl Degree {
    /// Of a number.
    pub const NUMBER: Degree = Degree::polynomial(0.0);

    /// Of a polynomial.
    pub const fn polynomial(degree: f64) -> Degree {
        Degree {
            above: degree,
            below: 0.0,
        }
    }

    /// Of a sum over the product of all denominators.
    pub fn of_sum(terms: &[Degree]) -> Degree {
        let below: f64 = terms.iter().map(|term| term.below).sum();
        let above = terms.iter().map(|term| term.above + below - term.below);
        Degree {
            above: above.fold(0.0, f64::max),
            below,
        }
    }

    /// Of a product.
    #[must_use]
    pub fn times(self, other: Degree) -> Degree {
        Degree {
            above: self.above + other.above,
            below: self.below + other.below,
        }
    }

    /// Of a power; a root w with w² = u counts as u.
    #[must_use]
    pub fn power(self, exponent: f64) -> Degree {
        let size = exponent.abs().ceil();
        if exponent < 0.0 {
            Degree {
                above: self.below * size,
                below: self.above * size,
            }
        } else {
            Degree {
                above: self.above * size,
                below: self.below * size,
            }
        }
    }
}

impl Pool {
    /// Degrees of expressions, given those of the symbols.
    pub fn degrees(
        &self,
        e: &[ExprId],
        angles: &Angles,
        symbol: &dyn Fn(Symbol) -> Degree,
    ) -> Vec<Degree> {
        let reachable = self.iter_reachable(e);
        let length = e.iter().map(|e| e.index() + 1).max().unwrap_or(0);
        let mut degrees = vec![Degree::NUMBER; length];
        for &e in &reachable {
            let at = |e: ExprId| degrees[e.index()];
            degrees[e.index()] = match self.node(e) {
                Node::Number(_) => Degree::NUMBER,
                Node::Pi => Degree::polynomial(1.0),
                Node::Symbol(s) => symbol(*s),
                Node::Sum { terms, .. } => {
                    let terms: Vec<Degree> = terms.iter().map(|&(e, _)| at(e)).collect();
                    Degree::of_sum(&terms)
                }
                Node::Product(factors) => factors
                    .iter()
                    .fold(Degree::NUMBER, |product, &(base, exponent)| {
                        product.times(at(base).power(exponent.to_f64()))
                    }),
                // An atom of its own; that two atoms coincide is the vanishing of the difference of their arguments.
                Node::Power(base, exponent) => at(*base).times(at(*exponent)).times(ATOM),
                Node::Call(_, arguments) => {
                    let own = self.turns(arguments[0], angles);
                    let arguments = arguments.iter().map(|&u| at(u));
                    let keys = arguments.fold(0.0, |sum, u| sum + u.above + u.below);
                    Degree {
                        above: own.max(2.0) + keys,
                        below: own,
                    }
                }
                Node::Group(e) => at(*e),
                Node::Select {
                    then, otherwise, ..
                } => {
                    let (a, b) = (at(*then), at(*otherwise));
                    Degree {
                        above: a.above.max(b.above),
                        below: a.below.max(b.below),
                    }
                }
            };
        }
        e.iter().map(|e| degrees[e.index()]).collect()
    }
}

const ATOM: Degree = Degree::polynomial(2.0);
