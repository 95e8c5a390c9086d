//! Wall time: repetitions of all kernels take turns, so that a machine that
//! slows down slows all of them; medians are compared within a case.

use std::time::Instant;

use crate::kernels::{Kernel, Method};

/// One turn of the crank.
const STEPS: u32 = 600;
const REPETITIONS: usize = 201;

/// Prints ns per step and ratios of every case.
pub fn print() {
    let kernels = Kernel::all();
    let mut times = vec![Vec::with_capacity(REPETITIONS); kernels.len()];
    for _ in 0..REPETITIONS {
        for (kernel, times) in kernels.iter().zip(&mut times) {
            let start = Instant::now();
            std::hint::black_box(kernel.run(STEPS));
            times.push(start.elapsed().as_secs_f64() * 1e9 / f64::from(STEPS));
        }
    }
    let medians: Vec<f64> = times.iter_mut().map(|times| median(times)).collect();
    let time = |case: &str, method: Method| {
        let at = kernels.iter().position(|k| k.case() == case && k.method == method)?;
        Some(medians[at])
    };

    println!("ns per Heun step, medians of {REPETITIONS} interleaved repetitions");
    println!(
        "{:28} {:>9} {:>9} {:>9} {:>12} {:>14}",
        "", "compiled", "dense LU", "by hand", "dense/ours", "ours/by hand"
    );
    for kernel in kernels.iter().filter(|kernel| kernel.method == Method::Compiled) {
        let case = kernel.case();
        let (Some(ours), Some(dense)) = (time(&case, Method::Compiled), time(&case, Method::Dense)) else {
            continue;
        };
        print!("{case:28} {ours:9.1} {dense:9.1}");
        match time(&case, Method::ByHand) {
            Some(by_hand) => println!(" {by_hand:9.1} {:11.1}x {:13.2}x", dense / ours, ours / by_hand),
            None => println!(" {:>9} {:11.1}x", "", dense / ours),
        }
    }
    println!();
}

fn median(times: &mut [f64]) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}
