//! Runs over duals.

use mbs_runtime::equations::At;
use mbs_runtime::gradients::{Seeds, Sum};
use mbs_runtime::{Dual, Error, Real, System};

use super::{Builder, Run};
use crate::Live;

impl Builder {
    /// The choices for the same run over another scalar: `change` is given its parameters. Over
    /// [`Dual`], a run with its derivatives. The text is not compiled again; the state that was
    /// given and the inputs become constants.
    ///
    /// # Example
    /// ```
    /// use mbs_live::{Run, Text};
    /// use mbs_runtime::{Dual, System};
    ///
    /// let text = "Fall {
    ///     dof = 1;
    ///     param g = 9.81 [m/s^2];
    ///     gravity = (0, -g);
    ///     body ball (y) { mass = 1 [kg]; }
    ///     start { y = 1 [m]; }
    /// }";
    /// let ball = Text::declaration("fall.mbs", text).compile()?;
    /// let by_g = |values: &mut [Dual<f64, 1>]| values[0] = Dual::variable(9.81, 0);
    /// let mut run = Run::builder(&ball, 1e-3).over(by_g)?.build()?;
    /// run.advance(500)?;
    /// // ∂(h − ½gt²)/∂g
    /// assert!((run.q()[0].partials[0] + 0.125).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// As [`Live::with_parameters`](crate::Live::with_parameters).
    pub fn over<T: Real>(&self, change: impl FnOnce(&mut [T])) -> Result<Builder<T>, Error> {
        let constants = |numbers: &Vec<f64>| numbers.iter().map(|x| T::from_f64(*x)).collect();
        let state = self.state.as_ref().map(|(t, q, v)| (T::from_f64(*t), constants(q), constants(v)));
        Ok(Builder {
            mechanism: self.mechanism.over().with_parameters(change)?,
            step: self.step,
            method: self.method,
            gains: self.gains,
            inputs: constants(&self.inputs),
            state,
            steps_taken: self.steps_taken,
            start: self.start,
            allow_unstable: self.allow_unstable,
        })
    }

    /// A sum over the run that starts here, with its derivatives by variables in `gradient`; as
    /// [`gradient`](mbs_runtime::Builder::gradient) of a mechanism of `mechanism!`.
    ///
    /// # Example
    /// How far a push over the first half of a second moves a block, by that push and by its mass:
    /// ```
    /// use mbs_live::{Run, Text};
    /// use mbs_runtime::gradients::{Sum, Variable};
    /// use mbs_runtime::{Dual, System};
    ///
    /// let text = "Block {
    ///     dof = 1;
    ///     param m = 2 [kg];
    ///     input push [N];
    ///     body block (x) { mass = m; }
    ///     force pushed on x = push;
    ///     start { x = 0; }
    /// }";
    /// let block = Text::declaration("block.mbs", text).compile()?;
    /// let variables =
    ///     [Variable::Input { name: "push", from: 0, until: 500 }, Variable::Parameter("m")];
    /// let signal = |step: u64, _: usize| if step < 500 { 4.0 } else { 0.0 };
    /// let sum = Sum::new(1000, &variables).driven_by(&signal);
    /// let mut gradient = [0.0; 2];
    /// let way = Run::builder(&block, 1e-3).gradient(
    ///     &sum,
    ///     |run: &Run<Dual<f64, 2>>| {
    ///         Ok(if run.steps() == 1000 { run.q()[0] } else { Dual::default() })
    ///     },
    ///     &mut gradient,
    /// )?;
    /// // a = 2 m/s² for half a second, then on with 1 m/s
    /// assert!((way - 0.75).abs() < 1e-12);
    /// assert!((gradient[0] - way / 4.0).abs() < 1e-12 && (gradient[1] + way / 2.0).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// As [`gradient`](mbs_runtime::Builder::gradient) there.
    pub fn gradient<const N: usize>(
        &self,
        sum: &Sum<'_>,
        term: impl FnMut(&Run<Dual<f64, N>>) -> Result<Dual<f64, N>, Error>,
        gradient: &mut [f64],
    ) -> Result<f64, Error> {
        let start = |seeds: Seeds<'_, N>| self.seeded(seeds)?.build();
        let mut inputs: Vec<_> = self.inputs.iter().map(|input| Dual::constant(*input)).collect();
        sum.differentiate(self.mechanism.declared_info(), start, term, &mut inputs, gradient)
    }

