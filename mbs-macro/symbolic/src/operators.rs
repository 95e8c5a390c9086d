//! The elementary functions, one row of a table each.
//!
//! A row says all that the symbolic engine knows of a function: value, slopes, parity, range, whether it has
//! pieces, and how it is spelled.

use crate::algebra::Scalar;

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

/// The properties of a function that the engine knows.
pub struct Row {
    /// The function itself.
    pub function: Function,
    /// Its name.
    pub name: &'static str,
    /// Whether the language has it, by that name.
    pub is_word: bool,
    /// One or two.
    pub arity: usize,
    /// Behaviour under x → −x.
    pub parity: Parity,
    /// Where its values are.
    pub range: Range,
    /// Whether it is made of pieces: its slope, or itself, jumps.
    pub is_piecewise: bool,
    /// Its name in C's `math.h`, for `double`, if it stands there.
    pub c: Option<&'static str>,
    /// How it is typeset.
    pub latex: Latex,
    /// Its value; the second argument is ignored where `arity` is 1.
    pub value: fn(f64, f64) -> f64,
    /// Partial derivatives with respect to both arguments (the second 0 where
    /// `arity` is 1), given the arguments and the value.
    pub partials: Partials,
}

/// From x, y and f(x, y): ∂f/∂x and ∂f/∂y.
pub type Partials = for<'a> fn(Scalar<'a>, Scalar<'a>, Scalar<'a>) -> [Scalar<'a>; 2];

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

/// Where the values of a function are, whatever its arguments.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Range {
    /// anywhere
    All,
    /// 0 ≤ f(x)
    NotNegative,
    /// −1 ≤ f(x) ≤ 1
    Unit,
}

/// How a function is typeset.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Latex {
    /// By this operator before its argument.
    Operator(&'static str),
    /// By what stands before and behind its argument.
    Around(&'static str, &'static str),
    /// By its name and arguments in parentheses.
    Name,
}

use Function as F;
use Latex::{Around, Name, Operator};
use Parity::{Even, Neither, Odd};
use Range::{All, NotNegative, Unit};

