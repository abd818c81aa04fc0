//! The derived numbers as expressions, every effect acting: what a check is held against.

use crate::derive::{Equations, OutputId};
use crate::model::{Normal, System};
use crate::symbolic::{ExprId, Pool, Symbol};

/// M v̇ = f + Σ aᵢᵀ λᵢ + couplings, aᵢ v̇ + γᵢ = 0.
pub(super) struct Mechanics<'a> {
    /// The system, without its pool.
    pub system: &'a System,
    /// Lower triangle of M.
    pub mass: Vec<(usize, usize, ExprId)>,
    /// f
    pub forcing: Vec<ExprId>,
    /// Constraints, contacts, slip components.
    pub rows: Vec<Row>,
    /// (coordinate, row, factor): Q += factor · λ.
    pub couplings: Vec<(usize, usize, ExprId)>,
    /// Per contact: N/λ if it is not 1, and the edge of its region.
    pub contacts: Vec<(Option<ExprId>, Option<ExprId>)>,
    /// Per friction.
    pub frictions: Vec<Friction>,
    /// Names of applied forces and what they stand for.
    pub applied: Vec<(Symbol, ExprId)>,
    /// (q, v, v̇) per coordinate.
    pub coordinates: Vec<[Symbol; 3]>,
    /// Fields.
    pub parameters: Vec<Symbol>,
}

/// One row a v̇ + γ = 0.
pub(super) struct Row {
    pub jacobian: Vec<(usize, ExprId)>,
    pub bias: ExprId,
    pub position: Option<ExprId>,
    /// a v + b
    pub velocity: ExprId,
    /// λ
    pub force: Symbol,
}

/// What a friction needs.
pub(super) struct Friction {
    /// Rows of its slip components.
    pub rows: Vec<usize>,
    pub normal: Normal,
    pub static_coefficient: ExprId,
    pub kinetic_coefficient: ExprId,
}

impl<'a> Mechanics<'a> {
    /// Collects what has been derived. The pool is that of the equations, lent by them.
    pub fn of(equations: &'a Equations, pool: &mut Pool) -> Self {
        let (system, structure) = (&equations.system, &equations.structure);
        let mut total = |id: OutputId| equations.total(pool, id);
        let rows = structure.rows.iter().zip(system.multipliers());
        let rows = rows
            .map(|(row, force)| Row {
                jacobian: row.jacobian.iter().map(|&(j, a)| (j, total(a))).collect(),
                bias: total(row.bias),
                position: row.position.map(&mut total),
                velocity: total(row.velocity),
                force,
            })
            .collect();
        let mass = structure.mass.iter();
        let mass = mass.map(|&(i, j, m)| (i, j, total(m))).collect();
        let forcing = structure.forcing.iter().map(|&f| total(f)).collect();
        let couplings = structure.couplings.iter();
        let couplings = couplings.map(|c| (c.coordinate, c.row, total(c.factor)));
        let couplings = couplings.collect();
        let contacts = structure.contacts.iter();
        let contacts =
            contacts.map(|c| (c.normal_factor.map(&mut total), c.region.map(&mut total)));
        let contacts = contacts.collect();
        let frictions = structure.frictions.iter().zip(&system.frictions);
        let frictions = frictions.map(|(numbers, friction)| Friction {
            rows: (numbers.row..numbers.row + friction.slip.len()).collect(),
            normal: friction.normal,
            static_coefficient: total(numbers.static_coefficient),
            kinetic_coefficient: total(numbers.kinetic_coefficient),
        });
        let frictions = frictions.collect();
        Mechanics {
            system,
            mass,
            forcing,
            rows,
            couplings,
            contacts,
            frictions,
            applied: system.forces.iter().map(|f| (f.force, f.value)).collect(),
            coordinates: system
                .coordinates
                .iter()
                .map(|c| [c.position, c.velocity, c.acceleration])
                .collect(),
            parameters: system.parameters.iter().map(|p| p.symbol).collect(),
        }
    }

    /// Replaces every expression.
    pub fn map(&self, f: &mut impl FnMut(ExprId) -> ExprId) -> Self {
        Mechanics {
            system: self.system,
            mass: self.mass.iter().map(|&(i, j, e)| (i, j, f(e))).collect(),
            forcing: self.forcing.iter().map(|&e| f(e)).collect(),
            rows: self
                .rows
                .iter()
                .map(|row| Row {
                    jacobian: row.jacobian.iter().map(|&(j, e)| (j, f(e))).collect(),
                    bias: f(row.bias),
                    position: row.position.map(&mut *f),
                    velocity: f(row.velocity),
                    force: row.force,
                })
                .collect(),
            couplings: self
                .couplings
                .iter()
                .map(|&(i, row, e)| (i, row, f(e)))
                .collect(),
            contacts: self
                .contacts
                .iter()
                .map(|&(n, r)| (n.map(&mut *f), r.map(&mut *f)))
                .collect(),
            frictions: self
                .frictions
                .iter()
                .map(|friction| Friction {
                    rows: friction.rows.clone(),
                    normal: match friction.normal {
                        Normal::Given(e) => Normal::Given(f(e)),
                        other => other,
                    },
                    static_coefficient: f(friction.static_coefficient),
                    kinetic_coefficient: f(friction.kinetic_coefficient),
                })
                .collect(),
            applied: self.applied.iter().map(|&(s, e)| (s, f(e))).collect(),
            coordinates: self.coordinates.clone(),
            parameters: self.parameters.clone(),
        }
    }

    /// Every expression that the motion in any mode is made of.
    pub fn expressions(&self) -> Vec<ExprId> {
        let mut all = Vec::new();
        self.map(&mut |e| {
            all.push(e);
            e
        });
        all
    }
}
