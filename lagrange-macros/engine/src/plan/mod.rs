//! Equations → [`Program`]: which operations compute the outputs, shared, masked by need.
//!
//! ```text
//! expression → form (fixed scale · varying node) → n-ary graph with shared pairs → operations → blocks
//! ```
//!
//! What depends on parameters only is computed once per run by the constants program; everything else is an
//! operation of the core's `program` in one of two tapes, before the solve and after it.

mod constants;
mod distribute;
mod form;
mod graph;
mod lower;
pub mod mode;
mod needs;
mod outputs;
mod schedule;
mod share;
mod tape;

pub use needs::OutputMask;
pub use tape::{Block, Coefficient, Mode, Operation, Step, Tape, Value, Write};

use crate::derive::{Equations, OutputId, Stage};
use crate::model::System;
use crate::sorted::SortedMap;
use crate::symbolic::{ExprId, Pool, Symbol};
use constants::Constants;
use form::{Fixed, Former};
use lower::Lowerer;
use outputs::Target;
use schedule::Demand;

/// Where a number is found after a tape has run; as the core's `ValueRef`.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum ValueRef {
    /// Structurally zero.
    Zero,
    /// Index into the constants.
    Constant(usize),
    /// Index into the outputs of the stage's tape.
    Node(usize),
}

/// What is emitted.
pub struct Program {
    /// What it computes.
    pub equations: Equations,
    /// Of each output of the equations.
    pub places: Vec<ValueRef>,
    /// Inputs are the parameters, outputs the constants. Scalar operations.
    pub constants: Tape,
    /// Inputs t, q, v.
    pub motion: Tape,
    /// Inputs t, q, v, v̇ and the force of each row.
    pub report: Tape,
    /// In order of declaration.
    pub starts: Vec<Start>,
    /// One program for each mode that can be listed.
    pub modes: Vec<mode::ModeProgram>,
}

/// A named start. Scalar operations.
pub struct Start {
    /// Inputs are the parameters, then t.
    pub tape: Tape,
    /// What the outputs are; what is not named is 0.
    pub targets: Vec<StartTarget>,
}

/// What an output of a start is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum StartTarget {
    /// Position of this coordinate.
    Position(usize),
    /// Velocity of this coordinate.
    Velocity(usize),
}

impl Program {
    /// Where an output is found.
    pub fn place(&self, output: OutputId) -> ValueRef {
        self.places[output.0]
    }

    /// Inputs of a stage.
    pub fn inputs(&self, stage: Stage) -> Vec<Symbol> {
        inputs(&self.equations.system, stage)
    }

    /// Arithmetic operations of a stage that run while `held` (words of a need mask) is held.
    pub fn operations(&self, stage: Stage, held: &[u64]) -> usize {
        match stage {
            Stage::Motion => self.motion.operations(held),
            Stage::Report => self.report.operations(held),
        }
    }
}

/// Plans the computation of all outputs.
pub fn plan(mut equations: Equations) -> Program {
    let parameters: SortedMap<Symbol, usize> =
        numbered(equations.system.parameters.iter().map(|p| p.symbol));
    let mut constants = Constants::new(parameters.clone());
    let mut places = vec![ValueRef::Zero; equations.outputs.len()];
    let motion = stage_tape(&mut equations, Stage::Motion, &mut constants, &mut places);
    let report = stage_tape(&mut equations, Stage::Report, &mut constants, &mut places);
    let starts = starts(&mut equations.system, &parameters);
    let modes = mode::programs(&mut equations);

    let constants = constants_tape(&mut equations.system.pool, constants, &parameters);
    Program {
        equations,
        places,
        constants,
        motion,
        report,
        starts,
        modes,
    }
}

/// Inputs of a stage, in order.
fn inputs(system: &System, stage: Stage) -> Vec<Symbol> {
    let coordinates = &system.coordinates;
    let mut inputs = vec![system.time];
    inputs.extend(coordinates.iter().map(|coordinate| coordinate.position));
    inputs.extend(coordinates.iter().map(|coordinate| coordinate.velocity));
    if stage == Stage::Report {
        inputs.extend(coordinates.iter().map(|coordinate| coordinate.acceleration));
        inputs.extend(system.constraints.iter().map(|constraint| constraint.force));
        inputs.extend(system.contacts.iter().map(|contact| contact.force));
        inputs.extend(
            system
                .frictions
                .iter()
                .flat_map(|friction| friction.slip.iter().map(|(_, force)| *force)),
        );
    }
    inputs
}

