//! Statements to model: one function per kind of statement.

use mbs_symbolic::units::{Dimension, Unit};
use mbs_symbolic::{Expr, Number, Stage};
use proc_macro2::{Ident, Span};
use quote::quote;

use super::names::{Definition, Place, Row, Scope, State, Value, duplicate};
use super::{
    Body, Constraint, Coordinate, Direction, Load, Meaning, Model, Output, Parameter, Quantity, Requirement,
    Start, Symbols,
};
use crate::diagnostics::{Diagnostic, Diagnostics, listing, nearest};
use crate::syntax::{self, Comparison, Declaration, Formula, FormulaKind, Item, ItemKind};

const ENERGY: Dimension = Dimension::of(1, 2, -2);

/// Resolves names and checks dimensions.
///
/// # Errors
/// All of them, as far as they do not follow from each other.
pub fn resolve(declaration: &Declaration) -> Result<Model, Diagnostics> {
    let mut resolver = Resolver::new(declaration);
    // Names first, so that statements may stand in any order.
    for item in &declaration.items {
        resolver.declare(item);
    }
    for item in &declaration.items {
        resolver.resolve_constraint(item);
    }
    for item in &declaration.items {
        resolver.resolve_item(item);
    }
    resolver.resolve_rest();
    resolver.finish(declaration)
}

struct Resolver<'a> {
    scope: Scope<'a>,
    errors: Diagnostics,
    mechanism: Span,
    runtime: proc_macro2::TokenStream,
    dof: Option<(i64, Span)>,
    parameters: Vec<Parameter>,
    inputs: Vec<Quantity>,
    coordinates: Vec<Coordinate>,
    bodies: Vec<Body>,
    body_spans: Vec<(String, Span)>,
    constraints: Vec<Constraint>,
    row_count: usize,
    gravity: Option<([Expr; 2], Span)>,
    loads: Vec<Load>,
    load_names: Vec<(String, Span)>,
    start: Option<Span>,
    starts: Vec<Start>,
    outputs: Vec<Output>,
    output_spans: Vec<(String, Span)>,
}

impl<'a> Resolver<'a> {
    fn new(declaration: &Declaration) -> Self {
        Self {
            scope: Scope::new(),
            errors: Diagnostics::default(),
            mechanism: declaration.name.span(),
            runtime: quote!(::mbs_runtime),
            dof: None,
            parameters: Vec::new(),
            inputs: Vec::new(),
            coordinates: Vec::new(),
            bodies: Vec::new(),
            body_spans: Vec::new(),
            constraints: Vec::new(),
            row_count: 0,
            gravity: None,
            loads: Vec::new(),
            load_names: Vec::new(),
            start: None,
            starts: Vec::new(),
            outputs: Vec::new(),
            output_spans: Vec::new(),
        }
    }

    fn declare(&mut self, item: &'a Item) {
        match &item.kind {
            ItemKind::Parameter { name, value, .. } => self.declare_parameter(name, value, &item.doc),
            ItemKind::Constant { name, value } => self.declare_definition(name, value, true),
            ItemKind::Let { name, value } => self.declare_definition(name, value, false),
            ItemKind::Input { name, unit } => {
                let meaning = Meaning::Input(self.inputs.len());
                let symbol = self.scope.symbol(&name.to_string(), Stage::Variable, meaning);
                let dimension = unit.unit.dimension;
                let value = Value::Symbol { symbol, dimension, span: name.span() };
                self.scope.declare(name, value, &mut self.errors);
                self.inputs.push(quantity(name, &item.doc, &unit.text, unit.unit));
            }
            ItemKind::Body { name, coordinates, .. } => self.declare_body(name, coordinates, &item.doc),
            ItemKind::Constraint { name, is_drive, .. } => self.declare_row(name, *is_drive),
            _ => {}
        }
    }

    fn declare_parameter(&mut self, name: &Ident, formula: &'a Formula, doc: &str) {
        let unit = literal_unit(formula);
        let meaning = Meaning::Parameter(self.parameters.len());
        let symbol = self.scope.symbol(&name.to_string(), Stage::Parameter, meaning);
        // The dimension is that of the declared value, which uses constants
        // only and so can be resolved as soon as those are declared.
        let dimension = unit.as_ref().map_or(Dimension::NONE, |unit| unit.unit.dimension);
        let value = Value::Symbol { symbol, dimension, span: name.span() };
        self.scope.declare(name, value, &mut self.errors);
        let (text, unit) = unit.map_or((String::new(), Unit::ONE), |unit| (unit.text, unit.unit));
        let quantity = quantity(name, doc, &text, unit);
        self.parameters.push(Parameter { quantity, symbol, value: f64::NAN, requirement: None });
    }

