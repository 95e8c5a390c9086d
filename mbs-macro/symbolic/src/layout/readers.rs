//! How long results are needed.

use rustc_hash::FxHashMap as HashMap;

use crate::program::{Operand, Program};
use crate::repetition::{Block, Source};

/// The last block that reads a result through its slot; `usize::MAX` of outputs.
pub(super) fn last_readers(program: &Program, blocks: &[Block]) -> HashMap<usize, usize> {
    let mut readers: HashMap<usize, usize> = HashMap::default();
    let mut read = |operand: Operand, reader: usize| {
        if let Operand::Value(value) = operand {
            let last = readers.entry(value).or_insert(reader);
            *last = reader.max(*last);
        }
    };
    for (at, block) in blocks.iter().enumerate() {
        match block {
            Block::Straight(range) => {
                for instruction in &program.instructions[range.clone()] {
                    for operand in [instruction.a, instruction.b] {
                        let is_own = matches!(operand, Operand::Value(value) if range.contains(&value));
                        if !is_own {
                            read(operand, at);
                        }
                    }
                }
            }
            Block::Repeated(repetition) => {
                for source in (0..repetition.length).flat_map(|i| repetition.sources(program, i)) {
                    match source {
                        Source::Own(_) => {}
                        Source::Same(operand) | Source::Carried(_, operand) => read(operand, at),
                        Source::Each(operands) => operands.into_iter().for_each(|operand| read(operand, at)),
                    }
                }
            }
        }
    }
    program.outputs.iter().for_each(|&output| read(output, usize::MAX));
    readers
}
