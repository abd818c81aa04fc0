//! Number of operations of an expression as a graph, each distinct node once.
//!
//! A sum of k terms is k − 1 additions; ±1 as a coefficient is free, and terms with coefficients of one size share
//! a multiplication. Powers x^n go by squaring and are shared; all divisors of a product are one division; sin and
//! cos of one argument are one operation. What holds no symbol, or only fixed ones, is a constant and free: a term
//! is then a fixed coefficient times a varying product.

use super::hash::Memo;
use super::table::Flags;
use super::{ExprId, Function, Node, Pool, Rational};

/// exp(v ln u)
const GENERAL_POWER: usize = 3;

// What has been counted of an expression, besides its powers 2 to 24.
const VISITED: u32 = 0;
const LARGE_POWER: u32 = 25;
const ROOT: u32 = 26;
const CIRCULAR: u32 = 27;
const HYPERBOLIC: u32 = 28;
const SCALED: u32 = 29;
const VARYING_PART: u32 = 30;

type Factors = Vec<(ExprId, Rational)>;

impl Pool {
    /// Number of operations of the expressions as one graph, without those on fixed symbols alone.
    pub fn operations(&self, e: &[ExprId]) -> usize {
        self.count(e, false)
    }

    /// All operations, also those that are done once.
    pub(super) fn all_operations(&self, e: ExprId) -> usize {
        self.count(&[e], true)
    }

    fn count(&self, roots: &[ExprId], everything: bool) -> usize {
        let mut count = Count {
            pool: self,
            everything,
            total: 0,
            seen: Flags::default(),
            parts: Memo::default(),
            scaled: Memo::default(),
        };
        let mut stack = roots.to_vec();
        for &root in roots {
            count.scaled_use(root);
        }
        while let Some(e) = stack.pop() {
            if !count.is_free(e) && count.seen.raise(e, VISITED) {
                count.node(e);
                self.node(e).for_each_child(|child| stack.push(child));
            }
        }
        count.total
    }
}

struct Count<'a> {
    pool: &'a Pool,
    /// Fixed symbols count like others.
    everything: bool,
    total: usize,
    seen: Flags,
    /// Varying parts of products that are no expressions of the pool.
    parts: Memo<Factors, ()>,
    /// Terms times numbers.
    scaled: Memo<(ExprId, Rational), ()>,
}

