//! Is a claim zero on the whole surface of a mode? Values at random points of two finite fields.
//!
//! The claim's numerator has some degree d (bounded by [`crate::symbolic::field::Degree`]; velocities and forces come
//! from linear equations, so theirs follow from Cramer's rule). k points let a wrong claim pass with probability
//! ≤ (d/2^61)^k; k is as large as it takes to bring that below 2^-120.

use super::arithmetic::{Arithmetic, Exact};
use super::case::Case;
use super::degree::degree;
use super::motion::{accelerations, rank, velocities};
use super::stuck::Stuck;
use crate::sorted::SortedSet;
use crate::symbolic::field::{Angles, PRIMES, Point, Trouble};
use crate::symbolic::{ExprId, Node, Pool, Symbol};

/// What values at points say about a claim.
#[derive(Clone, PartialEq, Debug)]
pub(super) enum Finding {
    /// It holds.
    Zero,
    /// It does not hold for independent atoms; `certain` if these cannot depend on each other.
    Different { certain: bool },
    /// Nothing: why.
    Open(String),
    /// The mode has no states.
    Impossible,
}

/// A wrong claim passes with at most this probability, as a power of 2.
const ASSURANCE: f64 = 120.0;

/// A root of a square has a random sign: as many points make a wrong sign as improbable.
const POINTS_WITH_ROOTS: usize = 120;

/// Up to so many roots, all combinations of their signs occur among [`POINTS_WITH_ROOTS`] points.
const MOST_ROOTS: usize = 2;

/// Branches that are not decided double the work.
const MOST_BRANCHES: usize = 6;

/// Points that are looked at for each one that is needed: roots need squares.
const TRIES: usize = 1 << 12;

/// Tests a claim.
pub(super) fn exact(pool: &mut Pool, case: &Case) -> Finding {
    let mut all = case.mechanics.expressions();
    for tie in case.ties {
        all.extend(tie.jacobian.iter().map(|&(_, e)| e).chain([tie.whole]));
    }
    all.push(case.claim);
    let mechanics = case.mechanics;
    let moving = mechanics.coordinates.iter().flat_map(|q| &q[1..]).copied();
    let forces = mechanics.rows.iter().map(|row| row.force);
    let dependent: Vec<Symbol> = moving.chain(forces).collect();
    let angles = pool.angles(&all, &dependent);
    let mut undecided = branches(pool, &all);
    undecided.retain(|branch| case.decided.iter().all(|(known, _)| known != branch));
    if undecided.len() > MOST_BRANCHES {
        return Finding::Open(format!("it has {} branches", undecided.len()));
    }
    let degree = degree(pool, case, &angles);
    let bits = 61.0 - degree.max(2.0).log2();
    if bits < 8.0 {
        return Finding::Open("its degree is too large".to_owned());
    }
    let points = (ASSURANCE / bits).ceil().max(2.0) as usize;
    let few_roots = roots(pool, &all) <= MOST_ROOTS;
    let (mut zero, mut different, mut all_certain) = (false, false, true);
    for choice in 0..1_u32 << undecided.len() {
        let mut chosen: Vec<usize> = Vec::new();
        chosen.extend(case.decided.iter().filter(|d| d.1).map(|d| d.0));
        let bits = undecided.iter().enumerate();
        chosen.extend(bits.filter(|(i, _)| choice >> i & 1 == 1).map(|(_, &b)| b));
        match at_points(pool, case, &angles, &chosen, points) {
            Finding::Zero => zero = true,
            Finding::Impossible => {}
            Finding::Different { certain } => {
                different = true;
                all_certain &= certain;
            }
            open => return open,
        }
    }
    match (zero, different) {
        // Whichever sides of the branches are the real ones.
        (false, true) => Finding::Different {
            certain: all_certain && few_roots && angles.are_independent(),
        },
        (true, true) => Finding::Different { certain: false },
        (true, false) => Finding::Zero,
        (false, false) => Finding::Impossible,
    }
}

