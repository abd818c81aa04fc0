//! Derived equations at random states.

use super::notation::parse;
use crate::derive::{Equations, OutputId};
use crate::symbolic::{ExprId, Node, Symbol};
use std::collections::BTreeMap;

/// Derived equations with the names of their system.
pub struct Derived {
    pub equations: Equations,
    pub names: BTreeMap<String, ExprId>,
}

/// Values by name.
pub type Point = BTreeMap<String, f64>;

impl Derived {
    /// Random values between 0.3 and 1.7 for every name, so that roots and quotients are safe.
    pub fn point(&self, random: &mut Random) -> Point {
        let leaf = |(name, e): (&String, &ExprId)| {
            let pool = &self.equations.system.pool;
            matches!(pool.node(*e), Node::Symbol(_))
                .then(|| (name.clone(), random.between(0.3, 1.7)))
        };
        self.names.iter().filter_map(leaf).collect()
    }

    /// Value of an output with all needs held; branches by the sign of their guards.
    pub fn value(&self, output: OutputId, point: &Point) -> f64 {
        self.equations.outputs[output.0]
            .terms
            .iter()
            .map(|&(_, term)| self.evaluate(term, point))
            .sum()
    }

    /// Value of an expression.
    pub fn evaluate(&self, e: ExprId, point: &Point) -> f64 {
        let system = &self.equations.system;
        let pool = &system.pool;
        let symbols = |s: Symbol| point[pool.name(s)];
        let then = |branch: usize| self.evaluate(system.branches[branch].guard, point) >= 0.0;
        pool.evaluate(&[e], &symbols, &then)[0]
    }

    /// Mᵢⱼ
    pub fn mass(&self, i: usize, j: usize, point: &Point) -> f64 {
        let wanted = (i.max(j), i.min(j));
        let entry = self
            .equations
            .structure
            .mass
            .iter()
            .find(|&&(i, j, _)| (i, j) == wanted);
        entry.map_or(0.0, |&(_, _, output)| self.value(output, point))
    }

    /// fᵢ
    pub fn forcing(&self, i: usize, point: &Point) -> f64 {
        self.value(self.equations.structure.forcing[i], point)
    }

    /// aᵢ of a row, dense.
    pub fn jacobian(&self, row: usize, point: &Point) -> Vec<f64> {
        let mut dense = vec![0.0; self.equations.system.coordinates.len()];
        for &(i, output) in &self.equations.structure.rows[row].jacobian {
            dense[i] = self.value(output, point);
        }
        dense
    }

    /// (v̇, λ) with these rows acting: M v̇ − aᵀλ = f, a v̇ = −γ.
    pub fn accelerations(&self, rows: &[usize], point: &Point) -> Vec<f64> {
        let n = self.equations.system.coordinates.len();
        let size = n + rows.len();
        let mut matrix = vec![vec![0.0; size]; size];
        let mut right = vec![0.0; size];
        for i in 0..n {
            for (j, entry) in matrix[i][..n].iter_mut().enumerate() {
                *entry = self.mass(i, j, point);
            }
            right[i] = self.forcing(i, point);
        }
        for (k, &row) in rows.iter().enumerate() {
            for (i, a) in self.jacobian(row, point).into_iter().enumerate() {
                matrix[n + k][i] = a;
                matrix[i][n + k] = -a;
            }
            right[n + k] = -self.value(self.equations.structure.rows[row].bias, point);
        }
        solve(matrix, right)
    }

    /// (i, j) of the entries of M that are not structurally zero.
    pub fn pattern(&self) -> Vec<(usize, usize)> {
        self.equations
            .structure
            .mass
            .iter()
            .map(|&(i, j, _)| (i, j))
            .collect()
    }

