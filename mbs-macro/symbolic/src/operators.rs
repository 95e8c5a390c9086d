//! The elementary functions, one row of a table each.

use crate::arena::{Arena, Expr};
use crate::number::Number;

/// An elementary function of one or two arguments.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Function {
    /// sin x
    Sin,
    /// cos x
    Cos,
    /// tan x
    Tan,
    /// arcsin x
    Asin,
    /// arccos x
    Acos,
    /// arctan x
    Atan,
    /// √x
    Sqrt,
    /// eˣ
    Exp,
    /// ln x
    Ln,
    /// tanh x
    Tanh,
    /// |x|
    Abs,
    /// −1, 0, 1
    Sign,
    /// angle of the vector (second argument, first argument)
    Atan2,
    /// smaller of two
    Min,
    /// larger of two
    Max,
    /// xʸ
    Pow,
    /// 1 if the first argument is larger, else 0
    Greater,
}

/// What the engine knows of a function.
pub struct Row {
    /// The function itself.
    pub function: Function,
    /// How it is written in the language; empty if it cannot be written there.
    pub name: &'static str,
    /// One or two.
    pub arity: usize,
    /// Its value; the second argument is ignored where `arity` is 1.
    pub value: fn(f64, f64) -> f64,
    /// Partial derivatives with respect to both arguments (the second 0 where
    /// `arity` is 1), given the arguments and the value.
    pub partials: fn(&mut Arena, Expr, Expr, Expr) -> [Expr; 2],
    /// Behaviour under x → −x.
    pub parity: Parity,
    /// Its name in C's `math.h`, for `double`, if it stands there.
    pub c: Option<&'static str>,
}

/// f(−x) = −f(x), f(x), or neither.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Parity {
    /// f(−x) = −f(x)
    Odd,
    /// f(−x) = f(x)
    Even,
    /// no rule
    Neither,
}

use Function as F;
use Parity::{Even, Neither, Odd};

/// Derivatives are those of the smooth pieces: |x|′ = sign x with 0 at 0,
/// sign′ = 0, and `min`, `max` take the slope of their second argument where
/// both are equal.
#[rustfmt::skip]
pub const TABLE: &[Row] = &[
    Row { function: F::Sin,  name: "sin",  arity: 1, parity: Odd,     c: Some("sin"),   value: |x, _| x.sin(),  partials: |a, x, _, _| { let d = a.call(F::Cos, x); one(a, d) } },
    Row { function: F::Cos,  name: "cos",  arity: 1, parity: Even,    c: Some("cos"),   value: |x, _| x.cos(),  partials: |a, x, _, _| { let s = a.call(F::Sin, x); let d = a.neg(s); one(a, d) } },
    Row { function: F::Tan,  name: "tan",  arity: 1, parity: Odd,     c: Some("tan"),   value: |x, _| x.tan(),  partials: |a, _, _, f| { let d = polynomial(a, f, 1, 1); one(a, d) } },
    Row { function: F::Asin, name: "asin", arity: 1, parity: Odd,     c: Some("asin"),  value: |x, _| x.asin(), partials: |a, x, _, _| { let d = inverse_root(a, x); one(a, d) } },
    Row { function: F::Acos, name: "acos", arity: 1, parity: Neither, c: Some("acos"),  value: |x, _| x.acos(), partials: |a, x, _, _| { let r = inverse_root(a, x); let d = a.neg(r); one(a, d) } },
    Row { function: F::Atan, name: "atan", arity: 1, parity: Odd,     c: Some("atan"),  value: |x, _| x.atan(), partials: |a, x, _, _| { let p = polynomial(a, x, 1, 1); let d = a.powi(p, -1); one(a, d) } },
    Row { function: F::Sqrt, name: "sqrt", arity: 1, parity: Neither, c: Some("sqrt"),  value: |x, _| x.sqrt(), partials: |a, _, _, f| { let r = a.powi(f, -1); let d = a.scale(r, Number::ratio(1, 2)); one(a, d) } },
    Row { function: F::Exp,  name: "exp",  arity: 1, parity: Neither, c: Some("exp"),   value: |x, _| x.exp(),  partials: |a, _, _, f| one(a, f) },
    Row { function: F::Ln,   name: "ln",   arity: 1, parity: Neither, c: Some("log"),   value: |x, _| x.ln(),   partials: |a, x, _, _| { let d = a.powi(x, -1); one(a, d) } },
    Row { function: F::Tanh, name: "tanh", arity: 1, parity: Odd,     c: Some("tanh"),  value: |x, _| x.tanh(), partials: |a, _, _, f| { let d = polynomial(a, f, 1, -1); one(a, d) } },
    Row { function: F::Abs,  name: "abs",  arity: 1, parity: Even,    c: Some("fabs"),  value: |x, _| x.abs(),  partials: |a, x, _, _| { let d = a.call(F::Sign, x); one(a, d) } },
    Row { function: F::Sign, name: "sign", arity: 1, parity: Odd,     c: None,          value: |x, _| sign(x),  partials: |a, _, _, _| [a.zero(), a.zero()] },
    Row { function: F::Atan2, name: "atan2", arity: 2, parity: Neither, c: Some("atan2"), value: f64::atan2, partials: atan2_partials },
    Row { function: F::Min,   name: "min",   arity: 2, parity: Neither, c: None,          value: |x, y| if x < y || x.is_nan() { x } else { y }, partials: |a, x, y, _| select(a, y, x) },
    Row { function: F::Max,   name: "max",   arity: 2, parity: Neither, c: None,          value: |x, y| if x > y || x.is_nan() { x } else { y }, partials: |a, x, y, _| select(a, x, y) },
    Row { function: F::Pow,   name: "pow",   arity: 2, parity: Neither, c: Some("pow"),   value: f64::powf, partials: pow_partials },
    Row { function: F::Greater, name: "",    arity: 2, parity: Neither, c: None,          value: |x, y| f64::from(u8::from(x > y)), partials: |a, _, _, _| [a.zero(), a.zero()] },
];

