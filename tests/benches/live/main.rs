//! The time that a declaration takes from text to the first step, and the time of a step by
//! interpretation against the compiled one, alone and in lanes, in turns in one run.
#![allow(
    clippy::expect_used,
    clippy::panic,
    dead_code,
    reason = "a benchmark of declarations that tests share"
)]

#[path = "../../tests/agreement/declarations.rs"]
mod declarations;

use std::hint::black_box;
use std::process::ExitCode;
use std::time::Instant;

use declarations::*;
use mbs_ensemble::{Ensemble, Extremes};
use mbs_live::{LANES, Live, Pack, Run, Text};
use mbs_runtime::equations::Equations;
use mbs_runtime::{Components, Mechanism, Simulation, System};

const STEPS: u32 = 600;
const MEMBERS: usize = 1024;

/// The least and the median of times in s.
fn summary(mut times: Vec<f64>) -> [f64; 2] {
    times.sort_by(f64::total_cmp);
    [times[0], times[times.len() / 2]]
}

fn timed<T>(work: impl FnOnce() -> T) -> (f64, T) {
    let start = Instant::now();
    let result = black_box(work());
    (start.elapsed().as_secs_f64(), result)
}

fn compiled(text: &str) -> Live {
    Text::declaration("mechanism.mbs", text).compile().unwrap_or_else(|error| panic!("{error}"))
}

fn numbers<C: Components<Real = f64>>(components: C) -> Vec<f64> {
    components.into_array().as_ref().to_vec()
}

fn inputs<C: Components<Real = f64>>(value: f64) -> C {
    C::splat(value)
}

/// From a text to the time after the first step.
fn first_step(text: &str) -> f64 {
    let mut run = Run::builder(&compiled(text), 1e-4).build().expect("a start");
    run.step().expect("a step");
    run.time()
}

fn text_to_first_step(name: &str, text: &str, repetitions: usize) {
    let times = (0..repetitions).map(|_| timed(|| first_step(text)).0).collect();
    let [least, median] = summary(times);
    println!("{name:24} from text to first step: {:8.2} / {:8.2} ms", least * 1e3, median * 1e3);
}

/// One state: the compiled step against the interpreted one; `false` if they differ.
fn alone<M: Mechanism<Real = f64>>(
    name: &str,
    text: &str,
    input: f64,
    h: f64,
    steps: u32,
    rounds: usize,
) -> bool {
    let mechanism = M::new(M::Parameters::default()).expect("declared parameters");
    let run = Simulation::builder(mechanism, h).inputs(inputs(input)).build().expect("a start");
    let live = compiled(text);
    let inputs = vec![input; live.info().inputs.len()];
    let mut times = [Vec::new(), Vec::new()];
    let mut ends = [Vec::new(), Vec::new()];
    for _ in 0..rounds {
        let (time, end) = timed(|| {
            let mut run = black_box(run);
            for _ in 0..steps {
                run.step().expect("a step");
            }
            numbers(run.state().q)
        });
        times[0].push(time * 1e9 / f64::from(steps));
        ends[0] = end.clone();
        let mut run = Run::builder(&live, h).inputs(&inputs).build().expect("a start");
        let (time, end) = timed(|| {
            run.advance(steps.into()).expect("steps");
            let (mut q, mut v) = (vec![0.0; end.len()], vec![0.0; end.len()]);
            run.state(&mut q, &mut v);
            q
        });
        times[1].push(time * 1e9 / f64::from(steps));
        ends[1] = end;
    }
    let [compiled, interpreted] = times.map(summary);
    println!(
        "{name:24} one state: compiled {:7.1} / {:7.1} ns, live {:7.1} / {:7.1} ns, ratio {:.2}",
        compiled[0],
        compiled[1],
        interpreted[0],
        interpreted[1],
        interpreted[0] / compiled[0]
    );
    ends[0] == ends[1]
}

