//! Runs to a tolerance as a [`System`].
//!
//! Its `step` leads to the next sample, so recording and sweeping know nothing of tolerances.

use core::fmt;

use super::events::Watched;
use super::{Adaptive, AdaptiveScheme, Dynamics, Effort, Event, MOST_EVENTS};
use crate::equations::{At, Equations};
use crate::info::Direction;
use crate::simulation::clock;
use crate::view::View;
use crate::watch::WorstPlace;
use crate::{Derivation, Error, Real, Sketch, System, vectors};

/// A sample is at the end of a run that is nearer to it than this share of an interval.
const AT_END: f64 = 1e-6;

/// A run to a tolerance whose state is looked at on a grid of times: a [`System`] whose `step`
/// leads to the next of these times.
///
/// The grid does not shorten the steps of the run: a sample is interpolated, and projected onto the
/// constraints. The run starts anew from a sample at which inputs change, and from every event. Where it
/// [ends](System::ends_at) a step ends too.
///
/// # Example
/// ```
/// use mbs_runtime::{Adaptive, Error, Sampled, System, mechanism};
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
/// let swing = Adaptive::builder(Pendulum::declared()).build()?;
/// let mut samples = Sampled::new(swing, 0.01)?;
/// let (mut q, mut v) = ([0.0; 2], [0.0; 2]);
/// for _ in 0..100 {
///     samples.step()?;
///     samples.state(&mut q, &mut v);
///     assert!((q[0].hypot(q[1]) - 1.0).abs() < 1e-12);
/// }
/// // a second in a hundred samples, and in fewer steps
/// assert!(samples.time() == 1.0 && samples.run().effort().steps < 40);
/// // from here on ten times as many
/// samples.set_interval(1e-3)?;
/// assert_eq!((samples.step_size(), samples.steps_to(1.1)?), (1e-3, 100));
/// # Ok::<(), Error>(())
/// ```
#[derive(Clone)]
pub struct Sampled<D: Dynamics, S: AdaptiveScheme> {
    run: Adaptive<D, S>,
    interval: f64,
    /// From when samples are that far apart, and how many there were until then.
    since: (f64, u64),
    samples: u64,
    /// When the run ends, and the number of the last sample then.
    end: Option<(f64, u64)>,
    t: D::Real,
    q: D::Coordinates,
    v: D::Coordinates,
    /// The event at which the run is, while what is seen is before it.
    ahead: Option<Event>,
    threshold: Option<Threshold>,
}

/// A value that a run watches beside its declared events.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Threshold {
    /// The quantity that is compared.
    pub measured: Measured,
    /// The value that the quantity is compared with, in SI units.
    pub value: f64,
    /// Which changes of sign of the difference count.
    pub direction: Direction,
}

/// A quantity of a state, by its place in [`Info`](crate::Info).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measured {
    /// A coordinate.
    Position(usize),
    /// The rate of a coordinate.
    Velocity(usize),
    /// An output, one of the first [`MOST_EVENTS`].
    Output(usize),
    /// The multiplier of a constraint.
    Multiplier(usize),
    /// An input or a memory.
    Input(usize),
}

impl Threshold {
    /// The difference of a state from it; no number for a quantity that does not exist.
    fn difference<D: Dynamics>(&self, dynamics: &D, inputs: &D::Inputs, at: At<'_, D::Real>) -> D::Real {
        let found = match self.measured {
            Measured::Position(index) => at.q.get(index).copied(),
            Measured::Velocity(index) => at.v.get(index).copied(),
            Measured::Input(index) => {
                dynamics.with_inputs(&mut inputs.clone(), |inputs| inputs.get(index).copied())
            }
            Measured::Output(_) | Measured::Multiplier(_) => {
                let (mut a, mut multipliers) = (dynamics.declared_start().1, dynamics.no_feedback());
                let mut outputs = [D::Real::from_f64(f64::NAN); MOST_EVENTS];
                let (a, multipliers) = (a.as_mut(), multipliers.as_mut());
                let mechanism = dynamics.equations();
                dynamics.with_inputs(&mut inputs.clone(), |inputs| {
                    mechanism.reactions(at, inputs, a, multipliers);
                    let count = mechanism.info().outputs.len().min(MOST_EVENTS);
                    if let Some(outputs) = outputs.get_mut(..count) {
                        mechanism.outputs(at, inputs, [a, multipliers], outputs);
                    }
                });
                match self.measured {
                    Measured::Multiplier(row) => multipliers.get(row).copied(),
                    Measured::Output(index) => outputs.get(index).copied(),
                    _ => None,
                }
            }
        };
        found.unwrap_or(D::Real::from_f64(f64::NAN)) - D::Real::from_f64(self.value)
    }
}

