//! The tapes of a mode, recorded, and where each number has its Taylor coefficients.

use crate::arithmetic::{Arithmetic, Coefficients, Recorded, Recording, Scalar, Slot, Variation};
use crate::linear::{Entry, Plan};
use crate::system::{Description, Held, Place, System};

/// Coefficient table: zero | t q v v̇ λ | constants | motion tape | report tape | plan's program.
#[derive(Clone, Debug, Default)]
pub(super) struct Table<T> {
    pub coefficients: Coefficients<T>,
    /// Whether everything is that of the present mode and needs.
    current: bool,
    order: usize,
    /// Whether the coordinates that cannot accelerate are known to be at rest.
    pinned_at_rest: bool,
    /// The motion tape and the plan's program.
    pub motion: Recording<T>,
    pub report: Recording<T>,
    /// t, q, v, v̇, λ of all rows.
    inputs: Vec<Recorded>,
    /// Outputs of the motion tape, then results of the plan's program.
    pub nodes: Vec<Recorded>,
    pub report_nodes: Vec<Recorded>,
    /// λ of the rows kept, in the order of the unknowns.
    pub kept: Vec<Slot>,
    /// What is not a parameter-only number in the right-hand sides: (row, factor, node).
    pub loads: Vec<(usize, T, Slot)>,
    /// Elements of the matrix times accelerations, to be subtracted from the right-hand sides.
    pub with_accelerations: Vec<Product>,
    /// The same with forces, to be added: the unknown is −λ, the table holds λ.
    pub with_forces: Vec<Product>,
    /// What is not a parameter-only number in the forces of eliminated rows.
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
    pub element: Recorded,
    pub unknown: Slot,
    /// Whether the unknown is a force, stored with the other sign.
    pub subtract: bool,
}

/// First slots of the parts.
struct Layout {
    inputs: usize,
    constants: usize,
    motion: usize,
    report: usize,
    program: usize,
}

fn layout(d: &Description) -> Layout {
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

/// What the tapes of a mode are told.
pub(super) struct Tapes<'a, S: System> {
    pub scene: &'a S,
    pub constants: &'a [S::Scalar],
    pub plan: &'a Plan<S::Scalar>,
    pub motion: Held<'a>,
    /// None: nothing is asked of the report.
    pub report: Option<Held<'a>>,
}

impl<T: Scalar> Table<T> {
    /// The mode or the needs have changed: everything is made anew before the next series.
    pub(super) fn outdate(&mut self) {
        self.current = false;
    }

    /// Shapes the table and records the tapes, unless that has been done. `pinned_at_rest`: coordinates that cannot
    /// accelerate have no velocity either.
    pub(super) fn prepare<S: System<Scalar = T>>(
        &mut self,
        tapes: &Tapes<S>,
        order: usize,
        pinned_at_rest: bool,
    ) {
        if self.current && self.order == order && self.pinned_at_rest == pinned_at_rest {
            return;
        }
        (self.current, self.order, self.pinned_at_rest) = (true, order, pinned_at_rest);
        let d = S::DESCRIPTION;
        let parts = layout(d);
        let (plan, constants) = (tapes.plan, tapes.constants);
        self.coefficients
            .shape(parts.program + plan.program.len(), order);
        for (i, &c) in constants[..d.constants].iter().enumerate() {
            let slot = self.coefficients.slot(parts.constants + i);
            self.coefficients.put(slot, 0, c);
        }
        self.classify_inputs(d, plan);
        let stride = self.coefficients.stride();
        self.nodes.clear();
        self.nodes
            .resize(d.motion.outputs + plan.program.len(), Recorded::ZERO);
        self.motion.clear();
        let mut a = self.motion.record(parts.motion, stride);
        let inputs = &self.inputs[..1 + 2 * d.coordinates.len()];
        let outputs = &mut self.nodes[..d.motion.outputs];
        tapes
            .scene
            .motion(&mut a, &tapes.motion, constants, inputs, outputs);
        a.origin(parts.program);
        plan.program.run(&mut a, constants, &mut self.nodes);
        self.report_nodes.clear();
        self.report_nodes.resize(d.report.outputs, Recorded::ZERO);
        self.report.clear();
        if let Some(held) = &tapes.report {
            let mut a = self.report.record(parts.report, stride);
            tapes.scene.report(
                &mut a,
                held,
                constants,
                &self.inputs,
                &mut self.report_nodes,
            );
        }
        self.resolve(d, plan);
    }

