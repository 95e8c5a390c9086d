//! Angles whose sines and cosines are computed at once.

use std::collections::BTreeMap;

use rustc_hash::FxHashMap as HashMap;

use super::steps::Lane;
use crate::program::{Instruction, Operand, Program};

/// Two operands, as the lanes of a pair.
pub(super) type Lanes = (Operand, Operand);

/// Angle → the pair of angles that it belongs to, and its lane.
pub(super) type Angles = HashMap<Operand, (Lanes, Lane)>;

/// Pairs the angles whose sines and cosines can be computed at once, in their order;
/// the last of an odd number stands alone.
pub(super) fn pair_angles(program: &Program) -> Angles {
    // How many turns one after the other lead to a value: those with equal numbers do
    // not depend on each other, whatever else shares vectors.
    let mut depths = Vec::with_capacity(program.instructions.len());
    let mut angles: BTreeMap<u32, Vec<Operand>> = BTreeMap::new();
    for instruction in &program.instructions {
        let depth = |operand: Operand| match operand {
            Operand::Value(at) => depths[at],
            _ => 0,
        };
        let mut of_result: u32 = depth(instruction.a).max(depth(instruction.b));
        if is_sine_or_cosine(instruction) {
            let angles = angles.entry(of_result).or_default();
            if !angles.contains(&instruction.a) {
                angles.push(instruction.a);
            }
            of_result += 1;
        }
        depths.push(of_result);
    }
    let mut lanes = Angles::default();
    for pair in angles.values().flat_map(|angles| angles.chunks(2)) {
        if let [first, second] = *pair {
            lanes.insert(first, ((first, second), Lane::First));
            lanes.insert(second, ((first, second), Lane::Second));
        } else {
            lanes.extend(pair.iter().map(|&angle| (angle, ((angle, angle), Lane::First))));
        }
    }
    lanes
}

pub(crate) fn is_sine_or_cosine(instruction: &Instruction) -> bool {
    instruction.operation.turn().is_some()
}
