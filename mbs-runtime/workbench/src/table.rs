//! Tables in plain text.

use std::fmt;

/// A table with a heading per column, printed with aligned columns.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Table {
    headings: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl Table {
    /// An empty table with these headings.
    pub fn new<S: Into<String>>(headings: impl IntoIterator<Item = S>) -> Self {
        Self { headings: headings.into_iter().map(Into::into).collect(), rows: Vec::new() }
    }

    /// Appends a row; missing cells are empty.
    pub fn row<S: Into<String>>(&mut self, cells: impl IntoIterator<Item = S>) {
        self.rows.push(cells.into_iter().map(Into::into).collect());
    }

    /// The headings.
    pub fn headings(&self) -> &[String] {
        &self.headings
    }

    /// The rows.
    pub fn rows(&self) -> &[Vec<String>] {
        &self.rows
    }
}

/// Columns on a terminal: characters, without the dots that combine with one (Φ̇).
fn width(text: &str) -> usize {
    text.chars().filter(|c| !('\u{300}'..='\u{36f}').contains(c)).count()
}

impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let columns = self.rows.iter().map(Vec::len).chain([self.headings.len()]).max().unwrap_or(0);
        let lines = || std::iter::once(&self.headings).chain(&self.rows);
        let cell = |line: &'_ [String], at: usize| line.get(at).cloned().unwrap_or_default();
        let widths: Vec<_> =
            (0..columns).map(|at| lines().map(|line| width(&cell(line, at))).max().unwrap_or(0)).collect();
        for (number, line) in lines().enumerate() {
            let mut text = String::new();
            for (at, column) in widths.iter().enumerate() {
                let content = cell(line, at);
                text += &content;
                text += &" ".repeat(column - width(&content) + 2);
            }
            writeln!(f, "{}", text.trim_end())?;
            if number == 0 {
                let rules: Vec<_> = widths.iter().map(|w| "─".repeat(*w)).collect();
                writeln!(f, "{}", rules.join("  "))?;
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::Table;

    #[test]
    fn columns_are_aligned_in_characters() {
        let mut table = Table::new(["‖Φ‖", "value"]);
        table.row(["a", "1"]);
        table.row(["long", "2"]);
        assert_eq!(table.to_string(), "‖Φ‖   value\n────  ─────\na     1\nlong  2\n");
    }
}
