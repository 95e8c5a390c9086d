//! Numbers of XML elements.

use crate::xml::Document;
use crate::{Refusal, shown};

/// Squares and products of numbers up to this one stay numbers.
const LARGEST: f64 = 1e9;

/// The text as XML whose root has a name.
pub(super) fn parsed<'a>(text: &'a str, root: &str) -> Result<Document<'a>, Refusal> {
    let document = Document::parse(text)?;
    if document.root().name() != root {
        return Err(Refusal(format!("its root is not `{root}`")));
    }
    Ok(document)
}

/// Numbers with spaces between them, if nothing else stands there.
pub(super) fn quantities(text: &str) -> Option<Vec<f64>> {
    text.split_whitespace().map(|word| word.parse().ok()).collect()
}

/// Numbers with spaces between them.
pub(super) fn numbers(text: &str, attribute: &str, of: &str) -> Result<Vec<f64>, Refusal> {
    let number = |word: &str| word.parse::<f64>().ok().filter(|number| number.abs() < LARGEST);
    let wrong = |word: &str| {
        Refusal(format!("{of}: `{attribute}` has {} in the place of a number below 1e9", shown(word)))
    };
    text.split_whitespace().map(|word| number(word).ok_or_else(|| wrong(word))).collect()
}

/// So many numbers.
pub(super) fn exactly<const N: usize>(text: &str, attribute: &str, of: &str) -> Result<[f64; N], Refusal> {
    let found = numbers(text, attribute, of)?;
    let count = found.len();
    found.try_into().map_err(|_| {
        Refusal(format!(
            "{of}: `{attribute}` has {count} number{}, not {N}",
            if count == 1 { "" } else { "s" }
        ))
    })
}

/// A number that may be zero and not less.
pub(super) fn not_negative(number: f64, attribute: &str, of: &str) -> Result<f64, Refusal> {
    match number < 0.0 {
        true => Err(Refusal(format!("{of}: its `{attribute}` is negative"))),
        false => Ok(number),
    }
}
