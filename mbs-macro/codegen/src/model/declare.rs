//! Names first: what statements declare, before any formula is read.

use mbs_symbolic::units::{Dimension, Unit};
use mbs_symbolic::{Number, Stage};
use proc_macro2::Ident;

use super::known::{Definition, Frame, GROUND, Row, Source, State, Value};
use super::names::duplicate;
use super::resolver::Resolver;
use super::{Block, Body, Coordinate, Direction, Meaning};
use crate::diagnostics::Diagnostic;
use crate::quantity::{Quantity, Setting};
use crate::syntax::{self, Attachment, Formula, FormulaKind, Item, ItemKind, Role, UnitText};

impl<'a> Resolver<'a> {
    pub(super) fn declare(&mut self, item: &'a Item) {
        match &item.kind {
            ItemKind::Parameter { name, value, .. } => self.declare_parameter(name, value, &item.doc),
            ItemKind::Constant { name, value } => self.declare_definition(name, value, true),
            ItemKind::Let { name, value } | ItemKind::Binding { name, value, .. } => {
                self.declare_definition(name, value, false);
            }
            ItemKind::Input { name, unit, .. } => self.declare_input(name, unit, &item.doc),
            ItemKind::Body { name, coordinates, .. } => self.declare_body(name, coordinates),
            ItemKind::Particle { name, at, .. } => {
                self.scope.particles.entry(name.to_string()).or_insert(at);
            }
            ItemKind::Coordinate { name, unit } => {
                let block = Block::Free;
                self.declare_coordinate(name, block, quantity(name, &item.doc, &unit.text, unit.unit));
            }
            _ => {}
        }
    }

    /// Rows and points, once all bodies are known.
    pub(super) fn declare_rows(&mut self, item: &'a Item) {
        match &item.kind {
            ItemKind::Constraint { name, role, .. } => self.declare_row(name, name, *role == Role::Drive),
            ItemKind::Joint(joint) => self.declare_joint(joint),
            ItemKind::Table(table) => self.declare_table(table),
            ItemKind::Point { name, body, value, .. } => {
                self.scope.declare_point(name, body, value, &mut self.errors);
            }
            ItemKind::State { name, unit, .. } => self.declare_state(name, unit, &item.doc),
            ItemKind::Force { name, is_torque, .. } => {
                self.declare_source(name, if *is_torque { "torque" } else { "force" }, None);
            }
            ItemKind::Energy { name, role, .. } => self.declare_source(name, role.word(), None),
            ItemKind::Element(element) => {
                let ends = element.second.clone().map(|second| [element.first.clone(), second]);
                self.declare_source(&element.name, element.kind.word, ends);
                self.declare_bristle(element);
            }
            _ => {}
        }
    }

    /// Memories, which stand behind all inputs.
    pub(super) fn declare_memory(&mut self, item: &'a Item) {
        match &item.kind {
            ItemKind::Memory { name, unit, .. } => {
                self.scope.first_memory = self.scope.first_memory.min(self.inputs.len());
                self.declare_input(name, unit, &item.doc);
            }
            ItemKind::Stop { name, properties, .. } => self.declare_stop(name, properties),
            ItemKind::Mode { name, rows, .. } => self.declare_mode(name, rows, &item.doc),
            ItemKind::When(_) => self.declare_transition(),
            ItemKind::Element(element) => self.declare_friction(element),
            _ => {}
        }
    }

    fn declare_input(&mut self, name: &Ident, unit: &UnitText, doc: &str) {
        let meaning = Meaning::Input(self.inputs.len());
        let symbol = self.scope.symbol(&name.to_string(), Stage::Variable, meaning);
        let dimension = unit.unit.dimension;
        let value = Value::Symbol { symbol, dimension, span: name.span() };
        self.scope.declare(name, value, &mut self.errors);
        let quantity = quantity(name, doc, &unit.text, unit.unit);
        self.inputs.push(Setting { quantity, value: 0.0 });
    }

    /// A second one of the same name is refused when it is resolved.
    pub(super) fn declare_source(&mut self, name: &Ident, word: &'static str, ends: Option<[Attachment; 2]>) {
        let source = Source { word, span: name.span(), ends, work: Vec::new(), exerts: None };
        self.scope.sources.entry(name.to_string()).or_insert(source);
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
        self.parameters.push(Setting { quantity, value: f64::NAN });
    }

    fn declare_definition(&mut self, name: &Ident, formula: &'a Formula, is_constant: bool) {
        let definition = Definition { formula, is_constant, span: name.span(), state: State::Untouched };
        self.scope.declare(name, Value::Definition(definition), &mut self.errors);
    }

