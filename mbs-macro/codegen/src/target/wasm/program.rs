//! The body of a function: the instructions of its program.
//!
//! A result that is read once stands where it is read, on the stack of the machine; the others are locals.

use mbs_symbolic::{Function as Elementary, Inconsistency, Instruction, Operand, Operation, Program, SinCos};
use wasm_encoder::{Function, MemArg, MemArgTarget, ValType};

use super::Signature;
use super::helpers::{Helper, Splines, function_of};
use crate::compiled::{Argument, Compiled, Input};

/// Results nest at most so deep, so that the printer's own stack is bounded.
const DEEPEST: u32 = 48;

/// What a parameter of a function is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Slot {
    /// The address of the parameters, and of what depends on them alone behind them.
    Mechanism,
    Time,
    Positions,
    Velocities,
    Inputs,
    /// The address of −2α and −β².
    Gains,
    Feedback,
    /// The address of q̈, and of λ behind it.
    Reactions,
    Shift,
    Predicted,
    /// h,
    Step,
    /// h/2,
    HalfStep,
    /// and t + h of a whole step.
    NextTime,
}

impl Slot {
    /// Where an argument is found; the states of a step stand in the place of all coordinates.
    pub fn of(argument: Argument) -> Self {
        match argument {
            Argument::Time => Self::Time,
            Argument::Positions | Argument::StatePositions => Self::Positions,
            Argument::Velocities | Argument::StateVelocities => Self::Velocities,
            Argument::Inputs => Self::Inputs,
            Argument::Gains => Self::Gains,
            Argument::Feedback => Self::Feedback,
            Argument::Reactions => Self::Reactions,
            Argument::Shift => Self::Shift,
            Argument::Predicted => Self::Predicted,
        }
    }

    /// A number, or an address.
    pub fn kind(self) -> ValType {
        match self {
            Self::Time | Self::Shift | Self::Step | Self::HalfStep | Self::NextTime => ValType::F64,
            _ => ValType::I32,
        }
    }
}

/// Where the result of an instruction is.
#[derive(Clone, Copy, PartialEq)]
enum Place {
    /// In this local.
    Local(u32),
    /// Where it is read.
    Stack,
}

/// The body of a function.
///
/// # Errors
/// The program reads what the function is not given.
pub fn body(
    compiled: &Compiled,
    program: &Program,
    signature: &Signature,
    splines: &Splines,
) -> Result<Function, Inconsistency> {
    let first = signature.slots.len() + signature.lengths.len();
    let places = places(program, first as u32);
    let locals = places.iter().filter(|place| matches!(place, Place::Local(_))).count() as u32;
    let code = Function::new([(locals, ValType::F64)]);
    let mut printer = Printer { compiled, program, signature, splines, places, code };
    printer.instructions()?;
    printer.results()?;
    printer.code.instructions().end();
    Ok(printer.code)
}

/// Locals from `next` on for what is read more than once, or by a sine and its cosine.
fn places(program: &Program, mut next: u32) -> Vec<Place> {
    let mut reads = vec![0_u32; program.instructions.len()];
    let operands = program.instructions.iter().flat_map(operands);
    for operand in operands.chain(program.outputs.iter().copied()) {
        if let Operand::Value(at) = operand {
            reads[at] += 1;
        }
    }
    let mut depths = vec![0_u32; reads.len()];
    let mut places = Vec::with_capacity(reads.len());
    for (at, instruction) in program.instructions.iter().enumerate() {
        let depth_of = |operand| match operand {
            Operand::Value(at) => depths[at],
            _ => 0,
        };
        let depth = 1 + operands_depth(instruction, depth_of);
        let is_turn = matches!(instruction.operation, Operation::Call(Elementary::Sin | Elementary::Cos));
        if reads[at] == 1 && !is_turn && depth < DEEPEST {
            depths[at] = depth;
            places.push(Place::Stack);
        } else {
            places.push(Place::Local(next));
            next += 1;
        }
    }
    places
}

fn operands_depth(instruction: &Instruction, depth_of: impl Fn(Operand) -> u32) -> u32 {
    operands(instruction).map(depth_of).max().unwrap_or(0)
}

/// The operands that an instruction has.
fn operands(instruction: &Instruction) -> impl Iterator<Item = Operand> {
    let has_two = match instruction.operation {
        Operation::Add | Operation::Sub | Operation::Mul | Operation::Div | Operation::Call2(_) => true,
        Operation::Neg | Operation::Call(_) | Operation::Spline(..) => false,
    };
    [Some(instruction.a), has_two.then_some(instruction.b)].into_iter().flatten()
}

struct Printer<'a> {
    compiled: &'a Compiled,
    program: &'a Program,
    signature: &'a Signature,
    splines: &'a Splines,
    places: Vec<Place>,
    code: Function,
}

