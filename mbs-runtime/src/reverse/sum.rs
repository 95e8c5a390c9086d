//! A sum over a run with its derivatives, by going back through the run.
//!
//! # How it works
//!
//! This file goes forward and back. `kept` has the states that are kept or made again. `step` takes a step
//! backward. `projection` and `measures` do so with a projection and with outputs. A run of a type or of a
//! text is `Reversible` (`run`). All of this has a heap and needs `std`. `Transposed`, which generated code
//! implements, does not.

use core::ops::Range;
use std::vec;
use std::vec::Vec;

use super::kept::Kept;
use super::measures::Measures;
use super::step::Backward;
use super::{Adjoints, Function, Given, Reversible};
use crate::equations::At;
use crate::gradients::{Seeds, Sum, Variable};
use crate::{Dual, Error, Info, System};

/// Derivatives of a start that duals carry at once.
pub const PARTIALS: usize = 8;

/// A state of a run, of which a term of a sum in reverse is a function; the term writes its derivatives here,
/// which are 0 at first.
pub struct Moment<'a> {
    /// The steps that were taken before.
    pub step: u64,
    /// Time, positions and velocities of what is integrated.
    pub at: At<'a, f64>,
    /// The inputs of the step that led there; at the start those of the first one.
    pub inputs: &'a [f64],
    /// ∂term/∂q of the coordinates that are integrated.
    pub by_q: &'a mut [f64],
    /// ∂term/∂v of them.
    pub by_v: &'a mut [f64],
    /// ∂term/∂y of the [`outputs`](Self::outputs).
    pub by_outputs: &'a mut [f64],
    run: &'a mut dyn Reversible,
    measures: &'a mut Measures,
}

impl Moment<'_> {
    /// The declared outputs in this state. A call computes them.
    ///
    /// # Errors
    /// [`Error::Undefined`] if an output is not finite.
    pub fn outputs(&mut self) -> Result<&[f64], Error> {
        self.measures.measure(self.run, self.at, self.inputs)
    }
}

/// A function that returns the term of a state in a sum.
type Term<'a> = dyn FnMut(&mut Moment<'_>) -> Result<f64, Error> + 'a;

