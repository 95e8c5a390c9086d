//! Cost of a Heun step of the slider-crank: compiled, against a dense LU of the same equations and against a
//! person's elimination, in the same run; its operations; its instructions against recorded ones.

mod instructions;
mod kernels;
mod timing;

use std::env;
use std::process::ExitCode;

use kernels::{Kernel, Method};
use mbs_runtime::{Info, Mechanism};
use models::{SliderCrank, SliderCrankFree};

fn main() -> ExitCode {
    let arguments: Vec<String> = env::args().skip(1).collect();
    if arguments.first().is_some_and(|first| first == instructions::RUN) {
        let is_known = instructions::run_child(&arguments[1..]);
        return if is_known { ExitCode::SUCCESS } else { ExitCode::FAILURE };
    }
    if !all_methods_agree() {
        return ExitCode::FAILURE;
    }
    // `cargo test --benches` runs this without the flag: the comparison above is the test
    if !arguments.iter().any(|argument| argument == "--bench") {
        return ExitCode::SUCCESS;
    }
    print_operations(SliderCrank::<f64>::INFO);
    print_operations(SliderCrankFree::<f64>::INFO);
    println!();
    timing::print();
    if instructions::check() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// After one turn the methods are apart by rounding alone: 600 steps of less
/// than 1e-14 each, so that nothing else is compared than the same work.
fn all_methods_agree() -> bool {
    let mut is_good = true;
    for kernel in Kernel::all() {
        let reference = Kernel { method: Method::Dense, ..kernel };
        let ((angle, reaction), (angle_0, reaction_0)) = (kernel.run(600), reference.run(600));
        if (angle - angle_0).abs() > 1e-10 || (reaction - reaction_0).abs() > 1e-8 * (1.0 + reaction_0.abs())
        {
            println!("{}: θ1 = {angle}, λ = {reaction}, but dense {angle_0}, {reaction_0}", kernel.name());
            is_good = false;
        }
    }
    is_good
}

fn print_operations(info: &Info) {
    for function in
        info.functions.iter().filter(|f| ["stabilized", "constrained", "reactions"].contains(&f.name))
    {
        let o = function.operations;
        println!(
            "{:16} {:12} {} mul + {} add + {} div + {} sincos, and {} to watch pivots",
            info.name, function.name, o.mul, o.add, o.div, o.sin_cos, o.watch
        );
    }
}
