//! Where each number of the Taylor expansion has its coefficients.

use crate::arithmetic::{Coefficients, Scalar, Slot};
use crate::linear::Plan;
use crate::system::{Description, Place};

/// Coefficient table: zero | t q v v̇ λ | constants | motion tape | report tape | plan's program.
#[derive(Clone, Debug, Default)]
pub(super) struct Table<T> {
    pub coefficients: Coefficients<T>,
    /// Whether shape and constants are those of the present mode.
    current: bool,
    /// Whether the lists below are those of the present mode.
    resolved: bool,
    order: usize,
    /// t, q, v, v̇, λ of all rows.
    pub inputs: Vec<Slot>,
    /// Outputs of the motion tape, then results of the plan's program.
    pub nodes: Vec<Slot>,
    pub report_nodes: Vec<Slot>,
    /// λ of the rows kept, in the order of the unknowns.
    pub kept: Vec<Slot>,
    /// What changes in the right-hand sides: (row, factor, node).
    pub loads: Vec<(usize, T, Slot)>,
    /// Elements of the matrix times accelerations, to be subtracted from the right-hand sides.
    pub with_accelerations: Vec<Product>,
    /// The same with forces, to be added: the unknown is −λ, the table holds λ.
    pub with_forces: Vec<Product>,
    /// What changes in the forces of eliminated rows.
    pub force_parts: Vec<ForcePart>,
}

/// An element of the matrix and the unknown that it multiplies.
#[derive(Clone, Copy, Debug)]
pub(super) struct Product {
    pub row: usize,
    pub element: Slot,
    pub unknown: Slot,
}

/// λ of an eliminated row += ± element · unknown.
#[derive(Clone, Copy, Debug)]
pub(super) struct ForcePart {
    pub force: Slot,
    pub element: Slot,
    pub unknown: Slot,
    /// Whether the unknown is a force, stored with the other sign.
    pub subtract: bool,
}

/// First slots of the parts.
pub(super) struct Layout {
    pub inputs: usize,
    pub constants: usize,
    pub motion: usize,
    pub report: usize,
    pub program: usize,
}

pub(super) fn layout(d: &Description) -> Layout {
    let inputs = 1;
    let constants = inputs + 1 + 3 * d.coordinates.len() + d.rows.len();
    let motion = constants + d.constants;
    let report = motion + d.motion.slots;
    Layout {
        inputs,
        constants,
        motion,
        report,
        program: report + d.report.slots,
    }
}

impl<T: Scalar> Table<T> {
    /// The mode has changed: everything is made anew before the next series.
    pub(super) fn outdate(&mut self) {
        self.current = false;
    }

    /// Shape, constants and the slots of the inputs.
    pub(super) fn prepare(
        &mut self,
        d: &Description,
        constants: &[T],
        plan: &Plan<T>,
        order: usize,
    ) {
        if self.current && self.order == order {
            return;
        }
        (self.current, self.resolved, self.order) = (true, false, order);
        let parts = layout(d);
        let program = plan.program.len();
        self.coefficients.shape(parts.program + program, order);
        let stride = self.coefficients.stride();
        self.inputs.clear();
        self.inputs
            .extend((parts.inputs..parts.constants).map(|slot| Slot::new(slot, stride)));
        self.nodes.clear();
        self.nodes
            .resize(d.motion.outputs + program, Slot::new(0, stride));
        self.report_nodes.clear();
        self.report_nodes
            .resize(d.report.outputs, Slot::new(0, stride));
        for (i, &c) in constants[..d.constants].iter().enumerate() {
            self.coefficients
                .put(Slot::new(parts.constants + i, stride), 0, c);
        }
        // dt/dτ = 1
        if order > 0 {
            self.coefficients.put(self.inputs[0], 1, T::one());
        }
    }

    /// The plan's lists in terms of slots; the tape has run once and said which they are.
    pub(super) fn resolve(&mut self, d: &Description, plan: &Plan<T>) {
        if self.resolved {
            return;
        }
        self.resolved = true;
        let (inputs, nodes) = (&self.inputs, &self.nodes);
        let (free, size) = (plan.free(), plan.size());
        let accelerations = &inputs[1 + 2 * d.coordinates.len()..];
        let forces = &inputs[1 + 3 * d.coordinates.len()..];
        let unknown = |column: usize| match column.checked_sub(free) {
            None => accelerations[plan.elimination.free[column]],
            Some(index) => forces[plan.kept[index]],
        };
        self.kept.clear();
        self.kept.extend(plan.kept.iter().map(|&row| forces[row]));
        self.loads.clear();
        self.loads.extend(
            plan.loads
                .iter()
                .map(|load| (load.row, load.factor, nodes[load.node])),
        );
        let product = |e: &crate::linear::Entry| Product {
            row: e.row,
            element: nodes[e.node],
            unknown: unknown(e.column),
        };
        let (with_accelerations, with_forces) = plan.entries.split_at(plan.first_force);
        self.with_accelerations.clear();
        self.with_accelerations
            .extend(with_accelerations.iter().map(product));
        self.with_forces.clear();
        self.with_forces.extend(with_forces.iter().map(product));
        self.force_parts.clear();
        self.force_parts
            .extend(plan.force_entries.iter().map(|e| ForcePart {
                force: forces[plan.eliminated[e.row - size]],
                element: nodes[e.node],
                unknown: unknown(e.column),
                subtract: e.column >= free,
            }));
    }

    /// The coefficients of a number, given the slots of the tape's outputs.
    pub(super) fn series(&self, d: &Description, place: Place, nodes: &[Slot]) -> &[T] {
        let slot = match place {
            Place::Zero => self.coefficients.slot(0),
            Place::Constant(i) => self.coefficients.slot(layout(d).constants + i),
            Place::Node(i) => nodes[i],
        };
        self.coefficients.series(slot)
    }
}
