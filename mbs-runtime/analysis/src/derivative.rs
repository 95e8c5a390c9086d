//! Derivatives of the equations of a mechanism along directions in which its state, its inputs and
//! its parameters change. Nothing else in this crate knows how they are found: by the chain rule
//! where the equations can be had over duals, else by differences, which also tell where there is
//! no derivative.

use mbs_runtime::Real;
use mbs_runtime::equations::{At, Equations, Partials};
use nalgebra::DVector;

use crate::difference::{derivative, from_one_side};
use crate::family::Varied;
use crate::point::Drives;
use crate::{Error, OperatingPoint};

/// The first difference steps by this share of a scale.
const LONGEST: f64 = 0.02;
/// The number of differences, each with half the step of the one before.
const LEVELS: usize = 8;
/// Differences that leave more open than [`CORNER`] are made again, so many times. A mechanism with a link of a hundredth of its
/// size bends within the longest step; a corner is one at every step.
const AGAIN: usize = 2;
/// Each time the first step is so many times that of the time before.
const SMALLER: f64 = 1.0 / 128.0;

/// Differences that leave a larger share of a derivative open than this may hide a corner.
const CORNER: f64 = 1e-6;
/// Roundings in a derivative that the chain rule gives.
const ROUNDINGS: f64 = 64.0;

/// The values of the equations at a state, or their rates along a direction.
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
    /// The declared outputs.
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
    pub mechanism: &'a dyn Equations<f64>,
    pub point: &'a OperatingPoint,
    /// Of a mechanism whose parameters change.
    pub varied: Option<Varied<'a>>,
    /// Of coordinates: 1 rad, or the size of the mechanism in m.
    pub scales: DVector<f64>,
}

impl Direction {
    /// A direction in which nothing changes yet.
    pub fn none(mechanism: &dyn Equations<f64>) -> Self {
        let info = mechanism.info();
        let still = || DVector::zeros(info.coordinates.len());
        Self { q: still(), v: still(), inputs: DVector::zeros(info.inputs.len()), parameter: None }
    }
}

