//! Output that may end early.

use std::fmt::Display;
use std::io::Write;

/// Writes a line to standard output. A reader that has gone away, such as
/// `head`, is no error: `println!` would panic there.
pub fn say(line: impl Display) {
    let _ = writeln!(std::io::stdout(), "{line}");
}

/// The same to standard error.
pub(crate) fn complain(line: impl Display) {
    let _ = writeln!(std::io::stderr(), "{line}");
}
