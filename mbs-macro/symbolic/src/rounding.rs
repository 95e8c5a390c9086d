//! Numbers with a running bound of their rounding error.
//!
//! # Source
//! N. J. Higham, Accuracy and Stability of Numerical Algorithms, 2nd ed., SIAM 2002, section 3.3.

use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::arithmetic::{Arithmetic, Numeric};
use crate::number::Number;
use crate::operators::{Function, Pieces};
use crate::spline::Spline;

/// A computed value and a first-order bound of how far it may be from the exact
/// one, given exact inputs.
#[derive(Clone, Copy, Debug, Default)]
pub struct Rounded {
    /// The computed value.
    pub value: f64,
    /// The bound; infinite or NaN where nothing is known.
    pub error: f64,
}

/// A library function is good to a unit in the last place or two.
const OF_A_FUNCTION: f64 = 2.0 * f64::EPSILON;

impl Rounded {
    /// A number that is what it should be.
    pub fn exact(value: f64) -> Self {
        Self { value, error: 0.0 }
    }

    /// A result that was rounded once more.
    fn after(value: f64, error: f64) -> Self {
        Self { value, error: error + f64::EPSILON * value.abs() }
    }

    /// 1/x
    #[must_use]
    pub fn recip(self) -> Self {
        let value = 1.0 / self.value;
        Self::after(value, self.error * value * value)
    }
}

impl Arithmetic for Rounded {
    fn constant(self, value: i64) -> Self {
        Self::exact(value as f64)
    }

    fn half(self) -> Self {
        Self { value: 0.5 * self.value, error: 0.5 * self.error }
    }

    fn call(self, function: Function, y: Self) -> Self {
        let row = function.row();
        let y = if row.arity == 1 { Self::default() } else { y };
        let value = (row.value)(self.value, y.value);
        // no change of an argument, no error of it
        let passed_on = |(slope, x): (f64, Self)| if x.error == 0.0 { 0.0 } else { slope.abs() * x.error };
        let error = match row.pieces {
            Pieces::One => {
                let slopes = function.slopes(self.value, y.value, value);
                let passed_on: f64 = slopes.into_iter().zip([self, y]).map(passed_on).sum();
                passed_on + OF_A_FUNCTION * value.abs()
            }
            Pieces::Kinked => self.error.max(y.error),
            Pieces::Gate if self.value == 0.0 && self.error == 0.0 => 0.0,
            Pieces::Gate => self.error.max(y.error),
            // where rounding decides between the pieces, nothing is known
            Pieces::Steps if (self.value - y.value).abs() <= 4.0 * (self.error + y.error) => f64::INFINITY,
            Pieces::Steps | Pieces::Seamless => 0.0,
        };
        Self { value, error }
    }
}

impl Numeric for Rounded {
    /// It was rounded when it was read and when constants were folded.
    fn number(number: Number) -> Self {
        Self { value: number.to_f64(), error: number.error() }
    }

    fn is_zero(self) -> bool {
        self.value == 0.0 && self.error == 0.0
    }

    /// The argument is reduced to one period and then to one segment, with an error of a few roundings of the
    /// larger of both. The four terms are as large as the derivatives times the period, or the way from the first
    /// point to the last, allow.
    fn spline(self, spline: &Spline, order: u8) -> Self {
        let of = |more: u8| self.value.spline(spline, order + more);
        let span = spline.span();
        let reduced = self.error + 4.0 * f64::EPSILON * (self.value.abs() + spline.origin.abs() + span);
        let terms = of(0).abs() + of(1).abs() * span + of(2).abs() * span * span;
        Self { value: of(0), error: of(1).abs() * reduced + 16.0 * f64::EPSILON * terms }
    }
}

impl Add for Rounded {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self::after(self.value + other.value, self.error + other.error)
    }
}

impl Neg for Rounded {
    type Output = Self;

    fn neg(self) -> Self {
        Self { value: -self.value, ..self }
    }
}

impl Sub for Rounded {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Rounded {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let error = self.value.abs() * other.error + other.value.abs() * self.error;
        Self::after(self.value * other.value, error)
    }
}

impl Div for Rounded {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        self.mul(other.recip())
    }
}
