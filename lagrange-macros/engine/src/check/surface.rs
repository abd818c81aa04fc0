//! The positions of a mode as a surface: equations solved one after the other, each for one symbol.
//!
//! A symbol is chosen that makes the solution simple: a coordinate that occurs alone (r = R + a), a field that occurs
//! linearly (the lengths of a closed linkage), a coordinate that does, and last the roots of a quadratic equation (l of
//! x² + y² = l²; fields are positive). What no coordinate occurs in may be solved for the time. Every solution is
//! then a rational map (with roots) from free symbols onto the surface, so a random point of these is a random point of it.

use super::mechanics::Mechanics;
use super::motion::Tie;
use crate::model::Premise;
use crate::sorted::SortedSet;
use crate::symbolic::{ExprId, Function, Node, Pool, Rational, Symbol};

/// What solving has come to.
pub(super) enum Surface {
    /// All sheets of the surface.
    Sheets(Vec<Sheet>),
    /// There are no such positions.
    Empty,
    /// An equation could not be solved: why.
    Unsolved(String),
}

/// One sheet.
#[derive(Clone, Default)]
pub(super) struct Sheet {
    /// Solved symbols in the remaining ones.
    pub solved: Vec<(Symbol, ExprId)>,
    /// Rows on position level that were not already implied by the others.
    pub positions: Vec<usize>,
}

/// More sheets are not followed.
const MOST_SHEETS: usize = 16;

/// Conditions that are affine in the velocities, as rows.
pub(super) fn ties(pool: &mut Pool, mechanics: &Mechanics, premises: &[Premise]) -> Vec<Tie> {
    let velocities: Vec<Symbol> = mechanics.coordinates.iter().map(|q| q[1]).collect();
    let mut ties = Vec::new();
    for premise in premises {
        if let Premise::Zero(e) = *premise
            && pool.depends_on_any(e, &velocities)
            && let Some((coefficients, _)) = pool.coefficients_linear(e, &velocities)
        {
            let jacobian = coefficients.into_iter().enumerate();
            let jacobian = jacobian.filter(|&(_, c)| !pool.is_zero(c)).collect();
            ties.push(Tie { jacobian, whole: e });
        }
    }
    ties
}

/// Solves the position equations of active rows, and what the conditions say beside their ties.
pub(super) fn surface(
    pool: &mut Pool,
    mechanics: &Mechanics,
    active: &[usize],
    premises: &[Premise],
    claims: &[ExprId],
) -> Surface {
    let velocities: Vec<Symbol> = mechanics.coordinates.iter().map(|q| q[1]).collect();
    let mut equations: Vec<(Option<usize>, ExprId)> = active
        .iter()
        .filter_map(|&row| Some((Some(row), mechanics.rows[row].position?)))
        .collect();
    for premise in premises {
        if let Premise::Zero(e) = *premise {
            let moves = pool.depends_on_any(e, &velocities);
            if !moves || pool.coefficients_linear(e, &velocities).is_none() {
                equations.push((None, e));
            }
        }
    }
    let mut all = mechanics.expressions();
    all.extend(claims);
    all.extend(equations.iter().map(|&(_, e)| e));
    let angular = angular(pool, &all);
    let mut sheets = vec![Sheet::default()];
    for (row, equation) in equations {
        let mut next = Vec::new();
        for sheet in sheets {
            let e = pool.substitute(equation, &sheet.solved);
            let e = pool.expand(e);
            let e = pool.simplify(e);
            if pool.vanishes(e) {
                next.push(sheet);
                continue;
            }
            let places = mechanics.coordinates.iter().map(|q| q[0]);
            let places: Vec<Symbol> = places.collect();
            if row.is_some() && !pool.depends_on_any(e, &places) {
                continue;
            }
            let solved =
                primitive(pool, mechanics, e).and_then(|e| solution(pool, mechanics, e, &angular));
            let Some((symbol, roots)) = solved else {
                let text = pool.print(equation);
                return Surface::Unsolved(format!("`{text} = 0` could not be solved exactly"));
            };
            for root in roots {
                let mut sheet = sheet.clone();
                for (_, known) in &mut sheet.solved {
                    *known = pool.substitute(*known, &[(symbol, root)]);
                }
                sheet.solved.push((symbol, root));
                sheet.positions.extend(row);
                next.push(sheet);
            }
        }
        if next.len() > MOST_SHEETS {
            return Surface::Unsolved("its positions have too many branches".to_owned());
        }
        sheets = next;
    }
    if sheets.is_empty() {
        return Surface::Empty;
    }
    for sheet in &sheets {
        if let Some(reason) = circular(pool, mechanics, active, &sheet.solved, &velocities) {
            return Surface::Unsolved(reason);
        }
    }
    Surface::Sheets(sheets)
}

