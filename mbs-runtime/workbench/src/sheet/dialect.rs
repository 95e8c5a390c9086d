//! Tables as programs and instruments write them: which separator, decimal sign, encoding and comments.

use std::path::Path;

use crate::{Error, files};

/// The cells of a table.
pub(crate) struct Cells {
    /// The cells of the headings.
    pub headings: Vec<String>,
    /// The cells of a row of units beneath the headings, if there is one.
    pub units: Option<Vec<String>>,
    /// The cells of the rows, with the lines of the file in which they stand. Numbers have a decimal point.
    pub rows: Vec<(u64, Vec<String>)>,
}

/// Lines that begin with one of these are comments.
const COMMENTS: [char; 2] = ['#', '%'];
/// Separators of cells. The first of them that a line has is its separator.
const SEPARATORS: [u8; 3] = [b'\t', b';', b','];

impl Cells {
    /// Reads a file.
    ///
    /// # Errors
    /// [`Error::File`] if it cannot be read, [`Error::Name`] and [`Error::Value`] for what is no table, with the line.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let text = decoded(&files::read(path)?).map_err(|reason| refused(path, reason))?;
        let (text, separator) = without_comments(&text);
        let unreadable = |error: csv::Error| Error::file("read", path)(error.into());
        let mut reader = csv::ReaderBuilder::new()
            .has_headers(false)
            .flexible(true)
            .trim(csv::Trim::All)
            .delimiter(separator)
            .from_reader(text.as_bytes());
        let mut lines: Vec<(u64, Vec<String>)> = Vec::new();
        for record in reader.records() {
            let record = record.map_err(unreadable)?;
            let line = record.position().map_or(0, csv::Position::line);
            let cells: Vec<String> = record.iter().map(str::to_owned).collect();
            // a line of separators alone is none
            if cells.iter().any(|cell| !cell.is_empty()) {
                lines.push((line, cells));
            }
        }
        let mut lines = lines.into_iter();
        let Some((heading_line, mut headings)) = lines.next() else {
            return Err(refused(path, "it is empty; it needs a heading for each column, and rows".into()));
        };
        let mut rows: Vec<_> = lines.collect();
        drop_empty_ends(&mut headings, &mut rows);
        for (line, cells) in &rows {
            if cells.len() != headings.len() {
                return Err(refused(
                    path,
                    unlike(*line, cells.len(), heading_line, headings.len(), separator),
                ));
            }
        }
        let has_units = rows.first().is_some_and(|(_, cells)| are_units(cells));
        let units = if has_units { Some(rows.remove(0).1) } else { None };
        if separator != b',' {
            decimal_points(path, &headings, &mut rows)?;
        }
        Ok(Self { headings, units, rows })
    }
}

fn refused(path: &Path, reason: String) -> Error {
    Error::Name { name: path.display().to_string(), reason }
}

/// The text of a file: UTF-8, UTF-16 with a byte order mark, or else what Windows calls 1252, of which headings
/// have `°`, `µ` and `²`.
fn decoded(bytes: &[u8]) -> Result<String, String> {
    let utf16 = |rest: &[u8], number: fn([u8; 2]) -> u16| {
        let (pairs, _) = rest.as_chunks::<2>();
        String::from_utf16(&pairs.iter().map(|pair| number(*pair)).collect::<Vec<_>>())
            .map_err(|_| "it is not the UTF-16 that it begins as; save it as UTF-8".to_owned())
    };
    match bytes {
        [0xff, 0xfe, rest @ ..] => utf16(rest, u16::from_le_bytes),
        [0xfe, 0xff, rest @ ..] => utf16(rest, u16::from_be_bytes),
        [0xef, 0xbb, 0xbf, rest @ ..] => decoded(rest),
        _ if bytes.contains(&0) => {
            Err("it is not text, or UTF-16 without a byte order mark; save it as UTF-8".into())
        }
        _ => Ok(match str::from_utf8(bytes) {
            Ok(text) => text.to_owned(),
            Err(_) => bytes.iter().map(|byte| char::from(*byte)).collect(),
        }),
    }
}

