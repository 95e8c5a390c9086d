//! States on the way.

use mbs_runtime::lanes::{Lane, Snapshot, unpack};
use mbs_runtime::{Mechanism, State};

use crate::Observe;

/// Keeps the start and every state a number of steps later. The only observer whose
/// memory grows with the number of steps.
#[derive(Clone, Copy, Debug)]
pub struct Samples {
    every: u64,
}

impl Samples {
    /// Every `every`-th state; 0 counts as 1.
    pub const fn every(every: u64) -> Self {
        Self { every: if every == 0 { 1 } else { every } }
    }
}

/// The samples so far, one list per lane, and the states seen.
#[doc(hidden)]
pub struct Notes<M: Mechanism, const N: usize> {
    samples: [Vec<State<M::Coordinates>>; N],
    seen: u64,
}

impl<M: Mechanism<Real: Lane>> Observe<M> for Samples {
    type Notes<const N: usize> = Notes<M, N>;
    type Result = Vec<State<M::Coordinates>>;

    fn begin<const N: usize>(&self) -> Self::Notes<N> {
        Notes { samples: std::array::from_fn(|_| Vec::new()), seen: 0 }
    }

    #[inline(always)]
    fn observe<const N: usize>(&self, notes: &mut Self::Notes<N>, at: &Snapshot<'_, M, N>) -> [bool; N] {
        if notes.seen % self.every == 0 {
            keep(notes, at);
        }
        notes.seen += 1;
        [true; N]
    }

    fn finish<const N: usize>(&self, notes: &Self::Notes<N>, lane: usize) -> Self::Result {
        notes.samples[lane].clone()
    }
}

fn keep<M: Mechanism<Real: Lane>, const N: usize>(notes: &mut Notes<M, N>, at: &Snapshot<'_, M, N>) {
    let State { t, q, v } = at.state();
    for (lane, samples) in notes.samples.iter_mut().enumerate() {
        samples.push(State { t: t.0[lane], q: unpack(q, lane), v: unpack(v, lane) });
    }
}
