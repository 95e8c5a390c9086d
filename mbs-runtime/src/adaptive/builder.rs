//! The choices before a run to a tolerance starts.

use core::marker::PhantomData;

use super::attempt::{Attempt, is_healthy};
use super::between::Between;
use super::events::Happened;
use super::gaps::Stopping;
use super::noise::Progress;
use super::switching::Switching;
use super::{Adaptive, AdaptiveScheme, Beginning, Control, Dynamics, Effort, Moment, Tolerances};
use crate::equations::Start;
use crate::vectors::assign;
use crate::watch::Watch;
use crate::{Components, Dopri5, Error, Info, Mechanism, Real, State};

/// Given states are checked as those of runs with this step, in s.
const NOMINAL_STEP: f64 = 1e-3;

/// The choices before a run to a tolerance starts; see [`Adaptive::builder`].
#[derive(Clone)]
pub struct AdaptiveBuilder<D: Dynamics, S: AdaptiveScheme = Dopri5> {
    beginning: Beginning<D>,
    tolerances: Tolerances,
    most_steps: u64,
    /// True if the samples at the start have been taken.
    goes_on: bool,
    scheme: PhantomData<S>,
}

impl<D: Dynamics> Adaptive<D> {
    /// Choices to make before the start. Without any: the declared start, made consistent, the
    /// pair 5(4) of Dormand and Prince, the default [`Tolerances`] and inputs.
    pub fn builder(mechanism: D) -> AdaptiveBuilder<D> {
        let (beginning, tolerances) = (Beginning::new(mechanism), Tolerances::default());
        AdaptiveBuilder { beginning, tolerances, most_steps: u64::MAX, goes_on: false, scheme: PhantomData }
    }
}

impl<D: Dynamics, S: AdaptiveScheme> AdaptiveBuilder<D, S> {
    /// The scheme, one with an estimate of its error: [`Bs3`](crate::Bs3) for coarse tolerances,
    /// [`Dopri5`] or [`Dop853`](crate::Dop853) for fine ones, from about 10⁻⁸ on.
    #[must_use]
    pub fn scheme<R: AdaptiveScheme>(self) -> AdaptiveBuilder<D, R> {
        let Self { beginning, tolerances, most_steps, goes_on, .. } = self;
        AdaptiveBuilder { beginning, tolerances, most_steps, goes_on, scheme: PhantomData }
    }

    /// The tolerances.
    #[must_use]
    pub fn tolerances(self, tolerances: Tolerances) -> Self {
        Self { tolerances, ..self }
    }

    /// Lets it take so many steps at most, after which it ends with [`Error::TooManySteps`].
    ///
    /// # Example
    /// ```
    /// # use mbs_runtime::{Adaptive, Error, mechanism};
    /// # mechanism! {
    /// #     pub Pendulum {
    /// #         dof = 1;
    /// #         param length = 1 [m];
    /// #         gravity = (0, -9.81) [m/s^2];
    /// #         body bob (x, y) { mass = 2 [kg]; }
    /// #         constraint rod: x^2 + y^2 = length^2;
    /// #         start { x = length; guess y = 0; }
    /// #     }
    /// # }
    /// let mut swing = Adaptive::builder(Pendulum::declared()).most_steps(5).build()?;
    /// assert!(matches!(swing.advance_to(10.0), Err(Error::TooManySteps { steps: 5, .. })));
    /// # Ok::<(), Error>(())
    /// ```
    #[must_use]
    pub fn most_steps(self, most_steps: u64) -> Self {
        Self { most_steps, ..self }
    }

    /// The inputs of the first step.
    #[must_use]
    pub fn inputs(mut self, inputs: D::Inputs) -> Self {
        self.beginning.inputs = inputs;
        self
    }

    /// Starts at `t` from positions and velocities that have to be consistent.
    #[must_use]
    pub fn from_vectors(mut self, t: D::Real, q: D::Coordinates, v: D::Coordinates) -> Self {
        (self.beginning.state, self.beginning.start) = ((t, q, v), Start::Given);
        self
    }

