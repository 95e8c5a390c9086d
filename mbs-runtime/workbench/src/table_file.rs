//! Tables of a sweep as files of CSV, in which every row that is whole counts if the process ends.

use std::fs::File;
use std::io::BufReader;
use std::path::Path;

use crate::Error;
use crate::files::Output;

/// Endings of tables in other forms, for which nobody would look for CSV.
const OTHERS: [&str; 5] = ["parquet", "feather", "xlsx", "xls", "h5"];

/// Begins to write a table.
///
/// # Errors
/// [`Error::Name`] if the ending is that of another form, [`Error::File`] if the file cannot be made.
pub(crate) fn create(path: &Path) -> Result<Output, Error> {
    check(path)?;
    Output::create(path)
}

/// Refuses names of tables in other forms.
///
/// # Errors
/// [`Error::Name`] if the ending is that of another form.
pub(crate) fn check(path: &Path) -> Result<(), Error> {
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
    if ending.is_none_or(|ending| !OTHERS.contains(&ending.as_str())) {
        return Ok(());
    }
    let reason = "tables are written as CSV; name a .csv file, of which pandas and others make other forms";
    Err(Error::Name { name: path.display().to_string(), reason: reason.into() })
}

/// The lines of a table.
///
/// # Errors
/// [`Error::File`] if it cannot be read.
pub(crate) fn lines(path: &Path) -> Result<BufReader<File>, Error> {
    Ok(BufReader::new(File::open(path).map_err(Error::file("read", path))?))
}
