//! The compiler of mechanisms as a program of its own: it answers the request on standard input.

use std::io::{self, Read, Write};

fn main() -> io::Result<()> {
    let mut request = String::new();
    io::stdin().read_to_string(&mut request)?;
    io::stdout().write_all(mbs_editor::answer(&request).as_bytes())
}
