//! Wall time: repetitions of all kernels take turns, so that a machine that
//! slows down slows all of them; medians are compared within a case.

use std::time::Instant;

use crate::kernels::{Kernel, Method, Reactions};

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
        "{:36} {:>9} {:>9} {:>9} {:>9} {:>12} {:>14} {:>14} {:>12}",
        "",
        "compiled",
        "dense LU",
        "by hand",
        "on pairs",
        "dense/ours",
        "ours/by hand",
        "ours/on pairs",
        "with λ"
    );
    for kernel in kernels.iter().filter(|kernel| kernel.method == Method::Compiled) {
        let of = |method: Method| time(&kernel.case(), method);
        let (Some(ours), Some(dense)) = (of(Method::Compiled), of(Method::Dense)) else { continue };
        let columns = [of(Method::ByHand), of(Method::OnPairs)];
        let [by_hand, on_pairs] = columns.map(|time| time.map_or(String::new(), |time| format!("{time:.1}")));
        let [to_hand, to_pairs] =
            columns.map(|time| time.map_or(String::new(), |time| format!("{:.2}x", ours / time)));
        let without = Kernel { reactions: Reactions::None, ..*kernel }.case();
        let with_reactions =
            match time(&without, Method::Compiled).filter(|_| kernel.reactions != Reactions::None) {
                Some(without) => format!("{:.2}x", ours / without),
                None => String::new(),
            };
        println!(
            "{:36} {ours:9.1} {dense:9.1} {by_hand:>9} {on_pairs:>9} {:11.1}x {to_hand:>14} {to_pairs:>14} {with_reactions:>12}",
            kernel.case(),
            dense / ours
        );
    }
    println!();
}

fn median(times: &mut [f64]) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}