/// Number of roots of what is not a number.
fn roots(pool: &Pool, all: &[ExprId]) -> usize {
    let mut radicands = SortedSet::new();
    for e in pool.iter_reachable(all) {
        if let Node::Product(factors) = pool.node(e) {
            let broken = factors.iter().filter(|(_, r)| !r.is_integer());
            let broken = broken.filter(|&&(base, _)| pool.as_number(base).is_none());
            radicands.extend(broken.map(|&(base, _)| base));
        }
    }
    radicands.len()
}

/// All branches in the expressions.
fn branches(pool: &Pool, all: &[ExprId]) -> Vec<usize> {
    let reachable = pool.iter_reachable(all).into_iter();
    let branches = reachable.filter_map(|e| match pool.node(e) {
        Node::Select { branch, .. } => Some(*branch),
        _ => None,
    });
    let found: SortedSet<usize> = branches.collect();
    found.into_iter().collect()
}

fn at_points(
    pool: &Pool,
    case: &Case,
    angles: &Angles,
    chosen: &[usize],
    points: usize,
) -> Finding {
    let (mut needed, mut seen, mut tried) = (points, 0, 0);
    let mut zeros = 0;
    while seen < needed {
        if tried >= TRIES.max(8 * needed) {
            return Finding::Open("its roots have no values in the field".to_owned());
        }
        let field = PRIMES[seen % 2];
        let mut point = Point::new(field, 0x6c61_6772 + tried as u64, angles);
        tried += 1;
        for &branch in chosen {
            point.choose(branch);
        }
        // Fields are positive.
        for &symbol in &case.mechanics.parameters {
            let root = point.symbol(symbol);
            point.bind(symbol, field.mul(root, root));
        }
        let mut point = Exact(point);
        match at_point(pool, case, &mut point) {
            Ok((0, _)) => {
                seen += 1;
                zeros += 1;
                if point.0.has_roots() {
                    needed = needed.max(POINTS_WITH_ROOTS);
                }
            }
            Ok((_, Some(name))) => {
                return Finding::Open(format!("the mode does not determine `{name}`"));
            }
            // Without roots one point decides. With roots it may have the wrong signs, unless all points differ.
            Ok((_, None)) if !point.0.is_exact() || zeros > 0 => {
                return Finding::Different { certain: false };
            }
            Ok((_, None)) if !point.0.has_roots() => return Finding::Different { certain: true },
            Ok((_, None)) => {
                seen += 1;
                needed = needed.max(POINTS_WITH_ROOTS);
            }
            Err(Stuck::Impossible) => return Finding::Impossible,
            Err(Stuck::Trouble(Trouble::Beyond)) => {
                return Finding::Open("it holds numbers that the field does not have".to_owned());
            }
            Err(Stuck::Trouble(Trouble::Division | Trouble::NotSquare)) => {}
        }
    }
    match zeros {
        0 => Finding::Different { certain: true },
        _ if zeros == seen => Finding::Zero,
        _ => Finding::Different { certain: false },
    }
}

/// Value of the claim, and something it contains that the mode does not determine.
fn at_point(pool: &Pool, case: &Case, point: &mut Exact) -> Result<(u64, Option<String>), Stuck> {
    let mechanics = case.mechanics;
    if rank(point, pool, mechanics, case.positions)? < case.positions.len() {
        return Err(Stuck::Impossible);
    }
    let active = case.mode.acting_rows(mechanics.system);
    velocities(point, pool, mechanics, &active, case.ties)?;
    let undetermined = accelerations(point, pool, mechanics, case.mode)?;
    let value = point.values(pool, &[case.claim])?[0];
    let open = undetermined
        .into_iter()
        .find(|&symbol| pool.depends_on(case.claim, symbol));
    Ok((value, open.map(|symbol| pool.name(symbol).to_owned())))
}
