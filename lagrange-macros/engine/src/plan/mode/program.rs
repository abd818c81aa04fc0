//! The equations of one mode, as they are emitted, and which of their values are needed for what.

use super::stages::Phase;
use crate::derive::OutputId;
use crate::modes::Mode;
use crate::plan::ValueRef;
use crate::plan::tape::{Block, Step, Tape, Value};

/// The linear system K w = b.
pub struct LinearSystem<P = ValueRef> {
    /// The first unknowns are accelerations, the others −λ of the rows that stay.
    pub accelerations: usize,
    /// Whether K is symmetric among the accelerations.
    pub symmetric: bool,
    /// K, row by row.
    pub matrix: Vec<Vec<P>>,
    /// b
    pub right: Vec<P>,
    /// 1/Kₚₚ where it depends on parameters only.
    pub reciprocals: Vec<Option<P>>,
    /// Inertias of parameters alone, which must be positive.
    pub positive: Vec<P>,
    /// Unknowns that stand alone, already divided by their inertia.
    pub units: Vec<bool>,
    /// The part of K w − b that is of accelerations, with what it shares kept whole, where series have fewer products by that.
    pub balance: Option<Vec<P>>,
}

impl<P> LinearSystem<P> {
    /// The same with other numbers.
    fn map<Q>(self, mut make: impl FnMut(Phase, P) -> Q) -> LinearSystem<Q> {
        let mut of_assembly = |number| make(Phase::Assembly, number);
        let matrix = self.matrix.into_iter();
        let matrix = matrix.map(|row| row.into_iter().map(&mut of_assembly).collect());
        LinearSystem {
            accelerations: self.accelerations,
            symmetric: self.symmetric,
            matrix: matrix.collect(),
            right: self.right.into_iter().map(&mut of_assembly).collect(),
            reciprocals: self
                .reciprocals
                .into_iter()
                .map(|inverse| inverse.map(&mut of_assembly))
                .collect(),
            positive: self.positive.into_iter().map(of_assembly).collect(),
            units: self.units,
            balance: self.balance.map(|balance| {
                let sums = balance.into_iter();
                sums.map(|sum| make(Phase::Balance, sum)).collect()
            }),
        }
    }

    /// Arithmetic operations of the solution, of a full matrix.
    pub fn operations(&self) -> usize {
        let n = self.matrix.len();
        n * (n + 1) * (2 * n + 1) / 6
    }

    /// Whether series have a balance in the place of the products with an element of K.
    pub fn is_balanced(&self, row: usize, column: usize) -> bool {
        self.balance.is_some() && row.max(column) < self.accelerations
    }
}

/// What a program gives besides accelerations and forces.
pub struct Extra<P = ValueRef> {
    /// Whose number it is.
    pub output: OutputId,
    /// Where it is.
    pub place: P,
    /// Whether its series is read as well.
    pub has_series: bool,
}

/// All that a mode gives: of each number its place, or the sum that it is before it has one.
pub struct Results<P = ValueRef> {
    /// The system in the middle.
    pub system: LinearSystem<P>,
    /// v̇, one per coordinate.
    pub accelerations: Vec<P>,
    /// λ, one per row; none where a row has no force.
    pub forces: Vec<Option<P>>,
    /// Constants that are divided by, and those that they must not be small against.
    pub divisors: Vec<(P, Vec<P>)>,
    /// Coordinates that stand still, and where.
    pub pins: Vec<(usize, P)>,
    /// Gaps, slips, coefficients, guards, terms of stops and marks; then what a projection onto the rows that act takes.
    pub extras: Vec<Extra<P>>,
}

impl<P> Results<P> {
    /// The same with other numbers, made in the order of the phases at the end of which they must be known.
    pub(super) fn map<Q>(self, mut make: impl FnMut(Phase, P) -> Q) -> Results<Q> {
        let system = self.system.map(&mut make);
        let accelerations = self.accelerations.into_iter();
        let accelerations = accelerations.map(|sum| make(Phase::Accelerations, sum));
        let accelerations = accelerations.collect();
        let forces = self.forces.into_iter();
        let forces = forces.map(|force| Some(make(Phase::Forces, force?)));
        let forces = forces.collect();
        let mut number = |number| make(Phase::Outputs, number);
        let divisors = self.divisors.into_iter();
        let divisors = divisors.map(|(pivot, against)| {
            let pivot = number(pivot);
            (pivot, against.into_iter().map(&mut number).collect())
        });
        let divisors = divisors.collect();
        let pins = self.pins.into_iter();
        let pins = pins.map(|(j, at)| (j, number(at))).collect();
        let extras = self.extras.into_iter().map(|extra| Extra {
            output: extra.output,
            place: number(extra.place),
            has_series: extra.has_series,
        });
        Results {
            system,
            accelerations,
            forces,
            divisors,
            pins,
            extras: extras.collect(),
        }
    }
}

