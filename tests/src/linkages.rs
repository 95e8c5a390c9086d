//! Random mechanisms that a person might declare: bodies placed in the plane and
//! joined where they are, so that they are assembled as they are made; trees and
//! loops, gears, racks, rolling wheels, cams, springs and assemblies.

use std::f64::consts::PI;
use std::fmt::Write as _;

use crate::random::Random;

/// A body with three coordinates, where it starts.
#[derive(Clone, Copy)]
struct Placed {
    x: f64,
    y: f64,
    angle: f64,
    /// True if a pivot in its centre holds it to the ground.
    is_pivoted: bool,
}

impl Placed {
    /// A point of the plane in the body's frame.
    fn local(&self, (x, y): (f64, f64)) -> (f64, f64) {
        let (sin, cos) = self.angle.sin_cos();
        let (x, y) = (x - self.x, y - self.y);
        (cos * x + sin * y, cos * y - sin * x)
    }
}

/// A mechanism under construction.
struct Linkage {
    random: Random,
    bodies: Vec<Placed>,
    points: usize,
    statements: usize,
    coordinates: i64,
    rows: i64,
    text: String,
    start: String,
}

/// The declaration with this number: always the same.
pub fn declaration(number: u64) -> String {
    let mut linkage = Linkage {
        random: Random::new(number),
        bodies: Vec::new(),
        points: 0,
        statements: 0,
        coordinates: 0,
        rows: 0,
        text: String::new(),
        start: String::new(),
    };
    let bodies = 1 + linkage.random.below(8);
    for _ in 0..bodies {
        linkage.body();
        linkage.join();
    }
    for _ in 0..linkage.random.below(3) {
        linkage.close_loop();
    }
    for _ in 0..linkage.random.below(4) {
        linkage.transmission();
    }
    for _ in 0..linkage.random.below(4) {
        linkage.element();
    }
    if linkage.random.once_in(4) {
        linkage.pendulums();
    }
    linkage.drives();
    let Linkage { text, start, coordinates, rows, .. } = linkage;
    let dof = coordinates - rows;
    let states = if number.is_multiple_of(2) { "all" } else { "reduced" };
    format!(
        "pub Random{number} {{\ndof = {dof};\nstates = {states};\ngravity = (0, -9.81) [m/s^2];\n{text}start {{ {start}}}\n}}\n"
    )
}

impl Linkage {
    fn write(&mut self, statement: &str) {
        self.text.push_str(statement);
        self.text.push('\n');
    }

    fn next_name(&mut self, kind: &str) -> String {
        self.statements += 1;
        format!("{kind}{}", self.statements)
    }

    /// A free body at a random place, massless now and then.
    fn body(&mut self) {
        let at = self.bodies.len();
        let [x, y] = self.random.around_zero(1.5);
        let angle = self.random.between(-PI, PI);
        let mass = if self.random.once_in(12) { 0.0 } else { self.random.between(0.1, 5.0) };
        let inertia = if self.random.once_in(6) { 0.0 } else { self.random.between(0.01, 1.0) };
        self.bodies.push(Placed { x, y, angle, is_pivoted: false });
        self.coordinates += 3;
        self.write(&format!(
            "body b{at} (x{at}, y{at}, angle{at}) {{ mass = {mass:.4} [kg]; inertia = {inertia:.4} [kg*m^2]; }}"
        ));
        let _ =
            write!(self.start, "guess x{at} = {x} [m]; guess y{at} = {y} [m]; guess angle{at} = {angle}; ");
    }

    /// A point of a body, or of the ground, at a place of the plane; its name.
    fn point(&mut self, body: Option<usize>, place: (f64, f64)) -> String {
        self.points += 1;
        let (name, (x, y)) = match body {
            Some(at) => (format!("b{at}"), self.bodies[at].local(place)),
            None => ("ground".to_owned(), place),
        };
        let point = format!("p{}", self.points);
        self.write(&format!("point {point} on {name} = ({x} [m], {y} [m]);"));
        format!("{name}.{point}")
    }

