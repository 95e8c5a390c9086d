//! Wall time: rounds of all kernels take turns, so that a machine that slows down
//! slows all of them; ratios are between numbers of one run.

use std::hint::black_box;
use std::time::Instant;

use crate::kernels::{Chain, Code, Kernel};

/// Links times steps of a round: a fraction of a millisecond for each kernel.
const WORK: usize = 4000;
const ROUNDS: usize = 301;

/// ns per step: the least of all rounds, when nobody disturbed, and the median.
#[derive(Clone, Copy)]
pub struct Time {
    pub least: f64,
    pub median: f64,
}

/// Prints ns per step and per link, and the ratios.
pub fn print(kernels: &[Kernel], times: &[Time]) {
    use Chain::{FourBar, Pendulum};
    use Code::{ByHand, Generated, Straight};
    let time = |chain: Chain, n: usize, code: Code| {
        let at = kernels.iter().position(|k| k.chain == chain && k.n == n && k.code == code)?;
        times.get(at).copied()
    };
    println!("ns per Heun step, least / median of {ROUNDS} interleaved rounds");
    println!("{:28} {:>19} {:>19}", "", "per step", "per link");
    for (kernel, time) in kernels.iter().zip(times) {
        let n = kernel.n as f64;
        println!(
            "{:28} {:9.0} {:9.0} {:9.1} {:9.1}",
            kernel.name(),
            time.least,
            time.median,
            time.least / n,
            time.median / n
        );
    }
    println!();
    for (name, chain) in [("pendulum", Pendulum), ("four-bar", FourBar)] {
        let growing = kernels.iter().zip(times).filter(|(k, _)| k.chain == chain && k.code == Generated);
        let (n, times): (Vec<_>, Vec<_>) = growing.map(|(kernel, time)| (kernel.n as f64, *time)).unzip();
        let fitted = |of: fn(&Time) -> f64| exponent(&n, &times.iter().map(of).collect::<Vec<_>>());
        let by = fitted(|time| time.least);
        println!("{name}: step ~ N^{by:.2} by least times, N^{:.2} by medians", fitted(|time| time.median));
    }
    let ratios = [
        ("four-bar 40 / pendulum 40", time(FourBar, 40, Generated), time(Pendulum, 40, Generated)),
        ("pendulum 40, straight lines / loops", time(Pendulum, 40, Straight), time(Pendulum, 40, Generated)),
        ("four-bar 40, straight lines / loops", time(FourBar, 40, Straight), time(FourBar, 40, Generated)),
        ("pendulum 10, generated / by hand", time(Pendulum, 10, Generated), time(Pendulum, 10, ByHand)),
        ("pendulum 40, generated / by hand", time(Pendulum, 40, Generated), time(Pendulum, 40, ByHand)),
        ("pendulum 400, generated / by hand", time(Pendulum, 400, Generated), time(Pendulum, 400, ByHand)),
    ];
    for (name, upper, lower) in ratios {
        if let (Some(upper), Some(lower)) = (upper, lower) {
            let (least, median) = (upper.least / lower.least, upper.median / lower.median);
            println!("{name:36} {least:5.2} by least times, {median:5.2} by medians");
        }
    }
}

/// Times of all kernels, in their order.
pub fn times(kernels: &[Kernel]) -> Vec<Time> {
    let mut rounds = vec![Vec::with_capacity(ROUNDS); kernels.len()];
    for _ in 0..ROUNDS {
        for (kernel, times) in kernels.iter().zip(&mut rounds) {
            let steps = (WORK / kernel.n) as u32;
            let start = Instant::now();
            black_box((kernel.run)(steps));
            times.push(start.elapsed().as_secs_f64() * 1e9 / f64::from(steps));
        }
    }
    let time = |mut times: Vec<f64>| {
        times.sort_by(f64::total_cmp);
        Time { least: times[0], median: times[times.len() / 2] }
    };
    rounds.into_iter().map(time).collect()
}

/// The slope of log t over log n by least squares.
fn exponent(n: &[f64], t: &[f64]) -> f64 {
    let logarithms = || n.iter().zip(t).map(|(n, t)| (n.ln(), t.ln()));
    let count = n.len() as f64;
    let (x, y) = logarithms().fold((0.0, 0.0), |sum, (x, y)| (sum.0 + x / count, sum.1 + y / count));
    let slope =
        logarithms().fold((0.0, 0.0), |sum, (a, b)| (sum.0 + (a - x) * (b - y), sum.1 + (a - x) * (a - x)));
    slope.0 / slope.1
}
