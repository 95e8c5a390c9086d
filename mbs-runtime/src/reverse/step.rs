//! Steps that go backward: from the adjoints of the state behind a step to those of the state before it, and of
//! everything that the step reads.

use std::boxed::Box;
use std::vec;
use std::vec::Vec;

use super::projection::Projection;
use super::{Adjoints, Function, Given, Reversible};
use crate::vectors::{add, copy, fill};
use crate::{Explicit, Stabilization};

/// Steps of a run backward, and room for them.
pub enum Backward {
    /// The whole step is one function; the weights of its results.
    Whole(Function, Vec<f64>),
    Staged(Box<Stages>),
}

/// Room for a step in stages: what is computed forward first, and the adjoints of it.
pub struct Stages {
    method: Explicit,
    /// q, v and q̈ of every stage.
    positions: Vec<Vec<f64>>,
    velocities: Vec<Vec<f64>>,
    accelerations: Vec<Vec<f64>>,
    feedback: Vec<f64>,
    /// Adjoints of v and q̈ of every stage.
    of_velocities: Vec<Vec<f64>>,
    of_accelerations: Vec<Vec<f64>>,
    /// Adjoints of the state before the step.
    of_position: Vec<f64>,
    of_velocity: Vec<f64>,
    /// The projection, if the method has one.
    projection: Option<Projection>,
    /// Weights of the results of a stage.
    weights: Vec<f64>,
    unread: Vec<f64>,
}

impl Backward {
    pub fn new(run: &dyn Reversible) -> Self {
        let (info, method) = (run.info(), run.method());
        let (s, m) = (info.states.len(), info.constraints.len());
        if let Some(function) = run.whole_step() {
            return Self::Whole(function, vec![0.0; 2 * s]);
        }
        let of_stages = || vec![vec![0.0; s]; method.tableau.stage_count()];
        Self::Staged(Box::new(Stages {
            method,
            positions: of_stages(),
            velocities: of_stages(),
            accelerations: of_stages(),
            feedback: vec![0.0; m],
            of_velocities: of_stages(),
            of_accelerations: of_stages(),
            of_position: vec![0.0; s],
            of_velocity: vec![0.0; s],
            projection: method.is_projected().then(|| Projection::new(info)),
            weights: vec![0.0; s + m],
            unread: vec![0.0; m],
        }))
    }

    /// Goes back over the step that begins at `at`: the adjoints of positions and velocities are those behind
    /// the step, and afterwards those before it; to all others is added.
    pub fn step(&mut self, run: &mut dyn Reversible, at: &Given<'_, f64>, adjoints: &mut Adjoints<'_, f64>) {
        match self {
            Self::Whole(function, weights) => {
                let half = weights.len() / 2;
                let (of_q, of_v) = weights.split_at_mut(half);
                take(of_q, adjoints.q);
                take(of_v, adjoints.v);
                run.backward(*function, at, weights, adjoints);
            }
            Self::Staged(stages) => {
                stages.forward(run, at);
                stages.backward(run, at, adjoints);
            }
        }
    }
}

/// The functions of the first stage and of the others.
const fn functions(method: Explicit) -> [Function; 2] {
    match method.stabilization {
        Stabilization::Held => [Function::Stabilized, Function::Constrained],
        Stabilization::PerStage => [Function::Stabilized; 2],
        Stabilization::Projection => [Function::Constrained; 2],
    }
}

impl Stages {
    /// The stages of the step, as they were made.
    fn forward(&mut self, run: &mut dyn Reversible, at: &Given<'_, f64>) {
        let [first, others] = functions(self.method);
        fill(&mut self.feedback, 0.0);
        for stage in 0..self.positions.len() {
            self.lead(stage, at);
            let given = Given {
                t: time(self.method, stage, at),
                q: &self.positions[stage],
                v: &self.velocities[stage],
                feedback: &self.feedback,
                ..*at
            };
            let (a, unread) = (&mut self.accelerations[stage], &mut self.unread);
            match if stage == 0 { first } else { others } {
                Function::Constrained => run.forward(Function::Constrained, &given, &mut [a]),
                function => run.forward(function, &given, &mut [a, unread]),
            }
            if stage == 0 && first == Function::Stabilized {
                copy(&mut self.feedback, &self.unread);
            }
        }
        self.project(run, at);
    }

    /// The end of the step before it is projected, and the projection.
    fn project(&mut self, run: &mut dyn Reversible, at: &Given<'_, f64>) {
        let Some(projection) = &mut self.projection else { return };
        let update = Sum::update(self.method, at);
        for (k, ((q, v), (q_end, v_end))) in
            at.q.iter().zip(at.v).zip(projection.q.iter_mut().zip(&mut projection.v)).enumerate()
        {
            *q_end = q + update.of(&self.velocities, k);
            *v_end = v + update.of(&self.accelerations, k);
        }
        projection.forward(run, at);
    }

