//! `mbs sweep`: one mechanism over a grid of one or two parameters.

mod axis;
pub(super) mod checked;
mod rows;
pub(super) mod shard;
mod shown;
mod watched;

use std::fmt;
use std::ops::Range;
use std::path::{Path, PathBuf};

use clap::{Args, ValueEnum};

use self::axis::{Evenly, Grid, GridAxis};
use self::rows::Rows;
use self::shard::{Head, Heading, Shard, There};
use self::watched::{Watched, watched};
use super::options::{self, Named, Run};
use crate::console::{Warnings, complain};
use crate::figure::Save;
use crate::members::{Extent, Member, Members};
use crate::models::Models;
use crate::notes::{end_note, lost_start_values};
use crate::sweep::Progress;
use crate::{Error, Model, Settings, Signals, Start, interrupt, say};

const EXAMPLE: &str = "\
Example:
  mbs sweep slider-crank --param l1=50mm..80mm:31 --param omega=100rpm..300rpm:41 \\
      --output drive_torque --end 0.6s --out sweep.csv --plot sweep.svg

A run that fails is a gap in the picture and says why in the table. A file is there
once the sweep is complete. Ctrl-C ends it early: the runs that are finished are summed
up, their rows are in a file FILE.csv.….part, and the exit code is 130. If some runs fail
or give what is no number, the exit code is 3; if all do, 1.

On many machines, each makes a share of the runs, in any order:
  mbs sweep slider-crank --param l1=50mm..80mm:31 --shard 3/16 --out part-3.csv
  mbs merge part-*.csv --out sweep.csv
The same command goes on where it was ended, makes again what is missing of a damaged file, and does nothing if
its file is complete.";

#[derive(Args)]
#[command(
    about = "Simulate a mechanism over a grid of one or two parameters",
    after_help = EXAMPLE,
    mut_args(options::signed),
)]
pub(crate) struct Arguments {
    #[command(flatten)]
    model: Named,
    /// A parameter and its values, both ends included, such as l1=50mm..120mm:20; once or twice
    #[arg(long, value_name = "NAME=LOW..HIGH:COUNT", required = true)]
    param: Vec<String>,
    /// An output or a coordinate to look at; repeatable [default: all outputs]
    #[arg(long, value_name = "NAME")]
    output: Vec<String>,
    /// What of it is drawn; a peak is the largest magnitude
    #[arg(long, value_name = "WHAT", default_value = "peak")]
    show: Shown,
    #[command(flatten)]
    run: Run,
    /// Write smallest, largest and final values, a row for every run
    #[arg(long, value_name = "FILE.csv")]
    out: Option<PathBuf>,
    /// Draw curves over one parameter, heat maps over two
    #[arg(long, value_name = "FILE.svg|.png")]
    plot: Option<PathBuf>,
    /// Make the K-th of N shares of the runs, and write it to --out; `mbs merge` puts the shares together
    #[arg(long, value_name = "K/N", requires = "out", conflicts_with_all = ["plot", "json", "show"])]
    shard: Option<String>,
    /// Print the summary as JSON
    #[arg(long)]
    json: bool,
}

/// The number of an extent that is drawn and summed up.
#[derive(Clone, Copy, ValueEnum)]
enum Shown {
    Peak,
    Max,
    Min,
    Final,
}

impl Shown {
    fn of(self, extent: &Extent) -> f64 {
        match self {
            Self::Peak => extent.high.abs().max(extent.low.abs()),
            Self::Max => extent.high,
            Self::Min => extent.low,
            Self::Final => extent.last,
        }
    }

    fn word(self) -> &'static str {
        match self {
            Self::Peak => "peak",
            Self::Max => "max",
            Self::Min => "min",
            Self::Final => "final",
        }
    }
}

/// Why the row of a run lacks numbers.
enum Failure {
    Run(mbs_runtime::Error),
    NotFinite(&'static str),
}

impl Failure {
    fn of(member: &Member, watched: &[Watched]) -> Option<Self> {
        let extents = match member {
            Ok(extents) => extents,
            Err(error) => return Some(Self::Run(*error)),
        };
        let is_finite =
            |extent: &Extent| [extent.low, extent.high, extent.last].iter().all(|x| x.is_finite());
        let bad = watched.iter().find(|quantity| !extents.get(quantity.at).is_some_and(is_finite))?;
        Some(Self::NotFinite(bad.name))
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Run(error) => error.fmt(f),
            Self::NotFinite(name) => write!(f, "`{name}` is not always a finite number"),
        }
    }
}

