//! Forces and torques: on a body as vector or torque, or along a coordinate.

use mbs_symbolic::Expr;
use mbs_symbolic::units::Dimension;
use proc_macro2::{Ident, Span};

use super::names::{Place, duplicate};
use super::resolver::Resolver;
use super::{Direction, Load};
use crate::diagnostics::{Diagnostic, listing, nearest};
use crate::syntax;

/// λᵀΦ and Qᵀδq are energies.
const ENERGY: Dimension = Dimension::of(1, 2, -2);

impl Resolver<'_> {
    pub(super) fn resolve_load(
        &mut self,
        name: &Ident,
        is_torque: bool,
        target: &Ident,
        load: &syntax::Load,
    ) {
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
}
