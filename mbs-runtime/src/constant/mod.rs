//! Runs with a constant step of methods that are more than the stages of an explicit scheme.
//!
//! # How it works
//!
//! A `Kernel` takes the step: RATTLE in `rattle`, TR-BDF2 in `trbdf2`, or one of another crate. This module
//! makes a run of it. Kernels are generic over `Dynamics`, as runs to a tolerance are. Both kinds of runs
//! share three things: where they begin (`adaptive/beginning.rs`), why there is no step
//! (`adaptive/cause.rs`), and a state as a `System` shows it (`view.rs`).

mod builder;
mod kernel;
mod rattle;
mod system;
mod trbdf2;

pub use builder::ConstantStepBuilder;
pub use kernel::Kernel;
pub use rattle::{Rattle, RattleStep};
pub use trbdf2::{TrBdf2, TrBdf2Step};

use core::fmt;

use crate::adaptive::{Moment, RISEN, cause, is_healthy};
use crate::diagnosis::{check_inputs, singular};
use crate::equations::At;
use crate::moreau::Pushed;
use crate::run::note_risen;
use crate::samples::Grid;
use crate::simulation::clock;
use crate::vectors::assign;
use crate::watch::Watch;
use crate::{Components, Dynamics, Error, Heun, Mechanism, Real, State, moreau, vectors};

/// A mechanism being integrated with a constant step by a method of its own: a [`Rattle`] or a
/// [`TrBdf2`] run.
#[derive(Clone)]
pub struct ConstantStep<D: Dynamics, K: Kernel<D>> {
    dynamics: D,
    inputs: D::Inputs,
    kernel: K,
    step: D::Real,
    start_time: f64,
    steps: u64,
    /// The present state, with the acceleration that the last step ended with.
    now: Moment<D::Real, D::States>,
    /// The end of the step that is tried. Between steps it is the same as `now`: a step computes on the
    /// numbers that the one before has left, since it would have to wait for a copy.
    next: Moment<D::Real, D::States>,
    /// All coordinates and velocities of the present state.
    all: [D::Coordinates; 2],
    /// True if the acceleration of `next` is that of the present inputs.
    is_solved: bool,
    watch: Watch<D::Real>,
}

impl<D: Dynamics, K: Kernel<D>> ConstantStep<D, K> {
    /// Advances by one step.
    ///
    /// # Errors
    /// [`Error::NotConverged`] if there is no such step, and a shorter one mends it; [`Error::OutOfReach`],
    /// [`Error::Singular`], [`Error::NonFinite`], [`Error::Input`]. The state stays that of the last good step.
    pub fn step(&mut self) -> Result<(), Error> {
        let was_solved = self.is_solved;
        // a step that fails behind an impact has not set memories
        let inputs = self.dynamics.equations().info().jumps().then(|| self.inputs.clone());
        let taken = self.try_step();
        if taken.is_err() {
            copy_moment(&mut self.next, &self.now);
            self.is_solved = was_solved;
            if let Some(inputs) = inputs {
                self.inputs = inputs;
            }
        }
        taken
    }

    fn try_step(&mut self) -> Result<(), Error> {
        let pushed = self.push()?;
        self.solve()?;
        let Self { dynamics, inputs, kernel, step, start_time, steps, next, .. } = self;
        let start = D::Real::from_f64(*start_time);
        let t_next = start + D::Real::from_f64((*steps + 1) as f64) * *step;
        let growth = kernel.step(&*dynamics, inputs, *step, t_next, next);
        match growth.filter(|growth| is_healthy(*growth, next)) {
            Some(growth) => {
                self.strike(&pushed)?;
                self.accept(growth)
            }
            None => Err(self.cause()),
        }
    }

    /// The stops that push before a step.
    fn push(&mut self) -> Result<Pushed<D::Real>, Error> {
        let Self { dynamics, inputs, step, next, all: [q, v], .. } = self;
        if !dynamics.equations().info().jumps() {
            return Ok(Pushed::NONE);
        }
        let (mut v, mut vectors) = (v.clone(), vectors(dynamics));
        let pushed = with_memories(dynamics, next.t, inputs, |inputs| {
            let at = (next.t, q.as_ref(), v.as_mut());
            moreau::push(dynamics.equations(), (*step, vectors.changes()), at, inputs)
        })?;
        if pushed.is_any() {
            next.v = dynamics.states(&v);
            self.is_solved = false;
        }
        Ok(pushed)
    }

