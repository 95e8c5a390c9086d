//! Joints with play: `revolute pin (crank.tip, rod.eye) clearance = 0.1 [mm] { … }`.
//!
//! The block says how they push. With a `stiffness` or a `modulus` it is that of a contact. Else it is that of stops, which hit
//! in no time.

use proc_macro2::{Group, Ident, Literal, TokenStream, TokenTree};
use quote::{ToTokens, format_ident, quote_spanned};
use syn::ext::IdentExt;
use syn::parse::{ParseStream, Parser};
use syn::{Error, Result, Token, token};

use super::choices::condition;
use super::joints::{Shape, two_places};
use super::words::{block, equals, helped, name, property_name};
use super::{Attachment, Clause, Element, ElementProperty, ItemKind, Joint, Load, Vector, words};
use crate::mechanics::elements::{ElementKind, LOOSE_PRISMATIC, LOOSE_REVOLUTE};

const CLEARANCE: &str = "clearance";
/// The properties of joints that hit in no time, beside sizes.
const OF_STOPS: [&str; 3] = ["restitution", "settle", "friction"];

/// True of a joint that has a `clearance`, before its block or its end.
pub(super) fn is_loose(input: ParseStream<'_>) -> bool {
    let ahead = input.fork();
    while !ahead.is_empty() && !ahead.peek(token::Brace) && !ahead.peek(Token![;]) {
        if is_next(&ahead, CLEARANCE) {
            return true;
        }
        if ahead.parse::<TokenTree>().is_err() {
            break;
        }
    }
    false
}

/// A joint with play, behind its word.
pub(super) fn joint(input: ParseStream<'_>, word: &Ident) -> Result<Vec<ItemKind>> {
    let kinds = [&LOOSE_REVOLUTE, &LOOSE_PRISMATIC];
    let Some(kind) = kinds.into_iter().find(|kind| word == kind.word) else {
        let help = "`revolute` and `prismatic` joints have play";
        return Err(helped(word.span(), format!("`{word}` takes no `{CLEARANCE}`"), help));
    };
    let name = name(input)?;
    let example = format!("{word} {name} {}", kind.example);
    let (first, second) = two_places(input, "the two places that it connects are", "a joint", &example)?;
    let along = along(input, kind, &example)?;
    let clearance = clearance(input, &example)?;
    let properties = properties(input, &example)?;
    if is_zero(&clearance) {
        let is_known = |name: &Ident| {
            kind.properties.iter().any(|row| name == row.name) || OF_STOPS.iter().any(|row| name == row)
        };
        if let Some((name, _)) = properties.iter().find(|(name, _)| !is_known(name)) {
            return Err(helped(
                name.span(),
                format!("a joint with play has no `{name}`"),
                format!("as in `{example}`"),
            ));
        }
        return ideal(word, (name, [first, second], along));
    }
    let joint = Loose { kind, name, first, second, along, clearance, properties };
    if joint.has("stiffness") || joint.has("modulus") {
        return Ok(vec![joint.contact()?]);
    }
    if joint.has("restitution") {
        return joint.stops(&example);
    }
    let message = format!("`{}` does not say its `stiffness`, `modulus` or `restitution`", joint.name);
    Err(helped(
        joint.name.span(),
        message,
        format!("as in `{example}`; a `restitution` alone is that of stops"),
    ))
}

/// True of the number 0, with a unit or without.
fn is_zero(clearance: &TokenStream) -> bool {
    match clearance.clone().into_iter().next() {
        Some(TokenTree::Literal(literal)) => {
            let is_alone =
                clearance.clone().into_iter().skip(1).all(|token| matches!(token, TokenTree::Group(_)));
            is_alone && literal.to_string().parse() == Ok(0.0)
        }
        _ => false,
    }
}

/// The joint without play, which is that with a clearance of 0.
fn ideal(
    word: &Ident,
    (name, ends, along): (Ident, [Attachment; 2], Option<Group>),
) -> Result<Vec<ItemKind>> {
    let shape = Shape::named(&word.to_string())
        .ok_or_else(|| Error::new(word.span(), format!("`{word}` is no joint")))?;
    let [first, second] = ends;
    let clauses = along.map(|along| syn::parse2::<Vector>(along.into_token_stream()).map(Clause::Along));
    let clauses = clauses.transpose()?.into_iter().collect();
    Ok(vec![ItemKind::Joint(Box::new(Joint { kind: shape.kind, name, first, second, clauses }))])
}

fn is_next(input: ParseStream<'_>, word: &str) -> bool {
    input.fork().call(Ident::parse_any).is_ok_and(|found| found == word)
}

