//! Function calls: the elementary ones, `der`, `lambda`, `effort` and `distance`.

use mbs_symbolic::units::Dimension;
use mbs_symbolic::{Algebra, Dimensions, Function, Number, Symbol};
use proc_macro2::Ident;
use rustc_hash::FxHashMap as HashMap;

use super::Meaning;
use super::choices::PIECES;
use super::hints::in_radians;
use super::known::Typed;
use super::measures::MEASURES;
use super::names::{Place, Scope};
use crate::diagnostics::{Diagnostic, Diagnostics, described, listing, nearest};
use crate::mechanics::laws::LAWS;
use crate::syntax::{Attachment, Formula, FormulaKind};

impl Scope<'_> {
    pub(super) fn call(
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
            "distance" => self.distance(name, arguments, place, errors),
            text if MEASURES.contains(&text) => self.measure(name, arguments, place, errors),
            text => {
                if let Some(function) = Function::named(text) {
                    return self.function(function, name, arguments, place, errors);
                }
                if PIECES.contains(&text) {
                    return self.pieces(name, arguments, place, errors);
                }
                if let Some(law) = LAWS.iter().find(|law| law.name == text) {
                    return self.law(law, name, arguments, place, errors);
                }
                if self.tables.contains_key(text) {
                    return self.table(name, arguments, place, errors);
                }
                errors.push(self.unknown_function(name));
                None
            }
        }
    }

    fn unknown_function(&self, name: &Ident) -> Diagnostic {
        let text = name.to_string();
        let known: Vec<&str> = known().chain(self.tables.keys().map(String::as_str)).collect();
        let error = Diagnostic::new(name.span(), format!("there is no function `{text}`"));
        match nearest(&text, known.iter().copied()) {
            _ if self.values.contains_key(&text) => {
                error.help(format!("write a product with `*`: `{text}*(…)`"))
            }
            Some(near) => error.help(format!("did you mean `{near}`?")),
            None => error.help(format!("the functions are {}", listing(known))),
        }
    }

    /// `distance(boom.eye, frame.pin)`: how far two places are apart.
    fn distance(
        &mut self,
        name: &Ident,
        arguments: &[Formula],
        place: Place,
        errors: &mut Diagnostics,
    ) -> Option<Typed> {
        let [first, second] = arguments else {
            let message = format!("`{name}` takes 2 places, not {}", arguments.len());
            errors.push(Diagnostic::new(name.span(), message).help("write `distance(boom.eye, frame.pin)`"));
            return None;
        };
        let mut placed = |formula| match errors.take(attachment(formula)) {
            Some(attachment) => self.attachment(&attachment, errors),
            None => None,
        };
        let (first, second) = (placed(first), placed(second));
        let (first, second) = (first?, second?);
        let algebra = Algebra::new(&mut self.arena);
        let expr = first.on(&algebra).distance_to(second.on(&algebra)).expr();
        self.allowed(Typed { expr, dimension: Some(Dimension::LENGTH) }, name, place, errors)
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
                .help(match (arity, function) {
                    (1, _) => format!("write `{name}(x)`"),
                    (_, Function::Atan2) => format!("write `{name}(y, x)`"),
                    _ => format!("write `{name}(x, y)`"),
                }),
            );
            return None;
        }
        let values: Vec<_> = arguments.iter().map(|argument| self.formula(argument, place, errors)).collect();
        let values: Vec<_> = values.into_iter().collect::<Option<_>>()?;
        let dimension = errors.take(function_dimension(function, name, arguments, &values))?;
        if let (Some(_), [argument]) = (function.row().of_turn, arguments) {
            errors.take(in_radians(argument))?;
        }
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
            [x, y] => self.arena.call2(function, x.expr, y.expr),
            _ => return None,
        };
        let operands: Vec<_> = values.iter().map(|value| value.expr).collect();
        self.finite(Typed { expr, dimension }, &operands, name.span(), errors)
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
        let mut direction = HashMap::default();
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

    /// The symbol with a meaning.
    pub(super) fn symbol_of(&self, wanted: Meaning) -> Option<Symbol> {
        let at = self.meanings.iter().position(|&meaning| meaning == wanted);
        at.and_then(|at| self.arena.symbol_at(at))
    }

    fn successor(&self, symbol: Symbol) -> Symbol {
        let wanted = match self.meaning(symbol) {
            Meaning::Coordinate(at) => Meaning::Velocity(at),
            Meaning::Velocity(at) => Meaning::Acceleration(at),
            other => other,
        };
        self.symbol_of(wanted).unwrap_or(symbol)
    }

    /// `lambda(row)` is the multiplier, `effort(drive)` = −λ what a drive
    /// exerts along its left-hand side.
    fn multiplier(&mut self, name: &Ident, arguments: &[Formula], place: Place) -> Result<Typed, Diagnostic> {
        // `lambda(pin.x)` is `lambda(pin_x)`
        let row = match arguments {
            [Formula { kind: FormulaKind::Name(row), .. }] => Some(row.clone()),
            [Formula { kind: FormulaKind::Member(path), .. }] => match &path[..] {
                [joint, row] => Some(Ident::new(&format!("{joint}_{row}"), joint.span())),
                _ => None,
            },
            _ => None,
        };
        let Some(row) = row else {
            return Err(Diagnostic::new(name.span(), format!("`{name}` takes the name of a constraint"))
                .help(format!("the constraints are {}", listing(self.rows.keys()))));
        };
        let text = row.to_string();
        let Some(known) = self.rows.get(&text) else {
            let rows = self.joints.get(&text).map_or(&[][..], |joint| joint.kind.rows);
            let rows: Vec<String> = rows.iter().map(|row| format!("{text}{}", row.suffix)).collect();
            if let [first, ..] = &rows[..] {
                let message = format!("joint `{text}` has several multipliers: {}", listing(&rows));
                return Err(Diagnostic::new(row.span(), message).help(format!(
                    "the size of its force is `reaction({text})`; one multiplier is `lambda({first})`"
                )));
            }
            if self.stops.contains_key(&text) {
                return Err(Diagnostic::new(row.span(), format!("`{text}` is a stop, not a constraint"))
                    .help(format!("the force with which it bears what rests on it is `force({text})`")));
            }
            let error = Diagnostic::new(row.span(), format!("there is no constraint `{text}`"));
            return Err(match nearest(&text, self.rows.keys().map(String::as_str)) {
                Some(near) => error.help(format!("did you mean `{near}`?")),
                None => error.help(format!("the constraints are {}", listing(self.rows.keys()))),
            });
        };
        if name == "effort" && !known.is_drive {
            let kind = if self.joints.contains_key(&text) { "joint" } else { "constraint" };
            return Err(Diagnostic::new(row.span(), format!("`{text}` is a {kind}, not a drive"))
                .help(format!("its multiplier is `lambda({text})`")));
        }
        let is_allowed = match known.position {
            Some(at) => place.allows(Meaning::Multiplier(at)),
            // a run finds it behind all forces
            None => place == Place::Anywhere,
        };
        if !is_allowed {
            return Err(Diagnostic::new(
                name.span(),
                format!("the multiplier of `{text}` cannot stand here"),
            )
            .help(match known.position {
                Some(_) => place.rule(),
                None => "a run finds the forces of a mode behind all others: ask for them in an `output` or in the condition of a `when`",
            }));
        }
        if known.is_broken {
            // fits everywhere: no second error for the same cause
            return Ok(Typed { expr: self.arena.zero(), dimension: None });
        }
        let Some(dimension) = known.dimension else {
            // a constraint is being resolved, by way of a `let`
            return Err(Diagnostic::new(row.span(), format!("the multiplier of `{text}` cannot stand here"))
                .help(Place::Constraint.rule()));
        };
        let multiplier = known.multiplier;
        let lambda = self.arena.variable(multiplier);
        let expr = if name == "effort" { self.arena.neg(lambda) } else { lambda };
        // λᵀΦ is an energy
        let energy = Dimension::of(1, 2, -2);
        Ok(Typed { expr, dimension: Some(energy.over(dimension)) })
    }
}