/// A symbol that is solved in terms of velocities must not be needed to find them.
fn circular(
    pool: &Pool,
    mechanics: &Mechanics,
    active: &[usize],
    solved: &[(Symbol, ExprId)],
    velocities: &[Symbol],
) -> Option<String> {
    let moving = solved
        .iter()
        .filter(|&&(_, e)| pool.depends_on_any(e, velocities));
    for &(symbol, _) in moving {
        let needed = active.iter().any(|&row| {
            let row = &mechanics.rows[row];
            let jacobian = row.jacobian.iter().map(|&(_, e)| e);
            let mut all = jacobian.chain([row.velocity]);
            all.any(|e| pool.depends_on(e, symbol))
        });
        if needed {
            let name = pool.name(symbol);
            return Some(format!(
                "the condition ties `{name}` to velocities that depend on it"
            ));
        }
    }
    None
}

/// Symbols inside the arguments of circular functions and exponentials: best left free.
fn angular(pool: &Pool, all: &[ExprId]) -> SortedSet<Symbol> {
    let mut arguments = Vec::new();
    for e in pool.iter_reachable(all) {
        if let Node::Call(f, list) = pool.node(e)
            && !matches!(
                f,
                Function::Asin | Function::Acos | Function::Atan | Function::Atan2
            )
        {
            arguments.extend(list);
        }
    }
    let reachable = pool.iter_reachable(&arguments);
    let symbols = reachable.into_iter().filter_map(|e| match pool.node(e) {
        Node::Symbol(symbol) => Some(*symbol),
        _ => None,
    });
    symbols.collect()
}

/// e without factors that do not vanish: fields, and whatever stands in a denominator. None if it has several other
/// factors: it vanishes where one of them does, and solving it would miss the rest of the surface, or give just that.
fn primitive(pool: &mut Pool, mechanics: &Mechanics, e: ExprId) -> Option<ExprId> {
    let terms: Vec<ExprId> = match pool.node(e) {
        Node::Sum { constant, terms } if constant.is_zero() => {
            terms.iter().map(|&(term, _)| term).collect()
        }
        Node::Sum { .. } => return Some(e),
        _ => vec![e],
    };
    let factors = |pool: &Pool, e: ExprId| match pool.node(e) {
        Node::Product(factors) => factors.clone(),
        _ => vec![(e, Rational::ONE)],
    };
    let mut common = factors(pool, *terms.first()?);
    for &term in &terms[1..] {
        let here = factors(pool, term);
        common.retain_mut(|(base, r)| {
            let same = here.iter().find(|(other, _)| other == base);
            if let Some((_, other)) = same {
                *r = (*r).min(*other);
            }
            same.is_some()
        });
    }
    let mut e = e;
    let mut vanishing = 0;
    for (base, r) in common {
        let never = matches!(pool.node(base), Node::Number(_) | Node::Pi)
            || matches!(pool.node(base), Node::Symbol(s) if mechanics.parameters.contains(s))
            || r.is_negative();
        if never {
            let below = pool.raise(base, Rational::MINUS_ONE.checked_mul(r)?);
            e = pool.mul(e, below);
            e = pool.expand(e);
        } else {
            vanishing += 1;
        }
    }
    let rest = usize::from(terms.len() > 1);
    (vanishing + rest <= 1).then_some(e)
}

