//! Errors for the person who wrote the declaration.
//!
//! `Diagnostics` collects the errors of a stage, and its `finish` ends the stage. A stage with errors is the
//! last one. All of its errors are shown. An error has the span of the token at fault, a `help` that mends
//! it, and notes with the lines of other places.

use std::fmt;

use mbs_symbolic::units::Dimension;
use proc_macro2::{Ident, Span, TokenStream};
use quote::quote_spanned;

/// The text between an error and how to mend it.
pub const HELP: &str = "\n\nhelp: ";

/// End of the message about a name that is a word of Rust. Each such name is reported once, where it stands first.
pub const WORD_OF_RUST: &str = "is a word of Rust and cannot be a name here";

/// A count with what it counts: `1 coordinate`, `2 coordinates`.
pub fn counted(count: impl fmt::Display, one: &str) -> String {
    let count = count.to_string();
    let plural = if count == "1" { "" } else { "s" };
    format!("{count} {one}{plural}")
}

/// One error: what is wrong, where, and how to mend it.
#[derive(Clone, Debug)]
pub struct Diagnostic {
    /// The token at fault.
    pub span: Span,
    /// The fault, in the words of the declaration.
    pub message: String,
    /// How to mend it.
    pub help: Option<String>,
    /// Other places that matter, such as an earlier definition.
    pub notes: Vec<(Span, String)>,
}

impl Diagnostic {
    /// An error at a token.
    pub fn new(span: Span, message: impl Into<String>) -> Self {
        Self { span, message: message.into(), help: None, notes: Vec::new() }
    }

    /// Adds how to mend it.
    #[must_use]
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// Adds another place that matters.
    #[must_use]
    pub fn note(mut self, span: Span, note: impl Into<String>) -> Self {
        self.notes.push((span, note.into()));
        self
    }

    /// An inconsistency that is the compiler's own fault.
    pub fn internal(span: Span, what: impl fmt::Display) -> Self {
        Self::new(span, format!("internal inconsistency of the mechanism compiler: {what}"))
            .help("this is not your mistake; please report it with the declaration")
    }

    /// The text as the compiler shows it: one error, with its notes as lines.
    pub fn text(&self) -> String {
        let mut text = self.message.clone();
        if let Some(help) = &self.help {
            text += HELP;
            text += help;
        }
        let mut separator = if self.help.is_some() { "\n" } else { "\n\n" };
        for (span, note) in &self.notes {
            text += &format!("{separator}note: {}", located(note, *span));
            separator = "\n";
        }
        text
    }

    fn to_tokens(&self) -> TokenStream {
        let text = self.text();
        quote_spanned!(self.span=> ::core::compile_error!(#text);)
    }
}

/// A note with the line of its place. Macros have no other way to show a
/// second place than a second error.
fn located(note: &str, place: Span) -> String {
    match (place.start().line, note.strip_suffix("here")) {
        (0, _) => note.to_owned(),
        (line, Some(start)) => format!("{start}in line {line}"),
        (line, None) => format!("{note}, line {line}"),
    }
}

impl From<syn::Error> for Diagnostic {
    /// The errors combined with the first are its notes.
    fn from(error: syn::Error) -> Self {
        let notes = error.clone().into_iter().skip(1).map(|note| (note.span(), note.to_string())).collect();
        let text = error.to_string();
        let (message, help) = match text.split_once(HELP) {
            Some((message, help)) => (message, Some(help.to_owned())),
            None => (text.as_str(), None),
        };
        Self { help, notes, ..Self::new(error.span(), message) }
    }
}

/// Collects the errors of a stage, so that all of them are shown at once.
#[derive(Debug, Default)]
#[must_use]
pub struct Diagnostics {
    list: Vec<Diagnostic>,
}

impl Diagnostics {
    /// Adds an error.
    pub fn push(&mut self, diagnostic: impl Into<Diagnostic>) {
        let diagnostic = diagnostic.into();
        let is_said = |other: &Diagnostic| other.message == diagnostic.message;
        if !diagnostic.message.ends_with(WORD_OF_RUST) || !self.list.iter().any(is_said) {
            self.list.push(diagnostic);
        }
    }

    /// The value, or `None` with its error added.
    pub fn take<T>(&mut self, result: Result<T, Diagnostic>) -> Option<T> {
        result.map_err(|diagnostic| self.push(diagnostic)).ok()
    }

    /// Their number.
    pub fn len(&self) -> usize {
        self.list.len()
    }

    /// True if there are none.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// Forgets all but the first `length`.
    pub fn truncate(&mut self, length: usize) {
        self.list.truncate(length);
    }

    /// The end of a stage: `value` if it had no errors.
    ///
    /// # Errors
    /// The errors themselves, if there are any.
    pub fn finish<T>(self, value: T) -> Result<T, Self> {
        if self.list.is_empty() { Ok(value) } else { Err(self) }
    }

    /// All errors, in the order in which they were found.
    pub fn iter(&self) -> impl Iterator<Item = &Diagnostic> {
        self.list.iter()
    }

    /// The errors as `compile_error!` invocations.
    pub fn to_compile_errors(&self) -> TokenStream {
        self.list.iter().map(Diagnostic::to_tokens).collect()
    }
}

impl fmt::Display for Diagnostics {
    /// The errors one below the other, each with line and column where they are known.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (at, diagnostic) in self.list.iter().enumerate() {
            let separator = if at == 0 { "" } else { "\n\n" };
            let start = diagnostic.span.start();
            let place = match start.line {
                0 => String::new(),
                line => format!("{line}:{}: ", start.column + 1),
            };
            write!(f, "{separator}{place}{}", diagnostic.text())?;
        }
        Ok(())
    }
}

