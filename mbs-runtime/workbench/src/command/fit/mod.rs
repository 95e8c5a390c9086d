//! `mbs fit`: values with which a mechanism moves as measured.

mod request;
mod result;

use std::path::PathBuf;
use std::time::{Duration, Instant};

use clap::{Args, value_parser};
use indicatif::ProgressBar;
use mbs_analysis::{Fit, Trials};

use self::request::Request;
use self::result::Shown;
use super::options::{self, Named, Values, signed};
use crate::console::Warnings;
use crate::figure::Save;
use crate::models::Models;
use crate::{Error, say, write_csv};

const EXAMPLES: &str = "\
Examples:
  mbs fit spring-mass-damper --data run.csv --param stiffness,damping --plot fit.svg
  mbs fit my.mbs --data measured.csv --param k=100N/m,c,m --start x --bounds c=0..50N*s/m
  mbs fit my.mbs --data measured.csv --param k,c --columns x --sigma x=0.2mm --input @force.csv

A column of the data is the time: the one called t or time, or the one in s, ms or such; each other
one has the name of a coordinate x, a rate der(x), an output or an input, with its unit as x [mm],
x (mm) or in a row beneath. Lines that begin with # or % are comments; cells are separated by
commas, semicolons or tabs, and the latter two may have decimal commas. Data that begin late on a
clock of their own, at 646 s for instance, are those of runs that begin then. A fit that is in doubt is written as any other, with a warning and exit code 3.";

/// Nobody is told of a fit that is over within this time.
const SOON: Duration = Duration::from_millis(700);

#[derive(Args)]
#[command(
    about = "Find parameters with which a mechanism moves as measured, and how well the data determine them",
    after_help = EXAMPLES,
    mut_args(signed),
)]
pub(crate) struct Arguments {
    #[command(flatten)]
    model: Named,
    #[command(flatten)]
    values: Values,
    /// The measured motion
    #[arg(long, value_name = "FILE.csv")]
    data: PathBuf,
    /// Parameters to be found [guess: as declared or by --set]
    #[arg(long, value_name = "NAME[=GUESS],…", value_delimiter = ',')]
    param: Vec<String>,
    /// Start values to be found: a coordinate x or a rate der(x)
    #[arg(long, value_name = "NAME[=GUESS],…", value_delimiter = ',')]
    start: Vec<String>,
    /// Where to look; an end may be left out; repeatable
    #[arg(long, value_name = "NAME=LOW..HIGH")]
    bounds: Vec<String>,
    /// Columns to be compared, also patterns with * [default: coordinates, rates and outputs]
    #[arg(long, value_name = "NAME,…", value_delimiter = ',')]
    columns: Vec<String>,
    /// The standard deviation of the noise of a column [default: estimated]; repeatable
    #[arg(long, value_name = "NAME=VALUE")]
    sigma: Vec<String>,
    /// The probability with which an interval contains the true value [default: 95%]
    #[arg(long, value_name = "PERCENT")]
    confidence: Option<String>,
    /// Look from so many starts at most
    #[arg(long, value_name = "N", value_parser = value_parser!(u16).range(1..), default_value = "12")]
    starts: u16,
    /// Print the result as JSON
    #[arg(long)]
    json: bool,
    /// Draw the data, the fitted motion and what is left over
    #[arg(long, value_name = "FILE.svg|.png")]
    plot: Option<PathBuf>,
    /// Write the data, the fitted motion and what is left over
    #[arg(long, value_name = "FILE.csv")]
    out: Option<PathBuf>,
}

impl Arguments {
    pub fn run(&self, models: &Models) -> Result<Warnings, Error> {
        let found = self.model.find(models)?;
        let (name, model) = (found.name(), found.model());
        let [plot, out] = [&self.plot, &self.out].map(Option::as_deref);
        options::check_files(Some(&self.data), &[plot], &[out])?;
        let trials = found.trials()?;
        let request = Request::of(model, self)?;
        let fit = fitted(&request, &*trials)?;
        let shown = Shown { name, info: model.info(), request: &request, fit: &fit };
        if let Some(path) = plot {
            shown.figure().save(path)?;
        }
        if let Some(path) = out {
            write_csv(path, &shown.columns())?;
        }
        if self.json {
            say(shown.json())?;
        } else {
            say(shown.tables().trim_end())?;
            options::say_written([plot, out])?;
        }
        Ok(shown.warnings())
    }
}

/// The fit, with a word about its progress where it takes long.
fn fitted(request: &Request, trials: &dyn Trials) -> Result<Fit, Error> {
    let (began, bar) = (Instant::now(), ProgressBar::hidden());
    let mut is_shown = false;
    let experiment = request.experiment();
    let fit = experiment.fit_while(trials, &mut |progress| {
        if began.elapsed() < SOON {
            return true;
        }
        if !is_shown {
            bar.set_draw_target(indicatif::ProgressDrawTarget::stderr());
            is_shown = true;
        }
        let mbs_analysis::Progress { start, starts, runs } = progress;
        bar.set_message(format!("start {start} of {starts} at most, {runs} runs"));
        bar.tick();
        true
    });
    bar.finish_and_clear();
    fit.map_err(|error| request.in_its_units(error))
}
