//! Points and joints: `point tip on crank = (l/2, 0);`, `revolute pin (crank.tip, rod.base);`.
//!
//! A joint is a name, two places and clauses in any order; [`JOINTS`] says which
//! clauses a kind takes.

use mbs_symbolic::units;
use proc_macro2::Span;
use syn::ext::IdentExt;
use syn::parse::{Parse, ParseStream};
use syn::{Error, Ident, Result, Token, parenthesized, token};

use super::words::{equals, helped, name, semicolon};
use super::{Attachment, Clause, ClauseKind, ItemKind, Joint, JointKind};
use crate::diagnostics::nearest;

/// A kind of joint: the word that declares it, and its clauses.
pub struct Shape {
    pub word: &'static str,
    pub kind: JointKind,
    /// Of each of these groups, one clause is needed and no other is taken.
    needs: &'static [&'static [ClauseKind]],
    takes: &'static [ClauseKind],
    /// How its places and clauses are written.
    pub example: &'static str,
    /// What it does.
    pub meaning: &'static str,
}

use ClauseKind::{Along, At, Carrier, Equals, Radii, Radius, Teeth};

/// A row of the table.
const fn shape(
    word: &'static str,
    kind: JointKind,
    needs: &'static [&'static [ClauseKind]],
    takes: &'static [ClauseKind],
    example: &'static str,
    meaning: &'static str,
) -> Shape {
    Shape { word, kind, needs, takes, example, meaning }
}

/// Transmissions between turning bodies are alike.
const SIZES: &[&[ClauseKind]] = &[&[Radii, Teeth]];
const LINE_AND_RADIUS: &[&[ClauseKind]] = &[&[Along], &[Radius]];

