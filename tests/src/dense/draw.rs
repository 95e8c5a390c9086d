//! Random mechanisms, assembled as they are drawn.

use super::{Body, Joint, Kind, Mechanism, Particle, Place, Spring};
use crate::random::Random;

/// The mechanism with this number: always the same.
pub fn mechanism(number: u64) -> Mechanism {
    let mut random = Random::new(number);
    let digits = *random.of(&[Some(1), Some(2), Some(3), None]);
    let mut pen = Pen { random, digits };
    if pen.random.once_in(6) { pen.truss() } else { pen.linkage() }
}

/// Draws with numbers of so many digits behind the point, or of all.
struct Pen {
    random: Random,
    digits: Option<i32>,
}

impl Pen {
    fn number(&mut self, low: f64, high: f64) -> f64 {
        let number = self.random.between(low, high);
        self.digits.map_or(number, |digits| {
            let ten = 10_f64.powi(digits);
            (number * ten).round() / ten
        })
    }

    /// Not 0 by rounding.
    fn positive(&mut self, high: f64) -> f64 {
        let number = self.number(0.0, high);
        if number > 0.0 { number } else { high }
    }

    fn direction(&mut self) -> [f64; 2] {
        let [u, v] = [self.number(-2.0, 2.0), self.number(-2.0, 2.0)];
        if u.hypot(v) > 0.1 { [u, v] } else { [1.0, 0.0] }
    }

    fn gravity(&mut self) -> [f64; 2] {
        match self.random.below(5) {
            0 | 1 => [0.0; 2],
            2 | 3 => [0.0, -9.81],
            _ => [self.number(-5.0, 5.0), self.number(-9.0, -1.0)],
        }
    }

    fn body(&mut self) -> Body {
        let all = [true; 3];
        let has = *self.random.of(&[
            all,
            all,
            all,
            all,
            [true, true, false],
            [true, false, true],
            [false, true, true],
            [true, false, false],
            [false, true, false],
            [false, false, true],
        ]);
        let mut at = [self.number(-1.5, 1.5), self.number(-1.5, 1.5), 0.0];
        if self.random.once_in(2) {
            at[2] = self.number(-3.0, 3.0);
        }
        for axis in 0..3 {
            if !has[axis] {
                at[axis] = 0.0;
            }
        }
        let is_parametric = self.random.once_in(2);
        Body { has, at, mass: self.positive(5.0), inertia: self.positive(1.0), is_parametric }
    }

    fn empty(&mut self, bodies: Vec<Body>) -> Mechanism {
        let (own, particles, joints, springs) = Default::default();
        Mechanism { gravity: self.gravity(), bodies, own, particles, joints, springs }
    }

    /// Particles on bodies, and some that move on them or over the ground.
    fn weigh(&mut self, drawn: &mut Mechanism) {
        for own in 0..self.random.below(3) {
            let at = self.number(-0.5, 0.5);
            drawn.own.push(at);
            // two of one coordinate now and then
            for _ in 0..=self.random.below(2) {
                let body = self.random.below(drawn.bodies.len() + 1);
                let (body, along) = ((body < drawn.bodies.len()).then_some(body), self.direction());
                let place = Place { moves: Some((own, along)), ..Place::of(body, self.local()) };
                drawn.particles.push(Particle { place, mass: self.positive(3.0) });
            }
        }
        for _ in 0..self.random.below(3) {
            let body = self.random.below(drawn.bodies.len());
            let has = drawn.bodies[body].has;
            if has[0] || has[1] {
                let place = Place::of(Some(body), self.local());
                drawn.particles.push(Particle { place, mass: self.positive(3.0) });
            }
        }
    }

    /// A place of a body that moves there, if there is a coordinate for it and chance has it.
    fn somewhere(&mut self, drawn: &Mechanism, body: usize) -> Place {
        let place = Place::of(Some(body), self.local());
        if drawn.own.is_empty() || self.random.once_in(2) {
            return place;
        }
        let (own, along) = (self.random.below(drawn.own.len()), self.direction());
        Place { moves: Some((own, along)), ..place }
    }

    /// Bodies on each other or on the ground, some loops, some springs.
    fn linkage(&mut self) -> Mechanism {
        let count = 1 + self.random.below(4);
        let bodies = (0..count).map(|_| self.body()).collect();
        let mut drawn = self.empty(bodies);
        if self.random.once_in(3) {
            self.weigh(&mut drawn);
        }
        for body in 0..count {
            if self.random.once_in(8) {
                continue; // free
            }
            let other = self.random.below(body + 1);
            self.join(&mut drawn, body, (other < body).then_some(other));
        }
        for _ in 0..self.random.below(3) {
            let (body, other) = (self.random.below(count), self.random.below(count + 1));
            if body != other {
                self.join(&mut drawn, body, (other < count).then_some(other));
            }
        }
        for _ in 0..self.random.below(3) {
            let (body, other) = (self.random.below(count), self.random.below(count + 1));
            let has = drawn.bodies[body].has;
            if body != other && (has[0] || has[1]) {
                self.spring(&mut drawn, body, (other < count).then_some(other));
            }
        }
        drawn
    }

    fn local(&mut self) -> [f64; 2] {
        if self.random.once_in(3) { [0.0; 2] } else { [self.number(-1.0, 1.0), self.number(-1.0, 1.0)] }
    }

