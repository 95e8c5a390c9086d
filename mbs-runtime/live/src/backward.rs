//! Steps that go backward: from how much the state behind a step counts to how much that before it does, and
//! everything that the step reads.

mod measures;
mod projection;

pub use measures::{FUNCTIONS as MEASURES, Measures};
pub use projection::FUNCTIONS as PROJECTION;

use std::sync::Arc;

use mbs_codegen::FunctionId;
use mbs_runtime::{Error, Explicit, Stabilization};

use crate::Live;
use crate::arguments::Arguments;
use crate::code::Code;
use crate::instruction::execute;
use crate::live::Programs;
use crate::transposed::{Counts, Transposed, Transposes};
use projection::Projection;

/// Slots of a code.
type Slots = Vec<[f64; 1]>;

/// Transposed steps of a mechanism, and room for them.
pub struct Backward {
    programs: Arc<Programs>,
    method: Explicit,
    memory: Memory,
}

enum Memory {
    /// The whole step is one program.
    Fused(Slots, Slots),
    Staged(Box<Stages>),
}

/// Room for a step in stages: what is computed forward first, and what each of it counts.
struct Stages {
    first: Slots,
    others: Slots,
    first_back: Slots,
    others_back: Slots,
    /// q, v and q̈ of every stage.
    positions: Vec<Slots>,
    velocities: Vec<Slots>,
    accelerations: Vec<Slots>,
    feedback: Slots,
    /// How much v and q̈ of every stage count.
    of_velocities: Vec<Vec<f64>>,
    of_accelerations: Vec<Vec<f64>>,
    /// How much the state before the step counts.
    of_position: Vec<f64>,
    of_velocity: Vec<f64>,
    /// What projects, where the method does.
    projection: Option<Projection>,
    /// Weights of the results of a stage.
    weights: Slots,
    unread: Slots,
}

impl Backward {
    /// Steps of this method.
    ///
    /// # Errors
    /// [`Error::NoTranspose`].
    pub fn new(live: &Live, method: Explicit) -> Result<Self, Error> {
        let programs = live.programs();
        let Some(transposes) = &programs.transposes else {
            return Err(Error::NoTranspose { mechanism: live.declared_info().name });
        };
        let slots = |code: &Code| code.memory(|fixed| [live.fixed(fixed)]);
        let info = live.declared_info();
        let (s, m) = (info.states.len(), info.constraints.len());
        let column = |count: usize| vec![[0.0]; count];
        let memory = match fused(programs, transposes, method) {
            Some(transposed) => Memory::Fused(slots(&transposed.code), column(2 * s)),
            None => {
                let count = method.tableau.stage_count();
                let [first, others] = functions(method);
                let [first_back, others_back] = transposed(transposes, method);
                Memory::Staged(Box::new(Stages {
                    first: slots(programs.function(first)),
                    others: slots(programs.function(others)),
                    first_back: slots(&first_back.code),
                    others_back: slots(&others_back.code),
                    positions: vec![column(s); count],
                    velocities: vec![column(s); count],
                    accelerations: vec![column(s); count],
                    feedback: column(m),
                    of_velocities: vec![vec![0.0; s]; count],
                    of_accelerations: vec![vec![0.0; s]; count],
                    of_position: vec![0.0; s],
                    of_velocity: vec![0.0; s],
                    projection: method.is_projected().then(|| Projection::new(live, transposes)),
                    weights: column(s + m),
                    unread: column(m),
                }))
            }
        };
        Ok(Self { programs: Arc::clone(programs), method, memory })
    }

    /// Goes back over the step that begins at `at`: `counts` says how much positions and velocities behind the
    /// step count, and afterwards how much those before it do; to everything else is added.
    pub fn step(&mut self, at: &Arguments<'_>, counts: &mut Counts) {
        let Self { programs, method, memory } = self;
        let Some(transposes) = &programs.transposes else { return };
        let splines = programs.tables.splines;
        match memory {
            Memory::Fused(slots, weights) => {
                let Some(transposed) = fused(programs, transposes, *method) else { return };
                let s = weights.len() / 2;
                let ranges = [counts.layout.positions(), counts.layout.velocities()];
                for (weights, range) in weights.chunks_exact_mut(s.max(1)).zip(ranges) {
                    for (weight, count) in weights.iter_mut().zip(counts.part(range)) {
                        *weight = [std::mem::take(count)];
                    }
                }
                transposed.run(splines, slots, &Arguments { weights, ..*at }, &mut counts.numbers);
            }
            Memory::Staged(stages) => {
                stages.forward(programs, *method, at);
                stages.backward((programs, transposes), *method, at, counts);
            }
        }
    }
}

