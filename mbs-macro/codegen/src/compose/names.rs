//! Where names stand in statements: what a statement declares, and every name
//! that it uses. The one place that knows, so that copies of an assembly can be
//! told apart.
//!
//! A new kind of statement needs its arms here.

use proc_macro2::Ident;

use crate::mechanics::joints::POLAR_ANGLE;
use crate::syntax::{
    Attachment, Clause, Condition, Formula, FormulaKind, Item, ItemKind, Load, Outline, Outside, Points, Set,
    Vector,
};

/// Rows of joints are called after them: `pin_x`.
const ROW_SUFFIXES: &[&str] = &["_x", "_y", "_angle", "_normal", "_slip"];

/// A name, or a path such as `leg.crank.tip`, in a statement.
pub enum Mention<'a> {
    Name(&'a mut Ident),
    /// The name in a call: a function of the language, or a table.
    Function(&'a mut Ident),
    /// The body that a point is declared on, and the point.
    Point(&'a mut Ident, &'a mut Ident),
    /// The path of a place; its body, and what leads to it.
    Place(&'a mut Attachment),
    /// A path in a formula, which may turn out to be a plain name.
    Formula(&'a mut FormulaKind),
    /// A coordinate in `start`, and what leads to it.
    Coordinate(&'a mut Vec<Ident>, &'a mut Ident),
}

/// The names that a statement declares for formulas, places and multipliers; of
/// a table, `lift()`.
pub fn declared(item: &Item) -> Vec<String> {
    let plain = |name: &Ident| vec![name.to_string()];
    match &item.kind {
        ItemKind::Parameter { .. }
        | ItemKind::Constant { .. }
        | ItemKind::Input { .. }
        | ItemKind::State { .. }
        | ItemKind::Coordinate { .. }
        | ItemKind::Memory { .. }
        | ItemKind::Mode { .. }
        | ItemKind::Let { .. }
        | ItemKind::Binding { .. } => quantities(item).into_iter().map(ToString::to_string).collect(),
        ItemKind::Constraint { name, .. }
        | ItemKind::Force { name, .. }
        | ItemKind::Energy { name, .. }
        | ItemKind::Particle { name, .. }
        | ItemKind::Event { name, .. }
        | ItemKind::Stop { name, .. }
        | ItemKind::Output { name, .. } => plain(name),
        ItemKind::Element(element) => plain(&element.name),
        ItemKind::Table(table) => vec![format!("{}()", table.name), table.name.to_string()],
        ItemKind::Body { name, .. } => {
            quantities(item).into_iter().chain([name]).map(ToString::to_string).collect()
        }
        ItemKind::Joint(joint) => {
            let rows = ROW_SUFFIXES.iter().map(|suffix| format!("{}{suffix}", joint.name));
            rows.chain([joint.name.to_string()]).collect()
        }
        ItemKind::Dof { .. }
        | ItemKind::Crate { .. }
        | ItemKind::Redundant { .. }
        | ItemKind::States { .. }
        | ItemKind::Limit { .. }
        | ItemKind::Step { .. }
        | ItemKind::Closes { .. }
        | ItemKind::Method { .. }
        | ItemKind::Gradients { .. }
        | ItemKind::Feedback { .. }
        | ItemKind::Gravity { .. }
        | ItemKind::Point { .. }
        | ItemKind::Rate { .. }
        | ItemKind::Every(_)
        | ItemKind::When(_)
        | ItemKind::Set(_)
        | ItemKind::Start { .. }
        | ItemKind::Require { .. }
        | ItemKind::Size { .. }
        | ItemKind::Assembly { .. }
        | ItemKind::Instance { .. } => Vec::new(),
    }
}

/// The names of quantities that a statement declares.
pub fn quantities(item: &Item) -> Vec<&Ident> {
    match &item.kind {
        ItemKind::Parameter { name, .. }
        | ItemKind::Constant { name, .. }
        | ItemKind::Input { name, .. }
        | ItemKind::State { name, .. }
        | ItemKind::Coordinate { name, .. }
        | ItemKind::Memory { name, .. }
        | ItemKind::Mode { name, .. }
        | ItemKind::Let { name, .. }
        | ItemKind::Binding { name, .. } => vec![name],
        ItemKind::Body { coordinates, .. } => coordinates.iter().map(|coordinate| &coordinate.name).collect(),
        _ => Vec::new(),
    }
}

/// Calls `visit` for every name of a statement, declared or used. Words of the
/// language (functions, properties, names of points) are none.
pub fn visit(item: &mut Item, visit: &mut dyn FnMut(Mention<'_>)) {
    match &mut item.kind {
        ItemKind::Parameter { name, value, condition } => {
            visit(Mention::Name(name));
            in_formula(value, visit);
            if let Some(condition) = condition {
                in_condition(condition, visit);
            }
        }
        ItemKind::Constant { name, value }
        | ItemKind::Let { name, value }
        | ItemKind::Energy { name, value, .. }
        | ItemKind::Output { name, value, .. } => {
            visit(Mention::Name(name));
            in_formula(value, visit);
        }
        ItemKind::Binding { name, value, default } => {
            visit(Mention::Name(name));
            in_formula(value, visit);
            in_formula(default, visit);
        }
        ItemKind::Input { name, value, .. }
        | ItemKind::State { name, value, .. }
        | ItemKind::Memory { name, value, .. } => {
            visit(Mention::Name(name));
            value.iter_mut().for_each(|value| in_formula(value, visit));
        }
        ItemKind::Coordinate { name, .. } => visit(Mention::Name(name)),
        ItemKind::Particle { name, at, properties } => {
            visit(Mention::Name(name));
            visit(Mention::Place(at));
            properties.iter_mut().for_each(|property| in_formula(&mut property.value, visit));
        }
        ItemKind::Rate { prefix, state, value } => {
            visit(Mention::Coordinate(prefix, state));
            in_formula(value, visit);
        }
        ItemKind::Every(every) => {
            in_formula(&mut every.period, visit);
            every.offset.iter_mut().for_each(|offset| in_formula(offset, visit));
            every.sets.iter_mut().for_each(|set| in_set(set, visit));
        }
        ItemKind::When(when) => {
            in_condition(&mut when.condition, visit);
            when.sets.iter_mut().for_each(|set| in_set(set, visit));
        }
        ItemKind::Mode { name, value, rows } => {
            visit(Mention::Name(name));
            value.iter_mut().for_each(|value| in_formula(value, visit));
            rows.iter_mut().for_each(|row| visit(Mention::Name(row)));
        }
        ItemKind::Set(set) => in_set(set, visit),
        ItemKind::Require { of, condition } => {
            of.iter_mut().for_each(|name| visit(Mention::Name(name)));
            in_condition(condition, visit);
        }
        ItemKind::Size { of, value, .. } => {
            visit(Mention::Name(of));
            in_formula(value, visit);
        }
        ItemKind::Gravity { value, .. } => in_vector(value, visit),
        ItemKind::Step { value, .. } => in_formula(value, visit),
        ItemKind::Closes { coordinate, from, to, .. } => {
            coordinate.iter_mut().for_each(|name| visit(Mention::Name(name)));
            in_formula(from, visit);
            in_formula(to, visit);
        }
        ItemKind::Feedback { gains, .. } => gains.iter_mut().for_each(|gain| in_formula(gain, visit)),
        ItemKind::Body { name, coordinates, properties } => {
            visit(Mention::Name(name));
            coordinates.iter_mut().for_each(|coordinate| visit(Mention::Name(&mut coordinate.name)));
            properties.iter_mut().for_each(|property| in_formula(&mut property.value, visit));
        }
        ItemKind::Stop { name, condition, properties } => {
            visit(Mention::Name(name));
            in_condition(condition, visit);
            properties.iter_mut().for_each(|property| in_formula(&mut property.value, visit));
        }
        ItemKind::Constraint { name, left, right, .. } | ItemKind::Event { name, left, right, .. } => {
            visit(Mention::Name(name));
            in_formula(left, visit);
            in_formula(right, visit);
        }
        ItemKind::Force { name, target, frame, value, .. } => {
            visit(Mention::Name(name));
            visit(Mention::Place(target));
            frame.iter_mut().for_each(|body| visit(Mention::Name(body)));
            in_load(value, visit);
        }
        ItemKind::Point { name, body, value, outline } => {
            visit(Mention::Point(body, name));
            in_vector(value, visit);
            match &mut **outline {
                Outline::Point => {}
                Outline::Circle { radius } | Outline::Bore { radius } => in_formula(radius, visit),
                Outline::Line { along } => in_vector(along, visit),
                Outline::Slot { along, width } => {
                    in_vector(along, visit);
                    in_formula(width, visit);
                }
                Outline::Segment { to, radius } => {
                    in_vector(to, visit);
                    radius.iter_mut().for_each(|radius| in_formula(radius, visit));
                }
                Outline::Arc { radius, from, to } => {
                    [radius, from, to].into_iter().for_each(|formula| in_formula(formula, visit));
                }
                Outline::Polygon { to, radius } => {
                    to.iter_mut().for_each(|corner| in_vector(corner, visit));
                    radius.iter_mut().for_each(|radius| in_formula(radius, visit));
                }
            }
        }
        ItemKind::Joint(joint) => {
            visit(Mention::Name(&mut joint.name));
            visit(Mention::Place(&mut joint.first));
            visit(Mention::Place(&mut joint.second));
            for clause in &mut joint.clauses {
                match clause {
                    Clause::Along(value) | Clause::Radii(value) | Clause::Teeth(value) => {
                        in_vector(value, visit)
                    }
                    Clause::Angle(value)
                    | Clause::Place(value)
                    | Clause::Distance(value)
                    | Clause::Radius(value) => in_formula(value, visit),
                    Clause::Profile(value) => {
                        in_formula(value, &mut beside(|name| name == POLAR_ANGLE, visit));
                    }
                    Clause::Carrier(body) => visit(Mention::Name(body)),
                }
            }
        }
        ItemKind::Table(table) => {
            visit(Mention::Name(&mut table.name));
            match &mut table.points {
                Points::Curve(points, outside) => {
                    points.iter_mut().for_each(|point| in_vector(point, visit));
                    if let Outside::After(period) = outside {
                        in_formula(period, visit);
                    }
                }
                Points::Grid(points, _) => {
                    points.iter_mut().flatten().for_each(|number| in_formula(number, visit));
                }
            }
        }
        ItemKind::Element(element) => {
            visit(Mention::Name(&mut element.name));
            visit(Mention::Place(&mut element.first));
            element.second.iter_mut().for_each(|second| visit(Mention::Place(second)));
            element.along.iter_mut().for_each(|along| in_vector(along, visit));
            let known = element.kind.knows;
            let mut visit = beside(|name| known.iter().any(|known| name == known.name), visit);
            element.properties.iter_mut().for_each(|property| in_load(&mut property.value, &mut visit));
        }
        ItemKind::Start { entries, .. } => {
            for entry in entries {
                visit(Mention::Coordinate(&mut entry.prefix, &mut entry.coordinate));
                in_formula(&mut entry.value, visit);
            }
        }
        ItemKind::Instance { bindings, .. } => {
            bindings.iter_mut().for_each(|binding| in_formula(&mut binding.value, visit));
        }
        ItemKind::Dof { .. }
        | ItemKind::Crate { .. }
        | ItemKind::Redundant { .. }
        | ItemKind::States { .. }
        | ItemKind::Limit { .. }
        | ItemKind::Method { .. }
        | ItemKind::Gradients { .. }
        | ItemKind::Assembly { .. } => {}
    }
}

/// The names beside those that a formula knows by where it stands.
fn beside(is_known: impl Fn(&Ident) -> bool, visit: &mut dyn FnMut(Mention<'_>)) -> impl FnMut(Mention<'_>) {
    move |mention| match mention {
        Mention::Formula(FormulaKind::Name(name)) if is_known(name) => {}
        other => visit(other),
    }
}

fn in_set(set: &mut Set, visit: &mut dyn FnMut(Mention<'_>)) {
    visit(Mention::Coordinate(&mut set.prefix, &mut set.memory));
    in_formula(&mut set.value, visit);
}

fn in_condition(condition: &mut Condition, visit: &mut dyn FnMut(Mention<'_>)) {
    in_formula(&mut condition.left, visit);
    in_formula(&mut condition.right, visit);
}

fn in_load(load: &mut Load, visit: &mut dyn FnMut(Mention<'_>)) {
    match load {
        Load::Scalar(value) => in_formula(value, visit),
        Load::Vector(value) => in_vector(value, visit),
    }
}

fn in_vector(vector: &mut Vector, visit: &mut dyn FnMut(Mention<'_>)) {
    in_formula(&mut vector.x, visit);
    in_formula(&mut vector.y, visit);
}

fn in_formula(formula: &mut Formula, visit: &mut dyn FnMut(Mention<'_>)) {
    match &mut formula.kind {
        FormulaKind::Number { .. } => {}
        kind @ (FormulaKind::Name(_) | FormulaKind::Member(_)) => visit(Mention::Formula(kind)),
        FormulaKind::Negative(inner)
        | FormulaKind::WithUnit { inner, .. }
        | FormulaKind::Component { call: inner, .. } => in_formula(inner, visit),
        FormulaKind::Chain { first, rest } => {
            in_formula(first, visit);
            rest.iter_mut().for_each(|operation| in_formula(&mut operation.operand, visit));
        }
        FormulaKind::Power { base, exponent, .. } => {
            in_formula(base, visit);
            in_formula(exponent, visit);
        }
        FormulaKind::Choice(choice) => {
            choice.test.formulas_mut().into_iter().for_each(|compared| in_formula(compared, visit));
            in_formula(&mut choice.value, visit);
            in_formula(&mut choice.otherwise, visit);
        }
        FormulaKind::Call { function, arguments } => {
            visit(Mention::Function(function));
            arguments.iter_mut().for_each(|argument| in_formula(argument, visit));
        }
    }
}
