//! The equations of motion of a mode before anything is eliminated.
//!
//! ```text
//! Σⱼ mass[j] v̇ⱼ − Σᵣ forces[r] λᵣ = load        one for each coordinate
//! ```
//!
//! Sliding friction acts through the force that presses: λ_slip = factor · λ_source, with factor = −μₖ ν d.
//!
//! The inertia of a unit quaternion is singular along itself. With the row a v̇ + γ = 0 that keeps its length, κ aᵀ (a v̇ + γ) is added to the balances of
//! its coordinates: the solution stays, forces included, and M + κ aᵀ a is positive definite (augmented Lagrangian; Hestenes 1969, J. Optim. Theory Appl. 4,
//! 303). κ = tr M / 12 makes that of a ball a multiple of 1.

use super::masked::{ALWAYS, Masked};
use crate::derive::{Equations, OutputId};
use crate::model::Normal;
use crate::modes::{Direction, FrictionState, Mode};
use crate::sorted::SortedMap;
use crate::symbolic::{ExprId, Pool, Symbol};

/// The balance of one coordinate.
#[derive(Clone, Default, Debug)]
pub(super) struct Balance {
    pub mass: SortedMap<usize, Masked>,
    pub forces: SortedMap<usize, Masked>,
    pub load: Masked,
}

/// The force of a slip that slides: factor · λ[source], or the factor itself.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slide {
    pub row: usize,
    pub factor: ExprId,
    pub source: Option<usize>,
}

/// All of a mode.
pub(super) struct Balances {
    /// By coordinate.
    pub list: Vec<Balance>,
    pub slides: Vec<Slide>,
}

impl Balance {
    /// Takes `factor` times another balance away.
    pub fn subtract(&mut self, pool: &mut Pool, factor: ExprId, other: &Balance) {
        let minus = pool.neg(factor);
        for (sums, others) in [
            (&mut self.mass, &other.mass),
            (&mut self.forces, &other.forces),
        ] {
            for (&index, sum) in others {
                let entry = sums.get_or_default(index);
                entry.add_scaled(pool, minus, sum);
                if entry.is_zero() {
                    sums.remove(&index);
                }
            }
        }
        self.load.add_scaled(pool, minus, &other.load);
    }
}

/// The expression of an output that cannot be left out, with symbols replaced.
pub(super) fn whole(
    equations: &mut Equations,
    output: OutputId,
    known: &[(Symbol, ExprId)],
) -> ExprId {
    let mut pool = std::mem::take(&mut equations.system.pool);
    let sum = equations.total(&mut pool, output);
    let sum = pool.substitute(sum, known);
    let simple = pool.simplify(sum);
    equations.system.pool = pool;
    simple
}

/// The balances of a mode in which `acting` rows hold; `known` is what it says of the state. `signs` are, per friction, the
/// symbols of the sign of its slip and of the multiplier that presses. None where a slip has two components.
pub(super) fn balances(
    equations: &mut Equations,
    mode: &Mode,
    acting: &[usize],
    known: &[(Symbol, ExprId)],
    signs: &[[Symbol; 2]],
) -> Option<Balances> {
    let mut list = vec![Balance::default(); equations.system.coordinates.len()];
    for (i, j, output) in equations.structure.mass.clone() {
        let (pool, outputs) = (&mut equations.system.pool, &equations.outputs);
        let entry = Masked::of(pool, &outputs[output.0], known);
        if !entry.is_zero() {
            list[i].mass.insert(j, entry.clone());
            list[j].mass.insert(i, entry);
        }
    }
    for (balance, output) in list.iter_mut().zip(equations.structure.forcing.clone()) {
        let (pool, outputs) = (&mut equations.system.pool, &equations.outputs);
        balance.load = Masked::of(pool, &outputs[output.0], known);
    }
    for &row in acting {
        for (j, a) in jacobian(equations, row, known) {
            let column = Masked::always(&equations.system.pool, a);
            list[j].forces.insert(row, column);
        }
    }
    for (row, first) in attitudes(equations, acting) {
        augment(equations, &mut list, row, first, known);
    }
    let slides = slides(equations, mode, acting, known, signs)?;
    for slide in &slides {
        for (j, a) in jacobian(equations, slide.row, known) {
            let pool = &mut equations.system.pool;
            let force = pool.mul(slide.factor, a);
            let sum = match slide.source {
                Some(source) => list[j].forces.get_or_default(source),
                None => &mut list[j].load,
            };
            sum.add(pool, ALWAYS, force);
        }
    }
    for at in 0..equations.structure.couplings.len() {
        let coupling = &equations.structure.couplings[at];
        let (j, row, need) = (coupling.coordinate, coupling.row, coupling.need);
        let factor = whole(equations, coupling.factor, known);
        let pool = &mut equations.system.pool;
        if acting.contains(&row) {
            list[j].forces.get_or_default(row).add(pool, need, factor);
        } else if let Some(slide) = slides.iter().find(|slide| slide.row == row) {
            let force = pool.mul(factor, slide.factor);
            let sum = match slide.source {
                Some(source) => list[j].forces.get_or_default(source),
                None => &mut list[j].load,
            };
            sum.add(pool, need, force);
        }
    }
    Some(Balances { list, slides })
}