/// The transposed program of a whole step, if there is one.
fn fused<'a>(programs: &Programs, transposes: &'a Transposes, method: Explicit) -> Option<&'a Transposed> {
    programs.step(method)?;
    let [held, per_stage] = transposes.steps.as_ref()?;
    match method.stabilization {
        Stabilization::Held => Some(held),
        Stabilization::PerStage => Some(per_stage),
        Stabilization::Projection => None,
    }
}

/// The functions of the first stage and of the others.
fn functions(method: Explicit) -> [FunctionId; 2] {
    match method.stabilization {
        Stabilization::Held => [FunctionId::Stabilized, FunctionId::Constrained],
        Stabilization::PerStage => [FunctionId::Stabilized; 2],
        Stabilization::Projection => [FunctionId::Constrained; 2],
    }
}

/// Their transposes.
fn transposed(transposes: &Transposes, method: Explicit) -> [&Transposed; 2] {
    match method.stabilization {
        Stabilization::Held => [&transposes.held, &transposes.constrained],
        Stabilization::PerStage => [&transposes.alone; 2],
        Stabilization::Projection => [&transposes.constrained; 2],
    }
}

impl Stages {
    /// The stages of the step, as they were made.
    fn forward(&mut self, programs: &Programs, method: Explicit, at: &Arguments<'_>) {
        let [first, others] = functions(method);
        let count = self.positions.len();
        for stage in 0..count {
            self.lead(method, stage, at);
            let (function, slots) =
                if stage == 0 { (first, &mut self.first) } else { (others, &mut self.others) };
            let code = programs.function(function);
            let given = Arguments {
                t: time(method, stage, at),
                q: &self.positions[stage],
                v: &self.velocities[stage],
                feedback: &self.feedback,
                ..*at
            };
            code.load(slots, &given);
            execute(&code.instructions, programs.tables.splines, slots);
            let a = &mut self.accelerations[stage];
            match (stage, function) {
                (_, FunctionId::Constrained) => code.store(slots, &mut [a]),
                (0, _) => code.store(slots, &mut [a, &mut self.feedback]),
                _ => code.store(slots, &mut [a, &mut self.unread]),
            }
        }
        self.project(programs, method, at);
    }

    /// The end of the step before it is projected, and the projection.
    fn project(&mut self, programs: &Programs, method: Explicit, at: &Arguments<'_>) {
        let Some(projection) = &mut self.projection else { return };
        let update = Sum::update(method, at);
        for (k, ((q, v), (q_end, v_end))) in
            at.q.iter().zip(at.v).zip(projection.q.iter_mut().zip(&mut projection.v)).enumerate()
        {
            *q_end = [q[0] + update.of(&self.velocities, k)];
            *v_end = [v[0] + update.of(&self.accelerations, k)];
        }
        projection.forward(programs, at);
    }

    /// Position and velocity of a stage.
    fn lead(&mut self, method: Explicit, stage: usize, at: &Arguments<'_>) {
        let (q, v) = (&mut self.positions[stage], self.velocities.split_at_mut(stage));
        let (before, there) = v;
        q.copy_from_slice(at.q);
        let Some(there) = there.first_mut() else { return };
        there.copy_from_slice(at.v);
        let Some(sum) = Sum::before(method, stage, at) else { return };
        for (k, q) in q.iter_mut().enumerate() {
            q[0] += sum.of(before, k);
        }
        for (k, v) in there.iter_mut().enumerate() {
            v[0] += sum.of(&self.accelerations, k);
        }
    }

