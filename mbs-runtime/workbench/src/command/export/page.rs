//! `mbs export page`: a mechanism as a page in which it runs.

use std::path::PathBuf;

use clap::{Arg, ArgMatches, Command, value_parser};

use crate::command::options::{of_values, option, settings};
use crate::console::complain;
use crate::{Error, Models, files, say};

pub(super) fn command() -> Command {
    Command::new("page")
        .about("Write a mechanism as one HTML file in which it runs, offline, to change and to drag")
        .after_help(EXAMPLES)
        .arg(Arg::new("model").value_name("MODEL").required(true).help("A name from `list`, or a file"))
        .arg(
            option("out", "FILE.html", "The file to write")
                .required(true)
                .value_parser(value_parser!(PathBuf)),
        )
        .args(of_values())
        .arg(option("step", "TIME", "Step in s, or with a unit [default: as declared, 0.5ms, or its own]"))
        .arg(option("end", "TIME", "The time that curves and speed are laid out for [default: 1s]"))
}

const EXAMPLES: &str = "\
Examples:
  mbs export page double-pendulum --out pendulum.html
  mbs export page slider-crank --set omega=30rpm --end 4s --out slow.html
  mbs export page my.mbs --step 0.1ms --end 4s --out my.html

The file needs no network and no server: the mechanism is in it as WebAssembly. Numbers are
those of `simulate` to the bit, as far as functions of the browser agree with Rust's: those
other than sine, cosine and square root may not.";

pub(super) fn run(models: &Models, matches: &ArgMatches) -> Result<(), Error> {
    let name = matches.get_one::<String>("model").map_or("", String::as_str);
    let path = matches.get_one::<PathBuf>("out").cloned().unwrap_or_default();
    let found = models.find(name)?;
    let model = found.model();
    let settings = settings(model, matches)?;
    let html = model.interactive_page(found.name(), &settings)?;
    files::write(&path, html.as_bytes())?;
    say(format_args!("written: {}", path.display()))?;
    if let [event, ..] = model.info().events {
        let name = event.name;
        complain(format_args!(
            "note: the page makes constant steps and looks for no events such as `{name}`"
        ));
    }
    Ok(())
}