/// The functions of the language.
fn known<'a>() -> impl Iterator<Item = &'a str> {
    let elementary = mbs_symbolic::FUNCTIONS.iter().filter(|row| row.is_word).map(|row| row.name);
    elementary
        .chain(PIECES.iter().copied())
        .chain(LAWS.iter().map(|law| law.name))
        .chain(["der", "lambda", "effort", "distance"])
        .chain(MEASURES.iter().copied())
}

/// True if the language has a function of this name.
pub fn is_known(name: &str) -> bool {
    known().any(|known| known == name)
}

/// A formula that names a place.
fn attachment(formula: &Formula) -> Result<Attachment, Diagnostic> {
    match &formula.kind {
        FormulaKind::Name(body) => Ok(Attachment::of_path(body.clone(), Vec::new())),
        FormulaKind::Member(path) if path.len() == 2 => {
            Ok(Attachment::of_path(path[0].clone(), vec![path[1].clone()]))
        }
        _ => Err(Diagnostic::new(formula.span, "this is not a place")
            .help("a place is a body or one of its points, as in `distance(boom.eye, frame)`")),
    }
}

/// The dimension of f(…), or the error of an argument.
fn function_dimension(
    function: Function,
    name: &Ident,
    arguments: &[Formula],
    values: &[Typed],
) -> Result<Option<Dimension>, Diagnostic> {
    let first = values.first().and_then(|value| value.dimension);
    match function.row().dimensions {
        Dimensions::Root => match first {
            None => Ok(None),
            Some(dimension) => dimension.power(Number::ratio(1, 2)).map(Some).ok_or_else(|| {
                Diagnostic::new(
                    arguments[0].span,
                    format!("the square root of {} has no dimension", described(dimension)),
                )
                .help("check the exponents of the argument")
            }),
        },
        lost_or_same @ (Dimensions::Lost | Dimensions::Same) => {
            let second = values.get(1).and_then(|value| value.dimension);
            if let (Some(a), Some(b)) = (first, second)
                && a != b
            {
                return Err(Diagnostic::new(
                    name.span(),
                    format!("`{name}` compares {} with {}", described(a), described(b)),
                )
                .help("both arguments need the same dimension"));
            }
            Ok(if lost_or_same == Dimensions::Lost { Some(Dimension::NONE) } else { first.or(second) })
        }
        Dimensions::None => {
            for (argument, value) in arguments.iter().zip(values) {
                if let Some(dimension) = value.dimension.filter(|d| *d != Dimension::NONE) {
                    return Err(Diagnostic::new(
                        argument.span,
                        format!(
                            "`{name}` takes a bare number or angle, but this is {}",
                            described(dimension)
                        ),
                    )
                    .help("divide it by a quantity of the same dimension"));
                }
            }
            Ok(Some(Dimension::NONE))
        }
    }
}