impl Printer<'_> {
    /// All instructions whose results are locals, with what they read on the way.
    fn instructions(&mut self) -> Result<(), Inconsistency> {
        let pairs = SinCos::of(self.program);
        for (at, instruction) in self.program.instructions.iter().enumerate() {
            let Place::Local(local) = self.places[at] else { continue };
            let Operation::Call(turn @ (Elementary::Sin | Elementary::Cos)) = instruction.operation else {
                self.value(at)?;
                self.code.instructions().local_set(local);
                continue;
            };
            let partner = pairs.partner(at);
            // the first of both brings the other
            if partner.is_some_and(|partner| partner < at) {
                continue;
            }
            let partner = partner.and_then(|partner| match self.places[partner] {
                Place::Local(local) => Some(local),
                Place::Stack => None,
            });
            let is_sine = turn == Elementary::Sin;
            let (sine, cosine) = if is_sine { (Some(local), partner) } else { (partner, Some(local)) };
            self.operand(instruction.a)?;
            self.code.instructions().call(Helper::SinCos.index());
            // the cosine is on top
            for local in [cosine, sine] {
                match local {
                    Some(local) => self.code.instructions().local_set(local),
                    None => self.code.instructions().drop(),
                };
            }
        }
        Ok(())
    }

    /// Leaves the result of an instruction on the stack.
    fn value(&mut self, at: usize) -> Result<(), Inconsistency> {
        let instruction = &self.program.instructions[at];
        for operand in operands(instruction) {
            self.operand(operand)?;
        }
        let mut code = self.code.instructions();
        match instruction.operation {
            Operation::Add => code.f64_add(),
            Operation::Sub => code.f64_sub(),
            Operation::Mul => code.f64_mul(),
            Operation::Div => code.f64_div(),
            Operation::Neg => code.f64_neg(),
            Operation::Call(Elementary::Sqrt) => code.f64_sqrt(),
            Operation::Call(Elementary::Abs) => code.f64_abs(),
            Operation::Call2(Elementary::Greater) => code.f64_gt().f64_convert_i32_u(),
            Operation::Call(function) | Operation::Call2(function) => match function_of(function) {
                Some(index) => code.call(index),
                None => return Err(fault("every function has a code")),
            },
            Operation::Spline(spline, order) => {
                let address = self.splines.address(spline.index()).ok_or(fault("splines are in memory"))?;
                code.i32_const(address).i32_const(order.into()).call(Helper::Interpolate.index())
            }
        };
        Ok(())
    }

    /// Leaves an operand on the stack.
    fn operand(&mut self, operand: Operand) -> Result<(), Inconsistency> {
        match operand {
            Operand::Number(number) => {
                self.code.instructions().f64_const(number.to_f64().into());
            }
            Operand::Symbol(symbol) => self.input(self.compiled.input(symbol))?,
            Operand::Hoisted(at) => self.element(Slot::Mechanism, self.compiled.parameters.len() + at)?,
            Operand::Value(at) => match self.places[at] {
                Place::Local(local) => {
                    self.code.instructions().local_get(local);
                }
                Place::Stack => self.value(at)?,
            },
        }
        Ok(())
    }

    fn input(&mut self, input: Input) -> Result<(), Inconsistency> {
        match input {
            Input::Parameter(at) => self.element(Slot::Mechanism, at),
            Input::Input(at) => self.element(Slot::Inputs, at),
            Input::Position(at) | Input::StatePosition(at) => self.element(Slot::Positions, at),
            Input::Velocity(at) | Input::StateVelocity(at) => self.element(Slot::Velocities, at),
            Input::Acceleration(at) => self.element(Slot::Reactions, at),
            Input::Multiplier(at) => self.element(Slot::Reactions, self.compiled.coordinates.len() + at),
            Input::Feedback(at) => self.element(Slot::Feedback, at),
            Input::Predicted(at) => self.element(Slot::Predicted, at),
            Input::MinusTwoAlpha => self.element(Slot::Gains, 0),
            Input::MinusBetaSquared => self.element(Slot::Gains, 1),
            Input::Time => self.number(Slot::Time),
            Input::Shift => self.number(Slot::Shift),
            Input::Step => self.number(Slot::Step),
            Input::HalfStep => self.number(Slot::HalfStep),
            Input::NextTime => self.number(Slot::NextTime),
            Input::Weight(_) => Err(fault("a transposed program is not printed")),
        }
    }

    /// A parameter of the function.
    fn number(&mut self, slot: Slot) -> Result<(), Inconsistency> {
        let at = self.signature.slots.iter().position(|&other| other == slot);
        let at = at.ok_or(fault("a program reads what its function is given"))?;
        self.code.instructions().local_get(at as u32);
        Ok(())
    }

    /// A number at an address that is a parameter of the function.
    fn element(&mut self, slot: Slot, at: usize) -> Result<(), Inconsistency> {
        self.number(slot)?;
        self.code.instructions().f64_load(word(at));
        Ok(())
    }

    /// Writes the results to their addresses, and leaves one to be returned.
    fn results(&mut self) -> Result<(), Inconsistency> {
        let Signature { slots, lengths, returns, .. } = self.signature;
        let mut values = self.program.outputs.iter();
        for (result, &length) in lengths.iter().enumerate() {
            for (at, &value) in (0..length).zip(values.by_ref()) {
                self.code.instructions().local_get((slots.len() + result) as u32);
                self.operand(value)?;
                self.code.instructions().f64_store(word(at));
            }
        }
        match (returns, values.next()) {
            (true, Some(&value)) => self.operand(value),
            (true, None) => Err(fault("a function has the number that it returns")),
            (false, _) => Ok(()),
        }
    }
}

/// The place of a number behind an address.
pub fn word(at: usize) -> MemArg {
    MemArg { offset: 8 * at as u64, align: 3, target: MemArgTarget::default(), ordering: None }
}

fn fault(rule: &'static str) -> Inconsistency {
    Inconsistency { pass: "wasm", rule }
}
