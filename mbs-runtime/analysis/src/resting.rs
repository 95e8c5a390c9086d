//! A mechanism that rests on some of its stops, with the modes that hold: their gaps and constraints are rows of it.
//!
//! Searches of equilibria and linear systems see another mechanism. Behind its declared rows stands one for each constraint of
//! a mode that holds, and behind these a row g = 0 for each stop; it has as many degrees of freedom less. The rows are not
//! eliminated: responses to unit impulses along them add them to what the mechanism solves without them. The memories of the
//! stops are those of the set, whatever a run has left in them.

use std::collections::BTreeMap;
use std::sync::{Mutex, OnceLock, PoisonError};

use mbs_runtime::equations::{At, Equations, Partials, lean};
use mbs_runtime::{Constraint, Dimension, Error, Gains, Info, Real};

/// A mechanism with rows among its contacts: stops, and behind all of them and frictions constraints of modes.
pub struct Resting<'a, T: Real> {
    free: &'a dyn Equations<T>,
    info: Info,
    rows: Vec<usize>,
}

impl<'a, T: Real> Resting<'a, T> {
    /// A mechanism with rows that are independent of each other and of the constraints.
    pub fn new(free: &'a dyn Equations<T>, rows: &[usize]) -> Self {
        let mut info = *free.info();
        info.constraints = constraints(&info, rows);
        info.dof -= i32::try_from(rows.len()).unwrap_or(0);
        Self { free, info, rows: rows.to_vec() }
    }

    /// The number of declared constraints.
    fn declared(&self) -> usize {
        self.info.constraints.len() - self.rows.len()
    }

    /// Declared rows, and those of contacts.
    fn split<'b>(&self, rows: &'b [T]) -> (&'b [T], &'b [T]) {
        rows.split_at(self.declared().min(rows.len()))
    }

    fn split_mut<'b>(&self, rows: &'b mut [T]) -> (&'b mut [T], &'b mut [T]) {
        rows.split_at_mut(self.declared().min(rows.len()))
    }

    /// Value, rate and second derivative of the rows of contacts.
    fn gaps(&self, at: At<'_, T>, acceleration: &[T]) -> Vec<[T; 3]> {
        let mut all = vec![T::ZERO; 3 * self.info.contacts()];
        self.free.gaps(at, acceleration, &mut all);
        let of = |row: &usize| [all[3 * row], all[3 * row + 1], all[3 * row + 2]];
        self.rows.iter().map(of).collect()
    }

    /// Adds the responses to forces along the rows that take `short` away from each of their rows. Gives the pivot growth and the
    /// forces.
    fn lead(&self, t: T, q: &[T], short: &[T], to: &mut [T]) -> (T, Vec<T>) {
        let mut forces = vec![T::ZERO; self.rows.len()];
        let growth = lean(self.free, (t, q), &self.rows, short, (to, &mut forces));
        (growth, forces)
    }

    /// Adds the part of a correction that solves the rows of contacts; the declared rows stay solved.
    fn correct(&self, t: T, q: &[T], residual: &[T], to: &mut [T]) -> T {
        let still = vec![T::ZERO; q.len()];
        let rates = |v: &[T]| self.gaps(At { t, q, v }, &still);
        let moved = rates(to).into_iter().zip(rates(&still));
        let short: Vec<T> =
            moved.zip(residual).map(|((with, without), asked)| with[1] - without[1] - *asked).collect();
        self.lead(t, q, &short, to).0
    }

    /// The inputs with the memories of the stops that are rested on.
    fn resting_inputs(&self, inputs: &[T]) -> Vec<T> {
        let mut inputs = inputs.to_vec();
        for (at, stop) in self.info.stops.iter().enumerate() {
            inputs[stop.memory] = T::from_f64(f64::from(u8::from(self.rows.contains(&at))));
        }
        inputs
    }

    /// q̈ with γ + `feedback` below, and the forces along the rows.
    fn solved(&self, at: At<'_, T>, inputs: &[T], feedback: &[T], a: &mut [T]) -> (T, Vec<T>) {
        let (declared, of_rows) = self.split(feedback);
        let growth = self.free.accelerations(at, inputs, declared, a);
        let gaps = self.gaps(at, a).into_iter().zip(of_rows);
        let short: Vec<T> = gaps.map(|(gap, feedback)| gap[2] - *feedback).collect();
        let (more, forces) = self.lead(at.t, at.q, &short, a);
        (growth + more, forces)
    }
}

