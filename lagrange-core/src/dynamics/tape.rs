//! The tapes of a mode as one recording: motion, solution, forces, report.
//!
//! Registers: zero | t q v v̇ λ | motion tape | report tape | plan's program | what the recorder needs beside.

use super::Operations;
use super::compiled::{Asked, Compiled};
use super::needs::NeedSet;
use super::solution::{Pivot, forces, right_hand_sides, solve};
use super::values::Extent;
use crate::arithmetic::{
    Arithmetic, Coefficient, Expansion, Given, Numbers, Program, Recorded, Recording, Scalar, Slot,
    Variation,
};
use crate::linear::Plan;
use crate::system::{Description, Held, Place};
use crate::tapes::{Call, Tapes, Which};
use std::sync::Arc;

/// Parts of the recording.
pub(super) const MOTION: usize = 0;
/// After the solution: accelerations and forces.
pub(super) const FORCES: usize = 1;
/// The report tape.
pub(super) const REPORT: usize = 2;

/// A linear system that the tape leaves to the solver.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Unsolved {
    /// Right-hand sides of the equations.
    pub right: Vec<Recorded>,
    /// Where the unknowns go.
    pub unknowns: Vec<Slot>,
    /// Elements that change with time: (equation, element, unknown).
    pub elements: Vec<(usize, Slot, Slot)>,
}

impl Unsolved {
    /// Right-hand sides of one order, from the coefficients `now`, the values `first`, and what `earlier` coefficients of the elements
    /// and unknowns give.
    #[inline(always)]
    pub(super) fn right_hand_sides<C: Coefficient>(
        &self,
        now: &[C],
        first: &[C],
        earlier: &[C],
        right: &mut Vec<C>,
    ) {
        right.clear();
        right.extend(self.right.iter().map(|r| now[r.slot.index()]));
        let elements = self.elements.iter().zip(earlier);
        for (&(equation, element, unknown), &earlier) in elements {
            let product = now[element.index()] * first[unknown.index()];
            right[equation] = right[equation] - (product + earlier);
        }
    }
}

/// The recorded equations of a mode without their numbers.
#[derive(Debug, PartialEq)]
pub(super) struct Shape {
    /// Motion, forces and report.
    pub everything: Program,
    /// Accelerations alone.
    accelerations: Program,
    /// Positions and velocities that may change, with their rates.
    pub integrals: Vec<(Slot, Slot)>,
    /// None: the tape solves for the accelerations itself.
    pub unsolved: Option<Unsolved>,
    /// Whose series are kept.
    pub wanted: Vec<Recorded>,
    /// How many registers there are, and how many of them are used.
    pub registers: usize,
    pub used: usize,
}

impl Shape {
    /// Memory to expand it in.
    pub(super) fn expansion<C: Coefficient>(&self) -> Expansion<C> {
        let elements = self.unsolved.as_ref().map(|unsolved| {
            let elements = unsolved.elements.iter();
            elements
                .map(|&(_, element, unknown)| (element, unknown))
                .collect::<Vec<_>>()
        });
        Expansion::new(
            &self.everything,
            self.registers,
            &self.wanted,
            elements.as_deref(),
        )
    }
}

/// The recorded equations of a mode, and their registers.
#[derive(Clone, Debug)]
pub(super) struct Tape<T> {
    held: NeedSet,
    extra: NeedSet,
    report: Option<NeedSet>,
    at_rest: bool,
    /// What runs; shared with other motions that do the same with other numbers.
    pub shape: Arc<Shape>,
    pub registers: Vec<T>,
    /// Exchanges the numbers in the registers that depend on parameters.
    numbers: Numbers<T>,
    /// Whether the numbers are those of other parameters.
    outdated: bool,
    /// Whether the registers hold everything at the state in them.
    pub evaluated: bool,
    pub expansion: Expansion<T>,
    /// Order of the series held.
    pub order: usize,
    /// t, q, v, v̇, λ of all rows.
    inputs: Vec<Recorded>,
    /// Outputs of the motion tape, then results of the plan's program.
    pub nodes: Vec<Recorded>,
    report_nodes: Vec<Recorded>,
    /// What it divides by when it does.
    pub pivots: Vec<Pivot>,
    /// Directions given from outside: (friction, components, their rates).
    pub headings: Vec<(usize, [Slot; 2], [Slot; 2])>,
}

