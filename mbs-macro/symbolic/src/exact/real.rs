//! Constants that are no short fractions.

use std::f64::consts::PI;
use std::ops::{Add, Mul};

use super::residue::Residue;
use crate::number::Number;

/// The residue of π, which no polynomial with rational coefficients relates to anything.
const REASON_PI: u64 = 1;
/// Those of results that stand for themselves.
const REASON_ROOT: u64 = 2;
const REASON_SUM: u64 = 3;
const REASON_INVERSE: u64 = 4;
const REASON_FUNCTION: u64 = 5;

/// Rounding leaves at most this share of the terms of a sum that is 0. It guards roots of roots,
/// whose residues may have the other sign; rounding of some hundred operations is far below.
const CANCELLED: f64 = 1e-9;

/// A real number: a float near it, and its exact value as a [`Residue`].
///
/// The float has the rounding errors of the operations that led to it, of which a bound to first order is
/// kept. The residue has none, so it decides whether a difference is 0. Results of functions that have no
/// exact rule stand for themselves: their residues are related to no others.
#[derive(Clone, Copy, Debug)]
pub struct Real {
    value: f64,
    /// The bound of what rounding did to the value, as a share of it.
    rounding: f32,
    residue: Residue,
}

impl Real {
    /// A value that operations on other rounded ones led to, which `passed_on` their errors.
    fn rounded(value: f64, passed_on: f64, residue: Residue) -> Self {
        let share = if value == 0.0 { 0.0 } else { passed_on / value.abs() };
        Self { value, rounding: (share + f64::EPSILON) as f32, residue }
    }

    /// A float as it is.
    pub fn float(value: f64) -> Self {
        let of_bits = || Residue::stand_in(value.to_bits(), &[]);
        Self::rounded(value, 0.0, Residue::float(value).unwrap_or_else(of_bits))
    }

    /// (numerator/denominator) π
    pub fn pi(numerator: i64, denominator: i64) -> Self {
        let value = PI * numerator as f64 / denominator as f64;
        let residue =
            Residue::ratio(numerator, denominator).unwrap_or_default() * Residue::stand_in(REASON_PI, &[]);
        Self::rounded(value, 2.0 * f64::EPSILON * value.abs(), residue)
    }

    /// A constant with its residue.
    pub fn of(number: Number) -> Self {
        match number {
            Number::Rational(n, d) => {
                let residue = Residue::ratio(n, d).unwrap_or_else(|| Residue::stand_in(REASON_INVERSE, &[]));
                Self::rounded(n as f64 / d as f64, 0.0, residue)
            }
            Number::Real(real) => real,
        }
    }

    /// The float.
    pub fn value(self) -> f64 {
        self.value
    }

    /// A bound, to first order, of the distance between the float and the exact value.
    pub fn error(self) -> f64 {
        f64::from(self.rounding) * self.value.abs()
    }

    /// The exact value.
    pub fn residue(self) -> Residue {
        self.residue
    }

    /// 1/x
    pub fn recip(self) -> Self {
        let of_zero = || Residue::stand_in(REASON_INVERSE, &[self.residue]);
        let value = 1.0 / self.value;
        Self::rounded(value, self.error() * value * value, self.residue.inverse().unwrap_or_else(of_zero))
    }

    /// √x
    pub fn sqrt(self) -> Number {
        let none = || Residue::stand_in(REASON_ROOT, &[self.residue]);
        let value = self.value.sqrt();
        Self::rounded(value, 0.5 * self.error() / value, self.residue.root().unwrap_or_else(none)).number()
    }

    /// √(numerator/denominator), which is not negative
    pub fn root_of_ratio(numerator: i64, denominator: i64) -> Number {
        let value = (numerator as f64 / denominator as f64).sqrt();
        let none =
            || Residue::stand_in(REASON_ROOT, &[Residue::integer(numerator), Residue::integer(denominator)]);
        let residue = Residue::root_of_ratio(numerator, denominator).unwrap_or_else(none);
        Self::rounded(value, 0.0, residue).number()
    }

    /// The turn exp(i x) by this angle, if it is a multiple of π with a short fraction.
    pub fn turn(self) -> Option<Residue> {
        const PARTS: i64 = 100_800;
        let count = (self.value / PI * PARTS as f64).round();
        let is_multiple = count.abs() < 1e15 && Self::pi(count as i64, PARTS).residue == self.residue;
        if is_multiple { Residue::turn(count as i64, PARTS) } else { None }
    }

    /// The result `value` of a function of x, or of x and y, that stands for itself.
    pub fn of_function(value: f64, name: &str, arguments: &[Self]) -> Self {
        let name = name.bytes().fold(REASON_FUNCTION, |hash, byte| hash.rotate_left(8) ^ u64::from(byte));
        let of: Vec<Residue> = arguments.iter().map(|argument| argument.residue).collect();
        Self::known(value, arguments, Residue::stand_in(name, &of))
    }

    /// The result `value` of a function whose exact value is known. Its slope is taken to be 1, or the result
    /// if that is more: so steep are sine, cosine, tangent hyperbolic and exponential at most.
    pub fn known(value: f64, arguments: &[Self], residue: Residue) -> Self {
        let passed_on: f64 = arguments.iter().map(|argument| argument.error()).sum();
        Self::rounded(value, passed_on * value.abs().max(1.0) + f64::EPSILON * value.abs(), residue)
    }

    /// The same as a fraction, if it is an integer or half of one.
    pub fn number(self) -> Number {
        let twice = 2.0 * self.value;
        let nearest = twice.round();
        if self.value.fract() == 0.0 && self.value.abs() < 9e15 {
            return Number::integer(self.value as i64);
        }
        let is_near =
            nearest != 0.0 && nearest.abs() < 1e12 && (twice - nearest).abs() <= CANCELLED * nearest.abs();
        if is_near && Residue::ratio(nearest as i64, 2) == Some(self.residue) {
            return Number::ratio(nearest as i64, 2);
        }
        Number::Real(self)
    }
}

impl Add for Real {
    type Output = Number;

    /// Exactly 0 where the sum is 0.
    fn add(self, other: Self) -> Number {
        let value = self.value + other.value;
        let residue = self.residue + other.residue;
        let passed_on = self.error() + other.error();
        if residue != Residue::ZERO {
            return Self::rounded(value, passed_on, residue).number();
        }
        if value.abs() <= CANCELLED * self.value.abs().max(other.value.abs()) {
            return Number::ZERO;
        }
        let of = [self.residue, Residue::ONE];
        Self::rounded(value, passed_on, Residue::stand_in(REASON_SUM, &of)).number()
    }
}

impl Mul for Real {
    type Output = Number;

    fn mul(self, other: Self) -> Number {
        let passed_on = self.value.abs() * other.error() + other.value.abs() * self.error();
        Self::rounded(self.value * other.value, passed_on, self.residue * other.residue).number()
    }
}