    fn declare_body(&mut self, name: &Ident, coordinates: &[syntax::Coordinate]) {
        let text = name.to_string();
        if text == GROUND {
            self.refuse(coordinates);
            self.errors.push(
                Diagnostic::new(name.span(), "`ground` is what does not move and cannot be declared")
                    .help("choose another name for the body"),
            );
            return;
        }
        if let Some((_, earlier)) = self.body_names.get(&text) {
            self.errors.push(duplicate(name, *earlier));
            self.refuse(coordinates);
            return;
        }
        let body = self.bodies.len();
        self.body_names.insert(text.clone(), (body, name.span()));
        let mut positions = Vec::new();
        let mut is_broken = coordinates.is_empty() || coordinates.len() > 3;
        if is_broken {
            self.refuse(coordinates.get(3..).unwrap_or_default());
            self.errors.push(
                Diagnostic::new(name.span(), format!("body `{text}` has {} coordinates", coordinates.len()))
                    .help("a planar body has one to three: x, y and its angle"),
            );
        }
        for (at, coordinate) in coordinates.iter().enumerate().take(3) {
            let result = direction(coordinate, at, coordinates.len());
            let Some(direction) = self.errors.take(result) else {
                self.refuse(&coordinates[at..=at]);
                is_broken = true;
                continue;
            };
            let taken =
                positions.iter().any(|&other: &usize| self.coordinates[other].direction() == Some(direction));
            if taken {
                self.errors.push(
                    Diagnostic::new(
                        coordinate.name.span(),
                        format!("`{}` is a second coordinate in the same direction", coordinate.name),
                    )
                    .help("say which direction each one has: `(x = s, angle = phi)`"),
                );
                self.refuse(&coordinates[at..=at]);
                is_broken = true;
                continue;
            }
            positions.push(self.coordinates.len());
            let (unit, dimension) = match direction {
                Direction::Angle => ("rad", Dimension::NONE),
                Direction::X | Direction::Y => ("m", Dimension::LENGTH),
            };
            let unit = quantity(&coordinate.name, "", unit, Unit { scale: Number::ONE, dimension });
            self.declare_coordinate(&coordinate.name, Block::Line { body, direction }, unit);
        }
        let names = coordinates.iter().map(|coordinate| coordinate.name.to_string()).collect();
        let zero = self.scope.arena.zero();
        let [x, y, angle] = [Direction::X, Direction::Y, Direction::Angle].map(|direction| {
            let coordinate =
                positions.iter().find(|&&at| self.coordinates[at].direction() == Some(direction));
            coordinate.map_or(zero, |&at| self.scope.arena.variable(self.coordinates[at].position))
        });
        let mut frame = Frame::new(names, [x, y], angle);
        frame.is_broken = is_broken;
        self.scope.bodies.insert(text.clone(), frame);
        self.bodies.push(Body {
            name: text,
            span: name.span(),
            coordinates: positions,
            mass: zero,
            inertia: zero,
        });
    }

    /// Enters coordinates that have an error.
    fn refuse(&mut self, coordinates: &[syntax::Coordinate]) {
        for name in coordinates.iter().map(|coordinate| &coordinate.name) {
            self.scope.values.entry(name.to_string()).or_insert(Value::Refused(name.span()));
        }
    }

    fn declare_coordinate(&mut self, name: &Ident, block: Block, quantity: Quantity) {
        let at = self.coordinates.len();
        let text = name.to_string();
        let position = self.scope.symbol(&text, Stage::Variable, Meaning::Coordinate(at));
        let velocity = self.scope.symbol(&format!("der({text})"), Stage::Variable, Meaning::Velocity(at));
        self.scope.motion.add_coordinate(position, velocity);
        self.scope.symbol(&format!("der(der({text}))"), Stage::Variable, Meaning::Acceleration(at));
        let value = Value::Symbol { symbol: position, dimension: quantity.dimension, span: name.span() };
        self.scope.declare(name, value, &mut self.errors);
        self.coordinates.push(Coordinate { quantity, span: name.span(), position, velocity, block });
    }

    /// Enters a row of a joint, or of a constraint of its own.
    pub(super) fn declare_row(&mut self, name: &Ident, owner: &Ident, is_drive: bool) {
        let text = name.to_string();
        if let Some(earlier) = self.scope.rows.get(&text) {
            self.errors.push(duplicate(name, earlier.span));
            return;
        }
        if self.mode_of(&owner.to_string()).is_some() {
            let row = self.declare_lock(name);
            self.scope.rows.insert(text, row);
            return;
        }
        let position = self.row_count;
        self.row_count += 1;
        let multiplier =
            self.scope.symbol(&format!("lambda({text})"), Stage::Variable, Meaning::Multiplier(position));
        self.scope.motion.add_multiplier(multiplier);
        let span = name.span();
        let (dimension, phi, rate, is_broken) = (None, None, None, false);
        let position = Some(position);
        let row = Row { position, is_drive, span, multiplier, dimension, phi, rate, is_broken };
        self.scope.rows.insert(text, row);
    }
}

pub(super) fn quantity(name: &Ident, doc: &str, unit_text: &str, unit: Unit) -> Quantity {
    Quantity {
        name: name.to_string(),
        doc: doc.to_owned(),
        unit: unit_text.to_owned(),
        scale: unit.scale.to_f64(),
        dimension: unit.dimension,
    }
}

/// The unit of a number, also behind a sign; `None` for computed values.
fn literal_unit(formula: &Formula) -> Option<UnitText> {
    match &formula.kind {
        FormulaKind::Number { unit, .. } => unit.clone(),
        FormulaKind::Negative(inner) => literal_unit(inner),
        FormulaKind::WithUnit { unit, .. } => Some(unit.clone()),
        _ => None,
    }
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
    let name = &coordinate.written;
    let suggested = suggested_direction(name);
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
    const ANGLES: &[&str] =
        &["theta", "phi", "psi", "alpha", "beta", "angle", "rot", "θ", "φ", "ϕ", "ψ", "α", "β"];
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
