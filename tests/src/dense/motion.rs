//! The equations of motion by a dense decomposition.

use nalgebra::{DMatrix, DVector};

use super::{Mechanism, Spring};
use crate::jet::{Jet, first, line, second, value};

/// Singular values below this share of the largest are 0.
const ZERO: f64 = 1e-10;
/// Those between [`ZERO`] and this are neither, and so is a mass matrix along free directions of such a condition.
const SMALL: f64 = 1e-3;
/// Places are one within so many metres.
const COINCIDENT: f64 = 1e-10;

/// Verdict on a mechanism: its motion has one right answer, or that is not certain.
#[derive(Clone, Debug, PartialEq)]
pub enum Judgement {
    /// Assembled, of this rank there and near, and with a mass along every free direction.
    Regular {
        /// Of its rows.
        rank: usize,
    },
    /// Close to a position or a mass where that changes, or not assembled.
    Unclear(&'static str),
}

/// The accelerations that a dense solver finds, and their scale.
pub struct Motion {
    /// q̈
    pub accelerations: Vec<f64>,
    /// The size of what they are sums of: of M⁻¹Q, and at least 1.
    pub scale: f64,
    /// The uncertainty of accelerations by dampers without length whose places coincide: of their direction r
    /// only its rounding is left, which differs from one order of operations to the next.
    pub open: f64,
}

/// Jacobian, and Φ̈ without its part in q̈.
struct Rows {
    jacobian: DMatrix<f64>,
    gamma: DVector<f64>,
}

/// The parts of a singular value decomposition that everything here needs.
struct Split {
    rank: usize,
    values: Vec<f64>,
    /// Least-norm inverse.
    inverse: DMatrix<f64>,
    /// Directions that the rows leave free.
    free: DMatrix<f64>,
}

impl Mechanism {
    fn rows_at(&self, q: &[f64], v: &[f64]) -> Rows {
        let along = |direction: &dyn Fn(usize) -> f64| -> Vec<Jet> {
            let jets: Vec<Jet> = q.iter().enumerate().map(|(i, q)| line(*q, direction(i))).collect();
            self.phi(&jets)
        };
        let gamma: Vec<f64> = along(&|i| v[i]).into_iter().map(second).collect();
        let mut jacobian = DMatrix::zeros(gamma.len(), q.len());
        for column in 0..q.len() {
            for (row, jet) in along(&|i| f64::from(u8::from(i == column))).into_iter().enumerate() {
                jacobian[(row, column)] = first(jet);
            }
        }
        Rows { jacobian, gamma: DVector::from_vec(gamma) }
    }

    /// The nearest assembled position, by Newton's method with all rows.
    pub fn assembled(&self, q: &[f64]) -> Option<Vec<f64>> {
        let mut q = DVector::from_column_slice(q);
        for _ in 0..30 {
            let phi = DVector::from_vec(self.phi(q.as_slice()));
            if phi.amax() < 1e-13 {
                return Some(q.as_slice().to_vec());
            }
            let rows = self.rows_at(q.as_slice(), &vec![0.0; q.len()]);
            q -= split(&rows.jacobian).inverse * phi;
        }
        (DVector::from_vec(self.phi(q.as_slice())).amax() < 1e-11).then(|| q.as_slice().to_vec())
    }

    /// Judges whether a compiler has to accept the mechanism, and with which rank.
    pub fn judgement(&self) -> Judgement {
        let n = self.coordinates().len();
        let Some(q) = self.assembled(&self.drawn()) else { return Judgement::Unclear("assembly") };
        let rows = self.rows_at(&q, &vec![0.0; n]);
        let here = split(&rows.jacobian);
        if rows.jacobian.row_iter().any(|row| row.amax() < ZERO) {
            return Judgement::Unclear("a row of nothing");
        }
        if is_small(&here.values) {
            return Judgement::Unclear("rank");
        }
        // the rank of positions beside it
        for direction in here.free.column_iter() {
            let beside: Vec<f64> = q.iter().zip(direction.iter()).map(|(q, d)| q + 0.01 * d).collect();
            let Some(beside) = self.assembled(&beside) else { return Judgement::Unclear("beside") };
            let there = split(&self.rows_at(&beside, &vec![0.0; n]).jacobian);
            if there.rank != here.rank || is_small(&there.values) {
                return Judgement::Unclear("singular position");
            }
        }
        let inertia = here.free.transpose() * self.masses(&q) * &here.free;
        if !is_small(&split(&inertia).values) {
            Judgement::Regular { rank: here.rank }
        } else {
            Judgement::Unclear("mass")
        }
    }

