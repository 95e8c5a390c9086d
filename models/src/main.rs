//! The `mbs` command: mechanisms at a desk, and the paper reproduced.

use std::process::ExitCode;

fn main() -> ExitCode {
    mbs_workbench::app()
        .mechanism::<models::SliderCrank>("slider-crank")
        .mechanism::<models::SliderCrankFree>("slider-crank-free")
        .run()
}
