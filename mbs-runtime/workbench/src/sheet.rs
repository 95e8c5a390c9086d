//! Tables of numbers in files: time first, and a quantity with its unit in each of the other columns.

use std::path::Path;

use mbs_runtime::Quantity;

use crate::quantity::TIME;
use crate::{Error, quantity};

/// A CSV file whose headings are such as `t [s]` and `crank_torque [N*mm]`.
pub(crate) struct Sheet {
    path: String,
    /// Time in s, of a table that has it.
    pub times: Vec<f64>,
    pub columns: Vec<SheetColumn>,
    /// The lines of the file in which the rows stand.
    lines: Vec<u64>,
}

/// A column as it was read.
pub(crate) struct SheetColumn {
    pub name: String,
    /// Empty where the heading names none.
    pub unit: String,
    cells: Vec<String>,
}

impl Sheet {
    /// Reads a file whose first column is the time.
    ///
    /// # Errors
    /// As [`without_time`](Self::without_time), and [`Error::Value`] where time is no number or does not
    /// ascend.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let mut sheet = Self::without_time(path)?;
        if sheet.columns.len() < 2 {
            let reason = "it needs a column for time, one for a quantity, and a row".into();
            return Err(Error::Name { name: sheet.path, reason });
        }
        let time = sheet.columns.remove(0);
        sheet.times = sheet.ascending(&time)?;
        Ok(sheet)
    }

    /// Reads a file of quantities alone.
    ///
    /// # Errors
    /// [`Error::File`] if it cannot be read, [`Error::Name`] for two columns of one name or a file without
    /// rows.
    pub fn without_time(path: &Path) -> Result<Self, Error> {
        let unreadable = |error: csv::Error| Error::file("read", path)(error.into());
        let mut table = csv::ReaderBuilder::new().trim(csv::Trim::All).from_path(path).map_err(unreadable)?;
        let headings = table.headers().map_err(unreadable)?.clone();
        let mut columns: Vec<SheetColumn> = headings.iter().map(SheetColumn::new).collect();
        let mut lines = Vec::new();
        for record in table.records() {
            let record = record.map_err(unreadable)?;
            lines.push(record.position().map_or(0, csv::Position::line));
            for (column, cell) in columns.iter_mut().zip(&record) {
                column.cells.push(cell.to_owned());
            }
        }
        let path = path.display().to_string();
        for (at, column) in columns.iter().enumerate() {
            if columns.iter().take(at).any(|other| other.name == column.name) {
                let reason = format!("{path} has two columns of that name");
                return Err(Error::Name { name: column.name.clone(), reason });
            }
        }
        if lines.is_empty() {
            let reason = "it needs a heading for each column, and a row".into();
            return Err(Error::Name { name: path, reason });
        }
        Ok(Self { path, times: Vec::new(), columns, lines })
    }

    fn ascending(&self, column: &SheetColumn) -> Result<Vec<f64>, Error> {
        let mut times: Vec<f64> = Vec::new();
        for (row, cell) in column.cells.iter().enumerate() {
            let time = quantity::parse(&self.place(row, "time"), &column.with_unit(cell), TIME)?;
            if times.last().is_some_and(|last| *last >= time) {
                let reason = "time has to rise from row to row".into();
                return Err(Error::Value { what: self.place(row, "time"), text: cell.clone(), reason });
            }
            times.push(time);
        }
        Ok(times)
    }

    /// Where a cell stands.
    pub fn place(&self, row: usize, what: &str) -> String {
        let line = self.lines.get(row).copied().unwrap_or_default();
        format!("{}, line {line}: {what}", self.path)
    }

    /// The values of a column, each read by `read` from its text with the unit of the heading; nothing for
    /// empty cells.
    ///
    /// # Errors
    /// What `read` says, with the place of the cell.
    pub fn values(
        &self,
        column: &SheetColumn,
        read: impl Fn(&str) -> Result<f64, Error>,
    ) -> Result<Vec<Option<f64>>, Error> {
        let value = |(row, cell): (usize, &String)| {
            let text = (!cell.is_empty()).then(|| column.with_unit(cell));
            let value = text.map(|text| read(&text)).transpose();
            value.map_err(|error| error.about(self.place(row, &column.name)))
        };
        column.cells.iter().enumerate().map(value).collect()
    }

    /// The same of a column without empty cells.
    ///
    /// # Errors
    /// As [`values`](Self::values), and [`Error::Value`] for an empty cell.
    pub fn complete(
        &self,
        column: &SheetColumn,
        read: impl Fn(&str) -> Result<f64, Error>,
    ) -> Result<Vec<f64>, Error> {
        let values = self.values(column, read)?;
        if let Some(row) = values.iter().position(Option::is_none) {
            let reason = "it needs a value in every row".into();
            let what = self.place(row, &column.name);
            return Err(Error::Value { what, text: String::new(), reason });
        }
        Ok(values.into_iter().flatten().collect())
    }

    /// Whether every column is one of these quantities.
    ///
    /// # Errors
    /// [`Error::Unknown`] for another one.
    pub fn are_known(&self, kind: &'static str, quantities: &[Quantity]) -> Result<(), Error> {
        let known = || quantities.iter().map(|quantity| quantity.name);
        let other = self.columns.iter().find(|column| known().all(|name| name != column.name));
        other.map_or(Ok(()), |column| Err(Error::unknown(kind, &column.name, known())))
    }
}

impl SheetColumn {
    fn new(heading: &str) -> Self {
        let (name, unit) = match heading.split_once('[') {
            Some((name, unit)) => (name.trim(), unit.trim_end_matches(']').trim()),
            None => (heading, ""),
        };
        Self { name: name.to_owned(), unit: unit.to_owned(), cells: Vec::new() }
    }

    fn with_unit(&self, number: &str) -> String {
        format!("{number} {}", self.unit).trim().to_owned()
    }
}
