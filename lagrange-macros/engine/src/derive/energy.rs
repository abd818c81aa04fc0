//! Energies → T, V, the Jacobi integral, its rate by explicit time, and the generalized momenta.
//!
//! ```text
//! h = v·∂L/∂v − L        dh/dt = Q·v − ∂L/∂t        pᵢ = ∂L/∂vᵢ
//! ```
//!
//! (Goldstein, Poole & Safko 2002, section 2.7; Lanczos 1970, section V.4.) h is T + V where T is a quadratic form
//! in v and V is free of v; a rotating frame or a moving support makes them differ.
//!
//! A scene can leave out a named energy: its terms then stand under its own need also in the report, so that the
//! ledger adds up what acts. Energies without a name stand under the need of the energies.

use super::euler_lagrange::Inertia;
use super::needs::ALWAYS;
use super::sheet::Sheet;
use super::{NeedId, OutputId, Stage};
use crate::symbolic::ExprId;

/// T, V, h and −∂L/∂t with their need.
pub(super) fn energies(
    sheet: &mut Sheet,
    inertias: &[Inertia],
) -> (OutputId, OutputId, OutputId, OutputId, NeedId) {
    let mut kinetic = Vec::new();
    let mut potential = Vec::new();
    let mut jacobi = Vec::new();
    let mut time_power = Vec::new();
    let asked = sheet.needs.energy;
    for inertia in inertias {
        let need = report_need(inertia, asked);
        let pool = &mut sheet.system.pool;
        // A Lagrangian is not declared in two parts: its energy is h, so its T is what h has beyond V.
        let declared = if sheet.system.from_lagrangian {
            inertia.motional
        } else {
            inertia.kinetic
        };
        kinetic.push((need, declared));
        potential.push((need, inertia.potential));
        let parts = [inertia.motional, inertia.potential].map(|part| pool.group_sum(part));
        jacobi.push((need, pool.sum(&parts)));
        let lagrangian = pool.sub(inertia.kinetic, inertia.potential);
        let explicit = pool.differentiate(lagrangian, sheet.system.time);
        let explicit = pool.neg(explicit);
        time_power.push((need, pool.simplify(explicit)));
    }
    let mut write = |label: &str, terms: &[(NeedId, ExprId)]| {
        sheet.output(Stage::Report, label.to_owned(), terms)
    };
    (
        write("kinetic_energy", &kinetic),
        write("potential_energy", &potential),
        write("jacobi", &jacobi),
        write("time_power", &time_power),
        asked,
    )
}

/// ∂L/∂v with their need.
pub(super) fn momenta(sheet: &mut Sheet, inertias: &[Inertia]) -> (Vec<OutputId>, NeedId) {
    let asked = sheet.needs.momenta;
    let mut terms: Vec<Vec<(NeedId, ExprId)>> = vec![Vec::new(); sheet.x.len()];
    for inertia in inertias {
        for &(i, p) in &inertia.momenta {
            terms[i].push((report_need(inertia, asked), p));
        }
    }
    let mut outputs = Vec::new();
    for (i, terms) in terms.iter().enumerate() {
        let label = format!("momentum[{}]", sheet.coordinate(i));
        outputs.push(sheet.output(Stage::Report, label, terms));
    }
    (outputs, asked)
}

/// A named energy is reported while it acts, an unnamed one when asked for.
fn report_need(inertia: &Inertia, asked: NeedId) -> NeedId {
    if inertia.need == ALWAYS {
        asked
    } else {
        inertia.need
    }
}
