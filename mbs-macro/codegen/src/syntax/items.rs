//! Statements: `param …;`, `body … { … }`, `constraint …;`.

use proc_macro2::{Ident, Span, TokenStream};
use quote::ToTokens;
use syn::ext::IdentExt;
use syn::parse::{ParseStream, Parser};
use syn::punctuated::Punctuated;
use syn::{Error, Result, Token, braced, parenthesized, token};

use super::choices::condition;
use super::formula::{end, is_vector};
use super::indices::Indices;
use super::keywords::{STATEMENTS, keywords, neighbour};
use super::statements::Reader;
use super::words::{
    block, definition, doc, equals, helped, name, name_before_unit, path, properties, semicolon, usable,
    with_unit,
};
use super::{Coordinate, Declaration, EnergyRole, ItemKind, Load, Role, StartEntry};
use super::{elements, groups, joints, loose};
use crate::diagnostics::{Diagnostics, nearest};
use crate::mechanics::elements::{ELEMENTS, FORCE_BETWEEN, TORQUE_BETWEEN};
use crate::quantity::Crossing;

/// Reads a declaration.
///
/// # Errors
/// All errors of shape.
pub fn parse(tokens: TokenStream) -> std::result::Result<Declaration, Diagnostics> {
    let mut errors = Diagnostics::default();
    let parser = |input: ParseStream<'_>| declaration(input, &mut errors);
    match groups::delimited(tokens).and_then(|tokens| parser.parse2(tokens)) {
        Ok(declaration) => errors.finish(declaration),
        Err(error) => {
            errors.push(error);
            Err(errors)
        }
    }
}

fn declaration(input: ParseStream<'_>, errors: &mut Diagnostics) -> Result<Declaration> {
    let doc = doc(input)?;
    let visibility = input.parse::<syn::Visibility>()?.into_token_stream();
    let expected =
        |span| Error::new(span, "the name of the mechanism is expected here, as in `pub SliderCrank { … }`");
    let name = Ident::parse_any(input).map_err(|error| expected(error.span()))?;
    if name == "mechanism" && input.peek(Token![!]) {
        let message = "`mechanism! { … }` stands around a declaration in Rust; here the declaration stands alone, as in \
                       `SliderCrank { dof = 0; … }`";
        return Err(Error::new(name.span(), message));
    }
    if let Err(error) = usable(name.clone()) {
        // of `pub struct Crank { … }` the first word is not meant to be the name
        if !input.peek(token::Brace) {
            return Err(expected(name.span()));
        }
        errors.push(error);
    }
    block(input, "SliderCrank { dof = 0; … }")?;
    let content;
    braced!(content in input);
    let indices = Indices::of(&content.fork().parse()?);
    let items = Reader::new(errors).statements(&content, &indices);
    if !input.is_empty() {
        errors.push(input.error("a declaration has one mechanism, which ended before this"));
        input.parse::<TokenStream>()?;
    }
    Ok(Declaration { doc, visibility, name, items })
}

/// A statement with its doc comment.
///
/// One that stands for several gives these.
pub(super) fn item(input: ParseStream<'_>) -> Result<(String, Vec<ItemKind>)> {
    let doc = doc(input)?;
    let keyword = Ident::parse_any(input).map_err(|error| {
        Error::new(error.span(), format!("a statement is expected here: {}", statements().join(", ")))
    })?;
    let word = keyword.to_string();
    let statement = STATEMENTS.iter().find(|(known, ..)| *known == word);
    let joint = joints::Shape::named(&word);
    let element = ELEMENTS.iter().find(|kind| kind.word == word);
    let kind = match (statement, joint, element) {
        (Some((.., read)), _, _) => read(input, keyword.span()),
        (None, Some(_), _) if loose::is_loose(input) => return Ok((doc, loose::joint(input, &keyword)?)),
        (None, Some(shape), _) => joints::joint(input, shape),
        (None, None, Some(kind)) => elements::element(input, kind),
        (None, None, None) => Err(unknown_statement(&keyword, &word)),
    }?;
    Ok((doc, vec![kind]))
}

