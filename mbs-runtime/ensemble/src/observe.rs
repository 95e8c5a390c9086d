//! Observers, which look at members while these run.

use mbs_runtime::Mechanism;
use mbs_runtime::lanes::{Lane, Snapshot, and};

/// Reduces the states of every member while it runs: at its start, and after every step.
///
/// An observer is shared by all blocks. Its memory of the `N` members of a block is a
/// [`Notes`](Self::Notes), with a [`Lanes`](mbs_runtime::Lanes) for each number, so that
/// looking at eight members costs what looking at one does.
///
/// # Example
/// The impulse of a spring: the sum of its force over all steps, times the step.
/// ```
/// use mbs_ensemble::{Ensemble, Observe};
/// use mbs_runtime::{Lanes, Simulation, lanes::Snapshot, mechanism};
///
/// mechanism! {
///     pub Oscillator {
///         dof = 1;
///         body block (x) { mass = 1 [kg]; }
///         force spring on x = -4 [N/m]*x;
///         start { x = 1 [m]; }
///         output pull [N] = 4 [N/m]*x;
///     }
/// }
///
/// struct Impulse;
///
/// impl Observe<Oscillator> for Impulse {
///     type Notes<const N: usize> = Lanes<f64, N>;
///     type Result = f64;
///
///     fn begin<const N: usize>(&self) -> Lanes<f64, N> {
///         Lanes::default()
///     }
///     #[inline(always)]
///     fn observe<const N: usize>(&self, sum: &mut Lanes<f64, N>, at: &Snapshot<'_, Oscillator, N>) -> [bool; N] {
///         let (outputs, healthy) = at.outputs();
///         *sum = (*sum + outputs.pull).select(healthy, *sum);
///         healthy
///     }
///     fn finish<const N: usize>(&self, sum: &Lanes<f64, N>, lane: usize) -> f64 {
///         1e-3 * sum.0[lane]
///     }
/// }
///
/// let member = |_| Simulation::new(Oscillator::declared(), 1e-3);
/// let runs = Ensemble::new(0.5).run(3, member, &Impulse)?;
/// // ∫ 4 cos 2t dt; the sum errs by half of the first and of the last term
/// let expected = 2.0 * f64::sin(1.0) + 0.5e-3 * (4.0 + 4.0 * f64::cos(1.0));
/// assert!(runs.iter().flatten().all(|run| (run.observed - expected).abs() < 1e-5));
/// # Ok::<(), mbs_ensemble::Cancelled>(())
/// ```
pub trait Observe<M: Mechanism<Real: Lane>>: Sync {
    /// The notes on the members of a block.
    type Notes<const N: usize>;
    /// The result for a member.
    type Result: Send;

    /// True if it looks at anything. Steps that nobody looks at are tested for health
    /// many at a time.
    const LOOKS: bool = true;

    /// The notes before anything was seen.
    fn begin<const N: usize>(&self) -> Self::Notes<N>;

    /// Looks at a state of every member, and says in which lanes that could be
    /// done. The notes of the others stay as they are; their members end with the
    /// error that their outputs, or else their constraints, have.
    ///
    /// Mark it `#[inline(always)]`: then it is compiled for the vector instructions of
    /// the step.
    fn observe<const N: usize>(&self, notes: &mut Self::Notes<N>, at: &Snapshot<'_, M, N>) -> [bool; N];

    /// The result for the member in a lane below `N`.
    fn finish<const N: usize>(&self, notes: &Self::Notes<N>, lane: usize) -> Self::Result;
}

/// Looks at nothing.
impl<M: Mechanism<Real: Lane>> Observe<M> for () {
    type Notes<const N: usize> = ();
    type Result = ();
    const LOOKS: bool = false;

    fn begin<const N: usize>(&self) {}
    #[inline(always)]
    fn observe<const N: usize>(&self, (): &mut (), _: &Snapshot<'_, M, N>) -> [bool; N] {
        [true; N]
    }
    fn finish<const N: usize>(&self, (): &(), _: usize) {}
}

/// Looks with both observers, one after the other. See the example of [`Samples::every`](crate::Samples::every).
impl<M: Mechanism<Real: Lane>, A: Observe<M>, B: Observe<M>> Observe<M> for (A, B) {
    type Notes<const N: usize> = (A::Notes<N>, B::Notes<N>);
    type Result = (A::Result, B::Result);
    const LOOKS: bool = A::LOOKS || B::LOOKS;

    fn begin<const N: usize>(&self) -> Self::Notes<N> {
        (self.0.begin(), self.1.begin())
    }
    #[inline(always)]
    fn observe<const N: usize>(&self, notes: &mut Self::Notes<N>, at: &Snapshot<'_, M, N>) -> [bool; N] {
        and(self.0.observe(&mut notes.0, at), self.1.observe(&mut notes.1, at))
    }
    fn finish<const N: usize>(&self, notes: &Self::Notes<N>, lane: usize) -> Self::Result {
        (self.0.finish(&notes.0, lane), self.1.finish(&notes.1, lane))
    }
}
