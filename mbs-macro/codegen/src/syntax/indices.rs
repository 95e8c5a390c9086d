//! Indices, loops and conditions on whole numbers, resolved on tokens before
//! statements are read: behind this there is only `link_3`.
//!
//! `link[i]` is the name `link_3` where i is 3. An index is made of whole
//! numbers, loop variables and whole constants, with `+ - * ( )`.

use std::collections::BTreeMap;

use mbs_symbolic::units;
use proc_macro2::{Delimiter, Group, Ident, Literal, TokenStream, TokenTree};
use syn::ext::IdentExt;
use syn::parse::{Parse, ParseStream, Parser};
use syn::{Error, Result, Token, parenthesized, token};

use super::words::{helped, usable};
use crate::mechanics::elements::{FORCE_BETWEEN, TORQUE_BETWEEN};

/// Whole numbers that are known while statements are read.
#[derive(Clone, Default)]
pub struct Indices {
    /// `const N = 40;`
    constants: BTreeMap<String, i64>,
    /// `for i in …`
    variables: BTreeMap<String, i64>,
}

impl Indices {
    /// Collects the whole constants among the statements of a declaration. A
    /// constant may be used before it is declared, so this comes first.
    pub fn of(tokens: &TokenStream) -> Self {
        let mut indices = Self::default();
        let mut statement = Vec::new();
        for token in tokens.clone() {
            match &token {
                TokenTree::Punct(punct) if punct.as_char() == ';' => {
                    indices.add_constant(&statement);
                    statement.clear();
                }
                TokenTree::Group(group) if group.delimiter() == Delimiter::Brace => statement.clear(),
                _ => statement.push(token),
            }
        }
        indices
    }

    /// `const N = 40`, behind its doc comments.
    fn add_constant(&mut self, statement: &[TokenTree]) {
        let is_const = |token: &TokenTree| matches!(token, TokenTree::Ident(word) if word == "const");
        let Some(at) = statement.iter().position(is_const) else { return };
        let [TokenTree::Ident(name), TokenTree::Punct(_), value @ ..] = &statement[at + 1..] else { return };
        if let Ok(value) = self.evaluate(value.iter().cloned().collect()) {
            self.constants.insert(name.to_string(), value);
        }
    }

    /// These and a loop variable.
    ///
    /// # Errors
    /// If its name is taken, that of a unit, which would make `[m]` ambiguous, or known to the laws of forces.
    pub fn with(&self, variable: &Ident, value: i64) -> Result<Self> {
        let name = variable.to_string();
        let taken = self.variables.contains_key(&name) || self.constants.contains_key(&name);
        let mut laws = [FORCE_BETWEEN.knows, TORQUE_BETWEEN.knows].into_iter().flatten();
        let is_of_laws = laws.any(|known| name == known.name);
        if taken || units::lookup(&name).is_some() || name == "t" || name == "pi" || is_of_laws {
            let what = if taken { "already has a value here" } else { "has a meaning of its own" };
            let help = "give the loop variable another name, such as `i`";
            return Err(helped(variable.span(), format!("`{name}` {what}"), help));
        }
        let mut indices = self.clone();
        indices.variables.insert(name, value);
        Ok(indices)
    }

