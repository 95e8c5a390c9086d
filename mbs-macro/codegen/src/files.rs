//! Tables of files: `table gas(angle) = from "gas.csv" cubic outside periodic;` becomes the table of its points.
//!
//! This is done on tokens, before anything is parsed, so that all stages see points alone. Points have the place of the
//! name of their file.

use proc_macro2::{Delimiter, Group, Ident, Literal, Punct, Spacing, Span, TokenStream, TokenTree};

use crate::diagnostics::{Diagnostic, Diagnostics, listing, nearest};

/// More rows than this are no table that somebody looks up.
const MOST_ROWS: usize = 100_000;

/// Lines that begin so are left out.
const COMMENT: u8 = b'#';

/// Gives the text of a file, or why there is none.
pub type Read<'a> = &'a mut dyn FnMut(&str) -> Result<String, String>;

/// A declaration with the points of all files that its tables name.
///
/// # Errors
/// Files that cannot be read, and columns that they do not have.
pub fn with_files(declaration: TokenStream, read: Read<'_>) -> Result<TokenStream, Diagnostics> {
    let mut errors = Diagnostics::default();
    let replaced = replaced(&declaration, read, &mut errors);
    errors.finish(replaced.unwrap_or(declaration))
}

/// Tokens with points in the place of files; `None` where they name none, so that all keep their places.
fn replaced(tokens: &TokenStream, read: Read<'_>, errors: &mut Diagnostics) -> Option<TokenStream> {
    let tokens: Vec<TokenTree> = tokens.clone().into_iter().collect();
    let mut found = Vec::with_capacity(tokens.len());
    let mut is_changed = false;
    let mut rest = tokens.as_slice();
    while let Some((first, behind)) = rest.split_first() {
        if let Some((table, count)) = Table::at(rest) {
            let points = errors.take(table.points(read)).unwrap_or_default();
            found.extend(rest.iter().take(count - 2).cloned());
            found.extend(table.placed([group(Delimiter::Bracket, points)]));
            rest = rest.get(count..).unwrap_or_default();
            is_changed = true;
            continue;
        }
        let inside = match first {
            TokenTree::Group(of) => replaced(&of.stream(), read, errors).map(|inside| (of, inside)),
            _ => None,
        };
        is_changed |= inside.is_some();
        found.push(inside.map_or_else(
            || first.clone(),
            |(of, inside)| {
                let mut inside = Group::new(of.delimiter(), inside);
                inside.set_span(of.span());
                inside.into()
            },
        ));
        rest = behind;
    }
    is_changed.then(|| found.into_iter().collect())
}

/// A table that names a file.
struct Table {
    name: Ident,
    /// The columns of its arguments.
    arguments: Vec<Ident>,
    file: String,
    span: Span,
}

impl Table {
    /// The table that begins here, and the number of tokens up to the name of its file.
    fn at(tokens: &[TokenTree]) -> Option<(Self, usize)> {
        // `table gas(angle)`, or `table gas[i](angle)` in a loop
        let (word, name, rest) = match tokens {
            [TokenTree::Ident(word), TokenTree::Ident(name), TokenTree::Group(index), rest @ ..]
                if index.delimiter() == Delimiter::Bracket =>
            {
                (word, name, rest)
            }
            [TokenTree::Ident(word), TokenTree::Ident(name), rest @ ..] => (word, name, rest),
            _ => return None,
        };
        let [
            TokenTree::Group(arguments),
            TokenTree::Punct(equals),
            TokenTree::Ident(from),
            TokenTree::Literal(file),
            behind @ ..,
        ] = rest
        else {
            return None;
        };
        if word != "table" || equals.as_char() != '=' || from != "from" {
            return None;
        }
        let text: syn::LitStr = syn::parse2(TokenTree::from(file.clone()).into()).ok()?;
        let arguments = arguments.stream().into_iter().filter_map(|token| match token {
            TokenTree::Ident(argument) => Some(argument),
            _ => None,
        });
        let table = Self {
            name: name.clone(),
            arguments: arguments.collect(),
            file: text.value(),
            span: file.span(),
        };
        Some((table, tokens.len() - behind.len()))
    }

