//! Simulations that are gone back through.

use super::{Builder, Simulation};
use crate::equations::{At, Equations, read, write};
use crate::gradients::{Seeds, Sum};
use crate::mechanism::is_fused_for;
use crate::reverse::{Adjoints, Function, Given, Moment, Reversible, Transposed};
use crate::{Error, Explicit, Gains, Info, Mechanism, Method, Stabilization};

impl<M: Mechanism<Real = f64>, X: Method> Builder<M, X> {
    /// A sum over the run that starts here, with its derivatives by variables in `gradient`, by going back
    /// through the run. It costs a few times the run, whatever the number of variables. The declaration of the
    /// mechanism has to say `gradients = reverse;`.
    ///
    /// Forward, states are kept; backward, the adjoint x̄ of a state, which is the derivative of the sum by it,
    /// passes through each step by transposed programs,
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
    /// use mbs_runtime::gradients::{Sum, Variable};
    /// use mbs_runtime::{Simulation, mechanism};
    ///
    /// mechanism! {
    ///     pub Throw {
    ///         dof = 1;
    ///         gradients = reverse;
    ///         param c = 0.5 [N*s/m];
    ///         body ball (x) { mass = 1 [kg]; }
    ///         force drag on x = -c*der(x);
    ///         start { x = 0; der(x) = 3 [m/s]; }
    ///     }
    /// }
    ///
    /// let variables = [Variable::Velocity("x"), Variable::Parameter("c")];
    /// let mut gradient = [0.0; 2];
    /// let way = Simulation::builder(Throw::declared(), 1e-3).gradient_in_reverse(
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
    /// # Ok::<(), mbs_runtime::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Memory`]; otherwise as [`gradient`](Self::gradient).
    ///
    /// # Source
    /// A. Griewank, A. Walther, Evaluating Derivatives, 2nd ed., SIAM 2008, chapters 3 and 12.
    pub fn gradient_in_reverse(
        self,
        sum: &Sum<'_>,
        memory: usize,
        mut term: impl FnMut(&mut Moment<'_>) -> Result<f64, Error>,
        gradient: &mut [f64],
    ) -> Result<f64, Error>
    where
        M: Transposed,
    {
        let mut run = self.build()?;
        let start = |seeds: Seeds<'_, _>| self.seeded(seeds)?.build();
        sum.differentiate_in_reverse(&mut run, start, memory, &mut term, gradient)
    }
}

impl<M: Transposed<Real = f64>, X: Method> Reversible for Simulation<M, X> {
    fn info(&self) -> &'static Info {
        M::INFO
    }

    fn method(&self) -> Explicit {
        X::EXPLICIT
    }

    fn gains(&self) -> Gains<f64> {
        self.gains
    }

    fn step_size(&self) -> f64 {
        self.step
    }

    fn whole_step(&self) -> Option<Function> {
        match X::EXPLICIT.stabilization {
            Stabilization::Held => Some(Function::StepHeld),
            Stabilization::PerStage => Some(Function::StepPerStage),
            Stabilization::Projection => None,
        }
        .filter(|_| const { M::HAS_STEP && is_fused_for::<M, X>() })
    }

    fn hoisted(&self) -> usize {
        Mechanism::hoisted(&self.mechanism).len()
    }

    fn time(&self) -> f64 {
        self.state.t
    }

    fn states(&self, q: &mut [f64], v: &mut [f64]) {
        write(self.state.q, q);
        write(self.state.v, v);
    }

    fn inputs(&self, inputs: &mut [f64]) {
        write(self.inputs, inputs);
    }

    fn set_inputs(&mut self, inputs: &[f64]) {
        self.inputs = read(inputs);
    }

    fn step(&mut self) -> Result<(), Error> {
        Self::step(self)
    }

    fn go_to(&mut self, step: u64, at: At<'_, f64>) {
        *self = self.moved_to((at.state(), *self.inputs()), step, self.watch.anew());
    }

    fn forward(&mut self, function: Function, given: &Given<'_, f64>, results: &mut [&mut [f64]]) {
        let mechanism = &self.mechanism;
        let at = At { t: given.t, q: given.q, v: given.v };
        match (function, results) {
            (Function::Stabilized, [acceleration, feedback]) => {
                Equations::stabilized(mechanism, at, given.inputs, &given.gains, acceleration, feedback);
            }
            (Function::Constrained, [acceleration]) => {
                Equations::constrained(mechanism, at, given.inputs, given.feedback, acceleration);
            }
            (Function::Complete, [q, v]) => Equations::complete(mechanism, at, q, v),
            (Function::Phi, [phi]) => Equations::phi(mechanism, at.t, at.q, phi),
            (Function::PhiDot, [phi_dot]) => Equations::phi_dot(mechanism, at, phi_dot),
            (Function::Projection, [correction]) => {
                Equations::projection(mechanism, at.t, at.q, given.feedback, correction);
            }
            (Function::Reactions, [acceleration, multipliers]) => {
                Equations::reactions(mechanism, at, given.inputs, acceleration, multipliers);
            }
            (Function::Outputs, [outputs]) => {
                let reactions = [given.acceleration, given.multipliers];
                Equations::outputs(mechanism, at, given.inputs, reactions, outputs);
            }
            (_, results) => results.iter_mut().for_each(|result| result.fill(f64::NAN)),
        }
    }

    fn backward(
        &mut self,
        function: Function,
        given: &Given<'_, f64>,
        weights: &[f64],
        adjoints: &mut Adjoints<'_, f64>,
    ) {
        if self.mechanism.transposed(function, given, weights, adjoints).is_none() {
            // whoever asks for what is not there is not told a wrong number
            [&mut adjoints.q, &mut adjoints.parameters]
                .into_iter()
                .for_each(|adjoint| adjoint.fill(f64::NAN));
        }
    }
}
