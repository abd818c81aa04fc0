//! The solution of small systems, and the forces that follow from any solution, written down on the tape.

use super::compiled::Compiled;
use crate::arithmetic::{Arithmetic, Recorded, Recorder, Scalar, Slot};
use crate::linear::{Plan, positive_definite};
use crate::system::Place;

/// A number that the tape divides by to solve the equations. Where it is not safe to do so the solver must.
#[derive(Clone, Debug)]
pub(super) struct Pivot {
    pub(super) element: Slot,
    /// Elements that it must not be small against.
    pub(super) against: Vec<Slot>,
    share: f64,
    /// Whether it must be positive.
    positive: bool,
}

impl Pivot {
    /// Whether dividing by it is safe.
    #[inline]
    pub(super) fn is_safe<T: Scalar>(&self, registers: &[T]) -> bool {
        let at = |slot: &Slot| registers[slot.index()].value();
        let size = self
            .against
            .iter()
            .fold(0.0, |size, slot| at(slot).abs().max(size));
        let pivot = at(&self.element);
        let pivot = if self.positive { pivot } else { pivot.abs() };
        pivot > self.share * size && size > 0.0
    }
}

/// Right-hand sides of the equations and of the forces of eliminated rows.
pub(super) fn right_hand_sides<T: Scalar>(
    a: &mut Recorder<'_, T>,
    plan: &Plan<T>,
    nodes: &[Recorded],
) -> Vec<Recorded> {
    let constants = plan.constant_load.iter().enumerate();
    constants
        .map(|(row, &constant)| {
            let loads = plan.loads.iter().filter(|load| load.row == row);
            let to = a.fresh();
            let sum = a.push_sum(
                to.index(),
                loads.map(|load| (load.factor, nodes[load.node])),
            );
            let to = a.fresh();
            a.offset(to.index(), constant, sum)
        })
        .collect()
}

/// Largest system that a tape solves.
const MOST_ON_TAPE: usize = 3;

/// The unknowns: solved for on the tape, by which pivots, if there are only a few accelerations; else left to the solver.
pub(super) fn solve<T: Scalar>(
    a: &mut Recorder<'_, T>,
    compiled: &Compiled<T>,
    nodes: &[Recorded],
    inputs: &[Recorded],
    n: usize,
    right: &[Recorded],
) -> (Vec<Recorded>, Vec<Pivot>) {
    let plan = &compiled.plan;
    let size = plan.size();
    let alone = compiled.on_tape && plan.headings.is_empty();
    if alone && plan.kept.is_empty() && (1..=MOST_ON_TAPE).contains(&size) {
        return eliminate(a, plan, nodes, 2 + 2 * n, right);
    }
    let unknowns = (0..size).map(|column| {
        let free = plan.elimination.free.get(column);
        let own = || a.fresh();
        Recorded::varying(free.map_or_else(own, |&j| inputs[1 + 2 * n + j].slot))
    });
    (unknowns.collect(), Vec::new())
}

/// Gaussian elimination without row exchanges, on the tape; accelerations begin at that register.
fn eliminate<T: Scalar>(
    a: &mut Recorder<'_, T>,
    plan: &Plan<T>,
    nodes: &[Recorded],
    accelerations: usize,
    right: &[Recorded],
) -> (Vec<Recorded>, Vec<Pivot>) {
    let size = plan.size();
    let mut matrix = vec![vec![Recorded::ZERO; size]; size];
    for (i, row) in matrix.iter_mut().enumerate() {
        for (j, element) in row.iter_mut().enumerate() {
            let entries = plan.entries.iter().filter(|e| (e.row, e.column) == (i, j));
            let to = a.fresh();
            let changing = a.push_sum(to.index(), entries.map(|e| (T::one(), nodes[e.node])));
            let to = a.fresh();
            *element = a.offset(to.index(), plan.constant[i * size + j], changing);
        }
    }
    // Rows with few elements first: they leave the others as they are. The order holds for rows and columns alike.
    let mut order: Vec<usize> = (0..size).collect();
    order.sort_by_key(|&i| {
        let others = (0..size).filter(|&j| j != i);
        let count = others.filter(|&j| !(matrix[i][j].is_zero() && matrix[j][i].is_zero()));
        (count.count(), matrix[i][i].varies(), i)
    });
    let mut b = right[..size].to_vec();
    let mut pivots = Vec::new();
    let diagonal: Vec<Recorded> = (0..size).map(|i| matrix[i][i]).collect();
    for (step, &p) in order.iter().enumerate() {
        let rest = &order[step + 1..];
        pivots.push(pivot(plan, &matrix, diagonal[p], p, rest));
        for &i in rest
            .iter()
            .filter(|&&i| !matrix[i][p].is_zero())
            .collect::<Vec<_>>()
        {
            let to = a.fresh();
            let factor = a.div(to.index(), matrix[i][p], matrix[p][p]);
            for &j in rest {
                let mirrored = plan.elimination.symmetric && j < i && !matrix[j][p].is_zero();
                if mirrored && rest.iter().position(|&x| x == j) < rest.iter().position(|&x| x == i)
                {
                    matrix[i][j] = matrix[j][i];
                    continue;
                }
                matrix[i][j] = subtract(a, matrix[i][j], factor, matrix[p][j]);
            }
            b[i] = subtract(a, b[i], factor, b[p]);
        }
    }
    let mut x = vec![Recorded::ZERO; size];
    for (step, &p) in order.iter().enumerate().rev() {
        let mut sum = b[p];
        for &j in &order[step + 1..] {
            sum = subtract(a, sum, matrix[p][j], x[j]);
        }
        if !sum.is_zero() {
            let to = accelerations + plan.elimination.free[p];
            x[p] = a.div(to, sum, matrix[p][p]);
        }
    }
    (x, pivots)
}