fn along(input: ParseStream<'_>, kind: &ElementKind, example: &str) -> Result<Option<Group>> {
    let slides = kind.word == LOOSE_PRISMATIC.word;
    if is_next(input, "along") != slides {
        let missing = if slides { "`along` is expected here" } else { "`clearance` is expected here" };
        return Err(helped(input.span(), missing, format!("as in `{example}`")));
    }
    if !slides {
        return Ok(None);
    }
    Ident::parse_any(input)?;
    input.parse().map(Some)
}

fn clearance(input: ParseStream<'_>, example: &str) -> Result<TokenStream> {
    let as_in = format!("as in `{example}`");
    if !is_next(input, CLEARANCE) {
        return Err(helped(input.span(), format!("`{CLEARANCE}` is expected here"), as_in));
    }
    Ident::parse_any(input)?;
    equals(input)?;
    let mut tokens = TokenStream::new();
    while !input.is_empty() && !input.peek(token::Brace) && !input.peek(Token![;]) {
        tokens.extend([input.parse::<TokenTree>()?]);
    }
    if input.peek(token::Brace) {
        return Ok(tokens);
    }
    Err(helped(input.span(), "the block that says how this joint pushes is expected here", as_in))
}

/// Names and values of the block.
fn properties(input: ParseStream<'_>, example: &str) -> Result<Vec<(Ident, TokenStream)>> {
    block(input, example)?;
    let content;
    syn::braced!(content in input);
    let mut all = Vec::new();
    while !content.is_empty() {
        let name = property_name(&content)?;
        equals(&content)?;
        let mut value = TokenStream::new();
        while !content.is_empty() && !content.peek(Token![;]) {
            value.extend([content.parse::<TokenTree>()?]);
        }
        words::semicolon(&content)?;
        all.push((name, value));
    }
    Ok(all)
}

/// A joint with play as it is written.
struct Loose {
    kind: &'static ElementKind,
    name: Ident,
    first: Attachment,
    second: Attachment,
    along: Option<Group>,
    clearance: TokenStream,
    properties: Vec<(Ident, TokenStream)>,
}

/// Tokens at the name of a joint.
macro_rules! spanned {
    ($joint:expr, $($tokens:tt)*) => { quote_spanned!($joint.name.span()=> $($tokens)*) };
}

impl Loose {
    fn property(&self, name: &str) -> Option<&TokenStream> {
        self.properties.iter().find(|(given, _)| given == name).map(|(_, value)| value)
    }

    fn has(&self, name: &str) -> bool {
        self.property(name).is_some()
    }

    fn contact(self) -> Result<ItemKind> {
        let Self { kind, name, first, second, along, clearance, properties } = self;
        let along = along.map(|along| syn::parse2::<Vector>(along.into_token_stream())).transpose()?;
        let clearance = (Ident::new(CLEARANCE, name.span()), clearance);
        let property = |(name, value)| Ok(ElementProperty { name, value: Load::Scalar(syn::parse2(value)?) });
        let properties = properties.into_iter().chain([clearance]).map(property).collect::<Result<_>>()?;
        Ok(ItemKind::Element(Box::new(Element {
            name,
            kind,
            first,
            second: Some(second),
            along,
            properties,
        })))
    }

    /// The gap of a pin in its bore, or those of four corners in their guide, behind what has to be positive.
    fn stops(&self, example: &str) -> Result<Vec<ItemKind>> {
        let known: &[&str] = match &self.along {
            Some(_) => &["length", "height", "restitution", "settle", "friction"],
            None => &["restitution", "settle"],
        };
        if let Some((word, _)) =
            self.properties.iter().find(|(name, _)| !known.iter().any(|known| name == known))
        {
            let message = format!("`{}` hits in no time, and has no `{word}`", self.name);
            return Err(helped(
                word.span(),
                message,
                "give it a `stiffness` or a `modulus` for a contact that takes time",
            ));
        }
        let mut items = vec![self.positive(CLEARANCE, &self.clearance)?];
        match &self.along {
            Some(along) => {
                for size in ["length", "height"] {
                    items.push(self.positive(size, self.size(size, example)?)?);
                }
                items.extend(self.corners(along, example)?);
            }
            None => items.push(self.pin()?),
        }
        Ok(items)
    }

    fn positive(&self, word: &'static str, size: &TokenStream) -> Result<ItemKind> {
        Ok(ItemKind::Size { word, of: self.name.clone(), value: syn::parse2(size.clone())? })
    }

