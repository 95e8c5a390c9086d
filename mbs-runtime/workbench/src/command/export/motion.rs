//! `mbs export svg` and `mbs export gif`: a motion as a picture that moves by itself.

use std::path::PathBuf;

use clap::{Arg, Args};

use super::svg;
use crate::command::options::{Named, Run, signed};
use crate::command::simulate::recorded;
use crate::figure::gif;
use crate::models::Models;
use crate::picture::Picture;
use crate::{Error, files, say, sweep};

/// A format of pictures that move.
pub(super) struct Format {
    /// How its files end.
    ending: &'static str,
    pub about: &'static str,
    pub examples: &'static str,
    /// The file of a picture under a name.
    written: fn(&str, &Picture) -> Result<Vec<u8>, Error>,
}

pub(super) const SVG: Format = Format {
    ending: "svg",
    about: "Write a motion as a picture that moves by itself and begins again at its end",
    examples: "\
The picture has no script. It takes as long as the motion; a whole period makes it go round without a jump.

Examples:
  mbs export svg four-bar --set omega=60rpm --end 1s --out four_bar.svg
  mbs export svg jansen-walker --set omega=30rpm --end 2s --out walker.svg",
    written: |name, picture| Ok(svg::animated(name, picture).into_bytes()),
};

pub(super) const GIF: Format = Format {
    ending: "gif",
    about: "Write a motion as a GIF, for programs that show no SVG which moves",
    examples: "\
It takes as long as the motion, in 200 frames or less; a whole period makes it go round without a jump.
A slower motion is one of slower drives, as below.

Examples:
  mbs export gif four-bar --set omega=60rpm --end 1s --out four_bar.gif
  mbs export gif jansen-walker --set omega=30rpm --end 2s --out walker.gif",
    written: |name, picture| Ok(gif(name, picture, |frames, draw| sweep::map("frames", frames, draw))?),
};

#[derive(Args)]
#[command(mut_args(signed))]
pub(super) struct Arguments {
    #[command(flatten)]
    model: Named,
    /// The picture to write
    #[arg(long)]
    out: PathBuf,
    #[command(flatten)]
    run: Run,
}

impl Format {
    /// Says in the help how the file to write ends.
    pub fn ends(&self) -> impl FnMut(Arg) -> Arg {
        let name = format!("FILE.{}", self.ending);
        move |arg| if arg.get_id() == "out" { arg.value_name(name.clone()) } else { arg }
    }
}

impl Arguments {
    pub fn run(&self, format: &Format, models: &Models) -> Result<(), Error> {
        let path = &self.out;
        if path.extension().is_none_or(|ending| !ending.eq_ignore_ascii_case(format.ending)) {
            let reason = format!("a picture of `mbs export {0}` ends in .{0}", format.ending);
            return Err(Error::Name { name: path.display().to_string(), reason });
        }
        let found = self.model.find(models)?;
        let (name, model) = (found.name(), found.model());
        let settings = self.run.settings(model)?;
        let recording = recorded(model, &settings)?;
        let picture = Picture::of(&model.motion(&settings, &recording)?);
        files::write(path, &(format.written)(name, &picture)?)?;
        if let Some(cause) = recording.ended {
            let kept = format!("; the motion up to there is in {}", path.display());
            return Err(Error::EndedEarly { cause, kept });
        }
        say(format_args!("written: {}", path.display()))
    }
}
