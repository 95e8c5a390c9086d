//! Derivatives of a sum over a run by going back through it.

mod kept;

use mbs_runtime::equations::At;
use mbs_runtime::gradients::{Seeds, Sum, Variable};
use mbs_runtime::{Baumgarte, Dual, Error, Gains, Held, System};

use super::{Builder, Run};
use crate::arguments::Arguments;
use crate::backward::{Backward, Measures};
use crate::equations::{both, single, state};
use crate::transposed::{Counts, Transposes};
use crate::{Live, Stepper};
use kept::{Kept, put};

/// A state of a run, of which a term of [`gradient_in_reverse`](Builder::gradient_in_reverse) is a function; the term
/// writes its derivatives here, which are 0 at first.
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
    measures: &'a mut Measures,
}

impl Moment<'_> {
    /// What the declaration measures there. It is computed when it is asked for.
    ///
    /// # Errors
    /// [`Error::Undefined`] if an output is not finite.
    pub fn outputs(&mut self) -> Result<&[f64], Error> {
        self.measures.measure(self.at, self.inputs)
    }
}

/// Derivatives of a start that duals carry at once.
const PARTIALS: usize = 8;

impl Builder {
    /// A sum over the run that starts here, with its derivatives by variables in `gradient`, by going back
    /// through the run. It costs a few times the run, whatever the number of variables; the mechanism has to be
    /// compiled by [`compile_with_transposes`](crate::Text::compile_with_transposes).
    ///
    /// Forward, states are kept; backward, how much a state counts for the sum passes through each step by
    /// transposed programs,
    ///
    /// ```text
    /// x̄ₖ = (∂xₖ₊₁/∂xₖ)ᵀ x̄ₖ₊₁ + ∂termₖ/∂xₖ      p̄ ← p̄ + (∂xₖ₊₁/∂p)ᵀ x̄ₖ₊₁
    /// ```
    ///
    /// and from the start to the variables by dual numbers. Of `steps` states of 2s numbers all are kept if
    /// they fit into `memory` bytes. Else every j-th is, and the steps between two of them are made again, which
    /// costs one more run: 16 s (steps/j + j + 1) bytes, at least for j = √steps.
    ///
    /// `term` is what a state adds to the sum, a function of what is integrated and of the outputs there, by which
    /// it writes its derivatives. It is called once for each state, from the last to the first.
    ///
    /// # Example
    /// The end of a throw with drag, by speed and by drag:
    /// ```
    /// use mbs_live::{Run, Text};
    /// use mbs_runtime::gradients::{Sum, Variable};
    ///
    /// let text = "Throw {
    ///     dof = 1;
    ///     param c = 0.5 [N*s/m];
    ///     body ball (x) { mass = 1 [kg]; }
    ///     force drag on x = -c*der(x);
    ///     start { x = 0; der(x) = 3 [m/s]; }
    /// }";
    /// let ball = Text::declaration("throw.mbs", text).compile_with_transposes()?;
    /// let variables = [Variable::Velocity("x"), Variable::Parameter("c")];
    /// let mut gradient = [0.0; 2];
    /// let way = Run::builder(&ball, 1e-3).gradient_in_reverse(
    ///     &Sum::new(1000, &variables),
    ///     1 << 20,
    ///     |moment| {
    ///         if moment.step < 1000 {
    ///             return Ok(0.0);
    ///         }
    ///         moment.by_q[0] = 1.0;
    ///         Ok(moment.at.q[0])
    ///     },
    ///     &mut gradient,
    /// )?;
    /// // x = v (1 − exp(−ct))/c
    /// let decay = (-0.5_f64).exp();
    /// assert!((way - 6.0 * (1.0 - decay)).abs() < 1e-6);
    /// assert!((gradient[0] - 2.0 * (1.0 - decay)).abs() < 1e-6);
    /// assert!((gradient[1] - 3.0 * (2.0 * decay - 4.0 * (1.0 - decay))).abs() < 1e-6);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::NoTranspose`], [`Error::Memory`]; otherwise as [`gradient`](Self::gradient).
    ///
    /// # Source
    /// A. Griewank, A. Walther, Evaluating Derivatives, 2nd ed., SIAM 2008, chapters 3 and 12.
    pub fn gradient_in_reverse(
        &self,
        sum: &Sum<'_>,
        memory: usize,
        mut term: impl FnMut(&mut Moment<'_>) -> Result<f64, Error>,
        gradient: &mut [f64],
    ) -> Result<f64, Error> {
        let info = self.mechanism.declared_info();
        let (found, expected) = (gradient.len(), sum.variables().len());
        if found != expected {
            return Err(Error::Length { what: "the gradient", found, expected });
        }
        sum.variables().iter().try_for_each(|variable| variable.find(info).map(drop))?;
        let mut back = Backward::new(&self.mechanism, self.method)?;
        let mut kept = Kept::within(memory, sum.steps(), info.states.len())?;
        let (run, start_time) = self.forward(sum, &mut kept)?;
        let Some(transposes) = &self.mechanism.programs().transposes else {
            return Err(Error::NoTranspose { mechanism: info.name });
        };
        let mut counts = Counts::new(transposes.layout);
        gradient.fill(0.0);

        let mut terms = Terms::new(&self.mechanism, transposes);
        let gains = Baumgarte::<Held>::new(self.gains[0], self.gains[1])?.gains();
        let mut again = Again { stepper: Stepper::new(&self.mechanism, self.method), gains, start_time };
        let mut inputs = run.inputs.clone();
        let mut value = terms.add(&mut term, sum.steps(), run.states(), &inputs, &mut counts)?;
        by_inputs(sum, info, sum.steps().saturating_sub(1), &mut counts, gradient);
        for step in (0..sum.steps()).rev() {
            kept.restore(step, |step, q, v, behind| {
                self.set_inputs(sum, step, &mut inputs);
                again.step((step, self.step), At { t: start_time, q, v }, &inputs, behind);
            });
            self.set_inputs(sum, step, &mut inputs);
            let Some((q, v)) = kept.state(step) else { break };
            let at = At { t: again.time(step, self.step), q, v };
            let given = Arguments {
                inputs: single(&inputs),
                gains: both(&again.gains),
                step: [self.step],
                t_next: [again.time(step + 1, self.step)],
                ..state(at)
            };
            back.step(&given, &mut counts);
            by_inputs(sum, info, step, &mut counts, gradient);
            // a state is looked at with the inputs of the step that led there
            let before = step.saturating_sub(1);
            self.set_inputs(sum, before, &mut inputs);
            value += terms.add(&mut term, step, at, &inputs, &mut counts)?;
            by_inputs(sum, info, before, &mut counts, gradient);
        }
        self.by_parameters(&mut counts);
        self.by_start(sum, &mut counts, gradient)?;
        for (variable, derivative) in sum.variables().iter().zip(gradient.iter()) {
            if !derivative.is_finite() {
                let (what, name) = ("the derivative of the sum by", variable.name());
                return Err(Error::Undefined { t: start_time, what, name, value: *derivative });
            }
        }
        Ok(value)
    }

    /// The run to its end, from which states are kept; the time of its start.
    fn forward(&self, sum: &Sum<'_>, kept: &mut Kept) -> Result<(Run, f64), Error> {
        let mut run = self.over(|_: &mut [f64]| {})?.build()?;
        let start_time = run.t;
        self.set_inputs(sum, 0, &mut run.inputs);
        for step in 0..sum.steps() {
            self.set_inputs(sum, step, &mut run.inputs);
            kept.keep(step, &run.q, &run.v);
            run.step()?;
        }
        Ok((run, start_time))
    }

    fn set_inputs(&self, sum: &Sum<'_>, step: u64, inputs: &mut [f64]) {
        for (place, input) in inputs.iter_mut().enumerate() {
            if let Some(value) = sum.input(step, place) {
                *input = value;
            }
        }
    }

    /// From what depends on parameters alone to the parameters.
    fn by_parameters(&self, counts: &mut Counts) {
        let Some(transposes) = &self.mechanism.programs().transposes else { return };
        let layout = counts.layout;
        let weights: Vec<[f64; 1]> = counts.part(layout.hoisted()).iter().map(|count| [*count]).collect();
        let splines = self.mechanism.programs().tables.splines;
        let given = Arguments { weights: &weights, ..Arguments::default() };
        let number = |fixed| self.mechanism.fixed(fixed);
        transposes.hoisted.run_once(splines, number, &given, &mut counts.numbers);
    }

    /// From the start and the parameters to the variables.
    fn by_start(&self, sum: &Sum<'_>, counts: &mut Counts, gradient: &mut [f64]) -> Result<(), Error> {
        let (info, layout) = (self.mechanism.declared_info(), counts.layout);
        let variables = sum.variables();
        for (chunk, places) in gradient.chunks_mut(PARTIALS).enumerate() {
            let chosen = variables.get(chunk * PARTIALS..).unwrap_or_default();
            let seeds: Seeds<'_, PARTIALS> = Seeds::new(info, chosen);
            let is_input = |variable: &Variable| matches!(variable, Variable::Input { .. });
            if chosen.iter().take(PARTIALS).all(is_input) {
                continue;
            }
            let start: Run<Dual<f64, PARTIALS>> = self.seeded(seeds)?.build()?;
            for (at, (place, variable)) in places.iter_mut().zip(chosen).enumerate() {
                if let Variable::Parameter(_) = variable {
                    *place +=
                        counts.part(layout.parameters()).get(variable.find(info)?).copied().unwrap_or(0.0);
                }
                let of_q = start
                    .q
                    .iter()
                    .zip(counts.part(layout.positions()))
                    .map(|(q, count)| q.partials[at] * *count);
                let of_q: f64 = of_q.sum();
                let of_v = start
                    .v
                    .iter()
                    .zip(counts.part(layout.velocities()))
                    .map(|(v, count)| v.partials[at] * *count);
                *place += of_q + of_v.sum::<f64>();
            }
        }
        Ok(())
    }
}

/// What the inputs of a step count, to the variables that they are.
fn by_inputs(sum: &Sum<'_>, info: &mbs_runtime::Info, step: u64, counts: &mut Counts, gradient: &mut [f64]) {
    let range = counts.layout.inputs();
    let counted = counts.part(range);
    for (variable, place) in sum.variables().iter().zip(gradient) {
        if let Variable::Input { from, until, .. } = variable
            && (*from..*until).contains(&step)
            && let Ok(at) = variable.find(info)
        {
            *place += counted.get(at).copied().unwrap_or(0.0);
        }
    }
    counted.fill(0.0);
}

/// What states add to the sum, and room for that.
struct Terms<'a> {
    transposes: &'a Transposes,
    measures: Measures,
    by_q: Vec<f64>,
    by_v: Vec<f64>,
    by_outputs: Vec<f64>,
}

