//! A mechanism in motion, whatever it was made from.
//!
//! `System` is for runs as `Equations` is for mechanisms: names, parameters, state, steps, reactions,
//! outputs, energies and points, for a type or for a text.

use crate::equations::{At, Equations};
use crate::watch::WorstPlace;
use crate::{Derivation, Effort, Error, Event, Real, Sketch};

/// A mechanism in motion as tools see it: a [`Simulation`](crate::Simulation) of a type that the compiler
/// knew, or a run of a mechanism that was read from a text. `T` is its scalar: `f64`, or a
/// [`Dual`](crate::Dual) for derivatives.
///
/// The trait is object-safe, and vectors are slices in the order of
/// [`Info`](crate::Info): `q`, `v` and `acceleration` have a number per coordinate,
/// `multipliers` one per constraint, `inputs` and `outputs` one for each of theirs,
/// `points` two for each point. Results from slices of other lengths mean nothing. SI
/// units, angles in rad. No method panics.
///
/// # Example
/// ```
/// use mbs_runtime::{Simulation, System, mechanism};
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
/// fn lowest(run: &mut dyn System, end: f64) -> Result<f64, mbs_runtime::Error> {
///     let n = run.equations().info().coordinates.len();
///     let (mut q, mut v, mut lowest) = (vec![0.0; n], vec![0.0; n], f64::INFINITY);
///     for _ in 0..run.steps_to(end)? {
///         run.step()?;
///         run.state(&mut q, &mut v);
///         lowest = lowest.min(q[1]);
///     }
///     Ok(lowest)
/// }
/// let mut swing = Simulation::new(Pendulum::declared(), 1e-3)?;
/// assert!((lowest(&mut swing, 1.0)? + 1.0).abs() < 1e-5);
/// # Ok::<(), mbs_runtime::Error>(())
/// ```
pub trait System<T: Real = f64>: Send {
    /// The equations, outputs, energies and points of the mechanism, in any state.
    fn equations(&self) -> &dyn Equations<T>;

    /// The equations and their elimination, for people to read.
    fn derivation(&self) -> &Derivation;

    /// The picture of the mechanism.
    fn sketch(&self) -> &Sketch;

    /// Writes the parameters that it was made with.
    fn parameters(&self, parameters: &mut [T]) {
        self.equations().parameters(parameters);
    }

    /// Time in s.
    fn time(&self) -> T;

    /// Writes positions and velocities.
    fn state(&self, q: &mut [T], v: &mut [T]);

    /// Writes the inputs as they are now.
    fn inputs(&self, inputs: &mut [T]);

    /// Sets the inputs, which are held over the steps that follow.
    fn set_inputs(&mut self, inputs: &[T]);

    /// The step in s.
    fn step_size(&self) -> T;

    /// Steps taken since the start.
    fn steps(&self) -> u64;

    /// How many steps lead to less than half a step before or behind `end` seconds.
    ///
    /// # Errors
    /// [`Error::EndTime`], [`Error::Time`].
    fn steps_to(&self, end: f64) -> Result<u64, Error>;

    /// Says that the run ends at `end` seconds, and tells how many steps lead there.
    ///
    /// A run to a tolerance ends one of its own steps there, and its last sample is at that time, however
    /// near the one before it is. One with a constant step ends as [`steps_to`](Self::steps_to) says.
    ///
    /// # Errors
    /// As [`steps_to`](Self::steps_to).
    fn ends_at(&mut self, end: f64) -> Result<u64, Error> {
        self.steps_to(end)
    }

    /// Advances by one step.
    ///
    /// # Errors
    /// As [`Simulation::step`](crate::Simulation::step); the state stays that of the last good step.
    fn step(&mut self) -> Result<(), Error>;

    /// Advances to the next event if there is one before the end of the step, and by a step
    /// otherwise. Runs with a constant step find no events.
    ///
    /// # Errors
    /// As [`step`](Self::step).
    fn step_to_event(&mut self) -> Result<Option<Event>, Error> {
        self.step().map(|()| None)
    }

    /// Advances by some steps.
    ///
    /// # Errors
    /// As [`step`](Self::step); the state stays that of the last good step.
    fn advance(&mut self, steps: u64) -> Result<(), Error> {
        (0..steps).try_for_each(|_| self.step())
    }

    /// Writes q̈ and λ of the present state, without feedback terms.
    ///
    /// # Errors
    /// As [`Simulation::reactions`](crate::Simulation::reactions).
    fn reactions(&self, acceleration: &mut [T], multipliers: &mut [T]) -> Result<(), Error>;

    /// Writes what the declaration measures, given q̈ and λ of the present state.
    ///
    /// # Errors
    /// [`Error::Undefined`] if one of them is not finite; all are written.
    fn outputs(&self, acceleration: &[T], multipliers: &[T], outputs: &mut [T]) -> Result<(), Error>;

    /// ‖Φ‖ and ‖Φ̇‖, the Euclidean norms.
    fn violations(&self) -> [T; 2];

    /// Kinetic and potential energy in J, of another state of the mechanism too.
    fn energies(&self, at: At<'_, T>) -> [T; 2] {
        let mechanism = self.equations();
        [mechanism.kinetic_energy(at), mechanism.potential_energy(at)]
    }

    /// Writes x and y of every point of the [sketch](Self::sketch) in m, one after the
    /// other.
    fn points(&self, t: T, q: &[T], points: &mut [T]) {
        self.equations().points(t, q, points);
    }

    /// The steps of a run to a tolerance, of which [`steps`](Self::steps) counts the samples;
    /// nothing of one with a constant step.
    fn effort(&self) -> Option<Effort> {
        None
    }

    /// The largest pivot growth so far; see [`Simulation::worst_growth`](crate::Simulation::worst_growth).
    fn worst_growth(&self) -> T;

    /// Where it was; see [`Simulation::worst_place`](crate::Simulation::worst_place).
    fn worst_place(&self) -> Option<WorstPlace>;

    /// The digits that it left; see [`Simulation::digits_left`](crate::Simulation::digits_left).
    fn digits_left(&self) -> f64;
}

/// A [`System`] that can be copied while its type is not known, so that a run in the loop of another program is saved
/// and gone back to.
///
/// # Example
/// ```
/// use mbs_runtime::{Simulation, SystemClone, mechanism};
/// # mechanism! {
/// #     pub Fall {
/// #         dof = 1;
/// #         gravity = (0, -9.81) [m/s^2];
/// #         body ball (y) { mass = 1 [kg]; }
/// #     }
/// # }
/// let mut run: Box<dyn SystemClone> = Box::new(Simulation::new(Fall::declared(), 1e-3)?);
/// run.advance(100)?;
/// let mut saved = run.boxed_clone();
/// run.advance(20)?;
/// saved.advance(20)?;
/// let y = |run: &dyn SystemClone| {
///     let (mut y, mut v) = ([0.0], [0.0]);
///     run.state(&mut y, &mut v);
///     y[0]
/// };
/// assert_eq!(y(&*run), y(&*saved));
/// # Ok::<(), mbs_runtime::Error>(())
/// ```
#[cfg(feature = "std")]
pub trait SystemClone<T: Real = f64>: System<T> {
    /// A copy, which goes on by itself: to the same bits.
    fn boxed_clone(&self) -> std::boxed::Box<dyn SystemClone<T>>;
}

#[cfg(feature = "std")]
impl<T: Real, S: System<T> + Clone + 'static> SystemClone<T> for S {
    fn boxed_clone(&self) -> std::boxed::Box<dyn SystemClone<T>> {
        std::boxed::Box::new(self.clone())
    }
}
