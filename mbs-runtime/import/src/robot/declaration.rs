//! A planar robot written in the language.

use super::digits::{angle, sum, term, tidy};
use super::flat::{Closed, Coordinate, Flat, Freedom, Held, Measure, Part};
use super::{GROUND, Kind, freedom};
use crate::declaration::{Line, Written, number};
use crate::geometry::{Point, distance, minus};
use crate::mobility::Mobility;
use crate::naming::{Names, camel};
use crate::{Refusal, shown};

/// The endings of names that belong to a body.
const OF_A_BODY: [&str; 2] = ["_mass", "_inertia"];

/// Those that belong to a joint: its rows, its coordinate, its output, its spring and its rotor.
const OF_A_JOINT: [&str; 16] = [
    "_x",
    "_y",
    "_normal",
    "_angle",
    "_position",
    "_q",
    "_stiffness",
    "_damping",
    "_rest",
    "_pull",
    "_spring",
    "_reaction",
    "_armature",
    "_rotor",
    "_turn",
    "_gear",
];

/// The declaration of a robot from `file`.
///
/// # Errors
/// Springs and actuators on slides that the language has no place for.
pub(super) fn written(
    flat: &Flat<'_>,
    notes: &[String],
    program: &str,
    name: &str,
    file: &str,
) -> Result<Written, Refusal> {
    let mobility = freedom::of(flat);
    let mut writer = Writer::new(flat);
    writer.head(notes, [program, name, file], &mobility);
    writer.bodies();
    writer.joints();
    writer.closings();
    writer.coordinates();
    for at in 0..flat.coordinates.len() {
        writer.spring(at)?;
        writer.rotor(at);
    }
    writer.couplings();
    writer.actuators()?;
    writer.start();
    writer.outputs();
    writer.line("", "}");
    let links = flat.parts.len() - 1;
    Ok(Written { lines: writer.lines, links, dof: mobility.dof, repeated: mobility.repeated })
}

pub(super) struct Writer<'a> {
    pub(super) flat: &'a Flat<'a>,
    pub(super) names: Names,
    lines: Vec<Line>,
    /// Names of the parts with their coordinates x, y and angle.
    pub(super) parts: Vec<(String, [String; 3])>,
    /// Those of the coordinates.
    pub(super) coordinates: Vec<String>,
    closings: Vec<String>,
    /// Angles of rotors, with where they begin.
    pub(super) rotors: Vec<(String, f64)>,
}

impl<'a> Writer<'a> {
    fn new(flat: &'a Flat<'a>) -> Self {
        let mut names = Names::default();
        names.take("gravity", "gravity", &[]);
        let mut parts = vec![("ground".to_owned(), Default::default())];
        for part in flat.parts.iter().skip(1) {
            let name = names.take(&part.body.name, "body", &OF_A_BODY);
            let coordinates =
                ["x", "y", "angle"].map(|letter| names.take(&format!("{letter}_{name}"), letter, &[]));
            parts.push((name, coordinates));
        }
        let joint = |coordinate: &Coordinate<'_>| names.take(&coordinate.joint.name, "joint", &OF_A_JOINT);
        let coordinates = flat.coordinates.iter().map(joint).collect();
        let closings = flat
            .closings
            .iter()
            .map(|closed| names.take(&closed.closing.name, "closing", &OF_A_JOINT))
            .collect();
        Self { flat, names, lines: Vec::new(), parts, coordinates, closings, rotors: Vec::new() }
    }

    /// A line that comes from a part of the file, if that has a name.
    pub(super) fn line(&mut self, of: &str, text: impl Into<String>) {
        let of = (!of.is_empty()).then(|| of.to_owned());
        self.lines.push(Line { text: text.into(), of });
    }

    fn head(&mut self, notes: &[String], [program, name, file]: [&str; 3], mobility: &Mobility) {
        let of = if name.is_empty() { String::new() } else { format!(" {}", shown(name)) };
        let plane = &self.flat.plane.name;
        self.line(
            "",
            format!("// The mechanism{of} from the file {} of {program}, in its plane {plane}.", shown(file)),
        );
        for note in notes {
            let mut letters = note.chars();
            let first: String = letters.next().into_iter().flat_map(char::to_uppercase).collect();
            self.line("", format!("// {first}{}.", letters.as_str()));
        }
        let stem = file.split('.').next().unwrap_or_default();
        self.line("", format!("{} {{", camel(if name.is_empty() { stem } else { name })));
        self.line("", format!("    dof = {};", mobility.dof));
        self.line("", "    states = reduced;");
        if mobility.repeated > 0 {
            let repeated = mobility.repeated;
            self.line(
                "",
                format!("    redundant = minimum_norm;    // {repeated} of its constraints repeat others"),
            );
        }
        let [x, y] = self.flat.gravity.map(number);
        self.line("", format!("    gravity = ({x}, {y}) [m/s^2];"));
    }

