//! A linkage written in the language.

use super::geometry::{Point, distance, minus, polar, turned};
use super::linkage::{Drive, GROUND, Link, Linkage, Motion, Slot};
use super::masses::{Outline, outline};
use super::naming::{Names, camel};
use super::{Refusal, mobility, shown};

/// A declaration, with what each line came from.
pub(super) struct Written {
    pub lines: Vec<Line>,
    /// How many links move.
    pub links: usize,
    /// Where it is drawn.
    pub dof: usize,
    /// Number of its constraints that repeat others where it is drawn.
    pub repeated: usize,
}

/// A line of a declaration.
pub(super) struct Line {
    pub text: String,
    /// The part of the file that it came from.
    pub of: Option<String>,
}

/// The declaration of a linkage from `file`.
///
/// # Errors
/// A linkage with more motors than can turn.
pub(super) fn written(linkage: &Linkage, file: &str) -> Result<Written, Refusal> {
    let mobility = mobility::of(linkage);
    let mut writer = Writer::new(linkage);
    writer.head(file, &mobility);
    writer.parameters();
    writer.bodies();
    writer.joints();
    writer.slots();
    writer.forces();
    writer.drives();
    writer.start();
    writer.outputs();
    writer.line("}");
    let links = linkage.links.len() - 1;
    Ok(Written { lines: writer.lines, links, dof: mobility.dof, repeated: mobility.repeated })
}

/// A link as it is declared.
struct Body {
    name: String,
    /// The coordinates: x, y, angle.
    coordinates: [String; 3],
    /// At the start, in the unit of the file.
    centre: Point,
    /// At the start, in rad: the direction of the second pin from the first.
    angle: f64,
    /// A length by name, where the link is a bar.
    length: Option<String>,
}

struct Writer<'a> {
    linkage: &'a Linkage,
    names: Names,
    lines: Vec<Line>,
    /// One for each link, the ground too.
    bodies: Vec<Body>,
    /// The names of the pins.
    pins: Vec<String>,
}

/// The endings of names that belong to a link: its length, its mass, its motor and the motor's speed.
const OF_A_LINK: [&str; 5] = ["_length", "_mass", "_inertia", "_motor", "_speed"];

/// Those that belong to a joint: the rows of its equations, its outputs, and its slot.
const OF_A_PIN: [&str; 5] = ["_x", "_y", "_slot", "_slot_normal", "_slot_angle"];

/// Names of parameters and other statements that a declaration may have.
const OWN: [&str; 5] = ["density", "block_mass", "block_inertia", "step_time", "gravity"];

impl<'a> Writer<'a> {
    fn new(linkage: &'a Linkage) -> Self {
        let mut names = Names::default();
        for own in OWN {
            names.take(own, own, &[]);
        }
        let mut bodies = vec![Body {
            name: "ground".into(),
            coordinates: Default::default(),
            centre: [0.0; 2],
            angle: 0.0,
            length: None,
        }];
        for link in linkage.links.iter().skip(1) {
            let name = names.take(&link.name, "link", &OF_A_LINK);
            let coordinates =
                ["x", "y", "angle"].map(|letter| names.take(&format!("{letter}_{name}"), letter, &[]));
            let places: Vec<Point> = link.pins.iter().map(|pin| linkage.pins[*pin].at).collect();
            let is_bar = places.len() == 2 && link.mass.is_none();
            let length = is_bar.then(|| format!("{name}_length"));
            let angle = if let [first, second, ..] = places[..] { polar(minus(second, first)) } else { 0.0 };
            let centre = link.mass.map_or_else(|| outline(&places).centre, |mass| mass.centre);
            bodies.push(Body { name, coordinates, centre, angle, length });
        }
        let pins = linkage.pins.iter().map(|pin| names.take(&pin.name, "joint", &OF_A_PIN)).collect();
        Self { linkage, names, lines: Vec::new(), bodies, pins }
    }

    fn line(&mut self, text: impl Into<String>) {
        self.lines.push(Line { text: text.into(), of: None });
    }

    fn line_of(&mut self, of: &str, text: impl Into<String>) {
        self.lines.push(Line { text: text.into(), of: Some(of.into()) });
    }

