//! A live mechanism as [`Equations`]: a function of the compiled mechanism behind each method.

use mbs_codegen::FunctionId;
use mbs_runtime::__private::{next_corner, worst};
use mbs_runtime::equations::{At, Equations, Partials, hold, press};
use mbs_runtime::{Error, Gains, Info, Real, Switch};

use crate::Live;
use crate::arguments::Arguments;

impl<T: Real> Equations<T> for Live<T> {
    fn info(&self) -> &Info {
        self.declared_info()
    }

    fn phi(&self, t: T, q: &[T], phi: &mut [T]) {
        self.call(FunctionId::Phi, &position(t, q), [phi]);
    }

    fn phi_dot(&self, at: At<'_, T>, phi_dot: &mut [T]) {
        self.call(FunctionId::PhiDot, &state(at), [phi_dot]);
    }

    fn complete(&self, states: At<'_, T>, q: &mut [T], v: &mut [T]) {
        self.call(FunctionId::Complete, &state(states), [q, v]);
    }

    fn stabilized(
        &self,
        states: At<'_, T>,
        inputs: &[T],
        gains: &Gains<T>,
        acceleration: &mut [T],
        feedback: &mut [T],
    ) -> T {
        let arguments = Arguments { inputs: single(inputs), gains: both(gains), ..state(states) };
        self.solve(|growth| {
            self.call(FunctionId::Stabilized, &arguments, [acceleration, feedback, growth]);
        })
    }

    fn constrained(&self, states: At<'_, T>, inputs: &[T], feedback: &[T], acceleration: &mut [T]) -> T {
        let arguments = Arguments { inputs: single(inputs), feedback: single(feedback), ..state(states) };
        self.solve(|growth| self.call(FunctionId::Constrained, &arguments, [acceleration, growth]))
    }

    fn implicit(
        &self,
        states: At<'_, T>,
        inputs: &[T],
        shift: T,
        predicted: &[T],
        acceleration: &mut [T],
    ) -> T {
        let arguments = Arguments {
            inputs: single(inputs),
            shift: [shift],
            acceleration: single(predicted),
            ..state(states)
        };
        self.solve(|growth| self.call(FunctionId::Implicit, &arguments, [acceleration, growth]))
    }

    fn accelerations(&self, at: At<'_, T>, inputs: &[T], feedback: &[T], acceleration: &mut [T]) -> T {
        let mut multipliers = vec![T::from_f64(f64::NAN); feedback.len()];
        let given = Arguments { inputs: single(inputs), feedback: single(feedback), ..state(at) };
        self.solve(|growth| {
            self.call(FunctionId::Reactions, &given, [acceleration, &mut multipliers, growth]);
        })
    }

    fn position_correction(&self, t: T, q: &[T], residual: &[T], correction: &mut [T]) -> T {
        let arguments = Arguments { feedback: single(residual), ..position(t, q) };
        self.solve(|growth| self.call(FunctionId::PositionCorrection, &arguments, [correction, growth]))
    }

    fn velocity_correction(&self, t: T, q: &[T], residual: &[T], correction: &mut [T]) -> T {
        let arguments = Arguments { feedback: single(residual), ..position(t, q) };
        self.solve(|growth| self.call(FunctionId::VelocityCorrection, &arguments, [correction, growth]))
    }

    fn projection(&self, t: T, q: &[T], violation: &[T], correction: &mut [T]) -> T {
        let arguments = Arguments { feedback: single(violation), ..position(t, q) };
        self.solve(|growth| self.call(FunctionId::Projection, &arguments, [correction, growth]))
    }

    fn worst_pivot(&self, t: T, q: &[T]) -> Option<(usize, T)> {
        self.worst_of(FunctionId::Pivots, t, q)
    }

    fn worst_start_pivot(&self, t: T, q: &[T]) -> Option<(usize, T)> {
        self.worst_of(FunctionId::StartPivots, t, q)
    }

