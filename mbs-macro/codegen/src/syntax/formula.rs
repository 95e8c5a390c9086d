//! Formulas: `-l1/2*cos(theta1) + 3 [mm]`.

use mbs_symbolic::Number;
use mbs_symbolic::units::{self, Unit};
use proc_macro2::{Punct, Span, TokenStream, TokenTree};
use syn::ext::IdentExt;
use syn::parse::{Parse, ParseStream};
use syn::spanned::Spanned;
use syn::{Error, Ident, Lit, Result, Token, bracketed, parenthesized, token};

use super::choices::choice;
use super::words::{helped, usable};
use super::{Formula, FormulaKind, Operation, Operator, UnitText, Vector};

/// Parentheses, powers and signs may nest this deep.
const DEEPEST: usize = 128;

impl Formula {
    /// The formula that is a name.
    pub fn name(name: &Ident) -> Self {
        Self { span: name.span(), kind: FormulaKind::Name(name.clone()) }
    }

    /// A whole number without a unit.
    pub fn whole(value: i64, span: Span) -> Self {
        Self { span, kind: FormulaKind::Number { value: value.into(), unit: None } }
    }

    /// A bare number, also behind a sign, gets this unit; any other formula has its own.
    pub fn in_unit(self, unit: &UnitText) -> Self {
        let kind = match self.kind {
            FormulaKind::Number { value, unit: None } => {
                FormulaKind::Number { value, unit: Some(unit.clone()) }
            }
            FormulaKind::Negative(inner) => FormulaKind::Negative(Box::new(inner.in_unit(unit))),
            other => other,
        };
        Self { kind, ..self }
    }

    /// As it is written, if it is a name or a path of names.
    pub fn path(&self) -> Option<String> {
        match &self.kind {
            FormulaKind::Name(name) => Some(name.to_string()),
            FormulaKind::Member(path) => {
                Some(path.iter().map(ToString::to_string).collect::<Vec<_>>().join("."))
            }
            _ => None,
        }
    }

    /// The plain names in it.
    pub fn names(&self) -> Vec<&Ident> {
        match &self.kind {
            FormulaKind::Name(name) => vec![name],
            _ => self.parts().into_iter().flat_map(Self::names).collect(),
        }
    }

    /// The calls in it whose one argument is a name, with that.
    pub fn calls_of_names(&self) -> Vec<[&Ident; 2]> {
        let inner = self.parts().into_iter().flat_map(Self::calls_of_names);
        let own = match &self.kind {
            FormulaKind::Call { function, arguments } => match &arguments[..] {
                [Self { kind: FormulaKind::Name(name), .. }] => Some([function, name]),
                _ => None,
            },
            _ => None,
        };
        own.into_iter().chain(inner).collect()
    }

    /// The formulas that it is made of.
    fn parts(&self) -> Vec<&Self> {
        match &self.kind {
            FormulaKind::Number { .. } | FormulaKind::Member(_) | FormulaKind::Name(_) => Vec::new(),
            FormulaKind::Negative(inner)
            | FormulaKind::Component { call: inner, .. }
            | FormulaKind::WithUnit { inner, .. } => vec![inner],
            FormulaKind::Chain { first, rest } => {
                std::iter::once(&**first).chain(rest.iter().map(|operation| &operation.operand)).collect()
            }
            FormulaKind::Power { base, exponent, .. } => vec![base, exponent],
            FormulaKind::Call { arguments, .. } => arguments.iter().collect(),
            FormulaKind::Choice(choice) => {
                choice.test.formulas().into_iter().chain([&choice.value, &choice.otherwise]).collect()
            }
        }
    }
}

impl Parse for Formula {
    fn parse(input: ParseStream<'_>) -> Result<Self> {
        sum(input, 0)
    }
}

pub(super) fn sum(input: ParseStream<'_>, depth: usize) -> Result<Formula> {
    chain(input, &|input| product(input, depth), &[('+', Operator::Plus), ('-', Operator::Minus)])
}

fn product(input: ParseStream<'_>, depth: usize) -> Result<Formula> {
    chain(input, &|input| signed(input, depth), &[('*', Operator::Times), ('/', Operator::Over)])
}

