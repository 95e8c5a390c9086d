//! Units as they are written: products of powers such as `kg*m/s^2`.

use std::fmt;

use super::{Dimension, Unit, known, lookup, meant};

/// A unit that could not be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnitError {
    /// The fault in words.
    pub message: String,
    /// The name that is no unit, if another name may be meant.
    pub unknown: Option<String>,
}

impl UnitError {
    /// The error for a name that is no unit.
    pub fn unknown(name: &str) -> Self {
        if CELSIUS.contains(&name) {
            let message = format!(
                "`{name}` begins at another zero, so that it is no unit: 20 °C are `293.15 [K]`, and 20 °C more `20 [K]`"
            );
            return Self { message, unknown: None };
        }
        let list: Vec<_> = known().collect();
        let message = format!("unknown unit `{name}`; the units are {}", list.join(", "));
        Self { message, unknown: Some(name.to_owned()) }
    }

    /// The same where a unit of a dimension is expected: no other units are proposed.
    #[must_use]
    pub fn in_place_of(self, expected: Dimension) -> Self {
        let Some(name) = &self.unknown else { return self };
        let fits = |unit: &str| parse(unit).is_ok_and(|unit| unit.dimension == expected);
        let mut fitting: Vec<_> = known().filter(|unit| fits(unit)).map(str::to_owned).collect();
        if fitting.is_empty() {
            fitting.push(expected.si_unit());
        }
        let meant = meant(name).filter(|unit| fits(unit));
        let meant = meant.map(|unit| format!("did you mean `{unit}`? ")).unwrap_or_default();
        let message = format!("unknown unit `{name}`; {meant}a {expected} may be in {}", fitting.join(", "));
        Self { message, ..self }
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
/// `/` applies to the next factor alone, as in `kg*m/s/s`. `Ω` is `ohm`.
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

/// Names of degrees that do not begin at 0 K.
const CELSIUS: &[&str] = &["degC", "°C", "celsius", "Celsius", "degF", "°F"];

fn parse_factor(factor: &str, sign: i32) -> Result<Unit, UnitError> {
    let (name, exponent) = match factor.split_once('^') {
        Some((name, exponent)) => (name.trim_end(), exponent.trim().parse::<i32>().ok()),
        None => (factor, Some(1)),
    };
    let power = |unit: Unit| exponent.and_then(|e| unit.power(sign * e.clamp(-99, 99)));
    // the sign of the unit and the Greek letter
    let ohms = name.replace(['\u{2126}', 'Ω'], "ohm");
    let unit = if name == "1" { Some(Unit::ONE) } else { lookup(&ohms) };
    match unit {
        None => Err(UnitError::unknown(name)),
        Some(unit) => power(unit).ok_or_else(|| UnitError {
            message: format!("`{factor}` needs a small whole number as its exponent"),
            unknown: None,
        }),
    }
}
