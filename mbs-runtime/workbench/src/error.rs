//! Errors of the workbench.

use std::path::PathBuf;

use crate::names;

/// Why a command could not be carried out, in words that say what to do.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A name that nothing has.
    #[error("{}", names::unknown(.kind, .name, .known))]
    Unknown {
        /// The kind of thing that was looked for: `mechanism`, `parameter`, …
        kind: &'static str,
        /// The name that was given.
        name: String,
        /// The names that exist.
        known: Vec<String>,
    },
    /// A task for which there is no mechanism, as far as was looked.
    #[error("no mechanism was found: {reason}")]
    NoLinkage {
        /// Why no start led to one, and what to change.
        reason: String,
    },
    /// A column that a file does not have.
    #[error("{} has no column `{name}`; it has {}", file.display(), known.join(", "))]
    Column {
        /// The file.
        file: PathBuf,
        /// The column that was looked for.
        name: String,
        /// The columns that it has.
        known: Vec<String>,
    },
    /// A setting that is not of the form `name=value`.
    #[error("`{text}` is not a setting; write it as name=value, for instance omega=300rpm")]
    Setting {
        /// The text that was given.
        text: String,
    },
    /// A value that is not a number with an optional unit.
    #[error("{what} = `{text}`: {reason}")]
    Value {
        /// The quantity or the option that the value is for.
        what: String,
        /// The text that was given.
        text: String,
        /// The reason why it is refused.
        reason: String,
    },
    /// A value with the unit of something else.
    #[error("{what} = `{text}`: a {found} was given, but {what} is a {expected}")]
    Dimension {
        /// The quantity or the option that the value is for.
        what: String,
        /// The text that was given.
        text: String,
        /// The dimension it has to have.
        expected: String,
        /// The dimension it has.
        found: String,
    },
    /// An error of the mechanism or the integrator.
    #[error("{0}")]
    Mechanism(#[from] mbs_runtime::Error),
    /// An error of an analysis.
    #[error("{0}")]
    Analysis(#[source] mbs_analysis::Error),
    /// No equilibrium to linearize about.
    #[error("{0}; or linearize elsewhere: --here at rest at the start, --after 0.1s in motion")]
    NoEquilibrium(#[source] mbs_analysis::Error),
    /// Errors in a declaration.
    #[cfg(feature = "live")]
    #[error("{0}")]
    Declaration(#[from] mbs_live::Error),
    /// Declarations that were checked and have errors, which were shown.
    #[cfg(feature = "live")]
    #[error("{refused} of {of} declarations cannot be compiled")]
    Refused {
        /// How many have errors.
        refused: usize,
        /// How many were checked.
        of: usize,
    },
    /// A file of another program that is not what it should be, or has what is not imported.
    #[cfg(feature = "live")]
    #[error("cannot import {}: {reason}", file.display())]
    Import {
        /// The file.
        file: PathBuf,
        /// Why not, in the words of the file.
        reason: String,
    },
    /// A page that cannot be served.
    #[cfg(feature = "live")]
    #[error("cannot serve a page on port {port} of this machine: {source}; --port 0 takes a free one")]
    Serve {
        /// The port that was asked for.
        port: u16,
        /// The error of the system.
        source: std::io::Error,
    },
    /// A C compiler that failed.
    #[cfg(feature = "live")]
    #[error("the C compiler `{compiler}` failed; --sources-only does without: {reason}")]
    Compiler {
        /// Its name.
        compiler: String,
        /// Its message, or the error of the system where it cannot be started.
        reason: String,
    },
    /// A run that ended early; what it had computed was kept.
    #[error("the run ended early: {cause}{kept}")]
    EndedEarly {
        /// Why.
        cause: mbs_runtime::Error,
        /// Where the results up to then are, as a clause to append.
        kept: String,
    },
    /// A sweep that was interrupted; the runs that it had finished were kept.
    #[error("interrupted after {finished} of {of} runs{kept}")]
    Interrupted {
        /// The runs that were finished.
        finished: usize,
        /// How many runs there were to be.
        of: usize,
        /// Where the finished ones are, as a clause to append.
        kept: String,
    },
    /// A search that was interrupted.
    #[error("interrupted{kept}")]
    Stopped {
        /// How far the search came, as a clause to append; may be empty.
        kept: String,
    },
    /// Runs of a sweep that failed.
    #[error("{failed} of {of} runs failed, the first one at {first}: {cause}")]
    Sweep {
        /// How many.
        failed: usize,
        /// How many runs there were.
        of: usize,
        /// The parameters of the first one that failed.
        first: String,
        /// Why it did.
        cause: String,
    },
    /// More runs than anybody waits for.
    #[error("a sweep has at most {most} runs; take fewer values")]
    TooManyRuns {
        /// How many it may have.
        most: usize,
    },
    /// More rows than a table should hold.
    #[error("{rows} rows would be recorded; take a longer step, an earlier end, or --every {every}")]
    TooManyRows {
        /// How many rows were asked for.
        rows: u64,
        /// A stride that gives a reasonable number.
        every: u64,
    },
    /// A file that could not be read or written.
    #[error("cannot {doing} {}: {source}", path.display())]
    File {
        /// `write`, `create`, …
        doing: &'static str,
        /// The file.
        path: PathBuf,
        /// The error of the system.
        source: std::io::Error,
    },
    /// Standard output takes nothing more.
    #[error("cannot write to standard output: {0}")]
    Standard(#[source] std::io::Error),
    /// A name for a file or crate that cannot be one.
    #[error("`{name}` cannot be used: {reason}")]
    Name {
        /// The name.
        name: String,
        /// Why not.
        reason: String,
    },
    /// A picture that could not be drawn.
    #[error("the figure `{title}` could not be drawn: {reason}")]
    Figure {
        /// Its title.
        title: String,
        /// The message of the drawing library.
        reason: String,
    },
    /// An error of a command of the embedding program.
    #[error("{0}")]
    Command(#[source] Box<dyn std::error::Error + Send + Sync>),
}

impl Error {
    /// Marks an I/O error with the file it concerns.
    pub fn file(doing: &'static str, path: impl Into<PathBuf>) -> impl FnOnce(std::io::Error) -> Self {
        let path = path.into();
        move |source| Self::File { doing, path, source }
    }

    /// The same about a value that stands elsewhere.
    #[cfg(feature = "desk")]
    pub(crate) fn about(self, place: String) -> Self {
        match self {
            Self::Value { text, reason, .. } => Self::Value { what: place, text, reason },
            Self::Dimension { text, expected, found, .. } => {
                Self::Dimension { what: place, text, expected, found }
            }
            other => other,
        }
    }

    /// The error for a name that nothing has.
    pub fn unknown<'a>(
        kind: &'static str,
        name: impl Into<String>,
        known: impl IntoIterator<Item = &'a str>,
    ) -> Self {
        Self::Unknown { kind, name: name.into(), known: known.into_iter().map(str::to_owned).collect() }
    }
}

#[cfg(feature = "desk")]
impl From<mbs_pictures::Error> for Error {
    fn from(error: mbs_pictures::Error) -> Self {
        match error {
            mbs_pictures::Error::Ending { name } => {
                Self::Name { name, reason: mbs_pictures::Error::ENDING.into() }
            }
            mbs_pictures::Error::Figure { title, reason } => Self::Figure { title, reason },
        }
    }
}

impl From<mbs_analysis::Error> for Error {
    fn from(error: mbs_analysis::Error) -> Self {
        match error {
            mbs_analysis::Error::Unknown { kind, name, known } => Self::Unknown { kind, name, known },
            mbs_analysis::Error::Mechanism(error) => Self::Mechanism(error),
            mbs_analysis::Error::Interrupted => Self::Stopped { kept: String::new() },
            other => Self::Analysis(other),
        }
    }
}
