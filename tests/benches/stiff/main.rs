//! A slider-crank whose crank pin is a bushing of 10⁹ N/m: the error of its slow motion over the
//! step of TR-BDF2, and what a step takes beside one of Heun's method in the same run.
//! `-- --figure FILE.svg` draws the errors.
#![allow(clippy::expect_used, reason = "a benchmark ends where it cannot go on")]

use std::env;
use std::process::ExitCode;
use std::time::Instant;

use mbs_runtime::{Adaptive, Dop853, Simulation, State, Tolerances, TrBdf2};
use mbs_workbench::figure::{Axis, Figure, Panel, Save, Series, Stroke};
use tests::bushing::{Crank, CrankCoordinates, CrankParameters};

/// N/m and N s/m
const BUSHINGS: [(&str, f64, f64); 2] = [("1e9 N/m", 1e9, 0.0), ("1e7 N/m, 1e3 N s/m", 1e7, 1e3)];
const END: f64 = 0.3;
/// ms
const LENGTHS: [f64; 5] = [2.0, 1.0, 0.5, 0.25, 0.125];
const REPETITIONS: usize = 41;
const STEPS: u32 = 500;

fn main() -> ExitCode {
    let is_bench = env::args().any(|argument| argument == "--bench");
    let mut curves = Vec::new();
    let mut is_good = true;
    for (name, stiffness, damping) in BUSHINGS {
        let parameters = CrankParameters { stiffness, damping, ..*Crank::declared().parameters() };
        let crank = Crank::new(parameters).expect("parameters");
        let mut settling = TrBdf2::builder(crank, 1e-4).build().expect("a start");
        settling.advance_to(1e-2).expect("a regular motion");
        let start = settling.state();
        let theta = reference(crank, start);
        let errors = LENGTHS.map(|h| [h, (stiff(crank, start, 1e-3 * h) - theta).abs()]);
        for [h, error] in errors {
            println!("{name:20} {h:6.3} ms {error:9.1e} rad");
        }
        is_good &= errors.iter().any(|[_, error]| *error < 1e-3);
        curves.push(Series::new(name, errors).stroke(Stroke::Dotted));
    }
    // this is the test of the benchmark
    if !is_good || !is_bench {
        return if is_good { ExitCode::SUCCESS } else { ExitCode::FAILURE };
    }
    let [implicit, heun] = times();
    println!("a step: {implicit:.0} ns, of Heun's method {heun:.0} ns, ratio {:.2}", implicit / heun);
    if let Some(file) = env::args().skip_while(|argument| argument != "--figure").nth(1) {
        let (step, error) =
            (Axis::new("step", "ms").log(), Axis::new("error of the crank after a turn", "rad").log());
        let panel = Panel::lines(step, error, curves);
        if let Err(error) =
            Figure::new("Crank with a stiff bushing, TR-BDF2").panel(panel).save(file.as_ref())
        {
            println!("{error}");
            return ExitCode::FAILURE;
        }
    }
    ExitCode::SUCCESS
}

fn reference(crank: Crank, start: State<CrankCoordinates>) -> f64 {
    let tolerances = Tolerances { rtol: 1e-11, atol: 1e-13, ..Tolerances::default() };
    let builder = Adaptive::builder(crank).scheme::<Dop853>().tolerances(tolerances);
    let mut run = builder.from_state(start).build().expect("a start");
    run.advance_to(start.t + END).expect("a regular motion");
    run.state().q.theta1
}

fn stiff(crank: Crank, start: State<CrankCoordinates>, step: f64) -> f64 {
    let mut run = TrBdf2::builder(crank, step).from_state(start).build().expect("a start");
    run.advance_to(start.t + END).expect("a regular motion");
    run.state().q.theta1
}

/// The medians of the times of a step in ns. A soft bushing, so that Heun's method has a motion.
fn times() -> [f64; 2] {
    let parameters = CrankParameters { stiffness: 1e4, damping: 5.0, ..*Crank::declared().parameters() };
    let crank = Crank::new(parameters).expect("parameters");
    let mut times = [const { Vec::new() }; 2];
    for _ in 0..REPETITIONS {
        let mut run = TrBdf2::builder(crank, 1e-4).build().expect("a start");
        let clock = Instant::now();
        (0..STEPS).for_each(|_| run.step().expect("a regular motion"));
        times[0].push(clock.elapsed().as_secs_f64());
        let mut run = Simulation::new(crank, 1e-4).expect("a start");
        let clock = Instant::now();
        (0..STEPS).for_each(|_| run.step().expect("a regular motion"));
        times[1].push(clock.elapsed().as_secs_f64());
    }
    times.map(|mut times| {
        times.sort_by(f64::total_cmp);
        1e9 * times[times.len() / 2] / f64::from(STEPS)
    })
}
