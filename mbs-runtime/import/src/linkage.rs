//! A linkage as the files of other programs describe it: rigid links that share pins.

use super::geometry::{Point, distance};
use super::masses::Mass;
use super::{Refusal, shown};

/// The link that does not move, among the links of a [`Linkage`].
pub(super) const GROUND: usize = 0;

/// A mechanism is at most this large: compiling takes seconds then.
const MOST_LINKS: usize = 200;
const MOST_PINS: usize = 1000;

/// Pins, links, slots and drives with the names and numbers of a file.
#[derive(Debug)]
pub(super) struct Linkage {
    /// Its name in the file.
    pub name: String,
    /// The program that wrote the file.
    pub program: &'static str,
    /// The unit of lengths.
    pub unit: String,
    /// True if the file says the unit.
    pub has_unit: bool,
    /// True if weights act, along −y.
    pub has_gravity: bool,
    /// True if the file says so.
    pub says_gravity: bool,
    /// The length of a step, where the file counts time in steps.
    pub has_steps: bool,
    pub pins: Vec<Pin>,
    /// The first one is the ground.
    pub links: Vec<Link>,
    pub slots: Vec<Slot>,
    pub drives: Vec<Drive>,
    pub forces: Vec<Force>,
    /// Notes on what was assumed, and on what was not carried over.
    pub notes: Vec<String>,
}

/// A place where links are joined, or which a link only carries.
#[derive(Debug)]
pub(super) struct Pin {
    pub name: String,
    /// Its name in messages, in the words of the file.
    pub of: String,
    /// Its place at the start.
    pub at: Point,
}

/// A rigid part.
#[derive(Debug)]
pub(super) struct Link {
    pub name: String,
    /// Its name in messages, in the words of the file.
    pub of: String,
    pub pins: Vec<usize>,
    /// The mass, where the file says it; a thin bar otherwise.
    pub mass: Option<Mass>,
}

/// A force on a point of a link.
#[derive(Debug)]
pub(super) struct Force {
    pub name: String,
    /// Its name in messages, in the words of the file.
    pub of: String,
    pub link: usize,
    /// Where it acts at the start.
    pub at: Point,
    /// The force at the start, in N.
    pub force: Point,
    /// True if it turns with the link.
    pub turns: bool,
}

/// A pin that slides along a line of a link.
#[derive(Debug)]
pub(super) struct Slot {
    pub pin: usize,
    /// The link that slides; nothing is the first other one on the pin.
    pub rider: Option<usize>,
    /// The link that has the line.
    pub link: usize,
    /// A point of the line, at the start.
    pub through: Point,
    /// The line's direction at the start.
    pub along: Point,
    /// True if the link that slides keeps its angle against the other one.
    pub keeps_angle: bool,
}

/// A motor between two links.
#[derive(Debug)]
pub(super) struct Drive {
    pub link: usize,
    /// The link that carries the motor.
    pub against: usize,
    /// Its name in messages, in the words of the file.
    pub of: String,
    /// The polar angle in rad of `to` seen from `from` at t = 0, where the file says it.
    pub start: Option<f64>,
    /// The pins whose direction is the angle.
    pub from: usize,
    pub to: usize,
    pub motion: Motion,
}

/// How a motor turns.
#[derive(Debug)]
pub(super) enum Motion {
    /// Revolutions per minute.
    Rpm(f64),
    /// Radians per step of the program.
    PerStep(f64),
    /// A motor that pushes the pin `to` along a direction, by so many lengths per second.
    Slide { along: Point, speed: f64 },
    /// Forth and back between two angles in rad, with so many radians per step.
    Swing { per_step: f64, from: f64, to: f64 },
}

impl Linkage {
    pub fn new(program: &'static str, unit: &str) -> Self {
        let ground = Link { name: "ground".into(), of: "the ground".into(), pins: Vec::new(), mass: None };
        Self {
            name: String::new(),
            program,
            unit: unit.into(),
            has_unit: false,
            has_gravity: true,
            says_gravity: false,
            has_steps: false,
            pins: Vec::new(),
            links: vec![ground],
            slots: Vec::new(),
            drives: Vec::new(),
            forces: Vec::new(),
            notes: Vec::new(),
        }
    }

    /// The unit of lengths, as the caller knows it.
    ///
    /// # Errors
    /// Another unit than the one of the file.
    pub fn say_unit(&mut self, unit: &str) -> Result<(), Refusal> {
        if self.has_unit && self.unit != unit {
            return Err(Refusal(format!(
                "its lengths are in {}; --unit is for files that leave their unit open",
                self.unit
            )));
        }
        unit.clone_into(&mut self.unit);
        Ok(())
    }

    /// One more pin.
    ///
    /// # Errors
    /// A place that is none.
    pub fn pin(&mut self, name: &str, of: String, at: Point) -> Result<usize, Refusal> {
        // Squares and cubes of lengths stay numbers.
        if !at.iter().all(|number| number.abs() < 1e9) {
            return Err(Refusal(format!("{of} has no place within 1e9 {} of the origin", self.unit)));
        }
        // Readers look for pins by their names among all others.
        if self.pins.len() >= MOST_PINS {
            return Err(Refusal(format!(
                "it has more than {MOST_PINS} joints, which is the most that is imported"
            )));
        }
        self.pins.push(Pin { name: name.to_owned(), of, at });
        Ok(self.pins.len() - 1)
    }

    /// One more link.
    pub fn link(&mut self, name: &str, of: String, pins: Vec<usize>) -> usize {
        self.links.push(Link { name: name.to_owned(), of, pins, mass: None });
        self.links.len() - 1
    }