/// The constraints of a mechanism with some rows. They are kept as long as the program, once for each set of rows, as are
/// the texts of mechanisms.
fn constraints(info: &Info, rows: &[usize]) -> &'static [Constraint] {
    type Known = BTreeMap<([usize; 2], Vec<usize>), &'static [Constraint]>;
    static KNOWN: OnceLock<Mutex<Known>> = OnceLock::new();
    let known = KNOWN.get_or_init(Mutex::default);
    let mut known = known.lock().unwrap_or_else(PoisonError::into_inner);
    // a row is of a list that is not empty, and has a place in memory of its own
    let key = ([info.stops.as_ptr().addr(), info.modes.locks.as_ptr().addr()], rows.to_vec());
    known.entry(key).or_insert_with(|| {
        let more = rows.iter().filter_map(|row| constraint(info, *row));
        Vec::leak(info.constraints.iter().copied().chain(more).collect())
    })
}

/// A row among the contacts as a constraint.
fn constraint(info: &Info, row: usize) -> Option<Constraint> {
    let [is_drive, is_rate] = [false; 2];
    if let Some(stop) = info.stops.get(row) {
        let (name, doc, formula, dimension) = (stop.name, stop.doc, stop.formula, stop.dimension);
        return Some(Constraint { name, doc, formula, is_drive, is_rate, dimension });
    }
    let (_, lock) = info.locks().find(|(of, _)| *of == row)?;
    let (name, formula, is_rate) = (lock.name, lock.formula, lock.is_rate);
    // λ does work on Φ
    let dimension = Dimension::of(1, 2, -2).over(info.inputs.get(lock.held)?.dimension);
    Some(Constraint { name, doc: "", formula, is_drive, is_rate, dimension })
}

