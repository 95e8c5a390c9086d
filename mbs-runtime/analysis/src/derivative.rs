//! Derivatives of the equations of a mechanism along directions in which its state, its inputs and
//! its parameters change. Nothing else in this crate knows how they are found.

use mbs_runtime::equations::{At, Described};
use nalgebra::DVector;

use crate::difference::derivative;
use crate::family::Varied;
use crate::point::Drives;
use crate::{Error, OperatingPoint};

/// The first difference steps by this share of a scale,
const LONGEST: f64 = 0.02;
/// and so many each by half of the one before.
const LEVELS: usize = 8;

/// What the equations say at a state, or how that changes along a direction.
#[derive(Clone, Debug)]
pub struct Values {
    /// Φ
    pub phi: DVector<f64>,
    /// Φ̇
    pub phi_dot: DVector<f64>,
    /// q̈
    pub acceleration: DVector<f64>,
    /// λ
    pub multipliers: DVector<f64>,
    /// What the declaration measures.
    pub outputs: DVector<f64>,
}

/// How fast everything changes along a direction.
#[derive(Clone, Debug)]
pub struct Direction {
    pub q: DVector<f64>,
    pub v: DVector<f64>,
    pub inputs: DVector<f64>,
    /// The position of the one parameter that changes, with rate 1.
    pub parameter: Option<usize>,
}

/// A mechanism at an operating point, and the sizes by which changes of it are measured.
pub struct Derivatives<'a> {
    pub mechanism: &'a dyn Described<f64>,
    pub point: &'a OperatingPoint,
    /// Of a mechanism whose parameters change.
    pub varied: Option<Varied<'a>>,
    /// Of coordinates: 1 rad, or the size of the mechanism in m.
    pub scales: DVector<f64>,
}

impl Direction {
    /// A direction in which nothing changes yet.
    pub fn none(mechanism: &dyn Described<f64>) -> Self {
        let info = mechanism.info();
        let still = || DVector::zeros(info.coordinates.len());
        Self { q: still(), v: still(), inputs: DVector::zeros(info.inputs.len()), parameter: None }
    }
}