impl<D: Dynamics, S: AdaptiveScheme> Sampled<D, S> {
    /// A run looked at every `interval` seconds, from where it is.
    ///
    /// # Errors
    /// [`Error::Step`] for an interval that is not positive and finite.
    pub fn new(run: Adaptive<D, S>, interval: f64) -> Result<Self, Error> {
        check_interval(interval)?;
        let (t, q_now, v_now) = (run.now.t, run.now.q.clone(), run.now.v.clone());
        let [q, v] = run.all.clone();
        let since = (t.to_f64(), 0);
        let mut sampled =
            Self { run, interval, since, samples: 0, end: None, t, q, v, ahead: None, threshold: None };
        sampled.put(t, &q_now, &v_now);
        Ok(sampled)
    }

    /// Looks at the run every `interval` seconds from the present sample on, so that samples may be
    /// at any times.
    ///
    /// # Errors
    /// [`Error::Step`] for an interval that is not positive and finite.
    pub fn set_interval(&mut self, interval: f64) -> Result<(), Error> {
        check_interval(interval)?;
        self.interval = interval;
        self.since = (self.t.to_f64(), self.samples);
        self.end = None;
        Ok(())
    }

    /// When the sample with a number is.
    fn time_of(&self, sample: u64) -> f64 {
        let (t, samples) = self.since;
        match self.end {
            Some((end, last)) if sample == last => end,
            _ => t + sample.saturating_sub(samples) as f64 * self.interval,
        }
    }

    /// Behind its end, if that is no sample of the others, a run is looked at anew.
    fn pass_end(&mut self) {
        let Some((end, last)) = self.end else { return };
        if self.samples == last {
            self.end = None;
            if (end - self.time_of(last)).abs() > AT_END * self.interval {
                self.since = (end, last);
            }
        }
    }

    /// The same run with one value more that it watches: its event has the index behind those of
    /// the declared ones.
    #[must_use]
    pub fn watching(self, threshold: Threshold) -> Self {
        Self { threshold: Some(threshold), ..self }
    }

    /// A step of the run, which ends at its first event, and at the end of the run.
    fn run_on(&mut self) -> Result<Option<Event>, Error> {
        let end = self.end.map_or(f64::INFINITY, |(end, _)| end);
        let ahead = D::Real::from_f64(if end > self.run.now.t.to_f64() { end } else { f64::INFINITY });
        self.watch(|run, watched| run.step_or_event(ahead, watched))
    }

    /// Does something with the run and the values that it watches.
    fn watch<R>(&mut self, what: impl FnOnce(&mut Adaptive<D, S>, &mut Watched<'_, D>) -> R) -> R {
        let Self { run, threshold, .. } = self;
        let events = run.dynamics.info().events;
        let extra = threshold.filter(|_| events.len() < MOST_EVENTS);
        let direction = |index: usize| {
            let declared = events.get(index).map(|event| event.direction);
            declared.or(extra.filter(|_| index == events.len()).map(|extra| extra.direction))
        };
        let mut watched = Watched {
            count: events.len() + usize::from(extra.is_some()),
            direction: &direction,
            values: &mut |dynamics: &D, inputs: &D::Inputs, at, found| {
                dynamics.events(at, inputs, found);
                if let (Some(extra), Some(found)) = (extra, found.get_mut(events.len())) {
                    *found = extra.difference(dynamics, inputs, at);
                }
            },
            room: &mut [D::Real::from_f64(f64::NAN); MOST_EVENTS],
            is_declared: true,
        };
        what(run, &mut watched)
    }

    /// The run, which may be ahead of what is seen by a part of a step.
    pub fn run(&self) -> &Adaptive<D, S> {
        &self.run
    }

    /// The mechanism in the state that is seen.
    fn view(&self) -> View<'_, D> {
        let at = At { t: self.t, q: self.q.as_ref(), v: self.v.as_ref() };
        View { dynamics: &self.run.dynamics, inputs: &self.run.inputs, at }
    }

    /// The moment that is shown.
    fn put(&mut self, t: D::Real, q: &D::States, v: &D::States) {
        let Self { run: Adaptive { dynamics, all, .. }, .. } = self;
        dynamics.complete(t, q, v, all);
        self.t = t;
        let [q, v] = &self.run.all;
        vectors::copy(self.q.as_mut(), q.as_ref());
        vectors::copy(self.v.as_mut(), v.as_ref());
    }
}

const fn check_interval(interval: f64) -> Result<(), Error> {
    if interval > 0.0 && interval.is_finite() { Ok(()) } else { Err(Error::Step { step: interval }) }
}

