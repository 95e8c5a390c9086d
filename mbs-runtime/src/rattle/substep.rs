//! One step of RATTLE.

use crate::adaptive::{Moment, copy};
use crate::explicit::{Beside, subtract};
use crate::{Dynamics, Real, vectors};

/// Corrections of positions, each of which takes off a share of the order of h, end at rounding
/// long before.
const CORRECTIONS: u32 = 50;

/// The vectors of a step.
#[derive(Clone)]
pub struct Substep<V> {
    /// The positions at its start.
    pub from: V,
    /// A correction.
    pub delta: V,
}

impl<V: Clone> Substep<V> {
    /// A step of `h` seconds to the time `t`, on `moment`; the growths of all that was solved,
    /// added. Nothing if its positions do not lead to the constraints.
    ///
    /// The acceleration of a moment is that of its forces up to a combination of M⁻¹ Φ_qᵀ, which
    /// the multipliers take up: that at the end of a step serves the next one, though it was found
    /// with other velocities.
    pub fn take<D: Dynamics<States = V>>(
        &mut self,
        dynamics: &D,
        inputs: &D::Inputs,
        h: D::Real,
        t: D::Real,
        moment: &mut Moment<D::Real, V>,
    ) -> Option<D::Real>
    where
        V: AsRef<[D::Real]> + AsMut<[D::Real]>,
    {
        let Self { from, delta } = self;
        let half = D::Real::from_f64(0.5) * h;
        let t_from = moment.t;
        copy(from, &moment.q);
        vectors::add_scaled(moment.v.as_mut(), half, moment.a.as_ref());
        vectors::add_scaled(moment.q.as_mut(), h, moment.v.as_ref());
        moment.t = t;
        let mut growth = D::Real::default();
        let mut correct = |moment: &mut Moment<D::Real, V>| {
            growth = growth + dynamics.correction_along((t_from, from), t, &moment.q, delta);
            subtract(&mut moment.q, delta);
            vectors::zip_map(moment.v.as_mut(), delta.as_ref(), |v, delta| v - delta / h);
            vectors::largest(delta.as_ref()).1
        };
        let corrections = converge(|| {
            let size = correct(moment);
            size / (D::Real::from_f64(1.0) + vectors::largest(moment.q.as_ref()).1)
        })?;
        // derivatives converge as values do, an order behind the other
        for _ in 0..D::Real::ORDER as u32 * corrections {
            correct(moment);
        }
        let Moment { q, v, a, .. } = moment;
        growth = growth + dynamics.acceleration(t, q, v, inputs, a);
        vectors::add_scaled(v.as_mut(), half, a.as_ref());
        growth = growth + dynamics.correction(t, &Beside { q, v: Some(v) }, delta);
        subtract(v, delta);
        Some(growth)
    }
}

/// Corrects until a correction, measured by the size of what it corrects, is a few roundings, or
/// is small and no smaller than half of the one before: then it is made of roundings of Φ. How
/// many corrections that were; nothing if they do not come to an end.
fn converge<T: Real>(mut correct: impl FnMut() -> T) -> Option<u32> {
    let (rounding, small) = (T::from_f64(4.0) * T::EPSILON, T::EPSILON.sqrt());
    let mut before = T::from_f64(f64::INFINITY);
    for count in 1..=CORRECTIONS {
        let size = correct();
        let is_rounding = size <= rounding || (size <= small && size + size >= before);
        if is_rounding {
            return Some(count);
        }
        before = size;
    }
    None
}
