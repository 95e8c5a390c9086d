//! Units and dimensions: `N*m`, `rad/s`, `kg*m^2`, `rpm`.

mod table;
mod text;

pub use text::{UnitError, parse};

use std::fmt;

use crate::Number;
use table::{OTHER_NAMES, Scale, UNITS};

/// Exponents are kept in sixths, so that square and cube roots stay exact.
const SIXTHS: i16 = 6;

/// The base units, in the order of exponents.
const BASE: [&str; 5] = ["kg", "m", "s", "A", "K"];

/// A physical dimension kgᵃ·mᵇ·sᶜ·Aᵈ·Kᵉ. Angles are dimensionless.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Dimension {
    sixths: [i16; BASE.len()],
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
        Self::from_whole([mass, length, time, 0, 0])
    }

    /// kgᵃ·mᵇ·sᶜ·Aᵈ
    pub const fn electric(mass: i16, length: i16, time: i16, current: i16) -> Self {
        Self::from_whole([mass, length, time, current, 0])
    }

    /// kgᵃ·mᵇ·sᶜ·Kᵈ
    pub const fn thermal(mass: i16, length: i16, time: i16, temperature: i16) -> Self {
        Self::from_whole([mass, length, time, 0, temperature])
    }

    const fn from_whole([mass, length, time, current, temperature]: [i16; BASE.len()]) -> Self {
        let sixths = [SIXTHS * mass, SIXTHS * length, SIXTHS * time, SIXTHS * current, SIXTHS * temperature];
        Self { sixths }
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
        let mut sixths = [0; BASE.len()];
        for (to, from) in sixths.iter_mut().zip(self.sixths) {
            let scaled = i64::from(from).checked_mul(n)?;
            *to = i16::try_from((scaled % d == 0).then_some(scaled / d)?).ok()?;
        }
        Some(Self { sixths })
    }

    /// Those of (mass, length, time, current, temperature) if all are small integers.
    pub fn exponents(self) -> Option<[i8; BASE.len()]> {
        let mut exponents = [0; BASE.len()];
        for (to, from) in exponents.iter_mut().zip(self.sixths) {
            *to = i8::try_from((from % SIXTHS == 0).then_some(from / SIXTHS)?).ok()?;
        }
        Some(exponents)
    }

    /// The dimension with these exponents of (mass, length, time, current, temperature).
    pub fn from_exponents(exponents: [i8; BASE.len()]) -> Self {
        Self::from_whole(exponents.map(i16::from))
    }

    /// The SI unit as text: `N*m`, `kg^2/s`; empty for a bare number.
    pub fn si_unit(self) -> String {
        if let Some((_, _, unit)) = self.named() {
            return (*unit).to_owned();
        }
        // the rate of a quantity that has a unit of its own: V/s
        if let Some((_, _, unit)) = self.times(Self::TIME).named().filter(|(.., unit)| !unit.contains('/')) {
            return format!("{unit}/s");
        }
        let factors = |sign: i16| {
            let powers = BASE.into_iter().zip(self.sixths.map(|sixths| sign * sixths));
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

    /// Its row among the dimensions that engineers have a name for.
    fn named(self) -> Option<&'static (Self, &'static str, &'static str)> {
        QUANTITIES.iter().find(|(dimension, ..)| *dimension == self)
    }

    fn zip(self, other: Self, f: impl Fn(i16, i16) -> i16) -> Self {
        let mut sixths = self.sixths;
        sixths.iter_mut().zip(other.sixths).for_each(|(to, other)| *to = f(*to, other));
        Self { sixths }
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
    (Dimension::electric(0, 0, 0, 1), "current", "A"),
    (Dimension::electric(0, 0, 1, 1), "charge", "C"),
    (Dimension::electric(1, 2, -3, -1), "voltage", "V"),
    (Dimension::electric(1, 2, -3, -2), "resistance", "ohm"),
    (Dimension::electric(-1, -2, 4, 2), "capacitance", "F"),
    (Dimension::electric(1, 2, -2, -2), "inductance", "H"),
    (Dimension::electric(1, 2, -2, -1), "torque per current or voltage per speed", "N*m/A"),
    (Dimension::electric(1, 0, -2, -1), "magnetic flux density", "T"),
    (Dimension::thermal(0, 0, 0, 1), "temperature", "K"),
    (Dimension::thermal(1, 2, -2, -1), "heat capacity", "J/K"),
    (Dimension::thermal(1, 2, -3, -1), "thermal conductance", "W/K"),
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

/// The unit called `name`; on a command line and in tables `°` is one, too.
pub fn lookup(name: &str) -> Option<Unit> {
    let name = if name == "°" { "deg" } else { name };
    let (_, scale, exponents) = UNITS.iter().find(|(known, ..)| *known == name)?;
    let scale = match *scale {
        Scale::Exact(n, d) => Number::ratio(n, d),
        Scale::Pi(n, d) => Number::pi(n, d),
    };
    let mut whole = [0; BASE.len()];
    whole.iter_mut().zip(*exponents).for_each(|(to, exponent)| *to = *exponent);
    Some(Unit { scale, dimension: Dimension::from_whole(whole) })
}

/// The names of all units, for messages.
pub fn known() -> impl Iterator<Item = &'static str> {
    UNITS.iter().map(|(name, ..)| *name)
}

/// The unit that is likely meant by a name that is no unit: `lb` for `lbs`, and `N*m` for `Nm`. `None` without a guess.
pub fn meant(name: &str) -> Option<String> {
    if let Some((_, meant)) = OTHER_NAMES.iter().find(|(other, _)| *other == name) {
        return Some((*meant).to_owned());
    }
    // people write several kilograms as `kgs`, and newton-seconds as `Ns`
    let counted = [Dimension::MASS, Dimension::LENGTH, Dimension::NONE];
    if let Some(one) =
        name.strip_suffix('s').filter(|one| lookup(one).is_some_and(|unit| counted.contains(&unit.dimension)))
    {
        return Some(one.to_owned());
    }
    let mut products = (1..name.len()).filter_map(|at| name.split_at_checked(at));
    // nobody means a product of two masses by `kgg`
    let dimension = |name| lookup(name).map(|unit| unit.dimension);
    let product =
        products.find(|(a, b)| dimension(a).zip(dimension(b)).is_some_and(|(first, second)| first != second));
    product.map(|(a, b)| format!("{a}*{b}"))
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

    /// The factors of NIST SP 811, appendix B.8, to the digits that it prints.
    #[test]
    fn units_of_the_english_system_are_those_of_nist() {
        for (unit, factor, digits) in [
            ("in", 2.54e-2, 16),
            ("ft", 3.048e-1, 16),
            ("yd", 9.144e-1, 16),
            ("mi", 1.609344e3, 16),
            ("gal", 3.785412e-3, 7),
            ("lb", 4.5359237e-1, 16),
            ("oz", 2.834952e-2, 7),
            ("slug", 1.459390e1, 7),
            ("kgf", 9.80665, 16),
            ("lbf", 4.4482216152605, 14),
            ("ozf", 2.780139e-1, 7),
            ("kip", 4.448222e3, 7),
            ("psi", 6.894757e3, 7),
            ("ksi", 6.894757e6, 7),
            ("hp", 7.456999e2, 7),
            ("mph", 4.4704e-1, 16),
            ("lbf*ft", 1.355818, 7),
            ("lbf*in", 1.129848e-1, 7),
            ("ft/s^2", 3.048e-1, 16),
            ("lb*ft^2", 4.214011e-2, 7),
        ] {
            let scale = parse(unit).unwrap().scale.to_f64();
            let error = (scale / factor - 1.0).abs();
            assert!(error <= 5.0 * 0.1_f64.powi(digits), "1 {unit} = {scale}, not {factor}");
        }
        assert_eq!(parse("lbf*s^2/ft"), parse("slug"));
        assert_eq!(parse("lbf/in^2"), parse("psi"));
        assert_eq!(parse("°/s"), parse("deg/s"));
    }

    /// Regression: `m` was proposed for `lbm`.
    #[test]
    fn what_is_proposed_fits() {
        let said = |text: &str, expected| parse(text).unwrap_err().in_place_of(expected).message;
        let mass = said("lbs", Dimension::MASS);
        assert!(
            mass.starts_with("unknown unit `lbs`; did you mean `lb`? a mass [kg] may be in kg, g,"),
            "{mass}"
        );
        let length = said("lbs", Dimension::LENGTH);
        assert!(length.starts_with("unknown unit `lbs`; a length [m] may be in m, mm,"), "{length}");
        assert_eq!(
            said("Nms", Dimension::of(1, 0, -1)),
            "unknown unit `Nms`; a damping [N*s/m] may be in N*s/m"
        );
        assert_eq!(said("m^x", Dimension::MASS), "`m^x` needs a small whole number as its exponent");
    }

    /// Everything that is proposed is a unit, and what it is proposed for is none.
    #[test]
    fn other_names_are_of_units() {
        for (other, unit) in super::OTHER_NAMES {
            assert!(super::lookup(other).is_none() && parse(unit).is_ok(), "{other}");
        }
    }

    #[test]
    fn electric_and_thermal_units_follow_from_their_equations() {
        for (unit, equal) in [
            ("V", "W/A"),
            ("ohm", "V/A"),
            ("F", "C/V"),
            ("H", "V*s/A"),
            ("Wb", "N*m/A"),
            ("T", "N/A/m"),
            ("C", "A*s"),
            ("uC", "uA*s"),
            ("nC", "nF*V"),
            ("Ah", "A*h"),
            ("mAh", "mA*h"),
            ("kWh", "kW*h"),
        ] {
            assert_eq!(parse(unit), parse(equal), "{unit}");
        }
        assert_eq!(Dimension::electric(1, 2, -3, -1).to_string(), "voltage [V]");
        assert_eq!(parse("V/kΩ"), parse("mA"));
        assert_eq!(parse("V/A^2/m").unwrap().dimension.si_unit(), "kg*m/s^3/A^3");
        let refused = parse("J/degC").unwrap_err().message;
        assert!(refused.contains("293.15 [K]"), "{refused}");
    }

    #[test]
    fn dimensions_read_as_quantities() {
        assert_eq!(Dimension::of(1, 2, -2).to_string(), "torque or energy [N*m]");
        assert_eq!(Dimension::of(3, 0, -1).to_string(), "[kg^3/s]");
    }
}
