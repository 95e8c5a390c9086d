//! The kinds of numbers that formulas are computed in: expressions, floats, floats with bounds of their rounding errors
//! (`rounding.rs`), and numbers that move (`moving.rs`).

use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::number::Number;
use crate::operators::Function;
use crate::spline::Spline;

/// A kind of number that the slopes of functions can be written in.
pub trait Arithmetic:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    /// A constant of the same kind.
    fn constant(self, value: i64) -> Self;
    /// x/2
    fn half(self) -> Self;
    /// f(x, y), or f(x) of a function of one argument.
    fn call(self, function: Function, y: Self) -> Self;
    /// f(x)
    fn of(self, function: Function) -> Self {
        self.call(function, self)
    }
    /// True if it is a constant by its form.
    fn is_number(self) -> bool {
        false
    }
}

/// Numbers in which expressions and programs are evaluated; 0 by default.
pub trait Numeric: Arithmetic + Default {
    /// A constant.
    fn number(number: Number) -> Self;
    /// Reports whether it is 0 without an error, and does not move.
    fn is_zero(self) -> bool;
    /// The derivative of this order of a spline, 0 beyond the third.
    fn spline(self, spline: &Spline, order: u8) -> Self;
    /// x to a power that is not 0.
    fn powi(self, exponent: i32) -> Self {
        let power = (1..exponent.unsigned_abs()).fold(self, |power, _| power * self);
        if exponent < 0 { self.constant(1) / power } else { power }
    }
}

impl Arithmetic for f64 {
    fn constant(self, value: i64) -> Self {
        value as Self
    }

    fn half(self) -> Self {
        0.5 * self
    }

    fn call(self, function: Function, y: Self) -> Self {
        (function.row().value)(self, y)
    }
}

impl Numeric for f64 {
    fn number(number: Number) -> Self {
        number.to_f64()
    }

    fn is_zero(self) -> bool {
        self == 0.0
    }

    fn spline(self, spline: &Spline, order: u8) -> Self {
        if order > 3 { 0.0 } else { spline.derivative(order, self) }
    }

    fn powi(self, exponent: i32) -> Self {
        Self::powi(self, exponent)
    }
}