    /// Asserts that an output has one term, which equals `wanted` and needs no more operations.
    #[track_caller]
    pub fn expect(&mut self, output: OutputId, wanted: &str) {
        let terms = &self.equations.outputs[output.0].terms;
        let [(_, got)] = terms[..] else {
            panic!("{} has {} terms", self.printed(output), terms.len())
        };
        let system = &mut self.equations.system;
        let wanted = parse(system, &self.names, wanted);
        let pool = &mut system.pool;
        let difference = pool.sub(got, wanted);
        let difference = pool.simplify(difference);
        let (printed, form) = (pool.print(got), pool.print(wanted));
        assert!(pool.is_zero(difference), "got {printed}, want {form}");
        let (cost, bound) = (pool.operations(&[got]), pool.operations(&[wanted]));
        assert!(
            cost <= bound,
            "{printed} has {cost} operations, {form} has {bound}"
        );
    }

    /// The terms of an output, printed.
    pub fn printed(&self, output: OutputId) -> String {
        let pool = &self.equations.system.pool;
        let terms: Vec<String> = self.equations.outputs[output.0]
            .terms
            .iter()
            .map(|&(_, term)| pool.print(term))
            .collect();
        terms.join(" + ")
    }

    fn motion(&self) -> impl Iterator<Item = OutputId> {
        let structure = &self.equations.structure;
        structure
            .mass
            .iter()
            .map(|&(_, _, output)| output)
            .chain(structure.forcing.iter().copied())
    }

    /// M and f, printed.
    pub fn equations_of_motion(&self) -> Vec<String> {
        let line = |o: OutputId| {
            format!(
                "{} = {}",
                self.equations.outputs[o.0].label,
                self.printed(o)
            )
        };
        self.motion().map(line).collect()
    }

    /// Operations of M and f together.
    pub fn operations(&self) -> usize {
        let terms: Vec<ExprId> = self
            .motion()
            .flat_map(|o| self.equations.outputs[o.0].terms.iter().map(|&(_, e)| e))
            .collect();
        self.equations.system.pool.operations(&terms)
    }

    /// Operations of these expressions together.
    pub fn operations_of(&mut self, expressions: &[&str]) -> usize {
        let system = &mut self.equations.system;
        let parsed: Vec<ExprId> = expressions
            .iter()
            .map(|text| parse(system, &self.names, text))
            .collect();
        system.pool.operations(&parsed)
    }
}

/// Solves A x = b by elimination with pivoting.
pub fn solve(mut a: Vec<Vec<f64>>, mut b: Vec<f64>) -> Vec<f64> {
    let n = b.len();
    for k in 0..n {
        let pivot = (k..n)
            .max_by(|&i, &j| a[i][k].abs().total_cmp(&a[j][k].abs()))
            .expect("not empty");
        a.swap(k, pivot);
        b.swap(k, pivot);
        let row = a[k].clone();
        for i in k + 1..n {
            let factor = a[i][k] / row[k];
            for (entry, above) in a[i].iter_mut().zip(&row) {
                *entry -= factor * above;
            }
            b[i] -= factor * b[k];
        }
    }
    for k in (0..n).rev() {
        b[k] = (b[k] - (k + 1..n).map(|j| a[k][j] * b[j]).sum::<f64>()) / a[k][k];
    }
    b
}

/// Seeded random numbers.
pub struct Random(fastrand::Rng);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(fastrand::Rng::with_seed(seed))
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.0.f64()
    }

    pub fn below(&mut self, n: usize) -> usize {
        self.0.usize(..n)
    }
}

/// Asserts relative agreement to rounding.
#[track_caller]
pub fn close(what: &str, got: f64, want: f64) {
    assert!(
        (got - want).abs() <= 1e-12 * (1.0 + want.abs()),
        "{what}: got {got}, want {want}"
    );
}

/// Calls `check` at ten random points.
pub fn at_random(derived: &Derived, check: impl Fn(&Point)) {
    let mut random = Random::new(0x5eed);
    for _ in 0..10 {
        check(&derived.point(&mut random));
    }
}
