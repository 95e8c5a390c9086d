//! Source expressions as plain trees, evaluated without the algebra of expressions: with second-order jets whose
//! every component knows a bound of its rounding error.
#![allow(clippy::unwrap_used, reason = "helpers of tests")]

mod trees;

use mbs_symbolic::{Arena, Arithmetic, Expr, Function, Moving, Number, Numeric, Rounded};

pub use self::trees::{VARIABLES, config, every_operator, points, trees};

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
            Self::Call2(function, a, b) => {
                let (a, b) = (a.build(arena, variables)?, b.build(arena, variables)?);
                arena.call2(*function, a, b)
            }
        })
    }

    /// Value and derivatives; `None` outside the smooth domain, or so near its
    /// edge that rounding decides.
    pub fn jet(&self, variables: &[Jet]) -> Option<Jet> {
        let variables: Vec<_> = variables.iter().map(|&jet| jet.into()).collect();
        self.moving(&variables).map(Jet::from)
    }

    fn moving(&self, variables: &[Moving<Moving<Rounded>>]) -> Option<Moving<Moving<Rounded>>> {
        let of = |tree: &Self| tree.moving(variables);
        let moving = match self {
            Self::Number(n, d) => Jet::line(*n as f64 / *d as f64, 0.0).into(),
            Self::Variable(at) => variables[*at],
            Self::Add(a, b) => of(a)? + of(b)?,
            Self::Sub(a, b) => of(a)? - of(b)?,
            Self::Mul(a, b) => of(a)? * of(b)?,
            Self::Div(a, b) => of(a)? / of(b)?,
            Self::Neg(a) => -of(a)?,
            Self::Power(a, 0) => of(a)?.constant(1),
            Self::Power(a, e) => of(a)?.powi(*e),
            Self::Call(function, a) => of(a)?.of(*function),
            Self::Call2(function, a, b) => {
                let (a, b) = (of(a)?, of(b)?);
                let [y, x] = [a, b].map(|x| Jet::from(x).value.value);
                // where the angle of a vector jumps, −0 is not 0
                if *function == Function::Atan2 && x <= 0.0 && y.abs() < 1e-2 {
                    return None;
                }
                a.call(*function, b)
            }
        };
        let Jet { value, first, second } = moving.into();
        let is_sane = |x: Rounded| x.value.abs() < 1e6 && x.tolerance() < 1e-3 * (1.0 + x.value.abs());
        [value, first, second].into_iter().all(is_sane).then_some(moving)
    }
}

/// x, ẋ and ẍ with bounds of their errors.
pub type Jet = mbs_symbolic::Jet<Rounded>;

/// Jets along straight lines.
pub trait Line {
    /// x + s·slope of numbers that were rounded.
    fn line(x: f64, slope: f64) -> Self;
}

impl Line for Jet {
    fn line(x: f64, slope: f64) -> Self {
        let [value, first] = [x, slope].map(|x| Rounded { value: x, error: f64::EPSILON * x.abs() });
        Self { value, first, second: Rounded::default() }
    }
}

/// Comparisons of numbers that know their rounding error.
pub trait Tolerance {
    /// How far another arrangement of the same formula may be from this one.
    /// Both have errors of this size; canonical forms reorder and collect,
    /// which changes the bound by a factor that 64 covers.
    fn tolerance(&self) -> f64;
    /// True if another arrangement of the same formula may give this number.
    fn agrees_with(&self, other: f64) -> bool;
}

impl Tolerance for Rounded {
    fn tolerance(&self) -> f64 {
        64.0 * (self.error + f64::EPSILON * self.value.abs())
    }

    fn agrees_with(&self, other: f64) -> bool {
        (self.value - other).abs() <= self.tolerance()
    }
}
