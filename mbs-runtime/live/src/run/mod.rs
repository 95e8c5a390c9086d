//! A live mechanism in motion.

mod clocks;
mod derivatives;
mod pack;
mod reverse;
mod stops;

pub use pack::Pack;

use mbs_codegen::FunctionId;
use mbs_runtime::equations::{self, At, Equations, Preparation, Room, Start, Watch, press};
use mbs_runtime::{
    Adaptive, AdaptiveBuilder, Baumgarte, Error, Explicit, Gains, Held, Method, Projected, Real,
};

use crate::arguments::Arguments;
use crate::equations::{single, state};
use crate::{Live, Prepared, Stepper};

/// A live mechanism being integrated in time; what one does with it is [`System`](mbs_runtime::System). `T` is its
/// scalar: `f64`, or by [`over`](Builder::over) a [`Dual`](mbs_runtime::Dual) for derivatives.
///
/// # Example
/// ```
/// use mbs_live::{Run, Text};
/// use mbs_runtime::System;
///
/// let text = "Pendulum {
///     dof = 1;
///     param length = 1 [m];
///     gravity = (0, -9.81) [m/s^2];
///     body bob (x, y) { mass = 2 [kg]; }
///     constraint rod: x^2 + y^2 = length^2;
///     start { x = length; guess y = 0; }
/// }";
/// let pendulum = Text::declaration("pendulum.mbs", text).compile()?;
/// let mut swing = Run::builder(&pendulum, 1e-3).build()?;
/// swing.advance(500)?;
/// let (mut q, mut v) = ([0.0; 2], [0.0; 2]);
/// swing.state(&mut q, &mut v);
/// assert!(q[1] < -0.8);
///
/// // A copy goes on by itself from the same state, which it thereby saves.
/// let saved = swing.clone();
/// swing.step()?;
/// assert!(saved.steps() == 500 && swing.steps() == 501);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone)]
pub struct Run<T = f64> {
    mechanism: Live<T>,
    gains: Gains<T>,
    method: Explicit,
    keeps_constraints: bool,
    inputs: Vec<T>,
    step: T,
    start_time: T,
    steps: u64,
    t: T,
    /// The coordinates that are integrated, and their velocities.
    q: Vec<T>,
    v: Vec<T>,
    /// The number of multipliers.
    multipliers: usize,
    watch: Watch<T>,
    stepper: Stepper<T>,
    room: Vec<T>,
}

/// The choices before a run starts; see [`Run::builder`].
///
/// # Example
/// A cart of 2 kg, pushed by the input `push`:
/// ```
/// use mbs_live::{Run, Text};
/// use mbs_runtime::equations::At;
/// use mbs_runtime::{Explicit, RK4, System};
/// # let text = "Cart {
/// #     dof = 1;
/// #     input push [N];
/// #     body cart (x) { mass = 2 [kg]; }
/// #     force pushed on x = push;
/// # }";
///
/// let cart = Text::declaration("cart.mbs", text).compile()?;
/// let mut run = Run::builder(&cart, 1e-2)
///     .method(Explicit::held(&RK4))
///     .inputs(&[6.0])
///     .from_state(At { t: 1.0, q: &[0.0], v: &[2.0] })
///     .build()?;
/// run.advance(100)?;
/// // x = v t + a t²/2
/// assert!(run.time() == 2.0 && (run.q()[0] - 3.5).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Builder<T = f64> {
    mechanism: Live<T>,
    step: f64,
    method: Explicit,
    /// α and β in 1/s
    gains: [f64; 2],
    inputs: Vec<T>,
    state: Option<(T, Vec<T>, Vec<T>)>,
    steps_taken: u64,
    start: Start,
    allow_unstable: bool,
}

/// The run as the core sees it. No method, because it borrows some of the fields while
/// others change.
macro_rules! on_slices {
    ($run:ident) => {
        equations::Run {
            equations: &$run.mechanism,
            at: At { t: $run.t, q: &$run.q, v: &$run.v },
            inputs: &$run.inputs,
            gains: $run.gains,
            step: $run.step,
            method: $run.method,
            keeps_constraints: $run.keeps_constraints,
        }
    };
}

