//! The tapes of a mode as one recording: motion, solution, forces, report.
//!
//! Registers: zero | t q v v̇ λ | motion tape | report tape | plan's program | what the recorder needs beside.

use super::Operations;
use super::compiled::{Asked, Compiled};
use super::needs::NeedSet;
use super::values::Extent;
use crate::arithmetic::{
    Arithmetic, Expansion, Program, Recorded, Recorder, Recording, Scalar, Slot, Variation,
};
use crate::linear::{Plan, positive_definite};
use crate::system::{Description, Held, Place};
use crate::tapes::{Call, Tapes};

/// Parts of the recording.
pub(super) const MOTION: usize = 0;
/// After the solution: accelerations and forces.
pub(super) const FORCES: usize = 1;
/// The report tape.
pub(super) const REPORT: usize = 2;

/// A linear system that the tape leaves to the solver.
#[derive(Clone, Debug, Default)]
pub(super) struct Unsolved {
    /// Right-hand sides of the equations.
    pub right: Vec<Recorded>,
    /// Where the unknowns go.
    pub unknowns: Vec<Slot>,
    /// Elements that change with time: (equation, element, unknown).
    pub elements: Vec<(usize, Slot, Slot)>,
}

/// A number that the tape divides by to solve the equations. Where it is not safe to do so the solver must.
#[derive(Clone, Debug)]
pub(super) struct Pivot {
    element: Slot,
    /// Elements that it must not be small against.
    against: Vec<Slot>,
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

/// The recorded equations of a mode, and their registers.
#[derive(Clone, Debug)]
pub(super) struct Tape<T> {
    extra: NeedSet,
    report: Option<NeedSet>,
    at_rest: bool,
    /// Motion, forces and report.
    pub everything: Program,
    /// Accelerations alone.
    accelerations: Program,
    pub registers: Vec<T>,
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
    /// Positions and velocities that may change, with their rates.
    pub integrals: Vec<(Slot, Slot)>,
    /// None: the tape solves for the accelerations itself.
    pub unsolved: Option<Unsolved>,
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
        let size = self.unsolved.as_ref().map_or(0, |u| u.unknowns.len());
        let solver = size * (size + 1) * (4 * size + 5) / 6 - 2 * size;
        Operations {
            accelerations: self.accelerations.operations() + solver,
            everything: self.everything.operations() + solver,
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
            Extent::Everything => &self.everything,
            Extent::Accelerations => &self.accelerations,
        };
        program.evaluate(part, &mut self.registers);
    }

    /// Records the equations of a mode.
    pub(super) fn record(system: &dyn Tapes<T>, compiled: &Compiled<T>, asked: &Asked) -> Self {
        let d = system.description();
        let plan = &compiled.plan;
        let parts = layout(d, plan.program.len());
        let n = d.coordinates.len();
        let mut recording = Recording::new(parts.end);
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
        system.motion_recorded(Call {
            arithmetic: &mut a,
            held: &held,
            constants: &compiled.constants,
            inputs: state,
            outputs: &mut nodes,
        });
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
            system.report_recorded(Call {
                arithmetic: &mut a,
                held: &held,
                constants: &compiled.constants,
                inputs: &inputs,
                outputs: &mut report_nodes,
            });
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
        let (sides, elements) = match &unsolved {
            Some(unsolved) => (&unsolved.right[..], &unsolved.elements[..]),
            None => (&[][..], &[][..]),
        };
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
        let registers = recording.registers_filled();
        let products: Vec<_> = elements.iter().map(|&(_, e, u)| (e, u)).collect();
        let products = unsolved.is_some().then_some(&products[..]);
        let expansion = Expansion::new(&program, registers.len(), &wanted, products);
        let changes = (1..1 + 2 * n).filter(|&i| !inputs[i + n].is_zero());
        let changes = changes.map(|i| (inputs[i].slot, inputs[i + n].slot));
        let turns = headings
            .iter()
            .flat_map(|&(_, u, rates)| u.into_iter().zip(rates));
        Tape {
            extra: asked.extra.clone(),
            report: asked.report.cloned(),
            at_rest: asked.at_rest,
            everything: program,
            accelerations,
            registers,
            evaluated: false,
            expansion,
            order: 0,
            integrals: changes.chain(turns).collect(),
            inputs,
            nodes,
            report_nodes,
            unsolved,
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

/// Right-hand sides of the equations and of the forces of eliminated rows.
fn right_hand_sides<T: Scalar>(
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
fn solve<T: Scalar>(
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
fn forces<T: Scalar>(
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
