//! `coordinate w [mm];`, `particle bob at rod.tip { mass = m; }`: what moves without being a body.

use syn::parse::ParseStream;
use syn::{Result, Token, token};

use super::ItemKind;
use super::words::{expect_word, name, name_before_unit, properties, semicolon};

/// `coordinate w [mm];`
pub(super) fn coordinate(input: ParseStream<'_>) -> Result<ItemKind> {
    let name = name_before_unit(input)?;
    if !input.peek(token::Bracket) {
        return Err(input.error(format!(
            "a coordinate of its own needs its unit: `coordinate {name} [mm];`, `[rad]` of an angle or `[1]` for a bare \
             number"
        )));
    }
    let unit = input.parse()?;
    if input.peek(Token![=]) {
        return Err(input.error(format!("where a coordinate starts is said in `start {{ {name} = …; }}`")));
    }
    semicolon(input)?;
    Ok(ItemKind::Coordinate { name, unit })
}

/// `particle bob at rod.tip { mass = m; }`
pub(super) fn particle(input: ParseStream<'_>) -> Result<ItemKind> {
    let name = name(input)?;
    let example = format!("particle {name} at rod.tip {{ mass = 1 [kg]; }}");
    expect_word(input, "at", &example)?;
    let at = input.parse()?;
    let properties = properties(input, &example)?;
    Ok(ItemKind::Particle { name, at, properties })
}
