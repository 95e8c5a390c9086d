//! Points of bodies, and the outlines about them, where bodies touch each other.

use proc_macro2::Ident;
use syn::ext::IdentExt;
use syn::parse::{Parse, ParseStream};
use syn::{Error, Result, token};

use super::words::{equals, helped, name, semicolon};
use super::{Formula, ItemKind, Vector};

/// The outline about a point of a body.
#[derive(Clone)]
pub enum Outline {
    /// It is a point.
    Point,
    /// `circle rim on wheel = (0, 0) radius r;`
    Circle { radius: Formula },
    /// `bore hole on housing = (0, 0) radius r;`
    Bore { radius: Formula },
    /// `line floor on ground = (0, 0) along (1, 0);`
    Line { along: Vector },
    /// `slot groove on wheel = (0, 0) along (1, 0) width 10.2 [mm];`
    Slot { along: Vector, width: Formula },
    /// `segment edge on door = (0, 0) to (0.8, 0);`, round with a `radius`
    Segment { to: Vector, radius: Option<Formula> },
    /// `arc rim on wheel = (0, 0) radius 0.3 from -45 [deg] to 45 [deg];`
    Arc { radius: Formula, from: Formula, to: Formula },
    /// `polygon hull on block = (0, 0) to (0.2, 0) to (0.2, 0.1) to (0, 0.1);`, round with a `radius`
    Polygon { to: Vec<Vector>, radius: Option<Formula> },
}

const POINT: &str = "point tip on crank = (l/2, 0);";
const CIRCLE: &str = "circle rim on wheel = (0, 0) radius 0.3 [m];";
const BORE: &str = "bore hole on housing = (0, 0) radius 10.1 [mm];";
const LINE: &str = "line floor on ground = (0, 0) along (1, 0);";
const SLOT: &str = "slot groove on wheel = (0, 0) along (1, 0) width 10.2 [mm];";
const SEGMENT: &str = "segment edge on door = (0, 0) to (0.8 [m], 0) radius 5 [mm];";
const ARC: &str = "arc rim on wheel = (0, 0) radius 0.3 [m] from -45 [deg] to 45 [deg];";
const POLYGON: &str = "polygon hull on block = (0, 0) to (0.2 [m], 0) to (0.2 [m], 0.1 [m]) to (0, 0.1 [m]);";

pub(super) fn point(input: ParseStream<'_>) -> Result<ItemKind> {
    outline(input, POINT, |_| Ok(Outline::Point))
}

pub(super) fn circle(input: ParseStream<'_>) -> Result<ItemKind> {
    outline(input, CIRCLE, |input| Ok(Outline::Circle { radius: clause(input, "radius", CIRCLE)? }))
}

pub(super) fn bore(input: ParseStream<'_>) -> Result<ItemKind> {
    outline(input, BORE, |input| Ok(Outline::Bore { radius: clause(input, "radius", BORE)? }))
}

pub(super) fn line(input: ParseStream<'_>) -> Result<ItemKind> {
    outline(input, LINE, |input| Ok(Outline::Line { along: clause(input, "along", LINE)? }))
}

pub(super) fn slot(input: ParseStream<'_>) -> Result<ItemKind> {
    outline(input, SLOT, |input| {
        Ok(Outline::Slot { along: clause(input, "along", SLOT)?, width: clause(input, "width", SLOT)? })
    })
}

pub(super) fn segment(input: ParseStream<'_>) -> Result<ItemKind> {
    outline(input, SEGMENT, |input| {
        Ok(Outline::Segment { to: clause(input, "to", SEGMENT)?, radius: edge(input, SEGMENT)? })
    })
}

pub(super) fn arc(input: ParseStream<'_>) -> Result<ItemKind> {
    outline(input, ARC, |input| {
        let radius = clause(input, "radius", ARC)?;
        Ok(Outline::Arc { radius, from: clause(input, "from", ARC)?, to: clause(input, "to", ARC)? })
    })
}

pub(super) fn polygon(input: ParseStream<'_>) -> Result<ItemKind> {
    outline(input, POLYGON, |input| {
        let mut to = vec![clause(input, "to", POLYGON)?, clause(input, "to", POLYGON)?];
        while is_next(input, "to") {
            to.push(clause(input, "to", POLYGON)?);
        }
        Ok(Outline::Polygon { to, radius: edge(input, POLYGON)? })
    })
}

/// The radius of a round edge, which may be left out.
fn edge(input: ParseStream<'_>, example: &str) -> Result<Option<Formula>> {
    is_next(input, "radius").then(|| clause(input, "radius", example)).transpose()
}

fn is_next(input: ParseStream<'_>, word: &str) -> bool {
    input.fork().call(Ident::parse_any).is_ok_and(|found| found == word)
}

/// A name, its body, its place, and what stands behind that.
fn outline(
    input: ParseStream<'_>,
    example: &str,
    clauses: fn(ParseStream<'_>) -> Result<Outline>,
) -> Result<ItemKind> {
    let what = name(input)?;
    let on = input.span();
    if what == "on" || !Ident::parse_any(input).is_ok_and(|word| word == "on") {
        return Err(Error::new(
            if what == "on" { what.span() } else { on },
            format!("a name, `on` and a body or `ground` are expected here, as in `{example}`"),
        ));
    }
    let body = name(input)?;
    equals(input)?;
    if !input.peek(token::Paren) {
        let (word, place) = example.split_once(' ').unwrap_or((example, ""));
        let place = place.split_once('=').map_or("", |(_, place)| place);
        let message =
            format!("a {word} is given by its place on the body: `{word} {what} on {body} ={place}`");
        return Err(input.error(message));
    }
    let value = input.parse()?;
    let outline = clauses(input)?;
    semicolon(input)?;
    Ok(ItemKind::Point { name: what, body, value, outline: Box::new(outline) })
}

/// A word and what stands behind it.
fn clause<T: Parse>(input: ParseStream<'_>, word: &str, example: &str) -> Result<T> {
    let span = input.span();
    match Ident::parse_any(input) {
        Ok(found) if found == word => input.parse(),
        _ => Err(helped(span, format!("`{word}` is expected here"), format!("as in `{example}`"))),
    }
}