    /// The rank of its rows where it is drawn.
    pub fn rank_as_drawn(&self) -> usize {
        let q = self.drawn();
        split(&self.rows_at(&q, &vec![0.0; q.len()]).jacobian).rank
    }

    /// The part of velocities that the rows allow.
    pub fn speeds(&self, q: &[f64], v: &[f64]) -> Vec<f64> {
        let free = split(&self.rows_at(q, &vec![0.0; q.len()]).jacobian).free;
        let v = &free * (free.transpose() * DVector::from_column_slice(v));
        v.as_slice().to_vec()
    }

    fn masses(&self, q: &[f64]) -> DMatrix<f64> {
        let mass = |&(body, axis): &(usize, usize)| match self.bodies.get(body) {
            Some(body) if axis < 2 => body.mass,
            Some(body) => body.inertia,
            None => 0.0,
        };
        let mut masses =
            DMatrix::from_diagonal(&DVector::from_vec(self.coordinates().iter().map(mass).collect()));
        for particle in &self.particles {
            let columns = self.columns(&particle.place, q);
            masses += particle.mass * &columns * columns.transpose();
        }
        masses
    }

    /// ∂s/∂q of a place, a row for each coordinate.
    fn columns(&self, place: &super::Place, q: &[f64]) -> DMatrix<f64> {
        let mut columns = DMatrix::zeros(q.len(), 2);
        for row in 0..q.len() {
            let direction = |i: usize| f64::from(u8::from(i == row));
            let jets: Vec<Jet> = q.iter().enumerate().map(|(i, q)| line(*q, direction(i))).collect();
            let moved = self.place(place, &jets);
            (0..2).for_each(|axis| columns[(row, axis)] = first(moved[axis]));
        }
        columns
    }

    fn forces(&self, q: &[f64], v: &[f64]) -> DVector<f64> {
        let weight = |&(body, axis): &(usize, usize)| {
            self.gravity.get(axis).map_or(0.0, |g| self.bodies[body].mass * g)
        };
        let mut forces = DVector::from_vec(self.coordinates().iter().map(weight).collect());
        for particle in &self.particles {
            let jets: Vec<Jet> = q.iter().zip(v).map(|(q, v)| line(*q, *v)).collect();
            let turning = self.place(&particle.place, &jets).map(second);
            let pull = DVector::from_fn(2, |axis, _| self.gravity[axis] - turning[axis]);
            forces += particle.mass * self.columns(&particle.place, q) * pull;
        }
        for spring in &self.springs {
            self.pull(spring, q, v, &mut forces);
        }
        forces
    }

    /// −(k (d − l) + c ḋ) ∂d/∂q. Where l is 0, −(k r + c w) ∂r/∂q of the vector r between the places: w is the
    /// rate along r, and all of ṙ where the places coincide. The passage is the one of the language, since what
    /// rounding leaves of r where they do counts as (|r|/ε)², 3e-11 for 6e-16 m.
    fn pull(&self, spring: &Spring, q: &[f64], v: &[f64], forces: &mut DVector<f64>) {
        let apart = |direction: &dyn Fn(usize) -> f64| -> [Jet; 2] {
            let jets: Vec<Jet> = q.iter().enumerate().map(|(i, q)| line(*q, direction(i))).collect();
            let [a, b] = spring.places.map(|place| self.place(&place, &jets));
            [a[0] - b[0], a[1] - b[1]]
        };
        let moving = apart(&|i| v[i]);
        let (apart_now, rate) = (moving.map(value), moving.map(first));
        let distance = apart_now[0].hypot(apart_now[1]);
        let along = apart_now.map(|x| x / distance);
        let Spring { stiffness, length, damping, .. } = *spring;
        let parting = along[0] * rate[0] + along[1] * rate[1];
        let opening = apart_now[0] * rate[0] + apart_now[1] * rate[1];
        let [squares, near] = [distance, COINCIDENT].map(|length| length * length);
        let force: [f64; 2] = std::array::from_fn(|axis| {
            if length == 0.0 {
                let rate = (apart_now[axis] * opening + near * rate[axis]) / (squares + near);
                stiffness * apart_now[axis] + damping * rate
            } else {
                (stiffness * (distance - length) + damping * parting) * along[axis]
            }
        });
        for column in 0..q.len() {
            let [x, y] = apart(&|i| f64::from(u8::from(i == column))).map(first);
            forces[column] -= force[0] * x + force[1] * y;
        }
    }

