//! `memory u [V] = 0;` and `every 1 [ms] { set u = …; }`.

use mbs_symbolic::units;
use proc_macro2::{Delimiter, Ident, Span, TokenStream, TokenTree};
use syn::ext::IdentExt;
use syn::parse::ParseStream;
use syn::{Result, Token, token};

use super::words::{equals, helped, path, semicolon, with_unit};
use super::{Formula, ItemKind};

/// A clock, and what it sets in this order.
#[derive(Clone)]
pub struct Every {
    pub keyword: Span,
    pub period: Formula,
    pub offset: Option<Formula>,
    pub sets: Vec<Set>,
}

/// A memory with its value from a sample on.
#[derive(Clone)]
pub struct Set {
    /// The instances of assemblies that lead to it; empty after composition.
    pub prefix: Vec<Ident>,
    pub memory: Ident,
    pub value: Formula,
    /// True of `enter` and `leave`, which a mode alone may stand behind.
    pub is_of_mode: bool,
}

/// `memory integral [rad] = 0;`
pub(super) fn memory(input: ParseStream<'_>) -> Result<ItemKind> {
    let (name, unit, value) =
        with_unit(input, |name| format!("a memory needs its unit: `memory {name} [V] = 0;`"))?;
    let value = value.map(|value| value.in_unit(&unit));
    Ok(ItemKind::Memory { name, unit, value })
}

/// `set integral = integral + error;`
pub(super) fn set(input: ParseStream<'_>) -> Result<ItemKind> {
    let mut prefix = path(input)?;
    let memory = prefix.pop().ok_or_else(|| input.error("a memory is expected here"))?;
    equals(input)?;
    let value = input.parse()?;
    semicolon(input)?;
    Ok(ItemKind::Set(Set { prefix, memory, value, is_of_mode: false }))
}

/// True of the words with which a statement of a moment begins.
pub(super) fn is_set(word: &Ident) -> bool {
    ["set", "enter", "leave"].iter().any(|known| word == known)
}

/// The first word of a block that begins something else than these statements, `for` or `if`.
pub(super) fn other_than(is_statement: fn(&Ident) -> bool, block: TokenStream) -> Option<Ident> {
    let mut is_first = true;
    let mut is_set = false;
    for token in block {
        match token {
            TokenTree::Ident(word) if is_first => {
                is_set = is_statement(&word);
                if !(is_set || ["for", "if", "else"].iter().any(|known| word == known)) {
                    return Some(word);
                }
                is_first = false;
            }
            TokenTree::Punct(punct) if punct.as_char() == ';' => is_first = true,
            // a block of statements, and not of a formula
            TokenTree::Group(group) if group.delimiter() == Delimiter::Brace && !is_set => {
                is_first = true;
                if let Some(word) = other_than(is_statement, group.stream()) {
                    return Some(word);
                }
            }
            _ => {}
        }
    }
    None
}

const EXAMPLE: &str = "every 1 [ms] offset 0.2 [ms] { set u = …; }";

/// The period of a clock and its offset, up to the end or a block.
pub(super) fn times(input: ParseStream<'_>) -> Result<(Formula, Option<Formula>)> {
    let period = time(input)?;
    if input.is_empty() || input.peek(token::Brace) {
        return Ok((period, None));
    }
    let word = input.fork().call(Ident::parse_any);
    if !word.as_ref().is_ok_and(|word| word == "offset") {
        let message = format!("`{{ … }}` or `offset` is expected here, as in `{EXAMPLE}`");
        return Err(match word {
            Ok(word) if units::lookup(&word.to_string()).is_some() => {
                helped(word.span(), message, format!("units stand in brackets: `[{word}]`"))
            }
            _ => input.error(message),
        });
    }
    input.call(Ident::parse_any)?;
    let offset = time(input)?;
    match input.is_empty() || input.peek(token::Brace) {
        true => Ok((period, Some(offset))),
        false => Err(input.error(format!("`{{ … }}` is expected here, as in `{EXAMPLE}`"))),
    }
}

/// A formula, which has to be there.
fn time(input: ParseStream<'_>) -> Result<Formula> {
    if input.is_empty() || input.peek(token::Brace) || input.peek(Token![;]) {
        return Err(input.error(format!("a time is expected here, as in `{EXAMPLE}`")));
    }
    input.parse()
}
