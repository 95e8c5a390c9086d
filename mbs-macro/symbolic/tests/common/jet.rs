//! Derivatives by the chain rule, on numbers.

use std::ops::{Add, Mul, Neg, Sub};

use mbs_symbolic::Function;

use super::Num;

/// x, x′, x″ along one direction.
#[derive(Clone, Copy, Debug)]
pub struct Jet {
    pub value: Num,
    pub first: Num,
    pub second: Num,
}

impl Jet {
    pub fn constant(x: f64) -> Self {
        Self { value: Num::leaf(x), first: Num::exact(0.0), second: Num::exact(0.0) }
    }

    pub fn line(x: f64, slope: f64) -> Self {
        Self { value: Num::leaf(x), first: Num::leaf(slope), second: Num::exact(0.0) }
    }

    fn chain(self, f: Num, df: Num, ddf: Num) -> Self {
        Self { value: f, first: df * self.first, second: ddf * self.first * self.first + df * self.second }
    }

    pub fn power(self, exponent: i32) -> Option<Self> {
        let one = Self::constant(1.0);
        if exponent < 0 {
            let x = self.value;
            if x.value.abs() < 1e-2 {
                return None;
            }
            let r = Num::exact(1.0) / x;
            let inverse = self.chain(r, -(r * r), Num::exact(2.0) * r * r * r);
            return inverse.power(-exponent);
        }
        Some((0..exponent).fold(one, |product, _| product * self))
    }

    pub fn call(self, function: Function) -> Option<Self> {
        let x = self.value;
        let v = x.value;
        let one = Num::exact(1.0);
        let two = Num::exact(2.0);
        let is_near = |edge: f64| (v - edge).abs() < 1e-2;
        let inside = 1.0 - v * v > 1e-2;
        Some(match function {
            Function::Sin | Function::Cos => {
                let s = x.function(v.sin(), v.cos());
                let c = x.function(v.cos(), v.sin());
                if function == Function::Sin { self.chain(s, c, -s) } else { self.chain(c, -s, -c) }
            }
            Function::Tan if v.cos().abs() > 0.05 => {
                let t = x.function(v.tan(), 1.0 / (v.cos() * v.cos()));
                let dt = one + t * t;
                self.chain(t, dt, two * t * dt)
            }
            Function::Asin | Function::Acos if inside => {
                let root = one - x * x;
                let root = root.function(root.value.sqrt(), 0.5 / root.value.sqrt());
                let r = one / root;
                let rrr = x * r * r * r;
                if function == Function::Asin {
                    self.chain(x.function(v.asin(), r.value), r, rrr)
                } else {
                    self.chain(x.function(v.acos(), r.value), -r, -rrr)
                }
            }
            Function::Atan => {
                let r = one / (one + x * x);
                self.chain(x.function(v.atan(), r.value), r, -(two * x * r * r))
            }
            Function::Sqrt if v > 1e-2 => {
                let f = x.function(v.sqrt(), 0.5 / v.sqrt());
                let df = Num::exact(0.5) / f;
                self.chain(f, df, -(Num::exact(0.5) * df / x))
            }
            Function::Exp if v < 10.0 => {
                let f = x.function(v.exp(), v.exp());
                self.chain(f, f, f)
            }
            Function::Ln if v > 1e-2 => {
                let r = one / x;
                self.chain(x.function(v.ln(), r.value), r, -(r * r))
            }
            Function::Tanh => {
                let f = x.function(v.tanh(), 1.0);
                let df = one - f * f;
                self.chain(f, df, -(two * f * df))
            }
            Function::Abs if !is_near(0.0) => {
                if v < 0.0 {
                    -self
                } else {
                    self
                }
            }
            Function::Sign if !is_near(0.0) => Self::constant(v.signum()),
            _ => return None,
        })
    }

    pub fn call2(self, function: Function, y: Self) -> Option<Self> {
        let difference = self.value.value - y.value.value;
        let is_decided = difference.abs() > 1e-2;
        Some(match function {
            Function::Min if is_decided => {
                if difference < 0.0 {
                    self
                } else {
                    y
                }
            }
            Function::Max if is_decided => {
                if difference > 0.0 {
                    self
                } else {
                    y
                }
            }
            Function::Greater if is_decided => Self::constant(f64::from(u8::from(difference > 0.0))),
            Function::Pow if self.value.value > 1e-2 => (y * self.call(Function::Ln)?).call(Function::Exp)?,
            Function::Atan2 => {
                // the angle seen from the vector itself, where atan is smooth
                let (dy, dx) = (self.value.value, y.value.value);
                if dy.hypot(dx) < 1e-1 || (dx < 0.0 && dy.abs() < 1e-2) {
                    return None;
                }
                let (cy, cx) = (Self::exact(dy), Self::exact(dx));
                let along = self * cy + y * cx;
                let turned = ((self * cx - y * cy) * along.power(-1)?).call(Function::Atan)?;
                let angle = dy.atan2(dx);
                let value = Num { value: angle, error: turned.value.error + 2.0 * angle.abs() };
                Self { value, ..turned }
            }
            _ => return None,
        })
    }

    fn exact(x: f64) -> Self {
        Self { value: Num::exact(x), first: Num::exact(0.0), second: Num::exact(0.0) }
    }
}

impl Add for Jet {
    type Output = Self;
    fn add(self, y: Self) -> Self {
        Self { value: self.value + y.value, first: self.first + y.first, second: self.second + y.second }
    }
}

impl Neg for Jet {
    type Output = Self;
    fn neg(self) -> Self {
        Self { value: -self.value, first: -self.first, second: -self.second }
    }
}

impl Sub for Jet {
    type Output = Self;
    fn sub(self, y: Self) -> Self {
        self + -y
    }
}

impl Mul for Jet {
    type Output = Self;
    fn mul(self, y: Self) -> Self {
        let cross = self.first * y.first;
        Self {
            value: self.value * y.value,
            first: self.first * y.value + self.value * y.first,
            second: self.second * y.value + (cross + cross) + self.value * y.second,
        }
    }
}
