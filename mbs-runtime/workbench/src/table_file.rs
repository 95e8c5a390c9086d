//! Tables of a sweep as files: CSV, or Parquet by the ending of their name.
//!
//! Rows are always written as CSV, where every row that is whole counts if the process ends. A
//! table with the ending `.parquet` is put into that form once it is complete.

#[cfg_attr(not(feature = "parquet"), path = "table_file/without_parquet.rs")]
mod parquet;

use std::fs::{self, File};
use std::io::{self, BufReader, Read, Seek, Write};
use std::path::{Path, PathBuf};

use crate::Error;
use crate::files::Output;

/// A Parquet file begins with these bytes.
const MAGIC: &[u8] = b"PAR1";

/// A table that is being written.
pub(crate) struct TableFile {
    /// As it was asked for.
    path: PathBuf,
    rows: Output,
    is_parquet: bool,
}

impl TableFile {
    /// Begins to write what is to be called `path`.
    pub fn create(path: &Path) -> Result<Self, Error> {
        let is_parquet = is_parquet(path)?;
        let rows = if is_parquet { Output::create(&beside(path))? } else { Output::create(path)? };
        Ok(Self { path: path.to_owned(), rows, is_parquet })
    }

    /// Gives the file its form and its name.
    pub fn finish(self) -> Result<PathBuf, Error> {
        if !self.is_parquet {
            return self.rows.finish();
        }
        to_parquet(&self.rows.keep()?, &self.path)?;
        Ok(self.path)
    }

    /// Leaves the rows that are there as CSV, and says where these are.
    pub fn keep(self) -> Result<PathBuf, Error> {
        self.rows.keep()
    }
}

impl Write for TableFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.rows.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.rows.flush()
    }
}

/// Whether a table of this name is a Parquet file.
///
/// # Errors
/// [`Error::Name`] if it is one, and this program can write none.
pub(crate) fn is_parquet(path: &Path) -> Result<bool, Error> {
    let is_parquet = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("parquet"));
    if is_parquet && !cfg!(feature = "parquet") { Err(not_built(path)) } else { Ok(is_parquet) }
}

/// What holds the rows of a Parquet file until it is complete.
fn beside(path: &Path) -> PathBuf {
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(".csv");
    path.with_file_name(name)
}

/// Puts a CSV file into a Parquet file, and removes it.
pub(crate) fn to_parquet(rows: &Path, path: &Path) -> Result<(), Error> {
    parquet::write(rows, path)?;
    fs::remove_file(rows).map_err(Error::file("remove", rows))
}

/// The lines of a table as those of CSV, whatever form its file has.
///
/// # Errors
/// [`Error::File`] if it cannot be read, [`Error::Name`] if this program knows no Parquet.
pub(crate) fn lines(path: &Path) -> Result<BufReader<File>, Error> {
    let failed = || Error::file("read", path);
    let mut file = File::open(path).map_err(failed())?;
    let mut first = Vec::new();
    (&mut file).take(MAGIC.len() as u64).read_to_end(&mut first).map_err(failed())?;
    file.rewind().map_err(failed())?;
    let file = if first == MAGIC { parquet::as_csv(file, path)? } else { file };
    Ok(BufReader::new(file))
}

fn not_built(path: &Path) -> Error {
    let reason = "this program knows no Parquet; build it with `--features parquet`, or take a .csv file";
    Error::Name { name: path.display().to_string(), reason: reason.into() }
}
