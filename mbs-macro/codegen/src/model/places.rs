//! Points on bodies, and what a formula or a joint can say of them.

use mbs_symbolic::units::Dimension;
use mbs_symbolic::{Algebra, Expr, Node};
use proc_macro2::{Ident, Span};

use super::known::{Frame, Local, Point, Typed};
use super::names::{Place, Scope, duplicate};
use crate::diagnostics::{Diagnostic, Diagnostics, listing, nearest};
use crate::mechanics::Placed;
use crate::syntax::{Attachment, Vector};

/// Words behind a dot that are no points.
const MEMBERS: &[&str] = &["x", "y", "angle"];

/// Points may build on each other this deep.
const DEEPEST: usize = 128;

impl<'a> Scope<'a> {
    /// Enters the name of a point.
    pub fn declare_point(&mut self, name: &Ident, body: &Ident, place: &'a Vector, errors: &mut Diagnostics) {
        let text = name.to_string();
        if MEMBERS.contains(&text.as_str()) {
            errors.push(
                Diagnostic::new(
                    name.span(),
                    format!("`{text}` is a word of the language and cannot be declared"),
                )
                .help("choose another name"),
            );
            return;
        }
        let Some(frame) =
            errors.take(self.frame(body).map(|_| ())).and_then(|()| self.bodies.get_mut(&body.to_string()))
        else {
            return;
        };
        match frame.points.get(&text) {
            Some(earlier) => errors.push(duplicate(name, earlier.span)),
            None => {
                let point = Point { span: name.span(), place, local: Local::Untouched, outline: None };
                frame.points.insert(text, point);
            }
        }
    }

    /// Where a point is on its body, read when it is first needed: it may build on other points. `None` if there
    /// is none, or if it has errors, which are added or were.
    pub fn local(&mut self, body: &Ident, name: &Ident, errors: &mut Diagnostics) -> Option<[Expr; 2]> {
        let depth = self.depth;
        let point = self.point(body, name)?;
        match point.local {
            Local::Done(local) => Some(local),
            Local::Failed => None,
            Local::Open => {
                let error =
                    Diagnostic::new(name.span(), format!("the point `{body}.{name}` builds on itself"))
                        .note(point.span, format!("`{name}` is declared here"));
                errors.push(error.help("break the circle: give one of the points a place of its own"));
                None
            }
            Local::Untouched if depth > DEEPEST => {
                let message =
                    format!("`{body}.{name}` builds on more than {DEEPEST} names, one on the other");
                let help = "declare points behind those that they build on";
                errors.push(Diagnostic::new(name.span(), message).help(help));
                None
            }
            Local::Untouched => {
                point.local = Local::Open;
                let place = point.place;
                let what = ("the place of a point", Dimension::LENGTH);
                // a point means the same wherever it is used
                let locals = std::mem::take(&mut self.locals);
                self.depth += 1;
                let x = self.formula_of(&place.x, Place::Point, what, errors);
                let y = self.formula_of(&place.y, Place::Point, what, errors);
                self.depth -= 1;
                self.locals = locals;
                let local = x.zip(y).map(|(x, y)| [x, y]);
                self.point(body, name)?.local = local.map_or(Local::Failed, Local::Done);
                local
            }
        }
    }