    fn head(&mut self, file: &str, mobility: &mobility::Mobility) {
        let Linkage { name, program, unit, notes, .. } = self.linkage;
        let of = if name.is_empty() { String::new() } else { format!(" {}", shown(name)) };
        self.line(format!(
            "// The linkage{of} from the file {} of {program}. Lengths are in {unit}.",
            shown(file)
        ));
        let massless = self.massless().count();
        if massless + 1 == self.linkage.links.len() {
            self.line("// The file has no masses: links are thin bars between their joints, of `density`.");
        } else if massless > 0 {
            self.line(
                "// Links without a mass in the file are thin bars between their joints, of `density`.",
            );
        }
        for note in notes {
            self.line(format!("// Note: {note}."));
        }
        let stem = file.split('.').next().unwrap_or_default();
        self.line(format!("{} {{", camel(if name.is_empty() { stem } else { name })));
        self.line(format!("    dof = {};", mobility.dof));
        if mobility.repeated > 0 {
            let repeated = mobility.repeated;
            self.line(format!(
                "    redundant = minimum_norm;    // {repeated} of its constraints repeat others"
            ));
        }
    }

    /// The links that move and whose mass is assumed.
    fn massless(&self) -> impl Iterator<Item = &'a Link> + use<'a> {
        self.linkage.links.iter().skip(1).filter(|link| link.mass.is_none())
    }

    fn parameters(&mut self) {
        if self.massless().next().is_some() {
            self.line("    /// Mass of the links per length; assumed.");
            self.line("    param density = 1 [kg/m] where density > 0;");
        }
        if self.massless().any(|link| link.pins.len() < 2) {
            self.line("    /// Mass of a block that slides; assumed.");
            self.line("    param block_mass = 0.1 [kg] where block_mass > 0;");
            self.line("    /// Inertia of a block that slides; assumed.");
            self.line("    param block_inertia = 1e-5 [kg*m^2] where block_inertia > 0;");
        }
        if self.linkage.has_steps {
            self.line(format!("    /// Time of a step of {}; assumed.", self.linkage.program));
            self.line("    param step_time = 10 [ms] where step_time > 0;");
        }
        if self.linkage.has_gravity {
            let remark = if self.linkage.says_gravity { "" } else { "    // assumed" };
            self.line(format!("    gravity = (0, -9.81) [m/s^2];{remark}"));
        }
    }

    fn bodies(&mut self) {
        for (at, link) in self.linkage.links.iter().enumerate() {
            self.line("");
            if at != GROUND {
                let (mass, inertia) = self.mass(at, link);
                let Body { name, coordinates: [x, y, angle], .. } = &self.bodies[at];
                let text =
                    format!("    body {name} ({x}, {y}, {angle}) {{ mass = {mass}; inertia = {inertia}; }}");
                self.line_of(&link.of, text);
            }
            for (order, &pin) in link.pins.iter().enumerate() {
                let place = self.place(at, order, pin);
                let Body { name, .. } = &self.bodies[at];
                let text = format!("    point {} on {name} = {place};", self.pins[pin]);
                self.line_of(&self.linkage.pins[pin].of, text);
            }
        }
    }

    /// The mass and the inertia of a link, and the lines of the parameters that they take.
    fn mass(&mut self, at: usize, link: &Link) -> (String, String) {
        let unit = &self.linkage.unit;
        let places: Vec<Point> = link.pins.iter().map(|pin| self.linkage.pins[*pin].at).collect();
        let name = self.bodies[at].name.clone();
        if let Some(mass) = link.mass {
            let (kilograms, inertia) = (number(mass.mass), number(mass.inertia));
            let names = [format!("{name}_mass"), format!("{name}_inertia")];
            let [m, j] = &names;
            self.line_of(&link.of, format!("    param {m} = {kilograms} [kg] where {m} > 0;"));
            self.line_of(&link.of, format!("    param {j} = {inertia} [kg*{unit}^2] where {j} > 0;"));
            return names.into();
        }
        if let Some(length) = self.bodies[at].length.clone() {
            let value = number(distance(places[0], places[1]));
            self.line_of(&link.of, format!("    param {length} = {value} [{unit}] where {length} > 0;"));
            return (format!("density*{length}"), format!("density*{length}^3/12"));
        }
        if places.len() < 2 {
            return ("block_mass".into(), "block_inertia".into());
        }
        let Outline { length, inertia, .. } = outline(&places);
        let (length, inertia) = (number(length), number(inertia));
        (format!("density*({length} [{unit}])"), format!("density*({inertia} [{unit}^3])"))
    }

