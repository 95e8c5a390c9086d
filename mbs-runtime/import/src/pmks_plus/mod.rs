//! Files and web addresses of PMKS+ (PMKS-Web), version 2: records between points, their numbers in
//! digits of base 64.
//!
//! A slider is a joint that slides, and a block between it and the pin at the same place. Its line is
//! the ground's, or goes through two joints of a link.

mod digits;
mod records;

use super::Refusal;
use super::address::query;
use super::geometry::{Point, distance, from, minus};
use super::linkage::{self, Drive, GROUND, Linkage, Motion, Slot};
use super::masses::{Mass, outline};
use records::{Drawing, Force, Joint, Link, Settings};

/// The speed of a slide where a text says nothing, in lengths per second.
const USUAL_SLIDE: f64 = 5.0;

/// The units that a drawing is in: of lengths; kg of a mass, the same in the inertia; N of a force.
const UNITS: [(&str, f64, f64, f64); 3] = [
    ("inch", 0.453_592_37, 0.453_592_37, 4.448_221_615_260_5),
    ("cm", 0.001, 1.0, 1.0),
    ("m", 1.0, 1.0, 1.0),
];

/// True if a text begins as a file or an address does.
pub(super) fn is_begun(text: &str) -> bool {
    records::is_begun(&content(text))
}

/// The part of a web address behind `?`; all of a file.
fn content(text: &str) -> String {
    query(text).unwrap_or_else(|| text.trim().to_owned())
}

/// Reads a text.
pub(super) fn read(text: &str) -> Result<Linkage, Refusal> {
    let text = content(text);
    let drawing = records::read(&text)?;
    let units = UNITS.iter().enumerate().find(|(at, _)| drawing.settings.length_unit == *at as f64);
    let Some((_, &units)) = units else {
        return Err(Refusal("its lengths are in none of the units inch, cm and m".into()));
    };
    let mut linkage = Linkage::new("PMKS+", units.0);
    (linkage.has_unit, linkage.says_gravity) = (true, true);
    linkage.has_gravity = !drawing.settings.weightless;
    let mut builder = Builder { drawing: &drawing, units, linkage, links: Vec::new() };
    builder.pins()?;
    builder.links()?;
    builder.slides()?;
    builder.inputs()?;
    for force in &drawing.forces {
        builder.force(force)?;
    }
    Ok(builder.linkage)
}