impl Count<'_> {
    fn is_free(&self, e: ExprId) -> bool {
        if self.everything {
            self.pool.symbol_bits(e) == 0
        } else {
            !self.pool.varies(e)
        }
    }

    fn node(&mut self, e: ExprId) {
        let pool = self.pool;
        match pool.node(e) {
            Node::Number(_) | Node::Pi | Node::Symbol(_) => {}
            Node::Sum { constant, terms } => self.sum(*constant, terms),
            Node::Product(factors) => {
                self.product(e, factors);
                for &(base, _) in factors {
                    self.scaled_use(base);
                }
            }
            Node::Power(base, exponent) => {
                self.total += GENERAL_POWER;
                self.scaled_use(*base);
                self.scaled_use(*exponent);
            }
            Node::Call(f, arguments) => {
                let first = arguments[0];
                let new = match f {
                    Function::Sin | Function::Cos => self.seen.raise(first, CIRCULAR),
                    Function::Sinh | Function::Cosh => self.seen.raise(first, HYPERBOLIC),
                    _ => true,
                };
                self.total += usize::from(new);
                for &argument in arguments {
                    self.scaled_use(argument);
                }
            }
            Node::Group(e) => self.scaled_use(*e),
            Node::Select {
                then, otherwise, ..
            } => {
                self.total += 1;
                self.scaled_use(*then);
                self.scaled_use(*otherwise);
            }
        }
    }

    /// A product with a fixed part that is not a term of a sum needs one multiplication for it.
    fn scaled_use(&mut self, e: ExprId) {
        if let Node::Product(factors) = self.pool.node(e)
            && !self.is_free(e)
            && factors.iter().any(|&(base, _)| self.is_free(base))
            && self.seen.raise(e, SCALED)
        {
            self.total += 1;
        }
    }

    fn sum(&mut self, constant: Rational, terms: &[(ExprId, Rational)]) {
        // (size of the coefficient, fixed part, term) of what varies
        let mut scaled: Vec<(Rational, Factors, ExprId)> = Vec::new();
        let mut varying = 0;
        let mut mixed = Vec::new();
        for &(term, c) in terms {
            if self.is_free(term) {
                continue;
            }
            varying += 1;
            let size = c.checked_abs().unwrap_or(c);
            match self.pool.node(term) {
                Node::Product(factors) if factors.iter().any(|&(base, _)| self.is_free(base)) => {
                    mixed.push((self.part(factors, false), size, term));
                }
                _ if !size.is_one() => scaled.push((size, Vec::new(), term)),
                _ => {}
            }
        }
        self.total += varying - usize::from(constant.is_zero() && varying == terms.len());
        // Terms with one varying part are one term, with the sum of their fixed parts.
        mixed.sort_unstable();
        let mut at = 0;
        while at < mixed.len() {
            let count = mixed[at..]
                .iter()
                .take_while(|part| part.0 == mixed[at].0)
                .count();
            let (_, size, term) = mixed[at];
            if count > 1 {
                self.total -= count - 2;
            } else if let Node::Product(factors) = self.pool.node(term) {
                scaled.push((size, self.part(factors, true), term));
            }
            at += count;
        }
        // Terms with one coefficient share the multiplication; a single one shares it with other sums.
        scaled.sort_unstable();
        let mut at = 0;
        while at < scaled.len() {
            let count = scaled[at..]
                .iter()
                .take_while(|part| (part.0, &part.1) == (scaled[at].0, &scaled[at].1));
            let count = count.count();
            let new = match &scaled[at] {
                _ if count > 1 => true,
                (size, _, term) if size.is_one() => self.seen.raise(*term, SCALED),
                (size, _, term) => self.scaled.insert((*term, *size), ()).is_none(),
            };
            self.total += usize::from(new);
            at += count;
        }
    }

    /// The fixed or the varying factors.
    fn part(&self, factors: &[(ExprId, Rational)], fixed: bool) -> Factors {
        factors
            .iter()
            .filter(|&&(base, _)| self.is_free(base) == fixed)
            .copied()
            .collect()
    }

    fn product(&mut self, e: ExprId, factors: &[(ExprId, Rational)]) {
        let varying: Factors = factors
            .iter()
            .filter(|&&(base, _)| !self.is_free(base))
            .copied()
            .collect();
        for &(base, exponent) in &varying {
            self.power(base, exponent);
        }
        let below = varying
            .iter()
            .filter(|(_, exponent)| exponent.is_negative())
            .count();
        let above = varying.len() - below;
        let cost = usize::max(above, 1) - 1 + below;
        if cost == 0 {
            return;
        }
        // The same varying part with another coefficient is the same operations.
        let new = if varying.len() == factors.len() {
            self.seen.raise(e, VARYING_PART)
        } else {
            match self.pool.find(&Node::Product(varying.clone())) {
                Some(part) => self.seen.raise(part, VARYING_PART),
                None => self.parts.insert(varying, ()).is_none(),
            }
        };
        if new {
            self.total += cost;
        }
    }

    /// base^|exponent|
    fn power(&mut self, base: ExprId, exponent: Rational) {
        let size = exponent.numerator().unsigned_abs();
        let whole = (size / exponent.denominator().unsigned_abs()).min(1 << 32) as u64;
        let broken = !exponent.is_integer();
        if whole >= 2 && self.seen.raise(base, (whole as u32).min(LARGE_POWER)) {
            self.total += (whole.ilog2() + whole.count_ones() - 1) as usize;
        }
        if broken && self.seen.raise(base, ROOT) {
            self.total += 1;
        }
        self.total += usize::from(broken && whole > 0);
    }
}