/// The text with empty lines in the place of comments, and what separates its cells. The last comment with several
/// cells is the headings of a table that has none.
fn without_comments(text: &str) -> (String, u8) {
    let is_comment = |line: &&str| line.trim_start().starts_with(COMMENTS);
    let is_row = |line: &&str| !line.trim().is_empty() && !is_comment(line);
    let first = text.lines().find(is_row).unwrap_or_default();
    // as spreadsheets say it
    if let Some(separator) = first.trim().strip_prefix("sep=").and_then(|rest| rest.bytes().next()) {
        return (blank(text, |line| line == first || is_comment(&line), None), separator);
    }
    let is_number = |cell: &str| cell.trim().replace(',', ".").parse::<f64>().is_ok();
    let separator = separator(first);
    let has_cells = |line: &&str| line.contains(char::from(separator));
    let before = text.lines().take_while(|line| !is_row(line)).filter(is_comment);
    let heading = before.filter(has_cells).last();
    let has_no_heading = first.split(char::from(separator)).all(is_number);
    (blank(text, |line| is_comment(&line), heading.filter(|_| has_no_heading)), separator)
}

/// The text with empty lines for some; `heading` is kept without its sign.
fn blank(text: &str, is_blank: impl Fn(&str) -> bool, heading: Option<&str>) -> String {
    let mut kept = String::with_capacity(text.len());
    for line in text.lines() {
        match heading.filter(|heading| std::ptr::eq(*heading, line)) {
            Some(heading) => kept += heading.trim_start().trim_start_matches(COMMENTS),
            None if !is_blank(line) => kept += line,
            None => {}
        }
        kept.push('\n');
    }
    kept
}

/// The separator of the cells of a line, which stands outside of quotes; a comma if there is none.
fn separator(line: &str) -> u8 {
    let outside = || line.split('"').step_by(2);
    let has = |sign: &u8| outside().any(|part| part.contains(char::from(*sign)));
    SEPARATORS.into_iter().find(has).unwrap_or(b',')
}

/// Takes columns away at the end that have neither a heading nor a cell: lines that end with a separator.
fn drop_empty_ends(headings: &mut Vec<String>, rows: &mut [(u64, Vec<String>)]) {
    while headings.last().is_some_and(String::is_empty) {
        headings.pop();
    }
    for (_, cells) in rows {
        while cells.len() > headings.len() && cells.last().is_some_and(String::is_empty) {
            cells.pop();
        }
    }
}

fn unlike(line: u64, found: usize, heading_line: u64, expected: usize, separator: u8) -> String {
    let advice = if expected == 1 {
        "; cells are separated by commas, semicolons or tabs, and lines before the headings begin with #"
    } else if separator == b',' && found + 1 >= 2 * expected {
        "; numbers with a decimal comma need `;` or tabs between the cells"
    } else {
        ""
    };
    let cells = |count: usize| format!("{count} cell{}", if count == 1 { "" } else { "s" });
    format!(
        "line {line} has {}, and the headings in line {heading_line} have {expected}{advice}",
        cells(found)
    )
}

/// `true` if cells are units and not values: one of them at least is a unit, and none is a number.
fn are_units(cells: &[String]) -> bool {
    let is_number = |cell: &String| cell.replacen(',', ".", 1).parse::<f64>().is_ok();
    !cells.iter().any(is_number) && cells.iter().any(|cell| super::unit_of(cell).is_some())
}

/// Gives numbers with a decimal comma a point.
fn decimal_points(path: &Path, headings: &[String], rows: &mut [(u64, Vec<String>)]) -> Result<(), Error> {
    let mut point: Option<(u64, String)> = None;
    let mut comma: Option<(u64, String, String)> = None;
    for (line, cells) in rows {
        for (cell, heading) in cells.iter_mut().zip(headings) {
            let is_number = |text: &str| text.parse::<f64>().is_ok();
            if cell.contains('.') && is_number(cell) {
                point.get_or_insert_with(|| (*line, cell.clone()));
            } else if cell.contains(',') && is_number(&cell.replacen(',', ".", 1)) {
                comma.get_or_insert_with(|| (*line, heading.clone(), cell.clone()));
                *cell = cell.replacen(',', ".", 1);
            }
        }
    }
    match (point, comma) {
        (Some((other_line, other)), Some((line, heading, cell))) => Err(Error::Value {
            what: format!("{}, line {line}: {heading}", path.display()),
            text: cell,
            reason: format!(
                "it has a decimal comma, and `{other}` in line {other_line} a decimal point; one of them \
                 separates thousands: write numbers without that"
            ),
        }),
        _ => Ok(()),
    }
}
