//! A program as flat code: operations on numbered slots.
//!
//! `slots` makes the code, `grouped` puts instructions of a kind behind each other, `instruction` does them,
//! and `check` compares the code with its program.

use mbs_codegen::compiled::{Compiled, Input};
use mbs_runtime::Real;
use mbs_symbolic::{Inconsistency, Operand, Program};

use crate::arguments::{Arguments, Given};
use crate::check::check;
use crate::grouped::grouped;
use crate::instruction::Instruction;
use crate::slots::allocate;

/// The code of a program.
#[derive(Debug)]
pub struct Code {
    /// The instructions of every run.
    pub instructions: Vec<Instruction>,
    /// The numbers in the first slots, before the first run and for ever.
    pub fixed: Vec<Fixed>,
    /// Arguments, and the slots that they are put into before every run.
    pub given: Vec<(Given, u32)>,
    /// The slots of the results after a run.
    pub outputs: Vec<u32>,
    /// The number of slots.
    pub slots: usize,
}

/// A number that does not change from run to run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fixed {
    /// A constant.
    Number(f64),
    /// A value that depends on parameters alone, by position.
    Hoisted(usize),
    /// A parameter, by position.
    Parameter(usize),
}

impl Fixed {
    /// The number for these parameters and what depends on them; no number where there is
    /// none.
    pub fn value<T: Real>(self, parameters: &[T], hoisted: &[T]) -> T {
        let number = match self {
            Self::Number(number) => return T::from_f64(number),
            Self::Hoisted(at) => hoisted.get(at),
            Self::Parameter(at) => parameters.get(at),
        };
        number.copied().unwrap_or(T::from_f64(f64::NAN))
    }
}

impl Code {
    /// The code of a program of a compiled mechanism.
    ///
    /// # Errors
    /// The code does not do what the program does, which is a mistake of this crate.
    pub fn new(compiled: &Compiled, program: &Program) -> Result<Self, Inconsistency> {
        Self::in_order(compiled, &grouped(program))
    }

    /// The same, its instructions in the order of the program.
    pub fn in_order(compiled: &Compiled, program: &Program) -> Result<Self, Inconsistency> {
        let code = allocate(program, &|operand| role(compiled, operand))?;
        check(compiled, program, &code)?;
        Ok(code)
    }

    /// Slots to run in, the first of them filled; `number` gives what a fixed one holds.
    pub fn memory<T: Real, const C: usize>(&self, number: impl Fn(Fixed) -> [T; C]) -> Vec<[T; C]> {
        let mut values = vec![[T::default(); C]; self.slots];
        for (value, &fixed) in values.iter_mut().zip(&self.fixed) {
            *value = number(fixed);
        }
        values
    }

    /// Puts arguments into their slots.
    #[inline]
    pub fn load<T: Real, const C: usize>(&self, values: &mut [[T; C]], arguments: &Arguments<'_, T, C>) {
        for &(given, slot) in &self.given {
            values[slot as usize] = arguments.read(given);
        }
    }

    /// Copies results out of their slots, one vector after the other.
    #[inline]
    pub fn store<T: Real, const C: usize>(&self, values: &[[T; C]], results: &mut [&mut [[T; C]]]) {
        let mut outputs = self.outputs.iter();
        for vector in results {
            for (place, &slot) in vector.iter_mut().zip(outputs.by_ref()) {
                *place = values[slot as usize];
            }
        }
    }
}

/// The role of an operand in the code that reads it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Role {
    /// There before the first run.
    Fixed(Fixed),
    /// An argument of every run.
    Given(Given),
    /// The result of an instruction.
    Value(usize),
}

/// The role of an operand.
pub fn role(compiled: &Compiled, operand: Operand) -> Role {
    let given = match operand {
        Operand::Number(number) => return Role::Fixed(Fixed::Number(number.to_f64())),
        Operand::Hoisted(at) => return Role::Fixed(Fixed::Hoisted(at)),
        Operand::Value(at) => return Role::Value(at),
        Operand::Symbol(symbol) => match compiled.input(symbol) {
            Input::Parameter(at) => return Role::Fixed(Fixed::Parameter(at)),
            Input::Time => Given::Time,
            Input::Step => Given::Step,
            Input::HalfStep => Given::HalfStep,
            Input::NextTime => Given::NextTime,
            Input::MinusTwoAlpha => Given::MinusTwoAlpha,
            Input::MinusBetaSquared => Given::MinusBetaSquared,
            Input::Position(at) | Input::StatePosition(at) => Given::Position(at),
            Input::Velocity(at) | Input::StateVelocity(at) => Given::Velocity(at),
            Input::Input(at) => Given::Input(at),
            Input::Acceleration(at) => Given::Acceleration(at),
            Input::Multiplier(at) => Given::Multiplier(at),
            Input::Feedback(at) => Given::Feedback(at),
            Input::Predicted(at) => Given::Acceleration(at),
            Input::Shift => Given::Shift,
            Input::Weight(at) => Given::Weight(at),
        },
    };
    Role::Given(given)
}