    /// The same over duals, whose parameters, positions and velocities are variables.
    pub(super) fn seeded<const N: usize>(&self, seeds: Seeds<'_, N>) -> Result<Builder<Dual<f64, N>>, Error> {
        let mut builder = self.over(|parameters| seeds.parameters(parameters))?;
        let (t, mut q, mut v) = builder.state.unwrap_or_else(|| builder.mechanism.declared_start());
        seeds.start(&mut q, &mut v);
        builder.state = Some((t, q, v));
        Ok(builder)
    }
}

impl<T: Real> Run<T> {
    /// The mechanism, with its parameters.
    pub fn mechanism(&self) -> &Live<T> {
        &self.mechanism
    }

    /// The positions that are integrated, in the order of [`Info::states`](mbs_runtime::Info::states). See the example
    /// of [`at`](Self::at).
    pub fn q(&self) -> &[T] {
        &self.q
    }

    /// The velocities that are integrated. See the example of [`at`](Self::at).
    pub fn v(&self) -> &[T] {
        &self.v
    }

    /// The present time in s, and the positions and velocities that are integrated.
    ///
    /// # Example
    /// ```
    /// use mbs_live::{Run, Text};
    /// use mbs_runtime::System;
    /// use mbs_runtime::equations::Equations;
    ///
    /// let text = "Fall { dof = 1; gravity = (0, -9.81) [m/s^2]; body ball (y) { mass = 1 [kg]; } }";
    /// let ball = Text::declaration("fall.mbs", text).compile()?;
    /// let mut run = Run::builder(&ball, 1e-3).build()?;
    /// run.advance(1000)?;
    /// assert!((run.q()[0] + 0.5 * 9.81).abs() < 1e-12 && (run.v()[0] + 9.81).abs() < 1e-12);
    /// // what it has fallen became speed
    /// let energy = run.mechanism().kinetic_energy(run.at());
    /// assert!((energy - 9.81 * 0.5 * 9.81).abs() < 1e-10);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn at(&self) -> At<'_, T> {
        At { t: self.t, q: &self.q, v: &self.v }
    }

    /// The outputs of the present state, in SI units and in the order of [`Info::outputs`](mbs_runtime::Info::outputs).
    ///
    /// # Errors
    /// As those of a [`Simulation`](mbs_runtime::Simulation).
    ///
    /// # Example
    /// ```
    /// use mbs_live::{Run, Text};
    ///
    /// let text = "Hook {
    ///     dof = 0;
    ///     gravity = (0, -9.81) [m/s^2];
    ///     body weight (y) { mass = 2 [kg]; }
    ///     constraint hook: y = 0;
    ///     output load [N] = lambda(hook);
    /// }";
    /// let weight = Text::declaration("hook.mbs", text).compile()?;
    /// let outputs = Run::builder(&weight, 1e-3).build()?.measured()?;
    /// // M q̈ + Φ_qᵀ λ = Q
    /// assert!((outputs[0] + 2.0 * 9.81).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn measured(&self) -> Result<Vec<T>, Error> {
        let info = self.mechanism.declared_info();
        let [mut a, mut multipliers, mut outputs] =
            [info.coordinates.len(), info.constraints.len(), info.outputs.len()].map(|n| vec![T::ZERO; n]);
        self.reactions(&mut a, &mut multipliers)?;
        self.outputs(&a, &multipliers, &mut outputs)?;
        Ok(outputs)
    }
}
