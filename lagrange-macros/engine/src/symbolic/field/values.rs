//! Values of expressions at a point.

use super::super::{ExprId, Function, Node, Pool, Rational};
use super::angles::is_additive;
use super::complex::Turn;
use super::{FieldValue, PRIMES, Point, Prime, Trouble};

impl Pool {
    /// Values at a point, whose `Angles` must have been made of these expressions (and others).
    pub fn at_point(&self, e: &[ExprId], point: &mut Point) -> Vec<FieldValue> {
        let mut values = Values {
            pool: self,
            pages: Vec::new(),
        };
        if !point.angles.independent {
            for &term in &point.angles.plain {
                values.fill(term, point);
            }
        }
        for &e in e {
            values.fill(e, point);
        }
        e.iter().map(|&e| values.at(e)).collect()
    }

    /// Whether an expression is zero wherever it has a value: by form, or by its values at points of both fields. An expression with
    /// branches may be zero on one side of them only, and is taken for another number.
    pub fn vanishes(&mut self, e: ExprId) -> bool {
        /// Points at which it is looked at, and those with a value that must be zeros.
        const POINTS: usize = 8;
        const ZEROS: usize = 2;
        if self.is_zero(e) {
            return true;
        }
        if !self.branches(e).is_empty() {
            return false;
        }
        let angles = self.angles(&[e], &[]);
        let mut zeros = 0;
        for (seed, &field) in (0..POINTS).zip(PRIMES.iter().cycle()) {
            let mut point = Point::new(field, seed as u64, &angles);
            match self.at_point(&[e], &mut point)[0] {
                Ok(0) => zeros += 1,
                Ok(_) => return false,
                Err(_) => {}
            }
        }
        zeros >= ZEROS
    }
}

// Keys of atoms in [`Point::random`].
const TURN: u64 = 2;
const GROWTH: u64 = 3;
const PI: u64 = 4;
const OPAQUE: u64 = 16;

/// Values on their way, on pages: few expressions of a large pool are needed.
struct Values<'a> {
    pool: &'a Pool,
    pages: Vec<Option<Page>>,
}

const PAGE: usize = 64;

type Page = Box<[Option<FieldValue>; PAGE]>;

