//! A mechanism whose free coordinates are prescribed: where the others are, how they move, and which
//! forces that takes.
//!
//! `jacobian` factorizes `[Φ_q; 1_I]`. Positions are followed on their branch with it. M is never formed
//! whole: M w are differences of kinetic energies, which are exact but for rounding. Q is known by the q̈
//! and λ that it causes.
//!
//! `inverse` finds inputs, and `travel` the forces that hold a mechanism along a slow motion. `curve` has
//! motions over time.

use mbs_runtime::equations::{At, Equations};
use nalgebra::{DMatrix, DVector};

use crate::Error;
use crate::jacobian::Jacobian;
use crate::point::Drives;
use crate::tangent::Rest;

/// Newton's corrections of a step along the path.
const CORRECTIONS: usize = 12;
/// A correction that moves no coordinate by more than this share of its scale is rounding.
const ROUNDING: f64 = 1e-14;
/// A correction below this share is rounding too, if it is more than half as long as the one before.
const STAGNANT: f64 = 1e-11;
/// A position is on the path that was predicted if it is nearer to that than this share of the scales.
/// Branches that are nearer to each other than that meet, where the determinant changes its sign.
const NEAR: f64 = 0.05;
/// Constraints that repeat others are met if they are violated by less than this share of the scales.
const MET: f64 = 1e-8;
/// Steps along the path are at least this share of what is between two samples.
const SHORTEST: f64 = 1.0 / 1_048_576.0;

/// A mechanism of which as many coordinates are prescribed as it has degrees of freedom.
#[derive(Clone)]
pub struct Guided<'a> {
    pub mechanism: &'a dyn Equations<f64>,
    /// The prescribed coordinates, I.
    pub places: Vec<usize>,
    pub drives: Drives,
    pub t: f64,
    pub q: DVector<f64>,
    /// 1 rad for an angle, the size of the mechanism for a length.
    pub scales: DVector<f64>,
    /// [Φ_q; 1_I] at (t, q).
    pub jacobian: Jacobian,
}

/// The accelerations, reactions and efforts of a prescribed motion.
pub struct Forces {
    /// q̈
    pub acceleration: DVector<f64>,
    /// λ
    pub multipliers: DVector<f64>,
    /// τ, along each prescribed coordinate.
    pub efforts: DVector<f64>,
}

/// A way of the prescribed coordinates, from where they are in a straight line.
struct Way {
    t: [f64; 2],
    z: [DVector<f64>; 2],
}

impl<'a> Guided<'a> {
    /// The mechanism at a position that is moved onto the constraints.
    ///
    /// # Errors
    /// [`Error::Unreachable`] where the position is singular; of the mechanism
    /// [`NotAssembled`](mbs_runtime::Error::NotAssembled).
    pub fn new(
        mechanism: &'a dyn Equations<f64>,
        places: Vec<usize>,
        drives: Drives,
        (t, from): (f64, &[f64]),
    ) -> Result<Self, Error> {
        let mut q = DVector::from_column_slice(from);
        let rest = Rest::new(mechanism, t, &[], from);
        rest.assemble(&mut q)?;
        let scales = rest.scales();
        let jacobian = Jacobian::at(mechanism, (t, &q), &places, &scales);
        let guided = Self { mechanism, places, drives, t, q, scales, jacobian };
        if guided.jacobian.is_singular() { Err(guided.unreachable(0)) } else { Ok(guided) }
    }

    /// The prescribed coordinates where they are.
    pub fn prescribed(&self) -> DVector<f64> {
        self.q.select_rows(&self.places)
    }

    /// Leads time and the prescribed coordinates in a straight line to those of a sample, and the mechanism
    /// along with them, on the branch on which it is. Steps along the tangent are corrected by Newton's
    /// method, and halved where a correction is not small beside the mechanism, or where the determinant
    /// of [Φ_q; 1_I] has another sign: between them the position is singular then. No sample may be singular.
    ///
    /// # Errors
    /// [`Error::Unreachable`]; it stays where it cannot be led any further.
    pub fn follow(&mut self, t: f64, z: &DVector<f64>, sample: usize) -> Result<(), Error> {
        let way = Way { t: [self.t, t], z: [self.prescribed(), z.clone()] };
        let (mut done, mut share) = (0.0, 1.0);
        while done < 1.0 {
            let next = if done + share < 1.0 { done + share } else { 1.0 };
            match self.step(&way, [done, next]) {
                true => (done, share) = (next, 2.0 * share),
                false if share <= SHORTEST => return Err(self.unreachable(sample)),
                false => share *= 0.5,
            }
        }
        // a way that ends there has no other side, where the determinant would have another sign
        if self.jacobian.is_singular() { Err(self.unreachable(sample)) } else { Ok(()) }
    }

