//! `mbs completions`: what a shell needs to complete commands, options and mechanisms.

use clap::builder::PossibleValuesParser;
use clap::{Args, Command};
use clap_complete::Shell;

use crate::models::Models;
use crate::{Error, say};

#[derive(Args)]
#[command(
    about = "Print a script that completes commands in a shell",
    after_help = "Example:\n  mbs completions bash > ~/.local/share/bash-completion/completions/mbs"
)]
pub(crate) struct Arguments {
    #[arg(value_name = "shell")]
    shell: Shell,
}

impl Arguments {
    /// Of the whole command line, which `parser` is.
    pub fn run(&self, models: &Models, parser: Command) -> Result<(), Error> {
        let names: Vec<String> = models.names().map(str::to_owned).collect();
        let mut parser = with_names(parser, &names);
        let program = std::env::args_os().next().map(std::path::PathBuf::from);
        let stem = program.as_ref().and_then(|path| path.file_stem()).and_then(|stem| stem.to_str());
        let mut script = Vec::new();
        clap_complete::generate(self.shell, &mut parser, stem.unwrap_or("mbs"), &mut script);
        say(String::from_utf8_lossy(&script).trim_end())
    }
}

/// The command with the names of mechanisms as values of every argument that is one, in its subcommands too.
fn with_names(command: Command, names: &[String]) -> Command {
    let subcommands: Vec<String> =
        command.get_subcommands().map(|inner| inner.get_name().to_owned()).collect();
    let takes_a_model = command.get_arguments().any(|argument| argument.get_id() == "model");
    let command = if takes_a_model {
        let parser = PossibleValuesParser::new(names.to_vec());
        command.mut_arg("model", |argument| argument.value_parser(parser))
    } else {
        command
    };
    subcommands
        .into_iter()
        .fold(command, |command, name| command.mut_subcommand(name, |inner| with_names(inner, names)))
}
