//! Rows in the words of the declaration: a joint has several, but is one thing.
//!
//! Errors about dependence speak of joints and bodies. There is one error for each joint.

use std::fmt;

use mbs_symbolic::units::Dimension;

use crate::diagnostics::{joined, listing};
use crate::model::{Constraint, Model, Source};

/// Rows of one statement.
pub struct Part<'a> {
    pub source: &'a Source,
    rows: Vec<&'a Constraint>,
    /// True if these are all rows that the statement has.
    is_whole: bool,
}

impl<'a> Part<'a> {
    /// The statements of these rows, in the order of their first rows.
    pub fn of(model: &'a Model, rows: impl IntoIterator<Item = usize>) -> Vec<Self> {
        let mut parts: Vec<Self> = Vec::new();
        for row in rows.into_iter().filter_map(|row| model.constraints.get(row)) {
            match parts.iter_mut().find(|part| *part.source == row.source) {
                Some(part) => part.rows.push(row),
                None => parts.push(Self { source: &row.source, rows: vec![row], is_whole: false }),
            }
        }
        for part in &mut parts {
            let all = model.constraints.iter().filter(|row| row.source == *part.source).count();
            part.is_whole = part.rows.len() == all;
        }
        parts
    }

    /// The first of its rows.
    pub fn row(&self) -> Option<&'a Constraint> {
        self.rows.first().copied()
    }

    /// The form of a verb for it.
    pub fn verb(&self, of_one: &'static str, of_many: &'static str) -> &'static str {
        if self.is_whole || self.rows.len() == 1 { of_one } else { of_many }
    }
}

/// With the bodies that a joint connects, and with the rows if they are not all.
impl fmt::Display for Part<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.is_whole {
            let s = if self.rows.len() == 1 { "" } else { "s" };
            write!(f, "row{s} {} of ", listing(self.rows.iter().map(|row| &row.name)))?;
        }
        self.source.fmt(f)?;
        let body =
            |name: &String| if name == "ground" { "the ground".to_owned() } else { format!("`{name}`") };
        match &self.source.bodies {
            Some(bodies) => write!(f, " between {}", joined(bodies.iter().map(body))),
            None => Ok(()),
        }
    }
}

impl fmt::Display for Source {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} `{}`", self.kind, self.name)
    }
}

/// That others say already what it says.
pub fn repeats(part: &Part<'_>, others: &[Part<'_>]) -> String {
    let say = if others.len() == 1 { "says" } else { "say" };
    format!("{part} {} what {} already {say}", part.verb("repeats", "repeat"), by_kind(others))
}

/// That it meets others in a double root.
pub fn touches(part: &Part<'_>, others: &[Part<'_>]) -> String {
    let touches = part.verb("touches", "touch");
    let others = by_kind(others);
    format!(
        "{part} {touches} {others} as a circle touches its tangent: together they forbid a motion that no force \
         of theirs holds"
    )
}

/// ``joints `a` and `b` and drive `c` ``
fn by_kind(parts: &[Part<'_>]) -> String {
    let mut kinds: Vec<(&str, Vec<&str>)> = Vec::new();
    for Source { kind, name, .. } in parts.iter().map(|part| part.source) {
        match kinds.iter_mut().find(|(known, _)| known == kind) {
            Some((_, names)) => names.push(name),
            None => kinds.push((*kind, vec![name])),
        }
    }
    let of_kind = |(kind, names): (&str, Vec<&str>)| {
        let s = if names.len() == 1 { "" } else { "s" };
        format!("{kind}{s} {}", listing(names))
    };
    joined(kinds.into_iter().map(of_kind))
}

/// The SI unit of a violation, where it is that of a length.
pub fn unit(dimension: Dimension) -> &'static str {
    if dimension == Dimension::LENGTH { " m" } else { "" }
}
