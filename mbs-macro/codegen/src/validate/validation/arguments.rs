//! A program reads nothing but the arguments of its function.

use mbs_interface::{Argument, FunctionId};
use mbs_symbolic::Operand;

use super::Check;
use crate::inputs::Input;
use crate::model::Model;
use crate::plan::Plan;

/// Every function can be called with what its row of the table says.
///
/// # Errors
/// The first function that reads more, with the name of what it reads.
pub(super) fn check(model: &Model, plan: &Plan) -> Check {
    // coordinates that are all integrated are the arguments themselves
    let has_all = plan.inputs.states.len() == model.coordinates.len();
    for function in FunctionId::all() {
        let program = &plan.programs[function];
        let read = program.instructions.iter().flat_map(|instruction| [instruction.a, instruction.b]);
        for operand in read.chain(program.outputs.iter().copied()) {
            let Operand::Symbol(symbol) = operand else { continue };
            let is_given = |input| {
                let given = arguments(input, has_all);
                given.is_none_or(|given| function.arguments().iter().any(|argument| given.contains(argument)))
            };
            if !plan.inputs.of(symbol).is_some_and(is_given) {
                let name = model.arena.name(symbol);
                return Err(format!("`{}` reads {name}, which it is not given", function.name()));
            }
        }
    }
    Ok(())
}

/// The arguments that have an input; nothing of parameters, which every function is given.
fn arguments(input: Input, has_all: bool) -> Option<&'static [Argument]> {
    Some(match input {
        Input::Parameter(_) => return None,
        Input::Time => &[Argument::Time],
        Input::Input(_) => &[Argument::Inputs],
        Input::Position(_) if has_all => &[Argument::Positions, Argument::StatePositions],
        Input::Velocity(_) if has_all => &[Argument::Velocities, Argument::StateVelocities],
        Input::Position(_) => &[Argument::Positions],
        Input::Velocity(_) => &[Argument::Velocities],
        Input::StatePosition(_) => &[Argument::StatePositions],
        Input::StateVelocity(_) => &[Argument::StateVelocities],
        Input::Acceleration(_) | Input::Multiplier(_) => &[Argument::Reactions],
        Input::Feedback(_) => &[Argument::Feedback],
        Input::Predicted(_) => &[Argument::Predicted],
        Input::Shift => &[Argument::Shift],
        Input::MinusTwoAlpha | Input::MinusBetaSquared => &[Argument::Gains],
        // of functions that are made of these
        Input::Step | Input::HalfStep | Input::NextTime | Input::Weight(_) => &[],
    })
}
