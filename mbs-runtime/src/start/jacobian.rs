//! The Jacobian Φ_q, column by column: Φ̇ is Φ_q v + Φ_t.

use crate::{Components, Mechanism, Real, State};

/// 1 in one component, 0 in the others.
pub(super) fn unit<C: Components>(at: usize) -> C {
    let mut array = C::splat(C::Real::default()).into_array();
    if let Some(component) = array.as_mut().get_mut(at) {
        *component = C::Real::from_f64(1.0);
    }
    C::from_array(array)
}

/// Φ_q v
pub(super) fn along<M: Mechanism>(
    mechanism: &M,
    at: &State<M::Coordinates>,
    v: M::Coordinates,
) -> M::Constraints {
    let still = M::Coordinates::splat(M::Real::default());
    let phi_t = mechanism.phi_dot(&State { v: still, ..*at });
    mechanism.phi_dot(&State { v, ..*at }).zip_map(phi_t, |rate, phi_t| rate - phi_t)
}

/// ∂Φ/∂qⱼ
pub(super) fn column<M: Mechanism>(mechanism: &M, at: &State<M::Coordinates>, j: usize) -> M::Constraints {
    along(mechanism, at, unit(j))
}
