//! What can be seen to be singular before any number is known.

use super::euler_lagrange::Inertia;
use super::sheet::Sheet;
use super::{Output, OutputId, Structure};
use crate::diagnostics::{Code, Diagnostics};
use crate::model::System;
use crate::sorted::SortedSet;
use crate::symbolic::Symbol;

/// Larger systems are not looked at for singular inertia: it takes n³ operations.
const MOST_COORDINATES: usize = 60;

/// Whether the system can be solved as far as its structure tells; reports what cannot.
///
/// * A coordinate whose row of M vanishes has no inertia. A constraint that contains it may still determine it:
///   the constrained system can be regular where M alone is not.
/// * Coordinates may share one inertia, as in ½ m (ẋ + ẏ)².
/// * Impacts need M free of velocities.
/// * Exact numbers and exponents that have outgrown their bounds make every form unreliable.
pub(super) fn check(
    sheet: &Sheet,
    inertias: &[Inertia],
    structure: &Structure<OutputId>,
    sink: &mut Diagnostics,
) -> bool {
    let (system, outputs) = (&sheet.system, &sheet.outputs);
    let before = sink.count();
    let inert: SortedSet<usize> = structure
        .mass
        .iter()
        .flat_map(|&(i, j, _)| [i, j])
        .collect();
    let tied: SortedSet<usize> = system
        .constraints
        .iter()
        .zip(&structure.rows)
        .filter(|(constraint, _)| constraint.while_contact.is_none())
        .flat_map(|(_, row)| row.jacobian.iter().map(|&(i, _)| i))
        .collect();
    for (i, coordinate) in system.coordinates.iter().enumerate() {
        if !inert.contains(&i) && !tied.contains(&i) {
            sink.report(
                Code::NoInertia,
                coordinate.name.span,
                &[&coordinate.name.text],
            );
        }
    }
    if sink.count() == before {
        singular(system, inertias, structure, outputs, sink);
    }
    if !system.contacts.is_empty() {
        quadratic(system, inertias, sink);
    }
    if let Some(outgrown) = system.pool.outgrown() {
        let (at, name) = match &sheet.outgrown {
            Some(item) => (item.span, format!("`{}`", item.text)),
            None => (system.name.span(), "the equations".to_owned()),
        };
        sink.report(Code::Overflow, at, &[&outgrown.of(&name)]);
    }
    sink.count() == before
}

/// Reports coordinates that can move together without kinetic energy, while every constraint holds: M x = 0 and A x = 0
/// for some x ≠ 0 at each of a few arbitrary states.
fn singular(
    system: &System,
    inertias: &[Inertia],
    structure: &Structure<OutputId>,
    outputs: &[Output],
    sink: &mut Diagnostics,
) {
    let n = system.coordinates.len();
    if n > MOST_COORDINATES {
        return;
    }
    let rows = system.constraints.iter().zip(&structure.rows);
    let rows = rows.filter(|(constraint, _)| constraint.while_contact.is_none());
    let masses = inertias.iter().flat_map(|inertia| &inertia.mass);
    // (row, column, expression); constraints follow the n rows of M.
    let mut entries = Vec::new();
    for (&(i, j), &mass) in masses {
        entries.push((i, j, mass));
        if i != j {
            entries.push((j, i, mass));
        }
    }
    let mut height = n;
    for (_, row) in rows {
        for &(j, output) in &row.jacobian {
            let terms = outputs[output.0].terms.iter();
            entries.extend(terms.map(|&(_, term)| (height, j, term)));
        }
        height += 1;
    }
    let expressions: Vec<_> = entries.iter().map(|&(_, _, e)| e).collect();
    let mut free = None;
    for state in 1..=3u32 {
        let value = |symbol: Symbol| {
            // Irrational steps: no two symbols are in a simple ratio.
            0.4 + (f64::from(state) * 0.414_213_562_373 * (symbol.index() + 1) as f64).fract()
        };
        let values = system.pool.evaluate(&expressions, &value, &|_| true);
        if !values.iter().all(|value| value.is_finite()) {
            return;
        }
        let mut matrix = vec![vec![0.0; n]; height];
        for (&(i, j, _), value) in entries.iter().zip(values) {
            matrix[i][j] += value;
        }
        match kernel(matrix, n) {
            None => return,
            found => free = found,
        }
    }
    let Some(direction) = free else { return };
    let size = direction.iter().fold(0.0, |size: f64, x| size.max(x.abs()));
    let moving = (0..n).filter(|&j| direction[j].abs() > 1e-6 * size);
    let names: Vec<_> = moving.map(|j| &system.coordinates[j].name).collect();
    if let Some(first) = names.first() {
        let list: Vec<String> = names
            .iter()
            .map(|name| format!("`{}`", name.text))
            .collect();
        sink.report(Code::SingularInertia, first.span, &[&list.join(", ")]);
    }
}

/// A vector that a matrix of n columns takes to zero, if there is one (Gauss–Jordan with full pivoting of scaled rows).
fn kernel(mut matrix: Vec<Vec<f64>>, n: usize) -> Option<Vec<f64>> {
    for row in &mut matrix {
        let size = row.iter().fold(0.0, |size: f64, a| size.max(a.abs()));
        if size > 0.0 {
            row.iter_mut().for_each(|a| *a /= size);
        }
    }
    let mut pivots: Vec<(usize, usize)> = Vec::new();
    for _ in 0..n {
        let mut best = (0.0, 0, 0);
        for (i, row) in matrix.iter().enumerate() {
            if pivots.iter().any(|(used, _)| *used == i) {
                continue;
            }
            for (j, a) in row.iter().enumerate() {
                if a.abs() > best.0 {
                    best = (a.abs(), i, j);
                }
            }
        }
        let (size, i, j) = best;
        if size < 1e-10 {
            break;
        }
        pivots.push((i, j));
        let pivot: Vec<f64> = matrix[i].iter().map(|a| a / matrix[i][j]).collect();
        for (k, row) in matrix.iter_mut().enumerate() {
            if k == i {
                row.clone_from(&pivot);
                continue;
            }
            let factor = row[j];
            row.iter_mut()
                .zip(&pivot)
                .for_each(|(a, b)| *a -= factor * b);
        }
    }
    let free = (0..n).find(|j| !pivots.iter().any(|(_, pivot)| pivot == j))?;
    let mut direction = vec![0.0; n];
    direction[free] = 1.0;
    for (i, j) in pivots {
        direction[j] = -matrix[i][free];
    }
    Some(direction)
}

/// Reports the velocities that the mass matrix contains.
fn quadratic(system: &System, inertias: &[Inertia], sink: &mut Diagnostics) {
    let what = if system.from_lagrangian {
        "Lagrangian"
    } else {
        "kinetic energy"
    };
    let Some(term) = system.kinetic.first() else {
        return;
    };
    let pool = &system.pool;
    let entries = inertias
        .iter()
        .filter(|inertia| !inertia.quadratic)
        .flat_map(|inertia| inertia.mass.values());
    let symbols: SortedSet<_> = entries.flat_map(|&entry| pool.symbols(entry)).collect();
    for coordinate in system
        .coordinates
        .iter()
        .filter(|c| symbols.contains(&c.velocity))
    {
        let rate = format!("der({})", coordinate.name.text);
        sink.report(Code::NotQuadratic, term.name.span, &[&what, &rate]);
    }
}