    fn declare_definition(&mut self, name: &Ident, formula: &'a Formula, is_constant: bool) {
        let definition = Definition { formula, is_constant, span: name.span(), state: State::Untouched };
        self.scope.declare(name, Value::Definition(definition), &mut self.errors);
    }

    fn declare_body(&mut self, name: &Ident, coordinates: &'a [syntax::Coordinate], doc: &str) {
        let text = name.to_string();
        if let Some((_, earlier)) = self.body_spans.iter().find(|(known, _)| *known == text) {
            self.errors.push(duplicate(name, *earlier));
            return;
        }
        self.body_spans.push((text.clone(), name.span()));
        let body = self.bodies.len();
        let mut positions = Vec::new();
        if coordinates.is_empty() || coordinates.len() > 3 {
            self.errors.push(
                Diagnostic::new(name.span(), format!("body `{text}` has {} coordinates", coordinates.len()))
                    .help("a planar body has one to three: x, y and its angle"),
            );
        }
        for (at, coordinate) in coordinates.iter().enumerate().take(3) {
            let result = direction(coordinate, at, coordinates.len());
            let Some(direction) = self.errors.take(result) else { continue };
            let taken = positions.iter().any(|&other: &usize| self.coordinates[other].direction == direction);
            if taken {
                self.errors.push(
                    Diagnostic::new(
                        coordinate.name.span(),
                        format!("`{}` is a second coordinate in the same direction", coordinate.name),
                    )
                    .help("say which direction each one has: `(x = s, angle = phi)`"),
                );
                continue;
            }
            positions.push(self.coordinates.len());
            self.declare_coordinate(&coordinate.name, direction, body);
        }
        let names = coordinates.iter().map(|coordinate| coordinate.name.to_string()).collect();
        self.scope.bodies.insert(text.clone(), names);
        let zero = self.scope.arena.zero();
        self.bodies.push(Body {
            name: text,
            span: name.span(),
            doc: doc.to_owned(),
            coordinates: positions,
            mass: zero,
            inertia: zero,
        });
    }

    fn declare_coordinate(&mut self, name: &Ident, direction: Direction, body: usize) {
        let at = self.coordinates.len();
        let text = name.to_string();
        let position = self.scope.symbol(&text, Stage::Variable, Meaning::Coordinate(at));
        let velocity = self.scope.symbol(&format!("der({text})"), Stage::Variable, Meaning::Velocity(at));
        let acceleration =
            self.scope.symbol(&format!("der(der({text}))"), Stage::Variable, Meaning::Acceleration(at));
        let (unit, dimension) = match direction {
            Direction::Angle => ("rad", Dimension::NONE),
            _ => ("m", Dimension::LENGTH),
        };
        let value = Value::Symbol { symbol: position, dimension, span: name.span() };
        self.scope.declare(name, value, &mut self.errors);
        let quantity = quantity(name, "", unit, Unit { scale: Number::ONE, dimension });
        self.coordinates.push(Coordinate {
            quantity,
            span: name.span(),
            position,
            velocity,
            acceleration,
            body,
            direction,
        });
    }

    fn declare_row(&mut self, name: &Ident, is_drive: bool) {
        let text = name.to_string();
        if let Some(earlier) = self.scope.rows.get(&text) {
            self.errors.push(duplicate(name, earlier.span));
            return;
        }
        let position = self.row_count;
        self.row_count += 1;
        let multiplier =
            self.scope.symbol(&format!("lambda({text})"), Stage::Variable, Meaning::Multiplier(position));
        let span = name.span();
        let row = Row { position, is_drive, span, multiplier, dimension: None, is_broken: false };
        self.scope.rows.insert(text, row);
    }

