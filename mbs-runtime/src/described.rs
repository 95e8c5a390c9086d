//! The outputs, energies, texts and pictures of a mechanism, apart from its equations.

use crate::differentiable::Differentiable;
use crate::equations::{Arrays, At, Equations, read, write};
use crate::pressing::press;
use crate::sticking::hold;
use crate::{Components, Derivation, Mechanism, Reactions, Real, Sketch, State, vectors};

/// The outputs, energies, texts and pictures of a mechanism, on slices as [`Equations`]. They are
/// apart from these, so that a program that only integrates does not carry texts and pictures.
pub trait Described<T: Real>: Equations<T> {
    /// q̈ and λ without feedback terms; their pivot growth.
    fn reactions(&self, at: At<'_, T>, inputs: &[T], acceleration: &mut [T], multipliers: &mut [T]) -> T;

    /// Writes the declared outputs, given q̈ and λ.
    fn outputs(&self, at: At<'_, T>, inputs: &[T], reactions: [&[T]; 2], outputs: &mut [T]);

    /// Writes the values whose changes of sign are the declared events.
    fn events(&self, at: At<'_, T>, inputs: &[T], values: &mut [T]);

    /// Potential energy of gravity and springs in J.
    fn potential_energy(&self, at: At<'_, T>) -> T;

    /// x and y of every point of the [sketch](Self::sketch) in m, one after the other.
    fn points(&self, t: T, q: &[T], points: &mut [T]);

    /// Writes the parameters.
    fn parameters(&self, parameters: &mut [T]);

    /// The equations and their elimination, for people to read.
    fn derivation(&self) -> &Derivation;

    /// The picture of the mechanism.
    fn sketch(&self) -> &Sketch;

    /// The same with equations that can be had over duals, if it has them.
    fn differentiable(&self) -> Option<&dyn Differentiable> {
        None
    }
}

/// The declared outputs, with the forces of what sticks and of modes in this state: memories may have been set behind a step.
#[inline(always)]
pub(crate) fn measured<M: Mechanism>(
    mechanism: &M,
    at: &State<M::Coordinates>,
    inputs: &M::Inputs,
    reactions: &Reactions<M::Coordinates, M::Constraints>,
) -> M::Outputs {
    if M::INFO.holds() {
        return mechanism.outputs(at, &held(mechanism, at, inputs), reactions);
    }
    mechanism.outputs(at, inputs, reactions)
}

/// Inputs with those forces.
#[inline(never)]
fn held<M: Mechanism>(mechanism: &M, at: &State<M::Coordinates>, inputs: &M::Inputs) -> M::Inputs {
    let (state, mut own) = (Arrays::of(at), inputs.into_array());
    let mut a = M::Coordinates::splat(M::Real::default()).into_array();
    let mut lambda = M::Constraints::splat(M::Real::default()).into_array();
    hold(mechanism, state.at(), own.as_mut(), [a.as_mut(), lambda.as_mut()]);
    Components::from_array(own)
}

impl<M: Mechanism> Described<M::Real> for M {
    fn reactions(
        &self,
        at: At<'_, M::Real>,
        inputs: &[M::Real],
        acceleration: &mut [M::Real],
        multipliers: &mut [M::Real],
    ) -> M::Real {
        let growth = self.free_reactions(at, inputs, acceleration, multipliers);
        if M::INFO.contacts() == 0 {
            return growth;
        }
        growth + press(self, at, inputs, acceleration, Some(multipliers))
    }

    fn outputs(
        &self,
        at: At<'_, M::Real>,
        inputs: &[M::Real],
        [acceleration, multipliers]: [&[M::Real]; 2],
        outputs: &mut [M::Real],
    ) {
        let growth = M::Real::default();
        let (acceleration, multipliers): (M::Coordinates, M::Constraints) =
            (read(acceleration), read(multipliers));
        let reactions = Reactions { acceleration, multipliers, growth };
        write(measured(self, &at.state(), &read(inputs), &reactions), outputs);
    }

    fn events(&self, at: At<'_, M::Real>, inputs: &[M::Real], values: &mut [M::Real]) {
        vectors::copy(values, Mechanism::events(self, &at.state(), &read(inputs)).as_ref());
    }

    fn potential_energy(&self, at: At<'_, M::Real>) -> M::Real {
        Mechanism::potential_energy(self, &at.state())
    }

    fn points(&self, t: M::Real, q: &[M::Real], points: &mut [M::Real]) {
        let places = Mechanism::points(self, t, &read(q));
        for (point, place) in points.chunks_exact_mut(2).zip(places.as_ref()) {
            point.copy_from_slice(place);
        }
    }

    fn parameters(&self, parameters: &mut [M::Real]) {
        write(*Mechanism::parameters(self), parameters);
    }

    fn derivation(&self) -> &Derivation {
        M::DERIVATION
    }

    fn sketch(&self) -> &Sketch {
        M::SKETCH
    }
}