    pub fn note(&mut self, note: impl Into<String>) {
        self.notes.push(note.into());
    }

    /// The links that a pin is on.
    pub fn on(&self, pin: usize) -> impl Iterator<Item = usize> {
        self.links.iter().enumerate().filter(move |(_, link)| link.pins.contains(&pin)).map(|(at, _)| at)
    }

    /// The link that slides in a slot.
    pub fn rider(&self, slot: &Slot) -> Option<usize> {
        let said = slot.rider.filter(|rider| *rider != slot.link);
        said.or_else(|| self.on(slot.pin).find(|link| *link != slot.link))
    }

    /// The same mechanism in which two links share at most one pin, and every link that moves
    /// is held by something.
    ///
    /// # Errors
    /// Pins of a link at one place, what is too large, and what nothing of moves.
    pub fn normalized(mut self) -> Result<Self, Refusal> {
        if self.links.len() > MOST_LINKS || self.pins.len() > MOST_PINS {
            let (links, pins) = (self.links.len() - 1, self.pins.len());
            return Err(Refusal(format!(
                "it has {links} links and {pins} joints; at most {MOST_LINKS} and {MOST_PINS} are imported"
            )));
        }
        for link in &mut self.links {
            let mut seen = Vec::new();
            link.pins.retain(|pin| {
                !seen.contains(pin) && {
                    seen.push(*pin);
                    true
                }
            });
        }
        while let Some((kept, gone)) = self.twins() {
            self.merge(kept, gone);
        }
        self.drop_idle();
        if self.links.len() == 1 {
            return Err(Refusal("nothing in it moves: no link has two joints".into()));
        }
        for link in self.links.iter().skip(1) {
            if let Some((a, b)) = self.coincident(link) {
                let (a, b) = (&self.pins[a].of, &self.pins[b].of);
                return Err(Refusal(format!("{} has {a} and {b} at one place", link.of)));
            }
        }
        Ok(self)
    }

    /// Two links that share two pins, and so are one rigid part.
    fn twins(&self) -> Option<(usize, usize)> {
        let shared = |a: &Link, b: &Link| a.pins.iter().filter(|pin| b.pins.contains(pin)).count();
        let pairs = (0..self.links.len()).flat_map(|a| (a + 1..self.links.len()).map(move |b| (a, b)));
        pairs.into_iter().find(|&(a, b)| shared(&self.links[a], &self.links[b]) > 1)
    }

    fn merge(&mut self, kept: usize, gone: usize) {
        let note = format!(
            "{} and {} share two joints: they are one part",
            self.links[kept].of, self.links[gone].of
        );
        self.note(note);
        let Link { pins, mass, .. } = self.links.remove(gone);
        self.links[kept].mass = self.links[kept].mass.zip(mass).map(|(a, b)| a.joined(b));
        for pin in pins {
            if !self.links[kept].pins.contains(&pin) {
                self.links[kept].pins.push(pin);
            }
        }
        self.renumber(|link| if link == gone { kept } else { link - usize::from(link > gone) });
        let mut left = Vec::new();
        for drive in std::mem::take(&mut self.drives) {
            if drive.link == drive.against {
                self.note(format!("{} turns what does not move: it was left out", drive.of));
            } else {
                left.push(drive);
            }
        }
        self.drives = left;
    }

    /// Leaves out links that hold nothing together.
    fn drop_idle(&mut self) {
        let is_held = |link: &Self, at: usize| {
            let slides =
                link.slots.iter().any(|slot| slot.link == at || link.links[at].pins.contains(&slot.pin));
            link.links[at].pins.len() > 1 || slides
        };
        let mut at = 1;
        while at < self.links.len() {
            if is_held(self, at) {
                at += 1;
                continue;
            }
            let gone = self.links.remove(at);
            self.note(format!("{} has fewer than two joints and holds nothing: it was left out", gone.of));
            self.drives.retain(|drive| drive.link != at && drive.against != at);
            self.forces.retain(|force| force.link != at);
            self.renumber(|link| link - usize::from(link > at));
        }
    }

    fn renumber(&mut self, new: impl Fn(usize) -> usize) {
        for slot in &mut self.slots {
            (slot.link, slot.rider) = (new(slot.link), slot.rider.map(&new));
        }
        for drive in &mut self.drives {
            (drive.link, drive.against) = (new(drive.link), new(drive.against));
        }
        self.forces.iter_mut().for_each(|force| force.link = new(force.link));
    }

    /// Two pins of a link that are at one place.
    fn coincident(&self, link: &Link) -> Option<(usize, usize)> {
        let pairs =
            link.pins.iter().enumerate().flat_map(|(at, &a)| link.pins[..at].iter().map(move |&b| (b, a)));
        let mut pairs = pairs;
        // Nearer than any drawing is exact.
        pairs.find(|&(a, b)| distance(self.pins[a].at, self.pins[b].at) < 1e-9 * self.size())
    }

    /// How far the pins are apart, at least 1e-300.
    pub fn size(&self) -> f64 {
        let extent = |axis: usize| {
            let places = self.pins.iter().map(|pin| pin.at[axis]);
            let (low, high) =
                places.fold((f64::MAX, f64::MIN), |(low, high), at| (low.min(at), high.max(at)));
            high - low
        };
        extent(0).max(extent(1)).max(1e-300)
    }

    /// The refusal of a file that refers to a thing that it does not have.
    pub fn missing(what: &str, name: &str, by: &str) -> Refusal {
        Refusal(format!("{by} refers to {what} {}, which the file does not have", shown(name)))
    }
}