// behind the macro that it uses
mod system;

impl<T: Real> Run<T> {
    /// Choices to make before the start. Without any: the declared start, made consistent,
    /// steps of `step` seconds of the declared scheme, deadbeat feedback held over each step,
    /// inputs at their declared values. See the examples of [`Run`] and [`Builder`].
    pub fn builder(mechanism: &Live<T>, step: f64) -> Builder<T> {
        let method = Explicit::held(mechanism.declared_scheme());
        let inputs = mechanism.declared_info().inputs.iter();
        Builder {
            mechanism: mechanism.clone(),
            step,
            method,
            gains: method.deadbeat(step),
            inputs: inputs.map(|input| T::from_f64(input.default)).collect(),
            state: None,
            steps_taken: 0,
            start: Start::Declared,
            allow_unstable: false,
        }
    }

    /// Choices to make before a run to a tolerance starts, whose steps are as long as their error
    /// permits.
    ///
    /// # Example
    /// ```
    /// use mbs_live::{Run, Text};
    /// use mbs_runtime::{Dop853, Sampled, System, Tolerances};
    ///
    /// let text = "Oscillator {
    ///     dof = 1;
    ///     body mass (x) { mass = 1 [kg]; }
    ///     force spring on x = -4 [N/m]*x;
    ///     start { x = 1 [m]; }
    /// }";
    /// let oscillator = Text::declaration("oscillator.mbs", text).compile()?;
    /// let tolerances = Tolerances { rtol: 1e-10, atol: 1e-12, ..Tolerances::default() };
    /// let run = Run::adaptive(&oscillator).scheme::<Dop853>().tolerances(tolerances).build()?;
    /// let mut samples = Sampled::new(run, 0.1)?;
    /// samples.advance(10)?;
    /// let (mut x, mut v) = ([0.0], [0.0]);
    /// samples.state(&mut x, &mut v);
    /// assert!((x[0] - 2.0_f64.cos()).abs() < 1e-8);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn adaptive(mechanism: &Live<T>) -> AdaptiveBuilder<Prepared<T>> {
        Adaptive::builder(Prepared::new(mechanism))
    }

    /// The state of the coordinates that are integrated.
    fn states(&self) -> At<'_, T> {
        At { t: self.t, q: &self.q, v: &self.v }
    }

    /// All coordinates and velocities.
    fn completed(&self) -> [Vec<T>; 2] {
        let mut all =
            [(); 2].map(|()| vec![T::from_f64(f64::NAN); self.mechanism.declared_info().coordinates.len()]);
        let [q, v] = &mut all;
        self.mechanism.complete(self.states(), q, v);
        all
    }

    /// Writes q̈ and λ of the present state with the feedback terms left in, as the first
    /// stage of a step sees them.
    ///
    /// # Errors
    /// As [`System::reactions`](mbs_runtime::System::reactions).
    ///
    /// # Example
    /// ```
    /// use mbs_live::{Run, Text};
    /// use mbs_runtime::System;
    ///
    /// // 1 cm beside its constraint
    /// let text = "Clamped {
    ///     dof = 0;
    ///     body block (x) { mass = 2 [kg]; }
    ///     constraint clamp: x = 0;
    ///     start { guess x = 1 [cm]; }
    /// }";
    /// let block = Text::declaration("clamped.mbs", text).compile()?;
    /// let run = Run::builder(&block, 1e-3).gains([100.0, 50.0]).as_declared().build()?;
    /// let (mut a, mut lambda) = ([0.0], [0.0]);
    /// run.raw_reactions(&mut a, &mut lambda)?;
    /// // q̈ = −β² x, and λ = −m q̈
    /// assert!((a[0] + 25.0).abs() < 1e-12 && (lambda[0] - 50.0).abs() < 1e-12);
    /// run.reactions(&mut a, &mut lambda)?;
    /// assert!(lambda[0].abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn raw_reactions(&self, acceleration: &mut [T], multipliers: &mut [T]) -> Result<(), Error> {
        let mut feedback = vec![T::from_f64(f64::NAN); self.multipliers];
        let mut unread = vec![T::from_f64(f64::NAN); self.q.len()];
        self.mechanism.stabilized(self.states(), &self.inputs, &self.gains, &mut unread, &mut feedback);
        self.reactions_with(&feedback, acceleration, multipliers)
    }

    fn reactions_with(
        &self,
        feedback: &[T],
        acceleration: &mut [T],
        multipliers: &mut [T],
    ) -> Result<(), Error> {
        let [q, v] = self.completed();
        let at = At { t: self.t, q: &q, v: &v };
        let arguments = Arguments { inputs: single(&self.inputs), feedback: single(feedback), ..state(at) };
        let mut growth = [T::from_f64(f64::NAN)];
        self.mechanism.call(
            FunctionId::Reactions,
            &arguments,
            [&mut *acceleration, &mut *multipliers, &mut growth],
        );
        growth[0] = growth[0] + press(&self.mechanism, at, &self.inputs, acceleration, Some(multipliers));
        on_slices!(self).examine(&q, acceleration, multipliers, growth[0])
    }
}