    fn resolve_constraint(&mut self, item: &Item) {
        let ItemKind::Constraint { name, is_drive, left, equals, right } = &item.kind else { return };
        let l = self.scope.formula(left, Place::Constraint, &mut self.errors);
        let r = self.scope.formula(right, Place::Constraint, &mut self.errors);
        let result = self.equation(name, l, r, *equals);
        let resolved = result.and_then(|result| self.errors.take(result));
        if let Some(row) = self.scope.rows.get_mut(&name.to_string()) {
            row.is_broken = resolved.is_none();
            row.dimension = resolved.map(|(_, dimension)| dimension);
        }
        let Some((phi, dimension)) = resolved else { return };
        let (name, span, doc) = (name.to_string(), name.span(), item.doc.clone());
        self.constraints.push(Constraint { name, doc, span, is_drive: *is_drive, phi, dimension });
    }

    /// Φ = left − right with its dimension.
    fn equation(
        &mut self,
        name: &Ident,
        left: Option<super::names::Typed>,
        right: Option<super::names::Typed>,
        equals: Span,
    ) -> Option<Result<(Expr, Dimension), Diagnostic>> {
        let (left, right) = (left?, right?);
        if let (Some(a), Some(b)) = (left.dimension, right.dimension)
            && a != b
        {
            return Some(Err(Diagnostic::new(
                equals,
                format!("the left side is a {a}, the right side a {b}"),
            )
            .help("both sides of an equation need the same dimension; check units and factors")));
        }
        let phi = self.scope.arena.sub(left.expr, right.expr);
        let depends = self
            .scope
            .arena
            .symbols_in(phi)
            .into_iter()
            .any(|symbol| matches!(self.scope.meaning(symbol), Meaning::Coordinate(_)));
        if !depends {
            return Some(Err(Diagnostic::new(
                name.span(),
                format!("`{name}` does not constrain anything: no coordinate is left in it"),
            )
            .help("write an equation between coordinates, as in `x = l*cos(theta)`")));
        }
        Some(Ok((phi, left.dimension.or(right.dimension).unwrap_or(Dimension::NONE))))
    }

    fn resolve_item(&mut self, item: &'a Item) {
        match &item.kind {
            ItemKind::Dof { keyword, value } => match self.dof {
                Some((_, earlier)) => self.repeated("dof", *keyword, earlier),
                None => self.dof = Some((*value, *keyword)),
            },
            ItemKind::Crate { path, .. } => self.runtime = path.clone(),
            ItemKind::Parameter { name, value, condition } => {
                self.resolve_parameter(name, value, condition.as_ref());
            }
            ItemKind::Gravity { keyword, value } => {
                if let Some((_, earlier)) = self.gravity {
                    self.repeated("gravity", *keyword, earlier);
                    return;
                }
                let what = ("gravity", Dimension::of(0, 1, -2));
                let x = self.scope.formula_of(&value.x, Place::Property, what, &mut self.errors);
                let y = self.scope.formula_of(&value.y, Place::Property, what, &mut self.errors);
                if let (Some(x), Some(y)) = (x, y) {
                    self.gravity = Some(([x, y], *keyword));
                }
            }
            ItemKind::Body { name, properties, .. } => self.resolve_body(name, properties),
            ItemKind::Force { name, is_torque, target, value } => {
                self.resolve_load(name, *is_torque, target, value)
            }
            ItemKind::Start { keyword, entries } => match self.start {
                Some(earlier) => self.repeated("start", *keyword, earlier),
                None => {
                    self.start = Some(*keyword);
                    for entry in entries {
                        self.resolve_start(entry);
                    }
                }
            },
            ItemKind::Output { name, unit, value } => {
                self.resolve_output(name, unit.as_ref(), value, &item.doc)
            }
            _ => {}
        }
    }

    fn repeated(&mut self, what: &str, again: Span, earlier: Span) {
        self.errors.push(
            Diagnostic::new(again, format!("`{what}` is given twice"))
                .note(earlier, format!("`{what}` is first given here"))
                .help("keep one of them"),
        );
    }

    fn resolve_parameter(&mut self, name: &Ident, formula: &Formula, condition: Option<&syntax::Condition>) {
        let text = name.to_string();
        let Some(at) = self.parameters.iter().position(|parameter| parameter.quantity.name == text) else {
            return;
        };
        if let Some(typed) = self.scope.formula(formula, Place::Constant, &mut self.errors) {
            let declared = self.parameters[at].quantity.dimension;
            let found = typed.dimension.unwrap_or(declared);
            let value = self.scope.arena.as_number(typed.expr).map(Number::to_f64);
            match value.filter(|value| value.is_finite()) {
                Some(_) if found != declared => self.errors.push(
                    Diagnostic::new(formula.span, format!("the declared value of `{text}` is a {found}, which has no unit of its own here"))
                        .help("write a number with its unit, as in `param l = 60 [mm];`, or use `const` or `let` for computed values"),
                ),
                Some(value) => self.parameters[at].value = value,
                None => self.errors.push(
                    Diagnostic::new(formula.span, format!("the declared value of `{text}` is not a finite number"))
                        .help("check its divisors and functions"),
                ),
            }
        }
        if let Some(condition) = condition {
            self.parameters[at].requirement = self.requirement(condition);
        }
    }

