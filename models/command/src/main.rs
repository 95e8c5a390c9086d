//! The `mbs` command: mechanisms at a desk, and the paper reproduced.

use std::process::ExitCode;

use mbs_command::{library, paper};

fn main() -> ExitCode {
    let app = library()
        .iter()
        .fold(mbs_workbench::app(), |app, entry| app.text(entry.name, entry.text(), entry.defaults()));
    app.command(paper::command(), paper::run).default_command("paper").run()
}
