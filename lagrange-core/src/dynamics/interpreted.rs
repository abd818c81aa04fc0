//! The equations of a mode as data: what runs where none have been emitted for it.
//!
//! Registers: zero | t q v v̇ λ | numbers | results. The parts of the program follow one another:
//!
//! ```text
//! motion     t, q, v → masses, forces, rows
//! system     → right-hand sides of K w = b, which the solver takes, w = (u̇, −λ of the rows kept)
//! forces     w → v̇, λ of all rows
//! report     t, q, v, v̇, λ → outputs
//! ```

use super::Operations;
use super::output_mask::OutputMask;
use crate::arithmetic::products::Row;
use crate::arithmetic::{Number, Scalar};
use crate::linear::KktPattern;
use crate::mode::Mode;
use crate::program::{Builder, Numbers, Op, Program, Register, Series, room};
use crate::system::{Description, ErasedSystem, Selection, ValueRef};
use core::ops::Range;
use std::sync::Arc;

/// Parts of the program.
pub(super) const MOTION: usize = 0;
pub(super) const SYSTEM: usize = 1;
pub(super) const FORCES: usize = 2;
pub(super) const REPORT: usize = 3;

/// How far from a state those beside it are, for tests of signs.
const BESIDE: f64 = 1e-3;

/// How much of the program runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Extent {
    /// All outputs that are held.
    Everything,
    /// What has a series.
    Series,
    /// What the accelerations need.
    Accelerations,
}

/// What equations are loaded for.
#[derive(Clone, Copy, Debug)]
pub(super) struct Asked<'a> {
    /// Everything that is held of the motion.
    pub held: &'a OutputMask,
    /// Of this, what is asked for beside the motion.
    pub extra: &'a OutputMask,
    /// What is held of the report; none if nothing is asked of it.
    pub report: Option<&'a OutputMask>,
    /// How much of the equations it is.
    pub part: Part,
    /// Whether outputs of the forcing are held. With rows they are not: the forces that they consist of are not asked for.
    pub forcing: bool,
}

/// Which part of the equations is loaded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part {
    /// All: the equations of motion are solved.
    Solution,
    /// Outputs.
    Outputs,
}

/// What the equations of a mode are loaded from.
#[derive(Clone, Copy, Debug)]
pub(super) struct Planned<'a, T> {
    pub mode: &'a Mode,
    /// The system's own, then the plan's.
    pub constants: &'a [T],
    /// How the linear system is solved.
    pub pattern: &'a KktPattern<T>,
}

impl<'a, T> Planned<'a, T> {
    /// The constants that equations loaded for outputs or for a solution read.
    fn constants(self, d: &Description, part: Part) -> &'a [T] {
        match part {
            Part::Solution => self.constants,
            Part::Outputs => &self.constants[..d.constants.outputs],
        }
    }
}

/// The program of a mode without its numbers.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Shape {
    everything: Program,
    series: Program,
    accelerations: Program,
    /// Numbers that may change, with their rates.
    pub integrals: Vec<(Register, Register)>,
    /// Right-hand sides of the equations.
    pub right: Vec<Register>,
    /// Where the unknowns go.
    pub unknowns: Vec<Register>,
    /// Elements of the matrix that change with the state: (equation, element, unknown).
    elements: Vec<(usize, Register, Register)>,
    /// Outputs of the motion program, zero for those that are not held, then those of the plan.
    pub nodes: Vec<Register>,
    pub report_nodes: Vec<Register>,
    /// Outputs of the motion program that are held: (node, register).
    held_nodes: Vec<(usize, Register)>,
    /// Directions given from outside: (friction, components, their rates).
    pub slip_directions: Vec<(usize, [Register; 2], [Register; 2])>,
    /// What presses frictions, given from outside.
    pub resultants: Vec<ResultantRegisters>,
    /// Whose series are kept.
    wanted: Vec<Register>,
    /// Where the numbers are.
    numbers: Range<usize>,
    /// How many registers are used, and the room for them.
    pub used: usize,
    pub registers: usize,
}

