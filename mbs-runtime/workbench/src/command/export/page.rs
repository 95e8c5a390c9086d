//! `mbs export page`: a mechanism as a page in which it runs.

use std::path::PathBuf;

use clap::Args;

use super::settings;
use crate::command::options::{Named, Values, signed};
use crate::console::complain;
use crate::{Error, Models, files, say};

#[derive(Args)]
#[command(
    about = "Write a mechanism as one HTML file in which it runs, offline, to change and to drag",
    after_help = EXAMPLES,
    mut_args(signed),
)]
pub(super) struct Arguments {
    #[command(flatten)]
    model: Named,
    /// The file to write
    #[arg(long, value_name = "FILE.html")]
    out: PathBuf,
    #[command(flatten)]
    values: Values,
    /// Step in s, or with a unit [default: as declared, 0.5ms, or its own]
    #[arg(long, value_name = "TIME")]
    step: Option<String>,
    /// The time that curves and speed are laid out for [default: 1s]
    #[arg(long, value_name = "TIME")]
    end: Option<String>,
}

const EXAMPLES: &str = "\
Examples:
  mbs export page double-pendulum --out pendulum.html
  mbs export page slider-crank --set omega=30rpm --end 4s --out slow.html
  mbs export page my.mbs --step 0.1ms --end 4s --out my.html

The file needs no network and no server: the mechanism is in it as WebAssembly. Numbers are
those of `simulate` to the bit, as far as functions of the browser agree with Rust's: those
other than sine, cosine and square root may not.";

impl Arguments {
    pub fn run(&self, models: &Models) -> Result<(), Error> {
        let found = self.model.find(models)?;
        let (model, path) = (found.model(), &self.out);
        let options = self.values.asked(model.info())?;
        let settings = settings(model, options, self.step.as_ref(), self.end.as_ref())?;
        let html = model.interactive_page(found.name(), &settings)?;
        files::write(path, html.as_bytes())?;
        say(format_args!("written: {}", path.display()))?;
        if let [event, ..] = model.info().events {
            let name = event.name;
            complain(format_args!(
                "note: the page makes constant steps and looks for no events such as `{name}`"
            ));
        }
        Ok(())
    }
}
