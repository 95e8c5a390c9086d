//! Cost of a Heun step of a member of an ensemble: by lanes, against one simulation after the other and
//! against lanes that a person has eliminated, in the same run, and on two threads; and a million members.

mod by_hand;
#[cfg(target_arch = "x86_64")]
mod steps;
#[cfg(target_arch = "x86_64")]
mod vector;

use std::array::from_fn;
use std::fs;
use std::hint::black_box;
use std::process::ExitCode;
use std::time::Instant;

use by_hand::{Hand, N, Seven};
use indicatif::ProgressBar;
use mbs_ensemble::{Ensemble, Violation};
use mbs_runtime::{Baumgarte, Components, Error, Held, Mechanism, PerStage, Simulation};
use models::{SliderCrank, SliderCrankFree, SliderCrankFreeInputs, SliderCrankFreeParameters};
use rayon::ThreadPoolBuilder;

const H: f64 = 0.5e-3;
const STEPS: u64 = 600;
const END: f64 = 0.3;
const MEMBERS: usize = 1024;
const REPETITIONS: usize = 101;
/// One after the other they cost the same each: few of them, for a quiet moment.
const ALONE: usize = 64;

/// A tenth heavier from first to last.
fn mass(index: usize) -> f64 {
    2.0 + 0.2 * index as f64 / MEMBERS as f64
}

fn driven(index: usize) -> Result<Simulation<SliderCrank>, Error> {
    let parameters = models::SliderCrankParameters { m3: mass(index), ..Default::default() };
    Simulation::new(SliderCrank::new(parameters)?, H)
}

fn free(index: usize) -> Result<Simulation<SliderCrankFree>, Error> {
    let parameters = SliderCrankFreeParameters { m3: mass(index), ..Default::default() };
    let inputs = SliderCrankFreeInputs { crank_torque: 0.5 };
    Simulation::builder(SliderCrankFree::new(parameters)?, H).inputs(inputs).build()
}

/// Eight slider-cranks from the given one on, with the start of simulations.
fn hand<M: Mechanism<Real = f64>>(runs: &[Simulation<M>], first: usize) -> (Hand, Seven, Seven) {
    let c = |x: f64| [x; N];
    let best = Baumgarte::<Held>::deadbeat(H);
    let hand = Hand {
        l1: c(0.06),
        l2: c(0.18),
        m: [c(0.5), c(1.2), from_fn(|lane| mass(first + lane))],
        j: [c(0.5 * 0.06 * 0.06 / 12.0), c(1.2 * 0.18 * 0.18 / 12.0)],
        omega: c(200.0 * std::f64::consts::TAU / 60.0),
        torque: c(0.5),
        minus_two_alpha: c(-2.0 * best.alpha()),
        minus_beta_squared: c(-best.beta() * best.beta()),
    };
    let of = |what: &dyn Fn(&Simulation<M>) -> M::Coordinates, i: usize| {
        from_fn(|lane| what(&runs[first + lane]).into_array().as_ref()[i])
    };
    (hand, from_fn(|i| of(&|run| run.state().q, i)), from_fn(|i| of(&|run| run.state().v, i)))
}

/// Seconds of one, and what the crank's angles add up to. An ensemble is timed on a thread of
/// its pool: to wake that up takes tens of microseconds, once.
fn timed(work: impl FnOnce() -> f64) -> (f64, f64) {
    let start = Instant::now();
    let sum = black_box(work());
    (start.elapsed().as_secs_f64(), sum)
}

fn alone<M: Mechanism<Real = f64>>(runs: &[Simulation<M>]) -> f64 {
    let angles = runs.iter().map(|run| {
        let mut run = black_box(*run);
        let outcome = run.advance_to(END);
        if outcome.is_ok() { angle(run.state().q) } else { f64::NAN }
    });
    angles.sum()
}

fn together<M: Mechanism<Real = f64>>(runs: &[Simulation<M>]) -> f64 {
    let outcomes = Ensemble::new(END).run(runs.len(), |index| Ok(black_box(runs[index])), &());
    outcomes.into_iter().flatten().flatten().map(|run| angle(run.state.q)).sum()
}

fn by_hand<M: Mechanism<Real = f64>, const DRIVEN: bool, const FUSED: bool>(runs: &[Simulation<M>]) -> f64 {
    let mut sum = 0.0;
    for first in (0..runs.len()).step_by(N) {
        let (hand, mut q, mut v) = black_box(hand(runs, first));
        let is_there = by_hand::advance::<DRIVEN, FUSED>(&hand, &mut q, &mut v, H, STEPS);
        sum += if is_there { q[2].into_iter().sum() } else { f64::NAN };
    }
    sum
}

fn angle<C: Components<Real = f64>>(q: C) -> f64 {
    q.get("theta1").unwrap_or(f64::NAN)
}

