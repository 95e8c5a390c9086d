//! Cost of derivatives: a run of the free slider-crank with 1, 4 and 8 partial derivatives against the run
//! itself, of the type and of its text, in the same process; and ten derivatives in reverse.
//! `-- --figure FILE.svg` draws how the slider's position depends on the parameters.
#![allow(clippy::expect_used, reason = "a benchmark ends where it cannot go on")]

mod reverse;

use std::env;
use std::path::Path;
use std::process::ExitCode;
use std::time::Instant;

use mbs_live::{Live, Run, Text};
use mbs_runtime::{Components, Dual, Mechanism, Real, Simulation, System};
use mbs_workbench::figure::{Axis, Figure, Panel, Save, Series};
use models::{SliderCrankFree, SliderCrankFreeInputs};

const STEPS: u64 = 600;
const H: f64 = 0.5e-3;
const TORQUE: f64 = 0.5;
const REPETITIONS: usize = 101;

/// A run of some scalar, of the type or of the text, and its x3 at the end.
struct Program {
    name: &'static str,
    partials: usize,
    run: Box<dyn Fn() -> f64>,
}

fn main() -> ExitCode {
    let text = include_str!("../../../models/src/slider_crank_free.rs");
    let live = Text::rust("slider_crank_free.rs", text).compile().expect("a mechanism of the library");
    let programs = [
        typed("type", 0, SliderCrankFree::declared()),
        typed("type", 1, seeded::<1>()),
        typed("type", 4, seeded::<4>()),
        typed("type", 8, seeded::<8>()),
        of_text(0, &live, |_: &mut [f64]| {}),
        of_text(1, &live, seed::<1>),
        of_text(4, &live, seed::<4>),
        of_text(8, &live, seed::<8>),
    ];
    // values do not depend on the derivatives beside them: this is the test of the benchmark
    let ends: Vec<f64> = programs.iter().map(|program| (program.run)()).collect();
    if ends.iter().any(|end| end.to_bits() != ends[0].to_bits()) {
        println!("the runs end apart: {ends:?}");
        return ExitCode::FAILURE;
    }
    let text = Text::rust("slider_crank_free.rs", text);
    let reverse = reverse::Reverse::of(&text.compile_with_transposes().expect("a mechanism of the library"));
    if !reverse.is_forward() {
        println!("derivatives in reverse are not those of dual numbers");
        return ExitCode::FAILURE;
    }
    let arguments: Vec<String> = env::args().collect();
    if !arguments.iter().any(|argument| argument == "--bench") {
        return ExitCode::SUCCESS;
    }
    print(&programs);
    reverse.print();
    let file = arguments.iter().skip_while(|argument| *argument != "--figure").nth(1);
    match file.map(|file| draw(file.as_ref())) {
        Some(Err(error)) => {
            println!("{error}");
            ExitCode::FAILURE
        }
        _ => ExitCode::SUCCESS,
    }
}

/// Every parameter is a variable, as many of them as there are partials.
fn seed<const N: usize>(parameters: &mut [Dual<f64, N>]) {
    for (at, parameter) in parameters.iter_mut().enumerate() {
        *parameter = Dual::variable(parameter.value, at);
    }
}

fn seeded<const N: usize>() -> SliderCrankFree<Dual<f64, N>> {
    let declared = SliderCrankFree::declared();
    let mut parameters =
        declared.parameters().over::<<SliderCrankFree<_> as Mechanism>::Parameters>().into_array();
    seed(&mut parameters);
    SliderCrankFree::new(Components::from_array(parameters)).expect("declared parameters")
}

fn typed<T: Real>(name: &'static str, partials: usize, mechanism: SliderCrankFree<T>) -> Program {
    let inputs = SliderCrankFreeInputs { crank_torque: T::from_f64(TORQUE) };
    let start = Simulation::builder(mechanism, H).inputs(inputs).build().expect("a start");
    let run = move || {
        let mut run = start;
        for _ in 0..STEPS {
            run.step().expect("a regular motion");
        }
        std::hint::black_box(run.state()).q.x3.to_f64()
    };
    Program { name, partials, run: Box::new(run) }
}

fn of_text<T: Real>(partials: usize, live: &Live, change: fn(&mut [T])) -> Program {
    let builder = Run::builder(live, H).over(change).expect("declared parameters");
    // made anew each time, which is a small part of a run
    let mechanism = builder.build().expect("a start").mechanism().clone();
    let run = move || {
        let inputs = [T::from_f64(TORQUE)];
        let mut run = Run::builder(&mechanism, H).inputs(&inputs).build().expect("a start");
        run.advance(STEPS).expect("a regular motion");
        std::hint::black_box(run.q())[6].to_f64()
    };
    Program { name: "text", partials, run: Box::new(run) }
}

/// Least and median times, in turns.
fn print(programs: &[Program]) {
    let mut times = vec![Vec::with_capacity(REPETITIONS); programs.len()];
    for _ in 0..REPETITIONS {
        for (program, times) in programs.iter().zip(&mut times) {
            let start = Instant::now();
            (program.run)();
            times.push(start.elapsed().as_secs_f64() * 1e6);
        }
    }
    println!("µs of {STEPS} steps (least, median of {REPETITIONS}); the least over that without derivatives");
    let mut alone = f64::NAN;
    for (program, times) in programs.iter().zip(&mut times) {
        times.sort_by(f64::total_cmp);
        let (least, median) = (times[0], times[REPETITIONS / 2]);
        alone = if program.partials == 0 { least } else { alone };
        let ratio = least / alone;
        let each = if program.partials > 0 { (ratio - 1.0) / program.partials as f64 } else { 0.0 };
        println!(
            "{:5} {} partials {least:8.1} {median:8.1} µs, {ratio:5.2} times, {each:5.2} per partial",
            program.name, program.partials
        );
    }
}

/// p ∂x₃/∂p along the run, of the lengths and masses.
fn draw(file: &Path) -> Result<(), mbs_workbench::Error> {
    let names = ["crank length", "rod length", "crank mass", "rod mass", "slider mass"];
    let mechanism = seeded::<8>();
    let inputs = SliderCrankFreeInputs { crank_torque: Dual::constant(TORQUE) };
    let mut run = Simulation::builder(mechanism, H).inputs(inputs).build().expect("a start");
    let mut points = vec![Vec::new(); names.len()];
    for step in 0..=STEPS {
        if step > 0 {
            run.step().expect("a regular motion");
        }
        for (points, (at, parameter)) in
            points.iter_mut().zip(mechanism.parameters().into_array().into_iter().enumerate())
        {
            let change = 0.01 * parameter.value * run.state().q.x3.partials[at];
            points.push([1e3 * run.time().value, 1e3 * change]);
        }
    }
    let curves = names.into_iter().zip(points).map(|(name, points)| Series::new(name, points));
    let (t, change) = (Axis::new("t", "ms"), Axis::new("change of x3 by 1 % of a parameter", "mm"));
    Figure::new("Sensitivities of the free slider-crank")
        .panel(Panel::lines(t, change, curves.collect::<Vec<_>>()))
        .save(file)
}
