//! Sines and cosines of one angle, which are computed together.

use rustc_hash::FxHashMap as HashMap;

use crate::operators::Function;
use crate::program::{Instruction, Operand, Operation, Program};

/// Sine instruction ↔ cosine instruction of the same angle.
pub struct SinCos(HashMap<usize, usize>);

impl SinCos {
    /// The pairs of a program.
    pub fn of(program: &Program) -> Self {
        let calls = |wanted: Function| {
            let of_angle = move |(at, instruction): (usize, &Instruction)| {
                (instruction.operation == Operation::Call(wanted)).then_some((instruction.a, at))
            };
            program.instructions.iter().enumerate().filter_map(of_angle)
        };
        let cosines: HashMap<Operand, usize> = calls(Function::Cos).collect();
        let mut pairs = HashMap::default();
        for (angle, sine) in calls(Function::Sin) {
            if let Some(&cosine) = cosines.get(&angle) {
                pairs.insert(sine, cosine);
                pairs.insert(cosine, sine);
            }
        }
        Self(pairs)
    }

    /// The cosine that goes with a sine, or the other way round.
    pub fn partner(&self, at: usize) -> Option<usize> {
        self.0.get(&at).copied()
    }
}
