//! Repeated parts that do not need each other, side by side.
//!
//! A chain that is eliminated from both ends gives two loops, one after the other. In each,
//! a copy waits for the pivot of the copy before, and a processor does not look far enough ahead to
//! work at both. Here a copy of one follows a copy of the other, so that one loop does both
//! (loop fusion), and a processor has operations of one end while it waits for a pivot of the other.

use std::ops::Range;

use super::flatten::{Flat, Value};
use crate::program::Program;
use crate::repetition::{Block, Repetition};

/// The values in an order that puts repeated parts side by side. `program` computes them in
/// the given `order`, and `starts` says at which instruction each begins.
pub(super) fn fuse(flat: &Flat, order: &[Value], starts: &[usize], program: &Program) -> Vec<Value> {
    // by places in the order
    let places = |instructions: Range<usize>| {
        let place = |instruction: usize| starts.partition_point(|&start| start < instruction);
        place(instructions.start)..place(instructions.end)
    };
    let mut fused = Vec::with_capacity(order.len());
    let mut waiting: Option<Repetition> = None;
    let mut done = 0;
    for block in program.blocks(&|_| ()) {
        let Block::Repeated(second) = block else { continue };
        let Some(first) = waiting.replace(second) else { continue };
        let [a, b] = [first, second].map(|part| places(part.range()));
        let later = dependent(flat, order, a.clone(), b.end);
        if order[b.clone()].iter().any(|&value| later[value]) {
            continue;
        }
        fused.extend(&order[done..a.start]);
        let (after, before): (Vec<Value>, _) = order[a.end..b.start].iter().partition(|&&value| later[value]);
        fused.extend(before);
        for copy in 0..first.count.max(second.count) {
            for part in [first, second] {
                if copy < part.count {
                    let start = part.start + copy * part.length;
                    fused.extend(&order[places(start..start + part.length)]);
                }
            }
        }
        fused.extend(after);
        done = b.end;
        waiting = None;
    }
    fused.extend(&order[done..]);
    fused
}

/// Which values, at the places before `end`, need one at the places `from`, or are one.
fn dependent(flat: &Flat, order: &[Value], from: Range<usize>, end: usize) -> Vec<bool> {
    let mut later = vec![false; flat.definitions.len()];
    order[from.clone()].iter().for_each(|&value| later[value] = true);
    for &value in &order[from.end..end] {
        let mut needs = false;
        flat.definitions[value].for_each_operand(|operand| needs |= later[operand]);
        later[value] = needs;
    }
    later
}