    /// Makes the given start consistent as a declared one is: the coordinates that the declaration
    /// gives keep their values, the others move to the constraints.
    ///
    /// # Example
    /// ```
    /// # use mbs_runtime::{Adaptive, Error, mechanism};
    /// # mechanism! {
    /// #     pub Pendulum {
    /// #         dof = 1;
    /// #         param length = 1 [m];
    /// #         gravity = (0, -9.81) [m/s^2];
    /// #         body bob (x, y) { mass = 2 [kg]; }
    /// #         constraint rod: x^2 + y^2 = length^2;
    /// #         start { x = 0.6 [m]; guess y = 0.7 [m]; }
    /// #     }
    /// # }
    /// let tilted = Adaptive::builder(Pendulum::declared()).from_vectors(0.0, [0.6, 0.7], [0.0; 2]);
    /// assert!(matches!(tilted.clone().build(), Err(Error::Inconsistent { constraint: "rod", .. })));
    /// let kept = tilted.clone().as_declared().build()?;
    /// assert_eq!(kept.state().q.y, 0.7);
    /// // the declaration gives x, and y is a guess
    /// let moved = tilted.made_consistent().build()?.state().q;
    /// assert!(moved.x == 0.6 && (moved.y - 0.8).abs() < 1e-14);
    /// # Ok::<(), Error>(())
    /// ```
    #[must_use]
    pub fn made_consistent(mut self) -> Self {
        self.beginning.start = Start::Declared;
        self
    }

    /// Keeps the start as it is, consistent or not; the first step leads to the constraints.
    #[must_use]
    pub fn as_declared(mut self) -> Self {
        self.beginning.start = Start::Unchecked;
        self
    }

    /// Goes on with a run that was at this state: its clocks have taken the samples that are due there, and the given
    /// inputs have the memories of it.
    #[must_use]
    pub fn goes_on(self) -> Self {
        Self { goes_on: true, ..self }
    }

    /// Starts.
    ///
    /// # Errors
    /// [`Error::Tolerance`], [`Error::Step`], [`Error::NoEstimate`] for a scheme that cannot tell
    /// its error, and those of the start of a [`Simulation`](crate::Simulation).
    pub fn build(self) -> Result<Adaptive<D, S>, Error> {
        let scheme = S::WORD;
        let estimate = S::ESTIMATE.ok_or(Error::NoEstimate { scheme })?;
        self.tolerances.check::<D::Real>()?;
        if S::RELAXES {
            self.beginning.dynamics.info().refuse_stops(S::WORD)?;
        }
        let Self { mut beginning, tolerances, most_steps, goes_on, .. } = self;
        let length = beginning.prepare::<S::Explicit>(NOMINAL_STEP)?;
        let Beginning { dynamics, inputs, state: (t, q, v), .. } = beginning;
        let (states, rates) = (dynamics.states(&q), dynamics.states(&v));
        let moment = Moment { t, a: states.clone(), q: states, v: rates };
        let stages = S::slopes(moment.q.clone());
        let mut atol = moment.q.clone();
        tolerances.in_units(dynamics.info(), atol.as_mut());
        let mut run = Adaptive {
            control: Control::new(tolerances.first_step.unwrap_or(0.0)),
            before: moment.clone(),
            next: moment.clone(),
            all: [q, v],
            attempt: Attempt {
                there: moment.q.clone(),
                velocities: stages.clone(),
                accelerations: stages,
                atol,
            },
            between: Between::new(S::between([moment.q.clone(), moment.q.clone()])),
            arrival: moment.clone(),
            now: moment,
            dynamics,
            inputs,
            tolerances,
            most_steps,
            estimate,
            is_solved: false,
            watch: Watch::new(length),
            effort: Effort::default(),
            progress: Progress::new(),
            switching: Switching::new(),
            stopping: Stopping::new(&tolerances),
            sampled: None,
            happened: Happened { is_set: true, ..Happened::default() },
            happened_before: Happened::default(),
        };
        run.sampled = goes_on.then_some(run.now.t);
        if !goes_on {
            run.touch()?;
        }
        run.sample_at_start();
        run.solve()?;
        run.before = run.now.clone();
        if run.tolerances.first_step.is_none() {
            run.control.next = run.first_step();
        }
        Ok(run)
    }
}

