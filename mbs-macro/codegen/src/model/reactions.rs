//! Functions that tell what joints exert.

use mbs_symbolic::{Algebra, Scalar, Symbol, Vector};
use proc_macro2::Ident;

use super::known::Typed;
use super::measures::{ENERGY, FORCE, name_of, unknown, wrong_arguments};
use super::names::{Place, Scope};
use crate::diagnostics::{Diagnostic, Diagnostics, listing};
use crate::mechanics::joints::{Connection, Row, Wrench};
use crate::mechanics::norm;
use crate::syntax::{Formula, FormulaKind};

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
        let acting = self.acting(name, asked)?;
        let algebra = Algebra::new(&mut self.arena);
        let wrenches = acting.wrenches(&algebra);
        let is_force = |(_, wrench): &&(Scalar<'_>, Wrench<'_>)| matches!(wrench, Wrench::Force(_));
        let forces: Vec<_> = wrenches.iter().filter(is_force).map(|(lambda, _)| *lambda).collect();
        // The rows of a joint are along directions at right angles.
        let size = match forces[..] {
            [x, y] => norm(Vector { x, y }),
            [along] => along.abs(),
            _ => {
                let message = format!("`{asked}` transmits no force between two places");
                let help =
                    format!("what its multiplier `lambda({asked})` means is said in the list of joints");
                return Err(Diagnostic::new(asked.span(), message).help(help));
            }
        };
        Ok(Typed { expr: size.expr(), dimension: Some(FORCE) })
    }

    fn reaction_on(
        &mut self,
        name: &Ident,
        arguments: &[Formula],
        member: &Ident,
    ) -> Result<Typed, Diagnostic> {
        let [joint, rest @ ..] = arguments else { return Err(wrong_arguments(name, "reaction")) };
        let asked = name_of(name, joint)?;
        let acting = self.acting(name, asked)?;
        let bodies = acting.bodies.each_ref();
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
        let Some(at) = bodies.iter().rposition(|known| body == known) else {
            let message = format!("`{asked}` does not act on `{body}`");
            let help = format!("it connects {}", listing(bodies));
            return Err(Diagnostic::new(body.span(), message).help(help));
        };
        let algebra = Algebra::new(&mut self.arena);
        let wrenches = acting.wrenches(&algebra);
        let mut terms = Vec::new();
        for (lambda, wrench) in &wrenches {
            if let Some(component) = component(wrench, member)? {
                terms.push(*lambda * component);
            }
        }
        if terms.is_empty() {
            let what = if member == "torque" { "torque" } else { "force" };
            return Err(Diagnostic::new(member.span(), format!("`{asked}` exerts no {what}"))
                .help("record what it does exert"));
        }
        let dimension = if member == "torque" { ENERGY } else { FORCE };
        let on_second = algebra.sum(terms);
        let exerted = if at == 0 { -on_second } else { on_second };
        Ok(Typed { expr: exerted.expr(), dimension: Some(dimension) })
    }

    /// A joint whose rows are known.
    fn acting(&self, name: &Ident, joint: &Ident) -> Result<Acting, Diagnostic> {
        let text = joint.to_string();
        let Some(known) = self.joints.get(&text) else {
            if let Some(row) = self.rows.get(&text) {
                let kind = if row.is_drive { "drive" } else { "constraint" };
                return Err(Diagnostic::new(joint.span(), format!("`{text}` is a {kind}, not a joint"))
                    .help(format!("its multiplier is `lambda({text})`")));
            }
            return Err(unknown(joint, "joint", self.joints.keys()));
        };
        let Some(connection) = known.connection else {
            // A constraint is being resolved, by way of a `let`; or it is
            // broken, and has its error.
            return Err(Diagnostic::new(name.span(), format!("the reaction of `{text}` cannot stand here"))
                .help(Place::Constraint.rule()));
        };
        let bodies = known.ends.each_ref().map(|end| end.body.to_string());
        Ok(Acting { connection, rows: known.rows.clone(), bodies })
    }
}

/// A joint whose rows are known.
struct Acting {
    connection: Connection,
    rows: Vec<(&'static Row, Symbol)>,
    bodies: [String; 2],
}

impl Acting {
    /// Its multipliers, and what each one exerts on the second body.
    fn wrenches<'a>(&self, algebra: &'a Algebra<'a>) -> Vec<(Scalar<'a>, Wrench<'a>)> {
        let joint = self.connection.on(algebra);
        let wrench = |&(row, multiplier): &(&Row, Symbol)| Some((multiplier, row.wrench?(&joint)));
        let wrenches: Vec<_> = self.rows.iter().filter_map(wrench).collect();
        wrenches.into_iter().map(|(multiplier, wrench)| (algebra.variable(multiplier), wrench)).collect()
    }
}

/// A component of a wrench, if it has one of this name.
fn component<'a>(wrench: &Wrench<'a>, member: &Ident) -> Result<Option<Scalar<'a>>, Diagnostic> {
    match (member.to_string().as_str(), wrench) {
        ("x", Wrench::Force(force)) => Ok(Some(force.x)),
        ("y", Wrench::Force(force)) => Ok(Some(force.y)),
        ("torque", Wrench::Torque(torque)) => Ok(Some(*torque)),
        ("x" | "y" | "torque", _) => Ok(None),
        _ => Err(Diagnostic::new(member.span(), format!("a reaction has no `{member}`"))
            .help("it has `x`, `y` and `torque`")),
    }
}