/// The words that begin statements.
fn statements() -> Vec<&'static str> {
    keywords().into_iter().map(|keyword| keyword.word).collect()
}

fn unknown_statement(keyword: &Ident, word: &str) -> Error {
    let known = statements();
    let help = match (neighbour(word), nearest(word, known.iter().copied())) {
        (Some(help), _) => help.to_owned(),
        (None, Some(near)) => format!("did you mean `{near}`?"),
        (None, None) => format!("statements begin with {}", known.join(", ")),
    };
    helped(keyword.span(), format!("`{word}` does not begin a statement"), help)
}

pub(super) fn dof(input: ParseStream<'_>, keyword: Span) -> Result<ItemKind> {
    equals(input)?;
    let value: syn::LitInt = input.parse().map_err(|error| {
        Error::new(error.span(), "a whole number is expected here: the degrees of freedom that are left")
    })?;
    semicolon(input)?;
    let small: i32 = value
        .base10_parse()
        .map_err(|_| Error::new(value.span(), "no mechanism has that many degrees of freedom"))?;
    Ok(ItemKind::Dof { keyword, value: small.into() })
}

pub(super) fn crate_path(input: ParseStream<'_>, keyword: Span) -> Result<ItemKind> {
    equals(input)?;
    let path = input.call(syn::Path::parse_mod_style).map_err(|error| {
        Error::new(error.span(), "the path of the runtime is expected here, as in `crate = ::my_runtime;`")
    })?;
    let path = path.into_token_stream();
    semicolon(input)?;
    Ok(ItemKind::Crate { keyword, path })
}

pub(super) fn parameter(input: ParseStream<'_>) -> Result<ItemKind> {
    let name = name(input)?;
    equals(input)?;
    let value = input.parse()?;
    let condition = match input.parse::<Option<Token![where]>>()? {
        Some(_) => Some(condition(input, "where l1 > 0")?),
        None => None,
    };
    semicolon(input)?;
    Ok(ItemKind::Parameter { name, value, condition })
}

/// `require crank < rod;`
pub(super) fn require(input: ParseStream<'_>) -> Result<ItemKind> {
    let condition = condition(input, "require l1 < l2;")?;
    semicolon(input)?;
    Ok(ItemKind::Require { of: None, condition })
}

/// `instance left: Leg { phase = 120 [deg]; }`
pub(super) fn instance(input: ParseStream<'_>) -> Result<ItemKind> {
    let name = name(input)?;
    let example = format!("instance {name}: Leg {{ length = 0.5 [m]; }}");
    input.parse::<Token![:]>().map_err(|error| {
        Error::new(error.span(), format!("`:` and an assembly are expected here, as in `{example}`"))
    })?;
    let assembly = self::name(input)?;
    let bindings = match input.parse::<Option<Token![;]>>()? {
        Some(_) => Vec::new(),
        None => properties(input, &example)?,
    };
    Ok(ItemKind::Instance { name, assembly, bindings })
}

pub(super) fn constant(input: ParseStream<'_>) -> Result<ItemKind> {
    let (name, value) = definition(input)?;
    Ok(ItemKind::Constant { name, value })
}

pub(super) fn let_item(input: ParseStream<'_>) -> Result<ItemKind> {
    let (name, value) = definition(input)?;
    Ok(ItemKind::Let { name, value })
}

pub(super) fn energy(input: ParseStream<'_>, role: EnergyRole) -> Result<ItemKind> {
    let (name, value) = definition(input)?;
    Ok(ItemKind::Energy { name, role, value })
}

/// `input torque [N*m];`, or with its value at first, `input push [N] = 2 [kN];`. A bare number is in the unit of the
/// input.
pub(super) fn input_item(input: ParseStream<'_>) -> Result<ItemKind> {
    let (name, unit, value) =
        with_unit(input, |name| format!("an input needs its unit: `input {name} [N*m];`"))?;
    let value = value.map(|value| value.in_unit(&unit));
    Ok(ItemKind::Input { name, unit, value })
}

