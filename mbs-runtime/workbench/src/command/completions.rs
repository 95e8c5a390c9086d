//! `mbs completions`: what a shell needs to complete commands, options and mechanisms.

use clap::builder::PossibleValuesParser;
use clap::{Arg, ArgMatches, Command, value_parser};
use clap_complete::Shell;

use crate::models::Models;
use crate::{Error, say};

pub(crate) fn command() -> Command {
    Command::new("completions")
        .about("Print a script that completes commands in a shell")
        .after_help("Example:\n  mbs completions bash > ~/.local/share/bash-completion/completions/mbs")
        .arg(Arg::new("shell").required(true).value_parser(value_parser!(Shell)))
}

/// `parser` is the whole command line.
pub(crate) fn run(models: &Models, parser: Command, matches: &ArgMatches) -> Result<(), Error> {
    let Some(shell) = matches.get_one::<Shell>("shell").copied() else { return Ok(()) };
    let names: Vec<String> = models.names().map(str::to_owned).collect();
    let with_names = |command: Command, argument: &'static str| {
        let parser = PossibleValuesParser::new(names.clone());
        command.mut_arg(argument, |argument| argument.value_parser(parser))
    };
    let mut parser = parser
        .mut_subcommand("simulate", |command| with_names(command, "model"))
        .mut_subcommand("sweep", |command| with_names(command, "model"))
        .mut_subcommand("equilibrium", |command| with_names(command, "model"))
        .mut_subcommand("linearize", |command| with_names(command, "model"))
        .mut_subcommand("modes", |command| with_names(command, "model"))
        .mut_subcommand("bode", |command| with_names(command, "model"))
        .mut_subcommand("explain", |command| with_names(command, "mechanism"));
    let program = std::env::args_os().next().map(std::path::PathBuf::from);
    let stem = program.as_ref().and_then(|path| path.file_stem()).and_then(|stem| stem.to_str());
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut parser, stem.unwrap_or("mbs"), &mut script);
    say(String::from_utf8_lossy(&script).trim_end())
}
