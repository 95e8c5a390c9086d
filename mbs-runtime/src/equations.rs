//! The equations of a mechanism on slices. Rare work on a mechanism (making starts consistent
//! and checking them, finding out why a step failed) is written once, behind this interface,
//! and not compiled again for each mechanism. It also holds mechanisms whose number of
//! coordinates is known at run time only.
//!
//! Vectors have a component per coordinate (`q`, `v`, `acceleration`, `correction`), per
//! constraint (`phi`, `phi_dot`, `feedback`, `residual`) or per input, in the order of
//! [`Info`]. The vectors of a step have a component per coordinate that is integrated
//! ([`Info::states`]). SI units, angles in rad.
#![doc = include_str!("equations.md")]

pub use crate::described::Described;
pub use crate::differentiable::{Differentiable, Differentiated, PARTIALS, Partials};
pub use crate::moreau::{Pushed, Vectors, begin as begin_at_stops, push, strike};
pub use crate::pressing::{are_independent, lean, press};
pub use crate::reach::reach;
pub use crate::room::Room;
pub use crate::run::{Correction, Run, check_outputs, correction};
pub use crate::samples::Grid;
pub use crate::simulation::clock::steps_to;
pub use crate::start::assembly::{assemble, consistent, project_velocities};
pub use crate::start::consistency::check;
pub use crate::start::preparation::{Preparation, Start};
pub use crate::start::projection::project;
pub use crate::sticking::hold;
pub use crate::watch::Watch;

use crate::{Components, Gains, Info, Mechanism, Reactions, Real, State, Switch, vectors};

/// Time, positions and velocities as slices.
#[derive(Clone, Copy, Debug)]
pub struct At<'a, T> {
    /// Time in s.
    pub t: T,
    /// Coordinates q: lengths in m, angles in rad.
    pub q: &'a [T],
    /// Velocities v = q̇, per second.
    pub v: &'a [T],
}

/// A mechanism with constraints Φ(q, t) = 0 and the equations of motion of Eq. (8), as
/// [`Mechanism`] has them, on slices.
///
/// Methods that solve a system write the solution into the last slices that they are
/// given and return the pivot growth. None of them panics. Every slice is as long as its
/// vector; what comes from others means nothing.
pub trait Equations<T: Real> {
    /// Names, dimensions, redundant rows and pivots.
    fn info(&self) -> &Info;

    /// Φ(q, t)
    fn phi(&self, t: T, q: &[T], phi: &mut [T]);

