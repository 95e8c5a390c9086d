//! The table of a sweep, written run by run.

use std::path::{Path, PathBuf};

use super::Watched;
use super::axis::Grid;
use crate::files::Output;
use crate::members::Member;
use crate::recording::{csv_number, finished};
use crate::{Error, unit};

/// A CSV file that has its name once it is complete.
pub struct Rows {
    path: PathBuf,
    writer: csv::Writer<Output>,
}

impl Rows {
    /// The file with its headings: parameters, three columns per quantity, and why a
    /// run failed.
    pub fn create(path: &Path, grid: &Grid, watched: &[Watched]) -> Result<Self, Error> {
        let mut writer = csv::Writer::from_writer(Output::create(path)?);
        let mut headings: Vec<_> =
            grid.axes.iter().map(|axis| unit::heading(axis.name, axis.unit.name())).collect();
        for quantity in watched {
            for what in ["min", "max", "final"] {
                headings.push(unit::heading(&format!("{what} {}", quantity.name), quantity.unit.name()));
            }
        }
        headings.push("error".into());
        writer.write_record(headings).map_err(|error| Error::file("write", path)(error.into()))?;
        Ok(Self { path: path.to_owned(), writer })
    }

    /// A run's row; empty cells where it failed.
    pub fn write(
        &mut self,
        grid: &Grid,
        index: usize,
        watched: &[Watched],
        member: &Member,
        error: String,
    ) -> Result<(), Error> {
        let mut cells: Vec<_> = grid.shown_values(index).into_iter().map(csv_number).collect();
        for quantity in watched {
            match member.as_ref().ok().and_then(|extents| extents.get(quantity.at)) {
                Some(extent) => cells.extend([extent.low, extent.high, extent.last].map(csv_number)),
                None => cells.extend([const { String::new() }; 3]),
            }
        }
        cells.push(error);
        self.writer.write_record(cells).map_err(|error| Error::file("write", &self.path)(error.into()))
    }

    /// The unfinished file, complete up to the last row.
    pub fn give_up(self) -> Result<PathBuf, Error> {
        let failed = Error::file("write", &self.path);
        self.writer.into_inner().map_err(|error| failed(error.into_error()))?.keep()
    }

    /// Gives the file its name.
    pub fn finish(self) -> Result<PathBuf, Error> {
        finished(&self.path, self.writer)
    }
}
