//! Units and dimensions: `N*m`, `rad/s`, `kg*m^2`, `rpm`.

use std::fmt;

use crate::Number;

/// Exponents are kept in sixths, so that square and cube roots stay exact.
const SIXTHS: i16 = 6;

/// A physical dimension kgᵃ·mᵇ·sᶜ. Angles are dimensionless.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Dimension {
    sixths: [i16; 3],
}

impl Dimension {
    /// A bare number or an angle.
    pub const NONE: Self = Self::of(0, 0, 0);
    /// kg
    pub const MASS: Self = Self::of(1, 0, 0);
    /// m
    pub const LENGTH: Self = Self::of(0, 1, 0);
    /// s
    pub const TIME: Self = Self::of(0, 0, 1);

    /// kgᵃ·mᵇ·sᶜ
    pub const fn of(mass: i16, length: i16, time: i16) -> Self {
        Self { sixths: [SIXTHS * mass, SIXTHS * length, SIXTHS * time] }
    }

    /// The dimension of a product.
    #[must_use]
    pub fn times(self, other: Self) -> Self {
        self.zip(other, i16::saturating_add)
    }

    /// The dimension of a quotient.
    #[must_use]
    pub fn over(self, other: Self) -> Self {
        self.zip(other, i16::saturating_sub)
    }

    /// The dimension of a power; `None` if an exponent is no multiple of 1/6.
    pub fn power(self, exponent: Number) -> Option<Self> {
        let Number::Rational(n, d) = exponent else {
            return (self == Self::NONE).then_some(self);
        };
        let mut sixths = [0; 3];
        for (to, from) in sixths.iter_mut().zip(self.sixths) {
            let scaled = i64::from(from).checked_mul(n)?;
            *to = i16::try_from((scaled % d == 0).then_some(scaled / d)?).ok()?;
        }
        Some(Self { sixths })
    }

    /// (mass, length, time) if all exponents are small integers.
    pub fn exponents(self) -> Option<[i8; 3]> {
        let mut exponents = [0; 3];
        for (to, from) in exponents.iter_mut().zip(self.sixths) {
            *to = i8::try_from((from % SIXTHS == 0).then_some(from / SIXTHS)?).ok()?;
        }
        Some(exponents)
    }

    /// The dimension with these exponents of (mass, length, time).
    pub fn from_exponents([mass, length, time]: [i8; 3]) -> Self {
        Self::of(mass.into(), length.into(), time.into())
    }

    /// The SI unit as text: `N*m`, `kg^2/s`; empty for a bare number.
    pub fn si_unit(self) -> String {
        if let Some((_, _, unit)) = self.named() {
            return (*unit).to_owned();
        }
        let factors = |sign: i16| {
            let powers = ["kg", "m", "s"].into_iter().zip(self.sixths.map(|sixths| sign * sixths));
            let raised = |(unit, sixths): (&str, i16)| match Number::ratio(sixths.into(), SIXTHS.into()) {
                Number::Rational(1, 1) => unit.to_owned(),
                Number::Rational(power, 1) => format!("{unit}^{power}"),
                fraction => format!("{unit}^({fraction})"),
            };
            powers.filter(|(_, sixths)| *sixths > 0).map(raised).collect::<Vec<_>>()
        };
        let (over, under) = (factors(1).join("*"), factors(-1));
        let over = if over.is_empty() { "1".to_owned() } else { over };
        under.iter().fold(over, |text, factor| format!("{text}/{factor}"))
    }

    /// What engineers call it.
    fn named(self) -> Option<&'static (Self, &'static str, &'static str)> {
        QUANTITIES.iter().find(|(dimension, ..)| *dimension == self)
    }

    fn zip(self, other: Self, f: impl Fn(i16, i16) -> i16) -> Self {
        let [a, b, c] = self.sixths;
        let [x, y, z] = other.sixths;
        Self { sixths: [f(a, x), f(b, y), f(c, z)] }
    }
}

