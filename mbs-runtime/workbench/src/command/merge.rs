//! `mbs merge`: the shares of a sweep as one table.

use std::fs::File;
use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};

use clap::{Arg, ArgMatches, Command, value_parser};

use super::options::option;
use super::sweep::shard::Heading;
use crate::table_file::{self, TableFile};
use crate::{Error, say};

const EXAMPLE: &str = "\
Example:
  mbs merge part-*.csv --out sweep.csv

Shares and table may also be Parquet files, by the ending .parquet, in a program that is built with it.
The table is the one that a sweep without --shard writes, to the byte. Shares that are missing, given twice or of
another sweep are refused.";

pub(crate) fn command() -> Command {
    let path = || value_parser!(PathBuf);
    Command::new("merge")
        .about("Put the shares of a sweep together, which `sweep --shard` wrote")
        .after_help(EXAMPLE)
        .arg(
            Arg::new("share")
                .value_name("SHARE")
                .required(true)
                .num_args(1..)
                .value_parser(path())
                .help("The shares, in any order"),
        )
        .arg(option("out", "FILE.csv", "Write the table").required(true).value_parser(path()))
}

/// A share of a sweep, behind its first line.
struct Share {
    path: PathBuf,
    heading: Heading,
    columns: String,
    rows: BufReader<File>,
}

pub(crate) fn run(matches: &ArgMatches) -> Result<(), Error> {
    let paths = matches.get_many::<PathBuf>("share").unwrap_or_default();
    let mut shares = paths.map(|path| Share::open(path)).collect::<Result<Vec<_>, _>>()?;
    shares.sort_by_key(|share| share.heading.shard.number);
    check(&shares)?;
    let Some(out) = matches.get_one::<PathBuf>("out") else { return Ok(()) };
    let mut output = TableFile::create(out)?;
    let columns = shares.first().map_or("", |share| &share.columns);
    output.write_all(columns.as_bytes()).map_err(Error::file("write", out))?;
    let mut count = 0;
    for share in shares {
        count += share.copy(&mut output, out)?;
    }
    say(format_args!("written: {}, {count} runs", output.finish()?.display()))
}

impl Share {
    fn open(path: &Path) -> Result<Self, Error> {
        let mut rows = table_file::lines(path)?;
        let mut line = || {
            let mut line = String::new();
            rows.read_line(&mut line).map_err(Error::file("read", path))?;
            Ok::<_, Error>(line)
        };
        let (first, columns) = (line()?, line()?);
        let heading = Heading::parse(&first).ok_or_else(|| {
            refused(path, "it is not a share of a sweep; `mbs sweep … --shard K/N --out FILE.csv` writes one")
        })?;
        Ok(Self { path: path.to_owned(), heading, columns, rows })
    }

    /// Writes the rows, as many as the share has to have.
    fn copy(mut self, output: &mut TableFile, out: &Path) -> Result<usize, Error> {
        let expected = self.heading.shard.members(self.heading.count).len();
        let (mut line, mut count) = (Vec::new(), 0);
        loop {
            line.clear();
            self.rows.read_until(b'\n', &mut line).map_err(Error::file("read", &self.path))?;
            if line.is_empty() {
                break;
            }
            output.write_all(&line).map_err(Error::file("write", out))?;
            count += 1;
        }
        if count == expected {
            return Ok(count);
        }
        Err(refused(&self.path, &format!("it has {count} of its {expected} runs; run its command again")))
    }
}

/// Whether they are all shares of one sweep, and each is there once.
fn check(shares: &[Share]) -> Result<(), Error> {
    let Some(first) = shares.first() else { return Ok(()) };
    for share in shares {
        if !share.heading.is_like(&first.heading) || share.columns != first.columns {
            let reason = format!("it is a share of another sweep than {}", first.path.display());
            return Err(refused(&share.path, &reason));
        }
    }
    for pair in shares.windows(2) {
        if let [a, b] = pair
            && a.heading == b.heading
        {
            return Err(refused(&b.path, &format!("it is the same share as {}", a.path.display())));
        }
    }
    let of = first.heading.shard.of;
    let is_there = |number: &usize| shares.iter().any(|share| share.heading.shard.number == *number);
    let missing: Vec<String> =
        (1..=of).filter(|number| !is_there(number)).take(10).map(|number| format!("{number}/{of}")).collect();
    if missing.is_empty() {
        return Ok(());
    }
    Err(refused(&first.path, &format!("of its sweep these shares are missing: {}", missing.join(", "))))
}

fn refused(path: &Path, reason: &str) -> Error {
    Error::Name { name: path.display().to_string(), reason: reason.to_owned() }
}
