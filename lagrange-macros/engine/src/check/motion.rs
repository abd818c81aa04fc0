//! A position in a mode → velocities that its rows allow → accelerations and forces.
//!
//! ```text
//! A v + b = 0
//! M v̇ − Σ aᵢᵀ λᵢ − couplings = f,   A v̇ = −γ,   slipping: λ = −μk N s/|s|,  N = |λ| of what it rubs on
//! ```

use super::arithmetic::Arithmetic;
use super::forces::{Affine, forces};
use super::linear::solve;
use super::mechanics::Mechanics;
use super::stuck::Stuck;
use crate::modes::Mode;
use crate::symbolic::field::Trouble;
use crate::symbolic::{ExprId, Pool, Symbol};

/// A further condition on velocities: Σ cᵢ vᵢ + rest = 0, as (i, cᵢ) and the whole.
pub(super) struct Tie {
    pub jacobian: Vec<(usize, ExprId)>,
    pub whole: ExprId,
}

/// Values in the order in which they were asked for.
struct Numbers<N>(std::vec::IntoIter<N>, N);

impl<N: Copy> Numbers<N> {
    fn of<A: Arithmetic<Number = N>>(
        a: &mut A,
        pool: &Pool,
        needed: Vec<ExprId>,
    ) -> Result<Self, Trouble> {
        let values = a.values(pool, &needed)?;
        Ok(Numbers(values.into_iter(), a.integer(0)))
    }

    /// The next one; as many are taken as were asked for.
    fn next(&mut self) -> N {
        self.0.next().unwrap_or(self.1)
    }
}

/// Changes the velocities that are bound so that the active rows and ties hold.
pub(super) fn velocities<A: Arithmetic>(
    a: &mut A,
    pool: &Pool,
    mechanics: &Mechanics,
    active: &[usize],
    ties: &[Tie],
) -> Result<(), Stuck> {
    let n = mechanics.coordinates.len();
    let rows = active.iter().map(|&row| &mechanics.rows[row]);
    let rows = rows.map(|row| (&row.jacobian, row.velocity));
    let rows = rows.chain(ties.iter().map(|tie| (&tie.jacobian, tie.whole)));
    let rows: Vec<(&Vec<(usize, ExprId)>, ExprId)> = rows.collect();
    let needed = rows.iter().flat_map(|(jacobian, velocity)| {
        let entries = jacobian.iter().map(|&(_, e)| e);
        entries.chain([*velocity])
    });
    let mut numbers = Numbers::of(a, pool, needed.collect())?;
    let mut equations = Vec::new();
    for (jacobian, _) in rows {
        let mut equation = vec![a.integer(0); n + 1];
        for &(j, _) in jacobian {
            equation[j] = numbers.next();
        }
        equation[n] = a.sub(a.integer(0), numbers.next());
        equations.push(equation);
    }
    let zeros = vec![a.integer(0); n];
    let change = solve(a, equations, &zeros)?.ok_or(Stuck::Impossible)?;
    for (&[_, v, _], &change) in mechanics.coordinates.iter().zip(&change.x) {
        let value = a.add(a.symbol(v), change);
        a.bind(v, value);
    }
    Ok(())
}

/// Number of independent rows among these.
pub(super) fn rank<A: Arithmetic>(
    a: &mut A,
    pool: &Pool,
    mechanics: &Mechanics,
    rows: &[usize],
) -> Result<usize, Stuck> {
    let n = mechanics.coordinates.len();
    let entries = rows.iter().flat_map(|&row| &mechanics.rows[row].jacobian);
    let mut numbers = Numbers::of(a, pool, entries.map(|&(_, e)| e).collect())?;
    let mut equations = Vec::new();
    for &row in rows {
        let mut equation = vec![a.integer(0); n + 1];
        for &(j, _) in &mechanics.rows[row].jacobian {
            equation[j] = numbers.next();
        }
        equations.push(equation);
    }
    let zeros = vec![a.integer(0); n];
    let solution = solve(a, equations, &zeros)?.ok_or(Stuck::Impossible)?;
    Ok(solution.rank)
}

