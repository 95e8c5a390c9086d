//! `mbs synthesize`: dimensions with which a mechanism passes given positions.

mod request;
mod result;

use std::path::PathBuf;
use std::sync::atomic::Ordering;

use clap::{Arg, ArgAction, ArgMatches, Command, value_parser};
use indicatif::{ProgressBar, ProgressStyle};

use self::request::task;
use self::result::Shown;
use super::operating;
use super::options::{self, option};
use crate::figure::Figure;
use crate::models::Models;
use crate::{Error, interrupt, say, write_csv};

const EXAMPLES: &str = "\
Examples:
  mbs synthesize my.mbs --through points.csv --param l1=20mm..90mm,l2=20mm..90mm,px=-1m..1m --drive theta1
  mbs synthesize my.mbs --through line.csv --param l1=0.1..2,l2=0.1..2 --tolerance 0.2mm --sketch found.svg

Each row of the table is a position, in the order in which they are to be passed; its columns have the
names of coordinates and outputs, with units in brackets. An empty cell is free. With a column of the
driving coordinate the timing is prescribed; without it the positions may be passed at any time.";

pub(crate) fn command() -> Command {
    let file = |name: &'static str, value: &'static str, help: &'static str| {
        option(name, value, help).value_parser(value_parser!(PathBuf))
    };
    let number = |name: &'static str, help: &'static str, default: &'static str| {
        option(name, "N", help).value_parser(value_parser!(u32).range(1..)).default_value(default)
    };
    Command::new("synthesize")
        .about("Find dimensions with which a mechanism passes given positions, in order and without a defect")
        .after_help(EXAMPLES)
        .arg(Arg::new("model").value_name("MODEL").required(true).help("A name from `list`, or a file"))
        .args(options::of_values())
        .arg(file("through", "FILE.csv", "The positions").required(true))
        .arg(
            option("param", "NAME=LOW..HIGH,…", "Parameters to be found, between these values")
                .required(true)
                .value_delimiter(',')
                .action(ArgAction::Append),
        )
        .arg(option("drive", "NAME", "The coordinate that drives, and must not turn back on the way"))
        .arg(option("tolerance", "VALUE", "By how much a value may be missed: 0.1mm, 0.5deg [default: 1e-9]"))
        .arg(number("starts", "Look from so many random starts at most", "20000"))
        .arg(number("enough", "Stop when so many mechanisms are found", "1"))
        .arg(option("seed", "N", "Other random starts").value_parser(value_parser!(u64)).default_value("0"))
        .arg(Arg::new("json").long("json").action(ArgAction::SetTrue).help("Print the result as JSON"))
        .arg(file("plot", "FILE.svg|.png", "Draw what was asked for, and what the best mechanism does"))
        .arg(file("sketch", "FILE.svg|.png", "Draw the best mechanism on its way"))
        .arg(file("out", "FILE.csv", "Write the coordinates of the best mechanism on its way"))
}

pub(crate) fn run(models: &Models, matches: &ArgMatches) -> Result<(), Error> {
    let found = operating::named(models, matches)?;
    let (name, model) = (found.name(), found.model());
    let path = |name: &str| matches.get_one::<PathBuf>(name);
    let [through, plot, sketch, out] = ["through", "plot", "sketch", "out"].map(path);
    options::check_files([through, plot, sketch, out].into_iter().flatten().map(PathBuf::as_path))?;
    [plot, sketch].into_iter().flatten().try_for_each(|path| Figure::check_ending(path))?;
    let trials = found.trials()?;
    let (task, units) = task(model, matches)?;
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
    if matches.get_flag("json") {
        say(shown.json())?;
    } else {
        say(shown.table().trim_end())?;
        let mut files = [plot, sketch, out].into_iter().flatten();
        files.try_for_each(|path| say(format_args!("written: {}", path.display())))?;
    }
    if is_over {
        let kept = format!(" after {} starts; what they found is told and written", synthesis.starts);
        return Err(Error::Stopped { kept });
    }
    Ok(())
}
