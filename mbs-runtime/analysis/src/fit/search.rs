//! From where, over how much of the data and with which weights a minimum is looked for.
//!
//! Far from the values that were measured, an oscillation of the model comes out of step with that of the
//! data, and the sum of squares has a minimum for every period of the difference. Over the beginning of the
//! data it has not: each start is followed over a part of the data first, then over twice as much.

use nalgebra::DVector;

use super::covariance::covariance;
use super::least_squares::{Local, Minimum, Stop, minimize};
use super::problem::Problem;
use super::quantile::two_sided;
use super::{Estimate, Experiment, Fit, Progress, Remainder, Trials};
use crate::Error;

/// Parts of the data over which a start is followed, one after the other, before all of the data.
const PARTS: [f64; 4] = [1.0 / 16.0, 1.0 / 8.0, 1.0 / 4.0, 1.0 / 2.0];
/// A part of the data is used if it has so many samples for every unknown.
const SAMPLES: usize = 4;
const OVER_A_PART: Stop = Stop { iterations: 12, change: 1e-3 };
/// The sum changes by the square of how far x is off, so that x is known to a thousandth of its error.
const OVER_ALL: Stop = Stop { iterations: 60, change: 1e-9 };
/// The largest factor between the given start and another.
const RANGE: f64 = 4.0;
/// Sums of squares that differ by less than this part are those of one minimum.
const EQUAL: f64 = 1e-5;
/// Weights are estimated at most so many times, until they change by less than this part.
const ROUNDS: usize = 20;
const SETTLED: f64 = 1e-3;
/// An unknown with less influence than this on the data has none.
const NOTHING: f64 = 1e-7;
/// A deviation is not estimated below this part of the range of the data: the error of the runs.
const LEAST: f64 = 1e-9;

impl Experiment {
    /// Looks for the values with which the mechanism moves as measured.
    ///
    /// # Errors
    /// [`Error::Unknown`] for a name that the mechanism does not have; [`Error::Sample`],
    /// [`Error::FewSamples`], [`Error::Bounds`], [`Error::Range`] for data and values that cannot be used;
    /// [`Error::Undetermined`] for unknowns that the data do not determine; [`Error::Mechanism`] where no run
    /// from the start comes to the end of the data.
    ///
    /// # Example
    /// A text, with `trials` as in the example of [`Trials`](crate::Trials):
    /// ```
    /// # use mbs_analysis::Experiment;
    /// # use mbs_live::{Prepared, Text};
    /// # use mbs_runtime::equations::Partials;
    /// let text = "Oscillator {
    ///     dof = 1;
    ///     param k = 3 [N/m] where k > 0;
    ///     body block (x) { mass = 1 [kg]; }
    ///     force spring on x = -k*x;
    ///     start { x = 1 [m]; }
    /// }";
    /// # let live = Text::declaration("oscillator.mbs", text).compile()?;
    /// # let over = live.over::<Partials>();
    /// # let trials = |values: &[Partials]| {
    /// #     let live = over.with_parameters(|own| own.copy_from_slice(values))?;
    /// #     Ok(Prepared::new(&live))
    /// # };
    ///
    /// // read from the motion of 4 N/m, cos 2t
    /// let times: Vec<f64> = (0..20).map(|at| 0.1 * f64::from(at)).collect();
    /// let values: Vec<f64> = times.iter().map(|t| (2.0 * t).cos()).collect();
    ///
    /// let fit = Experiment::of(live.declared_info())
    ///     .measured("x", &times, &values)
    ///     .unknown("k", 3.0)
    ///     .fit(&trials)?;
    /// assert!((fit.estimates[0].value - 4.0).abs() < 1e-6 && fit.has_converged);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn fit(&self, trials: &dyn Trials) -> Result<Fit, Error> {
        self.fit_while(trials, &mut |_| true)
    }

    /// Looks for the values as [`fit`](Self::fit) does, as long as `goes_on` returns `true`. It is called after every
    /// run.
    ///
    /// # Errors
    /// As [`fit`](Self::fit); [`Error::Interrupted`].
    ///
    /// # Example
    /// ```
    /// # use mbs_analysis::Experiment;
    /// # use mbs_live::{Prepared, Text};
    /// # use mbs_runtime::equations::Partials;
    /// # let text = "Oscillator {
    /// #     dof = 1;
    /// #     param k = 3 [N/m] where k > 0;
    /// #     body block (x) { mass = 1 [kg]; }
    /// #     force spring on x = -k*x;
    /// #     start { x = 1 [m]; }
    /// # }";
    /// # let live = Text::declaration("oscillator.mbs", text).compile()?;
    /// # let over = live.over::<Partials>();
    /// # let trials = |values: &[Partials]| {
    /// #     let live = over.with_parameters(|own| own.copy_from_slice(values))?;
    /// #     Ok(Prepared::new(&live))
    /// # };
    /// # let times: Vec<f64> = (0..20).map(|at| 0.1 * f64::from(at)).collect();
    /// # let values: Vec<f64> = times.iter().map(|t| (2.0 * t).cos()).collect();
    /// use mbs_analysis::Error;
    ///
    /// // the experiment of `fit`, with no more than one run
    /// let fit = Experiment::of(live.declared_info())
    ///     .measured("x", &times, &values)
    ///     .unknown("k", 3.0)
    ///     .fit_while(&trials, &mut |progress| progress.runs < 1);
    /// assert!(matches!(fit, Err(Error::Interrupted)));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn fit_while(
        &self,
        trials: &dyn Trials,
        goes_on: &mut dyn FnMut(&Progress) -> bool,
    ) -> Result<Fit, Error> {
        fit(self, trials, goes_on)
    }
}

