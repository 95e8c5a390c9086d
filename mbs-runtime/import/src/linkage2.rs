//! Files `.linkage2` of Linkage (David Rector): XML with connectors, and links through them.
//!
//! A connector may be an anchor on the ground, an input that turns the links on it, or a
//! slider on the line between two others. A positive speed turns clockwise.

use super::xml::{Document, Node};

use super::geometry::minus;
use super::linkage::{Drive, GROUND, Linkage, Motion, Slot};
use super::{Refusal, shown};

/// Reads a file. Its lengths count as mm unless a unit is given, also where the program shows inches.
pub(super) fn read(text: &str) -> Result<Linkage, Refusal> {
    let document = Document::parse(text)?;
    let root = document.root();
    if root.name() != "linkage2" {
        return Err(Refusal("its root is not `linkage2`".into()));
    }
    let mut reader = Reader { linkage: Linkage::new("Linkage", "mm"), known: Vec::new() };
    reader.scale(root);
    for node in parts(root, &["connector"]) {
        reader.connector(node)?;
    }
    for node in parts(root, &["Link", "element"]) {
        reader.link(node)?;
    }
    for node in parts(root, &["connector"]) {
        reader.slider(node)?;
        reader.input(node)?;
    }
    if let Some(ratios) = parts(root, &["ratios"]).find(|node| node.elements().next().is_some())
        && parts(ratios, &["ratio"]).next().is_some()
    {
        return Err(Refusal("it has gears or chains, which are not imported".into()));
    }
    Ok(reader.linkage)
}

/// The parts of a node with one of these names.
fn parts<'a>(of: Node<'a>, names: &'static [&'static str]) -> impl Iterator<Item = Node<'a>> {
    of.elements().filter(|node| names.contains(&node.name()))
}

fn is_set(node: Node<'_>, attribute: &str) -> bool {
    node.attribute(attribute) == Some("true")
}

/// A number of an attribute, which has to be there.
fn number(node: Node<'_>, attribute: &str, of: &str) -> Result<f64, Refusal> {
    let text = node.attribute(attribute).ok_or_else(|| Refusal(format!("{of} has no `{attribute}`")))?;
    let number = text.trim().parse::<f64>().ok().filter(|number| number.is_finite());
    number.ok_or_else(|| Refusal(format!("{of}: `{attribute}` = {} is no number", shown(text))))
}

struct Reader<'a> {
    linkage: Linkage,
    /// The connectors' numbers; their places in the list are those of the pins.
    known: Vec<&'a str>,
}

impl<'a> Reader<'a> {
    fn scale(&mut self, root: Node<'_>) {
        let program = parts(root, &["program"]).next();
        let attribute = |name: &str| program.and_then(|node| node.attribute(name));
        if attribute("units").is_some_and(|units| units.eq_ignore_ascii_case("inches")) {
            self.linkage
                .note("The program shows inches; its file has them in the units of its drawing, as mm here");
        }
        if attribute("scalefactor")
            .and_then(|factor| factor.parse::<f64>().ok())
            .is_some_and(|factor| factor != 1.0)
        {
            self.linkage.note("The file has a `scalefactor`, which was not applied; --unit gives its unit");
        }
    }

    /// The pin of a connector by its number.
    fn find(&self, node: Node<'_>, by: &str) -> Result<usize, Refusal> {
        let id =
            node.attribute("id").ok_or_else(|| Refusal(format!("{by} refers to a part without its `id`")))?;
        let known = self.known.iter().position(|known| *known == id);
        known.ok_or_else(|| Linkage::missing("the connector", id, by))
    }

    fn connector(&mut self, node: Node<'a>) -> Result<(), Refusal> {
        let id = node.attribute("id").ok_or_else(|| Refusal("a connector has no `id`".into()))?;
        let of = format!("the connector {}", shown(id));
        if self.known.contains(&id) {
            return Err(Refusal(format!("{of} is there twice")));
        }
        let at = [number(node, "x", &of)?, number(node, "y", &of)?];
        let name = node.attribute("name").filter(|name| !name.is_empty()).unwrap_or(id);
        let pin = self.linkage.pin(&label(name, "c"), of, at)?;
        self.known.push(id);
        if is_set(node, "anchor") {
            self.linkage.links[GROUND].pins.push(pin);
        }
        Ok(())
    }

