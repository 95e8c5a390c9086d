//! A mechanism as runs to a tolerance see it.
//!
//! Three kinds of mechanisms are `Dynamics`:
//!
//! * every `Mechanism`, with arrays for vectors and with inlined functions;
//! * a text (`Prepared` of `mbs-live`), with vectors on the heap;
//! * a type or a text whose name is forgotten (`erased.rs` of the workbench), so that these runs are compiled
//!   once for all of them.

use crate::equations::{At, Equations};
use crate::explicit::{Beside, correct};
use crate::pressing::press;
use crate::room::{OnStack, Room};
use crate::{
    Accelerations, Components, Derivation, Error, Info, Mechanism, Real, Scheme, Sketch, State, Switch,
    arrays, vectors,
};

/// A mechanism that runs to a tolerance can integrate: every [`Mechanism`], whose vectors are
/// arrays, and mechanisms that were read from a text, whose vectors are on the heap.
///
/// Functions that solve a system return the pivot growth; see [`Mechanism`].
pub trait Dynamics: Clone + Send {
    /// The scalar of the computation.
    type Real: Real;
    /// A vector with a component per coordinate.
    type Coordinates: Clone + Send + AsRef<[Self::Real]> + AsMut<[Self::Real]>;
    /// A vector with a component per coordinate that is integrated.
    type States: Clone + Send + AsRef<[Self::Real]> + AsMut<[Self::Real]>;
    /// A vector with a component per constraint.
    type Constraints: Clone + Send + AsRef<[Self::Real]> + AsMut<[Self::Real]>;
    /// The inputs.
    type Inputs: Clone + Send;

    /// False of a type whose velocities and memories never jump; the code of jumps is not compiled for it then.
    const JUMPS: bool = true;
    /// False of a type without clocks.
    const SAMPLES: bool = true;
    /// False of a type whose laws neither bend nor jump.
    const SWITCHES: bool = true;

    /// Its equations on slices.
    fn equations(&self) -> &dyn Equations<Self::Real>;

    /// The equations and their elimination, for people to read.
    fn derivation(&self) -> &Derivation;

    /// The picture of the mechanism.
    fn sketch(&self) -> &Sketch;

    /// Names, units and numbers. Of a type it is a constant, so that what it does not declare costs nothing.
    fn info(&self) -> &Info {
        self.equations().info()
    }

