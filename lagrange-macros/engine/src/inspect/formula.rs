//! Formulas as they stand on paper: what printers print.
//!
//! A formula is built in the order in which it is read; printers decide on parentheses and layout, nothing else.

use super::letter::{Letter, Mark};
use crate::ast::Decimal;
use crate::symbolic::Rational;

/// What is left of a part at least.
const FEW: usize = 6;

/// A formula.
#[derive(Clone, PartialEq, Debug)]
pub enum Formula {
    /// A number ≥ 0 (signs are in sums and [`Formula::Negative`]).
    Number(Rational),
    /// A number ≥ 0 that is no whole one, as the user wrote it: `0.98`.
    Decimal(Decimal),
    /// π
    Pi,
    /// A symbol.
    Letter(Letter),
    /// Terms with their signs (true: minus), at least one.
    Sum(Vec<(bool, Formula)>),
    /// Factors, at least one.
    Product(Vec<Formula>),
    /// −a
    Negative(Box<Formula>),
    /// a/b
    Fraction(Box<Formula>, Box<Formula>),
    /// a to the power b
    Power(Box<Formula>, Box<Formula>),
    /// √a
    Root(Box<Formula>),
    /// |a|
    Absolute(Box<Formula>),
    /// f(a, …)
    Call(String, Vec<Formula>),
    /// d/dt of something that is no symbol, once or twice.
    Rate(Box<Formula>, u8),
    /// The first if the condition holds, else the second.
    Cases(Box<Statement>, Box<Formula>, Box<Formula>),
    /// Σ of the last over an index: from ≤ index < to.
    SumOver(Letter, Box<[Formula; 3]>),
    /// (a, b, …)
    List(Vec<Formula>),
    /// `list[index]` where the list is no symbol.
    Element(Box<Formula>, Box<Formula>),
    /// So many terms that are not shown.
    More(usize),
}

/// `left relation right`
#[derive(Clone, PartialEq, Debug)]
pub struct Statement {
    /// Left side.
    pub left: Formula,
    /// What holds between them.
    pub relation: Relation,
    /// Right side.
    pub right: Formula,
}

/// What holds between two sides.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Relation {
    /// =
    Equal,
    /// ≥
    AtLeast,
    /// ≤
    AtMost,
    /// >
    Above,
    /// <
    Below,
}

impl Statement {
    /// `left = right`, without a sign on the left.
    pub fn equal(left: Formula, right: Formula) -> Statement {
        let (minus, left) = left.signed();
        let right = if minus { right.negated() } else { right };
        Statement::new(left, Relation::Equal, right)
    }

    /// `left relation right`
    pub fn new(left: Formula, relation: Relation, right: Formula) -> Statement {
        Statement {
            left,
            relation,
            right,
        }
    }
}

impl Formula {
    /// 0
    pub const ZERO: Formula = Formula::Number(Rational::ZERO);

    /// A number of any sign.
    pub fn number(n: Rational) -> Formula {
        match n.checked_abs() {
            Some(size) if n.is_negative() => Formula::Number(size).negated(),
            _ => Formula::Number(n),
        }
    }

    /// −a, or a of −a.
    pub fn negated(self) -> Formula {
        match self {
            Formula::Negative(inner) => *inner,
            Formula::Number(n) if n.is_zero() => self,
            other => Formula::Negative(Box::new(other)),
        }
    }

    /// Its sign (true: minus) and the rest.
    pub fn signed(self) -> (bool, Formula) {
        match self {
            Formula::Negative(inner) => (true, *inner),
            other => (false, other),
        }
    }

    /// The sum of terms with signs; sums among them are opened, zeros left out.
    pub fn sum(terms: impl IntoIterator<Item = Formula>) -> Formula {
        let mut flat = Vec::new();
        for term in terms {
            let (minus, term) = term.signed();
            match term {
                Formula::Sum(inner) => {
                    flat.extend(inner.into_iter().map(|(sign, term)| (sign != minus, term)));
                }
                Formula::Number(n) if n.is_zero() => {}
                term => flat.push((minus, term)),
            }
        }
        match flat.len() {
            0 => Formula::ZERO,
            1 => {
                let (minus, term) = flat.remove(0);
                if minus { term.negated() } else { term }
            }
            _ => Formula::Sum(flat),
        }
    }

    /// How much there is to read: letters, numbers, signs and parentheses.
    pub fn size(&self) -> usize {
        let all = |list: &[Formula]| list.iter().map(Formula::size).sum::<usize>();
        match self {
            Formula::Number(n) if n.is_integer() => 1,
            Formula::Number(_) | Formula::More(_) => 2,
            Formula::Decimal(_) | Formula::Pi | Formula::Letter(_) => 1,
            Formula::Sum(terms) => terms.iter().map(|(_, term)| 1 + term.size()).sum(),
            Formula::Product(factors) => {
                let sums = factors.iter().filter(|f| matches!(f, Formula::Sum(_)));
                all(factors) + 2 * sums.count()
            }
            Formula::Negative(a) | Formula::Root(a) | Formula::Absolute(a) => 1 + a.size(),
            Formula::Fraction(a, b) | Formula::Power(a, b) | Formula::Element(a, b) => {
                let grouped = usize::from(matches!(**a, Formula::Sum(_)));
                1 + 2 * grouped + a.size() + b.size()
            }
            Formula::Call(_, arguments) => 1 + all(arguments),
            Formula::Rate(a, _) => 2 + a.size(),
            Formula::Cases(condition, a, b) => {
                4 + condition.left.size() + condition.right.size() + a.size() + b.size()
            }
            Formula::SumOver(_, parts) => 2 + all(&**parts),
            Formula::List(list) => 2 + all(list),
        }
    }

