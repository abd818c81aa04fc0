//! Sums that contain each other: each made of the longest shorter one.

use crate::symbolic::{ExprId, Node, Pool, Rational};

/// A sum as (term, number), ascending.
pub(super) type Terms = Vec<(ExprId, Rational)>;

/// How many shorter sums are looked at for one that a sum contains.
const TRIES: usize = 16;

/// e as a sum.
pub(super) fn terms(pool: &Pool, e: ExprId) -> Terms {
    match pool.node(e) {
        Node::Sum { constant, terms } if constant.is_zero() => terms.clone(),
        Node::Number(number) if number.is_zero() => Vec::new(),
        _ => vec![(e, Rational::ONE)],
    }
}

/// The sums, each made of the longest shorter one that it contains.
pub(super) fn nested(pool: &mut Pool, lists: &[Terms]) -> Vec<ExprId> {
    let mut order: Vec<usize> = (0..lists.len()).collect();
    order.sort_by_key(|&k| lists[k].len());
    let mut sums = vec![pool.integer(0); lists.len()];
    let mut made: Vec<usize> = Vec::new();
    for k in order {
        let list = &lists[k];
        let inner = made.iter().rev().take(TRIES).copied();
        let inner = inner
            .filter(|&inner| lists[inner].len() > 1)
            .find_map(|inner| Some((inner, remainder(list, &lists[inner])?)));
        sums[k] = match inner {
            Some((inner, rest)) if rest.is_empty() => sums[inner],
            Some((inner, mut rest)) => {
                rest.push((pool.group_sum(sums[inner]), Rational::ONE));
                pool.linear(Rational::ZERO, rest)
            }
            None => pool.linear(Rational::ZERO, list.clone()),
        };
        made.push(k);
    }
    sums
}

/// What a sum has beside another one, if it contains it.
fn remainder(list: &Terms, inner: &Terms) -> Option<Terms> {
    let mut rest = Vec::with_capacity(list.len() - inner.len());
    let mut inner = inner.iter().peekable();
    for term in list {
        if inner.peek() == Some(&term) {
            inner.next();
        } else {
            rest.push(*term);
        }
    }
    inner.next().is_none().then_some(rest)
}
