//! `mbs export c`: a mechanism as C99.

use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};
use mbs_live::Scalar;

use crate::command::options::{Named, signed};
use crate::model::without_text;
use crate::{Error, Models, files, say};

#[derive(Args)]
#[command(
    about = "Write a mechanism as C99: header, source, an example and a page about them",
    after_help = EXAMPLES,
    mut_args(signed),
)]
pub(super) struct Arguments {
    #[command(flatten)]
    model: Named,
    /// The folder to write to; it is made if it is not there
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// The floating-point type
    #[arg(long, value_name = "TYPE", default_value = "double")]
    scalar: Type,
}

#[derive(Clone, Copy, ValueEnum)]
enum Type {
    Double,
    Float,
}

const EXAMPLES: &str = "\
Examples:
  mbs export c slider-crank --out c
  gcc -std=c99 -O2 c/*.c -lm -o slider_crank && ./slider_crank > run.csv";

impl Arguments {
    pub fn run(&self, models: &Models) -> Result<(), Error> {
        let found = self.model.find(models)?;
        let text = found.model().text().ok_or_else(|| without_text(found.name()))?;
        let sources = text.c(match self.scalar {
            Type::Double => Scalar::Double,
            Type::Float => Scalar::Float,
        })?;
        std::fs::create_dir_all(&self.out).map_err(Error::file("create", &self.out))?;
        // these are called so for every mechanism, and begin with its name
        for file in sources.named_alike() {
            check_owner(&self.out.join(&file.name), &file.text)?;
        }
        for file in sources.files() {
            let path = self.out.join(&file.name);
            files::write(&path, file.text.as_bytes())?;
            say(format_args!("written: {}", path.display()))?;
        }
        Ok(())
    }
}

/// Refuses to write over a file that begins otherwise: that of another mechanism, or of
/// somebody else.
fn check_owner(path: &Path, text: &str) -> Result<(), Error> {
    match std::fs::read_to_string(path) {
        Ok(known) if known.lines().next() != text.lines().next() => {
            let reason = "it is there already, and not of this mechanism; name another folder".into();
            Err(Error::Name { name: path.display().to_string(), reason })
        }
        _ => Ok(()),
    }
}