/// Where N = Σ uᵢ λᵢ + ρ is given.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ResultantRegisters {
    /// Index into the description.
    pub resultant: usize,
    /// u
    pub along: [Register; 3],
    /// ρ and its rate.
    pub rest: (Register, Register),
    /// Per constraint: the unknown that is −λ; none where the force follows from others.
    pub forces: Vec<Option<usize>>,
}

impl Shape {
    /// The program of this extent.
    pub(super) fn program(&self, extent: Extent) -> &Program {
        match extent {
            Extent::Everything => &self.everything,
            Extent::Series => &self.series,
            Extent::Accelerations => &self.accelerations,
        }
    }

    /// Memory for Taylor coefficients.
    pub(super) fn series<C: Number>(&self) -> Series<C> {
        let elements = self.elements.iter();
        Series::new(
            &self.series,
            self.registers,
            &self.wanted,
            elements.map(|&(_, element, unknown)| (element, unknown)),
            FORCES,
        )
    }

    /// Right-hand sides of one order, from the coefficients `now`, the values `first`, and what `earlier` coefficients of the elements
    /// and unknowns give.
    #[inline(always)]
    pub(super) fn right_hand_sides<C: Number>(
        &self,
        now: &[C],
        first: &[C],
        earlier: &[C],
        right: &mut Vec<C>,
    ) {
        right.clear();
        right.extend(self.right.iter().map(|register| now[register.index()]));
        let elements = self.elements.iter().zip(earlier);
        for (&(equation, element, unknown), &earlier) in elements {
            let product = now[element.index()] * first[unknown.index()];
            right[equation] = right[equation] - (product + earlier);
        }
    }
}

/// The interpreted equations of a mode, for what is asked.
#[derive(Clone, Debug)]
pub(super) struct Interpreted<T> {
    held: OutputMask,
    extra: OutputMask,
    report: Option<OutputMask>,
    part: Part,
    /// Shared with other motions that do the same with other numbers.
    pub shape: Arc<Shape>,
    pub registers: Vec<T>,
    /// Whether the numbers are those of other parameters.
    outdated: bool,
    /// Made when a series is first asked for.
    series: Option<Series<T>>,
    /// Order of the series held.
    order: usize,
}

impl<T: Scalar> Interpreted<T> {
    /// Whether it was made for this.
    pub(super) fn is_for(&self, asked: &Asked) -> bool {
        self.held == *asked.held
            && self.extra == *asked.extra
            && self.report.as_ref() == asked.report
            && self.part == asked.part
    }

    /// Whether any output of the motion program is held.
    #[inline]
    pub(super) fn has_motion(&self) -> bool {
        !self.shape.held_nodes.is_empty()
    }

    /// Arithmetic operations of one evaluation; the solver's are those of elimination by pivots.
    pub(super) fn operations(&self) -> Operations {
        let size = self.shape.unknowns.len();
        let solver = (size * (size + 1) * (4 * size + 5) / 6).saturating_sub(2 * size);
        Operations {
            accelerations: self.shape.accelerations.operations() + solver,
            everything: self.shape.everything.operations() + solver,
        }
    }

    /// Writes a state into the registers, with no acceleration and no force.
    #[inline]
    pub(super) fn place(&mut self, t: T, q: &[T], v: &[T]) {
        let n = q.len();
        let inputs = &mut self.registers[1..self.shape.numbers.start];
        inputs[0] = t;
        inputs[1..1 + n].copy_from_slice(q);
        inputs[1 + n..1 + 2 * n].copy_from_slice(v);
        inputs[1 + 2 * n..].fill(T::default());
    }

    /// Takes those outputs of the motion program that are held.
    #[inline]
    pub(super) fn take_nodes(&self, nodes: &mut [T]) {
        for &(node, register) in &self.shape.held_nodes {
            nodes[node] = self.registers[register.index()];
        }
    }

    /// Sizes of the right-hand sides of the equations at the time and the positions in the registers and at these velocities.
    pub(super) fn right_sides_at(&self, velocities: &[f64]) -> Vec<f64> {
        let mut registers = self.registers.clone();
        let places = registers[2 + velocities.len()..].iter_mut();
        for (place, &v) in places.zip(velocities) {
            *place = T::from_f64(v);
        }
        let program = self.shape.program(Extent::Accelerations);
        for part in [MOTION, SYSTEM] {
            program.evaluate(part, &mut registers);
        }
        let right = self.shape.right.iter();
        right
            .map(|register| registers[register.index()].value().abs())
            .collect()
    }

