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
    /// How many coordinates and constraints there are.
    sizes: [usize; 2],
    room: RefCell<Memory>,
}

/// Slots of the functions that are called in every step, and vectors between them.
#[derive(Clone, Debug)]
struct Memory {
    acceleration: Vec<[f64; 1]>,
    phi: Vec<[f64; 1]>,
    phi_dot: Vec<[f64; 1]>,
    projection: Vec<[f64; 1]>,
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
            phi: slots(FunctionId::Phi),
            phi_dot: slots(FunctionId::PhiDot),
            projection: slots(FunctionId::Projection),
            violation: vec![0.0; m],
            no_feedback: vec![0.0; m],
        };
        Self { live: live.clone(), sizes: [n, m], room: RefCell::new(room) }
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

    fn no_feedback(&self) -> Vec<f64> {
        vec![0.0; self.sizes[1]]
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
        let [n, m] = self.sizes;
        let mut numbers = vec![0.0; Room::<f64>::len(n, m, S::TABLEAU.stage_count())];
        what(&mut Room::within(&mut numbers, n, m))
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
        let Memory { phi, phi_dot, projection, violation, .. } = &mut *self.room.borrow_mut();
        match at.v {
            None => self.run(FunctionId::Phi, phi, &position(t, at.q), [&mut *violation]),
            Some(v) => {
                let at = state(At { t, q: at.q, v });
                self.run(FunctionId::PhiDot, phi_dot, &at, [&mut *violation]);
            }
        }
        let given = Arguments { feedback: single(violation), ..position(t, at.q) };
        let mut growth = [f64::NAN];
        self.run(FunctionId::Projection, projection, &given, [delta, &mut growth]);
        growth[0]
    }
}
