//! The variables of a system, total time derivatives, and the choice between equal forms.

use crate::model::System;
use crate::symbolic::{ExprId, Pool, Symbol};

/// t, q and v of a system, as symbols and as expressions.
pub(super) struct Variables {
    /// t
    pub time: Symbol,
    /// q
    pub positions: Vec<Symbol>,
    /// v
    pub velocities: Vec<Symbol>,
    /// What changes with each coordinate, and how fast.
    pub moved: Vec<Vec<(Symbol, ExprId)>>,
    /// Axes of bodies, and their rates.
    pub axes: Vec<(Symbol, ExprId)>,
    /// The first of the three turns of each body.
    pub turns: Vec<usize>,
    /// v as expressions.
    pub rates: Vec<ExprId>,
    /// v̇ as expressions.
    pub accelerations: Vec<ExprId>,
    /// 0
    pub zero: ExprId,
    /// 1
    pub one: ExprId,
}

impl Variables {
    /// The variables of a system.
    pub fn of(system: &mut System) -> Self {
        let velocities: Vec<Symbol> = system.coordinates.iter().map(|c| c.velocity).collect();
        let count = velocities.len();
        let moved = (0..count).map(|i| system.moved(i)).collect();
        let turns = system.bodies.iter().map(|body| body.first).collect();
        let pool = &mut system.pool;
        let mut axes = Vec::new();
        for body in &system.bodies {
            let rates = [0, 1, 2].map(|k| velocities[body.first + k]);
            axes.extend(body.rates(pool, rates));
        }
        Self {
            axes,
            moved,
            turns,
            time: system.time,
            positions: system.coordinates.iter().map(|c| c.position).collect(),
            rates: velocities.iter().map(|&v| pool.leaf(v)).collect(),
            accelerations: system
                .coordinates
                .iter()
                .map(|c| pool.leaf(c.acceleration))
                .collect(),
            velocities,
            zero: pool.integer(0),
            one: pool.integer(1),
        }
    }

    /// Number of coordinates.
    pub fn len(&self) -> usize {
        self.positions.len()
    }

    /// What d/dt leaves of e(q, v, t) without accelerations: Σ ∂e/∂qᵢ vᵢ + ∂e/∂t.
    pub fn rate(&self, pool: &mut Pool, e: ExprId) -> ExprId {
        let present = pool.symbols(e);
        let mut direction: Vec<(Symbol, ExprId)> = self
            .positions
            .iter()
            .zip(&self.rates)
            .filter(|(q, _)| present.binary_search(q).is_ok())
            .map(|(&q, &v)| (q, v))
            .collect();
        direction.extend(
            self.axes
                .iter()
                .filter(|(e, _)| present.binary_search(e).is_ok()),
        );
        if present.binary_search(&self.time).is_ok() {
            direction.push((self.time, self.one));
        }
        pool.derivative_along(e, &direction)
    }

    /// Indices of the coordinates whose velocity occurs in e.
    pub fn velocities_in(&self, pool: &Pool, e: ExprId) -> Vec<usize> {
        indices_in(&self.velocities, &pool.symbols(e))
    }

    /// Indices of the coordinates that e changes with.
    pub fn positions_in(&self, pool: &Pool, e: ExprId) -> Vec<usize> {
        let present = pool.symbols(e);
        let mut indices = indices_in(&self.positions, &present);
        for i in self.turns.iter().flat_map(|&first| first..first + 3) {
            let mut moved = self.moved[i].iter();
            if moved.any(|(axis, _)| present.binary_search(axis).is_ok()) {
                indices.push(i);
            }
        }
        indices
    }

    /// ∂e/∂qᵢ, or the rate at which e changes with a turn.
    pub fn slope(&self, pool: &mut Pool, e: ExprId, i: usize) -> ExprId {
        pool.derivative_along(e, &self.moved[i])
    }

    /// Whether e can change during a run: it is no expression of parameters alone.
    pub fn changes(&self, pool: &Pool, e: ExprId) -> bool {
        !pool.branches(e).is_empty()
            || pool.depends_on_any(e, &[self.time])
            || pool.depends_on_any(e, &self.positions)
            || pool.depends_on_any(e, &self.velocities)
    }

    /// e at v = 0.
    pub fn at_rest(&self, pool: &mut Pool, e: ExprId) -> ExprId {
        let rest: Vec<_> = self
            .velocities_in(pool, e)
            .into_iter()
            .map(|i| (self.velocities[i], self.zero))
            .collect();
        pool.substitute(e, &rest)
    }

    /// Σ cᵢ vᵢ
    pub fn along_velocity(&self, pool: &mut Pool, coefficients: &[(usize, ExprId)]) -> ExprId {
        let terms: Vec<ExprId> = coefficients
            .iter()
            .map(|&(i, c)| pool.mul(c, self.rates[i]))
            .collect();
        pool.sum(&terms)
    }
}

/// Both are ascending.
fn indices_in(symbols: &[Symbol], present: &[Symbol]) -> Vec<usize> {
    let index = |symbol| symbols.binary_search(symbol).ok();
    present.iter().filter_map(index).collect()
}

/// The form with the fewest operations when computed beside `company`; of equals the first.
pub(super) fn cheapest(pool: &Pool, company: &[ExprId], forms: Vec<Vec<ExprId>>) -> Vec<ExprId> {
    let cost = |form: &Vec<ExprId>| {
        let all: Vec<ExprId> = company.iter().chain(form).copied().collect();
        pool.operations(&all)
    };
    forms.into_iter().min_by_key(cost).unwrap_or_default()
}
