//! The energy of a long run: the double pendulum for 1000 s in steps of 2 ms, by methods that keep
//! it and by methods that do not, and the time of a step. `-- --figure FILE.svg` draws it.
#![allow(clippy::expect_used, reason = "a benchmark ends where it cannot go on")]

use std::env;
use std::process::ExitCode;
use std::time::Instant;

use mbs_runtime::{Held, Heun, Method, Projected, RATTLE, RATTLE4, Rattle, Rk4, Simulation, System};
use mbs_workbench::figure::{Axis, Figure, Panel, Save, Series, Stroke};
use models::DoublePendulum;

const STEP: f64 = 2e-3;
const STEPS: u64 = 500_000;
/// Intervals in which the largest deviation is looked for.
const INTERVALS: u64 = 100;
/// The kinetic energy is 1.6 J at most.
const SCALE: f64 = 1.6;

/// A run and what came of it.
struct Row {
    method: &'static str,
    /// Time in s, and the largest deviation of the energy so far over [`SCALE`].
    deviations: Vec<[f64; 2]>,
    /// ns
    step: f64,
}

fn main() -> ExitCode {
    let is_bench = env::args().any(|argument| argument == "--bench");
    let intervals = if is_bench { INTERVALS } else { 1 };
    let declared = DoublePendulum::declared();
    let rattle =
        |composition| Rattle::builder(declared, STEP).composition(composition).build().expect("a start");
    let rows = [
        row("Heun, feedback", &mut simulation::<Held<Heun>>(), intervals),
        row("RK4, projection", &mut simulation::<Projected<Rk4>>(), intervals),
        row("RATTLE", &mut rattle(&RATTLE), intervals),
        row("RATTLE of order 4", &mut rattle(&RATTLE4), intervals),
    ];
    for Row { method, deviations, step } in &rows {
        let first = deviations.first().map_or(f64::NAN, |[_, deviation]| *deviation);
        let last = deviations.last().map_or(f64::NAN, |[_, deviation]| *deviation);
        println!("{method:20} {first:8.1e} after 10 s, {last:8.1e} at the end, {step:6.0} ns per step");
    }
    // this is the test of the benchmark
    let is_good = rows.iter().all(|row| row.deviations.iter().all(|[_, deviation]| *deviation < 0.1));
    if !is_good {
        return ExitCode::FAILURE;
    }
    if let Some(file) = env::args().skip_while(|argument| argument != "--figure").nth(1) {
        let curves =
            rows.into_iter().map(|row| Series::new(row.method, row.deviations).stroke(Stroke::Solid));
        let axes = [Axis::new("time", "s"), Axis::new("largest error of the energy so far", "").log()];
        let [time, error] = axes;
        let panel = Panel::lines(time, error, curves);
        if let Err(error) = Figure::new("Energy of a double pendulum").panel(panel).save(file.as_ref()) {
            println!("{error}");
            return ExitCode::FAILURE;
        }
    }
    ExitCode::SUCCESS
}

fn simulation<X: Method>() -> Simulation<DoublePendulum, X> {
    Simulation::builder(DoublePendulum::declared(), STEP).method::<X>().build().expect("a start")
}

fn row(method: &'static str, run: &mut impl System, intervals: u64) -> Row {
    let energy = |run: &dyn System| {
        let n = run.equations().info().coordinates.len();
        let (mut q, mut v) = (vec![0.0; n], vec![0.0; n]);
        run.state(&mut q, &mut v);
        let [kinetic, potential] = run.energies(mbs_runtime::equations::At { t: run.time(), q: &q, v: &v });
        kinetic + potential
    };
    let (start, mut largest, mut time) = (energy(run), 0.0_f64, 0.0);
    let mut deviations = Vec::new();
    for _ in 0..intervals {
        // a few hundred looks in an interval see its extremes
        for _ in 0..STEPS / INTERVALS / 10 {
            let clock = Instant::now();
            run.advance(10).expect("a regular motion");
            time += clock.elapsed().as_secs_f64();
            largest = largest.max((energy(run) - start).abs() / SCALE);
        }
        deviations.push([run.time(), largest]);
    }
    Row { method, deviations, step: 1e9 * time / run.steps() as f64 }
}
