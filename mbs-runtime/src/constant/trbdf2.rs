//! TR-BDF2: implicit steps for stiff springs and dampers, in straight lines.

use mbs_interface::TRBDF2;

use super::{ConstantStep, ConstantStepBuilder, Kernel};
use crate::adaptive::Moment;
use crate::explicit::{Beside, subtract};
use crate::vectors::assign;
use crate::{Dynamics, Error, Info, Real, vectors};

/// A mechanism being integrated by TR-BDF2, with a constant step: for springs, bushings and dampers
/// that are too stiff for the step of an explicit method.
///
/// Half a trapezoidal step leads to t + γh with γ = 2 − √2, a backward difference over both to
/// t + h. With d = γ/2, w = √2/4 and a(q, v) the accelerations of the constrained mechanism,
///
/// ```text
/// v₂ = v + d h (a + a₂),              q₂ = q + d h (v + v₂)
/// v⁺ = v + h (w a + w a₂ + d a₃),     q⁺ = q + h (w v + w v₂ + d v⁺)
/// ```
///
/// where a₂ and a₃ are accelerations at the states that they lead to. Each is found by one step of
/// Newton's method from the acceleration before ([`Mechanism::implicit`](crate::Mechanism::implicit)),
/// with the exact derivatives of the forces: one elimination, of
/// M − d h ∂Q/∂v − d²h² ∂Q/∂q in place of M. The end is projected onto the constraints, positions
/// and velocities once each. So a step has no loop and no branch, and always takes the same number
/// of operations.
///
/// The method is of second order and L-stable: what is too fast for the step is damped within some
/// steps, and the slow motion is followed as if the stiff spring were a constraint. Both stages are
/// of second order themselves, which linearly implicit (Rosenbrock) schemes lack: on a pendulum
/// whose rod has 10⁹ N/m, turning by 0.01 rad in a step, these lose the motion within a turn, and
/// TR-BDF2 is off by 3 · 10⁻⁵ of the radius.
///
/// Take it where a stiff force and not the motion limits the step; [`implicit`](crate::implicit) has it, and a
/// scheme of fourth order, for runs to a tolerance. Vibrations that a step does not
/// resolve are lost, and the energy with them. A force whose derivative is not symmetric and that is
/// stiff (a follower, a spring that acts on one body only) may not be followed; forces between two
/// bodies are symmetric. Friction as a stiff function of reactions is not treated as stiff.
///
/// # Example
/// ```
/// use mbs_runtime::{TrBdf2, mechanism};
///
/// mechanism! {
///     /// A weight on a rod as stiff as steel.
///     pub Pendulum {
///         dof = 2;
///         param length = 1 [m];
///         gravity = (0, -9.81) [m/s^2];
///         body bob (x, y) { mass = 2 [kg]; }
///         point hook on ground = (0, 0);
///         spring rod (ground.hook, bob) { stiffness = 1e8 [N/m]; length = length; }
///         start { x = length; y = 0; }
///     }
/// }
///
/// // an explicit method would need steps below 0.28 ms
/// let mut swing = TrBdf2::builder(Pendulum::declared(), 5e-3).build()?;
/// swing.advance_to(2.0)?;
/// let stretch = swing.state().q.x.hypot(swing.state().q.y) - 1.0;
/// // three times the weight at the bottom stretches the rod by 0.6 µm
/// assert!(stretch.abs() < 1e-6);
/// # Ok::<(), mbs_runtime::Error>(())
/// ```
///
/// # Source
/// R. E. Bank et al., IEEE Trans. CAD 4 (1985) 436-451; M. E. Hosea, L. F. Shampine, Appl. Numer.
/// Math. 20 (1996) 21-37. On stiff springs as the limit of constraints: Ch. Lubich, BIT 33 (1993)
/// 280-303.
pub type TrBdf2<D> = ConstantStep<D, TrBdf2Step<<D as Dynamics>::States>>;

/// d: the share that a stage has of its own slope.
const OWN: f64 = TRBDF2.own;
/// w: the shares of the slopes before in the last stage.
const BEFORE: f64 = TRBDF2.stages[1].share;

/// The share of the positions from which on a correction is repeated, as from a start that is far from the
/// constraints: that of a regular step is of third order.
const FAR: f64 = 1e-3;
/// So often at most.
const CORRECTIONS: usize = 4;

/// The vectors of a step of TR-BDF2.
#[derive(Clone)]
pub struct TrBdf2Step<V> {
    /// Positions and velocities of the last stage without its own share.
    base: [V; 2],
    /// Positions and velocities to which a predicted acceleration leads.
    there: [V; 2],
    /// a₂ and a₃.
    slopes: [V; 2],
    /// True if there is an acceleration from before.
    is_started: bool,
}

