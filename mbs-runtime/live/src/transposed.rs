//! Code of transposed programs.

use mbs_codegen::FunctionId;
use mbs_codegen::compiled::{self, Compiled, Input};
use mbs_runtime::__private::Spline;
use mbs_runtime::reverse::{Adjoints, Function};
use mbs_symbolic::{Inconsistency, Operand};

use crate::arguments::Arguments;
use crate::code::Code;
use crate::instruction::execute_alone;

/// The transposed programs of a mechanism, in the order of [`Function::ALL`].
pub struct Transposes([Option<Transposed>; Function::ALL.len()]);

/// A transposed program.
pub struct Transposed {
    pub code: Code,
    /// The results that are added to each vector of the adjoints, in the order of [`vectors`]: slots and
    /// places. Vector follows vector, since a choice for each number would cost as much as an operation.
    sums: [Vec<(u32, usize)>; 8],
}

/// The adjoints, in the order of [`place`].
fn vectors<'a>(adjoints: &'a mut Adjoints<'_, f64>) -> [&'a mut [f64]; 8] {
    let Adjoints { q, v, feedback, inputs, parameters, hoisted, acceleration, multipliers } = adjoints;
    [q, v, feedback, inputs, parameters, hoisted, acceleration, multipliers]
}

/// The vector of the adjoints, and the place in it, of an operand by which a transposed program differentiates.
fn place(compiled: &Compiled, operand: Operand) -> Option<(usize, usize)> {
    if let Operand::Hoisted(at) = operand {
        return Some((5, at));
    }
    Some(match compiled.input_of(operand)? {
        Input::Position(at) | Input::StatePosition(at) => (0, at),
        Input::Velocity(at) | Input::StateVelocity(at) => (1, at),
        Input::Feedback(at) => (2, at),
        Input::Input(at) => (3, at),
        Input::Parameter(at) => (4, at),
        Input::Acceleration(at) => (6, at),
        Input::Multiplier(at) => (7, at),
        Input::Time
        | Input::Step
        | Input::HalfStep
        | Input::NextTime
        | Input::MinusTwoAlpha
        | Input::MinusBetaSquared
        | Input::Shift
        | Input::Predicted(_)
        | Input::Weight(_) => return None,
    })
}

impl Transposes {
    /// The transposes of a compiled mechanism.
    ///
    /// # Errors
    /// A mistake of the compiler or of this crate.
    pub fn new(compiled: &Compiled) -> Result<Self, Inconsistency> {
        let transposes = compiled.transposes()?;
        let mut all = [const { None }; Function::ALL.len()];
        for (place, function) in all.iter_mut().zip(Function::ALL) {
            let step = transposes.step.as_ref();
            let found = match (function, id(function)) {
                (Function::StepHeld, _) => step.map(|step| &step.held),
                (Function::StepPerStage, _) => step.map(|step| &step.per_stage),
                (_, id) => id.and_then(|id| transposes.of(id)),
            };
            *place = found.map(|transposed| Transposed::new(compiled, transposed)).transpose()?;
        }
        Ok(Self(all))
    }

    /// That of a function, if there is one.
    pub fn of(&self, function: Function) -> Option<&Transposed> {
        self.0.get(function as usize)?.as_ref()
    }
}

/// A function as the compiler names it; whole steps are none of its functions.
pub fn id(function: Function) -> Option<FunctionId> {
    Some(match function {
        Function::Hoisted => FunctionId::Hoisted,
        Function::Stabilized => FunctionId::Stabilized,
        Function::Constrained => FunctionId::Constrained,
        Function::Complete => FunctionId::Complete,
        Function::Phi => FunctionId::Phi,
        Function::PhiDot => FunctionId::PhiDot,
        Function::Projection => FunctionId::Projection,
        Function::Reactions => FunctionId::Reactions,
        Function::Outputs => FunctionId::Outputs,
        Function::StepHeld | Function::StepPerStage => return None,
    })
}

impl Transposed {
    fn new(compiled: &Compiled, transposed: &compiled::Transposed) -> Result<Self, Inconsistency> {
        let code = Code::new(compiled, &transposed.program)?;
        let mut sums: [Vec<(u32, usize)>; 8] = Default::default();
        for (&slot, &operand) in code.outputs.iter().zip(&transposed.by) {
            let unknown =
                Inconsistency { pass: "reading a transposed program", rule: "derivatives are by variables" };
            let (vector, at) = place(compiled, operand).ok_or(unknown)?;
            sums[vector].push((slot, at));
        }
        Ok(Self { code, sums })
    }

    /// Adds its results to the adjoints.
    pub fn run(
        &self,
        splines: &[Spline],
        slots: &mut [[f64; 1]],
        given: &Arguments<'_>,
        adjoints: &mut Adjoints<'_, f64>,
    ) {
        self.code.load(slots, given);
        execute_alone(&self.code.instructions, splines, slots);
        for (vector, sums) in vectors(adjoints).into_iter().zip(&self.sums) {
            for &(slot, at) in sums {
                if let (Some(adjoint), Some([value])) = (vector.get_mut(at), slots.get(slot as usize)) {
                    *adjoint += value;
                }
            }
        }
    }
}
