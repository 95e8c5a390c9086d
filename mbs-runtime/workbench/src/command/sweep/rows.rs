//! The table of a sweep, written run by run.

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use mbs_pictures::heading;

use super::axis::Grid;
use super::shard::{Head, Part};
use super::watched::Watched;
use crate::Error;
use crate::csv_file::csv_number;
use crate::files::Output;
use crate::members::Member;
use crate::table_file;

/// A process that ends at once loses the rows of this time.
const SAFE: Duration = Duration::from_millis(500);

/// A file that has its name once it is complete.
pub struct Rows {
    path: PathBuf,
    writer: csv::Writer<Target>,
    flushed: Instant,
}

/// The file that rows are written to.
enum Target {
    /// A file for all rows of a sweep.
    Whole(Output),
    /// A file for the rows of a share of a sweep.
    Share(Part),
}

impl Write for Target {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self {
            Self::Whole(output) => output.write(bytes),
            Self::Share(part) => part.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match self {
            Self::Whole(output) => output.flush(),
            Self::Share(part) => part.flush(),
        }
    }
}

impl Rows {
    /// The file with its headings: parameters, three columns per quantity, and why a
    /// run failed.
    pub fn create(path: &Path, grid: &Grid, watched: &[Watched]) -> Result<Self, Error> {
        let mut rows = Self::to(path, Target::Whole(table_file::create(path)?));
        rows.write_record(headings(grid, watched))?;
        Ok(rows)
    }

    /// The file of a share, and how many of its rows are there already.
    pub fn share(path: &Path, head: &Head) -> Result<(Self, usize), Error> {
        let part = Part::open(path, head)?;
        let there = part.rows;
        Ok((Self::to(path, Target::Share(part)), there))
    }

    fn to(path: &Path, target: Target) -> Self {
        Self { path: path.to_owned(), writer: csv::Writer::from_writer(target), flushed: Instant::now() }
    }

    fn write_record(&mut self, cells: Vec<String>) -> Result<(), Error> {
        self.writer.write_record(cells).map_err(|error| Error::file("write", &self.path)(error.into()))
    }

    /// A run's row; empty cells where it failed.
    pub fn write(
        &mut self,
        grid: &Grid,
        index: usize,
        watched: &[Watched],
        member: &Member,
        error: &str,
    ) -> Result<(), Error> {
        let mut cells: Vec<_> = grid.shown_values(index).into_iter().map(csv_number).collect();
        for quantity in watched {
            match member.as_ref().ok().and_then(|extents| extents.get(quantity.at)) {
                Some(extent) => cells.extend([extent.low, extent.high, extent.last].map(csv_number)),
                None => cells.extend([const { String::new() }; 3]),
            }
        }
        // a row is a line
        cells.push(error.replace(['\n', '\r'], " "));
        self.write_record(cells)?;
        if self.flushed.elapsed() > SAFE {
            self.writer.flush().map_err(Error::file("write", &self.path))?;
            self.flushed = Instant::now();
        }
        Ok(())
    }

    /// The unfinished file, complete up to the last row.
    pub fn give_up(self) -> Result<PathBuf, Error> {
        match self.target()? {
            Target::Whole(output) => output.keep(),
            Target::Share(part) => Ok(part.kept()),
        }
    }

    /// Gives the file its name.
    pub fn finish(self) -> Result<PathBuf, Error> {
        match self.target()? {
            Target::Whole(output) => output.finish(),
            Target::Share(part) => part.finish(),
        }
    }

    fn target(self) -> Result<Target, Error> {
        let failed = Error::file("write", &self.path);
        self.writer.into_inner().map_err(|error| failed(error.into_error()))
    }
}

/// The line with the names of the columns.
pub fn columns(grid: &Grid, watched: &[Watched]) -> io::Result<String> {
    let mut line = csv::Writer::from_writer(Vec::new());
    line.write_record(headings(grid, watched))?;
    let line = line.into_inner().map_err(csv::IntoInnerError::into_error)?;
    String::from_utf8(line).map_err(io::Error::other)
}

fn headings(grid: &Grid, watched: &[Watched]) -> Vec<String> {
    let axes = grid.axes.iter().map(|axis| heading(axis.name, axis.unit.name()));
    let extents = |quantity: &Watched| {
        let Watched { name, unit, .. } = quantity;
        ["min", "max", "final"].map(|what| heading(&format!("{what} {name}"), unit.name()))
    };
    axes.chain(watched.iter().flat_map(extents)).chain(["error".into()]).collect()
}