/// Members in lanes: those of the ensemble on one thread against packs; with outputs at
/// every step, or in the end alone.
fn in_lanes<M: Mechanism<Real = f64>>(
    name: &str,
    text: &str,
    [input, h]: [f64; 2],
    is_observed: bool,
    rounds: usize,
) -> bool {
    let mechanism = M::new(M::Parameters::default()).expect("declared parameters");
    let run = Simulation::builder(mechanism, h).inputs(inputs(input)).build().expect("a start");
    let live = compiled(text);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    let per_step = |time: f64| time * 1e9 / f64::from(STEPS) / MEMBERS as f64;
    let mut times = [Vec::new(), Vec::new()];
    let mut ends = [0.0; 2];
    for _ in 0..rounds {
        let (time, sum) = pool.install(|| timed(|| ensemble(&run, h * f64::from(STEPS), is_observed)));
        times[0].push(per_step(time));
        ends[0] = sum;
        let inputs = vec![input; live.info().inputs.len()];
        let run = || Run::builder(&live, h).inputs(&inputs).build().expect("a start");
        let runs = (0..MEMBERS / LANES).map(|_| (0..LANES).map(|_| run()).collect()).collect();
        let (time, sum) = timed(|| packs(runs, is_observed));
        times[1].push(per_step(time));
        ends[1] = sum;
    }
    let [compiled, interpreted] = times.map(summary);
    let what = if is_observed { "observed:" } else { "a member:" };
    println!(
        "{name:24} {what}  compiled {:7.1} / {:7.1} ns, live {:7.1} / {:7.1} ns, ratio {:.2}",
        compiled[0],
        compiled[1],
        interpreted[0],
        interpreted[1],
        interpreted[0] / compiled[0]
    );
    (ends[0] - ends[1]).abs() <= 1e-12 * MEMBERS as f64
}

/// The first coordinates of all members in the end, added.
fn ensemble<M: Mechanism<Real = f64>>(run: &Simulation<M>, end: f64, is_observed: bool) -> f64 {
    let member = |_| Ok(black_box(*run));
    let first = |state: mbs_runtime::State<M::Coordinates>| numbers(state.q)[0];
    if is_observed {
        let outcomes = Ensemble::new(end).run(MEMBERS, member, &Extremes::default());
        outcomes.into_iter().flatten().flatten().map(|run| first(run.state)).sum()
    } else {
        let outcomes = Ensemble::new(end).run(MEMBERS, member, &());
        outcomes.into_iter().flatten().flatten().map(|run| first(run.state)).sum()
    }
}

/// The same of packs of runs.
fn packs(packs: Vec<Vec<Run>>, is_observed: bool) -> f64 {
    let mut sum = 0.0;
    for runs in packs {
        let info = runs[0].equations().info();
        let mut rows = vec![[0.0; LANES]; info.coordinates.len() + info.outputs.len()];
        let mut pack = Pack::new(runs).map_err(|_| "they are alike").expect("a pack");
        for step in 1..=STEPS {
            assert!(pack.step().is_empty());
            if is_observed || step == STEPS {
                assert!(pack.observe(&mut rows).is_empty());
            }
        }
        sum += rows[0].iter().sum::<f64>();
    }
    sum
}

fn main() -> ExitCode {
    // `cargo test --benches` runs this without the flag: the comparison is the test
    let is_bench = std::env::args().any(|argument| argument == "--bench");
    let rounds = if is_bench { 51 } else { 1 };
    println!("minimum / median of {rounds} rounds");
    text_to_first_step("driven slider-crank", DRIVEN, rounds);
    text_to_first_step("free slider-crank", FREE, rounds);
    text_to_first_step("40 four-bars in a row", &CHAIN.replace("N = 8", "N = 40"), rounds.div_ceil(10));
    let good = [
        alone::<Driven>("driven slider-crank", DRIVEN, 0.0, 0.5e-3, STEPS, rounds),
        alone::<Free>("free slider-crank", FREE, 0.5, 0.5e-3, STEPS, rounds),
        alone::<Chain>("8 four-bars in a row", CHAIN, 0.0, 1e-4, STEPS / 10, rounds),
        in_lanes::<Driven>("driven slider-crank", DRIVEN, [0.0, 0.5e-3], false, rounds.div_ceil(3)),
        in_lanes::<Free>("free slider-crank", FREE, [0.5, 0.5e-3], false, rounds.div_ceil(3)),
        in_lanes::<Free>("free slider-crank", FREE, [0.5, 0.5e-3], true, rounds.div_ceil(3)),
        in_lanes::<Chain>("8 four-bars in a row", CHAIN, [0.0, 1e-4], false, rounds.div_ceil(20)),
    ];
    if good.iter().all(|&good| good) {
        ExitCode::SUCCESS
    } else {
        println!("the programs do not agree: {good:?}");
        ExitCode::FAILURE
    }
}
