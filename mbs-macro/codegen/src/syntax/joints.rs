//! Points and joints: `point tip on crank = (l/2, 0);`, `revolute pin (crank.tip, rod.base);`.
//!
//! A joint is a name, two places and clauses in any order; its kind says which it takes.

use mbs_symbolic::units;
use proc_macro2::Span;
use syn::ext::IdentExt;
use syn::parse::{Parse, ParseStream};
use syn::{Error, Ident, Result, Token, parenthesized, token};

use super::words::{helped, name, semicolon};
use super::{Attachment, Clause, ItemKind, Joint};
use crate::diagnostics::nearest;
use crate::mechanics::joints::{ClauseKind, JOINTS, JointKind};

/// Stands for the word of a clause that begins with `=`.
const EQUALS: &str = ClauseKind::EQUALS;

/// A kind of joint by a word that declares it.
#[derive(Clone, Copy)]
pub(super) struct Shape {
    word: &'static str,
    pub kind: &'static JointKind,
}

impl Shape {
    /// The joint that this word declares.
    pub fn named(word: &str) -> Option<Self> {
        let shapes = JOINTS.iter().flat_map(|&kind| kind.words().map(move |(word, _)| Self { word, kind }));
        shapes.into_iter().find(|shape| shape.word == word)
    }
}

pub(super) fn joint(input: ParseStream<'_>, shape: Shape) -> Result<ItemKind> {
    let name = name(input)?;
    let example = format!("{} {name} {};", shape.word, shape.kind.example);
    let (first, second) = two_places(input, "the two places that it connects are", "a joint", &example)?;
    let clauses = clauses(input, shape, &name, &example)?;
    Ok(ItemKind::Joint(Box::new(Joint { kind: shape.kind, name, first, second, clauses })))
}

/// Clauses up to the `;`, each at most once, all that are needed.
fn clauses(input: ParseStream<'_>, shape: Shape, name: &Ident, example: &str) -> Result<Vec<Clause>> {
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
    for group in shape.kind.needs {
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

/// True if both clauses cannot stand together.
fn excludes(shape: Shape, kind: ClauseKind, other: ClauseKind) -> bool {
    kind == other || shape.kind.needs.iter().any(|group| group.contains(&kind) && group.contains(&other))
}

/// The word, or `=`, with which a clause begins.
fn clause_word(input: ParseStream<'_>, shape: Shape, example: &str) -> Result<(ClauseKind, Span)> {
    let span = input.span();
    let taken: Vec<ClauseKind> = shape.kind.clauses().collect();
    let taken_as = |word: &str| taken.iter().copied().find(|kind| kind.word() == word);
    if input.parse::<Option<Token![=]>>()?.is_some() {
        return taken_as(EQUALS).map(|kind| (kind, span)).ok_or_else(|| {
            helped(span, format!("`{}` takes no `{EQUALS}`", shape.word), help(&taken, example))
        });
    }
    let Ok(word) = input.fork().call(Ident::parse_any) else {
        return Err(helped(span, "a clause or `;` is expected here", help(&taken, example)));
    };
    let text = word.to_string();
    if let Some(kind) = taken_as(&text) {
        Ident::parse_any(input)?;
        return Ok((kind, span));
    }
    match ClauseKind::ALL.into_iter().find(|kind| kind.word() == text) {
        Some(kind) => Err(helped(span, format!("`{}` takes no {kind}", shape.word), help(&taken, example))),
        None if units::lookup(&text).is_some() => {
            let help = format!("units stand in brackets: `[{text}]`");
            Err(helped(span, format!("`{text}` is no clause"), help))
        }
        None => {
            let words = ClauseKind::ALL.into_iter().filter(|kind| taken.contains(kind));
            let help = match nearest(&text, words.map(ClauseKind::word).filter(|word| *word != EQUALS)) {
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
        ClauseKind::Along => Clause::Along(input.parse()?),
        ClauseKind::Angle => Clause::Angle(input.parse()?),
        ClauseKind::Place => Clause::Place(input.parse()?),
        ClauseKind::Distance => Clause::Distance(input.parse()?),
        ClauseKind::Profile => Clause::Profile(input.parse()?),
        ClauseKind::Radius => Clause::Radius(input.parse()?),
        ClauseKind::Radii => Clause::Radii(input.parse()?),
        ClauseKind::Teeth => Clause::Teeth(input.parse()?),
        ClauseKind::Carrier => Clause::Carrier(name(input)?),
    })
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
