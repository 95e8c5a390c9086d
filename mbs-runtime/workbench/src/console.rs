//! Lines on standard output and standard error.

use std::fmt::Display;
use std::io::Write;

use crate::Error;

/// Warnings about the results of a command that gave them nevertheless.
pub(crate) type Warnings = Vec<String>;

/// Writes a line to standard output.
///
/// # Errors
/// [`Error::Standard`] if it cannot be written: a full disk, or a reader that has gone
/// away, such as `head`. A program that passes it on to [`App`](crate::App) ends as one
/// expects of it; `println!` would panic.
pub fn say(line: impl Display) -> Result<(), Error> {
    let mut stdout = std::io::stdout().lock();
    writeln!(stdout, "{line}").and_then(|()| stdout.flush()).map_err(Error::Standard)
}

/// The same to standard error; if that takes nothing, there is nobody left to tell.
pub(crate) fn complain(line: impl Display) {
    let _ = writeln!(std::io::stderr(), "{line}");
}