    /// The registers at states on two sides of that of `n` coordinates in them, with its accelerations and forces.
    pub(super) fn beside(&self, n: usize) -> [Vec<T>; 2] {
        [-BESIDE, BESIDE].map(|step| {
            let mut registers = self.registers.clone();
            for (i, x) in registers[2..2 + 2 * n].iter_mut().enumerate() {
                // Irrational steps: no two changes are in a simple ratio.
                let weight = 0.5 + (i as f64 * 0.618_033_988_749).fract();
                *x += T::from_f64(step * weight);
            }
            let program = self.shape.program(Extent::Series);
            for part in [MOTION, SYSTEM, FORCES, REPORT] {
                program.evaluate(part, &mut registers);
            }
            registers
        })
    }

    /// Runs a part for values.
    #[inline]
    pub(super) fn evaluate(&mut self, extent: Extent, part: usize) {
        let program = self.shape.program(extent);
        program.evaluate(part, &mut self.registers);
    }

    /// Memory of a series of this order, and the values in the registers, which it begins with.
    pub(super) fn series_memory(&mut self, order: usize) -> (&mut Series<T>, &[T]) {
        self.order = order;
        let series = self.series.get_or_insert_with(|| self.shape.series());
        (series, &self.registers)
    }

    /// What an expansion works with.
    pub(super) fn parts(&mut self) -> (&Shape, &mut [T], Option<&mut Series<T>>) {
        (&self.shape, &mut self.registers, self.series.as_mut())
    }

    /// Whether the numbers are those of the present parameters.
    pub(super) fn is_current(&self) -> bool {
        !self.outdated
    }

    /// The parameters have changed.
    pub(super) fn outdate(&mut self) {
        self.outdated = true;
    }

    /// Takes the numbers of the present parameters, if they have changed; `numbers` is memory. False if others of them are zero
    /// now: then it is the program of other parameters.
    pub(super) fn renew(
        &mut self,
        system: &dyn ErasedSystem<T>,
        planned: Planned<'_, T>,
        numbers: &mut Vec<T>,
    ) -> bool {
        if self.outdated {
            collect(system, planned, self.part, numbers);
            let registers = &mut self.registers[self.shape.numbers.clone()];
            let mut pairs = registers.iter().zip(&*numbers);
            if registers.len() != numbers.len() || pairs.any(|(x, y)| x.is_zero() != y.is_zero()) {
                return false;
            }
            registers.copy_from_slice(numbers);
            self.outdated = false;
        }
        true
    }

    /// Loads the equations of a mode; `numbers` is memory.
    pub(super) fn load(
        system: &dyn ErasedSystem<T>,
        planned: Planned<'_, T>,
        asked: &Asked,
        numbers: &mut Vec<T>,
    ) -> Self {
        collect(system, planned, asked.part, numbers);
        let shape = shape(system.description(), planned, asked, numbers);
        let mut registers = vec![T::zero(); shape.registers];
        registers[shape.numbers.clone()].copy_from_slice(numbers);
        Self {
            held: asked.held.clone(),
            extra: asked.extra.clone(),
            report: asked.report.cloned(),
            part: asked.part,
            shape: Arc::new(shape),
            registers,
            outdated: false,
            series: None,
            order: 0,
        }
    }

    /// Coefficients of the positions and velocities of `n` coordinates.
    pub(super) fn state_series(&self, n: usize) -> &[Row<T>] {
        let first = Register::new(2);
        let series = self.series.as_ref();
        series.map_or(&[], |series| series.rows_from(first, 2 * n))
    }

    /// Coefficients of t, q, v or λ, by their index in the inputs of the report.
    #[inline]
    pub(super) fn input_series(&self, index: usize) -> &[T] {
        self.series_of(Register::new(1 + index))
    }

    /// Coefficients of an output of the motion program.
    #[inline]
    pub(super) fn node_series(&self, node: usize) -> &[T] {
        self.series_of(self.shape.nodes[node])
    }