/// `state current [A] = 0;`
pub(super) fn state(input: ParseStream<'_>) -> Result<ItemKind> {
    let (name, unit, value) =
        with_unit(input, |name| format!("a state needs its unit: `state {name} [A] = 0;`"))?;
    Ok(ItemKind::State { name, unit, value })
}

/// `der(current) = (u - R*current)/L;`
pub(super) fn rate(input: ParseStream<'_>) -> Result<ItemKind> {
    if !input.peek(token::Paren) {
        return Err(input.error("the rate of a state is written `der(current) = …;`"));
    }
    let (prefix, state) = derived(input)?;
    equals(input)?;
    let value = input.parse()?;
    semicolon(input)?;
    Ok(ItemKind::Rate { prefix, state, value })
}

/// `(theta)`, or `(leg.theta)`: the instances of assemblies that lead to a name, and the name.
fn derived(input: ParseStream<'_>) -> Result<(Vec<Ident>, Ident)> {
    let content;
    parenthesized!(content in input);
    let mut path = path(&content)?;
    end(&content)?;
    let name = path.pop().ok_or_else(|| input.error("a name is expected here"))?;
    Ok((path, name))
}

pub(super) fn gravity(input: ParseStream<'_>, keyword: Span) -> Result<ItemKind> {
    equals(input)?;
    if !is_vector(input) {
        return Err(input.error("gravity is a vector: `gravity = (0, -9.81) [m/s^2];`"));
    }
    let value = input.parse()?;
    semicolon(input)?;
    Ok(ItemKind::Gravity { keyword, value })
}

pub(super) fn body(input: ParseStream<'_>) -> Result<ItemKind> {
    let name = name(input)?;
    if !input.peek(token::Paren) {
        return Err(input.error(format!("a body needs its coordinates: `body {name} (x, y, theta) {{ … }}`")));
    }
    let content;
    parenthesized!(content in input);
    let coordinates = Punctuated::<Coordinate, Token![,]>::parse_terminated_with(&content, coordinate)?;
    let coordinates = coordinates.into_iter().collect();
    let properties = properties(input, &format!("body {name} (x, y) {{ mass = 1 [kg]; }}"))?;
    Ok(ItemKind::Body { name, coordinates, properties })
}

fn coordinate(input: ParseStream<'_>) -> Result<Coordinate> {
    let first = name(input)?;
    let (direction, name) = match input.parse::<Option<Token![=]>>()? {
        Some(_) => (Some(first), name(input)?),
        None => (None, first),
    };
    let written = name.to_string();
    if !input.is_empty() && !input.peek(Token![,]) {
        return Err(input.error("`,` is expected between coordinates"));
    }
    Ok(Coordinate { direction, name, written })
}

pub(super) fn constraint(input: ParseStream<'_>, role: Role) -> Result<ItemKind> {
    let name = name(input)?;
    input.parse::<Token![:]>().map_err(|error| {
        let example = match role {
            Role::Constraint => "constraint rod: x = l*cos(theta);",
            Role::Drive => "drive motor: theta = omega*t;",
            Role::Coupler => "coupler screw: x = lead/(2*pi)*theta;",
            Role::Rate => "rate edge: der(y)*cos(phi) = der(x)*sin(phi);",
        };
        Error::new(error.span(), format!("a name and `:` stand before an equation, as in `{example}`"))
    })?;
    let left = input.parse()?;
    let equals = equals(input)?;
    let right = input.parse()?;
    semicolon(input)?;
    Ok(ItemKind::Constraint { name, role, left, equals, right })
}

pub(super) fn force(input: ParseStream<'_>, is_torque: bool) -> Result<ItemKind> {
    let word = if is_torque { "torque" } else { "force" };
    let what = name(input)?;
    if input.peek(token::Paren) {
        return elements::law(input, what, if is_torque { &TORQUE_BETWEEN } else { &FORCE_BETWEEN });
    }
    let on = input.span();
    if what == "on" || !Ident::parse_any(input).is_ok_and(|word| word == "on") {
        let span = if what == "on" { what.span() } else { on };
        let message =
            format!("a name and what it acts on are expected here, as in `{word} push on crank = …;`");
        return Err(Error::new(span, message));
    }
    let target = input.parse()?;
    let frame = match input.parse::<Option<Token![in]>>()? {
        Some(_) => Some(name(input)?),
        None => None,
    };
    equals(input)?;
    let value = if is_vector(input) { Load::Vector(input.parse()?) } else { Load::Scalar(input.parse()?) };
    semicolon(input)?;
    Ok(ItemKind::Force { name: what, is_torque, target, frame, value })
}

