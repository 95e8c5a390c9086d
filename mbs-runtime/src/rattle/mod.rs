//! RATTLE: steps that keep the energy of mechanisms without friction.

mod builder;
mod substep;
mod system;

pub use builder::RattleBuilder;

use core::fmt;

use mbs_schemes::Composition;
use substep::Substep;

use crate::adaptive::{Moment, cause, copy, is_healthy};
use crate::diagnosis::check_inputs;
use crate::run::note_risen;
use crate::simulation::clock;
use crate::watch::Watch;
use crate::{Components, Dynamics, Error, Heun, Mechanism, Real, State};

/// A mechanism being integrated by RATTLE, with a constant step.
///
/// With a = M⁻¹ Q(q) and h the step,
///
/// ```text
/// v½ = v + h/2 a(q) − M⁻¹ Φ_q(q)ᵀ μ,    q⁺ = q + h v½,    Φ(q⁺) = 0
/// v⁺ = v½ + h/2 a(q⁺) − M⁻¹ Φ_q(q⁺)ᵀ ν,                    Φ̇(q⁺, v⁺) = 0
/// ```
///
/// The positions are found by simplified Newton steps to rounding, the velocities by one solution.
/// The method is of second order, symmetric and symplectic: in a mechanism whose forces have a
/// potential and whose constraints do not depend on time the energy oscillates by O(h²) and does
/// not drift, however long the run is. Composed of five steps
/// ([`composition`](RattleBuilder::composition)) it is of fourth order.
///
/// Forces must not depend on velocities. Forces and drives that depend on time, and inputs, are
/// permitted: they do work, and the method keeps its order. A run evaluates the forces once a step
/// and solves five to eight times with the elimination of the accelerations, about three times the
/// work of Heun's method. Take it for long runs whose energy matters, and an
/// [`Adaptive`](crate::Adaptive) run where the accuracy of one motion does.
///
/// # Example
/// ```
/// use mbs_runtime::{Rattle, mechanism};
///
/// mechanism! {
///     pub Pendulum {
///         dof = 1;
///         param length = 1 [m];
///         gravity = (0, -9.81) [m/s^2];
///         body bob (x, y) { mass = 2 [kg]; }
///         constraint rod: x^2 + y^2 = length^2;
///         start { x = length; guess y = 0; }
///     }
/// }
///
/// let mut swing = Rattle::builder(Pendulum::declared(), 1e-2).build()?;
/// let mut largest: f64 = 0.0;
/// for _ in 0..100_000 {
///     swing.step()?;
///     largest = largest.max(swing.energy().abs());
/// }
/// // a thousand seconds later: of 20 J that move to and fro
/// assert!(largest < 1e-2 && swing.violation() < 1e-14);
/// # Ok::<(), mbs_runtime::Error>(())
/// ```
///
/// # Source
/// H. C. Andersen, J. Comput. Phys. 52 (1983) 24-34; Hairer, Lubich, Wanner, Geometric Numerical
/// Integration, VII.1.4 (symplecticity) and V.3.2 (composition).
#[derive(Clone)]
pub struct Rattle<D: Dynamics> {
    dynamics: D,
    inputs: D::Inputs,
    composition: &'static Composition,
    step: D::Real,
    start_time: f64,
    steps: u64,
    now: Moment<D::Real, D::States>,
    /// The end of the step that is tried.
    next: Moment<D::Real, D::States>,
    substep: Substep<D::States>,
    /// All coordinates and velocities of the present state.
    all: [D::Coordinates; 2],
    /// Whether the acceleration of the present state is that of the present inputs.
    is_solved: bool,
    watch: Watch<D::Real>,
}

impl<D: Dynamics> Rattle<D> {
    /// Advances by one step.
    ///
    /// # Errors
    /// [`Error::NotConverged`] if the positions do not lead to the constraints, which a shorter
    /// step mends; [`Error::OutOfReach`], [`Error::Singular`], [`Error::NonFinite`],
    /// [`Error::Input`]. The state stays that of the last good step.
    pub fn step(&mut self) -> Result<(), Error> {
        self.solve()?;
        let Self { dynamics, inputs, composition, step, start_time, steps, now, next, substep, .. } = self;
        let start = D::Real::from_f64(*start_time);
        let t_next = start + D::Real::from_f64((*steps + 1) as f64) * *step;
        copy(&mut next.q, &now.q);
        copy(&mut next.v, &now.v);
        copy(&mut next.a, &now.a);
        next.t = now.t;
        let (mut growth, mut taken) = (Some(D::Real::default()), 0.0);
        for (at, &share) in composition.shares.iter().enumerate() {
            taken += share;
            let is_last = at + 1 == composition.shares.len();
            let t = if is_last { t_next } else { now.t + D::Real::from_f64(taken) * *step };
            let h = D::Real::from_f64(share) * *step;
            let found = substep.take(&*dynamics, inputs, h, t, next);
            growth = growth.zip(found).map(|(sum, growth)| sum + growth);
        }
        match growth.filter(|growth| is_healthy(*growth, next)) {
            Some(growth) => self.accept(growth),
            None => Err(self.cause()),
        }
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
        core::mem::swap(now, next);
        self.steps += 1;
        self.complete();
        Ok(())
    }

    /// All coordinates and velocities of the present state.
    fn complete(&mut self) {
        let Self { dynamics, now, all, .. } = self;
        dynamics.complete(now.t, &now.q, &now.v, all);
    }

    /// Sees to it that the acceleration of the present state is known.
    fn solve(&mut self) -> Result<(), Error> {
        if self.is_solved {
            return Ok(());
        }
        let Self { dynamics, inputs, now, .. } = self;
        dynamics.with_inputs(inputs, |inputs| check_inputs(dynamics.equations().info(), inputs))?;
        let Moment { t, q, v, a } = now;
        let growth = dynamics.acceleration(*t, q, v, inputs, a);
        if !is_healthy(growth, now) {
            return Err(self.cause());
        }
        self.is_solved = true;
        Ok(())
    }

    /// Why there is no step from the present state.
    fn cause(&mut self) -> Error {
        let Self { dynamics, inputs, now, next, watch, .. } = self;
        let step = self.step.to_f64();
        let found = cause::<D, Heun>(dynamics, inputs, now, next, *watch, 2.0 * step);
        found.unwrap_or(Error::NotConverged { t: now.t.to_f64(), step })
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

impl<M: Mechanism> Rattle<M> {
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

impl<D: Dynamics> fmt::Debug for Rattle<D> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { now, step, steps, composition, .. } = self;
        let mut shown = f.debug_struct("Rattle");
        shown.field("composition", &composition.word).field("t", &now.t).field("step", step);
        shown.field("steps", steps).finish_non_exhaustive()
    }
}
