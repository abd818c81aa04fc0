//! System → [`Equations`]: Euler–Lagrange, rows with their accelerations, energies; one theorem a file.
//!
//! Every number that the core needs is an [`Output`]: a sum of terms, each with the need that asks for it.
//! The [`Structure`] says what the outputs mean; it mirrors `lagrange_core::system::Description` field by field,
//! with an [`OutputId`] where the description has a `ValueRef`.

mod cyclic;
mod energy;
mod euler_lagrange;
mod forms;
mod friction;
mod kept;
mod loads;
mod needs;
mod onsets;
mod outputs;
mod quadratic;
mod regular;
mod rows;
mod sheet;
mod squares;
#[cfg(test)]
mod tests;

use crate::diagnostics::Diagnostics;
use crate::model::System;
use crate::sorted::SortedMap;
use crate::symbolic::{ExprId, MOST_OPERANDS, Pool};
use euler_lagrange::{Group, Inertia};
use loads::Loads;
use sheet::Sheet;

/// A bit of the need mask. Need 0 is always held.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct NeedId(pub usize);

/// Index into `Equations::outputs`.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct OutputId(pub usize);

/// Which tape computes an output.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Stage {
    /// Before the solve: inputs t, q, v.
    Motion,
    /// After it: inputs t, q, v, v̇ and the forces of all rows.
    Report,
}

/// A number the core asks for: the sum of those terms whose need is held.
pub struct Output {
    /// Which tape.
    pub stage: Stage,
    /// What it is, for comments in the generated code: `mass[theta, theta]`.
    pub label: String,
    /// (need, term); an output without terms is structurally zero.
    pub terms: Vec<(NeedId, ExprId)>,
}

/// Everything derived from a system.
pub struct Equations {
    /// The system, with its pool.
    pub system: System,
    /// What each need asks for, for comments in the generated code.
    pub needs: Vec<String>,
    /// All outputs.
    pub outputs: Vec<Output>,
    /// What they mean.
    pub structure: Structure<OutputId>,
    /// The balance of forces with what it shares kept whole; none where there is no such form.
    pub balance: Option<WholeBalance>,
}

/// The equations of motion as a balance of forces, M v̇ − f = 0; each term with its need.
pub struct WholeBalance {
    /// (row, column ≤ row) of M, made of what the balance is made of.
    pub mass: SortedMap<(usize, usize), Vec<(NeedId, ExprId)>>,
    /// Per coordinate.
    pub balance: Vec<Vec<(NeedId, ExprId)>>,
}

impl Equations {
    /// An output as one expression, every need held. The pool is that of the equations, lent by them.
    pub fn total(&self, pool: &mut Pool, output: OutputId) -> ExprId {
        let terms = self.outputs[output.0].terms.iter();
        let terms: Vec<ExprId> = terms.map(|&(_, term)| term).collect();
        pool.sum(&terms)
    }

    /// All terms of what a motion depends on: of all outputs but those that are observed only.
    pub fn terms_of_motion(&self) -> Vec<ExprId> {
        let observed = |i: usize| self.structure.observes.iter().any(|(id, _)| id.0 == i);
        let outputs = self.outputs.iter().enumerate();
        let outputs = outputs.filter(|(i, _)| !observed(*i));
        let terms = outputs.flat_map(|(_, output)| &output.terms);
        terms.map(|&(_, term)| term).collect()
    }
}

/// Derives all equations of a system. None if it is structurally singular, which the sink then tells. Where the pool is
/// [full](crate::symbolic::Pool::is_full) they are not complete.
pub fn equations(mut system: System, sink: &mut Diagnostics) -> Option<Equations> {
    onsets::delay(&mut system);
    let before = system.pool.clone();
    system.pool.allow(kept::operands_multiplied_out(&system));
    let mut equations = derived(system, sink)?;
    if equations.system.pool.is_full() {
        let mut system = equations.system;
        system.pool = before;
        kept::keep_shared(&mut system);
        return derived(system, sink);
    }
    equations.system.pool.allow(MOST_OPERANDS);
    Some(equations)
}

