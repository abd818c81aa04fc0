//! Rows that depend on parameters only leave the system when the program is made.
//!
//! A row a v̇ = 0 with constant a (a pinned coordinate, rolling on a constant radius, sticking) says how one acceleration
//! follows from the others, and the balance of one coordinate gives its force once the accelerations are known:
//!
//! ```text
//! v̇ = Z u        Wᵀ (M Z u − C λ − f) = 0        λ_e = (M v̇ − C λ − f)ₚ / Cₚₑ
//! ```
//!
//! Reference: null-space (coordinate partitioning) method, Wehage & Haug 1982, J. Mech. Design 104.

use super::balance::{Balance, Balances, jacobian, whole};
use super::masked::Masked;
use crate::derive::Equations;
use crate::sorted::SortedMap;
use crate::symbolic::{ExprId, Pool, Symbol};

/// A number that is divided by, and what it must not be small against.
#[derive(Clone, Debug)]
pub(super) struct Divisor {
    pub pivot: ExprId,
    pub against: Vec<ExprId>,
}

impl Divisor {
    /// Both as sums.
    pub fn sums(&self, pool: &Pool) -> (Masked, Vec<Masked>) {
        let sum = |&e: &ExprId| Masked::always(pool, e);
        (sum(&self.pivot), self.against.iter().map(sum).collect())
    }
}

/// The balance that gives the force of an eliminated row.
#[derive(Clone, Debug)]
pub(super) struct Solved {
    pub row: usize,
    pub balance: Balance,
    pub coefficient: ExprId,
}

/// What is left of the equations of a mode.
pub(super) struct Reduced {
    /// v̇ⱼ = Σ factor · u[coordinate]; nothing for a coordinate that cannot accelerate.
    pub accelerations: Vec<SortedMap<usize, ExprId>>,
    /// Coordinates whose accelerations are left, ascending.
    pub free: Vec<usize>,
    /// Balances that are left, as many.
    pub balances: Vec<Balance>,
    /// Rows that stay in the system: (row, coefficients of u, bias).
    pub kept: Vec<(usize, SortedMap<usize, ExprId>, ExprId)>,
    /// In order of elimination: the balance of one may hold forces of later ones.
    pub solved: Vec<Solved>,
    /// Whether Wᵀ M Z is symmetric.
    pub symmetric: bool,
    /// Divisors that parameters could make small.
    pub divisors: Vec<Divisor>,
}

/// How good an expression is to divide by: numbers come before parameters, short before long.
fn rank(pool: &Pool, e: ExprId) -> (u8, usize) {
    match pool.as_number(e) {
        Some(number) if number.is_unit() => (0, 0),
        Some(_) => (1, 0),
        None => (2, pool.iter_reachable(&[e]).len()),
    }
}

fn is_fixed(pool: &Pool, varying: &[Symbol], e: ExprId) -> bool {
    pool.branches(e).is_empty() && !pool.depends_on_any(e, varying)
}

/// Σ factors · Z
fn along(
    pool: &mut Pool,
    row: &[(usize, ExprId)],
    accelerations: &[SortedMap<usize, ExprId>],
) -> SortedMap<usize, ExprId> {
    let mut sums: SortedMap<usize, Vec<ExprId>> = SortedMap::new();
    for &(j, a) in row {
        for (&k, &z) in &accelerations[j] {
            let term = pool.mul(a, z);
            sums.get_or_default(k).push(term);
        }
    }
    let mut combined = SortedMap::new();
    for (k, terms) in sums {
        let sum = pool.sum(&terms);
        let sum = pool.simplify(sum);
        if !pool.vanishes(sum) {
            combined.insert(k, sum);
        }
    }
    combined
}

/// The forces of a row in these balances; none where something of it can be left out.
fn column<'a>(
    pool: &mut Pool,
    balances: impl Iterator<Item = (usize, &'a Balance)>,
    row: usize,
) -> Vec<(usize, Option<ExprId>)> {
    balances
        .filter_map(|(i, balance)| Some((i, balance.forces.get(&row)?.whole(pool))))
        .collect()
}

/// Eliminates the constant rows among `acting`. None where one follows from the others, or where elimination combines
/// what a row that stays is made of: the solver of the core then finds out what is determined.
pub(super) fn reduce(
    equations: &mut Equations,
    balances: &Balances,
    acting: &[usize],
    known: &[(Symbol, ExprId)],
    varying: &[Symbol],
) -> Option<Reduced> {
    let n = equations.system.coordinates.len();
    let one = equations.system.pool.integer(1);
    let mut left: Vec<Option<Balance>> = balances.list.iter().cloned().map(Some).collect();
    let mut reduced = Reduced {
        accelerations: (0..n).map(|j| SortedMap::from([(j, one)])).collect(),
        free: Vec::new(),
        balances: Vec::new(),
        kept: Vec::new(),
        solved: Vec::new(),
        symmetric: true,
        divisors: Vec::new(),
    };
    let mut staying = Vec::new();
    for &row in acting {
        let a = jacobian(equations, row, known);
        let bias = whole(equations, equations.structure.rows[row].bias, known);
        let pool = &mut equations.system.pool;
        let present = left.iter().enumerate();
        let present = present.filter_map(|(i, balance)| Some((i, balance.as_ref()?)));
        let own = column(pool, present, row);
        let fixed = |e: ExprId| is_fixed(pool, varying, e);
        let constant = pool.is_zero(bias)
            && a.iter().all(|&(_, a)| fixed(a))
            && own.iter().all(|&(_, c)| c.is_some_and(fixed));
        if !constant {
            staying.push((row, a, bias));
            continue;
        }
        let declared = column(pool, balances.list.iter().enumerate(), row);
        let along = a.iter().map(|&(j, a)| (j, Some(a)));
        reduced.symmetric &= declared.into_iter().eq(along);
        let pivot = reduced.substitute(pool, &a, &equations.structure.cyclic)?;
        let at = reduced.solve(pool, row, own, pivot, &mut left)?;
        reduced.symmetric &= at == pivot;
    }
    for (row, a, bias) in staying {
        reduced.keep(&mut equations.system.pool, row, &a, bias)?;
    }
    let accelerations = &reduced.accelerations;
    let stays = |j: &usize| accelerations.iter().any(|z| z.contains_key(j));
    reduced.free = (0..n).filter(stays).collect();
    reduced.balances = left.into_iter().flatten().collect();
    (reduced.balances.len() == reduced.free.len()).then_some(reduced)
}

