//! Formulas that choose: `if a < b { p } else { q }`.

use proc_macro2::{Delimiter, Group, TokenStream, TokenTree};
use syn::parse::{ParseBuffer, ParseStream};
use syn::{Ident, Result, Token, braced, parenthesized, token};

use super::formula::{checked, end, sum};
use super::words::{helped, written};
use super::{Choice, Condition, Formula, FormulaKind, Test};
use crate::quantity::Comparison;

const EXAMPLE: &str = "as in `if x < 0 [m] { -k*x } else { 0 }`";

/// `if a < b { p } else if c > d { q } else { r }`
pub fn choice(input: ParseStream<'_>, depth: usize) -> Result<Formula> {
    checked(input, depth)?;
    let span = input.span();
    input.parse::<Token![if]>()?;
    let test = any(input, depth)?;
    let value = branch(input, depth, "its value")?;
    if input.parse::<Option<Token![else]>>()?.is_none() {
        let message = "this `if` does not say its value where the condition does not hold";
        return Err(helped(span, message, format!("put `else {{ … }}` behind it, {EXAMPLE}")));
    }
    let otherwise = match input.peek(Token![if]) {
        true => choice(input, depth + 1)?,
        false => branch(input, depth, "its other value")?,
    };
    Ok(Formula { span, kind: FormulaKind::Choice(Box::new(Choice { test, value, otherwise })) })
}

/// `{ formula }`
fn branch(input: ParseStream<'_>, depth: usize, what: &str) -> Result<Formula> {
    if is_comparison(input) {
        let help = "join two conditions: `0 < x && x < 1`";
        return Err(helped(input.span(), "one comparison has two sides", help));
    }
    for (word, sign) in [("and", "&&"), ("or", "||")] {
        if input.fork().parse::<Ident>().is_ok_and(|next| next == word) {
            return Err(helped(input.span(), format!("`{word}` is written `{sign}`"), EXAMPLE));
        }
    }
    if !input.peek(token::Brace) {
        return Err(helped(input.span(), format!("`{{` and {what} are expected here"), EXAMPLE));
    }
    let content;
    braced!(content in input);
    let value = sum(&content, depth + 1)?;
    end(&content)?;
    Ok(value)
}

/// Conditions of which one has to hold.
fn any(input: ParseStream<'_>, depth: usize) -> Result<Test> {
    let mut test = all(input, depth)?;
    while input.parse::<Option<Token![||]>>()?.is_some() {
        test = Test::Either(Box::new([test, all(input, depth)?]));
    }
    Ok(test)
}

/// Conditions that have to hold together.
fn all(input: ParseStream<'_>, depth: usize) -> Result<Test> {
    let mut test = one(input, depth)?;
    while input.parse::<Option<Token![&&]>>()?.is_some() {
        test = Test::Both(Box::new([test, one(input, depth)?]));
    }
    Ok(test)
}

fn one(input: ParseStream<'_>, depth: usize) -> Result<Test> {
    checked(input, depth)?;
    if input.parse::<Option<Token![!]>>()?.is_some() {
        return Ok(Test::Not(Box::new(one(input, depth + 1)?)));
    }
    if is_condition(input) {
        let content;
        parenthesized!(content in input);
        let test = any(&content, depth + 1)?;
        end(&content)?;
        return Ok(test);
    }
    let left = sum(input, depth + 1)?;
    let span = input.span();
    let Some(comparison) = comparison(input)? else {
        let message = match input.peek(Token![=]) || input.peek(Token![==]) || input.peek(Token![!=]) {
            true => "computed values are hardly ever equal",
            false => "a comparison is expected here",
        };
        return Err(helped(span, message, format!("write `<`, `<=`, `>` or `>=`, {EXAMPLE}")));
    };
    let right = sum(input, depth + 1)?;
    Ok(Test::Compared { sides: Box::new([left, right]), comparison, span })
}

/// `<`, `<=`, `>` or `>=`, if one comes next.
pub fn comparison(input: ParseStream<'_>) -> Result<Option<Comparison>> {
    Ok(if input.parse::<Option<Token![<=]>>()?.is_some() {
        Some(Comparison::LessOrEqual)
    } else if input.parse::<Option<Token![>=]>>()?.is_some() {
        Some(Comparison::GreaterOrEqual)
    } else if input.parse::<Option<Token![<]>>()?.is_some() {
        Some(Comparison::Less)
    } else if input.parse::<Option<Token![>]>>()?.is_some() {
        Some(Comparison::Greater)
    } else {
        None
    })
}

fn is_comparison(input: ParseStream<'_>) -> bool {
    matches!(comparison(&input.fork()), Ok(Some(_)))
}

/// Reports whether a parenthesis that comes next holds a condition and not a formula.
fn is_condition(input: ParseStream<'_>) -> bool {
    let Ok(group) = input.fork().parse::<Group>() else { return false };
    input.peek(token::Paren) && holds_condition(&group)
}

fn holds_condition(group: &Group) -> bool {
    let is_if = |token: TokenTree| matches!(token, TokenTree::Ident(word) if word == "if");
    !group.stream().into_iter().any(is_if)
        && group.stream().into_iter().any(|token| match token {
            TokenTree::Punct(punct) => matches!(punct.as_char(), '<' | '>' | '!' | '&' | '|'),
            TokenTree::Group(inner) => inner.delimiter() == Delimiter::Parenthesis && holds_condition(&inner),
            _ => false,
        })
}

/// A comparison of two formulas, as it was written.
pub(super) fn condition(input: ParseStream<'_>, example: &str) -> Result<Condition> {
    let (ahead, mut text) = (input.fork(), TokenStream::new());
    let left = input.parse()?;
    pass(&ahead, input, &mut text)?;
    let left_text = written(text.clone());
    let comparison_span = input.span();
    let Some(comparison) = comparison(input)? else {
        return Err(input.error(format!("one of `<`, `<=`, `>`, `>=` is expected here, as in `{example}`")));
    };
    let right = input.parse()?;
    pass(&ahead, input, &mut text)?;
    let text = written(text);
    Ok(Condition { left, comparison, comparison_span, right, text, left_text })
}

/// Takes the tokens that `input` has passed.
fn pass(ahead: &ParseBuffer<'_>, input: ParseStream<'_>, text: &mut TokenStream) -> Result<()> {
    while !ahead.is_empty() && ahead.cursor() != input.cursor() {
        text.extend([ahead.parse::<TokenTree>()?]);
    }
    Ok(())
}