impl Derivatives<'_> {
    /// What the equations say at the point.
    pub fn values(&self) -> Values {
        let point = self.point;
        let [q, v, inputs] = [&point.q, &point.v, &point.inputs].map(|list| DVector::from_column_slice(list));
        self.at(self.mechanism, &q, &v, &inputs)
    }

    /// The derivative along a direction, and an estimate of its error in every number.
    ///
    /// # Errors
    /// [`Error::Mechanism`] for parameters that the mechanism refuses on both sides.
    pub fn along(&self, direction: &Direction) -> Result<[Values; 2], Error> {
        let step = LONGEST / self.size(direction);
        let [value, error] = match self.extrapolated(direction, step, false) {
            Err(Error::Mechanism(_)) if direction.parameter.is_some() => {
                self.extrapolated(direction, step, true)?
            }
            other => other?,
        };
        Ok([self.split(&value), self.split(&error)])
    }

    /// How far one unit along a direction leads, measured by the scales.
    fn size(&self, direction: &Direction) -> f64 {
        let info = self.mechanism.info();
        let moved = direction.q.component_div(&self.scales).amax();
        let faster = direction.v.component_div(&self.scales).amax();
        let pushed = (0..direction.inputs.len())
            .map(|at| (direction.inputs[at] / scale(&info.inputs[at], self.point.inputs[at])).abs());
        let pushed = pushed.fold(0.0, f64::max);
        let changed = match (direction.parameter, &self.varied) {
            (Some(at), Some(varied)) => 1.0 / scale(&info.parameters[at], varied.parameters[at]),
            _ => 0.0,
        };
        let size = moved.max(faster).max(pushed).max(changed);
        if size > 0.0 { size } else { 1.0 }
    }

    fn extrapolated(
        &self,
        direction: &Direction,
        step: f64,
        is_one_sided: bool,
    ) -> Result<[DVector<f64>; 2], Error> {
        let point = self.point;
        let there = |share: f64| -> Result<DVector<f64>, Error> {
            let q = DVector::from_column_slice(&point.q) + &direction.q * share;
            let v = DVector::from_column_slice(&point.v) + &direction.v * share;
            let inputs = DVector::from_column_slice(&point.inputs) + &direction.inputs * share;
            let (Some(at), Some(varied)) = (direction.parameter, &self.varied) else {
                return Ok(joined(&self.at(self.mechanism, &q, &v, &inputs)));
            };
            let mut found = DVector::zeros(0);
            varied.moved(at, share, &mut |mechanism| found = joined(&self.at(mechanism, &q, &v, &inputs)))?;
            Ok(found)
        };
        derivative(there, step, LEVELS, is_one_sided)
    }

    fn at(
        &self,
        mechanism: &dyn Described<f64>,
        q: &DVector<f64>,
        v: &DVector<f64>,
        inputs: &DVector<f64>,
    ) -> Values {
        let info = mechanism.info();
        let (n, m, t) = (info.coordinates.len(), info.constraints.len(), self.point.t);
        let at = At { t, q: q.as_slice(), v: v.as_slice() };
        let inputs = inputs.as_slice();
        let (mut phi, mut phi_dot) = (DVector::zeros(m), DVector::zeros(m));
        mechanism.phi(t, at.q, phi.as_mut_slice());
        mechanism.phi_dot(at, phi_dot.as_mut_slice());
        let (mut acceleration, mut multipliers) = (DVector::zeros(n), DVector::zeros(m));
        mechanism.reactions(at, inputs, acceleration.as_mut_slice(), multipliers.as_mut_slice());
        if self.point.drives == Drives::Held {
            // Φ_t, and what Φ_tt and Φ_tq v do to the accelerations. What is taken away with them,
            // (Φ_q v)_q v, is of second order at rest.
            let still = vec![0.0; n];
            let mut driven = DVector::zeros(m);
            mechanism.phi_dot(At { v: &still, ..at }, driven.as_mut_slice());
            let mut gamma = DVector::zeros(m);
            mechanism.phi_dot(At { v: acceleration.as_slice(), ..at }, gamma.as_mut_slice());
            phi_dot -= &driven;
            gamma -= &driven;
            if gamma.amax() > 0.0 {
                let opposed = -gamma;
                mechanism.accelerations(at, inputs, opposed.as_slice(), acceleration.as_mut_slice());
            }
        }
        let mut outputs = DVector::zeros(info.outputs.len());
        let reactions = [acceleration.as_slice(), multipliers.as_slice()];
        mechanism.outputs(at, inputs, reactions, outputs.as_mut_slice());
        Values { phi, phi_dot, acceleration, multipliers, outputs }
    }

    fn split(&self, all: &DVector<f64>) -> Values {
        let info = self.mechanism.info();
        let (n, m) = (info.coordinates.len(), info.constraints.len());
        let part = |from: usize, count: usize| all.rows(from, count).clone_owned();
        Values {
            phi: part(0, m),
            phi_dot: part(m, m),
            acceleration: part(2 * m, n),
            multipliers: part(2 * m + n, m),
            outputs: part(3 * m + n, info.outputs.len()),
        }
    }
}

fn joined(values: &Values) -> DVector<f64> {
    let Values { phi, phi_dot, acceleration, multipliers, outputs } = values;
    let parts = [phi, phi_dot, acceleration, multipliers, outputs];
    DVector::from_iterator(
        parts.iter().map(|part| part.len()).sum(),
        parts.iter().flat_map(|part| part.iter()).copied(),
    )
}

/// The size of a quantity: that of its value, or one of its declared units where it is 0.
pub fn scale(quantity: &mbs_runtime::Quantity, value: f64) -> f64 {
    let unit = if quantity.scale > 0.0 { quantity.scale } else { 1.0 };
    if value == 0.0 { unit } else { value.abs() }
}
