//! Numbers that move: derivatives by the chain rule on numbers, without the algebra of expressions.
//!
//! A number that moves at a rate that moves has a second derivative, so nothing but first derivatives of
//! functions is needed.

use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::arithmetic::{Arithmetic, Numeric};
use crate::number::Number;
use crate::operators::Function;
use crate::spline::Spline;

/// x and ẋ.
#[derive(Clone, Copy, Debug, Default)]
pub struct Moving<T> {
    value: T,
    rate: T,
}

/// x, ẋ and ẍ along a curve.
#[derive(Clone, Copy, Debug, Default)]
pub struct Jet<T> {
    /// x
    pub value: T,
    /// ẋ
    pub first: T,
    /// ẍ
    pub second: T,
}

impl<T: Copy> From<Jet<T>> for Moving<Moving<T>> {
    fn from(Jet { value, first, second }: Jet<T>) -> Self {
        Self { value: Moving { value, rate: first }, rate: Moving { value: first, rate: second } }
    }
}

impl<T: Copy> From<Moving<Moving<T>>> for Jet<T> {
    fn from(Moving { value, rate }: Moving<Moving<T>>) -> Self {
        Self { value: value.value, first: rate.value, second: rate.rate }
    }
}

impl<T: Numeric> Moving<T> {
    fn still(value: T) -> Self {
        Self { value, rate: T::default() }
    }
}

/// The part of a rate that a slope passes on. Where one of them is 0, the other one need not be a number: what does not
/// move may stand where a function has no slope.
fn passed_on<T: Numeric>(slope: T, rate: T) -> T {
    if slope.is_zero() || rate.is_zero() { T::default() } else { slope * rate }
}

impl<T: Numeric> Arithmetic for Moving<T> {
    fn constant(self, value: i64) -> Self {
        Self::still(self.value.constant(value))
    }

    fn half(self) -> Self {
        Self { value: self.value.half(), rate: self.rate.half() }
    }

    fn call(self, function: Function, y: Self) -> Self {
        let value = self.value.call(function, y.value);
        let [along_x, along_y] = function.slopes(self.value, y.value, value);
        Self { value, rate: passed_on(along_x, self.rate) + passed_on(along_y, y.rate) }
    }
}

impl<T: Numeric> Numeric for Moving<T> {
    fn number(number: Number) -> Self {
        Self::still(T::number(number))
    }

    fn is_zero(self) -> bool {
        self.value.is_zero() && self.rate.is_zero()
    }

    fn spline(self, spline: &Spline, order: u8) -> Self {
        let [value, slope] = [order, order + 1].map(|order| self.value.spline(spline, order));
        Self { value, rate: passed_on(slope, self.rate) }
    }
}

impl<T: Numeric> Add for Moving<T> {
    type Output = Self;

    fn add(self, y: Self) -> Self {
        Self { value: self.value + y.value, rate: self.rate + y.rate }
    }
}

impl<T: Numeric> Sub for Moving<T> {
    type Output = Self;

    fn sub(self, y: Self) -> Self {
        self + -y
    }
}

impl<T: Numeric> Neg for Moving<T> {
    type Output = Self;

    fn neg(self) -> Self {
        Self { value: -self.value, rate: -self.rate }
    }
}

impl<T: Numeric> Mul for Moving<T> {
    type Output = Self;

    fn mul(self, y: Self) -> Self {
        Self {
            value: self.value * y.value,
            rate: passed_on(y.value, self.rate) + passed_on(self.value, y.rate),
        }
    }
}

impl<T: Numeric> Div for Moving<T> {
    type Output = Self;

    fn div(self, y: Self) -> Self {
        let value = self.value / y.value;
        let change = self.rate - passed_on(value, y.rate);
        Self { value, rate: if change.is_zero() { change } else { change / y.value } }
    }
}
