//! Runs to a tolerance: steps as long as an estimate of their error permits.
//!
//! # How it works
//! * `dynamics` is a mechanism as these runs see it.
//! * `scheme` has the stages of a step. `attempt` takes it and estimates its error. `control` chooses the
//!   next length.
//! * `dense` has the motion within a step, `within` the state there. `crossing` looks through it for events, and
//!   `ending` ends a step at one. `stops` sees where the motion hits a stop, `closing` where a gap closes, `jump`
//!   what follows.
//! * `switches` looks where laws bend or jump, `passing` at steps over several such places.
//! * `sampled` makes a `System` of a run. `cause` finds the error that ends one.

mod attempt;
mod beginning;
mod between;
mod builder;
mod cause;
mod change;
mod clocks;
mod closing;
mod control;
mod crossing;
mod dense;
mod dynamics;
mod effort;
mod ending;
mod events;
mod gaps;
mod jump;
mod margins;
mod noise;
mod passing;
mod resting;
mod sampled;
mod scheme;
mod stops;
mod switches;
mod switching;
mod transitions;
mod typed;
mod within;

use attempt::Attempt;
pub(crate) use attempt::is_healthy;
pub(crate) use beginning::Beginning;
use between::Between;
pub use builder::AdaptiveBuilder;
pub(crate) use cause::cause;
use control::Control;
pub use control::Tolerances;
pub use dense::Moment;
use dense::is_instant;
pub use dynamics::Dynamics;
pub use effort::Effort;
use events::Happened;
pub use events::{Event, MOST_EVENTS};
use gaps::Stopping;
use noise::Progress;
pub(crate) use noise::RISEN;
pub use sampled::{Measured, Sampled, Threshold};
pub use scheme::AdaptiveScheme;
pub(crate) use scheme::Sealed;
use switching::Switching;

use core::fmt;

use mbs_interface::Estimate;

use crate::diagnosis::check_inputs;
use crate::run::note_risen;
use crate::watch::{Watch, WorstPlace};
use crate::{Dopri5, Error, Real};

/// A run gives up after trying this many lengths for one step.
const TRIALS: usize = 40;
/// The error that ends a run is looked for in steps up to this many seconds.
const LONGEST: f64 = 1.0;

/// A mechanism being integrated to a tolerance.
///
/// An explicit pair of Runge–Kutta schemes, Dormand and Prince's 5(4) unless another one is asked
/// for, takes steps as long as the estimate of their error permits. The end of each step is
/// projected onto the constraints, positions and then velocities, so that there is neither drift
/// nor feedback. Between the ends of a step the motion is a polynomial of fifth degree through
/// positions, velocities and accelerations of both.
///
/// Take it where the accuracy is given and not the step, and a [`Simulation`](crate::Simulation)
/// where every step must take the same time. Explicit schemes are inefficient where a stiff
/// spring or damper forces short steps on a slow motion.
///
/// # Example
/// ```
/// use mbs_runtime::{Adaptive, Dop853, Tolerances, mechanism};
///
/// mechanism! {
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
/// // released from the side, it is at the bottom after K(1/√2)·√(l/g)
/// let bottom = 1.854074677301372 / 9.81_f64.sqrt();
/// let mut swing = Adaptive::builder(Pendulum::declared())
///     .scheme::<Dop853>()
///     .tolerances(Tolerances { rtol: 1e-10, atol: 1e-12, ..Tolerances::default() })
///     .build()?;
/// swing.advance_to(bottom)?;
/// assert!(swing.state().q.x.abs() < 1e-9 && swing.effort().steps < 20);
/// // the motion within the last step
/// let before = swing.at(bottom - 1e-3)?;
/// assert!((before.q.x / before.v.x + 1e-3).abs() < 1e-8);
/// // back within it, and on from there
/// swing.rewind_to(bottom - 1e-3)?;
/// assert!(swing.time() < bottom && swing.next_step() > 1e-3);
/// swing.advance_to(bottom)?;
/// assert!(swing.state().q.x.abs() < 1e-9);
/// # Ok::<(), mbs_runtime::Error>(())
/// ```
///
/// # Source
/// Hairer, Nørsett, Wanner, Solving Ordinary Differential Equations I, II.4 and II.5; Eich 1993
/// (see [`Projected`](crate::Projected)).
#[derive(Clone)]
pub struct Adaptive<D: Dynamics, S: AdaptiveScheme = Dopri5> {
    dynamics: D,
    inputs: D::Inputs,
    tolerances: Tolerances,
    most_steps: u64,
    estimate: Estimate,
    control: Control,
    /// The start of the last step, and its end.
    before: Moment<D::Real, D::States>,
    now: Moment<D::Real, D::States>,
    /// The end of the step that is tried.
    next: Moment<D::Real, D::States>,
    attempt: Attempt<D::States, S::Slopes<D::States>>,
    between: Between<S::Between<[D::States; 2]>>,
    /// Room for all coordinates and velocities.
    all: [D::Coordinates; 2],
    /// True if the acceleration of the present state is that of the present inputs.
    is_solved: bool,
    watch: Watch<D::Real>,
    effort: Effort,
    progress: Progress<D::Real>,
    switching: Switching,
    stopping: Stopping,
    /// When clocks sampled last.
    sampled: Option<D::Real>,
    /// Events at the present time.
    happened: Happened,
    /// Events at the start of the last step.
    happened_before: Happened,
    /// The end of the last step, where events were, before a program has set another state there.
    arrival: Moment<D::Real, D::States>,
}

