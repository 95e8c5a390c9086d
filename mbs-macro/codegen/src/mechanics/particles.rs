//! Particles: point masses at places that move with coordinates.
//!
//! A body has a diagonal mass matrix, since its coordinates are those of its centre of mass. A particle sits
//! anywhere: beside the centre of its body, or at a point whose place on the body changes. With s(q) its place
//! and s_q the columns ∂s/∂q its kinetic energy ½ m ṡ² gives
//!
//! ```text
//! M += m s_qᵀ s_q,    Q += m s_qᵀ (g − c),    c = s̈ at q̈ = 0
//! ```
//!
//! so that M q̈ + Φ_qᵀ λ = Q holds with the centrifugal and Coriolis forces −m s_qᵀ c on its right side.
//!
//! With p the centre of the body, R its rotation and l the place on it, s = p + R l and s_q = p_q + R b, where
//! b = l_q + φ_q ẑ × l. What is of the axes of the body alone, such as Σ m b·b, is added over its particles and
//! collected before it is rotated: of many particles few numbers are left.

use std::collections::BTreeMap;

use mbs_symbolic::{Algebra, Expr, Scalar, Vector};

use super::{Motion, Placed};

/// A point mass at a place of a body.
#[derive(Clone, Copy)]
pub struct Particle {
    pub mass: Expr,
    /// The centre of the body, whose coordinates are its x and y or 0, and the angle of the body.
    pub frame: Placed,
    /// Its place on the body.
    pub local: [Expr; 2],
    /// Its place in the axes of the ground.
    pub place: Vector<Expr>,
}

impl Particle {
    /// True if it moves with some coordinate.
    pub fn moves<'a>(&self, algebra: &'a Algebra<'a>, motion: &Motion) -> bool {
        let place = self.place.components().map(|x| algebra.scalar(x));
        place.into_iter().any(|x| !motion.slopes(x).is_empty())
    }
}

/// The particles of a body.
pub struct Cluster<'a, 'm> {
    algebra: &'a Algebra<'a>,
    motion: &'m Motion,
    frame: Placed<Scalar<'a>>,
    particles: Vec<Particle>,
}

/// The terms that particles add to the equations of motion.
pub struct Inertial<'a> {
    /// Entries of M over pairs of coordinates, the first one not behind the second.
    pub masses: BTreeMap<(usize, usize), Scalar<'a>>,
    /// Weight, centrifugal and Coriolis forces along coordinates.
    pub forces: Vec<(usize, Scalar<'a>)>,
}

/// A vector of the plane.
type Plane<'a> = Vector<Scalar<'a>>;

impl<'a, 'm> Cluster<'a, 'm> {
    /// Particles by their bodies, in the order of the first one of each.
    pub fn all(algebra: &'a Algebra<'a>, motion: &'m Motion, particles: &[Particle]) -> Vec<Self> {
        let mut clusters: Vec<(Placed, Self)> = Vec::new();
        for particle in particles {
            let is_of = |frame: &Placed| {
                frame.angle == particle.frame.angle && frame.position == particle.frame.position
            };
            match clusters.iter_mut().find(|(frame, _)| is_of(frame)) {
                Some((_, cluster)) => cluster.particles.push(*particle),
                None => {
                    let (frame, particles) = (particle.frame.on(algebra), vec![*particle]);
                    clusters.push((particle.frame, Self { algebra, motion, frame, particles }));
                }
            }
        }
        clusters.into_iter().map(|(_, cluster)| cluster).collect()
    }

