//! Force elements, a file each: their properties as a table, and the forces
//! that come of them.
//!
//! A new element is such a file, a row in `syntax/elements.rs` and two lines
//! here.

mod drag;
mod friction;
mod motor;
mod spring;

use std::collections::BTreeMap;

use mbs_symbolic::Expr;
use mbs_symbolic::units::Dimension;
use proc_macro2::{Ident, Span};

use super::Check;
use super::hints::in_radians;
use super::names::Place;
use super::resolver::Resolver;
use crate::diagnostics::{Diagnostic, listing, nearest};
use crate::mechanics::Placed;
use crate::syntax::{Element, ElementKind, ElementProperty, Formula, Load};

const FORCE: Dimension = Dimension::of(1, 1, -2);
const TORQUE: Dimension = Dimension::of(1, 2, -2);
const RATE: Dimension = Dimension::of(0, 0, -1);
const SPEED: Dimension = Dimension::of(0, 1, -1);

/// What is known of a property.
struct Property {
    name: &'static str,
    dimension: Dimension,
    /// What it may depend on.
    place: Place,
    range: Range,
    is_vector: bool,
}

/// The values that make sense.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Range {
    All,
    NotNegative,
    Positive,
}

impl Property {
    /// A value that may change with the motion.
    const fn varying(name: &'static str, dimension: Dimension) -> Self {
        Self { name, dimension, place: Place::Load, range: Range::All, is_vector: false }
    }

    /// A value in parameters and constants.
    const fn fixed(name: &'static str, dimension: Dimension) -> Self {
        Self { place: Place::Property, ..Self::varying(name, dimension) }
    }

    const fn not_negative(self) -> Self {
        Self { range: Range::NotNegative, ..self }
    }

    const fn positive(self) -> Self {
        Self { range: Range::Positive, ..self }
    }

    const fn vector(self) -> Self {
        Self { is_vector: true, ..self }
    }
}

/// An element with its places found and its properties read.
struct Resolved<'e> {
    element: &'e Element,
    first: Placed,
    /// The first again where there is no second.
    second: Placed,
    /// Components by name: one of a scalar, two of a vector.
    values: BTreeMap<String, Vec<Expr>>,
}

impl Resolved<'_> {
    fn has(&self, property: &str) -> bool {
        self.values.contains_key(property)
    }

    fn vector(&self, property: &str) -> Option<[Expr; 2]> {
        self.values.get(property)?.as_slice().try_into().ok()
    }

    fn get(&self, property: &str) -> Option<Expr> {
        self.values.get(property)?.first().copied()
    }
}

fn properties(kind: ElementKind) -> &'static [Property] {
    match kind {
        ElementKind::Spring => spring::LINEAR,
        ElementKind::TorsionSpring => spring::TORSIONAL,
        ElementKind::Motor => motor::PROPERTIES,
        ElementKind::Friction => friction::SLIDING,
        ElementKind::TorsionFriction => friction::TURNING,
        ElementKind::Drag => drag::PROPERTIES,
    }
}

/// Whether all properties are given that the element needs.
fn is_said(element: &Element, given: &BTreeMap<String, Span>) -> Result<(), Diagnostic> {
    match element.kind {
        ElementKind::Spring => spring::is_said(element, given, "length"),
        ElementKind::TorsionSpring => spring::is_said(element, given, "angle"),
        ElementKind::Motor => motor::is_said(element, given),
        ElementKind::Friction => friction::is_said(element, given, &["coefficient", "normal"]),
        ElementKind::TorsionFriction => {
            friction::is_said(element, given, &["coefficient", "normal", "radius"])
        }
        ElementKind::Drag => drag::is_said(element, given),
    }
}

/// The first of several properties that is not given.
fn all_said(
    element: &Element,
    given: &BTreeMap<String, Span>,
    needed: &[&str],
    example: &str,
) -> Result<(), Diagnostic> {
    match needed.iter().find(|name| !given.contains_key(**name)) {
        Some(name) => Err(missing(element, &format!("`{name}`"), example)),
        None => Ok(()),
    }
}