/// Compares the programs; `false` if they do not agree.
fn compare<M: Mechanism<Real = f64>, const DRIVEN: bool>(
    name: &str,
    member: impl Fn(usize) -> Result<Simulation<M>, Error>,
    repetitions: usize,
) -> Result<bool, Box<dyn std::error::Error>> {
    let runs = (0..MEMBERS).map(member).collect::<Result<Vec<_>, _>>()?;
    let pool = |threads| ThreadPoolBuilder::new().num_threads(threads).build();
    let (one, two) = (pool(1)?, pool(2)?);
    let mut times = [const { Vec::new() }; 5];
    let expected = alone(&runs);
    let mut sums = [0.0; 5];
    for _ in 0..repetitions {
        let results = [
            timed(|| alone(&runs[..ALONE])),
            one.install(|| timed(|| together(&runs))),
            timed(|| by_hand::<M, DRIVEN, false>(&runs)),
            timed(|| by_hand::<M, DRIVEN, true>(&runs)),
            two.install(|| timed(|| together(&runs))),
        ];
        for (at, (time, result)) in results.into_iter().enumerate() {
            let members = if at == 0 { ALONE } else { MEMBERS };
            times[at].push(time * 1e9 / (STEPS as f64 * members as f64));
            sums[at] = result;
        }
    }
    let shown = ["alone", "lanes", "by hand", "by hand, fused", "two threads"];
    for times in &mut times {
        times.sort_by(f64::total_cmp);
    }
    for (what, times) in shown.iter().zip(&times) {
        println!("{name:8} {what:16} {:6.1} / {:6.1}", times[0], times[times.len() / 2]);
    }
    let [alone, lanes, hand, fused, threads] = times.each_ref().map(|times| times[0]);
    println!(
        "{name:8} alone/lanes {:.2}   lanes/by hand {:.2}   lanes/fused by hand {:.2}   one/two threads {:.2}\n",
        alone / lanes,
        lanes / hand,
        lanes / fused,
        lanes / threads
    );
    // the same to the bit, and as the benchmark of one step compares by hand
    let near = |sum: f64| sum.is_nan() || (sum - expected).abs() < 1e-10 * MEMBERS as f64;
    let agree = sums[1] == expected && sums[4] == expected && near(sums[2]) && near(sums[3]);
    if !agree {
        println!("{name}: the sums of the angles differ: {expected} {sums:?}");
    }
    Ok(agree)
}

/// Peak memory of this process in MB, where the system tells.
fn peak() -> Option<f64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    Some(line.trim().trim_end_matches(" kB").parse::<f64>().ok()? / 1000.0)
}

fn million() {
    const COUNT: usize = 1_000_000;
    let mut sum = 0.0;
    let bar = ProgressBar::new(COUNT as u64);
    let report = |done: usize, _: usize| bar.set_position(done as u64);
    let start = Instant::now();
    let before = peak();
    let outcome = Ensemble::new(END).progress(&report).for_each(
        COUNT,
        |index| free(index % MEMBERS),
        &(),
        |_, outcome| {
            sum += outcome.map_or(f64::NAN, |run| angle(run.state.q));
        },
    );
    let seconds = start.elapsed().as_secs_f64();
    bar.finish_and_clear();
    println!("a million free members, {STEPS} steps, with their starts: {seconds:.1} s {outcome:?} {sum:.3}");
    println!("peak memory: {before:?} MB before, {:?} MB after", peak());
}

/// Figure 11 of the paper: the largest violation over 37 × 37 gains, one turn each.
fn paper() -> f64 {
    let member = |index: usize| {
        let gain = |k: usize| 200.0 + 50.0 * k as f64;
        let gains = Baumgarte::<PerStage>::new(gain(index % 37), gain(index / 37))?;
        Simulation::builder(SliderCrank::declared(), H)
            .baumgarte(gains)
            .as_declared()
            .allow_unstable()
            .build()
    };
    let runs = Ensemble::new(END).run(37 * 37, member, &Violation);
    runs.into_iter().flatten().flatten().map(|run| run.observed.phi).sum()
}

fn time_paper() -> Result<(), Box<dyn std::error::Error>> {
    let pool = ThreadPoolBuilder::new().num_threads(1).build()?;
    let times = (0..REPETITIONS).map(|_| pool.install(|| timed(paper)).0);
    let least = times.fold(f64::INFINITY, f64::min);
    println!("37 x 37 gains, {STEPS} steps, violations observed, one thread: {:.1} ms", least * 1e3);
    Ok(())
}

fn main() -> ExitCode {
    // `cargo test --benches` runs this without the flag: the comparison is the test
    let is_bench = std::env::args().any(|argument| argument == "--bench");
    let repetitions = if is_bench { REPETITIONS } else { 1 };
    println!("ns per step and member, minimum / median of {repetitions}, ensembles of {MEMBERS}");
    let good = [
        compare::<SliderCrank, true>("driven", driven, repetitions),
        compare::<SliderCrankFree, false>("free", free, repetitions),
    ];
    if is_bench {
        if let Err(error) = time_paper() {
            println!("{error}");
        }
        million();
    }
    let good = good.iter().all(|result| matches!(result, Ok(true)));
    if good { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
