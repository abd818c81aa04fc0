//! Blocks by phase: each operation runs as late as the first phase that needs it allows.

use crate::plan::tape::{Block, Tape};

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

/// Puts the blocks of a tape into phases, given at the end of which each output must be known; returns the phase of each block.
pub(super) fn arrange(tape: &mut Tape, of_output: &[Phase]) -> Vec<Phase> {
    // The earliest phase that reads each value.
    let mut read = vec![Phase::Outputs; tape.values];
    for write in tape.blocks.iter().flat_map(|block| &block.writes) {
        let first = &mut read[write.value.0];
        *first = of_output[write.output].min(*first);
    }
    let mut phases: Vec<Vec<Phase>> = Vec::with_capacity(tape.blocks.len());
    for block in tape.blocks.iter().rev() {
        let mut own = Vec::with_capacity(block.steps.len());
        for step in block.steps.iter().rev() {
            let values = step.value.0..step.value.0 + step.operation.values();
            let phase = values
                .map(|value| read[value])
                .min()
                .unwrap_or(Phase::Outputs);
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
    for phase in PHASES {
        for (block, phases) in tape.blocks.iter().zip(&phases) {
            let steps = block.steps.iter().zip(phases);
            let part = Block {
                needs: block.needs.clone(),
                steps: steps
                    .filter(|(_, p)| **p == phase)
                    .map(|(s, _)| *s)
                    .collect(),
                writes: block
                    .writes
                    .iter()
                    .filter(|write| of_output[write.output] == phase)
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
