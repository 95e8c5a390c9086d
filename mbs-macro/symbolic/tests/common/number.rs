//! Numbers that know their rounding error.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// A number with a bound of its rounding error in units of ε (running error
/// analysis, Higham, Accuracy and Stability, §3.3).
#[derive(Clone, Copy, Debug)]
pub struct Num {
    pub value: f64,
    pub error: f64,
}

impl Num {
    pub fn exact(value: f64) -> Self {
        Self { value, error: 0.0 }
    }

    pub fn leaf(value: f64) -> Self {
        Self { value, error: value.abs() }
    }

    /// f(x), good to 2 ulp, with the error of x carried along |f′|.
    pub fn function(self, value: f64, slope: f64) -> Self {
        Self { value, error: slope.abs() * self.error + 2.0 * value.abs() }
    }

    /// How far another arrangement of the same formula may be from this one.
    /// Both have errors of this size; canonical forms reorder and collect,
    /// which changes the bound by a factor that 64 covers.
    pub fn tolerance(&self) -> f64 {
        64.0 * f64::EPSILON * (self.error + self.value.abs())
    }

    pub fn agrees_with(&self, other: f64) -> bool {
        (self.value - other).abs() <= self.tolerance()
    }
}

impl Add for Num {
    type Output = Self;
    fn add(self, y: Self) -> Self {
        let value = self.value + y.value;
        Self { value, error: self.error + y.error + value.abs() }
    }
}

impl Neg for Num {
    type Output = Self;
    fn neg(self) -> Self {
        Self { value: -self.value, ..self }
    }
}

impl Sub for Num {
    type Output = Self;
    fn sub(self, y: Self) -> Self {
        self + -y
    }
}

impl Mul for Num {
    type Output = Self;
    fn mul(self, y: Self) -> Self {
        let value = self.value * y.value;
        let error = self.value.abs() * y.error + y.value.abs() * self.error + value.abs();
        Self { value, error }
    }
}

impl Div for Num {
    type Output = Self;
    fn div(self, y: Self) -> Self {
        let r = 1.0 / y.value;
        self.mul(y.function(r, r * r))
    }
}
