//! The C sources of a mechanism, written into a folder.
//!
//! ```text
//! cargo run -p mbs-codegen --example c -- FOLDER [float] < pendulum.mbs
//! ```
//!
//! where `pendulum.mbs` is what stands between the braces of `mechanism!`.

use std::error::Error;
use std::io::{Read, stdin};
use std::path::PathBuf;

use mbs_codegen::analyse;
use mbs_codegen::target::{Scalar, c};

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let folder = PathBuf::from(arguments.next().ok_or("give a folder")?);
    let is_float = arguments.next().is_some_and(|word| word == "float");
    let mut declaration = String::new();
    stdin().read_to_string(&mut declaration)?;
    let compiled = analyse(declaration.parse()?)?;
    let sources = c(&compiled, if is_float { Scalar::Float } else { Scalar::Double })?;
    std::fs::create_dir_all(&folder)?;
    for file in sources.files() {
        std::fs::write(folder.join(&file.name), &file.text)?;
    }
    Ok(())
}
