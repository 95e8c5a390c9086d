//! What a run leaves behind: columns of numbers and a summary.

use std::path::Path;

use crate::Error;

/// A recorded quantity.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Its name, such as `x1`, `der(x1)` or `lambda(guide)`.
    pub name: String,
    /// Its unit, such as `m` or `N*m`.
    pub unit: String,
    /// One value per recorded instant, in that unit.
    pub values: Vec<f64>,
}

impl Column {
    /// An empty column.
    pub fn new(name: impl Into<String>, unit: impl Into<String>) -> Self {
        Self { name: name.into(), unit: unit.into(), values: Vec::new() }
    }

    /// `name [unit]`
    pub fn heading(&self) -> String {
        format!("{} [{}]", self.name, self.unit)
    }
}

/// The figures of a run that one looks at first.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Summary {
    /// Steps taken.
    pub steps: u64,
    /// Time of the last good state in s.
    pub end: f64,
    /// Largest ‖Φ‖ over all steps.
    pub max_phi: f64,
    /// Largest ‖Φ̇‖ over all steps.
    pub max_phi_dot: f64,
    /// Kinetic plus potential energy at the start in J.
    pub energy_start: f64,
    /// The same at the end.
    pub energy_end: f64,
}

/// The result of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Recording {
    /// Time first, then coordinates, velocities, multipliers, outputs, violation.
    pub columns: Vec<Column>,
    /// How many of the columns after time are coordinates.
    pub coordinates: usize,
    /// The summary.
    pub summary: Summary,
    /// Why the run ended before its end time, if it did.
    pub ended: Option<mbs_runtime::Error>,
}

impl Recording {
    /// The column called `name`.
    pub fn column(&self, name: &str) -> Option<&Column> {
        self.columns.iter().find(|c| c.name == name)
    }

    /// Writes the columns to a CSV file; see [`write_csv`].
    ///
    /// # Errors
    /// [`Error::File`].
    pub fn write_csv(&self, path: &Path) -> Result<(), Error> {
        write_csv(path, &self.columns)
    }
}

/// Writes columns to a CSV file: a heading `name [unit]` each, numbers in the
/// shortest form that reads back as the same number. A cell is empty where the
/// value is not finite or the column has ended.
///
/// # Errors
/// [`Error::File`].
pub fn write_csv(path: &Path, columns: &[Column]) -> Result<(), Error> {
    let file = std::fs::File::create(path).map_err(Error::file("write", path))?;
    let mut writer = csv::Writer::from_writer(std::io::BufWriter::new(file));
    let rows = columns.iter().map(|c| c.values.len()).max().unwrap_or(0);
    let mut write = || -> csv::Result<()> {
        writer.write_record(columns.iter().map(Column::heading))?;
        for row in 0..rows {
            let value = |c: &Column| c.values.get(row).copied().filter(|x| x.is_finite());
            let cell = |c: &Column| value(c).map_or_else(String::new, |x| format!("{x:?}"));
            writer.write_record(columns.iter().map(cell))?;
        }
        Ok(writer.flush()?)
    };
    write().map_err(|error| Error::file("write", path)(error.into()))
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
        write_csv(&path, &[t, x]).unwrap();
        let text = std::fs::read_to_string(&path).unwrap();
        assert_eq!(text, "t [s],der(x1) [m/s]\n0.0,1e-300\n0.30000000000000004,\n");
        let missing = folder.path().join("no/such/folder.csv");
        assert!(write_csv(&missing, &[]).unwrap_err().to_string().contains("cannot write"));
    }
}
