//! RATTLE: steps that keep the energy of mechanisms without friction.

use mbs_interface::{Composition, RATTLE};

use super::{ConstantStep, ConstantStepBuilder, Kernel};
use crate::adaptive::Moment;
use crate::explicit::{Beside, subtract};
use crate::vectors::assign;
use crate::{Dynamics, Error, Info, Real, vectors};

/// Corrections of positions, each of which takes off a share of the order of h, end at rounding
/// long before.
const CORRECTIONS: u32 = 50;

/// A mechanism being integrated by RATTLE, with a constant step.
///
/// With a = M⁻¹ Q(q) and h the step,
///
/// ```text
/// v½ = v + h/2 a(q) − M⁻¹ Φ_q(q)ᵀ μ,    q⁺ = q + h v½,    Φ(q⁺) = 0
/// v⁺ = v½ + h/2 a(q⁺) − M⁻¹ Φ_q(q⁺)ᵀ ν,                    Φ̇(q⁺, v⁺) = 0
/// ```
///
/// The positions are found by simplified Newton steps to rounding, the velocities by one solution.
/// The method is of second order, symmetric and symplectic: in a mechanism whose forces have a
/// potential and whose constraints do not depend on time the energy oscillates by O(h²) and does
/// not drift, however long the run is. Composed of five steps
/// ([`composition`](ConstantStepBuilder::composition)) it is of fourth order.
///
/// Forces must not depend on velocities, as those of dampers and the centrifugal forces of particles do. Forces and drives that depend on time, and inputs, are
/// permitted: they do work, and the method keeps its order. A run evaluates the forces once a step
/// and solves five to eight times with the elimination of the accelerations, about three times the
/// work of Heun's method. Take it for long runs whose energy matters, and an
/// [`Adaptive`](crate::Adaptive) run where the accuracy of one motion does.
///
/// # Example
/// ```
/// use mbs_runtime::{Rattle, mechanism};
///
/// mechanism! {
///     pub Pendulum {
///         dof = 1;
///         param length = 1 [m];
///         gravity = (0, -9.81) [m/s^2];
///         body bob (x, y) { mass = 2 [kg]; }
///         constraint rod: x^2 + y^2 = length^2;
///         start { x = length; guess y = 0; }
///     }
/// }
///
/// let mut swing = Rattle::builder(Pendulum::declared(), 1e-2).build()?;
/// let mut largest: f64 = 0.0;
/// for _ in 0..100_000 {
///     swing.step()?;
///     largest = largest.max(swing.energy().abs());
/// }
/// // a thousand seconds later: of 20 J that move to and fro
/// assert!(largest < 1e-2 && swing.violation() < 1e-14);
/// # Ok::<(), mbs_runtime::Error>(())
/// ```
///
/// # Source
/// H. C. Andersen, J. Comput. Phys. 52 (1983) 24-34; Hairer, Lubich, Wanner, Geometric Numerical
/// Integration, VII.1.4 (symplecticity) and V.3.2 (composition).
pub type Rattle<D> = ConstantStep<D, RattleStep<<D as Dynamics>::States>>;

/// The vectors of a step of RATTLE, and what it is composed of.
#[derive(Clone)]
pub struct RattleStep<V> {
    composition: &'static Composition,
    /// The positions at the start of a substep.
    from: V,
    /// A correction.
    delta: V,
}

impl<D: Dynamics> Rattle<D> {
    /// Choices to make before the start. Without any: the declared start, made consistent, steps
    /// of `step` seconds of second order, inputs at their defaults.
    pub fn builder(mechanism: D, step: f64) -> ConstantStepBuilder<D, RattleStep<D::States>> {
        let vector = mechanism.states(&mechanism.declared_start().1);
        let kernel = RattleStep { composition: &RATTLE, from: vector.clone(), delta: vector };
        ConstantStepBuilder::new(mechanism, step, kernel)
    }
}

impl<D: Dynamics> ConstantStepBuilder<D, RattleStep<D::States>> {
    /// Sets the composition of a step: [`RATTLE`](crate::RATTLE) itself, of second order, or
    /// [`RATTLE4`](crate::RATTLE4), five steps that make one of fourth order.
    ///
    /// # Example
    /// ```
    /// use mbs_runtime::{RATTLE4, Rattle, mechanism};
    /// # mechanism! {
    /// #     pub Pendulum {
    /// #         dof = 1;
    /// #         param length = 1 [m];
    /// #         gravity = (0, -9.81) [m/s^2];
    /// #         body bob (x, y) { mass = 2 [kg]; }
    /// #         constraint rod: x^2 + y^2 = length^2;
    /// #         start { x = length; guess y = 0; }
    /// #     }
    /// # }
    /// let mut swing =
    ///     Rattle::builder(Pendulum::declared(), 1e-2).composition(&RATTLE4).build()?;
    /// swing.advance_to(10.0)?;
    /// assert!(swing.energy().abs() < 1e-6);
    /// # Ok::<(), mbs_runtime::Error>(())
    /// ```
    #[must_use]
    pub fn composition(mut self, composition: &'static Composition) -> Self {
        self.kernel.composition = composition;
        self
    }
}

impl<D: Dynamics> Kernel<D> for RattleStep<D::States> {
    fn word(&self) -> &'static str {
        self.composition.word
    }

    fn check(&self, info: &Info) -> Result<(), Error> {
        if let Some(&at) = info.velocity_forces.first() {
            return Err(Error::VelocityForce { coordinate: info.coordinate_name(at) });
        }
        info.refuse_rates(self.composition.word)?;
        if info.has_reduced_states() {
            return Err(Error::ReducedStates { method: self.composition.word });
        }
        Ok(())
    }

    fn step(
        &mut self,
        dynamics: &D,
        inputs: &D::Inputs,
        h: D::Real,
        t_next: D::Real,
        moment: &mut Moment<D::Real, D::States>,
    ) -> Option<D::Real> {
        let (start, shares) = (moment.t, self.composition.shares);
        let (mut growth, mut taken) = (D::Real::default(), 0.0);
        for (at, &share) in shares.iter().enumerate() {
            taken += share;
            let is_last = at + 1 == shares.len();
            let t = if is_last { t_next } else { start + D::Real::from_f64(taken) * h };
            growth = growth + self.substep(dynamics, inputs, D::Real::from_f64(share) * h, t, moment)?;
        }
        Some(growth)
    }
}

impl<V: Clone> RattleStep<V> {
    /// A step of `h` seconds to the time `t`, on `moment`; the growths of all that was solved,
    /// added. Nothing if its positions do not lead to the constraints.
    ///
    /// The acceleration of a moment is that of its forces up to a combination of M⁻¹ Φ_qᵀ, which
    /// the multipliers take up: that at the end of a step serves the next one, though it was found
    /// with other velocities.
    fn substep<D: Dynamics<States = V>>(
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
        let Self { from, delta, .. } = self;
        let half = D::Real::from_f64(0.5) * h;
        let t_from = moment.t;
        assign(from, &moment.q);
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
            let positions = dynamics.equations().info().of_bodies(moment.q.as_ref());
            size / (D::Real::from_f64(1.0) + vectors::largest(positions).1)
        })?;
        // derivatives converge as values do, an order behind the other
        for _ in 0..D::Real::ORDER as u32 * corrections {
            correct(moment);
        }
        let Moment { q, v, a, .. } = moment;
        growth = growth + dynamics.free_acceleration(t, q, v, inputs, a);
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