/// Operands with operators between them, which are of one rank.
fn chain(
    input: ParseStream<'_>,
    operand: &dyn Fn(ParseStream<'_>) -> Result<Formula>,
    operators: &[(char, Operator)],
) -> Result<Formula> {
    let first = operand(input)?;
    let mut rest = Vec::new();
    while let Some(op) = next_operator(input, operators) {
        let (_, op_span) = operator(input)?;
        rest.push(Operation { op, op_span, operand: operand(input)? });
    }
    if rest.is_empty() {
        return Ok(first);
    }
    // `join` gives the first token alone on stable compilers; errors therefore
    // go to single tokens, and this span is only the formula's beginning.
    Ok(Formula { span: first.span, kind: FormulaKind::Chain { first: Box::new(first), rest } })
}

fn next_operator(input: ParseStream<'_>, operators: &[(char, Operator)]) -> Option<Operator> {
    let punct = input.fork().parse::<Punct>().ok()?;
    operators.iter().find(|(mark, _)| *mark == punct.as_char()).map(|(_, operator)| *operator)
}

/// Refuses what is nested too deeply.
pub(super) fn checked(input: ParseStream<'_>, depth: usize) -> Result<()> {
    let message = "this formula is nested too deeply; name a part of it with `let`";
    if depth > DEEPEST { Err(input.error(message)) } else { Ok(()) }
}

/// A sign binds looser than `^`: −x² is −(x²).
fn signed(input: ParseStream<'_>, depth: usize) -> Result<Formula> {
    checked(input, depth)?;
    if input.peek(Token![-]) {
        let (_, span) = operator(input)?;
        let inner = signed(input, depth + 1)?;
        return Ok(Formula { span, kind: FormulaKind::Negative(Box::new(inner)) });
    }
    if input.peek(Token![+]) {
        operator(input)?;
        return signed(input, depth + 1);
    }
    let base = with_unit(input, depth)?;
    if input.peek(Token![^]) {
        let (_, op_span) = operator(input)?;
        let exponent = Box::new(signed(input, depth + 1)?);
        return Ok(Formula {
            span: base.span,
            kind: FormulaKind::Power { base: Box::new(base), op_span, exponent },
        });
    }
    Ok(base)
}

fn operator(input: ParseStream<'_>) -> Result<(char, Span)> {
    let punct: Punct = input.parse()?;
    Ok((punct.as_char(), punct.span()))
}

fn with_unit(input: ParseStream<'_>, depth: usize) -> Result<Formula> {
    let formula = primary(input, depth)?;
    if !input.peek(token::Bracket) {
        return Ok(formula);
    }
    let span = formula.span;
    match formula.kind {
        FormulaKind::Number { value, unit: None } => {
            let unit = Some(input.parse()?);
            Ok(Formula { span, kind: FormulaKind::Number { value, unit } })
        }
        FormulaKind::Name(name) => Err(bracket_after_name(input, &name)),
        kind => {
            let inner = Box::new(Formula { span, kind });
            let unit = input.parse()?;
            Ok(Formula { span, kind: FormulaKind::WithUnit { inner, unit } })
        }
    }
}

/// A bracket behind a name is an index that has been resolved before, a unit by
/// mistake, or an index that is not known.
pub(super) fn bracket_after_name(input: ParseStream<'_>, name: &Ident) -> Error {
    let is_unit = input.fork().parse::<UnitText>().is_ok();
    if is_unit {
        let message = "has a unit of its own; units in brackets follow numbers, as in `60 [mm]`";
        return input.error(format!("`{name}` {message}"));
    }
    let message = format!("the index of `{name}` is not known here");
    let help = format!(
        "an index is 0 or more, made of whole numbers, loop variables and whole constants, as in `{name}[i-1]`"
    );
    helped(input.span(), message, help)
}

fn primary(input: ParseStream<'_>, depth: usize) -> Result<Formula> {
    if input.peek(Lit) {
        return number(&input.parse()?);
    }
    if input.peek(token::Paren) {
        let content;
        let paren = parenthesized!(content in input);
        let inner = sum(&content, depth + 1)?;
        if content.peek(Token![,]) {
            let message = "a vector stands alone; here a scalar is needed";
            let help = "write its components, as in `(if a < b { x } else { 0 }, 2*y)`";
            return Err(helped(paren.span.join(), message, help));
        }
        end(&content)?;
        return Ok(Formula { span: paren.span.join(), kind: inner.kind });
    }
    if input.peek(Token![if]) {
        return choice(input, depth);
    }
    if input.peek(Ident::peek_any) {
        let name = Ident::parse_any(input)?;
        let span = name.span();
        if !input.peek(token::Paren) {
            return Ok(Formula { span, kind: path(input, usable(name)?)? });
        }
        let content;
        parenthesized!(content in input);
        let mut arguments = Vec::new();
        while !content.is_empty() {
            arguments.push(sum(&content, depth + 1)?);
            if content.parse::<Option<Token![,]>>()?.is_none() {
                end(&content)?;
            }
        }
        let call = Formula { span, kind: FormulaKind::Call { function: name, arguments } };
        if input.parse::<Option<Token![.]>>()?.is_none() {
            return Ok(call);
        }
        let member = member(input)?;
        return Ok(Formula { span, kind: FormulaKind::Component { call: Box::new(call), member } });
    }
    // `input.error` would speak of an unexpected end of input
    Err(Error::new(input.span(), "a formula is expected here: a number, a name, a function call or `( … )`"))
}

/// `theta`, or `crank.tip.x`.
fn path(input: ParseStream<'_>, name: Ident) -> Result<FormulaKind> {
    // `a .. b` is a span
    let is_member = || input.peek(Token![.]) && !input.peek(Token![..]);
    if !is_member() {
        return Ok(FormulaKind::Name(name));
    }
    let mut path = vec![name];
    while is_member() {
        input.parse::<Token![.]>()?;
        path.push(member(input)?);
    }
    Ok(FormulaKind::Member(path))
}

fn member(input: ParseStream<'_>) -> Result<Ident> {
    Ident::parse_any(input).map_err(|error| Error::new(error.span(), "a name is expected behind `.`"))
}

fn number(literal: &Lit) -> Result<Formula> {
    let (digits, suffix) = match literal {
        Lit::Int(int) => (int.base10_digits().to_owned(), int.suffix().to_owned()),
        Lit::Float(float) => (float.base10_digits().to_owned(), float.suffix().to_owned()),
        other => return Err(Error::new(other.span(), "only numbers can stand in a formula")),
    };
    if !suffix.is_empty() {
        let help = if units::lookup(&suffix).is_some() {
            format!("write the unit in brackets: `{digits} [{suffix}]`")
        } else {
            format!("write a product with `*`: `{digits}*{suffix}`")
        };
        return Err(helped(literal.span(), format!("`{digits}{suffix}` is not a number"), help));
    }
    let value = Number::parse(&digits)
        .ok_or_else(|| Error::new(literal.span(), "this number is too large for a double"))?;
    Ok(Formula { span: literal.span(), kind: FormulaKind::Number { value, unit: None } })
}

const JOINED: &str = "units are joined by `*`, `/` and `^`";

impl Parse for UnitText {
    /// `[N*m/s^2]`
    fn parse(input: ParseStream<'_>) -> Result<Self> {
        let content;
        let bracket = bracketed!(content in input);
        let inner;
        // `[$u]` around the fragment of a macro
        let content = match content.peek(token::Paren) && is_one_token(&content) {
            true => {
                parenthesized!(inner in content);
                inner
            }
            false => content,
        };
        let tokens: TokenStream = content.fork().parse()?;
        let text = tokens.to_string().replace(' ', "");
        if content.is_empty() {
            return Err(Error::new(
                bracket.span.join(),
                "an empty unit; leave the brackets out of a bare number",
            ));
        }
        Ok(Self { text, unit: unit(&content)? })
    }
}

fn is_one_token(input: ParseStream<'_>) -> bool {
    let ahead = input.fork();
    ahead.parse::<TokenTree>().is_ok() && ahead.is_empty()
}

/// A unit, inside its brackets.
pub(super) fn unit(content: ParseStream<'_>) -> Result<Unit> {
    let mut unit = unit_factor(content)?;
    while !content.is_empty() {
        let (op, span) = operator(content).map_err(|error| Error::new(error.span(), JOINED))?;
        let factor = unit_factor(content)?;
        unit = match op {
            '*' => unit.times(factor),
            '/' => factor.power(-1).map_or(unit, |inverse| unit.times(inverse)),
            _ => return Err(Error::new(span, JOINED)),
        };
    }
    Ok(unit)
}

fn unit_factor(input: ParseStream<'_>) -> Result<Unit> {
    if input.peek(token::Paren) {
        let message = "a unit has no parentheses; `/` applies to the next factor alone, as in `[N/m/s]`";
        return Err(input.error(message));
    }
    if input.peek(Lit) {
        let literal: Lit = input.parse()?;
        return match &literal {
            Lit::Int(int) if int.base10_digits() == "1" && int.suffix().is_empty() => Ok(Unit::ONE),
            _ => Err(Error::new(
                literal.span(),
                "a unit is expected here; the only number in units is 1, as in `[1/s]`",
            )),
        };
    }
    let name =
        Ident::parse_any(input).map_err(|error| Error::new(error.span(), "a unit is expected here"))?;
    let unit = units::lookup(&name.to_string()).ok_or_else(|| {
        let unknown = units::UnitError::unknown(&name.to_string());
        let near = |text: &str| crate::diagnostics::nearest(text, units::known()).map(str::to_owned);
        let meant = unknown.unknown.as_deref().and_then(|text| units::meant(text).or_else(|| near(text)));
        match meant {
            Some(meant) => helped(name.span(), unknown, format!("did you mean `{meant}`?")),
            None => Error::new(name.span(), unknown),
        }
    })?;
    if !input.peek(Token![^]) {
        return Ok(unit);
    }
    operator(input)?;
    let negative = input.peek(Token![-]);
    if negative {
        operator(input)?;
    }
    let whole = "the exponent of a unit is a small whole number";
    let exponent: syn::LitInt = input.parse().map_err(|error| Error::new(error.span(), whole))?;
    let magnitude = exponent.base10_parse::<i8>().map_err(|error| Error::new(error.span(), whole))?;
    let power = unit.power(if negative { -i32::from(magnitude) } else { magnitude.into() });
    power.ok_or_else(|| Error::new(exponent.span(), whole))
}

impl Parse for Vector {
    /// `(x, y)` or `(x, y) [unit]`
    fn parse(input: ParseStream<'_>) -> Result<Self> {
        if !is_vector(input) {
            return Err(Error::new(input.span(), "a vector is expected here, as in `(1, 0)`"));
        }
        let content;
        let paren = parenthesized!(content in input);
        let x = content.parse()?;
        content.parse::<Token![,]>()?;
        let y = content.parse()?;
        content.parse::<Option<Token![,]>>()?;
        if !content.is_empty() {
            return Err(content.error("a vector of the plane has two components, `(x, y)`"));
        }
        let mut vector = Self { span: paren.span.join(), x, y };
        if input.peek(token::Bracket) {
            let unit: UnitText = input.parse()?;
            vector.x = in_unit(vector.x, unit.clone());
            vector.y = in_unit(vector.y, unit);
        }
        Ok(vector)
    }
}

fn in_unit(inner: Formula, unit: UnitText) -> Formula {
    Formula { span: inner.span, kind: FormulaKind::WithUnit { inner: Box::new(inner), unit } }
}

/// True if a parenthesis holds a vector: a comma on its first level.
pub(super) fn is_vector(input: ParseStream<'_>) -> bool {
    let ahead = input.fork();
    let Ok(group) = ahead.parse::<proc_macro2::Group>() else { return false };
    let is_comma = |token| matches!(token, TokenTree::Punct(p) if p.as_char() == ',');
    input.peek(token::Paren) && group.stream().into_iter().any(is_comma)
}

/// Nothing may be left.
pub(super) fn end(input: ParseStream<'_>) -> Result<()> {
    if input.is_empty() {
        return Ok(());
    }
    let rest: TokenStream = input.fork().parse()?;
    Err(Error::new(rest.span(), "an operator, `;` or the end is expected here"))
}