impl<D: Dynamics, S: AdaptiveScheme> Adaptive<D, S> {
    /// Takes a step as long as the tolerance permits.
    ///
    /// # Errors
    /// [`Error::StepTooShort`] where no step meets the tolerance, [`Error::Singular`],
    /// [`Error::OutOfReach`], [`Error::NonFinite`], [`Error::Input`], [`Error::TooManySteps`] where a bound was
    /// asked for. The state stays that of the last good step.
    pub fn step(&mut self) -> Result<(), Error> {
        self.step_to(D::Real::from_f64(f64::INFINITY))?;
        self.look_for_stops()?;
        self.jump()?;
        self.sample(true)
    }

    /// Takes steps until `end` seconds, the last one of which ends there. It does not change how
    /// long the steps behind it are.
    ///
    /// # Errors
    /// As [`step`](Self::step), and [`Error::EndTime`] for a time that is past.
    pub fn advance_to(&mut self, end: f64) -> Result<(), Error> {
        let last = D::Real::from_f64(end);
        if !(end.is_finite() && last >= self.now.t) {
            return Err(Error::EndTime { end, now: self.now.t.to_f64() });
        }
        while self.now.t < last {
            self.step_to(last)?;
            self.look_for_stops()?;
        }
        self.jump()?;
        self.sample(false)
    }

    /// A step that ends at `limit` at the latest, and at the first corner of the accelerations. Where it is
    /// cut short, the next one is not.
    fn step_to(&mut self, limit: D::Real) -> Result<(), Error> {
        self.jump()?;
        self.sample(true)?;
        self.look_at_rests()?;
        let (next, rejected) = (self.control.next, self.effort.rejected);
        let corner = self.next_corner();
        let limit = if corner < limit { corner } else { limit };
        self.step_within(limit)?;
        self.stay();
        self.look_at_switches(self.effort.rejected != rejected)?;
        let is_cut = self.now.t >= limit && self.effort.rejected == rejected;
        if is_cut && self.control.next < next {
            self.control.next = next;
        }
        Ok(())
    }

    /// Takes steps until the last one covers `t` seconds.
    ///
    /// # Errors
    /// As [`step`](Self::step), and [`Error::EndTime`] for a time before the last step.
    pub fn cover(&mut self, t: f64) -> Result<(), Error> {
        let at = D::Real::from_f64(t);
        if !(t.is_finite() && at >= self.before.t) {
            return Err(Error::EndTime { end: t, now: self.before.t.to_f64() });
        }
        while self.now.t < at {
            self.step()?;
        }
        if at < self.now.t {
            self.look_between();
        }
        Ok(())
    }

    /// A step that ends at `limit` at the latest.
    fn step_within(&mut self, limit: D::Real) -> Result<(), Error> {
        self.solve()?;
        self.is_held_up()?;
        let t = self.now.t;
        if self.effort.steps >= self.most_steps {
            return Err(Error::TooManySteps { t: t.to_f64(), steps: self.effort.steps });
        }
        let mut is_aimed = false;
        for _ in 0..TRIALS {
            let h = D::Real::from_f64(self.next_step());
            let left = limit - t;
            // a step that would end just short of the limit is stretched to it
            let t_next = if D::Real::from_f64(1.01) * h >= left { limit } else { t + h };
            let h = (t_next - t).to_f64();
            let shortest = 4.0 * D::Real::EPSILON.to_f64() * t.to_f64().abs();
            let is_ahead = t_next > t && (t_next >= limit || h >= shortest);
            if !is_ahead {
                break;
            }
            let Self { dynamics, inputs, now, next, attempt, between, .. } = self;
            between.lose_stages();
            let growth = attempt.step::<D, S>((&*dynamics, &*inputs), now, t_next, next);
            let growth = growth.filter(|growth| is_healthy(*growth, next));
            let ratio = match growth {
                Some(_) => attempt.error(&self.estimate, &self.tolerances, now, next),
                None => f64::NAN,
            };
            self.switching.knot = None;
            let ratio = self.judged(ratio);
            // the step over a corner cannot be shorter
            let is_over_corner = t_next >= limit && is_instant(h, t.to_f64(), D::Real::EPSILON.to_f64());
            let is_good = self.control.judge(h, ratio, &self.estimate) || is_over_corner;
            if let (Some(growth), true) = (growth, is_good) {
                return self.accept(growth);
            }
            self.effort.rejected += 1;
            // where a step to a knot passes it again, one of half the length tells better where it is
            let to_knot = self.step_to_knot(h).filter(|_| S::RELAXES && growth.is_some() && !is_aimed);
            is_aimed = to_knot.is_some();
            self.control.next = to_knot.unwrap_or(self.control.next);
        }
        Err(self.cause())
    }