/// Looks for the smallest sum of squares.
fn fit(
    experiment: &Experiment,
    trials: &dyn Trials,
    goes_on: &mut dyn FnMut(&Progress) -> bool,
) -> Result<Fit, Error> {
    let problem = Problem::new(experiment, trials)?;
    let mut search = Search {
        deviations: first_deviations(experiment),
        problem: &problem,
        goes_on,
        start: 0,
        is_over: false,
    };
    let mut best = search.smallest()?;
    for _ in 0..ROUNDS {
        let deviations = estimated(&problem, &best, &search.deviations);
        let ratios = || deviations.iter().zip(&search.deviations).map(|(new, old)| new / old);
        let (low, high) = ratios().fold((f64::INFINITY, 0.0_f64), |(low, high), x| (low.min(x), high.max(x)));
        weigh_anew(&problem, &mut best, &search.deviations, &deviations);
        search.deviations = deviations;
        // a factor that all have moves no minimum
        if high <= low * (1.0 + SETTLED) {
            break;
        }
        let x = best.x.clone();
        best = search.over(x, problem.samples.len(), OVER_ALL).unwrap_or(best);
        if search.is_over {
            return Err(Error::Interrupted);
        }
    }
    finish(&problem, &best, &search.deviations)
}

/// Those that are given, and the range of the data for those that are not.
fn first_deviations(experiment: &Experiment) -> Vec<f64> {
    let ranges = ranges(experiment);
    experiment
        .measured
        .iter()
        .zip(ranges)
        .map(|(measured, range)| measured.deviation.unwrap_or(range))
        .collect()
}

/// The root mean square of the data about their mean, or their size where they are constant.
fn ranges(experiment: &Experiment) -> Vec<f64> {
    let range = |values: &[f64]| {
        let n = values.len().max(1) as f64;
        let mean = values.iter().sum::<f64>() / n;
        let variance = values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / n;
        let found = [variance.sqrt(), mean.abs()].into_iter().find(|size| *size > 0.0);
        found.unwrap_or(1.0)
    };
    experiment.measured.iter().map(|measured| range(&measured.values)).collect()
}

struct Search<'a> {
    problem: &'a Problem<'a>,
    deviations: Vec<f64>,
    goes_on: &'a mut dyn FnMut(&Progress) -> bool,
    start: usize,
    /// True if it was interrupted: nothing is run any more.
    is_over: bool,
}

