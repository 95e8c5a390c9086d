//! A live mechanism with room for the functions that a run to a tolerance calls.

use std::cell::RefCell;

use mbs_codegen::FunctionId;
use mbs_runtime::equations::{At, Equations, Room};
use mbs_runtime::explicit::Beside;
use mbs_runtime::{Derivation, Dynamics, Error, Real, Scheme, Sketch};

use crate::Live;
use crate::arguments::Arguments;
use crate::equations::{position, single, state};
use crate::instruction::execute;

/// A live mechanism that [`Adaptive`](mbs_runtime::Adaptive) can integrate; see
/// [`Run::adaptive`](crate::Run::adaptive).
///
/// # Example
/// ```
/// use mbs_live::{Prepared, Text};
/// use mbs_runtime::{Adaptive, Sampled, System};
///
/// let text = "Fall { dof = 1; gravity = (0, -9.81) [m/s^2]; body ball (y) { mass = 1 [kg]; } }";
/// let ball = Prepared::new(&Text::declaration("fall.mbs", text).compile()?);
/// assert_eq!(ball.mechanism().declared_info().name, "Fall");
///
/// // a sample after every second
/// let mut run = Sampled::new(Adaptive::builder(ball).build()?, 1.0)?;
/// run.advance(2)?;
/// let (mut y, mut v) = ([0.0], [0.0]);
/// run.state(&mut y, &mut v);
/// assert!((y[0] + 0.5 * 9.81 * 4.0).abs() < 1e-9);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Prepared<T = f64> {
    live: Live<T>,
    room: RefCell<Memory<T>>,
}

/// Slots of the functions that are called in every step, and vectors between them.
#[derive(Clone, Debug)]
struct Memory<T> {
    acceleration: Vec<[T; 1]>,
    implicit: Vec<[T; 1]>,
    complete: Vec<[T; 1]>,
    phi: Vec<[T; 1]>,
    phi_dot: Vec<[T; 1]>,
    projection: Vec<[T; 1]>,
    /// All coordinates, velocities and corrections.
    all: [Vec<T>; 3],
    violation: Vec<T>,
    no_feedback: Vec<T>,
}

impl<T: Real> Prepared<T> {
    /// A mechanism with room for its functions.
    pub fn new(live: &Live<T>) -> Self {
        let slots = |function| live.programs().function(function).memory(|fixed| [live.fixed(fixed)]);
        let info = live.declared_info();
        let (n, m) = (info.coordinates.len(), info.constraints.len());
        let room = Memory {
            acceleration: slots(FunctionId::Constrained),
            implicit: slots(FunctionId::Implicit),
            complete: slots(FunctionId::Complete),
            phi: slots(FunctionId::Phi),
            phi_dot: slots(FunctionId::PhiDot),
            projection: slots(FunctionId::Projection),
            all: [(); 3].map(|()| vec![T::ZERO; n]),
            violation: vec![T::ZERO; m],
            no_feedback: vec![T::ZERO; m],
        };
        Self { live: live.clone(), room: RefCell::new(room) }
    }

    /// The mechanism.
    pub fn mechanism(&self) -> &Live<T> {
        &self.live
    }

    /// Runs a function in its slots.
    fn run<const VECTORS: usize>(
        &self,
        function: FunctionId,
        slots: &mut [[T; 1]],
        arguments: &Arguments<'_, T>,
        results: [&mut [T]; VECTORS],
    ) {
        let programs = self.live.programs();
        let code = programs.function(function);
        code.load(slots, arguments);
        execute(&code.instructions, programs.tables.splines, slots);
        code.store(slots, &mut results.map(|vector| vector.as_chunks_mut().0));
    }
}

impl<T: Real> Dynamics for Prepared<T> {
    type Real = T;
    type Coordinates = Vec<T>;
    type States = Vec<T>;
    type Constraints = Vec<T>;
    type Inputs = Vec<T>;

    fn equations(&self) -> &dyn Equations<T> {
        &self.live
    }

    fn derivation(&self) -> &Derivation {
        self.live.derivation()
    }

    fn sketch(&self) -> &Sketch {
        self.live.sketch()
    }

