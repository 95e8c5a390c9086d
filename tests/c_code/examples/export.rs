//! Writes the C sources of a mechanism of the library into a folder, and prints what their names
//! begin with: `export FILE.rs FOLDER`. `benches/casadi/compare.py` times them.

use std::error::Error;
use std::path::{Path, PathBuf};

use c_code::declarations;
use mbs_codegen::analyse;
use mbs_codegen::targets::{Scalar, c};

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1).map(PathBuf::from);
    let (file, folder) = arguments.next().zip(arguments.next()).ok_or("export FILE.rs FOLDER")?;
    let all = declarations(file.parent().unwrap_or(Path::new(".")))?;
    let declaration = all.into_iter().find(|(path, _)| *path == file).ok_or("there is no mechanism")?;
    let sources = c(&analyse(declaration.1)?, Scalar::Double)?;
    for file in sources.files() {
        std::fs::write(folder.join(&file.name), &file.text)?;
    }
    println!("{}", sources.prefix);
    Ok(())
}