/// The acting rows that keep quaternions at unit length, with the first of the four coordinates.
pub(super) fn attitudes(equations: &Equations, acting: &[usize]) -> Vec<(usize, usize)> {
    let constraints = equations.system.constraints.iter().enumerate();
    let rows = constraints.filter_map(|(row, constraint)| Some((row, constraint.attitude?)));
    rows.filter(|(row, _)| acting.contains(row)).collect()
}

/// Adds κ aᵀ (a v̇ + γ) of this row to the balances of the quaternion.
fn augment(
    equations: &mut Equations,
    list: &mut [Balance],
    row: usize,
    first: usize,
    known: &[(Symbol, ExprId)],
) {
    let a = jacobian(equations, row, known);
    let bias = whole(equations, equations.structure.rows[row].bias, known);
    let pool = &mut equations.system.pool;
    let (one, twelve) = (pool.integer(1), pool.integer(12));
    let Some(twelfth) = pool.div(one, twelve) else {
        return;
    };
    let mut trace = Masked::default();
    for (j, balance) in list.iter().enumerate().skip(first).take(4) {
        if let Some(inertia) = balance.mass.get(&j) {
            trace.add_scaled(pool, one, inertia);
        }
    }
    let trace = trace.simplified(pool);
    for &(i, left) in &a {
        let part = pool.mul(twelfth, left);
        for &(j, right) in &a {
            let square = pool.mul(part, right);
            let entry = list[i].mass.get_or_default(j);
            entry.add_scaled(pool, square, &trace);
            *entry = entry.simplified(pool);
        }
        let load = pool.mul(part, bias);
        let load = pool.neg(load);
        list[i].load.add_scaled(pool, load, &trace);
    }
}

/// The row of the Jacobian, without zeros.
pub(super) fn jacobian(
    equations: &mut Equations,
    row: usize,
    known: &[(Symbol, ExprId)],
) -> Vec<(usize, ExprId)> {
    let entries = equations.structure.rows[row].jacobian.clone();
    let mut row = Vec::with_capacity(entries.len());
    for (j, output) in entries {
        let a = whole(equations, output, known);
        if !equations.system.pool.is_zero(a) {
            row.push((j, a));
        }
    }
    row
}

fn slides(
    equations: &mut Equations,
    mode: &Mode,
    acting: &[usize],
    known: &[(Symbol, ExprId)],
    signs: &[[Symbol; 2]],
) -> Option<Vec<Slide>> {
    let mut slides = Vec::new();
    for (i, &[direction, pressing]) in signs.iter().enumerate() {
        match mode.frictions[i] {
            FrictionState::Inactive | FrictionState::Stick => continue,
            FrictionState::Slip(Direction::Fixed(_)) => {}
            // A slip in space turns, and vanishes in ways that the interpreter knows.
            FrictionState::Slip(_) => return None,
        }
        let friction = &equations.structure.frictions[i];
        let (row, given) = (friction.row, friction.given_normal);
        let coefficient = friction.kinetic_coefficient;
        let mut factor = whole(equations, coefficient, known);
        let constraints = equations.system.constraints.len();
        let source = match equations.system.frictions[i].normal {
            Normal::Contact(contact) => {
                if let Some(output) = equations.structure.contacts[contact].normal_factor {
                    let normal = whole(equations, output, known);
                    factor = equations.system.pool.mul(factor, normal);
                }
                Some(constraints + contact)
            }
            Normal::Constraint(constraint) => {
                let pool = &mut equations.system.pool;
                let pressing = pool.leaf(pressing);
                factor = pool.mul(factor, pressing);
                Some(constraint)
            }
            // Nothing linear says what presses: the interpreter looks for its direction.
            Normal::Resultant(_) => return None,
            Normal::Given(_) => {
                let normal = whole(equations, given?, known);
                factor = equations.system.pool.mul(factor, normal);
                None
            }
        };
        if source.is_some_and(|row| !acting.contains(&row)) {
            continue;
        }
        let pool = &mut equations.system.pool;
        let direction = pool.leaf(direction);
        let factor = pool.mul(factor, direction);
        let factor = pool.neg(factor);
        slides.push(Slide {
            row,
            factor,
            source,
        });
    }
    Some(slides)
}
