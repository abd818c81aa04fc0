//! The sums that a mode gives → one tape that computes them, and their places.

use super::masked::Masked;
use super::stages::{Phase, arrange};
use crate::derive::{Output, OutputId, Stage};
use crate::plan::constants::Constants;
use crate::plan::form::Fixed;
use crate::plan::tape::Tape;
use crate::plan::{ValueRef, outputs, tape};
use crate::sorted::{SortedMap, SortedSet};
use crate::symbolic::{Pool, Symbol};

/// The outputs of a mode, before they have places.
#[derive(Default)]
pub(super) struct Sheet {
    list: Vec<Output>,
    phases: Vec<Phase>,
}

/// A sheet with its tape.
pub(super) struct Planned {
    /// Blocks in the order of their phases.
    pub tape: Tape,
    /// Which phase each block belongs to.
    pub phases: Vec<Phase>,
    places: Vec<ValueRef>,
}

impl Sheet {
    /// Notes an output, which must be known at the end of a phase.
    pub fn add(&mut self, phase: Phase, sum: &Masked) -> OutputId {
        self.list.push(Output {
            stage: Stage::Motion,
            label: String::new(),
            terms: sum.terms(),
        });
        self.phases.push(phase);
        OutputId(self.list.len() - 1)
    }

    /// Plans all of them together. What was not asked for beside is read whatever is held.
    pub fn plan(
        self,
        pool: &mut Pool,
        inputs: &SortedMap<Symbol, usize>,
        constants: &mut Constants,
    ) -> Planned {
        let numbers = self.phases.iter().enumerate();
        let total: SortedSet<OutputId> = numbers
            .filter(|(_, phase)| **phase != Phase::Outputs)
            .map(|(number, _)| OutputId(number))
            .collect();
        let mut places = vec![ValueRef::Zero; self.list.len()];
        let always_read = (Stage::Motion, &total);
        let targets = outputs::targets(
            pool,
            &self.list,
            always_read,
            inputs,
            constants,
            &mut places,
        );
        let mut tape = tape(pool, constants, inputs, Fixed::Parameters, None, &targets);
        let mut earliest = vec![Phase::Outputs; targets.len()];
        for (place, phase) in places.iter().zip(self.phases) {
            if let ValueRef::Node(node) = *place {
                earliest[node] = phase.min(earliest[node]);
            }
        }
        let phases = arrange(&mut tape, &earliest);
        Planned {
            tape,
            phases,
            places,
        }
    }
}

impl Planned {
    /// Where an output is found.
    pub fn place(&self, output: OutputId) -> ValueRef {
        self.places[output.0]
    }
}
