//! Statements to model: one function per kind of statement.

use mbs_symbolic::units::{Dimension, Unit};
use mbs_symbolic::{Expr, Number};
use proc_macro2::{Ident, Span};

use super::declare::quantity;
use super::known::Typed;
use super::names::{Place, duplicate};
use super::resolver::Resolver;
use super::{Constraint, Direction, Output, Requirement, Source};
use crate::diagnostics::{Diagnostic, described, nearest};
use crate::quantity::Comparison;
use crate::syntax::{self, Formula, FormulaKind, Item, ItemKind, Role};

impl<'a> Resolver<'a> {
    pub(super) fn resolve_places(&mut self, item: &Item) {
        if let ItemKind::Point { name, body, outline, .. } = &item.kind {
            self.scope.local(body, name, &mut self.errors);
            self.resolve_outline(name, body, outline);
        }
    }

    pub(super) fn resolve_constraint(&mut self, item: &Item) {
        if let ItemKind::Joint(joint) = &item.kind {
            return self.resolve_joint(joint, &item.doc);
        }
        if let ItemKind::Stop { name, condition, properties } = &item.kind {
            return self.resolve_stop(name, condition, properties);
        }
        let ItemKind::Constraint { name, role, left, equals, right } = &item.kind else { return };
        if *role == Role::Rate {
            return self.resolve_rate_row(name, (left, *equals, right), &item.doc);
        }
        let resolved = match self.errors.take(prescribes_position(name, *role, left, right)) {
            None => None,
            Some(()) => {
                let l = self.scope.formula(left, Place::Constraint, &mut self.errors);
                let r = self.scope.formula(right, Place::Constraint, &mut self.errors);
                let result = self.equation((name, *role), l, r, *equals);
                result.and_then(|result| self.errors.take(result))
            }
        };
        if let Some(row) = self.scope.rows.get_mut(&name.to_string()) {
            row.is_broken = resolved.is_none();
            row.dimension = resolved.map(|(_, dimension)| dimension);
            row.phi = resolved.map(|(phi, _)| phi);
        }
        let Some((phi, dimension)) = resolved else { return };
        let (name, span, doc) = (name.to_string(), name.span(), item.doc.clone());
        let is_drive = *role == Role::Drive;
        let source = Source { kind: role.word(), name: name.clone(), bodies: None };
        self.push_row(Constraint { name, source, doc, span, is_drive, rate: None, phi, dimension });
    }

    /// Φ = left − right with its dimension.
    fn equation(
        &mut self,
        (name, role): (&Ident, Role),
        left: Option<Typed>,
        right: Option<Typed>,
        equals: Span,
    ) -> Option<Result<(Expr, Dimension), Diagnostic>> {
        let (phi, dimension) = match self.difference(left?, right?, equals) {
            Ok(difference) => difference,
            Err(error) => return Some(Err(error)),
        };
        let coordinates = self.coordinates_in(phi);
        if role == Role::Coupler && coordinates < 2 {
            return Some(Err(Diagnostic::new(
                name.span(),
                format!("`{name}` does not couple anything: it needs two coordinates that move together"),
            )
            .help("write `constraint` or `drive` for an equation of a single coordinate")));
        }
        if coordinates == 0 {
            return Some(Err(Diagnostic::new(
                name.span(),
                format!("`{name}` does not constrain anything: no coordinate is left in it"),
            )
            .help("write an equation between coordinates, as in `x = l*cos(theta)`")));
        }
        Some(Ok((phi, dimension)))
    }

    /// left − right with its dimension.
    pub(super) fn difference(
        &mut self,
        left: Typed,
        right: Typed,
        equals: Span,
    ) -> Result<(Expr, Dimension), Diagnostic> {
        if let (Some(a), Some(b)) = (left.dimension, right.dimension)
            && a != b
        {
            let message = format!("the left side is {}, the right side {}", described(a), described(b));
            return Err(Diagnostic::new(equals, message).help(equation_help(a, b)));
        }
        let difference = self.scope.arena.sub(left.expr, right.expr);
        Ok((difference, left.dimension.or(right.dimension).unwrap_or(Dimension::NONE)))
    }

