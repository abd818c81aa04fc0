//! Operations → blocks: who needs what, in which order, in which slot.

use super::lower::Lowered;
use super::needs::OutputMask;
use super::tape::{Block, Step, Tape, Value, Write};
use crate::sorted::SortedMap;

/// What enters an output, when asked for.
pub(super) struct Demand {
    /// Who asks.
    pub needs: OutputMask,
    /// What enters where.
    pub write: Write,
}

/// Puts the operations that somebody asks for into one block for each distinct need set.
pub(super) fn schedule(
    lowered: &Lowered,
    inputs: usize,
    outputs: usize,
    demands: &[Demand],
) -> Tape {
    // Whoever needs a value needs its operands: one pass from the last operation to the first.
    let mut asked = vec![OutputMask::default(); lowered.values];
    for demand in demands {
        asked[demand.write.value.0].join(&demand.needs);
    }
    let mut needs_of = vec![OutputMask::default(); lowered.operations.len()];
    for (index, (first, operation)) in lowered.operations.iter().enumerate().rev() {
        let mut needs = OutputMask::default();
        for needed in &asked[first.0..first.0 + operation.values()] {
            needs.join(needed);
        }
        for operand in operation.operands() {
            asked[operand.0].join(&needs);
        }
        needs_of[index] = needs;
    }

    let mut blocks: SortedMap<Rank, Block> = SortedMap::new();
    let mut block = |needs: &OutputMask, fill: &mut dyn FnMut(&mut Block)| {
        let empty = || Block {
            needs: needs.clone(),
            steps: Vec::new(),
            writes: Vec::new(),
        };
        fill(blocks.get_or_insert_with(rank(needs), empty));
    };
    for (index, (value, operation)) in lowered.operations.iter().enumerate() {
        if !needs_of[index].is_empty() {
            let step = Step {
                value: *value,
                operation: *operation,
            };
            block(&needs_of[index], &mut |block| block.steps.push(step));
        }
    }
    for demand in demands {
        block(&demand.needs, &mut |block| block.writes.push(demand.write));
    }
    numbered(
        blocks.into_iter().map(|(_, block)| block).collect(),
        inputs,
        outputs,
        lowered.values,
    )
}

/// Larger sets first, the set that always runs before all.
type Rank = (bool, std::cmp::Reverse<usize>, OutputMask);

fn rank(needs: &OutputMask) -> Rank {
    (
        !needs.is_always(),
        std::cmp::Reverse(needs.len()),
        needs.clone(),
    )
}

/// Numbers values in the order in which they are computed.
fn numbered(mut blocks: Vec<Block>, inputs: usize, outputs: usize, values: usize) -> Tape {
    let mut names: Vec<Option<usize>> = (0..values)
        .map(|value| (value < inputs).then_some(value))
        .collect();
    let mut values = inputs;
    for block in &mut blocks {
        for step in &mut block.steps {
            let count = step.operation.values();
            for offset in 0..count {
                names[step.value.0 + offset] = Some(values + offset);
            }
            let name = |value: Value| Value(names[value.0].expect("operands come first"));
            *step = Step {
                value: name(step.value),
                operation: step.operation.renamed(name),
            };
            values += count;
        }
        for write in &mut block.writes {
            write.value = Value(names[write.value.0].expect("outputs come last"));
        }
    }
    Tape {
        inputs,
        values,
        outputs,
        blocks,
    }
}