    fn bodies(&mut self) {
        for (at, part) in self.flat.parts.iter().enumerate() {
            self.line("", "");
            let (name, [x, y, angle]) = self.parts[at].clone();
            let of = &part.body.of;
            if at != GROUND {
                let (mass, inertia) = (number(part.mass), number(part.inertia));
                self.line(of, format!("    param {name}_mass = {mass} [kg] where {name}_mass > 0;"));
                self.line(
                    of,
                    format!("    param {name}_inertia = {inertia} [kg*m^2] where {name}_inertia >= 0;"),
                );
                self.line(
                    of,
                    format!("    body {name} ({x}, {y}, {angle}) {{ mass = {name}_mass; inertia = {name}_inertia; }}"),
                );
            }
            self.points(at, part, &name);
        }
    }

    fn points(&mut self, at: usize, part: &Part<'_>, body: &str) {
        let mut places: Vec<Point> = Vec::new();
        let flat = self.flat;
        let firsts: Vec<(usize, &Held<'_>)> = self.firsts().collect();
        let held = firsts
            .iter()
            .map(|(first, held)| (&self.coordinates[*first], &held.joint.of, held.parts, held.at));
        let closed = flat.closings.iter().zip(&self.closings);
        let closed = closed.map(|(closed, name)| (name, &closed.closing.of, closed.parts, closed.at));
        let mut lines = Vec::new();
        for (name, of, parts, ends) in held.chain(closed) {
            for (_, place) in parts.into_iter().zip(ends).filter(|(part, _)| *part == at) {
                places.push(place);
                lines.push((of.clone(), name.clone(), place));
            }
        }
        for (mark, place) in &part.marks {
            let is_new = places.iter().all(|other| distance(*other, *place) > 1e-9 * flat.size);
            let is_wanted = !mark.is_shape || (is_new && places.len() < 2 && at != GROUND);
            if is_wanted {
                places.push(*place);
                let name = self.names.take(&mark.name, "mark", &[]);
                lines.push((mark.of.clone(), name, *place));
            }
        }
        for (of, name, place) in lines {
            let place = self.vector(minus(place, part.centre));
            self.line(&of, format!("    point {name} on {body} = {place} [m];"));
        }
    }

    /// The joints, each with its first coordinate.
    pub(super) fn firsts(&self) -> impl Iterator<Item = (usize, &'a Held<'a>)> + use<'a> {
        let flat = self.flat;
        let first = |held: usize| flat.coordinates.iter().position(|coordinate| coordinate.held == held);
        flat.joints.iter().enumerate().map(move |(at, held)| (first(at).unwrap_or_default(), held))
    }

    /// Places or directions to the digits that they have.
    fn vector(&self, [x, y]: Point) -> String {
        let size = self.flat.size;
        format!("({}, {})", tidy(x, size), tidy(y, size))
    }

    fn joints(&mut self) {
        self.line("", "");
        for (first, held) in self.firsts().collect::<Vec<_>>() {
            let name = self.coordinates[first].clone();
            let [body, parent] = held.parts.map(|part| self.parts[part].0.clone());
            let difference = self.difference(held.parts);
            let line = |[x, y]: Point| format!("along ({}, {})", tidy(x, 1.0), tidy(y, 1.0));
            let text = match held.freedom {
                Freedom::Turn => format!("revolute {name} ({body}.{name}, {parent}.{name});"),
                Freedom::Slide { along } => format!(
                    "prismatic {name} ({body}.{name}, {parent}.{name}) {} at {};",
                    line(along),
                    angle(difference)
                ),
                Freedom::SlideAndTurn { along } => {
                    format!("pin_slot {name} ({body}.{name}, {parent}.{name}) {};", line(along))
                }
                Freedom::TurnAndSlide { along } => {
                    format!("pin_slot {name} ({parent}.{name}, {body}.{name}) {};", line(along))
                }
                Freedom::Shift => {
                    let turned = self.turned(held.parts);
                    format!("constraint {name}_turn: {turned} = {};", angle(difference))
                }
                Freedom::All => continue,
            };
            self.line(&held.joint.of, format!("    {text}"));
        }
    }

    fn closings(&mut self) {
        for (closed, name) in self.flat.closings.iter().zip(self.closings.clone()) {
            let Closed { closing, parts, angle: kept, .. } = closed;
            let [first, second] = parts.map(|part| &self.parts[part].0);
            let places = format!("({first}.{name}, {second}.{name})");
            let text = match kept {
                Some(kept) => format!("    fixed {name} {places} at {};", angle(*kept)),
                None => format!("    revolute {name} {places};"),
            };
            self.line(&closing.of, text);
        }
    }

    /// The angle of the first part against the second, at the start.
    pub(super) fn difference(&self, parts: [usize; 2]) -> f64 {
        let [first, second] = parts.map(|part| self.flat.parts[part].angle);
        first - second
    }

    /// The same as a formula.
    fn turned(&self, [first, second]: [usize; 2]) -> String {
        let [first, second] = [first, second].map(|part| &self.parts[part].1[2]);
        if second.is_empty() { first.clone() } else { format!("{first} - {second}") }
    }

