//! Tables: `table gas(angle) = [(0 [deg], 1 [bar]), …] cubic outside hold;`, and
//! `profile lift = spline((0 [deg], 20 [mm]), …) period 360 [deg];`, which is a cubic one with a period; of two
//! arguments `table map(speed, load) = [(1000 [rpm], 0, 5 [N*m]), …] linear outside hold;`.

use mbs_symbolic::{Beyond, Interpolation};
use syn::ext::IdentExt;
use syn::parse::ParseStream;
use syn::punctuated::Punctuated;
use syn::{Error, Ident, Result, Token, bracketed, parenthesized, token};

use super::words::{equals, helped, name, semicolon};
use super::{Formula, ItemKind, Outside, Points, Table, Vector};
use crate::diagnostics::{listing, nearest};

const PROFILE: &str =
    "profile lift = spline((0 [deg], 20 [mm]), (120 [deg], 35 [mm]), (240 [deg], 25 [mm])) period 360 [deg];";
const TABLE: &str = "table damping(speed) = [(-1 [m/s], -900 [N]), (0 [m/s], 0 [N]), (1 [m/s], 400 [N])] linear outside extend;";
const MAP: &str =
    "table map(speed, load) = [(1000 [rpm], 0, 5 [N*m]), (1000 [rpm], 1, 90 [N*m]), …] linear outside hold;";
const OUTSIDE: &str = "rule for what is outside of the points";

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
    let outside = Outside::After(input.parse()?);
    semicolon(input)?;
    let interpolation = Interpolation::Cubic;
    let points = Points::Curve(points, outside);
    Ok(ItemKind::Table(Table { word: "profile", name, points, interpolation }))
}

pub(super) fn table(input: ParseStream<'_>) -> Result<ItemKind> {
    let name = name(input)?;
    if !input.peek(token::Paren) {
        return Err(helped(input.span(), "a table names its argument here", format!("write `{TABLE}`")));
    }
    let content;
    parenthesized!(content in input);
    let arguments = Punctuated::<Ident, Token![,]>::parse_terminated_with(&content, Ident::parse_any)?;
    let count = arguments.len();
    if count != 1 && count != 2 {
        let message = format!("table `{name}` has {count} arguments");
        return Err(helped(name.span(), message, "a table is a function of one argument or of two"));
    }
    if let Some(again) = arguments.iter().skip(1).find(|argument| Some(*argument) == arguments.first()) {
        let message = format!("both arguments of table `{name}` are called `{again}`");
        return Err(helped(again.span(), message, "call one of them another name"));
    }
    equals(input)?;
    if !input.peek(token::Bracket) {
        let example = if count == 1 { TABLE } else { MAP };
        let file = format!("points of a file are `from \"{name}.csv\"`");
        return Err(helped(input.span(), format!("points are expected here, as in `{example}`"), file));
    }
    let content;
    bracketed!(content in input);
    let word = "table";
    if count == 1 {
        let points = points(&content)?;
        let interpolation = interpolation(input)?;
        let outside = Outside::By(one_of(input, OUTSIDE, &Beyond::WORDS)?);
        semicolon(input)?;
        let points = Points::Curve(points, outside);
        return Ok(ItemKind::Table(Table { word, name, points, interpolation }));
    }
    let points = Punctuated::<[Formula; 3], Token![,]>::parse_terminated_with(&content, triple)?;
    let interpolation = interpolation(input)?;
    let outside = outside_of_grid(input)?;
    semicolon(input)?;
    let points = Points::Grid(points.into_iter().collect(), outside);
    Ok(ItemKind::Table(Table { word, name, points, interpolation }))
}

/// `linear outside`
fn interpolation(input: ParseStream<'_>) -> Result<Interpolation> {
    let interpolation = one_of(input, "way from point to point", &Interpolation::WORDS)?;
    word(input, "outside", TABLE)?;
    Ok(interpolation)
}

/// `hold`, or `(periodic, hold)` where both arguments have words of their own.
fn outside_of_grid(input: ParseStream<'_>) -> Result<[Beyond; 2]> {
    if !input.peek(token::Paren) {
        return Ok([one_of(input, OUTSIDE, &Beyond::WORDS)?; 2]);
    }
    let content;
    parenthesized!(content in input);
    let first = one_of(&content, OUTSIDE, &Beyond::WORDS)?;
    content.parse::<Token![,]>()?;
    let second = one_of(&content, OUTSIDE, &Beyond::WORDS)?;
    content.parse::<Option<Token![,]>>()?;
    if !content.is_empty() {
        return Err(content.error("a table of two arguments has two rules, `outside (periodic, hold)`"));
    }
    Ok([first, second])
}

/// `(1000 [rpm], 50 [%], 120 [N*m])`
fn triple(input: ParseStream<'_>) -> Result<[Formula; 3]> {
    const EXAMPLE: &str =
        "a point of two arguments and a value is expected here, as in `(1000 [rpm], 0.5, 120 [N*m])`";
    if !input.peek(token::Paren) {
        return Err(Error::new(input.span(), EXAMPLE));
    }
    let content;
    let paren = parenthesized!(content in input);
    let numbers = Punctuated::<Formula, Token![,]>::parse_terminated(&content)?;
    let numbers: Vec<Formula> = numbers.into_iter().collect();
    let Ok(point) = <[Formula; 3]>::try_from(numbers) else {
        return Err(Error::new(paren.span.join(), EXAMPLE));
    };
    if !input.is_empty() && !input.peek(Token![,]) {
        return Err(input.error("`,` is expected between points"));
    }
    Ok(point)
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
