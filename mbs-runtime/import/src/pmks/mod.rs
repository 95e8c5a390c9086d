//! Files of PMKS, the Planar Mechanism Kinematic Simulator (M. I. Campbell): its text files, its web
//! addresses, and its JSON files `.pmks` of 2019.
//!
//! A joint is `R` (its links turn), `RP` (they turn and slide along a line of its first link) or `P`
//! (they slide). A joint on one link is a point that is traced. One joint is driven.

mod json;
mod text;

use super::Refusal;
use super::geometry::{Point, from};
use super::linkage::{Drive, GROUND, Linkage, Motion, Slot};
use crate::shown;

pub(super) use text::is_begun;

/// The speed of the input where a file says nothing, in rpm or in lengths per second.
const USUAL_SPEED: f64 = 10.0;

/// Reads a file.
pub(super) fn read(text: &str) -> Result<Linkage, Refusal> {
    let sheet = if text.trim_start().starts_with('{') { json::read(text)? } else { text::read(text)? };
    sheet.linkage()
}

/// The table of joints, which all forms of file have.
#[derive(Default)]
struct Sheet {
    name: String,
    joints: Vec<Joint>,
    /// The number of the joint that is driven, where the file says it.
    input: Option<usize>,
    speed: Option<Speed>,
    notes: Vec<String>,
}

/// How fast the input moves.
#[derive(Clone, Copy)]
enum Speed {
    /// In rpm, or in lengths per second where it slides.
    OfThePage(f64),
    /// In rad/s, or in lengths per second where it slides.
    OfTheLibrary(f64),
}

/// A joint as it is written.
struct Joint {
    kind: Kind,
    at: Point,
    /// The angle of the line that it slides along, in rad.
    angle: f64,
    links: Vec<String>,
}

#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Revolute,
    Slot,
    Prismatic,
}

impl Kind {
    /// # Errors
    /// A kind that is not imported.
    fn of(word: &str, of: &str) -> Result<Self, Refusal> {
        match word.to_ascii_uppercase().as_str() {
            "R" => Ok(Self::Revolute),
            "RP" => Ok(Self::Slot),
            "P" => Ok(Self::Prismatic),
            "G" => Err(Refusal(format!("{of} is a contact of gear teeth (G), which is not imported"))),
            _ => Err(Refusal(format!("{of} is of the kind {}, not R, P or RP", shown(word)))),
        }
    }
}

impl Sheet {
    fn linkage(self) -> Result<Linkage, Refusal> {
        let mut builder = Builder { linkage: Linkage::new("PMKS", "mm"), links: vec!["ground".into()] };
        let linkage = &mut builder.linkage;
        linkage.name.clone_from(&self.name);
        linkage.note("Lengths of PMKS have no unit; they count as mm, if --unit says nothing else");
        self.notes.iter().for_each(|note| linkage.note(note.clone()));
        let input = self.input(linkage)?;
        // Points that are traced come last: a joint that is drawn at the same place counts instead.
        let is_traced = |joint: &Joint| joint.links.len() < 2;
        let mut pins = vec![0; self.joints.len()];
        for traced in [false, true] {
            let joints = self.joints.iter().enumerate();
            for (at, joint) in joints.filter(|(_, joint)| is_traced(joint) == traced) {
                pins[at] = builder.joint(at, joint, Some(at) == input)?;
            }
        }
        if let Some(at) = input {
            let (joint, pin) = (&self.joints[at], pins[at]);
            builder.drive(joint, pin, self.speed)?;
        }
        Ok(builder.linkage)
    }

    /// The joint that is driven: the one that the file says, or the first that can be.
    fn input(&self, linkage: &mut Linkage) -> Result<Option<usize>, Refusal> {
        if let Some(input) = self.input {
            let Some(joint) = self.joints.get(input) else {
                return Err(Refusal(format!(
                    "its input is the joint P{input}, which the file does not have"
                )));
            };
            if joint.kind == Kind::Slot {
                return Err(Refusal(format!(
                    "the joint P{input} is the input and of the kind RP: it has two freedoms"
                )));
            }
            if joint.links.len() < 2 {
                return Err(Refusal(format!("the joint P{input} is the input and on one link alone")));
            }
            return Ok(Some(input));
        }
        let can_be = |joint: &Joint| joint.links.len() > 1 && joint.kind != Kind::Slot;
        let first = self.joints.iter().position(can_be);
        if let Some(first) = first {
            linkage.note(format!("The file marks no input: the joint P{first} is driven, as PMKS does"));
        }
        Ok(first)
    }
}

struct Builder {
    linkage: Linkage,
    /// The names of the links, in the order of the linkage's.
    links: Vec<String>,
}

impl Builder {
    fn link(&mut self, name: &str) -> usize {
        let name = if is_ground(name) { "ground" } else { name };
        self.links.iter().position(|known| known == name).unwrap_or_else(|| {
            self.links.push(name.into());
            self.linkage.link(name, format!("the link {}", shown(name)), Vec::new())
        })
    }