    fn switching(&self) -> &'static [Switch] {
        self.programs().tables.switches
    }

    fn switches(&self, at: At<'_, T>, inputs: &[T], values: &mut [T]) {
        let given = Arguments { inputs: single(inputs), ..state(at) };
        let count = self.switching().len().min(values.len());
        self.call(FunctionId::Switches, &given, [&mut values[..count]]);
    }

    fn next_corner(&self, t: T, inputs: &[T]) -> T {
        let corners = self.programs().tables.corners;
        if corners.is_empty() {
            return T::from_f64(f64::INFINITY);
        }
        let mut lines = vec![T::ZERO; 2 * corners.len()];
        let given = Arguments { inputs: single(inputs), ..Arguments::default() };
        self.call(FunctionId::Corners, &given, [&mut lines]);
        next_corner(t, lines.as_chunks().0, corners)
    }

    fn stop_laws(&self, laws: &mut [T]) {
        self.call(FunctionId::Stops, &Arguments::default(), [laws]);
    }

    fn gaps(&self, at: At<'_, T>, acceleration: &[T], gaps: &mut [T]) {
        let given = Arguments { acceleration: single(acceleration), ..state(at) };
        self.call(FunctionId::Gaps, &given, [gaps]);
    }

    fn limits(&self, at: At<'_, T>, inputs: &[T], [a, lambda]: [&[T]; 2], limits: &mut [T]) {
        let given = Arguments {
            inputs: single(inputs),
            acceleration: single(a),
            multipliers: single(lambda),
            ..state(at)
        };
        self.call(FunctionId::Limits, &given, [limits]);
    }

    fn free_reactions(
        &self,
        at: At<'_, T>,
        inputs: &[T],
        acceleration: &mut [T],
        multipliers: &mut [T],
    ) -> T {
        let no_feedback = vec![T::ZERO; self.declared_info().constraints.len()];
        let given = Arguments { inputs: single(inputs), feedback: single(&no_feedback), ..state(at) };
        self.solve(|growth| self.call(FunctionId::Reactions, &given, [acceleration, multipliers, growth]))
    }

    fn contacts(&self, t: T, q: &[T], what: &mut dyn FnMut(&[T])) {
        let info = self.declared_info();
        let (stops, each) = (info.contacts(), 2 * info.coordinates.len() + info.constraints.len());
        if stops > 0 {
            let mut values = vec![T::from_f64(f64::NAN); stops * (each + stops + 1) + 1];
            self.call(FunctionId::Contacts, &position(t, q), [&mut values]);
            what(&values);
        }
    }

    fn clock(&self, clock: usize) -> [T; 2] {
        let mut times = vec![T::from_f64(f64::NAN); 2 * self.declared_info().sampling.clocks];
        self.call(FunctionId::Clocks, &Arguments::default(), [&mut times]);
        times.as_chunks().0.get(clock).copied().unwrap_or([T::from_f64(f64::NAN); 2])
    }

    fn transitions(&self, at: At<'_, T>, inputs: &[T], [a, lambda]: [&[T]; 2], values: &mut [T]) {
        let [acceleration, multipliers] = [a, lambda].map(single);
        let given = Arguments { inputs: single(inputs), acceleration, multipliers, ..state(at) };
        self.call(FunctionId::Transitions, &given, [values]);
    }

    fn sample(&self, at: At<'_, T>, inputs: &mut [T], clock: usize) {
        let samples = self.declared_info().sampling.samples;
        let mut values = vec![T::from_f64(f64::NAN); samples.len()];
        let given = Arguments { inputs: single(inputs), ..state(at) };
        self.call(FunctionId::Samples, &given, [&mut values]);
        for (&[of, memory], value) in samples.iter().zip(values) {
            if let Some(input) = inputs.get_mut(memory).filter(|_| of == clock) {
                *input = value;
            }
        }
    }

    fn kinetic_energy(&self, at: At<'_, T>) -> T {
        let mut energy = [T::from_f64(f64::NAN)];
        self.call(FunctionId::KineticEnergy, &state(at), [&mut energy]);
        energy[0]
    }

    fn reactions(&self, at: At<'_, T>, inputs: &[T], acceleration: &mut [T], multipliers: &mut [T]) -> T {
        let growth = self.free_reactions(at, inputs, acceleration, multipliers);
        growth + press(self, at, inputs, acceleration, Some(multipliers))
    }

    fn outputs(
        &self,
        at: At<'_, T>,
        inputs: &[T],
        [acceleration, multipliers]: [&[T]; 2],
        outputs: &mut [T],
    ) {
        let mut own = Vec::new();
        let inputs = if !self.declared_info().holds() {
            inputs
        } else {
            own.extend_from_slice(inputs);
            hold(self, at, &mut own, [&mut acceleration.to_vec(), &mut multipliers.to_vec()]);
            &own
        };
        let [acceleration, multipliers] = [acceleration, multipliers].map(single);
        let given = Arguments { inputs: single(inputs), acceleration, multipliers, ..state(at) };
        self.call(FunctionId::Outputs, &given, [outputs]);
    }

    fn events(&self, at: At<'_, T>, inputs: &[T], values: &mut [T]) {
        let given = Arguments { inputs: single(inputs), ..state(at) };
        self.call(FunctionId::Events, &given, [values]);
    }

    fn potential_energy(&self, at: At<'_, T>) -> T {
        let mut energy = [T::from_f64(f64::NAN)];
        self.call(FunctionId::PotentialEnergy, &state(at), [&mut energy]);
        energy[0]
    }

    fn points(&self, t: T, q: &[T], points: &mut [T]) {
        self.call(FunctionId::Points, &position(t, q), [points]);
    }

    fn parameters(&self, parameters: &mut [T]) {
        parameters.iter_mut().zip(Self::parameters(self)).for_each(|(to, from)| *to = *from);
    }

    fn is_differentiable(&self) -> bool {
        T::ORDER == 0
    }

    fn with_partials(
        &self,
        parameters: &[Partials],
        what: &mut dyn FnMut(&dyn Equations<Partials>),
    ) -> Result<(), Error> {
        let given =
            |own: &mut [Partials]| own.iter_mut().zip(parameters).for_each(|(own, given)| *own = *given);
        what(&self.over().with_parameters(given)?);
        Ok(())
    }
}