    /// Leads the step that was tried back from the stops that are closed at its end.
    fn strike(&mut self, pushed: &Pushed<D::Real>) -> Result<(), Error> {
        let Self { dynamics, inputs, step, now, next, all: [q_before, v_before], .. } = self;
        if !dynamics.equations().info().jumps() {
            return Ok(());
        }
        let (t, mut vectors, mut after) = (next.t, vectors(dynamics), [q_before.clone(), v_before.clone()]);
        dynamics.complete(t, &next.q, &next.v, &mut after);
        let [q, v] = &mut after;
        let before = At { t: now.t, q: q_before.as_ref(), v: v_before.as_ref() };
        let has_acted = with_memories(dynamics, t, inputs, |inputs| {
            let (end, equations) = ((t, [q.as_mut(), v.as_mut()]), dynamics.equations());
            moreau::strike(equations, (*step, vectors.changes()), (pushed, before), end, inputs)
        })?;
        if has_acted {
            (next.q, next.v) = (dynamics.states(q), dynamics.states(v));
        }
        // forces may depend on memories of stops
        self.is_solved = false;
        Ok(())
    }

    /// Rests on the stops that the start touches.
    fn touch(&mut self) -> Result<(), Error> {
        let Self { dynamics, inputs, step, now, all: [q, v], .. } = self;
        if !dynamics.equations().info().jumps() {
            return Ok(());
        }
        let (at, mut vectors) = (At { t: now.t, q: q.as_ref(), v: v.as_ref() }, vectors(dynamics));
        with_memories(dynamics, now.t, inputs, |inputs| {
            moreau::begin(dynamics.equations(), (*step, vectors.changes()), at, inputs)
        })
    }

    /// Makes the step that was tried the last one.
    fn accept(&mut self, growth: D::Real) -> Result<(), Error> {
        let Self { dynamics, now, next, watch, .. } = self;
        if growth > watch.alarm || !dynamics.equations().info().redundant.is_empty() {
            let ends = [now.at(), next.at()];
            dynamics.with_room::<Heun>(|room| note_risen(dynamics.equations(), ends, growth, watch, room))?;
        } else {
            watch.note(growth);
        }
        copy_moment(now, next);
        self.steps += 1;
        self.complete();
        self.sample();
        Ok(())
    }

    /// The steps, by which clocks are told.
    fn grid(&self) -> Grid {
        Grid { start: self.start_time, step: self.step.to_f64() }
    }

    /// Takes the samples that are due.
    fn sample(&mut self) {
        let (grid, steps) = (self.grid(), self.steps);
        let Self { dynamics, inputs, now, all: [q, v], .. } = self;
        if dynamics.equations().info().sampling.clocks == 0 {
            return;
        }
        let at = At { t: now.t, q: q.as_ref(), v: v.as_ref() };
        with_memories(dynamics, now.t, inputs, |present| {
            grid.sample(steps, dynamics.equations(), at, present);
        });
        self.is_solved = false;
    }

    /// All coordinates and velocities of the present state.
    fn complete(&mut self) {
        let Self { dynamics, now, all, .. } = self;
        dynamics.complete(now.t, &now.q, &now.v, all);
    }

    /// Sees to it that the step begins with the acceleration of the present inputs.
    fn solve(&mut self) -> Result<(), Error> {
        if self.is_solved {
            return Ok(());
        }
        let Self { dynamics, inputs, kernel, step, next, .. } = self;
        dynamics.with_inputs(inputs, |inputs| check_inputs(dynamics.equations().info(), inputs))?;
        let growth = kernel.accelerate(&*dynamics, inputs, *step, next);
        if !is_healthy(growth, next) {
            return Err(self.cause());
        }
        self.is_solved = true;
        Ok(())
    }

