//! The axes of a body are at right angles and of length 1, and each is the cross product of the other two.
//!
//! Rates about the axes do not need this, but a point that a body carries brings it in: of |v|² = Σⱼ (ω₁ e₀ⱼ − ω₀ e₁ⱼ)² a textbook
//! writes ω₀² + ω₁². In sums that are multiplied out, terms that together are such a product are replaced by what it is.

use super::readable::Reader;
use crate::derive::Equations;
use crate::model::Body;
use crate::sorted::SortedMap;
use crate::symbolic::{ExprId, Node, Pool, Rational, Symbol};

/// Sums that would have more terms are not multiplied out: three components of two axes each, squared, with two velocities are a hundred.
const MOST_TERMS: usize = 512;

/// Products of two components each, with their signs, whose sum is known.
struct Rule {
    products: Vec<(bool, [ExprId; 2])>,
    value: ExprId,
}

/// Puts what is known of axes into all outputs, as they are read.
pub(super) fn reduce(equations: &mut Equations, reader: &mut Reader) {
    let bodies = &equations.system.bodies;
    let axes: Vec<Symbol> = bodies.iter().flat_map(|b| b.axes).flatten().collect();
    let rules: Vec<Rule> = bodies
        .iter()
        .flat_map(|body| rules(body, reader.pool()))
        .collect();
    let outputs = equations.outputs.iter_mut();
    for (_, term) in outputs.flat_map(|output| &mut output.terms) {
        if !reader.peek().depends_on_any(*term, &axes) {
            continue;
        }
        let open = without_groups(reader.pool(), *term);
        if let Some(flat) = reader.multiplied_out_within(MOST_TERMS, open)
            && let Some(reduced) = reduced(reader.pool(), flat, &rules)
        {
            *term = reduced;
        }
    }
}

/// A sum with the sums that stand in it as groups opened: the Jacobi integral is the sum of two.
fn without_groups(pool: &mut Pool, e: ExprId) -> ExprId {
    let Node::Sum { constant, terms } = pool.node(e).clone() else {
        return e;
    };
    let open = |&(term, c): &(ExprId, Rational)| match pool.node(term) {
        Node::Group(inner) => (*inner, c),
        _ => (term, c),
    };
    let terms = terms.iter().map(open).collect();
    pool.linear(constant, terms)
}

/// What holds among the components of the axes of a body, and of those of the axes of space in the body.
fn rules(body: &Body, pool: &mut Pool) -> Vec<Rule> {
    let e = body.axes.map(|axis| axis.map(|symbol| pool.leaf(symbol)));
    let [zero, one] = [pool.integer(0), pool.integer(1)];
    let mut rules = Vec::new();
    for i in 0..3 {
        for j in 0..=i {
            let value = if i == j { one } else { zero };
            let of_axes = (0..3).map(|k| (false, [e[i][k], e[j][k]])).collect();
            let of_space = (0..3).map(|k| (false, [e[k][i], e[k][j]])).collect();
            rules.extend([of_axes, of_space].map(|products| Rule { products, value }));
        }
        let (a, b) = (e[(i + 1) % 3], e[(i + 2) % 3]);
        for (k, value) in e[i].into_iter().enumerate() {
            let (next, last) = ((k + 1) % 3, (k + 2) % 3);
            let products = vec![(false, [a[next], b[last]]), (true, [a[last], b[next]])];
            rules.push(Rule { products, value });
        }
    }
    rules
}

/// A sum with what the rules say of it; none where they say nothing.
fn reduced(pool: &mut Pool, flat: ExprId, rules: &[Rule]) -> Option<ExprId> {
    let Node::Sum { constant, terms } = pool.node(flat).clone() else {
        return None;
    };
    let mut left: SortedMap<ExprId, Rational> = SortedMap::new();
    left.extend(terms.iter().copied());
    let mut found = Vec::new();
    for &(term, _) in &terms {
        for rule in rules {
            let Some(&size) = left.get(&term) else {
                break;
            };
            let Some(rest) = without(pool, term, rule.products[0].1) else {
                continue;
            };
            let with = |pool: &mut Pool, factors: &[ExprId]| {
                let factors = factors.iter().map(|&e| (e, Rational::ONE));
                let all: Vec<_> = rest.iter().copied().chain(factors).collect();
                pool.monomial(Rational::ONE, &all)
            };
            let partners = rule.products.iter();
            let partners: Vec<_> = partners.map(|(s, pair)| (*s, with(pool, pair))).collect();
            let signed = |minus: bool| match minus {
                true => size.checked_neg(),
                false => Some(size),
            };
            let mut all = partners.iter();
            if all.all(|(minus, e)| left.get(e).copied() == signed(*minus)) {
                for (_, e) in &partners {
                    left.remove(e);
                }
                found.push((with(pool, &[rule.value]), size));
            }
        }
    }
    if found.is_empty() {
        return None;
    }
    let whole = pool.linear(constant, left.into_iter().chain(found).collect());
    // What was found may be part of a product in turn.
    Some(reduced(pool, whole, rules).unwrap_or(whole))
}

/// The factors of a term without these two; none if they are not among them.
fn without(pool: &Pool, term: ExprId, pair: [ExprId; 2]) -> Option<Vec<(ExprId, Rational)>> {
    let Node::Product(factors) = pool.node(term) else {
        return None;
    };
    let mut factors = factors.clone();
    for e in pair {
        let at = factors.iter().position(|&(base, _)| base == e)?;
        let (_, exponent) = factors[at];
        if !exponent.is_integer() || exponent.is_negative() {
            return None;
        }
        match exponent.is_one() {
            true => drop(factors.remove(at)),
            false => factors[at].1 = exponent.checked_sub(Rational::ONE)?,
        }
    }
    Some(factors)
}
