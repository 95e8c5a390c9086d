//! The body of a function: the instructions of its program.
//!
//! A result that is read once stands where it is read, on the stack of the machine; the others are locals.

use std::ops::Range;

use mbs_symbolic::layout::{Array, Place as Kept};
use mbs_symbolic::{
    Function as Elementary, Inconsistency, Instruction, Operand, Operation, Program, SinCos, Wasm,
};
use wasm_encoder::{Function, InstructionSink, MemArg, ValType};

use super::helpers::{Helper, import};
use super::loops;
use super::memory::{Memory, word};
use super::planned::{Planned, Signature};
use super::slot::Slot;
use crate::compiled::{Compiled, Input};

/// Results nest at most so deep, so that the printer's own stack is bounded.
const DEEPEST: u32 = 48;

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
    planned: &Planned<'_>,
    memory: &mut Memory,
) -> Result<Function, Inconsistency> {
    let Signature { slots, lengths, .. } = &planned.signature;
    let copy = (slots.len() + lengths.len()) as u32;
    let code = Vec::new();
    let (range, places) = (0..0, Vec::new());
    let mut printer =
        Printer { compiled, planned, memory, range, places, copy, next: copy + 1, most: 0, code };
    match &planned.layout {
        None => {
            printer.straight(0..planned.program.instructions.len(), &[])?;
            printer.results()?;
        }
        Some(layout) => loops::print(&mut printer, layout)?,
    }
    printer.sink().end();
    let Printer { most, code, .. } = printer;
    let mut function = Function::new([(1, ValType::I32), (most, ValType::F64)]);
    function.raw(code);
    Ok(function)
}

fn operands_depth(instruction: &Instruction, depth_of: impl Fn(Operand) -> u32) -> u32 {
    instruction.operands().map(depth_of).max().unwrap_or(0)
}

/// Writes instructions of a program.
pub struct Printer<'a> {
    pub compiled: &'a Compiled,
    pub planned: &'a Planned<'a>,
    pub memory: &'a mut Memory,
    /// The instructions that are written together; results of others are where the layout keeps them.
    pub range: Range<usize>,
    /// Where their results are.
    places: Vec<Place>,
    /// The local with the copy of a loop, as the distance of numbers in bytes.
    pub copy: u32,
    /// The next local for a number, and behind the last one that was taken.
    next: u32,
    most: u32,
    code: Vec<u8>,
}