fn numbered(symbols: impl Iterator<Item = Symbol>) -> SortedMap<Symbol, usize> {
    symbols
        .enumerate()
        .map(|(index, symbol)| (symbol, index))
        .collect()
}

fn stage_tape(
    equations: &mut Equations,
    stage: Stage,
    constants: &mut Constants,
    places: &mut [ValueRef],
) -> Tape {
    // The solve reads M and f whatever is held.
    let mass = equations.structure.mass.iter().map(|(_, _, entry)| *entry);
    let always_read = mass
        .chain(equations.structure.forcing.iter().copied())
        .collect();
    let inputs = numbered(inputs(&equations.system, stage).into_iter());
    let pool = &mut equations.system.pool;
    let stage = (stage, &always_read);
    let targets = outputs::targets(pool, &equations.outputs, stage, &inputs, constants, places);
    tape(pool, constants, &inputs, Fixed::Parameters, None, &targets)
}

fn starts(system: &mut System, parameters: &SortedMap<Symbol, usize>) -> Vec<Start> {
    let mut inputs = parameters.clone();
    inputs.insert(system.time, parameters.len());
    let guards: Vec<ExprId> = system.branches.iter().map(|branch| branch.guard).collect();
    let mut starts = Vec::with_capacity(system.starts.len());
    for start in &system.starts {
        let positions = start
            .positions
            .iter()
            .map(|(index, e)| (StartTarget::Position(*index), *e));
        let velocities = start
            .velocities
            .iter()
            .map(|(index, e)| (StartTarget::Velocity(*index), *e));
        let (targets, values): (Vec<_>, Vec<_>) = positions.chain(velocities).unzip();
        let values: Vec<Target> = values.into_iter().map(Target::always).collect();
        let mut constants = Constants::closed();
        let tape = tape(
            &mut system.pool,
            &mut constants,
            &inputs,
            Fixed::Numbers,
            Some(&guards),
            &values,
        );
        starts.push(Start { tape, targets });
    }
    starts
}

/// The program of the constants that other tapes have asked for.
fn constants_tape(
    pool: &mut Pool,
    constants: Constants,
    parameters: &SortedMap<Symbol, usize>,
) -> Tape {
    let sources = constants.sources.into_iter();
    let targets: Vec<Target> = sources.map(Target::of_constant).collect();
    let none = &mut Constants::closed();
    tape(pool, none, parameters, Fixed::Numbers, None, &targets)
}

/// One tape for all targets.
fn tape(
    pool: &mut Pool,
    constants: &mut Constants,
    inputs: &SortedMap<Symbol, usize>,
    fixed: Fixed,
    guards: Option<&[ExprId]>,
    targets: &[Target],
) -> Tape {
    let mut former = Former::new(pool, inputs, fixed, guards);
    let entries: Vec<_> = targets
        .iter()
        .enumerate()
        .flat_map(|(i, target)| target.entries(i, &mut former))
        .collect();
    let mut graph = former.into_graph();
    let roots: Vec<_> = entries.iter().map(|entry| entry.node).collect();
    distribute::distribute(&mut graph, pool, constants, &roots);
    graph.split_quotients(&roots);
    share::share(&mut graph, pool, &roots);

    let mut lowerer = Lowerer::new(pool, (&graph, &roots), constants, inputs.len());
    let mut demands = Vec::with_capacity(entries.len());
    for entry in entries {
        let write = Write {
            output: entry.output,
            value: lowerer.value(entry.node),
            mode: entry.mode,
        };
        demands.push(Demand {
            needs: entry.needs,
            write,
        });
    }
    let tape = schedule::schedule(&lowerer.finish(), inputs.len(), targets.len(), &demands);
    for block in &tape.blocks {
        for step in &block.steps {
            if let Some(coefficient) = step.operation.coefficient() {
                constants.ask(coefficient, &block.needs);
            }
        }
    }
    tape
}

#[cfg(test)]
mod tests;
