//! `particle bob at rod.tip { mass = m; }`: point masses at places.

use mbs_symbolic::Algebra;
use mbs_symbolic::units::Dimension;
use proc_macro2::{Ident, Span};

use super::Check;
use super::names::{Place, duplicate};
use super::resolver::Resolver;
use crate::diagnostics::{Diagnostic, nearest};
use crate::mechanics::{Particle, Placed};
use crate::syntax::{Attachment, Property};

impl Resolver<'_> {
    pub(super) fn resolve_particle(&mut self, name: &Ident, at: &Attachment, properties: &[Property]) {
        let text = name.to_string();
        let body = self.body_names.get(&text).map(|(_, span)| *span);
        if let Some(earlier) = body.or_else(|| self.particle_names.get(&text).copied()) {
            self.errors.push(duplicate(name, earlier));
            return;
        }
        self.particle_names.insert(text, name.span());
        let mass = self.particle_mass(name, properties);
        // a place that does not exist has its error then
        let Some(Placed { position: place, .. }) = self.scope.attachment(at, &mut self.errors) else {
            return;
        };
        let at = self.scope.on_body(at);
        let local = match &at.point {
            Some(point) => self.scope.local(&at.body, point, &mut self.errors),
            None => Some([self.scope.arena.zero(); 2]),
        };
        let frame = self.scope.frame(&at.body).ok().map(|frame| (frame.origin, frame.angle));
        let (Some(mass), Some(local), Some((origin, angle))) = (mass, local, frame) else { return };
        let frame = Placed { position: origin.into(), angle };
        let particle = Particle { mass, frame, local, place };
        let algebra = Algebra::new(&mut self.scope.arena);
        if !particle.moves(&algebra, &self.scope.motion) {
            let message = format!("`{name}` does not move: no coordinate changes its place");
            let help = "put it on a body that moves, or let the place of its point depend on a `coordinate`";
            self.errors.push(Diagnostic::new(name.span(), message).help(help));
            return;
        }
        self.particles.push(particle);
        self.particle_idents.push(name.clone());
    }

    fn particle_mass(&mut self, name: &Ident, properties: &[Property]) -> Option<mbs_symbolic::Expr> {
        let mut given: Option<Span> = None;
        let mut mass = None;
        for Property { name: property, value } in properties {
            if property != "mass" {
                let help = match (property == "inertia", nearest(&property.to_string(), ["mass"])) {
                    (true, _) => "a particle has no size; what resists turning is a `body`".to_owned(),
                    (false, Some(near)) => format!("did you mean `{near}`?"),
                    (false, None) => "its property is `mass`".to_owned(),
                };
                let message = format!("a particle has no `{property}`");
                self.errors.push(Diagnostic::new(property.span(), message).help(help));
                continue;
            }
            let what = format!("the mass of `{name}`");
            if let Some(earlier) = given.replace(property.span()) {
                self.repeated(&what, property.span(), earlier);
                continue;
            }
            let what = (what.as_str(), Dimension::MASS);
            mass = self.scope.formula_of(value, Place::Property, what, &mut self.errors);
        }
        if given.is_none() {
            let error = Diagnostic::new(name.span(), format!("particle `{name}` has no `mass`"));
            self.errors.push(error.help("add `mass = …;`"));
        }
        let value = mass?;
        self.checks.push(Check {
            value,
            is_strict: false,
            property: "mass",
            owner: name.to_string(),
            span: name.span(),
            zero_help: None,
        });
        Some(value)
    }
}