    /// (c² − d²)/(2c) of the distance d, which is smooth where d is 0, and c − d where it closes.
    fn pin(&self) -> Result<ItemKind> {
        let clearance = &self.clearance;
        let [[x1, y1], [x2, y2]] = [&self.first, &self.second].map(position);
        let gap = spanned!(self, ((#clearance)^2 - (#x1 - #x2)^2 - (#y1 - #y2)^2)/(2*(#clearance)));
        self.stop(self.name.clone(), &gap, None)
    }

    /// With the middle of the block at p and q along and across the guide, the angle δ between both, and corners at
    /// (a l/2, b h/2), a and b ±1, gaps are c + h/2 (1 − cos δ) − b (q + a l/2 sin δ). Corners are at p + a l/2 cos δ − b h/2 sin δ.
    fn corners(&self, along: &Group, example: &str) -> Result<Vec<ItemKind>> {
        let (length, height) = (self.size("length", example)?, self.size("height", example)?);
        let [p, q] = self.place(along)?;
        let ([first, second], clearance) = ([&self.first, &self.second].map(angle), &self.clearance);
        let delta = spanned!(self, (#first - #second));
        let corner = |(number, [a, b]): (usize, [i64; 2])| {
            let [a, b] = [a, b].map(Literal::i64_unsuffixed);
            let gap = spanned!(
                self,
                (#clearance) + (#height)/2*(1 - cos(#delta)) - (#b)*(#q + (#a)*(#length)/2*sin(#delta))
            );
            let slid = spanned!(self, #p + (#a)*(#length)/2*cos(#delta) - (#b)*(#height)/2*sin(#delta));
            let name = format_ident!("{}_{}", self.name, number + 1, span = self.name.span());
            self.stop(name, &gap, self.has("friction").then_some(slid))
        };
        [[-1, -1], [1, -1], [1, 1], [-1, 1]].into_iter().enumerate().map(corner).collect()
    }

    fn size(&self, word: &str, example: &str) -> Result<&TokenStream> {
        self.property(word).ok_or_else(|| {
            let message = format!("`{}` does not say its `{word}`", self.name);
            helped(self.name.span(), message, format!("as in `{example}`"))
        })
    }

    /// The first place as the second one sees it: along the guide, and across it.
    fn place(&self, along: &Group) -> Result<[TokenStream; 2]> {
        let components = |input: ParseStream<'_>| {
            let x = until_comma(input)?;
            input
                .parse::<Token![,]>()
                .map_err(|_| Error::new(along.span(), "a direction has two components"))?;
            Ok([x, until_comma(input)?])
        };
        let [x, y] = components.parse2(along.stream())?;
        let [[x1, y1], [x2, y2]] = [&self.first, &self.second].map(position);
        let (dx, dy) = (spanned!(self, (#x1 - #x2)), spanned!(self, (#y1 - #y2)));
        let (second, norm) = (angle(&self.second), spanned!(self, sqrt((#x)^2 + (#y)^2)));
        let cosine = spanned!(self, (((#x)*cos(#second) - (#y)*sin(#second))/#norm));
        let sine = spanned!(self, (((#x)*sin(#second) + (#y)*cos(#second))/#norm));
        Ok([spanned!(self, (#cosine*#dx + #sine*#dy)), spanned!(self, (#cosine*#dy - #sine*#dx))])
    }

    fn stop(&self, name: Ident, gap: &TokenStream, slid: Option<TokenStream>) -> Result<ItemKind> {
        let is_size = |name: &Ident| self.along.is_some() && (name == "length" || name == "height");
        let others = self.properties.iter().filter(|(name, _)| !is_size(name));
        let others = others.map(|(name, value)| spanned!(self, #name = #value;));
        let slid = slid.map(|slid| spanned!(self, along = #slid;));
        let stop = |input: ParseStream<'_>| {
            let (condition, properties) = (condition(input, "")?, words::properties(input, "")?);
            Ok(ItemKind::Stop { name, condition, properties })
        };
        stop.parse2(spanned!(self, #gap >= 0 { #(#others)* #slid }))
    }
}

fn until_comma(input: ParseStream<'_>) -> Result<TokenStream> {
    let mut tokens = TokenStream::new();
    while !input.is_empty() && !input.peek(Token![,]) {
        tokens.extend([input.parse::<TokenTree>()?]);
    }
    Ok(tokens)
}

/// x and y of a place.
fn position(place: &Attachment) -> [TokenStream; 2] {
    ["x", "y"].map(|component| member(place, component))
}

/// The angle of the body of a place.
fn angle(place: &Attachment) -> TokenStream {
    member(place, "angle")
}

/// One of these with all names of the path: before composition nobody knows which of them is an instance.
fn member(place: &Attachment, name: &str) -> TokenStream {
    let Attachment { prefix, body, point } = place;
    let (points, name) = (point.iter(), Ident::new(name, body.span()));
    quote_spanned!(body.span()=> #(#prefix.)* #body #(.#points)* .#name)
}
