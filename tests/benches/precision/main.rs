//! Work against precision: the free slider-crank at 200 rpm under a constant torque on the crank
//! for 0.3 s, by every scheme, and by a person's Runge–Kutta method in the angle of the crank, in
//! the same run. `-- --figure FILE.svg` draws it.
#![allow(clippy::expect_used, reason = "a benchmark ends where it cannot go on")]

mod by_hand;
mod programs;

use std::env;
use std::path::Path;
use std::process::ExitCode;
use std::time::Instant;

use mbs_workbench::figure::{Axis, Figure, Panel, Save, Series, Stroke};
use programs::{Program, SAMPLES};

const REPETITIONS: usize = 41;
/// Runs of one timing.
const RUNS: u32 = 20;

fn main() -> ExitCode {
    let programs = programs::all();
    let reference = programs::reference();
    let errors: Vec<f64> = programs.iter().map(|program| program.error(&reference)).collect();
    // the finest run of every method finds the same motion: this is the test of the benchmark
    let is_good = programs::methods().all(|method| {
        let of_method = programs.iter().zip(&errors).filter(|(program, _)| program.method == method);
        let best = of_method.map(|(_, error)| *error).fold(f64::INFINITY, f64::min);
        println!("{method:28} {best:.1e} m at best");
        best < 1e-5
    });
    let arguments: Vec<String> = env::args().collect();
    if !is_good || !arguments.iter().any(|argument| argument == "--bench") {
        return if is_good { ExitCode::SUCCESS } else { ExitCode::FAILURE };
    }
    let times = times(&programs);
    println!("\nlargest error of x3 at {SAMPLES} instants, and µs per run (least, median of {REPETITIONS})");
    for ((program, error), [least, median]) in programs.iter().zip(&errors).zip(&times) {
        println!("{:28} {:10} {error:9.1e} m {least:8.1} {median:8.1} µs", program.method, program.effort);
    }
    let file = arguments.iter().skip_while(|argument| *argument != "--figure").nth(1);
    if let Some(file) = file
        && let Err(error) = draw(&programs, &errors, &times, file.as_ref())
    {
        println!("{error}");
        return ExitCode::FAILURE;
    }
    ExitCode::SUCCESS
}

/// The least and the median time of a run of every program in µs; they take turns.
fn times(programs: &[Program]) -> Vec<[f64; 2]> {
    let mut times = vec![Vec::with_capacity(REPETITIONS); programs.len()];
    for _ in 0..REPETITIONS {
        for (program, times) in programs.iter().zip(&mut times) {
            let start = Instant::now();
            for _ in 0..RUNS {
                (program.run)();
            }
            times.push(start.elapsed().as_secs_f64() * 1e6 / f64::from(RUNS));
        }
    }
    let middle = |times: &mut Vec<f64>| {
        times.sort_by(f64::total_cmp);
        [times[0], times[times.len() / 2]]
    };
    times.iter_mut().map(middle).collect()
}

fn draw(
    programs: &[Program],
    errors: &[f64],
    times: &[[f64; 2]],
    file: &Path,
) -> Result<(), mbs_workbench::Error> {
    let curves = programs::methods().map(|method| {
        let of_method =
            programs.iter().zip(errors).zip(times).filter(|((program, _), _)| program.method == method);
        let points = of_method.map(|((_, error), [least, _])| [*error, *least]);
        // there are more methods than colours
        let stroke = if method == programs::BY_HAND { Stroke::Dashed } else { Stroke::Dotted };
        Series::new(method, points).stroke(stroke)
    });
    let (error, time) = (Axis::new("largest error of x3", "m").log(), Axis::new("time of a run", "µs").log());
    let curves: Vec<Series> = curves.collect();
    Figure::new("Work against precision").panel(Panel::lines(error, time, curves)).save(file)
}
