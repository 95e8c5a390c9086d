//! Texts that are no tokens.

use proc_macro2::{LexError, TokenStream};

use crate::error::{Location, Note, Problem};

/// The problem of a text that cannot be cut into tokens, at the place where the lexer fails.
pub fn problem(error: &LexError, text: &str) -> Problem {
    let at = error.span().byte_range().start.min(text.len());
    let rest = text.get(at..).unwrap_or_default();
    let (message, help) = words(rest);
    let length = rest.chars().next().map_or(0, char::len_utf8);
    let notes = if rest.starts_with([')', ']', '}']) { open_before(text, at) } else { None };
    Problem {
        message: message.to_owned(),
        location: Some(Location::new(text, at..at + length)),
        help: Some(help.to_owned()),
        notes: notes.into_iter().collect(),
    }
}

/// Message and help for what begins with `rest`. A bracket that opens a group is at fault
/// only if the group has no end.
fn words(rest: &str) -> (&'static str, &'static str) {
    let mut letters = rest.chars();
    match (letters.next(), letters.next()) {
        (Some('(' | '[' | '{'), _) => ("this bracket is never closed", "close it, or remove it"),
        (Some(')' | ']' | '}'), _) => (
            "this bracket does not close the one that is open",
            "look for a bracket before it that is missing, or is of another kind",
        ),
        (Some('/'), Some('*')) => ("this comment never ends", "end it with `*/`"),
        (Some('"'), _) => {
            ("this string never ends, or has an unknown escape", "declarations have no strings")
        }
        (Some('\''), _) => ("this is no character and no lifetime", "declarations have neither"),
        (Some('0'..='9'), _) => ("this is not a number", "numbers look like `12`, `0.25` or `1e-3`"),
        (Some('°'), _) => ("this character has no meaning here", "degrees are written as in `90 [deg]`"),
        (Some(_), _) => ("this character has no meaning here", "names have letters, digits and `_`"),
        (None, _) => ("the text ends too early", "look for a bracket that is never closed"),
    }
}

/// The bracket that is open there: what the lexer misses the end of in the text before.
fn open_before(text: &str, at: usize) -> Option<Note> {
    let error = text.get(..at)?.parse::<TokenStream>().err()?;
    let open = error.span().byte_range().start;
    let location = Some(Location::new(text, open..open + 1));
    Some(Note { message: "this one is open".to_owned(), location })
}
