//! `mbs export`: a mechanism as a program in another language, for other programs, or as a picture.
//!
//! Pictures are made of the shapes of a `Picture`, as figures are. DXF shows them at one instant. An SVG
//! carries the motion in its elements. A GIF has frames that are drawn as figures are. DXF and SVG need no
//! library.

mod c;
mod dxf;
mod fmu;
mod motion;
mod page;
mod svg;

use clap::{ArgMatches, Command};

use crate::{Error, Model, Models, RunOptions, Settings};

pub(crate) fn command() -> Command {
    Command::new("export")
        .about("Write a mechanism as a program, for another program, as a page in which it runs, or as a drawing")
        .subcommand_required(true)
        .arg_required_else_help(true)
        .subcommand(c::command())
        .subcommand(fmu::command())
        .subcommand(page::command())
        .subcommand(dxf::command())
        .subcommands(motion::FORMATS.iter().map(motion::command))
}

pub(crate) fn run(models: &Models, matches: &ArgMatches) -> Result<(), Error> {
    match matches.subcommand() {
        Some(("c", matches)) => c::run(models, matches),
        Some(("fmu", matches)) => fmu::run(models, matches),
        Some(("page", matches)) => page::run(models, matches),
        Some(("dxf", matches)) => dxf::run(models, matches),
        Some((name, matches)) => match motion::FORMATS.iter().find(|format| motion::is(format, name)) {
            Some(format) => motion::run(format, models, matches),
            // the parser requires one that it knows
            None => Ok(()),
        },
        None => Ok(()),
    }
}

/// The settings of a run with the step and the end that are asked for.
fn settings(model: &dyn Model, matches: &ArgMatches) -> Result<Settings, Error> {
    let mut options = RunOptions::default();
    for name in ["step", "end"] {
        if let Some(text) = matches.get_one::<String>(name) {
            options.set(name, text)?;
        }
    }
    options.settings(model)
}