impl Function {
    /// The table row of this function.
    pub fn row(self) -> &'static Row {
        // The table is in the order of the enum; a test holds it to that.
        &TABLE[self as usize]
    }

    /// The function written `name` in the language.
    pub fn named(name: &str) -> Option<Self> {
        TABLE.iter().find(|row| !row.name.is_empty() && row.name == name).map(|row| row.function)
    }
}

fn sign(x: f64) -> f64 {
    if x == 0.0 || x.is_nan() { x } else { x.signum() }
}

/// The partials of a function of one argument.
fn one(arena: &Arena, derivative: Expr) -> [Expr; 2] {
    [derivative, arena.zero()]
}

/// constant + coefficient·x²
fn polynomial(arena: &mut Arena, x: Expr, constant: i64, coefficient: i64) -> Expr {
    let square = arena.powi(x, 2);
    let scaled = arena.scale(square, Number::integer(coefficient));
    let constant = arena.number(Number::integer(constant));
    arena.add(constant, scaled)
}

/// 1/√(1 − x²)
fn inverse_root(arena: &mut Arena, x: Expr) -> Expr {
    let inner = polynomial(arena, x, 1, -1);
    let root = arena.call(F::Sqrt, inner);
    arena.powi(root, -1)
}

/// Slopes of `max`-like functions: [larger > smaller, its complement], in the
/// order of the function's own arguments.
fn select(arena: &mut Arena, larger: Expr, smaller: Expr) -> [Expr; 2] {
    let first = arena.call2(F::Greater, larger, smaller);
    let one = arena.one();
    [first, arena.sub(one, first)]
}

fn atan2_partials(arena: &mut Arena, y: Expr, x: Expr, _: Expr) -> [Expr; 2] {
    let (yy, xx) = (arena.powi(y, 2), arena.powi(x, 2));
    let squares = arena.add(yy, xx);
    let inverse = arena.powi(squares, -1);
    let dy = arena.mul(x, inverse);
    let dx = arena.mul(y, inverse);
    [dy, arena.neg(dx)]
}

/// ∂xʸ = y xʸ⁻¹, xʸ ln x; the second only where y is not constant.
fn pow_partials(arena: &mut Arena, x: Expr, y: Expr, value: Expr) -> [Expr; 2] {
    let minus_one = arena.number(Number::MINUS_ONE);
    let lower = arena.add(y, minus_one);
    let power = arena.pow(x, lower);
    let dx = arena.mul(y, power);
    if arena.as_number(y).is_some() {
        return [dx, arena.zero()];
    }
    let ln = arena.call(F::Ln, x);
    [dx, arena.mul(value, ln)]
}

#[cfg(test)]
mod tests {
    use super::TABLE;

    #[test]
    fn table_is_in_the_order_of_the_enum() {
        for (at, row) in TABLE.iter().enumerate() {
            assert_eq!(row.function as usize, at, "{}", row.name);
        }
    }
}