    /// True if a step was made.
    fn step(&mut self, way: &Way, [done, next]: [f64; 2]) -> bool {
        let between = |share: f64| way.t[0] * (1.0 - share) + way.t[1] * share;
        let t = if next < 1.0 { between(next) } else { way.t[1] };
        let z = if next < 1.0 { way.z[0].lerp(&way.z[1], next) } else { way.z[1].clone() };
        let share = next - done;
        let rates = -self.driven() * ((way.t[1] - way.t[0]) * share);
        let tangent = self.jacobian.solve(&rates, &((&way.z[1] - &way.z[0]) * share));
        let predicted = &self.q + tangent;
        let Some((q, jacobian)) = self.corrected(t, &z, predicted.clone()) else { return false };
        let away = (&q - &predicted).component_div(&self.scales).amax();
        // of rows that are independent where the step begins
        let rows = self.jacobian.independent();
        if away.is_nan() || away > NEAR || jacobian.sign(&rows) != self.jacobian.sign(&rows) {
            return false;
        }
        (self.t, self.q, self.jacobian) = (t, q, jacobian);
        true
    }

    /// Newton's method on Φ(q, t) = 0, q_I = z.
    fn corrected(&self, t: f64, z: &DVector<f64>, mut q: DVector<f64>) -> Option<(DVector<f64>, Jacobian)> {
        let mut last = f64::INFINITY;
        for _ in 0..CORRECTIONS {
            let jacobian = Jacobian::at(self.mechanism, (t, &q), &self.places, &self.scales);
            let phi = self.violation(t, &q);
            let correction = jacobian.solve(&-phi, &(z - q.select_rows(&self.places)));
            q += &correction;
            let size = correction.component_div(&self.scales).amax();
            if size.is_nan() {
                break;
            }
            let rounding = ROUNDING * (1.0 + q.component_div(&self.scales).amax());
            if size <= rounding || (size <= STAGNANT && size > 0.5 * last) {
                let phi = self.violation(t, &q);
                return (jacobian.violation(&phi) <= MET).then_some((q, jacobian));
            }
            last = size;
        }
        None
    }

    /// The error of a sample to which the mechanism cannot be led.
    pub fn unreachable(&self, sample: usize) -> Error {
        let info = self.mechanism.info();
        let [row, free] = self.jacobian.nearly_singular();
        let constraint = info.constraints.get(row).map_or("", |row| row.name);
        let coordinate = info.coordinates.get(free).map_or("", |q| q.name);
        Error::Unreachable { sample, place: self.place(), constraint, coordinate }
    }

    /// Where it is, in words.
    pub fn place(&self) -> String {
        let coordinates = self.mechanism.info().coordinates;
        let place = |at: &usize| {
            coordinates.get(*at).map(|q| {
                let unit = if q.dimension.length != 0 { "m" } else { "rad" };
                format!(", `{}` = {:.6} {unit}", q.name, self.q[*at])
            })
        };
        format!("t = {:.6} s{}", self.t, self.places.iter().filter_map(place).collect::<String>())
    }

    /// Φ
    pub fn violation(&self, t: f64, q: &DVector<f64>) -> DVector<f64> {
        let mut phi = DVector::zeros(self.mechanism.info().constraints.len());
        self.mechanism.phi(t, q.as_slice(), phi.as_mut_slice());
        phi
    }

    /// Φ_t
    pub fn driven(&self) -> DVector<f64> {
        let mut rate = DVector::zeros(self.mechanism.info().constraints.len());
        let still = DVector::zeros(self.q.len());
        let at = At { t: self.t, q: self.q.as_slice(), v: still.as_slice() };
        self.mechanism.phi_dot(at, rate.as_mut_slice());
        rate
    }

