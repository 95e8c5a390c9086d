//! `mbs export`: a mechanism as a program in another language, or as a drawing.

mod dxf;
mod svg;

mod fmu;

use std::path::{Path, PathBuf};

use clap::builder::PossibleValuesParser;
use clap::{Arg, ArgMatches, Command, value_parser};
use mbs_live::Scalar;

use super::options::option;
use crate::models::Models;
use crate::{Error, files, say};

pub(crate) fn command() -> Command {
    let c = Command::new("c")
        .about("Write a mechanism as C99: header, source, an example and a page about them")
        .after_help(EXAMPLES)
        .arg(Arg::new("model").value_name("MODEL").required(true).help("A name from `list`, or a file"))
        .arg(
            option("out", "DIR", "The folder to write to; it is made if it is not there")
                .required(true)
                .value_parser(value_parser!(PathBuf)),
        )
        .arg(
            option("scalar", "TYPE", "The floating-point type")
                .value_parser(PossibleValuesParser::new(["double", "float"]))
                .default_value("double"),
        );
    Command::new("export")
        .about("Write a mechanism as a program in another language, or as a drawing")
        .subcommand_required(true)
        .arg_required_else_help(true)
        .subcommand(c)
        .subcommand(fmu::command())
        .subcommand(dxf::command())
        .subcommand(svg::command())
}

const EXAMPLES: &str = "\
Examples:
  mbs export c slider-crank --out c
  gcc -std=c99 -O2 c/*.c -lm -o slider_crank && ./slider_crank > run.csv";

pub(crate) fn run(models: &Models, matches: &ArgMatches) -> Result<(), Error> {
    match matches.subcommand() {
        Some(("c", matches)) => c(models, matches),
        Some(("fmu", matches)) => fmu::run(models, matches),
        Some(("dxf", matches)) => dxf::run(models, matches),
        Some(("svg", matches)) => svg::run(models, matches),
        // the parser requires one that it knows
        _ => Ok(()),
    }
}

fn c(models: &Models, matches: &ArgMatches) -> Result<(), Error> {
    let name = matches.get_one::<String>("model").map_or("", String::as_str);
    let folder = matches.get_one::<PathBuf>("out").cloned().unwrap_or_default();
    let is_float = matches.get_one::<String>("scalar").is_some_and(|scalar| scalar == "float");
    let found = models.find(name)?;
    let Some(text) = found.model().text() else {
        let reason = "its declaration is compiled into this program and not there as a text; name its file";
        return Err(Error::Name { name: name.to_owned(), reason: reason.into() });
    };
    let sources = text.c(if is_float { Scalar::Float } else { Scalar::Double })?;
    std::fs::create_dir_all(&folder).map_err(Error::file("create", &folder))?;
    // these are called so for every mechanism, and begin with its name
    for file in sources.named_alike() {
        check_owner(&folder.join(&file.name), &file.text)?;
    }
    for file in sources.files() {
        let path = folder.join(&file.name);
        files::write(&path, file.text.as_bytes())?;
        say(format_args!("written: {}", path.display()))?;
    }
    Ok(())
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