/// Dimensions that engineers have a name for, the name, and the SI unit.
const QUANTITIES: &[(Dimension, &str, &str)] = &[
    (Dimension::NONE, "dimensionless", ""),
    (Dimension::LENGTH, "length", "m"),
    (Dimension::MASS, "mass", "kg"),
    (Dimension::TIME, "time", "s"),
    (Dimension::of(0, 2, 0), "area", "m^2"),
    (Dimension::of(0, 0, -1), "rate", "1/s"),
    (Dimension::of(0, 1, -1), "velocity", "m/s"),
    (Dimension::of(0, 1, -2), "acceleration", "m/s^2"),
    (Dimension::of(0, 0, -2), "angular acceleration", "1/s^2"),
    (Dimension::of(1, 1, -2), "force", "N"),
    (Dimension::of(1, 2, -2), "torque or energy", "N*m"),
    (Dimension::of(1, 2, -3), "power", "W"),
    (Dimension::of(1, -1, -2), "pressure", "Pa"),
    (Dimension::of(1, 2, 0), "moment of inertia", "kg*m^2"),
    (Dimension::of(1, 0, -2), "stiffness", "N/m"),
    (Dimension::of(1, 0, -1), "damping", "N*s/m"),
    (Dimension::of(1, 2, -1), "rotational damping", "N*m*s"),
    (Dimension::of(1, 1, -1), "momentum", "kg*m/s"),
];

impl fmt::Display for Dimension {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.named() {
            Some((_, name, "")) => f.write_str(name),
            Some((_, name, unit)) => write!(f, "{name} [{unit}]"),
            None => write!(f, "[{}]", self.si_unit()),
        }
    }
}

/// A unit: its dimension, and how many SI units it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit {
    /// SI value of one such unit; exact except where π is in it.
    pub scale: Number,
    /// Its dimension.
    pub dimension: Dimension,
}

impl Unit {
    /// The unit of a bare number.
    pub const ONE: Self = Self { scale: Number::ONE, dimension: Dimension::NONE };

    /// The product of two units.
    #[must_use]
    pub fn times(self, other: Self) -> Self {
        Self { scale: self.scale * other.scale, dimension: self.dimension.times(other.dimension) }
    }

    /// A unit to an integer power; `None` if it is out of all measure.
    pub fn power(self, exponent: i32) -> Option<Self> {
        let dimension = self.dimension.power(Number::integer(exponent.into()))?;
        (exponent.unsigned_abs() <= 12).then_some(Self { scale: self.scale.powi(exponent), dimension })
    }
}

/// How a unit's scale is written in the table.
#[derive(Clone, Copy)]
enum Scale {
    /// A ratio of integers.
    Exact(i64, i64),
    /// π times a ratio of integers.
    Pi(i64, i64),
}

/// Every unit the language knows: name, scale, exponents of (kg, m, s).
const UNITS: &[(&str, Scale, [i16; 3])] = &[
    ("m", Scale::Exact(1, 1), [0, 1, 0]),
    ("mm", Scale::Exact(1, 1000), [0, 1, 0]),
    ("cm", Scale::Exact(1, 100), [0, 1, 0]),
    ("um", Scale::Exact(1, 1_000_000), [0, 1, 0]),
    ("km", Scale::Exact(1000, 1), [0, 1, 0]),
    ("inch", Scale::Exact(254, 10_000), [0, 1, 0]),
    ("ft", Scale::Exact(3048, 10_000), [0, 1, 0]),
    ("kg", Scale::Exact(1, 1), [1, 0, 0]),
    ("g", Scale::Exact(1, 1000), [1, 0, 0]),
    ("tonne", Scale::Exact(1000, 1), [1, 0, 0]),
    ("lb", Scale::Exact(45_359_237, 100_000_000), [1, 0, 0]),
    ("s", Scale::Exact(1, 1), [0, 0, 1]),
    ("ms", Scale::Exact(1, 1000), [0, 0, 1]),
    ("us", Scale::Exact(1, 1_000_000), [0, 0, 1]),
    ("min", Scale::Exact(60, 1), [0, 0, 1]),
    ("h", Scale::Exact(3600, 1), [0, 0, 1]),
    ("Hz", Scale::Exact(1, 1), [0, 0, -1]),
    ("rad", Scale::Exact(1, 1), [0, 0, 0]),
    ("mrad", Scale::Exact(1, 1000), [0, 0, 0]),
    ("deg", Scale::Pi(1, 180), [0, 0, 0]),
    ("rev", Scale::Pi(2, 1), [0, 0, 0]),
    ("rpm", Scale::Pi(1, 30), [0, 0, -1]),
    ("N", Scale::Exact(1, 1), [1, 1, -2]),
    ("mN", Scale::Exact(1, 1000), [1, 1, -2]),
    ("kN", Scale::Exact(1000, 1), [1, 1, -2]),
    ("J", Scale::Exact(1, 1), [1, 2, -2]),
    ("kJ", Scale::Exact(1000, 1), [1, 2, -2]),
    ("W", Scale::Exact(1, 1), [1, 2, -3]),
    ("kW", Scale::Exact(1000, 1), [1, 2, -3]),
    ("Pa", Scale::Exact(1, 1), [1, -1, -2]),
    ("kPa", Scale::Exact(1000, 1), [1, -1, -2]),
    ("MPa", Scale::Exact(1_000_000, 1), [1, -1, -2]),
    ("bar", Scale::Exact(100_000, 1), [1, -1, -2]),
];