    fn requirement(&mut self, condition: &syntax::Condition) -> Option<Requirement> {
        let left = self.scope.formula(&condition.left, Place::Property, &mut self.errors);
        let right = self.scope.formula(&condition.right, Place::Property, &mut self.errors);
        let (left, right) = (left?, right?);
        if let (Some(a), Some(b)) = (left.dimension, right.dimension)
            && a != b
        {
            self.errors.push(
                Diagnostic::new(condition.comparison_span, format!("a {a} cannot be compared with a {b}"))
                    .help("give the number its unit, or compare with 0"),
            );
            return None;
        }
        let difference = self.scope.arena.sub(left.expr, right.expr);
        let text = format!("`{}` has to hold", condition.text);
        Some(Requirement {
            difference,
            comparison: condition.comparison,
            text,
            span: condition.comparison_span,
        })
    }

    fn resolve_body(&mut self, name: &Ident, properties: &[syntax::Property]) {
        let Some(at) = self.bodies.iter().position(|body| body.name == name.to_string()) else { return };
        let has = |direction: &dyn Fn(Direction) -> bool| {
            self.bodies[at].coordinates.iter().any(|&c| direction(self.coordinates[c].direction))
        };
        let (moves, turns) = (has(&|d| d != Direction::Angle), has(&|d| d == Direction::Angle));
        let (mut mass, mut inertia): (Option<Span>, Option<Span>) = (None, None);
        for property in properties {
            let (slot, dimension) = match property.name.to_string().as_str() {
                "mass" => (&mut mass, Dimension::MASS),
                "inertia" => (&mut inertia, Dimension::of(1, 2, 0)),
                other => {
                    let hint = nearest(other, ["mass", "inertia"]);
                    self.errors.push(
                        Diagnostic::new(property.name.span(), format!("a body has no `{other}`")).help(
                            hint.map_or("its properties are `mass` and `inertia`".to_owned(), |near| {
                                format!("did you mean `{near}`?")
                            }),
                        ),
                    );
                    continue;
                }
            };
            if let Some(earlier) = slot.replace(property.name.span()) {
                self.errors.push(duplicate(&property.name, earlier));
                continue;
            }
            let what = format!("the {} of `{name}`", property.name);
            let value =
                self.scope.formula_of(&property.value, Place::Property, (&what, dimension), &mut self.errors);
            if let Some(value) = value {
                match dimension {
                    Dimension::MASS => self.bodies[at].mass = value,
                    _ => self.bodies[at].inertia = value,
                }
            }
        }
        for (needed, given, what, coordinate) in
            [(moves, mass, "mass", "a position"), (turns, inertia, "inertia", "an angle")]
        {
            if needed && given.is_none() {
                self.errors.push(
                    Diagnostic::new(name.span(), format!("body `{name}` has {coordinate} but no `{what}`"))
                        .help(format!(
                            "add `{what} = …;` (0 is allowed, if constraints determine the motion)"
                        )),
                );
            }
        }
    }

    fn resolve_load(&mut self, name: &Ident, is_torque: bool, target: &Ident, load: &syntax::Load) {
        let text = name.to_string();
        if let Some((_, earlier)) = self.load_names.iter().find(|(known, _)| *known == text) {
            self.errors.push(duplicate(name, *earlier));
            return;
        }
        self.load_names.push((text, name.span()));
        let target_text = target.to_string();
        let coordinate = self.coordinates.iter().position(|c| c.quantity.name == target_text);
        let body = self.bodies.iter().position(|body| body.name == target_text);
        match (coordinate, body) {
            (Some(coordinate), _) => self.load_on_coordinate(coordinate, target, load),
            (None, Some(body)) => self.load_on_body(body, is_torque, target, load),
            (None, None) => {
                let bodies: Vec<_> = self.bodies.iter().map(|body| body.name.clone()).collect();
                let coordinates = self.coordinates.iter().map(|c| c.quantity.name.clone());
                let known: Vec<_> = bodies.into_iter().chain(coordinates).collect();
                let hint = match nearest(&target_text, known.iter().map(String::as_str)) {
                    Some(near) => format!("did you mean `{near}`?"),
                    None => format!("a force acts on one of {}", listing(&known)),
                };
                self.errors.push(
                    Diagnostic::new(target.span(), format!("there is no body or coordinate `{target_text}`"))
                        .help(hint),
                );
            }
        }
    }

