//! Classes of defaults, and elements with the attributes that they have by their classes.

use std::collections::BTreeMap;

use roxmltree::Node;

use super::settings::Settings;
use crate::import::robot::space::{Rotation, Vector, cross, dot, minus, scaled, unit};
use crate::import::robot::xml::{described, elements, elements_named, exactly, not_negative, numbers};
use crate::import::{Refusal, shown};

/// Defaults are nested at most so deep.
const DEEPEST: usize = 50;

/// The attributes that elements of a kind have in a class.
type Attributes<'a> = BTreeMap<(&'a str, &'a str), &'a str>;

/// The defaults of a file.
pub(super) struct Classes<'a, 'i> {
    /// The first one is the class of elements that name none.
    classes: Vec<(&'a str, Attributes<'a>)>,
    input: std::marker::PhantomData<&'i ()>,
}

/// All actuators share their defaults.
fn shared(kind: &str) -> &str {
    match kind {
        "motor" | "position" | "velocity" => "general",
        "connect" | "weld" => "equality",
        other => other,
    }
}

impl<'a, 'i> Classes<'a, 'i> {
    pub fn read(root: Node<'a, 'i>) -> Result<Self, Refusal> {
        let mut classes = Self { classes: vec![("main", BTreeMap::new())], input: std::marker::PhantomData };
        for node in elements_named(root, "default") {
            classes.class(node, None, 0)?;
        }
        Ok(classes)
    }

    fn class(&mut self, node: Node<'a, 'i>, parent: Option<usize>, depth: usize) -> Result<(), Refusal> {
        let of = described("default", node);
        if depth > DEEPEST {
            return Err(Refusal(format!("{of} is nested more than {DEEPEST} deep")));
        }
        let at = match (parent, node.attribute("class")) {
            (None, _) => 0,
            (Some(_), None) => return Err(Refusal(format!("{of} has no `class`"))),
            (Some(parent), Some(class)) => {
                let inherited = self.classes.get(parent).map(|(_, inherited)| inherited.clone());
                self.classes.push((class, inherited.unwrap_or_default()));
                self.classes.len() - 1
            }
        };
        if let (None, Some(class)) = (parent, node.attribute("class")) {
            self.classes[0].0 = class;
        }
        let own = elements(node).filter(|child| child.tag_name().name() != "default");
        for child in own {
            let kind = shared(child.tag_name().name());
            let attributes =
                child.attributes().map(|attribute| ((kind, attribute.name()), attribute.value()));
            self.classes[at].1.extend(attributes);
        }
        elements_named(node, "default").try_for_each(|child| self.class(child, Some(at), depth + 1))
    }

    /// An element with its class, or that of the bodies around it.
    pub fn element(
        &self,
        node: Node<'a, 'i>,
        kind: &'static str,
        inherited: Option<&'a str>,
    ) -> Result<Element<'a, 'i, '_>, Refusal> {
        let of = described(node.tag_name().name(), node);
        let wanted = node.attribute("class").or(inherited);
        let found = match wanted {
            None => self.classes.first(),
            Some(class) => self.classes.iter().find(|(name, _)| *name == class),
        };
        let missing = || {
            Refusal(format!(
                "{of} has the class {}, which the file does not have",
                shown(wanted.unwrap_or_default())
            ))
        };
        let (_, attributes) = found.ok_or_else(missing)?;
        Ok(Element { node, kind: shared(kind), attributes, of })
    }
}

/// An element with the attributes of its class.
pub(super) struct Element<'a, 'i, 'c> {
    pub node: Node<'a, 'i>,
    kind: &'static str,
    attributes: &'c Attributes<'a>,
    /// What it is in messages.
    pub of: String,
}

impl<'a> Element<'a, '_, '_> {
    pub fn get(&self, attribute: &str) -> Option<&'a str> {
        let own = self.node.attributes().find(|own| own.name() == attribute).map(|own| own.value());
        own.or_else(|| {
            let inherited =
                self.attributes.iter().find(|((kind, name), _)| *kind == self.kind && *name == attribute);
            inherited.map(|(_, value)| *value)
        })
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
