//! The parts of all statements: names, paths, signs and blocks.

use mbs_symbolic::units;
use proc_macro2::{Delimiter, Ident, Spacing, Span, TokenStream, TokenTree};
use syn::ext::IdentExt;
use syn::parse::ParseStream;
use syn::spanned::Spanned;
use syn::{Attribute, Error, Result, Token, braced, token};

use super::formula::bracket_after_name;
use super::{Formula, Property, UnitText};
use crate::diagnostics::{HELP, WORD_OF_RUST};

/// The text of doc comments; other attributes are refused.
pub(super) fn doc(input: ParseStream<'_>) -> Result<String> {
    let mut lines = Vec::new();
    for attribute in input.call(Attribute::parse_outer)? {
        let line = match &attribute.meta {
            syn::Meta::NameValue(pair) if pair.path.is_ident("doc") => match &pair.value {
                syn::Expr::Lit(syn::ExprLit { lit: syn::Lit::Str(text), .. }) => Some(text.value()),
                _ => None,
            },
            _ => None,
        };
        let line = line.ok_or_else(|| Error::new(attribute.span(), "only doc comments can stand here"))?;
        lines.push(line.strip_prefix(' ').unwrap_or(&line).to_owned());
    }
    Ok(lines.join("\n"))
}

/// An error that says how to mend it.
pub(super) fn helped(span: Span, message: impl std::fmt::Display, help: impl std::fmt::Display) -> Error {
    Error::new(span, format!("{message}{HELP}{help}"))
}

/// An error with more help behind the one that it has; one without stays as it is.
pub(super) fn helped_further(error: Error, help: &str) -> Error {
    let text = error.to_string();
    if text.contains(HELP) { Error::new(error.span(), format!("{text}{help}")) } else { error }
}

pub(super) fn name(input: ParseStream<'_>) -> Result<Ident> {
    let name = name_before_unit(input)?;
    if input.peek(token::Bracket) {
        return Err(bracket_after_name(input, &name));
    }
    Ok(name)
}

/// A name behind which a bracket may stand.
pub(super) fn name_before_unit(input: ParseStream<'_>) -> Result<Ident> {
    let name =
        Ident::parse_any(input).map_err(|error| Error::new(error.span(), "a name is expected here"))?;
    usable(name)
}

/// A name, if it can be one in Rust, too.
pub(super) fn usable(name: Ident) -> Result<Ident> {
    // `gen` is one since the edition of 2024, which syn does not ask for
    let text = name.to_string();
    if text != "gen" && !text.starts_with("r#") && syn::parse_str::<Ident>(&text).is_ok() {
        return Ok(name);
    }
    let help = match text.trim_start_matches("r#") {
        "_" => "choose another name".to_owned(),
        word => format!("choose another name, such as `{word}_1`"),
    };
    Err(helped(name.span(), format!("`{name}` {WORD_OF_RUST}"), help))
}

/// `crank`, or `leg.crank.tip`.
pub(super) fn path(input: ParseStream<'_>) -> Result<Vec<Ident>> {
    let mut path = vec![name(input)?];
    while input.parse::<Option<Token![.]>>()?.is_some() {
        path.push(name(input)?);
    }
    Ok(path)
}

pub(super) fn equals(input: ParseStream<'_>) -> Result<Span> {
    let equals: Token![=] =
        input.parse().map_err(|error| Error::new(error.span(), "`=` is expected here"))?;
    Ok(equals.span())
}

pub(super) fn semicolon(input: ParseStream<'_>) -> Result<()> {
    match input.parse::<Token![;]>() {
        Ok(_) => Ok(()),
        Err(error) => Err(unexpected(input, error.span())),
    }
}

/// The error for what follows a complete formula.
fn unexpected(input: ParseStream<'_>, span: Span) -> Error {
    let message = "an operator or `;` is expected before this";
    match input.fork().call(Ident::parse_any) {
        Ok(word) if units::lookup(&word.to_string()).is_some() => {
            helped(span, message, format!("units stand in brackets: `[{word}]`"))
        }
        _ => Error::new(span, message),
    }
}

/// Reads a word, which has to be the expected one.
pub(super) fn expect_word(input: ParseStream<'_>, expected: &str, example: &str) -> Result<()> {
    let span = input.span();
    if Ident::parse_any(input).is_ok_and(|word| word == expected) {
        return Ok(());
    }
    Err(Error::new(span, format!("`{expected}` is expected before this, as in `{example}`")))
}

