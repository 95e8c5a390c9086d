//! Errors, with their places in the text.

use std::fmt;
use std::ops::Range;

use ariadne::{CharSet, Config, IndexType, Label, Report, ReportKind, Source};
use mbs_codegen::Diagnostic;
use proc_macro2::Span;

use crate::excerpt::Excerpt;

/// So many problems are shown, which is more than anybody reads at once.
const MOST_SHOWN: usize = 100;

/// The same in bytes: each problem is shown with its lines, which may be long.
const LONGEST_SHOWN: usize = 1 << 18;

/// Why a text was not compiled. Its `Display` shows at most a hundred problems with file, line, column and the
/// underlined source, without colours; [`colored`](Self::colored) shows them with colours.
///
/// # Example
/// ```
/// use mbs_live::Text;
///
/// let text = "Slider {
///     dof = 1;
///     param l = 1 [m];
///     param l = 2 [m];
///     body block (x) { mass = 1 [kg]; }
/// }";
/// let error = Text::declaration("slider.mbs", text).compile().unwrap_err();
/// let problem = &error.problems()[0];
/// assert_eq!((error.file(), problem.message.as_str()), ("slider.mbs", "`l` is declared twice"));
/// assert_eq!(problem.help.as_deref(), Some("rename one of them"));
/// assert_eq!(problem.notes[0].message, "`l` is first declared here");
/// assert!(problem.location.as_ref().is_some_and(|place| (place.line, place.column) == (4, 11)));
/// assert!(error.to_string().contains("slider.mbs:4:11"));
/// assert!(error.colored().to_string().contains('\u{1b}'));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Error {
    file: String,
    text: String,
    problems: Vec<Problem>,
}

/// Warnings about parts of a text that compile and are likely mistakes. They are shown as an [`Error`] is.
///
/// # Example
/// ```
/// use mbs_live::Text;
///
/// let text = "Slider { dof = 1; param k = 2 [N/m]; body block (x) { mass = 1 [kg]; } }";
/// let (_, warnings) = Text::declaration("slider.mbs", text).check()?;
/// assert_eq!(warnings.problems().len(), 1);
/// assert!(warnings.to_string().contains("slider.mbs:1:25"));
/// assert!(warnings.colored().to_string().contains('\u{1b}'));
/// # Ok::<(), mbs_live::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Warnings(pub(crate) Error);

impl Warnings {
    /// The problems, in the order of the text.
    pub fn problems(&self) -> &[Problem] {
        self.0.problems()
    }

    /// The warnings with colours, for a terminal.
    pub fn colored(&self) -> impl fmt::Display + '_ {
        Shown { error: &self.0, kind: ReportKind::Warning, is_colored: true }
    }
}

impl fmt::Display for Warnings {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        Shown { error: &self.0, kind: ReportKind::Warning, is_colored: false }.fmt(f)
    }
}

/// One problem of a text. See the example of [`Error`].
#[derive(Clone, Debug, PartialEq)]
pub struct Problem {
    /// The problem in the words of the declaration.
    pub message: String,
    /// The token at fault; `None` if the problem has no single place.
    pub location: Option<Location>,
    /// A way to mend it.
    pub help: Option<String>,
    /// Other places that matter.
    pub notes: Vec<Note>,
}

/// Another place that matters, such as an earlier definition. See the example of [`Error`].
#[derive(Clone, Debug, PartialEq)]
pub struct Note {
    /// The text of the note.
    pub message: String,
    /// The place, if it is one.
    pub location: Option<Location>,
}

/// A place in a text. See the example of [`Text`](crate::Text).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Location {
    /// The line, from 1.
    pub line: usize,
    /// The column of its first character in this line, from 1.
    pub column: usize,
    /// The number of its characters; 0 at the end of a text.
    pub length: usize,
    /// The range of its bytes in the text.
    pub bytes: Range<usize>,
}

impl Error {
    pub(crate) fn new(file: String, text: String, problems: Vec<Problem>) -> Self {
        Self { file, text, problems }
    }

    /// The name of the file in errors.
    pub fn file(&self) -> &str {
        &self.file
    }

    /// The problems, in the order in which they were found. See the example of [`Error`].
    pub fn problems(&self) -> &[Problem] {
        &self.problems
    }

    /// The error with colours, for a terminal.
    pub fn colored(&self) -> impl fmt::Display + '_ {
        Shown { error: self, kind: ReportKind::Error, is_colored: true }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        Shown { error: self, kind: ReportKind::Error, is_colored: false }.fmt(f)
    }
}

impl std::error::Error for Error {}

impl Problem {
    /// A problem of the text as a whole.
    pub(crate) fn everywhere(message: impl Into<String>) -> Self {
        Self { message: message.into(), location: None, help: None, notes: Vec::new() }
    }