impl<T: Real> Live<T> {
    /// The growth that a function gives which solves.
    fn solve(&self, call: impl FnOnce(&mut [T])) -> T {
        let mut growth = [T::from_f64(f64::NAN)];
        call(&mut growth);
        growth[0]
    }

    fn worst_of(&self, pivots: FunctionId, t: T, q: &[T]) -> Option<(usize, T)> {
        let mut growths = vec![T::from_f64(f64::NAN); self.programs().function(pivots).outputs.len()];
        self.call(pivots, &position(t, q), [&mut growths]);
        worst(&growths)
    }
}

/// A vector of single numbers, as functions are given it.
pub(crate) fn single<T>(vector: &[T]) -> &[[T; 1]] {
    vector.as_chunks().0
}

/// The gains as functions are given them.
pub(crate) const fn both<T: Real>(gains: &Gains<T>) -> [[T; 1]; 2] {
    [[gains.minus_two_alpha], [gains.minus_beta_squared]]
}

/// Time and positions as functions are given them.
pub(crate) fn position<T: Real>(t: T, q: &[T]) -> Arguments<'_, T> {
    Arguments { t: [t], q: single(q), ..Arguments::default() }
}

/// Time, positions and velocities as functions are given them.
pub(crate) fn state<T: Real>(at: At<'_, T>) -> Arguments<'_, T> {
    Arguments { v: single(at.v), ..position(at.t, at.q) }
}
