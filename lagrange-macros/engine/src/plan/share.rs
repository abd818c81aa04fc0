//! Shared partial sums and products: the pair that occurs in most sums becomes a node of its own, again and again.
//!
//! The greedy pair extraction of algebraic factoring (R. Brayton, C. McMullen 1982, restricted to two operands):
//! each extraction of a pair found in n sums saves n − 1 operations and never costs one.

use super::graph::{Graph, NodeId, Shape, Term};
use crate::sorted::{SortedMap, SortedSet};
use crate::symbolic::{ExprId, Pool};
use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};

/// Sums and products longer than this are not searched for pairs (their number is quadratic).
const LONGEST: usize = 96;

/// A multiset of operands: for a sum ±1 per term, for a product the exponent.
type Bag<A> = SortedMap<A, i32>;

/// Two operands and the sign of the second relative to the first (+1 in products; there both may be one operand).
type Pair<A> = (A, A, i32);

/// Rewrites the graph below the roots with shared pairs.
pub(super) fn share(graph: &mut Graph, pool: &mut Pool, roots: &[NodeId]) {
    let one = pool.integer(1);
    flip_private_negations(graph, pool, roots);
    multiply_scales_in(graph, one, roots);
    let uses = graph.uses(roots);
    let (mut sums, mut products) = (SortedMap::new(), SortedMap::new());
    for (index, uses) in uses.iter().enumerate() {
        match graph.shape(NodeId(index)) {
            _ if *uses == 0 => {}
            Shape::Sum { terms, .. } if terms.len() <= LONGEST => {
                let bag = terms.iter().map(|term| {
                    (
                        (term.node, term.magnitude),
                        if term.negative { -1 } else { 1 },
                    )
                });
                sums.insert(NodeId(index), bag.collect::<Bag<_>>());
            }
            Shape::Product(factors) if factors.len() <= LONGEST => {
                products.insert(NodeId(index), factors.iter().copied().collect::<Bag<_>>());
            }
            _ => {}
        }
    }
    let whole = |graph: &Graph, id: NodeId| {
        !matches!(
            graph.shape(id),
            Shape::Sum {
                offset: Some(_),
                ..
            }
        )
    };
    extract(&mut sums, graph, &whole, &|node| (node, one), &sum_shape);
    extract(&mut products, graph, &whole, &|node| node, &product_shape);
}

/// Writes the bag as a sum with the offset that the node had.
fn sum_shape(bag: &Bag<(NodeId, ExprId)>, before: Option<&Shape>) -> Shape {
    let offset = match before {
        Some(Shape::Sum { offset, .. }) => *offset,
        _ => None,
    };
    let terms = bag.iter().map(|(&(node, magnitude), sign)| Term {
        node,
        magnitude,
        negative: *sign < 0,
    });
    Shape::Sum {
        offset,
        terms: terms.collect(),
    }
}

fn product_shape(bag: &Bag<NodeId>, _: Option<&Shape>) -> Shape {
    Shape::Product(
        bag.iter()
            .map(|(node, exponent)| (*node, *exponent))
            .collect(),
    )
}

/// −(a − b) is b − a, and −x (a − b) is x (b − a), where nobody else reads the difference.
fn flip_private_negations(graph: &mut Graph, pool: &mut Pool, roots: &[NodeId]) {
    let uses = graph.uses(roots);
    for index in 0..uses.len() {
        let Shape::Sum { offset, terms } = graph.shape(NodeId(index)) else {
            continue;
        };
        if uses[index] == 0
            || !terms
                .iter()
                .all(|term| term.negative && pool.is_one(term.magnitude))
        {
            continue;
        }
        let (offset, mut terms) = (*offset, terms.clone());
        let turned = terms
            .iter()
            .enumerate()
            .find_map(|(at, term)| Some((at, negative(graph, pool, &uses, term.node)?)));
        let turned = turned.filter(|(_, node)| terms.iter().all(|term| term.node != *node));
        if let Some((at, node)) = turned {
            terms[at] = Term {
                node,
                negative: false,
                ..terms[at]
            };
            terms.sort();
            graph.reshape(NodeId(index), Shape::Sum { offset, terms });
        }
    }
}

