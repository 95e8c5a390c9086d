//! Planar mechanisms as numbers: each is written as a declaration, and its equations of motion are
//! solved by a dense decomposition that shares nothing with the compiler.

mod draw;
mod motion;
mod text;

pub use draw::mechanism;
pub use motion::{Judgement, Motion};

use std::ops::Range;

use mbs_runtime::Real;

/// A rigid body.
#[derive(Clone, Debug)]
pub struct Body {
    /// Which of x, y and the angle are coordinates; the others are 0.
    pub has: [bool; 3],
    /// Where it is drawn.
    pub at: [f64; 3],
    /// In kg.
    pub mass: f64,
    /// In kg m².
    pub inertia: f64,
    /// `true` if mass and inertia are parameters.
    pub is_parametric: bool,
}

/// A point of a body, or of the ground.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    /// Nothing is the ground.
    pub body: Option<usize>,
    /// In the body's frame, in m.
    pub local: [f64; 2],
    /// The coordinate of its own that moves it in the body's frame, and by how much.
    pub moves: Option<(usize, [f64; 2])>,
}

impl Place {
    /// A place that does not move on its body.
    pub const fn of(body: Option<usize>, local: [f64; 2]) -> Self {
        Self { body, local, moves: None }
    }
}

/// Joints by the names of their statements, with directions in the frame of the second body.
#[derive(Clone, Copy, Debug)]
#[allow(missing_docs, reason = "the words of the statements")]
pub enum Kind {
    Revolute,
    PointOnLine { along: [f64; 2] },
    PinSlot { along: [f64; 2] },
    Prismatic { along: [f64; 2], at: f64 },
    Distance { length: f64 },
    Rolling { along: [f64; 2], radius: f64, at: f64 },
}

/// A joint between two places.
#[derive(Clone, Copy, Debug)]
pub struct Joint {
    /// The kind of joint, with its directions and lengths.
    pub kind: Kind,
    /// The first and the second.
    pub places: [Place; 2],
}

/// A spring with a damper.
#[derive(Clone, Copy, Debug)]
#[allow(missing_docs, reason = "the words of the statement")]
pub struct Spring {
    pub places: [Place; 2],
    pub stiffness: f64,
    pub length: f64,
    pub damping: f64,
}

/// A point mass.
#[derive(Clone, Copy, Debug)]
#[allow(missing_docs, reason = "the words of the statement")]
pub struct Particle {
    pub place: Place,
    pub mass: f64,
}

/// The numbers of a declaration.
#[derive(Clone, Debug)]
#[allow(missing_docs, reason = "the words of the statements")]
pub struct Mechanism {
    pub gravity: [f64; 2],
    pub bodies: Vec<Body>,
    /// Where coordinates of its own are drawn.
    pub own: Vec<f64>,
    pub particles: Vec<Particle>,
    pub joints: Vec<Joint>,
    pub springs: Vec<Spring>,
}

impl Mechanism {
    /// Body and component of each coordinate, in the order of the bodies. Those of its own follow as component 3 of
    /// bodies that are none.
    pub fn coordinates(&self) -> Vec<(usize, usize)> {
        let of = |(at, body): (usize, &Body)| {
            (0..3).filter(|&axis| body.has[axis]).map(move |axis| (at, axis)).collect::<Vec<_>>()
        };
        let own = (0..self.own.len()).map(|at| (self.bodies.len() + at, 3));
        self.bodies.iter().enumerate().flat_map(of).chain(own).collect()
    }

    /// The coordinates as they are drawn.
    pub fn drawn(&self) -> Vec<f64> {
        let drawn = |&(body, axis): &(usize, usize)| match self.bodies.get(body) {
            Some(body) => body.at[axis],
            None => self.own[body - self.bodies.len()],
        };
        self.coordinates().iter().map(drawn).collect()
    }

    /// x, y and angle of a body, or of the ground.
    fn pose<T: Real>(&self, body: Option<usize>, q: &[T]) -> [T; 3] {
        let mut pose = [T::ZERO; 3];
        for (&(owner, axis), value) in self.coordinates().iter().zip(q) {
            if Some(owner) == body {
                pose[axis] = *value;
            }
        }
        pose
    }

    /// Where a place is.
    pub fn place<T: Real>(&self, place: &Place, q: &[T]) -> [T; 2] {
        let [x, y, angle] = self.pose(place.body, q);
        let mut local = place.local.map(T::from_f64);
        if let Some((own, along)) = place.moves {
            let w = q[q.len() - self.own.len() + own];
            local = std::array::from_fn(|axis| local[axis] + w * T::from_f64(along[axis]));
        }
        let [u, v] = turned(local, angle);
        [x + u, y + v]
    }

    /// Φ, joint by joint.
    pub fn phi<T: Real>(&self, q: &[T]) -> Vec<T> {
        self.joints.iter().flat_map(|joint| self.rows(joint, q)).collect()
    }

    /// The rows of a joint in Φ.
    pub fn rows_of(&self, joint: usize) -> Range<usize> {
        let before: usize = self.joints[..joint].iter().map(|joint| joint.kind.rows()).sum();
        before..before + self.joints[joint].kind.rows()
    }

    fn rows<T: Real>(&self, joint: &Joint, q: &[T]) -> Vec<T> {
        let [first, second] = joint.places.map(|place| self.place(&place, q));
        let apart = [first[0] - second[0], first[1] - second[1]];
        let [own, other] = joint.places.map(|place| self.pose(place.body, q)[2]);
        let relative = own - other;
        // unit vector along, and at right angles to it
        let axes = |along: [f64; 2]| {
            let size = along[0].hypot(along[1]);
            let [u, v] = turned(along.map(|x| T::from_f64(x / size)), other);
            [[u, v], [T::ZERO - v, u]]
        };
        let dot = |[a, b]: [T; 2]| a * apart[0] + b * apart[1];
        match joint.kind {
            Kind::Revolute => apart.to_vec(),
            Kind::PointOnLine { along } | Kind::PinSlot { along } => vec![dot(axes(along)[1])],
            Kind::Prismatic { along, at } => vec![dot(axes(along)[1]), relative - T::from_f64(at)],
            Kind::Distance { length } => vec![dot(apart).sqrt() - T::from_f64(length)],
            Kind::Rolling { along, radius, at } => {
                let [tangent, normal] = axes(along);
                let radius = T::from_f64(radius);
                vec![dot(tangent) + radius * relative - T::from_f64(at), dot(normal) - radius]
            }
        }
    }
}

/// (cos, −sin; sin, cos) times a vector.
fn turned<T: Real>([x, y]: [T; 2], angle: T) -> [T; 2] {
    let (sin, cos) = angle.sin_cos();
    [cos * x - sin * y, sin * x + cos * y]
}