impl<M: Mechanism, S: AdaptiveScheme> AdaptiveBuilder<M, S> {
    /// Starts from a state that has to be [`check`](crate::start::check)ed for consistency.
    #[must_use]
    pub fn from_state(self, state: State<M::Coordinates>) -> Self {
        self.from_vectors(state.t, state.q.into_array(), state.v.into_array())
    }
}

impl<D: Dynamics, S: AdaptiveScheme> Adaptive<D, S> {
    /// The first step that the motion suggests: one in which Euler's method changes the state by
    /// a hundredth of what is allowed, and in which the second derivative, from a difference,
    /// lets the scheme add a hundredth of the allowed error.
    ///
    /// # Source
    /// Hairer, Nørsett, Wanner, Solving Ordinary Differential Equations I, II.4, with squares
    /// added up as in their code.
    fn first_step(&mut self) -> f64 {
        const SMALLEST: f64 = 1e-6;
        let Self { dynamics, inputs, tolerances, now, next, attempt, estimate, .. } = self;
        let size = |of: [&D::States; 2]| tolerances.size(&attempt.atol, [&now.q, &now.v], of);
        let (of_state, of_slope) = (size([&now.q, &now.v]), size([&now.v, &now.a]));
        let is_still = of_state < 1e-5 || of_slope < 1e-5;
        let first = if is_still { SMALLEST } else { 0.01 * of_state / of_slope };
        let first = first.min(tolerances.max_step);
        let h = D::Real::from_f64(first);
        assign(&mut next.q, &now.q);
        assign(&mut next.v, &now.v);
        crate::vectors::add_scaled(next.q.as_mut(), h, now.v.as_ref());
        crate::vectors::add_scaled(next.v.as_mut(), h, now.a.as_ref());
        next.t = now.t + h;
        let growth = dynamics.acceleration(next.t, &next.q, &next.v, inputs, &mut next.a);
        if !is_healthy(growth, next) {
            return first.min(SMALLEST);
        }
        // the changes of both slopes
        let of_velocities = &mut attempt.there;
        assign(of_velocities, &next.v);
        crate::vectors::add_scaled(of_velocities.as_mut(), D::Real::from_f64(-1.0), now.v.as_ref());
        crate::vectors::add_scaled(next.a.as_mut(), D::Real::from_f64(-1.0), now.a.as_ref());
        let change = tolerances.size(&attempt.atol, [&now.q, &now.v], [&attempt.there, &next.a]) / first;
        let largest = of_slope.max(change);
        let second = if largest < 1e-15 {
            SMALLEST.max(1e-3 * first)
        } else {
            Real::pow(0.01 / largest, 1.0 / f64::from(estimate.power))
        };
        second.min(100.0 * first).min(tolerances.max_step)
    }
}

impl Tolerances {
    /// Writes the absolute errors of all integrated components, in SI units.
    fn in_units<T: Real>(&self, info: &Info, atol: &mut [T]) {
        for (atol, state) in atol.iter_mut().zip(info.states) {
            let scale = info.coordinates.get(*state).map_or(1.0, |state| state.scale);
            *atol = T::from_f64(self.atol * scale);
        }
    }

    /// The root mean square of vectors, measured by what is allowed at a state.
    pub(super) fn size<T: Real, V: AsRef<[T]>>(&self, atol: &V, state: [&V; 2], vectors: [&V; 2]) -> f64 {
        let rtol = T::from_f64(self.rtol);
        let (mut sum, mut count) = (0.0, 0.0);
        for (state, vector) in state.into_iter().zip(vectors) {
            for ((state, component), atol) in state.as_ref().iter().zip(vector.as_ref()).zip(atol.as_ref()) {
                let ratio = (*component / (*atol + rtol * state.abs())).to_f64();
                sum += ratio * ratio;
                count += 1.0;
            }
        }
        if count > 0.0 { Real::sqrt(sum / count) } else { 0.0 }
    }
}
