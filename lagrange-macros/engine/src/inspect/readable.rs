//! Expressions → formulas as a person writes them.
//!
//! Several forms of equal value are laid out, and the one with the least to read is taken: as it stands, multiplied
//! out, collected by velocities; each with the factors that all terms share in front. Nothing that is emitted depends
//! on it: forms made here are only read.

use super::formula::{Formula, Relation, Statement};
use super::names::{Kind, Known, Names};
use crate::symbolic::{ExprId, Function, Node, Pool, Rational};
use std::cell::RefCell;
use std::collections::BTreeMap;

/// Sums that would have more terms are not multiplied out.
const MOST_EXPANDED: usize = 48;

/// Of longer sums only so many terms are shown.
const MOST_SHOWN: usize = 40;

/// Of formulas with more to read than this, parts are left out.
const LONGEST: usize = 120;

/// base^exponent factors.
type Factors = Vec<(ExprId, Rational)>;

/// Writes the expressions of a pool.
pub struct Reader<'a> {
    pool: &'a mut Pool,
    names: &'a Names,
    /// Guards of the branches.
    guards: Vec<ExprId>,
    known: BTreeMap<ExprId, Formula>,
    seen: RefCell<BTreeMap<ExprId, Contents>>,
}

/// What an expression is made of.
#[derive(Clone, Copy)]
struct Contents {
    /// The last kind of its symbols.
    latest: Option<Kind>,
    /// The first of its symbols.
    symbol: usize,
    /// The first place that one of its symbols has among its kind.
    order: usize,
}

/// Where a factor stands in a product, then among its like.
type Rank = (u8, usize, usize);

/// Where a term stands in a sum.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
struct Place {
    forces: i64,
    rates: i64,
    mixed: bool,
    velocities: Vec<usize>,
    still: bool,
    ranks: Vec<(Rank, Rational)>,
}

impl Default for Place {
    fn default() -> Place {
        Place {
            forces: 0,
            rates: 0,
            mixed: false,
            velocities: Vec::new(),
            still: true,
            ranks: Vec::new(),
        }
    }
}

const NUMBER: u8 = 0;
const PARAMETER: u8 = 2;
const MOVING_SUM: u8 = 10;
const FUNCTION: u8 = 11;

impl<'a> Reader<'a> {
    /// A reader of expressions of this pool, with the guards of its branches.
    pub fn new(pool: &'a mut Pool, names: &'a Names, guards: Vec<ExprId>) -> Reader<'a> {
        Reader {
            pool,
            names,
            guards,
            known: BTreeMap::new(),
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
        self.full(e).shortened(LONGEST)
    }

    fn full(&mut self, e: ExprId) -> Formula {
        if let Some(known) = self.known.get(&e) {
            return known.clone();
        }
        let formula = self.written(e);
        self.known.insert(e, formula.clone());
        formula
    }

    fn written(&mut self, e: ExprId) -> Formula {
        match self.pool.node(e).clone() {
            Node::Number(n) => Formula::number(n),
            Node::Pi => Formula::Pi,
            Node::Symbol(symbol) => Formula::Letter(self.names.letter(symbol)),
            Node::Sum { .. } => self.best(e),
            Node::Product(factors) => {
                let as_is = self.term(Rational::ONE, &factors, None);
                match factors.iter().any(|&(base, r)| self.opens(base, r)) {
                    true => self.better(as_is, e),
                    false => as_is,
                }
            }
            Node::Power(base, exponent) => {
                Formula::Power(Box::new(self.full(base)), Box::new(self.full(exponent)))
            }
            Node::Call(f, arguments) => {
                let arguments = arguments.iter().map(|&a| self.full(a)).collect();
                Formula::Call(name(f).to_owned(), arguments)
            }
            Node::Group(e) => self.full(e),
            Node::Select {
                branch,
                then,
                otherwise,
            } => self.selection(branch, then, otherwise),
        }
    }

    /// The form of a sum with the least to read.
    fn best(&mut self, e: ExprId) -> Formula {
        let as_is = self.laid_out(e);
        self.better(as_is, e)
    }

