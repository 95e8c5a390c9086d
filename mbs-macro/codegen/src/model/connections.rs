//! Joints between places: names of their rows, then the rows themselves.

use mbs_symbolic::{Expr, Symbol};
use proc_macro2::Ident;

use super::joints::{self, JointRow};
use super::places::GROUND;
use super::reactions::KnownJoint;
use super::resolver::Resolver;
use super::{Constraint, Meaning, Source};
use crate::diagnostics::Diagnostic;
use crate::syntax::{Joint, JointKind};

impl Resolver<'_> {
    /// The rows that the joint will have. A joint that holds an angle between
    /// bodies that do not turn has no row for it.
    pub(super) fn declare_joint(&mut self, joint: &Joint) {
        for suffix in self.suffixes(joint) {
            self.declare_row(&row_name(joint, suffix), false);
        }
        let multipliers: Vec<_> = self
            .suffixes(joint)
            .into_iter()
            .filter_map(|suffix| self.scope.rows.get(&row_name(joint, suffix).to_string()))
            .map(|row| row.multiplier)
            .collect();
        let ends = [joint.first.clone(), joint.second.clone()];
        let (kind, span) = (joint.kind, joint.name.span());
        let known = KnownJoint { kind, span, ends, multipliers, connection: None };
        self.scope.joints.entry(joint.name.to_string()).or_insert(known);
    }

    fn suffixes(&self, joint: &Joint) -> Vec<&'static str> {
        let turns = |body: &Ident| match self.scope.bodies.get(&body.to_string()) {
            Some(frame) => self.scope.arena.as_number(frame.angle).is_none(),
            None => true,
        };
        let any_turns = turns(&joint.first.body) || turns(&joint.second.body);
        joints::row_suffixes(joint.kind)
            .iter()
            .copied()
            .filter(|suffix| any_turns || *suffix != "_angle")
            .collect()
    }

    pub(super) fn resolve_joint(&mut self, joint: &Joint, doc: &str) {
        let rows = self.joint_rows(joint);
        for (at, suffix) in self.suffixes(joint).into_iter().enumerate() {
            let name = row_name(joint, suffix);
            let row = rows.as_ref().and_then(|rows| rows.get(at));
            let is_restricting = row.is_some_and(|row| self.depends_on_coordinates(row.phi));
            if row.is_some() && !is_restricting {
                let error = self.useless_row(joint, suffix);
                self.errors.push(error);
            }
            if let Some(known) = self.scope.rows.get_mut(&name.to_string()) {
                known.is_broken = !is_restricting;
                known.dimension = row.map(|row| row.dimension);
                known.phi = row.map(|row| row.phi);
            }
            if let (Some(JointRow { phi, dimension }), true) = (row, is_restricting) {
                let (name, doc, span) = (name.to_string(), doc.to_owned(), joint.name.span());
                let (source, phi, dimension) = (source(joint), *phi, *dimension);
                self.constraints.push(Constraint {
                    name,
                    source,
                    doc,
                    span,
                    is_drive: false,
                    phi,
                    dimension,
                });
            }
        }
    }

    fn joint_rows(&mut self, joint: &Joint) -> Option<Vec<JointRow>> {
        let connection = self.connection(joint)?;
        if let Some(known) = self.scope.joints.get_mut(&joint.name.to_string()) {
            known.connection = Some(connection);
        }
        Some(joints::rows(&mut self.scope.arena, joint.kind, &connection))
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
    fn useless_row(&self, joint: &Joint, suffix: &str) -> Diagnostic {
        let what = match suffix {
            "_x" => " along x",
            "_y" => " along y",
            "_normal" => " across its line",
            "_angle" => " in its angle",
            _ => "",
        };
        let missing = match joint.kind {
            JointKind::Revolute | JointKind::Rolling => self.missing_coordinate(&joint.first.body),
            _ => None,
        };
        let help = match (joint.kind, missing) {
            (JointKind::Rolling, Some(missing)) => {
                format!(
                    "{missing}: the contact holds the wheel at its height, so that it needs both positions"
                )
            }
            (JointKind::Revolute, Some(missing)) => format!("remove the joint, or {missing}"),
            (JointKind::Revolute | JointKind::Rolling, None) => {
                "remove the joint, or give a body the coordinate that is missing".to_owned()
            }
            _ => "remove the joint: its bodies cannot move otherwise".to_owned(),
        };
        let message =
            format!("joint `{}` restricts nothing{what}: neither of its places can move so", joint.name);
        Diagnostic::new(joint.name.span(), message).help(help)
    }

    /// What to write for a position that a body lacks.
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

fn row_name(joint: &Joint, suffix: &str) -> Ident {
    Ident::new(&format!("{}{suffix}", joint.name), joint.name.span())
}
