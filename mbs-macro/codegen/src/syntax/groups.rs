//! Groups of tokens, before anything is parsed: what a macro hands over, and
//! how deep they nest.
//!
//! A `macro_rules!` around a declaration hands over `$k:expr` as a group without
//! delimiters, which parsers look through: `1/$k` with `1 + 1` for `$k` would be
//! read as 1/1 + 1. Such a group becomes a parenthesis where its content has an
//! operator of its own, and is opened where it has none, as in a name, a path, a
//! vector or a range.

use proc_macro2::{Delimiter, Group, Spacing, TokenStream, TokenTree};
use syn::{Error, Result};

use super::indices::regrouped;

/// Groups may nest this deep: parsers, and rustc itself, descend into them by
/// recursion. Braces, parentheses and brackets of a formula take their share.
const DEEPEST: usize = 256;

/// Numbers have at most so many characters: the time that parsers take for one grows with
/// the square of them.
const LONGEST_NUMBER: usize = 1000;

/// The tokens without groups that have no delimiters.
///
/// # Errors
/// If groups are nested too deeply for a parser, or a number is too long for one.
pub fn delimited(tokens: TokenStream) -> Result<TokenStream> {
    Ok(within(&tokens, 0)?.unwrap_or(tokens))
}

/// `None` if nothing is to be changed, so that groups keep their spans.
fn within(tokens: &TokenStream, depth: usize) -> Result<Option<TokenStream>> {
    let mut delimited = TokenStream::new();
    let mut is_changed = false;
    for token in tokens.clone() {
        let TokenTree::Group(group) = token else {
            check_length(&token)?;
            delimited.extend([token]);
            continue;
        };
        if depth >= DEEPEST {
            let message = format!("groups are nested more than {DEEPEST} deep here");
            return Err(Error::new(group.span_open(), message));
        }
        let content = within(&group.stream(), depth + 1)?;
        is_changed |= content.is_some() || group.delimiter() == Delimiter::None;
        match (group.delimiter(), content) {
            (Delimiter::None, content) => {
                let content = content.unwrap_or_else(|| group.stream());
                match is_operation(&content) {
                    true => delimited.extend([parenthesis(&group, content)]),
                    false => delimited.extend(content),
                }
            }
            (_, Some(content)) => delimited.extend([TokenTree::from(regrouped(&group, content))]),
            (_, None) => delimited.extend([TokenTree::from(group)]),
        }
    }
    Ok(is_changed.then_some(delimited))
}

/// Refuses a number that nobody has written by hand.
fn check_length(token: &TokenTree) -> Result<()> {
    let TokenTree::Literal(literal) = token else { return Ok(()) };
    let text = literal.to_string();
    if text.len() > LONGEST_NUMBER && text.starts_with(|first: char| first.is_ascii_digit()) {
        let message = format!("this number has more than {LONGEST_NUMBER} characters");
        return Err(Error::new(literal.span(), message));
    }
    Ok(())
}

fn parenthesis(group: &Group, content: TokenStream) -> TokenTree {
    let mut parenthesis = Group::new(Delimiter::Parenthesis, content);
    parenthesis.set_span(group.span());
    parenthesis.into()
}

/// True if tokens are a formula with an operator outside of all groups. A sign that
/// binds looser than all operators, such as a comparison, `=` or the dots of a
/// range, makes them something else.
fn is_operation(tokens: &TokenStream) -> bool {
    let mut has_operator = false;
    for token in tokens.clone() {
        let TokenTree::Punct(punct) = token else { continue };
        match punct.as_char() {
            '+' | '-' | '*' | '/' | '^' => has_operator = true,
            '.' if punct.spacing() == Spacing::Alone => {}
            _ => return false,
        }
    }
    has_operator
}