    /// The terms of all its particles.
    pub fn inertial(&self, gravity: [Expr; 2]) -> Inertial<'a> {
        let (angle, gravity) = (self.frame.angle, self.algebra.vector(gravity));
        let (mass, pull) = (self.mass(), self.sum(|particle| self.pull(particle)).rotated(angle));
        // Σ m b·b over pairs of coordinates, Σ m b and Σ m b·(what turns a particle), term by term
        let mut squares: BTreeMap<(usize, usize), Vec<Scalar<'a>>> = BTreeMap::new();
        let mut moments: BTreeMap<usize, [Vec<Scalar<'a>>; 3]> = BTreeMap::new();
        for particle in &self.particles {
            let (columns, mass) = (self.columns(particle), self.algebra.scalar(particle.mass));
            let pull = self.pull(particle);
            for (at, &(i, b)) in columns.iter().enumerate() {
                let sums = moments.entry(i).or_default();
                for (sum, term) in sums.iter_mut().zip([b.x, b.y, b.dot(pull)]) {
                    sum.push(mass * term);
                }
                for &(j, other) in &columns[at..] {
                    squares.entry((i, j)).or_default().push(mass * b.dot(other));
                }
            }
        }
        let sum = |terms: Vec<Scalar<'a>>| self.algebra.sum(terms).collected();
        let of_centre = self.of_centre();
        let mut masses: BTreeMap<_, _> =
            squares.into_iter().map(|(pair, terms)| (pair, sum(terms))).collect();
        let mut add = |i: usize, j: usize, value: Scalar<'a>| {
            let entry = masses.entry((i.min(j), i.max(j))).or_insert(self.algebra.number(0));
            *entry = *entry + value;
        };
        let mut forces = Vec::new();
        for (i, sums) in moments {
            let [x, y, turning] = sums.map(sum);
            let moment = Vector { x, y }.rotated(angle);
            forces.push((i, gravity.dot(moment) - turning));
            for &(j, centre) in &of_centre {
                let mixed = centre.dot(moment);
                add(i, j, if i == j { 2 * mixed } else { mixed });
            }
        }
        for (at, &(i, centre)) in of_centre.iter().enumerate() {
            forces.push((i, gravity.dot(mass * centre) - centre.dot(pull)));
            for &(j, other) in &of_centre[at..] {
                add(i, j, mass * centre.dot(other));
            }
        }
        Inertial { masses, forces }
    }

    /// Σ ½ m ṡ²
    pub fn kinetic(&self) -> Scalar<'a> {
        let centre = self.frame.position.map(|x| self.motion.rate(x));
        let relative = self.sum(|particle| self.velocity(particle)).rotated(self.frame.angle);
        let square = self.total(|particle| {
            let velocity = self.velocity(particle);
            velocity.dot(velocity)
        });
        (self.mass() * centre.dot(centre) + 2 * centre.dot(relative) + square) / 2
    }

    /// −Σ m g·s
    pub fn potential(&self, gravity: [Expr; 2]) -> Scalar<'a> {
        let local = self.sum(|particle| self.local(particle)).rotated(self.frame.angle);
        -self.algebra.vector(gravity).dot(self.mass() * self.frame.position + local)
    }

    /// Σ m
    fn mass(&self) -> Scalar<'a> {
        self.algebra.sum(self.particles.iter().map(|particle| self.algebra.scalar(particle.mass)))
    }

    /// Σ m x
    fn total(&self, x: impl Fn(&Particle) -> Scalar<'a>) -> Scalar<'a> {
        let terms = self.particles.iter().map(|particle| self.algebra.scalar(particle.mass) * x(particle));
        self.algebra.sum(terms).collected()
    }

    /// Σ m x
    fn sum(&self, x: impl Fn(&Particle) -> Plane<'a>) -> Plane<'a> {
        Vector { x: self.total(|particle| x(particle).x), y: self.total(|particle| x(particle).y) }
    }

    /// p_q of the coordinates along which it is not 0.
    fn of_centre(&self) -> Vec<(usize, Plane<'a>)> {
        self.gradients(self.frame.position)
    }

    /// The gradient of a vector by the coordinates that it depends on.
    fn gradients(&self, vector: Plane<'a>) -> Vec<(usize, Plane<'a>)> {
        let zero = self.algebra.number(0);
        let mut gradients: BTreeMap<usize, Plane<'a>> = BTreeMap::new();
        let mut slopes = |x: Scalar<'a>, is_x: bool| {
            for (at, slope) in self.motion.slopes(x) {
                let gradient = gradients.entry(at).or_insert(Vector { x: zero, y: zero });
                let component = if is_x { &mut gradient.x } else { &mut gradient.y };
                *component = self.algebra.scalar(slope);
            }
        };
        slopes(vector.x, true);
        slopes(vector.y, false);
        gradients.into_iter().collect()
    }

    fn local(&self, particle: &Particle) -> Plane<'a> {
        self.algebra.vector(particle.local)
    }

    /// b = l_q + φ_q ẑ × l of the coordinates along which it is not 0.
    fn columns(&self, particle: &Particle) -> Vec<(usize, Plane<'a>)> {
        let local = self.local(particle);
        let mut columns: BTreeMap<usize, Plane<'a>> = self.gradients(local).into_iter().collect();
        for (at, slope) in self.motion.slopes(self.frame.angle) {
            let turned = self.algebra.scalar(slope) * local.perpendicular();
            let column = columns.entry(at).or_insert(self.algebra.vector([self.algebra.number(0).expr(); 2]));
            *column = *column + turned;
        }
        columns.into_iter().filter(|(_, b)| !b.x.is_zero() || !b.y.is_zero()).collect()
    }

    /// ṡ − ṗ in the axes of the body: l̇ + ω ẑ × l.
    fn velocity(&self, particle: &Particle) -> Plane<'a> {
        let local = self.local(particle);
        local.map(|x| self.motion.rate(x)) + self.turning() * local.perpendicular()
    }

    /// s̈ at q̈ = 0 in the axes of the body: l̈ + 2ω ẑ × l̇ − ω² l. The centre of a body adds nothing, since its x
    /// and y are coordinates or 0.
    fn pull(&self, particle: &Particle) -> Plane<'a> {
        let (local, turning) = (self.local(particle), self.turning());
        let relative = local.map(|x| self.motion.rate(x));
        let bent = relative.map(|x| self.motion.rate(x));
        bent + (2 * turning) * relative.perpendicular() - turning.squared() * local
    }

    /// ω
    fn turning(&self) -> Scalar<'a> {
        self.motion.rate(self.frame.angle)
    }
}