    /// q̈ of M q̈ + Jᵀλ = Q, J q̈ = −γ.
    pub fn motion(&self, q: &[f64], v: &[f64]) -> Motion {
        let rows = self.rows_at(q, v);
        let parts = split(&rows.jacobian);
        let forced = -&parts.inverse * &rows.gamma;
        let masses = self.masses(q);
        let inertia = parts.free.transpose() * &masses * &parts.free;
        let forces = self.forces(q, v);
        let alone = forces.component_div(&masses.diagonal());
        let scale = alone.iter().chain(forced.iter()).fold(1.0_f64, |scale, x| scale.max(x.abs()));
        let left = parts.free.transpose() * (forces - &masses * &forced);
        let inner = split(&inertia);
        let accelerations = forced + &parts.free * (&inner.inverse * left);
        Motion { accelerations: accelerations.as_slice().to_vec(), scale, open: self.open(q, v) }
    }

    /// The uncertainty of accelerations by dampers without length whose places coincide. Of r only its rounding is
    /// left there, which differs from one order of operations to the next. By the passage of the language, the
    /// rate along r has the share (|r|/ε)² of that, 1e-9 for places some metres away.
    fn open(&self, q: &[f64], v: &[f64]) -> f64 {
        let masses = self.masses(q);
        let least = masses.diagonal().iter().copied().fold(f64::INFINITY, f64::min);
        let of = |spring: &Spring| {
            let jets: Vec<Jet> = q.iter().zip(v).map(|(q, v)| line(*q, *v)).collect();
            let [a, b] = spring.places.map(|place| self.place(&place, &jets));
            let [x, y] = [0, 1].map(|axis| a[axis] - b[axis]);
            if spring.length != 0.0 || value(x).hypot(value(y)) >= COINCIDENT {
                return 0.0;
            }
            let arm = |place: &super::Place| place.local[0].hypot(place.local[1]);
            let size = spring.places.iter().map(arm).fold(value(a[0]).hypot(value(a[1])), f64::max);
            let share = 4.0 * f64::EPSILON * size / COINCIDENT;
            spring.damping * first(x).hypot(first(y)) * share * share * (1.0 + size) / least
        };
        self.springs.iter().map(of).sum()
    }

    /// By how much the motion amplifies what is off in its numbers, if these rows hold it.
    pub fn condition(&self, q: &[f64], rows: &[usize]) -> f64 {
        let jacobian = self.rows_at(q, &vec![0.0; q.len()]).jacobian.select_rows(rows);
        let parts = split(&jacobian);
        let masses = self.masses(q);
        let inner = split(&(parts.free.transpose() * &masses * &parts.free));
        let mut masses: Vec<f64> = masses.diagonal().as_slice().to_vec();
        masses.sort_by(|a, b| b.total_cmp(a));
        let of = |values: &[f64]| match values {
            [] => 1.0,
            all => all[0] / all[all.len() - 1],
        };
        of(&parts.values[..parts.rank]) * of(&inner.values[..inner.rank]) * of(&masses)
    }
}

/// `true` if one of the values, the largest first, is neither 0 nor clearly more.
fn is_small(values: &[f64]) -> bool {
    let largest = values.first().copied().unwrap_or(0.0);
    values.iter().any(|value| (ZERO * largest..SMALL * largest).contains(value))
}

fn split(matrix: &DMatrix<f64>) -> Split {
    let (m, n) = matrix.shape();
    let mut values: Vec<f64> = match m.min(n) {
        0 => Vec::new(),
        _ => matrix.singular_values().as_slice().to_vec(),
    };
    values.sort_by(|a, b| b.total_cmp(a));
    let largest = values.first().copied().unwrap_or(0.0);
    let rank = values.iter().filter(|value| **value > ZERO * largest).count();
    // with columns of zeros the decomposition gives an orthonormal basis of all directions
    let mut square = DMatrix::zeros(n, m.max(n));
    square.columns_mut(0, m).copy_from(&matrix.transpose());
    let basis = if n == 0 { square } else { square.col_piv_qr().q() };
    let held = basis.columns(0, rank).into_owned();
    let inverse = match rank {
        0 => DMatrix::zeros(n, m),
        _ => {
            let (q, r) = (matrix * &held).qr().unpack();
            let solved = r.solve_upper_triangular(&q.transpose());
            held * solved.unwrap_or_else(|| DMatrix::from_element(rank, m, f64::NAN))
        }
    };
    Split { rank, values, inverse, free: basis.columns(rank, n - rank).into_owned() }
}
