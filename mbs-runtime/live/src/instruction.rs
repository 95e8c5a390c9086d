//! What an interpreter does: operations on numbered slots.
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
/// Slots and splines exist: that was checked when the instructions were made.
#[inline(always)]
pub fn execute<T: Real, const C: usize>(
    instructions: &[Instruction],
    splines: &[Spline],
    values: &mut [[T; C]],
) {
    for instruction in instructions {
        match *instruction {
            Instruction::Add(slots) => binary(values, slots, |a, b| a + b),
            Instruction::Sub(slots) => binary(values, slots, |a, b| a - b),
            Instruction::Mul(slots) => binary(values, slots, |a, b| a * b),
            Instruction::Div(slots) => binary(values, slots, |a, b| a / b),
            Instruction::MulAdd(slots) => ternary(values, slots, |a, b, c| c + a * b),
            Instruction::SubMul(slots) => ternary(values, slots, |a, b, c| c - a * b),
            Instruction::MulSub(slots) => ternary(values, slots, |a, b, c| a * b - c),
            Instruction::Neg(slots) => unary(values, slots, |a| -a),
            Instruction::SinCos([sine, cosine, angle]) => {
                for column in 0..C {
                    let (s, c) = values[angle as usize][column].sin_cos();
                    values[sine as usize][column] = s;
                    values[cosine as usize][column] = c;
                }
            }
            Instruction::Call(function, slots) => call(function, values, slots),
            Instruction::Spline { order, spline, slots } => {
                let spline = &splines[spline as usize];
                unary(values, slots, |a| spline.derivative(order, a));
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
        let [a, b, c] = [a, b, c].map(|slot| values[slot as usize][column]);
        values[to as usize][column] = f(a, b, c);
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
        Function::Greater => binary(values, slots, |a, b| a.greater(b)),
    }
}
