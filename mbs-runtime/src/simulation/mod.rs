//! A mechanism in motion.

mod builder;
pub(crate) mod clock;
mod on_slices;
#[cfg(feature = "std")]
mod reverse;
mod steps;
mod system;

pub use self::builder::Builder;
pub(crate) use self::on_slices::{press, pushed, struck};

use crate::components::sum_of;
use crate::equations::measured;
use crate::mechanism::growth_limit;
use crate::run::check_outputs;
use crate::watch::{Watch, WorstPlace};
use crate::{Baumgarte, Components, Error, Gains, Held, Mechanism, Method, Reactions, Real, State};

/// A mechanism being integrated in time.
///
/// # Example
/// ```
/// use mbs_runtime::{Simulation, mechanism};
///
/// mechanism! {
///     /// A weight on a massless rod.
///     pub Pendulum {
///         dof = 1;
///         param length = 1 [m];
///         gravity = (0, -9.81) [m/s^2];
///         body bob (x, y) { mass = 2 [kg]; }
///         constraint rod: x^2 + y^2 = length^2;
///         start { x = length; guess y = 0; }
///     }
/// }
///
/// let mut swing = Simulation::new(Pendulum::declared(), 1e-3)?;
/// swing.advance_to(0.5)?;
/// assert!(swing.state().q.y < 0.0);
/// assert_eq!(swing.time(), swing.steps() as f64 * swing.step_size());
/// # Ok::<(), mbs_runtime::Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Simulation<M: Mechanism, X: Method = Held<<M as Mechanism>::Scheme>> {
    mechanism: M,
    inputs: M::Inputs,
    state: State<M::States>,
    baumgarte: Baumgarte<X>,
    gains: Gains<M::Real>,
    step: M::Real,
    start_time: M::Real,
    /// How many steps were taken. Every step multiplies this number with its length, so it is a
    /// float; an integer would have to be converted.
    steps: f64,
    watch: Watch<M::Real>,
}

impl<M: Mechanism> Simulation<M> {
    /// Starts at the declared start, made consistent, with steps of `step` seconds of the
    /// declared scheme and deadbeat feedback held over each step.
    ///
    /// # Errors
    /// As [`Builder::build`].
    pub fn new(mechanism: M, step: f64) -> Result<Self, Error> {
        Self::builder(mechanism, step).build()
    }

    /// Choices to make before the start.
    pub fn builder(mechanism: M, step: f64) -> Builder<M> {
        Builder::new(mechanism, step)
    }
}

impl<M: Mechanism, X: Method> Simulation<M, X> {
    /// Time, positions and velocities of all coordinates.
    #[inline]
    pub fn state(&self) -> State<M::Coordinates> {
        self.mechanism.complete(&self.state)
    }

    /// Time, positions and velocities of the coordinates that are integrated.
    #[inline]
    pub fn integrated(&self) -> &State<M::States> {
        &self.state
    }

    /// Time in s.
    #[inline]
    pub fn time(&self) -> M::Real {
        self.state.t
    }

    /// The step in s.
    pub fn step_size(&self) -> M::Real {
        self.step
    }

    /// The time of the start in s.
    pub(crate) fn start_time(&self) -> M::Real {
        self.start_time
    }

    /// The same run, that many steps after its start.
    pub(crate) fn moved_to(
        &self,
        (state, inputs): (State<M::States>, M::Inputs),
        steps: u64,
        watch: Watch<M::Real>,
    ) -> Self {
        Self { state, inputs, steps: steps as f64, watch, ..*self }
    }

    pub(crate) fn watch(&self) -> &Watch<M::Real> {
        &self.watch
    }

    /// Steps taken since the start.
    pub fn steps(&self) -> u64 {
        self.steps as u64
    }

    /// The mechanism.
    pub fn mechanism(&self) -> &M {
        &self.mechanism
    }

    /// The feedback.
    pub fn baumgarte(&self) -> &Baumgarte<X> {
        &self.baumgarte
    }

    /// The inputs as they are now.
    pub fn inputs(&self) -> &M::Inputs {
        &self.inputs
    }

    /// The inputs, to be set before a step; they are held over it.
    pub fn inputs_mut(&mut self) -> &mut M::Inputs {
        &mut self.inputs
    }

    /// Constraint violation ‖Φ‖, the Euclidean norm.
    pub fn violation(&self) -> M::Real {
        self.mechanism.phi(self.state.t, &self.state().q).norm()
    }

    /// Constraint violation in velocities ‖Φ̇‖.
    pub fn velocity_violation(&self) -> M::Real {
        self.mechanism.phi_dot(&self.state()).norm()
    }

    /// The largest pivot growth of a step so far, all stages added; 0 before the first.
    ///
    /// In a healthy position every pivot adds about 2. Where a mechanism comes close to a
    /// singular position it is the factor by which rounding errors are magnified; see
    /// [`digits_left`](Self::digits_left) and [`worst_place`](Self::worst_place).
    ///
    /// # Example
    /// Both stages of a step with Heun's method divide by the cosine of the angle of the rod:
    /// ```
    /// # use mbs_runtime::{Simulation, mechanism};
    /// # mechanism! {
    /// #     pub SliderCrank {
    /// #         dof = 0;
    /// #         const crank = 1 [m];
    /// #         const rod = 1.25 [m];
    /// #         body wheel (angle = phi) { inertia = 1 [kg*m^2]; }
    /// #         body link (angle = psi) { inertia = 1 [kg*m^2]; }
    /// #         body slider (x) { mass = 1 [kg]; }
    /// #         constraint guide: crank*sin(phi) + rod*sin(psi) = 0;
    /// #         constraint pin: x = crank*cos(phi) + rod*cos(psi);
    /// #         drive motor: phi = 1 [rad/s]*t;
    /// #         start { guess x = 2 [m]; }
    /// #     }
    /// # }
    /// let mut run = Simulation::new(SliderCrank::declared(), 0.01)?;
    /// run.advance_to(2.0)?;
    /// // the crank is upright at 1.57 s: sin ψ = −1/1.25, cos ψ = 0.6
    /// assert!((run.worst_growth() - 2.0 / 0.6).abs() < 0.03);
    /// assert!((run.digits_left() + (f64::EPSILON * run.worst_growth()).log10()).abs() < 1e-12);
    /// # Ok::<(), mbs_runtime::Error>(())
    /// ```
    pub fn worst_growth(&self) -> M::Real {
        self.watch.worst
    }

