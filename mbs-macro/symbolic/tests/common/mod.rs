//! Source expressions as plain trees, evaluated without the engine: with
//! second-order jets whose every component knows a bound of its rounding error.
#![allow(dead_code, clippy::unwrap_used, reason = "each test uses its part of this")]

use std::ops::{Add, Div, Mul, Neg, Sub};

use mbs_symbolic::{Arena, Expr, Function, Number};
use proptest::prelude::*;

/// An expression as it was written.
#[derive(Clone, Debug)]
pub enum Tree {
    Number(i64, i64),
    Variable(usize),
    Add(Box<Tree>, Box<Tree>),
    Sub(Box<Tree>, Box<Tree>),
    Mul(Box<Tree>, Box<Tree>),
    Div(Box<Tree>, Box<Tree>),
    Neg(Box<Tree>),
    Power(Box<Tree>, i32),
    Call(Function, Box<Tree>),
    Call2(Function, Box<Tree>, Box<Tree>),
}

impl Tree {
    /// The expression in an arena; `None` for a division by the constant 0.
    pub fn build(&self, arena: &mut Arena, variables: &[Expr]) -> Option<Expr> {
        Some(match self {
            Self::Number(n, d) => arena.number(Number::ratio(*n, *d)),
            Self::Variable(at) => variables[*at],
            Self::Add(a, b) => {
                let (a, b) = (a.build(arena, variables)?, b.build(arena, variables)?);
                arena.add(a, b)
            }
            Self::Sub(a, b) => {
                let (a, b) = (a.build(arena, variables)?, b.build(arena, variables)?);
                arena.sub(a, b)
            }
            Self::Mul(a, b) => {
                let (a, b) = (a.build(arena, variables)?, b.build(arena, variables)?);
                arena.mul(a, b)
            }
            Self::Div(a, b) => {
                let (a, b) = (a.build(arena, variables)?, b.build(arena, variables)?);
                arena.div(a, b)?
            }
            Self::Neg(a) => {
                let a = a.build(arena, variables)?;
                arena.neg(a)
            }
            Self::Power(a, e) => {
                let a = a.build(arena, variables)?;
                arena.powi(a, *e)
            }
            Self::Call(function, a) => {
                let a = a.build(arena, variables)?;
                arena.call(*function, a)
            }
            Self::Call2(Function::Pow, a, b) => {
                let (a, b) = (a.build(arena, variables)?, b.build(arena, variables)?);
                arena.pow(a, b)
            }
            Self::Call2(function, a, b) => {
                let (a, b) = (a.build(arena, variables)?, b.build(arena, variables)?);
                arena.call2(*function, a, b)
            }
        })
    }

