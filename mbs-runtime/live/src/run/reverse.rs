//! Runs that are gone back through.
//!
//! `transposed.rs` makes code of transposed programs. This module makes a run `Reversible`. Texts that are
//! not compiled for that carry none of it.

use mbs_codegen::FunctionId;
use mbs_runtime::equations::At;
use mbs_runtime::gradients::{Seeds, Sum};
use mbs_runtime::reverse::{Adjoints, Function, Given, Moment, Reversible};
use mbs_runtime::{Error, Explicit, Gains, Info, Stabilization, System};

use super::{Builder, Run, copy};
use crate::Live;
use crate::arguments::Arguments;
use crate::code::Code;
use crate::equations::{both, single, state};
use crate::instruction::execute;
use crate::transposed::id;

impl Builder {
    /// A sum over the run that starts here, with its derivatives by variables in `gradient`, by going back
    /// through the run; as
    /// [`gradient_in_reverse`](mbs_runtime::Builder::gradient_in_reverse) of a mechanism of `mechanism!`, where
    /// it is explained. The declaration has to say `gradients = reverse;`, or to be compiled by
    /// [`compile_with_transposes`](crate::Text::compile_with_transposes).
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
    pub fn gradient_in_reverse(
        &self,
        sum: &Sum<'_>,
        memory: usize,
        mut term: impl FnMut(&mut Moment<'_>) -> Result<f64, Error>,
        gradient: &mut [f64],
    ) -> Result<f64, Error> {
        // consistent starts are made with what the builder has
        let mut run = Retraced::new(self.over(|_: &mut [f64]| {})?.build()?)?;
        let start = |seeds: Seeds<'_, _>| self.seeded(seeds)?.build();
        sum.differentiate_in_reverse(&mut run, start, memory, &mut term, gradient)
    }
}

/// Slots of a code.
type Slots = Vec<[f64; 1]>;

/// A run, and slots for the functions of its mechanism, in the order of [`Function::ALL`]. They are made when a
/// function is first run.
struct Retraced {
    run: Run,
    forward: [Slots; Function::ALL.len()],
    backward: [Slots; Function::ALL.len()],
}

impl Retraced {
    /// # Errors
    /// [`Error::NoTranspose`].
    fn new(run: Run) -> Result<Self, Error> {
        let live = &run.mechanism;
        if live.programs().transposes.is_none() {
            return Err(Error::NoTranspose { mechanism: live.declared_info().name });
        }
        Ok(Self { run, forward: Default::default(), backward: Default::default() })
    }
}

/// Fills the slots of a code at its first run.
fn prepare(slots: &mut Slots, code: &Code, live: &Live) {
    if slots.is_empty() {
        *slots = code.memory(|fixed| [live.fixed(fixed)]);
    }
}

impl Reversible for Retraced {
    fn info(&self) -> &'static Info {
        self.run.mechanism.declared_info()
    }

    fn method(&self) -> Explicit {
        self.run.method
    }

    fn gains(&self) -> Gains<f64> {
        self.run.gains
    }

    fn step_size(&self) -> f64 {
        self.run.step
    }

    fn whole_step(&self) -> Option<Function> {
        let Run { mechanism, method, .. } = &self.run;
        mechanism.programs().step(*method)?;
        match method.stabilization {
            Stabilization::Held => Some(Function::StepHeld),
            Stabilization::PerStage => Some(Function::StepPerStage),
            Stabilization::Projection => None,
        }
    }

    fn hoisted(&self) -> usize {
        self.run.mechanism.programs().function(FunctionId::Hoisted).outputs.len()
    }

    fn time(&self) -> f64 {
        self.run.t
    }

    fn states(&self, q: &mut [f64], v: &mut [f64]) {
        copy(q, &self.run.q);
        copy(v, &self.run.v);
    }

    fn inputs(&self, inputs: &mut [f64]) {
        copy(inputs, &self.run.inputs);
    }

    fn set_inputs(&mut self, inputs: &[f64]) {
        copy(&mut self.run.inputs, inputs);
    }

    fn step(&mut self) -> Result<(), Error> {
        self.run.step()
    }

    fn go_to(&mut self, step: u64, at: At<'_, f64>) {
        let Run { steps, t, q, v, watch, .. } = &mut self.run;
        (*steps, *t, *watch) = (step, at.t, watch.anew());
        copy(q, at.q);
        copy(v, at.v);
    }

    fn forward(&mut self, function: Function, given: &Given<'_, f64>, results: &mut [&mut [f64]]) {
        let Self { run: Run { mechanism: live, .. }, forward, .. } = self;
        let Some(id) = id(function) else { return };
        let (programs, slots) = (live.programs(), &mut forward[function as usize]);
        let code = programs.function(id);
        prepare(slots, code, live);
        code.load(slots, &arguments(given));
        execute(&code.instructions, programs.tables.splines, slots);
        let places = results.iter_mut().flat_map(|result| result.iter_mut());
        for (place, &slot) in places.zip(&code.outputs) {
            [*place] = slots[slot as usize];
        }
    }

    fn backward(
        &mut self,
        function: Function,
        given: &Given<'_, f64>,
        weights: &[f64],
        adjoints: &mut Adjoints<'_, f64>,
    ) {
        let Self { run: Run { mechanism: live, .. }, backward, .. } = self;
        let programs = live.programs();
        let Some(transposed) = programs.transposes.as_ref().and_then(|all| all.of(function)) else { return };
        let slots = &mut backward[function as usize];
        prepare(slots, &transposed.code, live);
        let given = Arguments { weights: single(weights), ..arguments(given) };
        transposed.run(programs.tables.splines, slots, &given, adjoints);
    }
}

/// The arguments of a function, as codes read them.
fn arguments<'a>(given: &Given<'a, f64>) -> Arguments<'a> {
    Arguments {
        inputs: single(given.inputs),
        gains: both(&given.gains),
        feedback: single(given.feedback),
        acceleration: single(given.acceleration),
        multipliers: single(given.multipliers),
        step: [given.h],
        t_next: [given.t_next],
        ..state(At { t: given.t, q: given.q, v: given.v })
    }
}