    fn better(&mut self, as_is: Formula, e: ExprId) -> Formula {
        let mut best = as_is;
        let Some(flat) = self.multiplied_out(e) else {
            return best;
        };
        let by_rates = self.collected(flat, Kind::Velocity);
        let by_positions = self.collected(flat, Kind::Position);
        for form in [by_rates, by_positions, flat] {
            if form != e {
                let other = match self.pool.node(form).clone() {
                    Node::Sum { .. } => self.laid_out(form),
                    Node::Product(factors) => self.term(Rational::ONE, &factors, None),
                    _ => self.full(form),
                };
                if other.effort() < best.effort() {
                    best = other;
                }
            }
        }
        best
    }

    /// Whether a factor is a sum that moves, which can be multiplied out.
    fn opens(&self, base: ExprId, exponent: Rational) -> bool {
        exponent.is_integer()
            && !exponent.is_negative()
            && exponent.numerator() <= 3
            && matches!(self.pool.node(base), Node::Sum { .. })
            && !self.is_still(base)
    }

    /// Whether it holds parameters and time only.
    pub fn is_still(&self, e: ExprId) -> bool {
        self.is_below(e, Kind::Position)
    }

    /// Whether all its symbols are of a kind before this one.
    fn is_below(&self, e: ExprId, kind: Kind) -> bool {
        self.contents(e).latest.is_none_or(|latest| latest < kind)
    }

    /// What an expression is made of; once for each.
    fn contents(&self, e: ExprId) -> Contents {
        if let Some(known) = self.seen.borrow().get(&e) {
            return *known;
        }
        let mut contents = Contents {
            latest: None,
            symbol: usize::MAX,
            order: usize::MAX,
        };
        if let Node::Symbol(symbol) = self.pool.node(e) {
            let known = self.names.symbol(*symbol);
            contents.latest = Some(known.map_or(Kind::Force, |known| known.kind));
            contents.symbol = symbol.index();
            contents.order = known.map_or(usize::MAX, |known| known.order);
        }
        let mut children = Vec::new();
        self.pool
            .node(e)
            .for_each_child(|child| children.push(child));
        for child in children {
            let inner = self.contents(child);
            contents.latest = contents.latest.max(inner.latest);
            contents.symbol = contents.symbol.min(inner.symbol);
            contents.order = contents.order.min(inner.order);
        }
        self.seen.borrow_mut().insert(e, contents);
        contents
    }

    /// Products over moving sums multiplied out; `None` if that is too long.
    pub fn multiplied_out(&mut self, e: ExprId) -> Option<ExprId> {
        let mut terms = Vec::new();
        self.open(e, (Rational::ONE, Vec::new()), &mut terms)?;
        let mut list = Vec::new();
        for (c, factors) in terms {
            list.push((self.pool.monomial(c, &factors), Rational::ONE));
        }
        Some(self.pool.linear(Rational::ZERO, list))
    }

    /// Adds the terms of e times `by`.
    fn open(
        &self,
        e: ExprId,
        by: (Rational, Factors),
        terms: &mut Vec<(Rational, Factors)>,
    ) -> Option<()> {
        if terms.len() > MOST_EXPANDED {
            return None;
        }
        let (c, mut factors) = by;
        match self.pool.node(e) {
            Node::Number(n) => terms.push((c.checked_mul(*n)?, factors)),
            Node::Sum {
                constant,
                terms: own,
            } => {
                for &(term, size) in own {
                    self.open(term, (c.checked_mul(size)?, factors.clone()), terms)?;
                }
                if !constant.is_zero() {
                    terms.push((c.checked_mul(*constant)?, factors));
                }
            }
            Node::Product(own) => {
                let opening = own.iter().position(|&(base, r)| self.opens(base, r));
                let Some(at) = opening else {
                    factors.extend(own.iter().copied());
                    terms.push((c, factors));
                    return Some(());
                };
                let (base, exponent) = own[at];
                let mut rest = own.clone();
                match exponent.is_one() {
                    true => drop(rest.remove(at)),
                    false => rest[at].1 = exponent.checked_sub(Rational::ONE)?,
                }
                let mut inner = Vec::new();
                self.open(base, (c, factors), &mut inner)?;
                for (c, mut factors) in inner {
                    // What is left of the product can open in turn.
                    let mut still = Vec::new();
                    for &(base, r) in &rest {
                        match self.opens(base, r) {
                            true => still.push((base, r)),
                            false => factors.push((base, r)),
                        }
                    }
                    self.open_factors(&still, (c, factors), terms)?;
                }
            }
            _ => {
                factors.push((e, Rational::ONE));
                terms.push((c, factors));
            }
        }
        Some(())
    }

