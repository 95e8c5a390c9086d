//! Numbers and formulas as they are written.

use crate::declaration::number;

/// A number without the noise that sums and turns leave in its last digits, for numbers of
/// some size.
pub(super) fn tidy(value: f64, size: f64) -> String {
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "within 0 and 40")]
    let digits = (15.0 - size.max(1e-20).log10().ceil()).clamp(0.0, 40.0) as usize;
    let rounded = format!("{value:.digits$}").parse().unwrap_or(value);
    number(rounded)
}

/// An angle in degrees where that is shorter.
pub(super) fn angle(radians: f64) -> String {
    let (degrees, radians) = (tidy(radians.to_degrees(), 360.0), tidy(radians, 1.0));
    if degrees.len() <= radians.len() { format!("{degrees} [deg]") } else { format!("{radians} [rad]") }
}

/// One more summand, if it is not zero.
pub(super) fn term(value: f64, unit: &str) -> String {
    let size = tidy(value.abs(), 1.0);
    match size.as_str() {
        "0" => String::new(),
        _ if value < 0.0 => format!(" - {size} [{unit}]"),
        _ => format!(" + {size} [{unit}]"),
    }
}

pub(super) fn product(factor: &str, name: &str) -> String {
    match factor {
        "0" => "0".into(),
        "1" => name.into(),
        "-1" => format!("-{name}"),
        _ => format!("{factor}*{name}"),
    }
}

pub(super) fn sum(terms: [(&String, &String); 2]) -> String {
    let products = terms.map(|(factor, name)| product(factor, name));
    products.into_iter().filter(|product| product != "0").collect::<Vec<_>>().join(" + ")
}