    fn link(&mut self, node: Node<'_>) -> Result<(), Refusal> {
        let id = node.attribute("id").ok_or_else(|| Refusal("a link has no `id`".into()))?;
        let of = format!("the link {}", shown(id));
        for (attribute, what) in [("actuator", "an actuator"), ("gear", "a gear")] {
            if is_set(node, attribute) {
                return Err(Refusal(format!("{of} is {what}, which is not imported")));
            }
        }
        if node.attribute("fastenlink").is_some() || node.attribute("fastenconnector").is_some() {
            return Err(Refusal(format!("{of} is fastened to another part, which is not imported")));
        }
        if is_set(node, "measurementelement") {
            self.linkage.note(format!("{of} is a measurement of the drawing: it was left out"));
            return Ok(());
        }
        let pins = parts(node, &["connector"]).map(|node| self.find(node, &of)).collect::<Result<_, _>>()?;
        let name = node.attribute("name").filter(|name| !name.is_empty()).unwrap_or(id);
        self.linkage.link(&label(name, "link"), of, pins);
        Ok(())
    }

    /// A connector that slides between two others of one link.
    fn slider(&mut self, node: Node<'_>) -> Result<(), Refusal> {
        let limits: Vec<_> = parts(node, &["slidelimit"]).collect();
        if !is_set(node, "slider") || limits.len() < 2 {
            return Ok(());
        }
        let pin = self.find(node, "a slider")?;
        let of = self.linkage.pins[pin].of.clone();
        if number(node, "slideradius", &of).is_ok_and(|radius| radius != 0.0) {
            return Err(Refusal(format!("{of} slides along an arc (`slideradius`), which is not imported")));
        }
        let [first, second] = [self.find(limits[0], &of)?, self.find(limits[1], &of)?];
        let links = &self.linkage.links;
        let both = |link: &usize| [first, second].iter().all(|pin| links[*link].pins.contains(pin));
        let Some(link) = (0..links.len()).find(both) else {
            return Err(Refusal(format!("{of} slides between two connectors that no link has both of")));
        };
        let through = self.linkage.pins[first].at;
        let along = minus(self.linkage.pins[second].at, through);
        if along == [0.0; 2] {
            return Err(Refusal(format!("{of} slides between two connectors at one place")));
        }
        self.linkage
            .note(format!("{of} stops at the ends of its slot in Linkage; here its line has no ends"));
        self.linkage.slots.push(Slot { pin, rider: None, link, through, along, keeps_angle: false });
        Ok(())
    }

    /// An input turns each link that is on it.
    fn input(&mut self, node: Node<'_>) -> Result<(), Refusal> {
        if !is_set(node, "input") {
            return Ok(());
        }
        let pin = self.find(node, "an input")?;
        let of = self.linkage.pins[pin].of.clone();
        if !is_set(node, "anchor") {
            return Err(Refusal(format!(
                "{of} is an input that is no anchor; only motors on the ground are imported"
            )));
        }
        if number(node, "limitangle", &of).is_ok_and(|limit| limit > 0.0) {
            self.linkage.note(format!("{of} turns back at its `limitangle` in Linkage; here it goes on"));
        }
        let rpm = number(node, "rpm", &of)?;
        let anchors = &self.linkage.links[GROUND].pins;
        let is_held = |link: &usize| {
            self.linkage.links[*link].pins.iter().filter(|pin| anchors.contains(pin)).count() > 1
        };
        let links: Vec<usize> = self.linkage.on(pin).filter(|link| !is_held(link)).collect();
        for link in links.into_iter().filter(|link| *link != GROUND) {
            let Some(&to) = self.linkage.links[link].pins.iter().find(|other| **other != pin) else {
                continue;
            };
            // clockwise
            let motion = Motion::Rpm(-rpm);
            self.linkage.drives.push(Drive {
                link,
                against: GROUND,
                of: of.clone(),
                start: None,
                from: pin,
                to,
                motion,
            });
        }
        Ok(())
    }
}

/// A number as a name.
fn label(name: &str, before: &str) -> String {
    if name.starts_with(|letter: char| letter.is_ascii_digit()) {
        format!("{before}{name}")
    } else {
        name.to_owned()
    }
}