    fn point(&mut self, body: &Ident, name: &Ident) -> Option<&mut Point<'a>> {
        self.bodies.get_mut(&body.to_string())?.points.get_mut(&name.to_string())
    }

    /// The body called `name`.
    pub(super) fn frame(&self, name: &Ident) -> Result<&Frame<'a>, Diagnostic> {
        let text = name.to_string();
        self.bodies.get(&text).ok_or_else(|| {
            let error = Diagnostic::new(name.span(), format!("there is no body `{text}`"));
            // a point by itself, without the body that it is on
            let on = self.bodies.iter().filter(|(_, frame)| frame.points.contains_key(&text));
            let points: Vec<String> = on.map(|(body, _)| format!("{body}.{text}")).collect();
            if !points.is_empty() {
                return error.help(format!("a point is written with its body: {}", listing(&points)));
            }
            match nearest(&text, self.bodies.keys().map(String::as_str)) {
                Some(near) => error.help(format!("did you mean `{near}`?")),
                None => error.help(format!("the bodies are {}", listing(self.bodies.keys()))),
            }
        })
    }

    /// The same place by its body, where it is that of a particle.
    pub fn on_body<'b>(&self, attachment: &'b Attachment) -> &'b Attachment
    where
        'a: 'b,
    {
        let name = attachment.body.to_string();
        match self.particles.get(&name) {
            Some(at) if attachment.point.is_none() && !self.bodies.contains_key(&name) => at,
            _ => attachment,
        }
    }

    /// A place on a body; `None` if it has errors, which are added or were.
    pub fn attachment(&mut self, attachment: &Attachment, errors: &mut Diagnostics) -> Option<Placed> {
        let attachment = self.on_body(attachment);
        let frame = errors.take(self.frame(&attachment.body))?;
        let origin = Placed { position: frame.origin.into(), angle: frame.angle };
        if frame.is_broken {
            return None;
        }
        let Some(name) = &attachment.point else { return Some(origin) };
        if !frame.points.contains_key(&name.to_string()) {
            errors.push(self.unknown_point(&attachment.body, name, frame));
            return None;
        }
        let local = self.local(&attachment.body, name, errors)?;
        let algebra = Algebra::new(&mut self.arena);
        Some(origin.on(&algebra).point(algebra.vector(local)).exprs())
    }

    /// The coordinate of a body that is called or meant by this name.
    fn coordinate_at(&self, frame: &Frame<'_>, name: &str) -> Option<String> {
        if let Some(known) = frame.coordinates.iter().find(|known| *known == name) {
            return Some(known.clone());
        }
        let expr = match name {
            "x" => frame.origin[0],
            "y" => frame.origin[1],
            "angle" => frame.angle,
            _ => return None,
        };
        match self.arena.node(expr) {
            Node::Symbol(symbol) => Some(self.arena.name(*symbol).to_owned()),
            _ => None,
        }
    }

    fn unknown_point(&self, body: &Ident, name: &Ident, frame: &Frame<'_>) -> Diagnostic {
        let error = Diagnostic::new(name.span(), format!("body `{body}` has no point `{name}`"));
        let text = name.to_string();
        if let Some(coordinate) = self.coordinate_at(frame, &text) {
            let message = format!("`{body}.{name}` is a coordinate, where a place is expected");
            return Diagnostic::new(name.span(), message).help(format!(
                "a force along it is written `on {coordinate}`; a place is `{body}` or one of its points"
            ));
        }
        if MEMBERS.contains(&text.as_str()) {
            let what = if text == "angle" { "angle" } else { &format!("{text} coordinate") };
            return Diagnostic::new(name.span(), format!("body `{body}` has no {what}"))
                .help(format!("its coordinates are {}", listing(&frame.coordinates)));
        }
        let others = self.bodies.iter().filter_map(|(other, frame)| Some((other, frame.points.get(&text)?)));
        let others: Vec<_> = others.collect();
        if let [(_, point), ..] = others.as_slice() {
            let owners = listing(others.iter().map(|(owner, _)| owner));
            return error.note(point.span, format!("`{name}` is declared here")).help(format!(
                "`{name}` is a point of {owners}; name that body, or correct on which body the point is declared"
            ));
        }
        match nearest(&name.to_string(), frame.points.keys().map(String::as_str)) {
            Some(near) => error.help(format!("did you mean `{near}`?")),
            None => error.help(format!("declare it: `point {name} on {body} = (…, …);`")),
        }
    }

    /// `crank.x`, `crank.angle`, `crank.tip.y`.
    pub fn member(&mut self, path: &[Ident], place: Place, errors: &mut Diagnostics) -> Option<Typed> {
        let (attachment, member) = match path {
            [body, member] => (Attachment::of_path(body.clone(), Vec::new()), member),
            [body, point, member] => (Attachment::of_path(body.clone(), vec![point.clone()]), member),
            _ => {
                let span = path.last().map_or(Span::call_site(), Ident::span);
                errors.push(
                    Diagnostic::new(span, "this path is too long").help("write `body.x` or `body.point.x`"),
                );
                return None;
            }
        };
        let placed = self.attachment(&attachment, errors)?;
        let (expr, dimension) = match member.to_string().as_str() {
            "x" => (placed.position.x, Dimension::LENGTH),
            "y" => (placed.position.y, Dimension::LENGTH),
            "angle" => (placed.angle, Dimension::NONE),
            _ => {
                let last = path.len() == 2
                    && self
                        .frame(&attachment.body)
                        .is_ok_and(|frame| frame.points.contains_key(&member.to_string()));
                let help = if last {
                    format!(
                        "`{member}` is a point; its coordinates are `{}.{member}.x` and `{}.{member}.y`",
                        attachment.body, attachment.body
                    )
                } else {
                    "a place has `x`, `y` and `angle`".to_owned()
                };
                errors
                    .push(Diagnostic::new(member.span(), format!("there is no `{member}` here")).help(help));
                return None;
            }
        };
        self.allowed(Typed { expr, dimension: Some(dimension) }, member, place, errors)
    }
}
