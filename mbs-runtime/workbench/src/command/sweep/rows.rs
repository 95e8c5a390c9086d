//! The table of a sweep, written run by run.

use std::fs::File;
use std::io::BufWriter;
use std::path::{Path, PathBuf};

use super::Watched;
use super::axis::Grid;
use crate::Error;
use crate::members::Member;

/// A CSV file that has its name once it is complete.
pub struct Rows {
    path: PathBuf,
    part: PathBuf,
    writer: csv::Writer<BufWriter<File>>,
}

impl Rows {
    /// The file with its headings: parameters, three columns per quantity, and why a
    /// run failed.
    pub fn create(path: &Path, grid: &Grid, watched: &[Watched]) -> Result<Self, Error> {
        let mut part = path.as_os_str().to_owned();
        part.push(".part");
        let part = PathBuf::from(part);
        let file = File::create(&part).map_err(Error::file("write", path))?;
        let mut writer = csv::Writer::from_writer(BufWriter::new(file));
        let unit = |unit: &str| if unit.is_empty() { String::new() } else { format!(" [{unit}]") };
        let mut headings: Vec<_> =
            grid.axes.iter().map(|axis| format!("{}{}", axis.name, unit(&axis.unit))).collect();
        for quantity in watched {
            for what in ["min", "max", "final"] {
                headings.push(format!("{what} {}{}", quantity.name, unit(&quantity.unit)));
            }
        }
        headings.push("error".into());
        writer.write_record(headings).map_err(|error| Error::file("write", path)(error.into()))?;
        Ok(Self { path: path.to_owned(), part, writer })
    }

    /// A run's row; empty cells where it failed.
    pub fn write(
        &mut self,
        grid: &Grid,
        index: usize,
        watched: &[Watched],
        member: &Member,
    ) -> Result<(), Error> {
        let number = |x: f64| if x.is_finite() { format!("{x:?}") } else { String::new() };
        let mut cells: Vec<_> = grid.shown_values(index).into_iter().map(number).collect();
        for quantity in watched {
            match member.as_ref().ok().and_then(|extents| extents.get(quantity.at)) {
                Some(extent) => cells.extend([extent.low, extent.high, extent.last].map(number)),
                None => cells.extend([const { String::new() }; 3]),
            }
        }
        cells.push(member.as_ref().err().map_or_else(String::new, ToString::to_string));
        self.writer.write_record(cells).map_err(|error| Error::file("write", &self.path)(error.into()))
    }

    /// The unfinished file, complete up to the last row.
    pub fn give_up(mut self) -> Result<PathBuf, Error> {
        self.writer.flush().map_err(Error::file("write", &self.part))?;
        Ok(self.part)
    }

    /// Gives the file its name.
    pub fn finish(mut self) -> Result<PathBuf, Error> {
        self.writer.flush().map_err(Error::file("write", &self.path))?;
        std::fs::rename(&self.part, &self.path).map_err(Error::file("write", &self.path))?;
        Ok(self.path)
    }
}