    /// The bytes of all its places.
    fn places(&self) -> Vec<Range<usize>> {
        let notes = self.notes.iter().map(|note| &note.location);
        [&self.location].into_iter().chain(notes).flatten().map(|place| place.bytes.clone()).collect()
    }

    /// The problem that the compiler found in a text.
    pub(crate) fn of(diagnostic: &Diagnostic, text: &str) -> Self {
        let note = |(span, note): &(Span, String)| Note {
            message: note.clone(),
            location: Location::of(*span, text),
        };
        Self {
            message: diagnostic.message.clone(),
            location: Location::of(diagnostic.span, text),
            help: diagnostic.help.clone(),
            notes: diagnostic.notes.iter().map(note).collect(),
        }
    }
}

impl Location {
    /// The place of a token, if it comes from the text.
    fn of(span: Span, text: &str) -> Option<Self> {
        span.source_text()?;
        let (bytes, start) = (span.byte_range(), span.start());
        let length = text.get(bytes.clone())?.chars().count();
        Some(Self { line: start.line, column: start.column + 1, length, bytes })
    }

    /// The place of some bytes of a text.
    pub(crate) fn new(text: &str, bytes: Range<usize>) -> Self {
        let before = text.get(..bytes.start).unwrap_or(text);
        let start_of_line = before.rfind('\n').map_or(0, |at| at + 1);
        Self {
            line: before.matches('\n').count() + 1,
            column: before[start_of_line..].chars().count() + 1,
            length: text.get(bytes.clone()).map_or(0, |part| part.chars().count()),
            bytes,
        }
    }
}

/// An error as text.
struct Shown<'a> {
    error: &'a Error,
    kind: ReportKind<'static>,
    is_colored: bool,
}

impl fmt::Display for Shown<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Error { file, text, problems } = self.error;
        let text = printable(text);
        let source = Source::from(text.as_str());
        let (mut shown, mut count) = (Vec::new(), 0);
        for problem in problems.iter().take(MOST_SHOWN) {
            match Excerpt::of(&text, &problem.places()) {
                None => {
                    let report = self.report(problem, &|place| place.bytes.clone());
                    report.write((file.as_str(), &source), &mut shown).map_err(|_| fmt::Error)?;
                }
                Some(excerpt) => shown.extend_from_slice(self.excerpt(problem, &excerpt)?.as_bytes()),
            }
            count += 1;
            if shown.len() > LONGEST_SHOWN {
                break;
            }
        }
        f.write_str(&String::from_utf8_lossy(&shown))?;
        match problems.len() - count {
            0 => Ok(()),
            more => writeln!(f, "… and {more} more"),
        }
    }
}

/// A text without characters that would command a terminal, as long in bytes.
fn printable(text: &str) -> String {
    let shown = |letter: char| match letter {
        '\n' | '\r' | '\t' => letter,
        _ if letter.is_control() && letter.is_ascii() => '?',
        _ if letter.is_control() => '¿',
        _ => letter,
    };
    text.chars().map(shown).collect()
}

impl<'a> Shown<'a> {
    /// A problem with a part of its lines, at the place that it has in the text.
    fn excerpt(&self, problem: &'a Problem, excerpt: &Excerpt) -> Result<String, fmt::Error> {
        let file = self.error.file.as_str();
        let shown_at = |place: &Location| excerpt.place(&place.bytes);
        let mut shown = Vec::new();
        let report = self.report(problem, &shown_at);
        report.write((file, Source::from(excerpt.text.as_str())), &mut shown).map_err(|_| fmt::Error)?;
        let shown = String::from_utf8_lossy(&shown).into_owned();
        let Some(place) = &problem.location else { return Ok(shown) };
        let cut = Location::new(&excerpt.text, shown_at(place));
        let named = |place: &Location| format!("{file}:{}:{} ", place.line, place.column);
        Ok(shown.replacen(&named(&cut), &named(place), 1))
    }

    /// A report of a problem whose places are shown at other bytes.
    fn report(
        &self,
        problem: &'a Problem,
        shown_at: &dyn Fn(&Location) -> Range<usize>,
    ) -> Report<'a, (&'a str, Range<usize>)> {
        let file = self.error.file.as_str();
        let config = Config::default()
            .with_index_type(IndexType::Byte)
            .with_char_set(CharSet::Unicode)
            .with_color(self.is_colored);
        let place = |location: &Location| (file, shown_at(location));
        let start = problem.location.as_ref().map_or((file, 0..0), place);
        let mut report = Report::build(self.kind, start).with_config(config);
        report.set_message(&problem.message);
        if let Some(location) = &problem.location {
            report.add_label(Label::new(place(location)).with_message("here"));
        }
        for note in &problem.notes {
            match &note.location {
                Some(location) => report.add_label(Label::new(place(location)).with_message(&note.message)),
                None => report.add_note(&note.message),
            }
        }
        if let Some(help) = &problem.help {
            report.add_help(help);
        }
        report.finish()
    }
}
