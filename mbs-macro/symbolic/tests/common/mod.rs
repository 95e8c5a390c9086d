//! Source expressions as plain trees, evaluated without the engine: with
//! second-order jets whose every component knows a bound of its rounding error.
#![allow(dead_code, unused_imports, clippy::unwrap_used, reason = "each test uses its part of this")]

mod jet;
mod number;
mod trees;

use mbs_symbolic::{Arena, Expr, Function, Number};

pub use self::jet::Jet;
pub use self::number::Num;
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