/// Binds accelerations and the forces of all rows; gives those that the equations leave undetermined.
pub(super) fn accelerations<A: Arithmetic>(
    a: &mut A,
    pool: &Pool,
    mechanics: &Mechanics,
    mode: &Mode,
) -> Result<Vec<Symbol>, Stuck> {
    let active = mode.acting_rows(mechanics.system);
    let forces = forces(a, pool, mechanics, mode, &active)?;
    let equations = equations(a, pool, mechanics, &active, &forces)?;
    // What stays undetermined is given some value: a claim about it must not depend on which.
    let accelerations = mechanics.coordinates.iter().map(|q| q[2]);
    let unknowns = accelerations.chain(active.iter().map(|&row| mechanics.rows[row].force));
    let free: Vec<A::Number> = unknowns.map(|symbol| a.symbol(symbol)).collect();
    let solution = solve(a, equations, &free)?.ok_or(Stuck::Impossible)?;
    let mut undetermined = Vec::new();
    for (k, &[_, _, symbol]) in mechanics.coordinates.iter().enumerate() {
        a.bind(symbol, solution.x[k]);
        undetermined.extend((!solution.determined[k]).then_some(symbol));
    }
    for (row, force) in mechanics.rows.iter().zip(&forces) {
        let mut value = force.constant;
        let mut determined = true;
        for &(k, c) in &force.terms {
            value = a.add(value, a.mul(c, solution.x[k]));
            determined &= solution.determined[k];
        }
        a.bind(row.force, value);
        undetermined.extend((!determined).then_some(row.force));
    }
    Ok(undetermined)
}

/// Balances of the coordinates, then the active rows; the right-hand side last.
fn equations<A: Arithmetic>(
    a: &mut A,
    pool: &Pool,
    mechanics: &Mechanics,
    active: &[usize],
    forces: &[Affine<A::Number>],
) -> Result<Vec<Vec<A::Number>>, Stuck> {
    let n = mechanics.coordinates.len();
    let size = n + active.len();
    let zero = a.integer(0);
    let acts = |row: &usize| {
        let force = &forces[*row];
        !force.terms.is_empty() || a.size(force.constant) != 0.0
    };
    let acting: Vec<usize> = (0..mechanics.rows.len()).filter(acts).collect();
    let entries = |row: usize| mechanics.rows[row].jacobian.iter().map(|&(_, e)| e);
    let mut needed: Vec<ExprId> = mechanics.mass.iter().map(|&(_, _, m)| m).collect();
    needed.extend(&mechanics.forcing);
    needed.extend(acting.iter().flat_map(|&row| entries(row)));
    needed.extend(mechanics.couplings.iter().map(|&(_, _, factor)| factor));
    needed.extend(
        active
            .iter()
            .flat_map(|&row| entries(row).chain([mechanics.rows[row].bias])),
    );
    let mut numbers = Numbers::of(a, pool, needed)?;
    let mut equations = vec![vec![zero; size + 1]; size];
    for &(i, j, _) in &mechanics.mass {
        let m = numbers.next();
        equations[i][j] = m;
        equations[j][i] = m;
    }
    for equation in &mut equations[..n] {
        equation[size] = numbers.next();
    }
    let mut push = |i: usize, factor: A::Number, force: &Affine<A::Number>| {
        for &(k, c) in &force.terms {
            equations[i][k] = a.sub(equations[i][k], a.mul(factor, c));
        }
        equations[i][size] = a.add(equations[i][size], a.mul(factor, force.constant));
    };
    for &row in &acting {
        for &(j, _) in &mechanics.rows[row].jacobian {
            push(j, numbers.next(), &forces[row]);
        }
    }
    for &(i, row, _) in &mechanics.couplings {
        push(i, numbers.next(), &forces[row]);
    }
    for (k, &row) in active.iter().enumerate() {
        for &(j, _) in &mechanics.rows[row].jacobian {
            equations[n + k][j] = numbers.next();
        }
        equations[n + k][size] = a.sub(zero, numbers.next());
    }
    Ok(equations)
}
