//! The acceleration of a mechanism at rest, and how it changes with positions.
//!
//! An own state z has no position that anything reads. At rest its value stands in that place, so that what is
//! searched for is one vector: positions, and values of states. Its "acceleration" is ż.
//!
//! Derivatives are those of duals where a mechanism has its equations over them. Elsewhere `tangent` takes
//! five-point differences.

use mbs_runtime::Real;
use mbs_runtime::equations::{At, Equations, PARTIALS, Partials};
use nalgebra::{DMatrix, DVector};

use crate::tangent::Rest;

/// q̈ from rest, and λ, with drives that stand still: Φ_q q̈ = 0.
pub fn acceleration<T: Real>(mechanism: &dyn Equations<T>, t: T, q: &[T], inputs: &[T]) -> (Vec<T>, Vec<T>) {
    let (n, m) = (q.len(), mechanism.info().constraints.len());
    let lines = mechanism.info().lines;
    let still: Vec<T> = (0..n).map(|at| if at < lines { T::ZERO } else { q[at] }).collect();
    let at = At { t, q, v: &still };
    let (mut a, mut multipliers) = (vec![T::ZERO; n], vec![T::ZERO; m]);
    mechanism.reactions(at, inputs, &mut a, &mut multipliers);
    // what the acceleration of drives adds is taken away: Φ_q q̈ is Φ̇ of v = q̈ without that of rest
    let (mut gamma, mut at_rest) = (vec![T::ZERO; m], vec![T::ZERO; m]);
    mechanism.phi_dot(At { t, q, v: &a }, &mut gamma);
    mechanism.phi_dot(at, &mut at_rest);
    let feedback: Vec<T> = gamma.iter().zip(&at_rest).map(|(gamma, rest)| *rest - *gamma).collect();
    if feedback.iter().any(|x| !x.is_same(T::ZERO)) {
        mechanism.accelerations(at, inputs, &feedback, &mut a);
    }
    (a, multipliers)
}

/// How q̈ from rest changes along directions, a column each, by the chain rule; nothing for a
/// mechanism whose equations cannot be had over duals.
pub fn rates(rest: &Rest<'_>, q: &DVector<f64>, directions: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    let mechanism = rest.mechanism;
    if !mechanism.is_differentiable() {
        return None;
    }
    let constants = |numbers: &[f64]| numbers.iter().map(|x| Partials::constant(*x)).collect::<Vec<_>>();
    let mut parameters = vec![0.0; mechanism.info().parameters.len()];
    mechanism.parameters(&mut parameters);
    let (t, inputs) = (Partials::constant(rest.t), constants(rest.inputs));
    let mut rates = DMatrix::zeros(q.len(), directions.ncols());
    let found = mechanism.with_partials(&constants(&parameters), &mut |equations| {
        for first in (0..directions.ncols()).step_by(PARTIALS) {
            let columns = first..directions.ncols().min(first + PARTIALS);
            let mut along = constants(q.as_slice());
            for (row, q) in along.iter_mut().enumerate() {
                for column in columns.clone() {
                    q.partials[column - first] = directions[(row, column)];
                }
            }
            let (a, _) = acceleration(equations, t, &along, &inputs);
            for (row, a) in a.iter().enumerate() {
                for column in columns.clone() {
                    rates[(row, column)] = a.partials[column - first];
                }
            }
        }
    });
    // the parameters are those that it has
    found.ok().map(|()| rates)
}
