//! Forces and torques: on a body as vector or torque, or along a coordinate.

use mbs_symbolic::Expr;
use mbs_symbolic::units::Dimension;
use proc_macro2::{Ident, Span};

use super::Load;
use super::names::{Place, duplicate};
use super::resolver::Resolver;
use crate::diagnostics::{Diagnostic, listing, nearest};
use crate::syntax::{self, Attachment};

/// λᵀΦ and Qᵀδq are energies.
const ENERGY: Dimension = Dimension::of(1, 2, -2);

impl Resolver<'_> {
    pub(super) fn resolve_load(
        &mut self,
        name: &Ident,
        is_torque: bool,
        target: &Attachment,
        load: &syntax::Load,
    ) {
        if !self.declare_load(name) {
            return;
        }
        let (body_name, target_text) = (&target.body, target.body.to_string());
        let coordinate = self.coordinates.iter().position(|c| c.quantity.name == target_text);
        let body = self.bodies.iter().position(|body| body.name == target_text);
        match (coordinate, body) {
            (Some(coordinate), _) if target.point.is_none() => {
                self.load_on_coordinate(coordinate, body_name, load);
            }
            (_, Some(body)) => self.load_on_body(body, is_torque, target, load),
            (Some(_), None) => self.errors.push(
                Diagnostic::new(
                    body_name.span(),
                    format!("`{target_text}` is a coordinate and has no points"),
                )
                .help("name the body whose point it is"),
            ),
            _ => {
                let bodies: Vec<_> = self.bodies.iter().map(|body| body.name.clone()).collect();
                let coordinates = self.coordinates.iter().map(|c| c.quantity.name.clone());
                let known: Vec<_> = bodies.into_iter().chain(coordinates).collect();
                let hint = match nearest(&target_text, known.iter().map(String::as_str)) {
                    Some(near) => format!("did you mean `{near}`?"),
                    None => format!("a force acts on one of {}", listing(&known)),
                };
                let message = format!("there is no body or coordinate `{target_text}`");
                self.errors.push(Diagnostic::new(body_name.span(), message).help(hint));
            }
        }
    }

    /// Enters the name of a force, torque or spring; false if it was there.
    pub(super) fn declare_load(&mut self, name: &Ident) -> bool {
        let text = name.to_string();
        if let Some((_, earlier)) = self.load_names.iter().find(|(known, _)| *known == text) {
            self.errors.push(duplicate(name, *earlier));
            return false;
        }
        self.load_names.push((text, name.span()));
        true
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

    fn load_on_body(&mut self, body: usize, is_torque: bool, target: &Attachment, load: &syntax::Load) {
        // A place that does not exist has its error already.
        let Some(placed) = self.scope.attachment(target, &mut self.errors) else { return };
        let name = &target.body;
        match (is_torque, load) {
            (true, syntax::Load::Scalar(formula)) => {
                let what = ("a torque", ENERGY);
                let value = self.scope.formula_of(formula, Place::Load, what, &mut self.errors);
                if let Some(value) = value {
                    self.push_load(body, (placed.angle, "angle"), (value, formula.span), name);
                }
            }
            (false, syntax::Load::Vector(vector)) => {
                let what = ("a force", Dimension::of(1, 1, -2));
                let [x, y] = placed.position;
                for (moved, formula) in [((x, "x coordinate"), &vector.x), ((y, "y coordinate"), &vector.y)] {
                    let value = self.scope.formula_of(formula, Place::Load, what, &mut self.errors);
                    if let Some(value) = value {
                        self.push_load(body, moved, (value, formula.span), name);
                    }
                }
            }
            (true, syntax::Load::Vector(vector)) => self.errors.push(
                Diagnostic::new(vector.span, "a planar torque is a scalar")
                    .help(format!("write `torque … on {name} = …;` with one formula")),
            ),
            (false, syntax::Load::Scalar(formula)) => self.errors.push(
                Diagnostic::new(formula.span, "a force on a body is a vector").help(format!(
                    "write `force … on {name} = (fx, fy);`, or name a coordinate instead of the body"
                )),
            ),
        }
    }

    /// Adds a component F of a load that does the virtual work F δs: the force
    /// F ∂s/∂q along every coordinate q of the body. One that the body cannot
    /// follow is refused unless it is 0, rather than dropped.
    fn push_load(
        &mut self,
        body: usize,
        (moved, what): (Expr, &str),
        (value, span): (Expr, Span),
        name: &Ident,
    ) {
        let mut moves = false;
        for coordinate in self.bodies[body].coordinates.clone() {
            let slope = self.scope.arena.partial(moved, self.coordinates[coordinate].position);
            if !self.scope.arena.is_zero(slope) {
                moves = true;
                let value = self.scope.arena.mul(value, slope);
                self.loads.push(Load { coordinate, value });
            }
        }
        if !moves && !self.scope.arena.is_zero(value) {
            let mend = if what == "angle" {
                "let it act on a body that turns"
            } else {
                "write 0 for this component"
            };
            let message = format!("body `{name}` has no {what}, so this would have no effect");
            self.errors.push(
                Diagnostic::new(span, message).help(format!("{mend}, or give `{name}` the coordinate")),
            );
        }
    }
}