/// Start values that the constraints move at an end of what is swept, and a run that ends beside `--end`.
fn start_notes(model: &dyn Model, settings: &Settings, grid: &Grid) -> Vec<String> {
    let at_end = |value: fn(&Evenly) -> f64| {
        let mut settings = settings.clone();
        let values = grid.axes.iter().map(|axis| (axis.name.to_owned(), value(&axis.values)));
        settings.parameters.extend(values);
        settings
    };
    let ends = [("smallest", at_end(|values| values.low)), ("largest", at_end(|values| values.high))];
    let lost = ends.iter().flat_map(|(which, settings)| {
        let lost = lost_start_values(model, settings).into_iter();
        lost.map(move |note| format!("with the {which} values of what is swept, {note}"))
    });
    let run = ends.iter().find_map(|(_, settings)| model.start(&Start::of(model, settings).ok()?).ok());
    let steps = run.and_then(|mut run| Some((run.ends_at(settings.end).ok()?, run)));
    lost.chain(steps.and_then(|(steps, run)| end_note(&*run, steps, settings.end))).collect()
}

impl Arguments {
    pub fn run(&self, models: &Models) -> Result<Warnings, Error> {
        let found = self.model.find(models)?;
        let (name, model) = (found.name(), found.model());
        let settings = self.run.settings(model)?;
        let axes = self.param.iter().map(|text| GridAxis::parse(text, model.info()));
        let grid = Grid::of(axes.collect::<Result<_, _>>()?)?;
        grid.check_against(&settings)?;
        let notes = settings.signals.iter().flat_map(Signals::notes);
        let notes = notes.chain(start_notes(model, &settings, &grid));
        notes.for_each(|note| complain(format_args!("note: {note}")));
        let watched = watched(model, &self.output)?;
        let [out, plot] = [&self.out, &self.plot].map(Option::as_deref);
        // before the work, so that a bad name is told at once
        options::check_files(None, &[plot], &[out])?;
        if let (Some(text), Some(path)) = (&self.shard, out) {
            let heading = Heading::of(Shard::parse(text)?, model, &settings, &grid, &watched);
            let columns = rows::columns(&grid, &watched).map_err(Error::file("write", path))?;
            return share(name, model, &settings, (&grid, &watched), &Head { heading, columns }, path);
        }
        let mut sweep = Sweep {
            rows: out.map(|path| Rows::create(path, &grid, &watched)).transpose()?,
            members: 0..grid.count(),
            values: vec![vec![f64::NAN; grid.count()]; watched.len()],
            failures: 0,
            first_failure: None,
            grid: &grid,
            watched: &watched,
            shown: self.show,
            json: self.json,
        };
        match sweep.carry_out(name, model, &settings) {
            Err(Error::Interrupted { finished, of, .. }) => sweep.give_up(finished, of),
            Err(error) => Err(error),
            Ok(()) => sweep.finish(name, plot),
        }
    }
}

/// Makes a share of the runs, those that its file does not have yet.
fn share(
    name: &str,
    model: &dyn Model,
    settings: &Settings,
    (grid, watched): (&Grid, &[Watched]),
    head: &Head,
    path: &Path,
) -> Result<Warnings, Error> {
    let Range { start, end } = head.heading.shard.members(grid.count());
    match head.there(path)? {
        There::Complete => {
            say(format_args!("complete already: {}, {} runs", path.display(), end - start))?;
            return Ok(Warnings::new());
        }
        There::Damaged(reason) => {
            complain(format_args!("note: {}, {reason}; what is missing is made again", path.display()));
        }
        There::Nothing => {}
    }
    let (rows, there) = Rows::share(path, head)?;
    let members = (start + there).min(end)..end;
    let count = members.len();
    let mut sweep = Sweep {
        rows: Some(rows),
        members,
        values: Vec::new(),
        failures: 0,
        first_failure: None,
        grid,
        watched,
        shown: Shown::Peak,
        json: false,
    };
    match sweep.carry_out(name, model, settings) {
        Err(Error::Interrupted { finished, .. }) => {
            let kept = sweep.rows.take().map(Rows::give_up).transpose()?;
            let kept = kept.map_or_else(String::new, |path| {
                format!("; their rows are in {}, and the same command goes on behind them", path.display())
            });
            return Err(Error::Interrupted { finished, of: count, kept });
        }
        done => done?,
    }
    let written = sweep.rows.take().map(Rows::finish).transpose()?.unwrap_or_default();
    let earlier = if there == 0 { String::new() } else { format!(", {there} of them earlier") };
    say(format_args!("written: {}, {} runs{earlier}", written.display(), end - start))?;
    let failure = sweep.failure();
    // a row says why a run failed, and other shares may do better
    Ok(failure.map(|failure| failure.to_string()).into_iter().collect())
}