    /// Coefficients of an output of the report.
    #[inline]
    pub(super) fn report_series(&self, node: usize) -> &[T] {
        self.series_of(self.shape.report_nodes[node])
    }

    /// Coefficients of zero.
    pub(super) fn zero_series(&self) -> &[T] {
        self.series_of(Register::ZERO)
    }

    #[inline]
    fn series_of(&self, register: Register) -> &[T] {
        let series = self.series.as_ref();
        series.map_or(&[], |series| series.series(register, self.order))
    }
}

/// The numbers of a mode: constants, parameters, exact numbers of both programs, those of the plan for a solution.
fn collect<T: Scalar>(
    system: &dyn ErasedSystem<T>,
    planned: Planned<'_, T>,
    part: Part,
    numbers: &mut Vec<T>,
) {
    let d = system.description();
    numbers.clear();
    numbers.extend_from_slice(planned.constants(d, part));
    numbers.extend((0..d.parameters.len()).map(|index| system.parameter(index)));
    let exact = d.motion.numbers.iter().chain(d.report.numbers);
    numbers.extend(exact.map(|&number| T::from_f64(number)));
    if part == Part::Solution {
        planned.pattern.collect(numbers);
    }
}

/// Loads the programs and writes the solution between them if it is asked for, for these numbers.
fn shape<T: Scalar>(
    d: &Description,
    planned: Planned<'_, T>,
    asked: &Asked,
    values: &[T],
) -> Shape {
    let Planned { mode, pattern, .. } = planned;
    let constants = planned.constants(d, asked.part);
    let n = d.coordinates.len();
    let inputs: Vec<Register> = (1..2 + 3 * n + d.rows.len()).map(Register::new).collect();
    let first = 1 + inputs.len();
    let of_motion = Numbers {
        constants: first,
        parameters: first + constants.len(),
        exact: first + constants.len() + d.parameters.len(),
    };
    let of_report = Numbers {
        exact: of_motion.exact + d.motion.numbers.len(),
        ..of_motion
    };
    let of_plan = of_report.exact + d.report.numbers.len();
    let held = |needs| Selection {
        needs,
        branches: &mode.branches,
    };
    let mut vanishing = vec![false; first];
    vanishing.extend(values.iter().map(T::is_zero));
    let mut builder = Builder::new(vanishing.len()).vanishing(vanishing);
    let motion = held(asked.held);
    let outputs = builder.load(&d.motion, &motion, of_motion, &inputs[..1 + 2 * n]);
    let held_nodes = outputs.iter().enumerate();
    let held_nodes = held_nodes.filter_map(|(node, register)| Some((node, (*register)?)));
    let is_whole =
        |&(node, _): &(usize, _)| asked.forcing || !d.forcing.contains(&ValueRef::Node(node));
    let held_nodes: Vec<(usize, Register)> = held_nodes.filter(is_whole).collect();
    let outputs = outputs.into_iter().map(Option::unwrap_or_default);
    let mut nodes: Vec<Register> = outputs.collect();
    builder.cut();
    let solution = (asked.part == Part::Solution).then(|| {
        pattern
            .program
            .load(&mut builder, of_motion.constants, of_plan, &mut nodes);
        let slip_directions = pattern.slip_directions.iter().map(|slip_direction| {
            let components = slip_direction.nodes.map(|node| nodes[node]);
            let rates = [builder.fresh(), builder.fresh()];
            (slip_direction.friction, components, rates)
        });
        let slip_directions: Vec<_> = slip_directions.collect();
        let resultants = pattern.resultants.iter().map(|given| {
            let constraints = d.resultants[given.resultant].iter();
            let forces = constraints.map(|&i| {
                let row = d.constraints[i].row;
                let kept = pattern.kept.iter().position(|kept| *kept == row);
                kept.map(|kept| pattern.free() + kept)
            });
            ResultantRegisters {
                resultant: given.resultant,
                along: given.along.map(|node| nodes[node]),
                rest: (nodes[given.rest], builder.fresh()),
                forces: forces.collect(),
            }
        });
        let resultants: Vec<_> = resultants.collect();
        let mut solution = Solution {
            builder: &mut builder,
            pattern,
            nodes: &nodes,
            inputs: &inputs,
            n,
            first: of_plan + pattern.program.numbers().count(),
            constants: of_motion.constants,
        };
        let right = solution.right_hand_sides();
        let unknowns = solution.unknowns();
        solution.builder.cut();
        solution.forces(&unknowns, &right);
        (slip_directions, resultants, right, unknowns)
    });
    if solution.is_none() {
        builder.cut();
    }
    builder.cut();
    let report_nodes = match asked.report {
        Some(needs) => {
            let outputs = builder.load(&d.report, &held(needs), of_report, &inputs);
            outputs.into_iter().map(Option::unwrap_or_default).collect()
        }
        None => vec![Register::ZERO; d.report.outputs],
    };
    let (everything, used) = builder.finish();
    let outputs = Shape {
        nodes,
        report_nodes,
        held_nodes,
        numbers: first..first + values.len(),
        used,
        registers: room(used),
        ..Shape::default()
    };
    let Some((slip_directions, resultants, right, unknowns)) = solution else {
        let nodes = outputs.held_nodes.iter().map(|(_, register)| *register);
        let wanted = nodes.chain(outputs.report_nodes.iter().copied());
        return Shape {
            everything: everything.needed(wanted, used),
            ..outputs
        };
    };
    let (nodes, report_nodes) = (&outputs.nodes, &outputs.report_nodes);
    // What is kept of a series: accelerations are in the velocities.
    let mut wanted = [&inputs[1..1 + 2 * n], &inputs[1 + 3 * n..]].concat();
    asked_places(d, asked.extra, &mut |place| {
        if let ValueRef::Node(node) = place {
            wanted.push(nodes[node]);
        }
    });
    wanted.extend_from_slice(report_nodes);
    for &(friction, ..) in &slip_directions {
        for row in d.frictions[friction].row..d.frictions[friction].row + 2 {
            if let ValueRef::Node(node) = d.rows[row].velocity {
                wanted.push(nodes[node]);
            }
        }
    }
    // What the solution needs.
    let matrix = pattern.entries.iter().map(|e| ValueRef::Node(e.node));
    let system = matrix
        .chain(pattern.cancelling())
        .chain(pattern.taking())
        .filter_map(|place| match place {
            ValueRef::Node(node) => Some(nodes[node]),
            ValueRef::Zero | ValueRef::Constant(_) => None,
        });
    let system: Vec<Register> = system.chain(right.iter().copied()).collect();
    let accelerations = inputs[1 + 2 * n..1 + 3 * n].iter().chain(&system).copied();
    let changes = (1..1 + n).chain((1 + n..1 + 2 * n).filter(|i| !pattern.is_pinned(i - 1 - n)));
    let changes = changes.map(|i| (inputs[i], inputs[i + n]));
    let turns = slip_directions
        .iter()
        .flat_map(|&(_, u, rates)| u.into_iter().zip(rates));
    let presses = resultants.iter().flat_map(|given| {
        let along = given.along.into_iter().map(|u| (u, Register::ZERO));
        along.chain([given.rest])
    });
    let elements = pattern.entries.iter().filter(|e| !nodes[e.node].is_zero());
    let elements = elements.map(|e| (e.row, nodes[e.node], unknowns[e.column]));
    Shape {
        series: everything.needed(wanted.iter().copied().chain(accelerations.clone()), used),
        accelerations: everything.needed(accelerations, used),
        everything,
        integrals: changes.chain(turns).chain(presses).collect(),
        right: right[..pattern.size()].to_vec(),
        elements: elements.collect(),
        unknowns,
        slip_directions,
        resultants,
        wanted,
        ..outputs
    }
}

