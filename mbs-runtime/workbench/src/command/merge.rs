//! `mbs merge`: the shares of a sweep as one table.

use std::fs::File;
use std::io::{BufReader, Write};
use std::path::{Path, PathBuf};

use clap::Args;

use super::options;
use super::sweep::checked::Next;
use super::sweep::shard::{Head, Shard};
use crate::files::Output;
use crate::{Error, say, table_file};

const EXAMPLE: &str = "\
Example:
  mbs merge part-*.csv --out sweep.csv

The table is the one that a sweep without --shard writes, to the byte. Shares that are missing, damaged, given twice
or of another sweep are refused.";

#[derive(Args)]
#[command(
    about = "Put the shares of a sweep together, which `sweep --shard` wrote",
    after_help = EXAMPLE,
    mut_args(options::signed),
)]
pub(crate) struct Arguments {
    /// The shares, in any order
    #[arg(value_name = "SHARE", required = true)]
    share: Vec<PathBuf>,
    /// Write the table
    #[arg(long, value_name = "FILE.csv")]
    out: PathBuf,
}

/// A share of a sweep, read up to its rows.
struct Share {
    path: PathBuf,
    head: Head,
    rows: BufReader<File>,
}

impl Arguments {
    pub fn run(&self) -> Result<(), Error> {
        let shares = self.share.iter().map(|path| Share::open(path));
        let mut shares = shares.collect::<Result<Vec<_>, _>>()?;
        shares.sort_by_key(|share| share.head.heading.shard.number);
        check(&shares)?;
        let out = self.out.as_path();
        if shares.iter().any(|share| options::is_same(&share.path, out)) {
            return Err(refused(out, "it is one of the shares; give the table another name"));
        }
        let mut output = table_file::create(out)?;
        let columns = shares.first().map_or("", |share| &share.head.columns);
        output.write_all(columns.as_bytes()).map_err(Error::file("write", out))?;
        let mut count = 0;
        for share in shares {
            count += share.copy(&mut output, out)?;
        }
        say(format_args!("written: {}, {count} runs", output.finish()?.display()))
    }
}

impl Share {
    fn open(path: &Path) -> Result<Self, Error> {
        let mut rows = table_file::lines(path)?;
        let head = Head::read(&mut rows).map_err(Error::file("read", path))?;
        let head = head.ok_or_else(|| {
            refused(path, "it is not a share of a sweep; `mbs sweep … --shard K/N --out FILE.csv` writes one")
        })?;
        Ok(Self { path: path.to_owned(), head, rows })
    }

    /// Writes the rows, each of which has to be the one that the sweep has there.
    fn copy(self, output: &mut Output, out: &Path) -> Result<usize, Error> {
        let mut rows = self.head.rows(self.rows);
        let mut count = 0;
        loop {
            match rows.next().map_err(Error::file("read", &self.path))? {
                Next::Row(row) => output.write_all(row).map_err(Error::file("write", out))?,
                Next::End => return Ok(count),
                Next::Wrong(reason) => {
                    return Err(refused(&self.path, &format!("{reason}; run its command again")));
                }
            }
            count += 1;
        }
    }
}

/// Whether they are all shares of one sweep, and each is there once.
fn check(shares: &[Share]) -> Result<(), Error> {
    let Some(first) = shares.first() else { return Ok(()) };
    for share in shares {
        if !share.head.heading.is_like(&first.head.heading) || share.head.columns != first.head.columns {
            let reason = format!("it is a share of another sweep than {}", first.path.display());
            return Err(refused(&share.path, &reason));
        }
    }
    for pair in shares.windows(2) {
        if let [a, b] = pair
            && a.head.heading == b.head.heading
        {
            let Shard { number, of } = a.head.heading.shard;
            let reason = format!("it is the same share as {}: {number}/{of}", a.path.display());
            return Err(refused(&b.path, &reason));
        }
    }
    let of = first.head.heading.shard.of;
    let is_there = |number: &usize| shares.iter().any(|share| share.head.heading.shard.number == *number);
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