pub(super) fn start(input: ParseStream<'_>) -> Result<ItemKind> {
    block(input, "start { theta = 0; }")?;
    let content;
    braced!(content in input);
    let mut entries = Vec::new();
    while !content.is_empty() {
        entries.push(start_entry(&content)?);
    }
    Ok(ItemKind::Start { entries })
}

fn start_entry(input: ParseStream<'_>) -> Result<StartEntry> {
    let ahead = input.fork();
    let is_guess = ahead.call(Ident::parse_any).is_ok_and(|word| word == "guess") && ahead.peek(syn::Ident);
    if is_guess {
        name(input)?;
    }
    let ahead = input.fork();
    let is_rate = ahead.call(Ident::parse_any).is_ok_and(|word| word == "der") && ahead.peek(token::Paren);
    let (prefix, coordinate) = if is_rate {
        name(input)?;
        derived(input)?
    } else {
        let mut path = path(input)?;
        let name = path.pop().ok_or_else(|| input.error("a coordinate is expected here"))?;
        (path, name)
    };
    equals(input)?;
    let value = input.parse()?;
    semicolon(input)?;
    Ok(StartEntry { is_guess, is_rate, prefix, coordinate, value })
}

pub(super) fn event(input: ParseStream<'_>) -> Result<ItemKind> {
    const EXAMPLE: &str = "event hit: x = 0.2 [m] rising;";
    let name = name(input)?;
    input.parse::<Token![:]>().map_err(|error| {
        Error::new(error.span(), format!("a name and `:` stand before an event, as in `{EXAMPLE}`"))
    })?;
    let left = input.parse()?;
    if input.peek(Token![<]) || input.peek(Token![>]) {
        let message = format!("an event has `=` and a direction behind it, as in `{EXAMPLE}`");
        return Err(Error::new(input.span(), message));
    }
    let equals = equals(input)?;
    let right = input.parse()?;
    let crossing = if input.peek(Token![;]) { Crossing::Either } else { crossing(input)? };
    semicolon(input)?;
    Ok(ItemKind::Event { name, left, equals, right, crossing })
}

/// `stop end: x <= 0.2 [m] { restitution = 0.4; }`
pub(super) fn stop(input: ParseStream<'_>) -> Result<ItemKind> {
    const EXAMPLE: &str = "stop end: x <= 0.2 [m] { restitution = 0.4; }";
    let name = name(input)?;
    input.parse::<Token![:]>().map_err(|error| {
        Error::new(error.span(), format!("a name and `:` stand before a stop, as in `{EXAMPLE}`"))
    })?;
    let condition = condition(input, EXAMPLE)?;
    let properties = properties(input, EXAMPLE)?;
    Ok(ItemKind::Stop { name, condition, properties })
}

fn crossing(input: ParseStream<'_>) -> Result<Crossing> {
    let expected = "`rising`, `falling` or the end of the statement is expected here";
    let word = Ident::parse_any(input).map_err(|error| Error::new(error.span(), expected))?;
    match word.to_string().as_str() {
        "rising" => Ok(Crossing::Rising),
        "falling" => Ok(Crossing::Falling),
        _ => Err(Error::new(word.span(), expected)),
    }
}

pub(super) fn output(input: ParseStream<'_>) -> Result<ItemKind> {
    let name = name_before_unit(input)?;
    let unit = if input.peek(token::Bracket) { Some(input.parse()?) } else { None };
    equals(input)?;
    let value = input.parse()?;
    semicolon(input)?;
    Ok(ItemKind::Output { name, unit, value })
}
