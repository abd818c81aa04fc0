//! Expressions → formulas as a person writes them.
//!
//! Several forms of equal value are laid out, and the one with the least to read is taken: as it stands, multiplied
//! out, collected by velocities; each with the factors that all terms share in front. Nothing that is emitted depends
//! on it: forms made here are only read.

mod common;
mod expand;
mod layout;
mod order;

use super::formula::{Formula, Relation, Statement};
use super::names::{Kind, Names};
use crate::sorted::SortedMap;
use crate::symbolic::{ExprId, Function, Node, Pool, Rational};
use order::Contents;
use std::cell::RefCell;

/// A formula with no more to read than this is written whole.
const WHOLE: usize = 900;
/// Of a longer one so much is written, to show how it begins.
const BEGINNING: usize = 120;
/// A part with more to read than this is kept as its beginning: what names build on names doubles with each, and nobody reads it. What is
/// left still is too long to be written whole.
const LONGEST_PART: usize = 4 * WHOLE;

/// base^exponent factors.
type Factors = Vec<(ExprId, Rational)>;

/// Writes the expressions of a pool.
pub struct Reader<'a> {
    pool: &'a mut Pool,
    names: &'a Names,
    /// Guards of the branches.
    guards: Vec<ExprId>,
    known: SortedMap<ExprId, Formula>,
    seen: RefCell<SortedMap<ExprId, Contents>>,
}

impl<'a> Reader<'a> {
    /// A reader of expressions of this pool, with the guards of its branches.
    pub fn new(pool: &'a mut Pool, names: &'a Names, guards: Vec<ExprId>) -> Reader<'a> {
        Reader {
            pool,
            names,
            guards,
            known: SortedMap::new(),
            seen: RefCell::default(),
        }
    }

    /// The pool, to look at.
    pub fn peek(&self) -> &Pool {
        self.pool
    }

    /// The pool, to build what is to be written.
    pub fn pool(&mut self) -> &mut Pool {
        self.pool
    }

    /// An expression on paper; what would be very long is shortened.
    pub fn formula(&mut self, e: ExprId) -> Formula {
        let full = self.full(e);
        within(WHOLE, BEGINNING, full)
    }

    fn full(&mut self, e: ExprId) -> Formula {
        if let Some(known) = self.known.get(&e) {
            return known.clone();
        }
        let formula = within(LONGEST_PART, 2 * WHOLE, self.written(e));
        self.known.insert(e, formula.clone());
        formula
    }

    fn written(&mut self, e: ExprId) -> Formula {
        match self.pool.node(e).clone() {
            Node::Number(n) => Formula::number(n),
            Node::Pi => Formula::Pi,
            Node::Symbol(symbol) => Formula::Letter(self.names.letter(symbol)),
            Node::Sum { .. } => self.best(e),
            Node::Product(factors) if factors.iter().any(|&(base, r)| self.opens(base, r)) => {
                self.best(e)
            }
            Node::Product(_) => self.as_it_stands(e),
            Node::Power(base, exponent) => {
                Formula::Power(Box::new(self.full(base)), Box::new(self.full(exponent)))
            }
            Node::Call(f, arguments) => {
                let arguments = arguments.iter().map(|&a| self.full(a)).collect();
                Formula::Call(name(f).to_owned(), arguments)
            }
            // What is made of groups of groups would be endless.
            Node::Group(e) => within(BEGINNING, BEGINNING, self.full(e)),
            Node::Select {
                branch,
                then,
                otherwise,
            } => self.selection(branch, then, otherwise),
        }
    }

    /// The form of equal value with the least to read.
    fn best(&mut self, e: ExprId) -> Formula {
        let mut best = self.as_it_stands(e);
        let Some(flat) = self.multiplied_out(e) else {
            return best;
        };
        let by_rates = self.collected(flat, Kind::Velocity);
        let by_positions = self.collected(flat, Kind::Position);
        for form in [by_rates, by_positions, flat] {
            if form != e {
                let other = self.as_it_stands(form);
                if other.effort() < best.effort() {
                    best = other;
                }
            }
        }
        best
    }

    /// A sum or product in the form that it has.
    fn as_it_stands(&mut self, e: ExprId) -> Formula {
        match self.pool.node(e).clone() {
            Node::Sum { .. } => self.laid_out(e),
            Node::Product(factors) => self.term(Rational::ONE, &factors, None),
            _ => self.full(e),
        }
    }

    /// An expression as a product.
    fn factors(&self, e: ExprId) -> Factors {
        match self.pool.node(e) {
            Node::Product(factors) => factors.clone(),
            _ => vec![(e, Rational::ONE)],
        }
    }

    /// `abs`, `sign`, `max`, `min` are recognised; anything else is a distinction of cases.
    fn selection(&mut self, branch: usize, then: ExprId, otherwise: ExprId) -> Formula {
        let Some(&guard) = self.guards.get(branch) else {
            return Formula::More(1);
        };
        let minus = self.pool.neg(then);
        let difference = self.pool.sub(then, otherwise);
        let reverse = self.pool.neg(difference);
        let call = |f: &str, arguments| Formula::Call(f.to_owned(), arguments);
        if otherwise == minus && then == guard {
            let (_, size) = self.full(guard).signed();
            return Formula::Absolute(Box::new(size));
        }
        if otherwise == minus && self.pool.is_one(then) {
            return call("sgn", vec![self.full(guard)]);
        }
        let sides = [self.full(then), self.full(otherwise)];
        if guard == difference {
            return call("max", sides.to_vec());
        }
        if guard == reverse {
            return call("min", sides.to_vec());
        }
        let [then, otherwise] = sides.map(Box::new);
        let condition = Statement::new(self.full(guard), Relation::AtLeast, Formula::ZERO);
        Formula::Cases(Box::new(condition), then, otherwise)
    }
}

/// A formula, or a beginning of this size if it has more to read than so much.
fn within(whole: usize, beginning: usize, formula: Formula) -> Formula {
    if formula.size() <= whole {
        formula
    } else {
        formula.shortened(beginning)
    }
}

/// Name of a function on paper.
fn name(f: Function) -> &'static str {
    match f {
        Function::Asin => "arcsin",
        Function::Acos => "arccos",
        Function::Atan => "arctan",
        other => other.name(),
    }
}
