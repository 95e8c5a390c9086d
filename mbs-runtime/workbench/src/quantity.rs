//! Values with units, as people type them: `300rpm`, `70 mm`, `0.5N*m`.

use mbs_runtime::{Dimension, Quantity};
use mbs_symbolic::units;

use crate::{Error, Unit};

pub(crate) const TIME: Dimension = Dimension::of(0, 0, 1);

/// Reads a value of the given dimension and returns it in SI units.
///
/// A bare number is taken to be in SI units. `what` names the value in messages.
///
/// # Errors
/// [`Error::Value`] if it is no finite number or its unit is unknown,
/// [`Error::Dimension`] if the unit is one of something else.
///
/// # Example
/// ```
/// use mbs_runtime::Dimension;
/// use mbs_workbench::quantity;
///
/// let length = Dimension::of(0, 1, 0);
/// assert_eq!(quantity::parse("l1", "70 mm", length)?, 0.07);
/// assert_eq!(quantity::parse("l1", "0.07", length)?, 0.07);
/// assert!(quantity::parse("l1", "300rpm", length).is_err());
/// # Ok::<(), mbs_workbench::Error>(())
/// ```
pub fn parse(what: &str, text: &str, dimension: Dimension) -> Result<f64, Error> {
    parse_in(what, text, dimension, &Unit::si(dimension))
}

/// Reads a value of a parameter or an input and returns it in SI units.
///
/// A bare number is taken to be in the [unit](Unit::of) in which the quantity is shown
/// everywhere else. A quantity that is declared without any unit takes bare numbers only.
///
/// # Errors
/// As [`parse`].
///
/// # Example
/// ```
/// use mbs_workbench::quantity;
///
/// mbs_runtime::mechanism! {
///     pub Bumper {
///         dof = 1;
///         param k = 60 [N/mm];
///         body buffer (x) { mass = 1 [kg]; }
///         spring s (buffer, ground) { stiffness = k; length = 0.1 [m]; }
///         start { x = 0.2 [m]; }
///     }
/// }
///
/// let k = &<Bumper as mbs_runtime::Mechanism>::INFO.parameters[0];
/// assert_eq!(quantity::parse_as(k, "80")?, 80e3);
/// assert_eq!(quantity::parse_as(k, "80 N/m")?, 80.0);
/// # Ok::<(), mbs_workbench::Error>(())
/// ```
pub fn parse_as(quantity: &Quantity, text: &str) -> Result<f64, Error> {
    parse_in(quantity.name, text, quantity.dimension, &Unit::of(quantity))
}

/// Reads a value whose bare numbers are in a `usual` unit, and returns it in SI units.
///
/// # Errors
/// As [`parse`].
pub fn parse_in(what: &str, text: &str, dimension: Dimension, usual: &Unit) -> Result<f64, Error> {
    let wrong = |reason: String| Error::Value { what: what.into(), text: text.into(), reason };
    // the sign as this program prints it
    let signed = text.trim().replacen('\u{2212}', "-", 1);
    let (number, unit) = split_number(&signed)
        .ok_or_else(|| wrong("that is not a number, or a number with a unit such as 300rpm".into()))?;
    if !number.is_finite() {
        return Err(wrong("it has to be finite".into()));
    }
    let unit = unit.trim();
    let finite = |si: f64| if si.is_finite() { Ok(si) } else { Err(wrong("it has to be finite".into())) };
    if unit.is_empty() {
        return finite(usual.read(number));
    }
    if usual.name().is_empty() {
        return Err(wrong(format!("{what} is a number without a unit; write {number}")));
    }
    let expected = units::Dimension::from_exponents(dimension.exponents());
    // `5/s` is 5 1/s
    let unit = if unit.starts_with('/') { format!("1{unit}") } else { unit.to_owned() };
    let unit = units::parse(&unit).map_err(|error| wrong(error.in_place_of(expected).to_string()))?;
    if unit.dimension != expected {
        return Err(Error::Dimension {
            what: what.into(),
            text: text.into(),
            expected: expected.to_string(),
            found: unit.dimension.to_string(),
        });
    }
    finite(number * unit.scale.to_f64())
}

/// The longest prefix that is a number, and the rest.
fn split_number(text: &str) -> Option<(f64, &str)> {
    let ends = text.char_indices().map(|(at, c)| at + c.len_utf8()).rev();
    ends.filter_map(|end| {
        let (head, tail) = text.split_at(end);
        // `1 m` must not be split inside a word: "inf" and "nan" are numbers, "in" of `inch` is not.
        let whole_word =
            !head.ends_with(char::is_alphabetic) || !tail.starts_with(|c: char| c.is_alphanumeric());
        Some((head.parse().ok().filter(|_| whole_word)?, tail))
    })
    .next()
}