impl Search<'_> {
    /// The smallest minimum that is found, from starts until two lead to it.
    fn smallest(&mut self) -> Result<Minimum, Error> {
        let mut best: Option<Minimum> = None;
        let mut first_failure = None;
        for start in 0..self.problem.experiment.starts {
            self.start = start;
            let found = self.minimum(start);
            if self.is_over {
                return Err(Error::Interrupted);
            }
            let Some(found) = found else {
                first_failure = first_failure.or(self.problem.failure.borrow_mut().take());
                continue;
            };
            let is_again =
                best.as_ref().is_some_and(|best| (found.cost - best.cost).abs() <= EQUAL * best.cost);
            if best.as_ref().is_none_or(|best| found.cost < best.cost) {
                best = Some(found);
            }
            if is_again {
                break;
            }
        }
        // a run that fails without a reason has a prediction that is not finite
        let undefined = Error::NoPrediction;
        best.ok_or_else(|| first_failure.map_or(undefined, Error::Mechanism))
    }

    fn minimum(&mut self, start: usize) -> Option<Minimum> {
        let problem = self.problem;
        let mut x = problem.guess.clone();
        for (at, (x, [low, high])) in x.iter_mut().zip(&problem.bounds).enumerate() {
            if start > 0 {
                *x = (*x * RANGE.powf(2.0 * halton(start, at) - 1.0)).clamp(*low, *high);
            }
        }
        let all = problem.samples.len();
        for part in PARTS {
            let count = problem.samples_until(part);
            if count >= SAMPLES * x.len() && count < all {
                x = self.over(x.clone(), count, OVER_A_PART).map_or(x, |found| found.x);
            }
        }
        self.over(x, all, OVER_ALL)
    }

    /// The minimum over the first `count` samples. Over a part of them, the values at the start count as
    /// known to 100 %, so that one which that part does not determine does not run away.
    fn over(&mut self, x: DVector<f64>, count: usize, stop: Stop) -> Option<Minimum> {
        let Self { problem, deviations, goes_on, start, is_over } = self;
        let is_part = count < problem.samples.len();
        let ranges = ranges(problem.experiment);
        let from = x.clone();
        let mut local = |x: &DVector<f64>| {
            if *is_over {
                return None;
            }
            let found = problem.predict(x, count);
            let (starts, runs) = (problem.experiment.starts, problem.runs.get());
            *is_over = !goes_on(&Progress { start: *start + 1, starts, runs });
            let mut local = found.map_err(|error| *problem.failure.borrow_mut() = Some(error)).ok()?;
            for (row, sample) in problem.samples.iter().take(count).enumerate() {
                let deviation = deviations[sample.channel];
                local.residuals[row] = (local.residuals[row] - sample.value) / deviation;
                local.jacobian.row_mut(row).unscale_mut(deviation);
            }
            let size = size(problem, count, deviations, &ranges);
            forget_rounding(&mut local, x, &problem.guess, size);
            Some(if is_part { with_prior(local, x, &from) } else { local })
        };
        minimize(&mut local, x, &problem.bounds, stop)
    }
}

/// The size of the data, measured by the deviations.
fn size(problem: &Problem<'_>, count: usize, deviations: &[f64], ranges: &[f64]) -> f64 {
    let samples = problem.samples.iter().take(count);
    samples.map(|sample| (ranges[sample.channel] / deviations[sample.channel]).powi(2)).sum::<f64>().sqrt()
}

/// Derivatives by what changes the data by a part `NOTHING` of their size, if it changes by its own size, are
/// those of the error of the runs: they count as 0.
fn forget_rounding(local: &mut Local, x: &DVector<f64>, guess: &DVector<f64>, size: f64) {
    for ((mut column, x), guess) in local.jacobian.column_iter_mut().zip(x).zip(guess) {
        // a guess of 0 says nothing about the size
        if *guess != 0.0 && column.norm() * x.abs().max(guess.abs()) < NOTHING * size {
            column.fill(0.0);
        }
    }
}

/// With a row (x − x₀)/|x₀| for each unknown.
fn with_prior(local: Local, x: &DVector<f64>, from: &DVector<f64>) -> Local {
    let (count, unknowns) = local.jacobian.shape();
    let mut residuals = local.residuals.insert_rows(count, unknowns, 0.0);
    let mut jacobian = local.jacobian.insert_rows(count, unknowns, 0.0);
    for at in 0..unknowns {
        let size = from[at].abs();
        if size > 0.0 {
            residuals[count + at] = (x[at] - from[at]) / size;
            jacobian[(count + at, at)] = 1.0 / size;
        }
    }
    Local { residuals, jacobian }
}

