//! Identification: values with which a mechanism moves as measured.
//!
//! # How it works
//!
//! * `experiment` has the measurements and the question.
//! * `trials` makes runs over duals of any `Dynamics`. `problem` takes the motion at the instants of the
//!   samples from them, with its derivatives.
//! * `search` chooses starts, parts of the data and weights.
//! * `least_squares` is Levenberg and Marquardt's method. It knows no mechanism.
//! * `covariance` tells how well the data determine the result.

mod covariance;
mod experiment;
mod least_squares;
mod problem;
mod quantile;
mod search;
mod trials;

pub use experiment::{Experiment, Measurement, Unknown, clock_of};
use nalgebra::DMatrix;
pub use trials::{Look, See, Trial, Trials, trials_of_type};

/// The result of fitting an [`Experiment`]. See the example of [`Experiment::fit`].
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// The estimates, in the order of the unknowns.
    pub estimates: Vec<Estimate>,
    /// The covariance of the estimates, in SI units; without those that ended at a bound, whose rows are 0.
    pub covariance: DMatrix<f64>,
    /// The remainder of each measured quantity.
    pub remainders: Vec<Remainder>,
    /// Σ (r/σ)² over all samples, with the deviations σ of the remainders.
    pub chi_squared: f64,
    /// The number of samples minus the number of unknowns.
    pub freedom: usize,
    /// True if the iteration converged, false if it reached its limit.
    pub has_converged: bool,
    /// The number of runs.
    pub runs: usize,
    /// The probability with which an interval contains the true value.
    pub confidence: f64,
    /// The number of standard errors that an interval reaches to each side: by Student's distribution where a
    /// deviation was estimated, by the normal one where all were given.
    pub coverage: f64,
}

/// A value that was found, in SI units. See the example of [`Experiment`].
#[derive(Clone, Debug, PartialEq)]
pub struct Estimate {
    /// The name of the unknown.
    pub name: String,
    /// The value from which the search began.
    pub guess: f64,
    /// The estimated value.
    pub value: f64,
    /// Its standard deviation, to first order; 0 at a bound.
    pub standard_error: f64,
    /// The interval that contains the true value with the probability [`Fit::confidence`].
    pub interval: [f64; 2],
    /// True if it ended at one of its bounds. The intervals of the others are then those of a mechanism in which it is
    /// known.
    pub is_at_bound: bool,
}

/// The residuals of a measured quantity, in SI units. See the example of
/// [`autocorrelation`](Remainder::autocorrelation).
#[derive(Clone, Debug, PartialEq)]
pub struct Remainder {
    /// The values of the fitted mechanism at the instants of the samples.
    pub predicted: Vec<f64>,
    /// Measured less predicted.
    pub residuals: Vec<f64>,
    /// The standard deviation σ of the noise, given or estimated.
    pub deviation: f64,
    /// True if it was estimated.
    pub is_estimated: bool,
}

/// The progress of a fit; see [`Experiment::fit_while`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// The number of the start, from 1 on.
    pub start: usize,
    /// The largest number of starts.
    pub starts: usize,
    /// The number of runs so far.
    pub runs: usize,
}

impl Fit {
    /// The correlation of two estimates, between −1 and 1; 0 where one ended at a bound.
    ///
    /// # Example
    /// A text, with `trials` as in the example of [`Trials`](crate::Trials):
    /// ```
    /// # use mbs_analysis::Experiment;
    /// # use mbs_live::{Prepared, Text};
    /// # use mbs_runtime::equations::Partials;
    /// let text = "Puck {
    ///     dof = 1;
    ///     body puck (x) { mass = 1 [kg]; }
    ///     start { x = 0; der(x) = 0; }
    /// }";
    /// # let live = Text::declaration("puck.mbs", text).compile()?;
    /// # let over = live.over::<Partials>();
    /// # let trials = |values: &[Partials]| {
    /// #     let live = over.with_parameters(|own| own.copy_from_slice(values))?;
    /// #     Ok(Prepared::new(&live))
    /// # };
    ///
    /// let (times, ways) = ([0.0, 1.0, 2.0, 3.0], [1.01, 2.99, 4.99, 7.01]);
    /// let fit = Experiment::of(live.declared_info())
    ///     .measured("x", &times, &ways)
    ///     .unknown("x", 0.5)
    ///     .unknown("der(x)", 1.0)
    ///     .fit(&trials)?;
    /// // of a straight line x₀ + v t it is −(mean of t)/√(mean of t²)
    /// assert!((fit.correlation(0, 1) + 1.5 / f64::sqrt(3.5)).abs() < 1e-6);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn correlation(&self, a: usize, b: usize) -> f64 {
        let variance = |at: usize| self.covariance.get((at, at)).copied().unwrap_or(0.0);
        let size = (variance(a) * variance(b)).sqrt();
        let shared = self.covariance.get((a, b)).copied().unwrap_or(0.0);
        if size > 0.0 { shared / size } else { 0.0 }
    }
}

impl Remainder {
    /// The correlation of each residual with the next one: about 0 ± 1/√n for independent noise, near 1 where
    /// the mechanism does not move as measured.
    ///
    /// # Example
    /// ```
    /// use mbs_analysis::Remainder;
    ///
    /// let of = |residuals: &[f64]| Remainder {
    ///     predicted: vec![0.0; residuals.len()],
    ///     residuals: residuals.to_vec(),
    ///     deviation: 1.0,
    ///     is_estimated: true,
    /// };
    /// // Σ rᵢ rᵢ₊₁ / Σ rᵢ²
    /// assert_eq!(of(&[1.0, 1.0, 1.0, 1.0]).autocorrelation(), 0.75);
    /// assert_eq!(of(&[1.0, -1.0, 1.0, -1.0]).autocorrelation(), -0.75);
    /// ```
    pub fn autocorrelation(&self) -> f64 {
        let all = &self.residuals;
        let square: f64 = all.iter().map(|r| r * r).sum();
        let product: f64 = all.iter().zip(all.iter().skip(1)).map(|(a, b)| a * b).sum();
        if square > 0.0 { product / square } else { 0.0 }
    }
}
