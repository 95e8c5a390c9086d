//! Numbers and names of XML elements, with the lines in which they stand.

use roxmltree::{Document, Node};

use crate::import::{Refusal, shown};

/// Squares and products of numbers up to this one stay numbers.
const LARGEST: f64 = 1e9;

/// The text as XML whose root has a name.
pub(super) fn parsed<'a>(text: &'a str, root: &str) -> Result<Document<'a>, Refusal> {
    let document =
        Document::parse(text).map_err(|error| Refusal(format!("it is no complete XML: {error}")))?;
    if document.root_element().tag_name().name() != root {
        return Err(Refusal(format!("its root is not `{root}`")));
    }
    Ok(document)
}

pub(super) fn elements<'a, 'b>(of: Node<'a, 'b>) -> impl Iterator<Item = Node<'a, 'b>> {
    of.children().filter(Node::is_element)
}

pub(super) fn elements_named<'a, 'b>(
    of: Node<'a, 'b>,
    name: &'static str,
) -> impl Iterator<Item = Node<'a, 'b>> {
    elements(of).filter(move |node| node.tag_name().name() == name)
}

/// The line in which an element begins.
fn line(node: Node<'_, '_>) -> u32 {
    node.document().text_pos_at(node.range().start).row
}

/// An element in messages: what it is, its name if it has one, and its line.
pub(super) fn described(what: &str, node: Node<'_, '_>) -> String {
    let line = line(node);
    match node.attribute("name").filter(|name| !name.is_empty()) {
        Some(name) => format!("the {what} {} (line {line})", shown(name)),
        None => format!("the {what} in line {line}"),
    }
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