    /// v for rates of the prescribed coordinates; 0 where drives are held, and nothing moves.
    pub fn velocity(&self, rates: &DVector<f64>) -> DVector<f64> {
        match self.drives {
            Drives::Held => DVector::zeros(self.q.len()),
            Drives::Moving => self.jacobian.solve(&-self.driven(), rates),
        }
    }

    /// q̈ and λ of the free motion: M q̈ + Φ_qᵀλ = Q, with drives that move.
    ///
    /// # Errors
    /// [`Error::Undefined`].
    pub fn free(&self, v: &DVector<f64>, inputs: &[f64]) -> Result<[DVector<f64>; 2], Error> {
        let info = self.mechanism.info();
        let [mut a, mut multipliers] = [info.coordinates.len(), info.constraints.len()].map(DVector::zeros);
        let at = At { t: self.t, q: self.q.as_slice(), v: v.as_slice() };
        self.mechanism.reactions(at, inputs, a.as_mut_slice(), multipliers.as_mut_slice());
        match info.coordinates.iter().zip(&a).find(|(_, a)| !a.is_finite()) {
            Some((coordinate, _)) => Err(Error::Undefined { coordinate: coordinate.name }),
            None => Ok([a, multipliers]),
        }
    }

    /// The accelerations with z̈, beside those of the free motion, which have Φ_q q̈ = γ as well.
    fn prescribed_acceleration(&self, free: &DVector<f64>, wanted: &DVector<f64>) -> DVector<f64> {
        match self.drives {
            Drives::Held => DVector::zeros(free.len()),
            Drives::Moving => {
                let none = DVector::zeros(self.mechanism.info().constraints.len());
                free + self.jacobian.solve(&none, &(wanted - free.select_rows(&self.places)))
            }
        }
    }

    /// The motion with z̈ and with forces along the prescribed coordinates,
    /// M q̈ + Φ_qᵀλ = Q + 1_Iᵀτ.
    ///
    /// # Errors
    /// [`Error::Undefined`].
    pub fn forces(&self, v: &DVector<f64>, wanted: &DVector<f64>, inputs: &[f64]) -> Result<Forces, Error> {
        let [free, of_free] = self.free(v, inputs)?;
        let acceleration = self.prescribed_acceleration(&free, wanted);
        let push = self.momentum(&(free - &acceleration));
        let [more, efforts] = self.jacobian.balance(&push);
        Ok(Forces { acceleration, multipliers: of_free + more, efforts: -efforts })
    }

    /// M w, from kinetic energies, of which differences are exact but for rounding.
    pub fn momentum(&self, w: &DVector<f64>) -> DVector<f64> {
        let size = w.component_div(&self.scales).amax();
        if size == 0.0 {
            return w.clone();
        }
        let energy = |v: &DVector<f64>| {
            self.mechanism.kinetic_energy(At { t: self.t, q: self.q.as_slice(), v: v.as_slice() })
        };
        DVector::from_fn(w.len(), |at, _| {
            let step = size * self.scales[at];
            let [mut ahead, mut behind] = [w.clone(), w.clone()];
            ahead[at] += step;
            behind[at] -= step;
            (energy(&ahead) - energy(&behind)) / (2.0 * step)
        })
    }

    /// M_r = NᵀMN of the prescribed coordinates, N_I = 1.
    pub fn mass(&self) -> DMatrix<f64> {
        let directions = self.jacobian.directions();
        let mut moved = directions.clone();
        for (mut column, direction) in moved.column_iter_mut().zip(directions.column_iter()) {
            column.copy_from(&self.momentum(&direction.clone_owned()));
        }
        directions.transpose() * moved
    }

    /// The declared outputs.
    pub fn outputs(&self, v: &DVector<f64>, inputs: &[f64], forces: &Forces) -> Vec<f64> {
        let mut outputs = vec![f64::NAN; self.mechanism.info().outputs.len()];
        let at = At { t: self.t, q: self.q.as_slice(), v: v.as_slice() };
        let reactions = [forces.acceleration.as_slice(), forces.multipliers.as_slice()];
        self.mechanism.outputs(at, inputs, reactions, &mut outputs);
        outputs
    }
}