impl Reduced {
    /// Puts in what a constant row a v̇ = 0 says of one acceleration; returns its coordinate.
    fn substitute(
        &mut self,
        pool: &mut Pool,
        a: &[(usize, ExprId)],
        cyclic: &[bool],
    ) -> Option<usize> {
        let along = along(pool, a, &self.accelerations);
        let (&pivot, &divisor) = along
            .iter()
            .min_by_key(|&(&j, &a)| (rank(pool, a), !cyclic[j], j))?;
        self.divide(pool, divisor, along.values().copied());
        let mut follows = SortedMap::new();
        for (&k, &a) in along.iter().filter(|&(&k, _)| k != pivot) {
            let ratio = pool.div(a, divisor)?;
            let ratio = pool.neg(ratio);
            follows.insert(k, pool.simplify(ratio));
        }
        for combination in &mut self.accelerations {
            let Some(factor) = combination.remove(&pivot) else {
                continue;
            };
            for (&k, &z) in &follows {
                let term = pool.mul(factor, z);
                let sum = match combination.get(&k) {
                    Some(&before) => pool.add(before, term),
                    None => term,
                };
                let sum = pool.simplify(sum);
                if pool.vanishes(sum) {
                    combination.remove(&k);
                } else {
                    combination.insert(k, sum);
                }
            }
        }
        Some(pivot)
    }

    /// Takes out the balance that gives the force of an eliminated row, if possible that of the `pivot`, and the force out of the balances
    /// that are left; returns whose balance it is. `column` is what the balances have of the force.
    fn solve(
        &mut self,
        pool: &mut Pool,
        row: usize,
        column: Vec<(usize, Option<ExprId>)>,
        pivot: usize,
        left: &mut [Option<Balance>],
    ) -> Option<usize> {
        let mut column: SortedMap<usize, ExprId> = column
            .into_iter()
            .filter_map(|(i, c)| Some((i, pool.simplify(c?))))
            .collect();
        column.retain(|_, c| !pool.vanishes(*c));
        let at = match column.contains_key(&pivot) {
            true => pivot,
            false => *column.iter().min_by_key(|&(&i, &c)| (rank(pool, c), i))?.0,
        };
        let coefficient = column[&at];
        self.divide(pool, coefficient, column.values().copied());
        let balance = left[at].take()?;
        for (&i, &c) in column.iter().filter(|&(&i, _)| i != at) {
            let ratio = pool.div(c, coefficient)?;
            let ratio = pool.simplify(ratio);
            let Some(other) = left[i].as_mut() else {
                continue;
            };
            other.subtract(pool, ratio, &balance);
            other.forces.remove(&row);
        }
        self.solved.push(Solved {
            row,
            balance,
            coefficient,
        });
        Some(at)
    }

    /// Notes a row that stays in the system.
    fn keep(
        &mut self,
        pool: &mut Pool,
        row: usize,
        a: &[(usize, ExprId)],
        bias: ExprId,
    ) -> Option<()> {
        // Where elimination adds terms up they can cancel, which only the numbers tell.
        let combines = |(j, _): &(usize, ExprId)| match self.accelerations[*j].iter().next() {
            Some((_, &z)) => self.accelerations[*j].len() > 1 || !pool.is_one(z),
            None => false,
        };
        if a.iter().any(combines) {
            return None;
        }
        let along = along(pool, a, &self.accelerations);
        if along.is_empty() {
            return None;
        }
        self.kept.push((row, along, bias));
        Some(())
    }

    /// Notes a divisor; exact numbers need no test.
    fn divide(&mut self, pool: &Pool, pivot: ExprId, row: impl Iterator<Item = ExprId>) {
        if pool.as_number(pivot).is_none() {
            let against = row.filter(|&e| e != pivot).collect();
            self.divisors.push(Divisor { pivot, against });
        }
    }

    /// The unknown that is the acceleration of this coordinate.
    pub fn index(&self, coordinate: usize) -> Option<usize> {
        self.free.iter().position(|&free| free == coordinate)
    }

    /// Row of the reduced inertia: Σⱼ mass[j] Z[j].
    pub fn inertia(
        &self,
        pool: &mut Pool,
        mass: &SortedMap<usize, Masked>,
    ) -> SortedMap<usize, Masked> {
        let mut row: SortedMap<usize, Masked> = SortedMap::new();
        for (&j, entry) in mass {
            for (&k, &z) in &self.accelerations[j] {
                row.get_or_default(k).add_scaled(pool, z, entry);
            }
        }
        row.values_mut().for_each(|sum| *sum = sum.simplified(pool));
        row.retain(|_, sum| !sum.is_zero());
        row
    }
}
