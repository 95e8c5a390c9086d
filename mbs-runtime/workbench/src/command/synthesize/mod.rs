//! `mbs synthesize`: dimensions with which a mechanism passes given positions.

mod request;
mod result;

use std::path::PathBuf;
use std::sync::atomic::Ordering;

use clap::{Args, value_parser};
use indicatif::{ProgressBar, ProgressStyle};

use self::request::task;
use self::result::Shown;
use super::options::{self, Named, Values, signed};
use crate::figure::Save;
use crate::models::Models;
use crate::{Error, interrupt, say, write_csv};

const EXAMPLES: &str = "\
Examples:
  mbs synthesize my.mbs --through points.csv --param l1=20mm..90mm,l2=20mm..90mm,px=-1m..1m --drive theta1
  mbs synthesize my.mbs --through line.csv --param l1=0.1..2,l2=0.1..2 --tolerance 0.2mm --sketch found.svg

Each row of the table is a position, in the order in which they are to be passed; its columns have the
names of coordinates and outputs, with units in brackets. An empty cell is free. With a column of the
driving coordinate the timing is prescribed; without it the positions may be passed at any time.";

#[derive(Args)]
#[command(
    about = "Find dimensions with which a mechanism passes given positions, in order and without a defect",
    after_help = EXAMPLES,
    mut_args(signed),
)]
pub(crate) struct Arguments {
    #[command(flatten)]
    model: Named,
    #[command(flatten)]
    values: Values,
    /// The positions
    #[arg(long, value_name = "FILE.csv")]
    through: PathBuf,
    /// Parameters to be found, between these values
    #[arg(long, value_name = "NAME=LOW..HIGH,…", required = true, value_delimiter = ',')]
    param: Vec<String>,
    /// The coordinate that drives, and must not turn back on the way
    #[arg(long, value_name = "NAME")]
    drive: Option<String>,
    /// By how much a value may be missed: 0.1mm, 0.5deg [default: 1e-9]
    #[arg(long, value_name = "VALUE")]
    tolerance: Option<String>,
    /// Look from so many random starts at most
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(1..), default_value = "20000")]
    starts: u32,
    /// Stop when so many mechanisms are found
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(1..), default_value = "1")]
    enough: u32,
    /// Other random starts
    #[arg(long, value_name = "N", default_value = "0")]
    seed: u64,
    /// Print the result as JSON
    #[arg(long)]
    json: bool,
    /// Draw what was asked for, and what the best mechanism does
    #[arg(long, value_name = "FILE.svg|.png")]
    plot: Option<PathBuf>,
    /// Draw the best mechanism on its way
    #[arg(long, value_name = "FILE.svg|.png")]
    sketch: Option<PathBuf>,
    /// Write the coordinates of the best mechanism on its way
    #[arg(long, value_name = "FILE.csv")]
    out: Option<PathBuf>,
}

impl Arguments {
    pub fn run(&self, models: &Models) -> Result<(), Error> {
        let found = self.model.find(models)?;
        let (name, model) = (found.name(), found.model());
        let [plot, sketch, out] = [&self.plot, &self.sketch, &self.out].map(Option::as_deref);
        options::check_files(Some(&self.through), &[plot, sketch], &[out])?;
        let trials = found.trials()?;
        let (task, units) = task(model, self)?;
        let style = ProgressStyle::with_template("{bar:40} {pos}/{len} starts, {msg}");
        let bar = ProgressBar::new(task.starts as u64)
            .with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        let interrupted = interrupt::flag();
        let synthesis = task.synthesize_while(&*trials, &mut |starts, found| {
            bar.set_position(starts as u64);
            bar.set_message(format!("{found} found"));
            !interrupted.load(Ordering::Relaxed)
        });
        let is_over = interrupted.load(Ordering::Relaxed);
        drop(interrupted);
        bar.finish_and_clear();
        let synthesis = synthesis?;
        let shown = Shown { name, model, task: &task, units: &units, synthesis: &synthesis };
        if is_over && synthesis.linkages.is_empty() {
            return Err(Error::Stopped {
                kept: format!(" after {} starts, which found nothing", synthesis.starts),
            });
        }
        let best = shown.best()?;
        if let Some(path) = plot {
            shown.figure(best)?.save(path)?;
        }
        if let Some(path) = sketch {
            shown.sketch(best)?.save(path)?;
        }
        if let Some(path) = out {
            write_csv(path, &shown.columns(best))?;
        }
        if self.json {
            say(shown.json())?;
        } else {
            say(shown.table().trim_end())?;
            options::say_written([plot, sketch, out])?;
        }
        if is_over {
            let kept = format!(" after {} starts; what they found is told and written", synthesis.starts);
            return Err(Error::Stopped { kept });
        }
        Ok(())
    }
}