impl Sum<'_> {
    /// The value of the sum over a run, with its derivatives by the variables in `gradient`, by going back
    /// through the run.
    ///
    /// `start` makes the start of the run with some of the variables, `term` is what a state adds to the sum,
    /// called once for each state from the last to the first, and `memory` is how many bytes the states may
    /// take that are kept. For those who write runs of their own; a [`Builder`](crate::Builder) has
    /// [`gradient_in_reverse`](crate::Builder::gradient_in_reverse), where this is explained.
    ///
    /// # Example
    /// The end of a throw with drag, by the drag:
    /// ```
    /// use mbs_runtime::gradients::{Seeds, Sum, Variable};
    /// use mbs_runtime::reverse::{Moment, PARTIALS};
    /// use mbs_runtime::{Components, Dual, Mechanism, Simulation};
    /// # use mbs_runtime::mechanism;
    /// # mechanism! {
    /// #     pub Throw {
    /// #         dof = 1;
    /// #         gradients = reverse;
    /// #         param c = 0.5 [N*s/m];
    /// #         body ball (x) { mass = 1 [kg]; }
    /// #         force drag on x = -c*der(x);
    /// #         start { x = 0; der(x) = 3 [m/s]; }
    /// #     }
    /// # }
    /// let start = |seeds: Seeds<'_, PARTIALS>| {
    ///     let mut parameters = [Dual::constant(0.5)];
    ///     seeds.parameters(&mut parameters);
    ///     Simulation::new(Throw::new(ThrowParameters::from_array(parameters))?, 1e-3)
    /// };
    /// let mut term = |moment: &mut Moment<'_>| {
    ///     let is_end = moment.step == 1000;
    ///     moment.by_q[0] = f64::from(is_end);
    ///     Ok(if is_end { moment.at.q[0] } else { 0.0 })
    /// };
    /// let (variables, mut gradient) = ([Variable::Parameter("c")], [0.0]);
    /// let (sum, mut run) = (Sum::new(1000, &variables), Simulation::new(Throw::declared(), 1e-3)?);
    /// let way = sum.differentiate_in_reverse(&mut run, start, 1 << 20, &mut term, &mut gradient)?;
    /// // x = v (1 − exp(−ct))/c
    /// let decay = (-0.5_f64).exp();
    /// assert!((way - 6.0 * (1.0 - decay)).abs() < 1e-6);
    /// assert!((gradient[0] - 3.0 * (2.0 * decay - 4.0 * (1.0 - decay))).abs() < 1e-6);
    /// # Ok::<(), mbs_runtime::Error>(())
    /// ```
    ///
    /// # Errors
    /// As there.
    pub fn differentiate_in_reverse<R: System<Dual<f64, PARTIALS>>>(
        &self,
        run: &mut dyn Reversible,
        start: impl Fn(Seeds<'_, PARTIALS>) -> Result<R, Error>,
        memory: usize,
        term: &mut Term<'_>,
        gradient: &mut [f64],
    ) -> Result<f64, Error> {
        let info = run.info();
        let (found, expected) = (gradient.len(), self.variables().len());
        if found != expected {
            return Err(Error::Length { what: "the gradient", found, expected });
        }
        self.variables().iter().try_for_each(|variable| variable.find(info).map(drop))?;
        info.refuse_clocks("the way back through a run")?;
        info.refuse_stops("the way back through a run")?;
        let mut numbers = vec![0.0; length(info, run.hoisted())];
        let mut adjoints = within(&mut numbers, info, run.hoisted());
        let mut kept = Kept::within(memory, self.steps(), info.states.len())?;
        let start_time = run.time();
        gradient.fill(0.0);
        let inputs = self.forward(run, &mut kept)?;
        let way = Way { sum: self, start_time, inputs };
        let value = way.back(run, &mut kept, term, &mut adjoints, gradient)?;
        let weights = adjoints.hoisted.to_vec();
        run.backward(Function::Hoisted, &Given::default(), &weights, &mut adjoints);
        self.by_start(info, start, &adjoints, gradient)?;
        for (variable, derivative) in self.variables().iter().zip(gradient.iter()) {
            if !derivative.is_finite() {
                let (what, name) = ("the derivative of the sum by", variable.name());
                return Err(Error::Undefined { t: start_time, what, name, value: *derivative });
            }
        }
        Ok(value)
    }

    /// Makes the run to its end, and keeps states of it; the inputs of its last step.
    fn forward(&self, run: &mut dyn Reversible, kept: &mut Kept) -> Result<Vec<f64>, Error> {
        let mut inputs = vec![0.0; run.info().inputs.len()];
        run.inputs(&mut inputs);
        self.set_inputs(0, &mut inputs);
        for step in 0..self.steps() {
            self.set_inputs(step, &mut inputs);
            run.set_inputs(&inputs);
            kept.keep(step, |q, v| run.states(q, v));
            run.step()?;
        }
        Ok(inputs)
    }

    fn set_inputs(&self, step: u64, inputs: &mut [f64]) {
        for (place, input) in inputs.iter_mut().enumerate() {
            if let Some(value) = self.input(step, place) {
                *input = value;
            }
        }
    }

    /// From the start and the parameters to the variables.
    fn by_start<R: System<Dual<f64, PARTIALS>>>(
        &self,
        info: &Info,
        start: impl Fn(Seeds<'_, PARTIALS>) -> Result<R, Error>,
        adjoints: &Adjoints<'_, f64>,
        gradient: &mut [f64],
    ) -> Result<(), Error> {
        let mut all = [(); 2].map(|()| vec![Dual::default(); info.coordinates.len()]);
        for (chunk, places) in gradient.chunks_mut(PARTIALS).enumerate() {
            let chosen = self.variables().get(chunk * PARTIALS..).unwrap_or_default();
            let is_input = |variable: &Variable| matches!(variable, Variable::Input { .. });
            if chosen.iter().take(PARTIALS).all(is_input) {
                continue;
            }
            let [q, v] = &mut all;
            start(Seeds::new(info, chosen))?.state(q, v);
            for (at, (place, variable)) in places.iter_mut().zip(chosen).enumerate() {
                if let Variable::Parameter(_) = variable {
                    *place += adjoints.parameters.get(variable.find(info)?).copied().unwrap_or(0.0);
                }
                // Σ x̄ ∂x/∂p of what is integrated
                let along = |x: &[Dual<f64, PARTIALS>], adjoint: &[f64]| -> f64 {
                    let states = info.states.iter().filter_map(|&state| x.get(state));
                    states.zip(adjoint).map(|(x, adjoint)| x.partials[at] * *adjoint).sum()
                };
                *place += along(q, adjoints.q) + along(v, adjoints.v);
            }
        }
        Ok(())
    }
}

/// The way back through a run.
struct Way<'a> {
    sum: &'a Sum<'a>,
    start_time: f64,
    /// Those of the last step, at first.
    inputs: Vec<f64>,
}