    /// The joints' coordinates, with the signs and the zeros that they have in the file.
    fn coordinates(&mut self) {
        self.line("", "");
        for (at, coordinate) in self.flat.coordinates.iter().enumerate() {
            let name = self.coordinates[at].clone();
            let held = &self.flat.joints[coordinate.held];
            let reference = coordinate.joint.reference;
            let text = match coordinate.measure {
                Measure::Angle { sign } => {
                    let turned = self.turned(held.parts);
                    let turned = match sign < 0.0 {
                        true if turned.contains(' ') => format!("-({turned})"),
                        true => format!("-{turned}"),
                        false => turned,
                    };
                    turned + &term(reference - sign * self.difference(held.parts), "rad")
                }
                Measure::Along { along, is_of_body } => {
                    self.travel(coordinate, along, is_of_body) + &term(reference, "m")
                }
            };
            self.line(&coordinate.joint.of, format!("    let {name}_q = {text};"));
        }
    }

    /// How far a body's point is along a direction.
    fn travel(&self, coordinate: &Coordinate<'_>, along: Point, is_of_body: bool) -> String {
        let held = &self.flat.joints[coordinate.held];
        let name = self.firsts().nth(coordinate.held).map_or("", |(first, _)| &self.coordinates[first]);
        let [body, parent] = held.parts.map(|part| &self.parts[part].0);
        let way = ["x", "y"].map(|axis| format!("({body}.{name}.{axis} - {parent}.{name}.{axis})"));
        let frame = &self.parts[if is_of_body { held.parts[0] } else { held.parts[1] }].1[2];
        let [u, v] = along.map(|entry| tidy(entry, 1.0));
        if frame.is_empty() {
            return sum([(&u, &way[0]), (&v, &way[1])]);
        }
        // the way in the frame of the direction
        let (sin, cos) = (format!("sin({frame})"), format!("cos({frame})"));
        let [x, y] = [
            format!("({}*{cos} + {}*{sin})", way[0], way[1]),
            format!("({}*{cos} - {}*{sin})", way[1], way[0]),
        ];
        sum([(&u, &x), (&v, &y)])
    }

    /// Where the file draws it. Angles of a tree are kept, so that others can be put in their
    /// place, unless they follow those of other joints; all the rest follows.
    fn start(&mut self) {
        self.line("", "");
        self.line("", "    start {");
        // A tree has one joint for each part that moves.
        let closes_no_loop = self.flat.closings.is_empty() && self.flat.joints.len() < self.flat.parts.len();
        let followers: Vec<usize> = self.flat.couplings.iter().map(|coupled| coupled.follower).collect();
        let hinges = self.flat.coordinates.iter().enumerate();
        let turns: Vec<usize> = hinges
            .filter(|(at, hinge)| hinge.joint.kind == Kind::Hinge && !followers.contains(at))
            .map(|(_, hinge)| self.flat.joints[hinge.held].parts[0])
            .filter(|part| !self.follows(*part, &followers))
            .collect();
        for (at, part) in self.flat.parts.iter().enumerate().skip(1) {
            let [x, y, turned] = &self.parts[at].1;
            let [cx, cy] = part.start(part.centre).map(|entry| tidy(entry, self.flat.size));
            let guess = if closes_no_loop && turns.contains(&at) { "" } else { "guess " };
            let value = angle(part.angle);
            let text =
                format!("        {guess}{turned} = {value}; guess {x} = {cx} [m]; guess {y} = {cy} [m];");
            self.line(&part.body.of, text);
        }
        for (turned, begin) in self.rotors.clone() {
            self.line("", format!("        guess {turned} = {} [rad];", tidy(begin, 1.0)));
        }
        self.line("", "    }");
    }

    /// `true` of a part that hangs on a joint which follows another one: it may be elsewhere than it is drawn.
    fn follows(&self, part: usize, followers: &[usize]) -> bool {
        let held = |at: &usize| self.flat.coordinates.get(*at).map(|coordinate| coordinate.held);
        let mut part = part;
        // of a tree, the way to the ground has fewer joints than there are parts
        for _ in 0..self.flat.parts.len() {
            let Some(joint) = self.flat.joints.iter().position(|joint| joint.parts[0] == part) else {
                return false;
            };
            if followers.iter().filter_map(held).any(|of| of == joint) {
                return true;
            }
            part = self.flat.joints[joint].parts[1];
        }
        false
    }

    /// An output for each joint's coordinate.
    fn outputs(&mut self) {
        self.line("", "");
        for (at, coordinate) in self.flat.coordinates.iter().enumerate() {
            let name = self.coordinates[at].clone();
            let (ending, unit) = match coordinate.joint.kind {
                Kind::Hinge => ("angle", "rad"),
                Kind::Slide => ("position", "m"),
            };
            self.line(&coordinate.joint.of, format!("    output {name}_{ending} [{unit}] = {name}_q;"));
        }
    }
}