    /// Where a pin is in the frame of a link.
    fn place(&self, link: usize, order: usize, pin: usize) -> String {
        match (&self.bodies[link].length, order) {
            (Some(length), 0) => format!("(-{length}/2, 0)"),
            (Some(length), _) => format!("({length}/2, 0)"),
            _ => self.vector(self.local(link, self.linkage.pins[pin].at)),
        }
    }

    /// A place of the start in the frame of a link.
    fn local(&self, link: usize, at: Point) -> Point {
        let body = &self.bodies[link];
        turned(minus(at, body.centre), -body.angle)
    }

    fn vector(&self, [x, y]: Point) -> String {
        format!("({}, {}) [{}]", number(x), number(y), self.linkage.unit)
    }

    fn joints(&mut self) {
        self.line("");
        for (at, pin) in self.linkage.pins.iter().enumerate() {
            let links: Vec<usize> = self.linkage.on(at).collect();
            let name = self.pins[at].clone();
            for (order, &link) in links.iter().enumerate().skip(1) {
                let joint =
                    if order == 1 { name.clone() } else { self.names.take(&name, "joint", &["_x", "_y"]) };
                let (first, second) = (&self.bodies[links[0]].name, &self.bodies[link].name);
                self.line_of(&pin.of, format!("    revolute {joint} ({first}.{name}, {second}.{name});"));
            }
        }
    }

    fn slots(&mut self) {
        for slot in &self.linkage.slots {
            let pin = &self.linkage.pins[slot.pin];
            match self.linkage.rider(slot) {
                Some(rider) => self.slot(slot, rider),
                None => self.line(format!("    // {} carries no link that could slide.", pin.of)),
            }
        }
    }

    fn slot(&mut self, slot: &Slot, rider: usize) {
        let pin = &self.linkage.pins[slot.pin];
        let name = self.pins[slot.pin].clone();
        let earlier = self.linkage.slots.iter().take_while(|other| !std::ptr::eq(*other, slot));
        let joint = match earlier.filter(|other| other.pin == slot.pin).count() {
            0 => format!("{name}_slot"),
            _ => self.names.take(&format!("{name}_slot"), "slot", &["_normal", "_angle"]),
        };
        let line = self.vector(self.local(slot.link, slot.through));
        let (first, second) = (&self.bodies[rider], &self.bodies[slot.link]);
        let [x, y] = turned(slot.along, -second.angle);
        let along = format!("({}, {})", number(x), number(y));
        let at = number((first.angle - second.angle).to_degrees());
        let (first, second) = (first.name.clone(), second.name.clone());
        self.line_of(&pin.of, format!("    point {joint} on {second} = {line};"));
        let joint_of = if slot.keeps_angle {
            format!("    prismatic {joint} ({first}.{name}, {second}.{joint}) along {along} at {at} [deg];")
        } else {
            format!("    pin_slot {joint} ({first}.{name}, {second}.{joint}) along {along};")
        };
        self.line_of(&pin.of, joint_of);
    }

    fn forces(&mut self) {
        for force in &self.linkage.forces {
            self.line("");
            let name = self.names.take(&force.name, "force", &["_point"]);
            let place = self.vector(self.local(force.link, force.at));
            let body = &self.bodies[force.link];
            let (along, frame) = if force.turns {
                (turned(force.force, -body.angle), format!(" in {}", body.name))
            } else {
                (force.force, String::new())
            };
            let ([x, y], body) = (along.map(number), body.name.clone());
            self.line_of(&force.of, format!("    point {name}_point on {body} = {place};"));
            let text = format!("    force {name} on {body}.{name}_point{frame} = ({x}, {y}) [N];");
            self.line_of(&force.of, text);
        }
    }

