//! Fate of each element and each attribute of a format, in one table per format.
//!
//! A walk over the file compares it with the table before anything is imported, so that nothing
//! is left out without a word, whatever a reader asks for.

use std::collections::{BTreeMap, BTreeSet};

use super::numbers::quantities;
use crate::xml::Node;
use crate::{Refusal, shown};
use mbs_words::names::nearest;

/// Parts that are not known are named one by one up to so many.
const MOST_NAMED: usize = 20;

/// Fate of a part of a file: read, left out or refused.
#[derive(Clone, Copy, Debug)]
pub(super) enum Fate {
    /// A reader asks for it.
    Read,
    /// The same of an element and all that is in it; of that the table has what is refused alone.
    Whole,
    /// It is left out with a note, which says what it is about: no motion in the plane depends on it.
    Left(&'static str),
    /// The mechanism would be another one without it. One of the usual values, with `|` between
    /// them, says nothing; the last text says more about the others.
    Refused(&'static str, &'static str),
}

/// Elements with what becomes of them and of their attributes. Names have blanks between them;
/// an element in another one of a name is written `other/element`, and `*` stands for a prefix or
/// for all names with one.
pub(super) type Row = (&'static str, Fate, &'static [(&'static str, Fate)]);

/// The rows of a format by the names of their elements.
pub(super) struct Table(BTreeMap<&'static str, &'static Row>);

impl Table {
    pub fn new(rows: &'static [Row]) -> Self {
        let named = |row: &'static Row| row.0.split_whitespace().map(move |name| (name, row));
        Self(rows.iter().flat_map(named).collect())
    }

    /// The row of an element in a parent: that of `parent/name`, else of `name`, else of its prefix. `None` if it is
    /// unknown.
    fn row(&self, parent: &str, name: &str) -> Option<&'static Row> {
        let find = |key: &str| self.0.get(key).copied();
        let of_prefix = || {
            let (prefix, own) = name.split_once(':')?;
            find(&format!("*:{own}")).or_else(|| find(&format!("{prefix}:*")))
        };
        find(&format!("{parent}/{name}")).or_else(|| find(name)).or_else(of_prefix)
    }

    /// Refuses an element for what its attributes are, wherever they come from.
    ///
    /// # Errors
    /// A value that the mechanism would be another one without.
    pub fn refuse<'v>(&self, node: Node<'_>, value: impl Fn(&str) -> Option<&'v str>) -> Result<(), Refusal> {
        let row = self.row("", node.name());
        for (names, fate) in row.map_or(&[][..], |row| row.2) {
            for name in names.split_whitespace() {
                value(name).map_or(Ok(()), |value| refused(node, name, value, *fate))?;
            }
        }
        Ok(())
    }

    /// Notes on the parts of a file that are left out. Elements for which `skips` is true are passed over.
    ///
    /// # Errors
    /// The first part without which the mechanism would be another one.
    pub fn check(&self, root: Node<'_>, skips: impl Fn(Node<'_>) -> bool) -> Result<Vec<String>, Refusal> {
        let mut walk = Walk { table: self, left: BTreeMap::new(), unknown: Vec::new() };
        walk.attributes(root, self.row("", root.name()), false)?;
        let mut open = vec![root.elements()];
        let mut names = vec![root.name()];
        while let (Some(elements), Some(parent)) = (open.last_mut(), names.last()) {
            match elements.next() {
                Some(node) if skips(node) => {}
                Some(node) if walk.enters(node, parent)? => {
                    open.push(node.elements());
                    names.push(node.name());
                }
                Some(_) => {}
                None => {
                    open.pop();
                    names.pop();
                }
            }
        }
        Ok(walk.notes())
    }
}

/// Refuses a value of an attribute, if that is its fate.
fn refused(node: Node<'_>, attribute: &str, value: &str, fate: Fate) -> Result<(), Refusal> {
    let Fate::Refused(usual, why) = fate else { return Ok(()) };
    if is_usual(value, usual) {
        return Ok(());
    }
    let (of, value) = (node.described(node.name()), shown(value));
    Err(Refusal(format!("{of}: `{attribute}` = {value} is not imported{}", also(why))))
}

fn also(why: &str) -> String {
    if why.is_empty() { String::new() } else { format!("; {why}") }
}

/// `true` if a value is one of the usual ones, as a word or as numbers: `0` is also `0.0 0.0`.
fn is_usual(value: &str, usual: &str) -> bool {
    usual.split('|').filter(|usual| !usual.is_empty()).any(|usual| {
        let is_same = |numbers: Vec<f64>| match quantities(usual).as_deref() {
            Some([one]) => numbers.iter().all(|number| number == one),
            Some(several) => numbers == several,
            None => false,
        };
        value.trim() == usual || quantities(value).is_some_and(is_same)
    })
}

struct Walk<'t> {
    table: &'t Table,
    /// Names of the parts that are left out, by what they are about.
    left: BTreeMap<&'static str, BTreeSet<String>>,
    unknown: Vec<String>,
}