impl Way<'_> {
    /// The value of the sum; adjoints are those of the start afterwards, and the gradient has what the
    /// inputs of each step contribute.
    fn back(
        mut self,
        run: &mut dyn Reversible,
        kept: &mut Kept,
        term: &mut Term<'_>,
        adjoints: &mut Adjoints<'_, f64>,
        gradient: &mut [f64],
    ) -> Result<f64, Error> {
        let (sum, info, steps) = (self.sum, run.info(), self.sum.steps());
        let (gains, h) = (run.gains(), run.step_size());
        let (mut back, mut terms) = (Backward::new(run), Terms::new(info));
        let pieces = Pieces::of(sum, info);
        let mut end = [(); 2].map(|()| vec![0.0; info.states.len()]);
        let [q, v] = &mut end;
        run.states(q, v);
        let at = At { t: self.time(steps, h), q, v };
        let mut value = terms.add(run, term, steps, at, &self.inputs, adjoints)?;
        pieces.collect(steps.saturating_sub(1), adjoints, gradient);
        for step in (0..steps).rev() {
            kept.restore(step, |step, [q, v], [q_next, v_next]| {
                sum.set_inputs(step, &mut self.inputs);
                run.set_inputs(&self.inputs);
                run.go_to(step, At { t: self.start_time + step as f64 * h, q, v });
                run.step()?;
                run.states(q_next, v_next);
                Ok(())
            })?;
            let (t, t_next) = (self.time(step, h), self.time(step + 1, h));
            let Some(at) = kept.state(step, t) else { break };
            sum.set_inputs(step, &mut self.inputs);
            let given =
                Given { t, q: at.q, v: at.v, inputs: &self.inputs, gains, h, t_next, ..Given::default() };
            back.step(run, &given, adjoints);
            pieces.collect(step, adjoints, gradient);
            // a state is looked at with the inputs of the step that led there
            let before = step.saturating_sub(1);
            sum.set_inputs(before, &mut self.inputs);
            value += terms.add(run, term, step, at, &self.inputs, adjoints)?;
            pieces.collect(before, adjoints, gradient);
        }
        Ok(value)
    }

    fn time(&self, step: u64, h: f64) -> f64 {
        self.start_time + step as f64 * h
    }
}

/// An input over some steps that is a variable.
struct Piece {
    steps: Range<u64>,
    /// The places of the input and of the variable.
    input: usize,
    variable: usize,
}

/// The inputs that are variables.
struct Pieces(Vec<Piece>);

impl Pieces {
    fn of(sum: &Sum<'_>, info: &Info) -> Self {
        let piece = |(at, variable): (usize, &Variable)| match *variable {
            Variable::Input { from, until, .. } => {
                Some(Piece { steps: from..until, input: variable.find(info).ok()?, variable: at })
            }
            _ => None,
        };
        Self(sum.variables().iter().enumerate().filter_map(piece).collect())
    }

    /// The adjoints of the inputs of a step, to the variables that these are.
    fn collect(&self, step: u64, adjoints: &mut Adjoints<'_, f64>, gradient: &mut [f64]) {
        for piece in self.0.iter().filter(|piece| piece.steps.contains(&step)) {
            if let (Some(place), Some(adjoint)) =
                (gradient.get_mut(piece.variable), adjoints.inputs.get(piece.input))
            {
                *place += *adjoint;
            }
        }
        adjoints.inputs.fill(0.0);
    }
}

/// Room for the terms of a sum and for their derivatives.
struct Terms {
    measures: Measures,
    by_q: Vec<f64>,
    by_v: Vec<f64>,
    by_outputs: Vec<f64>,
}

impl Terms {
    fn new(info: &Info) -> Self {
        let [by_q, by_v] = [(); 2].map(|()| vec![0.0; info.states.len()]);
        Self { measures: Measures::new(info), by_q, by_v, by_outputs: vec![0.0; info.outputs.len()] }
    }

    /// The term of a state, whose derivatives are added to the adjoints.
    fn add(
        &mut self,
        run: &mut dyn Reversible,
        term: &mut Term<'_>,
        step: u64,
        at: At<'_, f64>,
        inputs: &[f64],
        adjoints: &mut Adjoints<'_, f64>,
    ) -> Result<f64, Error> {
        let Self { measures, by_q, by_v, by_outputs } = self;
        [&mut *by_q, by_v, by_outputs].into_iter().for_each(|slopes| slopes.fill(0.0));
        let value = term(&mut Moment { step, at, inputs, by_q, by_v, by_outputs, run, measures })?;
        for (adjoints, slopes) in [(&mut *adjoints.q, &*by_q), (adjoints.v, by_v)] {
            adjoints.iter_mut().zip(slopes).for_each(|(adjoint, slope)| *adjoint += slope);
        }
        if by_outputs.iter().any(|slope| *slope != 0.0) {
            // the term may have weighed outputs that it did not ask for
            measures.measure(run, at, inputs)?;
            measures.backward(run, at, inputs, by_outputs, adjoints);
        }
        Ok(value)
    }
}

/// How many numbers adjoints are.
fn length(info: &Info, hoisted: usize) -> usize {
    let (n, m) = (info.coordinates.len(), info.constraints.len());
    3 * n + 2 * m + info.inputs.len() + info.parameters.len() + hoisted
}

/// Adjoints in so many numbers.
fn within<'a>(numbers: &'a mut [f64], info: &Info, hoisted: usize) -> Adjoints<'a, f64> {
    let (n, m) = (info.coordinates.len(), info.constraints.len());
    let mut rest = numbers;
    let mut part = |count: usize| {
        let (part, behind) = core::mem::take(&mut rest).split_at_mut_checked(count).unwrap_or_default();
        rest = behind;
        part
    };
    Adjoints {
        q: part(n),
        v: part(n),
        feedback: part(m),
        inputs: part(info.inputs.len()),
        parameters: part(info.parameters.len()),
        hoisted: part(hoisted),
        acceleration: part(n),
        multipliers: part(m),
    }
}