impl Derivatives<'_> {
    /// The values of the equations at the point.
    pub fn values(&self) -> Values {
        self.split(&self.joined())
    }

    fn joined(&self) -> DVector<f64> {
        let point = self.point;
        let [q, v, inputs] = [&point.q, &point.v, &point.inputs].map(|list| DVector::from_column_slice(list));
        self.at(self.mechanism, [&q, &v, &inputs])
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
        let Some(exact) = self.exact(direction) else {
            return Ok([self.split(&value), self.split(&error)]);
        };
        // a corner, of which the chain rule knows one side, shows in the differences alone
        let sizes = self.joined().abs() * self.size(direction) + exact.abs();
        let open_beside = |value: &DVector<f64>, error: &DVector<f64>| {
            (&exact - value).zip_map(error, |apart, error| error.max(apart.abs()))
        };
        let mut open = open_beside(&value, &error);
        let mut shorter = step;
        for _ in 0..AGAIN {
            if open.iter().zip(&sizes).all(|(open, size)| *open <= CORNER * size) {
                break;
            }
            shorter *= SMALLER;
            if let Ok([value, error]) = self.extrapolated(direction, shorter, false) {
                open = open.zip_map(&open_beside(&value, &error), f64::min);
            }
        }
        let error = DVector::from_fn(exact.len(), |at, _| match open[at] <= CORNER * sizes[at] {
            true => ROUNDINGS * f64::EPSILON * exact[at].abs(),
            false => open[at],
        });
        Ok([self.split(&exact), self.split(&error)])
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
                return Ok(self.at(self.mechanism, [&q, &v, &inputs]));
            };
            let mut found = DVector::zeros(0);
            varied.moved(at, share, &mut |mechanism| found = self.at(mechanism, [&q, &v, &inputs]))?;
            Ok(found)
        };
        if is_one_sided { from_one_side(there, step, LEVELS) } else { derivative(there, step, LEVELS, false) }
    }

    /// The values of the equations of a mechanism at a state, as one vector.
    fn at(&self, mechanism: &dyn Equations<f64>, [q, v, inputs]: [&DVector<f64>; 3]) -> DVector<f64> {
        let at = At { t: self.point.t, q: q.as_slice(), v: v.as_slice() };
        DVector::from_vec(evaluated(mechanism, at, inputs.as_slice(), self.point.drives))
    }

    /// The derivative along a direction by the chain rule; nothing for a mechanism whose equations
    /// cannot be had over duals.
    fn exact(&self, direction: &Direction) -> Option<DVector<f64>> {
        let (mechanism, point) = (self.mechanism, self.point);
        if !mechanism.is_differentiable() {
            return None;
        }
        let moving = |from: &[f64], rate: &DVector<f64>| -> Vec<Partials> {
            from.iter().zip(rate).map(|(x, rate)| Partials::constant(*x).plus_partial(0, *rate)).collect()
        };
        let mut parameters = vec![0.0; mechanism.info().parameters.len()];
        mechanism.parameters(&mut parameters);
        let changed = |at: usize| f64::from(u8::from(direction.parameter == Some(at)));
        let parameters = moving(&parameters, &DVector::from_fn(parameters.len(), |at, _| changed(at)));
        let (q, v) = (moving(&point.q, &direction.q), moving(&point.v, &direction.v));
        let inputs = moving(&point.inputs, &direction.inputs);
        let mut found = DVector::zeros(0);
        let look = &mut |equations: &dyn Equations<Partials>| {
            let at = At { t: Partials::constant(point.t), q: &q, v: &v };
            let all = evaluated(equations, at, &inputs, point.drives);
            // +0 makes no negative zero of a slope
            found = DVector::from_iterator(all.len(), all.iter().map(|x| x.partial(0) + 0.0));
        };
        // the parameters are those that it has
        mechanism.with_partials(&parameters, look).ok().map(|()| found)
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

/// Φ, Φ̇, q̈, λ and the outputs at a state, one after the other.
fn evaluated<T: Real>(mechanism: &dyn Equations<T>, at: At<'_, T>, inputs: &[T], drives: Drives) -> Vec<T> {
    let info = mechanism.info();
    let zeros = |count: usize| vec![T::ZERO; count];
    let (n, m) = (info.coordinates.len(), info.constraints.len());
    let (mut phi, mut phi_dot) = (zeros(m), zeros(m));
    mechanism.phi(at.t, at.q, &mut phi);
    mechanism.phi_dot(at, &mut phi_dot);
    let (mut acceleration, mut multipliers) = (zeros(n), zeros(m));
    mechanism.reactions(at, inputs, &mut acceleration, &mut multipliers);
    if drives == Drives::Held {
        // Φ_t, and what Φ_tt and Φ_tq v do to the accelerations. (Φ_q v)_q v is taken away with them;
        // it is of second order at rest.
        let (still, mut driven, mut gamma) = (zeros(n), zeros(m), zeros(m));
        mechanism.phi_dot(At { v: &still, ..at }, &mut driven);
        mechanism.phi_dot(At { v: &acceleration, ..at }, &mut gamma);
        let opposed: Vec<T> = driven.iter().zip(&gamma).map(|(driven, gamma)| *driven - *gamma).collect();
        phi_dot.iter_mut().zip(&driven).for_each(|(rate, driven)| *rate = *rate - *driven);
        if opposed.iter().any(|x| !x.is_same(T::ZERO)) {
            mechanism.accelerations(at, inputs, &opposed, &mut acceleration);
        }
    }
    let mut outputs = zeros(info.outputs.len());
    mechanism.outputs(at, inputs, [&acceleration, &multipliers], &mut outputs);
    [phi, phi_dot, acceleration, multipliers, outputs].concat()
}

/// The size of an own state: that of its value, and of one of its declared units at least, since a value near 0 is
/// no measure of its changes.
pub fn size_of_state(state: &mbs_runtime::Quantity, value: f64) -> f64 {
    scale(state, 0.0).max(value.abs())
}

/// The size of a quantity: that of its value, or one of its declared units where it is 0.
pub fn scale(quantity: &mbs_runtime::Quantity, value: f64) -> f64 {
    let unit = if quantity.scale > 0.0 { quantity.scale } else { 1.0 };
    if value == 0.0 { unit } else { value.abs() }
}
