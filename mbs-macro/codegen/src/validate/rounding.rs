//! Numbers with a running bound of their rounding error.

use std::ops::{Add, Mul, Neg, Sub};

use mbs_symbolic::{Function, Instruction, Number, Operand, Operation, Program, Spline, Symbol};

/// A computed value and a first-order bound of how far it may be from the exact
/// one, given exact inputs.
#[derive(Clone, Copy, Debug, Default)]
pub struct Rounded {
    pub value: f64,
    pub error: f64,
}

/// A library function is good to a unit in the last place or two.
const OF_A_FUNCTION: f64 = 2.0 * f64::EPSILON;

impl Rounded {
    pub fn exact(value: f64) -> Self {
        Self { value, error: 0.0 }
    }

    /// A constant, which was rounded when it was read and when constants were folded.
    pub fn constant(number: Number) -> Self {
        Self { value: number.to_f64(), error: number.error() }
    }

    /// A result that was rounded once more.
    fn after(value: f64, error: f64) -> Self {
        Self { value, error: error + f64::EPSILON * value.abs() }
    }

    pub fn recip(self) -> Self {
        let value = 1.0 / self.value;
        Self::after(value, self.error * value * value)
    }

    pub fn powi(self, exponent: i32) -> Self {
        let power = (0..exponent.unsigned_abs()).fold(Self::exact(1.0), |power, _| power * self);
        if exponent < 0 { power.recip() } else { power }
    }

    /// f(x), where |f′(x)| is `slope`; no change in x, no error of f.
    fn of(value: f64, slope: f64, x: Self) -> Self {
        let passed_on = if x.error == 0.0 { 0.0 } else { slope.abs() * x.error };
        Self { value, error: passed_on + OF_A_FUNCTION * value.abs() }
    }

    /// f(x, y); the second argument is ignored where there is only one.
    pub fn call(function: Function, x: Self, y: Self) -> Self {
        use Function as F;
        let (a, b) = (x.value, y.value);
        let value = (function.row().value)(a, b);
        // Where rounding decides between the pieces, nothing is known.
        let piece = |gap: f64, error: f64, chosen: Self| {
            if gap.abs() <= 4.0 * error { Self { value, error: f64::INFINITY } } else { chosen }
        };
        match function {
            F::Sin => Self::of(value, a.cos(), x),
            F::Cos => Self::of(value, a.sin(), x),
            F::Tan => Self::of(value, 1.0 + value * value, x),
            F::Asin | F::Acos => Self::of(value, 1.0 / (1.0 - a * a).sqrt(), x),
            F::Atan => Self::of(value, 1.0 / (1.0 + a * a), x),
            F::Sqrt => Self::of(value, 0.5 / value, x),
            F::Exp => Self::of(value, value, x),
            F::Ln => Self::of(value, 1.0 / a, x),
            F::Tanh => Self::of(value, 1.0 - value * value, x),
            F::Abs => Self { value, error: x.error },
            F::Sign => piece(a, x.error, Self::exact(value)),
            F::Greater => piece(a - b, x.error + y.error, Self::exact(value)),
            F::Min | F::Max => Self { value, error: x.error.max(y.error) },
            F::Atan2 => {
                let squares = a * a + b * b;
                let passed_on = (b.abs() * x.error + a.abs() * y.error) / squares;
                Self { value, error: passed_on + OF_A_FUNCTION * value.abs() }
            }
            F::Pow => {
                let of_base = Self::of(value, b * value / a, x).error;
                Self { value, error: of_base + Self::of(value, value * a.abs().ln(), y).error }
            }
        }
    }
}

impl Rounded {
    /// A derivative of a spline. Its argument is reduced to one period and then
    /// to one segment, with an error of a few roundings of the larger of both;
    /// its four terms are as large as its derivatives times the period allow.
    pub fn spline(spline: &Spline, order: u8, x: Self) -> Self {
        let of = |more: u8| if order + more > 3 { 0.0 } else { spline.derivative(order + more, x.value) };
        let period = spline.period;
        let reduced = x.error + 4.0 * f64::EPSILON * (x.value.abs() + spline.origin.abs() + period);
        let terms = of(0).abs() + of(1).abs() * period + of(2).abs() * period * period;
        Self { value: of(0), error: of(1).abs() * reduced + 16.0 * f64::EPSILON * terms }
    }
}

impl Add for Rounded {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::after(self.value + other.value, self.error + other.error)
    }
}

impl Neg for Rounded {
    type Output = Self;
    fn neg(self) -> Self {
        Self { value: -self.value, ..self }
    }
}

impl Sub for Rounded {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Rounded {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let error = self.value.abs() * other.error + other.value.abs() * self.error;
        Self::after(self.value * other.value, error)
    }
}

/// The results of a program with their bounds.
pub fn run(program: &Program, symbol: &dyn Fn(Symbol) -> f64, hoisted: &[Rounded]) -> Vec<Rounded> {
    let mut values: Vec<Rounded> = Vec::with_capacity(program.instructions.len());
    let read = |operand: Operand, values: &[Rounded]| match operand {
        Operand::Number(number) => Rounded::constant(number),
        Operand::Symbol(s) => Rounded::exact(symbol(s)),
        Operand::Hoisted(at) => hoisted[at],
        Operand::Value(at) => values[at],
    };
    for Instruction { operation, a, b, .. } in &program.instructions {
        let (a, b) = (read(*a, &values), read(*b, &values));
        values.push(match operation {
            Operation::Add => a + b,
            Operation::Sub => a - b,
            Operation::Mul => a * b,
            Operation::Div => a * b.recip(),
            Operation::Neg => -a,
            Operation::Call(function) | Operation::Call2(function) => Rounded::call(*function, a, b),
            Operation::Spline(spline, order) => Rounded::spline(&program.splines[spline.index()], *order, a),
        });
    }
    program.outputs.iter().map(|&output| read(output, &values)).collect()
}
