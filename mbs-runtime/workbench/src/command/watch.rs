//! `mbs watch`: a page that follows a file.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use clap::Args;

use super::curves::Choice;
use super::options::{Run, signed};
use super::page::page;
use crate::interactive::other_than_played;
use crate::watch::{News, Pages, Server, follow};
use crate::{Error, Picture, RunOptions, declarations, say};

#[derive(Args)]
#[command(
    about = "Show a mechanism in a browser, anew whenever its file is saved",
    after_help = EXAMPLES,
    mut_args(signed),
)]
pub(crate) struct Arguments {
    /// A declaration (.mbs), or a Rust file with one `mechanism! { … }`
    #[arg(value_name = "FILE")]
    file: PathBuf,
    #[command(flatten)]
    run: Run,
    /// The port of the page; a free one for 0
    #[arg(long, value_name = "PORT", default_value = "0")]
    port: u16,
}

const EXAMPLES: &str = "\
Examples:
  mbs new --file my.mbs
  mbs watch my.mbs --end 4s

The page shows the run as it was recorded, or the mechanism to play, to change and to drag. It can be
read on this machine alone. Ctrl-C ends it.";

impl Arguments {
    pub fn run(&self) -> Result<(), Error> {
        let (path, port) = (&self.file, self.port);
        let title =
            path.file_name().map_or_else(|| path.display().to_string(), |name| name.display().to_string());
        let news = Arc::new(News::default());
        let server = Server::start(&title, &news, port).map_err(|source| Error::Serve { port, source })?;
        say(format_args!("{} follows {}; Ctrl-C ends it", server.url(), path.display()))?;
        let make = || shown(path, &self.run).map_err(|error| error.to_string());
        // nothing is kept: Ctrl-C ends the program at once
        follow(path, &make, &news, &AtomicBool::new(false));
        Ok(())
    }
}

/// The pages of the mechanism as it is declared now.
fn shown(path: &Path, run: &Run) -> Result<Pages, Error> {
    let model = declarations::read(path, None)?;
    let options = RunOptions { finds_events: true, ..run.asked(model.info())? };
    let recorded = options.settings(&*model)?;
    let recording = model.simulate(&recorded, &mut |_, _| ())?;
    let picture = Picture::of(&model.motion(&recorded, &recording)?);
    let ended = recording.ended.as_ref().map(|cause| format!("The run ended early: {cause}."));
    let name = model.info().name;
    let mut page = page(name, model.info(), &recording, &picture, &Choice::default())?;
    if let (Some(section), Some(ended)) = (page.sections.get_mut(1), ended) {
        *section = section.clone().text(ended);
    }
    // a page looks for no events
    let settings = run.settings(&*model)?;
    let is_played = other_than_played(&settings).is_none();
    let played = is_played.then(|| model.interactive_page(name, &settings)).transpose()?;
    Ok(Pages { recorded: page.html()?, played })
}
