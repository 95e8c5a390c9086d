//! `mbs simulate`: one run of one mechanism, or some that are compared.

use std::path::{Path, PathBuf};

use clap::{Args, value_parser};
use indicatif::{ProgressBar, ProgressStyle};

use super::compare::{self, Comparison};
use super::curves::{Choice, curves};
use super::options::{self, Named, Run, pairs, signed};
use super::{json, page};
use crate::console::{Warnings, complain};
use crate::figure::{Figure, Save};
use crate::models::Models;
use crate::{Error, Model, Picture, Recording, RunOptions, Settings, say, write_csv};

#[derive(Args)]
#[command(about = "Simulate a mechanism and record its motion", after_help = EXAMPLES, mut_args(signed))]
pub(crate) struct Arguments {
    #[command(flatten)]
    model: Named,
    #[command(flatten)]
    run: Run,
    /// End where this becomes true, 'x3 > 200mm' or 'der(theta) < 0', or at this event, stop or mode; a run to a
    /// tolerance
    #[arg(long, value_name = "CONDITION")]
    until: Option<String>,
    /// Start with this value of a coordinate x or a rate der(x), the others following; repeatable
    #[arg(long, value_name = "NAME=VALUE")]
    from: Vec<String>,
    /// Record every N-th step
    #[arg(long, value_name = "N", value_parser = value_parser!(u64).range(1..), default_value = "1")]
    every: u64,
    /// Record, draw and print these: x1, der(theta*), lambda(pin*), …
    #[arg(long, value_name = "NAME,…", value_delimiter = ',')]
    columns: Vec<String>,
    /// Draw over this instead of time
    #[arg(long, value_name = "NAME")]
    x: Option<String>,
    /// Run once for each of these values of a parameter or input, in one picture
    #[arg(long, value_name = "NAME=VALUE,…", conflicts_with_all = ["sketch", "report"])]
    compare: Option<String>,
    /// Print all coordinates, however many there are
    #[arg(long)]
    all: bool,
    /// Print the summary as JSON
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    files: Files,
}

/// The files that a run is written to.
#[derive(Args, Clone)]
pub(super) struct Files {
    /// Write what was recorded
    #[arg(long, value_name = "FILE.csv")]
    pub out: Option<PathBuf>,
    /// Draw coordinates, outputs and violation, or --columns
    #[arg(long, value_name = "FILE.svg|.png")]
    pub plot: Option<PathBuf>,
    /// Draw the mechanism, its later poses and its paths
    #[arg(long, value_name = "FILE.svg|.png")]
    pub sketch: Option<PathBuf>,
    /// Write a page with the mechanism in motion and all curves
    #[arg(long, value_name = "FILE.html")]
    pub report: Option<PathBuf>,
}

const EXAMPLES: &str = "\
Examples:
  mbs simulate four-bar --columns 'theta*' --plot run.svg
  mbs simulate slider-crank-free --rtol 1e-8 --until 'x3 < 200mm'
  mbs simulate jansen --columns yf --x xf --plot path.svg
  mbs simulate slider-crank --compare omega=100rpm,200rpm --columns drive_torque --plot both.svg

A run whose numbers are in doubt is written as any other, with a warning and exit code 3.";

impl Arguments {
    pub fn run(&self, models: &Models) -> Result<Warnings, Error> {
        let found = self.model.find(models)?;
        let (name, model) = (found.name(), found.model());
        let mut options = RunOptions {
            from: pairs(&self.from)?,
            every: Some(self.every),
            finds_events: true,
            ..self.run.asked(model.info())?
        };
        self.until.as_ref().map_or(Ok(()), |text| options.set("until", text))?;
        let settings = options.settings(model)?;
        let choice = Choice { columns: self.columns.clone(), x: self.x.clone() };
        let request =
            Request { name, model, files: self.files.clone(), choice, all: self.all, json: self.json };
        request.files.check()?;
        // Whether there are such columns.
        request.choice.written(&Recording::empty(model.info()))?;
        match &self.compare {
            Some(text) => compare::carry_out(&request, &Comparison::of(model.info(), &settings, text)?),
            None => request.carry_out(&settings),
        }
    }
}