impl<D: Dynamics, S: AdaptiveScheme> fmt::Debug for Sampled<D, S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { run, interval, t, .. } = self;
        f.debug_struct("Sampled")
            .field("run", run)
            .field("interval", interval)
            .field("t", t)
            .finish_non_exhaustive()
    }
}

impl<D: Dynamics, S: AdaptiveScheme> System<D::Real> for Sampled<D, S> {
    fn equations(&self) -> &dyn Equations<D::Real> {
        self.run.dynamics.equations()
    }

    fn derivation(&self) -> &Derivation {
        self.run.dynamics.derivation()
    }

    fn sketch(&self) -> &Sketch {
        self.run.dynamics.sketch()
    }

    fn time(&self) -> D::Real {
        self.t
    }

    fn state(&self, q: &mut [D::Real], v: &mut [D::Real]) {
        vectors::copy(q, self.q.as_ref());
        vectors::copy(v, self.v.as_ref());
    }

    fn inputs(&self, inputs: &mut [D::Real]) {
        self.view().with_inputs(|own| vectors::copy(inputs, own));
    }

    fn set_inputs(&mut self, inputs: &[D::Real]) {
        let Adaptive { dynamics, inputs: own, .. } = &mut self.run;
        let sampling = dynamics.info().sampling;
        let is_new = dynamics.with_inputs(own, |own| {
            let free = own.len().saturating_sub(sampling.memories);
            own.iter().zip(inputs).take(free).any(|(own, input)| !own.is_same(*input))
        });
        if is_new {
            // with the inputs of the step that this moment lies in; it does, so that there is no error
            let _ = self.run.rewind_to(self.t.to_f64());
            let Adaptive { dynamics, inputs: own, .. } = &mut self.run;
            dynamics.with_inputs(own, |own| sampling.set_inputs(own, inputs));
            self.ahead = None;
        }
    }

    fn step_size(&self) -> D::Real {
        D::Real::from_f64(self.interval)
    }

    fn steps(&self) -> u64 {
        self.samples
    }

    fn steps_to(&self, end: f64) -> Result<u64, Error> {
        let (t, samples) = self.since;
        clock::steps_to::<D::Real>(t, self.interval, self.samples - samples, end)
    }

    fn ends_at(&mut self, end: f64) -> Result<u64, Error> {
        let now = self.t.to_f64();
        let nearest = self.steps_to(end)?;
        if end < now {
            return Err(Error::EndTime { end, now });
        }
        let is_behind = end - self.time_of(self.samples + nearest) > AT_END * self.interval;
        let steps = nearest + u64::from(is_behind);
        self.end = Some((end, self.samples + steps));
        Ok(steps)
    }

    fn step(&mut self) -> Result<(), Error> {
        while self.step_to_event()?.is_some() {}
        Ok(())
    }

    fn step_to_event(&mut self) -> Result<Option<Event>, Error> {
        let t = self.time_of(self.samples + 1);
        loop {
            if let Some(event) = self.ahead.filter(|event| event.t <= t) {
                self.ahead = None;
                let (q, v) = (self.run.now.q.clone(), self.run.now.v.clone());
                self.put(self.run.now.t, &q, &v);
                return Ok(Some(event));
            }
            let at = D::Real::from_f64(t);
            if self.run.now.t >= at {
                self.run.look_between();
                let (q, v) = self.run.interpolate(at)?;
                self.put(at, &q, &v);
                if self.run.now.t <= at {
                    self.watch(|run, watched| run.sample_and_look(false, watched))?;
                    // what jumps at this moment has jumped, as memories have
                    let (q, v) = (self.run.now.q.clone(), self.run.now.v.clone());
                    self.put(at, &q, &v);
                }
                self.samples += 1;
                self.pass_end();
                return Ok(None);
            }
            self.ahead = self.run_on()?;
        }
    }

    fn reactions(&self, acceleration: &mut [D::Real], multipliers: &mut [D::Real]) -> Result<(), Error> {
        self.view().reactions(acceleration, multipliers)
    }

    fn outputs(
        &self,
        acceleration: &[D::Real],
        multipliers: &[D::Real],
        outputs: &mut [D::Real],
    ) -> Result<(), Error> {
        self.view().outputs(acceleration, multipliers, outputs)
    }

    fn violations(&self) -> [D::Real; 2] {
        self.view().violations()
    }

    fn effort(&self) -> Option<Effort> {
        Some(*self.run.effort())
    }

    fn worst_growth(&self) -> D::Real {
        self.run.worst_growth()
    }

    fn worst_place(&self) -> Option<WorstPlace> {
        self.run.worst_place()
    }

    fn digits_left(&self) -> f64 {
        self.run.digits_left()
    }
}
