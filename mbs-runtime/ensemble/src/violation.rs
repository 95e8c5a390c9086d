//! How well constraints were kept.

use mbs_runtime::lanes::{Lane, Lanes, Snapshot, and};
use mbs_runtime::{Mechanism, Real};

use crate::Observe;

/// Observes the largest constraint violations.
///
/// # Example
/// ```
/// use mbs_ensemble::{Ensemble, Violation};
/// use mbs_runtime::{Simulation, mechanism};
///
/// mechanism! {
///     pub Pendulum {
///         dof = 1;
///         gravity = (0, -9.81) [m/s^2];
///         body bob (x, y) { mass = 2 [kg]; }
///         constraint rod: x^2 + y^2 = 1 [m^2];
///         start { x = 1 [m]; guess y = 0; }
///     }
/// }
///
/// // shorter steps keep the rod better: with its error per step, h³
/// let member = |index: usize| Simulation::new(Pendulum::declared(), [2e-3, 1e-3][index]);
/// let runs = Ensemble::new(1.0).run(2, member, &Violation)?;
/// let [long, short] = [0, 1].map(|at| runs[at].as_ref().map_or(f64::NAN, |run| run.observed.phi));
/// assert!(short > 0.0 && ((long / short).log2() - 3.0).abs() < 0.3);
/// # Ok::<(), mbs_ensemble::Cancelled>(())
/// ```
#[derive(Clone, Copy, Debug, Default)]
pub struct Violation;

/// The largest violations of a run, as Euclidean norms over all constraints in SI units.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct OfConstraints<T> {
    /// max ‖Φ‖
    pub phi: T,
    /// max ‖Φ̇‖
    pub phi_dot: T,
}

impl<M: Mechanism<Real: Lane>> Observe<M> for Violation {
    type Notes<const N: usize> = OfConstraints<Lanes<M::Real, N>>;
    type Result = OfConstraints<M::Real>;

    fn begin<const N: usize>(&self) -> Self::Notes<N> {
        OfConstraints::default()
    }

    #[inline(always)]
    fn observe<const N: usize>(&self, notes: &mut Self::Notes<N>, at: &Snapshot<'_, M, N>) -> [bool; N] {
        let (phi, phi_dot) = (at.violation(), at.velocity_violation());
        // NaN is not larger, and what is not finite ends the member
        notes.phi = larger(phi, notes.phi);
        notes.phi_dot = larger(phi_dot, notes.phi_dot);
        let are_finite = |x: Lanes<M::Real, N>| x.test(x, |x, _| x.is_finite());
        and(are_finite(phi), are_finite(phi_dot))
    }

    fn finish<const N: usize>(&self, notes: &Self::Notes<N>, lane: usize) -> Self::Result {
        OfConstraints { phi: notes.phi.0[lane], phi_dot: notes.phi_dot.0[lane] }
    }
}

#[inline(always)]
fn larger<T: Lane, const N: usize>(new: Lanes<T, N>, old: Lanes<T, N>) -> Lanes<T, N> {
    new.zip_map(old, |new, old| if new > old { new } else { old })
}