    /// Value and derivatives; `None` outside the smooth domain, or so near its
    /// edge that rounding decides.
    pub fn jet(&self, variables: &[Jet]) -> Option<Jet> {
        let jet = match self {
            Self::Number(n, d) => Jet::constant(*n as f64 / *d as f64),
            Self::Variable(at) => variables[*at],
            Self::Add(a, b) => a.jet(variables)? + b.jet(variables)?,
            Self::Sub(a, b) => a.jet(variables)? - b.jet(variables)?,
            Self::Mul(a, b) => a.jet(variables)? * b.jet(variables)?,
            Self::Div(a, b) => a.jet(variables)? * b.jet(variables)?.power(-1)?,
            Self::Neg(a) => -a.jet(variables)?,
            Self::Power(a, e) => a.jet(variables)?.power(*e)?,
            Self::Call(function, a) => a.jet(variables)?.call(*function)?,
            Self::Call2(function, a, b) => a.jet(variables)?.call2(*function, b.jet(variables)?)?,
        };
        let is_sane = |x: Num| x.value.abs() < 1e6 && x.tolerance() < 1e-3 * (1.0 + x.value.abs());
        (is_sane(jet.value) && is_sane(jet.first) && is_sane(jet.second)).then_some(jet)
    }
}

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

    fn leaf(value: f64) -> Self {
        Self { value, error: value.abs() }
    }

    /// f(x), good to 2 ulp, with the error of x carried along |f′|.
    fn function(self, value: f64, slope: f64) -> Self {
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

    fn power(self, exponent: i32) -> Option<Self> {
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

    fn call(self, function: Function) -> Option<Self> {
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

    fn call2(self, function: Function, y: Self) -> Option<Self> {
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

/// How many variables trees have.
pub const VARIABLES: usize = 4;

const UNARY: [Function; 12] = [
    Function::Sin,
    Function::Cos,
    Function::Tan,
    Function::Asin,
    Function::Acos,
    Function::Atan,
    Function::Sqrt,
    Function::Exp,
    Function::Ln,
    Function::Tanh,
    Function::Abs,
    Function::Sign,
];

const BINARY: [Function; 5] =
    [Function::Atan2, Function::Min, Function::Max, Function::Pow, Function::Greater];

fn boxed(tree: Tree) -> Box<Tree> {
    Box::new(tree)
}

/// f(x) with x brought into the domain of f.
fn guarded(function: Function, x: Tree) -> Tree {
    let half = boxed(Tree::Number(1, 2));
    let argument = match function {
        Function::Sqrt | Function::Ln => Tree::Add(boxed(Tree::Power(boxed(x), 2)), half),
        Function::Tan | Function::Asin | Function::Acos | Function::Exp => {
            Tree::Mul(half, boxed(Tree::Call(Function::Sin, boxed(x))))
        }
        _ => x,
    };
    Tree::Call(function, boxed(argument))
}

/// Random trees of all operators; repeated leaves are likely, so that rules
/// for like terms, equal factors and squares of sines find work.
pub fn trees() -> impl Strategy<Value = Tree> {
    let leaf = prop_oneof![
        (-4_i64..5, 1_i64..4).prop_map(|(n, d)| Tree::Number(n, d)),
        (0..VARIABLES).prop_map(Tree::Variable),
        (0..VARIABLES).prop_map(Tree::Variable),
    ];
    leaf.prop_recursive(6, 40, 2, |inner| {
        let pair = || (inner.clone(), inner.clone());
        prop_oneof![
            3 => pair().prop_map(|(a, b)| Tree::Add(boxed(a), boxed(b))),
            2 => pair().prop_map(|(a, b)| Tree::Sub(boxed(a), boxed(b))),
            4 => pair().prop_map(|(a, b)| Tree::Mul(boxed(a), boxed(b))),
            1 => pair().prop_map(|(a, b)| Tree::Div(boxed(a), boxed(b))),
            1 => inner.clone().prop_map(|a| Tree::Neg(boxed(a))),
            2 => (inner.clone(), -3..4).prop_map(|(a, e)| Tree::Power(boxed(a), e)),
            2 => (prop::sample::select(&UNARY[..]), inner.clone()).prop_map(|(f, a)| Tree::Call(f, boxed(a))),
            3 => (prop::sample::select(&UNARY[..]), inner.clone()).prop_map(|(f, a)| guarded(f, a)),
            1 => (prop::sample::select(&BINARY[..]), pair()).prop_map(|(f, (a, b))| Tree::Call2(f, boxed(a), boxed(b))),
            1 => (inner.clone(), pair()).prop_map(|(a, (b, c))| {
                // r cos²a + s sin²a
                let square = |f| boxed(Tree::Power(boxed(Tree::Call(f, boxed(a.clone()))), 2));
                let (b, c) = (Tree::Mul(boxed(b), square(Function::Cos)), Tree::Mul(boxed(c), square(Function::Sin)));
                Tree::Add(boxed(b), boxed(c))
            }),
        ]
    })
}

/// One expression with every row of the operator table in it, and every other
/// constructor.
pub fn every_operator() -> Tree {
    let x = || boxed(Tree::Variable(0));
    let y = || boxed(Tree::Variable(1));
    let plus = |a: Tree, b: Tree| Tree::Add(boxed(a), boxed(b));
    let mut sum = Tree::Number(-7, 3);
    for (at, function) in UNARY.into_iter().enumerate() {
        let scaled = Tree::Mul(boxed(Tree::Number(at as i64 + 1, 9)), y());
        let term = Tree::Mul(boxed(guarded(function, plus(Tree::Variable(0), scaled))), y());
        sum = plus(sum, term);
    }
    let positive = || boxed(Tree::Add(boxed(Tree::Power(x(), 2)), boxed(Tree::Number(1, 2))));
    for function in BINARY {
        let term = Tree::Call2(function, positive(), boxed(Tree::Variable(2)));
        sum = plus(sum, Tree::Div(boxed(Tree::Neg(boxed(term))), positive()));
    }
    Tree::Sub(boxed(sum), boxed(Tree::Power(positive(), -3)))
}

/// Values or directions of all variables.
pub fn points() -> impl Strategy<Value = [f64; VARIABLES]> {
    prop::array::uniform4(-3.0..3.0)
}
