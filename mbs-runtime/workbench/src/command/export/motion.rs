//! `mbs export svg` and `mbs export gif`: a motion as a picture that moves by itself.

use std::path::PathBuf;

use clap::{Arg, ArgMatches, Command, value_parser};

use super::svg;
use crate::command::options::{self, option};
use crate::command::simulate::recorded;
use crate::figure::gif::gif;
use crate::models::Models;
use crate::picture::Picture;
use crate::{Error, files, say};

/// A format of pictures that move.
pub(super) struct Format {
    /// The command, and how its files end.
    name: &'static str,
    file: &'static str,
    about: &'static str,
    examples: &'static str,
    /// The file of a picture under a name.
    written: fn(&str, &Picture) -> Result<Vec<u8>, Error>,
}

pub(super) const FORMATS: [Format; 2] = [
    Format {
        name: "svg",
        file: "FILE.svg",
        about: "Write a motion as a picture that moves by itself and begins again at its end",
        examples: "\
The picture has no script. It takes as long as the motion; a whole period makes it go round without a jump.

Examples:
  mbs export svg four-bar --set omega=60rpm --end 1s --out four_bar.svg
  mbs export svg jansen-walker --set omega=30rpm --end 2s --out walker.svg",
        written: |name, picture| Ok(svg::animated(name, picture).into_bytes()),
    },
    Format {
        name: "gif",
        file: "FILE.gif",
        about: "Write a motion as a GIF, for programs that show no SVG which moves",
        examples: "\
It takes as long as the motion, in 200 frames or less; a whole period makes it go round without a jump.
A slower motion is one of slower drives, as below.

Examples:
  mbs export gif four-bar --set omega=60rpm --end 1s --out four_bar.gif
  mbs export gif jansen-walker --set omega=30rpm --end 2s --out walker.gif",
        written: gif,
    },
];

pub(super) fn command(format: &Format) -> Command {
    Command::new(format.name)
        .about(format.about)
        .after_help(format.examples)
        .arg(Arg::new("model").value_name("MODEL").required(true).help("A name from `list`, or a file"))
        .arg(
            option("out", format.file, "The picture to write")
                .required(true)
                .value_parser(value_parser!(PathBuf)),
        )
        .args(options::of_a_run())
}

/// Whether a subcommand is this format's.
pub(super) fn is(format: &Format, name: &str) -> bool {
    format.name == name
}

pub(super) fn run(format: &Format, models: &Models, matches: &ArgMatches) -> Result<(), Error> {
    let text = |name: &str| matches.get_one::<String>(name).map(String::as_str);
    let path = matches.get_one::<PathBuf>("out").cloned().unwrap_or_default();
    if path.extension().is_none_or(|ending| !ending.eq_ignore_ascii_case(format.name)) {
        let reason = format!("a picture of `mbs export {0}` ends in .{0}", format.name);
        return Err(Error::Name { name: path.display().to_string(), reason });
    }
    let found = models.find(text("model").unwrap_or_default())?;
    let (name, model) = (found.name(), found.model());
    let settings = options::settings(model, matches)?;
    let recording = recorded(model, &settings)?;
    let picture = Picture::of(&model.motion(&settings, &recording)?);
    files::write(&path, &(format.written)(name, &picture)?)?;
    if let Some(cause) = recording.ended {
        let kept = format!("; the motion up to there is in {}", path.display());
        return Err(Error::EndedEarly { cause, kept });
    }
    say(format_args!("written: {}", path.display()))
}