struct Layout {
    motion: usize,
    report: usize,
    program: usize,
    end: usize,
}

fn layout(d: &Description, program: usize) -> Layout {
    let motion = 2 + 3 * d.coordinates.len() + d.rows.len();
    let report = motion + d.motion.slots;
    let first = report + d.report.slots;
    Layout {
        motion,
        report,
        program: first,
        end: first + program,
    }
}

impl<T: Scalar> Tape<T> {
    /// Whether the tape was recorded for this.
    pub(super) fn is_for(&self, asked: &Asked) -> bool {
        self.at_rest == asked.at_rest
            && self.extra == *asked.extra
            && self.report.as_ref() == asked.report
    }

    /// Arithmetic operations of one evaluation; the solver's are those of elimination by pivots.
    pub(super) fn operations(&self) -> Operations {
        let size = self.shape.unsolved.as_ref().map_or(0, |u| u.unknowns.len());
        let solver = size * (size + 1) * (4 * size + 5) / 6 - 2 * size;
        Operations {
            accelerations: self.shape.accelerations.operations() + solver,
            everything: self.shape.everything.operations() + solver,
        }
    }

    /// Whether it takes the coordinates that cannot accelerate as at rest.
    #[inline]
    pub(super) fn is_at_rest(&self) -> bool {
        self.at_rest
    }

    /// Runs a part for values.
    #[inline(always)]
    pub(super) fn evaluate(&mut self, extent: Extent, part: usize) {
        let program = match extent {
            Extent::Everything => &self.shape.everything,
            Extent::Accelerations => &self.shape.accelerations,
        };
        program.evaluate(part, &mut self.registers);
    }

    /// The parameters have changed.
    pub(super) fn outdate(&mut self) {
        self.outdated = true;
    }

    /// Takes the numbers of the present parameters, if they have changed; `given` is memory. False: with them another tape must be
    /// recorded.
    pub(super) fn renew(
        &mut self,
        system: &dyn Tapes<T>,
        compiled: &Compiled<T>,
        given: &mut Given<T>,
    ) -> bool {
        if !self.outdated {
            return true;
        }
        self.evaluated = false;
        collect(system, compiled, &self.held, self.report.as_ref(), given);
        self.outdated = !self.numbers.renew(&given.list, &mut self.registers);
        !self.outdated
    }

