//! Sums: a common fixed factor goes outside where that costs nothing, equal coefficients are taken together.

use super::Former;
use crate::plan::graph::{Form, NodeId, Shape, Term};
use crate::sorted::SortedMap;
use crate::symbolic::{ExprId, Node, Rational};

impl Former<'_> {
    pub(super) fn sum(&mut self, constant: Rational, terms: &[(ExprId, Rational)]) -> Form {
        let mut offsets = vec![self.pool.number(constant)];
        let mut scales: SortedMap<NodeId, Vec<ExprId>> = SortedMap::new();
        for &(term, coefficient) in terms {
            let form = self.form(term);
            let scale = self.pool.scale(form.scale, coefficient);
            match form.node {
                Some(node) => scales.get_or_default(node).push(scale),
                None => offsets.push(scale),
            }
        }
        let offset = self.pool.sum(&offsets);
        let mut terms: Vec<(NodeId, ExprId)> = Vec::with_capacity(scales.len());
        for (node, scales) in scales {
            let scale = self.pool.sum(&scales);
            if !self.pool.is_zero(scale) {
                terms.push((node, scale));
            }
        }
        match terms[..] {
            [] => {
                return Form {
                    scale: offset,
                    node: None,
                };
            }
            [(node, scale)] if self.pool.is_zero(offset) => {
                return Form {
                    scale,
                    node: Some(node),
                };
            }
            _ => {}
        }
        let outside = self.common_factor(&terms, offset);
        let (offset, terms) = self.divided(offset, &terms, outside);
        let node = self.grouped(offset, terms);
        Form {
            scale: outside,
            node: Some(node),
        }
    }

    /// Divides a sum by a factor that is not zero.
    fn divided(
        &mut self,
        offset: ExprId,
        terms: &[(NodeId, ExprId)],
        factor: ExprId,
    ) -> (Option<ExprId>, Vec<Term>) {
        let offset = (!self.pool.is_zero(offset)).then(|| self.quotient(offset, factor));
        let mut signed = Vec::with_capacity(terms.len());
        for &(node, scale) in terms {
            let scale = self.quotient(scale, factor);
            let (negative, magnitude) = self.magnitude(scale);
            signed.push(Term {
                node,
                magnitude,
                negative,
            });
        }
        (offset, signed)
    }

    /// Terms with the same magnitude become one sum, scaled once.
    fn grouped(&mut self, offset: Option<ExprId>, terms: Vec<Term>) -> NodeId {
        let one = self.pool.integer(1);
        let mut groups: SortedMap<ExprId, Vec<Term>> = SortedMap::new();
        for term in terms {
            groups.get_or_default(term.magnitude).push(term);
        }
        let mut terms = Vec::new();
        for (magnitude, group) in groups {
            if magnitude == one || group.len() == 1 {
                terms.extend(group);
                continue;
            }
            let flip = mostly_negative(&group);
            let inner = group.iter().map(|term| Term {
                magnitude: one,
                negative: term.negative != flip,
                ..*term
            });
            let inner = Shape::Sum {
                offset: None,
                terms: inner.collect(),
            };
            terms.push(Term {
                node: self.graph.node(inner),
                magnitude,
                negative: flip,
            });
        }
        terms.sort();
        self.graph.node(Shape::Sum { offset, terms })
    }

    /// A signed factor of all terms and the offset, such that at least one term is ±1 after division by it, so that
    /// taking it out costs nothing; 1 or −1 if there is none.
    fn common_factor(&mut self, terms: &[(NodeId, ExprId)], offset: ExprId) -> ExprId {
        let mut parts: Vec<(Rational, SortedMap<ExprId, Rational>)> = terms
            .iter()
            .map(|(_, scale)| self.factors(*scale))
            .collect();
        let numbers: Vec<Rational> = parts.iter().map(|(number, _)| absolute(*number)).collect();
        if !self.pool.is_zero(offset) {
            parts.push(self.factors(offset));
        }
        let mut common = parts[0].1.clone();
        for (_, factors) in &parts[1..] {
            common.retain(|base, exponent| match factors.get(base) {
                Some(other) if other.numerator().signum() == exponent.numerator().signum() => {
                    if absolute(*other) < absolute(*exponent) {
                        *exponent = *other;
                    }
                    true
                }
                _ => false,
            });
        }
        // The number that turns most of the terms into ±1.
        let bare = numbers
            .iter()
            .zip(&parts)
            .filter(|(_, (_, factors))| *factors == common)
            .map(|(n, _)| *n);
        let mut votes: SortedMap<Rational, usize> = SortedMap::new();
        for number in bare {
            *votes.get_or_default(number) += 1;
        }
        // A quotient that outgrows exact numbers is worth nothing.
        let divides = |number: Rational| {
            let mut all = parts.iter();
            all.all(|(n, _)| n.checked_div(number).is_some())
        };
        let mut best: Option<(Rational, usize)> = None;
        for (number, count) in votes {
            if best.is_none_or(|(_, most)| count > most) && divides(number) {
                best = Some((number, count));
            }
        }
        let mut factors = Vec::new();
        if let Some((number, _)) = best {
            factors.push(self.pool.number(number));
            for (base, exponent) in common {
                factors.push(self.power(base, exponent));
            }
        }
        let signed: Vec<Term> = terms
            .iter()
            .map(|(node, scale)| {
                let (negative, magnitude) = self.magnitude(*scale);
                Term {
                    node: *node,
                    magnitude,
                    negative,
                }
            })
            .collect();
        if mostly_negative(&signed) {
            factors.push(self.pool.integer(-1));
        }
        self.pool.product(&factors)
    }

    /// A fixed expression as number · Π baseᵉ.
    fn factors(&mut self, e: ExprId) -> (Rational, SortedMap<ExprId, Rational>) {
        let one = Rational::ONE;
        match self.pool.node(e).clone() {
            Node::Number(number) => (number, SortedMap::new()),
            Node::Sum { constant, terms } if constant.is_zero() && terms.len() == 1 => {
                let (_, factors) = self.factors(terms[0].0);
                (terms[0].1, factors)
            }
            Node::Product(factors) => (one, factors.into_iter().collect()),
            _ => (one, SortedMap::from([(e, one)])),
        }
    }

    fn quotient(&mut self, e: ExprId, factor: ExprId) -> ExprId {
        self.pool
            .div(e, factor)
            .expect("a common factor is not zero")
    }
}

/// Whether more terms are negative than positive; the first decides a tie.
fn mostly_negative(terms: &[Term]) -> bool {
    let negative = terms.iter().filter(|term| term.negative).count();
    match (2 * negative).cmp(&terms.len()) {
        std::cmp::Ordering::Equal => terms[0].negative,
        order => order.is_gt(),
    }
}

fn absolute(number: Rational) -> Rational {
    if number.is_negative() {
        number.checked_neg().unwrap_or(number)
    } else {
        number
    }
}
