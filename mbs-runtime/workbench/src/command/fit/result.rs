//! Results of a fit: as tables, for scripts, as columns and as a picture.

use mbs_analysis::{Estimate, Fit, Measurement, Remainder};
use mbs_runtime::Info;
use serde_json::{Value, json};

use super::request::Request;
use crate::command::json::number;
use crate::console::Warnings;
use crate::figure::axis;
use crate::figure::{Figure, Panel, Series, Stroke};
use crate::names::some_of;
use crate::number::significant;
use crate::{Column, Table, Unit};

/// A parameter is in doubt if its standard error is more than this part of it.
const UNCERTAIN: f64 = 0.5;
/// Residuals are in doubt if their autocorrelation is more than so many of its standard errors.
const DEPENDENT: f64 = 4.0;
/// Residuals up to this share of the largest value are those of exact data: the error of runs and the digits of a file.
const EXACT: f64 = 1e-6;
/// Given deviations are in doubt if χ² is off its mean by more than so many standard deviations of χ².
const UNLIKELY: f64 = 5.0;
/// Estimates with a larger correlation can hardly be told from each other.
const CORRELATED: f64 = 0.95;

/// A fit and what was asked.
pub(super) struct Shown<'a> {
    pub name: &'a str,
    pub info: &'static Info,
    pub request: &'a Request,
    pub fit: &'a Fit,
}

