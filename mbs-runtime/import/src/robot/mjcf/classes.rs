//! Classes of defaults, and elements with the attributes that they have by their classes.

use std::collections::BTreeMap;

use crate::xml::Node;

use super::laws::{Law, is_actuator};
use super::settings::Settings;
use crate::robot::numbers::{exactly, not_negative, numbers};
use crate::robot::space::{Rotation, Vector, cross, dot, minus, scaled, unit};
use crate::robot::table::Table;
use crate::{Refusal, shown};

/// Defaults are nested at most so deep.
const DEEPEST: usize = 50;

/// The attributes that elements of a kind have in a class.
type Attributes<'a> = BTreeMap<(&'a str, &'a str), &'a str>;

/// The defaults of a file.
pub(super) struct Classes<'a> {
    /// The first one is the class of elements that name none.
    classes: Vec<Class<'a>>,
    names: BTreeMap<&'a str, usize>,
    table: Table,
}

struct Class<'a> {
    /// The class around it, which has what it does not say itself.
    parent: Option<usize>,
    own: Attributes<'a>,
    /// The law that actuators of the class have by default.
    law: Law,
}

/// Elements that share their defaults have one name there.
fn shared(kind: &str) -> &str {
    match kind {
        "connect" | "weld" => "equality",
        kind if is_actuator(kind) => "general",
        other => other,
    }
}

impl<'a> Classes<'a> {
    pub fn read(root: Node<'a>, table: Table) -> Result<Self, Refusal> {
        let main = Class { parent: None, own: BTreeMap::new(), law: Law::USUAL };
        let mut classes = Self { classes: vec![main], names: BTreeMap::from([("main", 0)]), table };
        for node in root.elements_named("default") {
            classes.class(node, None, 0)?;
        }
        Ok(classes)
    }

    fn class(&mut self, node: Node<'a>, parent: Option<usize>, depth: usize) -> Result<(), Refusal> {
        let of = node.described("default");
        if depth > DEEPEST {
            return Err(Refusal(format!("{of} is nested more than {DEEPEST} deep")));
        }
        let at = parent.map_or(0, |_| self.classes.len());
        match (parent, node.attribute("class")) {
            (Some(_), None) => return Err(Refusal(format!("{of} has no `class`"))),
            (_, Some(class)) => {
                self.names.entry(class).or_insert(at);
            }
            (None, None) => {}
        }
        let inherited = self.classes.get(parent.unwrap_or(0)).map_or(Law::USUAL, |class| class.law);
        let begun = self.classes.get_mut(at).map(|class| std::mem::take(&mut class.own));
        let mut class = Class { parent, own: begun.unwrap_or_default(), law: inherited };
        for child in node.elements().filter(|child| child.name() != "default") {
            let kind = shared(child.name());
            class.own.extend(child.attributes().map(|(name, value)| ((kind, name), value)));
            class.law.set(child)?;
        }
        match self.classes.get_mut(at) {
            Some(main) => *main = class,
            None => self.classes.push(class),
        }
        node.elements_named("default").try_for_each(|child| self.class(child, Some(at), depth + 1))
    }

    /// An element with its class, or that of the bodies around it.
    ///
    /// # Errors
    /// A class that is not there, and attributes that are refused, its own or those of its class.
    pub fn element(
        &self,
        node: Node<'a>,
        kind: &'static str,
        inherited: Option<&'a str>,
    ) -> Result<Element<'a, '_>, Refusal> {
        let of = node.described(node.name());
        let class = match node.attribute("class").or(inherited) {
            None => 0,
            Some(class) => *self.names.get(class).ok_or_else(|| {
                Refusal(format!("{of} has the class {}, which the file does not have", shown(class)))
            })?,
        };
        let element = Element { node, kind: shared(kind), class, classes: &self.classes, of };
        self.table.refuse(node, |attribute| element.get(attribute))?;
        Ok(element)
    }
}

/// An element with the attributes of its class.
pub(super) struct Element<'a, 'c> {
    pub node: Node<'a>,
    kind: &'static str,
    class: usize,
    classes: &'c [Class<'a>],
    /// Its name in messages, in the words of the file.
    pub of: String,
}

