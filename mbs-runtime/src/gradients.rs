#![doc = include_str!("gradients.md")]
#![doc = include_str!("gradients.svg")]

use crate::{Dual, Error, Info, Real, System};

/// A quantity that a sum over a run is differentiated by, with its name in the declaration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Variable {
    /// A parameter, which changes the mechanism and its start.
    Parameter(&'static str),
    /// The position that a coordinate is given at the start, before that is made consistent.
    Position(&'static str),
    /// The velocity that it is given there.
    Velocity(&'static str),
    /// An input, from the step with the number `from` on, before the one with the number `until`;
    /// the first step has the number 0.
    Input {
        /// Its name.
        name: &'static str,
        /// The first step on which it acts.
        from: u64,
        /// The first step on which it no longer acts.
        until: u64,
    },
}

impl Variable {
    /// An input over the whole run.
    pub const fn input(name: &'static str) -> Self {
        Self::Input { name, from: 0, until: u64::MAX }
    }

    /// Its place in [`Info`].
    ///
    /// # Errors
    /// [`Error::NoVariable`].
    pub fn find(self, info: &Info) -> Result<usize, Error> {
        let (what, name, quantities) = match self {
            Self::Parameter(name) => ("parameter", name, info.parameters),
            Self::Position(name) | Self::Velocity(name) => ("coordinate", name, info.coordinates),
            Self::Input { name, .. } => ("input", name, info.free_inputs()),
        };
        let found = quantities.iter().position(|quantity| quantity.name == name);
        found.ok_or(Error::NoVariable { what, name })
    }

    /// Its name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Parameter(name)
            | Self::Position(name)
            | Self::Velocity(name)
            | Self::Input { name, .. } => name,
        }
    }
}

/// A sum over a run that is to be differentiated: how long the run is, what goes in, and by which
/// variables.
#[derive(Clone, Copy)]
pub struct Sum<'a> {
    steps: u64,
    variables: &'a [Variable],
    signal: Option<&'a Signal>,
}

/// The value of an input, by the number of the step and by its place in [`Info`].
type Signal = dyn Fn(u64, usize) -> f64;

impl<'a> Sum<'a> {
    /// A sum over the start of a run and the ends of so many steps.
    pub const fn new(steps: u64, variables: &'a [Variable]) -> Self {
        Self { steps, variables, signal: None }
    }

    /// The same with inputs that change: `signal` gives the value of an input over a step, by the
    /// number of the step and the place of the input in [`Info`]. Without it they are those of the
    /// builder.
    ///
    /// # Example
    /// The speed to which a block is pushed with 2 N for half a second:
    /// ```
    /// use mbs_runtime::gradients::{Sum, Variable};
    /// use mbs_runtime::{Dual, Simulation};
    /// # use mbs_runtime::mechanism;
    /// # mechanism! {
    /// #     pub Block {
    /// #         dof = 1;
    /// #         input push [N];
    /// #         body block (x) { mass = 1 [kg]; }
    /// #         force pushed on x = push;
    /// #     }
    /// # }
    /// let variables = [Variable::input("push")];
    /// let signal = |step: u64, _: usize| if step < 500 { 2.0 } else { 0.0 };
    /// let mut gradient = [0.0];
    /// let speed = Simulation::builder(Block::declared(), 1e-3).gradient(
    ///     &Sum::new(1000, &variables).driven_by(&signal),
    ///     |run: &Simulation<Block<Dual<f64, 1>>>| {
    ///         Ok(if run.steps() == 1000 { run.state().v.x } else { Dual::default() })
    ///     },
    ///     &mut gradient,
    /// )?;
    /// // a newton more over the whole second would be 1 m/s more
    /// assert!((speed - 1.0).abs() < 1e-12 && (gradient[0] - 1.0).abs() < 1e-12);
    /// # Ok::<(), mbs_runtime::Error>(())
    /// ```
    #[must_use]
    pub const fn driven_by(self, signal: &'a Signal) -> Self {
        Self { signal: Some(signal), ..self }
    }

    /// The steps of the run.
    pub const fn steps(&self) -> u64 {
        self.steps
    }