impl Shown<'_> {
    fn estimates(&self) -> impl Iterator<Item = (&Estimate, &Unit)> {
        self.fit.estimates.iter().zip(&self.request.units)
    }

    fn channels(&self) -> impl Iterator<Item = (&Measurement, &Remainder, &Unit)> {
        let data = &self.request.data;
        let channels = data.measured.iter().zip(&self.fit.remainders).zip(&data.units);
        channels.map(|((measured, remainder), unit)| (measured, remainder, unit))
    }

    fn percent(&self) -> String {
        format!("{} %", significant(100.0 * self.fit.confidence, 4))
    }

    /// Estimates, columns, and what there is to say of both.
    pub fn tables(&self) -> String {
        let interval = format!("{} interval", self.percent());
        let mut found = Table::new([self.name, "fitted", "± standard error", &interval, "from"]);
        for (estimate, unit) in self.estimates() {
            let text = |value: f64| unit.text(value, digits(value, estimate.standard_error));
            let (error, interval) = if estimate.is_at_bound {
                ("at its bound".into(), String::new())
            } else {
                let [low, high] = estimate.interval;
                (unit.text(estimate.standard_error, 2), format!("{} … {}", text(low), text(high)))
            };
            found.row([
                estimate.name.clone(),
                text(estimate.value),
                error,
                interval,
                unit.text(estimate.guess, 4),
            ]);
        }
        let mut data = Table::new(["compared", "samples", "σ of the noise", ""]);
        for (measured, remainder, unit) in self.channels() {
            let origin = if remainder.is_estimated { "estimated" } else { "given" };
            let sigma = unit.text(remainder.deviation, 3);
            data.row([measured.name.clone(), measured.values.len().to_string(), sigma, origin.into()]);
        }
        format!("{found}\n{data}{}", self.notes())
    }

    fn notes(&self) -> String {
        let Fit { freedom, coverage, runs, chi_squared, .. } = self.fit;
        let is_estimated = self.fit.remainders.iter().any(|remainder| remainder.is_estimated);
        let distribution = if is_estimated { "Student's t" } else { "the normal distribution" };
        let mut notes = format!(
            "\nintervals of ±{} standard errors by {distribution}, {freedom} degrees of freedom; {runs} runs\n",
            significant(*coverage, 4)
        );
        if !is_estimated {
            notes += &format!("χ² = {} for {freedom} degrees of freedom\n", significant(*chi_squared, 4));
        }
        for (a, first) in self.fit.estimates.iter().enumerate() {
            for (b, second) in self.fit.estimates.iter().enumerate().skip(a + 1) {
                let correlation = self.fit.correlation(a, b);
                if correlation.abs() > CORRELATED {
                    let correlation = significant(correlation, 3);
                    notes += &format!("correlation of {} and {}: {correlation}\n", first.name, second.name);
                }
            }
        }
        let unused = &self.request.data.unused;
        if !unused.is_empty() {
            notes += &format!("columns not used: {}\n", some_of(unused));
        }
        if let Some(start) = self.request.start_time() {
            notes += &format!("the data begin at {start} s on a clock of their own, and so does the run\n");
        }
        notes
    }

    /// Why the result is in doubt.
    pub fn warnings(&self) -> Warnings {
        let mut warnings = Warnings::new();
        if !self.fit.has_converged {
            warnings.push("the sum of squares was still falling at the last iteration; begin nearer".into());
        }
        for (estimate, unit) in self.estimates() {
            let Estimate { name, value, standard_error, is_at_bound, .. } = estimate;
            let is_parameter = self.info.parameters.iter().any(|parameter| parameter.name == *name);
            if *is_at_bound {
                let value = unit.text(*value, 4);
                warnings.push(format!(
                    "`{name}` ended at its bound {value}; the other intervals take it for known"
                ));
            } else if is_parameter && *standard_error > UNCERTAIN * value.abs() {
                let part = significant(100.0 * standard_error / value.abs(), 2);
                warnings.push(format!(
                    "the data hardly determine `{name}`: its standard error is {part} % of it"
                ));
            }
        }
        let is_estimated = self.fit.remainders.iter().any(|remainder| remainder.is_estimated);
        let (chi_squared, freedom) = (self.fit.chi_squared, self.fit.freedom as f64);
        if !is_estimated && (chi_squared - freedom).abs() > UNLIKELY * (2.0 * freedom).sqrt() {
            let ratio = significant((chi_squared / freedom).sqrt(), 2);
            warnings.push(format!(
                "what is left over is {ratio} times as large as the given standard deviations"
            ));
        }
        for (measured, remainder, _) in self.channels() {
            let correlation = remainder.autocorrelation();
            let largest = measured.values.iter().fold(0.0_f64, |largest, value| largest.max(value.abs()));
            let is_exact = remainder.residuals.iter().all(|left| left.abs() <= EXACT * largest);
            if !is_exact && correlation.abs() * (measured.values.len() as f64).sqrt() > DEPENDENT {
                let (name, correlation) = (&measured.name, significant(correlation, 2));
                warnings.push(format!(
                    "what is left over of `{name}` is not independent noise (correlation of neighbours \
                     {correlation}): the mechanism lacks something, or the noise is filtered; intervals are too short"
                ));
            }
        }
        warnings
    }

    /// For scripts.
    pub fn json(&self) -> Value {
        let estimate = |(at, (estimate, unit)): (usize, (&Estimate, &Unit))| {
            let shown = |value: f64| number(unit.shown(value));
            json!({
                "name": estimate.name,
                "unit": unit.name(),
                "value": shown(estimate.value),
                "standard_error": shown(estimate.standard_error),
                "interval": estimate.interval.map(shown),
                "guess": shown(estimate.guess),
                "at_bound": estimate.is_at_bound,
                "correlations": (0..self.fit.estimates.len())
                    .map(|other| number(self.fit.correlation(at, other))).collect::<Vec<_>>(),
            })
        };
        let channel = |(measured, remainder, unit): (&Measurement, &Remainder, &Unit)| {
            json!({
                "name": measured.name,
                "unit": unit.name(),
                "samples": measured.values.len(),
                "standard_deviation": number(unit.shown(remainder.deviation)),
                "estimated": remainder.is_estimated,
                "autocorrelation": number(remainder.autocorrelation()),
            })
        };
        json!({
            "mechanism": self.name,
            "estimates": self.estimates().enumerate().map(estimate).collect::<Vec<_>>(),
            "columns": self.channels().map(channel).collect::<Vec<_>>(),
            "unused": self.request.data.unused,
            "start_time": self.request.start_time(),
            "confidence": self.fit.confidence,
            "chi_squared": number(self.fit.chi_squared),
            "degrees_of_freedom": self.fit.freedom,
            "converged": self.fit.has_converged,
            "runs": self.fit.runs,
            "warnings": self.warnings(),
        })
    }

    /// Time, data, fitted motion and residuals of each column, below each other where they have other times.
    pub fn columns(&self) -> Vec<Column> {
        let mut columns = Vec::new();
        let mut last: &[f64] = &[];
        for (measured, remainder, unit) in self.channels() {
            if measured.times != last {
                let time = if columns.is_empty() { "t".to_owned() } else { format!("t({})", measured.name) };
                columns.push(Column { values: measured.times.clone(), ..Column::new(time, "s") });
                last = &measured.times;
            }
            for (name, values) in [
                (measured.name.clone(), &measured.values),
                (format!("fitted({})", measured.name), &remainder.predicted),
                (format!("residual({})", measured.name), &remainder.residuals),
            ] {
                let values = values.iter().map(|value| unit.shown(*value)).collect();
                columns.push(Column { values, ..Column::new(name, unit.name()) });
            }
        }
        columns
    }

    /// For each column the data with the fitted motion, and what is left over.
    pub fn figure(&self) -> Figure {
        let mut figure = Figure::new(format!("{}: fitted", self.name)).panel_height(280);
        for (measured, remainder, unit) in self.channels() {
            let points = |values: &[f64]| -> Vec<[f64; 2]> {
                measured.times.iter().zip(values).map(|(t, value)| [*t, unit.shown(*value)]).collect()
            };
            let data = Series::new("measured", points(&measured.values)).stroke(Stroke::Points);
            let fitted = Series::new("fitted", points(&remainder.predicted));
            figure = figure.panel(Panel::lines(
                axis("time", "s"),
                axis(&measured.name, unit.name()),
                [data, fitted],
            ));
            let left = Series::new("", points(&remainder.residuals)).stroke(Stroke::Points);
            let name = format!("residual of {}", measured.name);
            figure = figure.panel(Panel::lines(axis("time", "s"), axis(&name, unit.name()), [left]));
        }
        figure
    }
}

/// As many digits of a value as its error leaves, and one more.
fn digits(value: f64, error: f64) -> usize {
    if error > 0.0 && value != 0.0 {
        ((value / error).abs().log10().floor() + 3.0).clamp(2.0, 12.0) as usize
    } else {
        6
    }
}
