//! The smallest and largest values of outputs, and when.

use mbs_runtime::lanes::{Lane, Lanes, ManyOutputs, Snapshot, and, unpack};
use mbs_runtime::{Components, Mechanism, Real};

use crate::Observe;

/// Observes the extremes of all outputs from a time on. A member ends with an error if an output is not finite from
/// then on; the error names the output.
///
/// # Example
/// Balls are thrown upwards with 0 … 5 m/s, under g = 10 m/s²:
/// ```
/// use mbs_ensemble::{Ensemble, Extremes};
/// # use mbs_runtime::{Simulation, mechanism};
/// # mechanism! {
/// #     pub Throw {
/// #         dof = 1;
/// #         param speed = 1 [m/s];
/// #         gravity = (0, -10) [m/s^2];
/// #         body ball (y) { mass = 1 [kg]; }
/// #         start { y = 0; der(y) = speed; }
/// #         output height [m] = y;
/// #     }
/// # }
///
/// let member = |index: usize| Simulation::new(Throw::new(ThrowParameters { speed: index as f64 })?, 1e-2);
/// let runs = Ensemble::new(1.0).run(6, member, &Extremes::default())?;
/// for (index, run) in runs.into_iter().enumerate() {
///     let (speed, found) = (index as f64, run?.observed);
///     // v²/2g, after v/g
///     assert!((found.high.height - speed * speed / 20.0).abs() < 1e-12);
///     assert!((found.high_time.height - speed / 10.0).abs() < 1e-12);
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default)]
pub struct Extremes {
    /// The time in s from which outputs count, such as the end of a transient. 0 by default.
    pub from: f64,
}

/// Extremes of the outputs of a run, in SI units; NaN if no output was seen. See the example of [`Extremes`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OfOutputs<C> {
    /// The smallest values.
    pub low: C,
    /// The times in s at which the smallest values were first seen.
    pub low_time: C,
    /// The largest values.
    pub high: C,
    /// The times in s at which the largest values were first seen.
    pub high_time: C,
}

impl<M: Mechanism<Real: Lane>> Observe<M> for Extremes {
    type Notes<const N: usize> = OfOutputs<ManyOutputs<M, N>>;
    type Result = OfOutputs<M::Outputs>;

    fn begin<const N: usize>(&self) -> Self::Notes<N> {
        let unknown = ManyOutputs::<M, N>::splat(Lanes::from_f64(f64::NAN));
        OfOutputs { low: unknown, low_time: unknown, high: unknown, high_time: unknown }
    }

    #[inline(always)]
    fn observe<const N: usize>(&self, notes: &mut Self::Notes<N>, at: &Snapshot<'_, M, N>) -> [bool; N] {
        let (outputs, healthy) = at.outputs();
        let t = at.time();
        let is_late = t.test(Lanes::from_f64(self.from), |t, from| t >= from);
        let counts = and(healthy, is_late);
        update(&mut notes.low, &mut notes.low_time, outputs, t, counts, |new, old| new < old);
        update(&mut notes.high, &mut notes.high_time, outputs, t, counts, |new, old| new > old);
        // what nobody asks for need not be a number
        std::array::from_fn(|lane| healthy[lane] | !is_late[lane])
    }

    fn finish<const N: usize>(&self, notes: &Self::Notes<N>, lane: usize) -> Self::Result {
        OfOutputs {
            low: unpack(notes.low, lane),
            low_time: unpack(notes.low_time, lane),
            high: unpack(notes.high, lane),
            high_time: unpack(notes.high_time, lane),
        }
    }
}

/// Takes over values that beat the ones so far, or are the first.
#[inline(always)]
fn update<T: Lane, C: Components<Real = Lanes<T, N>>, const N: usize>(
    best: &mut C,
    time: &mut C,
    values: C,
    t: Lanes<T, N>,
    counts: [bool; N],
    beats: impl Fn(T, T) -> bool + Copy,
) {
    let (mut bests, mut times) = (best.into_array(), time.into_array());
    for ((best, time), &value) in
        bests.as_mut().iter_mut().zip(times.as_mut()).zip(values.into_array().as_ref())
    {
        let is_new = value.test(*best, |new, old| beats(new, old) | old.partial_cmp(&old).is_none());
        let is_new = and(is_new, counts);
        *best = value.select(is_new, *best);
        *time = t.select(is_new, *time);
    }
    (*best, *time) = (C::from_array(bests), C::from_array(times));
}
