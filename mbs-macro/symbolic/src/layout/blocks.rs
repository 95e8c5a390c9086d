//! A program in blocks of bounded size.
//!
//! A repetition becomes a loop. The sequences between repetitions become functions of 256 instructions.

use std::hash::Hash;
use std::ops::Range;

use super::Components;
use crate::program::Program;
use crate::repetition::Block;

/// A program that is not to have loops is one function up to this length, whatever was
/// asked for: a compiler that nests a scope per statement, as rustc does, runs out of stack
/// at about twice as many.
const LONGEST: usize = 3072;

/// Longer sequences are written as functions of this many instructions.
const PART: usize = 256;

/// The blocks that a program is written in. One of more than `unrolled` instructions is
/// searched for parts that repeat themselves; a shorter one is one block.
pub fn blocks<V: Copy + Eq + Hash>(
    program: &Program,
    unrolled: usize,
    components: Components<'_, V>,
) -> Vec<Block> {
    let length = program.instructions.len();
    if length <= unrolled {
        let is_one = length <= LONGEST;
        return if is_one { vec![Block::Straight(0..length)] } else { parts(0..length).collect() };
    }
    // components of one vector may take each other's place, a single quantity has its own
    let class = |symbol| components(symbol).map(|component| component.vector).ok_or(symbol);
    let split = |block| match block {
        Block::Straight(range) => parts(range).collect(),
        repeated => vec![repeated],
    };
    program.blocks(&class).into_iter().flat_map(split).collect()
}

fn parts(range: Range<usize>) -> impl Iterator<Item = Block> {
    range.clone().step_by(PART).map(move |start| Block::Straight(start..range.end.min(start + PART)))
}
