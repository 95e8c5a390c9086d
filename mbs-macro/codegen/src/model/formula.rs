//! Formulas to expressions, with dimensions checked on the way.

use std::collections::HashMap;

use mbs_symbolic::units::{Dimension, Unit};
use mbs_symbolic::{Expr, Function, Number, Symbol};
use proc_macro2::{Ident, Span};

use super::Meaning;
use super::names::{Place, Scope, State, Typed, Value};
use crate::diagnostics::{Diagnostic, Diagnostics, listing, nearest};
use crate::syntax::{Formula, FormulaKind};

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
            FormulaKind::Negative(inner) => {
                let inner = self.formula(inner, place, errors)?;
                Some(Typed { expr: self.arena.neg(inner.expr), ..inner })
            }
            FormulaKind::Binary { op: '^', op_span, left, right } => {
                self.power(left, right, *op_span, place, errors)
            }
            FormulaKind::Binary { op, op_span, left, right } => {
                let (l, r) = (self.formula(left, place, errors), self.formula(right, place, errors));
                let (l, r) = (l?, r?);
                let result = match op {
                    '+' | '-' => self.add(*op, *op_span, (left, l), (right, r)),
                    '*' => Ok(Typed { expr: self.arena.mul(l.expr, r.expr), dimension: product(l, r) }),
                    _ => self.divide(right, l, r),
                };
                errors.take(result)
            }
            FormulaKind::Call { function, arguments } => self.call(function, arguments, place, errors),
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
                        format!("{what} has to be a {dimension}, but this is a {found}"),
                    )
                    .help(unit_help(formula, dimension)),
                );
                None
            }
            _ => Some(typed.expr),
        }
    }

    fn name(&mut self, name: &Ident, place: Place, errors: &mut Diagnostics) -> Option<Typed> {
        let text = name.to_string();
        if text == "pi" {
            return Some(Typed { expr: self.arena.number(Number::PI), dimension: Some(Dimension::NONE) });
        }
        if text == "t" {
            let typed = Typed { expr: self.arena.variable(self.time), dimension: Some(Dimension::TIME) };
            return self.allowed(typed, name, place, errors);
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
            None => {
                errors.push(self.unknown(name));
                return None;
            }
        };
        self.allowed(typed, name, place, errors)
    }

    /// Resolves a `let` or `const` that is met for the first time.
    pub fn definition(&mut self, name: &str, errors: &mut Diagnostics) -> Option<Typed> {
        let Some(Value::Definition(definition)) = self.values.get_mut(name) else { return None };
        definition.state = State::Open;
        let (formula, place) =
            (definition.formula, if definition.is_constant { Place::Constant } else { Place::Anywhere });
        let typed = self.formula(formula, place, errors);
        if let Some(Value::Definition(definition)) = self.values.get_mut(name) {
            definition.state = typed.map_or(State::Failed, State::Done);
        }
        typed
    }

    /// Refuses what an expression may not depend on in this place.
    fn allowed(&self, typed: Typed, name: &Ident, place: Place, errors: &mut Diagnostics) -> Option<Typed> {
        for symbol in self.arena.symbols_in(typed.expr) {
            if !place.allows(self.meaning(symbol)) {
                let culprit = self.describe(symbol);
                let message = if self.arena.name(symbol) == name.to_string() {
                    format!("{culprit} cannot stand here")
                } else {
                    format!("`{name}` cannot stand here, since it depends on {culprit}")
                };
                errors.push(Diagnostic::new(name.span(), message).help(place.rule()));
                return None;
            }
        }
        Some(typed)
    }

    fn describe(&self, symbol: Symbol) -> String {
        let name = self.arena.name(symbol);
        match self.meaning(symbol) {
            Meaning::Time => "the time `t`".to_owned(),
            Meaning::Parameter(_) => format!("the parameter `{name}`"),
            Meaning::Input(_) => format!("the input `{name}`"),
            Meaning::Coordinate(_) => format!("the coordinate `{name}`"),
            Meaning::Velocity(_) => format!("the velocity `{name}`"),
            Meaning::Acceleration(_) => format!("the acceleration `{name}`"),
            _ => format!("the multiplier `{name}`"),
        }
    }

    fn unknown(&self, name: &Ident) -> Diagnostic {
        let text = name.to_string();
        let error = Diagnostic::new(name.span(), format!("there is no `{text}` in this mechanism"));
        if let Some(coordinates) = self.bodies.get(&text) {
            let message = format!("`{text}` is a body, not a quantity");
            return Diagnostic::new(name.span(), message)
                .help(format!("its coordinates are {}", listing(coordinates)));
        }
        if self.rows.contains_key(&text) {
            return Diagnostic::new(name.span(), format!("`{text}` is a constraint, not a quantity"))
                .help(format!("its multiplier is `lambda({text})`"));
        }
        if Function::named(&text).is_some() {
            return Diagnostic::new(name.span(), format!("`{text}` is a function"))
                .help(format!("give it its argument: `{text}(…)`"));
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

    fn add(
        &mut self,
        op: char,
        op_span: Span,
        (left, l): (&Formula, Typed),
        (right, r): (&Formula, Typed),
    ) -> Result<Typed, Diagnostic> {
        let sign = if op == '-' { Number::MINUS_ONE } else { Number::ONE };
        let expr = self.arena.sum(&[(l.expr, Number::ONE), (r.expr, sign)]);
        match (l.dimension, r.dimension) {
            (Some(a), Some(b)) if a != b => {
                let message = match op {
                    '-' => format!("a {b} cannot be subtracted from a {a}"),
                    _ => format!("a {a} and a {b} cannot be added"),
                };
                // The number without a unit is the likely culprit.
                let bare = [left, right]
                    .into_iter()
                    .find(|f| matches!(f.kind, FormulaKind::Number { unit: None, .. }));
                Err(match bare {
                    Some(number) => Diagnostic::new(number.span, message)
                        .help("a number without a unit is dimensionless; give it one, as in `5 [mm]`"),
                    None => {
                        Diagnostic::new(op_span, message).help("check the units and factors of both sides")
                    }
                })
            }
            (a, b) => Ok(Typed { expr, dimension: a.or(b) }),
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
        let dimension = match (b.dimension, number) {
            (None | Some(Dimension::NONE), _) => Some(Dimension::NONE),
            (Some(dimension), Some(number)) => dimension.power(number),
            (Some(_), None) => None,
        };
        let Some(dimension) = dimension else {
            let base = b.dimension.unwrap_or_default();
            errors.push(
                Diagnostic::new(op_span, format!("a {base} to this power has no dimension"))
                    .help("a quantity with a dimension takes constant exponents such as 2, -1 or 1/2"),
            );
            return None;
        };
        Some(Typed { expr: self.arena.pow(b.expr, e), dimension: Some(dimension) })
    }

    fn call(
        &mut self,
        name: &Ident,
        arguments: &[Formula],
        place: Place,
        errors: &mut Diagnostics,
    ) -> Option<Typed> {
        match name.to_string().as_str() {
            "der" => self.time_derivative(name, arguments, place, errors),
            "lambda" | "effort" => {
                let result = self.multiplier(name, arguments, place);
                errors.take(result)
            }
            text => match Function::named(text) {
                Some(function) => self.function(function, name, arguments, place, errors),
                None => {
                    let known =
                        mbs_symbolic::FUNCTIONS.iter().map(|row| row.name).chain(["der", "lambda", "effort"]);
                    let known: Vec<_> = known.filter(|name| !name.is_empty()).collect();
                    let error = Diagnostic::new(name.span(), format!("there is no function `{text}`"));
                    errors.push(match nearest(text, known.iter().copied()) {
                        _ if self.values.contains_key(text) => {
                            error.help(format!("write a product with `*`: `{text}*(…)`"))
                        }
                        Some(near) => error.help(format!("did you mean `{near}`?")),
                        None => error.help(format!("the functions are {}", listing(known))),
                    });
                    None
                }
            },
        }
    }

    fn function(
        &mut self,
        function: Function,
        name: &Ident,
        arguments: &[Formula],
        place: Place,
        errors: &mut Diagnostics,
    ) -> Option<Typed> {
        let arity = function.row().arity;
        if arguments.len() != arity {
            let s = if arity == 1 { "" } else { "s" };
            errors.push(
                Diagnostic::new(
                    name.span(),
                    format!("`{name}` takes {arity} argument{s}, not {}", arguments.len()),
                )
                .help(if arity == 1 {
                    format!("write `{name}(x)`")
                } else {
                    format!("write `{name}(y, x)`")
                }),
            );
            return None;
        }
        let values: Vec<_> = arguments.iter().map(|argument| self.formula(argument, place, errors)).collect();
        let values: Vec<_> = values.into_iter().collect::<Option<_>>()?;
        let dimension = errors.take(function_dimension(function, name, arguments, &values))?;
        let expr = match values[..] {
            [x] if function == Function::Sqrt
                && self.arena.as_number(x.expr).is_some_and(Number::is_negative) =>
            {
                errors.push(
                    Diagnostic::new(arguments[0].span, "the square root of a negative number is not real")
                        .help("check the sign"),
                );
                return None;
            }
            [x] => self.arena.call(function, x.expr),
            [x, y] if function == Function::Pow => self.arena.pow(x.expr, y.expr),
            [x, y] => self.arena.call2(function, x.expr, y.expr),
            _ => return None,
        };
        Some(Typed { expr, dimension })
    }

    /// `der(e)`: the total time derivative.
    fn time_derivative(
        &mut self,
        name: &Ident,
        arguments: &[Formula],
        place: Place,
        errors: &mut Diagnostics,
    ) -> Option<Typed> {
        let [argument] = arguments else {
            errors.push(Diagnostic::new(name.span(), "`der` takes one argument").help("write `der(theta)`"));
            return None;
        };
        let inner = self.formula(argument, Place::Anywhere, errors)?;
        let mut direction = HashMap::new();
        for symbol in self.arena.symbols_in(inner.expr) {
            let rate = match self.meaning(symbol) {
                Meaning::Time => self.arena.one(),
                // the three symbols of a coordinate follow each other
                Meaning::Coordinate(_) | Meaning::Velocity(_) => {
                    let next = self.successor(symbol);
                    self.arena.variable(next)
                }
                Meaning::Parameter(_) => continue,
                _ => {
                    let culprit = self.describe(symbol);
                    errors.push(
                        Diagnostic::new(
                            name.span(),
                            format!("the time derivative of {culprit} is not known"),
                        )
                        .help("`der` can be taken of positions, velocities, time and parameters"),
                    );
                    return None;
                }
            };
            direction.insert(symbol, rate);
        }
        let expr = self.arena.derivative(inner.expr, &direction);
        let dimension = inner.dimension.map(|dimension| dimension.over(Dimension::TIME));
        self.allowed(Typed { expr, dimension }, name, place, errors)
    }

    fn successor(&self, symbol: Symbol) -> Symbol {
        let wanted = match self.meaning(symbol) {
            Meaning::Coordinate(at) => Meaning::Velocity(at),
            Meaning::Velocity(at) => Meaning::Acceleration(at),
            other => other,
        };
        let at = self.meanings.iter().position(|&meaning| meaning == wanted);
        at.and_then(|at| self.arena.symbol_at(at)).unwrap_or(symbol)
    }

    /// `lambda(row)` is the multiplier, `effort(drive)` = −λ what a drive
    /// exerts along its left-hand side.
    fn multiplier(&mut self, name: &Ident, arguments: &[Formula], place: Place) -> Result<Typed, Diagnostic> {
        let [Formula { kind: FormulaKind::Name(row), .. }] = arguments else {
            return Err(Diagnostic::new(name.span(), format!("`{name}` takes the name of a constraint"))
                .help(format!("the constraints are {}", listing(self.rows.keys()))));
        };
        let text = row.to_string();
        let Some(known) = self.rows.get(&text) else {
            let error = Diagnostic::new(row.span(), format!("there is no constraint `{text}`"));
            return Err(match nearest(&text, self.rows.keys().map(String::as_str)) {
                Some(near) => error.help(format!("did you mean `{near}`?")),
                None => error.help(format!("the constraints are {}", listing(self.rows.keys()))),
            });
        };
        if name == "effort" && !known.is_drive {
            return Err(Diagnostic::new(row.span(), format!("`{text}` is a constraint, not a drive"))
                .help(format!("its multiplier is `lambda({text})`")));
        }
        if known.is_broken {
            // fits everywhere: no second error for the same cause
            return Ok(Typed { expr: self.arena.zero(), dimension: None });
        }
        let Some(dimension) = known.dimension else {
            return Err(Diagnostic::new(row.span(), format!("the multiplier of `{text}` cannot stand here"))
                .help(place.rule()));
        };
        if !place.allows(Meaning::Multiplier(known.position)) {
            return Err(Diagnostic::new(
                name.span(),
                format!("the multiplier of `{text}` cannot stand here"),
            )
            .help(place.rule()));
        }
        let multiplier = known.multiplier;
        let lambda = self.arena.variable(multiplier);
        let expr = if name == "effort" { self.arena.neg(lambda) } else { lambda };
        // λᵀΦ is an energy
        let energy = Dimension::of(1, 2, -2);
        Ok(Typed { expr, dimension: Some(energy.over(dimension)) })
    }
}

fn product(l: Typed, r: Typed) -> Option<Dimension> {
    Some(l.dimension?.times(r.dimension?))
}

/// The dimension of f(…), or the error of an argument.
fn function_dimension(
    function: Function,
    name: &Ident,
    arguments: &[Formula],
    values: &[Typed],
) -> Result<Option<Dimension>, Diagnostic> {
    let first = values.first().and_then(|value| value.dimension);
    match function {
        Function::Abs => Ok(first),
        Function::Sign => Ok(Some(Dimension::NONE)),
        Function::Sqrt => match first {
            None => Ok(None),
            Some(dimension) => dimension.power(Number::ratio(1, 2)).map(Some).ok_or_else(|| {
                Diagnostic::new(
                    arguments[0].span,
                    format!("the square root of a {dimension} has no dimension"),
                )
                .help("check the exponents of the argument")
            }),
        },
        Function::Atan2 | Function::Min | Function::Max => {
            let second = values.get(1).and_then(|value| value.dimension);
            if let (Some(a), Some(b)) = (first, second)
                && a != b
            {
                return Err(Diagnostic::new(name.span(), format!("`{name}` compares a {a} with a {b}"))
                    .help("both arguments need the same dimension"));
            }
            let common = first.or(second);
            Ok(if function == Function::Atan2 { Some(Dimension::NONE) } else { common })
        }
        _ => {
            for (argument, value) in arguments.iter().zip(values) {
                if let Some(dimension) = value.dimension.filter(|d| *d != Dimension::NONE) {
                    return Err(Diagnostic::new(
                        argument.span,
                        format!("`{name}` takes an angle or a bare number, but this is a {dimension}"),
                    )
                    .help("divide it by a quantity of the same dimension"));
                }
            }
            Ok(Some(Dimension::NONE))
        }
    }
}

fn unit_help(formula: &Formula, dimension: Dimension) -> String {
    match formula.kind {
        FormulaKind::Number { unit: None, .. } => format!("give the number its unit: {dimension}"),
        _ => "check the units and factors of this formula".to_owned(),
    }
}
