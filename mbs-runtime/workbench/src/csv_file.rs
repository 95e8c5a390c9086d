//! Columns as a CSV file.

use std::borrow::Borrow;
use std::path::{Path, PathBuf};

use crate::files::Output;
use crate::{Column, Error, Recording};

impl Recording {
    /// Writes the columns to a CSV file; see [`write_csv`].
    ///
    /// # Errors
    /// [`Error::File`].
    pub fn write_csv(&self, path: &Path) -> Result<(), Error> {
        write_csv(path, &self.columns)
    }
}

/// Writes columns to a CSV file: a heading `name [unit]` each, numbers in the
/// shortest form that reads back as the same number, what is not finite as `NaN`,
/// `inf` or `-inf`. A cell is empty where its column has ended.
///
/// # Errors
/// [`Error::File`].
pub fn write_csv<C: Borrow<Column>>(path: &Path, columns: &[C]) -> Result<(), Error> {
    let columns: Vec<&Column> = columns.iter().map(Borrow::borrow).collect();
    let mut writer = csv::Writer::from_writer(Output::create(path)?);
    let rows = columns.iter().map(|c| c.values.len()).max().unwrap_or(0);
    let mut write = || -> csv::Result<()> {
        writer.write_record(columns.iter().map(|column| column.heading()))?;
        for row in 0..rows {
            let cell = |c: &&Column| c.values.get(row).map_or_else(String::new, |x| csv_number(*x));
            writer.write_record(columns.iter().map(cell))?;
        }
        Ok(())
    };
    write().map_err(|error| Error::file("write", path)(error.into()))?;
    finished(path, writer).map(drop)
}

/// A number in the shortest form that reads back as the same number; `NaN`, `inf` and
/// `-inf` are what they are.
pub(crate) fn csv_number(x: f64) -> String {
    format!("{x:?}")
}

/// Gives a file of rows its name.
pub(crate) fn finished(path: &Path, writer: csv::Writer<Output>) -> Result<PathBuf, Error> {
    let output = writer.into_inner().map_err(|error| Error::file("write", path)(error.into_error()))?;
    output.finish()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn csv_keeps_every_digit() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("out.csv");
        let mut t = Column::new("t", "s");
        t.values = vec![0.0, 0.1 + 0.2];
        let mut x = Column::new("der(x1)", "m/s");
        x.values = vec![1e-300];
        let mut y = Column::new("ratio", "");
        y.values = vec![f64::NAN, f64::NEG_INFINITY];
        write_csv(&path, &[t, x, y]).unwrap();
        let text = std::fs::read_to_string(&path).unwrap();
        assert_eq!(text, "t [s],der(x1) [m/s],ratio\n0.0,1e-300,NaN\n0.30000000000000004,,-inf\n");
        let missing = folder.path().join("no/such/folder.csv");
        assert!(write_csv::<Column>(&missing, &[]).unwrap_err().to_string().contains("cannot write"));
    }
}
