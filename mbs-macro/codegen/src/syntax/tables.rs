//! Tables: `table gas(angle) = [(0 [deg], 1 [bar]), …] cubic outside hold;`, and
//! `profile lift = spline((0 [deg], 20 [mm]), …) period 360 [deg];`, which is a cubic one with a period.

use mbs_symbolic::Interpolation;
use syn::ext::IdentExt;
use syn::parse::ParseStream;
use syn::punctuated::Punctuated;
use syn::{Error, Ident, Result, Token, bracketed, parenthesized, token};

use super::words::{equals, helped, name, semicolon};
use super::{ItemKind, Outside, Table, Vector};
use crate::diagnostics::{listing, nearest};

const PROFILE: &str =
    "profile lift = spline((0 [deg], 20 [mm]), (120 [deg], 35 [mm]), (240 [deg], 25 [mm])) period 360 [deg];";
const TABLE: &str = "table damping(speed) = [(-1 [m/s], -900 [N]), (0 [m/s], 0 [N]), (1 [m/s], 400 [N])] linear outside extend;";

/// Words for what lies between points.
const INTERPOLATIONS: [(&str, Interpolation); 4] = [
    ("linear", Interpolation::Linear),
    ("cubic", Interpolation::Cubic),
    ("monotone", Interpolation::Monotone),
    ("step", Interpolation::Step),
];

/// Words for what lies outside of all points.
const OUTSIDES: [(&str, Outside); 4] = [
    ("hold", Outside::Hold),
    ("extend", Outside::Extend),
    ("periodic", Outside::Periodic(None)),
    ("refuse", Outside::Refuse),
];

pub(super) fn profile(input: ParseStream<'_>) -> Result<ItemKind> {
    let name = name(input)?;
    equals(input)?;
    word(input, "spline", PROFILE)?;
    if !input.peek(token::Paren) {
        return Err(Error::new(input.span(), format!("points are expected here, as in `{PROFILE}`")));
    }
    let content;
    parenthesized!(content in input);
    let points = points(&content)?;
    word(input, "period", PROFILE)?;
    let outside = Outside::Periodic(Some(input.parse()?));
    semicolon(input)?;
    let interpolation = Interpolation::Cubic;
    Ok(ItemKind::Table(Table { word: "profile", name, points, interpolation, outside }))
}

pub(super) fn table(input: ParseStream<'_>) -> Result<ItemKind> {
    let name = name(input)?;
    if !input.peek(token::Paren) {
        return Err(helped(input.span(), "a table names its argument here", format!("write `{TABLE}`")));
    }
    let content;
    parenthesized!(content in input);
    let arguments = Punctuated::<Ident, Token![,]>::parse_terminated_with(&content, Ident::parse_any)?;
    if arguments.len() != 1 {
        let message = format!("table `{name}` has {} arguments", arguments.len());
        return Err(helped(name.span(), message, "a table is a function of one argument"));
    }
    equals(input)?;
    if !input.peek(token::Bracket) {
        return Err(Error::new(input.span(), format!("points are expected here, as in `{TABLE}`")));
    }
    let content;
    bracketed!(content in input);
    let points = points(&content)?;
    let interpolation = one_of(input, "way from point to point", &INTERPOLATIONS)?;
    word(input, "outside", TABLE)?;
    let outside = one_of(input, "rule for what is outside of the points", &OUTSIDES)?;
    semicolon(input)?;
    Ok(ItemKind::Table(Table { word: "table", name, points, interpolation, outside }))
}

fn word(input: ParseStream<'_>, expected: &str, example: &str) -> Result<()> {
    let span = input.span();
    if Ident::parse_any(input).is_ok_and(|word| word == expected) {
        return Ok(());
    }
    Err(Error::new(span, format!("`{expected}` is expected here, as in `{example}`")))
}

/// The meaning of the word that comes next, out of a list.
fn one_of<T: Clone>(input: ParseStream<'_>, what: &str, words: &[(&str, T)]) -> Result<T> {
    let known: Vec<&str> = words.iter().map(|(word, _)| *word).collect();
    let span = input.span();
    let Ok(found) = Ident::parse_any(input) else {
        return Err(helped(
            span,
            format!("the {what} is missing"),
            format!("it is one of {}", listing(known)),
        ));
    };
    let found = found.to_string();
    if let Some((_, meaning)) = words.iter().find(|(word, _)| *word == found) {
        return Ok(meaning.clone());
    }
    let help = match nearest(&found, known.iter().copied()) {
        Some(near) => format!("did you mean `{near}`?"),
        None => format!("it is one of {}", listing(known)),
    };
    Err(helped(span, format!("`{found}` is no {what}"), help))
}

fn points(content: ParseStream<'_>) -> Result<Vec<Vector>> {
    let points = Punctuated::<Vector, Token![,]>::parse_terminated_with(content, point)?;
    Ok(points.into_iter().collect())
}

fn point(input: ParseStream<'_>) -> Result<Vector> {
    if !input.peek(token::Paren) {
        return Err(Error::new(input.span(), "a point is expected here, as in `(30 [deg], 2 [bar])`"));
    }
    let point = input.parse()?;
    if !input.is_empty() && !input.peek(Token![,]) {
        return Err(input.error("`,` is expected between points"));
    }
    Ok(point)
}