/// The negative of a node that is read once, if it costs nothing.
fn negative(graph: &mut Graph, pool: &mut Pool, uses: &[usize], node: NodeId) -> Option<NodeId> {
    if uses.get(node.0) != Some(&1) {
        return None;
    }
    match graph.shape(node).clone() {
        Shape::Sum { offset, terms } if terms.iter().any(|term| term.negative) => {
            let offset = offset.map(|offset| pool.neg(offset));
            let terms = terms
                .into_iter()
                .map(|term| Term {
                    negative: !term.negative,
                    ..term
                })
                .collect();
            Some(graph.node(Shape::Sum { offset, terms }))
        }
        Shape::Product(mut factors) => {
            let (at, factor) = factors.iter().enumerate().find_map(
                |(at, &(factor, exponent))| match exponent {
                    1 => Some((at, negative(graph, pool, uses, factor)?)),
                    _ => None,
                },
            )?;
            if factors.iter().any(|(other, _)| *other == factor) {
                return None;
            }
            factors[at].0 = factor;
            factors.sort();
            Some(graph.node(Shape::Product(factors)))
        }
        _ => None,
    }
}

/// A scaled term is a product with a fixed factor, so that k s can be shared by k s x and k s y.
fn multiply_scales_in(graph: &mut Graph, one: ExprId, roots: &[NodeId]) {
    let uses = graph.uses(roots);
    for (index, used) in uses.iter().enumerate() {
        let Shape::Sum { offset, terms } = graph.shape(NodeId(index)).clone() else {
            continue;
        };
        if *used == 0 || terms.iter().all(|term| term.magnitude == one) {
            continue;
        }
        let scaled = |term: Term| {
            let mut factors = match graph.shape(term.node) {
                _ if term.magnitude == one => return term,
                // c/x is one operation.
                Shape::Quotient {
                    numerator: None, ..
                } if uses[term.node.0] == 1 => return term,
                Shape::Product(factors) => factors.clone(),
                _ => vec![(term.node, 1)],
            };
            factors.push((graph.node(Shape::Fixed(term.magnitude)), 1));
            factors.sort();
            Term {
                node: graph.product(factors),
                magnitude: one,
                ..term
            }
        };
        let mut terms: Vec<Term> = terms.into_iter().map(scaled).collect();
        terms.sort();
        graph.reshape(NodeId(index), Shape::Sum { offset, terms });
    }
}

/// Which bags contain each pair, and the pairs by how many do.
struct Census<A> {
    holders: BTreeMap<Pair<A>, Holders>,
    ranked: BTreeSet<(Reverse<usize>, Pair<A>)>,
    /// Pairs whose rank may have changed since it was last settled.
    changed: Vec<Pair<A>>,
}

/// The bags that contain a pair.
#[derive(Default)]
struct Holders {
    bags: SortedSet<NodeId>,
    /// Their number when the pair was last ranked.
    ranked: usize,
    /// Whether it waits to be ranked again.
    changed: bool,
}

impl<A: Ord + Copy> Census<A> {
    fn count(&mut self, pair: Pair<A>, bag: NodeId, present: bool) {
        let holders = self.holders.entry(pair).or_default();
        match present {
            true => holders.bags.insert(bag),
            false => holders.bags.remove(&bag),
        };
        if !holders.changed {
            holders.changed = true;
            self.changed.push(pair);
        }
    }

    /// The pair that most bags contain, if there is one in several, with its bags.
    ///
    /// What taking out a pair changes is the same few pairs in all its bags: they are ranked once, here.
    fn most_held(&mut self) -> Option<(Pair<A>, SortedSet<NodeId>)> {
        for pair in self.changed.drain(..) {
            let Some(holders) = self.holders.get_mut(&pair) else {
                continue;
            };
            self.ranked.remove(&(Reverse(holders.ranked), pair));
            (holders.ranked, holders.changed) = (holders.bags.len(), false);
            match holders.ranked {
                0 => drop(self.holders.remove(&pair)),
                1 => {}
                several => drop(self.ranked.insert((Reverse(several), pair))),
            }
        }
        let (_, pair) = self.ranked.pop_first()?;
        Some((pair, self.holders[&pair].bags.clone()))
    }
}

