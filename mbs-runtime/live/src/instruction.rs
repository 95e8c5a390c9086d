//! The instructions of an interpreter: operations on numbered slots.
//!
//! All scalar functions are those of `Real`. So results equal the compiled Rust to the last bit.
//! `models/tests/library/texts.rs` holds every mechanism of the library to that.
#![allow(clippy::needless_range_loop, reason = "a column is counted through several slots")]

use mbs_runtime::__private::Spline;
use mbs_runtime::Real;
use mbs_symbolic::Function;

/// An operation. The first slot is written, the others are read; of
/// [`SinCos`](Self::SinCos) the first two are written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Instruction {
    /// a + b
    Add([u32; 3]),
    /// a − b
    Sub([u32; 3]),
    /// a·b
    Mul([u32; 3]),
    /// a/b
    Div([u32; 3]),
    /// c + a·b, each rounded by itself
    MulAdd([u32; 4]),
    /// c − a·b
    SubMul([u32; 4]),
    /// a·b − c
    MulSub([u32; 4]),
    /// −a
    Neg([u32; 2]),
    /// Sine and cosine of one angle.
    SinCos([u32; 3]),
    /// f(a, b); b is a where the function has one argument.
    Call(Function, [u32; 3]),
    /// The derivative of this order of a spline at a.
    Spline { order: u8, spline: u32, slots: [u32; 2] },
}

/// Runs instructions. A slot holds `C` numbers: one operation is done on each of them.
///
/// Instructions of a kind that follow each other, which is how they are
/// [`grouped`](crate::grouped::grouped), are done in a loop of their own: its branch is foreseen, where a jump
/// by the kind of each instruction is not.
///
/// Slots and splines exist: that was checked when the instructions were made.
#[inline(always)]
pub fn execute<T: Real, const C: usize>(
    instructions: &[Instruction],
    splines: &[Spline],
    values: &mut [[T; C]],
) {
    let mut rest = instructions;
    macro_rules! all_of {
        ($Kind:ident, $run:ident, $f:expr) => {
            while let [Instruction::$Kind(slots), behind @ ..] = rest {
                $run(values, *slots, $f);
                rest = behind;
            }
        };
    }
    // each turn does at least its first instruction
    while let [instruction, behind @ ..] = rest {
        match *instruction {
            Instruction::Add(_) => all_of!(Add, binary, |a, b| a + b),
            Instruction::Sub(_) => all_of!(Sub, binary, |a, b| a - b),
            Instruction::Mul(_) => all_of!(Mul, binary, |a, b| a * b),
            Instruction::Div(_) => all_of!(Div, binary, |a, b| a / b),
            Instruction::MulAdd(_) => all_of!(MulAdd, ternary, |a, b, c| c + a * b),
            Instruction::SubMul(_) => all_of!(SubMul, ternary, |a, b, c| c - a * b),
            Instruction::MulSub(_) => all_of!(MulSub, ternary, |a, b, c| a * b - c),
            Instruction::Neg(_) => all_of!(Neg, unary, |a| -a),
            Instruction::SinCos([sine, cosine, angle]) => {
                for column in 0..C {
                    let (s, c) = values[angle as usize][column].sin_cos();
                    values[sine as usize][column] = s;
                    values[cosine as usize][column] = c;
                }
                rest = behind;
            }
            Instruction::Call(function, slots) => {
                call(function, values, slots);
                rest = behind;
            }
            Instruction::Spline { order, spline, slots } => {
                let spline = &splines[spline as usize];
                unary(values, slots, |a| spline.derivative(order, a));
                rest = behind;
            }
        }
    }
}

/// The same on single numbers, compiled apart from its callers: their branches beside it would cost a fifth of the
/// time.
#[inline(never)]
pub fn execute_alone(instructions: &[Instruction], splines: &[Spline], values: &mut [[f64; 1]]) {
    execute(instructions, splines, values);
}

#[inline(always)]
fn ternary<T: Real, const C: usize>(
    values: &mut [[T; C]],
    [to, a, b, c]: [u32; 4],
    f: impl Fn(T, T, T) -> T,
) {
    for column in 0..C {
        let number = |slot: u32| values[slot as usize][column];
        values[to as usize][column] = f(number(a), number(b), number(c));
    }
}

#[inline(always)]
fn binary<T: Real, const C: usize>(values: &mut [[T; C]], [to, a, b]: [u32; 3], f: impl Fn(T, T) -> T) {
    for column in 0..C {
        values[to as usize][column] = f(values[a as usize][column], values[b as usize][column]);
    }
}

#[inline(always)]
fn unary<T: Real, const C: usize>(values: &mut [[T; C]], [to, a]: [u32; 2], f: impl Fn(T) -> T) {
    for column in 0..C {
        values[to as usize][column] = f(values[a as usize][column]);
    }
}

/// The functions of [`Real`] by their names in programs.
#[inline(always)]
fn call<T: Real, const C: usize>(function: Function, values: &mut [[T; C]], slots: [u32; 3]) {
    match function {
        Function::Sin => binary(values, slots, |a, _| a.sin()),
        Function::Cos => binary(values, slots, |a, _| a.cos()),
        Function::Tan => binary(values, slots, |a, _| a.tan()),
        Function::Asin => binary(values, slots, |a, _| a.asin()),
        Function::Acos => binary(values, slots, |a, _| a.acos()),
        Function::Atan => binary(values, slots, |a, _| a.atan()),
        Function::Sqrt => binary(values, slots, |a, _| a.sqrt()),
        Function::Exp => binary(values, slots, |a, _| a.exp()),
        Function::Ln => binary(values, slots, |a, _| a.ln()),
        Function::Tanh => binary(values, slots, |a, _| a.tanh()),
        Function::Abs => binary(values, slots, |a, _| a.abs()),
        Function::Sign => binary(values, slots, |a, _| a.sign()),
        Function::Atan2 => binary(values, slots, |a, b| a.atan2(b)),
        Function::Min => binary(values, slots, |a, b| a.min(b)),
        Function::Max => binary(values, slots, |a, b| a.max(b)),
        Function::Pow => binary(values, slots, |a, b| a.pow(b)),
        Function::Greater | Function::Choice => binary(values, slots, |a, b| a.greater(b)),
        Function::Gate => binary(values, slots, |a, b| a.gate(b)),
    }
}
