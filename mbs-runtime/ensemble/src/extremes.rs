//! The smallest and largest values of outputs, and when.

use mbs_runtime::lanes::{Lane, Lanes, ManyOutputs, Snapshot, and, unpack};
use mbs_runtime::{Components, Mechanism, Real};

use crate::Observe;

/// Observes the extremes of all outputs from a time on. A member of which an output is not
/// finite from then on ends with the error that names it.
#[derive(Clone, Copy, Debug, Default)]
pub struct Extremes {
    /// In s: after it a transient is over. 0 by default.
    pub from: f64,
}

/// Extremes of the outputs of a run, in SI units. NaN if none were seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OfOutputs<C> {
    /// The smallest values,
    pub low: C,
    /// and when they were there first, in s.
    pub low_time: C,
    /// The largest values,
    pub high: C,
    /// and when they were there first, in s.
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
