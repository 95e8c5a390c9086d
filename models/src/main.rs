//! The `mbs` command: mechanisms at a desk, and the paper reproduced.

mod drift;
mod paper;

use std::process::ExitCode;

fn main() -> ExitCode {
    let app =
        models::library().into_iter().fold(mbs_workbench::app(), |app, (name, model)| app.model(name, model));
    app.command(paper::command(), paper::run)
        .command(drift::command(), drift::run)
        .default_command("paper")
        .run()
}
