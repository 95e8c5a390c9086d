//! Cost of a Heun step of a long chain: how it grows with the number of links, generated loops against
//! straight lines and against a person's loops, in the same run. `-- --figure FILE.svg` draws it.

mod figure;
mod kernels;
mod timing;

use std::env;
use std::process::ExitCode;

use kernels::Kernel;

fn main() -> ExitCode {
    let kernels = match Kernel::all() {
        Ok(kernels) => kernels,
        Err(error) => {
            println!("{error}");
            return ExitCode::FAILURE;
        }
    };
    if !all_codes_agree(&kernels) {
        return ExitCode::FAILURE;
    }
    // `cargo test --benches` runs this without the flag: the comparison above is the test
    if env::args().any(|argument| argument == "--bench") {
        let times = timing::times(&kernels);
        timing::print(&kernels, &times);
        let file = env::args().skip_while(|argument| argument != "--figure").nth(1);
        if let Some(Err(error)) = file.map(|file| figure::save(&kernels, &times, file.as_ref())) {
            println!("{error}");
            return ExitCode::FAILURE;
        }
    }
    ExitCode::SUCCESS
}

/// Ten steps, each of which rounds positions of size N m, a few times and by ε N; the
/// constraints hand that on enlarged by less than N (`tests/pendulum_by_hand.rs`).
fn all_codes_agree(kernels: &[Kernel]) -> bool {
    let mut is_good = true;
    for kernel in kernels {
        let n = kernel.n as f64;
        let tolerance = 10.0 * 4.0 * f64::EPSILON * n * n;
        let angle = (kernel.run)(10);
        let same = |other: &&Kernel| other.chain == kernel.chain && other.n == kernel.n;
        let others = kernels.iter().filter(same).map(|other| (other.run)(10));
        for other in others {
            let apart = (angle - other).abs();
            if apart.is_nan() || apart > tolerance {
                println!("{}: θ = {angle}, but {other} of another program", kernel.name());
                is_good = false;
            }
        }
    }
    is_good
}