    /// Slots of the inputs, and what is known of them in the mode.
    fn classify_inputs(&mut self, d: &Description, plan: &Plan<T>) {
        let n = d.coordinates.len();
        let parts = layout(d);
        let slots = (parts.inputs..parts.constants)
            .map(|slot| Recorded::varying(self.coefficients.slot(slot)));
        self.inputs.clear();
        self.inputs.extend(slots);
        for j in (0..n).filter(|&j| plan.is_pinned(j)) {
            self.inputs[1 + 2 * n + j].variation = Variation::Zero;
            if self.pinned_at_rest {
                self.inputs[1 + n + j].variation = Variation::Zero;
                self.inputs[1 + j].variation = Variation::Constant;
            } else {
                self.inputs[1 + n + j].variation = Variation::Constant;
            }
        }
        for row in 0..d.rows.len() {
            if !plan.has_force(row) {
                self.inputs[1 + 3 * n + row].variation = Variation::Zero;
            }
        }
    }

    /// The plan's lists in terms of slots.
    fn resolve(&mut self, d: &Description, plan: &Plan<T>) {
        let (inputs, nodes) = (&self.inputs, &self.nodes);
        let (free, size) = (plan.free(), plan.size());
        let accelerations = &inputs[1 + 2 * d.coordinates.len()..];
        let forces = &inputs[1 + 3 * d.coordinates.len()..];
        let unknown = |column: usize| match column.checked_sub(free) {
            None => accelerations[plan.elimination.free[column]].slot,
            Some(index) => forces[plan.kept[index]].slot,
        };
        self.kept.clear();
        self.kept
            .extend(plan.kept.iter().map(|&row| forces[row].slot));
        let loads = plan
            .loads
            .iter()
            .map(|load| (load.row, load.factor, nodes[load.node]));
        let loads = loads.filter(|(_, _, node)| node.variation != Variation::Zero);
        self.loads.clear();
        self.loads
            .extend(loads.map(|(row, factor, node)| (row, factor, node.slot)));
        let product = |e: &Entry| Product {
            row: e.row,
            element: nodes[e.node].slot,
            unknown: unknown(e.column),
        };
        // A constant element takes nothing from earlier coefficients.
        let varies = |e: &&Entry| nodes[e.node].variation == Variation::Varying;
        let (with_accelerations, with_forces) = plan.entries.split_at(plan.first_force);
        self.with_accelerations.clear();
        self.with_accelerations
            .extend(with_accelerations.iter().filter(varies).map(product));
        self.with_forces.clear();
        self.with_forces
            .extend(with_forces.iter().filter(varies).map(product));
        let parts = plan.force_entries.iter().map(|e| ForcePart {
            force: forces[plan.eliminated[e.row - size]].slot,
            element: nodes[e.node],
            unknown: unknown(e.column),
            subtract: e.column >= free,
        });
        self.force_parts.clear();
        self.force_parts
            .extend(parts.filter(|part| part.element.variation != Variation::Zero));
    }

    /// The order of the present series.
    pub(super) fn order(&self) -> usize {
        self.order
    }

    /// Slot of an input: t, q, v, v̇, λ of all rows.
    #[inline]
    pub(super) fn input(&self, index: usize) -> Slot {
        self.inputs[index].slot
    }

    /// The coefficients of a number, given what the tape's outputs are.
    pub(super) fn series(&self, d: &Description, place: Place, nodes: &[Recorded]) -> &[T] {
        let slot = match place {
            Place::Zero => self.coefficients.slot(0),
            Place::Constant(i) => self.coefficients.slot(layout(d).constants + i),
            Place::Node(i) => nodes[i].slot,
        };
        self.coefficients.series(slot)
    }
}