/// The words that declare joints.
#[rustfmt::skip]
pub const JOINTS: &[Shape] = &[
    shape("revolute", JointKind::Revolute, &[], &[], "(crank.tip, rod.base)", "two points coincide"),
    shape("fixed", JointKind::Fixed, &[], &[At], "(arm.end, hand.base) at 90 [deg]", "two bodies move as one"),
    shape("prismatic", JointKind::Prismatic, &[&[Along]], &[At], "(slider, ground.rail) along (1, 0)", "a body slides along another without turning against it"),
    shape("point_on_line", JointKind::PointOnLine, &[&[Along]], &[], "(rod.end, ground.rail) along (1, 0)", "a point stays on a line of another body"),
    shape("pin_slot", JointKind::PointOnLine, &[&[Along]], &[], "(rod.end, ground.rail) along (1, 0)", "a pin stays in a slot, the same as `point_on_line`"),
    shape("distance", JointKind::Distance, &[&[Equals]], &[], "(bob, ground.hook) = 0.5 [m]", "two points keep their distance"),
    shape("gear", JointKind::Gear, SIZES, &[Carrier, At], "(sun, planet) radii (20 [mm], 40 [mm]) carrier arm", "two gears turn against each other"),
    shape("internal_gear", JointKind::InternalGear, SIZES, &[Carrier, At], "(ring, planet) radii (80 [mm], 20 [mm]) carrier arm", "a gear turns in a ring"),
    shape("belt", JointKind::Belt, SIZES, &[Carrier, At], "(driver, driven) radii (30 [mm], 60 [mm])", "two pulleys turn the same way"),
    shape("crossed_belt", JointKind::CrossedBelt, SIZES, &[Carrier, At], "(driver, driven) radii (30 [mm], 60 [mm])", "two pulleys turn opposite ways"),
    shape("rack", JointKind::Rack, LINE_AND_RADIUS, &[At], "(pinion, bar) along (1, 0) radius 15 [mm]", "a pinion meshes with a rack"),
    shape("rolling", JointKind::Rolling, LINE_AND_RADIUS, &[At], "(wheel, ground.track) along (1, 0) radius 0.3 [m]", "a wheel rolls on a track without slip"),
    shape("cam", JointKind::Cam, &[&[Equals]], &[], "(disk, follower.tip) = r0*(1 + 0.2*cos(angle))", "a point follows the profile of a cam"),
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

pub(super) fn joint(input: ParseStream<'_>, shape: &Shape) -> Result<ItemKind> {
    let name = name(input)?;
    let example = format!("{} {name} {};", shape.word, shape.example);
    let (first, second) = two_places(input, "the two places that it connects are", "a joint", &example)?;
    let clauses = clauses(input, shape, &name, &example)?;
    Ok(ItemKind::Joint(Box::new(Joint { kind: shape.kind, name, first, second, clauses })))
}

/// Clauses up to the `;`, each at most once, all that are needed.
fn clauses(input: ParseStream<'_>, shape: &Shape, name: &Ident, example: &str) -> Result<Vec<Clause>> {
    let mut clauses = Vec::new();
    let mut given: Vec<(ClauseKind, Span)> = Vec::new();
    while !input.peek(Token![;]) {
        let (kind, span) = clause_word(input, shape, example)?;
        if let Some((earlier, first)) = given.iter().find(|(earlier, _)| excludes(shape, kind, *earlier)) {
            let message = if *earlier == kind {
                format!("{kind} of `{name}` is given twice")
            } else {
                format!("`{name}` has {kind} and {earlier}, which say the same")
            };
            let mut error = helped(span, message, "keep one of them");
            error.combine(Error::new(*first, format!("{earlier} of `{name}` is first given here")));
            return Err(error);
        }
        given.push((kind, span));
        clauses.push(clause(input, kind)?);
    }
    for group in shape.needs {
        if !given.iter().any(|(kind, _)| group.contains(kind)) {
            let missing: Vec<_> = group.iter().map(ToString::to_string).collect();
            let missing = missing.join(" or ");
            let message = format!("`{} {name}` needs {missing}", shape.word);
            return Err(helped(name.span(), message, format!("as in `{example}`")));
        }
    }
    semicolon(input)?;
    Ok(clauses)
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

/// Whether both clauses cannot stand together.
fn excludes(shape: &Shape, kind: ClauseKind, other: ClauseKind) -> bool {
    kind == other || shape.needs.iter().any(|group| group.contains(&kind) && group.contains(&other))
}

/// The word, or `=`, with which a clause begins.
fn clause_word(input: ParseStream<'_>, shape: &Shape, example: &str) -> Result<(ClauseKind, Span)> {
    let span = input.span();
    let needed = shape.needs.iter().flat_map(|group| group.iter());
    let taken: Vec<ClauseKind> = needed.chain(shape.takes).copied().collect();
    if input.parse::<Option<Token![=]>>()?.is_some() {
        if taken.contains(&Equals) {
            return Ok((Equals, span));
        }
        return Err(helped(span, format!("`{}` takes no {Equals}", shape.word), help(&taken, example)));
    }
    let Ok(word) = input.fork().call(Ident::parse_any) else {
        return Err(helped(span, "a clause or `;` is expected here", help(&taken, example)));
    };
    let text = word.to_string();
    match ClauseKind::WORDS.iter().find(|(known, _)| *known == text) {
        Some((_, kind)) if taken.contains(kind) => {
            Ident::parse_any(input)?;
            Ok((*kind, span))
        }
        Some((_, kind)) => {
            Err(helped(span, format!("`{}` takes no {kind}", shape.word), help(&taken, example)))
        }
        None if units::lookup(&text).is_some() => {
            let help = format!("units stand in brackets: `[{text}]`");
            Err(helped(span, format!("`{text}` is no clause"), help))
        }
        None => {
            let words = ClauseKind::WORDS.iter().filter(|(_, kind)| taken.contains(kind));
            let help = match nearest(&text, words.map(|(word, _)| *word)) {
                Some(near) => format!("did you mean `{near}`?"),
                None => help(&taken, example),
            };
            Err(helped(span, format!("`{text}` is no clause of `{}`", shape.word), help))
        }
    }
}

fn help(taken: &[ClauseKind], example: &str) -> String {
    if taken.is_empty() {
        return "end the statement with `;` here".to_owned();
    }
    format!("as in `{example}`")
}

fn clause(input: ParseStream<'_>, kind: ClauseKind) -> Result<Clause> {
    Ok(match kind {
        Along => Clause::Along(input.parse()?),
        At => Clause::At(input.parse()?),
        Equals => Clause::Equals(input.parse()?),
        Radius => Clause::Radius(input.parse()?),
        Radii => Clause::Radii(input.parse()?),
        Teeth => Clause::Teeth(input.parse()?),
        Carrier => Clause::Carrier(name(input)?),
    })
}

impl ClauseKind {
    /// The words with which clauses begin.
    const WORDS: [(&'static str, Self); 6] = [
        ("along", Along),
        ("at", At),
        ("radius", Radius),
        ("radii", Radii),
        ("teeth", Teeth),
        ("carrier", Carrier),
    ];
}

impl std::fmt::Display for ClauseKind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let word = Self::WORDS.iter().find(|(_, kind)| kind == self).map_or("= …", |(word, _)| word);
        write!(f, "`{word}`")
    }
}

impl Parse for Attachment {
    /// `crank.tip`, or `crank` for its centre.
    fn parse(input: ParseStream<'_>) -> Result<Self> {
        let first = name(input)?;
        let mut rest = Vec::new();
        while input.parse::<Option<Token![.]>>()?.is_some() {
            rest.push(name(input)?);
        }
        Ok(Self::of_path(first, rest))
    }
}
