//! The command line as a library.

use std::ffi::OsString;
use std::io::ErrorKind;
use std::process::ExitCode;

use clap::{ArgMatches, Command, FromArgMatches, Subcommand};
use mbs_runtime::Mechanism;

#[cfg(feature = "live")]
use crate::Settings;
use crate::command::Builtin;
use crate::command::{list, simulate};
use crate::console::{Warnings, complain};
use crate::models::Models;
use crate::{Error, Model, interrupt, model};

/// The exit code of a command that has warnings.
const DOUBTFUL: u8 = 3;
/// That of a command whose reader has gone away.
const NO_READER: u8 = 141;

/// The function behind a command of the embedding program.
type Action = Box<dyn Fn(&ArgMatches) -> Result<(), Box<dyn std::error::Error + Send + Sync>>>;

/// A command line for mechanisms: `list`, `explain`, `simulate`, `sweep`, `equilibrium`, `linearize`,
/// `modes`, `bode`, `inverse`, `travel`, `fit`, `synthesize`, `new`, and whatever the embedding program adds.
///
/// # Example
/// ```no_run
/// mbs_runtime::mechanism! {
///     /// A weight on a massless rod.
///     pub Pendulum {
///         dof = 1;
///         param length = 1 [m];
///         gravity = (0, -9.81) [m/s^2];
///         body bob (x, y) { mass = 2 [kg]; }
///         constraint rod: x^2 + y^2 = length^2;
///         start { x = length; guess y = 0; }
///     }
/// }
///
/// fn main() -> std::process::ExitCode {
///     mbs_workbench::app().mechanism::<Pendulum>("pendulum").run()
/// }
/// ```
#[derive(Default)]
pub struct App {
    models: Models,
    commands: Vec<(Command, Action)>,
    default_command: Option<&'static str>,
}

/// An empty command line; add mechanisms to it.
pub fn app() -> App {
    App::default()
}

impl App {
    /// Adds a mechanism under a name.
    #[must_use]
    pub fn mechanism<M: Mechanism<Real = f64>>(self, name: &str) -> Self {
        self.model(name, model::of::<M>())
    }

    /// Adds a mechanism whose type no longer matters under a name.
    #[must_use]
    pub fn model(mut self, name: &str, model: Box<dyn Model>) -> Self {
        self.models.push(name, model);
        self
    }

    /// Adds a mechanism whose declaration is a text, and whose runs have these defaults. The text is compiled
    /// on first use; its errors appear then.
    #[cfg(feature = "live")]
    #[must_use]
    pub fn text(mut self, name: &str, text: mbs_live::Text, defaults: Settings) -> Self {
        self.models.push_text(name, crate::declarations::Text::new(text, defaults));
        self
    }

    /// Adds a command of one's own.
    #[must_use]
    pub fn command(
        mut self,
        command: Command,
        run: impl Fn(&ArgMatches) -> Result<(), Box<dyn std::error::Error + Send + Sync>> + 'static,
    ) -> Self {
        self.commands.push((command, Box::new(run)));
        self
    }

    /// Says which added command runs when none is given. Without it, the first
    /// mechanism is simulated.
    #[must_use]
    pub fn default_command(mut self, name: &'static str) -> Self {
        self.default_command = Some(name);
        self
    }

    /// Runs what the program's arguments ask for. To be returned from `main`:
    /// 0 if it went well, 1 if it failed, 2 if it was asked wrongly, 3 if it went to its end
    /// with warnings, 130 if it was interrupted, 141 if nobody reads standard output any more
    /// (128 + SIGPIPE, with which other programs end there).
    pub fn run(self) -> ExitCode {
        self.run_from(std::env::args_os())
    }

    /// Runs what these arguments ask for; the first is the program's name.
    pub fn run_from<T: Into<OsString> + Clone>(self, arguments: impl IntoIterator<Item = T>) -> ExitCode {
        let matches = match self.parser().try_get_matches_from(arguments) {
            Ok(matches) => matches,
            Err(error) => {
                return match error.print() {
                    _ if error.use_stderr() => ExitCode::from(2),
                    Ok(()) => ExitCode::SUCCESS,
                    Err(_) => ExitCode::FAILURE,
                };
            }
        };
        match self.dispatch(&matches) {
            Ok(warnings) if warnings.is_empty() => ExitCode::SUCCESS,
            Ok(warnings) => {
                warnings.iter().for_each(|warning| complain(format_args!("warning: {warning}")));
                ExitCode::from(DOUBTFUL)
            }
            // Who reads no further wants to hear no more.
            Err(Error::Standard(error)) if error.kind() == ErrorKind::BrokenPipe => ExitCode::from(NO_READER),
            Err(error) => {
                match &error {
                    // it is shown with its source, and says itself what it is
                    #[cfg(feature = "live")]
                    Error::Declaration(error) => complain(crate::declarations::shown(error)),
                    error => complain(format_args!("error: {error}")),
                }
                match error {
                    Error::Interrupted { .. } | Error::Stopped { .. } => ExitCode::from(interrupt::EXIT_CODE),
                    _ => ExitCode::FAILURE,
                }
            }
        }
    }

    #[doc(hidden)]
    pub fn parser(&self) -> Command {
        let about = match self.default_command {
            Some(name) => format!("Compiled mechanisms at a desk. Without a command: {name}."),
            None => "Compiled mechanisms at a desk. Without a command: simulates the first.".into(),
        };
        Builtin::augment_subcommands(Command::new("mbs"))
            .about(about)
            .version(env!("CARGO_PKG_VERSION"))
            .subcommands(self.commands.iter().map(|(command, _)| command.clone()))
    }

    fn dispatch(&self, matches: &ArgMatches) -> Result<Warnings, Error> {
        match matches.subcommand() {
            Some((name, _)) if Builtin::has_subcommand(name) => match Builtin::from_arg_matches(matches) {
                Ok(command) => command.run(&self.models, || self.parser()),
                Err(error) => Err(Error::Command(Box::new(error))),
            },
            Some((name, matches)) => self.added(name, matches).map(|()| Warnings::new()),
            None => self.without_command(),
        }
    }

    fn added(&self, name: &str, matches: &ArgMatches) -> Result<(), Error> {
        match self.commands.iter().find(|(command, _)| command.get_name() == name) {
            // An error of ours keeps what it is.
            Some((_, action)) => action(matches)
                .map_err(|error| error.downcast().map_or_else(Error::Command, |error: Box<Error>| *error)),
            None => {
                let known = self.commands.iter().map(|(command, _)| command.get_name());
                Err(Error::unknown("command", name, known))
            }
        }
    }

    fn without_command(&self) -> Result<Warnings, Error> {
        if let Some(name) = self.default_command {
            // The arguments that the command has when none are given.
            let command = self.commands.iter().find(|(command, _)| command.get_name() == name);
            let parser = command.map_or_else(|| Command::new(name), |(command, _)| command.clone());
            let matches = parser.get_matches_from([name]);
            return self.added(name, &matches).map(|()| Warnings::new());
        }
        let first = self.models.names().next();
        match first {
            Some(name) => simulate::by_default(name, self.models.get(name)?),
            None => list::Arguments { json: false }.run(&self.models).map(|()| Warnings::new()),
        }
    }
}
