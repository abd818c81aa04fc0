//! What a mode gives besides accelerations and forces: what is read of a series, and what a projection takes.

use super::masked::Masked;
use super::program::Extra;
use crate::derive::{Equations, OutputId};
use crate::symbolic::{ExprId, Symbol};

/// All of it, for a mode in which `acting` rows hold; `known` is what it says of the `state`.
pub(super) fn extras(
    equations: &mut Equations,
    acting: &[usize],
    known: &[(Symbol, ExprId)],
    state: &[Symbol],
) -> Vec<Extra<Masked>> {
    let read = read(equations).into_iter().map(|output| (output, true));
    let projected = projected(equations, acting, known, state).into_iter();
    let projected = projected.map(|output| (output, false));
    let pool = &mut equations.system.pool;
    let outputs = &equations.outputs;
    let extra = |(output, has_series): (OutputId, bool)| Extra {
        output,
        place: Masked::of(pool, &outputs[output.0], known).simplified(pool),
        has_series,
    };
    read.chain(projected).map(extra).collect()
}

/// What guards, stops and marks read of a series.
fn read(equations: &Equations) -> Vec<OutputId> {
    let structure = &equations.structure;
    let mut list = Vec::new();
    for row in &structure.rows {
        list.extend(row.position);
        list.push(row.velocity);
    }
    for contact in &structure.contacts {
        list.extend(contact.normal_factor);
        list.extend(contact.region);
    }
    for friction in &structure.frictions {
        list.extend(friction.given_normal);
        list.push(friction.static_coefficient);
        list.push(friction.kinetic_coefficient);
    }
    list.extend(structure.branches.iter().map(|branch| branch.guard));
    list.extend(structure.stops.iter().flat_map(|(terms, _)| terms));
    list.extend(structure.marks.iter().flat_map(|(terms, _)| terms));
    list
}

/// Inertia and the Jacobians of the rows that act, if a step can leave one of them by more than rounding: then each step ends with a
/// projection.
fn projected(
    equations: &mut Equations,
    acting: &[usize],
    known: &[(Symbol, ExprId)],
    state: &[Symbol],
) -> Vec<OutputId> {
    let structure = &equations.structure;
    let rows = acting.iter().map(|&row| &structure.rows[row]);
    let jacobians = rows.flat_map(|row| row.jacobian.iter().map(|(_, output)| *output));
    let jacobians: Vec<OutputId> = jacobians.collect();
    let pool = &mut equations.system.pool;
    let outputs = &equations.outputs;
    let varies = |output: &OutputId| {
        outputs[output.0].terms.iter().any(|&(_, e)| {
            let e = pool.substitute(e, known);
            let e = pool.simplify(e);
            pool.depends_on_any(e, state)
        })
    };
    if !jacobians.iter().any(varies) {
        return Vec::new();
    }
    let inertia = structure.mass.iter().map(|(_, _, output)| *output);
    inertia.chain(jacobians).collect()
}