    /// Multiplies `by` with powers of sums.
    fn open_factors(
        &self,
        sums: &[(ExprId, Rational)],
        by: (Rational, Factors),
        terms: &mut Vec<(Rational, Factors)>,
    ) -> Option<()> {
        let Some((&(base, exponent), rest)) = sums.split_first() else {
            terms.push(by);
            return (terms.len() <= MOST_EXPANDED).then_some(());
        };
        let mut partial = vec![by];
        for _ in 0..exponent.numerator() {
            let mut next = Vec::new();
            for term in partial {
                self.open(base, term, &mut next)?;
            }
            partial = next;
        }
        for term in partial {
            self.open_factors(rest, term, terms)?;
        }
        Some(())
    }

    /// Terms put together that agree in all factors of this kind or a later one, functions of such included.
    fn collected(&mut self, flat: ExprId, kind: Kind) -> ExprId {
        let Node::Sum { constant, terms } = self.pool.node(flat).clone() else {
            return flat;
        };
        let mut groups: BTreeMap<Factors, Vec<(ExprId, Rational)>> = BTreeMap::new();
        for (term, c) in terms {
            let factors = match self.pool.node(term) {
                Node::Product(factors) => factors.clone(),
                _ => vec![(term, Rational::ONE)],
            };
            let (moving, still): (Factors, Factors) = factors
                .into_iter()
                .partition(|&(base, _)| !self.is_below(base, kind));
            let still = self.pool.monomial(Rational::ONE, &still);
            groups.entry(moving).or_default().push((still, c));
        }
        let mut terms = Vec::new();
        for (moving, group) in groups {
            let coefficient = self.pool.linear(Rational::ZERO, group);
            let mut factors = moving;
            if !factors.is_empty() {
                factors.push((coefficient, Rational::ONE));
                terms.push((self.pool.monomial(Rational::ONE, &factors), Rational::ONE));
            } else {
                terms.push((coefficient, Rational::ONE));
            }
        }
        self.pool.linear(constant, terms)
    }