    /// From the end of the step to its start.
    fn backward(
        &mut self,
        (programs, transposes): (&Programs, &Transposes),
        method: Explicit,
        at: &Arguments<'_>,
        counts: &mut Counts,
    ) {
        let (layout, splines) = (counts.layout, programs.tables.splines);
        let [first, others] = transposed(transposes, method);
        let update = Sum::update(method, at);
        copy(&mut self.of_position, counts.part(layout.positions()));
        copy(&mut self.of_velocity, counts.part(layout.velocities()));
        if let Some(projection) = &mut self.projection {
            let counted = [&mut self.of_position[..], &mut self.of_velocity];
            projection.backward((programs, transposes), at, counted, counts);
        }
        for slopes in [&mut self.of_velocities, &mut self.of_accelerations] {
            slopes.iter_mut().for_each(|slope| slope.fill(0.0));
        }
        update.spread(&self.of_position, &mut self.of_velocities);
        update.spread(&self.of_velocity, &mut self.of_accelerations);
        counts.part(layout.feedback()).fill(0.0);
        for stage in (0..self.positions.len()).rev() {
            counts.part(layout.positions()).fill(0.0);
            counts.part(layout.velocities()).fill(0.0);
            let a = self.of_accelerations[stage].iter().chain(counts.part(layout.feedback()).iter());
            for (weight, count) in self.weights.iter_mut().zip(a) {
                *weight = [*count];
            }
            let (transposed, slots) =
                if stage == 0 { (first, &mut self.first_back) } else { (others, &mut self.others_back) };
            let given = Arguments {
                t: time(method, stage, at),
                q: &self.positions[stage],
                v: &self.velocities[stage],
                feedback: &self.feedback,
                weights: &self.weights,
                ..*at
            };
            transposed.run(splines, slots, &given, &mut counts.numbers);
            self.pass(stage, Sum::before(method, stage, at), counts);
        }
        copy(counts.part(layout.positions()), &self.of_position);
        copy(counts.part(layout.velocities()), &self.of_velocity);
        counts.part(layout.feedback()).fill(0.0);
    }

    /// What the state of a stage counts, to what it was made of.
    fn pass(&mut self, stage: usize, sum: Option<Sum>, counts: &mut Counts) {
        let layout = counts.layout;
        let q = &*counts.part(layout.positions());
        add(&mut self.of_position, q);
        if let Some(sum) = &sum {
            sum.spread(q, &mut self.of_velocities);
        }
        // v of the stage counts as a slope and as what q̈ was found with
        let v = counts.part(layout.velocities());
        add(v, &self.of_velocities[stage]);
        add(&mut self.of_velocity, v);
        if let Some(sum) = &sum {
            sum.spread(v, &mut self.of_accelerations);
        }
    }
}

/// As many numbers as there are in both.
fn copy(to: &mut [f64], from: &[f64]) {
    to.iter_mut().zip(from).for_each(|(to, from)| *to = *from);
}

/// Weights of results from what they count.
fn put(weights: &mut [[f64; 1]], counts: &[f64]) {
    weights.iter_mut().zip(counts).for_each(|(weight, count)| *weight = [*count]);
}

fn add(to: &mut [f64], from: &[f64]) {
    to.iter_mut().zip(from).for_each(|(to, from)| *to += from);
}

/// (share · h) Σ w k
struct Sum {
    weights: &'static [f64],
    factor: f64,
}

impl Sum {
    /// What leads to a stage; nothing to the first.
    fn before(method: Explicit, stage: usize, at: &Arguments<'_>) -> Option<Self> {
        let row = method.tableau.stages.get(stage.checked_sub(1)?)?;
        Some(Self { weights: row.weights, factor: row.share * at.step[0] })
    }

    /// What leads to the end of the step.
    fn update(method: Explicit, at: &Arguments<'_>) -> Self {
        let row = &method.tableau.update;
        Self { weights: row.weights, factor: row.share * at.step[0] }
    }

    fn of(&self, slopes: &[Slots], component: usize) -> f64 {
        let terms = self.weights.iter().zip(slopes);
        self.factor * terms.map(|(weight, slope)| weight * slope[component][0]).sum::<f64>()
    }

    /// Adds what the sum counts to what the k count.
    fn spread(&self, count: &[f64], slopes: &mut [Vec<f64>]) {
        for (weight, slope) in self.weights.iter().zip(slopes) {
            for (slope, count) in slope.iter_mut().zip(count) {
                *slope += self.factor * weight * count;
            }
        }
    }
}

/// t of a stage.
fn time(method: Explicit, stage: usize, at: &Arguments<'_>) -> [f64; 1] {
    let row = stage.checked_sub(1).and_then(|before| method.tableau.stages.get(before));
    let node = row.map_or(0.0, |row| row.node());
    if node == 1.0 { at.t_next } else { [at.t[0] + node * at.step[0]] }
}