/// A number of Halton's sequence between 0 and 1, in the prime base of a dimension.
fn halton(mut index: usize, dimension: usize) -> f64 {
    let is_prime = |n: &usize| (2..*n).take_while(|d| d * d <= *n).all(|d| !n.is_multiple_of(d));
    let base = (2..).filter(is_prime).nth(dimension).unwrap_or(2);
    let (mut number, mut digit) = (0.0, 1.0);
    while index > 0 {
        digit /= base as f64;
        number += digit * (index % base) as f64;
        index /= base;
    }
    number
}

/// The standard deviations of what is left over, where none are given: each quantity bears its share of the
/// degrees of freedom that the estimates take.
fn estimated(problem: &Problem<'_>, best: &Minimum, deviations: &[f64]) -> Vec<f64> {
    let measured = &problem.experiment.measured;
    let share = 1.0 - best.x.len() as f64 / problem.samples.len() as f64;
    let mut squares = vec![0.0; measured.len()];
    for (sample, residual) in problem.samples.iter().zip(&best.local.residuals) {
        squares[sample.channel] += residual * residual;
    }
    let least = ranges(problem.experiment);
    let all = measured.iter().zip(deviations).zip(squares.iter().zip(least));
    all.map(|((measured, old), (square, range))| {
        let freedom = measured.values.len() as f64 * share;
        measured.deviation.unwrap_or((old * (square / freedom).sqrt()).max(LEAST * range))
    })
    .collect()
}

/// Residuals and derivatives with other weights.
fn weigh_anew(problem: &Problem<'_>, best: &mut Minimum, old: &[f64], new: &[f64]) {
    for (row, sample) in problem.samples.iter().enumerate() {
        let ratio = old[sample.channel] / new[sample.channel];
        best.local.residuals[row] *= ratio;
        best.local.jacobian.row_mut(row).scale_mut(ratio);
    }
    best.cost = 0.5 * best.local.residuals.norm_squared();
}

fn finish(problem: &Problem<'_>, best: &Minimum, deviations: &[f64]) -> Result<Fit, Error> {
    let experiment = problem.experiment;
    let is_at_bound = |at: usize| {
        let ([low, high], x) = (problem.bounds[at], best.x[at]);
        x <= low || x >= high
    };
    let free: Vec<usize> = (0..best.x.len()).filter(|at| !is_at_bound(*at)).collect();
    let covariance = covariance(experiment, best, &free)?;
    let estimated = experiment.measured.iter().filter(|measured| measured.deviation.is_none());
    let samples: usize = estimated.map(|measured| measured.values.len()).sum();
    let all = problem.samples.len();
    // those that the estimated deviations have
    let freedom = samples as f64 * (1.0 - best.x.len() as f64 / all as f64);
    let coverage = two_sided(experiment.confidence, (samples > 0).then_some(freedom as u64));
    let estimate = |(at, unknown): (usize, &super::Unknown)| {
        let (value, standard_error) = (best.x[at], covariance[(at, at)].sqrt());
        let reach = coverage * standard_error;
        Estimate {
            name: unknown.name.clone(),
            guess: problem.guess[at],
            value,
            standard_error,
            interval: [value - reach, value + reach],
            is_at_bound: is_at_bound(at),
        }
    };
    let remainder = |channel: usize| {
        let measured = &experiment.measured[channel];
        let rows = problem.samples.iter().zip(&best.local.residuals);
        let own = rows.filter(|(sample, _)| sample.channel == channel);
        let residuals: Vec<f64> = own.map(|(_, residual)| -residual * deviations[channel]).collect();
        let predicted = measured.values.iter().zip(&residuals).map(|(value, r)| value - r).collect();
        let is_estimated = measured.deviation.is_none();
        Remainder { predicted, residuals, deviation: deviations[channel], is_estimated }
    };
    Ok(Fit {
        estimates: experiment.unknown.iter().enumerate().map(estimate).collect(),
        remainders: (0..experiment.measured.len()).map(remainder).collect(),
        chi_squared: 2.0 * best.cost,
        freedom: all - best.x.len(),
        has_converged: best.has_converged,
        runs: problem.runs.get(),
        confidence: experiment.confidence,
        coverage,
        covariance,
    })
}