/// What makes it safe to divide by element p of the diagonal, which was `original` before the elimination.
fn pivot<T: Scalar>(
    plan: &Plan<T>,
    matrix: &[Vec<Recorded>],
    original: Recorded,
    p: usize,
    rest: &[usize],
) -> Pivot {
    /// Factors up to this size lose two digits.
    const SMALLEST: f64 = 0.01;
    let element = matrix[p][p].slot;
    if plan.elimination.symmetric {
        return Pivot {
            element,
            against: vec![original.slot],
            share: positive_definite::<T>(),
            positive: true,
        };
    }
    let below = rest.iter().map(|&i| matrix[i][p]).filter(|e| !e.is_zero());
    Pivot {
        element,
        against: core::iter::once(element)
            .chain(below.map(|e| e.slot))
            .collect(),
        share: SMALLEST,
        positive: false,
    }
}

/// x − y z
fn subtract<T: Scalar>(a: &mut Recorder<'_, T>, x: Recorded, y: Recorded, z: Recorded) -> Recorded {
    if y.is_zero() || z.is_zero() {
        return x;
    }
    let to = a.fresh();
    let product = a.mul(to.index(), y, z);
    let to = a.fresh();
    a.sub(to.index(), x, product)
}

/// Accelerations and forces from the unknowns, into the inputs of the report.
pub(super) fn forces<T: Scalar>(
    a: &mut Recorder<'_, T>,
    compiled: &Compiled<T>,
    n: usize,
    nodes: &[Recorded],
    unknowns: &[Recorded],
    right: &[Recorded],
    inputs: &mut [Recorded],
) {
    let (plan, constants) = (&compiled.plan, &compiled.constants);
    for j in (0..n).filter(|&j| !plan.is_pinned(j)) {
        let slot = Slot::new(2 + 2 * n + j);
        let parts = plan.elimination.right.row(j).iter();
        let sum = a.push_sum(
            slot.index(),
            parts.map(|&(column, factor)| (factor, unknowns[column])),
        );
        inputs[1 + 2 * n + j] = a.assign(slot, sum);
    }
    let force = |row: usize| 1 + 3 * n + row;
    for row in 0..inputs.len() - force(0) {
        inputs[force(row)] = Recorded::ZERO;
    }
    let place = |row: usize| Slot::new(1 + force(row));
    for (&row, &unknown) in plan.kept.iter().zip(&unknowns[plan.free()..]) {
        let negative = a.neg(place(row).index(), unknown);
        inputs[force(row)] = a.assign(place(row), negative);
    }
    let size = plan.size();
    for (index, &row) in plan.eliminated.iter().enumerate() {
        let elements = &plan.constant[(size + index) * size..(size + index + 1) * size];
        let to = a.fresh();
        let mut sum = a.push_sum(
            to.index(),
            elements.iter().copied().zip(unknowns.iter().copied()),
        );
        for entry in plan.force_entries.iter().filter(|e| e.row == size + index) {
            let to = a.fresh();
            let product = a.mul(to.index(), nodes[entry.node], unknowns[entry.column]);
            let to = a.fresh();
            sum = a.add(to.index(), sum, product);
        }
        let value = a.sub(place(row).index(), sum, right[size + index]);
        inputs[force(row)] = a.assign(place(row), value);
    }
    for slide in &plan.slides {
        let to = place(slide.row);
        let normal = slide.source.map(|source| inputs[force(source)]);
        let value = match (slide.factor, normal) {
            (Place::Zero, _) => Recorded::ZERO,
            (Place::Constant(c), Some(normal)) => a.scale(to.index(), constants[c], normal),
            (Place::Constant(c), None) => a.constant(to.index(), constants[c]),
            (Place::Node(node), Some(normal)) => a.mul(to.index(), nodes[node], normal),
            (Place::Node(node), None) => nodes[node],
        };
        inputs[force(slide.row)] = a.assign(to, value);
    }
}