    fn join(&mut self, drawn: &mut Mechanism, body: usize, other: Option<usize>) {
        let first = self.somewhere(drawn, body);
        let here = drawn.spot(&first);
        let (own, base) = (drawn.turn(Some(body)), drawn.turn(other));
        let along = self.direction();
        let reach = self.number(-1.0, 1.0);
        // the line through the first place along the direction of the second body
        let size = along[0].hypot(along[1]);
        let [u, v] = turn(along.map(|x| x / size), base);
        let back = |reach: f64, off: f64| [here[0] - reach * u + off * v, here[1] - reach * v - off * u];
        // the last two need bodies that turn
        let turn = [Some(body), other].into_iter().flatten().all(|at| drawn.bodies[at].has[2]);
        let (kind, there) = match self.random.below(if turn { 7 } else { 5 }) {
            0 | 1 => (Kind::Revolute, here),
            2 => (Kind::PointOnLine { along }, back(reach, 0.0)),
            3 => (Kind::PinSlot { along }, back(reach, 0.0)),
            5 => (Kind::Prismatic { along, at: own - base }, back(reach, 0.0)),
            4 => {
                let there = [here[0] + self.positive(1.0), here[1] + self.number(-1.0, 1.0)];
                let length = (there[0] - here[0]).hypot(there[1] - here[1]);
                (Kind::Distance { length }, there)
            }
            _ => {
                let radius = self.positive(0.5);
                let at = reach + radius * (own - base);
                (Kind::Rolling { along, radius, at }, back(reach, radius))
            }
        };
        let second = drawn.at(other, there);
        drawn.joints.push(Joint { kind, places: [first, second] });
    }

    /// A spring, now and then between places that coincide.
    fn spring(&mut self, drawn: &mut Mechanism, body: usize, other: Option<usize>) {
        let first = self.somewhere(drawn, body);
        let (stiffness, damping) = (self.positive(200.0), self.positive(5.0));
        let is_coincident = self.random.once_in(3);
        let here = drawn.spot(&first);
        let there = if is_coincident {
            here
        } else {
            [here[0] + self.positive(1.0), here[1] + self.number(-1.0, 1.0)]
        };
        let length = if is_coincident || self.random.once_in(3) { 0.0 } else { self.positive(1.0) };
        let second = drawn.at(other, there);
        drawn.springs.push(Spring { places: [first, second], stiffness, length, damping });
    }

    /// Nodes with bars between them, some more than hold it.
    fn truss(&mut self) -> Mechanism {
        let count = 2 + self.random.below(4);
        let node = |pen: &mut Self| Body {
            has: [true, true, false],
            at: [pen.number(-2.0, 2.0), pen.number(-2.0, 2.0), 0.0],
            mass: pen.positive(5.0),
            inertia: 1.0,
            is_parametric: pen.random.once_in(2),
        };
        let bodies = (0..count).map(|_| node(self)).collect();
        let mut drawn = self.empty(bodies);
        let held = Place::of(Some(0), [0.0; 2]);
        let ground = drawn.at(None, drawn.spot(&held));
        drawn.joints.push(Joint { kind: Kind::Revolute, places: [held, ground] });
        let guided = Place::of(Some(1), [0.0; 2]);
        let ground = drawn.at(None, drawn.spot(&guided));
        let along = self.direction();
        drawn.joints.push(Joint { kind: Kind::PointOnLine { along }, places: [guided, ground] });
        for body in 1..count {
            self.bar(&mut drawn, body, Some(body - 1));
            if body > 1 {
                self.bar(&mut drawn, body, Some(body - 2));
            }
        }
        for _ in 0..self.random.below(4) {
            let (body, other) = (self.random.below(count), self.random.below(count + 1));
            if body != other {
                self.bar(&mut drawn, body, (other < count).then_some(other));
            }
        }
        drawn
    }

    fn bar(&mut self, drawn: &mut Mechanism, body: usize, other: Option<usize>) {
        let first = Place::of(Some(body), [0.0; 2]);
        let second = match other {
            Some(_) => Place::of(other, [0.0; 2]),
            None => Place::of(None, [self.number(-3.0, 3.0), self.number(-3.0, 3.0)]),
        };
        let [a, b] = [drawn.spot(&first), drawn.spot(&second)];
        let length = (a[0] - b[0]).hypot(a[1] - b[1]);
        if length > 0.1 {
            drawn.joints.push(Joint { kind: Kind::Distance { length }, places: [first, second] });
        }
    }
}

impl Mechanism {
    /// Where a place is drawn.
    fn spot(&self, place: &Place) -> [f64; 2] {
        self.place(place, &self.drawn())
    }

    fn turn(&self, body: Option<usize>) -> f64 {
        body.map_or(0.0, |at| self.bodies[at].at[2])
    }

    /// The place of a body at a spot of the drawing.
    fn at(&self, body: Option<usize>, spot: [f64; 2]) -> Place {
        let [x, y, angle] = body.map_or([0.0; 3], |at| self.bodies[at].at);
        Place::of(body, turn([spot[0] - x, spot[1] - y], -angle))
    }
}

fn turn([x, y]: [f64; 2], angle: f64) -> [f64; 2] {
    let (sin, cos) = angle.sin_cos();
    [cos * x - sin * y, sin * x + cos * y]
}
