//! Sums and products on paper: signs and common factors in front, fractions with one line.

use super::common::take_common;
use super::order::{FUNCTION, MOVING_SUM, PARAMETER, Rank};
use super::{Factors, Reader};
use crate::inspect::formula::Formula;
use crate::symbolic::{ExprId, Node, Rational};

/// Of longer sums only so many terms are shown.
const MOST_SHOWN: usize = 40;

/// Factors of a product on paper.
struct Sides {
    minus: bool,
    above: Vec<(Rank, Formula)>,
    below: Vec<(Rank, Formula)>,
}

impl Reader<'_> {
    /// A sum as it stands, with the factors that all terms share in front.
    pub(super) fn laid_out(&mut self, e: ExprId) -> Formula {
        let Node::Sum { constant, terms } = self.pool.node(e).clone() else {
            return self.full(e);
        };
        let mut list: Vec<(Rational, Factors)> = terms
            .iter()
            .map(|&(term, c)| (c, self.factors(term)))
            .collect();
        if !constant.is_zero() {
            list.push((constant, Vec::new()));
        }
        if list.len() == 1 {
            let (c, factors) = list.remove(0);
            return self.term(c, &factors, None);
        }
        let (c, common) = take_common(&mut list);
        let mut hidden = 0;
        if list.len() > MOST_SHOWN {
            hidden = list.len() - MOST_SHOWN / 2;
            list.truncate(MOST_SHOWN / 2);
        }
        let bases = list.iter().flat_map(|(_, factors)| factors).map(|f| f.0);
        let inner_rank = match bases.clone().all(|base| self.is_still(base)) {
            true => (
                PARAMETER,
                bases.map(|base| self.rank(base).1).min().unwrap_or(0),
                0,
            ),
            false => (MOVING_SUM, 0, 0),
        };
        let mut keyed: Vec<_> = list
            .into_iter()
            .map(|(c, factors)| (self.place(&factors), c, factors))
            .collect();
        keyed.sort();
        if let Some(first) = keyed.iter().position(|(_, c, _)| !c.is_negative()) {
            let first = keyed.remove(first);
            keyed.insert(0, first);
        }
        let mut terms: Vec<Formula> = keyed
            .iter()
            .map(|(_, c, factors)| self.term(*c, factors, None))
            .collect();
        if hidden > 0 {
            terms.push(Formula::More(hidden));
        }
        let inner = Formula::sum(terms);
        if c.is_one() && common.is_empty() {
            return inner;
        }
        self.term(c, &common, Some((inner_rank, inner)))
    }

    /// c · Π base^exponent · extra, in the order of reading.
    pub(super) fn term(
        &mut self,
        c: Rational,
        factors: &[(ExprId, Rational)],
        extra: Option<(Rank, Formula)>,
    ) -> Formula {
        let mut sides = self.sides(factors);
        sides.above.extend(extra);
        sides.minus ^= c.is_negative();
        sides.assembled(c.checked_abs().unwrap_or(c))
    }

    /// Π base^exponent as factors over and under a line.
    fn sides(&mut self, factors: &[(ExprId, Rational)]) -> Sides {
        let mut sides = Sides {
            minus: false,
            above: Vec::new(),
            below: Vec::new(),
        };
        for &(base, exponent) in factors {
            if let Some((power, letter)) = self.names.root(base)
                && let Some(times) = exponent.checked_div(*power)
                && times.is_integer()
            {
                let formula = raised(Formula::Letter(letter.clone()), times);
                let side = match times.is_negative() {
                    true => &mut sides.below,
                    false => &mut sides.above,
                };
                side.push(((MOVING_SUM, 0, 0), formula));
                continue;
            }
            let mut rank = self.rank(base);
            let (negative, formula) = match self.full(base).signed() {
                // An odd power of a sum that reads better with its sign in front.
                (true, formula) if exponent.is_integer() => {
                    (exponent.numerator() % 2 != 0, formula)
                }
                (true, formula) => (false, formula.negated()),
                plus => plus,
            };
            sides.minus ^= negative;
            match formula {
                // A sum with its common factors in front: they stand among the others.
                Formula::Product(parts) if exponent.is_one() => {
                    let placed = parts.into_iter().map(|part| (self.place_of(&part), part));
                    sides.above.extend(placed);
                }
                formula => {
                    if let Formula::Fraction(..) | Formula::Product(_) = formula {
                        rank.0 = MOVING_SUM;
                    }
                    let side = match exponent.is_negative() {
                        true => &mut sides.below,
                        false => &mut sides.above,
                    };
                    side.push((rank, raised(formula, exponent)));
                }
            }
        }
        sides
    }
}

impl Sides {
    /// The product with a number of this size; functions stand behind the fraction.
    fn assembled(mut self, size: Rational) -> Formula {
        self.above.sort_by_key(|(rank, _)| *rank);
        self.below.sort_by_key(|(rank, _)| *rank);
        let functions = self.above.partition_point(|(rank, _)| rank.0 < FUNCTION);
        let formulas = |side: Vec<(Rank, Formula)>| side.into_iter().map(|(_, formula)| formula);
        let mut functions: Vec<Formula> = formulas(self.above.split_off(functions)).collect();
        let mut above: Vec<Formula> = formulas(self.above).collect();
        let mut below: Vec<Formula> = formulas(self.below).collect();
        let whole = if below.is_empty() {
            if !size.is_one() || above.is_empty() && functions.is_empty() {
                above.insert(0, Formula::Number(size));
            }
            above.append(&mut functions);
            product(above)
        } else {
            // The number goes over and under the line where there is one.
            let mut over = size;
            if size.denominator() != 1
                && let Some(under) = Rational::new(size.denominator(), 1)
            {
                below.insert(0, Formula::Number(under));
                over = Rational::new(size.numerator(), 1).unwrap_or(size);
            }
            if above.is_empty() {
                above.append(&mut functions);
            }
            if !over.is_one() || above.is_empty() {
                above.insert(0, Formula::Number(over));
            }
            let fraction = Formula::Fraction(Box::new(product(above)), Box::new(product(below)));
            let mut all = vec![fraction];
            all.append(&mut functions);
            product(all)
        };
        if self.minus { whole.negated() } else { whole }
    }
}

/// base^|exponent|
fn raised(base: Formula, exponent: Rational) -> Formula {
    let size = exponent.checked_abs().unwrap_or(exponent);
    if size.is_one() {
        base
    } else if size == Rational::HALF {
        Formula::Root(Box::new(base))
    } else {
        Formula::Power(Box::new(base), Box::new(Formula::Number(size)))
    }
}

fn product(factors: Vec<Formula>) -> Formula {
    let mut factors = joined(factors);
    match factors.len() {
        1 => factors.remove(0),
        _ => Formula::Product(factors),
    }
}

/// Factors with neighbours that are powers of one letter joined: r r is r².
fn joined(factors: Vec<Formula>) -> Vec<Formula> {
    let power = |f: &Formula| match f {
        Formula::Letter(letter) => Some((letter.clone(), Rational::ONE)),
        Formula::Power(base, exponent) => match (&**base, &**exponent) {
            (Formula::Letter(letter), Formula::Number(n)) => Some((letter.clone(), *n)),
            _ => None,
        },
        _ => None,
    };
    let mut joined: Vec<Formula> = Vec::new();
    for factor in factors {
        if let Some(last) = joined.last_mut()
            && let (Some((letter, a)), Some((other, b))) = (power(last), power(&factor))
            && letter == other
            && let Some(sum) = a.checked_add(b)
        {
            *last = raised(Formula::Letter(letter), sum);
        } else {
            joined.push(factor);
        }
    }
    joined
}
