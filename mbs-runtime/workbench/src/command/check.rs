//! `mbs check`: what is wrong with declarations.

use std::path::PathBuf;
use std::time::Instant;

use clap::Args;
use mbs_live::{Live, Location, Problem, Text, Warnings};
use serde_json::{Value, json};

use super::explain::coordinates;
use crate::console::complain;
use crate::number::{counted, significant};
use crate::{Error, declarations, say};

#[derive(Args)]
#[command(
    about = "Check the declarations in files, and show all of their errors, and what nothing uses",
    after_help = EXAMPLES,
)]
pub(crate) struct Arguments {
    /// A declaration (.mbs), or a Rust file with one `mechanism! { … }`
    #[arg(value_name = "FILE", required = true)]
    file: Vec<PathBuf>,
    /// Print what was found as JSON
    #[arg(long)]
    json: bool,
}

const EXAMPLES: &str = "\
Examples:
  mbs check my.mbs
  mbs check --json my.mbs    # messages with their places, for editors";

impl Arguments {
    pub fn run(&self) -> Result<(), Error> {
        let (mut found, mut refused) = (Vec::new(), 0);
        for file in &self.file {
            let start = Instant::now();
            let result = Text::read(file).map_err(Error::file("read", file))?.check();
            let name = file.display().to_string();
            refused += usize::from(result.is_err());
            match result {
                result if self.json => found.push(as_json(&name, &result)),
                Ok((live, warnings)) => {
                    if !warnings.problems().is_empty() {
                        complain(declarations::shown_warnings(&warnings));
                    }
                    say(summary(&name, &live, start.elapsed().as_secs_f64()))?;
                }
                Err(error) => complain(declarations::shown(&error)),
            }
        }
        if self.json {
            say(Value::Array(found))?;
        }
        if refused == 0 { Ok(()) } else { Err(Error::Refused { refused, of: self.file.len() }) }
    }
}

/// A declaration in a line: its name, its size, and the time that the check took.
fn summary(file: &str, live: &Live, seconds: f64) -> String {
    let info = live.declared_info();
    format!(
        "{file}: {}, {}, {}, {} of freedom; checked in {} ms",
        info.name,
        coordinates(info),
        counted(info.constraints.len(), "constraint"),
        counted(info.dof, "degree"),
        significant(1e3 * seconds, 2)
    )
}

fn as_json(file: &str, result: &Result<(Live, Warnings), mbs_live::Error>) -> Value {
    let place = |location: &Option<Location>| {
        location
            .as_ref()
            .map(|place| json!({ "line": place.line, "column": place.column, "length": place.length }))
    };
    let (severity, problems) = match result {
        Ok((_, warnings)) => ("warning", warnings.problems()),
        Err(error) => ("error", error.problems()),
    };
    let problem = |problem: &Problem| {
        let notes = problem.notes.iter();
        let notes = notes.map(|note| json!({ "message": note.message, "place": place(&note.location) }));
        json!({
            "severity": severity, "message": problem.message, "place": place(&problem.location), "help": problem.help,
            "notes": notes.collect::<Vec<_>>(),
        })
    };
    json!({ "file": file, "problems": problems.iter().map(problem).collect::<Vec<_>>() })
}
