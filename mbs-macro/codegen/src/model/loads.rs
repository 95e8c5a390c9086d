//! Forces and torques: on a body as vector or torque, or along a coordinate.

use mbs_symbolic::units::Dimension;
use mbs_symbolic::{Algebra, Expr};
use proc_macro2::{Ident, Span};

use super::ReactiveLoad;
use super::known::{GROUND, Value};
use super::names::{Place, duplicate};
use super::resolver::Resolver;
use crate::diagnostics::{Diagnostic, listing, nearest};
use crate::mechanics::elements::Exerts;
use crate::mechanics::{Applied, Work};
use crate::syntax::{self, Attachment};

/// λᵀΦ and Qᵀδq are energies.
const ENERGY: Dimension = Dimension::of(1, 2, -2);

impl Resolver<'_> {
    pub(super) fn resolve_load(
        &mut self,
        name: &Ident,
        is_torque: bool,
        (target, frame): (&Attachment, Option<&Ident>),
        value: &syntax::Load,
    ) {
        if !self.declare_load(name) {
            return;
        }
        let (body_name, target_text) = (&target.body, target.body.to_string());
        let coordinate = self.coordinate_named(&target_text);
        // a point of the ground may move with a coordinate of its own
        let is_body = self.body_names.contains_key(&target_text);
        let is_particle = target.point.is_none() && self.scope.particles.contains_key(&target_text);
        let is_place = is_body || is_particle || (target_text == GROUND && target.point.is_some());
        match (coordinate, is_place) {
            (Some(coordinate), _) if target.point.is_none() => {
                if let Some(frame) = frame {
                    self.errors.push(no_frame(frame, "a force along a coordinate"));
                    return;
                }
                self.load_on_coordinate(name, coordinate, body_name, value);
            }
            (_, true) => {
                let load = LoadOnBody { name, is_torque, target, frame };
                self.load_on_body(&load, value);
            }
            (Some(_), false) => self.errors.push(
                Diagnostic::new(
                    body_name.span(),
                    format!("`{target_text}` is a coordinate and has no points"),
                )
                .help("name the body whose point it is"),
            ),
            _ if matches!(self.scope.values.get(&target_text), Some(Value::Refused(_))) => {}
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
        if let Some(earlier) = self.load_names.get(&text) {
            self.errors.push(duplicate(name, *earlier));
            return false;
        }
        self.load_names.insert(text, name.span());
        true
    }

    fn load_on_coordinate(&mut self, name: &Ident, coordinate: usize, target: &Ident, load: &syntax::Load) {
        if self.coordinates[coordinate].is_own() {
            let message = format!("`{target}` is a state, along which no force acts");
            let help = format!("what drives it stands in its equation: `der({target}) = …;`");
            self.errors.push(Diagnostic::new(target.span(), message).help(help));
            return;
        }
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
            let one = self.scope.arena.one();
            self.push_work(name, Work { force: value, along: vec![(coordinate, one)] });
            self.exerts(name, Exerts { value, dimension });
        }
    }

    fn load_on_body(&mut self, load: &LoadOnBody<'_>, value: &syntax::Load) {
        // A place that does not exist has its error already.
        let Some(placed) = self.scope.attachment(load.target, &mut self.errors) else { return };
        let name = &load.target.body;
        match (load.is_torque, value) {
            (true, syntax::Load::Scalar(formula)) => {
                if let Some(frame) = load.frame {
                    self.errors.push(no_frame(frame, "a torque"));
                    return;
                }
                let what = ("a torque", ENERGY);
                let value = self.scope.formula_of(formula, Place::Load, what, &mut self.errors);
                if let Some(value) = value {
                    self.push_load(load, (placed.angle, "angle"), (value, formula.span));
                    self.exerts(load.name, Exerts { value, dimension: ENERGY });
                }
            }
            (false, syntax::Load::Vector(vector)) => {
                self.force_on_body(load, placed.position.components(), vector)
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

    fn force_on_body(&mut self, load: &LoadOnBody<'_>, [x, y]: [Expr; 2], vector: &syntax::Vector) {
        let what = ("a force", Dimension::of(1, 1, -2));
        let mut read = |formula| self.scope.formula_of(formula, Place::Load, what, &mut self.errors);
        let (fx, fy) = (read(&vector.x), read(&vector.y));
        let (fx, fy) = match load.frame {
            None => (fx, fy),
            Some(frame) => {
                let angle = self.scope.frame(frame).map(|frame| frame.angle);
                let (Some(angle), Some(fx), Some(fy)) = (self.errors.take(angle), fx, fy) else { return };
                let algebra = Algebra::new(&mut self.scope.arena);
                let [fx, fy] = algebra.vector([fx, fy]).rotated(algebra.scalar(angle)).exprs();
                (Some(fx), Some(fy))
            }
        };
        let components = [((x, "x coordinate"), fx, vector.x.span), ((y, "y coordinate"), fy, vector.y.span)];
        for (moved, value, span) in components {
            if let Some(value) = value {
                self.push_load(load, moved, (value, span));
            }
        }
    }

    /// Adds a component of a load on a body. One that the body cannot follow is
    /// refused unless it is 0, rather than dropped.
    fn push_load(&mut self, load: &LoadOnBody<'_>, (moved, what): (Expr, &str), (value, span): (Expr, Span)) {
        let moves = self.apply(load.name, value, moved);
        let body = load.target.body.to_string();
        if !moves && !self.scope.arena.is_zero(value) && !self.body_names.contains_key(&body) {
            let message = format!("this place has no {what} that moves, so this would have no effect");
            let help = "let it act on a body, or on a point whose place depends on a `coordinate`";
            self.errors.push(Diagnostic::new(span, message).help(help));
        } else if !moves && !self.scope.arena.is_zero(value) {
            let mend = if what == "angle" {
                "let it act on a body that turns"
            } else {
                "write 0 for this component"
            };
            let message = format!("body `{body}` has no {what}, so this would have no effect");
            self.errors.push(
                Diagnostic::new(span, message).help(format!("{mend}, or give `{body}` the coordinate")),
            );
        }
    }

    /// Adds a force F that does the virtual work F δs: F ∂s/∂q along every
    /// coordinate q; false if s depends on none.
    pub(super) fn apply(&mut self, name: &Ident, force: Expr, moved: Expr) -> bool {
        let algebra = Algebra::new(&mut self.scope.arena);
        let work = Work::along(&self.scope.motion, algebra.scalar(force), algebra.scalar(moved));
        let moves = !work.along.is_empty();
        self.push_work(name, work);
        moves
    }

    pub(super) fn push_work(&mut self, name: &Ident, work: Work) {
        let applied = work.applied(&Algebra::new(&mut self.scope.arena), &self.scope.motion);
        self.push_applied(name, applied);
    }

    /// Adds the forces of an element or a stop, the energies that it holds, and the scalar that it exerts.
    pub(super) fn push_forces(
        &mut self,
        name: &Ident,
        applied: Vec<Applied>,
        energies: Vec<Expr>,
        exerts: Option<Exerts>,
    ) {
        for applied in applied {
            self.push_applied(name, applied);
        }
        self.potentials.extend(energies);
        if let Some(exerts) = exerts {
            self.exerts(name, exerts);
        }
    }

    pub(super) fn push_applied(&mut self, name: &Ident, Applied { work, loads }: Applied) {
        match loads {
            Some(loads) => self.loads.extend(loads),
            None => self.reactive_loads.push(ReactiveLoad { work: work.clone(), span: name.span() }),
        }
        if let Some(source) = self.scope.sources.get_mut(&name.to_string()) {
            source.work.push(work);
        }
    }

    /// Notes what scalar an element exerts, for outputs.
    fn exerts(&mut self, name: &Ident, exerts: Exerts) {
        if let Some(source) = self.scope.sources.get_mut(&name.to_string()) {
            source.exerts = Some(exerts);
        }
    }
}

/// A declared force or torque on a body.
struct LoadOnBody<'l> {
    name: &'l Ident,
    is_torque: bool,
    target: &'l Attachment,
    /// The body whose axes a force is given in; those of the ground if left out.
    frame: Option<&'l Ident>,
}

fn no_frame(frame: &Ident, what: &str) -> Diagnostic {
    Diagnostic::new(frame.span(), format!("{what} is the same in every frame"))
        .help(format!("leave `in {frame}` out"))
}
