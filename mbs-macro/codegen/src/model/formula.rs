//! Formulas to expressions, with dimensions checked on the way.

use mbs_symbolic::units::{Dimension, Unit};
use mbs_symbolic::{Expr, Number, Symbol};
use proc_macro2::{Ident, Span};

use super::Meaning;
use super::functions;
use super::hints::unit_help_for_products;
use super::known::{State, Typed, Value};
use super::names::{Place, Scope};
use crate::diagnostics::{Diagnostic, Diagnostics, described, listing, nearest};
use crate::syntax::{Formula, FormulaKind, Operation, Operator};

impl Scope<'_> {
    /// The expression of a formula; `None` if it has errors, which are added.
    pub fn formula(&mut self, formula: &Formula, place: Place, errors: &mut Diagnostics) -> Option<Typed> {
        match &formula.kind {
            FormulaKind::Number { value, unit } => {
                let unit = unit.as_ref().map_or(Unit::ONE, |unit| unit.unit);
                let value = *value * unit.scale;
                let is_any = value.is_zero() && unit == Unit::ONE;
                let dimension = (!is_any).then_some(unit.dimension);
                Some(Typed { expr: self.arena.number(value), dimension })
            }
            FormulaKind::Name(name) => self.name(name, place, errors),
            FormulaKind::Member(path) => self.member(path, place, errors),
            FormulaKind::Negative(inner) => {
                let inner = self.formula(inner, place, errors)?;
                Some(Typed { expr: self.arena.neg(inner.expr), ..inner })
            }
            FormulaKind::Power { base, op_span, exponent } => {
                self.power(base, exponent, *op_span, place, errors)
            }
            FormulaKind::Chain { first, rest } => self.chain(first, rest, place, errors),
            FormulaKind::Choice(choice) => self.choice(choice, place, errors),
            FormulaKind::Call { function, arguments } => self.call(function, arguments, place, errors),
            FormulaKind::Component { call, member } => self.component(call, member, place, errors),
            FormulaKind::WithUnit { inner, unit } => {
                let value = self.formula(inner, place, errors)?;
                if value.dimension.is_some_and(|dimension| dimension != Dimension::NONE) {
                    errors.push(
                        Diagnostic::new(
                            inner.span,
                            format!("this already has a unit, so `[{}]` cannot be added", unit.text),
                        )
                        .help("leave one of the two units out"),
                    );
                    return None;
                }
                let expr = self.arena.scale(value.expr, unit.unit.scale);
                Some(Typed { expr, dimension: Some(unit.unit.dimension) })
            }
        }
    }

    /// From left to right; what has no value of its own has been reported.
    fn chain(
        &mut self,
        first: &Formula,
        rest: &[Operation],
        place: Place,
        errors: &mut Diagnostics,
    ) -> Option<Typed> {
        if rest.iter().all(|operation| matches!(operation.op, Operator::Plus | Operator::Minus)) {
            return self.sum(first, rest, place, errors);
        }
        let mut value = self.formula(first, place, errors);
        for Operation { op, op_span, operand } in rest {
            let found = self.formula(operand, place, errors);
            value = match (value, found) {
                (Some(l), Some(r)) => {
                    let result = match op {
                        Operator::Over => self.divide(operand, l, r),
                        _ => Ok(Typed { expr: self.arena.mul(l.expr, r.expr), dimension: product(l, r) }),
                    };
                    errors
                        .take(result)
                        .and_then(|typed| self.finite(typed, &[l.expr, r.expr], *op_span, errors))
                }
                _ => None,
            };
        }
        value
    }

    /// All terms at once: one after the other they would be as many sums, each with all terms before.
    fn sum(
        &mut self,
        first: &Formula,
        rest: &[Operation],
        place: Place,
        errors: &mut Diagnostics,
    ) -> Option<Typed> {
        let value = self.formula(first, place, errors);
        let mut dimension = value.map(|value| value.dimension);
        let mut terms: Vec<(Expr, Number)> =
            value.map(|value| (value.expr, Number::ONE)).into_iter().collect();
        // Only what is written, no result of an operation, may lack its unit.
        let mut left = Some(first);
        for Operation { op, op_span, operand } in rest {
            let found = self.formula(operand, place, errors);
            dimension = match (dimension, found) {
                (Some(l), Some(r)) => {
                    let sign = if matches!(op, Operator::Minus) { Number::MINUS_ONE } else { Number::ONE };
                    terms.push((r.expr, sign));
                    errors.take(common_dimension(sign, *op_span, (left, l), (operand, r.dimension)))
                }
                _ => None,
            };
            left = None;
        }
        let typed = Typed { expr: self.arena.sum(&terms), dimension: dimension? };
        let operands: Vec<Expr> = terms.iter().map(|(term, _)| *term).collect();
        let span = rest.last().map_or(first.span, |operation| operation.op_span);
        self.finite(typed, &operands, span, errors)
    }

    /// As [`formula`](Self::formula), of the given dimension.
    pub fn formula_of(
        &mut self,
        formula: &Formula,
        place: Place,
        (what, dimension): (&str, Dimension),
        errors: &mut Diagnostics,
    ) -> Option<Expr> {
        let typed = self.formula(formula, place, errors)?;
        match typed.dimension {
            Some(found) if found != dimension => {
                errors.push(
                    Diagnostic::new(
                        formula.span,
                        format!(
                            "{what} has to be {}, but this is {}",
                            described(dimension),
                            described(found)
                        ),
                    )
                    .help(self.unit_help(formula, (found, dimension))),
                );
                None
            }
            _ => Some(typed.expr),
        }
    }

    fn unit_help(&self, formula: &Formula, (found, wanted): (Dimension, Dimension)) -> String {
        if matches!(formula.kind, FormulaKind::Number { unit: None, .. }) {
            let number = formula.span.source_text().unwrap_or_else(|| "1".to_owned());
            let unit = wanted.si_unit();
            return format!("give the number its unit, as in `{number} [{unit}]`");
        }
        if let Some(help) = unit_help_for_products(formula) {
            return help;
        }
        let bare = self.bare_parameters(formula);
        match &bare[..] {
            [name] if found == Dimension::NONE => {
                format!(
                    "`{name}` is declared without a unit; give its value one, such as [{}]",
                    wanted.si_unit()
                )
            }
            _ => "check the units and factors of this formula".to_owned(),
        }
    }

    /// The parameters in a sum or product that are declared without a unit.
    fn bare_parameters(&self, formula: &Formula) -> Vec<String> {
        match &formula.kind {
            FormulaKind::Name(name) => match self.values.get(&name.to_string()) {
                Some(Value::Symbol { symbol, dimension: Dimension::NONE, .. })
                    if matches!(self.meaning(*symbol), Meaning::Parameter(_)) =>
                {
                    vec![name.to_string()]
                }
                _ => Vec::new(),
            },
            FormulaKind::Negative(inner) => self.bare_parameters(inner),
            FormulaKind::Chain { first, rest } => {
                let operands = rest.iter().map(|operation| &operation.operand);
                let all = std::iter::once(&**first).chain(operands);
                all.flat_map(|operand| self.bare_parameters(operand)).collect()
            }
            FormulaKind::Power { base, exponent, .. } => {
                let mut bare = self.bare_parameters(base);
                bare.extend(self.bare_parameters(exponent));
                bare
            }
            _ => Vec::new(),
        }
    }

    fn name(&mut self, name: &Ident, place: Place, errors: &mut Diagnostics) -> Option<Typed> {
        let text = name.to_string();
        if let Some(local) = self.locals.iter().find(|local| local.name == text) {
            return Some(local.typed);
        }
        if text == "pi" {
            return Some(Typed {
                expr: self.arena.number(Number::pi(1, 1)),
                dimension: Some(Dimension::NONE),
            });
        }
        if text == "t" {
            let typed = Typed { expr: self.arena.variable(self.time), dimension: Some(Dimension::TIME) };
            return self.allowed(typed, name, place, errors);
        }
        if self.values.contains_key(&text) && !self.used.contains(&text) {
            self.used.insert(text.clone());
        }
        let typed = match self.values.get_mut(&text) {
            Some(Value::Symbol { symbol, dimension, .. }) => {
                let (symbol, dimension) = (*symbol, *dimension);
                Typed { expr: self.arena.variable(symbol), dimension: Some(dimension) }
            }
            Some(Value::Definition(definition)) => match definition.state {
                State::Done(typed) => typed,
                State::Failed => return None,
                State::Open => {
                    let span = definition.span;
                    errors.push(
                        Diagnostic::new(name.span(), format!("`{text}` is defined through itself"))
                            .note(span, format!("the definition of `{text}` starts here"))
                            .help("break the circle: one of the names on it needs a value of its own"),
                    );
                    return None;
                }
                State::Untouched => self.definition(&text, errors)?,
            },
            Some(Value::Refused(_)) => return None,
            None => {
                errors.push(self.unknown(name));
                return None;
            }
        };
        self.allowed(typed, name, place, errors)
    }

    /// Refuses what an expression may not depend on in this place.
    pub(super) fn allowed(
        &self,
        typed: Typed,
        name: &Ident,
        place: Place,
        errors: &mut Diagnostics,
    ) -> Option<Typed> {
        for symbol in self.arena.symbols_in(typed.expr) {
            if !place.allows(self.meaning(symbol)) {
                let culprit = self.describe(symbol);
                let message = if *name == self.arena.name(symbol) {
                    format!("{culprit} cannot stand here")
                } else {
                    format!("`{name}` cannot stand here, since it depends on {culprit}")
                };
                let help = match self.meaning(symbol) {
                    Meaning::Acceleration(_) if self.is_rate_of_state(symbol) => format!(
                        "give the right side of its equation a name and use that: `let rate = …; {} = rate;`",
                        self.arena.name(symbol)
                    ),
                    _ => place.rule().to_owned(),
                };
                errors.push(Diagnostic::new(name.span(), message).help(help));
                return None;
            }
        }
        Some(typed)
    }

    /// True for `der(z)` of a state z.
    fn is_rate_of_state(&self, symbol: Symbol) -> bool {
        !self.arena.name(symbol).starts_with("der(der(")
    }

    pub(super) fn describe(&self, symbol: Symbol) -> String {
        let name = self.arena.name(symbol);
        match self.meaning(symbol) {
            Meaning::Time => "the time `t`".to_owned(),
            Meaning::Parameter(_) => format!("the parameter `{name}`"),
            Meaning::Input(at) if at >= self.first_memory => format!("the memory `{name}`"),
            Meaning::Input(_) => format!("the input `{name}`"),
            Meaning::Coordinate(_) => format!("the coordinate `{name}`"),
            // the velocity of a coordinate has no name of its own
            Meaning::Velocity(_) if !name.starts_with("der(") => format!("the state `{name}`"),
            Meaning::Velocity(_) => format!("the velocity `{name}`"),
            Meaning::Acceleration(_) if self.is_rate_of_state(symbol) => format!("the rate `{name}`"),
            Meaning::Acceleration(_) => format!("the acceleration `{name}`"),
            _ => format!("the multiplier `{name}`"),
        }
    }

    fn unknown(&self, name: &Ident) -> Diagnostic {
        let text = name.to_string();
        let error = Diagnostic::new(name.span(), format!("there is no `{text}` in this mechanism"));
        if let Some(frame) = self.bodies.get(&text) {
            let message = format!("`{text}` is a body, not a quantity");
            return Diagnostic::new(name.span(), message)
                .help(format!("its coordinates are {}", listing(&frame.coordinates)));
        }
        if self.rows.contains_key(&text) {
            return Diagnostic::new(name.span(), format!("`{text}` is a constraint, not a quantity"))
                .help(format!("its multiplier is `lambda({text})`"));
        }
        if functions::is_known(&text) || self.tables.contains_key(&text) {
            return Diagnostic::new(name.span(), format!("`{text}` is a function")).help(
                match text.ends_with("_energy") {
                    true => format!("write `{text}()`"),
                    false => format!("give it its argument: `{text}(…)`"),
                },
            );
        }
        let known = self.values.keys().map(String::as_str).chain(["t", "pi"]);
        match nearest(&text, known) {
            Some(near) => error.help(format!("did you mean `{near}`?")),
            None if mbs_symbolic::units::lookup(&text).is_some() => {
                error.help(format!("a unit stands in brackets behind its number: `1 [{text}]`"))
            }
            None => error.help(format!("declared are {}", listing(self.values.keys()))),
        }
    }

    fn divide(&mut self, divisor: &Formula, l: Typed, r: Typed) -> Result<Typed, Diagnostic> {
        let Some(expr) = self.arena.div(l.expr, r.expr) else {
            return Err(
                Diagnostic::new(divisor.span, "this divisor is 0").help("the quotient is not defined")
            );
        };
        let dimension = match (l.dimension, r.dimension) {
            (None, _) => None,
            (Some(a), b) => Some(a.over(b.unwrap_or(Dimension::NONE))),
        };
        Ok(Typed { expr, dimension })
    }

    fn power(
        &mut self,
        base: &Formula,
        exponent: &Formula,
        op_span: Span,
        place: Place,
        errors: &mut Diagnostics,
    ) -> Option<Typed> {
        let b = self.formula(base, place, errors);
        let what = ("an exponent", Dimension::NONE);
        let e = self.formula_of(exponent, place, what, errors)?;
        let b = b?;
        let number = self.arena.as_number(e);
        if self.arena.is_zero(b.expr) && number.is_none_or(Number::is_negative) {
            errors.push(
                Diagnostic::new(op_span, "this power of 0 is not defined")
                    .help("change the base or the exponent"),
            );
            return None;
        }
        let dimension = match b.dimension {
            None | Some(Dimension::NONE) => Ok(Dimension::NONE),
            Some(base) => number.and_then(|number| base.power(number)).ok_or(base),
        };
        let dimension = match dimension {
            Ok(dimension) => dimension,
            Err(base) => {
                errors.push(
                    Diagnostic::new(op_span, format!("{} to this power has no dimension", described(base)))
                        .help("a quantity with a dimension takes constant exponents such as 2, -1 or 1/2"),
                );
                return None;
            }
        };
        let expr = self.arena.pow(b.expr, e);
        self.finite(Typed { expr, dimension: Some(dimension) }, &[b.expr, e], op_span, errors)
    }

    /// Refuses an operation on numbers that gives none.
    pub fn finite(
        &self,
        typed: Typed,
        operands: &[Expr],
        span: Span,
        errors: &mut Diagnostics,
    ) -> Option<Typed> {
        let is_constant = operands.iter().all(|&operand| self.arena.as_number(operand).is_some());
        if is_constant && !self.arena.evaluate(&[typed.expr], &|_| f64::NAN)[0].is_finite() {
            errors.push(
                Diagnostic::new(span, "this does not give a finite number")
                    .help("check what it is applied to: its sign, its range and its size"),
            );
            return None;
        }
        Some(typed)
    }
}

/// The dimension of l + r or l − r: any, if both are numbers that may have any.
fn common_dimension(
    sign: Number,
    op_span: Span,
    (left, l): (Option<&Formula>, Option<Dimension>),
    (right, r): (&Formula, Option<Dimension>),
) -> Result<Option<Dimension>, Diagnostic> {
    let (a, b) = match (l, r) {
        (Some(a), Some(b)) if a != b => (a, b),
        _ => return Ok(l.or(r)),
    };
    let message = match sign.is_negative() {
        true => format!("{} cannot be subtracted from {}", described(b), described(a)),
        false => format!("{} and {} cannot be added", described(a), described(b)),
    };
    // The number without a unit is the likely culprit.
    let mut written = left.into_iter().chain([right]);
    let bare = written.find(|f| matches!(f.kind, FormulaKind::Number { unit: None, .. }));
    Err(match bare {
        Some(number) => Diagnostic::new(number.span, message)
            .help("a number without a unit is dimensionless; give it one, as in `5 [mm]`"),
        None => Diagnostic::new(op_span, message).help("check the units and factors of both sides"),
    })
}

fn product(l: Typed, r: Typed) -> Option<Dimension> {
    Some(l.dimension?.times(r.dimension?))
}