/// Runs a program that is given no command: simulates the mechanism as it is declared, records it to
/// `NAME.csv`, draws it to `NAME.svg` and `NAME-mechanism.svg`, and shows it in motion in `NAME.html`.
pub(crate) fn by_default(name: &str, model: &dyn Model) -> Result<Warnings, Error> {
    let path = |ending: &str| Some(PathBuf::from(format!("{name}{ending}")));
    let files = Files {
        out: path(".csv"),
        plot: path(".svg"),
        sketch: path("-mechanism.svg"),
        report: path(".html"),
    };
    Request { name, model, files, choice: Choice::default(), all: false, json: false }
        .carry_out(&model.defaults())
}

/// A run that is asked for, and its outputs.
pub(super) struct Request<'a> {
    pub name: &'a str,
    pub model: &'a dyn Model,
    pub files: Files,
    pub choice: Choice,
    pub all: bool,
    pub json: bool,
}

impl Files {
    pub fn all(&self) -> [Option<&Path>; 4] {
        [&self.out, &self.plot, &self.sketch, &self.report].map(Option::as_deref)
    }

    fn check(&self) -> Result<(), Error> {
        let [out, plot, sketch, report] = self.all();
        options::check_files(None, &[plot, sketch], &[out, report])
    }
}

impl Request<'_> {
    fn carry_out(&self, settings: &Settings) -> Result<Warnings, Error> {
        let recording = recorded(self.model, settings)?;
        let kept = self.write(settings, &recording)?;
        let warnings: Warnings = recording.doubts.iter().map(ToString::to_string).collect();
        if self.json {
            say(json::run(self, settings, &recording))?;
        }
        recording.notes.iter().for_each(|note| complain(format_args!("note: {note}")));
        if let Some(cause) = recording.ended {
            return Err(Error::EndedEarly { cause, kept });
        }
        if !self.json {
            say(self.table(settings, &recording)?.to_string().trim_end())?;
            options::say_written(self.files.all())?;
        }
        Ok(warnings)
    }

    /// Writes the files; says where the recording is, as a clause to append.
    fn write(&self, settings: &Settings, recording: &Recording) -> Result<String, Error> {
        let Files { out, plot, sketch, report } = &self.files;
        let mut kept = String::new();
        if let Some(path) = out {
            write_csv(path, &self.choice.written(recording)?)?;
            kept = format!("; the motion up to there is in {}", path.display());
        }
        if let Some(path) = plot {
            curves(self.name, recording, &self.choice)?.save(path)?;
        }
        if sketch.is_some() || report.is_some() {
            let picture = Picture::of(&self.model.motion(settings, recording)?);
            if let Some(path) = report {
                page::page(self.name, self.model.info(), recording, &picture, &self.choice)?.save(path)?;
            }
            if let Some(path) = sketch {
                Figure::mechanism(self.name, picture).save(path)?;
            }
        }
        Ok(kept)
    }

    fn table(&self, settings: &Settings, recording: &Recording) -> Result<crate::Table, Error> {
        let given = options::given(self.model.info(), settings);
        Ok(page::summary(self.name, &given, recording, self.shown(recording)?))
    }

    /// Whose values at the end are printed.
    pub fn shown<'r>(&self, recording: &'r Recording) -> Result<page::Shown<'r>, Error> {
        Ok(match (self.choice.columns.is_empty(), self.all) {
            (false, _) => page::Shown::Chosen(self.choice.drawn(recording)?),
            (true, true) => page::Shown::All,
            (true, false) => page::Shown::Ends,
        })
    }
}

/// A run with a progress bar.
pub(super) fn recorded(model: &dyn Model, settings: &Settings) -> Result<Recording, Error> {
    let bar = ProgressBar::new(0).with_style(
        ProgressStyle::with_template("{bar:40} {pos}/{len} steps, {eta} left")
            .unwrap_or_else(|_| ProgressStyle::default_bar()),
    );
    let recording = model.simulate(settings, &mut |done, all| {
        bar.set_length(all);
        bar.set_position(done);
    });
    bar.finish_and_clear();
    recording
}
