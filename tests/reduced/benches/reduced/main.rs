//! Cost of a Heun step with reduced states, against all coordinates in the same run. Timed are a simulation
//! that runs to a time, one whose steps are function calls, and members in lanes, and the step of the driven
//! slider-crank that a person writes. Repetitions take turns, and medians are compared.
#![allow(missing_docs, reason = "a program")]

mod by_hand;

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
    compare(models::SliderCrank::declared(), reduced::SliderCrank::declared(), 0.0, repetitions)?;
    compare_with_hand(repetitions)?;
    compare(models::SliderCrankFree::declared(), reduced::SliderCrankFree::declared(), 0.5, repetitions)?;
    compare(models::DoublePendulum::declared(), reduced::DoublePendulum::declared(), 0.0, repetitions)?;
    compare(models::FourBarFree::declared(), reduced::FourBarFree::declared(), 0.0, repetitions)?;
    compare(models::NPendulum10::declared(), reduced::NPendulum10::declared(), 0.0, repetitions)?;
    compare(models::NPendulum40::declared(), reduced::NPendulum40::declared(), 0.0, repetitions)?;
    Ok(())
}

/// Times of both, by turns.
fn compare<A: Mechanism<Real = f64>, R: Mechanism<Real = f64>>(
    all: A,
    reduced: R,
    input: f64,
    repetitions: usize,
) -> Result<(), Box<dyn Error>> {
    // chains cost more, and so fewer members do; a run's first step, which is examined, costs a hundred others
    let (h, members) = match A::INFO.coordinates.len() {
        0..12 => (H, MEMBERS),
        12..60 => (1e-4, MEMBERS / 8),
        _ => (1e-4, MEMBERS / 64),
    };
    let pool = ThreadPoolBuilder::new().num_threads(1).build()?;
    let (of_all, of_reduced) = (start(all, h, input)?, start(reduced, h, input)?);
    let mut times = [const { Vec::new() }; 6];
    let [all_run, reduced_run, all_called, reduced_called, all_together, reduced_together] = &mut times;
    for _ in 0..repetitions {
        all_run.push(running(of_all, STEPS)?);
        reduced_run.push(running(of_reduced, STEPS)?);
        all_called.push(called(of_all, STEPS)?);
        reduced_called.push(called(of_reduced, STEPS)?);
    }
    // apart from the others: a thread that waits for work looks for it for a while, and may do so on
    // the other half of the same core
    for _ in 0..repetitions {
        all_together.push(pool.install(|| together(of_all, STEPS, members)));
        reduced_together.push(pool.install(|| together(of_reduced, STEPS, members)));
    }
    print!("{:16}", A::INFO.name);
    let [all_run, reduced_run, all_called, reduced_called, all_together, reduced_together] =
        times.map(median);
    let kinds = [
        ("a run", all_run, reduced_run),
        ("by calls", all_called, reduced_called),
        ("a member in lanes", all_together, reduced_together),
    ];
    for (kind, all, reduced) in kinds {
        print!("   {kind} {all:8.1} {reduced:8.1} {:5.2}", reduced / all);
    }
    println!();
    Ok(())
}

/// Times of the driven slider-crank with reduced states and by hand, which end in the same state.
fn compare_with_hand(repetitions: usize) -> Result<(), Box<dyn Error>> {
    let mut generated = start(reduced::SliderCrank::declared(), H, 0.0)?;
    let first = generated;
    let parameters = first.mechanism().parameters();
    let crank = black_box(by_hand::Crank {
        r: parameters.l1,
        l: parameters.l2,
        omega: parameters.omega,
        h: H,
        gains: first.baumgarte().gains(),
    });
    let ([angle], [rate]) = (first.integrated().q.into_array(), first.integrated().v.into_array());
    let found = by_hand::run(&crank, [angle, rate], STEPS);
    for _ in 0..STEPS {
        generated.step()?;
    }
    // 600 steps round some 20 times each, rates of up to 7 rad/s; feedback keeps what came of it small
    let apart = (found[0] - generated.integrated().q.theta2).abs();
    if apart > 1e-11 {
        return Err(format!("by hand the rod ends {apart} rad away").into());
    }
    let mut times = [const { Vec::new() }; 2];
    for _ in 0..repetitions {
        let began = Instant::now();
        black_box(by_hand::run(&crank, black_box([angle, rate]), STEPS));
        times[0].push(began.elapsed().as_secs_f64() * 1e9 / STEPS as f64);
        times[1].push(running(first, STEPS)?);
    }
    let [by_hand, generated] = times.map(median);
    println!(
        "{:16}   a run {by_hand:8.1} {generated:8.1} {:5.2}   by hand, reduced, reduced/by hand",
        "",
        generated / by_hand
    );
    Ok(())
}

/// A run with this value of every input.
fn start<M: Mechanism<Real = f64>>(
    mechanism: M,
    h: f64,
    input: f64,
) -> Result<Simulation<M>, mbs_runtime::Error> {
    Simulation::builder(mechanism, h).inputs(M::Inputs::splat(input)).build()
}

/// ns per step of a simulation that runs to a time.
fn running<M: Mechanism<Real = f64>>(run: Simulation<M>, steps: u64) -> Result<f64, mbs_runtime::Error> {
    let end = run.time() + steps as f64 * run.step_size();
    per_step(run, steps, |run| run.advance_to(end))
}

/// ns per step of a simulation whose steps are function calls, so that its state goes through
/// memory.
fn called<M: Mechanism<Real = f64>>(run: Simulation<M>, steps: u64) -> Result<f64, mbs_runtime::Error> {
    per_step(run, steps, |run| (0..steps).try_for_each(|_| step(run)))
}

#[inline(never)]
fn step<M: Mechanism<Real = f64>>(run: &mut Simulation<M>) -> Result<(), mbs_runtime::Error> {
    run.step()
}

/// ns per step of `advance`, which makes `steps` of them.
fn per_step<M: Mechanism<Real = f64>>(
    run: Simulation<M>,
    steps: u64,
    advance: impl FnOnce(&mut Simulation<M>) -> Result<(), mbs_runtime::Error>,
) -> Result<f64, mbs_runtime::Error> {
    let mut run = black_box(run);
    let start = Instant::now();
    advance(&mut run)?;
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
