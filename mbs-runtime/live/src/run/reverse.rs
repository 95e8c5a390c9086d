//! Derivatives of a sum over a run by going back through it.

use mbs_runtime::equations::At;
use mbs_runtime::gradients::{Seeds, Sum, Variable};
use mbs_runtime::{Baumgarte, Dual, Error, Gains, Held, System};

use super::{Builder, Run};
use crate::Stepper;
use crate::arguments::Arguments;
use crate::backward::Backward;
use crate::equations::{both, single, state};
use crate::transposed::Counts;

/// How much the state of a run adds to a sum for a change of its positions and velocities, to be filled in by
/// a term of [`gradient_in_reverse`](Builder::gradient_in_reverse): ∂term/∂q and ∂term/∂v of the coordinates
/// that are integrated. They are 0 at first.
#[derive(Debug)]
pub struct Weights<'a> {
    /// ∂term/∂q
    pub q: &'a mut [f64],
    /// ∂term/∂v
    pub v: &'a mut [f64],
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
    /// `term` is what a state adds to the sum, and its derivatives by the state; it is called once for each,
    /// from the last to the first with their numbers of steps, and sees what is integrated.
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
    ///     |step, at, weights| {
    ///         if step < 1000 {
    ///             return Ok(0.0);
    ///         }
    ///         weights.q[0] = 1.0;
    ///         Ok(at.q[0])
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
        mut term: impl FnMut(u64, At<'_, f64>, Weights<'_>) -> Result<f64, Error>,
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
        let (mut run, start_time) = self.forward(sum, &mut kept)?;
        let Some(transposes) = &self.mechanism.programs().transposes else {
            return Err(Error::NoTranspose { mechanism: info.name });
        };
        let mut counts = Counts::new(transposes.layout);
        gradient.fill(0.0);

        let mut value = self.term(&mut term, sum.steps(), run.states(), &mut counts)?;
        let gains = Baumgarte::<Held>::new(self.gains[0], self.gains[1])?.gains();
        let mut again = Again { stepper: Stepper::new(&self.mechanism, self.method), gains, start_time };
        let mut inputs = std::mem::take(&mut run.inputs);
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
            value += self.term(&mut term, step, at, &mut counts)?;
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

    /// What a state adds to the sum, and to how much the state counts.
    fn term(
        &self,
        term: &mut impl FnMut(u64, At<'_, f64>, Weights<'_>) -> Result<f64, Error>,
        step: u64,
        at: At<'_, f64>,
        counts: &mut Counts,
    ) -> Result<f64, Error> {
        let s = at.q.len();
        let [q, v] = &mut counts.weights;
        q.fill(0.0);
        v.fill(0.0);
        let value = term(step, at, Weights { q: &mut q[..s], v: &mut v[..s] })?;
        let layout = counts.layout;
        for (range, which) in [(layout.positions(), 0), (layout.velocities(), 1)] {
            let Counts { numbers, weights, .. } = counts;
            let counted = numbers.get_mut(range).unwrap_or_default();
            counted.iter_mut().zip(&weights[which]).for_each(|(count, weight)| *count += weight);
        }
        Ok(value)
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

/// States of a run: every j-th, and those between two of them.
struct Kept {
    /// s
    states: usize,
    /// j
    stride: u64,
    every: Vec<f64>,
    /// Those from a kept one on, until the next; none where all are kept.
    between: Vec<f64>,
    /// The number of the step at which `between` begins, if it was made.
    first: Option<u64>,
}

impl Kept {
    /// As many as fit into so many bytes.
    fn within(memory: usize, steps: u64, states: usize) -> Result<Self, Error> {
        let size = 2 * states;
        let kept = |stride: u64| steps.div_ceil(stride) + if stride > 1 { stride } else { 0 };
        let bytes = |stride: u64| {
            usize::try_from(kept(stride)).map_or(usize::MAX, |kept| kept.saturating_mul(8 * size))
        };
        let most = (steps as f64).sqrt().ceil().max(1.0) as u64;
        let mut stride = 1;
        while bytes(stride) > memory && stride < most {
            stride = (2 * stride).min(most);
        }
        if bytes(stride) > memory {
            return Err(Error::Memory { allowed: memory, needed: bytes(stride) });
        }
        let count = |kept: u64| usize::try_from(kept).map_or(0, |kept| kept * size);
        let between = if stride > 1 { count(stride) } else { 0 };
        let (every, between) = (vec![0.0; count(steps.div_ceil(stride))], vec![0.0; between]);
        Ok(Self { states, stride, every, between, first: None })
    }

    fn place(&self, at: u64) -> std::ops::Range<usize> {
        let from = usize::try_from(at).unwrap_or(usize::MAX).saturating_mul(2 * self.states);
        from..from.saturating_add(2 * self.states)
    }

    /// Keeps the state before a step, if it is one of those.
    fn keep(&mut self, step: u64, q: &[f64], v: &[f64]) {
        if step.is_multiple_of(self.stride) {
            let place = self.place(step / self.stride);
            put(self.every.get_mut(place), q, v);
        }
    }

    /// Makes the states between two kept ones again, where the state before a step is not there: `again`
    /// writes the state behind a step, positions and then velocities.
    fn restore(&mut self, step: u64, mut again: impl FnMut(u64, &[f64], &[f64], &mut [f64])) {
        let first = step - step % self.stride;
        if self.stride == 1 || self.first == Some(first) {
            return;
        }
        let (from, to) = (self.place(first / self.stride), self.place(0));
        if let (Some(from), Some(to)) = (self.every.get(from), self.between.get_mut(to)) {
            to.copy_from_slice(from);
        }
        for at in first..step {
            let end = self.place(at - first).end;
            let middle = end.min(self.between.len());
            let (before, behind) = self.between.split_at_mut(middle);
            let Some(here) = before.get(end - 2 * self.states..) else { return };
            let (q, v) = here.split_at(self.states);
            let count = behind.len().min(2 * self.states);
            again(at, q, v, &mut behind[..count]);
        }
        self.first = Some(first);
    }

    /// The state before a step.
    fn state(&self, step: u64) -> Option<(&[f64], &[f64])> {
        let found = match self.stride {
            1 => self.every.get(self.place(step)),
            stride => self.between.get(self.place(step % stride)),
        };
        found.map(|state| state.split_at(self.states))
    }
}

fn put(place: Option<&mut [f64]>, q: &[f64], v: &[f64]) {
    if let Some(place) = place {
        place.iter_mut().zip(q.iter().chain(v)).for_each(|(place, number)| *place = *number);
    }
}
