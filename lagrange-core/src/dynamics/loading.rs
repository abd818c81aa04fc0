//! Loads the equations of a mode as one program: those of the system as data, with the solution of the linear system between them.

use super::output_mask::OutputMask;
use super::shape::{Asked, Part, Planned, ResultantRegisters, Shape};
use crate::arithmetic::Scalar;
use crate::linear::KktPattern;
use crate::program::{Builder, Numbers, Op, Register, room};
use crate::system::{Description, ErasedSystem, Normal, Selection, ValueRef};

/// How many numbers equations for outputs have.
pub(super) fn most_numbers(d: &Description) -> usize {
    let exact = d.motion.numbers.len() + d.report.numbers.len();
    d.constants.outputs + d.parameters.len() + exact
}

/// The numbers of a mode: constants, parameters, exact numbers of both programs, those of the plan for a solution.
pub(super) fn collect<T: Scalar>(
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
pub(super) fn shape<T: Scalar>(
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
        let mut solution = Solution {
            builder: &mut builder,
            pattern,
            nodes: &nodes,
            inputs: &inputs,
            n,
            first: of_plan + pattern.program.numbers().count(),
            constants: of_motion.constants,
        };
        let slip_directions = solution.slip_directions();
        let resultants = solution.resultants(d);
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
    // Accelerations are in the velocities.
    let mut wanted = [&inputs[1..1 + 2 * n], &inputs[1 + 3 * n..]].concat();
    asked_places(d, asked.extra, &mut |place| {
        wanted.extend(register(place, nodes));
    });
    wanted.extend_from_slice(report_nodes);
    for &(friction, ..) in &slip_directions {
        for row in d.frictions[friction].row..d.frictions[friction].row + 2 {
            wanted.extend(register(d.rows[row].velocity, nodes));
        }
    }
    let matrix = pattern.entries.iter().map(|e| ValueRef::Node(e.node));
    let system = matrix.chain(pattern.cancelling()).chain(pattern.taking());
    let system = system.filter_map(|place| register(place, nodes));
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

/// The register of an output that depends on the state.
fn register(place: ValueRef, nodes: &[Register]) -> Option<Register> {
    match place {
        ValueRef::Node(node) => Some(nodes[node]),
        ValueRef::Zero | ValueRef::Constant(_) => None,
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
    /// Directions of slips that are given: (friction, components, their rates).
    fn slip_directions(&mut self) -> Vec<(usize, [Register; 2], [Register; 2])> {
        let slip_directions = self.pattern.sliding.slip_directions.iter().map(|given| {
            let components = given.nodes.map(|node| self.nodes[node]);
            let rates = [self.builder.fresh(), self.builder.fresh()];
            (given.friction, components, rates)
        });
        slip_directions.collect()
    }

    /// What presses frictions, where it is given.
    fn resultants(&mut self, d: &Description) -> Vec<ResultantRegisters> {
        let pattern = self.pattern;
        let resultants = pattern.sliding.resultants.iter().map(|given| {
            let constraints = d.resultants[given.resultant].iter();
            let forces = constraints.map(|&i| {
                let row = d.constraints[i].row;
                let kept = pattern.kept.iter().position(|kept| *kept == row);
                kept.map(|kept| pattern.free() + kept)
            });
            ResultantRegisters {
                resultant: given.resultant,
                along: given.along.map(|node| self.nodes[node]),
                rest: (self.nodes[given.rest], self.builder.fresh()),
                forces: forces.collect(),
            }
        });
        resultants.collect()
    }

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
        for slide in &pattern.sliding.slides {
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
            if let Normal::Given(place) = friction.normal {
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