impl<'a> Terms<'a> {
    fn new(live: &Live, transposes: &'a Transposes) -> Self {
        let info = live.declared_info();
        let [by_q, by_v] = [(); 2].map(|()| vec![0.0; info.states.len()]);
        let by_outputs = vec![0.0; info.outputs.len()];
        Self { transposes, measures: Measures::new(live, transposes), by_q, by_v, by_outputs }
    }

    /// The term of a state; to how much everything counts is added.
    fn add(
        &mut self,
        term: &mut impl FnMut(&mut Moment<'_>) -> Result<f64, Error>,
        step: u64,
        at: At<'_, f64>,
        inputs: &[f64],
        counts: &mut Counts,
    ) -> Result<f64, Error> {
        let Self { transposes, measures, by_q, by_v, by_outputs } = self;
        [&mut *by_q, by_v, by_outputs].into_iter().for_each(|weights| weights.fill(0.0));
        let value = term(&mut Moment { step, at, inputs, by_q, by_v, by_outputs, measures })?;
        let layout = counts.layout;
        for (range, weights) in [(layout.positions(), &*by_q), (layout.velocities(), by_v)] {
            counts.part(range).iter_mut().zip(weights).for_each(|(count, weight)| *count += weight);
        }
        if by_outputs.iter().any(|weight| *weight != 0.0) {
            // the term may have weighed outputs that it did not ask for
            measures.measure(at, inputs)?;
            measures.backward(transposes, at, inputs, by_outputs, counts);
        }
        Ok(value)
    }
}

/// Steps that are made again.
struct Again {
    stepper: Stepper,
    gains: Gains<f64>,
    start_time: f64,
}

impl Again {
    fn time(&self, step: u64, h: f64) -> f64 {
        self.start_time + step as f64 * h
    }

    /// Writes the state behind a step of length h from positions and velocities.
    fn step(&mut self, (step, h): (u64, f64), at: At<'_, f64>, inputs: &[f64], behind: &mut [f64]) {
        let at = At { t: self.time(step, h), ..at };
        self.stepper.step(at, inputs, &self.gains, h, self.time(step + 1, h));
        put(Some(behind), self.stepper.q(), self.stepper.v());
    }
}
