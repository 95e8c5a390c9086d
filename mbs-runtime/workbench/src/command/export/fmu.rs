//! `mbs export fmu`: a mechanism for other simulators.

use std::path::PathBuf;

use clap::builder::PossibleValuesParser;
use clap::{Arg, ArgAction, ArgMatches, Command, value_parser};
use mbs_live::FmiVersion;

use super::settings;
use crate::command::options::option;
use crate::fmu::{Fmu, binaries};

use crate::{Error, Models, files, say};

/// The versions of the standard, as they are chosen and as files are called.
const VERSIONS: [(&str, FmiVersion); 2] = [("2", FmiVersion::V2), ("3", FmiVersion::V3)];

pub(super) fn command() -> Command {
    Command::new("fmu")
        .about("Write a mechanism as functional mock-up units, which other simulators import")
        .after_help(EXAMPLES)
        .arg(Arg::new("model").value_name("MODEL").required(true).help("A name from `list`, or a file"))
        .arg(
            option("out", "DIR", "The folder to write to; it is made if it is not there")
                .required(true)
                .value_parser(value_parser!(PathBuf)),
        )
        .arg(
            option("fmi", "VERSION", "The version of the standard, 2.0 or 3.0; both if it is not given")
                .value_parser(PossibleValuesParser::new(VERSIONS.map(|(word, _)| word)))
                .action(ArgAction::Append),
        )
        .arg(option("step", "TIME", "The step of co-simulation; as declared, or 0.5 ms, if it is not given"))
        .arg(option("end", "TIME", "How long importers are proposed to simulate").default_value("1 s"))
        .arg(
            Arg::new("sources-only")
                .long("sources-only")
                .action(ArgAction::SetTrue)
                .help("Pack no binary, even where there is a C compiler"),
        )
}

const EXAMPLES: &str = "\
Examples:
  mbs export fmu slider-crank-free --out fmu
  mbs export fmu my.mbs --fmi 3 --step 0.1ms --out fmu
  python -m fmpy --validate simulate fmu/slider_crank_free_fmi3.fmu --show-plot

A unit holds model exchange and co-simulation, the C code, a binary for this machine, and one for every
other for which a cross compiler is installed (x86_64-w64-mingw32-gcc for Windows). It needs no other
program where it is used.";

pub(super) fn run(models: &Models, matches: &ArgMatches) -> Result<(), Error> {
    let name = matches.get_one::<String>("model").map_or("", String::as_str);
    let folder = matches.get_one::<PathBuf>("out").cloned().unwrap_or_default();
    let found = models.find(name)?;
    let model = found.model();
    let fmu = Fmu::of(model, &settings(model, matches)?)?;
    let binaries = if matches.get_flag("sources-only") { Vec::new() } else { binaries(&fmu)? };
    let wanted: Vec<&String> = matches.get_many("fmi").into_iter().flatten().collect();
    std::fs::create_dir_all(&folder).map_err(Error::file("create", &folder))?;
    for (word, version) in VERSIONS {
        if wanted.is_empty() || wanted.iter().any(|wanted| *wanted == word) {
            let path = folder.join(format!("{}_fmi{word}.fmu", fmu.identifier));
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
