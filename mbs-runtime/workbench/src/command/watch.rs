//! `mbs watch`: a page that follows a file.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use clap::{Arg, ArgMatches, Command, value_parser};

use super::curves::Choice;
use super::options::{self, option, settings, settings_with_events};
use super::page::page;
use crate::interactive::other_than_played;
use crate::watch::{News, Pages, Server, follow};
use crate::{Error, Picture, declarations, say};

pub(crate) fn command() -> Command {
    Command::new("watch")
        .about("Show a mechanism in a browser, anew whenever its file is saved")
        .after_help(EXAMPLES)
        .arg(
            Arg::new("file")
                .value_name("FILE")
                .required(true)
                .value_parser(value_parser!(PathBuf))
                .help("A declaration (.mbs), or a Rust file with one `mechanism! { … }`"),
        )
        .args(options::of_a_run())
        .arg(
            option("port", "PORT", "The port of the page; a free one for 0")
                .value_parser(value_parser!(u16))
                .default_value("0"),
        )
}

const EXAMPLES: &str = "\
Examples:
  mbs new --file my.mbs
  mbs watch my.mbs --end 4s

The page shows the run as it was recorded, or the mechanism to play, to change and to drag. It can be
read on this machine alone. Ctrl-C ends it.";

pub(crate) fn run(matches: &ArgMatches) -> Result<(), Error> {
    let path: PathBuf = matches.get_one::<PathBuf>("file").cloned().unwrap_or_default();
    let port = matches.get_one::<u16>("port").copied().unwrap_or_default();
    let title =
        path.file_name().map_or_else(|| path.display().to_string(), |name| name.display().to_string());
    let news = Arc::new(News::default());
    let server = Server::start(&title, &news, port).map_err(|source| Error::Serve { port, source })?;
    say(format_args!("{} follows {}; Ctrl-C ends it", server.url(), path.display()))?;
    let make = || shown(&path, matches).map_err(|error| error.to_string());
    // nothing is kept: Ctrl-C ends the program at once
    follow(&path, &make, &news, &AtomicBool::new(false));
    Ok(())
}

/// The pages of the mechanism as it is declared now.
fn shown(path: &Path, matches: &ArgMatches) -> Result<Pages, Error> {
    let model = declarations::read(path, None)?;
    let recorded = settings_with_events(&*model, matches)?;
    let recording = model.simulate(&recorded, &mut |_, _| ())?;
    let picture = Picture::of(&model.motion(&recorded, &recording)?);
    let ended = recording.ended.as_ref().map(|cause| format!("The run ended early: {cause}."));
    let name = model.info().name;
    let mut page = page(name, model.info(), &recording, &picture, &Choice::default())?;
    if let (Some(section), Some(ended)) = (page.sections.get_mut(1), ended) {
        *section = section.clone().text(ended);
    }
    // a page looks for no events
    let settings = settings(&*model, matches)?;
    let is_played = other_than_played(&settings).is_none();
    let played = is_played.then(|| model.interactive_page(name, &settings)).transpose()?;
    Ok(Pages { recorded: page.html()?, played })
}