/// The unit called `name`.
pub fn lookup(name: &str) -> Option<Unit> {
    let (_, scale, [mass, length, time]) = UNITS.iter().find(|(known, ..)| *known == name)?;
    let scale = match *scale {
        Scale::Exact(n, d) => Number::ratio(n, d),
        Scale::Pi(n, d) => Number::Float(std::f64::consts::PI * n as f64 / d as f64),
    };
    Some(Unit { scale, dimension: Dimension::of(*mass, *length, *time) })
}

/// The names of all units, for messages.
pub fn known() -> impl Iterator<Item = &'static str> {
    UNITS.iter().map(|(name, ..)| *name)
}

/// A unit that could not be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnitError {
    /// What is wrong with it.
    pub message: String,
}

impl UnitError {
    /// The error for a name that is no unit.
    pub fn unknown(name: &str) -> Self {
        let list: Vec<_> = known().collect();
        Self { message: format!("unknown unit `{name}`; the units are {}", list.join(", ")) }
    }
}

impl fmt::Display for UnitError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for UnitError {}

/// Reads a product of unit powers such as `N*m`, `kg*m^2`, `m/s^2` or `1/s`.
///
/// `/` applies to the next factor alone, as in `kg*m/s/s`.
///
/// # Errors
/// Names the factor that is no unit and lists the units.
///
/// # Example
/// ```
/// use mbs_symbolic::units::{Dimension, parse};
///
/// let torque = parse("N*mm")?;
/// assert_eq!(torque.scale.to_f64(), 1e-3);
/// assert_eq!(torque.dimension, Dimension::of(1, 2, -2));
/// assert!(parse("Nm").is_err());
/// # Ok::<(), mbs_symbolic::units::UnitError>(())
/// ```
pub fn parse(text: &str) -> Result<Unit, UnitError> {
    let mut unit = Unit::ONE;
    let mut rest = text.trim();
    let mut sign = 1;
    loop {
        let end = rest.find(['*', '/']).unwrap_or(rest.len());
        let (factor, tail) = rest.split_at(end);
        unit = unit.times(parse_factor(factor.trim(), sign)?);
        let mut chars = tail.chars();
        sign = match chars.next() {
            None => return Ok(unit),
            Some('/') => -1,
            Some(_) => 1,
        };
        rest = chars.as_str().trim_start();
    }
}

fn parse_factor(factor: &str, sign: i32) -> Result<Unit, UnitError> {
    let (name, exponent) = match factor.split_once('^') {
        Some((name, exponent)) => (name.trim_end(), exponent.trim().parse::<i32>().ok()),
        None => (factor, Some(1)),
    };
    let power = |unit: Unit| exponent.and_then(|e| unit.power(sign * e.clamp(-99, 99)));
    let unit = if name == "1" { Some(Unit::ONE) } else { lookup(name) };
    match unit {
        None => Err(UnitError::unknown(name)),
        Some(unit) => power(unit).ok_or_else(|| UnitError {
            message: format!("`{factor}` needs a small whole number as its exponent"),
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::{Dimension, parse};

    #[test]
    fn products_powers_and_quotients() {
        let unit = parse("kg*m/s^2").unwrap();
        assert_eq!((unit.scale.to_f64(), unit.dimension), (1.0, Dimension::of(1, 1, -2)));
        assert_eq!(parse("1/s").unwrap().dimension, Dimension::of(0, 0, -1));
        assert_eq!(parse("rpm").unwrap().scale.to_f64(), std::f64::consts::PI / 30.0);
        assert_eq!(parse("mm^2").unwrap().scale.to_f64(), 1e-6);
    }

    #[test]
    fn nonsense_is_refused_by_name() {
        assert!(
            parse("furlong").unwrap_err().message.starts_with("unknown unit `furlong`; the units are m, mm")
        );
        assert!(parse("").is_err());
        assert!(parse("m*").is_err());
        assert!(parse("m^x").is_err());
        assert!(parse("m^99").is_err());
    }

    #[test]
    fn dimensions_read_as_quantities() {
        assert_eq!(Dimension::of(1, 2, -2).to_string(), "torque or energy [N*m]");
        assert_eq!(Dimension::of(3, 0, -1).to_string(), "[kg^3/s]");
    }
}
