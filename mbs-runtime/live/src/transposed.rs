//! Programs that go backward: from how much each result of a program counts to how much everything counts
//! that it reads.

use std::ops::Range;

use mbs_codegen::FunctionId;
use mbs_codegen::compiled::{Compiled, Input, Kinds};
use mbs_runtime::__private::Spline;
use mbs_symbolic::{Arena, Inconsistency, Operand, Program, Stage};

use crate::arguments::Arguments;
use crate::backward::{MEASURES, PROJECTION};
use crate::code::{Code, Fixed};
use crate::instruction::execute;

/// The transposed programs of a mechanism.
pub struct Transposes {
    pub layout: Layout,
    /// Of what depends on parameters alone.
    pub hoisted: Transposed,
    /// Of q̈ with feedback of its own violation: where the feedback counts too, as it does where it is held over
    /// the step, and where it does not.
    pub held: Transposed,
    pub alone: Transposed,
    /// Of q̈ with given feedback.
    pub constrained: Transposed,
    /// Of a whole step of the declared scheme, with both kinds of feedback.
    pub steps: Option<[Transposed; 2]>,
    /// Of what projects, in the order of [`PROJECTION`],
    pub projection: [Transposed; 4],
    /// and of what measures, in the order of [`MEASURES`].
    pub measures: [Transposed; 3],
}

/// A transposed program.
#[derive(Debug)]
pub struct Transposed {
    pub code: Code,
    /// Where each of its results is to be added.
    places: Vec<usize>,
}

/// How much everything counts that programs read: vectors one after the other.
#[derive(Clone, Copy, Debug)]
pub struct Layout {
    /// Coordinates; of programs of a step those that are integrated come first.
    coordinates: usize,
    constraints: usize,
    inputs: usize,
    parameters: usize,
    hoisted: usize,
}

/// How much everything counts that programs read.
pub struct Counts {
    pub layout: Layout,
    pub numbers: Vec<f64>,
}

impl Counts {
    /// Nothing counts yet.
    pub fn new(layout: Layout) -> Self {
        Self { layout, numbers: vec![0.0; layout.len()] }
    }

    /// The part of it for a vector.
    pub fn part(&mut self, range: Range<usize>) -> &mut [f64] {
        self.numbers.get_mut(range).unwrap_or_default()
    }
}

impl Layout {
    pub fn positions(&self) -> Range<usize> {
        0..self.coordinates
    }

    pub fn velocities(&self) -> Range<usize> {
        self.coordinates..2 * self.coordinates
    }

    pub fn feedback(&self) -> Range<usize> {
        let from = self.velocities().end;
        from..from + self.constraints
    }

    pub fn inputs(&self) -> Range<usize> {
        let from = self.feedback().end;
        from..from + self.inputs
    }

    pub fn parameters(&self) -> Range<usize> {
        let from = self.inputs().end;
        from..from + self.parameters
    }

    pub fn hoisted(&self) -> Range<usize> {
        let from = self.parameters().end;
        from..from + self.hoisted
    }

    pub fn accelerations(&self) -> Range<usize> {
        let from = self.hoisted().end;
        from..from + self.coordinates
    }

    pub fn multipliers(&self) -> Range<usize> {
        let from = self.accelerations().end;
        from..from + self.constraints
    }

    fn len(&self) -> usize {
        self.multipliers().end
    }

    /// Where what an operand counts is added; nothing for constants, times and gains, which are no variables.
    fn place(&self, compiled: &Compiled, operand: Operand) -> Option<usize> {
        let (range, at) = match operand {
            Operand::Hoisted(at) => (self.hoisted(), at),
            Operand::Number(_) | Operand::Value(_) => return None,
            Operand::Symbol(_) => match compiled.input_of(operand)? {
                Input::Position(at) | Input::StatePosition(at) => (self.positions(), at),
                Input::Velocity(at) | Input::StateVelocity(at) => (self.velocities(), at),
                Input::Feedback(at) => (self.feedback(), at),
                Input::Input(at) => (self.inputs(), at),
                Input::Parameter(at) => (self.parameters(), at),
                Input::Acceleration(at) => (self.accelerations(), at),
                Input::Multiplier(at) => (self.multipliers(), at),
                Input::Time
                | Input::Step
                | Input::HalfStep
                | Input::NextTime
                | Input::MinusTwoAlpha
                | Input::MinusBetaSquared
                // of implicit stages, which are not transposed
                | Input::Shift
                | Input::Predicted(_) => return None,
            },
        };
        Some(range.start + at)
    }