    fn load_on_coordinate(&mut self, coordinate: usize, target: &Ident, load: &syntax::Load) {
        let syntax::Load::Scalar(formula) = load else {
            self.errors.push(
                Diagnostic::new(
                    target.span(),
                    format!("`{target}` is a coordinate, so the force along it is a scalar"),
                )
                .help(format!("write one formula, or name the body of `{target}` to give a vector")),
            );
            return;
        };
        let dimension = ENERGY.over(self.coordinates[coordinate].quantity.dimension);
        let what = format!("the generalized force along `{target}`");
        if let Some(value) = self.scope.formula_of(formula, Place::Load, (&what, dimension), &mut self.errors)
        {
            self.loads.push(Load { coordinate, value });
        }
    }

    fn load_on_body(&mut self, body: usize, is_torque: bool, target: &Ident, load: &syntax::Load) {
        match (is_torque, load) {
            (true, syntax::Load::Scalar(formula)) => {
                let Some(value) =
                    self.scope.formula_of(formula, Place::Load, ("a torque", ENERGY), &mut self.errors)
                else {
                    return;
                };
                self.push_load(body, Direction::Angle, value, target, formula.span);
            }
            (false, syntax::Load::Vector(vector)) => {
                let what = ("a force", Dimension::of(1, 1, -2));
                for (direction, formula) in [(Direction::X, &vector.x), (Direction::Y, &vector.y)] {
                    let value = self.scope.formula_of(formula, Place::Load, what, &mut self.errors);
                    if let Some(value) = value {
                        self.push_load(body, direction, value, target, formula.span);
                    }
                }
            }
            (true, syntax::Load::Vector(vector)) => self.errors.push(
                Diagnostic::new(vector.span, "a planar torque is a scalar")
                    .help(format!("write `torque … on {target} = …;` with one formula")),
            ),
            (false, syntax::Load::Scalar(formula)) => self.errors.push(
                Diagnostic::new(formula.span, "a force on a body is a vector").help(format!(
                    "write `force … on {target} = (fx, fy);`, or name a coordinate instead of the body"
                )),
            ),
        }
    }

    /// Adds a component of a load; one that the body cannot follow is refused
    /// unless it is 0, rather than dropped.
    fn push_load(&mut self, body: usize, direction: Direction, value: Expr, target: &Ident, span: Span) {
        let coordinate = self.bodies[body]
            .coordinates
            .iter()
            .copied()
            .find(|&at| self.coordinates[at].direction == direction);
        match coordinate {
            Some(coordinate) => self.loads.push(Load { coordinate, value }),
            None if self.scope.arena.is_zero(value) => {}
            None => {
                let (what, mend) = match direction {
                    Direction::X => ("x coordinate", "write 0 for this component"),
                    Direction::Y => ("y coordinate", "write 0 for this component"),
                    Direction::Angle => ("angle", "let it act on a body that turns"),
                };
                self.errors.push(
                    Diagnostic::new(
                        span,
                        format!("body `{target}` has no {what}, so this would have no effect"),
                    )
                    .help(format!("{mend}, or give `{target}` the coordinate")),
                );
            }
        }
    }

