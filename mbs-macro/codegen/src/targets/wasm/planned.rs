//! The functions of a module, before they are written.

use mbs_symbolic::layout::Layout;
use mbs_symbolic::{Block, Inconsistency, Program};

use super::slot::Slot;
use crate::compiled::{Argument, Compiled, FunctionId, Kinds, Vector};

/// A function, before it is written.
pub struct Planned<'a> {
    pub signature: Signature,
    pub program: &'a Program,
    /// Of a long program.
    pub layout: Option<Layout<Vector>>,
}

/// The parameters and results of a function.
pub struct Signature {
    pub name: &'static str,
    /// Its parameters, in their order.
    pub slots: Vec<Slot>,
    /// How many numbers it writes to each address of results.
    pub lengths: Vec<usize>,
    /// True if the last output is returned.
    pub returns: bool,
}

/// The functions of a mechanism.
pub fn planned(compiled: &Compiled) -> Result<Vec<Planned<'_>>, Inconsistency> {
    let mut planned = Vec::new();
    for id in compiled.functions() {
        let (signature, program) = (Signature::of(compiled, id), compiled.program(id));
        let blocks = compiled.blocks(program);
        let is_long = !matches!(blocks[..], [] | [Block::Straight(_)]);
        let layout = is_long.then(|| compiled.layout(program, &blocks, &signature.lengths)).transpose()?;
        planned.push(Planned { signature, program, layout });
    }
    if let Some(step) = &compiled.fused_step {
        let Kinds { held, per_stage } = &step.alone;
        for (name, program) in [("step_held", held), ("step_per_stage", per_stage)] {
            planned.push(Planned { signature: Signature::of_step(compiled, name), program, layout: None });
        }
    }
    Ok(planned)
}

impl Signature {
    fn of(compiled: &Compiled, id: FunctionId) -> Self {
        let slots =
            [Slot::Mechanism].into_iter().chain(id.arguments().iter().map(|&argument| Slot::of(argument)));
        let lengths = id.written().map(|(_, kind)| compiled.length(kind)).collect();
        Self { name: id.name(), slots: slots.collect(), lengths, returns: id.returns() }
    }

    /// Of a whole step, which gives the next positions and velocities and returns the growth.
    fn of_step(compiled: &Compiled, name: &'static str) -> Self {
        let arguments =
            [Argument::Time, Argument::Positions, Argument::Velocities, Argument::Inputs, Argument::Gains];
        let slots = [Slot::Mechanism].into_iter().chain(arguments.map(Slot::of));
        let slots = slots.chain([Slot::Step, Slot::HalfStep, Slot::NextTime]).collect();
        Self { name, slots, lengths: vec![compiled.states.len(); 2], returns: true }
    }
}