    /// The value of a whole expression.
    ///
    /// # Errors
    /// A value that is not whole, or a name that is not known.
    pub fn evaluate(&self, tokens: TokenStream) -> Result<i64> {
        let parser = |input: ParseStream<'_>| {
            let value = self.sum(input)?;
            match input.parse::<Option<TokenTree>>()? {
                Some(token) => Err(Error::new(
                    token.span(),
                    "a whole number ends before this: it is made of whole numbers, names of such and `+ - * ( )`",
                )),
                None => Ok(value),
            }
        };
        parser.parse2(tokens)
    }

    /// Replaces loop variables by their values and indexed names by plain ones;
    /// `None` if there is nothing to replace.
    pub fn resolve(&self, tokens: TokenStream) -> Option<TokenStream> {
        let tokens: Vec<TokenTree> = tokens.into_iter().collect();
        let mut resolved: Vec<TokenTree> = Vec::new();
        let mut is_changed = false;
        let mut at = 0;
        while let Some(token) = tokens.get(at) {
            at += 1;
            match token {
                TokenTree::Ident(name) => {
                    let brackets = tokens[at..].iter().map_while(bracket).count();
                    let indices = &tokens[at..at + brackets];
                    let indices = match resolved.last() {
                        Some(TokenTree::Ident(word))
                            if ["coordinate", "input", "memory", "output", "state"]
                                .iter()
                                .any(|known| word == known) =>
                        {
                            without_unit(indices)
                        }
                        _ => indices,
                    };
                    let values: Option<Vec<i64>> =
                        indices.iter().filter_map(bracket).map(|index| self.evaluate(index).ok()).collect();
                    let is_member =
                        matches!(resolved.last(), Some(TokenTree::Punct(dot)) if dot.as_char() == '.');
                    let replacement = match (values, self.variables.get(&name.to_string())) {
                        (Some(values), _) if !values.is_empty() && values.iter().all(|&value| value >= 0) => {
                            at += values.len();
                            Some(indexed(name, &values))
                        }
                        (_, Some(&value)) if !is_member => Some(number(value, name)),
                        _ => None,
                    };
                    is_changed |= replacement.is_some();
                    resolved.push(replacement.unwrap_or_else(|| token.clone()));
                }
                TokenTree::Group(group) => {
                    let inner = self.resolve(group.stream());
                    is_changed |= inner.is_some();
                    resolved
                        .push(inner.map_or_else(|| token.clone(), |inner| regrouped(group, inner).into()));
                }
                _ => resolved.push(token.clone()),
            }
        }
        is_changed.then(|| resolved.into_iter().collect())
    }

    fn sum(&self, input: ParseStream<'_>) -> Result<i64> {
        let mut value = self.product(input)?;
        loop {
            let term = if input.parse::<Option<Token![+]>>()?.is_some() {
                self.product(input)?
            } else if input.parse::<Option<Token![-]>>()?.is_some() {
                self.product(input)?.checked_neg().ok_or_else(|| too_large(input))?
            } else {
                return Ok(value);
            };
            value = value.checked_add(term).ok_or_else(|| too_large(input))?;
        }
    }

    fn product(&self, input: ParseStream<'_>) -> Result<i64> {
        let is_negative = input.parse::<Option<Token![-]>>()?.is_some();
        let mut value = self.factor(input)?;
        if is_negative {
            value = value.checked_neg().ok_or_else(|| too_large(input))?;
        }
        while input.parse::<Option<Token![*]>>()?.is_some() {
            value = value.checked_mul(self.factor(input)?).ok_or_else(|| too_large(input))?;
        }
        Ok(value)
    }

    fn factor(&self, input: ParseStream<'_>) -> Result<i64> {
        if input.peek(syn::LitInt) {
            let number: syn::LitInt = input.parse()?;
            let value = number.base10_parse::<i32>().map_err(|_| too_large(input))?;
            return Ok(value.into());
        }
        if input.peek(token::Paren) {
            let content;
            parenthesized!(content in input);
            let value = self.sum(&content)?;
            return if content.is_empty() {
                Ok(value)
            } else {
                Err(content.error("an operator is expected here"))
            };
        }
        let name = Ident::parse_any(input).map_err(|error| {
            Error::new(error.span(), "a whole number, a loop variable or a whole constant is expected here")
        })?;
        let name = usable(name)?;
        let text = name.to_string();
        self.variables.get(&text).or_else(|| self.constants.get(&text)).copied().ok_or_else(|| {
            let message = format!("`{text}` is not a whole number that is known here");
            helped(name.span(), message, format!("declare it, `const {text} = 3;`, or use a loop variable"))
        })
    }
}

fn too_large(input: ParseStream<'_>) -> Error {
    input.error("this number is too large for an index")
}

/// The content of `[ … ]`.
fn bracket(token: &TokenTree) -> Option<TokenStream> {
    match token {
        TokenTree::Group(group) if group.delimiter() == Delimiter::Bracket => Some(group.stream()),
        _ => None,
    }
}

/// The group with another content. Errors about its end go to its closing brace.
pub fn regrouped(group: &Group, content: TokenStream) -> Group {
    let mut regrouped = Group::new(group.delimiter(), content);
    let is_block = group.delimiter() == Delimiter::Brace;
    regrouped.set_span(if is_block { group.span_close() } else { group.span() });
    regrouped
}

/// The brackets behind the name of an input or output, without the unit at their end:
/// `[N]` there is newton, whatever `N` is.
fn without_unit(brackets: &[TokenTree]) -> &[TokenTree] {
    match brackets.split_last() {
        Some((last, rest)) if bracket(last).is_some_and(|text| syn::parse2::<UnitLike>(text).is_ok()) => rest,
        _ => brackets,
    }
}

/// A unit, inside its brackets.
struct UnitLike;

impl Parse for UnitLike {
    fn parse(input: ParseStream<'_>) -> Result<Self> {
        super::formula::unit(input).map(|_| Self)
    }
}

/// `link_3`, where `link` stands.
fn indexed(name: &Ident, values: &[i64]) -> TokenTree {
    let text = values.iter().fold(name.unraw().to_string(), |text, value| format!("{text}_{value}"));
    Ident::new(&text, name.span()).into()
}

/// A whole number, where `name` stands.
fn number(value: i64, name: &Ident) -> TokenTree {
    let mut literal = Literal::i64_unsuffixed(value.abs());
    literal.set_span(name.span());
    if value >= 0 {
        return literal.into();
    }
    let mut minus = proc_macro2::Punct::new('-', proc_macro2::Spacing::Alone);
    minus.set_span(name.span());
    let tokens = TokenStream::from_iter([TokenTree::from(minus), literal.into()]);
    let mut group = Group::new(Delimiter::Parenthesis, tokens);
    group.set_span(name.span());
    group.into()
}
