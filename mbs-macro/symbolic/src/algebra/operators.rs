//! `+ - * /` and signs between scalars, and between scalars and numbers.

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::Scalar;
use crate::arena::Arena;
use crate::number::Number;

impl Add for Scalar<'_> {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        self.algebra.make((self.expr, other.expr), |arena, (a, b)| arena.add(a, b))
    }
}

impl Sub for Scalar<'_> {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self.algebra.make((self.expr, other.expr), |arena, (a, b)| arena.sub(a, b))
    }
}

impl Neg for Scalar<'_> {
    type Output = Self;

    fn neg(self) -> Self {
        self.algebra.make(self.expr, Arena::neg)
    }
}

impl Mul for Scalar<'_> {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        self.algebra.make((self.expr, other.expr), |arena, (a, b)| arena.mul(a, b))
    }
}

/// By the constant 0, it is a float infinity, which no caller should provoke.
impl Div for Scalar<'_> {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        let quotient = (self.expr, other.expr);
        self.algebra.make(quotient, |arena, (a, b)| arena.product(&[(a, 1), (b, -1)]))
    }
}

impl<'a> Mul<Scalar<'a>> for Number {
    type Output = Scalar<'a>;

    fn mul(self, x: Scalar<'a>) -> Scalar<'a> {
        x.algebra.make((x.expr, self), |arena, (x, factor)| arena.scale(x, factor))
    }
}

impl<'a> Mul<Scalar<'a>> for i64 {
    type Output = Scalar<'a>;

    fn mul(self, x: Scalar<'a>) -> Scalar<'a> {
        Number::integer(self) * x
    }
}

impl<'a> Sub<Scalar<'a>> for i64 {
    type Output = Scalar<'a>;

    fn sub(self, x: Scalar<'a>) -> Scalar<'a> {
        x.algebra.number(self) - x
    }
}

impl<'a> Add<Scalar<'a>> for i64 {
    type Output = Scalar<'a>;

    fn add(self, x: Scalar<'a>) -> Scalar<'a> {
        x.algebra.number(self) + x
    }
}

impl Sub<i64> for Scalar<'_> {
    type Output = Self;

    fn sub(self, number: i64) -> Self {
        self - self.algebra.number(number)
    }
}

impl Div<i64> for Scalar<'_> {
    type Output = Self;

    fn div(self, divisor: i64) -> Self {
        Number::ratio(1, divisor).mul(self)
    }
}
