//! Sums: constant + Σ cᵢ termᵢ with like terms collected.

use super::{ExprId, Node, Pool, Rational};

impl Pool {
    /// Σ
    pub fn sum(&mut self, terms: &[ExprId]) -> ExprId {
        let terms = terms.iter().map(|&e| (e, Rational::ONE)).collect();
        self.linear(Rational::ZERO, terms)
    }

    /// a + b
    pub fn add(&mut self, a: ExprId, b: ExprId) -> ExprId {
        self.linear(Rational::ZERO, vec![(a, Rational::ONE), (b, Rational::ONE)])
    }

    /// a − b
    pub fn sub(&mut self, a: ExprId, b: ExprId) -> ExprId {
        self.linear(
            Rational::ZERO,
            vec![(a, Rational::ONE), (b, Rational::MINUS_ONE)],
        )
    }

    /// −a
    pub fn neg(&mut self, a: ExprId) -> ExprId {
        self.scale(a, Rational::MINUS_ONE)
    }

    /// c a
    pub fn scale(&mut self, a: ExprId, c: Rational) -> ExprId {
        if c.is_one() {
            return a;
        }
        match self.node(a) {
            Node::Number(n) => {
                let n = *n;
                let n = self.times(n, c);
                self.number(n)
            }
            // Scaling keeps terms distinct and sorted.
            Node::Sum { constant, terms } if !c.is_zero() => {
                let constant = *constant;
                let mut terms = terms.clone();
                for term in &mut terms {
                    term.1 = self.times(term.1, c);
                }
                let constant = self.times(constant, c);
                self.intern_sum(constant, terms)
            }
            _ if c.is_zero() => self.integer(0),
            _ => self.intern_sum(Rational::ZERO, vec![(a, c)]),
        }
    }

    /// constant + Σ cᵢ eᵢ of any expressions: c₀, (eᵢ, cᵢ).
    pub fn linear(&mut self, constant: Rational, terms: Vec<(ExprId, Rational)>) -> ExprId {
        let mut constant = constant;
        let mut flat = terms;
        if flat
            .iter()
            .any(|&(e, _)| matches!(self.node(e), Node::Sum { .. } | Node::Number(_)))
        {
            let given = std::mem::take(&mut flat);
            for (e, c) in given {
                constant = self.append(constant, &mut flat, e, c);
            }
        }
        flat.sort_by_key(|&(e, _)| e);
        self.collect(&mut flat);
        if flat.iter().any(|&(e, _)| self.has_square(e)) {
            constant = self.reduce_squares(constant, &mut flat);
        }
        self.intern_sum(constant, flat)
    }

    /// Adds c·e to a list of terms, and returns the constant with its part of e.
    pub(super) fn append(
        &mut self,
        constant: Rational,
        flat: &mut Vec<(ExprId, Rational)>,
        e: ExprId,
        c: Rational,
    ) -> Rational {
        match self.node(e) {
            Node::Number(n) => {
                let n = *n;
                let n = self.times(n, c);
                self.plus(constant, n)
            }
            Node::Sum {
                constant: inner,
                terms,
            } => {
                let inner = *inner;
                let from = flat.len();
                flat.extend_from_slice(terms);
                if !c.is_one() {
                    for term in &mut flat[from..] {
                        term.1 = self.times(term.1, c);
                    }
                }
                let inner = self.times(inner, c);
                self.plus(constant, inner)
            }
            _ => {
                flat.push((e, c));
                constant
            }
        }
    }

    /// Merges neighbours with equal first elements by adding the second, and drops zeros. Also for exponents.
    pub(super) fn collect(&mut self, list: &mut Vec<(ExprId, Rational)>) {
        let mut kept = 0;
        let mut at = 0;
        while at < list.len() {
            let (e, mut c) = list[at];
            at += 1;
            while at < list.len() && list[at].0 == e {
                c = self.plus(c, list[at].1);
                at += 1;
            }
            if !c.is_zero() {
                list[kept] = (e, c);
                kept += 1;
            }
        }
        list.truncate(kept);
    }

    /// A sum of terms that are collected already.
    pub(super) fn intern_sum(
        &mut self,
        constant: Rational,
        terms: Vec<(ExprId, Rational)>,
    ) -> ExprId {
        if terms.is_empty() {
            return self.number(constant);
        }
        if constant.is_zero() && terms.len() == 1 && terms[0].1.is_one() {
            return terms[0].0;
        }
        self.intern(Node::Sum { constant, terms })
    }

    /// Whether the canonical sign of e is the other one: its first coefficient is negative.
    pub(super) fn leads_negative(&self, e: ExprId) -> bool {
        match self.node(e) {
            Node::Number(n) => n.is_negative(),
            Node::Sum { terms, .. } => terms[0].1.is_negative(),
            _ => false,
        }
    }

    /// A sum as (content, sum/content), so that multiples of a sum share one factor. The content is the most
    /// frequent size of a coefficient (of equals the smallest), which leaves most coefficients 1; its sign makes
    /// the first coefficient positive. Any choice that scales with the sum would do.
    pub(super) fn primitive_part(&mut self, sum: ExprId) -> (Rational, ExprId) {
        if let Some(&known) = self.primitive.get(&sum) {
            return known;
        }
        let Node::Sum { constant, terms } = self.node(sum) else {
            return (Rational::ONE, sum);
        };
        let (constant, negative) = (*constant, terms[0].1.is_negative());
        let mut sizes: Vec<Rational> = terms.iter().map(|&(_, c)| c).collect();
        if !constant.is_zero() {
            sizes.push(constant);
        }
        for size in &mut sizes {
            *size = self.checked(size.checked_abs());
        }
        sizes.sort();
        let (mut content, mut most, mut at) = (sizes[0], 0, 0);
        while at < sizes.len() {
            let count = sizes[at..]
                .iter()
                .take_while(|&&size| size == sizes[at])
                .count();
            if count > most {
                (content, most) = (sizes[at], count);
            }
            at += count;
        }
        if negative {
            content = self.negative(content);
        }
        let inverse = self.checked(Rational::ONE.checked_div(content));
        let part = self.scale(sum, inverse);
        self.primitive.insert(sum, (content, part));
        (content, part)
    }
}
