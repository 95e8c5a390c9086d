//! Numbers of a reference case against ours.

use std::fmt;

use mbs_runtime::Error;

/// By how much tolerances are wider than in double precision.
#[derive(Clone, Copy)]
pub(crate) struct Widening {
    pub of_truncation: f64,
    pub of_rounding: f64,
}

impl Widening {
    pub const NONE: Self = Self { of_truncation: 1.0, of_rounding: 1.0 };
}

/// Collects the deviations of a case; [`Case::finish`] fails if one is too large.
pub struct Case {
    name: String,
    widening: Widening,
    compared: usize,
    failures: Vec<String>,
    /// Largest deviation as a fraction of its tolerance, and where.
    worst: (f64, String),
}

impl Case {
    /// Nothing is compared yet.
    pub fn new(name: &str) -> Self {
        Self::widened(name, Widening::NONE)
    }

    pub(crate) fn widened(name: &str, widening: Widening) -> Self {
        let name = name.to_owned();
        Self { name, widening, compared: 0, failures: Vec::new(), worst: (0.0, String::new()) }
    }

    /// `ours` lies within `tolerance` of `reference`.
    pub fn near(&mut self, what: impl fmt::Display, ours: f64, reference: f64, tolerance: f64) {
        self.near_within(what, ours, reference, tolerance, 0.0);
    }

    /// `ours` lies within what truncation and what rounding may make of `reference`.
    pub fn near_within(
        &mut self,
        what: impl fmt::Display,
        ours: f64,
        reference: f64,
        truncation: f64,
        rounding: f64,
    ) {
        self.compared += 1;
        let Widening { of_truncation, of_rounding } = self.widening;
        let tolerance = truncation * of_truncation + rounding * of_rounding;
        let deviation = (ours - reference).abs();
        let message =
            format!("{what}: {ours} against {reference}, off by {deviation:.1e} of {tolerance:.0e}");
        // Written so that a NaN fails.
        let is_near = deviation <= tolerance;
        if deviation / tolerance >= self.worst.0 {
            self.worst = (deviation / tolerance, message.clone());
        }
        if !is_near {
            self.failures.push(message);
        }
    }

    /// Several values that share a tolerance.
    pub fn all_near<const N: usize>(
        &mut self,
        names: [&str; N],
        at: impl fmt::Display,
        ours: [f64; N],
        reference: [f64; N],
        tolerances: [f64; N],
    ) {
        for k in 0..N {
            self.near(format_args!("{} at {at}", names[k]), ours[k], reference[k], tolerances[k]);
        }
    }

    /// Tells the largest deviation.
    ///
    /// # Panics
    /// If a number deviates, or none was compared.
    pub fn finish(self) {
        let Self { name, compared, failures, worst, .. } = self;
        println!("{name}: {compared} numbers, the worst is {}", worst.1);
        assert!(compared > 0, "{name}: nothing was compared");
        assert!(failures.is_empty(), "{name}:\n  {}", failures.join("\n  "));
    }
}

/// Where `value` changes sign between `low` and `high`.
///
/// # Errors
/// Those of `value`.
pub fn bisect(
    mut low: f64,
    mut high: f64,
    mut value: impl FnMut(f64) -> Result<f64, Error>,
) -> Result<f64, Error> {
    let sign = value(low)?.signum();
    for _ in 0..60 {
        let middle = f64::midpoint(low, high);
        if value(middle)?.signum() == sign { low = middle } else { high = middle }
    }
    Ok(high)
}
