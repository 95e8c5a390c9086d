//! Expressions along a curve, to second order: an evaluation that takes its
//! derivatives from the chain rule on numbers, not from the symbolic engine.

use std::ops::{Add, Mul, Neg};

use mbs_symbolic::{Arena, Function, Node, Symbol, Tape, Values};

use super::rounding::Rounded;

/// x, x′ and x″ along a curve s.
#[derive(Clone, Copy, Debug, Default)]
pub struct Jet {
    pub value: Rounded,
    pub first: Rounded,
    pub second: Rounded,
}

/// The jets of the roots of a tape where symbols move along `curve`.
pub fn evaluate(tape: &Tape, arena: &Arena, curve: &dyn Fn(Symbol) -> Jet) -> Vec<Jet> {
    tape.run(arena, |node, values: &Values<Jet>| match node {
        Node::Number(number) => Jet::still(Rounded::constant(*number)),
        Node::Symbol(symbol) => curve(*symbol),
        Node::Sum(constant, terms) => {
            terms.iter().fold(Jet::still(Rounded::constant(*constant)), |sum, (term, coefficient)| {
                sum + Jet::still(Rounded::constant(*coefficient)) * values.of(*term)
            })
        }
        Node::Product(factors) => factors.iter().fold(Jet::still(ONE), |product, (factor, exponent)| {
            product * values.of(*factor).powi(*exponent)
        }),
        Node::Call(function, x) => values.of(*x).call(*function),
        Node::Call2(function, x, y) => values.of(*x).call2(*function, values.of(*y)),
        Node::Spline(spline, order, x) => {
            let (spline, jet) = (&arena.splines()[spline.index()], values.of(*x));
            let of = |more: u8| Rounded::spline(spline, order + more, jet.value);
            jet.chain(of(0), of(1), of(2))
        }
        Node::Shared(x) => values.of(*x),
    })
}

const ONE: Rounded = Rounded { value: 1.0, error: 0.0 };
const NONE: Rounded = Rounded { value: 0.0, error: 0.0 };

fn times(factor: f64, x: Rounded) -> Rounded {
    Rounded::exact(factor) * x
}

impl Jet {
    /// A value that does not move.
    pub fn still(value: Rounded) -> Self {
        Self { value, first: NONE, second: NONE }
    }

    /// value + s·first + s²/2·second
    pub fn curve(value: f64, first: f64, second: f64) -> Self {
        Self { value: Rounded::exact(value), first: Rounded::exact(first), second: Rounded::exact(second) }
    }

    fn is_still(&self) -> bool {
        [self.first, self.second].iter().all(|x| x.value == 0.0 && x.error == 0.0)
    }

    /// f(x) from f, f′ and f″ at x: (f∘x)″ = f″ x′² + f′ x″. A value that does not move
    /// may stand where f has no derivative.
    fn chain(self, f: Rounded, df: Rounded, ddf: Rounded) -> Self {
        if self.is_still() {
            return Self::still(f);
        }
        Self { value: f, first: df * self.first, second: ddf * self.first * self.first + df * self.second }
    }

    fn powi(self, exponent: i32) -> Self {
        let power = |lower: i32| self.value.powi(exponent - lower);
        let e = f64::from(exponent);
        match exponent {
            1 => self,
            2 => self * self,
            _ => self.chain(power(0), times(e, power(1)), times(e * (e - 1.0), power(2))),
        }
    }

    fn recip(self) -> Self {
        let r = self.value.recip();
        self.chain(r, -(r * r), times(2.0, r * r * r))
    }

    fn call(self, function: Function) -> Self {
        use Function as F;
        let x = self.value;
        let of = |function| Rounded::call(function, x, NONE);
        let f = of(function);
        match function {
            F::Sin => self.chain(f, of(F::Cos), -f),
            F::Cos => self.chain(f, -of(F::Sin), -f),
            F::Tan => {
                let slope = ONE + f * f;
                self.chain(f, slope, times(2.0, f * slope))
            }
            F::Asin | F::Acos => {
                let r = Rounded::call(F::Sqrt, ONE - x * x, NONE).recip();
                let r = if function == F::Acos { -r } else { r };
                self.chain(f, r, x * r * r * r)
            }
            F::Atan => {
                let r = (ONE + x * x).recip();
                self.chain(f, r, times(-2.0, x * r * r))
            }
            F::Sqrt => {
                let r = f.recip();
                self.chain(f, times(0.5, r), times(-0.25, r * r * r))
            }
            F::Exp => self.chain(f, f, f),
            F::Ln => {
                let r = x.recip();
                self.chain(f, r, -(r * r))
            }
            F::Tanh => {
                let slope = ONE - f * f;
                self.chain(f, slope, times(-2.0, f * slope))
            }
            F::Abs => self.chain(f, of(F::Sign), NONE),
            F::Sign => Self::still(f),
            F::Atan2 | F::Min | F::Max | F::Pow | F::Greater => self.call2(function, Self::still(NONE)),
        }
    }

    fn call2(self, function: Function, other: Self) -> Self {
        use Function as F;
        let f = Rounded::call(function, self.value, other.value);
        match function {
            F::Min | F::Max => {
                // sign(x − y) is uncertain exactly where the choice is
                let gap = Rounded::call(F::Sign, self.value - other.value, NONE);
                let is_first = (gap.value < 0.0) == (function == F::Min);
                let Self { value, first, second } = if is_first { self } else { other };
                let unsure = |x: Rounded| Rounded { error: x.error + gap.error, ..x };
                Self { value, first: unsure(first), second: unsure(second) }
            }
            F::Pow if other.is_still() => {
                let y = other.value;
                let power = |lower: f64| Rounded::call(F::Pow, self.value, y - Rounded::exact(lower));
                self.chain(f, y * power(1.0), y * (y - ONE) * power(2.0))
            }
            F::Pow => {
                let power = (other * self.call(F::Ln)).call(F::Exp);
                Self { value: f, ..power }
            }
            // The angle of a vector changes as the angle of the vector seen from itself.
            F::Atan2 => {
                let (y, x) = (self, other);
                let along = y * Self::still(y.value) + x * Self::still(x.value);
                let across = y * Self::still(x.value) + -(x * Self::still(y.value));
                let turned = (across * along.recip()).call(F::Atan);
                Self { value: f, ..turned }
            }
            _ => Self::still(f),
        }
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

impl Mul for Jet {
    type Output = Self;
    fn mul(self, y: Self) -> Self {
        let mixed = self.first * y.first;
        Self {
            value: self.value * y.value,
            first: self.first * y.value + self.value * y.first,
            second: self.second * y.value + (mixed + mixed) + self.value * y.second,
        }
    }
}
