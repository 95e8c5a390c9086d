//! `mbs export c`: a mechanism as C99.

use std::path::{Path, PathBuf};

use clap::builder::PossibleValuesParser;
use clap::{Arg, ArgMatches, Command, value_parser};
use mbs_live::Scalar;

use crate::command::options::option;
use crate::model::without_text;
use crate::{Error, Models, files, say};

pub(super) fn command() -> Command {
    Command::new("c")
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
        )
}

const EXAMPLES: &str = "\
Examples:
  mbs export c slider-crank --out c
  gcc -std=c99 -O2 c/*.c -lm -o slider_crank && ./slider_crank > run.csv";

pub(super) fn run(models: &Models, matches: &ArgMatches) -> Result<(), Error> {
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