    /// One more joint; its pin, which may be there already.
    fn joint(&mut self, number: usize, joint: &Joint, is_input: bool) -> Result<usize, Refusal> {
        let name = format!("P{number}");
        let of = format!("the joint {name}");
        let mut on: Vec<usize> = Vec::new();
        for name in &joint.links {
            let link = self.link(name);
            if !on.contains(&link) {
                on.push(link);
            }
        }
        if joint.links.len() > 1 && on.len() < 2 {
            return Err(Refusal(format!("{of} is on one link twice")));
        }
        if joint.kind == Kind::Revolute || on.len() < 2 {
            return self.pin(&name, of, joint.at, &on);
        }
        // The line of a driven slide is that of the ground.
        if is_input && on.contains(&GROUND) {
            on.sort_unstable();
        }
        let keeps_angle = joint.kind == Kind::Prismatic;
        if keeps_angle && on.len() > 2 {
            return Err(Refusal(format!("{of} slides without turning and joins more than two links")));
        }
        let pin = self.pin(&name, of, joint.at, &on[1..])?;
        let along = from([0.0; 2], 1.0, joint.angle);
        let (rider, link, through) = (Some(on[1]), on[0], joint.at);
        self.linkage.slots.push(Slot { pin, rider, link, through, along, keeps_angle });
        Ok(pin)
    }

    /// A pin on links, which may be there already: a block has its pin and its slide at one place.
    fn pin(&mut self, name: &str, of: String, at: Point, links: &[usize]) -> Result<usize, Refusal> {
        let pin = match self.same_place(at, links) {
            Some(pin) => {
                let other = &self.linkage.pins[pin].of;
                self.linkage.note(format!("{of} is at the place of {other}: both are one point"));
                pin
            }
            None => self.linkage.pin(name, of, at)?,
        };
        links.iter().for_each(|link| self.linkage.links[*link].pins.push(pin));
        Ok(pin)
    }

    /// A pin at a place that one of the links has.
    fn same_place(&self, at: Point, links: &[usize]) -> Option<usize> {
        let pins = &self.linkage.pins;
        let mut on = links.iter().flat_map(|link| &self.linkage.links[*link].pins);
        on.find(|pin| pins[**pin].at == at).copied()
    }

    fn drive(&mut self, joint: &Joint, pin: usize, speed: Option<Speed>) -> Result<(), Refusal> {
        let of = self.linkage.pins[pin].of.clone();
        let [first, second] = [&joint.links[0], &joint.links[1]].map(|name| self.link(name));
        let slides = joint.kind == Kind::Prismatic;
        let (against, link) = self.sides(first, second);
        if slides && against != GROUND {
            return Err(Refusal(format!(
                "{of} drives a slide between two links that both move, which is not imported"
            )));
        }
        let unit = if slides { format!("{}/s", self.linkage.unit) } else { "rpm".into() };
        if speed.is_none() {
            self.linkage.note(format!(
                "The file says no speed: {of} moves with {USUAL_SPEED} {unit}, as PMKS has it"
            ));
        }
        let motion = if slides {
            let (Speed::OfThePage(speed) | Speed::OfTheLibrary(speed)) =
                speed.unwrap_or(Speed::OfThePage(USUAL_SPEED));
            Motion::Slide { along: upward(joint.angle), speed }
        } else {
            match speed.unwrap_or(Speed::OfThePage(USUAL_SPEED)) {
                Speed::OfThePage(rpm) => Motion::Rpm(rpm),
                Speed::OfTheLibrary(rate) => Motion::Rpm(rate * 30.0 / std::f64::consts::PI),
            }
        };
        let others = &self.linkage.links[link].pins;
        // Any direction of the link does as the one that its angle is counted from.
        let to = if slides { pin } else { others.iter().copied().find(|other| *other != pin).unwrap_or(pin) };
        self.linkage.drives.push(Drive { link, against, of, start: None, from: pin, to, motion });
        Ok(())
    }

    /// The link that carries a motor and the one that it moves. Where neither is the ground, PMKS
    /// holds the one with two joints.
    fn sides(&self, first: usize, second: usize) -> (usize, usize) {
        let joints = |link: usize| self.linkage.links[link].pins.len();
        match (first, second) {
            (GROUND, _) => (first, second),
            (_, GROUND) => (second, first),
            _ if joints(first) >= 2 || joints(second) < 2 => (first, second),
            _ => (second, first),
        }
    }
}

/// The direction of a slide, which PMKS keeps between −90° and 90°.
fn upward(angle: f64) -> Point {
    let half = std::f64::consts::FRAC_PI_2;
    let mut angle = angle.rem_euclid(2.0 * half);
    if angle > half {
        angle -= 2.0 * half;
    }
    from([0.0; 2], 1.0, angle)
}

/// The names that PMKS knows the ground by.
fn is_ground(name: &str) -> bool {
    let name = name.to_ascii_lowercase();
    ["0", "gnd", "grnd", "grond", "gound", "groud"].contains(&name.as_str()) || name.starts_with("ground")
}