    /// Position and velocity of a stage.
    fn lead(&mut self, stage: usize, at: &Given<'_, f64>) {
        let (q, (before, there)) = (&mut self.positions[stage], self.velocities.split_at_mut(stage));
        copy(q, at.q);
        let Some(there) = there.first_mut() else { return };
        copy(there, at.v);
        let Some(sum) = Sum::before(self.method, stage, at) else { return };
        for (k, q) in q.iter_mut().enumerate() {
            *q += sum.of(before, k);
        }
        for (k, v) in there.iter_mut().enumerate() {
            *v += sum.of(&self.accelerations, k);
        }
    }

    /// From the end of the step to its start.
    fn backward(&mut self, run: &mut dyn Reversible, at: &Given<'_, f64>, adjoints: &mut Adjoints<'_, f64>) {
        let [first, others] = functions(self.method);
        copy(&mut self.of_position, adjoints.q);
        copy(&mut self.of_velocity, adjoints.v);
        if let Some(projection) = &mut self.projection {
            projection.backward(run, at, [&mut self.of_position, &mut self.of_velocity], adjoints);
        }
        self.of_velocities.iter_mut().chain(&mut self.of_accelerations).for_each(|slope| fill(slope, 0.0));
        let update = Sum::update(self.method, at);
        update.spread(&self.of_position, &mut self.of_velocities);
        update.spread(&self.of_velocity, &mut self.of_accelerations);
        fill(adjoints.feedback, 0.0);
        for stage in (0..self.positions.len()).rev() {
            fill(adjoints.q, 0.0);
            fill(adjoints.v, 0.0);
            let of_results = self.of_accelerations[stage].iter().chain(&*adjoints.feedback);
            self.weights.iter_mut().zip(of_results).for_each(|(weight, adjoint)| *weight = *adjoint);
            let given = Given {
                t: time(self.method, stage, at),
                q: &self.positions[stage],
                v: &self.velocities[stage],
                feedback: &self.feedback,
                ..*at
            };
            run.backward(if stage == 0 { first } else { others }, &given, &self.weights, adjoints);
            self.pass(stage, Sum::before(self.method, stage, at), adjoints);
        }
        copy(adjoints.q, &self.of_position);
        copy(adjoints.v, &self.of_velocity);
        fill(adjoints.feedback, 0.0);
    }

    /// The adjoints of the state of a stage, to what it was made of.
    fn pass(&mut self, stage: usize, sum: Option<Sum>, adjoints: &mut Adjoints<'_, f64>) {
        add(&mut self.of_position, adjoints.q);
        if let Some(sum) = &sum {
            sum.spread(adjoints.q, &mut self.of_velocities);
        }
        // v of the stage is a slope, and q̈ was found with it
        add(adjoints.v, &self.of_velocities[stage]);
        add(&mut self.of_velocity, adjoints.v);
        if let Some(sum) = &sum {
            sum.spread(adjoints.v, &mut self.of_accelerations);
        }
    }
}

/// Moves as many numbers as there are in `to`, and leaves 0.
fn take(to: &mut [f64], from: &mut [f64]) {
    to.iter_mut().zip(from).for_each(|(to, from)| *to = core::mem::take(from));
}

/// (share · h) Σ w k
struct Sum {
    weights: &'static [f64],
    factor: f64,
}

impl Sum {
    /// The sum that leads to a stage; `None` for the first one.
    fn before(method: Explicit, stage: usize, at: &Given<'_, f64>) -> Option<Self> {
        let row = method.tableau.stages.get(stage.checked_sub(1)?)?;
        Some(Self { weights: row.weights, factor: row.share * at.h })
    }

    /// The sum that leads to the end of the step.
    fn update(method: Explicit, at: &Given<'_, f64>) -> Self {
        let row = &method.tableau.update;
        Self { weights: row.weights, factor: row.share * at.h }
    }

    fn of(&self, slopes: &[Vec<f64>], component: usize) -> f64 {
        let terms = self.weights.iter().zip(slopes);
        self.factor * terms.map(|(weight, slope)| weight * slope[component]).sum::<f64>()
    }

    /// Adds the adjoint of the sum to those of the k.
    fn spread(&self, adjoint: &[f64], slopes: &mut [Vec<f64>]) {
        for (weight, slope) in self.weights.iter().zip(slopes) {
            for (slope, adjoint) in slope.iter_mut().zip(adjoint) {
                *slope += self.factor * weight * adjoint;
            }
        }
    }
}

/// t of a stage.
fn time(method: Explicit, stage: usize, at: &Given<'_, f64>) -> f64 {
    let row = stage.checked_sub(1).and_then(|before| method.tableau.stages.get(before));
    let node = row.map_or(0.0, |row| row.node());
    if node == 1.0 { at.t_next } else { at.t + node * at.h }
}