/// Derivatives are those of the smooth pieces: |x|′ = sign x with 0 at 0,
/// sign′ = 0, and `min`, `max` take the slope of their second argument where
/// both are equal.
#[rustfmt::skip]
pub const TABLE: &[Row] = &[
    Row {
        function: F::Sin, name: "sin", is_word: true, arity: 1, parity: Odd, range: Unit, is_piecewise: false,
        c: Some("sin"), latex: Operator(r"\sin"), value: |x, _| x.sin(), partials: |x, _, _| one(x.cos()),
    },
    Row {
        function: F::Cos, name: "cos", is_word: true, arity: 1, parity: Even, range: Unit, is_piecewise: false,
        c: Some("cos"), latex: Operator(r"\cos"), value: |x, _| x.cos(), partials: |x, _, _| one(-x.sin()),
    },
    Row {
        function: F::Tan, name: "tan", is_word: true, arity: 1, parity: Odd, range: All, is_piecewise: false,
        c: Some("tan"), latex: Operator(r"\tan"), value: |x, _| x.tan(), partials: |_, _, f| one(1 + f.squared()),
    },
    Row {
        function: F::Asin, name: "asin", is_word: true, arity: 1, parity: Odd, range: All, is_piecewise: false,
        c: Some("asin"), latex: Operator(r"\arcsin"), value: |x, _| x.asin(), partials: |x, _, _| one((1 - x.squared()).sqrt().powi(-1)),
    },
    Row {
        function: F::Acos, name: "acos", is_word: true, arity: 1, parity: Neither, range: All, is_piecewise: false,
        c: Some("acos"), latex: Operator(r"\arccos"), value: |x, _| x.acos(), partials: |x, _, _| one(-(1 - x.squared()).sqrt().powi(-1)),
    },
    Row {
        function: F::Atan, name: "atan", is_word: true, arity: 1, parity: Odd, range: All, is_piecewise: false,
        c: Some("atan"), latex: Operator(r"\arctan"), value: |x, _| x.atan(), partials: |x, _, _| one((1 + x.squared()).powi(-1)),
    },
    Row {
        function: F::Sqrt, name: "sqrt", is_word: true, arity: 1, parity: Neither, range: NotNegative, is_piecewise: false,
        c: Some("sqrt"), latex: Around(r"\sqrt{", "}"), value: |x, _| x.sqrt(), partials: |_, _, f| one(f.powi(-1) / 2),
    },
    Row {
        function: F::Exp, name: "exp", is_word: true, arity: 1, parity: Neither, range: NotNegative, is_piecewise: false,
        c: Some("exp"), latex: Operator(r"\exp"), value: |x, _| x.exp(), partials: |_, _, f| one(f),
    },
    Row {
        function: F::Ln, name: "ln", is_word: true, arity: 1, parity: Neither, range: All, is_piecewise: false,
        c: Some("log"), latex: Operator(r"\ln"), value: |x, _| x.ln(), partials: |x, _, _| one(x.powi(-1)),
    },
    Row {
        function: F::Tanh, name: "tanh", is_word: true, arity: 1, parity: Odd, range: Unit, is_piecewise: false,
        c: Some("tanh"), latex: Operator(r"\tanh"), value: |x, _| x.tanh(), partials: |_, _, f| one(1 - f.squared()),
    },
    Row {
        function: F::Abs, name: "abs", is_word: true, arity: 1, parity: Even, range: NotNegative, is_piecewise: true,
        c: Some("fabs"), latex: Around(r"\left|", r"\right|"), value: |x, _| x.abs(), partials: |x, _, _| one(x.sign()),
    },
    Row {
        function: F::Sign, name: "sign", is_word: true, arity: 1, parity: Odd, range: Unit, is_piecewise: true,
        c: None, latex: Name, value: |x, _| sign(x), partials: |x, _, _| [x.algebra().number(0); 2],
    },
    Row {
        function: F::Atan2, name: "atan2", is_word: true, arity: 2, parity: Neither, range: All, is_piecewise: false,
        c: Some("atan2"), latex: Name, value: f64::atan2, partials: atan2_partials,
    },
    Row {
        function: F::Min, name: "min", is_word: true, arity: 2, parity: Neither, range: All, is_piecewise: true,
        c: None, latex: Name, value: |x, y| if x < y || x.is_nan() { x } else { y }, partials: |x, y, _| select(y, x),
    },
    Row {
        function: F::Max, name: "max", is_word: true, arity: 2, parity: Neither, range: All, is_piecewise: true,
        c: None, latex: Name, value: |x, y| if x > y || x.is_nan() { x } else { y }, partials: |x, y, _| select(x, y),
    },
    Row {
        function: F::Pow, name: "pow", is_word: true, arity: 2, parity: Neither, range: All, is_piecewise: false,
        c: Some("pow"), latex: Name, value: f64::powf, partials: pow_partials,
    },
    Row {
        function: F::Greater, name: "greater", is_word: false, arity: 2, parity: Neither, range: Unit, is_piecewise: true,
        c: None, latex: Name, value: |x, y| f64::from(u8::from(x > y)), partials: |x, _, _| [x.algebra().number(0); 2],
    },
];

impl Function {
    /// The table row of this function.
    pub fn row(self) -> &'static Row {
        // The table is in the order of the enum; a test holds it to that.
        &TABLE[self as usize]
    }

    /// The function written `name` in the language.
    pub fn named(name: &str) -> Option<Self> {
        TABLE.iter().find(|row| row.is_word && row.name == name).map(|row| row.function)
    }
}

fn sign(x: f64) -> f64 {
    if x == 0.0 || x.is_nan() { x } else { x.signum() }
}

/// The partials of a function of one argument.
fn one(slope: Scalar<'_>) -> [Scalar<'_>; 2] {
    [slope, slope.algebra().number(0)]
}

/// Slopes of `max`-like functions: [larger > smaller, its complement], in the
/// order of the function's own arguments.
fn select<'a>(larger: Scalar<'a>, smaller: Scalar<'a>) -> [Scalar<'a>; 2] {
    let first = larger.greater(smaller);
    [first, 1 - first]
}

/// x/(x² + y²) and −y/(x² + y²), of the angle of (x, y).
fn atan2_partials<'a>(y: Scalar<'a>, x: Scalar<'a>, _: Scalar<'a>) -> [Scalar<'a>; 2] {
    let inverse = (y.squared() + x.squared()).powi(-1);
    [x * inverse, -(y * inverse)]
}

/// ∂xʸ = y xʸ⁻¹, xʸ ln x; the second only where y is not constant.
fn pow_partials<'a>(x: Scalar<'a>, y: Scalar<'a>, value: Scalar<'a>) -> [Scalar<'a>; 2] {
    let along_x = y * x.pow(y - 1);
    if y.number().is_some() {
        return one(along_x);
    }
    [along_x, value * x.ln()]
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