    /// Φ̇ = Φ_q v + Φ_t
    fn phi_dot(&self, at: At<'_, T>, phi_dot: &mut [T]);

    /// Writes all coordinates and velocities, from those that are integrated.
    fn complete(&self, states: At<'_, T>, q: &mut [T], v: &mut [T]);

    /// Solves Eq. (8) for q̈ of the states and gives the feedback −2αΦ̇ − β²Φ that went into it.
    fn stabilized(
        &self,
        states: At<'_, T>,
        inputs: &[T],
        gains: &Gains<T>,
        acceleration: &mut [T],
        feedback: &mut [T],
    ) -> T;

    /// Solves for q̈ of the states with γ + `feedback` below.
    fn constrained(&self, states: At<'_, T>, inputs: &[T], feedback: &[T], acceleration: &mut [T]) -> T;

    /// q̈ of the states in an implicit stage; see [`Mechanism::implicit`].
    fn implicit(
        &self,
        states: At<'_, T>,
        inputs: &[T],
        shift: T,
        predicted: &[T],
        acceleration: &mut [T],
    ) -> T;

    /// Solves for q̈ of all coordinates with γ + `feedback` below.
    fn accelerations(&self, at: At<'_, T>, inputs: &[T], feedback: &[T], acceleration: &mut [T]) -> T;

    /// The smallest Δq, in the norm of the mass matrix, with Φ_q Δq = `residual` and
    /// Δq = 0 for coordinates that the start prescribes.
    fn position_correction(&self, t: T, q: &[T], residual: &[T], correction: &mut [T]) -> T;

    /// The smallest Δv, in the norm of the mass matrix, with Φ_q Δv = `residual` and
    /// Δv = 0 for velocities that the start prescribes.
    fn velocity_correction(&self, t: T, q: &[T], residual: &[T], correction: &mut [T]) -> T;

    /// The smallest Δ, in the norm of the mass matrix, with Φ_q Δ = `violation`.
    fn projection(&self, t: T, q: &[T], violation: &[T], correction: &mut [T]) -> T;

    /// Index into [`Info::pivots`] of the pivot with the largest growth, and that growth,
    /// if the elimination has any pivot that can vanish.
    fn worst_pivot(&self, t: T, q: &[T]) -> Option<(usize, T)>;

    /// The same for the corrections of a start, as an index into [`Info::start_pivots`].
    fn worst_start_pivot(&self, t: T, q: &[T]) -> Option<(usize, T)>;

    /// The first time behind `t` at which something bends or jumps; see [`Mechanism::next_corner`].
    fn next_corner(&self, _t: T, _inputs: &[T]) -> T {
        T::from_f64(f64::INFINITY)
    }

    /// The values at whose knots laws bend or jump, as a run to a tolerance watches them.
    fn switching(&self) -> &'static [Switch] {
        &[]
    }

    /// Writes those values.
    fn switches(&self, _at: At<'_, T>, _inputs: &[T], _values: &mut [T]) {}

    /// Writes restitution and settling of every stop, and the friction of those that rub; see [`Mechanism::stop_laws`].
    fn stop_laws(&self, _laws: &mut [T]) {}

    /// Writes the gap of every stop, its rate and its second derivative; see [`Mechanism::gaps`].
    fn gaps(&self, _at: At<'_, T>, _acceleration: &[T], _gaps: &mut [T]) {}

    /// Writes the size of every friction that sticks while it slides, and the largest one with which it sticks, given q̈
    /// and λ; see [`Mechanism::limits`].
    fn limits(&self, _at: At<'_, T>, _inputs: &[T], _reactions: [&[T]; 2], _limits: &mut [T]) {}

    /// q̈ and λ without feedback terms, and without what stops and frictions do that hold; their pivot growth.
    fn free_reactions(&self, at: At<'_, T>, inputs: &[T], acceleration: &mut [T], multipliers: &mut [T])
    -> T;

    /// Does something with the responses to unit impulses along gaps; see [`Mechanism::contacts`].
    fn contacts(&self, _t: T, _q: &[T], _what: &mut dyn FnMut(&[T])) {}

    /// The period and the offset of a clock in s; see [`Mechanism::clock`].
    fn clock(&self, clock: usize) -> [T; 2];

    /// Sets the memories of a clock, which stand behind the inputs; see [`Mechanism::sample`].
    fn sample(&self, at: At<'_, T>, inputs: &mut [T], clock: usize);

    /// Writes the values of transitions, given q̈ and λ; see [`Mechanism::transitions`].
    fn transitions(&self, _at: At<'_, T>, _inputs: &[T], _reactions: [&[T]; 2], _values: &mut [T]) {}

    /// Kinetic energy ½ vᵀMv in J.
    fn kinetic_energy(&self, at: At<'_, T>) -> T;

    /// Writes those of all coordinates, velocities or accelerations that are integrated.
    fn states(&self, all: &[T], states: &mut [T]) {
        for (state, &at) in states.iter_mut().zip(self.info().states) {
            *state = all.get(at).copied().unwrap_or_default();
        }
    }
}

impl<M: Mechanism> Equations<M::Real> for M {
    fn next_corner(&self, t: M::Real, inputs: &[M::Real]) -> M::Real {
        Mechanism::next_corner(self, t, &read(inputs))
    }

    fn switching(&self) -> &'static [Switch] {
        M::SWITCHES
    }

    fn switches(&self, at: At<'_, M::Real>, inputs: &[M::Real], values: &mut [M::Real]) {
        Mechanism::switches(self, &at.state(), &read(inputs), values);
    }

    fn stop_laws(&self, laws: &mut [M::Real]) {
        Mechanism::stop_laws(self, laws);
    }

    fn gaps(&self, at: At<'_, M::Real>, acceleration: &[M::Real], gaps: &mut [M::Real]) {
        let multipliers = M::Constraints::splat(M::Real::default());
        let reactions =
            Reactions { acceleration: read(acceleration), multipliers, growth: M::Real::default() };
        Mechanism::gaps(self, &at.state(), &reactions, gaps);
    }

    fn limits(
        &self,
        at: At<'_, M::Real>,
        inputs: &[M::Real],
        [a, lambda]: [&[M::Real]; 2],
        limits: &mut [M::Real],
    ) {
        let growth = M::Real::default();
        let reactions = Reactions { acceleration: read(a), multipliers: read(lambda), growth };
        Mechanism::limits(self, &at.state(), &read(inputs), &reactions, limits);
    }

    fn free_reactions(
        &self,
        at: At<'_, M::Real>,
        inputs: &[M::Real],
        acceleration: &mut [M::Real],
        multipliers: &mut [M::Real],
    ) -> M::Real {
        let none = M::Constraints::splat(M::Real::default());
        let solved = Mechanism::reactions(self, &at.state(), &read(inputs), &none);
        write(solved.acceleration, acceleration);
        write(solved.multipliers, multipliers);
        solved.growth
    }

    fn contacts(&self, t: M::Real, q: &[M::Real], what: &mut dyn FnMut(&[M::Real])) {
        Mechanism::contacts(self, t, &read(q), what);
    }

    fn clock(&self, clock: usize) -> [M::Real; 2] {
        Mechanism::clock(self, clock)
    }

    fn transitions(
        &self,
        at: At<'_, M::Real>,
        inputs: &[M::Real],
        [a, lambda]: [&[M::Real]; 2],
        values: &mut [M::Real],
    ) {
        let growth = M::Real::default();
        let reactions = Reactions { acceleration: read(a), multipliers: read(lambda), growth };
        Mechanism::transitions(self, &at.state(), &read(inputs), &reactions, values);
    }

    fn sample(&self, at: At<'_, M::Real>, inputs: &mut [M::Real], clock: usize) {
        let mut own = read(inputs);
        Mechanism::sample(self, &at.state(), &mut own, clock);
        write(own, inputs);
    }

    fn info(&self) -> &Info {
        M::INFO
    }

    fn phi(&self, t: M::Real, q: &[M::Real], phi: &mut [M::Real]) {
        write(Mechanism::phi(self, t, &read(q)), phi);
    }

    fn phi_dot(&self, at: At<'_, M::Real>, phi_dot: &mut [M::Real]) {
        write(Mechanism::phi_dot(self, &at.state()), phi_dot);
    }

    fn complete(&self, states: At<'_, M::Real>, q: &mut [M::Real], v: &mut [M::Real]) {
        let all = Mechanism::complete(self, &states.state());
        write(all.q, q);
        write(all.v, v);
    }

    fn stabilized(
        &self,
        states: At<'_, M::Real>,
        inputs: &[M::Real],
        gains: &Gains<M::Real>,
        acceleration: &mut [M::Real],
        feedback: &mut [M::Real],
    ) -> M::Real {
        let solved = Mechanism::stabilized(self, &states.state(), &read(inputs), gains);
        write(solved.acceleration, acceleration);
        write(solved.feedback, feedback);
        solved.growth
    }

    fn constrained(
        &self,
        states: At<'_, M::Real>,
        inputs: &[M::Real],
        feedback: &[M::Real],
        acceleration: &mut [M::Real],
    ) -> M::Real {
        let solved = Mechanism::constrained(self, &states.state(), &read(inputs), &read(feedback));
        write(solved.acceleration, acceleration);
        solved.growth
    }

    fn implicit(
        &self,
        states: At<'_, M::Real>,
        inputs: &[M::Real],
        shift: M::Real,
        predicted: &[M::Real],
        acceleration: &mut [M::Real],
    ) -> M::Real {
        let solved = Mechanism::implicit(self, &states.state(), &read(inputs), shift, &read(predicted));
        write(solved.acceleration, acceleration);
        solved.growth
    }

    fn accelerations(
        &self,
        at: At<'_, M::Real>,
        inputs: &[M::Real],
        feedback: &[M::Real],
        acceleration: &mut [M::Real],
    ) -> M::Real {
        let solved = Mechanism::reactions(self, &at.state(), &read(inputs), &read(feedback));
        write(solved.acceleration, acceleration);
        solved.growth
    }

    fn position_correction(
        &self,
        t: M::Real,
        q: &[M::Real],
        residual: &[M::Real],
        correction: &mut [M::Real],
    ) -> M::Real {
        let solved = Mechanism::position_correction(self, t, &read(q), &read(residual));
        write(solved.acceleration, correction);
        solved.growth
    }

    fn velocity_correction(
        &self,
        t: M::Real,
        q: &[M::Real],
        residual: &[M::Real],
        correction: &mut [M::Real],
    ) -> M::Real {
        let solved = Mechanism::velocity_correction(self, t, &read(q), &read(residual));
        write(solved.acceleration, correction);
        solved.growth
    }

    fn projection(
        &self,
        t: M::Real,
        q: &[M::Real],
        violation: &[M::Real],
        correction: &mut [M::Real],
    ) -> M::Real {
        let solved = Mechanism::projection(self, t, &read(q), &read(violation));
        write(solved.acceleration, correction);
        solved.growth
    }

    fn worst_pivot(&self, t: M::Real, q: &[M::Real]) -> Option<(usize, M::Real)> {
        Mechanism::worst_pivot(self, t, &read(q))
    }

    fn worst_start_pivot(&self, t: M::Real, q: &[M::Real]) -> Option<(usize, M::Real)> {
        Mechanism::worst_start_pivot(self, t, &read(q))
    }

    fn kinetic_energy(&self, at: At<'_, M::Real>) -> M::Real {
        Mechanism::kinetic_energy(self, &at.state())
    }
}

/// Named components from a slice of as many numbers; 0 from another. Called and not
/// inlined, because moves between arrays and fields would be most of the code of every
/// method.
#[inline(never)]
pub(crate) fn read<C: Components>(slice: &[C::Real]) -> C {
    let mut array = C::splat(C::Real::default()).into_array();
    // a length that the compiler knows makes moves of the loop
    if slice.len() == array.as_ref().len() {
        vectors::copy(array.as_mut(), slice);
    }
    C::from_array(array)
}

/// Named components into a slice of as many numbers.
#[inline(never)]
pub(crate) fn write<C: Components>(components: C, slice: &mut [C::Real]) {
    let array = components.into_array();
    if slice.len() == array.as_ref().len() {
        vectors::copy(slice, array.as_ref());
    }
}

impl<T: Real> At<'_, T> {
    pub(crate) fn state<C: Components<Real = T>>(&self) -> State<C> {
        State { t: self.t, q: read(self.q), v: read(self.v) }
    }
}

/// A state with named components as arrays, of which [`At`] is a view.
pub(crate) struct Arrays<C: Components> {
    pub t: C::Real,
    pub q: C::Array,
    pub v: C::Array,
}

impl<C: Components> Arrays<C> {
    pub fn of(state: &State<C>) -> Self {
        Self { t: state.t, q: state.q.into_array(), v: state.v.into_array() }
    }

    pub fn at(&self) -> At<'_, C::Real> {
        At { t: self.t, q: self.q.as_ref(), v: self.v.as_ref() }
    }

    pub fn state(self) -> State<C> {
        State { t: self.t, q: C::from_array(self.q), v: C::from_array(self.v) }
    }
}
