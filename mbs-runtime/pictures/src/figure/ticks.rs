//! Where the ticks of an axis are and what they say.

use mbs_words::number::{minus, superscript, trimmed};

/// The ticks of an axis.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Ticks {
    /// Positions with their labels.
    pub(super) major: Vec<(f64, String)>,
    /// Positions without labels.
    pub(super) minor: Vec<f64>,
    /// A power of ten by which all labels are to be multiplied; 0 for none.
    pub(super) exponent: i32,
}

/// About `count` ticks at 1, 2 or 5 times a power of ten within `low … high`.
///
/// Where numbers are very small or large a common power of ten is taken out,
/// so that no label reads 0.00000012 or 0.
pub(super) fn linear(low: f64, high: f64, count: usize) -> Ticks {
    let span = high - low;
    if !(span > 0.0 && span.is_finite()) {
        return Ticks::default();
    }
    let rough = span / count.max(1) as f64;
    let power = 10_f64.powf(rough.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0].iter().map(|f| f * power).find(|s| *s >= 0.75 * rough).unwrap_or(rough);
    let largest = low.abs().max(high.abs());
    let magnitude = largest.log10().floor() as i32;
    let exponent = if (-3..5).contains(&magnitude) { 0 } else { 3 * magnitude.div_euclid(3) };
    let unit = 10_f64.powi(exponent);
    let places = (-(step / unit).log10()).ceil().clamp(0.0, 12.0) as usize;

    let first = (low / step - 1e-9).ceil() as i64;
    let last = (high / step + 1e-9).floor() as i64;
    let label = |at: f64| minus(&format!("{at:.places$}")).replacen("−0", "0", usize::from(at == 0.0));
    let major = (first..=last).map(|k| (k as f64 * step, label(k as f64 * step / unit))).collect();
    Ticks { major, minor: Vec::new(), exponent }
}

/// About `count` ticks at multiples of `unit`, or of a half, a third or a sixth of it.
pub(super) fn multiples(low: f64, high: f64, count: usize, unit: f64) -> Ticks {
    let rough = (high - low) / count.max(1) as f64;
    let parts = [1.0 / 6.0, 1.0 / 3.0, 0.5, 1.0].map(|part| part * unit);
    let whole = (rough / unit).ceil() * unit;
    let step = parts.into_iter().find(|step| *step >= 0.9 * rough).unwrap_or(whole);
    if !(step > 0.0 && step.is_finite()) {
        return Ticks::default();
    }
    let (first, last) = ((low / step - 1e-9).ceil() as i64, (high / step + 1e-9).floor() as i64);
    let at = |k: i64| k as f64 * step;
    let label = |k: i64| minus(&trimmed(&format!("{:.6}", at(k))));
    Ticks { major: (first..=last).map(|k| (at(k), label(k))).collect(), minor: Vec::new(), exponent: 0 }
}

/// Ticks of a logarithmic axis: a label per decade, or at 1, 2 and 5 where
/// fewer than two decades are shown; unlabelled ticks in between.
pub(super) fn logarithmic(low: f64, high: f64) -> Ticks {
    if !(low > 0.0 && high > low && high.is_finite()) {
        return Ticks::default();
    }
    let decades = high.log10() - low.log10();
    let labelled: &[u32] = if decades < 2.2 { &[1, 2, 5] } else { &[1] };
    let stride = (decades / 9.0).ceil().max(1.0) as i32;
    let mut ticks = Ticks::default();
    for exponent in low.log10().floor() as i32..=high.log10().ceil() as i32 {
        for mantissa in 1..10_u32 {
            let at = f64::from(mantissa) * 10_f64.powi(exponent);
            if at < low * (1.0 - 1e-9) || at > high * (1.0 + 1e-9) {
                continue;
            }
            if labelled.contains(&mantissa) && exponent.rem_euclid(stride) == 0 {
                ticks.major.push((at, log_label(mantissa, exponent)));
            } else if stride == 1 || mantissa == 1 {
                ticks.minor.push(at);
            }
        }
    }
    ticks
}

fn log_label(mantissa: u32, exponent: i32) -> String {
    if (-2..4).contains(&exponent) {
        let places = (-exponent).max(0) as usize;
        return trimmed(&format!("{:.places$}", f64::from(mantissa) * 10_f64.powi(exponent)));
    }
    match mantissa {
        1 => format!("10{}", superscript(exponent)),
        m => format!("{m}·10{}", superscript(exponent)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(ticks: &Ticks) -> Vec<&str> {
        ticks.major.iter().map(|(_, label)| label.as_str()).collect()
    }

    #[test]
    fn angles_have_ticks_at_parts_of_a_quarter_of_a_turn() {
        assert_eq!(labels(&multiples(-190.0, 10.0, 5, 90.0)), ["−180", "−135", "−90", "−45", "0"]);
        assert_eq!(labels(&multiples(-360.0, 0.0, 4, 90.0)), ["−360", "−270", "−180", "−90", "0"]);
        assert_eq!(labels(&multiples(-720.0, 0.0, 4, 90.0)), ["−720", "−540", "−360", "−180", "0"]);
        assert_eq!(labels(&multiples(-31.0, 1.0, 4, 90.0)), ["−30", "−15", "0"]);
    }

    #[test]
    fn small_numbers_share_a_power_of_ten() {
        let ticks = linear(0.0, 1.6e-6, 5);
        assert_eq!(ticks.exponent, -6);
        assert_eq!(labels(&ticks), ["0.0", "0.5", "1.0", "1.5"]);
        let ticks = linear(-0.34, 0.34, 5);
        assert_eq!((ticks.exponent, labels(&ticks)), (0, vec!["−0.2", "0.0", "0.2"]));
        assert_eq!(labels(&linear(0.0, 0.3, 6)), ["0.00", "0.05", "0.10", "0.15", "0.20", "0.25", "0.30"]);
        assert_eq!(linear(1.0, 1.0, 5), Ticks::default());
    }

    #[test]
    fn decades() {
        assert_eq!(labels(&logarithmic(1e-6, 1e-3)), ["10⁻⁶", "10⁻⁵", "10⁻⁴", "10⁻³"]);
        assert_eq!(labels(&logarithmic(1.2e-6, 3e-5)), ["2·10⁻⁶", "5·10⁻⁶", "10⁻⁵", "2·10⁻⁵"]);
        assert_eq!(labels(&logarithmic(0.5, 100.0)), ["1", "10", "100"]);
    }
}
