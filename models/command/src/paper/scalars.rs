//! The scalar results, each under the key that `--json` gives it.

use std::collections::BTreeMap;

use mbs_runtime::Error;
use serde_json::Value;

use super::setup::{Inertia, SPEEDS, Setup, Trace};
use super::study::Study;
use super::torque;

/// Key to value, or to the error that ended the run.
#[derive(Clone, Debug, Default)]
pub struct Scalars(BTreeMap<String, Result<f64, Error>>);

impl Scalars {
    fn set(&mut self, key: impl Into<String>, value: impl Into<Result<f64, Error>>) {
        self.0.insert(key.into(), value.into());
    }

    /// The value under a key, which is there if it was computed.
    pub fn get(&self, key: &str) -> Option<Result<f64, Error>> {
        self.0.get(key).copied()
    }

    /// The value under a key; NaN where there is none.
    pub fn number(&self, key: &str) -> f64 {
        self.get(key).and_then(Result::ok).unwrap_or(f64::NAN)
    }

    /// Flat JSON: numbers at full precision, errors as strings that begin with `error:`.
    pub fn json(&self) -> String {
        let value = |value: &Result<f64, Error>| match value {
            // A number that is not finite has no form in JSON.
            Ok(x) => serde_json::Number::from_f64(*x)
                .map_or_else(|| Value::String(format!("error: {x}")), Value::Number),
            Err(error) => Value::String(format!("error: {error}")),
        };
        let map = self.0.iter().map(|(key, v)| (key.clone(), value(v))).collect();
        format!("{:#}\n", Value::Object(map))
    }
}

/// All scalar results of a study.
pub fn scalars(study: &Study) -> Scalars {
    let mut s = Scalars::default();
    stability(study, &mut s);
    gains(study, &mut s);
    torques(study, &mut s);
    feedbacks(study, &mut s);
    s
}

/// Figures 4–10 and 13.
fn stability(study: &Study, s: &mut Scalars) {
    let drift = &study.drift;
    let [.., theta2, x3] = &drift.q;
    let crossing = x3.iter().zip(&drift.t).find(|(x3, _)| **x3 < 0.0).map(|(_, t)| *t);
    s.set("fig6.x3_zero_crossing_s", crossing.ok_or(Error::EndTime { end: 0.15, now: 0.15 }));
    let at_50_ms = theta2.iter().zip(&drift.t).find(|(_, t)| **t >= 0.05).map(|(theta2, _)| *theta2);
    s.set("fig4.theta2_at_50ms", at_50_ms.ok_or(Error::EndTime { end: 0.05, now: 0.0 }));
    // How the run ends: the position becomes singular, which is an error and no number.
    s.set("fig4.end_s", drift.ended.map_or_else(|| drift.largest(&drift.t), Err));
    s.set("drift.consistent.max_phi", study.drift_consistent.largest(&study.drift_consistent.phi));

    for (name, run) in [("", &study.stabilized), ("consistent.", &study.stabilized_consistent)] {
        s.set(format!("fig8.{name}max_phi"), run.largest(&run.phi));
        s.set(format!("fig10.{name}max_rel_x3"), run.largest(&run.relative_x3));
        s.set(format!("fig8.{name}max_phi_at_s"), time_of_largest(run, &run.phi));
        s.set(format!("fig10.{name}max_rel_x3_at_s"), time_of_largest(run, &run.relative_x3));
    }
    let run = &study.held;
    s.set("held.consistent.max_phi", run.largest(&run.phi));
    s.set("held.consistent.max_rel_x3", run.largest(&run.relative_x3));
    let [.., theta2, x3] = &study.stabilized_consistent.q;
    let ranged = |column: &[f64], sign: f64| {
        let signed: Vec<_> = column.iter().map(|x| sign * x).collect();
        study.stabilized_consistent.largest(&signed).map(|x| sign * x)
    };
    s.set("fig13.theta2_max", ranged(theta2, 1.0));
    s.set("fig13.theta2_min", ranged(theta2, -1.0));
    s.set("fig13.x3_max", ranged(x3, 1.0));
    s.set("fig13.x3_min", ranged(x3, -1.0));
}

/// When a column is largest.
fn time_of_largest(run: &Trace, column: &[f64]) -> Result<f64, Error> {
    let largest = run.largest(column)?;
    let at = column.iter().zip(&run.t).find(|(value, _)| **value == largest);
    Ok(at.map_or(f64::NAN, |(_, t)| *t))
}

/// Figures 11 and 12: max ‖Φ‖ over one turn from the paper's start.
fn gains(study: &Study, s: &mut Scalars) {
    let along_alpha = [200, 500, 1000, 1500, 2000, 2100, 2200, 2500, 3000];
    let along_beta = [200, 500, 1000, 1500, 1800, 2000];
    let points = along_alpha.map(|alpha| (format!("fig11.beta2000.alpha{alpha}"), f64::from(alpha), 2000.0));
    let mut points = points.to_vec();
    points.extend(along_beta.map(|beta| (format!("fig12.alpha2000.beta{beta}"), 2000.0, f64::from(beta))));
    points.push(("deadbeat.per_stage.max_phi".into(), 2000.0, 2000.0 * std::f64::consts::SQRT_2));
    let gains: Vec<_> = points.iter().map(|(_, alpha, beta)| (*alpha, *beta)).collect();
    for ((key, ..), violation) in points.into_iter().zip(study.crank.max_violations("gains", &gains)) {
        s.set(key, violation);
    }
}

/// Figure 14 and Table 3.
fn torques(study: &Study, s: &mut Scalars) {
    let runs = study.torque.iter().zip(&study.clean);
    for (rpm, (run, clean)) in SPEEDS.iter().zip(runs) {
        s.set(format!("table3.{rpm}rpm"), run.steady_peak(&run.raw_torque));
        s.set(format!("torque.clean.ml2_12.{rpm}rpm"), clean.steady_peak(&clean.clean_torque));
        for inertia in [Inertia::Paper, Inertia::Rod] {
            let parameters = Setup::gains(0.0, 0.0).torque(*rpm, inertia).parameters(&study.crank);
            s.set(format!("torque.closed_form.{}.{rpm}rpm", inertia.key()), Ok(torque::peak(&parameters)));
        }
        for (at, instant) in ["t0", "t1"].into_iter().enumerate() {
            let value = run.raw_torque.get(at).copied().ok_or(Error::EndTime { end: 0.0, now: 0.0 });
            s.set(format!("fig14.spike.{instant}.{rpm}rpm"), value);
        }
    }
}

/// Torques and violations under each kind of feedback, which the paper does not have.
fn feedbacks(study: &Study, s: &mut Scalars) {
    for run in &study.feedbacks {
        let trace = &run.trace;
        let key = |what: &str| format!("feedback.{}.{what}", run.key);
        s.set(key("raw_torque"), trace.steady_peak(&trace.raw_torque));
        s.set(key("clean_torque"), trace.steady_peak(&trace.clean_torque));
        s.set(key("max_phi"), trace.steady_peak(&trace.phi));
        s.set(key("max_phi_dot"), trace.steady_peak(&trace.phi_dot));
        if run.key == "per_stage.a2000" {
            s.set("torque.raw_per_stage.ml2_12.200rpm.a2000", trace.steady_peak(&trace.raw_torque));
        }
    }
}
