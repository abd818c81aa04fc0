//! A position in a mode → velocities that its rows allow → accelerations and forces.
//!
//! ```text
//! A v + b = 0
//! M v̇ − Σ aᵢᵀ λᵢ − couplings = f,   A v̇ = −γ,   slipping: λ = −μk N s/|s|,  N = |λ| of what it rubs on
//! ```

use super::arithmetic::Arithmetic;
use super::linear::solve;
use super::mechanics::Mechanics;
use super::modes::{Grip, Mode};
use crate::model::Normal;
use crate::symbolic::field::Trouble;
use crate::symbolic::{ExprId, Pool, Symbol};

/// Why there is no motion.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Stuck {
    /// A number has no value here.
    Trouble(Trouble),
    /// The equations of the mode contradict each other.
    Impossible,
}

impl From<Trouble> for Stuck {
    fn from(trouble: Trouble) -> Stuck {
        Stuck::Trouble(trouble)
    }
}

/// A further condition on velocities: Σ cᵢ vᵢ + rest = 0, as (i, cᵢ) and the whole.
pub(super) struct Tie {
    pub jacobian: Vec<(usize, ExprId)>,
    pub whole: ExprId,
}

/// Σ cₖ xₖ + constant over the unknowns.
struct Affine<N> {
    terms: Vec<(usize, N)>,
    constant: N,
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
    let n = mechanics.coordinates.len();
    let active = mode.active(mechanics);
    let size = n + active.len();
    let zero = a.integer(0);
    let forces = forces(a, pool, mechanics, mode, &active)?;
    let acts = |row: usize| {
        let force: &Affine<A::Number> = &forces[row];
        !force.terms.is_empty() || a.size(force.constant) != 0.0
    };
    let acting: Vec<usize> = (0..mechanics.rows.len()).filter(|&row| acts(row)).collect();
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
    let mut push = |a: &A, i: usize, factor: A::Number, force: &Affine<A::Number>| {
        for &(k, c) in &force.terms {
            equations[i][k] = a.sub(equations[i][k], a.mul(factor, c));
        }
        equations[i][size] = a.add(equations[i][size], a.mul(factor, force.constant));
    };
    for &row in &acting {
        for &(j, _) in &mechanics.rows[row].jacobian {
            push(a, j, numbers.next(), &forces[row]);
        }
    }
    for &(i, row, _) in &mechanics.couplings {
        push(a, i, numbers.next(), &forces[row]);
    }
    for (k, &row) in active.iter().enumerate() {
        for &(j, _) in &mechanics.rows[row].jacobian {
            equations[n + k][j] = numbers.next();
        }
        equations[n + k][size] = a.sub(zero, numbers.next());
    }
    // What stays undetermined is given some value: a claim about it must not depend on which.
    let mut free = vec![zero; size];
    for (place, symbol) in mechanics.coordinates.iter().map(|q| q[2]).enumerate() {
        free[place] = a.symbol(symbol);
    }
    for (k, &row) in active.iter().enumerate() {
        free[n + k] = a.symbol(mechanics.rows[row].force);
    }
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

/// The force of every row, in the unknowns: v̇, then the forces of the active rows.
fn forces<A: Arithmetic>(
    a: &mut A,
    pool: &Pool,
    mechanics: &Mechanics,
    mode: &Mode,
    active: &[usize],
) -> Result<Vec<Affine<A::Number>>, Stuck> {
    let n = mechanics.coordinates.len();
    let mut forces: Vec<Affine<A::Number>> = Vec::new();
    for row in 0..mechanics.rows.len() {
        let place = active.iter().position(|&r| r == row);
        forces.push(Affine {
            terms: place.map(|k| (n + k, a.integer(1))).into_iter().collect(),
            constant: a.integer(0),
        });
    }
    for (friction, grip) in mechanics.frictions.iter().zip(&mode.grips) {
        let Grip::Slips { forward } = *grip else {
            continue;
        };
        let mu = a.values(pool, &[friction.kinetic_coefficient])?[0];
        let backward = a.integer(if forward { -1 } else { 1 });
        let mut directions = vec![backward];
        if friction.rows.len() > 1 {
            let slips: Vec<ExprId> = friction
                .rows
                .iter()
                .map(|&row| mechanics.rows[row].velocity)
                .collect();
            let slips = a.values(pool, &slips)?;
            let square = slips
                .iter()
                .fold(a.integer(0), |sum, &s| a.add(sum, a.mul(s, s)));
            let speed = a.sqrt(square)?;
            directions.clear();
            for s in slips {
                directions.push(a.mul(backward, a.div(s, speed)?));
            }
        }
        let (terms, constant) = match friction.normal {
            Normal::Given(e) => (Vec::new(), a.values(pool, &[e])?[0]),
            Normal::Contact(contact) => {
                let factor = match mechanics.contacts[contact].0 {
                    None => a.integer(1),
                    Some(factor) => a.values(pool, &[factor])?[0],
                };
                let row = mechanics.constraints + contact;
                let scaled = |&(k, c): &(usize, A::Number)| (k, a.mul(factor, c));
                let terms = forces[row].terms.iter().map(scaled).collect();
                (terms, a.integer(0))
            }
            Normal::Constraint(constraint) => {
                let sign = a.integer(if mode.positive[constraint] { 1 } else { -1 });
                let scaled = |&(k, c): &(usize, A::Number)| (k, a.mul(sign, c));
                let terms = forces[constraint].terms.iter().map(scaled).collect();
                (terms, a.integer(0))
            }
        };
        for (&row, direction) in friction.rows.iter().zip(directions) {
            let factor = a.mul(mu, direction);
            let scaled = |&(k, c): &(usize, A::Number)| (k, a.mul(factor, c));
            forces[row] = Affine {
                terms: terms.iter().map(scaled).collect(),
                constant: a.mul(factor, constant),
            };
        }
    }
    Ok(forces)
}