struct Builder<'a> {
    drawing: &'a Drawing<'a>,
    units: (&'static str, f64, f64, f64),
    linkage: Linkage,
    /// The links of the text by the numbers that they have in the linkage.
    links: Vec<(&'a str, usize)>,
}

impl<'a> Builder<'a> {
    /// The pins have the numbers of the joints.
    fn pins(&mut self) -> Result<(), Refusal> {
        let joints = &self.drawing.joints;
        for (at, joint) in joints.iter().enumerate() {
            if joints[..at].iter().any(|other| other.id == joint.id) {
                return Err(Refusal(format!("{} is there twice", joint.of)));
            }
            if joint.is_cylinder {
                return Err(Refusal(format!("{} is a cylinder, which is not imported", joint.of)));
            }
            let name = if joint.name.is_empty() { joint.id } else { joint.name };
            let pin = self.linkage.pin(name, joint.of.clone(), joint.at)?;
            if joint.is_grounded && !joint.slides {
                self.linkage.links[GROUND].pins.push(pin);
            }
        }
        Ok(())
    }

    fn joint(&self, id: &str, by: &str) -> Result<usize, Refusal> {
        let at = self.drawing.joints.iter().position(|joint| joint.id == id);
        at.ok_or_else(|| Linkage::missing("the joint", id, by))
    }

    /// The links that are bodies.
    fn links(&mut self) -> Result<(), Refusal> {
        self.drawing.links.iter().filter(|link| link.is_root).try_for_each(|link| self.link(link))
    }

    fn link(&mut self, link: &'a Link<'a>) -> Result<(), Refusal> {
        let pins = link.joints.iter().map(|id| self.joint(id, &link.of)).collect::<Result<Vec<_>, _>>()?;
        let pins: Vec<usize> = pins.into_iter().filter(|pin| !self.drawing.joints[*pin].slides).collect();
        if link.is_block {
            // A block without a mass is the pin in its slot.
            let turns = pins.first().is_some_and(|pin| !self.drawing.joints[*pin].is_welded);
            if link.mass > 0.0 && !turns {
                self.linkage.note(format!("The mass of {} is not carried over: its pin is welded", link.of));
            }
            if link.mass <= 0.0 || !turns || pins.len() != 1 {
                return Ok(());
            }
        }
        let name = if link.name.is_empty() { link.id } else { link.name };
        let number = self.linkage.link(name, link.of.clone(), pins);
        self.linkage.links[number].mass = self.mass(link, number);
        if !link.is_block && link.mass > 0.0 && link.inertia <= 0.0 {
            self.linkage.note(format!("{} has no inertia in the file: it has that of thin bars", link.of));
        }
        self.links.push((link.id, number));
        self.links.extend(link.parts.iter().map(|part| (*part, number)));
        Ok(())
    }

    /// The mass that the text says, with the inertia of thin bars where it says none.
    fn mass(&self, link: &Link<'_>, number: usize) -> Option<Mass> {
        let (_, kilograms, of_inertia, _) = self.units;
        let mass = kilograms * link.mass;
        let pins = &self.linkage.links[number].pins;
        let places: Vec<Point> = pins.iter().map(|pin| self.linkage.pins[*pin].at).collect();
        let bars = outline(&places);
        let size = self.linkage.size();
        let (centre, inertia) = match link.is_block {
            // A hundredth of the drawing is the size of a block.
            true => (places.first().copied().unwrap_or_default(), mass * (0.01 * size).powi(2)),
            false if link.inertia > 0.0 => (link.centre, of_inertia * link.inertia),
            false => (link.centre, mass * bars.inertia / bars.length),
        };
        let is_sound = mass > 0.0 && inertia > 0.0 && centre.iter().all(|number| number.abs() < 1e9);
        is_sound.then_some(Mass { mass, inertia, centre })
    }

    fn number(&self, id: &str, by: &str) -> Result<usize, Refusal> {
        let known = self.links.iter().find(|(known, _)| *known == id);
        known.map(|(_, number)| *number).ok_or_else(|| Linkage::missing("the link", id, by))
    }

    /// Each joint that slides holds the pin behind its block on a line.
    fn slides(&mut self) -> Result<(), Refusal> {
        for joint in self.drawing.joints.iter().filter(|joint| joint.slides) {
            let pin = self.pin_of_slide(joint)?;
            let (link, through, along) = match joint.slot {
                Some([link, a, b]) => {
                    let [a, b] = [self.joint(a, &joint.of)?, self.joint(b, &joint.of)?];
                    let [a, b] = [a, b].map(|joint| self.drawing.joints[joint].at);
                    (self.number(link, &joint.of)?, a, minus(b, a))
                }
                None if joint.is_grounded => (GROUND, joint.at, from([0.0; 2], 1.0, joint.angle)),
                None => return Err(Refusal(format!("{} slides on no link", joint.of))),
            };
            if along == [0.0; 2] {
                return Err(Refusal(format!("{} slides between two joints at one place", joint.of)));
            }
            // A block that is a link does not turn; a welded pin holds the link on it as a block.
            let rider = self.linkage.on(pin).find(|rider| self.is_block(*rider));
            let keeps_angle = rider.is_some() || self.drawing.joints[pin].is_welded;
            self.linkage.slots.push(Slot { pin, rider, link, through, along, keeps_angle });
        }
        Ok(())
    }

    fn is_block(&self, number: usize) -> bool {
        let id = self.links.iter().find(|(_, known)| *known == number).map(|(id, _)| *id);
        self.drawing.links.iter().any(|link| link.is_block && Some(link.id) == id)
    }

    /// The pin at the other end of the block of a joint that slides.
    fn pin_of_slide(&self, joint: &Joint<'_>) -> Result<usize, Refusal> {
        let mut blocks =
            self.drawing.links.iter().filter(|link| link.is_block && link.joints.contains(&joint.id));
        let Some(block) = blocks.next() else {
            return Err(Refusal(format!("{} slides and has no block", joint.of)));
        };
        let pins = block.joints.iter().map(|id| self.joint(id, &block.of)).collect::<Result<Vec<_>, _>>()?;
        let mut pins = pins.into_iter().filter(|pin| !self.drawing.joints[*pin].slides);
        let (Some(pin), None) = (pins.next(), pins.next()) else {
            return Err(Refusal(format!("{} is a block with more or less than one pin", block.of)));
        };
        if distance(self.linkage.pins[pin].at, joint.at) > 1e-3 * self.linkage.size() {
            return Err(Refusal(format!("{} is at another place than its pin", joint.of)));
        }
        Ok(pin)
    }

    fn inputs(&mut self) -> Result<(), Refusal> {
        let inputs: Vec<usize> =
            (0..self.drawing.joints.len()).filter(|joint| self.drawing.joints[*joint].is_input).collect();
        if inputs.is_empty() {
            self.linkage
                .note("No joint is an input: the mechanism moves freely; a `drive` would turn a link");
        }
        for at in inputs {
            let joint = &self.drawing.joints[at];
            if !joint.is_grounded {
                return Err(Refusal(format!(
                    "{} is an input that is not on the ground; only motors on the ground are imported",
                    joint.of
                )));
            }
            if joint.slides { self.pushed(joint)? } else { self.turned(at, joint) }
        }
        Ok(())
    }

    fn turned(&mut self, pin: usize, joint: &Joint<'_>) {
        let Settings { rpm, clockwise, .. } = self.drawing.settings;
        let rpm = joint.speed.unwrap_or(if clockwise { -rpm } else { rpm });
        let links: Vec<usize> = self.linkage.on(pin).filter(|link| *link != GROUND).collect();
        for link in links {
            let others = &self.linkage.links[link].pins;
            let to = others.iter().copied().find(|other| *other != pin).unwrap_or(pin);
            let (of, motion) = (joint.of.clone(), Motion::Rpm(rpm));
            self.linkage.drives.push(Drive { link, against: GROUND, of, start: None, from: pin, to, motion });
        }
    }

    fn pushed(&mut self, joint: &Joint<'_>) -> Result<(), Refusal> {
        let pin = self.pin_of_slide(joint)?;
        let Some(link) = self.linkage.on(pin).find(|link| *link != GROUND) else { return Ok(()) };
        let speed = joint.speed.or(self.drawing.settings.slide_speed).unwrap_or_else(|| {
            let unit = self.units.0;
            self.linkage
                .note(format!("The file says no speed of {}: {USUAL_SLIDE} {unit}/s is assumed", joint.of));
            USUAL_SLIDE
        });
        let motion = Motion::Slide { along: from([0.0; 2], 1.0, joint.angle), speed };
        let of = joint.of.clone();
        self.linkage.drives.push(Drive {
            link,
            against: GROUND,
            of,
            start: None,
            from: pin,
            to: pin,
            motion,
        });
        Ok(())
    }

    fn force(&mut self, force: &Force<'_>) -> Result<(), Refusal> {
        let link = self.number(force.link, &force.of)?;
        let along = minus(force.to, force.from);
        let length = distance(force.to, force.from);
        if length == 0.0 {
            return Err(Refusal(format!("{} has no direction", force.of)));
        }
        let newtons = self.units.3 * force.magnitude * if force.points_outward { 1.0 } else { -1.0 };
        let name = if force.name.is_empty() { force.id } else { force.name };
        self.linkage.forces.push(linkage::Force {
            name: name.to_owned(),
            of: force.of.clone(),
            link,
            at: force.from,
            force: along.map(|part| newtons * part / length),
            turns: force.turns,
        });
        Ok(())
    }
}