    /// `(30 [deg], 2 [bar]), …`
    fn points(&self, read: Read<'_>) -> Result<TokenStream, Diagnostic> {
        let Self { name, file, span, .. } = self;
        let text = read(file).map_err(|reason| {
            Diagnostic::new(*span, format!("`{file}` cannot be read: {reason}"))
                .help("a table's file stands beside the declaration, or in a folder there")
        })?;
        let text = text.trim_start_matches('\u{feff}');
        let first = text.lines().find(|line| !line.starts_with(COMMENT as char)).unwrap_or_default();
        let separator = [b';', b'\t'].into_iter().find(|it| first.contains(*it as char)).unwrap_or(b',');
        let mut rows = csv::ReaderBuilder::new();
        rows.delimiter(separator).comment(Some(COMMENT)).trim(csv::Trim::All);
        let mut rows = rows.from_reader(text.as_bytes());
        let header = rows.headers().map_err(|error| self.unreadable(&error))?;
        let names: Vec<Column> = header.iter().map(Column::of).collect();
        let wanted = self.arguments.iter().chain([name]);
        let columns: Vec<usize> =
            wanted.map(|wanted| self.column(&wanted.to_string(), &names)).collect::<Result<_, _>>()?;
        let mut points = TokenStream::new();
        for (at, row) in rows.records().enumerate() {
            let row = row.map_err(|error| self.unreadable(&error))?;
            if at >= MOST_ROWS {
                let message = format!("`{file}` has more than {MOST_ROWS} rows");
                return Err(Diagnostic::new(*span, message).help("give fewer points"));
            }
            let mut numbers = TokenStream::new();
            for &column in &columns {
                let cell = row.get(column).unwrap_or_default();
                let Some(number) = number(cell, separator) else {
                    let (of, row) = (&names[column].name, at + 1);
                    let message =
                        format!("`{file}` has no number in row {row} of its column `{of}`: `{cell}`");
                    return Err(Diagnostic::new(*span, message).help("leave the row out, or complete it"));
                };
                numbers.extend(self.quantity(number, &names[column])?);
            }
            points.extend(self.placed([group(Delimiter::Parenthesis, numbers), comma()]));
        }
        Ok(points)
    }

    /// The error for rows that are no table.
    fn unreadable(&self, error: &csv::Error) -> Diagnostic {
        let reason = match error.kind() {
            csv::ErrorKind::UnequalLengths { pos, expected_len, len } => {
                let line = pos.as_ref().map_or(0, csv::Position::line);
                format!("line {line} has {len} cells and the first one {expected_len}")
            }
            _ => error.to_string(),
        };
        Diagnostic::new(self.span, format!("`{}` is no table: {reason}", self.file)).help(
            "a table has a line of names with units, `angle [deg], gas [bar]`, and a row for each point",
        )
    }

    fn column(&self, wanted: &str, names: &[Column]) -> Result<usize, Diagnostic> {
        let mut found = names.iter().enumerate().filter(|(_, column)| column.name == wanted);
        match (found.next(), found.next()) {
            (Some((at, _)), None) => return Ok(at),
            (Some(_), Some(_)) => {
                let message = format!("`{}` has two columns `{wanted}`", self.file);
                return Err(Diagnostic::new(self.span, message).help("call one of them another name"));
            }
            (None, _) => {}
        }
        let known: Vec<&str> = names.iter().map(|column| column.name.as_str()).collect();
        let help = match nearest(wanted, known.iter().copied()) {
            Some(near) => format!("did you mean `{near}`? Columns are called as the table and its arguments"),
            None => {
                format!("its columns are {}; they are called as the table and its arguments", listing(known))
            }
        };
        Err(Diagnostic::new(self.span, format!("`{}` has no column `{wanted}`", self.file)).help(help))
    }

    /// `-2.5 [bar],`
    fn quantity(&self, number: f64, column: &Column) -> Result<TokenStream, Diagnostic> {
        let sign = number.is_sign_negative().then(|| TokenTree::from(Punct::new('-', Spacing::Alone)));
        let number = TokenTree::from(Literal::f64_unsuffixed(number.abs()));
        let unit = match column.unit.as_str() {
            "" => None,
            unit => Some(group(Delimiter::Bracket, unit.parse().map_err(|_| self.no_unit(unit))?)),
        };
        Ok(self.placed(sign.into_iter().chain([number]).chain(unit).chain([comma()])))
    }

    fn no_unit(&self, unit: &str) -> Diagnostic {
        Diagnostic::new(self.span, format!("`[{unit}]` in `{}` is no unit", self.file))
            .help("write units as in a declaration, `[N*m]`")
    }

    /// Tokens at the place of the name of the file.
    fn placed(&self, tokens: impl IntoIterator<Item = TokenTree>) -> TokenStream {
        let place = |token: TokenTree| match token {
            TokenTree::Group(group) => {
                let mut placed = Group::new(group.delimiter(), self.placed(group.stream()));
                placed.set_span(self.span);
                placed.into()
            }
            mut other => {
                other.set_span(self.span);
                other
            }
        };
        tokens.into_iter().map(place).collect()
    }
}

/// A column of a file.
struct Column {
    name: String,
    /// Empty without one.
    unit: String,
}

impl Column {
    /// `angle [deg]`
    fn of(header: &str) -> Self {
        let with_unit = header.strip_suffix(']').and_then(|header| header.split_once('['));
        let (name, unit) = with_unit.unwrap_or((header, ""));
        // as tables are often written
        let unit = if unit.trim() == "°" { "deg" } else { unit };
        Self { name: name.trim().to_owned(), unit: unit.trim().to_owned() }
    }
}

/// A finite number; with a decimal comma where no comma separates columns.
fn number(cell: &str, separator: u8) -> Option<f64> {
    let text = if separator == b',' { cell.to_owned() } else { cell.replace(',', ".") };
    text.parse().ok().filter(|number: &f64| number.is_finite())
}

fn group(delimiter: Delimiter, tokens: TokenStream) -> TokenTree {
    Group::new(delimiter, tokens).into()
}

fn comma() -> TokenTree {
    Punct::new(',', Spacing::Alone).into()
}
