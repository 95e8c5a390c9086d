//! Steps of mechanisms with long vectors. Named components are a detour where loops
//! compute: the stages of these mechanisms are given arrays and return arrays, and a
//! step converts its state once.

use crate::heun::{correct, predict};
use crate::{Accelerations, Components, Feedback, Gains, Mechanism, Real, Stabilized, State, Stepped};

/// The coordinates of a mechanism as an array.
pub type Coordinates<M> = <<M as Mechanism>::Coordinates as Components>::Array;
/// One number per constraint as an array.
pub type Constraints<M> = <<M as Mechanism>::Constraints as Components>::Array;

/// The stages of a mechanism whose programs became loops.
pub trait OnArrays: Mechanism {
    /// [`stabilized`](Mechanism::stabilized): q̈, the feedback and the growth.
    fn stabilized_on_arrays(
        &self,
        t: Self::Real,
        q: &Coordinates<Self>,
        v: &Coordinates<Self>,
        inputs: &Self::Inputs,
        gains: &Gains<Self::Real>,
    ) -> (Coordinates<Self>, Constraints<Self>, Self::Real);

    /// [`constrained`](Mechanism::constrained): q̈ and the growth.
    fn constrained_on_arrays(
        &self,
        t: Self::Real,
        q: &Coordinates<Self>,
        v: &Coordinates<Self>,
        inputs: &Self::Inputs,
        feedback: &Constraints<Self>,
    ) -> (Coordinates<Self>, Self::Real);
}

/// [`Mechanism::stabilized`] of such a mechanism.
pub fn stabilized<M: OnArrays>(
    mechanism: &M,
    at: &State<M::Coordinates>,
    inputs: &M::Inputs,
    gains: &Gains<M::Real>,
) -> Stabilized<M::Coordinates, M::Constraints> {
    let (q, v) = (at.q.into_array(), at.v.into_array());
    let (acceleration, feedback, growth) = mechanism.stabilized_on_arrays(at.t, &q, &v, inputs, gains);
    let (acceleration, feedback) = (Components::from_array(acceleration), Components::from_array(feedback));
    Stabilized { acceleration, feedback, growth }
}

/// [`Mechanism::constrained`] of such a mechanism.
pub fn constrained<M: OnArrays>(
    mechanism: &M,
    at: &State<M::Coordinates>,
    inputs: &M::Inputs,
    feedback: &M::Constraints,
) -> Accelerations<M::Coordinates> {
    let (q, v, feedback) = (at.q.into_array(), at.v.into_array(), feedback.into_array());
    let (acceleration, growth) = mechanism.constrained_on_arrays(at.t, &q, &v, inputs, &feedback);
    Accelerations { acceleration: Components::from_array(acceleration), growth }
}

/// A step of Heun's method, in the operations of the stages one by one.
#[inline(never)]
pub fn step<M: OnArrays, F: Feedback>(
    mechanism: &M,
    at: &State<M::Coordinates>,
    inputs: &M::Inputs,
    gains: &Gains<M::Real>,
    h: M::Real,
    t_next: M::Real,
) -> Stepped<M::Coordinates> {
    let (q, v) = (at.q.into_array(), at.v.into_array());
    let (here, feedback, growth_here) = mechanism.stabilized_on_arrays(at.t, &q, &v, inputs, gains);
    let (mut q_next, mut v_next) = (q, v);
    predict(h, here.as_ref(), q_next.as_mut(), v_next.as_mut());
    let (there, growth_there) = if F::IS_HELD {
        mechanism.constrained_on_arrays(t_next, &q_next, &v_next, inputs, &feedback)
    } else {
        let (there, _, growth) = mechanism.stabilized_on_arrays(t_next, &q_next, &v_next, inputs, gains);
        (there, growth)
    };
    correct(h, [q.as_ref(), v.as_ref()], [here.as_ref(), there.as_ref()], q_next.as_mut(), v_next.as_mut());
    let is_finite = |array: &[M::Real]| array.iter().fold(true, |finite, x| finite & x.is_finite());
    let is_finite = is_finite(q_next.as_ref()) & is_finite(v_next.as_ref());
    Stepped {
        next: State { t: t_next, q: Components::from_array(q_next), v: Components::from_array(v_next) },
        growth: growth_here + growth_there,
        sum: M::Real::from_f64(if is_finite { 0.0 } else { f64::NAN }),
    }
}