    fn declared_start(&self) -> (T, Vec<T>, Vec<T>) {
        self.live.declared_start()
    }

    fn states(&self, all: &Vec<T>) -> Vec<T> {
        let mut states = vec![T::ZERO; self.live.declared_info().states.len()];
        self.live.states(all, &mut states);
        states
    }

    fn complete(&self, t: T, q: &Vec<T>, v: &Vec<T>, [q_all, v_all]: &mut [Vec<T>; 2]) {
        let slots = &mut self.room.borrow_mut().complete;
        self.run(FunctionId::Complete, slots, &state(At { t, q, v }), [q_all, v_all]);
    }

    fn no_feedback(&self) -> Vec<T> {
        vec![T::ZERO; self.live.declared_info().constraints.len()]
    }

    fn default_inputs(&self) -> Vec<T> {
        self.live.declared_info().inputs.iter().map(|input| T::from_f64(input.default)).collect()
    }

    fn with_inputs<R>(&self, inputs: &mut Vec<T>, what: impl FnOnce(&mut [T]) -> R) -> R {
        what(inputs)
    }

    fn with_room<S: Scheme>(
        &self,
        what: impl FnOnce(&mut Room<'_, T>) -> Result<(), Error>,
    ) -> Result<(), Error> {
        let info = self.live.declared_info();
        let mut numbers = vec![T::ZERO; Room::<T>::len(info, S::TABLEAU.stage_count())];
        what(&mut Room::within(&mut numbers, info))
    }

    fn events(&self, at: At<'_, T>, inputs: &Vec<T>, values: &mut [T]) {
        self.live.events(at, inputs, values);
    }

    fn free_acceleration(
        &self,
        t: T,
        q: &Vec<T>,
        v: &Vec<T>,
        inputs: &Vec<T>,
        acceleration: &mut Vec<T>,
    ) -> T {
        let Memory { acceleration: slots, no_feedback, .. } = &mut *self.room.borrow_mut();
        let at = Arguments { inputs: single(inputs), feedback: single(no_feedback), ..state(At { t, q, v }) };
        let mut growth = [T::from_f64(f64::NAN)];
        self.run(FunctionId::Constrained, slots, &at, [acceleration, &mut growth]);
        growth[0]
    }

    fn implicit(
        &self,
        t: T,
        [q, v]: [&Vec<T>; 2],
        inputs: &Vec<T>,
        (shift, predicted): (T, &Vec<T>),
        acceleration: &mut Vec<T>,
    ) -> T {
        let slots = &mut self.room.borrow_mut().implicit;
        let at = Arguments {
            inputs: single(inputs),
            shift: [shift],
            acceleration: single(predicted),
            ..state(At { t, q, v })
        };
        let mut growth = [T::from_f64(f64::NAN)];
        self.run(FunctionId::Implicit, slots, &at, [acceleration, &mut growth]);
        growth[0]
    }

    fn correction(&self, t: T, at: &Beside<'_, Vec<T>>, delta: &mut Vec<T>) -> T {
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
        let mut growth = [T::from_f64(f64::NAN)];
        self.run(FunctionId::Projection, projection, &given, [&mut *correction, &mut growth]);
        self.live.states(correction, delta);
        growth[0]
    }

    fn correction_along(&self, from: (T, &Vec<T>), t: T, q: &Vec<T>, delta: &mut Vec<T>) -> T {
        let Memory { complete, phi, projection, all: [at, unread, correction], violation, .. } =
            &mut *self.room.borrow_mut();
        // positions do not depend on velocities
        self.run(FunctionId::Complete, complete, &state(At { t, q, v: q }), [&mut *at, &mut *unread]);
        self.run(FunctionId::Phi, phi, &position(t, at), [&mut *violation]);
        let (t, q) = from;
        self.run(FunctionId::Complete, complete, &state(At { t, q, v: q }), [&mut *at, &mut *unread]);
        let given = Arguments { feedback: single(violation), ..position(t, at) };
        let mut growth = [T::from_f64(f64::NAN)];
        self.run(FunctionId::Projection, projection, &given, [&mut *correction, &mut growth]);
        self.live.states(correction, delta);
        growth[0]
    }
}
