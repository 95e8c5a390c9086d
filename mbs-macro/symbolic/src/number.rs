//! Constants: exact rationals as long as they fit, reals beyond.

use std::cmp::Ordering;
use std::fmt;
use std::hash::{Hash, Hasher};

use crate::exact::{Real, Residue};

/// A constant. Arithmetic on rationals is exact; a result whose numerator or
/// denominator leaves `i64`, or an operand that is a real, gives a real. A difference
/// that is 0 in exact arithmetic is 0 here.
#[derive(Clone, Copy, Debug)]
pub enum Number {
    /// Numerator and denominator in lowest terms, the denominator positive.
    Rational(i64, i64),
    /// A number that is no short fraction, such as π.
    Real(Real),
}

impl Number {
    /// 0
    pub const ZERO: Self = Self::Rational(0, 1);
    /// 1
    pub const ONE: Self = Self::Rational(1, 1);
    /// −1
    pub const MINUS_ONE: Self = Self::Rational(-1, 1);
    /// An integer.
    pub const fn integer(value: i64) -> Self {
        Self::Rational(value, 1)
    }

    /// A float as it is.
    pub fn float(value: f64) -> Self {
        Self::Real(Real::float(value))
    }

    /// (numerator/denominator) π
    pub fn pi(numerator: i64, denominator: i64) -> Self {
        Self::Real(Real::pi(numerator, denominator))
    }

    /// The same with its exact value.
    pub fn real(self) -> Real {
        Real::of(self)
    }

    /// `numerator / denominator` in lowest terms; a real if that overflows or
    /// the denominator is 0.
    pub fn ratio(numerator: i64, denominator: i64) -> Self {
        Self::reduced(numerator.into(), denominator.into())
    }

    fn reduced(numerator: i128, denominator: i128) -> Self {
        if let (Ok(n), 1) = (i64::try_from(numerator), denominator) {
            return Self::Rational(n, 1);
        }
        let divisor = gcd(numerator.unsigned_abs(), denominator.unsigned_abs()).max(1) as i128;
        let sign = if denominator < 0 { -1 } else { 1 };
        let (n, d) = (sign * numerator / divisor, sign * denominator / divisor);
        match (i64::try_from(n), i64::try_from(d)) {
            (Ok(n), Ok(d)) if d > 0 => Self::Rational(n, d),
            _ => {
                let value = numerator as f64 / denominator as f64;
                let exact = Residue::ratio(numerator, denominator);
                exact.map_or_else(|| Self::float(value), |exact| Self::Real(Real::known(value, &[], exact)))
            }
        }
    }

    /// A bound, to first order, of what rounding did to its float: 0 for integers that a float holds.
    pub fn error(self) -> f64 {
        match self {
            Self::Rational(n, 1) if n.unsigned_abs() < 1 << 53 => 0.0,
            Self::Rational(..) => f64::EPSILON * self.to_f64().abs(),
            Self::Real(x) => x.error(),
        }
    }

    /// Reads a decimal literal such as `12`, `0.25` or `1e-3`; underscores are
    /// allowed. `None` if it is not one.
    pub fn parse(text: &str) -> Option<Self> {
        let text = text.replace('_', "");
        let float = text.parse::<f64>().ok().filter(|value| value.is_finite())?;
        Some(Self::parse_exact(&text).unwrap_or(Self::float(float)))
    }

    fn parse_exact(text: &str) -> Option<Self> {
        let (mantissa, exponent) = match text.split_once(['e', 'E']) {
            Some((mantissa, exponent)) => (mantissa, exponent.parse::<i32>().ok()?),
            None => (text, 0),
        };
        let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
        let digits: i64 = format!("{whole}{fraction}").parse().ok()?;
        let places = exponent.checked_sub(i32::try_from(fraction.len()).ok()?)?;
        let power = 10_i64.checked_pow(places.unsigned_abs())?;
        match if places < 0 {
            Self::ratio(digits, power)
        } else {
            Self::integer(digits) * Self::integer(power)
        } {
            Self::Real(_) => None,
            exact => Some(exact),
        }
    }

    /// The nearest float.
    pub fn to_f64(self) -> f64 {
        match self {
            Self::Rational(n, d) => n as f64 / d as f64,
            Self::Real(x) => x.value(),
        }
    }

    /// Exactly 0.
    pub fn is_zero(self) -> bool {
        match self {
            Self::Rational(n, _) => n == 0,
            Self::Real(x) => x.value() == 0.0,
        }
    }

    /// Exactly 1.
    pub fn is_one(self) -> bool {
        self == Self::ONE
    }

    /// Below 0.
    pub fn is_negative(self) -> bool {
        match self {
            Self::Rational(n, _) => n < 0,
            Self::Real(x) => x.value() < 0.0,
        }
    }

    /// |x|
    #[must_use]
    pub fn abs(self) -> Self {
        if self.is_negative() { -self } else { self }
    }

    /// The integer it is, if it is one.
    pub fn as_integer(self) -> Option<i64> {
        match self {
            Self::Rational(n, 1) => Some(n),
            _ => None,
        }
    }

    /// 1/x; infinite for 0.
    #[must_use]
    pub fn recip(self) -> Self {
        match self {
            Self::Rational(n, d) => Self::reduced(d.into(), n.into()),
            Self::Real(x) => Self::Real(x.recip()),
        }
    }

