//! A scalar that carries its derivative along one direction, so that generated
//! code, run with it, differentiates itself.

use std::cmp::Ordering;
use std::fmt;
use std::ops::{Add, Div, Mul, Neg, Sub};

use mbs_runtime::Real;

/// x and dx/ds.
#[derive(Clone, Copy, Debug, Default)]
pub struct Dual {
    pub value: f64,
    pub rate: f64,
}

impl Dual {
    pub fn new(value: f64, rate: f64) -> Self {
        Self { value, rate }
    }

    /// f(x) from f and f′ at x.
    fn chain(self, f: f64, slope: f64) -> Self {
        Self::new(f, slope * self.rate)
    }
}

impl PartialEq for Dual {
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value
    }
}

impl PartialOrd for Dual {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.value.partial_cmp(&other.value)
    }
}

impl fmt::Display for Dual {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.value.fmt(f)
    }
}

impl Add for Dual {
    type Output = Self;
    fn add(self, y: Self) -> Self {
        Self::new(self.value + y.value, self.rate + y.rate)
    }
}

impl Neg for Dual {
    type Output = Self;
    fn neg(self) -> Self {
        Self::new(-self.value, -self.rate)
    }
}

impl Sub for Dual {
    type Output = Self;
    fn sub(self, y: Self) -> Self {
        self + -y
    }
}

impl Mul for Dual {
    type Output = Self;
    fn mul(self, y: Self) -> Self {
        Self::new(self.value * y.value, self.rate * y.value + self.value * y.rate)
    }
}

impl Div for Dual {
    type Output = Self;
    fn div(self, y: Self) -> Self {
        let quotient = self.value / y.value;
        Self::new(quotient, (self.rate - quotient * y.rate) / y.value)
    }
}

impl Real for Dual {
    const EPSILON: Self = Self { value: f64::EPSILON, rate: 0.0 };
    type Pair = mbs_runtime::Two<Self>;

    fn from_f64(x: f64) -> Self {
        Self::new(x, 0.0)
    }
    fn to_f64(self) -> f64 {
        self.value
    }
    fn is_finite(self) -> bool {
        self.value.is_finite() && self.rate.is_finite()
    }
    fn sin_cos(self) -> (Self, Self) {
        let (s, c) = self.value.sin_cos();
        (self.chain(s, c), self.chain(c, -s))
    }
    fn sin(self) -> Self {
        self.sin_cos().0
    }
    fn cos(self) -> Self {
        self.sin_cos().1
    }
    fn tan(self) -> Self {
        let (s, c) = self.sin_cos();
        s / c
    }
    fn asin(self) -> Self {
        self.chain(self.value.asin(), 1.0 / (1.0 - self.value * self.value).sqrt())
    }
    fn acos(self) -> Self {
        self.chain(self.value.acos(), -1.0 / (1.0 - self.value * self.value).sqrt())
    }
    fn atan(self) -> Self {
        self.chain(self.value.atan(), 1.0 / (1.0 + self.value * self.value))
    }
    fn atan2(self, x: Self) -> Self {
        let squared = self.value * self.value + x.value * x.value;
        let rate = (x.value * self.rate - self.value * x.rate) / squared;
        Self::new(self.value.atan2(x.value), rate)
    }
    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        self.chain(root, 0.5 / root)
    }
    fn exp(self) -> Self {
        let e = self.value.exp();
        self.chain(e, e)
    }
    fn ln(self) -> Self {
        self.chain(self.value.ln(), 1.0 / self.value)
    }
    fn tanh(self) -> Self {
        let f = self.value.tanh();
        self.chain(f, 1.0 - f * f)
    }
    fn pow(self, exponent: Self) -> Self {
        let power = (exponent * self.ln()).exp();
        Self::new(self.value.powf(exponent.value), power.rate)
    }
    fn abs(self) -> Self {
        if self.value < 0.0 { -self } else { self }
    }
    fn sign(self) -> Self {
        Self::from_f64(Real::sign(self.value))
    }
    fn min(self, other: Self) -> Self {
        if self.value < other.value { self } else { other }
    }
    fn max(self, other: Self) -> Self {
        if self.value > other.value { self } else { other }
    }
    fn greater(self, other: Self) -> Self {
        Self::from_f64(f64::from(u8::from(self.value > other.value)))
    }
}
