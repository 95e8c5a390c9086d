//! Clocks: when they sample, and what that does to the memories of a mechanism.
//!
//! A clock samples at the times `offset + k period`, k whole. A memory is an input that the mechanism sets itself, at
//! the samples; between them it holds. A run with a constant step counts steps, so that rounding neither leaves a sample
//! out nor takes one twice. One to a tolerance ends a step at each sample.

use crate::equations::{At, Equations};
use crate::spline::floor;
use crate::{Error, Real};

/// Times are those of samples within so many roundings of them.
const ROUNDINGS: f64 = 8.0;
/// A step that leads to samples is looked for among so many.
const MOST_PARTS: u32 = 10_000;

/// The steps of a run with a constant step, by which clocks are told.
///
/// # Example
/// ```
/// use mbs_runtime::equations::Grid;
/// # mbs_runtime::mechanism! {
/// #     pub Regulated {
/// #         dof = 1;
/// #         body rotor (angle = theta) { inertia = 1e-4 [kg*m^2]; }
/// #         memory torque [N*m] = 0;
/// #         every 1 [ms] { set torque = -1e-3 [N*m*s]*der(theta); }
/// #         torque motor on rotor = torque;
/// #     }
/// # }
/// let grid = Grid { start: 0.0, step: 0.3e-3 };
/// assert!(grid.check(&Regulated::declared()).is_err());
/// // steps that lead from sample to sample, every millisecond
/// let fitted = grid.fitted([[1e-3, 0.0]].into_iter(), f64::EPSILON).expect("1 ms has parts");
/// assert_eq!(fitted.step, 0.25e-3);
/// assert_eq!(fitted.steps_to_sample(1, &Regulated::declared()), 3);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    /// The time of the start in s.
    pub start: f64,
    /// The step in s.
    pub step: f64,
}

impl Grid {
    /// Checks that whole numbers of steps lead from the start to a sample, and from sample to sample. All of these times
    /// are known to some roundings.
    ///
    /// # Errors
    /// [`Error::Period`].
    pub fn check<T: Real>(&self, equations: &dyn Equations<T>) -> Result<(), Error> {
        let info = equations.info();
        if T::ORDER > 0 {
            // whether a gap is closed at the end of a step does not tell when it closed
            info.refuse_stops("a derivative of a run with constant steps")?;
        }
        for clock in 0..info.sampling.clocks {
            let [period, offset] = equations.clock(clock).map(Real::to_f64);
            if !self.meets(period, offset, T::EPSILON.to_f64()) {
                let mut set = info.sampling.samples.iter().filter(|[of, _]| *of == clock);
                let memory = set.next().and_then(|[_, memory]| info.inputs.get(*memory));
                let memory = memory.map_or("", |memory| memory.name);
                let all = (0..info.sampling.clocks).map(|clock| equations.clock(clock).map(Real::to_f64));
                let better = self.fitted(all, T::EPSILON.to_f64()).map_or(0.0, |grid| grid.step);
                let Self { start, step } = *self;
                return Err(Error::Period { memory, period, offset, start, step, better });
            }
        }
        Ok(())
    }

    /// True if the steps lead to the samples of a clock.
    fn meets(&self, period: f64, offset: f64, epsilon: f64) -> bool {
        let (slack, steps) = (ROUNDINGS * epsilon, period / self.step);
        let first = (self.start - offset) / self.step;
        let rounding = slack * (1.0 + (self.start.abs() + offset.abs()) / self.step);
        let count = self.count(period);
        count >= 1.0
            && (steps - count).abs() <= slack * count
            && (first - floor(first + 0.5)).abs() <= rounding
    }

    /// The same start with the longest steps that are no longer and lead to the samples of clocks, given by their
    /// periods and offsets; nothing if none of many does.
    pub fn fitted(&self, clocks: impl Iterator<Item = [f64; 2]> + Clone, epsilon: f64) -> Option<Self> {
        let shortest = clocks.clone().fold(f64::INFINITY, |shortest, [period, _]| shortest.min(period));
        let least = floor(shortest / self.step - ROUNDINGS * epsilon * shortest / self.step).max(0.0) + 1.0;
        let grids = (0..MOST_PARTS).map(|more| Self { step: shortest / (least + f64::from(more)), ..*self });
        grids
            .into_iter()
            .find(|grid| clocks.clone().all(|[period, offset]| grid.meets(period, offset, epsilon)))
    }

    /// The nearest whole number of steps to some seconds.
    fn count(&self, seconds: f64) -> f64 {
        floor(seconds / self.step + 0.5)
    }