    fn resolve_start(&mut self, entry: &syntax::StartEntry) {
        let text = entry.coordinate.to_string();
        let Some(coordinate) = self.coordinates.iter().position(|c| c.quantity.name == text) else {
            let names: Vec<_> = self.coordinates.iter().map(|c| c.quantity.name.as_str()).collect();
            let hint = match nearest(&text, names.iter().copied()) {
                Some(near) => format!("did you mean `{near}`?"),
                None => format!("the coordinates are {}", listing(&names)),
            };
            self.errors.push(
                Diagnostic::new(entry.coordinate.span(), format!("there is no coordinate `{text}`"))
                    .help(hint),
            );
            return;
        };
        let earlier = self.starts.iter().find(|s| s.coordinate == coordinate && s.is_rate == entry.is_rate);
        if let Some(earlier) = earlier {
            self.errors.push(duplicate(&entry.coordinate, earlier.span));
            return;
        }
        let dimension = self.coordinates[coordinate].quantity.dimension;
        let dimension = if entry.is_rate { dimension.over(Dimension::TIME) } else { dimension };
        let what = if entry.is_rate {
            format!("the start velocity `der({text})`")
        } else {
            format!("the start of `{text}`")
        };
        let value =
            self.scope.formula_of(&entry.value, Place::Property, (&what, dimension), &mut self.errors);
        if let Some(value) = value {
            let (is_rate, is_guess, span) = (entry.is_rate, entry.is_guess, entry.coordinate.span());
            self.starts.push(Start { coordinate, is_rate, is_guess, value, span });
        }
    }

    fn resolve_output(
        &mut self,
        name: &Ident,
        unit: Option<&syntax::UnitText>,
        formula: &Formula,
        doc: &str,
    ) {
        let text = name.to_string();
        if let Some((_, earlier)) = self.output_spans.iter().find(|(known, _)| *known == text) {
            self.errors.push(duplicate(name, *earlier));
            return;
        }
        self.output_spans.push((text, name.span()));
        let Some(typed) = self.scope.formula(formula, Place::Anywhere, &mut self.errors) else { return };
        let dimension = typed.dimension.unwrap_or(unit.map_or(Dimension::NONE, |unit| unit.unit.dimension));
        if let Some(unit) = unit
            && unit.unit.dimension != dimension
        {
            self.errors.push(
                Diagnostic::new(
                    name.span(),
                    format!(
                        "output `{name}` is a {dimension}, but [{}] is a {}",
                        unit.text, unit.unit.dimension
                    ),
                )
                .help("correct the unit, or leave it out for SI"),
            );
            return;
        }
        let (text, unit) = match unit {
            Some(unit) => (unit.text.clone(), unit.unit),
            None => (si_unit(dimension), Unit { scale: Number::ONE, dimension }),
        };
        let quantity = quantity(name, doc, &text, unit);
        self.outputs.push(Output { quantity, value: typed.expr });
    }

    /// What nothing else has asked for still has to be right.
    fn resolve_rest(&mut self) {
        let untouched: Vec<String> = self
            .scope
            .values
            .iter()
            .filter(|(_, value)| {
                matches!(value, Value::Definition(Definition { state: State::Untouched, .. }))
            })
            .map(|(name, _)| name.clone())
            .collect();
        for name in untouched {
            self.scope.definition(&name, &mut self.errors);
        }
    }

    fn finish(mut self, declaration: &Declaration) -> Result<Model, Diagnostics> {
        if self.coordinates.is_empty() && self.bodies.is_empty() {
            self.errors.push(
                Diagnostic::new(self.mechanism, format!("`{}` has no bodies", declaration.name))
                    .help("declare one: `body bob (x, y) { mass = 1 [kg]; }`"),
            );
        }
        if self.dof.is_none() {
            let left = self.coordinates.len() as i64 - self.row_count as i64;
            self.errors.push(
                Diagnostic::new(
                    self.mechanism,
                    format!("`{}` does not say how many degrees of freedom it has", declaration.name),
                )
                .help(format!(
                    "add `dof = …;` as a contract that is checked ({} coordinates − {} constraints = {left})",
                    self.coordinates.len(),
                    self.row_count
                )),
            );
        }
        let zero = self.scope.arena.zero();
        let symbols = self.generated_symbols();
        let model = Model {
            symbols,
            meanings: self.scope.meanings,
            arena: self.scope.arena,
            doc: declaration.doc.clone(),
            visibility: declaration.visibility.clone(),
            name: declaration.name.clone(),
            runtime: self.runtime,
            dof: self.dof.unwrap_or((0, self.mechanism)),
            parameters: self.parameters,
            inputs: self.inputs,
            coordinates: self.coordinates,
            bodies: self.bodies,
            constraints: self.constraints,
            gravity: self.gravity.map_or([zero; 2], |(gravity, _)| gravity),
            loads: self.loads,
            start: self.starts,
            outputs: self.outputs,
        };
        self.errors.finish(model)
    }