    /// Joins the last body to an earlier one or to the ground.
    fn join(&mut self) {
        let last = self.bodies.len() - 1;
        let earlier = self.random.below(self.bodies.len());
        let other = (earlier < last).then_some(earlier);
        if other.is_none() && self.random.once_in(3) {
            // a pivot in the centre, where gears sit
            let Placed { x, y, .. } = self.bodies[last];
            let ground = self.point(None, (x, y));
            let name = self.next_name("pivot");
            self.rows += 2;
            self.bodies[last].is_pivoted = true;
            self.write(&format!("revolute {name} (b{last}, {ground});"));
            return;
        }
        self.connect(last, other);
    }

    /// A joint between a body and another or the ground, at a random place.
    fn connect(&mut self, body: usize, other: Option<usize>) {
        let [x, y] = self.random.around_zero(1.5);
        let first = self.point(Some(body), (x, y));
        let angle = other.map_or(0.0, |at| self.bodies[at].angle);
        let kind = self.random.below(12);
        let name = self.next_name("joint");
        // a direction in the second body's frame
        let turn = self.random.between(-PI, PI);
        let (along_x, along_y) = (turn.cos(), turn.sin());
        match kind {
            0 => {
                let (dx, dy) = (self.random.between(0.2, 1.0), self.random.between(-1.0, 1.0));
                let second = self.point(other, (x + dx, y + dy));
                let length = dx.hypot(dy);
                self.rows += 1;
                self.write(&format!("distance {name} ({first}, {second}) = {length} [m];"));
            }
            1 | 2 => {
                // the second point lies behind, along the direction
                let world = turn + angle;
                let reach = self.random.between(0.1, 1.0);
                let second = self.point(other, (x - reach * world.cos(), y - reach * world.sin()));
                let relative = self.bodies[body].angle - angle;
                if kind == 1 {
                    self.rows += 1;
                    self.write(&format!("pin_slot {name} ({first}, {second}) along ({along_x}, {along_y});"));
                } else {
                    self.rows += 2;
                    self.write(&format!(
                        "prismatic {name} ({first}, {second}) along ({along_x}, {along_y}) at {relative};"
                    ));
                }
            }
            3 => {
                let second = self.point(other, (x, y));
                let relative = self.bodies[body].angle - angle;
                self.rows += 3;
                self.write(&format!("fixed {name} ({first}, {second}) at {relative};"));
            }
            4 => {
                // a wheel on the left of a line of the second body
                let Placed { x, y, angle: own, .. } = self.bodies[body];
                let (world, radius) = (turn + angle, self.random.between(0.1, 0.5));
                let second = self.point(other, (x + radius * world.sin(), y - radius * world.cos()));
                let at = radius * (own - angle);
                self.rows += 2;
                self.write(&format!(
                    "rolling {name} (b{body}, {second}) along ({along_x}, {along_y}) radius {radius} [m] at {at} [m];"
                ));
            }
            _ => {
                let second = self.point(other, (x, y));
                self.rows += 2;
                self.write(&format!("revolute {name} ({first}, {second});"));
            }
        }
    }

    /// A joint between two bodies that are there.
    fn close_loop(&mut self) {
        let body = self.random.below(self.bodies.len());
        let other = self.random.below(self.bodies.len() + 1);
        if other != body {
            self.connect(body, (other < self.bodies.len()).then_some(other));
        }
    }

    /// A pivoted body beside others, coupled to one of them.
    fn transmission(&mut self) {
        let pivoted: Vec<usize> = (0..self.bodies.len()).filter(|&at| self.bodies[at].is_pivoted).collect();
        let Some(&driven) = pivoted.last() else { return };
        let (r1, r2) = (self.random.between(0.1, 0.5), self.random.between(0.1, 0.5));
        let name = self.next_name("mesh");
        let other = self.random.below(self.bodies.len());
        if other == driven {
            return self.follower(driven);
        }
        let [a, b] = [self.bodies[other].angle, self.bodies[driven].angle];
        let (kind, at) = *self.random.of(&[
            ("gear", a + r2 / r1 * b),
            ("internal_gear", a - r2 / r1 * b),
            ("belt", a - r2 / r1 * b),
            ("crossed_belt", a + r2 / r1 * b),
        ]);
        self.rows += 1;
        self.write(&format!("{kind} {name} (b{other}, b{driven}) radii ({r1} [m], {r2} [m]) at {at};"));
    }

