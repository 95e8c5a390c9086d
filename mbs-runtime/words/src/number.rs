//! Numbers for people: a given number of digits, powers of ten as superscripts.

use std::fmt::Display;

/// `x` with `digits` significant digits: plain from 1e-4 to 1e6, else as
/// `1.53 × 10⁻⁶`. Trailing zeros after the point are dropped.
pub fn significant(x: f64, digits: usize) -> String {
    if !x.is_finite() {
        return x.to_string();
    }
    if x == 0.0 {
        return "0".into();
    }
    let text = format!("{x:.*e}", digits.saturating_sub(1));
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    if (-4..6).contains(&exponent) {
        let places = (digits as i32 - 1 - exponent).max(0) as usize;
        return minus(&trimmed(&format!("{x:.places$}")));
    }
    minus(&format!("{} × 10{}", trimmed(mantissa), superscript(exponent)))
}

/// An integer in superscript digits.
pub fn superscript(n: i32) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let digit = |c: char| c.to_digit(10).and_then(|d| DIGITS.get(d as usize).copied()).unwrap_or('⁻');
    n.to_string().chars().map(digit).collect()
}

/// A count with what it counts: `1 coordinate`, `2 coordinates`.
pub fn counted(count: impl Display, one: &str) -> String {
    let count = count.to_string();
    let plural = if count == "1" { "" } else { "s" };
    format!("{count} {one}{plural}")
}

/// Without trailing zeros after the point.
pub fn trimmed(text: &str) -> String {
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').into() } else { text.into() }
}

/// With a true minus sign.
pub fn minus(text: &str) -> String {
    text.replace('-', "−")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_and_powers() {
        assert_eq!(significant(1.532364545e-6, 4), "1.532 × 10⁻⁶");
        assert_eq!(significant(0.06, 6), "0.06");
        assert_eq!(significant(-3.39346, 5), "−3.3935");
        assert_eq!(significant(2000.0, 4), "2000");
        assert_eq!(significant(999_999.9, 3), "1 × 10⁶");
        assert_eq!(significant(0.0, 3), "0");
        assert_eq!(superscript(-12), "⁻¹²");
    }

    #[test]
    fn one_thing_and_several() {
        assert_eq!([0, 1, 2].map(|n| counted(n, "degree")), ["0 degrees", "1 degree", "2 degrees"]);
    }
}
