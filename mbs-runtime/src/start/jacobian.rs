//! The Jacobian Φ_q, column by column: Φ̇ is Φ_q v + Φ_t.

use crate::equations::{At, Equations};
use crate::{Info, Real, vectors};

/// The Jacobian Φ_q at a position.
pub(super) struct Jacobian<'a, T> {
    equations: &'a dyn Equations<T>,
    t: T,
    pub q: &'a [T],
    /// Φ_t
    pub phi_t: &'a [T],
    /// A direction: 0 between calls.
    direction: &'a mut [T],
}

impl<'a, T: Real> Jacobian<'a, T> {
    /// The Jacobian at q, with room for a direction and for Φ_t.
    pub fn new(
        equations: &'a dyn Equations<T>,
        t: T,
        q: &'a [T],
        direction: &'a mut [T],
        phi_t: &'a mut [T],
    ) -> Self {
        vectors::fill(direction, T::default());
        equations.phi_dot(At { t, q, v: direction }, phi_t);
        Self { equations, t, q, phi_t, direction }
    }

    /// The description of the mechanism.
    pub fn info(&self) -> &'a Info {
        self.equations.info()
    }

    /// Φ_q v
    pub fn along(&self, v: &[T], rates: &mut [T]) {
        self.equations.phi_dot(At { t: self.t, q: self.q, v }, rates);
        vectors::zip_map(rates, self.phi_t, |rate, phi_t| rate - phi_t);
    }

    /// ∂Φ/∂qⱼ
    pub fn column(&mut self, j: usize, entries: &mut [T]) {
        vectors::set(self.direction, j, T::from_f64(1.0));
        self.along(self.direction, entries);
        vectors::set(self.direction, j, T::default());
    }
}
