//! Profiles: `profile lift = spline((0 [deg], 20 [mm]), …) period 360 [deg];`.

use syn::ext::IdentExt;
use syn::parse::ParseStream;
use syn::punctuated::Punctuated;
use syn::{Error, Ident, Result, Token, parenthesized, token};

use super::words::{equals, name, semicolon};
use super::{ItemKind, Profile, Vector};

const EXAMPLE: &str =
    "profile lift = spline((0 [deg], 20 [mm]), (120 [deg], 35 [mm]), (240 [deg], 25 [mm])) period 360 [deg];";

pub(super) fn profile(input: ParseStream<'_>) -> Result<ItemKind> {
    let name = name(input)?;
    equals(input)?;
    word(input, "spline")?;
    if !input.peek(token::Paren) {
        return Err(Error::new(input.span(), format!("points are expected here, as in `{EXAMPLE}`")));
    }
    let content;
    parenthesized!(content in input);
    let points = Punctuated::<Vector, Token![,]>::parse_terminated_with(&content, point)?;
    word(input, "period")?;
    let period = input.parse()?;
    semicolon(input)?;
    Ok(ItemKind::Profile(Profile { name, points: points.into_iter().collect(), period }))
}

fn word(input: ParseStream<'_>, expected: &str) -> Result<()> {
    let span = input.span();
    if Ident::parse_any(input).is_ok_and(|word| word == expected) {
        return Ok(());
    }
    Err(Error::new(span, format!("`{expected}` is expected here, as in `{EXAMPLE}`")))
}

fn point(input: ParseStream<'_>) -> Result<Vector> {
    let point = input.parse()?;
    if !input.is_empty() && !input.peek(Token![,]) {
        return Err(input.error("`,` is expected between points"));
    }
    Ok(point)
}