    /// How hard it is to read: its size, and how deep its parentheses are.
    pub fn effort(&self) -> usize {
        self.size() + 3 * self.nesting()
    }

    fn nesting(&self) -> usize {
        match self {
            Formula::Sum(terms) => terms
                .iter()
                .map(|(_, term)| term.nesting())
                .max()
                .unwrap_or(0),
            Formula::Product(factors) => {
                let inside = |f: &Formula| usize::from(matches!(f, Formula::Sum(_))) + f.nesting();
                factors.iter().map(inside).max().unwrap_or(0)
            }
            Formula::Power(a, _) => usize::from(matches!(**a, Formula::Sum(_))) + a.nesting(),
            Formula::Negative(a) => a.nesting(),
            Formula::Fraction(a, b) => a.nesting().max(b.nesting()),
            _ => 0,
        }
    }

    /// The same, with terms and parts left out until there is no more than so much to read (but for what cannot be taken
    /// apart).
    pub fn shortened(&self, most: usize) -> Formula {
        if self.size() <= most {
            return self.clone();
        }
        let part = |a: &Formula, most: usize| Box::new(a.shortened(most));
        match self {
            Formula::Sum(terms) => {
                let mut left = most;
                let mut kept = Vec::new();
                for (minus, term) in terms {
                    let size = 1 + term.size();
                    if !kept.is_empty() && size > left {
                        break;
                    }
                    kept.push((*minus, term.shortened(left.max(FEW))));
                    left = left.saturating_sub(size);
                }
                if kept.len() < terms.len() {
                    kept.push((false, Formula::More(terms.len() - kept.len())));
                }
                Formula::Sum(kept)
            }
            Formula::Product(factors) => {
                let sizes: usize = factors.iter().map(Formula::size).sum();
                let share = |f: &Formula| (most * f.size() / sizes.max(1)).max(FEW);
                Formula::Product(factors.iter().map(|f| f.shortened(share(f))).collect())
            }
            Formula::Negative(a) => Formula::Negative(part(a, most)),
            Formula::Root(a) => Formula::Root(part(a, most)),
            Formula::Absolute(a) => Formula::Absolute(part(a, most)),
            Formula::Fraction(a, b) => {
                let half = (most / 2).max(FEW);
                Formula::Fraction(part(a, half), part(b, half))
            }
            Formula::Power(a, b) => Formula::Power(part(a, most), b.clone()),
            Formula::Call(f, arguments) => {
                let share = (most / arguments.len().max(1)).max(FEW);
                let arguments = arguments.iter().map(|a| a.shortened(share));
                Formula::Call(f.clone(), arguments.collect())
            }
            other => other.clone(),
        }
    }

    /// The same with every letter replaced.
    pub fn with_letters(&self, new: &dyn Fn(&Letter) -> Letter) -> Formula {
        let one = |a: &Formula| Box::new(a.with_letters(new));
        let all = |list: &[Formula]| list.iter().map(|a| a.with_letters(new)).collect();
        match self {
            Formula::Number(_) | Formula::Decimal(_) | Formula::Pi | Formula::More(_) => {
                self.clone()
            }
            Formula::Letter(letter) => Formula::Letter(new(letter)),
            Formula::Sum(terms) => Formula::Sum(
                terms
                    .iter()
                    .map(|(minus, term)| (*minus, term.with_letters(new)))
                    .collect(),
            ),
            Formula::Product(factors) => Formula::Product(all(factors)),
            Formula::Negative(a) => Formula::Negative(one(a)),
            Formula::Fraction(a, b) => Formula::Fraction(one(a), one(b)),
            Formula::Power(a, b) => Formula::Power(one(a), one(b)),
            Formula::Root(a) => Formula::Root(one(a)),
            Formula::Absolute(a) => Formula::Absolute(one(a)),
            Formula::Call(f, arguments) => Formula::Call(f.clone(), all(arguments)),
            Formula::Rate(a, order) => Formula::Rate(one(a), *order),
            Formula::Cases(condition, a, b) => {
                let condition = Statement {
                    left: condition.left.with_letters(new),
                    relation: condition.relation,
                    right: condition.right.with_letters(new),
                };
                Formula::Cases(Box::new(condition), one(a), one(b))
            }
            Formula::SumOver(index, parts) => {
                let [from, to, body] = &**parts;
                let parts = [from, to, body].map(|a| a.with_letters(new));
                Formula::SumOver(index.clone(), Box::new(parts))
            }
            Formula::List(list) => Formula::List(all(list)),
            Formula::Element(a, b) => Formula::Element(one(a), one(b)),
        }
    }

    /// The same with every velocity marked.
    pub fn with_velocities(&self, mark: Mark) -> Formula {
        self.with_letters(&|letter| {
            let mut letter = letter.clone();
            if letter.rate == 1 {
                letter.mark = mark;
            }
            letter
        })
    }

    /// The same with velocities' jumps in place of accelerations.
    pub fn with_jumps(&self) -> Formula {
        self.with_letters(&|letter| {
            let mut letter = letter.clone();
            if letter.rate == 2 {
                letter.rate = 1;
                letter.mark = Mark::Jump;
            }
            letter
        })
    }
}
