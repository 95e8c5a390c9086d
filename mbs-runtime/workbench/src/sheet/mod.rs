//! Tables of numbers in files: a quantity with its unit in each column, one of which may be the time.
//!
//! `dialect` reads tables as instruments write them. `signals.rs` takes inputs from a table, and
//! `measurements.rs` the values that `mbs fit` compares.

mod dialect;
#[cfg(test)]
mod tests;

use std::path::Path;

use mbs_runtime::Quantity;
use mbs_symbolic::units;

use self::dialect::Cells;
use crate::quantity::TIME;
use crate::{Error, quantity};

/// Values beyond this in SI units are refused: their squares would leave the range of numbers.
const LARGEST: f64 = 1e100;

/// A table whose headings are such as `t [s]` and `crank_torque [N*mm]`.
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
    /// Empty where neither the heading nor a row of units names one.
    pub unit: String,
    cells: Vec<String>,
}

impl Sheet {
    /// Reads a file with a column of time.
    ///
    /// # Errors
    /// As [`without_time`](Self::without_time); [`Error::Name`] where no column or several are the time,
    /// [`Error::Value`] where time is no number or does not ascend.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let mut sheet = Self::without_time(path)?;
        if sheet.columns.len() < 2 {
            let reason = "it needs a column for time, one for a quantity, and a row; cells are separated by \
                          commas, semicolons or tabs"
                .into();
            return Err(Error::Name { name: sheet.path, reason });
        }
        let time = sheet.columns.remove(sheet.time()?);
        sheet.times = sheet.ascending(&time)?;
        Ok(sheet)
    }

    /// Reads a file of quantities alone.
    ///
    /// # Errors
    /// [`Error::File`] if it cannot be read, [`Error::Name`] and [`Error::Value`] for what is no table, and one
    /// without rows.
    pub fn without_time(path: &Path) -> Result<Self, Error> {
        let Cells { headings, units, rows } = Cells::read(path)?;
        let mut columns: Vec<SheetColumn> =
            headings.iter().map(|heading| SheetColumn::new(heading)).collect();
        for (column, unit) in columns.iter_mut().zip(units.into_iter().flatten()) {
            if column.unit.is_empty() {
                column.unit = written(&unit);
            }
        }
        let mut lines = Vec::new();
        for (line, cells) in rows {
            lines.push(line);
            columns.iter_mut().zip(cells).for_each(|(column, cell)| column.cells.push(cell));
        }
        let path = path.display().to_string();
        if lines.is_empty() {
            let reason = "it needs a heading for each column, and a row".into();
            return Err(Error::Name { name: path, reason });
        }
        Ok(Self { path, times: Vec::new(), columns, lines })
    }

    /// Which column is the time: the one that is called so, the one with a unit of time, or else one in whose
    /// name the word is.
    fn time(&self) -> Result<usize, Error> {
        let ways: [&dyn Fn(&SheetColumn) -> bool; 3] = [
            // `T` is a temperature
            &|column| column.name == "t" || column.name.to_lowercase() == "time",
            &|column| is_of_time(&column.unit),
            &|column| column.name.to_lowercase().contains("time"),
        ];
        let listed = |columns: &mut dyn Iterator<Item = &SheetColumn>| {
            columns.map(|column| format!("`{}`", column.name)).collect::<Vec<_>>().join(", ")
        };
        let refused = |reason| Err(Error::Name { name: self.path.clone(), reason });
        for is_time in ways {
            let mut found = (0..self.columns.len()).filter(|at| is_time(&self.columns[*at]));
            match (found.next(), found.next()) {
                (Some(only), None) => return Ok(only),
                (None, _) => {}
                _ => {
                    let which = listed(&mut self.columns.iter().filter(|column| is_time(column)));
                    return refused(format!("{which} may each be the time; call the one that it is `t`"));
                }
            }
        }
        let has = listed(&mut self.columns.iter());
        refused(format!(
            "none of its columns is the time: {has}; call the one that it is `t`, such as `t [s]`"
        ))
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
    /// The error of `read`, with the place of the cell; [`Error::Value`] for a number out of all measure;
    /// [`Error::Name`] if two columns have that name.
    pub fn values(
        &self,
        column: &SheetColumn,
        read: impl Fn(&str) -> Result<f64, Error>,
    ) -> Result<Vec<Option<f64>>, Error> {
        if self.columns.iter().filter(|other| other.name == column.name).count() > 1 {
            let reason = format!("{} has two columns of that name", self.path);
            return Err(Error::Name { name: column.name.clone(), reason });
        }
        let value = |(row, cell): (usize, &String)| {
            if cell.is_empty() {
                return Ok(None);
            }
            let text = column.with_unit(cell);
            match read(&text) {
                Ok(value) if value.abs() <= LARGEST => Ok(Some(value)),
                Ok(_) => {
                    let reason = format!(
                        "it is out of all measure, beyond {LARGEST:e} in SI units; is that its unit?"
                    );
                    Err(Error::Value { what: self.place(row, &column.name), text, reason })
                }
                Err(error) => Err(error.about(self.place(row, &column.name))),
            }
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

    /// Checks that every column is one of these quantities.
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
    /// Of a heading such as `x [mm]`, `x (mm)` or `t_ms`.
    fn new(heading: &str) -> Self {
        let heading = heading.trim();
        let bracketed = enclosed(heading, ['[', ']']);
        let parenthesised = enclosed(heading, ['(', ')']).filter(|(name, unit)| {
            // `der(x)` is a name
            let is_call = name.ends_with("der") || name.ends_with("lambda");
            !is_call && (unit_of(unit).is_some() || name.ends_with(char::is_whitespace))
        });
        let of_time = heading.rsplit_once(['_', ' ']).filter(|(name, unit)| {
            matches!(name.to_lowercase().as_str(), "t" | "time")
                && is_of_time(&unit_of(unit).unwrap_or_default())
        });
        let (name, unit) = bracketed.or(parenthesised).or(of_time).unwrap_or((heading, ""));
        Self { name: name.trim().to_owned(), unit: written(unit), cells: Vec::new() }
    }

    fn with_unit(&self, number: &str) -> String {
        format!("{number} {}", self.unit).trim().to_owned()
    }
}

/// The parts of a heading before and within the pair of signs that ends it. `None` if no pair ends it, or nothing
/// stands before the pair.
fn enclosed(heading: &str, [open, close]: [char; 2]) -> Option<(&str, &str)> {
    let within = heading.strip_suffix(close)?;
    let mut depth = 0;
    let at = within.char_indices().rev().find_map(|(at, sign)| {
        depth += i32::from(sign == close) - i32::from(sign == open);
        (depth < 0).then_some(at)
    })?;
    let (name, unit) = within.split_at(at);
    (!name.trim().is_empty()).then_some((name, unit.get(1..)?))
}

fn is_of_time(unit: &str) -> bool {
    units::parse(unit).is_ok_and(|unit| unit.dimension == units::Dimension::TIME)
}

/// Signs in units of other programs, each with that of the language.
const SIGNS: [(&str, &str); 7] =
    [("°", "deg"), ("º", "deg"), ("µ", "u"), ("μ", "u"), ("·", "*"), ("²", "^2"), ("³", "^3")];
/// Units of other programs as whole words, each with that of the language.
const WORDS: [(&str, &str); 9] = [
    ("sec", "s"),
    ("second", "s"),
    ("seconds", "s"),
    ("msec", "ms"),
    ("degree", "deg"),
    ("degrees", "deg"),
    ("Nm", "N*m"),
    ("Nmm", "N*mm"),
    ("m/s2", "m/s^2"),
];

/// A unit as the language writes it, or as it stands there if it knows none such.
fn written(unit: &str) -> String {
    match unit.trim() {
        "-" => String::new(),
        unit => unit_of(unit).unwrap_or_else(|| unit.to_owned()),
    }
}

/// A unit as the language writes it, of one such as `°`, `[N·m]` or `sec`; nothing for what is none.
fn unit_of(text: &str) -> Option<String> {
    let text = text.trim();
    let pairs = [['[', ']'], ['(', ')']];
    let inner = |[open, close]: [char; 2]| text.strip_prefix(open)?.strip_suffix(close);
    let text = pairs.into_iter().find_map(inner).unwrap_or(text).trim();
    let word = WORDS.iter().find(|(word, _)| *word == text).map_or(text, |(_, unit)| unit);
    let unit = SIGNS.iter().fold(word.to_owned(), |unit, (sign, name)| unit.replace(sign, name));
    units::parse(&unit).is_ok().then_some(unit)
}