    /// x to an integer power; 0⁰ = 1.
    #[must_use]
    pub fn powi(self, exponent: i32) -> Self {
        let base = if exponent < 0 { self.recip() } else { self };
        (0..exponent.unsigned_abs()).fold(Self::ONE, |power, _| power * base)
    }

    /// √x; `None` below 0.
    pub fn sqrt(self) -> Option<Self> {
        if self.is_negative() {
            return None;
        }
        Some(match self {
            Self::Rational(n, d) => {
                let (rn, rd) = (n.isqrt(), d.isqrt());
                if rn * rn == n && rd * rd == d { Self::ratio(rn, rd) } else { Real::root_of_ratio(n, d) }
            }
            Self::Real(x) => x.sqrt(),
        })
    }
}

fn gcd(a: u128, b: u128) -> u128 {
    if b == 0 { a } else { gcd(b, a % b) }
}

impl std::ops::Add for Number {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        match (self, other) {
            (Self::Rational(a, b), Self::Rational(c, d)) => {
                let (a, b, c, d) = (i128::from(a), i128::from(b), i128::from(c), i128::from(d));
                Self::reduced(a * d + c * b, b * d)
            }
            _ => self.real().add(other.real()),
        }
    }
}

impl std::ops::Mul for Number {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        match (self, other) {
            (Self::Rational(a, b), Self::Rational(c, d)) => {
                Self::reduced(i128::from(a) * i128::from(c), i128::from(b) * i128::from(d))
            }
            _ => self.real().mul(other.real()),
        }
    }
}

impl std::ops::Neg for Number {
    type Output = Self;
    fn neg(self) -> Self {
        self * Self::MINUS_ONE
    }
}

impl From<i64> for Number {
    fn from(value: i64) -> Self {
        Self::integer(value)
    }
}

impl From<f64> for Number {
    /// An integer if it is one exactly, else the float as it is.
    fn from(x: f64) -> Self {
        if x.fract() == 0.0 && x.abs() < 9e15 { Self::integer(x as i64) } else { Self::float(x) }
    }
}

impl PartialEq for Number {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Number {}

impl Hash for Number {
    fn hash<H: Hasher>(&self, state: &mut H) {
        match *self {
            Self::Rational(n, d) => (n, d).hash(state),
            Self::Real(x) => (x.value().to_bits(), x.residue()).hash(state),
        }
    }
}

impl PartialOrd for Number {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Number {
    /// By value where that decides, else by representation, so that equal
    /// means "the same constant".
    fn cmp(&self, other: &Self) -> Ordering {
        match (*self, *other) {
            (Self::Rational(a, b), Self::Rational(c, d)) => {
                (i128::from(a) * i128::from(d)).cmp(&(i128::from(c) * i128::from(b)))
            }
            (Self::Real(x), Self::Real(y)) => {
                x.value().total_cmp(&y.value()).then_with(|| x.residue().cmp(&y.residue()))
            }
            (Self::Rational(..), Self::Real(y)) => self.to_f64().total_cmp(&y.value()).then(Ordering::Less),
            (Self::Real(x), Self::Rational(..)) => {
                x.value().total_cmp(&other.to_f64()).then(Ordering::Greater)
            }
        }
    }
}

/// Fractions with a denominator from here on are written as decimals, if they
/// are short ones.
const SHORTEST_DECIMAL: i64 = 20;
const LONGEST_DECIMAL: i64 = 1_000_000;

impl fmt::Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Rational(n, 1) => write!(f, "{n}"),
            // 9.81 reads better than 981/100, and 1/3 than any decimal
            Self::Rational(n, d) if d >= SHORTEST_DECIMAL && LONGEST_DECIMAL % d == 0 => {
                write!(f, "{}", n as f64 / d as f64)
            }
            Self::Rational(n, d) => write!(f, "{n}/{d}"),
            Self::Real(x) if x.value() == std::f64::consts::PI => write!(f, "pi"),
            Self::Real(x) if x.value() == 0.0 || (1e-5..1e16).contains(&x.value().abs()) => {
                write!(f, "{}", x.value())
            }
            Self::Real(x) => write!(f, "{:e}", x.value()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Number;

    #[test]
    fn literals_are_exact_where_they_can_be() {
        assert_eq!(Number::parse("0.06"), Some(Number::ratio(3, 50)));
        assert_eq!(Number::parse("1e-3"), Some(Number::ratio(1, 1000)));
        assert_eq!(Number::parse("1_000"), Some(Number::integer(1000)));
        assert_eq!(Number::parse("1e300"), Some(Number::float(1e300)));
        assert_eq!(Number::parse("1e999"), None);
        assert_eq!(Number::parse("x"), None);
    }

    #[test]
    fn rationals_overflow_into_floats() {
        let big = Number::integer(i64::MAX);
        assert_eq!((big * big).to_f64(), (i64::MAX as f64) * (i64::MAX as f64));
        assert_eq!(Number::ratio(1, 3) + Number::ratio(1, 6), Number::ratio(1, 2));
        assert_eq!(Number::ratio(2, 3).powi(-2), Number::ratio(9, 4));
        assert_eq!(Number::ratio(9, 4).sqrt(), Some(Number::ratio(3, 2)));
        assert_eq!(Number::integer(i64::MIN).abs().to_f64(), 9223372036854775808.0);
    }
}