impl Walk<'_> {
    /// Applies the fate of an element. Reports whether the walk goes on to the elements in it.
    fn enters(&mut self, node: Node<'_>, parent: &str) -> Result<bool, Refusal> {
        let name = node.name();
        let row = self.table.row(parent, name);
        // Defaults are refused where an element has them.
        let is_default = parent == "default";
        match row.map(|row| row.1) {
            Some(Fate::Refused(usual, why)) if !is_default => {
                let value = node.text().or(node.attribute("value")).unwrap_or_default();
                match is_usual(value, usual) {
                    true => Ok(false),
                    false => Err(Refusal(format!("{} is not imported{}", node.described(name), also(why)))),
                }
            }
            Some(Fate::Refused(..)) => Ok(false),
            Some(Fate::Left(about)) => {
                self.left(about, format!("`{name}`"));
                Ok(false)
            }
            Some(Fate::Whole) => {
                let in_it = node.elements().filter(|inner| {
                    let row = self.table.0.get(format!("{name}/{}", inner.name()).as_str());
                    row.is_some_and(|row| matches!(row.1, Fate::Refused(..)))
                });
                for inner in in_it.collect::<Vec<_>>() {
                    self.enters(inner, name)?;
                }
                Ok(false)
            }
            Some(Fate::Read) => {
                self.attributes(node, row, is_default)?;
                Ok(true)
            }
            None if name.contains(':') => {
                self.left("elements of other programs", format!("`{name}`"));
                Ok(false)
            }
            None => {
                let known = self.table.0.keys().map(|key| key.rsplit('/').next().unwrap_or(key));
                self.unknown(format!("`{}` in line {}", shortened(name), node.line()), name, known);
                Ok(false)
            }
        }
    }

    fn attributes(
        &mut self,
        node: Node<'_>,
        row: Option<&'static Row>,
        is_default: bool,
    ) -> Result<(), Refusal> {
        let known = row.map_or(&[][..], |row| row.2);
        let fates =
            known.iter().flat_map(|(names, fate)| names.split_whitespace().map(move |name| (name, *fate)));
        let fates: BTreeMap<&str, Fate> = fates.collect();
        let mut unknown = Vec::new();
        for (name, value) in node.attributes() {
            match fates.get(name) {
                Some(Fate::Left(about)) => self.left(about, format!("`{name}` of {}", node.name())),
                Some(_) if is_default => {}
                Some(fate) => refused(node, name, value, *fate)?,
                None if name == "xmlns" || name.starts_with("xmlns:") => {}
                None if name.contains(':') => {
                    self.left("attributes of other programs", format!("`{}`", shortened(name)));
                }
                None => unknown.push(name),
            }
        }
        let of = if unknown.is_empty() { String::new() } else { node.described(node.name()) };
        for name in unknown {
            self.unknown(format!("`{}` of {of}", shortened(name)), name, fates.keys().copied());
        }
        Ok(())
    }

    fn left(&mut self, about: &'static str, what: String) {
        self.left.entry(about).or_default().insert(what);
    }

    fn unknown<'k>(&mut self, what: String, name: &str, known: impl Iterator<Item = &'k str>) {
        let near = match self.unknown.len() < MOST_NAMED {
            true => nearest(name, &known.map(str::to_owned).collect::<Vec<_>>())
                .map_or(String::new(), |near| format!(", did you mean `{near}`?")),
            false => String::new(),
        };
        self.unknown.push(format!("not carried over: {what}, which is not known{near}"));
    }

    fn notes(self) -> Vec<String> {
        let left = self.left.into_iter().map(|(about, parts)| {
            let more = parts.len().saturating_sub(MOST_NAMED);
            let named = parts.into_iter().take(MOST_NAMED).collect::<Vec<_>>().join(", ");
            let more = if more > 0 { format!(" and {more} more") } else { String::new() };
            format!("not carried over: {about} ({named}{more})")
        });
        let more = self.unknown.len().saturating_sub(MOST_NAMED);
        let more = (more > 0).then(|| format!("not carried over: {more} more parts that are not known"));
        self.unknown.into_iter().take(MOST_NAMED).chain(more).chain(left).collect()
    }
}

/// A name that may be long, without its quotes.
fn shortened(name: &str) -> String {
    shown(name).trim_matches('`').to_owned()
}
