//! Fixed factors of sums go where they cost least: k (a x + b y) becomes (k a) x + (k b) y, whose coefficients the
//! constants program computes; k (x + y) stays.
//!
//! The scale of a sum that one node reads is moved to its terms unless more than one of them has no coefficient
//! yet; the terms join those of a sum around it.

use super::constants::Constants;
use super::graph::{Graph, NodeId, Shape, Term};
use crate::sorted::SortedMap;
use crate::symbolic::{ExprId, Pool};

/// Rewrites the sums below the roots.
pub(super) fn distribute(
    graph: &mut Graph,
    pool: &mut Pool,
    constants: &Constants,
    roots: &[NodeId],
) {
    let uses = graph.uses(roots);
    // Operands have smaller ids: inner sums are settled first.
    for (index, used) in uses.iter().enumerate() {
        let id = NodeId(index);
        let Shape::Sum { offset, terms } = graph.shape(id).clone() else {
            continue;
        };
        if *used == 0 {
            continue;
        }
        let opaque = offset.is_some_and(|offset| constants.is_masked(pool, offset));
        let mut flat = Flat {
            offset: offset.into_iter().collect(),
            scales: SortedMap::new(),
        };
        let mut changed = false;
        for term in terms {
            let scale = if term.negative {
                pool.neg(term.magnitude)
            } else {
                term.magnitude
            };
            match graph.shape(term.node) {
                Shape::Sum {
                    offset: inner,
                    terms,
                } if uses[term.node.0] == 1
                    && !(opaque && inner.is_some())
                    && joins(pool, scale, terms) =>
                {
                    flat.offset
                        .extend(inner.map(|inner| pool.mul(scale, inner)));
                    for term in terms {
                        let inner = if term.negative {
                            pool.neg(scale)
                        } else {
                            scale
                        };
                        let scale = pool.mul(inner, term.magnitude);
                        flat.scales.get_or_default(term.node).push(scale);
                    }
                    changed = true;
                }
                _ => flat.scales.get_or_default(term.node).push(scale),
            }
        }
        if changed {
            graph.reshape(id, flat.into_shape(pool));
        }
    }
}

/// A sum under construction: offsets, and the scales of each node.
struct Flat {
    offset: Vec<ExprId>,
    scales: SortedMap<NodeId, Vec<ExprId>>,
}

impl Flat {
    fn into_shape(self, pool: &mut Pool) -> Shape {
        let offset = pool.sum(&self.offset);
        let mut terms = Vec::with_capacity(self.scales.len());
        for (node, scales) in self.scales {
            let scale = pool.sum(&scales);
            if !pool.is_zero(scale) {
                let (negative, magnitude) = super::form::magnitude(pool, scale);
                terms.push(Term {
                    node,
                    magnitude,
                    negative,
                });
            }
        }
        if terms.is_empty() {
            return Shape::Fixed(offset);
        }
        Shape::Sum {
            offset: (!pool.is_zero(offset)).then_some(offset),
            terms,
        }
    }
}

/// Whether the terms of an inner sum may take its scale over without costing an operation.
fn joins(pool: &Pool, scale: ExprId, terms: &[Term]) -> bool {
    let unit = pool.as_number(scale).is_some_and(|number| number.is_unit());
    unit || terms
        .iter()
        .filter(|term| pool.is_one(term.magnitude))
        .count()
        == 0
}