impl Resolver<'_> {
    pub(super) fn resolve_element(&mut self, element: &Element) {
        if !self.declare_load(&element.name) {
            return;
        }
        let first = self.scope.attachment(&element.first, &mut self.errors);
        let second = match &element.second {
            Some(second) => self.scope.attachment(second, &mut self.errors),
            None => first,
        };
        let Some(values) = self.element_properties(element) else { return };
        let (Some(first), Some(second)) = (first, second) else { return };
        let resolved = Resolved { element, first, second, values };
        match element.kind {
            ElementKind::Spring | ElementKind::TorsionSpring => self.resolve_spring(&resolved),
            ElementKind::Motor => self.resolve_motor(&resolved),
            ElementKind::Friction | ElementKind::TorsionFriction => self.resolve_friction(&resolved),
            ElementKind::Drag => self.resolve_drag(&resolved),
        }
    }

    fn element_properties(&mut self, element: &Element) -> Option<BTreeMap<String, Vec<Expr>>> {
        let known = properties(element.kind);
        let mut values = BTreeMap::new();
        let mut given: BTreeMap<String, Span> = BTreeMap::new();
        let mut is_complete = true;
        for property in &element.properties {
            let text = property.name.to_string();
            let what = format!("the {text} of `{}`", element.name);
            if let Some(earlier) = given.insert(text.clone(), property.name.span()) {
                self.repeated(&what, property.name.span(), earlier);
                is_complete = false;
                continue;
            }
            let Some(row) = known.iter().find(|row| row.name == text) else {
                self.errors.push(unknown_property(element.kind, &property.name));
                is_complete = false;
                continue;
            };
            match self.property_value(element, row, property) {
                Some(value) => drop(values.insert(text, value)),
                None => is_complete = false,
            }
        }
        if is_complete {
            let said = is_said(element, &given);
            self.errors.take(said);
        }
        is_complete.then_some(values)
    }

    fn property_value(
        &mut self,
        element: &Element,
        row: &Property,
        property: &ElementProperty,
    ) -> Option<Vec<Expr>> {
        let what = format!("the {} of `{}`", row.name, element.name);
        let formulas: Vec<&Formula> = match (&property.value, row.is_vector) {
            (Load::Scalar(formula), false) => vec![formula],
            (Load::Vector(vector), true) => vec![&vector.x, &vector.y],
            (Load::Scalar(formula), true) => {
                let help = format!("write `{} = (…, …);`", row.name);
                self.errors.push(Diagnostic::new(formula.span, format!("{what} is a vector")).help(help));
                return None;
            }
            (Load::Vector(vector), false) => {
                let help = format!("write one formula: `{} = …;`", row.name);
                self.errors.push(Diagnostic::new(vector.span, format!("{what} is a scalar")).help(help));
                return None;
            }
        };
        let mut read = |formula: &Formula| {
            if row.name == "angle" {
                self.errors.take(in_radians(formula))?;
            }
            self.scope.formula_of(formula, row.place, (&what, row.dimension), &mut self.errors)
        };
        let values: Option<Vec<Expr>> = formulas.iter().map(|formula| read(formula)).collect();
        let values = values?;
        if let (true, [value]) = (row.range != Range::All, values.as_slice()) {
            self.checks.push(Check {
                value: *value,
                is_strict: row.range == Range::Positive,
                property: row.name,
                owner: element.name.to_string(),
                span: property.name.span(),
                zero_help: None,
            });
        }
        Some(values)
    }

    /// The value of a property, or 0 if it was left out.
    fn value_or_zero(&self, resolved: &Resolved<'_>, property: &str) -> Expr {
        resolved.get(property).unwrap_or(self.scope.arena.zero())
    }

    /// Refuses an element of which nothing moves.
    fn check_motion(&mut self, element: &Element, moved: &[Expr], help: &str) -> bool {
        let moves = moved.iter().any(|&moved| self.depends_on_coordinates(moved));
        if !moves {
            let what = if element.second.is_some() { "connects nothing" } else { "acts on nothing" };
            let message = format!("`{}` {what} that moves", element.name);
            self.errors.push(Diagnostic::new(element.name.span(), message).help(help));
        }
        moves
    }
}

/// The error for properties that are needed.
fn missing(element: &Element, what: &str, example: &str) -> Diagnostic {
    Diagnostic::new(element.name.span(), format!("`{}` does not say its {what}", element.name))
        .help(format!("as in `{example}`"))
}

fn unknown_property(kind: ElementKind, name: &Ident) -> Diagnostic {
    let names: Vec<_> = properties(kind).iter().map(|row| row.name).collect();
    let error = Diagnostic::new(name.span(), format!("a {} has no `{name}`", kind.word()));
    match nearest(&name.to_string(), names.iter().copied()) {
        Some(near) => error.help(format!("did you mean `{near}`?")),
        None => error.help(format!("its properties are {}", listing(names))),
    }
}
