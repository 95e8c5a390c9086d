//! The elementary functions, one row of a table each.
//!
//! A row says all that is known of a function: value, slopes, parity, range, pieces, exact values, how long it
//! takes, and how it is spelled. Whatever computes with functions (floats, rounding errors, derivatives,
//! programs, printers) reads it here.

use crate::arithmetic::Arithmetic;
use crate::exact::Residue;
use crate::number::Number;

/// The properties of a function.
pub struct Row {
    /// The function itself.
    pub function: Function,
    /// Its name, in Rust too.
    pub name: &'static str,
    /// True if the language has it, by that name.
    pub is_word: bool,
    /// One or two.
    pub arity: usize,
    /// Behaviour under x → −x.
    pub parity: Parity,
    /// Where its values are.
    pub range: Range,
    /// Its pieces.
    pub pieces: Pieces,
    /// The dimensions that its arguments and its value have.
    pub dimensions: Dimensions,
    /// Its value of a constant, where it is as exact as the constant; of some none.
    pub of_number: Option<fn(Number) -> Option<Number>>,
    /// Its exact value at an angle, from the turn by that angle, where there is such a rule.
    pub of_turn: Option<fn(Residue) -> Option<Residue>>,
    /// Roughly how many cycles today's processors take.
    pub latency: u32,
    /// Its name in C's `math.h`, for `double`; without one it is a function of the generated code.
    pub c: Option<&'static str>,
    /// How WebAssembly has it.
    pub wasm: Wasm,
    /// The way in which it is typeset.
    pub latex: Latex,
    /// Its value; the second argument is ignored where `arity` is 1.
    pub value: fn(f64, f64) -> f64,
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

/// The pieces that a function is made of. Where they meet, its two arguments are equal, or its only one is 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pieces {
    /// It is smooth.
    One,
    /// Its slope jumps. It is an argument or its negative.
    Kinked,
    /// It jumps, and is constant elsewhere.
    Steps,
    /// It jumps, and what it chooses between is equal there.
    Seamless,
    /// It is its second argument where the first one is not 0, and 0 elsewhere, whatever the second one is.
    Gate,
}

/// The dimensions of the arguments and the value of a function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dimensions {
    /// All are numbers or angles.
    None,
    /// All have the same.
    Same,
    /// The arguments have the same, the value none.
    Lost,
    /// The value has the root of that of the argument.
    Root,
}

/// How a function is called in WebAssembly.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wasm {
    /// By instructions, in bytes, on arguments that are on the stack.
    Code(&'static [u8]),
    /// As a function of the host, whose name is that of C.
    Host,
    /// As a function of the module.
    Module,
}