/// All pairs of a bag.
fn pairs<A: Ord + Copy>(bag: &Bag<A>) -> Vec<Pair<A>> {
    let mut pairs = Vec::new();
    for (i, (&first, &m)) in bag.iter().enumerate() {
        if m >= 2 {
            pairs.push((first, first, 1));
        }
        for (&second, &n) in bag.iter().skip(i + 1) {
            pairs.push((first, second, m.signum() * n.signum()));
        }
    }
    pairs
}

/// Those of a bag's pairs in which one of the operands is.
fn pairs_with<A: Ord + Copy>(bag: &Bag<A>, operands: &[A]) -> Vec<Pair<A>> {
    let mut pairs = Vec::with_capacity(operands.len() * bag.len());
    for (at, operand) in operands.iter().enumerate() {
        let Some(&m) = bag.get(operand) else { continue };
        if m >= 2 {
            pairs.push((*operand, *operand, 1));
        }
        for (&other, &n) in bag {
            if other != *operand && !operands[..at].contains(&other) {
                let (first, second) = (other.min(*operand), other.max(*operand));
                pairs.push((first, second, m.signum() * n.signum()));
            }
        }
    }
    pairs
}

/// How often the pair can be taken from the bag; negative for its negation.
fn multiplicity<A: Ord + Copy>(bag: &Bag<A>, (first, second, sign): Pair<A>) -> i32 {
    let m = bag.get(&first).copied().unwrap_or(0);
    if first == second {
        return m / 2;
    }
    let n = bag.get(&second).copied().unwrap_or(0) * sign;
    if m.signum() != n.signum() {
        0
    } else {
        m.signum() * m.abs().min(n.abs())
    }
}

/// Takes the pair out of the bag `times` times and puts `operand` in its place.
fn replace<A: Ord + Copy>(
    bag: &mut Bag<A>,
    (first, second, sign): Pair<A>,
    times: i32,
    operand: A,
) {
    *bag.get_or_default(first) -= times;
    *bag.get_or_default(second) -= times * sign;
    *bag.get_or_default(operand) += times;
    bag.retain(|_, count| *count != 0);
}

fn extract<A: Ord + Copy>(
    bags: &mut SortedMap<NodeId, Bag<A>>,
    graph: &mut Graph,
    whole: &dyn Fn(&Graph, NodeId) -> bool,
    operand: &dyn Fn(NodeId) -> A,
    shape: &dyn Fn(&Bag<A>, Option<&Shape>) -> Shape,
) {
    let mut census = Census {
        holders: BTreeMap::new(),
        ranked: BTreeSet::new(),
        changed: Vec::new(),
    };
    for (&id, bag) in bags.iter() {
        for pair in pairs(bag) {
            census.count(pair, id, true);
        }
    }
    while let Some((pair, holders)) = census.most_held() {
        let mut own = Bag::new();
        replace_into(&mut own, pair);
        // A bag that is just this pair is the node that the others use.
        let exact = holders
            .iter()
            .find(|id| bags[id] == own && whole(graph, **id))
            .copied();
        let node = exact.unwrap_or_else(|| graph.node(shape(&own, None)));
        for id in holders {
            let bag = bags.get_mut(&id).expect("holders are bags");
            let times = multiplicity(bag, pair);
            let mut changing = vec![pair.0, pair.1, operand(node)];
            changing.dedup();
            for old in pairs_with(bag, &changing) {
                census.count(old, id, false);
            }
            if id != node && times != 0 && !bag.contains_key(&operand(node)) {
                replace(bag, pair, times, operand(node));
                graph.reshape(id, shape(bag, Some(&graph.shape(id).clone())));
            }
            if id != node {
                let new = pairs_with(bag, &changing).into_iter();
                for new in new.filter(|new| *new != pair) {
                    census.count(new, id, true);
                }
            }
        }
    }
}

fn replace_into<A: Ord + Copy>(bag: &mut Bag<A>, (first, second, sign): Pair<A>) {
    *bag.get_or_default(first) += 1;
    *bag.get_or_default(second) += sign;
}