/// Checks that `{ … }` follows.
pub(super) fn block(input: ParseStream<'_>, example: &str) -> Result<()> {
    if input.peek(token::Brace) {
        return Ok(());
    }
    Err(Error::new(input.span(), format!("`{{ … }}` is expected here, as in `{example}`")))
}

/// `name = formula;`
pub(super) fn definition(input: ParseStream<'_>) -> Result<(Ident, Formula)> {
    let name = name(input)?;
    equals(input)?;
    let value = input.parse()?;
    semicolon(input)?;
    Ok((name, value))
}

/// The name of a property: `static` is a word of Rust, and no name of anything else.
pub(super) fn property_name(input: ParseStream<'_>) -> Result<Ident> {
    if input.peek(Token![static]) { input.call(Ident::parse_any) } else { name(input) }
}

/// `{ mass = 1 [kg]; inertia = 2 [kg*m^2]; }`
pub(super) fn properties(input: ParseStream<'_>, example: &str) -> Result<Vec<Property>> {
    block(input, example)?;
    let content;
    braced!(content in input);
    let mut properties = Vec::new();
    while !content.is_empty() {
        let name = property_name(&content)?;
        equals(&content)?;
        let value = content.parse()?;
        semicolon(&content)?;
        properties.push(Property { name, value });
    }
    Ok(properties)
}

/// A name, its unit, and a value where there is one; `needs` says that a unit is missing.
pub(super) fn with_unit(
    input: ParseStream<'_>,
    needs: impl Fn(&Ident) -> String,
) -> Result<(Ident, UnitText, Option<Formula>)> {
    let name = name_before_unit(input)?;
    if !input.peek(token::Bracket) {
        return Err(input.error(format!("{}, or `[1]` for a bare number", needs(&name))));
    }
    let unit = input.parse()?;
    let value = match input.parse::<Option<Token![=]>>()? {
        Some(_) => Some(input.parse()?),
        None => None,
    };
    semicolon(input)?;
    Ok((name, unit, value))
}

/// Tokens as people write them: operators and units apart, paths and calls together.
pub(super) fn written(tokens: TokenStream) -> String {
    let (mut text, mut is_apart, mut is_operand) = (String::new(), false, false);
    for token in tokens {
        let (word, is_before, is_behind) = match &token {
            TokenTree::Punct(mark) => match mark.as_char() {
                '.' | '^' => (mark.as_char().to_string(), false, false),
                ',' => (",".to_owned(), false, true),
                // a sign
                sign @ ('-' | '!') if !is_operand => (sign.to_string(), is_apart, false),
                other => (other.to_string(), is_apart, mark.spacing() == Spacing::Alone),
            },
            TokenTree::Group(group) => {
                let [open, close] = match group.delimiter() {
                    Delimiter::Parenthesis => ["(", ")"],
                    Delimiter::Bracket => ["[", "]"],
                    Delimiter::Brace => ["{ ", " }"],
                    Delimiter::None => ["", ""],
                };
                let is_call = group.delimiter() == Delimiter::Parenthesis && is_operand;
                let inner = written(group.stream());
                // the factors of a unit stand together
                let is_unit = group.delimiter() == Delimiter::Bracket;
                let inner = if is_unit { inner.replace(" / ", "/").replace(" * ", "*") } else { inner };
                (format!("{open}{inner}{close}"), is_apart && !is_call, true)
            }
            TokenTree::Ident(_) | TokenTree::Literal(_) => (token.to_string(), is_apart, true),
        };
        if is_before {
            text.push(' ');
        }
        text += &word;
        is_operand = !matches!(token, TokenTree::Punct(_));
        is_apart = is_behind;
    }
    text
}

#[cfg(test)]
mod tests {
    use super::written;

    #[test]
    fn conditions_are_written_as_people_do() {
        for text in [
            "bar.end.y < 0 [m]",
            "sqrt(x^2 + y^2) >= -2 [mm]",
            "distance(a.p, ground) < l",
            "der(phi) > 2 * x / l * 1 [kg*m^2/s]",
            "if x > 0 { -x } else { 1 } <= 3",
        ] {
            let tokens = text.parse().expect("tokens");
            assert_eq!(written(tokens), text);
        }
    }
}
