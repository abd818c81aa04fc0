//! Observables, stops, marks and piecewise branches.

use super::sheet::Sheet;
use super::{Branch, NeedId, OutputId, Stage};
use crate::model::ItemName;
use crate::sorted::SortedSet;
use crate::symbolic::{ExprId, Symbol};

/// Per observe: (value, need).
pub(super) fn observes(sheet: &mut Sheet) -> Vec<(OutputId, NeedId)> {
    let items: Vec<(ItemName, ExprId)> = sheet
        .system
        .observes
        .iter()
        .map(|o| (o.name.clone(), o.value))
        .collect();
    let needs = sheet.needs.observes.clone();
    let mut observes = Vec::new();
    for ((name, value), need) in items.into_iter().zip(needs) {
        let value = sheet.reported(value);
        let label = format!("observe[{}]", name.text);
        observes.push((sheet.report(label, need, value), need));
        sheet.derived_of(name);
    }
    observes
}

/// Per stop: (terms, need).
pub(super) fn stops(sheet: &mut Sheet) -> Vec<(Vec<OutputId>, NeedId)> {
    let items = sheet
        .system
        .stops
        .iter()
        .map(|s| (s.name.clone(), s.zeros, s.terms.clone()))
        .collect();
    let needs = sheet.needs.stops.clone();
    watches(sheet, "stop", items, needs)
}

/// Per mark: (terms, need).
pub(super) fn marks(sheet: &mut Sheet) -> Vec<(Vec<OutputId>, NeedId)> {
    let items = sheet
        .system
        .marks
        .iter()
        .map(|m| (m.name.clone(), m.zeros, m.terms.clone()))
        .collect();
    let needs = sheet.needs.marks.clone();
    watches(sheet, "mark", items, needs)
}

fn watches(
    sheet: &mut Sheet,
    kind: &str,
    items: Vec<(ItemName, bool, Vec<ExprId>)>,
    needs: Vec<NeedId>,
) -> Vec<(Vec<OutputId>, NeedId)> {
    let mut watches = Vec::new();
    for ((name, zeros, terms), need) in items.into_iter().zip(needs) {
        let mut outputs = Vec::new();
        for (k, term) in terms.into_iter().enumerate() {
            let term = sheet.system.pool.with_simple_zeros(term, !zeros);
            let term = sheet.reported(term);
            outputs.push(sheet.report(format!("{kind}[{}, {k}]", name.text), need, term));
        }
        sheet.derived_of(name);
        watches.push((outputs, need));
    }
    watches
}

/// Needs of the terms that contain each branch, be it of an output or of an energy.
fn users(sheet: &Sheet, count: usize) -> Vec<SortedSet<NeedId>> {
    let (system, needs) = (&sheet.system, &sheet.needs);
    let outputs = sheet.outputs.iter().flat_map(|o| o.terms.iter().copied());
    let kinetic = system.kinetic.iter().zip(&needs.kinetic);
    let potential = system.potential.iter().zip(&needs.potential);
    let energies = kinetic.chain(potential);
    let energies = energies.map(|(term, &need)| (need, term.energy));
    let mut users: Vec<SortedSet<NeedId>> = vec![SortedSet::new(); count];
    for (need, term) in outputs.chain(energies) {
        for branch in system.pool.branches(term) {
            users[branch].insert(need);
        }
    }
    users
}

/// Whether each guard contains what is known only after the solve.
fn after_solve(sheet: &Sheet, guards: &[ExprId]) -> Vec<bool> {
    let system = &sheet.system;
    let accelerations = system.coordinates.iter().map(|c| c.acceleration);
    let results = system.multipliers().into_iter().chain(accelerations);
    let results: SortedSet<Symbol> = results.collect();
    let guards = guards.iter();
    guards
        .map(|&guard| {
            let symbols = system.pool.symbols(guard);
            symbols.iter().any(|s| results.contains(s))
        })
        .collect()
}

/// Hands the users of a guard on to the branches inside it, and to the guard that one of them is known only after the solve.
fn hand_inward(inside: &[Vec<usize>], users: &mut [SortedSet<NeedId>], after_solve: &mut [bool]) {
    // Guards nest without cycles, so this ends; a guard contains branches that were made before it, as a rule.
    let nested: Vec<usize> = (0..inside.len())
        .filter(|&i| !inside[i].is_empty())
        .collect();
    let mut changed = true;
    while changed {
        changed = false;
        for &outer in nested.iter().rev() {
            let inherited = users[outer].clone();
            for &inner in &inside[outer] {
                let before = users[inner].len();
                users[inner].extend(inherited.iter().copied());
                changed |= users[inner].len() > before;
            }
        }
        for &outer in &nested {
            let late = inside[outer].iter().any(|&inner| after_solve[inner]);
            changed |= late && !after_solve[outer];
            after_solve[outer] |= late;
        }
    }
}

/// The branches; to be called last, when all outputs that may contain them are known.
///
/// Users are the needs of the terms that contain a branch, be it inside the guard of another branch. A branch of an energy has that energy
/// among its users even where equations of motion do not contain it, as the step of a potential: the energy may not jump.
pub(super) fn branches(sheet: &mut Sheet) -> Vec<Branch<OutputId>> {
    let count = sheet.system.branches.len();
    let declared: Vec<ExprId> = sheet.system.branches.iter().map(|b| b.guard).collect();
    let guards: Vec<ExprId> = declared
        .into_iter()
        .map(|guard| sheet.reported(guard))
        .collect();
    let pool = &sheet.system.pool;
    let inside: Vec<Vec<usize>> = guards.iter().map(|&guard| pool.branches(guard)).collect();
    let mut users = users(sheet, count);
    let mut after_solve = after_solve(sheet, &guards);
    hand_inward(&inside, &mut users, &mut after_solve);
    let mut branches = Vec::new();
    for (i, users) in users.into_iter().enumerate() {
        let need = sheet.needs.branches[i];
        let stage = if after_solve[i] {
            Stage::Report
        } else {
            Stage::Motion
        };
        // The guard of a branch that nothing uses is never asked for.
        let terms = if users.is_empty() {
            vec![]
        } else {
            vec![(need, guards[i])]
        };
        branches.push(Branch {
            guard: sheet.output(stage, format!("guard[{i}]"), &terms),
            need,
            after_solve: after_solve[i],
            users: users.into_iter().collect(),
        });
    }
    branches
}
