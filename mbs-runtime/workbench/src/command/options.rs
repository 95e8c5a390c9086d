//! Arguments that several commands share: which mechanism, with which values, and how it is run.

use std::path::Path;

use clap::builder::PossibleValuesParser;
use clap::{Arg, Args};
use mbs_runtime::{Info, Stabilization};

use crate::figure::Figure;
use crate::files::{check_writable, note_read};
use crate::models::{Found, Models};
use crate::start::settable;
use crate::{Error, Model, RunOptions, Settings, Signals, Unit, quantity, say, start_state};

/// The mechanism.
#[derive(Args)]
pub(crate) struct Named {
    /// A name from `list`, or a file
    model: String,
}

/// The values of parameters and inputs.
#[derive(Args)]
pub(crate) struct Values {
    /// A parameter, such as omega=300rpm; a bare number is in the unit of `list`; repeatable
    #[arg(long, value_name = "NAME=VALUE")]
    set: Vec<String>,
    /// An input, in the same way; NAME=@FILE.csv with time and the input in columns, or @FILE.csv for all inputs
    /// that it has. Behind the file, the way from row to row (linear, cubic, monotone or step) and what is outside of
    /// them (hold, extend, periodic or refuse): '@FILE.csv cubic outside periodic' [default: linear outside hold];
    /// repeatable
    #[arg(long, value_name = "NAME=VALUE|[NAME=]@FILE.csv")]
    input: Vec<String>,
}

/// The options of every command with runs.
#[derive(Args)]
pub(crate) struct Run {
    #[command(flatten)]
    values: Values,
    /// Step in s, or with a unit; with --rtol or --atol the time between samples [default: as declared, 0.5ms, or
    /// what a fast mechanism asks for]
    #[arg(long, value_name = "TIME")]
    step: Option<String>,
    /// End time in s, or with a unit [default: 1s]
    #[arg(long, value_name = "TIME")]
    end: Option<String>,
    /// Feedback of the velocity violation in 1/s [default: as declared, or deadbeat]
    #[arg(long, value_name = "RATE")]
    alpha: Option<String>,
    /// Feedback of the position violation in 1/s [default: as declared, or deadbeat]
    #[arg(long, value_name = "RATE")]
    beta: Option<String>,
    /// The scheme of the steps [default: as declared, heun, or dopri5 to a tolerance]; rattle and rattle4 keep the
    /// energy where no force depends on velocities, trbdf2 and esdirk4 take stiff forces, esdirk4 to a tolerance
    /// always
    #[arg(long, value_name = "SCHEME", value_parser = PossibleValuesParser::new(RunOptions::methods()))]
    method: Option<String>,
    /// Steps as long as this relative error of a step permits, with projection [default: 1e-6]
    #[arg(long, value_name = "NUMBER")]
    rtol: Option<String>,
    /// The same for its absolute error, in SI units, or in the unit with which a state or a coordinate is declared
    /// [default: a thousandth of --rtol]
    #[arg(long, value_name = "NUMBER")]
    atol: Option<String>,
    /// The longest step of a run to a tolerance
    #[arg(long, value_name = "TIME")]
    max_step: Option<String>,
    /// What keeps the constraints: the violation is fed back, or the state projected [default: as declared, or held]
    #[arg(
        long,
        value_name = "KIND",
        value_parser = PossibleValuesParser::new(Stabilization::ALL.map(Stabilization::word)),
    )]
    feedback: Option<String>,
    /// The declared start, made consistent or as it is
    #[arg(
        long,
        value_name = "WHERE",
        value_parser = PossibleValuesParser::new(RunOptions::STARTS),
        default_value = "consistent",
    )]
    start: String,
    /// Accept gains under which the violation grows
    #[arg(long)]
    allow_unstable: bool,
}

/// The value of an option may begin with a minus sign.
pub(super) fn signed(argument: Arg) -> Arg {
    let has_value = !argument.is_positional() && argument.get_action().takes_values();
    argument.allow_hyphen_values(has_value)
}

impl Named {
    pub fn find<'a>(&self, models: &'a Models) -> Result<Found<'a>, Error> {
        models.find(&self.model)
    }
}

impl Values {
    /// The mechanism's defaults with the parameters and inputs that are given.
    pub fn settings(&self, model: &dyn Model) -> Result<Settings, Error> {
        self.asked(model.info())?.values(model)
    }

    /// The same where inputs are constant, for this reason.
    pub fn constants(&self, why: &str) -> Result<&Self, Error> {
        if self.input.iter().any(|text| text.starts_with('@')) {
            let reason = format!("{why}; give a value, such as force=3N");
            return Err(Error::Name { name: "--input @FILE".into(), reason });
        }
        Ok(self)
    }