impl<'a> Element<'a, '_> {
    pub fn get(&self, attribute: &str) -> Option<&'a str> {
        let class = self.classes.get(self.class);
        let mut all = std::iter::successors(class, |class| self.classes.get(class.parent?));
        let inherited = || all.find_map(|class| class.own.get(&(self.kind, attribute)).copied());
        self.node.attribute(attribute).or_else(inherited)
    }

    /// The law of an actuator: that of its class with what it says itself.
    pub fn law(&self) -> Result<Law, Refusal> {
        let mut law = self.classes.get(self.class).map_or(Law::USUAL, |class| class.law);
        law.set(self.node)?;
        Ok(law)
    }

    pub fn list(&self, attribute: &str) -> Result<Vec<f64>, Refusal> {
        numbers(self.get(attribute).unwrap_or_default(), attribute, &self.of)
    }

    pub fn exactly<const N: usize>(&self, attribute: &str) -> Result<Option<[f64; N]>, Refusal> {
        self.get(attribute).map(|text| exactly(text, attribute, &self.of)).transpose()
    }

    pub fn vector(&self, attribute: &str) -> Result<Option<Vector>, Refusal> {
        self.exactly(attribute)
    }

    pub fn number(&self, attribute: &str) -> Result<Option<f64>, Refusal> {
        Ok(self.exactly::<1>(attribute)?.map(|[number]| number))
    }

    /// A coefficient that may be a polynomial, of which the first one is imported; not negative.
    pub fn coefficient(&self, attribute: &str) -> Result<f64, Refusal> {
        let found = self.list(attribute)?;
        let of = &self.of;
        if found.iter().skip(1).any(|number| *number != 0.0) {
            return Err(Refusal(format!(
                "{of}: a `{attribute}` that grows with its argument is not imported"
            )));
        }
        not_negative(found.first().copied().unwrap_or_default(), attribute, of)
    }

    /// The two places of `fromto`.
    pub fn ends(&self) -> Result<Option<[Vector; 2]>, Refusal> {
        let ends = self.exactly::<6>("fromto")?;
        Ok(ends.map(|[a, b, c, x, y, z]| [[a, b, c], [x, y, z]]))
    }

    /// How its frame is turned, in any of the ways that a file may say it.
    pub fn turn(&self, settings: &Settings) -> Result<Rotation, Refusal> {
        let flat = |attribute: &str| Refusal(format!("{}: its `{attribute}` has no direction", self.of));
        if let Some(quaternion) = self.exactly("quat")? {
            return Rotation::of_quaternion(quaternion).ok_or_else(|| flat("quat"));
        }
        if let Some([x, y, z, angle]) = self.exactly("axisangle")? {
            let axis = unit([x, y, z]).ok_or_else(|| flat("axisangle"))?;
            return Ok(Rotation::about(axis, settings.angle(angle)));
        }
        if let Some([a, b, c, x, y, z]) = self.exactly("xyaxes")? {
            let first = unit([a, b, c]).ok_or_else(|| flat("xyaxes"))?;
            let across = minus([x, y, z], scaled(first, dot(first, [x, y, z])));
            let second = unit(across).ok_or_else(|| flat("xyaxes"))?;
            return Ok(Rotation::of_axes(first, second, cross(first, second)));
        }
        if let Some(z) = self.vector("zaxis")? {
            return Ok(Rotation::from_z_to(unit(z).ok_or_else(|| flat("zaxis"))?));
        }
        let Some(angles) = self.vector("euler")? else { return Ok(Rotation::NONE) };
        let turns = settings.euler.into_iter().zip(angles);
        Ok(turns.fold(Rotation::NONE, |so_far, (axis, angle)| {
            let direction = match axis.to_ascii_lowercase() {
                'x' => [1.0, 0.0, 0.0],
                'y' => [0.0, 1.0, 0.0],
                _ => [0.0, 0.0, 1.0],
            };
            let turn = Rotation::about(direction, settings.angle(angle));
            if axis.is_ascii_uppercase() { turn.after(&so_far) } else { so_far.after(&turn) }
        }))
    }
}
