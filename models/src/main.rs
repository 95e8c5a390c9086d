//! The `mbs` command: mechanisms at a desk, and the paper reproduced.

mod paper;

use std::process::ExitCode;

fn main() -> ExitCode {
    mbs_workbench::app()
        .mechanism::<models::SliderCrank>("slider-crank")
        .mechanism::<models::SliderCrankFree>("slider-crank-free")
        .mechanism::<models::Pendulum>("pendulum")
        .command(paper::command(), paper::run)
        .default_command("paper")
        .run()
}
