//! `mode engaged { fixed lock (plate, wheel); }` and `when x < 0 [m] { enter engaged; }`.

use proc_macro2::{Ident, Span};
use syn::parse::ParseStream;
use syn::{Error, Result, Token, token};

use super::choices::condition;
use super::words::{helped, name, path, semicolon};
use super::{Condition, Formula, Item, ItemKind, Set};
use crate::mechanics::joints::JOINTS;

/// A condition, and what is set where it begins to hold.
#[derive(Clone)]
pub struct When {
    pub keyword: Span,
    pub condition: Condition,
    pub sets: Vec<Set>,
}

/// `enter engaged;`
pub(super) fn enter(input: ParseStream<'_>, keyword: Span) -> Result<ItemKind> {
    switch(input, keyword, 1)
}

/// `leave engaged;`
pub(super) fn leave(input: ParseStream<'_>, keyword: Span) -> Result<ItemKind> {
    switch(input, keyword, 0)
}

/// A mode is a memory of 1 while it holds.
fn switch(input: ParseStream<'_>, keyword: Span, value: i64) -> Result<ItemKind> {
    let mut prefix = path(input)?;
    let memory = prefix.pop().ok_or_else(|| input.error("a mode is expected here"))?;
    semicolon(input)?;
    Ok(ItemKind::Set(Set { prefix, memory, value: Formula::whole(value, keyword), is_of_mode: true }))
}

/// The name of a mode, and whether it holds at first.
pub(super) fn head(input: ParseStream<'_>) -> Result<(Ident, Option<Formula>)> {
    let name = name(input)?;
    if input.is_empty() || input.peek(token::Brace) {
        return Ok((name, None));
    }
    let example = format!("mode {name} = 1 {{ … }}");
    input.parse::<Token![=]>().map_err(|error| {
        Error::new(error.span(), format!("`=` or `{{ … }}` is expected here, as in `{example}`"))
    })?;
    Ok((name, Some(input.parse()?)))
}

/// The condition of a `when`.
pub(super) fn moment(input: ParseStream<'_>) -> Result<Condition> {
    let found = condition(input, "when x < 0 [m] { enter latched; }")?;
    if input.peek(Token![&&]) || input.peek(Token![||]) {
        let help = "`max(a, b) < 0` asks for both of `a < 0` and `b < 0`, and `min(a, b) < 0` for one of them; give both one unit";
        return Err(helped(input.span(), "a condition of a `when` is one comparison", help));
    }
    Ok(found)
}

/// True of a word that begins a constraint, which a mode may have.
pub(super) fn is_row(word: &Ident) -> bool {
    let is_joint = JOINTS.iter().flat_map(|kind| kind.words()).any(|(joint, _)| word == joint);
    is_joint || ["constraint", "coupler", "rate"].iter().any(|role| word == role)
}

/// The name of a constraint.
pub(super) fn row(item: &Item) -> Option<Ident> {
    match &item.kind {
        ItemKind::Joint(joint) => Some(joint.name.clone()),
        ItemKind::Constraint { name, .. } => Some(name.clone()),
        _ => None,
    }
}