impl Values<'_> {
    fn known(&self, e: ExprId) -> Option<FieldValue> {
        let page = self.pages.get(e.index() / PAGE)?.as_ref()?;
        page[e.index() % PAGE]
    }

    fn at(&self, e: ExprId) -> FieldValue {
        self.known(e).unwrap_or(Err(Trouble::Beyond))
    }

    fn set(&mut self, e: ExprId, value: FieldValue) {
        let page = e.index() / PAGE;
        if page >= self.pages.len() {
            self.pages.resize(page + 1, None);
        }
        self.pages[page].get_or_insert_with(|| Box::new([None; PAGE]))[e.index() % PAGE] =
            Some(value);
    }

    /// The value of e; children first, as far as they are not known.
    fn fill(&mut self, e: ExprId, point: &mut Point) {
        let mut stack = vec![e];
        while let Some(&top) = stack.last() {
            if self.known(top).is_none() {
                let height = stack.len();
                let missing = |e: ExprId| self.known(e).is_none();
                match self.pool.node(top) {
                    Node::Call(f, arguments) if is_additive(*f) => {
                        let argument = point.angles.arguments.get(&arguments[0]);
                        let argument = argument.copied().unwrap_or(arguments[0]);
                        let (_, terms) = self.pool.affine(argument);
                        stack.extend(terms.iter().map(|&(t, _)| t).filter(|&t| missing(t)));
                    }
                    node => node.for_each_child(|child| {
                        if missing(child) {
                            stack.push(child);
                        }
                    }),
                }
                if stack.len() > height {
                    continue;
                }
                let value = self.value(top, point);
                self.set(top, value);
            }
            stack.pop();
        }
    }

    fn value(&self, e: ExprId, point: &mut Point) -> FieldValue {
        let field = point.field;
        match self.pool.node(e) {
            Node::Number(n) => field.rational(*n).ok_or(Trouble::Beyond),
            Node::Pi => Ok(point.random(PI, 0)),
            Node::Symbol(symbol) => Ok(point.symbol(*symbol)),
            Node::Sum { constant, terms } => {
                let mut sum = field.rational(*constant).ok_or(Trouble::Beyond)?;
                for &(term, c) in terms {
                    let c = field.rational(c).ok_or(Trouble::Beyond)?;
                    sum = field.add(sum, field.mul(c, self.at(term)?));
                }
                Ok(sum)
            }
            Node::Product(factors) => {
                let mut product = 1;
                for &(base, exponent) in factors {
                    product = field.mul(product, self.power(base, exponent, point)?);
                }
                Ok(product)
            }
            Node::Power(base, exponent) => {
                point.exact = false;
                let key = field.mul(self.at(*base)?, 3);
                let key = point.random(OPAQUE + 15, key) ^ self.at(*exponent)?;
                // A general power is positive.
                Ok(square(field, point.random(OPAQUE + 14, key)))
            }
            Node::Call(f, arguments) => self.call(*f, arguments, point),
            Node::Group(e) => self.at(*e),
            Node::Select {
                branch,
                then,
                otherwise,
            } => self.at(if point.branches.contains(branch) {
                *then
            } else {
                *otherwise
            }),
        }
    }

    fn power(&self, base: ExprId, exponent: Rational, point: &mut Point) -> FieldValue {
        let a = self.at(base)?;
        if a == 0 && exponent.is_negative() {
            return Err(Trouble::Division);
        }
        if exponent.is_integer() {
            return point.field.power(a, exponent).ok_or(Trouble::Beyond);
        }
        let is_number = matches!(self.pool.node(base), Node::Number(_));
        point.roots |= !is_number;
        let never = if is_number {
            Trouble::Beyond
        } else {
            Trouble::NotSquare
        };
        point.field.power(a, exponent).ok_or(never)
    }

    fn call(&self, f: Function, arguments: &[ExprId], point: &mut Point) -> FieldValue {
        let field = point.field;
        let quotient = |a: u64, b: u64| {
            let below = field.inverse(b).ok_or(Trouble::Division)?;
            Ok(field.mul(a, below))
        };
        let u = arguments[0];
        match f {
            Function::Sin => Ok(self.turn(u, point)?.sin),
            Function::Cos => Ok(self.turn(u, point)?.cos),
            Function::Tan => {
                let turn = self.turn(u, point)?;
                quotient(turn.sin, turn.cos)
            }
            Function::Exp => self.growth(u, point),
            Function::Sinh | Function::Cosh | Function::Tanh => {
                let up = self.growth(u, point)?;
                let down = quotient(1, up)?;
                let (sum, difference) = (field.add(up, down), field.sub(up, down));
                match f {
                    Function::Sinh => quotient(difference, 2),
                    Function::Cosh => quotient(sum, 2),
                    _ => quotient(difference, sum),
                }
            }
            Function::Asin | Function::Atan => {
                point.exact = false;
                let (key, negative) = unsigned(field, self.at(u)?);
                let value = if key == 0 {
                    0
                } else {
                    point.random(OPAQUE + f as u64, key)
                };
                Ok(if negative { field.neg(value) } else { value })
            }
            Function::Acos | Function::Ln => {
                point.exact = false;
                Ok(point.random(OPAQUE + f as u64, self.at(u)?))
            }
            Function::Atan2 => {
                point.exact = false;
                let (y, x) = (self.at(u)?, self.at(arguments[1])?);
                let key = point.random(OPAQUE + 13, y) ^ x;
                Ok(point.random(OPAQUE + f as u64, key))
            }
        }
    }

    /// The argument as Σ nᵢ tᵢ/D: (constant · D, [(tᵢ, nᵢ)]).
    fn whole(&self, u: ExprId, point: &Point) -> Result<Whole, Trouble> {
        let u = point.angles.arguments.get(&u).copied().unwrap_or(u);
        let (constant, terms) = self.pool.affine(u);
        let d = point.angles.denominator.ok_or(Trouble::Beyond)?;
        let d = Rational::new(d, 1).ok_or(Trouble::Beyond)?;
        let times = |c: Rational| {
            let n = c.checked_mul(d).filter(|n| n.is_integer());
            n.map(Rational::numerator).ok_or(Trouble::Beyond)
        };
        let mut whole = Vec::with_capacity(terms.len());
        for (term, c) in terms {
            whole.push((term, c, times(c)?));
        }
        self.recognize(&mut whole, point);
        Ok((times(constant)?, whole))
    }

    /// Terms that are no products of free symbols may add up to one that is: θ (1/cos² − tan²) = θ.
    fn recognize(&self, whole: &mut Vec<(ExprId, Rational, i128)>, point: &Point) {
        const LARGEST: u64 = 64;
        let field = point.field;
        let is_plain = |term: &ExprId| point.angles.plain.contains(term);
        if whole.iter().all(|(term, ..)| is_plain(term)) {
            return;
        }
        let mut sum = 0;
        for (term, _, n) in whole.iter().filter(|(term, ..)| !is_plain(term)) {
            let Ok(value) = self.at(*term) else {
                return;
            };
            sum = field.add(sum, field.mul(field.integer(*n), value));
        }
        for &term in &point.angles.plain {
            let Some(below) = self.at(term).ok().and_then(|value| field.inverse(value)) else {
                continue;
            };
            let (ratio, negative) = unsigned(field, field.mul(sum, below));
            if ratio <= LARGEST {
                let n = i128::from(ratio);
                whole.retain(|(term, ..)| is_plain(term));
                whole.push((term, Rational::ZERO, if negative { -n } else { n }));
                return;
            }
        }
    }

    fn turn(&self, u: ExprId, point: &Point) -> Result<Turn, Trouble> {
        let field = point.field;
        // Half of each angle, which needs no division.
        let half = |key: u64| Turn {
            cos: 1,
            sin: point.random(TURN, key),
        };
        let (constant, terms) = self.whole(u, point)?;
        let mut halves = half(1).times(field, constant);
        let mut of_pi_only = Turn::NONE;
        for (term, c, n) in terms {
            if matches!(self.pool.node(term), Node::Pi) {
                of_pi_only = of_pi_only.and(field, of_pi(field, c)?);
                continue;
            }
            let (key, negative) = unsigned(field, self.at(term)?);
            if key != 0 {
                let n = if negative { -n } else { n };
                halves = halves.and(field, half(key).times(field, n));
            }
        }
        Ok(Turn::twice(field, halves).and(field, of_pi_only))
    }

    fn growth(&self, u: ExprId, point: &Point) -> FieldValue {
        let field = point.field;
        let order = i128::from(field.modulus() - 1);
        let atom = |key: u64, n: i128| {
            let base = square(field, point.random(GROWTH, key));
            field.pow(base, n.rem_euclid(order) as u64)
        };
        let (constant, terms) = self.whole(u, point)?;
        let mut growth = atom(1, constant);
        for (term, _, n) in terms {
            let (key, negative) = unsigned(field, self.at(term)?);
            if key != 0 {
                growth = field.mul(growth, atom(key, if negative { -n } else { n }));
            }
        }
        Ok(growth)
    }
}

