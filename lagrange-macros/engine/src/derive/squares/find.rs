//! Squares and products of velocities in the form of a kinetic energy.

use super::ByCoordinate;
use super::nested::{Terms, terms};
use crate::derive::forms::Variables;
use crate::sorted::SortedMap;
use crate::symbolic::{ExprId, Node, Pool, Rational, Symbol};

/// c w u: what an energy is a sum of. A square has u = w.
pub(super) struct Term {
    pub factor: ExprId,
    pub velocities: [ExprId; 2],
}

/// The squares and products of two velocities that an energy is the sum of.
pub(super) fn terms_of_energy(
    pool: &mut Pool,
    x: &Variables,
    kinetic: ExprId,
) -> Option<Vec<Term>> {
    let mut found = Vec::new();
    let mut open = vec![(x.one, kinetic)];
    while let Some((c, e)) = open.pop() {
        match pool.node(e).clone() {
            Node::Sum { constant, terms } if constant.is_zero() => {
                for (term, number) in terms.into_iter().rev() {
                    open.push((pool.scale(c, number), term));
                }
            }
            Node::Product(factors) => {
                let (varying, fixed): (Vec<_>, Vec<_>) =
                    (factors.into_iter()).partition(|&(base, _)| x.changes(pool, base));
                let fixed = pool.monomial(Rational::ONE, &fixed);
                let factor = pool.mul(c, fixed);
                if let [(sum, power)] = varying[..]
                    && power.is_one()
                {
                    open.push((factor, sum));
                    continue;
                }
                let velocities = velocities(pool, x, varying)?;
                found.push(Term { factor, velocities });
            }
            _ => return None,
        }
    }
    Some(found)
}

/// The two velocities whose product this is, the same twice in a square.
fn velocities(
    pool: &mut Pool,
    x: &Variables,
    factors: Vec<(ExprId, Rational)>,
) -> Option<[ExprId; 2]> {
    let half = |&(base, power): &(ExprId, Rational)| {
        let half = power.checked_mul(Rational::HALF)?;
        half.is_integer().then_some((base, half))
    };
    let root: Option<Vec<_>> = factors.iter().map(half).collect();
    if let Some(root) = root {
        let w = pool.monomial(Rational::ONE, &root);
        return Some([w, w]);
    }
    let moves = |&(base, _): &(ExprId, Rational)| pool.depends_on_any(base, &x.velocities);
    let (moving, mut places): (Vec<_>, Vec<_>) = factors.into_iter().partition(moves);
    let [one, other] = match moving[..] {
        [(one, power)] if power == Rational::integer(2) => [one, one],
        [(one, first), (other, second)] if first.is_one() && second.is_one() => [one, other],
        _ => return None,
    };
    // What depends on positions goes with one of them.
    places.push((one, Rational::ONE));
    Some([pool.monomial(Rational::ONE, &places), other])
}

/// (j, ∂w/∂vⱼ) of a velocity that is linear and homogeneous in v by its form.
pub(super) fn slopes(
    pool: &mut Pool,
    x: &Variables,
    velocities: &SortedMap<Symbol, usize>,
    w: ExprId,
) -> Option<ByCoordinate> {
    let mut parts: SortedMap<usize, Terms> = SortedMap::new();
    for (term, number) in terms(pool, w) {
        let factors = match pool.node(term) {
            Node::Product(factors) => factors.clone(),
            Node::Symbol(_) => vec![(term, Rational::ONE)],
            _ => return None,
        };
        let mut rest = Vec::with_capacity(factors.len());
        let mut moving = None;
        for (base, power) in factors {
            let velocity = match pool.node(base) {
                Node::Symbol(symbol) => velocities.get(symbol),
                _ if pool.depends_on_any(base, &x.velocities) => return None,
                _ => None,
            };
            match velocity {
                Some(&j) if power.is_one() && moving.is_none() => moving = Some(j),
                Some(_) => return None,
                None => rest.push((base, power)),
            }
        }
        let rest = pool.monomial(Rational::ONE, &rest);
        parts.get_or_default(moving?).push((rest, number));
    }
    let slopes = parts
        .into_iter()
        .map(|(j, terms)| (j, pool.linear(Rational::ZERO, terms)));
    Some(slopes.filter(|&(_, slope)| slope != x.zero).collect())
}

/// (j, ∂w/∂vⱼ) of a velocity in which others are kept whole, if it is linear and homogeneous in v, ascending.
pub(super) fn slopes_of_whole(pool: &mut Pool, x: &Variables, w: ExprId) -> Option<ByCoordinate> {
    let at_rest = x.at_rest(pool, w);
    let mut slopes = Vec::new();
    for j in x.velocities_in(pool, w) {
        let slope = pool.differentiate(w, x.velocities[j]);
        if pool.depends_on_any(slope, &x.velocities) {
            return None;
        }
        slopes.push((j, slope));
    }
    pool.is_zero(at_rest).then_some(slopes)
}
