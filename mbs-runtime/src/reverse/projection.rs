//! Projection backward: from the adjoints of positions and velocities on the constraints to those of what was
//! moved there.

use std::vec;
use std::vec::Vec;

use super::{Adjoints, Function, Given, Reversible};
use crate::Info;
use crate::vectors::{add, copy, fill};

/// Room for a projection.
pub struct Projection {
    /// The coordinates that are integrated, and their velocities, before the projection.
    pub q: Vec<f64>,
    pub v: Vec<f64>,
    /// The coordinates that are integrated, after the projection of positions.
    moved: Vec<f64>,
    /// All coordinates and velocities before the projection of positions.
    before: [Vec<f64>; 2],
    /// All coordinates and velocities after the projection of positions, before that of velocities.
    behind: [Vec<f64>; 2],
    /// Φ and Φ̇
    violations: [Vec<f64>; 2],
    correction: Vec<f64>,
    /// Weights of results.
    weights: Vec<f64>,
}

impl Projection {
    pub fn new(info: &Info) -> Self {
        let (n, m, s) = (info.coordinates.len(), info.constraints.len(), info.states.len());
        Self {
            q: vec![0.0; s],
            v: vec![0.0; s],
            moved: vec![0.0; s],
            before: [(); 2].map(|()| vec![0.0; n]),
            behind: [(); 2].map(|()| vec![0.0; n]),
            violations: [(); 2].map(|()| vec![0.0; m]),
            correction: vec![0.0; n],
            weights: vec![0.0; 2 * n + m],
        }
    }

    /// The projection of q and v, as it was made.
    pub fn forward(&mut self, run: &mut dyn Reversible, at: &Given<'_, f64>) {
        let Self { q, v, moved, before, behind, violations: [phi, phi_dot], correction, .. } = self;
        let at = Given { t: at.t_next, ..*at };
        let [q_all, v_all] = before;
        run.forward(Function::Complete, &Given { q, v, ..at }, &mut [q_all, v_all]);
        run.forward(Function::Phi, &Given { q: q_all, ..at }, &mut [phi]);
        run.forward(Function::Projection, &Given { q: q_all, feedback: phi, ..at }, &mut [correction]);
        for ((moved, q), &state) in moved.iter_mut().zip(&*q).zip(run.info().states) {
            *moved = q - correction[state];
        }
        let [q_all, v_all] = behind;
        run.forward(Function::Complete, &Given { q: moved, v, ..at }, &mut [q_all, v_all]);
        run.forward(Function::PhiDot, &Given { q: q_all, v: v_all, ..at }, &mut [phi_dot]);
    }

    /// From the adjoints of positions and velocities behind the projection to those before it.
    pub fn backward(
        &mut self,
        run: &mut dyn Reversible,
        at: &Given<'_, f64>,
        [of_q, of_v]: [&mut [f64]; 2],
        adjoints: &mut Adjoints<'_, f64>,
    ) {
        let at = Given { t: at.t_next, ..*at };
        self.correct(Function::PhiDot, run, &at, of_v, adjoints);
        add(of_q, adjoints.q);
        add(of_v, adjoints.v);
        self.correct(Function::Phi, run, &at, of_q, adjoints);
        add(of_q, adjoints.q);
    }

    /// From the adjoint of a correction −Δ by a violation to those of what is integrated, which it was made of,
    /// in place of those of positions and velocities.
    fn correct(
        &mut self,
        violation: Function,
        run: &mut dyn Reversible,
        at: &Given<'_, f64>,
        adjoint: &[f64],
        adjoints: &mut Adjoints<'_, f64>,
    ) {
        let Self { weights, violations: [phi, phi_dot], .. } = self;
        let (states, [q, v], residual) = match violation {
            Function::PhiDot => (&self.moved, &self.behind, phi_dot),
            _ => (&self.q, &self.before, phi),
        };
        for vector in [&mut *adjoints.q, adjoints.v, adjoints.feedback, weights] {
            fill(vector, 0.0);
        }
        for (&state, adjoint) in run.info().states.iter().zip(adjoint) {
            weights[state] = -adjoint;
        }
        run.backward(Function::Projection, &Given { q, feedback: residual, ..*at }, weights, adjoints);
        copy(weights, adjoints.feedback);
        fill(adjoints.feedback, 0.0);
        run.backward(violation, &Given { q, v, ..*at }, weights, adjoints);
        // all coordinates, and then their velocities
        let (of_q, of_v) = weights.split_at_mut(q.len());
        copy(of_q, adjoints.q);
        copy(of_v, adjoints.v);
        fill(adjoints.q, 0.0);
        fill(adjoints.v, 0.0);
        run.backward(Function::Complete, &Given { q: states, v: &self.v, ..*at }, weights, adjoints);
    }
}
