//! The declaration of a mechanism.

use std::fmt::Write as _;

use super::{Body, Joint, Kind, Mechanism, Place};

const NAMES: [&str; 3] = ["x", "y", "phi"];

impl Mechanism {
    /// Its text, with bodies and joints in these orders, `rank` of its rows independent.
    pub fn text(&self, states: &str, [bodies, joints]: [&[usize]; 2], rank: usize) -> String {
        let rows = self.joints.iter().map(|joint| joint.kind.rows()).sum::<usize>();
        let dof = self.coordinates().len() - rank;
        let mut text = format!("Drawn {{ dof = {dof}; states = {states};\n");
        if rank < rows {
            text += "redundant = minimum_norm;\n";
        }
        if self.gravity != [0.0; 2] {
            let _ = writeln!(text, "gravity = ({}, {}) [m/s^2];", self.gravity[0], self.gravity[1]);
        }
        for &at in bodies {
            self.bodies[at].write(at, &mut text);
        }
        for at in 0..self.own.len() {
            let _ = writeln!(text, "coordinate w{at} [m];");
        }
        for (at, particle) in self.particles.iter().enumerate() {
            let place = named(&format!("p{at}"), &particle.place, &mut text);
            let _ = writeln!(text, "particle p{at} at {place} {{ mass = {} [kg]; }}", particle.mass);
        }
        for &at in joints {
            self.joints[at].write(at, &mut text);
        }
        for (at, spring) in self.springs.iter().enumerate() {
            let [a, b] = pair(&format!("s{at}"), &spring.places, &mut text);
            let _ = writeln!(
                text,
                "spring s{at} ({a}, {b}) {{ stiffness = {} [N/m]; length = {} [m]; damping = {} [N*s/m]; }}",
                spring.stiffness, spring.length, spring.damping
            );
        }
        text += "start {";
        for (body, axis) in self.coordinates() {
            let Some(of) = self.bodies.get(body) else {
                let at = body - self.bodies.len();
                let _ = write!(text, " guess w{at} = {} [m];", self.own[at]);
                continue;
            };
            let unit = if axis < 2 { " [m]" } else { "" };
            let _ = write!(text, " guess {}{body} = {}{unit};", NAMES[axis], of.at[axis]);
        }
        text + " } }\n"
    }
}

impl Body {
    fn write(&self, at: usize, text: &mut String) {
        let named: Vec<String> =
            (0..3).filter(|&axis| self.has[axis]).map(|axis| format!("{}{at}", NAMES[axis])).collect();
        let (mut mass, mut inertia) = (format!("{} [kg]", self.mass), format!("{} [kg*m^2]", self.inertia));
        if self.is_parametric {
            let _ = writeln!(text, "param m{at} = {mass}; param i{at} = {inertia};");
            (mass, inertia) = (format!("m{at}"), format!("i{at}"));
        }
        let _ = write!(text, "body b{at} ({}) {{", named.join(", "));
        if self.has[0] || self.has[1] {
            let _ = write!(text, " mass = {mass};");
        }
        if self.has[2] {
            let _ = write!(text, " inertia = {inertia};");
        }
        *text += " }\n";
    }
}

impl Kind {
    pub(super) fn rows(&self) -> usize {
        match self {
            Self::PointOnLine { .. } | Self::PinSlot { .. } | Self::Distance { .. } => 1,
            Self::Revolute | Self::Prismatic { .. } | Self::Rolling { .. } => 2,
        }
    }
}

impl Joint {
    fn write(&self, at: usize, text: &mut String) {
        let [a, b] = pair(&format!("j{at}"), &self.places, text);
        let (word, rest) = match self.kind {
            Kind::Revolute => ("revolute", String::new()),
            Kind::PointOnLine { along: [u, v] } => ("point_on_line", format!(" along ({u}, {v})")),
            Kind::PinSlot { along: [u, v] } => ("pin_slot", format!(" along ({u}, {v})")),
            Kind::Prismatic { along: [u, v], at } => ("prismatic", format!(" along ({u}, {v}) at {at}")),
            Kind::Distance { length } => ("distance", format!(" = {length} [m]")),
            Kind::Rolling { along: [u, v], radius, at } => {
                ("rolling", format!(" along ({u}, {v}) radius {radius} [m] at {at} [m]"))
            }
        };
        let _ = writeln!(text, "{word} j{at} ({a}, {b}){rest};");
    }
}

/// Declares two places and gives their names.
fn pair(name: &str, places: &[Place; 2], text: &mut String) -> [String; 2] {
    [("a", places[0]), ("b", places[1])].map(|(end, place)| named(&format!("{name}{end}"), &place, text))
}

/// Declares a place, if it is no centre, and gives its name.
fn named(name: &str, place: &Place, text: &mut String) -> String {
    let body = place.body.map_or("ground".to_owned(), |at| format!("b{at}"));
    let [x, y] = place.local;
    match place.moves {
        None if [x, y] == [0.0; 2] => return body,
        None => {
            let _ = writeln!(text, "point {name} on {body} = ({x} [m], {y} [m]);");
        }
        Some((own, [u, v])) => {
            let _ = writeln!(text, "point {name} on {body} = ({x} [m] + {u}*w{own}, {y} [m] + {v}*w{own});");
        }
    }
    format!("{body}.{name}")
}