    /// The variables.
    pub const fn variables(&self) -> &'a [Variable] {
        self.variables
    }

    /// The value of the input at this place over a step; `None` without a signal.
    pub fn input(&self, step: u64, place: usize) -> Option<f64> {
        self.signal.map(|signal| signal(step, place))
    }

    /// The value of the sum, with its derivatives by the variables in `gradient`.
    ///
    /// `start` makes the run with some of the variables, `term` is what a state adds to the sum,
    /// and `inputs` has a number per input. For those who write runs of their own; a
    /// [`Builder`](crate::Builder) has [`gradient`](crate::Builder::gradient).
    ///
    /// # Example
    /// Where a run to a tolerance ends after 1 s, by a parameter:
    /// ```
    /// use mbs_runtime::gradients::{Seeds, Sum, Variable};
    /// use mbs_runtime::{Adaptive, Components, Dual, Mechanism, Sampled, System};
    /// # use mbs_runtime::mechanism;
    /// # mechanism! {
    /// #     pub Oscillator {
    /// #         dof = 1;
    /// #         param stiffness = 100 [N/m];
    /// #         body block (x) { mass = 1 [kg]; }
    /// #         force spring on x = -stiffness*x;
    /// #         start { x = 0.1 [m]; }
    /// #     }
    /// # }
    /// let start = |seeds: Seeds<'_, 1>| {
    ///     let mut parameters = [Dual::constant(100.0)];
    ///     seeds.parameters(&mut parameters);
    ///     let oscillator = Oscillator::new(OscillatorParameters::from_array(parameters))?;
    ///     Sampled::new(Adaptive::builder(oscillator).build()?, 0.01)
    /// };
    /// let end = |run: &Sampled<_, _>| {
    ///     let (mut q, mut v) = ([Dual::default()], [Dual::default()]);
    ///     run.state(&mut q, &mut v);
    ///     Ok(if run.steps() == 100 { q[0] } else { Dual::default() })
    /// };
    /// let (variables, mut gradient) = ([Variable::Parameter("stiffness")], [0.0]);
    /// let sum = Sum::new(100, &variables);
    /// let x = sum.differentiate(Oscillator::<f64>::INFO, start, end, &mut [], &mut gradient)?;
    /// // x = 0.1 cos √k t, ∂x/∂k = −0.1 t sin √k t/(2 √k)
    /// assert!((x - 0.1 * 10_f64.cos()).abs() < 1e-5);
    /// assert!((gradient[0] + 0.005 * 10_f64.sin()).abs() < 1e-5);
    /// # Ok::<(), mbs_runtime::Error>(())
    /// ```
    ///
    /// # Errors
    /// Those of the run and of `term`, and of [`Builder::gradient`](crate::Builder::gradient).
    pub fn differentiate<R: System<Dual<f64, N>>, const N: usize>(
        &self,
        info: &Info,
        start: impl Fn(Seeds<'_, N>) -> Result<R, Error>,
        mut term: impl FnMut(&R) -> Result<Dual<f64, N>, Error>,
        inputs: &mut [Dual<f64, N>],
        gradient: &mut [f64],
    ) -> Result<f64, Error> {
        const { assert!(N > 0, "at least one derivative is computed at once") };
        let (found, expected) = (gradient.len(), self.variables.len());
        if found != expected {
            return Err(Error::Length { what: "the gradient", found, expected });
        }
        for variable in self.variables {
            variable.find(info)?;
        }
        let mut value = f64::NAN;
        // without variables there is one run, for the value
        for chunk in 0..expected.div_ceil(N).max(1) {
            let first = chunk * N;
            let seeds = Seeds::new(info, self.variables.get(first..).unwrap_or_default());
            let (sum, t) = self.run(seeds, start(seeds)?, &mut term, inputs)?;
            value = sum.value;
            let places = gradient.iter_mut().skip(first).zip(seeds.variables);
            for ((place, variable), partial) in places.zip(sum.partials) {
                if !partial.is_finite() {
                    let (what, name) = ("the derivative of the sum by", variable.name());
                    return Err(Error::Undefined { t, what, name, value: partial });
                }
                *place = partial;
            }
        }
        Ok(value)
    }

    /// The sum with the derivatives by some of the variables, and the time of its end.
    fn run<R: System<Dual<f64, N>>, const N: usize>(
        &self,
        seeds: Seeds<'_, N>,
        mut run: R,
        term: &mut impl FnMut(&R) -> Result<Dual<f64, N>, Error>,
        inputs: &mut [Dual<f64, N>],
    ) -> Result<(Dual<f64, N>, f64), Error> {
        run.inputs(inputs);
        seeds.set_inputs(&mut run, 0, self.signal, inputs);
        let mut sum = term(&run)?;
        for step in 0..self.steps {
            seeds.set_inputs(&mut run, step, self.signal, inputs);
            run.step()?;
            sum = sum + term(&run)?;
        }
        Ok((sum, run.time().value))
    }
}

/// The variables by which a run differentiates, one partial derivative each.
#[derive(Clone, Copy, Debug)]
pub struct Seeds<'a, const N: usize> {
    info: &'a Info,
    variables: &'a [Variable],
}

impl<'a, const N: usize> Seeds<'a, N> {
    /// The first `N` of these variables.
    pub fn new(info: &'a Info, variables: &'a [Variable]) -> Self {
        Self { info, variables: variables.get(..N).unwrap_or(variables) }
    }

    /// Makes variables of parameters.
    pub fn parameters(&self, parameters: &mut [Dual<f64, N>]) {
        self.plant(parameters, |variable| matches!(variable, Variable::Parameter(_)));
    }

    /// Makes variables of the positions and velocities of a start.
    pub fn start(&self, q: &mut [Dual<f64, N>], v: &mut [Dual<f64, N>]) {
        self.plant(q, |variable| matches!(variable, Variable::Position(_)));
        self.plant(v, |variable| matches!(variable, Variable::Velocity(_)));
    }

    /// Gives a run the inputs of a step.
    fn set_inputs(
        &self,
        run: &mut impl System<Dual<f64, N>>,
        step: u64,
        signal: Option<&Signal>,
        inputs: &mut [Dual<f64, N>],
    ) {
        for (at, input) in inputs.iter_mut().enumerate() {
            *input = Dual::constant(signal.map_or(input.value, |signal| signal(step, at)));
        }
        self.plant(inputs, |variable| {
            matches!(variable, Variable::Input { from, until, .. } if from <= step && step < until)
        });
        run.set_inputs(inputs);
    }

    /// Makes variables of the numbers that some variables name.
    fn plant(&self, numbers: &mut [Dual<f64, N>], is_meant: impl Fn(Variable) -> bool) {
        let variables = self.variables.iter().enumerate();
        for (partial, variable) in variables.filter(|(_, variable)| is_meant(**variable)) {
            let place = variable.find(self.info).ok().and_then(|at| numbers.get_mut(at));
            if let Some(number) = place {
                *number = number.plus_partial(partial, 1.0);
            }
        }
    }
}
