//! Functions that tell what joints exert.

use mbs_symbolic::{Expr, Function, Number, Symbol};
use proc_macro2::{Ident, Span};

use super::joints::{self, Connection, Wrench};
use super::measures::{ENERGY, FORCE, name_of, unknown, wrong_arguments};
use super::names::{Place, Scope, Typed};
use crate::diagnostics::{Diagnostic, Diagnostics, listing};
use crate::syntax::{Attachment, Formula, FormulaKind, JointKind};

/// A declared joint.
pub struct KnownJoint {
    pub kind: JointKind,
    pub span: Span,
    pub ends: [Attachment; 2],
    pub multipliers: Vec<Symbol>,
    /// Known once its rows are.
    pub connection: Option<Connection>,
}

impl Scope<'_> {
    /// `reaction(pin, rod).x`: a component of what a joint exerts on a body.
    pub(super) fn component(
        &mut self,
        call: &Formula,
        member: &Ident,
        place: Place,
        errors: &mut Diagnostics,
    ) -> Option<Typed> {
        let result = match &call.kind {
            FormulaKind::Call { function, arguments } if function == "reaction" => {
                self.reaction_on(function, arguments, member).map(|typed| (function, typed))
            }
            _ => Err(Diagnostic::new(member.span(), "only `reaction(joint, body)` has components")
                .help("a component of a point is written `rod.tip.x`")),
        };
        let (function, typed) = errors.take(result)?;
        self.allowed(typed, function, place, errors)
    }

    /// `reaction(pin)`: how large the force is that a joint transmits.
    pub(super) fn reaction(&mut self, name: &Ident, joint: &Formula) -> Result<Typed, Diagnostic> {
        let asked = name_of(name, joint)?;
        let wrenches = self.wrenches(name, asked)?;
        let forces: Vec<Expr> =
            wrenches.iter().filter(|(_, w)| w.force.is_some()).map(|(lambda, _)| *lambda).collect();
        // The rows of a joint are along directions at right angles.
        let expr = match forces[..] {
            [x, y] => self.norm([x, y]),
            [along] => self.arena.call(Function::Abs, along),
            _ => {
                return Err(Diagnostic::new(
                    asked.span(),
                    format!("`{asked}` transmits no force between two places"),
                )
                .help(format!("what its multiplier `lambda({asked})` means is said in the list of joints")));
            }
        };
        Ok(Typed { expr, dimension: Some(FORCE) })
    }

    fn reaction_on(
        &mut self,
        name: &Ident,
        arguments: &[Formula],
        member: &Ident,
    ) -> Result<Typed, Diagnostic> {
        let [joint, rest @ ..] = arguments else { return Err(wrong_arguments(name, "reaction")) };
        let asked = name_of(name, joint)?;
        let wrenches = self.wrenches(name, asked)?;
        let Some(known) = self.joints.get(&asked.to_string()) else {
            return Err(unknown(asked, "joint", self.joints.keys()));
        };
        let bodies = known.ends.each_ref().map(|end| end.body.to_string());
        let body = match rest {
            [Formula { kind: FormulaKind::Name(body), .. }] => body,
            _ => {
                let message = format!("on which body does `{asked}` act?");
                let [first, second] = &bodies;
                return Err(Diagnostic::new(asked.span(), message).help(format!(
                    "write `reaction({asked}, {first}).{member}` or `reaction({asked}, {second}).{member}`"
                )));
            }
        };
        let sign = match bodies.iter().rposition(|known| body == known) {
            Some(0) => Number::MINUS_ONE,
            Some(_) => Number::ONE,
            None => {
                let message = format!("`{asked}` does not act on `{body}`");
                return Err(
                    Diagnostic::new(body.span(), message).help(format!("it connects {}", listing(bodies)))
                );
            }
        };
        let along = |wrench: &Wrench| match member.to_string().as_str() {
            "x" => Some(wrench.force.map(|force| force[0])),
            "y" => Some(wrench.force.map(|force| force[1])),
            "torque" => Some(wrench.torque),
            _ => None,
        };
        let mut terms = Vec::new();
        for (lambda, wrench) in &wrenches {
            let component = along(wrench).ok_or_else(|| {
                Diagnostic::new(member.span(), format!("a reaction has no `{member}`"))
                    .help("it has `x`, `y` and `torque`")
            })?;
            if let Some(component) = component {
                terms.push((self.arena.mul(*lambda, component), sign));
            }
        }
        if terms.is_empty() {
            let what = if member == "torque" { "torque" } else { "force" };
            return Err(Diagnostic::new(member.span(), format!("`{asked}` exerts no {what}"))
                .help("record what it does exert"));
        }
        let dimension = if member == "torque" { ENERGY } else { FORCE };
        Ok(Typed { expr: self.arena.sum(&terms), dimension: Some(dimension) })
    }

    /// The multipliers of a joint, and what each one exerts on the second body.
    fn wrenches(&mut self, name: &Ident, joint: &Ident) -> Result<Vec<(Expr, Wrench)>, Diagnostic> {
        let text = joint.to_string();
        let Some(known) = self.joints.get(&text) else {
            if let Some(row) = self.rows.get(&text) {
                let kind = if row.is_drive { "drive" } else { "constraint" };
                return Err(Diagnostic::new(joint.span(), format!("`{text}` is a {kind}, not a joint"))
                    .help(format!("its multiplier is `lambda({text})`")));
            }
            return Err(unknown(joint, "joint", self.joints.keys()));
        };
        let Some(connection) = &known.connection else {
            // A constraint is being resolved, by way of a `let`; or it is
            // broken, and has its error.
            return Err(Diagnostic::new(name.span(), format!("the reaction of `{text}` cannot stand here"))
                .help(Place::Constraint.rule()));
        };
        let wrenches = joints::wrenches(&mut self.arena, known.kind, connection);
        let multipliers = known.multipliers.clone();
        let lambdas = multipliers.into_iter().map(|symbol| self.arena.variable(symbol)).collect::<Vec<_>>();
        Ok(lambdas.into_iter().zip(wrenches).collect())
    }
}

/// The error for a reaction on a body without a component.
pub(super) fn is_vector(name: &Ident, joint: &Formula, body: &Formula) -> Diagnostic {
    let call = format!("reaction({}, {})", text_of(joint), text_of(body));
    Diagnostic::new(name.span(), "a reaction on a body is a vector")
        .help(format!("write `{call}.x`, `{call}.y` or `{call}.torque`"))
}

fn text_of(formula: &Formula) -> String {
    match &formula.kind {
        FormulaKind::Name(name) => name.to_string(),
        _ => "…".to_owned(),
    }
}