    /// The number of steps since the last sample of a clock, and that from sample to sample.
    fn place<T: Real>(&self, steps: u64, [period, offset]: [T; 2]) -> [f64; 2] {
        let count = self.count(period.to_f64());
        let steps = self.count(self.start - offset.to_f64()) + steps as f64;
        [steps - floor(steps / count) * count, count]
    }

    /// Takes the samples of all clocks that are due after so many steps, in the order of their declaration.
    pub fn sample<T: Real>(&self, steps: u64, equations: &dyn Equations<T>, at: At<'_, T>, inputs: &mut [T]) {
        for clock in 0..equations.info().sampling.clocks {
            if self.place(steps, equations.clock(clock))[0] == 0.0 {
                equations.sample(at, inputs, clock);
            }
        }
    }

    /// The number of steps to the next sample of any clock.
    pub fn steps_to_sample<T: Real>(&self, steps: u64, equations: &dyn Equations<T>) -> u64 {
        let clocks = 0..equations.info().sampling.clocks;
        let left = clocks.map(|clock| {
            let [place, count] = self.place(steps, equations.clock(clock));
            count - place
        });
        // never less than a step, whatever the period is
        left.fold(f64::INFINITY, f64::min).max(1.0) as u64
    }
}

/// The time of the sample of a clock that is nearest to `t`, and that of the next one.
fn around<T: Real>(t: T, [period, offset]: [T; 2]) -> [T; 2] {
    // within a period, so that samples of several clocks at one time are that but for rounding
    let offset = offset - T::from_f64(floor(offset.to_f64() / period.to_f64())) * period;
    let nearest = floor((t - offset).to_f64() / period.to_f64() + 0.5);
    [nearest, nearest + 1.0].map(|count| offset + T::from_f64(count) * period)
}

/// The largest period and offset of the clocks, whose roundings the times of all samples have.
fn scale<T: Real>(equations: &dyn Equations<T>) -> f64 {
    let clocks = 0..equations.info().sampling.clocks;
    let sizes = clocks.map(|clock| equations.clock(clock).map(|time| time.to_f64().abs()));
    sizes.fold(0.0, |largest, [period, offset]| largest.max(period + offset))
}

/// True if two times are the same but for rounding, theirs and that of clocks.
fn coincide<T: Real>(t: T, sample: T, scale: f64) -> bool {
    let size = t.to_f64().abs().max(sample.to_f64().abs()) + scale;
    (t.to_f64() - sample.to_f64()).abs() <= ROUNDINGS * T::EPSILON.to_f64() * size
}

/// The first time behind `t` at which a clock samples, but for samples of a time at which they have been taken; infinite
/// without one.
pub(crate) fn next_sample<T: Real>(equations: &dyn Equations<T>, t: T, taken: Option<T>) -> T {
    let (clocks, scale) = (0..equations.info().sampling.clocks, scale(equations));
    let is_taken = |sample: T| taken.is_some_and(|taken| coincide(taken, sample, scale));
    clocks
        .flat_map(|clock| around(t, equations.clock(clock)))
        .filter(|sample| *sample > t && !is_taken(*sample))
        .fold(T::from_f64(f64::INFINITY), |first, sample| if sample < first { sample } else { first })
}

/// The clocks that sample at a time but for rounding, in the order of their declaration, and when they do.
fn due_at<T: Real>(equations: &dyn Equations<T>, t: T) -> impl Iterator<Item = (usize, T)> {
    let (clocks, scale) = (0..equations.info().sampling.clocks, scale(equations));
    let nearest = clocks.map(move |clock| (clock, around(t, equations.clock(clock))[0]));
    nearest.filter(move |(_, sample)| coincide(t, *sample, scale))
}

/// True if a clock samples at a time, and has not done so; `is_exact` asks that the time is not before the sample by a
/// rounding.
pub(crate) fn is_sample<T: Real>(
    equations: &dyn Equations<T>,
    t: T,
    taken: Option<T>,
    is_exact: bool,
) -> bool {
    let is_taken = || taken.is_some_and(|taken| coincide(taken, t, scale(equations)));
    due_at(equations, t).any(|(_, sample)| sample <= t || !is_exact) && !is_taken()
}

/// Takes the samples of all clocks that are due at a time.
pub(crate) fn sample_at<T: Real>(equations: &dyn Equations<T>, at: At<'_, T>, inputs: &mut [T]) {
    due_at(equations, at.t).for_each(|(clock, _)| equations.sample(at, inputs, clock));
}
