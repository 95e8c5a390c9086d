//! Points and joints: `point tip on crank = (l/2, 0);`, `revolute pin (crank.tip, rod.base);`.

use syn::ext::IdentExt;
use syn::parse::{Parse, ParseStream};
use syn::{Error, Ident, Result, Token, parenthesized, token};

use super::items::{equals, name, semicolon};
use super::{Attachment, ItemKind, Joint, JointKind};

/// The words that declare joints.
pub const JOINTS: &[(&str, JointKind)] = &[
    ("revolute", JointKind::Revolute),
    ("fixed", JointKind::Fixed),
    ("prismatic", JointKind::Prismatic),
    ("point_on_line", JointKind::PointOnLine),
    ("pin_slot", JointKind::PointOnLine),
    ("distance", JointKind::Distance),
];

pub(super) fn point(input: ParseStream<'_>) -> Result<ItemKind> {
    let what = name(input)?;
    let on = input.span();
    if what == "on" || !Ident::parse_any(input).is_ok_and(|word| word == "on") {
        return Err(Error::new(
            if what == "on" { what.span() } else { on },
            "a name, `on` and a body are expected here, as in `point tip on crank = (l/2, 0);`",
        ));
    }
    let body = name(input)?;
    equals(input)?;
    if !input.peek(token::Paren) {
        return Err(input.error(format!(
            "a point is given by its place on the body: `point {what} on {body} = (l/2, 0);`"
        )));
    }
    let value = input.parse()?;
    semicolon(input)?;
    Ok(ItemKind::Point { name: what, body, value })
}

pub(super) fn joint(input: ParseStream<'_>, kind: JointKind, word: &Ident) -> Result<ItemKind> {
    let name = name(input)?;
    let example = example(kind, word, &name);
    let (first, second) = two_places(input, "the two places that it connects are", "a joint", &example)?;
    let mut joint = Joint { kind, name, first, second, along: None, angle: None, length: None };
    match kind {
        JointKind::Prismatic | JointKind::PointOnLine => {
            clause(input, "along", &example)?;
            joint.along = Some(input.parse()?);
        }
        JointKind::Distance => {
            equals(input)?;
            joint.length = Some(input.parse()?);
        }
        JointKind::Revolute | JointKind::Fixed => {}
    }
    if matches!(kind, JointKind::Prismatic | JointKind::Fixed) && !input.peek(Token![;]) {
        clause(input, "at", &example)?;
        joint.angle = Some(input.parse()?);
    }
    semicolon(input)?;
    Ok(ItemKind::Joint(Box::new(joint)))
}

/// `(a.p, b.q)`
pub(super) fn two_places(
    input: ParseStream<'_>,
    places: &str,
    what: &str,
    example: &str,
) -> Result<(Attachment, Attachment)> {
    if !input.peek(token::Paren) {
        return Err(input.error(format!("{places} expected here, as in `{example}`")));
    }
    let content;
    parenthesized!(content in input);
    let first = content.parse()?;
    if content.parse::<Option<Token![,]>>()?.is_none() {
        return Err(Error::new(content.span(), format!("{what} connects two places, as in `{example}`")));
    }
    let second = content.parse()?;
    if !content.is_empty() {
        return Err(Error::new(content.span(), format!("{what} connects two places, as in `{example}`")));
    }
    Ok((first, second))
}

pub(super) fn clause(input: ParseStream<'_>, expected: &str, example: &str) -> Result<()> {
    let span = input.span();
    if Ident::parse_any(input).is_ok_and(|word| word == expected) {
        return Ok(());
    }
    Err(Error::new(span, format!("`{expected}` is expected before this, as in `{example}`")))
}

fn example(kind: JointKind, word: &Ident, name: &Ident) -> String {
    let rest = match kind {
        JointKind::Revolute => "(crank.tip, rod.base)",
        JointKind::Fixed => "(arm.end, hand.base) at 90 [deg]",
        JointKind::Prismatic => "(slider, ground.rail) along (1, 0)",
        JointKind::PointOnLine => "(rod.end, ground.rail) along (1, 0)",
        JointKind::Distance => "(bob, ground.hook) = 0.5 [m]",
    };
    format!("{word} {name} {rest};")
}

impl Parse for Attachment {
    /// `crank.tip`, or `crank` for its centre.
    fn parse(input: ParseStream<'_>) -> Result<Self> {
        let body = name(input)?;
        let point = match input.parse::<Option<Token![.]>>()? {
            Some(_) => Some(name(input)?),
            None => None,
        };
        Ok(Self { body, point })
    }
}
