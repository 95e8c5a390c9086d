//! Code of transposed programs.

use mbs_codegen::FunctionId;
use mbs_codegen::compiled::{self, Compiled, Input};
use mbs_runtime::__private::Spline;
use mbs_runtime::reverse::{Adjoints, Function};
use mbs_symbolic::{Inconsistency, Operand};

use crate::arguments::Arguments;
use crate::code::Code;
use crate::instruction::execute;

/// The transposed programs of a mechanism, in the order of [`Function::ALL`].
pub struct Transposes([Option<Transposed>; Function::ALL.len()]);

/// A transposed program.
pub struct Transposed {
    pub code: Code,
    /// What each of its results is a derivative by.
    by: Vec<By>,
}

/// A component of an adjoint.
#[derive(Clone, Copy)]
enum By {
    Position(usize),
    Velocity(usize),
    Feedback(usize),
    Input(usize),
    Parameter(usize),
    Hoisted(usize),
    Acceleration(usize),
    Multiplier(usize),
}

impl By {
    /// That of an operand by which a transposed program differentiates.
    fn of(compiled: &Compiled, operand: Operand) -> Option<Self> {
        if let Operand::Hoisted(at) = operand {
            return Some(Self::Hoisted(at));
        }
        Some(match compiled.input_of(operand)? {
            Input::Position(at) | Input::StatePosition(at) => Self::Position(at),
            Input::Velocity(at) | Input::StateVelocity(at) => Self::Velocity(at),
            Input::Feedback(at) => Self::Feedback(at),
            Input::Input(at) => Self::Input(at),
            Input::Parameter(at) => Self::Parameter(at),
            Input::Acceleration(at) => Self::Acceleration(at),
            Input::Multiplier(at) => Self::Multiplier(at),
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

    /// Its place.
    fn place<'a>(self, adjoints: &'a mut Adjoints<'_, f64>) -> Option<&'a mut f64> {
        match self {
            Self::Position(at) => adjoints.q.get_mut(at),
            Self::Velocity(at) => adjoints.v.get_mut(at),
            Self::Feedback(at) => adjoints.feedback.get_mut(at),
            Self::Input(at) => adjoints.inputs.get_mut(at),
            Self::Parameter(at) => adjoints.parameters.get_mut(at),
            Self::Hoisted(at) => adjoints.hoisted.get_mut(at),
            Self::Acceleration(at) => adjoints.acceleration.get_mut(at),
            Self::Multiplier(at) => adjoints.multipliers.get_mut(at),
        }
    }
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
        let by = transposed.by.iter().map(|operand| By::of(compiled, *operand));
        let unknown =
            Inconsistency { pass: "reading a transposed program", rule: "derivatives are by variables" };
        let by = by.collect::<Option<_>>().ok_or(unknown)?;
        Ok(Self { code: Code::new(compiled, &transposed.program)?, by })
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
        execute(&self.code.instructions, splines, slots);
        for (&slot, by) in self.code.outputs.iter().zip(&self.by) {
            if let (Some(adjoint), Some([value])) = (by.place(adjoints), slots.get(slot as usize)) {
                *adjoint += value;
            }
        }
    }
}