impl<D: Dynamics> TrBdf2<D> {
    /// Choices to make before the start. Without any: the declared start, made consistent, steps
    /// of `step` seconds, inputs at their defaults.
    pub fn builder(mechanism: D, step: f64) -> ConstantStepBuilder<D, TrBdf2Step<D::States>> {
        let vector = || mechanism.states(&mechanism.declared_start().1);
        let pair = || [vector(), vector()];
        let kernel = TrBdf2Step { base: pair(), there: pair(), slopes: pair(), is_started: false };
        ConstantStepBuilder::new(mechanism, step, kernel)
    }
}

impl<D: Dynamics> Kernel<D> for TrBdf2Step<D::States> {
    fn word(&self) -> &'static str {
        "trbdf2"
    }

    fn check(&self, _: &Info) -> Result<(), Error> {
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
        let Self { base: [base_q, base_v], there: [q_there, v_there], slopes: [a2, a3], .. } = self;
        let [own, before] = [OWN, BEFORE].map(|share| D::Real::from_f64(share) * h);
        let Moment { t, q, v, a } = moment;

        // The sums are computed component by component, in registers. As vectors they would pass through
        // memory, written in other pieces than they are read, for which a processor waits.

        // the trapezoidal rule to t + γh
        let results = [&mut *q_there, v_there].map(|x| x.as_mut());
        vectors::zip_into(results, [&*q, v, a].map(|x| x.as_ref()), |[q, v, a]| {
            lead([q + own * v, v + own * a], own, a)
        });
        let t2 = *t + own + own;
        let mut growth = dynamics.implicit(t2, [q_there, v_there], inputs, (own, a), a2);

        // the backward difference to t + h
        let results = [&mut *base_q, base_v, q_there, v_there].map(|x| x.as_mut());
        vectors::zip_into(results, [&*q, v, a, a2].map(|x| x.as_ref()), |[q, v, a, a2]| {
            let v2 = v + own * a + own * a2;
            let base = [q + before * v + before * v2, v + before * a + before * a2];
            let [q_there, v_there] = lead(base, own, a2);
            [base[0], base[1], q_there, v_there]
        });
        growth = growth + dynamics.implicit(t_next, [q_there, v_there], inputs, (own, a2), a3);
        let results = [&mut *q, v, a].map(|x| x.as_mut());
        vectors::zip_into(results, [&*base_q, base_v, a3].map(|x| x.as_ref()), |[q, v, a3]| {
            let [q, v] = lead([q, v], own, a3);
            [q, v, a3]
        });

        *t = t_next;
        // Not by `project`: its closure would be one function for both corrections, with its numbers in
        // memory, which takes 20 ns longer.
        let delta = a3;
        let mut of_positions = dynamics.correction(t_next, &Beside { q, v: None }, delta);
        subtract(q, delta);
        for correction in 1.. {
            let positions = dynamics.equations().info().of_bodies(q.as_ref());
            let [moved, size] = [delta.as_ref(), positions].map(|x| vectors::largest(x).1);
            if moved <= D::Real::from_f64(FAR) * (D::Real::from_f64(1.0) + size) {
                break;
            }
            // beyond reach none is small
            if correction == CORRECTIONS {
                return None;
            }
            of_positions = of_positions + dynamics.correction(t_next, &Beside { q, v: None }, delta);
            subtract(q, delta);
        }
        let of_velocities = dynamics.correction(t_next, &Beside { q, v: Some(v) }, delta);
        subtract(v, delta);
        Some(growth + (of_positions + of_velocities))
    }

    /// At the start the acceleration of an explicit method. Where inputs change, a stage at the moment
    /// itself, twice: what changed acts on what is slow, and what is too fast for the step keeps the
    /// acceleration that it had, in which an explicit one would magnify roundings by the stiffness.
    fn accelerate(
        &mut self,
        dynamics: &D,
        inputs: &D::Inputs,
        h: D::Real,
        moment: &mut Moment<D::Real, D::States>,
    ) -> D::Real {
        let (own, predicted) = (D::Real::from_f64(OWN) * h, &mut self.slopes[0]);
        let Moment { t, q, v, a } = moment;
        if !core::mem::replace(&mut self.is_started, true) {
            return dynamics.free_acceleration(*t, q, v, inputs, a);
        }
        let mut growth = D::Real::default();
        for _ in 0..2 {
            assign(predicted, a);
            growth = growth + dynamics.implicit(*t, [q, v], inputs, (own, predicted), a);
        }
        growth
    }
}

/// The position and velocity to which an acceleration leads with its share of the step.
#[inline(always)]
fn lead<T: Real>([q, v]: [T; 2], own: T, acceleration: T) -> [T; 2] {
    let v = v + own * acceleration;
    [q + own * v, v]
}