impl Printer<'_> {
    pub fn sink(&mut self) -> InstructionSink<'_> {
        InstructionSink::new(&mut self.code)
    }

    /// Begins instructions that are written together, whose locals nothing before them needs any longer.
    pub fn begin(&mut self, range: Range<usize>) {
        self.next = self.copy + 1;
        self.places.clear();
        self.range = range;
    }

    /// A local for a number.
    pub fn local(&mut self) -> u32 {
        self.next += 1;
        self.most = self.most.max(self.next - self.copy - 1);
        self.next - 1
    }

    /// The result of the next instruction is in this local.
    pub fn is_in(&mut self, local: u32) {
        self.places.push(Place::Local(local));
    }

    /// Instructions one after the other, and what is kept of their results.
    ///
    /// # Errors
    /// The program reads what the function is not given.
    pub fn straight(&mut self, range: Range<usize>, kept: &[(usize, Kept)]) -> Result<(), Inconsistency> {
        self.begin(range);
        self.find_places(kept);
        self.instructions()?;
        // all that is kept is in locals by now, so that nothing is overwritten that is still read
        for &(at, place) in kept {
            self.keep(Operand::Value(at), place)?;
        }
        Ok(())
    }

    /// Locals for what is read more than once, is kept, or comes of a sine and its cosine.
    fn find_places(&mut self, kept: &[(usize, Kept)]) {
        let Program { instructions, outputs, .. } = self.planned.program;
        let start = self.range.start;
        let mut reads = vec![0_u32; self.range.len()];
        let read = instructions[self.range.clone()].iter().flat_map(Instruction::operands);
        let results = outputs.iter().copied().filter(|_| self.planned.layout.is_none());
        for operand in read.chain(results) {
            if let Operand::Value(at) = operand
                && self.range.contains(&at)
            {
                reads[at - start] += 1;
            }
        }
        kept.iter().for_each(|(at, _)| reads[at - start] += 2);
        let mut depths = vec![0_u32; reads.len()];
        for (at, instruction) in instructions[self.range.clone()].iter().enumerate() {
            let depth_of = |operand| match operand {
                Operand::Value(at) => at.checked_sub(start).map_or(0, |at| depths[at]),
                _ => 0,
            };
            let depth = 1 + operands_depth(instruction, depth_of);
            if reads[at] == 1 && instruction.operation.turn().is_none() && depth < DEEPEST {
                depths[at] = depth;
                self.places.push(Place::Stack);
            } else {
                let local = self.local();
                self.is_in(local);
            }
        }
    }

    /// All instructions whose results are locals, with what they read on the way.
    fn instructions(&mut self) -> Result<(), Inconsistency> {
        let program = self.planned.program;
        let pairs = SinCos::of(program);
        for at in self.range.clone() {
            let Place::Local(local) = self.place(at) else { continue };
            let instruction = &program.instructions[at];
            let Some(turn) = instruction.operation.turn() else {
                self.value(at)?;
                self.sink().local_set(local);
                continue;
            };
            let partner = pairs.partner(at).filter(|partner| self.range.contains(partner));
            // the first of both brings the other
            if partner.is_some_and(|partner| partner < at) {
                continue;
            }
            let partner = partner.and_then(|partner| match self.place(partner) {
                Place::Local(local) => Some(local),
                Place::Stack => None,
            });
            self.operand(instruction.a)?;
            self.turn(turn, local, partner);
        }
        Ok(())
    }

    /// The place of a result of the instructions that are written together.
    fn place(&self, at: usize) -> Place {
        self.places[at - self.range.start]
    }

    /// Sets the sine or the cosine of the angle on the stack, and the other one where it is asked for.
    pub fn turn(&mut self, turn: Elementary, local: u32, partner: Option<u32>) {
        let is_sine = turn == Elementary::Sin;
        let (sine, cosine) = if is_sine { (Some(local), partner) } else { (partner, Some(local)) };
        let mut code = self.sink();
        code.call(Helper::SinCos.index());
        // the cosine is on top
        for local in [cosine, sine] {
            match local {
                Some(local) => code.local_set(local),
                None => code.drop(),
            };
        }
    }

    /// Leaves the result of an instruction on the stack.
    fn value(&mut self, at: usize) -> Result<(), Inconsistency> {
        let instruction = &self.planned.program.instructions[at];
        for operand in instruction.operands() {
            self.operand(operand)?;
        }
        self.operation(instruction.operation)
    }

    /// Leaves the result of an operation with operands that are on the stack.
    pub fn operation(&mut self, operation: Operation) -> Result<(), Inconsistency> {
        let spline = match operation {
            Operation::Spline(spline, _) => self.memory.spline(spline.index()),
            _ => None,
        };
        let mut code = self.sink();
        match operation {
            Operation::Add => code.f64_add(),
            Operation::Sub => code.f64_sub(),
            Operation::Mul => code.f64_mul(),
            Operation::Div => code.f64_div(),
            Operation::Neg => code.f64_neg(),
            Operation::Call(function) => {
                let row = function.row();
                let index = match row.wasm {
                    Wasm::Code(bytes) => {
                        self.code.extend(bytes);
                        return Ok(());
                    }
                    Wasm::Host => row.c.and_then(import),
                    Wasm::Module => Helper::named(row.name).map(Helper::index),
                };
                code.call(index.ok_or(fault("every function has a code"))?)
            }
            Operation::Spline(_, order) => {
                let address = spline.ok_or(fault("splines are in memory"))?;
                code.i32_const(address as i32).i32_const(order.into()).call(Helper::Interpolate.index())
            }
        };
        Ok(())
    }

    /// Leaves an operand on the stack.
    pub fn operand(&mut self, operand: Operand) -> Result<(), Inconsistency> {
        match operand {
            Operand::Number(number) => {
                self.sink().f64_const(number.to_f64().into());
            }
            Operand::Symbol(symbol) => self.input(self.compiled.input(symbol))?,
            Operand::Hoisted(at) => self.element(Slot::Mechanism, self.compiled.parameters.len() + at)?,
            Operand::Value(at) if self.range.contains(&at) => match self.place(at) {
                Place::Local(local) => {
                    self.sink().local_get(local);
                }
                Place::Stack => self.value(at)?,
            },
            Operand::Value(at) => {
                let place = self.planned.layout.as_ref().and_then(|layout| layout.place(at));
                self.load(place.ok_or(fault("what another part reads is kept"))?);
            }
        }
        Ok(())
    }

    /// Leaves a number that is kept on the stack.
    pub fn load(&mut self, place: Kept) {
        let at = self.address(place.array, place.at);
        self.sink().f64_load(at);
    }

    /// Keeps an operand.
    pub fn keep(&mut self, operand: Operand, place: Kept) -> Result<(), Inconsistency> {
        let at = self.address(place.array, place.at);
        self.operand(operand)?;
        self.sink().f64_store(at);
        Ok(())
    }

    /// Leaves the address of an array on the stack; gives what to add for an element.
    pub fn address(&mut self, array: Array, at: usize) -> MemArg {
        match array {
            Array::Slots => {
                let slots = self.memory.slots() / 8;
                self.sink().i32_const(0);
                word(slots + at)
            }
            Array::Result(result) => {
                let result = self.result(result);
                self.sink().local_get(result);
                word(at)
            }
        }
    }

    /// The local with the address of results.
    pub fn result(&self, at: usize) -> u32 {
        (self.planned.signature.slots.len() + at) as u32
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

    /// The local with a parameter of the function.
    pub fn parameter(&self, slot: Slot) -> Result<u32, Inconsistency> {
        let at = self.planned.signature.slots.iter().position(|&other| other == slot);
        at.map(|at| at as u32).ok_or(fault("a program reads what its function is given"))
    }

    /// A parameter of the function.
    fn number(&mut self, slot: Slot) -> Result<(), Inconsistency> {
        let at = self.parameter(slot)?;
        self.sink().local_get(at);
        Ok(())
    }

    /// A number at an address that is a parameter of the function.
    fn element(&mut self, slot: Slot, at: usize) -> Result<(), Inconsistency> {
        self.number(slot)?;
        self.sink().f64_load(word(at));
        Ok(())
    }

    /// Writes the results to their addresses, and leaves one to be returned.
    fn results(&mut self) -> Result<(), Inconsistency> {
        let Signature { lengths, returns, .. } = &self.planned.signature;
        let mut values = self.planned.program.outputs.iter();
        for (result, &length) in lengths.iter().enumerate() {
            for (at, &value) in (0..length).zip(values.by_ref()) {
                self.keep(value, Kept { array: Array::Result(result), at })?;
            }
        }
        match (returns, values.next()) {
            (true, Some(&value)) => self.operand(value),
            (true, None) => Err(fault("a function has the number that it returns")),
            (false, _) => Ok(()),
        }
    }
}

pub fn fault(rule: &'static str) -> Inconsistency {
    Inconsistency { pass: "wasm", rule }
}
