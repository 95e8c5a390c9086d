//! A live mechanism with room for the functions that a run to a tolerance calls.

use std::cell::RefCell;

use mbs_codegen::FunctionId;
use mbs_runtime::equations::{At, Described, Equations, Room};
use mbs_runtime::explicit::Beside;
use mbs_runtime::{Dynamics, Error, Scheme};

use crate::Live;
use crate::arguments::Arguments;
use crate::equations::{position, single, state};
use crate::instruction::execute;

/// A live mechanism that [`Adaptive`](mbs_runtime::Adaptive) can integrate; see
/// [`Run::adaptive`](crate::Run::adaptive).
#[derive(Clone, Debug)]
pub struct Prepared {
    live: Live,
    room: RefCell<Memory>,
}

/// Slots of the functions that are called in every step, and vectors between them.
#[derive(Clone, Debug)]
struct Memory {
    acceleration: Vec<[f64; 1]>,
    complete: Vec<[f64; 1]>,
    phi: Vec<[f64; 1]>,
    phi_dot: Vec<[f64; 1]>,
    projection: Vec<[f64; 1]>,
    /// All coordinates, velocities and corrections.
    all: [Vec<f64>; 3],
    violation: Vec<f64>,
    no_feedback: Vec<f64>,
}

impl Prepared {
    /// A mechanism with room for its functions.
    pub fn new(live: &Live) -> Self {
        let slots = |function| live.programs().function(function).memory(|fixed| [live.fixed(fixed)]);
        let info = live.declared_info();
        let (n, m) = (info.coordinates.len(), info.constraints.len());
        let room = Memory {
            acceleration: slots(FunctionId::Constrained),
            complete: slots(FunctionId::Complete),
            phi: slots(FunctionId::Phi),
            phi_dot: slots(FunctionId::PhiDot),
            projection: slots(FunctionId::Projection),
            all: [(); 3].map(|()| vec![0.0; n]),
            violation: vec![0.0; m],
            no_feedback: vec![0.0; m],
        };
        Self { live: live.clone(), room: RefCell::new(room) }
    }

    /// The mechanism.
    pub fn mechanism(&self) -> &Live {
        &self.live
    }

    /// Runs a function in its slots.
    fn run<const VECTORS: usize>(
        &self,
        function: FunctionId,
        slots: &mut [[f64; 1]],
        arguments: &Arguments<'_>,
        results: [&mut [f64]; VECTORS],
    ) {
        let programs = self.live.programs();
        let code = programs.function(function);
        code.load(slots, arguments);
        execute(&code.instructions, programs.tables.splines, slots);
        code.store(slots, &mut results.map(|vector| vector.as_chunks_mut().0));
    }
}

impl Dynamics for Prepared {
    type Real = f64;
    type Coordinates = Vec<f64>;
    type States = Vec<f64>;
    type Constraints = Vec<f64>;
    type Inputs = Vec<f64>;

    fn equations(&self) -> &dyn Equations<f64> {
        &self.live
    }

    fn described(&self) -> &dyn Described<f64> {
        &self.live
    }

    fn declared_start(&self) -> (f64, Vec<f64>, Vec<f64>) {
        self.live.declared_start()
    }

    fn states(&self, all: &Vec<f64>) -> Vec<f64> {
        let mut states = vec![0.0; self.live.declared_info().states.len()];
        self.live.states(all, &mut states);
        states
    }

    fn complete(&self, t: f64, q: &Vec<f64>, v: &Vec<f64>, [q_all, v_all]: &mut [Vec<f64>; 2]) {
        let slots = &mut self.room.borrow_mut().complete;
        self.run(FunctionId::Complete, slots, &state(At { t, q, v }), [q_all, v_all]);
    }

    fn no_feedback(&self) -> Vec<f64> {
        vec![0.0; self.live.declared_info().constraints.len()]
    }

    fn default_inputs(&self) -> Vec<f64> {
        self.live.declared_info().inputs.iter().map(|input| input.default).collect()
    }

    fn with_inputs<R>(&self, inputs: &mut Vec<f64>, what: impl FnOnce(&mut [f64]) -> R) -> R {
        what(inputs)
    }

    fn with_room<S: Scheme>(
        &self,
        what: impl FnOnce(&mut Room<'_, f64>) -> Result<(), Error>,
    ) -> Result<(), Error> {
        let info = self.live.declared_info();
        let mut numbers = vec![0.0; Room::<f64>::len(info, S::TABLEAU.stage_count())];
        what(&mut Room::within(&mut numbers, info))
    }

    fn events(&self, at: At<'_, f64>, inputs: &Vec<f64>, values: &mut [f64]) {
        self.live.events(at, inputs, values);
    }

    fn acceleration(
        &self,
        t: f64,
        q: &Vec<f64>,
        v: &Vec<f64>,
        inputs: &Vec<f64>,
        acceleration: &mut Vec<f64>,
    ) -> f64 {
        let Memory { acceleration: slots, no_feedback, .. } = &mut *self.room.borrow_mut();
        let at = Arguments { inputs: single(inputs), feedback: single(no_feedback), ..state(At { t, q, v }) };
        let mut growth = [f64::NAN];
        self.run(FunctionId::Constrained, slots, &at, [acceleration, &mut growth]);
        growth[0]
    }

    fn correction(&self, t: f64, at: &Beside<'_, Vec<f64>>, delta: &mut Vec<f64>) -> f64 {
        let Memory { complete, phi, phi_dot, projection, all: [q, v, correction], violation, .. } =
            &mut *self.room.borrow_mut();
        // positions do not depend on velocities
        let states = At { t, q: at.q, v: at.v.unwrap_or(at.q) };
        self.run(FunctionId::Complete, complete, &state(states), [&mut *q, &mut *v]);
        match at.v {
            None => self.run(FunctionId::Phi, phi, &position(t, q), [&mut *violation]),
            Some(_) => self.run(FunctionId::PhiDot, phi_dot, &state(At { t, q, v }), [&mut *violation]),
        }
        let given = Arguments { feedback: single(violation), ..position(t, q) };
        let mut growth = [f64::NAN];
        self.run(FunctionId::Projection, projection, &given, [&mut *correction, &mut growth]);
        self.live.states(correction, delta);
        growth[0]
    }
}