    /// Makes the step that was tried the last one.
    fn accept(&mut self, growth: D::Real) -> Result<(), Error> {
        let Self { dynamics, before, now, next, watch, .. } = self;
        if growth > watch.alarm || !dynamics.info().redundant.is_empty() {
            let (from, to) = (now.at(), next.at());
            dynamics.with_room::<S::Explicit>(|room| {
                note_risen(dynamics.equations(), [from, to], growth, watch, room)
            })?;
        } else {
            watch.note(growth);
        }
        core::mem::swap(before, now);
        core::mem::swap(now, next);
        (self.happened_before, self.happened) = (self.happened, Happened::default());
        self.between.begin(true);
        let h = (self.now.t - self.before.t).to_f64();
        self.effort.count(h, self.before.is_instant(&self.now));
        self.note_progress(growth);
        Ok(())
    }

    /// Sees to it that the acceleration of the present state is known.
    fn solve(&mut self) -> Result<(), Error> {
        if self.is_solved {
            return Ok(());
        }
        let h = (self.effort.steps > 0).then(|| D::Real::from_f64(self.next_step()));
        let Self { dynamics, inputs, now, attempt, .. } = self;
        dynamics.with_inputs(inputs, |inputs| check_inputs(dynamics.info(), inputs))?;
        let growth = S::begin((&*dynamics, &*inputs), h, &mut attempt.there, now);
        if !is_healthy(growth, now) {
            return Err(self.cause());
        }
        self.is_solved = true;
        Ok(())
    }

    /// Why there is no step from the present state: the error of the shortest step that has
    /// one, and that the tolerance cannot be met if none has.
    fn cause(&mut self) -> Error {
        let Self { dynamics, inputs, now, next, control, watch, .. } = self;
        // steps that only look for the error are not steps of the run
        let found = cause::<D, S::Explicit>(dynamics, inputs, now, next, *watch, LONGEST);
        let step = control.next;
        found.unwrap_or_else(|| self.too_short(step))
    }

    /// The present time in s: the end of the last step.
    pub fn time(&self) -> D::Real {
        self.now.t
    }

    /// The steps that it took so far.
    pub fn effort(&self) -> &Effort {
        &self.effort
    }

    /// How long the next step is tried to be, in s.
    pub fn next_step(&self) -> f64 {
        self.control.next.min(self.tolerances.max_step)
    }

    /// The tolerances of the run.
    pub fn tolerances(&self) -> &Tolerances {
        &self.tolerances
    }

    /// The inputs.
    pub fn inputs(&self) -> &D::Inputs {
        &self.inputs
    }

    /// The inputs, to be changed for the steps that follow.
    pub fn inputs_mut(&mut self) -> &mut D::Inputs {
        // what lies behind was computed with those of before
        self.look_between();
        self.is_solved = false;
        self.progress.go_on();
        self.switching.go_on();
        &mut self.inputs
    }

    /// The largest pivot growth of a step so far; see
    /// [`Simulation::worst_growth`](crate::Simulation::worst_growth).
    pub fn worst_growth(&self) -> D::Real {
        self.watch.worst
    }

    /// Where it was.
    pub fn worst_place(&self) -> Option<WorstPlace> {
        self.watch.worst_place(self.dynamics.info())
    }

    /// The digits that it left.
    pub fn digits_left(&self) -> f64 {
        self.watch.digits_left()
    }
}

impl<D: Dynamics, S: AdaptiveScheme> fmt::Debug for Adaptive<D, S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { now, tolerances, effort, .. } = self;
        let mut shown = f.debug_struct("Adaptive");
        shown.field("scheme", &S::WORD).field("t", &now.t).field("tolerances", tolerances);
        shown.field("effort", effort).finish_non_exhaustive()
    }
}
