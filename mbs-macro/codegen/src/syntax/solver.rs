//! How a mechanism is to be solved: `redundant = …;`, `states = …;`, `limit …;`, `step = …;`,
//! `method = …;`, `feedback = …;`, `gradients = …;`.

use mbs_interface::{Composition, Implicit, SCHEMES, Tableau};
use proc_macro2::{Ident, Span};
use syn::ext::IdentExt;
use syn::parse::ParseStream;
use syn::{Error, Result};

use super::words::{equals, semicolon};
use super::{Formula, FormulaKind, ItemKind, Limited};
use crate::diagnostics::listing;

pub fn redundant(input: ParseStream<'_>, keyword: Span) -> Result<ItemKind> {
    equals(input)?;
    let expected = "`minimum_norm` is expected here: redundant constraints then share the force, with \
                    multipliers of least norm";
    let choice = Ident::parse_any(input).map_err(|error| Error::new(error.span(), expected))?;
    if choice != "minimum_norm" {
        return Err(Error::new(choice.span(), expected));
    }
    semicolon(input)?;
    Ok(ItemKind::Redundant { keyword })
}

pub fn states(input: ParseStream<'_>, keyword: Span) -> Result<ItemKind> {
    equals(input)?;
    let expected = "`reduced` or `all` is expected here: whether coordinates that a constraint gives \
                    explicitly are left out of the integration";
    let choice = Ident::parse_any(input).map_err(|error| Error::new(error.span(), expected))?;
    let are_reduced = match choice.to_string().as_str() {
        "reduced" => true,
        "all" => false,
        _ => return Err(Error::new(choice.span(), expected)),
    };
    semicolon(input)?;
    Ok(ItemKind::States { keyword, are_reduced })
}

pub fn limit(input: ParseStream<'_>, keyword: Span) -> Result<ItemKind> {
    let expected = "`operations`, `stack` or `unrolled` is expected here, as in `limit operations = 200;`";
    let what = Ident::parse_any(input).map_err(|error| Error::new(error.span(), expected))?;
    let limited = match what.to_string().as_str() {
        "operations" => Limited::Operations,
        "stack" => Limited::Stack,
        "unrolled" => Limited::Unrolled,
        _ => return Err(Error::new(what.span(), expected)),
    };
    equals(input)?;
    let whole = |span| Error::new(span, "a whole number, 0 or larger, is expected here");
    let value: syn::LitInt = input.parse().map_err(|error| whole(error.span()))?;
    let value = value.base10_parse().map_err(|_| whole(value.span()))?;
    semicolon(input)?;
    Ok(ItemKind::Limit { keyword, limited, value })
}

pub fn step(input: ParseStream<'_>, keyword: Span) -> Result<ItemKind> {
    equals(input)?;
    let value = input.parse()?;
    semicolon(input)?;
    Ok(ItemKind::Step { keyword, value })
}

/// `closes = 0 [s] .. 0.3 [s];` or `closes theta = 0 .. 2*pi;`
pub fn closes(input: ParseStream<'_>, keyword: Span) -> Result<ItemKind> {
    let coordinate = if input.peek(syn::Ident) { Some(input.parse()?) } else { None };
    equals(input)?;
    let from = input.parse()?;
    input.parse::<syn::Token![..]>().map_err(|error| {
        Error::new(
            error.span(),
            "a span is expected here, as in `closes = 0 [s] .. 0.3 [s];` or `closes theta = 0 .. 2*pi;`",
        )
    })?;
    let to = input.parse()?;
    semicolon(input)?;
    Ok(ItemKind::Closes { keyword, coordinate, from, to })
}

pub fn method(input: ParseStream<'_>, keyword: Span) -> Result<ItemKind> {
    equals(input)?;
    let words = listing(SCHEMES.iter().map(|scheme| scheme.word));
    let expected = format!("a scheme is expected here, one of {words}");
    let word = Ident::parse_any(input).map_err(|error| Error::new(error.span(), &expected))?;
    let Some(scheme) = Tableau::find(&word.to_string()) else {
        let word_text = word.to_string();
        let is_other = Implicit::find(&word_text).is_some() || Composition::find(&word_text).is_some();
        let of_runs = if is_other {
            format!("; a run is asked for `{word_text}`: --method {word_text}")
        } else {
            String::new()
        };
        return Err(Error::new(word.span(), expected + &of_runs));
    };
    semicolon(input)?;
    Ok(ItemKind::Method { keyword, scheme })
}

pub fn gradients(input: ParseStream<'_>, keyword: Span) -> Result<ItemKind> {
    equals(input)?;
    let expected = "`reverse` is expected here: derivatives of runs by many variables at once are then compiled; \
                    those by dual numbers need no statement";
    let choice = Ident::parse_any(input).map_err(|error| Error::new(error.span(), expected))?;
    if choice != "reverse" {
        return Err(Error::new(choice.span(), expected));
    }
    semicolon(input)?;
    Ok(ItemKind::Gradients { keyword })
}

pub fn feedback(input: ParseStream<'_>, keyword: Span) -> Result<ItemKind> {
    equals(input)?;
    let value: Formula = input.parse()?;
    let expected = "`held(alpha, beta)` or `per_stage(alpha, beta)` is expected here";
    let error = Error::new(value.span, expected);
    let FormulaKind::Call { function, arguments } = value.kind else { return Err(error) };
    let is_held = match function.to_string().as_str() {
        "held" => true,
        "per_stage" => false,
        _ => return Err(Error::new(function.span(), expected)),
    };
    let gains = <[Formula; 2]>::try_from(arguments).map_err(|_| error)?;
    semicolon(input)?;
    Ok(ItemKind::Feedback { keyword, is_held, gains })
}