    /// The parameters and inputs that are given.
    pub fn asked(&self, info: &Info) -> Result<RunOptions, Error> {
        let is_file = |text: &&String| text.starts_with('@') || text.split('=').nth(1).is_some_and(is_table);
        let (files, inputs): (Vec<&String>, Vec<&String>) = self.input.iter().partition(is_file);
        let mut signals: Option<Signals> = None;
        for text in files {
            let (name, text) = match text.strip_prefix('@') {
                Some(text) => (None, text),
                None => quantity::split_setting(text)
                    .map(|(name, text)| (Some(name), text.trim_start_matches('@')))?,
            };
            let (path, words) = file_and_words(text);
            let read = match name {
                None => Signals::read(path, info)?,
                Some(name) => Signals::read_input(path, info, name)?,
            };
            let read = read.led(words)?;
            signals = Some(match signals.take() {
                Some(others) => others.with(read)?,
                None => read,
            });
        }
        Ok(RunOptions {
            parameters: pairs(&self.set)?,
            inputs: pairs(inputs)?,
            signals,
            ..RunOptions::default()
        })
    }
}

impl Run {
    /// Settings of a run that looks for no declared events: what the options say, else the defaults of the
    /// mechanism.
    pub fn settings(&self, model: &dyn Model) -> Result<Settings, Error> {
        self.asked(model.info())?.settings(model)
    }

    /// The options that are given.
    pub fn asked(&self, info: &Info) -> Result<RunOptions, Error> {
        let mut asked = self.values.asked(info)?;
        let texts = [
            ("step", self.step.as_ref()),
            ("end", self.end.as_ref()),
            ("alpha", self.alpha.as_ref()),
            ("beta", self.beta.as_ref()),
            ("method", self.method.as_ref()),
            ("rtol", self.rtol.as_ref()),
            ("atol", self.atol.as_ref()),
            ("max-step", self.max_step.as_ref()),
            ("feedback", self.feedback.as_ref()),
            ("start", Some(&self.start)),
        ];
        for (name, text) in texts {
            text.map_or(Ok(()), |text| asked.set(name, text))?;
        }
        asked.allow_unstable = self.allow_unstable;
        Ok(asked)
    }
}

/// The names and the values of texts `NAME=VALUE`.
pub(super) fn pairs<'t>(texts: impl IntoIterator<Item = &'t String>) -> Result<Vec<(String, String)>, Error> {
    texts.into_iter().map(|text| split(text)).collect()
}

/// The name and the value of `NAME=VALUE`.
fn split(text: &str) -> Result<(String, String), Error> {
    quantity::split_setting(text).map(|(name, value)| (name.into(), value.into()))
}

/// A file, and the words that stand behind it. The file is the longest part of the text that is one; a name with a blank in
/// it is thereby no word.
fn file_and_words(text: &str) -> (&Path, &str) {
    let text = text.trim();
    let blanks = || text.match_indices(char::is_whitespace).map(|(at, _)| text.split_at(at));
    let mut parts = std::iter::once((text, "")).chain(blanks().rev());
    let found = parts.find(|(path, _)| Path::new(path).is_file());
    // of a file that is not there the name has no blank
    let (path, words) = found.or_else(|| blanks().next()).unwrap_or((text, ""));
    (Path::new(path), words)
}

/// `true` if the value of an input is the file of a table: `@FILE`.
fn is_table(value: &str) -> bool {
    value.trim_start().starts_with('@')
}

/// The name of a quantity that was set, its value in SI units, and the unit in which it is shown.
pub(super) type Given = (String, f64, Unit);

/// The values of the settings that replace declared ones.
pub(super) fn given(info: &'static Info, settings: &Settings) -> Vec<Given> {
    let set = settings.parameters.iter().chain(&settings.inputs);
    let inputs = settable(info);
    let quantity = |name: &str| info.parameters.iter().chain(&inputs).find(|q| q.name == name);
    let set = set.filter_map(|(name, value)| Some((name.clone(), *value, Unit::of(quantity(name)?))));
    let from = settings.from.iter();
    set.chain(from.filter_map(|(name, value)| Some((name.clone(), *value, start_state::unit(info, name)?))))
        .collect()
}

/// Refuses files that cannot be written, or of which one would be written twice, before the work whose results
/// they are for. `read` is what the command reads.
pub(super) fn check_files(
    read: Option<&Path>,
    pictures: &[Option<&Path>],
    others: &[Option<&Path>],
) -> Result<(), Error> {
    read.into_iter().for_each(note_read);
    let mut seen: Vec<&Path> = Vec::new();
    pictures.iter().flatten().try_for_each(|picture| Figure::check_ending(picture))?;
    for file in pictures.iter().chain(others).copied().flatten() {
        if seen.iter().any(|other| is_same(other, file)) {
            let reason = "two options write to it".into();
            return Err(Error::Name { name: file.display().to_string(), reason });
        }
        check_writable(file)?;
        seen.push(file);
    }
    Ok(())
}

/// Says which files were written.
pub(super) fn say_written<'a>(files: impl IntoIterator<Item = Option<&'a Path>>) -> Result<(), Error> {
    let mut files = files.into_iter().flatten();
    files.try_for_each(|path| say(format_args!("written: {}", path.display())))
}

/// Whether two names are those of one plain file.
pub(super) fn is_same(a: &Path, b: &Path) -> bool {
    let real = |path: &Path| path.canonicalize().ok().filter(|path| path.is_file());
    (a == b && !a.starts_with("/dev")) || real(a).is_some_and(|a| Some(a) == real(b))
}