    fn of(compiled: &Compiled) -> Self {
        Self {
            coordinates: compiled.coordinates.len(),
            constraints: compiled.constraints.len(),
            inputs: compiled.inputs.len(),
            parameters: compiled.parameters.len(),
            hoisted: compiled.program(FunctionId::Hoisted).outputs.len(),
        }
    }
}

impl Transposes {
    /// The transposes of a compiled mechanism.
    ///
    /// # Errors
    /// A mistake of this crate.
    pub fn new(compiled: &Compiled) -> Result<Self, Inconsistency> {
        let of = |function, counted| Transposed::new(compiled, compiled.program(function), counted);
        let (states, constraints) = (compiled.states.len(), compiled.constraints.len());
        let n = compiled.coordinates.len();
        let hoisted = compiled.program(FunctionId::Hoisted).outputs.len();
        let steps = compiled.fused_step.as_ref().map(|step| {
            let Kinds { held, per_stage } = &step.alone;
            let of = |program| Transposed::new(compiled, program, 2 * states);
            Ok([of(held)?, of(per_stage)?])
        });
        Ok(Self {
            layout: Layout::of(compiled),
            hoisted: of(FunctionId::Hoisted, hoisted)?,
            held: of(FunctionId::Stabilized, states + constraints)?,
            alone: of(FunctionId::Stabilized, states)?,
            constrained: of(FunctionId::Constrained, states)?,
            steps: steps.transpose()?,
            projection: {
                let [complete, phi, phi_dot, projection] = PROJECTION;
                [of(complete, 2 * n)?, of(phi, constraints)?, of(phi_dot, constraints)?, of(projection, n)?]
            },
            measures: {
                let [complete, reactions, outputs] = MEASURES;
                [of(complete, 2 * n)?, of(reactions, n + constraints)?, of(outputs, compiled.outputs.len())?]
            },
        })
    }
}

impl Transposed {
    /// The transpose of a program of which the first `counted` results count.
    fn new(compiled: &Compiled, program: &Program, counted: usize) -> Result<Self, Inconsistency> {
        // symbols behind those of the mechanism
        let mut arena = Arena::new();
        let count = compiled.symbol_count();
        let mut symbols = (0..count + counted).map(|_| arena.symbol("weight", Stage::Variable)).skip(count);
        let zero = Operand::Number(0.0.into());
        let weights: Vec<Operand> =
            program.outputs.iter().map(|_| symbols.next().map_or(zero, Operand::Symbol)).collect();
        let layout = Layout::of(compiled);
        let operands = program.instructions.iter().flat_map(|step| [step.a, step.b]);
        let mut read: Vec<(Operand, usize)> = operands
            .chain(program.outputs.iter().copied())
            .filter_map(|operand| Some((operand, layout.place(compiled, operand)?)))
            .collect();
        read.sort_unstable();
        read.dedup();
        let by: Vec<Operand> = read.iter().map(|(operand, _)| *operand).collect();
        let both = program.with_adjoint(&weights, &by)?;
        let gradient = both.outputs.iter().copied().skip(program.outputs.len());
        let kept = gradient.zip(&read).filter(|(output, _)| *output != zero);
        let (outputs, places) = kept.map(|(output, (_, place))| (output, *place)).unzip();
        let transposed = Program { outputs, ..both }.without_dead_code();
        Ok(Self { code: Code::new(compiled, &transposed)?, places })
    }

    /// Adds to how much everything counts.
    pub fn run(&self, splines: &[Spline], slots: &mut [[f64; 1]], given: &Arguments<'_>, counts: &mut [f64]) {
        self.code.load(slots, given);
        execute(&self.code.instructions, splines, slots);
        for (&slot, &place) in self.code.outputs.iter().zip(&self.places) {
            if let (Some(count), Some([value])) = (counts.get_mut(place), slots.get(slot as usize)) {
                *count += value;
            }
        }
    }

    /// The same in slots of its own.
    pub fn run_once(
        &self,
        splines: &[Spline],
        number: impl Fn(Fixed) -> f64,
        given: &Arguments<'_>,
        counts: &mut [f64],
    ) {
        let mut slots = self.code.memory(|fixed| [number(fixed)]);
        self.run(splines, &mut slots, given, counts);
    }
}
