//! The rows of a share as they are read, each held to the plan of its sweep.

use std::io::{self, BufRead};

use super::shard::Heading;

/// The longest line of a share in bytes: no sweep writes as long a one.
const LONGEST: u64 = 1 << 20;

/// Reads a line with its end, or what there is of it.
pub fn line(reader: &mut impl BufRead, line: &mut Vec<u8>) -> io::Result<()> {
    line.clear();
    io::Read::take(reader, LONGEST).read_until(b'\n', line).map(drop)
}

/// The rows of a share, in their order.
pub struct CheckedRows<'a, R> {
    reader: R,
    heading: &'a Heading,
    columns: usize,
    /// Number of rows that were read.
    read: usize,
    line: Vec<u8>,
}

/// Result of reading one more row.
pub enum Next<'a> {
    /// The row of the next run, with the end of its line.
    Row(&'a [u8]),
    /// Nothing: all runs have their rows.
    End,
    /// Which row it is that cannot be the next one, and why.
    Wrong(String),
}

impl<'a, R: BufRead> CheckedRows<'a, R> {
    /// Of a file that is read from its first row on.
    pub fn new(reader: R, heading: &'a Heading, columns: usize) -> Self {
        Self { reader, heading, columns, read: 0, line: Vec::new() }
    }

    /// Reads a row.
    pub fn next(&mut self) -> io::Result<Next<'_>> {
        line(&mut self.reader, &mut self.line)?;
        let members = self.heading.shard.members(self.heading.count());
        let run = members.start + self.read;
        let checked = match self.line.as_slice() {
            [] if run == members.end => return Ok(Next::End),
            [] => {
                let (read, of) = (self.read, members.len());
                return Ok(Next::Wrong(format!("it has {read} of its {of} runs")));
            }
            _ if run == members.end => Err(format!("the share has {} runs", members.len())),
            line => self.check(line, run),
        };
        self.read += 1;
        Ok(match checked {
            Ok(()) => Next::Row(&self.line),
            Err(reason) => Next::Wrong(format!("row {}: {reason}", self.read)),
        })
    }

    /// Checks that a line is the row of a run as a sweep writes it. The error is the reason why it is not.
    fn check(&self, line: &[u8], run: usize) -> Result<(), String> {
        let text = line.strip_suffix(b"\n").ok_or("it is cut")?;
        let text = str::from_utf8(text).map_err(|_| "it is no text")?;
        let cells: Vec<&str> = text.splitn(self.columns, ',').collect();
        let of_columns = || format!("it has {} of {} columns", cells.len(), self.columns);
        let (error, numbers) =
            cells.split_last().filter(|_| cells.len() == self.columns).ok_or_else(of_columns)?;
        let swept = &self.heading.swept;
        let (places, extents) = numbers.split_at_checked(swept.len()).ok_or_else(of_columns)?;
        for ((cell, value), swept) in places.iter().zip(self.heading.shown_values(run)).zip(swept) {
            if cell.parse() != Ok(value) {
                return Err(format!("`{}` is `{cell}`, where the sweep has {value:?}", swept.name));
            }
        }
        if !is_cell(error) {
            return Err("there is more behind its last column".into());
        }
        match (is_finite(extents)?, error.is_empty()) {
            (true, false) => Err("it has all its numbers, and an error".into()),
            (false, true) => Err("it lacks numbers, and does not say why".into()),
            _ => Ok(()),
        }
    }
}

/// Reports whether all cells are finite numbers; `false` if all are empty. The error names a cell that is no number.
fn is_finite(cells: &[&str]) -> Result<bool, String> {
    if cells.iter().all(|cell| cell.is_empty()) {
        return Ok(false);
    }
    let numbers = cells.iter().map(|cell| cell.parse().map_err(|_| format!("`{cell}` is not a number")));
    numbers.collect::<Result<Vec<f64>, _>>().map(|numbers| numbers.iter().all(|x| x.is_finite()))
}

/// Reports whether a text is one cell of CSV.
fn is_cell(text: &str) -> bool {
    match text.strip_prefix('"') {
        Some(quoted) => {
            quoted.strip_suffix('"').is_some_and(|inner| !inner.replace("\"\"", "").contains('"'))
        }
        None => !text.contains([',', '"', '\r']),
    }
}

#[cfg(test)]
mod tests {
    use super::super::shard::tests::heading;
    use super::*;

    /// Result of reading rows of a sweep of l1 = 50, 60, 70 mm with one quantity: `complete`, or the first fault.
    fn said(rows: &str) -> String {
        let heading = heading("1/1");
        let mut rows = CheckedRows::new(rows.as_bytes(), &heading, 5);
        loop {
            match rows.next().unwrap() {
                Next::Row(_) => {}
                Next::End => return "complete".into(),
                Next::Wrong(reason) => return reason,
            }
        }
    }

    #[test]
    fn every_row_is_checked() {
        let good = "50.0,1.0,2.0,1.5,\n60.0,,,,\"too short, `l1`\"\n";
        for (last, expected) in [
            ("70.0,1.0,2.0,1.5,\n", "complete"),
            ("70.0,NaN,NaN,1.5,`x` is not finite\n", "complete"),
            ("", "it has 2 of its 3 runs"),
            ("70.0,1.0,2.0,1.5,", "row 3: it is cut"),
            ("70.0,1.0,2.0,1\n", "row 3: it has 4 of 5 columns"),
            ("70.0,1.0,2.0,1.5,,\n", "row 3: there is more behind its last column"),
            ("70.0,1.0,2.0,1.5,\"a\"b\"\n", "row 3: there is more behind its last column"),
            ("70.0,1.0,2.0,1.5,\r\n", "row 3: there is more behind its last column"),
            ("70.0,1.0,2,0,1.5,\n", "row 3: there is more behind its last column"),
            ("70.0,1.0,x,1.5,\n", "row 3: `x` is not a number"),
            ("70.0,1.0,,1.5,late\n", "row 3: `` is not a number"),
            ("60.0,1.0,2.0,1.5,\n", "row 3: `l1` is `60.0`, where the sweep has 70.0"),
            ("70.0,1.0,inf,1.5,\n", "row 3: it lacks numbers, and does not say why"),
            ("70.0,1.0,2.0,1.5,late\n", "row 3: it has all its numbers, and an error"),
            ("70.0,1.0,2.0,1.5,\n70.0,1.0,2.0,1.5,\n", "row 4: the share has 3 runs"),
        ] {
            assert_eq!(said(&format!("{good}{last}")), expected, "{last}");
        }
    }

    #[test]
    fn a_line_without_an_end_is_read_up_to_a_bound() {
        let mut bytes = Vec::new();
        line(&mut io::BufReader::new(io::repeat(b'1')), &mut bytes).unwrap();
        assert_eq!(bytes.len() as u64, LONGEST);
    }
}
