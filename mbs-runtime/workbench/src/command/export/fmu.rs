//! `mbs export fmu`: a mechanism for other simulators.

use std::path::PathBuf;

use clap::Args;
use clap::builder::PossibleValuesParser;
use mbs_live::FmiVersion;

use super::settings;
use crate::command::options::{Named, signed};
use crate::fmu::{Fmu, binaries};
use crate::{Error, Models, RunOptions, files, say};

/// The versions of the standard, as they are chosen and as files are called.
const VERSIONS: [(&str, FmiVersion); 2] = [("2", FmiVersion::V2), ("3", FmiVersion::V3)];

#[derive(Args)]
#[command(
    about = "Write a mechanism as functional mock-up units, which other simulators import",
    after_help = EXAMPLES,
    mut_args(signed),
)]
pub(super) struct Arguments {
    #[command(flatten)]
    model: Named,
    /// The folder to write to; it is made if it is not there
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// The version of the standard, 2.0 or 3.0; both if it is not given
    #[arg(
        long,
        value_name = "VERSION",
        value_parser = PossibleValuesParser::new(VERSIONS.map(|(word, _)| word)),
    )]
    fmi: Vec<String>,
    /// The step of co-simulation; as declared, or 0.5 ms, if it is not given
    #[arg(long, value_name = "TIME")]
    step: Option<String>,
    /// How long importers are proposed to simulate
    #[arg(long, value_name = "TIME", default_value = "1 s")]
    end: String,
    /// Pack no binary, even where there is a C compiler
    #[arg(long)]
    sources_only: bool,
}

const EXAMPLES: &str = "\
Examples:
  mbs export fmu slider-crank-free --out fmu
  mbs export fmu my.mbs --fmi 3 --step 0.1ms --out fmu
  python -m fmpy --validate simulate fmu/slider_crank_free_fmi3.fmu --show-plot

A unit holds model exchange and co-simulation, the C code, a binary for this machine, and one for every
other for which a cross compiler is installed (x86_64-w64-mingw32-gcc for Windows). It needs no other
program where it is used.";

impl Arguments {
    pub fn run(&self, models: &Models) -> Result<(), Error> {
        let found = self.model.find(models)?;
        let model = found.model();
        let fmu =
            Fmu::of(model, &settings(model, RunOptions::default(), self.step.as_ref(), Some(&self.end))?)?;
        let binaries = if self.sources_only { Vec::new() } else { binaries(&fmu)? };
        std::fs::create_dir_all(&self.out).map_err(Error::file("create", &self.out))?;
        for (word, version) in VERSIONS {
            if self.fmi.is_empty() || self.fmi.iter().any(|wanted| *wanted == word) {
                let path = self.out.join(format!("{}_fmi{word}.fmu", fmu.identifier));
                files::write(&path, &fmu.archive(version, &binaries)?)?;
                say(format_args!("written: {}", path.display()))?;
            }
        }
        let platforms: Vec<&str> = binaries.iter().map(|binary| binary.platform()).collect();
        match platforms.is_empty() {
            false => say(format_args!("with binaries for {}", platforms.join(", "))),
            true => say(format_args!(
                "with the C code alone, which importers compile: there is no binary without a C compiler"
            )),
        }
    }
}
