//! Applied forces and dissipations → their part of the forcing, couplings to multipliers, value and power.
//!
//! ```text
//! force         Q = Q₀(q,v,t) + Σ (∂Q/∂λ) λ        linear in the multipliers it names: ∂Q/∂λ goes to the matrix
//! dissipation   Q = −∂R/∂v, also linear in multipliers (Goldstein, Poole & Safko 2002, section 1.5)
//! power         Q·v
//! ```

use super::sheet::Sheet;
use super::{Coupling, Load, NeedId, OutputId};
use crate::symbolic::{ExprId, Symbol};

/// What the applied forces and dissipations contribute.
pub(super) struct Loads {
    /// (coordinate, need, term of f)
    pub forcing: Vec<(usize, NeedId, ExprId)>,
    /// Forces proportional to multipliers.
    pub couplings: Vec<Coupling<OutputId>>,
    /// Per force.
    pub forces: Vec<Load<OutputId>>,
    /// Per dissipation.
    pub dissipations: Vec<Load<OutputId>>,
}

/// Derives all loads.
pub(super) fn loads(sheet: &mut Sheet) -> Loads {
    let mut loads = Loads {
        forcing: Vec::new(),
        couplings: Vec::new(),
        forces: Vec::new(),
        dissipations: Vec::new(),
    };
    for i in 0..sheet.system.forces.len() {
        force(sheet, i, &mut loads);
        sheet.derived_of(sheet.system.forces[i].name.clone());
    }
    for i in 0..sheet.system.dissipations.len() {
        dissipation(sheet, i, &mut loads);
        sheet.derived_of(sheet.system.dissipations[i].name.clone());
    }
    loads
}

fn force(sheet: &mut Sheet, index: usize, loads: &mut Loads) {
    let [need, report_need] = sheet.needs.forces[index];
    let force = &sheet.system.forces[index];
    let (name, value) = (force.name.text.clone(), force.value);
    let generalized = force.generalized.clone();
    act(sheet, &name, need, &generalized, loads);
    let power = sheet.x.along_velocity(&mut sheet.system.pool, &generalized);
    loads
        .forces
        .push(report(sheet, &name, [need, report_need], value, power));
}

/// Generalized forces → the forcing without multipliers, and a coupling for each multiplier.
fn act(
    sheet: &mut Sheet,
    name: &str,
    need: NeedId,
    generalized: &[(usize, ExprId)],
    loads: &mut Loads,
) {
    let multipliers = sheet.system.multipliers();
    for &(coordinate, q) in generalized {
        let pool = &mut sheet.system.pool;
        let present = pool.symbols(q);
        let named: Vec<(usize, Symbol)> = multipliers
            .iter()
            .enumerate()
            .filter(|(_, symbol)| present.binary_search(symbol).is_ok())
            .map(|(row, &symbol)| (row, symbol))
            .collect();
        let absent: Vec<(Symbol, ExprId)> = named
            .iter()
            .map(|&(_, symbol)| (symbol, sheet.x.zero))
            .collect();
        let free = pool.substitute(q, &absent);
        loads.forcing.push((coordinate, need, pool.simplify(free)));
        for (row, symbol) in named {
            let pool = &mut sheet.system.pool;
            let factor = pool.differentiate(q, symbol);
            let factor = pool.simplify(factor);
            if pool.is_zero(factor) {
                continue;
            }
            let label = format!("coupling[{name}, {}, {row}]", sheet.coordinate(coordinate));
            let factor = sheet.motion(label, need, factor);
            loads.couplings.push(Coupling {
                coordinate,
                row,
                factor,
                need,
            });
        }
    }
}

fn dissipation(sheet: &mut Sheet, index: usize, loads: &mut Loads) {
    let [need, report_need] = sheet.needs.dissipations[index];
    let dissipation = &sheet.system.dissipations[index];
    let (name, rayleigh) = (dissipation.name.text.clone(), dissipation.rayleigh);
    let (pool, x) = (&mut sheet.system.pool, &sheet.x);
    let mut generalized = Vec::new();
    for i in x.velocities_in(pool, rayleigh) {
        let slope = pool.differentiate(rayleigh, x.velocities[i]);
        let q = pool.neg(slope);
        generalized.push((i, pool.simplify(q)));
    }
    act(sheet, &name, need, &generalized, loads);
    let power = sheet.x.along_velocity(&mut sheet.system.pool, &generalized);
    loads
        .dissipations
        .push(report(sheet, &name, [need, report_need], rayleigh, power));
}

fn report(
    sheet: &mut Sheet,
    name: &str,
    [need, report_need]: [NeedId; 2],
    value: ExprId,
    power: ExprId,
) -> Load<OutputId> {
    let [value, power] = [value, power].map(|e| sheet.reported(e));
    Load {
        need,
        value: sheet.report(format!("value[{name}]"), report_need, value),
        power: sheet.report(format!("power[{name}]"), report_need, power),
        report_need,
    }
}
