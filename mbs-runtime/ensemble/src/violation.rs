//! How well constraints were kept.

use mbs_runtime::Mechanism;
use mbs_runtime::lanes::{Lane, Lanes, Snapshot, and};

use crate::Observe;

/// Observes the largest constraint violations.
#[derive(Clone, Copy, Debug, Default)]
pub struct Violation;

/// The largest violations of a run, Euclidean norms.
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
        // NaN is not larger, so a lane without a violation keeps its notes
        notes.phi = larger(phi, notes.phi);
        notes.phi_dot = larger(phi_dot, notes.phi_dot);
        let is_number = |x: Lanes<M::Real, N>| x.test(x, |x, y| x == y);
        and(is_number(phi), is_number(phi_dot))
    }

    fn finish<const N: usize>(&self, notes: &Self::Notes<N>, lane: usize) -> Self::Result {
        OfConstraints { phi: notes.phi.0[lane], phi_dot: notes.phi_dot.0[lane] }
    }
}

#[inline(always)]
fn larger<T: Lane, const N: usize>(new: Lanes<T, N>, old: Lanes<T, N>) -> Lanes<T, N> {
    new.zip_map(old, |new, old| if new > old { new } else { old })
}