/// The equations of one mode.
pub struct ModeProgram {
    /// The mode.
    pub mode: Mode,
    /// Inputs: parameters, then per friction the sign of its slip and of the multiplier that presses.
    pub constants: Tape,
    /// Inputs: see [`Inputs`]. Blocks in the order of [`Self::phases`].
    pub tape: Tape,
    /// Which phase each block of the tape belongs to.
    pub phases: Vec<Phase>,
    /// Numbers of the inputs.
    pub inputs: Inputs,
    /// The rows whose −λ are unknowns, in their order.
    pub kept: Vec<usize>,
    /// Where all that it gives is found.
    pub results: Results,
}

/// Where the inputs of a mode's tape begin: t, q, v, w, v̇, λ.
#[derive(Clone, Copy, Debug)]
pub struct Inputs {
    /// Number of coordinates.
    pub coordinates: usize,
    /// Number of unknowns.
    pub unknowns: usize,
}

impl Inputs {
    /// Position of coordinate `j`.
    pub fn position(self, j: usize) -> Value {
        Value(1 + j)
    }
    /// Velocity of coordinate `j`.
    pub fn velocity(self, j: usize) -> Value {
        Value(1 + self.coordinates + j)
    }
    /// Unknown `i`.
    pub fn unknown(self, i: usize) -> Value {
        Value(1 + 2 * self.coordinates + i)
    }
    /// Acceleration of coordinate `j`.
    pub fn acceleration(self, j: usize) -> Value {
        Value(1 + 2 * self.coordinates + self.unknowns + j)
    }
    /// Force of row `r`.
    pub fn force(self, r: usize) -> Value {
        Value(1 + 3 * self.coordinates + self.unknowns + r)
    }
}

impl ModeProgram {
    /// Whether a projection onto the rows that act finds among the extras what it takes.
    pub fn gives_rows(&self) -> bool {
        self.results.extras.iter().any(|extra| !extra.has_series)
    }

    /// Whether the linear system is also that of a projection of velocities, [M Aᵀ; A 0], of all coordinates and all rows that act.
    pub fn projects_velocities(&self) -> bool {
        let matrix = &self.results.system.matrix;
        let free = self.results.system.accelerations;
        let is_mirrored = |(i, row): (usize, &Vec<ValueRef>)| {
            let mut pairs = row.iter().zip(matrix);
            pairs.all(|(x, other)| *x == other[i])
        };
        let mut rows = matrix[free..].iter();
        self.gives_rows()
            && free == self.inputs.coordinates
            && matrix.iter().enumerate().all(is_mirrored)
            && rows.all(|row| row[free..].iter().all(|x| *x == ValueRef::Zero))
    }

    /// The operations of a phase, block by block.
    pub fn blocks(&self, phase: Phase) -> impl Iterator<Item = &Block> {
        let blocks = self.tape.blocks.iter().zip(&self.phases);
        blocks
            .filter(move |(_, p)| **p == phase)
            .map(|(block, _)| block)
    }

    /// Arithmetic operations up to the end of a phase, the solution of the linear system included.
    pub fn operations(&self, last: Phase) -> usize {
        let blocks = self.tape.blocks.iter().zip(&self.phases);
        let needed = blocks.filter(|(_, phase)| **phase <= last);
        let serves = self.serves_values();
        let steps = needed.flat_map(|(block, _)| &block.steps);
        let steps = steps.filter(|step| step.operation.is_work() && serves[step.value.0]);
        steps.count() + self.results.system.operations()
    }

    /// Whether each value of the tape is needed where no series are: for other outputs than the balance.
    pub fn serves_values(&self) -> Vec<bool> {
        let balance = self.results.system.balance.iter().flatten();
        let balance: Vec<ValueRef> = balance.copied().collect();
        let serves = |output| !balance.contains(&ValueRef::Node(output));
        self.needed(serves, |step| step.operation.operands())
    }