    /// The symbols that the equations need beside the declared ones.
    fn generated_symbols(&mut self) -> Symbols {
        let mut rows: Vec<_> =
            self.scope.rows.iter().map(|(name, row)| (row.position, name.clone(), row.multiplier)).collect();
        rows.sort_by_key(|(position, ..)| *position);
        let feedback = rows
            .iter()
            .map(|(position, name, _)| {
                self.scope.symbol(&format!("feedback({name})"), Stage::Variable, Meaning::Feedback(*position))
            })
            .collect();
        Symbols {
            time: self.scope.time,
            two_alpha: self.scope.symbol("2*alpha", Stage::Variable, Meaning::TwoAlpha),
            beta_squared: self.scope.symbol("beta^2", Stage::Variable, Meaning::BetaSquared),
            multipliers: rows.iter().map(|(_, _, multiplier)| *multiplier).collect(),
            feedback,
        }
    }
}

fn quantity(name: &Ident, doc: &str, unit_text: &str, unit: Unit) -> Quantity {
    Quantity {
        name: name.to_string(),
        doc: doc.to_owned(),
        unit: unit_text.to_owned(),
        scale: unit.scale.to_f64(),
        dimension: unit.dimension,
    }
}

/// The unit of a number, also behind a sign; `None` for computed values.
fn literal_unit(formula: &Formula) -> Option<syntax::UnitText> {
    match &formula.kind {
        FormulaKind::Number { unit, .. } => unit.clone(),
        FormulaKind::Negative(inner) => literal_unit(inner),
        FormulaKind::WithUnit { unit, .. } => Some(unit.clone()),
        _ => None,
    }
}

/// The SI unit in the description of a dimension, `[m/s]`, without brackets.
fn si_unit(dimension: Dimension) -> String {
    let text = dimension.to_string();
    let unit = text.split_once('[').and_then(|(_, rest)| rest.strip_suffix(']'));
    unit.unwrap_or_default().to_owned()
}

/// The direction of a coordinate: written, or that of its place among three,
/// or that which its name suggests.
fn direction(coordinate: &syntax::Coordinate, at: usize, count: usize) -> Result<Direction, Diagnostic> {
    if let Some(word) = &coordinate.direction {
        return match word.to_string().as_str() {
            "x" => Ok(Direction::X),
            "y" => Ok(Direction::Y),
            "angle" => Ok(Direction::Angle),
            other => Err(Diagnostic::new(word.span(), format!("`{other}` is no direction"))
                .help("a coordinate is along `x`, along `y` or an `angle`")),
        };
    }
    let name = coordinate.name.to_string();
    let suggested = suggested_direction(&name);
    let by_place = [Direction::X, Direction::Y, Direction::Angle].get(at).copied().filter(|_| count == 3);
    match (by_place, suggested) {
        (Some(place), Some(name_says)) if place != name_says => Err(Diagnostic::new(
            coordinate.name.span(),
            format!("`{name}` stands where the {} is expected", word(place)),
        )
        .help(format!("the order is (x, y, angle); or write `{} = {name}`", word_in_code(name_says)))),
        (Some(direction), _) | (None, Some(direction)) => Ok(direction),
        (None, None) => {
            Err(Diagnostic::new(coordinate.name.span(), format!("the direction of `{name}` is not clear"))
                .help(format!("write `(x = {name})`, `(y = {name})` or `(angle = {name})`")))
        }
    }
}

fn suggested_direction(name: &str) -> Option<Direction> {
    const ANGLES: &[&str] = &["theta", "phi", "psi", "alpha", "beta", "angle", "rot"];
    match name.chars().next() {
        Some('x') => Some(Direction::X),
        Some('y') => Some(Direction::Y),
        _ => ANGLES.iter().any(|prefix| name.starts_with(prefix)).then_some(Direction::Angle),
    }
}

fn word(direction: Direction) -> &'static str {
    match direction {
        Direction::X => "x coordinate",
        Direction::Y => "y coordinate",
        Direction::Angle => "angle",
    }
}

fn word_in_code(direction: Direction) -> &'static str {
    match direction {
        Direction::X => "x",
        Direction::Y => "y",
        Direction::Angle => "angle",
    }
}

/// Whether `difference` satisfies the comparison with 0.
pub fn holds(difference: f64, comparison: Comparison) -> bool {
    match comparison {
        Comparison::Less => difference < 0.0,
        Comparison::LessOrEqual => difference <= 0.0,
        Comparison::Greater => difference > 0.0,
        Comparison::GreaterOrEqual => difference >= 0.0,
    }
}