    /// Records the equations of a mode; `given` is memory.
    pub(super) fn record(
        system: &dyn Tapes<T>,
        compiled: &Compiled<T>,
        asked: &Asked,
        given: &mut Given<T>,
    ) -> Self {
        let d = system.description();
        let plan = &compiled.plan;
        let parts = layout(d, plan.program.len());
        let n = d.coordinates.len();
        collect(system, compiled, asked.held, asked.report, given);
        let mut recording = Recording::new(parts.end, &given.list);
        let mut inputs = inputs(d, plan, asked.at_rest);
        let mut nodes = vec![Recorded::ZERO; d.motion.outputs];
        let mut report_nodes = vec![Recorded::ZERO; d.report.outputs];
        let branches = &compiled.mode.branches[..];
        let held = Held {
            needs: asked.held,
            branches,
        };
        let mut a = recording.record(parts.motion);
        let state = &inputs[..1 + 2 * n];
        let call = Call {
            arithmetic: &mut a,
            held: &held,
            constants: &compiled.constants,
            inputs: state,
            outputs: &mut nodes,
        };
        system.record(Which::Motion, call);
        nodes.resize(d.motion.outputs + plan.program.len(), Recorded::ZERO);
        a.origin(parts.program);
        let mut headings = Vec::new();
        for heading in &plan.headings {
            let slots = heading.operations.map(|i| Slot::new(parts.program + i));
            for (node, slot) in heading.nodes.into_iter().zip(slots) {
                nodes[node] = Recorded::varying(slot);
            }
            headings.push((heading.friction, slots, [a.fresh(), a.fresh()]));
        }
        plan.program.run(&mut a, &compiled.constants, &mut nodes);
        a.origin(0);
        let right = right_hand_sides(&mut a, plan, &nodes);
        let (unknowns, pivots) = solve(&mut a, compiled, &nodes, &inputs, n, &right);
        a.cut();
        forces(&mut a, compiled, n, &nodes, &unknowns, &right, &mut inputs);
        a.cut();
        if let Some(needs) = asked.report {
            a.origin(parts.report);
            let held = Held { needs, branches };
            let call = Call {
                arithmetic: &mut a,
                held: &held,
                constants: &compiled.constants,
                inputs: &inputs,
                outputs: &mut report_nodes,
            };
            system.record(Which::Report, call);
        }
        let solved = plan.headings.is_empty() && (!pivots.is_empty() || plan.size() == 0);
        let unsolved = (!solved).then(|| Unsolved {
            right: right[..plan.size()].to_vec(),
            unknowns: unknowns.iter().map(|x| x.slot).collect(),
            elements: plan
                .entries
                .iter()
                .filter(|e| nodes[e.node].varies())
                .map(|e| (e.row, nodes[e.node].slot, unknowns[e.column].slot))
                .collect(),
        });
        // What is kept of a series: accelerations are in the velocities.
        let mut wanted = [&inputs[1..1 + 2 * n], &inputs[1 + 3 * n..]].concat();
        asked_places(d, asked.extra, &mut |place| {
            if let Place::Node(node) = place {
                wanted.push(nodes[node]);
            }
        });
        wanted.extend_from_slice(&report_nodes);
        for &(friction, ..) in &headings {
            for row in d.frictions[friction].row..d.frictions[friction].row + 2 {
                if let Place::Node(node) = d.rows[row].velocity {
                    wanted.push(nodes[node]);
                }
            }
        }
        let sides = unsolved.as_ref().map_or(&[][..], |u| &u.right[..]);
        // What the solution needs besides.
        let mut system: Vec<Slot> = sides.iter().map(|r| r.slot).collect();
        for pivot in &pivots {
            system.push(pivot.element);
            system.extend_from_slice(&pivot.against);
        }
        let matrix = plan.entries.iter().map(|e| Place::Node(e.node));
        for place in matrix.chain(plan.cancelling()) {
            if let Place::Node(node) = place {
                system.push(nodes[node].slot);
            }
        }
        let slots = |list: &[Recorded]| list.iter().map(|r| r.slot).collect::<Vec<_>>();
        let accelerations = [slots(&inputs[1 + 2 * n..1 + 3 * n]), system].concat();
        let all = [&slots(&wanted)[..], &accelerations].concat();
        let program = Program::new(&mut recording, &all);
        let accelerations = Program::new(&mut recording, &accelerations);
        let used = recording.registers();
        let (registers, numbers) = recording.finish();
        let changes = (1..1 + 2 * n).filter(|&i| !inputs[i + n].is_zero());
        let changes = changes.map(|i| (inputs[i].slot, inputs[i + n].slot));
        let turns = headings
            .iter()
            .flat_map(|&(_, u, rates)| u.into_iter().zip(rates));
        let shape = Shape {
            everything: program,
            accelerations,
            integrals: changes.chain(turns).collect(),
            unsolved,
            wanted,
            registers: registers.len(),
            used,
        };
        Tape {
            held: asked.held.clone(),
            extra: asked.extra.clone(),
            report: asked.report.cloned(),
            at_rest: asked.at_rest,
            expansion: shape.expansion(),
            shape: Arc::new(shape),
            registers,
            numbers,
            outdated: false,
            evaluated: false,
            order: 0,
            inputs,
            nodes,
            report_nodes,
            pivots,
            headings,
        }
    }

