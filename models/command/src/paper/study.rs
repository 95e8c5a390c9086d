//! Every run that the paper's figures and tables need, computed once.

use mbs_runtime::{Error, Explicit};
use mbs_workbench::sweep;

use super::crank::{Crank, HELD, PER_STAGE};
use super::setup::{Inertia, SPEEDS, STEP, Setup, TURN, Trace};

/// Points of the sweep over α and over β.
const SWEEP: usize = 73;

/// One point of a sweep.
pub type Point = (f64, Result<f64, Error>);

/// All runs.
pub struct Study {
    /// The mechanism.
    pub crank: Crank,
    /// No feedback, the paper's start, 0.15 s (Figures 4–7).
    pub drift: Trace,
    /// No feedback, consistent start, one turn.
    pub drift_consistent: Trace,
    /// α = β = 2000, the paper's start, one turn (Figures 8–10 and 13).
    pub stabilized: Trace,
    /// The same, consistent start.
    pub stabilized_consistent: Trace,
    /// Deadbeat held feedback, consistent start, one turn.
    pub held: Trace,
    /// The values of α and β of Figure 11.
    pub gains: Vec<f64>,
    /// max ‖Φ‖ over (α, β), all α for the first β first (Figure 11).
    pub map: Vec<Result<f64, Error>>,
    /// max ‖Φ‖ over β at α = 2000, beyond the paper's range (Figure 12).
    pub along_beta: Vec<Point>,
    /// max ‖Φ‖ over α at β = 2000, beyond the paper's range.
    pub along_alpha: Vec<Point>,
    /// The paper's torque runs, one per speed (Figure 14, Table 3).
    pub torque: Vec<Trace>,
    /// Clean torque with held feedback and J = m l²/12, one per speed.
    pub clean: Vec<Trace>,
    /// Torque runs with each kind of feedback at 200 rpm, J = m l²/12, over two turns.
    pub feedbacks: Vec<FeedbackRun>,
}

/// A torque run with one of the feedbacks that are compared.
pub struct FeedbackRun {
    /// Its name in the keys of the results.
    pub key: &'static str,
    /// Its name for people.
    pub name: &'static str,
    /// The run.
    pub trace: Trace,
}

/// Computes everything; shows progress on the terminal.
///
/// # Errors
/// An error that keeps a run from starting. Runs that end early are results, not errors.
pub fn study(crank: Crank) -> Result<Study, Error> {
    let none = Setup::gains(0.0, 0.0);
    let paper = Setup::gains(2000.0, 2000.0);
    let deadbeat = Setup::gains(0.75 / STEP, 1.0 / STEP).consistent();

    let gains = sweep::evenly(200.0, 2000.0, SWEEP);
    let grid: Vec<_> = gains.iter().flat_map(|&beta| gains.iter().map(move |&alpha| (alpha, beta))).collect();
    let map = crank.max_violations("Figure 11: α and β", &grid);
    let wide = sweep::evenly(200.0, 3000.0, 113);
    let along = |title: &str, point: fn(f64) -> (f64, f64)| -> Vec<Point> {
        let points: Vec<_> = wide.iter().copied().map(point).collect();
        wide.iter().copied().zip(crank.max_violations(title, &points)).collect()
    };
    let along_beta = along("Figure 12: β", |beta| (2000.0, beta));
    let along_alpha = along("α beyond 2000", |alpha| (alpha, 2000.0));

    let torque = |setup: Setup, inertia: Inertia, method: Explicit| {
        let runs = sweep::map("torque", &SPEEDS, |&rpm| setup.torque(rpm, inertia).trace(&crank, method));
        runs.into_iter().collect::<Result<Vec<_>, _>>()
    };
    Ok(Study {
        drift: Setup { end: 0.15, ..none }.trace(&crank, PER_STAGE)?,
        drift_consistent: none.consistent().trace(&crank, PER_STAGE)?,
        stabilized: paper.trace(&crank, PER_STAGE)?,
        stabilized_consistent: paper.consistent().trace(&crank, PER_STAGE)?,
        held: deadbeat.trace(&crank, HELD)?,
        gains,
        map,
        along_beta,
        along_alpha,
        torque: torque(Setup::gains(1000.0, 1000.0), Inertia::Paper, PER_STAGE)?,
        clean: torque(deadbeat, Inertia::Rod, HELD)?,
        feedbacks: feedbacks(&crank)?,
        crank,
    })
}

fn feedbacks(crank: &Crank) -> Result<Vec<FeedbackRun>, Error> {
    let root2 = std::f64::consts::SQRT_2;
    let cases = [
        ("per_stage.a2000", "both stages, αh = βh = 1 (paper)", 1.0, 1.0, PER_STAGE),
        ("per_stage.a2000_sqrt2", "both stages, αh = 1, βh = √2", 1.0, root2, PER_STAGE),
        ("per_stage.a1000", "both stages, αh = βh = ½", 0.5, 0.5, PER_STAGE),
        ("held.a1500", "held, αh = ¾, βh = 1", 0.75, 1.0, HELD),
        ("none", "none", 0.0, 0.0, HELD),
    ];
    let run = |(key, name, alpha_h, beta_h, method): (&'static str, &'static str, f64, f64, Explicit)| {
        let setup = Setup { end: 2.0 * TURN, ..Setup::gains(alpha_h / STEP, beta_h / STEP) }.consistent();
        Ok(FeedbackRun { key, name, trace: setup.trace(crank, method)? })
    };
    cases.into_iter().map(run).collect()
}
