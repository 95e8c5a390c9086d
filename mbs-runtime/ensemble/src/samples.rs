//! States on the way.

use mbs_runtime::lanes::{Lane, Snapshot, unpack};
use mbs_runtime::{Mechanism, State};

use crate::Observe;

/// Keeps states at a constant number of steps, from the start on. This is the only observer whose memory grows with
/// the number of steps.
#[derive(Clone, Copy, Debug)]
pub struct Samples {
    every: u64,
}

impl Samples {
    /// Keeps the start and every `every`-th state after it; 0 counts as 1.
    ///
    /// # Example
    /// ```
    /// # use mbs_ensemble::Ensemble;
    /// # use mbs_runtime::{Simulation, mechanism};
    /// # mechanism! {
    /// #     /// A ball that falls.
    /// #     pub Fall {
    /// #         dof = 1;
    /// #         param g = 9.81 [m/s^2];
    /// #         gravity = (0, -g);
    /// #         body ball (y) { mass = 1 [kg]; }
    /// #         output height [m] = y;
    /// #     }
    /// # }
    /// use mbs_ensemble::{Extremes, Samples};
    ///
    /// let member = |_| Simulation::new(Fall::declared(), 1e-2);
    /// // two observers look at every run
    /// let runs = Ensemble::new(1.0).run(3, member, &(Samples::every(50), Extremes::default()))?;
    /// for run in runs {
    ///     let (samples, extremes) = run?.observed;
    ///     assert_eq!(samples.iter().map(|state| state.t).collect::<Vec<_>>(), [0.0, 0.5, 1.0]);
    ///     assert!(samples.iter().all(|state| (state.v.y + 9.81 * state.t).abs() < 1e-12));
    ///     assert!((extremes.low.height + 0.5 * 9.81).abs() < 1e-12);
    /// }
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
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