/// The same of a system as it is.
fn derived(system: System, sink: &mut Diagnostics) -> Option<Equations> {
    let mut sheet = Sheet::new(system);
    let groups = euler_lagrange::groups(&mut sheet.system, &sheet.needs);
    let inertias: Vec<Inertia> = groups
        .iter()
        .map(|group| euler_lagrange::derive(&mut sheet.system.pool, &sheet.x, group))
        .collect();
    sheet.derived_of_energies();
    let rows = rows::rows(&mut sheet);
    let contacts = rows::contacts(&mut sheet);
    let frictions = friction::frictions(&mut sheet);
    let loads = loads::loads(&mut sheet);
    // All outputs so far, and what the loads will add to the forcing.
    let written = sheet
        .outputs
        .iter()
        .flat_map(|output| &output.terms)
        .map(|&(_, term)| term);
    let others: Vec<ExprId> = written
        .chain(loads.forcing.iter().map(|&(_, _, term)| term))
        .collect();
    let cyclic = cyclic::cyclic(&mut sheet, &inertias, &others);
    let unloaded = cyclic::cyclic(&mut sheet, &inertias, &[]);
    let mass = mass_matrix(&mut sheet, &inertias);
    let forcing = forcing(&mut sheet, &inertias, &loads);
    let energy = energy::energies(&mut sheet, &inertias);
    let momenta = energy::momenta(&mut sheet, &inertias);
    sheet.derived_of_energies();
    let structure = Structure {
        mass,
        forcing,
        rows,
        couplings: loads.couplings,
        kinetic: sheet.needs.kinetic.clone(),
        potential: sheet.needs.potential.clone(),
        contacts,
        frictions,
        forces: loads.forces,
        dissipations: loads.dissipations,
        energy,
        momenta,
        observes: outputs::observes(&mut sheet),
        stops: outputs::stops(&mut sheet),
        marks: outputs::marks(&mut sheet),
        branches: outputs::branches(&mut sheet),
        cyclic,
        unloaded,
    };
    // Of equations that are not finished nothing can be said.
    let unfinished = sheet.system.pool.is_full();
    let regular = unfinished || regular::check(&sheet, &inertias, &structure, sink);
    if !regular {
        return None;
    }
    let balance = balance(&mut sheet, &groups, &loads.forcing);
    Some(Equations {
        balance,
        needs: sheet.needs.labels,
        system: sheet.system,
        outputs: sheet.outputs,
        structure,
    })
}

/// The lower triangle of M; what each energy contributes stands under its need.
fn mass_matrix(sheet: &mut Sheet, inertias: &[Inertia]) -> Vec<(usize, usize, OutputId)> {
    let mut entries: SortedMap<(usize, usize), Vec<(NeedId, ExprId)>> = SortedMap::new();
    for inertia in inertias {
        for (&place, &entry) in &inertia.mass {
            entries.get_or_default(place).push((inertia.need, entry));
        }
    }
    let mut mass = Vec::new();
    for ((i, j), terms) in entries {
        let label = format!("mass[{}, {}]", sheet.coordinate(i), sheet.coordinate(j));
        mass.push((i, j, sheet.output(Stage::Motion, label, &terms)));
    }
    mass
}

/// f: inertial and conservative forces, applied forces, dissipation.
fn forcing(sheet: &mut Sheet, inertias: &[Inertia], loads: &Loads) -> Vec<OutputId> {
    let mut terms: Vec<Vec<(NeedId, ExprId)>> = vec![Vec::new(); sheet.x.len()];
    for inertia in inertias {
        for &(i, f) in &inertia.forcing {
            terms[i].push((inertia.need, f));
        }
    }
    for &(i, need, f) in &loads.forcing {
        terms[i].push((need, f));
    }
    let mut forcing = Vec::new();
    for (i, terms) in terms.iter().enumerate() {
        let label = format!("forcing[{}]", sheet.coordinate(i));
        forcing.push(sheet.output(Stage::Motion, label, terms));
    }
    forcing
}

/// M v̇ − f of all energies and applied forces.
fn balance(
    sheet: &mut Sheet,
    groups: &[Group],
    loads: &[(usize, NeedId, ExprId)],
) -> Option<WholeBalance> {
    if kept::energies_may_outgrow(&sheet.system) {
        return None;
    }
    let pool = &mut sheet.system.pool;
    let mut whole = WholeBalance {
        mass: SortedMap::new(),
        balance: vec![Vec::new(); sheet.x.len()],
    };
    for group in groups {
        let balance = euler_lagrange::balance(pool, &sheet.x, group)?;
        for (place, e) in balance.mass {
            let terms = whole.mass.get_or_default(place);
            terms.push((group.need, e));
        }
        for (terms, e) in whole.balance.iter_mut().zip(balance.balance) {
            terms.push((group.need, e));
        }
    }
    for &(i, need, f) in loads {
        whole.balance[i].push((need, pool.neg(f)));
    }
    (!pool.is_full()).then_some(whole)
}

