//! Refusals of files, in their words.

/// Why a file cannot be imported, in the words of the file.
#[derive(Debug)]
pub struct Refusal(pub String);

/// A part of a file as it is named in messages and comments: on one line, and not long.
pub(crate) fn shown(name: &str) -> String {
    let escaped: String = name.chars().take(60).flat_map(char::escape_debug).collect();
    format!("`{escaped}`")
}