/// A symbol of e = 0 and its solutions.
fn solution(
    pool: &mut Pool,
    mechanics: &Mechanics,
    e: ExprId,
    angular: &SortedSet<Symbol>,
) -> Option<(Symbol, Vec<ExprId>)> {
    let mut places: Vec<Symbol> = mechanics.coordinates.iter().map(|q| q[0]).collect();
    // A condition on the time alone chooses an instant, as one on a coordinate chooses a place.
    if !pool.depends_on_any(e, &places) {
        places.push(mechanics.system.time);
    }
    let mut best: Option<(u8, Symbol, Vec<ExprId>)> = None;
    for symbol in pool.symbols(e) {
        let is_place = places.contains(&symbol);
        if !is_place && !mechanics.parameters.contains(&symbol) {
            continue;
        }
        let inside = angular.contains(&symbol);
        if let Some((coefficients, rest)) = pool.coefficients_linear(e, &[symbol]) {
            let coefficient = pool.simplify(coefficients[0]);
            let is_number = pool.as_number(coefficient).is_some();
            let rank = match (is_place, is_number, inside) {
                (true, true, false) => 0,
                (false, _, false) => 1,
                (true, true, true) => 2,
                (true, false, false) => 3,
                _ => 6,
            };
            if best.as_ref().is_none_or(|best| rank < best.0) {
                let rest = pool.neg(rest);
                if let Some(root) = pool.div(rest, coefficient)
                    && (is_number || needs_all(pool, e, symbol, root))
                {
                    best = Some((rank, symbol, vec![root]));
                }
            }
        } else if !inside
            && best.as_ref().is_none_or(|best| best.0 > 5)
            && let Some(roots) = quadratic(pool, e, symbol, is_place)
        {
            let rank = if is_place { 5 } else { 4 };
            if best.as_ref().is_none_or(|best| rank < best.0) {
                best = Some((rank, symbol, roots));
            }
        }
    }
    best.map(|(_, symbol, roots)| (symbol, roots))
}

/// Whether the root of e = 0 depends on all symbols that e does. If not, e has a factor of its own in those.
fn needs_all(pool: &mut Pool, e: ExprId, symbol: Symbol, root: ExprId) -> bool {
    let mut others = pool.symbols(e);
    others.retain(|&other| other != symbol);
    others.into_iter().all(|other| {
        let slope = pool.differentiate(root, other);
        !pool.vanishes(slope)
    })
}

/// Roots of a s² + b s + c = 0; for b = 0 and a field only the positive one.
fn quadratic(pool: &mut Pool, e: ExprId, s: Symbol, both: bool) -> Option<Vec<ExprId>> {
    let slope = pool.differentiate(e, s);
    let (coefficients, b) = pool.coefficients_linear(slope, &[s])?;
    let a = pool.scale(coefficients[0], Rational::HALF);
    let zero = pool.integer(0);
    let c = pool.substitute(e, &[(s, zero)]);
    let [a, b, c] = [a, b, c].map(|e| pool.simplify(e));
    if pool.is_zero(b) {
        let square = pool.div(c, a)?;
        let square = pool.neg(square);
        let square = pool.simplify(square);
        let root = pool.sqrt(square);
        let opposite = pool.neg(root);
        return Some(if both {
            vec![root, opposite]
        } else {
            vec![root]
        });
    }
    let (bb, ac) = (pool.mul(b, b), pool.mul(a, c));
    let ac = pool.scale(ac, Rational::integer(4));
    let discriminant = pool.sub(bb, ac);
    let discriminant = pool.simplify(discriminant);
    let root = pool.sqrt(discriminant);
    let below = pool.scale(a, Rational::integer(2));
    let (up, down) = (pool.sub(root, b), pool.add(root, b));
    let down = pool.neg(down);
    Some(vec![pool.div(up, below)?, pool.div(down, below)?])
}