    /// A cam on a pivoted body that lifts a valve, or a rack that it moves.
    fn follower(&mut self, disk: usize) {
        let Placed { x, y, angle, .. } = self.bodies[disk];
        let name = self.next_name("follower");
        self.coordinates += 1;
        self.rows += 1;
        if self.random.once_in(2) {
            let radius = self.random.between(0.1, 0.4);
            self.write(&format!("body v{name} (x = s{name}) {{ mass = 0.7 [kg]; }}"));
            let at = x + radius * angle;
            self.write(&format!(
                "rack {name} (b{disk}, v{name}) along (1, 0) radius {radius} [m] at {at} [m];"
            ));
        } else {
            let lift = self.random.between(0.01, 0.1);
            // the follower slides on the vertical line x = 0, away from the disk
            let reach = 2.0 + x.hypot(y);
            self.write(&format!("body v{name} (y = s{name}) {{ mass = 0.4 [kg]; }}"));
            let lobes = 1 + self.random.below(3);
            self.write(&format!(
                "cam {name} (b{disk}, v{name}) = {reach} [m] + {lift} [m]*cos({lobes}*angle);"
            ));
            let _ = write!(self.start, "guess s{name} = {} [m]; ", y + reach);
        }
    }

    /// A force element between places.
    fn element(&mut self) {
        let body = self.random.below(self.bodies.len());
        let other = self.random.below(self.bodies.len() + 1);
        let other = (other < self.bodies.len() && other != body).then_some(other);
        let (first, second): ([f64; 2], [f64; 2]) =
            (self.random.around_zero(2.0), self.random.around_zero(2.0));
        let name = self.next_name("element");
        let second_name = other.map_or("ground".to_owned(), |at| format!("b{at}"));
        match self.random.below(5) {
            0 | 1 => {
                let first = self.point(Some(body), (first[0], first[1]));
                let second = self.point(other, (second[0], second[1]));
                let stiffness = self.random.between(1.0, 500.0);
                self.write(&format!(
                    "spring {name} ({first}, {second}) {{ stiffness = {stiffness} [N/m]; length = 0.3 [m]; damping = 2 [N*s/m]; }}"
                ));
            }
            2 => {
                self.write(&format!(
                    "torsion_spring {name} (b{body}, {second_name}) {{ stiffness = 3 [N*m/rad]; angle = 0.2; }}"
                ));
            }
            3 => {
                let first = self.point(Some(body), (first[0], first[1]));
                self.write(&format!("force {name} on {first} = (1.5, -0.5) [N];"));
            }
            _ => self.write(&format!("torque {name} on b{body} = 0.4 [N*m]*sin(3 [1/s]*t);")),
        }
    }

    /// Instances of an assembly, a pendulum of some links each.
    fn pendulums(&mut self) {
        let (count, links) = (1 + self.random.below(3), 1 + self.random.below(4));
        let length = self.random.between(0.2, 1.0);
        self.write(&format!(
            "assembly Pendulum {{
    param m = 0.5 [kg];
    for i in 1..={links} {{
        body link[i] (x[i], y[i], theta[i]) {{ mass = m; inertia = 0.02 [kg*m^2]; }}
        point up on link[i] = (0, {length} [m]);
    }}
    point hook on ground = (0, 0);
    revolute top (link[1].up, ground.hook);
    for i in 2..={links} {{ revolute pin[i] (link[i].up, link[i-1]); }}
    start {{ theta[1] = 10 [deg]; }}
}}"
        ));
        for at in 0..count {
            let mass = self.random.between(0.1, 1.0);
            self.write(&format!("instance pendulum{at}: Pendulum {{ m = {mass} [kg]; }}"));
        }
        self.coordinates += (3 * links * count) as i64;
        self.rows += (2 * links * count) as i64;
    }

    /// Drives for some of the degrees of freedom that are left.
    fn drives(&mut self) {
        let left = self.coordinates - self.rows;
        if left > 0 && self.random.once_in(3) {
            let body = self.random.below(self.bodies.len());
            let angle = self.bodies[body].angle;
            let name = self.next_name("drive");
            self.rows += 1;
            self.write(&format!("drive {name}: angle{body} = {angle} + 2 [rad/s]*t;"));
        }
    }
}