    /// The values of the motion at whose knots laws bend or jump.
    fn switching(&self) -> &'static [Switch] {
        self.equations().switching()
    }

    /// The declared start, nothing made consistent.
    fn declared_start(&self) -> (Self::Real, Self::Coordinates, Self::Coordinates);

    /// Those of all coordinates or velocities that are integrated.
    fn states(&self, all: &Self::Coordinates) -> Self::States;

    /// Writes all coordinates and velocities, from those that are integrated.
    fn complete(&self, t: Self::Real, q: &Self::States, v: &Self::States, all: &mut [Self::Coordinates; 2]);

    /// A zero per constraint.
    fn no_feedback(&self) -> Self::Constraints;

    /// The default inputs.
    fn default_inputs(&self) -> Self::Inputs;

    /// Does something with inputs as a slice, which may change them.
    fn with_inputs<R>(&self, inputs: &mut Self::Inputs, what: impl FnOnce(&mut [Self::Real]) -> R) -> R;

    /// Does something with vectors to compute with.
    ///
    /// # Errors
    /// Those of what is done.
    fn with_room<S: Scheme>(
        &self,
        what: impl FnOnce(&mut Room<'_, Self::Real>) -> Result<(), Error>,
    ) -> Result<(), Error>;

    /// The inputs at a time, of those that a run was given: the same, unless they change by themselves.
    fn inputs_at(&self, _t: Self::Real, inputs: &Self::Inputs) -> Self::Inputs {
        inputs.clone()
    }

    /// The first time behind `t` at which the accelerations have a corner, such as inputs of straight
    /// lines have between two of them; a step ends there. Infinite where there is none.
    fn next_corner(&self, t: Self::Real, inputs: &Self::Inputs) -> Self::Real {
        let mut present = self.inputs_at(t, inputs);
        self.with_inputs(&mut present, |inputs| self.equations().next_corner(t, inputs))
    }

    /// Writes the values whose changes of sign are the declared events.
    fn events(&self, at: At<'_, Self::Real>, inputs: &Self::Inputs, values: &mut [Self::Real]);

    /// q̈ of what is integrated, without feedback terms and without what stops do.
    fn free_acceleration(
        &self,
        t: Self::Real,
        q: &Self::States,
        v: &Self::States,
        inputs: &Self::Inputs,
        acceleration: &mut Self::States,
    ) -> Self::Real;

    /// The same with what the stops do that are rested on.
    #[inline(always)]
    fn acceleration(
        &self,
        t: Self::Real,
        q: &Self::States,
        v: &Self::States,
        inputs: &Self::Inputs,
        acceleration: &mut Self::States,
    ) -> Self::Real {
        let growth = self.free_acceleration(t, q, v, inputs, acceleration);
        let is_pressed = Self::JUMPS && self.info().contacts() > 0;
        if is_pressed { growth + self.press(t, [q, v], inputs, acceleration) } else { growth }
    }

    /// Adds to accelerations what the stops do that are rested on; the pivot growth of their responses.
    #[doc(hidden)]
    fn press(
        &self,
        t: Self::Real,
        [q, v]: [&Self::States; 2],
        inputs: &Self::Inputs,
        acceleration: &mut Self::States,
    ) -> Self::Real {
        let (mut inputs, at) = (inputs.clone(), At { t, q: q.as_ref(), v: v.as_ref() });
        self.with_inputs(&mut inputs, |inputs| {
            press(self.equations(), at, inputs, acceleration.as_mut(), None)
        })
    }

    /// q̈ of what is integrated in an implicit stage, by one step of Newton's method from a
    /// prediction; see [`Mechanism::implicit`].
    fn implicit(
        &self,
        t: Self::Real,
        at: [&Self::States; 2],
        inputs: &Self::Inputs,
        predicted: (Self::Real, &Self::States),
        acceleration: &mut Self::States,
    ) -> Self::Real;

    /// The correction of the positions or velocities that are integrated, which leads to the
    /// constraints; see [`explicit::project`](crate::explicit::project).
    fn correction(
        &self,
        t: Self::Real,
        at: &Beside<'_, Self::States>,
        delta: &mut Self::States,
    ) -> Self::Real;

    /// The correction of the positions `q` at `t` along the gradients of the constraints at
    /// another time and place, `from`: with Φ_q, Φ and M all of them,
    ///
    /// ```text
    /// Δ = M⁻¹ Φ_q(from)ᵀ μ,  Φ_q(from) Δ = Φ(q, t)
    /// ```
    fn correction_along(
        &self,
        from: (Self::Real, &Self::States),
        t: Self::Real,
        q: &Self::States,
        delta: &mut Self::States,
    ) -> Self::Real;
}

impl<M: Mechanism> Dynamics for M {
    type Real = M::Real;
    type Coordinates = arrays::Coordinates<M>;
    type States = arrays::States<M>;
    type Constraints = arrays::Constraints<M>;
    type Inputs = M::Inputs;

    const JUMPS: bool = M::INFO.jumps();
    const SAMPLES: bool = M::INFO.sampling.clocks > 0;
    const SWITCHES: bool = !M::SWITCHES.is_empty();

    fn equations(&self) -> &dyn Equations<M::Real> {
        self
    }

    fn derivation(&self) -> &Derivation {
        M::DERIVATION
    }

    fn sketch(&self) -> &Sketch {
        M::SKETCH
    }

    fn info(&self) -> &Info {
        M::INFO
    }

    fn switching(&self) -> &'static [Switch] {
        M::SWITCHES
    }

    fn declared_start(&self) -> (M::Real, Self::Coordinates, Self::Coordinates) {
        let State { t, q, v } = Mechanism::declared_start(self);
        (t, q.into_array(), v.into_array())
    }

    fn states(&self, all: &Self::Coordinates) -> Self::States {
        M::states(Components::from_array(*all)).into_array()
    }

    fn complete(&self, t: M::Real, q: &Self::States, v: &Self::States, all: &mut [Self::Coordinates; 2]) {
        let states = State { t, q: Components::from_array(*q), v: Components::from_array(*v) };
        let State { q, v, .. } = Mechanism::complete(self, &states);
        *all = [q.into_array(), v.into_array()];
    }

    fn no_feedback(&self) -> Self::Constraints {
        M::Constraints::splat(M::Real::default()).into_array()
    }

    fn default_inputs(&self) -> M::Inputs {
        M::Inputs::default()
    }

    fn with_inputs<R>(&self, inputs: &mut M::Inputs, what: impl FnOnce(&mut [M::Real]) -> R) -> R {
        let mut array = inputs.into_array();
        let result = what(array.as_mut());
        *inputs = Components::from_array(array);
        result
    }

    fn with_room<S: Scheme>(
        &self,
        what: impl FnOnce(&mut Room<'_, M::Real>) -> Result<(), Error>,
    ) -> Result<(), Error> {
        let zero = M::States::splat(M::Real::default()).into_array();
        what(&mut OnStack::<M>::new().room_for_steps::<S>(&mut S::stages([zero; 2])))
    }

    fn events(&self, at: At<'_, M::Real>, inputs: &M::Inputs, values: &mut [M::Real]) {
        vectors::copy(values, Mechanism::events(self, &at.state(), inputs).as_ref());
    }

    fn next_corner(&self, t: M::Real, inputs: &M::Inputs) -> M::Real {
        Mechanism::next_corner(self, t, inputs)
    }

    #[inline(always)]
    fn free_acceleration(
        &self,
        t: M::Real,
        q: &Self::States,
        v: &Self::States,
        inputs: &M::Inputs,
        acceleration: &mut Self::States,
    ) -> M::Real {
        let at = State { t, q: Components::from_array(*q), v: Components::from_array(*v) };
        let none = M::Constraints::splat(M::Real::default());
        let Accelerations { acceleration: solved, growth } = self.constrained(&at, inputs, &none);
        *acceleration = solved.into_array();
        growth
    }

    fn implicit(
        &self,
        t: M::Real,
        [q, v]: [&Self::States; 2],
        inputs: &M::Inputs,
        (shift, predicted): (M::Real, &Self::States),
        acceleration: &mut Self::States,
    ) -> M::Real {
        let at = State { t, q: Components::from_array(*q), v: Components::from_array(*v) };
        let predicted = Components::from_array(*predicted);
        let solved = Mechanism::implicit(self, &at, inputs, shift, &predicted);
        *acceleration = solved.acceleration.into_array();
        solved.growth
    }

    #[inline(always)]
    fn correction(&self, t: M::Real, at: &Beside<'_, Self::States>, delta: &mut Self::States) -> M::Real {
        correct(self, t, at, delta)
    }

    fn correction_along(
        &self,
        from: (M::Real, &Self::States),
        t: M::Real,
        q: &Self::States,
        delta: &mut Self::States,
    ) -> M::Real {
        // positions do not depend on velocities
        let complete = |(t, q): (M::Real, &Self::States)| {
            let [q, v] = [*q, *q].map(Components::from_array);
            Mechanism::complete(self, &State { t, q, v }).q
        };
        let violation = Mechanism::phi(self, t, &complete((t, q)));
        let solved = Mechanism::projection(self, from.0, &complete(from), &violation);
        *delta = M::states(solved.acceleration).into_array();
        solved.growth
    }
}
