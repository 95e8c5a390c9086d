//! Joints between places: names of their rows, then the rows themselves.

use mbs_symbolic::units::Dimension;
use mbs_symbolic::{Algebra, Expr, Symbol};
use proc_macro2::Ident;

use super::known::{GROUND, KnownJoint};
use super::resolver::Resolver;
use super::{Constraint, Meaning, Source};
use crate::diagnostics::Diagnostic;
use crate::mechanics::joints::{Holds, Mend, Row};
use crate::syntax::{Attachment, Joint};

impl Resolver<'_> {
    /// Enters the rows that the joint will have.
    pub(super) fn declare_joint(&mut self, joint: &Joint) {
        let declared = self.rows_of(joint);
        for row in &declared {
            self.declare_row(&row_name(joint, row), &joint.name, false);
        }
        let multiplier = |row| {
            let known = self.scope.rows.get(&row_name(joint, row).to_string())?;
            Some((row, known.multiplier))
        };
        let rows = declared.into_iter().filter_map(multiplier).collect();
        let ends = [joint.first.clone(), joint.second.clone()];
        let (kind, span) = (joint.kind, joint.name.span());
        let known = KnownJoint { kind, span, ends, rows, connection: None };
        self.scope.joints.entry(joint.name.to_string()).or_insert(known);
    }

    /// The rows that a joint has. One that holds angles has no row for what cannot move at either place, if it has others.
    fn rows_of(&self, joint: &Joint) -> Vec<&'static Row> {
        let ends = [&joint.first, &joint.second];
        let is_kept = |row: &&Row| !ends.into_iter().all(|place| self.is_still(place, row));
        let kept: Vec<_> = joint.kind.rows.iter().filter(is_kept).collect();
        if kept.is_empty() || !joint.kind.holds(Holds::Angle) {
            joint.kind.rows.iter().collect()
        } else {
            kept
        }
    }

    /// True if what a row holds cannot move at a place: the angle of a body that does not turn, or a coordinate of a middle that
    /// has none.
    fn is_still(&self, place: &Attachment, row: &Row) -> bool {
        let place = self.scope.on_body(place);
        let Some(frame) = self.scope.bodies.get(&place.body.to_string()) else { return false };
        let is_number = |value| self.scope.arena.as_number(value).is_some();
        let [x, y] = frame.origin.map(is_number);
        match (row.holds, row.suffix) {
            (Holds::Angle, _) => is_number(frame.angle),
            (Holds::Place, "_x") => x && place.point.is_none(),
            (Holds::Place, "_y") => y && place.point.is_none(),
            (Holds::Place | Holds::Length | Holds::Turns, _) => false,
        }
    }

    pub(super) fn resolve_joint(&mut self, joint: &Joint, doc: &str) {
        let rows = self.rows_of(joint);
        let equations = self.equations(joint, &rows);
        for (at, row) in rows.into_iter().enumerate() {
            let name = row_name(joint, row).to_string();
            let equation = equations.as_ref().map(|equations| equations[at]);
            let is_restricting = equation.is_some_and(|(phi, _)| self.depends_on_coordinates(phi));
            if equation.is_some() && !is_restricting {
                let error = self.useless_row(joint, row);
                self.errors.push(error);
            }
            if let Some(known) = self.scope.rows.get_mut(&name) {
                known.is_broken = !is_restricting;
                known.dimension = equation.map(|(_, dimension)| dimension);
                known.phi = equation.map(|(phi, _)| phi);
            }
            if let (Some((phi, dimension)), true) = (equation, is_restricting) {
                let (doc, span) = (doc.to_owned(), joint.name.span());
                let (source, is_drive) = (source(joint), false);
                let rate = None;
                self.push_row(Constraint { name, source, doc, span, is_drive, rate, phi, dimension });
            }
        }
    }

    /// Φ of each row, with its dimension.
    fn equations(&mut self, joint: &Joint, rows: &[&Row]) -> Option<Vec<(Expr, Dimension)>> {
        let connection = self.connection(joint)?;
        if let Some(known) = self.scope.joints.get_mut(&joint.name.to_string()) {
            known.connection = Some(connection);
        }
        let algebra = Algebra::new(&mut self.scope.arena);
        let on = connection.on(&algebra);
        let is_left_out = |row: &&Row| !rows.iter().any(|kept| kept.suffix == row.suffix);
        let mut left_out = joint.kind.rows.iter().filter(is_left_out);
        // between bodies that do not turn every angle is 0, as is the way between those that only turn
        let contradicts = left_out.any(|row| !(row.phi)(&on).is_zero());
        let equations = rows.iter().map(|row| ((row.phi)(&on).expr(), row.dimension(on.unit))).collect();
        if contradicts {
            let message =
                format!("joint `{}` asks for an angle, and neither of its places turns", joint.name);
            self.errors
                .push(Diagnostic::new(joint.name.span(), message).help("leave the angle out: it is 0"));
            return None;
        }
        Some(equations)
    }

    pub(super) fn depends_on_coordinates(&self, phi: Expr) -> bool {
        self.coordinates_in(phi) > 0
    }

    /// How many coordinates an expression depends on.
    pub(super) fn coordinates_in(&self, phi: Expr) -> usize {
        let is_coordinate = |&symbol: &Symbol| matches!(self.scope.meaning(symbol), Meaning::Coordinate(_));
        self.scope.arena.symbols_in(phi).iter().filter(|symbol| is_coordinate(symbol)).count()
    }

    /// The error for a row in which nothing can move.
    fn useless_row(&self, joint: &Joint, row: &Row) -> Diagnostic {
        let missing = self.missing_coordinate(&self.scope.on_body(&joint.first).body);
        let help = match (joint.kind.mend, missing) {
            (Mend::Remove, _) if row.holds == Holds::Angle && joint.kind.rows.len() > 1 => {
                "write a `revolute` for the rest of it, or remove the joint".to_owned()
            }
            (Mend::Remove, _) => "remove the joint: its bodies cannot move otherwise".to_owned(),
            (Mend::Move(reason), Some(missing)) => format!("{missing}: {reason}"),
            (Mend::RemoveOrMove, Some(missing)) => format!("remove the joint, or {missing}"),
            (Mend::Move(_) | Mend::RemoveOrMove, None) => {
                "remove the joint, or give a body the coordinate that is missing".to_owned()
            }
        };
        let (name, restricts) = (&joint.name, row.restricts);
        let message =
            format!("joint `{name}` restricts nothing{restricts}: neither of its places can move so");
        Diagnostic::new(name.span(), message).help(help)
    }

    /// The help for a position that a body lacks; `None` for the ground and for a body that lacks none.
    fn missing_coordinate(&self, body: &Ident) -> Option<String> {
        let frame = self.scope.bodies.get(&body.to_string()).filter(|_| body != GROUND)?;
        let fixed = frame.origin.map(|component| self.scope.arena.as_number(component).is_some());
        let missing = match fixed {
            [true, false] => "coordinate x",
            [false, true] => "coordinate y",
            [true, true] => "coordinates x and y",
            [false, false] => return None,
        };
        Some(format!("give `{body}` the {missing}"))
    }
}

fn source(joint: &Joint) -> Source {
    let bodies = [&joint.first, &joint.second].map(|place| place.body.to_string());
    Source { kind: "joint", name: joint.name.to_string(), bodies: Some(bodies) }
}

fn row_name(joint: &Joint, row: &Row) -> Ident {
    Ident::new(&format!("{}{}", joint.name, row.suffix), joint.name.span())
}