    fn drives(&mut self) {
        for drive in &self.linkage.drives {
            self.line("");
            self.drive(drive);
        }
    }

    fn drive(&mut self, drive: &Drive) {
        let (body, carrier) = (&self.bodies[drive.link], &self.bodies[drive.against]);
        let name = body.name.clone();
        let drawn = polar(minus(self.linkage.pins[drive.to].at, self.linkage.pins[drive.from].at));
        // The angle of the body is that of its first two pins, which may be others.
        let offset = body.angle - drawn - carrier.angle;
        let start = number(drive.start.unwrap_or(drawn) + offset);
        let mut what = format!("{name}.angle");
        if drive.against != GROUND {
            what = format!("{what} - {}.angle", carrier.name);
        }
        let (motor, speed) = (format!("{name}_motor"), format!("{name}_speed"));
        let turned = match drive.motion {
            Motion::Rpm(rpm) => {
                self.line_of(&drive.of, format!("    param {speed} = {} [rpm];", number(rpm)));
                format!("{start} [rad] + {speed}*t")
            }
            Motion::PerStep(angle) => {
                self.line_of(&drive.of, format!("    /// Angle of a step of {}.", self.linkage.program));
                self.line_of(&drive.of, format!("    param {speed} = {} [rad];", number(angle)));
                format!("{start} [rad] + {speed}/step_time*t")
            }
            Motion::Slide { along: [x, y], speed: value } => {
                let (pin, unit) = (&self.linkage.pins[drive.to], &self.linkage.unit);
                let place = number(x * pin.at[0] + y * pin.at[1]);
                let point = format!("{name}.{}", self.pins[drive.to]);
                what = format!("{}*{point}.x + {}*{point}.y", number(x), number(y));
                let value = number(value);
                let text = format!("    param {speed} = {value} [{unit}/s];");
                let start = format!("{place} [{unit}] + {speed}*t");
                self.line_of(&drive.of, text);
                start
            }
            Motion::Swing { per_step, from, to } => {
                let (half, middle) = (0.5 * (to - from), 0.5 * (to + from));
                let phase = ((drive.start.unwrap_or(from) - middle) / half).clamp(-1.0, 1.0).asin();
                let [half_text, middle, phase] = [half, middle + offset, phase].map(number);
                self.line_of(
                    &drive.of,
                    format!("    /// Part of the swing in a step of {}.", self.linkage.program),
                );
                self.line_of(&drive.of, format!("    param {speed} = {};", number(per_step / half)));
                format!("{middle} [rad] + {half_text} [rad]*sin({phase} + {speed}/step_time*t)")
            }
        };
        self.line_of(&drive.of, format!("    drive {motor}: {what} = {turned};"));
    }

    fn start(&mut self) {
        self.line("");
        self.line("    start {");
        for body in self.bodies.iter().skip(1).map(|body| {
            let [x, y, angle] = &body.coordinates;
            let ([cx, cy], unit) = (body.centre.map(number), &self.linkage.unit);
            let degrees = number(body.angle.to_degrees());
            format!("        guess {x} = {cx} [{unit}]; guess {y} = {cy} [{unit}]; guess {angle} = {degrees} [deg];")
        }).collect::<Vec<_>>() {
            self.line(body);
        }
        self.line("    }");
    }

    /// Where each pin that moves is.
    fn outputs(&mut self) {
        self.line("");
        for (at, pin) in self.linkage.pins.iter().enumerate() {
            let mut links = self.linkage.on(at).peekable();
            let Some(&link) = links.peek() else { continue };
            if link == GROUND {
                continue;
            }
            let (name, body, unit) = (&self.pins[at], &self.bodies[link].name, &self.linkage.unit);
            let text =
                ["x", "y"].map(|axis| format!("output {name}_{axis} [{unit}] = {body}.{name}.{axis};"));
            self.line_of(&pin.of, format!("    {}    {}", text[0], text[1]));
        }
    }
}

/// A number that reads back the same.
pub(super) fn number(value: f64) -> String {
    // no minus before a zero
    let value = if value == 0.0 { 0.0 } else { value };
    let plain = format!("{value}");
    if plain.len() <= 24 { plain } else { format!("{value:e}") }
}
