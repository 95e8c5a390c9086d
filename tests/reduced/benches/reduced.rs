//! What a Heun step costs with reduced states, against all coordinates in the same run: one
//! simulation, and members in lanes. Repetitions take turns, and medians are compared.
#![allow(missing_docs, reason = "a program")]

use std::error::Error;
use std::hint::black_box;
use std::time::Instant;

use mbs_ensemble::Ensemble;
use mbs_runtime::{Components, Mechanism, Simulation};
use rayon::ThreadPoolBuilder;

const H: f64 = 0.5e-3;
const STEPS: u64 = 600;
const REPETITIONS: usize = 101;
const MEMBERS: usize = 512;

fn main() -> Result<(), Box<dyn Error>> {
    let is_bench = std::env::args().any(|argument| argument == "--bench");
    // `cargo test --benches` only looks whether it runs
    let repetitions = if is_bench { REPETITIONS } else { 1 };
    println!("ns per Heun step, medians of {repetitions} interleaved repetitions: all, reduced, reduced/all");
    let (torque, none) = (|_: &str| 0.5, |_: &str| 0.0);
    compare(
        "driven slider-crank",
        models::SliderCrank::declared(),
        reduced::SliderCrank::declared(),
        none,
        repetitions,
    )?;
    compare(
        "free slider-crank",
        models::SliderCrankFree::declared(),
        reduced::SliderCrankFree::declared(),
        torque,
        repetitions,
    )?;
    compare(
        "double pendulum",
        models::DoublePendulum::declared(),
        reduced::DoublePendulum::declared(),
        none,
        repetitions,
    )?;
    compare(
        "free four-bar",
        models::FourBarFree::declared(),
        reduced::FourBarFree::declared(),
        none,
        repetitions,
    )?;
    compare(
        "pendulum of 10",
        models::NPendulum10::declared(),
        reduced::NPendulum10::declared(),
        none,
        repetitions,
    )?;
    compare(
        "pendulum of 40",
        models::NPendulum40::declared(),
        reduced::NPendulum40::declared(),
        none,
        repetitions,
    )?;
    Ok(())
}

/// Times of both, by turns.
fn compare<A: Mechanism<Real = f64>, R: Mechanism<Real = f64>>(
    name: &str,
    all: A,
    reduced: R,
    input: impl Fn(&str) -> f64 + Copy,
    repetitions: usize,
) -> Result<(), Box<dyn Error>> {
    // chains cost more, and so fewer steps last as long
    let (h, steps, members) = match A::INFO.coordinates.len() {
        0..12 => (H, STEPS, MEMBERS),
        12..60 => (1e-4, STEPS / 4, MEMBERS / 8),
        _ => (1e-4, STEPS / 16, MEMBERS / 32),
    };
    let pool = ThreadPoolBuilder::new().num_threads(1).build()?;
    let (of_all, of_reduced) = (start(all, h, input)?, start(reduced, h, input)?);
    let mut times = [const { Vec::new() }; 4];
    for _ in 0..repetitions {
        let measured = [
            alone(of_all, steps)?,
            alone(of_reduced, steps)?,
            pool.install(|| together(of_all, steps, members)),
            pool.install(|| together(of_reduced, steps, members)),
        ];
        times.iter_mut().zip(measured).for_each(|(times, time)| times.push(time));
    }
    let [all, reduced, all_in_lanes, reduced_in_lanes] = times.map(median);
    println!(
        "{name:20} alone {all:8.1} {reduced:8.1} {:5.2}   a member in lanes {all_in_lanes:8.1} {reduced_in_lanes:8.1} {:5.2}",
        reduced / all,
        reduced_in_lanes / all_in_lanes
    );
    Ok(())
}

fn start<M: Mechanism<Real = f64>>(
    mechanism: M,
    h: f64,
    input: impl Fn(&str) -> f64,
) -> Result<Simulation<M>, mbs_runtime::Error> {
    let mut inputs = M::Inputs::default().into_array();
    for (value, name) in inputs.as_mut().iter_mut().zip(M::Inputs::NAMES) {
        *value = input(name);
    }
    Simulation::builder(mechanism, h).inputs(M::Inputs::from_array(inputs)).build()
}

/// ns per step of a simulation.
fn alone<M: Mechanism<Real = f64>>(run: Simulation<M>, steps: u64) -> Result<f64, mbs_runtime::Error> {
    let mut run = black_box(run);
    let start = Instant::now();
    for _ in 0..steps {
        run.step()?;
    }
    black_box(run.integrated());
    Ok(start.elapsed().as_secs_f64() * 1e9 / steps as f64)
}

/// ns per step of a member in lanes.
fn together<M: Mechanism<Real = f64>>(run: Simulation<M>, steps: u64, members: usize) -> f64 {
    let end = run.time() + steps as f64 * run.step_size();
    let start = Instant::now();
    let outcomes = black_box(Ensemble::new(end).run(members, |_| Ok(black_box(run)), &()));
    assert!(outcomes.is_ok(), "nobody ends an ensemble");
    start.elapsed().as_secs_f64() * 1e9 / (steps as f64 * members as f64)
}

fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}