/// (constant · D, [(term, its coefficient c, c · D)])
type Whole = (i128, Vec<(ExprId, Rational, i128)>);

/// A positive element: a square that is not 0.
fn square(field: Prime, a: u64) -> u64 {
    let a = if a == 0 { 1 } else { a };
    field.mul(a, a)
}

/// One of a and −a, always the same, and whether it is −a.
fn unsigned(field: Prime, a: u64) -> (u64, bool) {
    let opposite = field.neg(a);
    if opposite < a {
        (opposite, true)
    } else {
        (a, false)
    }
}

/// The turn by c π, for c a multiple of 1/12: √2 and √3 are in the field, and the same as elsewhere.
fn of_pi(field: Prime, c: Rational) -> Result<Turn, Trouble> {
    let twelfths = c.checked_mul(Rational::integer(12));
    let Some(twelfths) = twelfths.filter(|n| n.is_integer()) else {
        return Err(Trouble::Beyond);
    };
    let root = |n: u64| field.power(n, Rational::HALF).ok_or(Trouble::Beyond);
    let half = field.power(2, Rational::MINUS_ONE).ok_or(Trouble::Beyond)?;
    let third = Turn {
        cos: half,
        sin: field.mul(root(3)?, half),
    };
    let diagonal = field.mul(root(2)?, half);
    let fourth_back = Turn {
        cos: diagonal,
        sin: field.neg(diagonal),
    };
    let twelfth = third.and(field, fourth_back);
    Ok(twelfth.times(field, twelfths.numerator().rem_euclid(24)))
}
