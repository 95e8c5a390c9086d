//! A type as equations on slices.

use super::{At, Equations};
use crate::pressing::press;
use crate::sticking::hold;
use crate::{Components, Gains, Info, Mechanism, Reactions, Real, State, Switch, vectors};

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

    fn reactions(
        &self,
        at: At<'_, M::Real>,
        inputs: &[M::Real],
        acceleration: &mut [M::Real],
        multipliers: &mut [M::Real],
    ) -> M::Real {
        let growth = self.free_reactions(at, inputs, acceleration, multipliers);
        if const { M::INFO.contacts() == 0 } {
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
}

/// The declared outputs, with the forces of what sticks and of modes in this state: memories may have been set behind a step.
#[inline(always)]
pub(crate) fn measured<M: Mechanism>(
    mechanism: &M,
    at: &State<M::Coordinates>,
    inputs: &M::Inputs,
    reactions: &Reactions<M::Coordinates, M::Constraints>,
) -> M::Outputs {
    if const { M::INFO.holds() } {
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