struct Sweep<'a> {
    rows: Option<Rows>,
    /// The runs that are made.
    members: Range<usize>,
    /// The shown numbers, quantity by quantity; NaN where a run failed, empty for a share.
    values: Vec<Vec<f64>>,
    failures: usize,
    first_failure: Option<(usize, Failure)>,
    grid: &'a Grid,
    watched: &'a [Watched],
    shown: Shown,
    json: bool,
}

impl Sweep<'_> {
    fn carry_out(&mut self, name: &str, model: &dyn Model, settings: &Settings) -> Result<(), Error> {
        let (grid, mut written) = (self.grid, Ok(()));
        let Range { start: first, end } = self.members;
        let count = end - first;
        let progress = Progress::new(name, count);
        let interrupted = interrupt::flag();
        let members = Members {
            names: grid.axes.iter().map(|axis| axis.name.to_owned()).collect(),
            count,
            values: &|index| grid.values(first + index),
            take: &mut |index, member| {
                if written.is_ok() {
                    written = self.take(first + index, &member);
                }
            },
            progress: &|done| progress.reached(done),
            cancel: &interrupted,
        };
        let swept = model.sweep(settings, members);
        progress.finish();
        swept.and(written)
    }

    fn take(&mut self, index: usize, member: &Member) -> Result<(), Error> {
        for (values, quantity) in self.values.iter_mut().zip(self.watched) {
            let extent = member.as_ref().ok().and_then(|extents| extents.get(quantity.at));
            if let (Some(value), Some(extent)) = (values.get_mut(index), extent) {
                *value = self.shown.of(extent);
            }
        }
        let failure = Failure::of(member, self.watched);
        if let Some(rows) = &mut self.rows {
            let error = failure.as_ref().map_or_else(String::new, ToString::to_string);
            rows.write(self.grid, index, self.watched, member, &error)?;
        }
        if let Some(failure) = failure {
            self.failures += 1;
            self.first_failure.get_or_insert((index, failure));
        }
        Ok(())
    }

    /// Ends an interrupted sweep: keeps its rows, and prints the summary of the runs that it finished.
    fn give_up(mut self, finished: usize, of: usize) -> Result<Warnings, Error> {
        let part = self.rows.take().map(Rows::give_up).transpose()?;
        if self.failures < finished {
            self.say_summary(&[])?;
        }
        let kept = part.map_or_else(String::new, |path| format!("; their rows are in {}", path.display()));
        Err(Error::Interrupted { finished, of, kept })
    }

    fn finish(mut self, name: &str, plot: Option<&Path>) -> Result<Warnings, Error> {
        let mut files = Vec::new();
        if let Some(path) = plot {
            self.figure(name).save(path)?;
            files.push(path.to_owned());
        }
        if let Some(rows) = self.rows.take() {
            files.insert(0, rows.finish()?);
        }
        let count = self.grid.count();
        if self.failures < count {
            self.say_summary(&files)?;
        }
        match self.failure() {
            Some(failure) if self.failures == count => Err(failure),
            Some(failure) => Ok(vec![failure.to_string()]),
            None => Ok(Warnings::new()),
        }
    }

    /// How many runs failed, and why the first one did.
    fn failure(&self) -> Option<Error> {
        self.first_failure.as_ref().map(|(at, cause)| Error::Sweep {
            failed: self.failures,
            of: self.members.len(),
            first: self.grid.place(*at),
            cause: cause.to_string(),
        })
    }
}
