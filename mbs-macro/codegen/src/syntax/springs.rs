//! Springs: `spring s (a.p, b.q) { stiffness = k; length = l; damping = c; }`.

use proc_macro2::Ident;
use syn::parse::ParseStream;
use syn::{Error, Result, Token, braced, parenthesized, token};

use super::items::{block, definition, name};
use super::{ItemKind, Property, Spring};

pub(super) fn spring(input: ParseStream<'_>, word: &Ident) -> Result<ItemKind> {
    let is_torsion = word == "torsion_spring";
    let name = name(input)?;
    let example = if is_torsion {
        format!("torsion_spring {name} (arm, ground) {{ stiffness = 5 [N*m]; angle = 0; }}")
    } else {
        format!("spring {name} (arm.end, ground) {{ stiffness = 100 [N/m]; length = 0.1 [m]; }}")
    };
    if !input.peek(token::Paren) {
        return Err(input.error(format!("what it connects is expected here, as in `{example}`")));
    }
    let content;
    parenthesized!(content in input);
    let first = content.parse()?;
    if content.parse::<Option<Token![,]>>()?.is_none() {
        return Err(Error::new(content.span(), format!("a spring connects two places, as in `{example}`")));
    }
    let second = content.parse()?;
    if !content.is_empty() {
        return Err(Error::new(content.span(), format!("a spring connects two places, as in `{example}`")));
    }
    block(input, &example)?;
    let content;
    braced!(content in input);
    let mut properties = Vec::new();
    while !content.is_empty() {
        let (name, value) = definition(&content)?;
        properties.push(Property { name, value });
    }
    Ok(ItemKind::Spring(Spring { name, is_torsion, first, second, properties }))
}
