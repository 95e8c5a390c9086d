//! Outputs, and from their adjoints to those of the state that they were measured of.

use std::vec;
use std::vec::Vec;

use super::{Adjoints, Function, Given, Reversible};
use crate::equations::{At, check_outputs};
use crate::vectors::{add, copy, fill};
use crate::{Error, Info};

/// Room for measurements.
pub struct Measures {
    /// All coordinates, velocities and accelerations.
    q: Vec<f64>,
    v: Vec<f64>,
    acceleration: Vec<f64>,
    multipliers: Vec<f64>,
    outputs: Vec<f64>,
    no_feedback: Vec<f64>,
    weights: Vec<f64>,
    /// The adjoints that the state had before.
    before: [Vec<f64>; 2],
}

impl Measures {
    pub fn new(info: &Info) -> Self {
        let (n, m, outputs) = (info.coordinates.len(), info.constraints.len(), info.outputs.len());
        Self {
            q: vec![0.0; n],
            v: vec![0.0; n],
            acceleration: vec![0.0; n],
            multipliers: vec![0.0; m],
            outputs: vec![0.0; outputs],
            no_feedback: vec![0.0; m],
            weights: vec![0.0; (2 * n).max(n + m).max(outputs)],
            before: [(); 2].map(|()| vec![0.0; n]),
        }
    }

    /// The outputs of a state of what is integrated.
    pub fn measure(
        &mut self,
        run: &mut dyn Reversible,
        states: At<'_, f64>,
        inputs: &[f64],
    ) -> Result<&[f64], Error> {
        let Self { q, v, acceleration, multipliers, outputs, no_feedback, .. } = self;
        let given = Given { inputs, ..at(states) };
        run.forward(Function::Complete, &given, &mut [q, v]);
        let all = Given { q, v, feedback: no_feedback, ..given };
        run.forward(Function::Reactions, &all, &mut [acceleration, multipliers]);
        run.forward(Function::Outputs, &Given { acceleration, multipliers, ..all }, &mut [outputs]);
        check_outputs(run.info(), states.t, outputs)?;
        Ok(outputs)
    }

    /// Adds to the adjoints of the state that was measured last, and of everything else, from those of its
    /// outputs.
    pub fn backward(
        &mut self,
        run: &mut dyn Reversible,
        states: At<'_, f64>,
        inputs: &[f64],
        of_outputs: &[f64],
        adjoints: &mut Adjoints<'_, f64>,
    ) {
        let Self { q, v, acceleration, multipliers, no_feedback, weights, before: [of_q, of_v], .. } = self;
        copy(of_q, adjoints.q);
        copy(of_v, adjoints.v);
        for vector in [&mut *adjoints.q, adjoints.v, adjoints.acceleration, adjoints.multipliers] {
            fill(vector, 0.0);
        }
        let n = q.len();
        let given = Given { inputs, ..at(states) };
        let all = Given { q, v, feedback: no_feedback, acceleration, multipliers, ..given };
        copy(weights, of_outputs);
        run.backward(Function::Outputs, &all, weights, adjoints);
        copy(weights, adjoints.acceleration);
        copy(&mut weights[n..], adjoints.multipliers);
        run.backward(Function::Reactions, &all, weights, adjoints);
        fill(adjoints.feedback, 0.0);
        copy(weights, adjoints.q);
        copy(&mut weights[n..], adjoints.v);
        fill(adjoints.q, 0.0);
        fill(adjoints.v, 0.0);
        run.backward(Function::Complete, &given, weights, adjoints);
        add(adjoints.q, of_q);
        add(adjoints.v, of_v);
    }
}

/// A state as functions are given it.
fn at<'a>(At { t, q, v }: At<'a, f64>) -> Given<'a, f64> {
    Given { t, q, v, ..Given::default() }
}