    /// Coefficients of t, q, v, v̇ or λ.
    #[inline]
    pub(super) fn input_series(&self, index: usize) -> &[T] {
        self.expansion.series(self.inputs[index], self.order)
    }

    /// Coefficients of an output of the motion tape.
    #[inline]
    pub(super) fn node_series(&self, node: usize) -> &[T] {
        self.expansion.series(self.nodes[node], self.order)
    }

    /// Coefficients of an output of the report tape.
    #[inline]
    pub(super) fn report_series(&self, node: usize) -> &[T] {
        self.expansion.series(self.report_nodes[node], self.order)
    }

    /// Coefficients of zero.
    pub(super) fn zero_series(&self) -> &[T] {
        self.expansion.series(Recorded::ZERO, self.order)
    }
}

/// All numbers that a recording is given: those of the tapes, and those of the plan.
fn collect<T: Scalar>(
    system: &dyn Tapes<T>,
    compiled: &Compiled<T>,
    held: &NeedSet,
    report: Option<&NeedSet>,
    given: &mut Given<T>,
) {
    let d = system.description();
    let (n, rows) = (d.coordinates.len(), d.rows.len());
    let Compiled {
        mode,
        constants,
        plan,
        ..
    } = compiled;
    let tapes = [
        (Which::Motion, Some(held), 1 + 2 * n, d.motion.outputs),
        (Which::Report, report, 1 + 3 * n + rows, d.report.outputs),
    ];
    given.list.clear();
    for (which, needs, inputs, outputs) in tapes {
        let Some(needs) = needs else { continue };
        let held = Held {
            needs,
            branches: &mode.branches,
        };
        let call = Call {
            arithmetic: &mut *given,
            held: &held,
            constants,
            inputs: &vec![(); inputs],
            outputs: &mut vec![(); outputs],
        };
        system.collect(which, call);
    }
    given.list.extend_from_slice(constants);
    plan.collect(&mut given.list);
}

/// The inputs, and what is known of them in the mode.
fn inputs<T: Scalar>(d: &Description, plan: &Plan<T>, at_rest: bool) -> Vec<Recorded> {
    let n = d.coordinates.len();
    let count = 1 + 3 * n + d.rows.len();
    let mut inputs: Vec<Recorded> = (1..=count)
        .map(|slot| Recorded::varying(Slot::new(slot)))
        .collect();
    for j in (0..n).filter(|&j| plan.is_pinned(j)) {
        inputs[1 + 2 * n + j] = Recorded::ZERO;
        if at_rest {
            inputs[1 + n + j] = Recorded::ZERO;
            inputs[1 + j].variation = Variation::Constant;
        } else {
            inputs[1 + n + j].variation = Variation::Constant;
        }
    }
    inputs
}

/// The numbers of the motion tape that a set of needs asks for.
fn asked_places(d: &Description, needs: &NeedSet, take: &mut dyn FnMut(Place)) {
    for row in d.rows {
        if needs.contains(row.needs.jacobian) {
            row.jacobian.iter().for_each(|&(_, place)| take(place));
        }
        if needs.contains(row.needs.bias) {
            take(row.bias);
        }
        if needs.contains(row.needs.velocity) {
            take(row.velocity);
        }
        if needs.contains(row.needs.position) {
            row.position.into_iter().for_each(&mut *take);
        }
    }
    for contact in d.contacts {
        let needs_of_row = &d.rows[contact.row].needs;
        if needs.contains(needs_of_row.jacobian) {
            contact.normal_factor.into_iter().for_each(&mut *take);
        }
        if needs.contains(needs_of_row.position) {
            contact.region.into_iter().for_each(&mut *take);
        }
    }
    for friction in d.frictions {
        if needs.contains(friction.coefficients_need) {
            take(friction.static_coefficient);
            take(friction.kinetic_coefficient);
            if let crate::system::Normal::Given(place) = friction.normal {
                take(place);
            }
        }
    }
    for branch in d.branches.iter().filter(|b| !b.after_solve) {
        if needs.contains(branch.need) {
            take(branch.guard);
        }
    }
}
