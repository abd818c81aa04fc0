//! Blocks by phase: each operation runs as late as the first phase that needs it allows.

use crate::plan::tape::{Block, Tape};
use crate::sorted::SortedSet;

/// When a block runs.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Phase {
    /// Before the linear system is solved.
    Assembly,
    /// What series have in the place of the elements of the linear system: K w − b of (t, q, v, w).
    Balance,
    /// What follows for all coordinates.
    Accelerations,
    /// What follows for all rows.
    Forces,
    /// What was asked for beside.
    Outputs,
}

const PHASES: [Phase; 5] = [
    Phase::Assembly,
    Phase::Balance,
    Phase::Accelerations,
    Phase::Forces,
    Phase::Outputs,
];

/// Number of the last phase.
const LAST: usize = PHASES.len() - 1;

/// Puts the blocks of a tape into phases, of which all but the last have the outputs `goals`; returns the phase of each.
pub(super) fn arrange(tape: &mut Tape, goals: &[SortedSet<usize>; LAST]) -> Vec<Phase> {
    let phase_of_output = |output: usize| {
        goals
            .iter()
            .position(|goal| goal.contains(&output))
            .unwrap_or(LAST)
    };
    // The earliest phase that reads each value.
    let mut read = vec![LAST; tape.values];
    for write in tape.blocks.iter().flat_map(|block| &block.writes) {
        let first = &mut read[write.value.0];
        *first = phase_of_output(write.output).min(*first);
    }
    let mut phases: Vec<Vec<usize>> = Vec::with_capacity(tape.blocks.len());
    for block in tape.blocks.iter().rev() {
        let mut own = Vec::with_capacity(block.steps.len());
        for step in block.steps.iter().rev() {
            let values = step.value.0..step.value.0 + step.operation.values();
            let phase = values.map(|value| read[value]).min().unwrap_or(LAST);
            for operand in step.operation.operands() {
                read[operand.0] = phase.min(read[operand.0]);
            }
            own.push(phase);
        }
        own.reverse();
        phases.push(own);
    }
    phases.reverse();
    let mut arranged = Vec::new();
    let mut of_block = Vec::new();
    for (number, phase) in PHASES.into_iter().enumerate() {
        for (block, phases) in tape.blocks.iter().zip(&phases) {
            let steps = block.steps.iter().zip(phases);
            let part = Block {
                needs: block.needs.clone(),
                steps: steps
                    .filter(|(_, p)| **p == number)
                    .map(|(s, _)| *s)
                    .collect(),
                writes: block
                    .writes
                    .iter()
                    .filter(|write| phase_of_output(write.output) == number)
                    .copied()
                    .collect(),
            };
            if !(part.steps.is_empty() && part.writes.is_empty()) {
                arranged.push(part);
                of_block.push(phase);
            }
        }
    }
    tape.blocks = arranged;
    of_block
}