    /// A sum as it stands, with the factors that all terms share in front.
    fn laid_out(&mut self, e: ExprId) -> Formula {
        let Node::Sum { constant, terms } = self.pool.node(e).clone() else {
            return self.full(e);
        };
        let mut list: Vec<(Rational, Factors)> = terms
            .iter()
            .map(|&(term, c)| match self.pool.node(term) {
                Node::Product(factors) => (c, factors.clone()),
                _ => (c, vec![(term, Rational::ONE)]),
            })
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

    /// Where a term stands in a sum: what moves most comes first, squares before products, numbers last.
    fn place(&self, factors: &[(ExprId, Rational)]) -> Place {
        let mut place = Place::default();
        for &(base, exponent) in factors {
            if let Node::Symbol(symbol) = self.pool.node(base)
                && let Some(known) = self.names.symbol(*symbol)
            {
                let size = i64::try_from(exponent.numerator()).unwrap_or(1);
                match known.kind {
                    Kind::Acceleration => {
                        place.rates -= 16 * size;
                        place.velocities.push(known.order);
                    }
                    Kind::Velocity => {
                        place.rates -= size;
                        place.velocities.push(known.order);
                    }
                    Kind::Force => place.forces += size,
                    _ => {}
                }
            }
            place.still &= self.is_still(base);
            place.ranks.push((self.rank(base), exponent));
        }
        place.velocities.sort_unstable();
        place.mixed = place.velocities.len() > 1;
        place.ranks.sort_unstable();
        place
    }

    /// c · Π base^exponent · extra, in the order of reading.
    fn term(
        &mut self,
        c: Rational,
        factors: &[(ExprId, Rational)],
        extra: Option<(Rank, Formula)>,
    ) -> Formula {
        let mut above: Vec<(Rank, Formula)> = Vec::new();
        let mut below: Vec<(Rank, Formula)> = Vec::new();
        let mut minus = c.is_negative();
        let mut size = c.checked_abs().unwrap_or(c);
        for &(base, exponent) in factors {
            let mut rank = self.rank(base);
            let (negative, formula) = match self.full(base).signed() {
                // An odd power of a sum that reads better with its sign in front.
                (true, formula) if exponent.is_integer() => {
                    (exponent.numerator() % 2 != 0, formula)
                }
                (true, formula) => (false, formula.negated()),
                plus => plus,
            };
            minus ^= negative;
            if let Formula::Fraction(..) = formula {
                rank.0 = MOVING_SUM;
            }
            // A sum with its common factors in front: they stand among the others.
            if let Formula::Product(parts) = formula {
                if exponent.is_one() {
                    above.extend(parts.into_iter().map(|part| (self.place_of(&part), part)));
                } else {
                    rank.0 = MOVING_SUM;
                    let formula = Formula::Product(parts);
                    let list = match exponent.is_negative() {
                        true => &mut below,
                        false => &mut above,
                    };
                    list.push((rank, raised(formula, exponent)));
                }
                continue;
            }
            let list = match exponent.is_negative() {
                true => &mut below,
                false => &mut above,
            };
            list.push((rank, raised(formula, exponent)));
        }
        if let Some(extra) = extra {
            above.push(extra);
        }
        above.sort_by_key(|(rank, _)| *rank);
        below.sort_by_key(|(rank, _)| *rank);
        let split = above.partition_point(|(rank, _)| rank.0 < FUNCTION);
        let mut functions: Vec<Formula> = above.split_off(split).into_iter().map(|f| f.1).collect();
        let mut above: Vec<Formula> = above.into_iter().map(|f| f.1).collect();
        let mut below: Vec<Formula> = below.into_iter().map(|f| f.1).collect();
        let whole = if below.is_empty() {
            if !size.is_one() || above.is_empty() && functions.is_empty() {
                above.insert(0, Formula::Number(size));
            }
            above.append(&mut functions);
            product(above)
        } else {
            // The number goes over and under the line where there is one.
            if size.denominator() != 1
                && let Some(under) = Rational::new(size.denominator(), 1)
            {
                below.insert(0, Formula::Number(under));
                size = Rational::new(size.numerator(), 1).unwrap_or(size);
            }
            if above.is_empty() {
                above.append(&mut functions);
            }
            if !size.is_one() || above.is_empty() {
                above.insert(0, Formula::Number(size));
            }
            let fraction = Formula::Fraction(Box::new(product(above)), Box::new(product(below)));
            let mut all = vec![fraction];
            all.append(&mut functions);
            product(all)
        };
        if minus { whole.negated() } else { whole }
    }

    /// The rank of a factor that is a formula already.
    fn place_of(&self, f: &Formula) -> Rank {
        match f {
            Formula::Number(_) => (NUMBER, 0, 0),
            Formula::Letter(letter) => self
                .names
                .of_letter(letter)
                .map_or((MOVING_SUM, 0, 0), rank_of),
            Formula::Power(base, _) => self.place_of(base),
            Formula::Call(..) => (FUNCTION, usize::MAX, 0),
            _ => (MOVING_SUM, 0, 0),
        }
    }

    fn rank(&self, e: ExprId) -> Rank {
        match self.pool.node(e) {
            Node::Number(_) => (NUMBER, 0, 0),
            Node::Pi => (1, 0, 0),
            Node::Symbol(symbol) => match self.names.symbol(*symbol) {
                Some(known) => rank_of(known),
                None => (9, symbol.index(), 0),
            },
            Node::Call(..) => (FUNCTION, self.contents(e).symbol, e.index()),
            // A sum of masses stands where masses stand.
            Node::Sum { .. } if self.is_still(e) => (PARAMETER, self.contents(e).order, e.index()),
            _ => (MOVING_SUM, 0, e.index()),
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

fn rank_of(known: &Known) -> Rank {
    let kind = match known.kind {
        Kind::Parameter => PARAMETER,
        Kind::Time => 3,
        Kind::Position => 4,
        Kind::Velocity => 6,
        Kind::Acceleration => 7,
        Kind::Force => 8,
    };
    (kind, known.order, 0)
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

fn product(mut factors: Vec<Formula>) -> Formula {
    match factors.len() {
        1 => factors.remove(0),
        _ => Formula::Product(factors),
    }
}

/// Divides all terms by what they share, and returns it. A number is shared if it is whole, or in the company of letters.
fn take_common(terms: &mut [(Rational, Factors)]) -> (Rational, Factors) {
    let mut common: Factors = Vec::new();
    for &(base, first) in &terms[0].1 {
        let mut least = first;
        let all = terms[1..].iter().all(|(_, factors)| {
            factors.iter().any(|&(other, exponent)| {
                least = if other == base {
                    least.min(exponent)
                } else {
                    least
                };
                other == base && exponent.is_negative() == first.is_negative()
            })
        });
        if all && least.is_integer() && (!first.is_negative()) {
            common.push((base, least));
        } else if all && terms.iter().all(|(_, f)| f.contains(&(base, first))) {
            common.push((base, first));
        }
    }
    for &(base, exponent) in &common {
        for (_, factors) in terms.iter_mut() {
            for factor in factors.iter_mut().filter(|factor| factor.0 == base) {
                factor.1 = factor.1.checked_sub(exponent).unwrap_or(Rational::ZERO);
            }
            factors.retain(|(_, exponent)| !exponent.is_zero());
        }
    }
    let (mut over, mut under) = (0, 1);
    for (c, _) in terms.iter() {
        over = gcd(over, c.numerator().unsigned_abs());
        let denominator = c.denominator().unsigned_abs();
        under = (under / gcd(under, denominator)).saturating_mul(denominator);
    }
    let minus = terms.iter().all(|(c, _)| c.is_negative());
    let number = match (i128::try_from(over), i128::try_from(under)) {
        (Ok(over), Ok(1)) => Rational::new(if minus { -over } else { over }, 1),
        // Of fractions the one that most terms have.
        _ if !common.is_empty() => {
            let size = |c: Rational| c.checked_abs().unwrap_or(c);
            let having = |n: Rational| terms.iter().filter(|(c, _)| size(*c) == n).count();
            let often = terms
                .iter()
                .map(|(c, _)| size(*c))
                .max_by_key(|&n| (having(n), n));
            let often = often.filter(|&n| 2 * having(n) > terms.len() && !n.is_integer());
            often.and_then(|n| if minus { n.checked_neg() } else { Some(n) })
        }
        _ => None,
    };
    let number = match number {
        None if minus && !common.is_empty() => Some(Rational::MINUS_ONE),
        number => number,
    };
    // A sign alone is not worth parentheses.
    let number = number.filter(|n| !(common.is_empty() && *n == Rational::MINUS_ONE));
    let Some(number) = number else {
        return (Rational::ONE, common);
    };
    let quotients: Option<Vec<Rational>> =
        terms.iter().map(|(c, _)| c.checked_div(number)).collect();
    match quotients {
        Some(quotients) => {
            for ((c, _), quotient) in terms.iter_mut().zip(quotients) {
                *c = quotient;
            }
            (number, common)
        }
        None => (Rational::ONE, common),
    }
}

fn gcd(a: u128, b: u128) -> u128 {
    if b == 0 { a } else { gcd(b, a % b) }
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