/// What a mode adds to the program of its motion.
struct Solution<'a, T> {
    builder: &'a mut Builder,
    pattern: &'a KktPattern<T>,
    nodes: &'a [Register],
    inputs: &'a [Register],
    /// Number of coordinates.
    n: usize,
    /// The first number of the rows of eliminated forces.
    first: usize,
    /// The first constant.
    constants: usize,
}

impl<T: Scalar> Solution<'_, T> {
    /// Right-hand sides of the equations and of the forces of eliminated rows.
    fn right_hand_sides(&mut self) -> Vec<Register> {
        let pattern = self.pattern;
        let constant_loads = self.first + pattern.constant_of_forces().len();
        let factors = constant_loads + pattern.constant_load.len();
        let constants = pattern.constant_load.iter().enumerate();
        constants
            .map(|(row, constant)| {
                let loads = pattern.loads.iter().zip(factors..);
                let loads = loads.filter(|(load, _)| load.row == row);
                let terms = loads.map(|(load, at)| (Register::new(at), self.nodes[load.node]));
                let sum = self.builder.sum(terms);
                if constant.is_zero() {
                    return sum;
                }
                let constant = Register::new(constant_loads + row);
                self.builder.push(Op::Add, constant, sum)
            })
            .collect()
    }

    /// Where the unknowns go: accelerations of free coordinates to where they are read.
    fn unknowns(&mut self) -> Vec<Register> {
        let free = self.pattern.elimination.free.iter();
        let mut unknowns: Vec<_> = free.map(|&j| self.inputs[1 + 2 * self.n + j]).collect();
        unknowns.resize_with(self.pattern.size(), || self.builder.fresh());
        unknowns
    }

    /// Accelerations and forces from the unknowns, to where the report reads them.
    fn forces(&mut self, unknowns: &[Register], right: &[Register]) {
        let (pattern, nodes) = (self.pattern, self.nodes);
        let mut factor =
            self.first + pattern.constant_of_forces().len() + pattern.constant_load.len();
        factor += pattern.loads.len();
        for j in 0..self.n {
            let parts = pattern.elimination.right.row(j);
            if !pattern.elimination.free.contains(&j) {
                let terms = parts.iter().zip(factor..);
                let terms = terms.map(|(&(column, _), at)| (Register::new(at), unknowns[column]));
                let sum = self.builder.sum(terms);
                self.builder.copy(self.inputs[1 + 2 * self.n + j], sum);
            }
            factor += parts.len();
        }
        let force = |row: usize| self.inputs[1 + 3 * self.n + row];
        for (&row, &unknown) in pattern.kept.iter().zip(&unknowns[pattern.free()..]) {
            let negative = self.builder.push(Op::Neg, unknown, Register::ZERO);
            self.builder.copy(force(row), negative);
        }
        let size = pattern.size();
        for (index, &row) in pattern.eliminated.iter().enumerate() {
            let elements = &pattern.constant_of_forces()[index * size..(index + 1) * size];
            let places = self.first + index * size..;
            let terms = elements.iter().zip(places).zip(unknowns);
            let terms = terms.filter(|((element, _), _)| !element.is_zero());
            let terms = terms.map(|((_, at), &unknown)| (Register::new(at), unknown));
            let mut sum = self.builder.sum(terms);
            for entry in pattern
                .force_entries
                .iter()
                .filter(|e| e.row == size + index)
            {
                let element = nodes[entry.node];
                let product = self.builder.push(Op::Mul, element, unknowns[entry.column]);
                sum = self.builder.push(Op::Add, sum, product);
            }
            let value = self.builder.push(Op::Sub, sum, right[size + index]);
            self.builder.copy(force(row), value);
        }
        let mut before: Option<(usize, Register)> = None;
        for slide in &pattern.slides {
            let factor = match slide.factor {
                ValueRef::Zero => Register::ZERO,
                ValueRef::Constant(at) => Register::new(self.constants + at),
                ValueRef::Node(node) => nodes[node],
            };
            let value = match (slide.factor, slide.source) {
                (_, None) => factor,
                (ValueRef::Node(_), Some(source)) => {
                    self.builder.push(Op::Mul, factor, force(source))
                }
                (_, Some(source)) => self.builder.push(Op::Scale, factor, force(source)),
            };
            let sum = match before.filter(|(row, _)| *row == slide.row) {
                Some((_, sum)) => self.builder.push(Op::Add, sum, value),
                None => value,
            };
            before = Some((slide.row, sum));
            self.builder.copy(force(slide.row), sum);
        }
    }
}

/// The outputs of the motion program that a set of needs asks for.
fn asked_places(d: &Description, needs: &OutputMask, take: &mut dyn FnMut(ValueRef)) {
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