/// What the outputs mean: see `lagrange_core::system::Description`, field by field.
pub struct Structure<P> {
    /// (row, column ≤ row, value)
    pub mass: Vec<(usize, usize, P)>,
    /// One per coordinate.
    pub forcing: Vec<P>,
    /// Constraints, contacts, slip components.
    pub rows: Vec<Row<P>>,
    /// Multiplier-proportional forces.
    pub couplings: Vec<Coupling<P>>,
    /// Needs of the kinetic terms.
    pub kinetic: Vec<NeedId>,
    /// Needs of the potential terms.
    pub potential: Vec<NeedId>,
    /// Per contact.
    pub contacts: Vec<Contact<P>>,
    /// Per friction.
    pub frictions: Vec<Friction<P>>,
    /// Per force.
    pub forces: Vec<Load<P>>,
    /// Per dissipation.
    pub dissipations: Vec<Load<P>>,
    /// Per branch.
    pub branches: Vec<Branch<P>>,
    /// T, V, Jacobi, −∂L/∂t; need of the unnamed energies, the others stand under their own.
    pub energy: (P, P, P, P, NeedId),
    /// ∂L/∂v; need as for the energies.
    pub momenta: (Vec<P>, NeedId),
    /// Per observe: (value, need).
    pub observes: Vec<(P, NeedId)>,
    /// Per stop: (terms, need).
    pub stops: Vec<(Vec<P>, NeedId)>,
    /// Per mark: (terms, need).
    pub marks: Vec<(Vec<P>, NeedId)>,
    /// Per coordinate: neither energies nor rows nor forces depend on it.
    pub cyclic: Vec<bool>,
    /// Per coordinate: the energies do not depend on it, so that only forces, which may depend on it, change its momentum.
    pub unloaded: Vec<bool>,
}

/// One row; the index is constraint, contact or slip component in this order.
pub struct Row<P> {
    /// (coordinate, aᵢⱼ)
    pub jacobian: Vec<(usize, P)>,
    /// γ
    pub bias: P,
    /// g, on position level.
    pub position: Option<P>,
    /// a v + b
    pub velocity: P,
    /// Whether b is not zero: what it holds moves by itself, so that its force does work.
    pub rheonomic: bool,
    /// Needs: jacobian, bias, position, velocity.
    pub needs: [NeedId; 4],
}

/// `Q[coordinate] += factor · λ[row]`
pub struct Coupling<P> {
    /// Coordinate.
    pub coordinate: usize,
    /// Row.
    pub row: usize,
    /// Factor.
    pub factor: P,
    /// Need of the force item.
    pub need: NeedId,
}

/// A contact's numbers.
pub struct Contact<P> {
    /// Row index.
    pub row: usize,
    /// |∂gap/∂p|
    pub normal_factor: Option<P>,
    /// e
    pub restitution: P,
    /// Need of e.
    pub restitution_need: NeedId,
    /// Region guard.
    pub region: Option<P>,
}

/// A friction's numbers.
pub struct Friction<P> {
    /// First row index.
    pub row: usize,
    /// Given normal force.
    pub given_normal: Option<P>,
    /// μs
    pub static_coefficient: P,
    /// μk
    pub kinetic_coefficient: P,
    /// Need of the coefficients and the given normal force.
    pub coefficients_need: NeedId,
}

/// A force's or dissipation's numbers.
pub struct Load<P> {
    /// Need of its contribution to f.
    pub need: NeedId,
    /// Reported value.
    pub value: P,
    /// Q·v
    pub power: P,
    /// Need of value and power.
    pub report_need: NeedId,
}

/// A branch's numbers.
pub struct Branch<P> {
    /// Guard.
    pub guard: P,
    /// Its need.
    pub need: NeedId,
    /// Whether the guard belongs to the report.
    pub after_solve: bool,
    /// Needs of the outputs that contain the branch.
    pub users: Vec<NeedId>,
}