/// As many numbers as there are in both.
fn copy<T: Copy>(to: &mut [T], from: &[T]) {
    to.iter_mut().zip(from).for_each(|(to, from)| *to = *from);
}

impl<T: Real> Builder<T> {
    /// The method of integration, with the gains that are deadbeat for it. See the example of [`Builder`].
    #[must_use]
    pub fn method(self, method: Explicit) -> Self {
        Self { method, gains: method.deadbeat(self.step), ..self }
    }

    /// Feedback of the constraint violation with these gains α and β in 1/s. See the example of
    /// [`allow_unstable`](Self::allow_unstable).
    #[must_use]
    pub fn gains(self, gains: [f64; 2]) -> Self {
        Self { gains, ..self }
    }

    /// Feedback of the constraint violation, and the method that its gains belong to.
    ///
    /// # Example
    /// ```
    /// use mbs_live::{Run, Text};
    /// use mbs_runtime::{Baumgarte, PerStage, Rk4, System};
    ///
    /// let text = "Oscillator {
    ///     dof = 1;
    ///     body mass (x) { mass = 1 [kg]; }
    ///     force spring on x = -4 [N/m]*x;
    ///     start { x = 1 [m]; }
    /// }";
    /// let oscillator = Text::declaration("oscillator.mbs", text).compile()?;
    /// let feedback = Baumgarte::<PerStage<Rk4>>::new(50.0, 50.0)?;
    /// let mut run = Run::builder(&oscillator, 1e-2).baumgarte(feedback).build()?;
    /// run.advance(100)?;
    /// assert!((run.q()[0] - 2.0_f64.cos()).abs() < 1e-8);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn baumgarte<X: Method>(self, baumgarte: Baumgarte<X>) -> Self {
        self.method(X::EXPLICIT).gains([baumgarte.alpha(), baumgarte.beta()])
    }

    /// Starts at `t` seconds from positions and velocities of all coordinates, which have to be consistent. See the
    /// example of [`Builder`].
    #[must_use]
    pub fn from_state(mut self, at: At<'_, T>) -> Self {
        self.state = Some((at.t, at.q.to_vec(), at.v.to_vec()));
        if self.start == Start::Declared {
            self.start = Start::Given;
        }
        self
    }

    /// Goes on with a run that has taken so many steps. The given state is that at t + n·h, where t is the time at
    /// which that run started.
    ///
    /// # Example
    /// A run that another process goes on with, to the same bits:
    /// ```
    /// use mbs_live::{Run, Text};
    /// use mbs_runtime::System;
    /// use mbs_runtime::equations::At;
    ///
    /// let text = "Fall { dof = 1; gravity = (0, -9.81) [m/s^2]; body ball (y) { mass = 1 [kg]; } }";
    /// let ball = Text::declaration("fall.mbs", text).compile()?;
    /// let mut run = Run::builder(&ball, 1e-3).build()?;
    /// run.advance(77)?;
    /// let (mut y, mut v) = ([0.0], [0.0]);
    /// run.state(&mut y, &mut v);
    /// let started = At { t: 0.0, q: &y, v: &v };
    /// let mut other = Run::builder(&ball, 1e-3).from_state(started).steps_taken(77).build()?;
    /// run.step()?;
    /// other.step()?;
    /// assert_eq!((run.time(), run.steps()), (other.time(), other.steps()));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn steps_taken(self, steps_taken: u64) -> Self {
        Self { steps_taken, ..self }
    }

    /// Keeps the start as it is, consistent or not. See the example of [`raw_reactions`](Run::raw_reactions).
    #[must_use]
    pub fn as_declared(mut self) -> Self {
        self.start = Start::Unchecked;
        self
    }

    /// The inputs of the first step, one number each in SI units. See the example of [`Builder`].
    #[must_use]
    pub fn inputs(mut self, inputs: &[T]) -> Self {
        self.inputs.iter_mut().zip(inputs).for_each(|(input, value)| *input = *value);
        self
    }

    /// Accepts gains under which violations grow, for the study of them.
    ///
    /// # Example
    /// ```
    /// use mbs_live::{Run, Text};
    /// use mbs_runtime::Error;
    ///
    /// let text = "Slider { dof = 1; body block (x, y) { mass = 1 [kg]; } constraint floor: y = 0; }";
    /// let slider = Text::declaration("slider.mbs", text).compile()?;
    /// // with steps of 1 ms, 750/s and 1000/s remove a violation; ten times these gains make it grow
    /// let builder = || Run::builder(&slider, 1e-3).gains([7500.0, 10_000.0]);
    /// assert!(matches!(builder().build(), Err(Error::UnstableGains { .. })));
    /// assert!(builder().allow_unstable().build().is_ok());
    /// # Ok::<(), mbs_live::Error>(())
    /// ```
    #[must_use]
    pub fn allow_unstable(mut self) -> Self {
        self.allow_unstable = true;
        self
    }

    /// Starts the run. See the example of [`Builder`].
    ///
    /// # Errors
    /// As the builder of a [`Simulation`](mbs_runtime::Simulation).
    pub fn build(self) -> Result<Run<T>, Error> {
        let Self { mechanism, step, method, gains, inputs, state, steps_taken, start, allow_unstable } = self;
        // as the scalar holds it
        let h = T::from_f64(step);
        if !(h > T::ZERO && h.is_finite()) {
            return Err(Error::Step { step });
        }
        let [alpha, beta] = gains;
        // what a gain may be does not depend on the method
        let baumgarte = Baumgarte::<Held>::new(alpha, beta)?;
        if method.is_projected() {
            Baumgarte::<Projected>::new(alpha, beta)?;
        }
        let keeps_constraints = method.is_stable(gains, step);
        if !allow_unstable && !keeps_constraints {
            return Err(Error::UnstableGains { alpha, beta, step, feedback: method.stabilization.word() });
        }
        let info = mechanism.declared_info();
        let (start_time, mut q, mut v) = state.unwrap_or_else(|| mechanism.declared_start());
        let t = start_time + T::from_f64(steps_taken as f64) * h;
        [&mut q, &mut v]
            .into_iter()
            .for_each(|all| all.resize(info.coordinates.len(), T::from_f64(f64::NAN)));
        let mut numbers = vec![T::ZERO; Room::<T>::len(info, method.tableau.stage_count())];
        let mut room = Room::within(&mut numbers, info);
        let preparation = Preparation { start, inputs: &inputs, step: h, keeps_constraints };
        let length = preparation.prepare(&mechanism, t, &mut q, &mut v, &mut room)?;
        let mut states = [(); 2].map(|()| vec![T::ZERO; info.states.len()]);
        states.iter_mut().zip([&q, &v]).for_each(|(states, all)| mechanism.states(all, states));
        let [q, v] = states;
        let mut run = Run {
            gains: baumgarte.gains(),
            method,
            keeps_constraints,
            inputs,
            step: h,
            start_time,
            steps: steps_taken,
            t,
            q,
            v,
            multipliers: info.constraints.len(),
            watch: Watch::new(length),
            stepper: Stepper::new(&mechanism, method),
            room: numbers,
            mechanism,
        };
        run.grid().check(&run.mechanism)?;
        if steps_taken == 0 {
            run.touch()?;
            run.sample();
        }
        Ok(run)
    }
}