    /// Whether each value of the tape is needed by series: for other outputs than the elements that the balance replaces and the extras
    /// that are read as values alone. `operands` says what the series of a step is made of.
    pub(super) fn serves_series(&self, operands: impl Fn(&Step) -> Vec<Value>) -> Vec<bool> {
        let system = &self.results.system;
        // The elements among the accelerations, which the balance replaces.
        let free = match system.balance {
            Some(_) => system.accelerations,
            None => 0,
        };
        let elements = system.matrix[..free].iter().flat_map(|row| &row[..free]);
        let values = self.results.extras.iter().filter(|extra| !extra.has_series);
        let replaced: Vec<ValueRef> = elements
            .chain(&system.right[..free])
            .copied()
            .chain(values.map(|extra| extra.place))
            .collect();
        let kept = system.matrix.iter().enumerate().flat_map(|(i, row)| {
            let elements = row.iter().enumerate();
            elements.filter(move |(j, _)| i >= free || *j >= free)
        });
        let extras = self.results.extras.iter().filter(|extra| extra.has_series);
        let results = self.results.accelerations.iter().copied();
        let kept: Vec<ValueRef> = kept
            .map(|(_, place)| *place)
            .chain(system.right[free..].iter().copied())
            .chain(extras.map(|extra| extra.place))
            .chain(results.chain(self.results.forces.iter().flatten().copied()))
            .collect();
        let serves = |output| {
            let place = ValueRef::Node(output);
            !replaced.contains(&place) || kept.contains(&place)
        };
        self.needed(serves, operands)
    }

    /// Whether each value of the tape is needed for these outputs, given what each step is made of. A value of several is needed if
    /// one of them is.
    fn needed(
        &self,
        output: impl Fn(usize) -> bool,
        operands: impl Fn(&Step) -> Vec<Value>,
    ) -> Vec<bool> {
        let mut needed = vec![false; self.tape.values];
        needed[..self.tape.inputs].fill(true);
        for write in self.tape.blocks.iter().flat_map(|block| &block.writes) {
            needed[write.value.0] |= output(write.output);
        }
        self.with_operands(needed, operands)
    }

    /// These values of the tape and all that they are made of, as `operands` says. A value of several is among them if one of them is.
    pub(super) fn with_operands(
        &self,
        mut values: Vec<bool>,
        operands: impl Fn(&Step) -> Vec<Value>,
    ) -> Vec<bool> {
        let blocks = self.tape.blocks.iter().rev();
        for step in blocks.flat_map(|block| block.steps.iter().rev()) {
            let own = step.value.0..step.value.0 + step.operation.values();
            if values[own.clone()].contains(&true) {
                values[own].fill(true);
                for operand in operands(step) {
                    values[operand.0] = true;
                }
            }
        }
        values
    }

    /// These inputs of the tape and all that is made of one of them.
    fn with_results(&self, mut values: Vec<bool>) -> Vec<bool> {
        for step in self.tape.blocks.iter().flat_map(|block| &block.steps) {
            let any = step.operation.operands().iter().any(|x| values[x.0]);
            values[step.value.0..step.value.0 + step.operation.values()].fill(any);
        }
        values
    }

    /// Whether each value of the tape depends on the unknowns of the linear system.
    pub fn follows_unknowns(&self) -> Vec<bool> {
        let mut unknowns = vec![false; self.tape.values];
        for i in 0..self.inputs.unknowns {
            unknowns[self.inputs.unknown(i).0] = true;
        }
        self.with_results(unknowns)
    }

    /// Whether each value of the tape changes with time.
    pub fn varying(&self) -> Vec<bool> {
        let mut varies = vec![false; self.tape.values];
        varies[..self.tape.inputs].fill(true);
        for &(j, _) in &self.results.pins {
            varies[self.inputs.position(j).0] = false;
            varies[self.inputs.velocity(j).0] = false;
        }
        for (j, place) in self.results.accelerations.iter().enumerate() {
            varies[self.inputs.acceleration(j).0] = matches!(place, ValueRef::Node(_));
        }
        for (r, place) in self.results.forces.iter().enumerate() {
            varies[self.inputs.force(r).0] = matches!(place, Some(ValueRef::Node(_)));
        }
        self.with_results(varies)
    }
}