impl std::error::Error for Diagnostics {}

impl From<Diagnostic> for Diagnostics {
    fn from(diagnostic: Diagnostic) -> Self {
        Self { list: vec![diagnostic] }
    }
}

/// The candidate closest to `name`, if it is close enough to be a misspelling:
/// other letters in one of three places, other cases anywhere, a lost letter, or
/// a longer or shorter form of the same word.
pub fn nearest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let name = name.to_lowercase();
    // Of two letters, one is no misspelling of the other: `x1` and `y1`.
    let tolerance = match name.chars().count() {
        0..=2 => 0,
        length => length.div_ceil(3),
    };
    let is_word = name.len() >= 2 && name.chars().all(char::is_alphabetic);
    let extends = |a: &str, b: &str| b.len() >= 3 && a.starts_with(b);
    candidates
        .into_iter()
        .map(|candidate| {
            let other = candidate.to_lowercase();
            let distance = distance(&name, &other);
            let lost_a_letter = is_word && distance == 1 && other.len() == name.len() + 1;
            let is_form = lost_a_letter || extends(&name, &other) || extends(&other, &name);
            (distance, is_form, candidate)
        })
        .filter(|(distance, is_form, _)| *distance <= tolerance || *is_form)
        .min_by_key(|(distance, ..)| *distance)
        .map(|(.., candidate)| candidate)
}

/// Levenshtein's distance.
fn distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, y) in b.iter().enumerate() {
            let substituted = diagonal + usize::from(x != *y);
            diagonal = row[j + 1];
            row[j + 1] = substituted.min(diagonal + 1).min(row[j] + 1);
        }
    }
    row[b.len()]
}

/// The error of a name that is known to the law of an element, and declared elsewhere.
pub fn two_meanings(name: &Ident, element: &str, declared: Span) -> Diagnostic {
    let message = format!("`{name}` has two meanings here");
    Diagnostic::new(name.span(), message).note(declared, format!("`{name}` is declared here")).help(format!(
        "in the law of a {element} it is that between the two places; call the other one differently"
    ))
}

/// A dimension with its article: `a mass [kg]`, `an area [m^2]`.
pub fn described(dimension: Dimension) -> String {
    let text = dimension.to_string();
    match text.chars().next() {
        _ if dimension == Dimension::NONE => "a bare number or angle".to_owned(),
        Some('[') => format!("a quantity in {text}"),
        Some('a' | 'e' | 'i' | 'o' | 'u') => format!("an {text}"),
        _ => format!("a {text}"),
    }
}

/// `` `a`, `b` and `c` ``
pub fn listing<T: fmt::Display>(items: impl IntoIterator<Item = T>) -> String {
    joined(items.into_iter().map(|item| format!("`{item}`")))
}

/// a, b and c
pub fn joined<T: fmt::Display>(items: impl IntoIterator<Item = T>) -> String {
    let items: Vec<String> = items.into_iter().map(|item| item.to_string()).collect();
    match items.split_last() {
        Some((last, [])) => last.clone(),
        Some((last, rest)) => format!("{} and {last}", rest.join(", ")),
        None => "none".to_owned(),
    }
}
