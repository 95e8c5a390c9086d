//! `mbs fit`: values with which a mechanism moves as measured.

mod request;
mod result;

use std::path::PathBuf;
use std::time::{Duration, Instant};

use clap::{Arg, ArgAction, ArgMatches, Command, value_parser};
use indicatif::ProgressBar;
use mbs_analysis::{Fit, Trials};

use self::request::Request;
use self::result::Shown;
use super::operating;
use super::options::{self, option};
use crate::app::Warnings;
use crate::figure::Figure;
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

pub(crate) fn command() -> Command {
    let file = |name: &'static str, value: &'static str, help: &'static str| {
        option(name, value, help).value_parser(value_parser!(PathBuf))
    };
    let list = |name: &'static str, value: &'static str, help: &'static str| {
        option(name, value, help).value_delimiter(',').action(ArgAction::Append)
    };
    Command::new("fit")
        .about(
            "Find parameters with which a mechanism moves as measured, and how well the data determine them",
        )
        .after_help(EXAMPLES)
        .arg(Arg::new("model").value_name("MODEL").required(true).help("A name from `list`, or a file"))
        .args(options::of_values())
        .arg(file("data", "FILE.csv", "The measured motion").required(true))
        .arg(list("param", "NAME[=GUESS],…", "Parameters to be found [guess: as declared or by --set]"))
        .arg(list("start", "NAME[=GUESS],…", "Start values to be found: a coordinate x or a rate der(x)"))
        .arg(
            option("bounds", "NAME=LOW..HIGH", "Where to look; an end may be left out; repeatable")
                .action(ArgAction::Append),
        )
        .arg(list(
            "columns",
            "NAME,…",
            "Columns to be compared, also patterns with * [default: coordinates, rates and outputs]",
        ))
        .arg(
            option(
                "sigma",
                "NAME=VALUE",
                "The standard deviation of the noise of a column [default: estimated]; repeatable",
            )
            .action(ArgAction::Append),
        )
        .arg(option(
            "confidence",
            "PERCENT",
            "The probability with which an interval contains the true value [default: 95%]",
        ))
        .arg(
            option("starts", "N", "Look from so many starts at most")
                .value_parser(value_parser!(u16).range(1..))
                .default_value("12"),
        )
        .arg(Arg::new("json").long("json").action(ArgAction::SetTrue).help("Print the result as JSON"))
        .arg(file("plot", "FILE.svg|.png", "Draw the data, the fitted motion and what is left over"))
        .arg(file("out", "FILE.csv", "Write the data, the fitted motion and what is left over"))
}

pub(crate) fn run(models: &Models, matches: &ArgMatches) -> Result<Warnings, Error> {
    let found = operating::named(models, matches)?;
    let (name, model) = (found.name(), found.model());
    let [plot, out] = ["plot", "out"].map(|name| matches.get_one::<PathBuf>(name));
    let data = matches.get_one::<PathBuf>("data");
    options::check_files([data, plot, out].into_iter().flatten().map(PathBuf::as_path))?;
    plot.map_or(Ok(()), |path| Figure::check_ending(path))?;
    let trials = found.trials()?;
    let request = Request::of(model, matches)?;
    let fit = fitted(&request, &*trials)?;
    let shown = Shown { name, info: model.info(), request: &request, fit: &fit };
    if let Some(path) = plot {
        shown.figure().save(path)?;
    }
    if let Some(path) = out {
        write_csv(path, &shown.columns())?;
    }
    if matches.get_flag("json") {
        say(shown.json())?;
    } else {
        say(shown.tables().trim_end())?;
        [plot, out]
            .into_iter()
            .flatten()
            .try_for_each(|path| say(format_args!("written: {}", path.display())))?;
    }
    Ok(shown.warnings())
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
