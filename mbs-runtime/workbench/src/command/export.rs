//! `mbs export`: a mechanism as a program in another language, or as a drawing.

mod dxf;
mod svg;

mod fmu;
//! `mbs export`: a mechanism as a program in another language, or as a page in which it runs.

use std::path::{Path, PathBuf};

use clap::builder::PossibleValuesParser;
use clap::{Arg, ArgMatches, Command, value_parser};
use mbs_live::Scalar;

use super::options::option;
use crate::models::Models;
use crate::{Error, RunOptions, files, interactive, say};

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
    let page = Command::new("page")
        .about("Write a mechanism as one HTML file in which it runs, offline, to change and to drag")
        .after_help(PAGE_EXAMPLES)
        .arg(Arg::new("model").value_name("MODEL").required(true).help("A name from `list`, or a file"))
        .arg(
            option("out", "FILE.html", "The file to write")
                .required(true)
                .value_parser(value_parser!(PathBuf)),
        )
        .arg(option("step", "TIME", "Step in s, or with a unit [default: as declared, 0.5ms, or its own]"))
        .arg(option("end", "TIME", "The time that curves and speed are laid out for [default: 1s]"));
    Command::new("export")
        .about("Write a mechanism as a program in another language, or as a drawing")
        .subcommand_required(true)
        .arg_required_else_help(true)
        .subcommand(c)
        .subcommand(fmu::command())
        .subcommand(dxf::command())
        .subcommand(svg::command())
        .about("Write a mechanism as a program in another language, or as a page in which it runs")
        .subcommand_required(true)
        .arg_required_else_help(true)
        .subcommand(c)
        .subcommand(page)
}

const EXAMPLES: &str = "\
Examples:
  mbs export c slider-crank --out c
  gcc -std=c99 -O2 c/*.c -lm -o slider_crank && ./slider_crank > run.csv";

const PAGE_EXAMPLES: &str = "\
Examples:
  mbs export page double-pendulum --out pendulum.html
  mbs export page my.mbs --step 0.1ms --end 4s --out my.html

The file needs no network and no server: the mechanism is in it as WebAssembly. Numbers are
those of `simulate` to the bit, as far as functions of the browser agree with Rust's: those
other than sine, cosine and square root may not.";

pub(crate) fn run(models: &Models, matches: &ArgMatches) -> Result<(), Error> {
    match matches.subcommand() {
        Some(("c", matches)) => c(models, matches),
        Some(("fmu", matches)) => fmu::run(models, matches),
        Some(("dxf", matches)) => dxf::run(models, matches),
        Some(("svg", matches)) => svg::run(models, matches),
        Some(("page", matches)) => page(models, matches),
        // the parser requires one that it knows
        _ => Ok(()),
    }
}

fn c(models: &Models, matches: &ArgMatches) -> Result<(), Error> {
    let name = matches.get_one::<String>("model").map_or("", String::as_str);
    let folder = matches.get_one::<PathBuf>("out").cloned().unwrap_or_default();
    let is_float = matches.get_one::<String>("scalar").is_some_and(|scalar| scalar == "float");
    let found = models.find(name)?;
    let text = found.model().text().ok_or_else(|| without_text(name))?;
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

fn page(models: &Models, matches: &ArgMatches) -> Result<(), Error> {
    let name = matches.get_one::<String>("model").map_or("", String::as_str);
    let path = matches.get_one::<PathBuf>("out").cloned().unwrap_or_default();
    let found = models.find(name)?;
    let model = found.model();
    let mut asked = RunOptions::default();
    for option in ["step", "end"] {
        if let Some(text) = matches.get_one::<String>(option) {
            asked.set(option, text)?;
        }
    }
    let settings = asked.settings(model)?;
    let html = interactive::page(found.name(), model, &settings)?.ok_or_else(|| without_text(name))?;
    files::write(&path, html.as_bytes())?;
    say(format_args!("written: {}", path.display()))
}

fn without_text(name: &str) -> Error {
    let reason = "its declaration is compiled into this program and not there as a text; name its file";
    Error::Name { name: name.to_owned(), reason: reason.into() }
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