    pub(super) fn resolve_item(&mut self, item: &'a Item) {
        match &item.kind {
            ItemKind::Dof { keyword, value } => match self.dof {
                Some((_, earlier)) => self.repeated("`dof`", *keyword, earlier),
                None => self.dof = Some((*value, *keyword)),
            },
            ItemKind::Redundant { keyword } => match self.minimum_norm {
                Some(earlier) => self.repeated("`redundant`", *keyword, earlier),
                None => self.minimum_norm = Some(*keyword),
            },
            ItemKind::States { keyword, are_reduced } => self.resolve_states(*keyword, *are_reduced),
            ItemKind::Limit { keyword, limited, value } => self.resolve_limit(*keyword, *limited, *value),
            ItemKind::Step { keyword, value } => self.resolve_step(*keyword, value),
            ItemKind::Closes { keyword, coordinate, from, to } => {
                self.resolve_closes(*keyword, coordinate.as_ref(), from, to);
            }
            ItemKind::Method { keyword, scheme } => self.resolve_method(*keyword, scheme),
            ItemKind::Gradients { keyword } => self.resolve_gradients(*keyword),
            ItemKind::Feedback { keyword, is_held, gains } => {
                self.resolve_feedback(*keyword, *is_held, gains);
            }
            ItemKind::Crate { keyword, path } => match self.runtime {
                Some((_, earlier)) => self.repeated("`crate`", *keyword, earlier),
                None => self.runtime = Some((path.clone(), *keyword)),
            },
            ItemKind::Parameter { name, condition: Some(condition), .. } => {
                self.require(condition, Some(name));
            }
            ItemKind::Gravity { keyword, value } => {
                if let Some((_, earlier)) = self.gravity {
                    self.repeated("`gravity`", *keyword, earlier);
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
            ItemKind::Force { name, is_torque, target, frame, value } => {
                self.resolve_load(name, *is_torque, (target, frame.as_ref()), value);
            }
            ItemKind::Energy { name, role, value } => self.resolve_energy(name, *role, value),
            ItemKind::Element(element) => self.resolve_element(element),
            ItemKind::Require { of, condition } => self.require(condition, of.as_ref()),
            ItemKind::Size { word, of, value } => self.require_size(word, of, value),
            ItemKind::Binding { name, value, default } => self.check_binding(name, value, default),
            ItemKind::State { name, value, .. } => self.resolve_state(name, value.as_ref()),
            ItemKind::Particle { name, at, properties } => self.resolve_particle(name, at, properties),
            ItemKind::Every(every) => self.resolve_every(every),
            ItemKind::Mode { name, value: Some(value), .. } => self.check_mode(name, value.span),
            ItemKind::Set(set) => self.set_outside(set),
            ItemKind::Start { entries, .. } => entries.iter().for_each(|entry| self.resolve_start(entry)),
            _ => {}
        }
    }

    /// Outputs, events and conditions come last: they may ask for everything.
    pub(super) fn resolve_measurement(&mut self, item: &Item) {
        if let ItemKind::When(when) = &item.kind {
            self.resolve_when(when);
        }
        if let ItemKind::Event { name, left, equals, right, crossing } = &item.kind {
            self.resolve_event((name, &item.doc), [left, right], *equals, *crossing);
        }
        if let ItemKind::Output { name, unit, value } = &item.kind {
            self.resolve_output(name, unit.as_ref(), value, &item.doc);
        }
    }

    pub(super) fn repeated(&mut self, what: &str, again: Span, earlier: Span) {
        self.errors.push(
            Diagnostic::new(again, format!("{what} is given twice"))
                .note(earlier, format!("{what} is first given here"))
                .help("keep one of them"),
        );
    }

    /// Adds a condition, of a parameter or else of its left side.
    fn require(&mut self, condition: &syntax::Condition, parameter: Option<&Ident>) {
        let is_used = parameter.is_none_or(|name| self.scope.used.contains(&name.to_string()));
        self.require_of(condition, parameter);
        // a condition on a parameter is no use of it
        if let (Some(name), false) = (parameter, is_used) {
            self.scope.used.remove(&name.to_string());
        }
    }

    fn require_of(&mut self, condition: &syntax::Condition, parameter: Option<&Ident>) {
        let left = self.scope.formula(&condition.left, Place::Property, &mut self.errors);
        let right = self.scope.formula(&condition.right, Place::Property, &mut self.errors);
        let (Some(left), Some(right)) = (left, right) else { return };
        if let (Some(a), Some(b)) = (left.dimension, right.dimension)
            && a != b
        {
            self.errors.push(
                Diagnostic::new(
                    condition.comparison_span,
                    format!("{} cannot be compared with {}", described(a), described(b)),
                )
                .help("give the number its unit, or compare with 0"),
            );
            return;
        }
        let mut value_of = |name| self.scope.formula(&Formula::name(name), Place::Property, &mut self.errors);
        let (name, value) = match parameter.map(|name| (name, value_of(name))) {
            Some((name, Some(value))) => (name.to_string(), value.expr),
            _ => (condition.left_text.clone(), left.expr),
        };
        self.scope.requirements.push(Requirement {
            name,
            value,
            difference: self.scope.arena.sub(left.expr, right.expr),
            comparison: condition.comparison,
            text: format!("`{}` has to hold", condition.text),
            span: condition.comparison_span,
        });
    }

    /// Requires that a length is positive.
    fn require_size(&mut self, word: &str, of: &Ident, size: &Formula) {
        let asked = (&*format!("the {word} of `{of}`"), Dimension::LENGTH);
        let Some(value) = self.scope.formula_of(size, Place::Property, asked, &mut self.errors) else {
            return;
        };
        self.scope.requirements.push(Requirement {
            name: format!("{word} of {of}"),
            value,
            difference: value,
            comparison: Comparison::Greater,
            text: "it has to be positive".into(),
            span: size.span,
        });
    }

    /// Checks that a value bound to a parameter of an assembly has the parameter's dimension.
    fn check_binding(&mut self, name: &Ident, value: &Formula, default: &Formula) {
        let default = self.scope.formula(default, Place::Constant, &mut self.errors);
        let Some(dimension) = default.and_then(|default| default.dimension) else { return };
        let what = format!("the parameter `{name}`");
        self.scope.formula_of(value, Place::Anywhere, (&what, dimension), &mut self.errors);
    }

    fn resolve_body(&mut self, name: &Ident, properties: &[syntax::Property]) {
        let Some(&(at, _)) = self.body_names.get(&name.to_string()) else { return };
        // A second body of the same name has been refused.
        if !self.resolved_bodies.insert(at) {
            return;
        }
        let has = |direction: &dyn Fn(Direction) -> bool| {
            self.bodies[at]
                .coordinates
                .iter()
                .any(|&c| self.coordinates[c].direction().is_some_and(direction))
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
                let what = format!("the {} of `{name}`", property.name);
                self.repeated(&what, property.name.span(), earlier);
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

    fn resolve_output(
        &mut self,
        name: &Ident,
        unit: Option<&syntax::UnitText>,
        formula: &Formula,
        doc: &str,
    ) {
        let text = name.to_string();
        if let Some(earlier) = self.output_names.get(&text) {
            self.errors.push(duplicate(name, *earlier));
            return;
        }
        self.output_names.insert(text, name.span());
        let Some(typed) = self.scope.formula(formula, Place::Anywhere, &mut self.errors) else { return };
        let dimension = typed.dimension.unwrap_or(unit.map_or(Dimension::NONE, |unit| unit.unit.dimension));
        if let Some(unit) = unit
            && unit.unit.dimension != dimension
        {
            self.errors.push(
                Diagnostic::new(
                    name.span(),
                    format!(
                        "output `{name}` is {}, but [{}] is {}",
                        described(dimension),
                        unit.text,
                        described(unit.unit.dimension)
                    ),
                )
                .help("correct the unit, or leave it out for SI"),
            );
            return;
        }
        let (text, unit) = match unit {
            Some(unit) => (unit.text.clone(), unit.unit),
            None => (dimension.si_unit(), Unit { scale: Number::ONE, dimension }),
        };
        let quantity = quantity(name, doc, &text, unit);
        self.outputs.push(Output { quantity, value: typed.expr });
    }
}

/// A drive gives a position over time, whose rate follows.
fn prescribes_position(name: &Ident, role: Role, left: &Formula, right: &Formula) -> Result<(), Diagnostic> {
    let FormulaKind::Call { function, arguments } = &left.kind else { return Ok(()) };
    let [moved] = &arguments[..] else { return Ok(()) };
    if role != Role::Drive || function != "der" {
        return Ok(());
    }
    let moved = moved.path().unwrap_or("…".to_owned());
    let rate = match &right.kind {
        FormulaKind::Number { value, unit: Some(unit) } => format!("{} [{}]", value.to_f64(), unit.text),
        _ => right.path().unwrap_or("rate".to_owned()),
    };
    let message = format!("`{name}` prescribes a rate, where a drive prescribes a position");
    let help = format!(
        "write the position over time, `{moved} = {rate}*t` for a constant rate; a rate of which nothing holds the \
         position is `rate {name}: der({moved}) = …;`"
    );
    Err(Diagnostic::new(function.span(), message).help(help))
}

/// How to mend an equation between different dimensions.
fn equation_help(left: Dimension, right: Dimension) -> &'static str {
    // a rate times t, where the rate is a bare number
    if right == Dimension::TIME && left == Dimension::NONE {
        return "a speed has a unit too: `200 [rpm]` or `20 [rad/s]`, times `t`";
    }
    if right == Dimension::TIME && left == Dimension::LENGTH {
        return "a speed has a unit too: `0.2 [m/s]`, times `t`";
    }
    "both sides of an equation need the same dimension; check units and factors"
}