impl<T: Real> Equations<T> for Resting<'_, T> {
    fn info(&self) -> &Info {
        &self.info
    }

    fn phi(&self, t: T, q: &[T], phi: &mut [T]) {
        let (declared, of_rows) = self.split_mut(phi);
        self.free.phi(t, q, declared);
        let still = vec![T::ZERO; q.len()];
        let gaps = self.gaps(At { t, q, v: &still }, &still);
        of_rows.iter_mut().zip(gaps).for_each(|(phi, gap)| *phi = gap[0]);
    }

    fn phi_dot(&self, at: At<'_, T>, phi_dot: &mut [T]) {
        let (declared, of_rows) = self.split_mut(phi_dot);
        self.free.phi_dot(at, declared);
        let gaps = self.gaps(at, &vec![T::ZERO; at.q.len()]);
        of_rows.iter_mut().zip(gaps).for_each(|(phi_dot, gap)| *phi_dot = gap[1]);
    }

    fn complete(&self, states: At<'_, T>, q: &mut [T], v: &mut [T]) {
        self.free.complete(states, q, v);
    }

    fn stabilized(
        &self,
        states: At<'_, T>,
        inputs: &[T],
        gains: &Gains<T>,
        a: &mut [T],
        feedback: &mut [T],
    ) -> T {
        let mut rows = [(); 2].map(|()| vec![T::ZERO; feedback.len()]);
        let [phi, phi_dot] = &mut rows;
        self.phi(states.t, states.q, phi);
        self.phi_dot(states, phi_dot);
        for (feedback, (phi, phi_dot)) in feedback.iter_mut().zip(phi.iter().zip(phi_dot.iter())) {
            *feedback = gains.minus_two_alpha * *phi_dot + gains.minus_beta_squared * *phi;
        }
        self.accelerations(states, inputs, feedback, a)
    }

    // with stops all coordinates are integrated
    fn constrained(&self, states: At<'_, T>, inputs: &[T], feedback: &[T], a: &mut [T]) -> T {
        self.accelerations(states, inputs, feedback, a)
    }

    fn implicit(&self, states: At<'_, T>, inputs: &[T], shift: T, predicted: &[T], a: &mut [T]) -> T {
        self.free.implicit(states, inputs, shift, predicted, a)
    }

    fn accelerations(&self, at: At<'_, T>, inputs: &[T], feedback: &[T], a: &mut [T]) -> T {
        self.solved(at, &self.resting_inputs(inputs), feedback, a).0
    }

    fn position_correction(&self, t: T, q: &[T], residual: &[T], correction: &mut [T]) -> T {
        let (declared, of_rows) = self.split(residual);
        self.free.position_correction(t, q, declared, correction) + self.correct(t, q, of_rows, correction)
    }

    fn velocity_correction(&self, t: T, q: &[T], residual: &[T], correction: &mut [T]) -> T {
        let (declared, of_rows) = self.split(residual);
        self.free.velocity_correction(t, q, declared, correction) + self.correct(t, q, of_rows, correction)
    }

    fn projection(&self, t: T, q: &[T], violation: &[T], correction: &mut [T]) -> T {
        let (declared, of_rows) = self.split(violation);
        self.free.projection(t, q, declared, correction) + self.correct(t, q, of_rows, correction)
    }

    fn worst_pivot(&self, t: T, q: &[T]) -> Option<(usize, T)> {
        self.free.worst_pivot(t, q)
    }

    fn worst_start_pivot(&self, t: T, q: &[T]) -> Option<(usize, T)> {
        self.free.worst_start_pivot(t, q)
    }

    fn gaps(&self, at: At<'_, T>, acceleration: &[T], gaps: &mut [T]) {
        self.free.gaps(at, acceleration, gaps);
    }

    fn limits(&self, at: At<'_, T>, inputs: &[T], reactions: [&[T]; 2], limits: &mut [T]) {
        self.free.limits(at, inputs, reactions, limits);
    }

    fn free_reactions(
        &self,
        at: At<'_, T>,
        inputs: &[T],
        acceleration: &mut [T],
        multipliers: &mut [T],
    ) -> T {
        let inputs = self.resting_inputs(inputs);
        let none = vec![T::ZERO; self.info.constraints.len()];
        let (_, forces) = self.solved(at, &inputs, &none, acceleration);
        let (declared, of_rows) = self.split_mut(multipliers);
        // M q̈ + Φ_qᵀ λ = Q, where forces act along rows
        of_rows.iter_mut().zip(forces).for_each(|(multiplier, force)| *multiplier = -force);
        self.free.reactions(at, &inputs, acceleration, declared)
    }

    fn clock(&self, clock: usize) -> [T; 2] {
        self.free.clock(clock)
    }

    fn transitions(&self, at: At<'_, T>, inputs: &[T], reactions: [&[T]; 2], values: &mut [T]) {
        self.free.transitions(at, inputs, reactions, values);
    }

    fn sample(&self, at: At<'_, T>, inputs: &mut [T], clock: usize) {
        self.free.sample(at, inputs, clock);
    }

    fn kinetic_energy(&self, at: At<'_, T>) -> T {
        self.free.kinetic_energy(at)
    }

    fn reactions(&self, at: At<'_, T>, inputs: &[T], acceleration: &mut [T], multipliers: &mut [T]) -> T {
        self.free_reactions(at, inputs, acceleration, multipliers)
    }

    fn outputs(
        &self,
        at: At<'_, T>,
        inputs: &[T],
        [acceleration, multipliers]: [&[T]; 2],
        outputs: &mut [T],
    ) {
        let given = [acceleration, self.split(multipliers).0];
        self.free.outputs(at, &self.resting_inputs(inputs), given, outputs);
    }

    fn events(&self, at: At<'_, T>, inputs: &[T], values: &mut [T]) {
        self.free.events(at, &self.resting_inputs(inputs), values);
    }

    fn potential_energy(&self, at: At<'_, T>) -> T {
        self.free.potential_energy(at)
    }

    fn points(&self, t: T, q: &[T], points: &mut [T]) {
        self.free.points(t, q, points);
    }

    fn parameters(&self, parameters: &mut [T]) {
        self.free.parameters(parameters);
    }

    fn is_differentiable(&self) -> bool {
        self.free.is_differentiable()
    }

    fn with_partials(
        &self,
        parameters: &[Partials],
        what: &mut dyn FnMut(&dyn Equations<Partials>),
    ) -> Result<(), Error> {
        self.free.with_partials(parameters, &mut |free| what(&Resting::new(free, &self.rows)))
    }
}
