//! The dependencies between the instructions of a program, direct and indirect.

use crate::program::{Operand, Program};

/// Which instructions wait for which others, a bit each.
pub(super) struct Ancestors {
    words: usize,
    bits: Vec<u64>,
}

impl Ancestors {
    pub fn new(program: &Program) -> Self {
        let length = program.instructions.len();
        let words = length.div_ceil(64);
        let mut bits = vec![0; words * length];
        for (at, instruction) in program.instructions.iter().enumerate() {
            for operand in [instruction.a, instruction.b] {
                let Operand::Value(value) = operand else { continue };
                for word in 0..words {
                    bits[at * words + word] |= bits[value * words + word];
                }
                bits[at * words + value / 64] |= 1 << (value % 64);
            }
        }
        Self { words, bits }
    }

    /// True if `at` waits for `value`.
    pub fn has(&self, at: usize, value: usize) -> bool {
        self.bits[at * self.words + value / 64] >> (value % 64) & 1 == 1
    }
}