/// How a function is typeset.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Latex {
    /// By this operator before its argument.
    Operator(&'static str),
    /// By what stands before and behind its argument.
    Around(&'static str, &'static str),
    /// By Iverson's bracket, which is 1 where its comparison holds and 0 elsewhere.
    Bracket(&'static str),
    /// As the product of its arguments.
    Product,
    /// By its name and arguments in parentheses.
    Name,
}

use Dimensions::{Lost, Root, Same};
use Function as F;
use Latex::{Around, Bracket, Name, Operator};
use Parity::{Even, Neither, Odd};
use Pieces::{Gate, Kinked, One, Seamless, Steps};
use Range::{All, NotNegative, Unit};
use Wasm::{Code, Host, Module};

/// A smooth function of one argument without further properties, from which rows differ.
const UNARY: Row = Row {
    function: F::Sin,
    name: "",
    is_word: true,
    arity: 1,
    parity: Neither,
    range: All,
    pieces: One,
    dimensions: Dimensions::None,
    of_number: None,
    of_turn: None,
    latency: 50,
    c: None,
    wasm: Host,
    latex: Name,
    value: |x, _| x,
};

/// The same of two arguments.
const BINARY: Row = Row { arity: 2, ..UNARY };

/// Makes the functions from their rows: name, value of (x, y), slopes of (x, y, f(x, y)), and properties.
macro_rules! functions {
    ($($(#[$doc:meta])* $function:ident: $name:literal, $value:expr,
        |$x:pat_param, $y:pat_param, $f:pat_param| $slopes:expr, { $($property:tt)* };)*) => {
        /// An elementary function of one or two arguments.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum Function {
            $($(#[$doc])* $function,)*
        }

        /// The rows of all functions, in their order.
        pub const TABLE: &[Row] =
            &[$(Row { function: F::$function, name: $name, value: $value, $($property)* }),*];

        impl Function {
            /// ∂f/∂x and ∂f/∂y, the second 0 where there is one argument, from x, y and f(x, y).
            ///
            /// They are those of the smooth pieces: |x|′ = sign x with 0 at 0, sign′ = 0, and `min`, `max` take
            /// the slope of their second argument where both are equal.
            pub fn slopes<T: Arithmetic>(self, x: T, y: T, f: T) -> [T; 2] {
                match self {
                    $(F::$function => {
                        let ($x, $y, $f) = (x, y, f);
                        $slopes
                    })*
                }
            }
        }
    };
}

functions! {
    /// sin x
    Sin: "sin", |x, _| x.sin(), |x, _, _| one(x.of(F::Cos)),
        { parity: Odd, range: Unit, of_turn: Some(Residue::sine), wasm: Module, latex: Operator(r"\sin"), ..UNARY };
    /// cos x
    Cos: "cos", |x, _| x.cos(), |x, _, _| one(-x.of(F::Sin)),
        { parity: Even, range: Unit, of_turn: Some(Residue::cosine), wasm: Module, latex: Operator(r"\cos"), ..UNARY };
    /// tan x
    Tan: "tan", |x, _| x.tan(), |_, _, f| one(f.constant(1) + f * f),
        { parity: Odd, of_turn: Some(Residue::tangent), c: Some("tan"), latex: Operator(r"\tan"), ..UNARY };
    /// arcsin x
    Asin: "asin", |x, _| x.asin(), |x, _, _| one(inverse((x.constant(1) - x * x).of(F::Sqrt))),
        { parity: Odd, c: Some("asin"), latex: Operator(r"\arcsin"), ..UNARY };
    /// arccos x
    Acos: "acos", |x, _| x.acos(), |x, _, _| one(-inverse((x.constant(1) - x * x).of(F::Sqrt))),
        { c: Some("acos"), latex: Operator(r"\arccos"), ..UNARY };
    /// arctan x
    Atan: "atan", |x, _| x.atan(), |x, _, _| one(inverse(x.constant(1) + x * x)),
        { parity: Odd, c: Some("atan"), latex: Operator(r"\arctan"), ..UNARY };
    /// √x
    Sqrt: "sqrt", |x, _| x.sqrt(), |_, _, f| one(inverse(f).half()),
        { range: NotNegative, dimensions: Root, of_number: Some(Number::sqrt), c: Some("sqrt"), wasm: Code(&[0x9f]),
          latex: Around(r"\sqrt{", "}"), ..UNARY };
    /// eˣ
    Exp: "exp", |x, _| x.exp(), |_, _, f| one(f),
        { range: NotNegative, c: Some("exp"), latex: Operator(r"\exp"), ..UNARY };
    /// ln x
    Ln: "ln", |x, _| x.ln(), |x, _, _| one(inverse(x)),
        { c: Some("log"), latex: Operator(r"\ln"), ..UNARY };
    /// tanh x
    Tanh: "tanh", |x, _| x.tanh(), |_, _, f| one(f.constant(1) - f * f),
        { parity: Odd, range: Unit, c: Some("tanh"), latex: Operator(r"\tanh"), ..UNARY };
    /// |x|
    Abs: "abs", |x, _| x.abs(), |x, _, _| one(x.of(F::Sign)),
        { parity: Even, range: NotNegative, pieces: Kinked, dimensions: Same, of_number: Some(|x| Some(x.abs())),
          latency: 1, c: Some("fabs"), wasm: Code(&[0x99]), latex: Around(r"\left|", r"\right|"), ..UNARY };
    /// −1, 0, 1
    Sign: "sign", |x, _| if x == 0.0 || x.is_nan() { x } else { x.signum() }, |x, _, _| [x.constant(0); 2],
        { parity: Odd, range: Unit, pieces: Steps, dimensions: Lost, wasm: Module, ..UNARY };
    /// angle of the vector (second argument, first argument)
    Atan2: "atan2", f64::atan2, |y, x, _| {
            let inverse = inverse(y * y + x * x);
            [x * inverse, -(y * inverse)]
        },
        { dimensions: Lost, c: Some("atan2"), ..BINARY };
    /// smaller of two
    Min: "min", |x, y| if x < y || x.is_nan() { x } else { y }, |x, y, _| select(y, x),
        { pieces: Kinked, dimensions: Same, wasm: Module, ..BINARY };
    /// larger of two
    Max: "max", |x, y| if x > y || x.is_nan() { x } else { y }, |x, y, _| select(x, y),
        { pieces: Kinked, dimensions: Same, wasm: Module, ..BINARY };
    /// xʸ
    Pow: "pow", f64::powf, |x, y, f| {
            let along_x = y * x.call(F::Pow, y - y.constant(1));
            // a constant exponent needs no logarithm, which a negative x does not have
            if y.is_number() { one(along_x) } else { [along_x, f * x.of(F::Ln)] }
        },
        { c: Some("pow"), ..BINARY };
    /// 1 if the first argument is larger, else 0
    Greater: "greater", |x, y| f64::from(u8::from(x > y)), |x, _, _| [x.constant(0); 2],
        { is_word: false, range: Unit, pieces: Steps, dimensions: Lost, wasm: Code(&[0x64, 0xb8]),
          latex: Bracket(">"), ..BINARY };
    /// the same, for a choice between values that are equal where its arguments are
    Choice: "greater", |x, y| f64::from(u8::from(x > y)), |x, _, _| [x.constant(0); 2],
        { is_word: false, range: Unit, pieces: Seamless, dimensions: Lost, wasm: Code(&[0x64, 0xb8]),
          latex: Bracket(">"), ..BINARY };
    /// second argument where the first, which is 0 or 1, is 1; 0 elsewhere, even if the second is no number
    Gate: "gate", |x, y| if x == 0.0 { 0.0 } else { y }, |x, _, _| [x.constant(0), x.call(F::Gate, x.constant(1))],
        { is_word: false, pieces: Gate, latency: 4, wasm: Module, latex: Latex::Product, ..BINARY };
}

impl Function {
    /// The table row of this function.
    pub fn row(self) -> &'static Row {
        &TABLE[self as usize]
    }

    /// The function written `name` in the language.
    pub fn named(name: &str) -> Option<Self> {
        TABLE.iter().find(|row| row.is_word && row.name == name).map(|row| row.function)
    }

    /// The arguments that it has, out of two.
    pub fn arguments<T>(self, both: &[T; 2]) -> &[T] {
        if self.row().arity == 1 { &both[..1] } else { both }
    }

    /// True if it is a sine or a cosine, which are computed together.
    pub fn is_turn(self) -> bool {
        matches!(self, F::Sin | F::Cos)
    }
}

/// The slopes of a function of one argument.
fn one<T: Arithmetic>(slope: T) -> [T; 2] {
    [slope, slope.constant(0)]
}

fn inverse<T: Arithmetic>(x: T) -> T {
    x.constant(1) / x
}

/// Slopes of `max`-like functions: [larger > smaller, its complement], in the
/// order of the function's own arguments.
fn select<T: Arithmetic>(larger: T, smaller: T) -> [T; 2] {
    let first = larger.call(F::Greater, smaller);
    [first, first.constant(1) - first]
}