    /// Why there is no step from the present state.
    fn cause(&mut self) -> Error {
        let Self { dynamics, inputs, kernel, step, now, next, all, watch, .. } = self;
        let step = step.to_f64();
        let found =
            kernel.failure().or_else(|| cause::<D, Heun>(dynamics, inputs, now, next, *watch, 2.0 * step));
        found.unwrap_or_else(|| {
            let (equations, [q, _]) = (dynamics.equations(), &*all);
            match equations.worst_pivot(now.t, q.as_ref()) {
                Some((at, growth)) if growth > D::Real::from_f64(RISEN) => {
                    singular(equations.info(), now.t, equations.info().pivots.get(at), growth)
                }
                _ => Error::NotConverged { t: now.t.to_f64(), step },
            }
        })
    }

    /// Takes steps until less than half a step is left to `end` seconds.
    ///
    /// # Errors
    /// [`Error::EndTime`], [`Error::Time`], and as [`step`](Self::step).
    pub fn advance_to(&mut self, end: f64) -> Result<(), Error> {
        let steps = clock::steps_to::<D::Real>(self.start_time, self.step.to_f64(), self.steps, end)?;
        (0..steps).try_for_each(|_| self.step())
    }

    /// The present time in s.
    pub fn time(&self) -> D::Real {
        self.now.t
    }

    /// Steps taken since the start.
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// The inputs.
    pub fn inputs(&self) -> &D::Inputs {
        &self.inputs
    }

    /// The inputs, to be changed before a step; they are held over it.
    pub fn inputs_mut(&mut self) -> &mut D::Inputs {
        self.is_solved = false;
        &mut self.inputs
    }
}

impl<M: Mechanism, K: Kernel<M>> ConstantStep<M, K> {
    /// The mechanism.
    pub fn mechanism(&self) -> &M {
        &self.dynamics
    }

    /// The present state.
    pub fn state(&self) -> State<M::Coordinates> {
        let [q, v] = self.all.map(Components::from_array);
        State { t: self.now.t, q, v }
    }

    /// Kinetic plus potential energy in J.
    pub fn energy(&self) -> M::Real {
        let state = self.state();
        let mechanism = self.mechanism();
        Mechanism::kinetic_energy(mechanism, &state) + Mechanism::potential_energy(mechanism, &state)
    }

    /// ‖Φ‖ of the present state.
    pub fn violation(&self) -> M::Real {
        Mechanism::phi(&self.dynamics, self.now.t, &self.state().q).norm()
    }
}

impl<D: Dynamics, K: Kernel<D>> fmt::Debug for ConstantStep<D, K> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { now, step, steps, kernel, .. } = self;
        let mut shown = f.debug_struct("ConstantStep");
        shown.field("method", &kernel.word()).field("t", &now.t).field("step", step);
        shown.field("steps", steps).finish_non_exhaustive()
    }
}

/// Vectors that stops compute with.
fn vectors<D: Dynamics>(dynamics: &D) -> moreau::Vectors<D::Coordinates, D::Constraints> {
    let mut zero = dynamics.declared_start().1;
    vectors::fill(zero.as_mut(), D::Real::default());
    moreau::Vectors::new(zero, dynamics.no_feedback())
}

fn copy_moment<T: Real, V: AsRef<[T]> + AsMut<[T]>>(to: &mut Moment<T, V>, from: &Moment<T, V>) {
    assign(&mut to.q, &from.q);
    assign(&mut to.v, &from.v);
    assign(&mut to.a, &from.a);
    to.t = from.t;
}

/// Does something that sets memories, with the inputs that there are at a time.
fn with_memories<D: Dynamics, R>(
    dynamics: &D,
    t: D::Real,
    inputs: &mut D::Inputs,
    what: impl FnOnce(&mut [D::Real]) -> R,
) -> R {
    let sampling = dynamics.equations().info().sampling;
    let mut present = dynamics.inputs_at(t, inputs);
    dynamics.with_inputs(&mut present, |present| {
        let result = what(present);
        dynamics.with_inputs(inputs, |own| sampling.set_memories(own, present));
        result
    })
}