    /// The decimal digits that the worst step so far had in its accelerations,
    /// −log₁₀(ε · [`worst_growth`](Self::worst_growth)): 15 in `f64` and 6 in `f32` while
    /// positions are healthy. An error comes below 3.
    ///
    /// # Example
    /// ```
    /// # use mbs_runtime::{Simulation, mechanism};
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
    /// let mut swing = Simulation::new(Pendulum::declared(), 1e-3)?;
    /// swing.advance_to(0.5)?;
    /// assert!(swing.digits_left() > 14.0 && swing.worst_place().is_none());
    /// # Ok::<(), mbs_runtime::Error>(())
    /// ```
    pub fn digits_left(&self) -> f64 {
        self.watch.digits_left()
    }

    /// When and where the run came closest to a singular position; nothing as long as
    /// every growth was below 64, which costs less than two digits.
    ///
    /// The place is remembered when the growth has doubled since the last one, so that
    /// it is that of a step with at least half of [`worst_growth`](Self::worst_growth).
    pub fn worst_place(&self) -> Option<WorstPlace> {
        self.watch.worst_place(M::INFO)
    }

    /// Kinetic plus potential energy in J.
    pub fn energy(&self) -> M::Real {
        let state = self.state();
        self.mechanism.kinetic_energy(&state) + self.mechanism.potential_energy(&state)
    }

    /// q̈ and λ of the present state, from the right-hand side *without*
    /// feedback terms: the forces that the mechanism feels.
    ///
    /// # Errors
    /// [`Error::Singular`], [`Error::Input`], [`Error::NonFinite`] of an acceleration,
    /// [`Error::Undefined`] of a multiplier.
    #[inline]
    pub fn reactions(&self) -> Result<Reactions<M::Coordinates, M::Constraints>, Error> {
        self.reactions_with(&M::Constraints::splat(M::Real::default()))
    }

    /// q̈ and λ of the present state with the feedback terms left in, as the
    /// first stage of a step sees them.
    ///
    /// # Example
    /// At rest beside the rod there is nothing to feel, but a violation Φ to remove:
    /// ```
    /// # use mbs_runtime::{Simulation, mechanism};
    /// # mechanism! {
    /// #     pub Pendulum {
    /// #         dof = 1;
    /// #         body bob (x, y) { mass = 2 [kg]; }
    /// #         constraint rod: x^2 + y^2 = 1 [m^2];
    /// #         start { y = 0; guess x = 1.001 [m]; }
    /// #     }
    /// # }
    /// let rest = Simulation::builder(Pendulum::declared(), 1e-3).as_declared().build()?;
    /// assert_eq!(rest.reactions()?.acceleration.x, 0.0);
    /// // 2x ẍ = −β²Φ
    /// let beta = rest.baumgarte().beta();
    /// let expected = -beta * beta * rest.violation() / (2.0 * 1.001);
    /// assert!((rest.raw_reactions()?.acceleration.x - expected).abs() < 1e-9);
    /// # Ok::<(), mbs_runtime::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`reactions`](Self::reactions).
    pub fn raw_reactions(&self) -> Result<Reactions<M::Coordinates, M::Constraints>, Error> {
        let feedback = self.mechanism.stabilized(&self.state, &self.inputs, &self.gains).feedback;
        self.reactions_with(&feedback)
    }

    #[inline]
    fn reactions_with(
        &self,
        feedback: &M::Constraints,
    ) -> Result<Reactions<M::Coordinates, M::Constraints>, Error> {
        let mut solved = self.mechanism.reactions(&self.state(), &self.inputs, feedback);
        press(&self.mechanism, &self.state(), &self.inputs, &mut solved);
        let sum = sum_of(solved.acceleration) + sum_of(solved.multipliers);
        if sum.is_finite() && solved.growth < growth_limit() {
            return Ok(solved);
        }
        self.examine(solved.acceleration, solved.multipliers, solved.growth).map(|()| solved)
    }

    /// The declared outputs in the present state.
    ///
    /// # Errors
    /// [`Error::Undefined`] if one of them is not finite, else as
    /// [`reactions`](Self::reactions).
    #[inline]
    pub fn outputs(&self) -> Result<M::Outputs, Error> {
        let reactions = self.reactions()?;
        let outputs = measured(&self.mechanism, &self.state(), &self.inputs, &reactions);
        self.check_outputs(outputs).map(|()| outputs)
    }

    /// Refuses outputs that are not finite.
    #[inline]
    pub(crate) fn check_outputs(&self, outputs: M::Outputs) -> Result<(), Error> {
        if sum_of(outputs).is_finite() {
            return Ok(());
        }
        check_outputs(M::INFO, self.state.t, outputs.into_array().as_ref())
    }
}