/// Reads a setting `name=value` into its two parts.
///
/// # Errors
/// [`Error::Setting`].
pub fn split_setting(text: &str) -> Result<(&str, &str), Error> {
    match text.split_once('=') {
        Some((name, value)) if !name.trim().is_empty() => Ok((name.trim(), value.trim())),
        _ => Err(Error::Setting { text: text.into() }),
    }
}

/// The SI unit of a dimension as text: `N*m`, `kg^2/s`; empty for a bare number.
pub fn si_unit(dimension: Dimension) -> String {
    units::Dimension::from_exponents(dimension.exponents()).si_unit()
}

#[cfg(test)]
mod tests {
    use super::*;

    const fn dimension(mass: i8, length: i8, time: i8) -> Dimension {
        Dimension::of(mass, length, time)
    }

    #[test]
    fn values_with_and_without_units() {
        let rate = dimension(0, 0, -1);
        let rpm = std::f64::consts::PI / 30.0;
        assert_eq!(parse("omega", "300rpm", rate).unwrap(), 300.0 * rpm);
        assert_eq!(parse("omega", "-1.5e2 rpm", rate).unwrap(), -150.0 * rpm);
        assert_eq!(parse("omega", "20rad/s", rate).unwrap(), 20.0);
        assert_eq!(parse("tau", "0.5N*m", dimension(1, 2, -2)).unwrap(), 0.5);
        assert_eq!(parse("step", "0.5ms", dimension(0, 0, 1)).unwrap(), 0.5e-3);
        assert_eq!(parse("k", "3", dimension(0, 0, 0)).unwrap(), 3.0);
        assert_eq!(parse("l", "2inch", dimension(0, 1, 0)).unwrap(), 0.0508);
        assert_eq!(parse("l", "2in", dimension(0, 1, 0)).unwrap(), 0.0508);
    }

    /// `--set k=60` was 60 N/m although the list shows N/mm.
    #[test]
    fn a_bare_number_has_the_declared_unit() {
        let declared =
            |unit, scale, dimension| Quantity { name: "k", doc: "", unit, scale, dimension, default: 0.0 };
        let stiffness = declared("N/mm", 1e3, dimension(1, 0, -2));
        assert_eq!(parse_as(&stiffness, "60").unwrap(), 60e3);
        assert_eq!(parse_as(&stiffness, "60 N/m").unwrap(), 60.0);
        let angle = declared("deg", std::f64::consts::PI / 180.0, dimension(0, 0, 0));
        assert_eq!(parse_as(&angle, "180").unwrap(), std::f64::consts::PI);
        assert_eq!(parse_as(&angle, "180°").unwrap(), std::f64::consts::PI);
        assert_eq!(parse_as(&angle, "1 rad").unwrap(), 1.0);
        let derived = declared("", 1.0, dimension(0, 1, 0));
        assert_eq!(parse_as(&derived, "0.5").unwrap(), 0.5);
        assert_eq!(parse_as(&derived, "5 mm").unwrap(), 5e-3);
        let ratio = declared("", 1.0, dimension(0, 0, 0));
        assert_eq!(parse_as(&ratio, "0.3").unwrap(), 0.3);
        let refused = parse_as(&ratio, "30deg").unwrap_err().to_string();
        assert_eq!(refused, "k = `30deg`: k is a number without a unit; write 30");
    }

    #[test]
    fn nonsense_is_explained() {
        let message = |text| parse("l1", text, dimension(0, 1, 0)).unwrap_err().to_string();
        assert_eq!(message("300rpm"), "l1 = `300rpm`: a rate [1/s] was given, but l1 is a length [m]");
        assert!(message("7 furlong").contains("unknown unit `furlong`"));
        assert!(message("NaN").contains("has to be finite"));
        assert!(message("inf").contains("has to be finite"));
        assert!(message("mm").contains("not a number"));
        assert!(message("").contains("not a number"));
        assert!(split_setting("l1").is_err() && split_setting("=3").is_err());
    }

    #[test]
    fn si_units_of_dimensions() {
        assert_eq!(si_unit(dimension(0, 0, 0)), "");
        assert_eq!(si_unit(dimension(0, 1, -1)), "m/s");
        assert_eq!(si_unit(dimension(1, 2, 0)), "kg*m^2");
        assert_eq!(si_unit(dimension(0, 0, -2)), "1/s^2");
        assert_eq!(si_unit(dimension(1, 2, -1)), "N*m*s");
        assert_eq!(si_unit(dimension(1, 0, -1)), "N*s/m");
        assert_eq!(si_unit(dimension(1, 2, -2)), "N*m");
    }
}
